"""Location: exact answers of any shape, and what is made of them."""

from __future__ import annotations

import pickle
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from conftest import oracle

import meshwalk
from meshwalk import Where


def test_answers_are_exact(scattered: meshwalk.Mesh, random: np.random.Generator) -> None:
    xy = np.concatenate([random.integers(-2, 14, (150, 2)), random.uniform(-1, 12, (150, 2))])
    hit = meshwalk.Locator(scattered).locate(xy)
    np.testing.assert_array_equal(hit.triangle, [oracle(scattered, p) for p in xy])


def test_one_point_is_as_many(scattered: meshwalk.Mesh, random: np.random.Generator) -> None:
    locator = meshwalk.Locator(scattered)
    xy = random.integers(-2, 14, (200, 2)).astype(float)
    hit = locator.locate(xy)
    for i, (x, y) in enumerate(xy):
        one = locator.locate_one(x, y)
        assert one.triangle == hit.triangle[i]
        assert one.where is Where(hit.where[i])
        assert one.inside == hit.inside[i]
        assert one.hole == hit.hole[i]
        assert one.local == (-1 if hit.local[i] == 255 else hit.local[i])
        np.testing.assert_array_equal(one.weights, hit.weights[i])


def test_where(ring: meshwalk.Mesh) -> None:
    xy: Any = [[3, 1], [3, 0], [0, 0], [9, 9], [3, 3], [np.nan, 0], [np.inf, 0]]
    hit = meshwalk.Locator(ring).locate(xy)
    kinds = ["INSIDE", "EDGE", "VERTEX", "OUTSIDE", "HOLE", "BAD", "BAD"]
    assert [Where(w).name for w in hit.where] == kinds
    assert hit.hole.tolist() == [-1, -1, -1, -1, 0, -1, -1]
    assert hit.inside.tolist() == [True, True, True, False, False, False, False]
    assert np.isnan(hit.weights[3:]).all()
    counts = "1 inside, 1 edge, 1 vertex, 1 outside, 1 hole, 2 bad"
    assert repr(hit) == f"<Locations: 7 points; {counts}>"


@pytest.mark.parametrize("shape", [(), (1,), (0,), (5,), (2, 3), (2, 0, 3), (2, 3, 4)])
def test_answers_have_the_shape_of_the_points(ring: meshwalk.Mesh, shape: tuple[int, ...]) -> None:
    hit = meshwalk.Locator(ring).locate(np.full((*shape, 2), 1.0))
    assert hit.shape == hit.triangle.shape == hit.where.shape == hit.inside.shape == shape
    assert hit.weights.shape == (*shape, 3)
    assert hit.interpolate(np.zeros(8)).shape == shape
    assert hit.interpolate(np.zeros((8, 2, 5))).shape == (*shape, 2, 5)
    assert hit.interpolate(np.zeros((8, 0))).shape == (*shape, 0)
    assert isinstance(repr(hit), str)


def test_answers_are_views(square: meshwalk.Mesh) -> None:
    hit = meshwalk.Locator(square).locate(np.ones((10, 2)))
    for view in (hit.triangle, hit.where, hit.weights, hit.hole, hit.local, np.asarray(hit)):
        assert np.shares_memory(view, hit.records)
    assert hit.triangle.dtype == np.int32
    assert hit.where.dtype == np.uint8


def test_indexing(square: meshwalk.Mesh) -> None:
    hit = meshwalk.Locator(square).locate([[3, 1], [1, 3], [9, 9]])
    assert hit[1].triangle == 1
    assert hit[hit.inside].triangle.tolist() == [0, 1]
    assert hit[::2].shape == (2,)
    np.testing.assert_array_equal(hit[::2].interpolate([1, 1, 1, 1]), [1, np.nan])
    assert len(hit) == 3


def test_tolerance(square: meshwalk.Mesh) -> None:
    locator = meshwalk.Locator(square, border=True)
    hit = locator.locate([[2, 5], [2, 9]], 1)
    assert hit.where.tolist() == [Where.NEAR, Where.OUTSIDE]
    assert hit.triangle.tolist() == [1, -1]
    assert not hit.inside.any()
    np.testing.assert_array_equal(hit.interpolate([0, 0, 4, 4]), [4, np.nan])
    with pytest.raises(ValueError, match="tolerance"):
        meshwalk.Locator(square).locate([[2, 5]], tolerance=1)
    for wrong in (-1, np.nan, np.inf):
        with pytest.raises(ValueError, match="tolerance"):
            locator.locate([[2, 5]], tolerance=wrong)


