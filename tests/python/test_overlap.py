"""Volumes, areas over regions, and conservative weights."""

from __future__ import annotations

import json
import pickle
import subprocess
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import meshwalk


@pytest.fixture
def hills(random: np.random.Generator) -> tuple[meshwalk.Mesh, meshwalk.Mesh]:
    """Two meshes of one square, with heights."""
    meshes = []
    for count in (200, 300):
        xy = np.vstack([[[0, 0], [9, 0], [9, 9], [0, 9]], random.uniform(0, 9, (count, 2))])
        heights = np.sin(xy[:, 0]) + random.uniform(size=len(xy))
        meshes.append(meshwalk.delaunay(np.column_stack([xy, heights])))
    return meshes[0], meshes[1]


def _run(*command: object) -> str:
    return subprocess.run([*map(str, command)], check=True, capture_output=True, text=True).stdout


def test_volumes_are_those_of_the_program(
    hills: tuple[meshwalk.Mesh, meshwalk.Mesh], program: str, tmp_path: Path
) -> None:
    names = [tmp_path / "a.ply", tmp_path / "b.ply"]
    for mesh, name in zip(hills, names, strict=True):
        mesh.write(name)
    info = meshwalk.volume(*hills)
    told = json.loads(_run(program, "volume", names[0], "--against", names[1], "--json"))
    for key in ("cut", "fill", "area", "cut_area", "fill_area", "level_area"):
        assert getattr(info, key) == told[key]
    assert info.area == pytest.approx(81)
    above = meshwalk.volume(meshwalk.Locator(hills[0], fill="yes"), 0.5, threads=2)
    told = json.loads(_run(program, "volume", names[0], "--base", 0.5, "--json"))
    assert (above.cut, above.fill) == (told["cut"], told["fill"])


def test_volumes_that_are_known(hills: tuple[meshwalk.Mesh, meshwalk.Mesh]) -> None:
    first, second = hills
    zero = np.zeros(first.vertex_count)
    assert meshwalk.volume(first, 1, heights=zero).fill == pytest.approx(81)
    raised = meshwalk.volume(first, second, heights=zero, other_heights=np.ones(304))
    assert raised.fill == pytest.approx(81)
    assert raised.cut == 0
    there = meshwalk.volume(first, second)
    back = meshwalk.volume(second, first)
    assert (there.cut, there.fill) == pytest.approx((back.fill, back.cut))
    missing = first.fields["z"].copy()
    missing[0] = np.nan
    partly = meshwalk.volume(first, second, heights=missing)
    assert partly.other_only == pytest.approx(81 - partly.area)
    assert partly.other_only > 0


def test_areas_of_slopes(hills: tuple[meshwalk.Mesh, meshwalk.Mesh]) -> None:
    mesh = hills[0]
    slope = 0.75 * mesh.points[:, 0]
    region = meshwalk.Mesh([[1, 1], [3, 1], [3, 4], [1, 4]], [[0, 1, 2], [0, 2, 3]])
    info = meshwalk.surface_area(mesh, region, heights=slope)
    assert info.surface_area == pytest.approx(6 * 1.25)
    assert (info.area, info.region_area) == pytest.approx((6, 6))


def test_weights_are_those_of_the_program(
    hills: tuple[meshwalk.Mesh, meshwalk.Mesh], program: str, tmp_path: Path
) -> None:
    from scipy.sparse import load_npz

    names = [tmp_path / "a.ply", tmp_path / "b.ply"]
    for mesh, name in zip(hills, names, strict=True):
        mesh.write(name)
    for values, others in (("triangles", "faces"), ("vertices", "vertices")):
        weights = meshwalk.remap(*hills, values)  # type: ignore[arg-type]
        _run(
            *(program, "weights", names[0], names[1], "--method", "conservative"),
            *("--values", others, "-o", tmp_path / "w.npz"),
        )
        expected = load_npz(tmp_path / "w.npz")
        ours = weights.weights.tocsr()
        np.testing.assert_array_equal(ours.toarray(), expected.toarray())


