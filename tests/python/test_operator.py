"""Weights that are kept."""

from __future__ import annotations

import pickle

import numpy as np
import pytest

import meshwalk


@pytest.fixture
def hit(scattered: meshwalk.Mesh, random: np.random.Generator) -> meshwalk.Locations:
    xy = np.concatenate([random.uniform(-1, 12, (40, 2)), scattered.points[:10]]).reshape(5, 10, 2)
    return meshwalk.Locator(scattered).locate(xy)


@pytest.mark.parametrize("kind", [np.float64, np.float32, np.int16])
def test_the_values_of_interpolate(
    hit: meshwalk.Locations, random: np.random.Generator, kind: type[np.generic]
) -> None:
    weights = meshwalk.Operator(hit)
    count = hit.mesh.vertex_count
    for shape in ((count,), (count, 7), (count, 2, 3), (count, 0)):
        values = (100 * random.uniform(size=shape)).astype(kind)
        for given in (values, np.asfortranarray(values), values[..., ::-1]):
            for threads in (0, 1, 2):
                got = weights.apply(given, threads)
                want = hit.interpolate(given)
                assert got.dtype == want.dtype
                np.testing.assert_array_equal(got, want)
    np.testing.assert_array_equal(weights @ np.arange(count), hit.interpolate(np.arange(count)))


def test_as_a_matrix(hit: meshwalk.Locations, random: np.random.Generator) -> None:
    weights = meshwalk.Operator(hit)
    matrix = hit.operator()
    assert weights.shape == matrix.shape
    assert weights.nnz == matrix.nnz
    assert (weights.tocsr() != matrix).nnz == 0
    assert 0 < weights.nbytes < 100 * len(matrix.indptr)
    values = random.uniform(size=hit.shape)
    np.testing.assert_allclose(weights.T @ values, matrix.T @ values.ravel(), rtol=1e-13)
    back = weights.T.T
    vertices = random.uniform(size=hit.mesh.vertex_count)
    there = hit.inside
    np.testing.assert_allclose(
        (back @ vertices)[there], hit.interpolate(vertices)[there], rtol=1e-14
    )
    assert repr(weights.T).endswith("weights, transposed>")


def test_missing_values() -> None:
    mesh = meshwalk.Mesh([[0, 0], [4, 0], [0, 4]], [[0, 1, 2]])
    weights = meshwalk.Operator(meshwalk.Locator(mesh).locate([[1, 1], [0, 2], [9, 9]]))
    values = [np.nan, 5.0, 9.0]
    assert np.isnan(weights @ values).all()
    filled = weights.apply(values, leave_out_missing=True)
    np.testing.assert_array_equal(filled, [7, 9, np.nan])


def test_refused(hit: meshwalk.Locations) -> None:
    weights = meshwalk.Operator(hit)
    with pytest.raises(ValueError, match=r"values must have a row for each of the \d+ vertices"):
        weights @ [1.0, 2.0]
    with pytest.raises(TypeError, match="values must be real numbers"):
        weights @ np.array(["a"] * weights.shape[1])
    assert isinstance(hit.mesh, meshwalk.Mesh)
    borrowed = meshwalk.BorrowedMesh(
        hit.mesh.points, hit.mesh.triangles, hit.mesh.neighbours, layout="edge"
    )
    with pytest.raises(TypeError, match="in a Mesh or a Surface, not in a BorrowedMesh"):
        meshwalk.Operator(meshwalk.Locations(borrowed, hit.records))


def test_pickles(hit: meshwalk.Locations, random: np.random.Generator) -> None:
    values = random.uniform(size=(hit.mesh.vertex_count, 3))
    for weights in (meshwalk.Operator(hit), meshwalk.Operator(hit[:0])):
        back = pickle.loads(pickle.dumps(weights))
        assert repr(back) == repr(weights)
        np.testing.assert_array_equal(back @ values, weights @ values)
        spread = random.uniform(size=weights.apply(values[:, 0]).shape)
        turned = pickle.loads(pickle.dumps(weights.T))
        assert repr(turned) == repr(weights.T)
        np.testing.assert_allclose(turned @ spread, weights.T @ spread)