def test_nearest_border(square: meshwalk.Mesh) -> None:
    near = meshwalk.Locator(square, border=True).nearest_border(2, 5)
    assert (near.triangle, near.edge, near.distance, near.point) == (1, 1, 1, (2, 4))
    with pytest.raises(ValueError, match="border"):
        meshwalk.Locator(square).nearest_border(2, 5)
    with pytest.raises(ValueError, match="finite"):
        meshwalk.Locator(square, border=True).nearest_border(np.nan, 5)


def test_walks_and_starts_have_one_answer(
    scattered: meshwalk.Mesh, random: np.random.Generator
) -> None:
    xy = random.integers(-2, 14, (100, 2))
    locator = meshwalk.Locator(scattered)
    expected = locator.locate(xy).records
    for options in ({"walk": "straight"}, {"walk": "celestial", "lanes": 3}, {"start": "random"}):
        np.testing.assert_array_equal(locator.locate(xy, **options).triangle, expected["triangle"])
    with pytest.raises(ValueError, match="there is no walk 'ramble'"):
        locator.locate(xy, walk="ramble")
    with pytest.raises(ValueError, match="there is no start 'nowhere'"):
        locator.locate(xy, start="nowhere")


def test_no_embedding_is_refused_by_name() -> None:
    points = [[0, 0], [4, 0], [0, 4], [1, 1]]
    mesh = meshwalk.Mesh(points, [[0, 1, 2], [0, 1, 3]])
    with pytest.raises(meshwalk.InputError) as raised:
        meshwalk.Locator(mesh)
    assert raised.value.triangle == 0
    assert raised.value.defect is not None
    assert raised.value.defect.kind == "folded along an edge"
    locator = meshwalk.Locator(mesh, any=True)
    assert not locator.describe().embedding
    assert locator.describe().void_promise
    with pytest.raises(meshwalk.InputError):
        meshwalk.Locator(meshwalk.Mesh(np.empty((0, 2)), []))


def test_description(ring: meshwalk.Mesh) -> None:
    info = meshwalk.Locator(ring).describe()
    assert info.holes == 1
    assert info.ghost_triangles == 2
    assert info.copied
    assert meshwalk.Locator(ring, fill="no").describe().unfilled
    with pytest.raises(ValueError, match="fill must be one of"):
        meshwalk.Locator(ring, fill="maybe")  # type: ignore[arg-type]


def test_late_chains(random: np.random.Generator) -> None:
    """Walks round a hub are long: they lead to chains, unless these are not wanted."""
    angle = np.linspace(0, 2 * np.pi, 400, endpoint=False)
    wheel = 0.09 * np.stack([np.cos(angle), np.sin(angle)], axis=1)
    turns, radius = 2 * np.pi * random.random(4000), 2.0 ** (-8 - 30 * random.random(4000))
    queries = np.stack([radius * np.cos(turns), radius * np.sin(turns)], axis=1)
    for _ in range(200):
        others = random.uniform(-1, 1, (600, 2))
        others = others[np.hypot(*others.T) > 0.1]
        mesh = meshwalk.delaunay(np.concatenate([[[0, 0]], wheel, others]))
        locator = meshwalk.Locator(mesh)
        without = meshwalk.Locator(mesh, late_chains=False)
        before = locator.describe()
        if before.chain_bytes == 0:
            break
    assert before.chain_bytes == 0
    answers = locator.locate(queries, walk="straight", start="sorted").triangle
    for _ in range(10):
        for asked in locator, without:
            assert (asked.locate(queries).triangle == answers).all()
    after = locator.describe()
    assert after.chain_bytes > 0
    assert after.bytes - before.bytes == after.chain_bytes
    assert after.guide_bytes - before.guide_bytes == after.chain_bytes
    assert without.describe().chain_bytes == 0
    assert pickle.loads(pickle.dumps(without))._options == without._options