def test_sums_are_conserved(
    hills: tuple[meshwalk.Mesh, meshwalk.Mesh], random: np.random.Generator
) -> None:
    first, second = hills
    of_triangles = random.uniform(size=(first.triangle_count, 3))
    for target in (second, meshwalk.Pixels(-1, 10, 0.5, 0.25, 22, 44)):
        weights = meshwalk.remap(first, target)
        result = np.nan_to_num(weights @ of_triangles)
        sums = (result * weights.target_area[..., None]).reshape(-1, 3).sum(0)
        np.testing.assert_allclose(sums, weights.source_area @ of_triangles)
        assert weights.common_sum == pytest.approx(81)
        assert weights.source_fraction == pytest.approx(1)
    assert result.shape == (44, 22, 3)
    assert weights.target_fraction.shape == (44, 22)
    ones = meshwalk.remap(first, target, covered=True) @ np.ones(first.triangle_count)
    assert np.nanmin(ones) == pytest.approx(1)
    assert np.isnan(ones[0]).all()
    linear = meshwalk.remap(first, second, "vertices")
    at = linear @ (2 * first.points[:, 0])
    np.testing.assert_allclose(at, 2 * second.points[second.triangles, 0].mean(1))


def test_cells_of_several_triangles(hills: tuple[meshwalk.Mesh, meshwalk.Mesh]) -> None:
    first, second = hills
    cells = np.arange(first.triangle_count) // 2
    by_cells = meshwalk.remap(first, second, source_cells=cells)
    whole = meshwalk.remap(first, second)
    values = np.arange(cells.max() + 1.0)
    np.testing.assert_allclose(by_cells @ values, whole @ values[cells])
    one = meshwalk.remap(first, second, target_cells=np.zeros(second.triangle_count, int))
    assert (one @ np.ones(first.triangle_count)).shape == (1,)


OCTAHEDRON = meshwalk.Mesh(
    [[0, 0], [90, 0], [180, 0], [-90, 0], [17, 90], [5, -90]],
    [[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4], [1, 0, 5], [2, 1, 5], [3, 2, 5], [0, 3, 5]],
)
CAPS = meshwalk.Mesh(
    [[10, 60], [130, 60], [-110, 60], [70, -45], [-170, -45], [-50, -45]],
    [[0, 1, 2], [5, 4, 3], [0, 3, 1], [1, 3, 4], [1, 4, 2], [2, 4, 5], [2, 5, 0], [0, 5, 3]],
)
"""Meshes of the whole globe: vertices at the poles; triangles with the poles inside."""


@pytest.mark.parametrize("source", [OCTAHEDRON, CAPS])
@pytest.mark.parametrize(
    "target", [OCTAHEDRON, CAPS, meshwalk.Pixels(-180, 90, 45, 45, columns=8, rows=4)]
)
def test_the_globe_is_cut(source: meshwalk.Mesh, target: Any) -> None:
    weights = meshwalk.remap(source, target, degrees=True)
    assert weights.common_sum == pytest.approx(4 * np.pi, rel=1e-13)
    assert weights.source_fraction == pytest.approx(1)
    assert weights.target_fraction == pytest.approx(1)
    assert weights.source_area.shape == (8,)
    values = np.arange(8.0)
    result = weights @ values
    assert (result * weights.target_area).sum() == pytest.approx(weights.source_area @ values)


def test_the_globe_as_the_program_cuts_it(program: str, tmp_path: Path) -> None:
    from scipy.sparse import load_npz

    for mesh, name in ((CAPS, "caps.off"), (OCTAHEDRON, "octa.off")):
        mesh.write(tmp_path / name)
    _run(
        *(program, "weights", tmp_path / "caps.off", tmp_path / "octa.off"),
        *("--method", "conservative", "--crs", "EPSG:4326", "--points-crs", "EPSG:4326"),
        *("-o", tmp_path / "w.npz"),
    )
    ours = meshwalk.remap(CAPS, OCTAHEDRON, degrees=True).weights.tocsr()
    np.testing.assert_array_equal(ours.toarray(), load_npz(tmp_path / "w.npz").toarray())


def test_cells_with_a_pole_inside() -> None:
    """Two triangles of the northern cap as one cell, over both pole and seam."""
    points = np.array([[-170, 60], [-80, 50], [10, 50], [100, 60]])
    cap = meshwalk.Mesh(points, [[0, 1, 2], [0, 2, 3]])
    pixels = meshwalk.Pixels(-180, 90, 90, 90, columns=4, rows=1)
    weights = meshwalk.remap(cap, pixels, source_cells=[0, 0], degrees=True)
    assert weights.source_area.shape == (1,)
    assert weights.source_fraction == pytest.approx(1)
    assert (weights.target_fraction > 0).all()
    with pytest.raises(ValueError, match="values='vertices' is not possible there"):
        meshwalk.remap(cap, pixels, "vertices", degrees=True)
    far = meshwalk.Mesh(points - [20, 0], cap.triangles)
    with pytest.raises(meshwalk.InputError, match="longitudes, from -190 to 80, have to lie"):
        meshwalk.remap(far, pixels, degrees=True)
    twice = meshwalk.Mesh([*points, [20, 55], [-70, 55], [-80, 40]], [*cap.triangles, [4, 5, 6]])
    with pytest.raises(meshwalk.InputError) as caught:
        meshwalk.remap(twice, pixels, degrees=True)
    assert "goes round the globe" in caught.value.__notes__[0]
    # A locator is of a mesh in the plane, and that mesh is not cut.
    with pytest.raises(meshwalk.InputError, match=r"differ by .* count them from 0 to 360"):
        meshwalk.remap(meshwalk.Locator(cap), pixels, degrees=True)


