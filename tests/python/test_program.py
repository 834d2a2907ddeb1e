"""The module and the program have one answer, bit for bit; the pages of the module are true."""

from __future__ import annotations

import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from conftest import run_page

import meshwalk


def _program(program: str, *arguments: object) -> str:
    command = [program, *map(str, arguments)]
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


def test_the_terrain(data: Path, program: str, tmp_path: Path, random: np.random.Generator) -> None:
    table = np.loadtxt(data / "jacksboro.csv", delimiter=",", skiprows=1)
    mesh = meshwalk.delaunay(table)
    by_program = tmp_path / "terrain.ply"
    _program(program, "triangulate", data / "jacksboro.csv", "-o", by_program)
    np.testing.assert_array_equal(meshwalk.read(by_program).triangles, mesh.triangles)

    low, high = table[:, :2].min(0), table[:, :2].max(0)
    xy = random.uniform(low - 100, high + 100, (2000, 2))
    np.savetxt(tmp_path / "xy.csv", xy, "%.17g", ",", header="x,y", comments="")
    hit = meshwalk.Locator(mesh).locate(xy)
    answers = _program(program, "sample", by_program, tmp_path / "xy.csv").splitlines()
    column = answers[0].split(",").index("z")
    heights = [float(line.split(",")[column] or "nan") for line in answers[1:]]
    np.testing.assert_array_equal(hit.interpolate("z"), heights)

    answers = _program(program, "locate", by_program, tmp_path / "xy.csv").splitlines()
    column = answers[0].split(",").index("triangle")
    triangles = [int(line.split(",")[column] or -1) for line in answers[1:]]
    np.testing.assert_array_equal(hit.triangle, triangles)


def test_weights_tell_the_places(program: str, tmp_path: Path) -> None:
    """The middles of pixels, the centroids of cells, the vertices: all linear in the weights."""
    netcdf = pytest.importorskip("netCDF4")
    if len(re.findall("^  (?:GDAL|netCDF) .* found:", _program(program, "--version"), re.M)) < 2:
        pytest.skip("there is no GDAL, or no netCDF")
    (tmp_path / "grid.asc").write_text(
        "ncols 3\nnrows 2\nxllcorner 10\nyllcorner 20\ncellsize 2\n1 2 3\n4 5 6\n"
    )
    corners = [(10, 20), (16, 20), (16, 24), (10, 24)]
    rows = "".join(f"{x} {y} 0\n" for x, y in corners)
    (tmp_path / "mesh.off").write_text(f"OFF\n4 2 0\n{rows}3 0 1 2\n3 0 2 3\n")
    middles = [(x, y) for y in (23, 21) for x in (11, 13, 15)]
    centroids = np.array([corners[:3], [corners[i] for i in (0, 2, 3)]], float).mean(1)
    for of, values in ("faces", centroids), ("vertices", corners):
        options = ("--method", "conservative", "--values", of, "-q", "-o", tmp_path / "w.nc")
        _program(program, "weights", tmp_path / "mesh.off", tmp_path / "grid.asc", *options)
        with netcdf.Dataset(tmp_path / "w.nc") as file:
            for end, expected in ("a", values), ("b", middles):
                places = np.stack([file[f"{axis}c_{end}"][:] for axis in "xy"], 1)
                np.testing.assert_allclose(places, expected, rtol=0, atol=1e-14)