def test_interpolation_is_exact_at_vertices(
    scattered: meshwalk.Mesh, random: np.random.Generator
) -> None:
    hit = meshwalk.Locator(scattered).locate(scattered.points)
    for kind in (np.float64, np.float32, np.float16, np.int32):
        values = random.integers(-1000, 1000, scattered.vertex_count).astype(kind)
        result = hit.interpolate(values)
        narrow = kind in (np.float32, np.float16)
        assert result.dtype == (np.float32 if narrow else np.float64)
        np.testing.assert_array_equal(result, values)


def test_interpolation_of_columns(scattered: meshwalk.Mesh, random: np.random.Generator) -> None:
    hit = meshwalk.Locator(scattered).locate(random.uniform(-1, 12, (50, 2)))
    values = random.uniform(size=(scattered.vertex_count, 3, 2))
    result = hit.interpolate(values)
    for i in range(3):
        for k in range(2):
            np.testing.assert_array_equal(result[:, i, k], hit.interpolate(values[:, i, k]))
    np.testing.assert_array_equal(hit.interpolate(np.asfortranarray(values)), result)
    expected = np.einsum("pk,pkij->pij", hit.weights, values[scattered.triangles[hit.triangle]])
    np.testing.assert_allclose(result, expected, rtol=1e-14)


def test_interpolation_of_layouts(scattered: meshwalk.Mesh, random: np.random.Generator) -> None:
    hit = meshwalk.Locator(scattered).locate(random.uniform(-1, 12, (50, 2)))
    wide = random.uniform(size=(scattered.vertex_count, 14))
    for kind in ("f2", "f4", "f8", ">f4", ">f8", "g"):
        values = wide.astype(kind)
        narrow = kind in ("f2", "f4", ">f4")
        every = [hit.interpolate(values[:, k].astype(float)) for k in range(14)]
        expected = np.column_stack(every).astype(np.float32 if narrow else np.float64)
        for part in (slice(None), slice(2, 9), slice(3, 4), slice(0, 14, 3), slice(None, None, -1)):
            result = hit.interpolate(values[:, part])
            np.testing.assert_array_equal(result, expected[:, part])
            assert result.dtype == expected.dtype
        by_time = np.ascontiguousarray(values.T)
        np.testing.assert_array_equal(hit.interpolate(by_time.T), expected)
        np.testing.assert_array_equal(hit.interpolate(by_time.T, threads=1), expected)
        by_layer = by_time.reshape(7, 2, -1).T  # vertex, layer, time
        layers = expected.reshape(50, 7, 2).transpose(0, 2, 1)
        np.testing.assert_array_equal(hit.interpolate(by_layer), layers)
        square = hit[:48].records.reshape(6, 8)
        both = meshwalk.Locations(scattered, square).interpolate(by_layer)
        np.testing.assert_array_equal(both, layers[:48].reshape(6, 8, 2, 7))
        windows = np.lib.stride_tricks.sliding_window_view(np.append(values[:, 0], [1, 2]), 3)
        copied = hit.interpolate(windows.copy())
        np.testing.assert_array_equal(hit.interpolate(windows), copied)
        same = np.broadcast_to(values[:, :1], values.shape)
        np.testing.assert_array_equal(hit.interpolate(same), np.repeat(expected[:, :1], 14, 1))
        np.testing.assert_array_equal(hit.interpolate(values[::-1][::-1]), expected)


def test_missing_values(square: meshwalk.Mesh) -> None:
    hit = meshwalk.Locator(square).locate([[3, 1], [4, 2], [9, 9]])
    masked = np.ma.masked_values([-999.0, 1.0, 2.0, 3.0], -999.0)
    np.testing.assert_array_equal(hit.interpolate(masked), [np.nan, 1.5, np.nan])
    whole = np.ma.masked_equal([-9, 1, 2, 3], -9)
    np.testing.assert_array_equal(hit.interpolate(whole), [np.nan, 1.5, np.nan])
    np.testing.assert_array_equal(hit.interpolate([np.nan, 1, 2, 3]), [np.nan, 1.5, np.nan])


