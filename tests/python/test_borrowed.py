"""Arrays that stay the caller's: the answers are those of a mesh."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import meshwalk
from meshwalk import BorrowedMesh, Where


def expect_same(borrowed: BorrowedMesh, mesh: meshwalk.Mesh, xy: Any) -> None:
    want = meshwalk.Locator(mesh).locate(xy)
    for walk in ("auto", "remembering", "barycentric", "direct"):
        got = borrowed.locate(xy, walk=walk)
        np.testing.assert_array_equal(got.triangle, want.triangle)
        np.testing.assert_array_equal(got.weights, want.weights)
        where = np.where(want.where == Where.HOLE, Where.OUTSIDE, want.where)
        np.testing.assert_array_equal(got.where, where)


@pytest.mark.parametrize("check", [True, False])
@pytest.mark.parametrize("kind", [np.int32, np.uint32, np.int64])
def test_answers_are_those_of_a_mesh(
    scattered: meshwalk.Mesh, random: np.random.Generator, check: bool, kind: Any
) -> None:
    xy = np.concatenate([random.integers(-2, 14, (150, 2)), random.uniform(-1, 12, (150, 2))])
    # of a Mesh neighbour k is across edge k
    borrowed = BorrowedMesh(
        scattered.points,
        scattered.triangles.astype(kind),
        scattered.neighbours,
        layout="edge",
        check=check,
    )
    expect_same(borrowed, scattered, xy)
    values = random.uniform(size=(scattered.vertex_count, 2))
    want = meshwalk.Locator(scattered).locate(xy).interpolate(values)
    np.testing.assert_allclose(borrowed.locate(xy).interpolate(values), want, rtol=1e-14)
    np.testing.assert_allclose(
        borrowed.locate(xy).interpolate(values[:, 0]), want[:, 0], rtol=1e-14
    )


def test_scipy(random: np.random.Generator) -> None:
    spatial = pytest.importorskip("scipy.spatial")
    for points in (random.uniform(size=(300, 2)), random.integers(0, 9, (200, 2)).astype(float)):
        delaunay = spatial.Delaunay(points)
        borrowed = BorrowedMesh.from_scipy(delaunay)
        assert np.shares_memory(borrowed.triangles, delaunay.simplices)
        assert np.shares_memory(borrowed.neighbours, delaunay.neighbors)
        mesh = meshwalk.Mesh(points, delaunay.simplices)
        expect_same(borrowed, mesh, random.uniform(-0.2, 1.2, (200, 2)) * points.max())
        expect_same(BorrowedMesh.from_scipy(delaunay, check=True), mesh, points)


def test_matplotlib(random: np.random.Generator) -> None:
    tri = pytest.importorskip("matplotlib.tri")
    points = random.uniform(size=(200, 2))
    expect = meshwalk.delaunay(points)
    corners = np.array(expect.triangles)
    corners[::3] = corners[::3, ::-1]  # clockwise
    for given in (tri.Triangulation(*points.T), tri.Triangulation(*points.T, corners)):
        borrowed = BorrowedMesh.from_matplotlib(given, check=True)
        mesh = meshwalk.Mesh(points, given.triangles)  # matplotlib has turned them
        expect_same(borrowed, mesh, random.uniform(-0.2, 1.2, (200, 2)))
    given.set_mask(np.arange(len(corners)) == 0)
    with pytest.raises(ValueError, match="masked"):
        BorrowedMesh.from_matplotlib(given)


def test_wrong_arrays_are_refused() -> None:
    points, triangles = [[0, 0], [1, 0], [1, 1], [0, 1]], [[0, 1, 2], [0, 2, 3]]
    right, wrong = [[-1, 1, -1], [-1, -1, 0]], [[1, -1, -1], [-1, -1, 0]]
    assert BorrowedMesh(points, triangles, right).convex
    with pytest.raises(meshwalk.InputError, match="triangle 0: its neighbour 1") as caught:
        BorrowedMesh(points, triangles, wrong)
    assert caught.value.triangle == 0
    with pytest.raises(meshwalk.InputError, match="would fit the other layout"):
        BorrowedMesh(points, triangles, right, layout="edge")
    with pytest.raises(ValueError, match="shape"):
        BorrowedMesh(points, triangles, right[:1])
    with pytest.raises(ValueError, match="layout must be"):
        BorrowedMesh(points, triangles, right, layout="other")  # type: ignore[arg-type]
    with pytest.raises(ValueError, match="the check decides this by itself"):
        BorrowedMesh(points, triangles, right, convex=True)
    with pytest.raises(ValueError, match="no walk"):
        BorrowedMesh(points, triangles, right).locate([0, 0], walk="lawsn")  # type: ignore[arg-type]
    with pytest.raises(ValueError, match="straight"):
        BorrowedMesh(points, triangles, right).locate([0, 0], walk="straight")  # type: ignore[arg-type]
    unchecked = BorrowedMesh(points, triangles, wrong, check=False)
    assert unchecked.locate([0.2, 0.7]).triangle == 1
    assert len(unchecked) == 2
    assert "4 vertices, 2 triangles" in repr(unchecked)