@pytest.mark.parametrize("page", ["README.md", "python/README.md"])
def test_pages(page: str, data: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(data.parent)
    run_page(data.parent / page)


def test_import_is_quick() -> None:
    """At most 30 ms more than NumPy alone: not timed here, but nothing large may be imported."""
    command = """
import numpy, sys
before = set(sys.modules)
import meshwalk
print(*(set(sys.modules) - before))
"""
    more = _program(sys.executable, "-c", command).split()
    others = [name for name in more if not name.startswith("meshwalk")]
    assert len(others) < 5, others


def test_the_extension_uses_the_limited_interface_only() -> None:
    from meshwalk import _core

    assert _core.__file__.endswith("_core.abi3.so")
    assert meshwalk.__version__ == _core.version


def test_where_is_that_of_the_library(square: meshwalk.Mesh) -> None:
    """The repr of a location is written by the library."""
    locator = meshwalk.Locator(square)
    for x, y in ((3, 1), (2, 0), (0, 0), (9, 9)):
        location = locator.locate_one(x, y)
        assert location.where.name.lower() in repr(location)


def test_a_globe(program: str, tmp_path: Path, random: np.random.Generator) -> None:
    from test_space import FACETS, OCTAHEDRON

    points = np.array(OCTAHEDRON) * 2.0 + [10, 20, 30]
    mesh = meshwalk.Mesh(points, FACETS)
    mesh.write(tmp_path / "globe.off")
    lonlat = random.uniform([-180, -90], [180, 90], (500, 2))
    np.savetxt(tmp_path / "d.csv", lonlat, "%.17g", ",", header="lon,lat", comments="")
    answers = _program(
        *(program, "star", tmp_path / "globe.off", tmp_path / "d.csv"),
        *("--lonlat", "--centre", "10,20,30"),
    ).splitlines()
    names = answers[0].split(",")
    table = [dict(zip(names, line.split(","), strict=True)) for line in answers[1:]]
    star = meshwalk.Star(meshwalk.Surface.read(tmp_path / "globe.off"), (10, 20, 30))
    hit = star.locate(lonlat, lonlat=True)
    np.testing.assert_array_equal(hit.triangle, [int(row["triangle"]) for row in table])
    weights = [[float(row[f"w{k}"]) for k in range(3)] for row in table]
    np.testing.assert_array_equal(hit.weights, weights)


def test_conservative_weights(data: Path, program: str, tmp_path: Path) -> None:
    """The program keeps sums, as SciPy's product tells."""
    from scipy.sparse import load_npz

    mesh = tmp_path / "terrain.ply"
    _program(program, "triangulate", data / "jacksboro.csv", "-o", mesh)
    terrain = meshwalk.read(mesh)
    low, high = terrain.points[:, :2].min(0), terrain.points[:, :2].max(0)
    size = 500
    columns, rows = np.ceil((high - low) / size).astype(int)
    grid = tmp_path / "grid.asc"
    grid.write_text(
        f"ncols {columns}\nnrows {rows}\nxllcorner {low[0]}\nyllcorner {low[1]}\n"
        f"cellsize {size}\n" + "0 " * (columns * rows) + "\n"
    )
    corner = terrain.points[terrain.triangles][:, :, :2]
    one, two = corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0]
    area = np.abs(one[:, 0] * two[:, 1] - one[:, 1] * two[:, 0]) / 2
    field = terrain.fields["z"][terrain.triangles].mean(1)

    conservative = ("weights", mesh, grid, "--method", "conservative", "-o")
    _program(program, *conservative, tmp_path / "w.npz")
    weights = load_npz(tmp_path / "w.npz")
    assert weights.shape == (rows * columns, len(area))
    assert np.isclose((weights @ field).sum() * size**2, (field * area).sum(), rtol=1e-12)
    np.testing.assert_allclose(weights.sum(0) * size**2, area, rtol=1e-11)
    heights = (weights @ field).reshape(rows, columns)
    assert heights.min() >= 0

    _program(program, *conservative, tmp_path / "v.npz", "--values", "vertices")
    linear = load_npz(tmp_path / "v.npz")
    assert np.isclose(
        (linear @ terrain.fields["z"]).sum() * size**2, (field * area).sum(), rtol=1e-12
    )

    _program(program, *conservative, tmp_path / "m.npz", "--norm", "fracarea")
    means = load_npz(tmp_path / "m.npz")
    covered = weights.sum(1)
    np.testing.assert_allclose(means.sum(1)[covered > 0], 1, rtol=1e-12)
    np.testing.assert_allclose((means @ field) * covered, weights @ field, rtol=1e-11)