def test_values_that_do_not_fit(square: meshwalk.Mesh) -> None:
    hit = meshwalk.Locator(square).locate([[3, 1]])
    with pytest.raises(ValueError, match=r"a row for each of the 4 vertices; its shape is \(3,\)"):
        hit.interpolate([1, 2, 3])
    with pytest.raises(TypeError, match="values must be real numbers, not complex128"):
        hit.interpolate(np.zeros(4, complex))
    with pytest.raises(KeyError, match="the mesh has no field 'z'; it has none"):
        hit.interpolate("z")


def test_pickle(ring: meshwalk.Mesh) -> None:
    locator = meshwalk.Locator(ring, border=True)
    hit = locator.locate([[3, 1], [3, 3]])
    locator, hit = pickle.loads(pickle.dumps((locator, hit)))
    assert hit.triangle.tolist() == [0, -1]
    assert locator.nearest_border(3, -1).distance == 1
    for name in hit.records.dtype.names:
        again = locator.locate([[3, 1], [3, 3]]).records[name]
        np.testing.assert_array_equal(again, hit.records[name])


def test_locate_one_takes_two_numbers(square: meshwalk.Mesh) -> None:
    locator = meshwalk.Locator(square)
    assert locator.locate_one(np.float32(3), 1).triangle == 0
    assert repr(locator.locate_one(9, 9)) == "<Location: outside>"
    with pytest.raises(TypeError, match="takes x and y"):
        locator.locate_one(3)  # type: ignore[call-arg]
    with pytest.raises(TypeError):
        locator.locate_one("3", 1)  # type: ignore[arg-type]


def test_types_are_not_made_by_hand(square: meshwalk.Mesh) -> None:
    with pytest.raises(TypeError):
        meshwalk.Location()
    with pytest.raises(TypeError, match=r"mesh must be a meshwalk\.Mesh, not ndarray"):
        meshwalk.Locator(np.zeros((3, 2)))  # type: ignore[arg-type]
    with pytest.raises(TypeError, match="records must be of the type that locate gives"):
        meshwalk.Locations(square, np.zeros(3))


def test_operator(scattered: meshwalk.Mesh, random: np.random.Generator) -> None:
    xy = np.concatenate([random.uniform(-1, 12, (40, 2)), scattered.points[:10]]).reshape(5, 10, 2)
    hit = meshwalk.Locator(scattered).locate(xy)
    operator = hit.operator()
    assert operator.shape == (50, scattered.vertex_count)
    assert (operator.data != 0).all()
    values = random.uniform(size=(scattered.vertex_count, 2))
    product = np.where(hit.triangle.ravel()[:, None] >= 0, operator @ values, np.nan)
    np.testing.assert_allclose(product.reshape(5, 10, 2), hit.interpolate(values), rtol=1e-14)
    assert (np.diff(operator.indptr)[~hit.inside.ravel()] == 0).all()
    assert meshwalk.Locator(scattered).locate([]).operator().shape == (0, scattered.vertex_count)


def test_weights_in_a_file(square: meshwalk.Mesh, tmp_path: Path) -> None:
    from scipy.io import netcdf_file

    hit = meshwalk.Locator(square).locate([[3, 1], [9, 9], [4, 4]])
    hit.to_esmf(tmp_path / "weights.nc")
    with netcdf_file(tmp_path / "weights.nc", mmap=False) as file:
        assert file.dimensions == {"n_a": 4, "n_b": 3, "n_s": 4}
        assert file.variables["row"][:].tolist() == [1, 1, 1, 3]
        assert file.variables["col"][:].tolist() == [1, 2, 3, 3]
        assert file.variables["S"][:].tolist() == [0.25, 0.5, 0.25, 1]
        assert file.variables["row"].start_index == file.variables["col"].start_index == 1
        assert file.variables["mask_b"][:].tolist() == [1, 0, 1]
        assert file.variables["frac_b"][:].tolist() == [1, 0, 1]
        assert file.variables["frac_a"][:].tolist() == [1, 1, 1, 0]
        assert file.variables["status_b"][:].tolist() == hit.where.tolist()
        assert file.variables["yc_a"][:].tolist() == square.points[:, 1].tolist()