def test_weights_pickle_and_print(
    hills: tuple[meshwalk.Mesh, meshwalk.Mesh], tmp_path: Path
) -> None:
    from scipy.io import netcdf_file

    weights = meshwalk.remap(hills[0], meshwalk.Pixels(0, 9, 3, 3, 3, 3))
    again = pickle.loads(pickle.dumps(weights))
    values = hills[0].triangles[:, 0]
    np.testing.assert_array_equal(again @ values, weights @ values)
    assert repr(again) == repr(weights)
    assert repr(weights).startswith(f"<Remap: {len(hills[0])} values to 9 cells, ")
    assert " cells, " in repr(weights.weights)
    weights.to_esmf(tmp_path / "w.nc")
    with netcdf_file(tmp_path / "w.nc", mmap=False) as file:
        matrix = np.zeros((9, len(hills[0])))
        matrix[file.variables["row"][:] - 1, file.variables["col"][:] - 1] = file.variables["S"][:]
        np.testing.assert_array_equal(file.variables["area_b"][:], 9)
        np.testing.assert_array_equal(file.variables["frac_a"][:], weights.source_fraction)
    np.testing.assert_array_equal(matrix, weights.weights.tocsr().toarray())


Call = Callable[[Any], object]
VOLUME: Callable[..., Any] = meshwalk.volume  # not only with what their types allow
REMAP: Callable[..., Any] = meshwalk.remap


@pytest.mark.parametrize(
    ("call", "error", "message"),
    [
        (lambda m: VOLUME(m, "low"), TypeError, "other must be a Mesh, a Locator or a n"),
        (lambda m: meshwalk.volume(m, np.nan), ValueError, "base"),
        (lambda m: VOLUME(7, m), TypeError, "surface must be a Mesh or a Lo"),
        (lambda m: meshwalk.volume(m, 1, heights="h"), KeyError, "no field 'h'; it has z"),
        (lambda m: meshwalk.volume(m, 1, heights=[1, 2]), ValueError, "heights must have the sh"),
        (lambda m: REMAP(m, m, "faces"), ValueError, "values must be 'triangles' or"),
        (lambda m: REMAP(m, 3), TypeError, "target must be a Mesh or a Locator, not int"),
        (lambda m: meshwalk.remap(m, m, source_cells=[0]), ValueError, "source_cells must have"),
        (
            lambda m: meshwalk.remap(m, m, source_cells=np.full(len(m), -1)),
            ValueError,
            r"source_cells\[0\] is no cell",
        ),
        (
            lambda m: meshwalk.remap(m, m, "vertices", source_cells=np.zeros(len(m), int)),
            ValueError,
            "source_cells need values='triangles'",
        ),
        (
            lambda m: meshwalk.remap(m, meshwalk.Pixels(0, 0, 0, 1, 2, 2)),
            ValueError,
            "pixel",
        ),
        (
            lambda m: meshwalk.remap(m, m) @ [1, 2],
            ValueError,
            "a row for each of the 402 cells",
        ),
    ],
)
def test_refusals(
    hills: tuple[meshwalk.Mesh, meshwalk.Mesh], call: Call, error: type[Exception], message: str
) -> None:
    mesh = meshwalk.delaunay(np.column_stack([hills[0].points, hills[0].fields["z"]])[:204])
    assert len(mesh) == 402
    with pytest.raises(error, match=message):
        call(mesh)


def test_open_pockets_are_refused(ring: meshwalk.Mesh) -> None:
    open_one = meshwalk.Locator(ring, fill="no")
    heights = np.zeros(8)
    with pytest.raises(ValueError, match="pockets and holes"):
        meshwalk.volume(open_one, 1, heights=heights)
    assert meshwalk.volume(ring, 1, heights=heights).area == 32


def test_cancelled(hills: tuple[meshwalk.Mesh, meshwalk.Mesh]) -> None:
    def stop(stage: str, done: float) -> None:
        raise ZeroDivisionError

    with pytest.raises(ZeroDivisionError):
        meshwalk.volume(*hills, progress=stop)
    with pytest.raises(ZeroDivisionError):
        meshwalk.remap(*hills, progress=stop)
