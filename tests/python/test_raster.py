"""Means of pixels over time, by the program, held against integrals in exact fractions."""

from __future__ import annotations

import subprocess
from fractions import Fraction
from itertools import pairwise
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import pytest
from conftest import turn
from numpy.typing import NDArray

import meshwalk

xarray = pytest.importorskip("xarray")

Corner = tuple[Fraction, Fraction]


class Pixels(NamedTuple):
    """As many squares of this size from the upper left corner."""

    west: Fraction
    north: Fraction
    size: Fraction
    columns: int
    rows: int

    def box(self, row: int, column: int) -> tuple[Fraction, Fraction, Fraction, Fraction]:
        """West, south, east and north of a pixel."""
        west, north = self.west + column * self.size, self.north - row * self.size
        return west, north - self.size, west + self.size, north

    def extent(self) -> str:
        """As the program takes it."""
        east, south = self.west + self.columns * self.size, self.north - self.rows * self.size
        return ",".join(repr(float(v)) for v in (self.west, south, east, self.north))


def _clipped(polygon: list[Corner], axis: int, bound: Fraction, sign: int) -> list[Corner]:
    """What of a convex polygon lies where sign * (coordinate - bound) is not negative."""
    out: list[Corner] = []
    for a, b in zip(polygon, [*polygon[1:], *polygon[:1]], strict=True):
        from_a, from_b = (sign * (p[axis] - bound) for p in (a, b))
        if from_a >= 0:
            out.append(a)
        if from_a * from_b < 0:
            part = from_a / (from_a - from_b)
            out.append((a[0] + part * (b[0] - a[0]), a[1] + part * (b[1] - a[1])))
    return out


def _twice_area(a: Corner, b: Corner, c: Corner) -> Fraction:
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])


def _parts(mesh: meshwalk.Mesh, pixels: Pixels) -> list[list[tuple[int, list[Corner]]]]:
    """Of each pixel, the triangles that have a part of it, and that part."""
    corners = [[tuple(map(Fraction, mesh.points[v])) for v in t] for t in mesh.triangles]
    found = []
    for row in range(pixels.rows):
        for column in range(pixels.columns):
            west, south, east, north = pixels.box(row, column)
            bounds = ((0, west, 1), (0, east, -1), (1, south, 1), (1, north, -1))
            parts = []
            for number, triangle in enumerate(corners):
                part: Any = triangle
                for bound in bounds:
                    part = _clipped(part, *bound)
                if len(part) > 2:
                    parts.append((number, part))
            found.append(parts)
    return found


def _area_and_integral(
    mesh: meshwalk.Mesh, number: int, part: list[Corner], values: list[Fraction]
) -> tuple[Fraction, Fraction]:
    """The area of a part of a triangle, and the integral over it of what its corners have."""
    a, b, c = (mesh.points[v] for v in mesh.triangles[number])
    whole = turn(a, b, c)

    def value(p: Corner) -> Fraction:
        weights = (turn(b, c, p), turn(c, a, p), turn(a, b, p))
        return sum((w * v for w, v in zip(weights, values, strict=True)), Fraction(0)) / whole

    area = integral = Fraction(0)
    for p, q in pairwise(part[1:]):
        size = abs(_twice_area(part[0], p, q)) / 2
        area += size
        integral += size * (value(part[0]) + value(p) + value(q)) / 3
    return area, integral


def _mean(
    mesh: meshwalk.Mesh, parts: list[tuple[int, list[Corner]]], values: list[list[Fraction]]
) -> float:
    sums = [_area_and_integral(mesh, n, part, values[n]) for n, part in parts]
    area = sum((s[0] for s in sums), Fraction(0))
    return float(sum((s[1] for s in sums), Fraction(0)) / area) if area else np.nan


def _simulation(mesh: meshwalk.Mesh, random: np.random.Generator, *, degrees: bool = False) -> Any:
    """Values of vertices and of faces at three times."""
    topology = {
        "cf_role": "mesh_topology",
        "topology_dimension": 2,
        "node_coordinates": "x y",
        "face_node_connectivity": "corners",
    }
    names = {"x": "projection_x_coordinate", "y": "projection_y_coordinate"}
    if degrees:
        names = {"x": "longitude", "y": "latitude"}
    units = {"longitude": "degrees_east", "latitude": "degrees_north"}
    return xarray.Dataset(
        {
            "mesh": ((), np.int32(0), topology),
            "corners": (("face", "three"), mesh.triangles, {"start_index": np.int32(0)}),
            "level": (("time", "node"), random.normal(size=(3, mesh.vertex_count))),
            "flow": (("time", "face"), random.normal(size=(3, mesh.triangle_count))),
        },
        coords={
            name: ("node", xy, {"standard_name": kind, "units": units.get(kind, "m")})
            for (name, kind), xy in zip(names.items(), mesh.points.T, strict=True)
        }
        | {"time": ("time", [0.0, 1.0, 3.0], {"units": "hours since 2026-01-01"})},
    )


def _bands(
    program: str, folder: Path, pixels: Pixels, *more: str
) -> dict[str, NDArray[np.float64]]:
    command = [
        *(program, "raster", "run.nc", "-q", "-o", "means.img", "--driver", "ENVI"),
        *("--mean", "--time", "all", "--type", "float64", "--resolution", str(float(pixels.size))),
        *(f"--extent={pixels.extent()}", *more),
    ]
    ran = subprocess.run(command, cwd=folder, capture_output=True, text=True)
    if "built with GDAL" in ran.stderr or "cannot be loaded" in ran.stderr:
        pytest.skip("GDAL is not found")
    assert ran.returncode == 0, ran.stderr
    header = (folder / "means.hdr").read_text()
    names = header.split("band names = {")[1].split("}")[0].replace("\n", "").split(",")
    values = np.fromfile(folder / "means.img").reshape(len(names), -1)
    return {name.strip(): band for name, band in zip(names, values, strict=True)}


def test_means_over_time_are_exact(
    program: str, tmp_path: Path, random: np.random.Generator
) -> None:
    mesh = meshwalk.delaunay(random.uniform(0, 4, (18, 2)))
    run = _simulation(mesh, random)
    run.to_netcdf(tmp_path / "run.nc")
    pixels = Pixels(Fraction(-1, 4), Fraction(9, 2), Fraction(3, 4), 7, 6)
    bands = _bands(program, tmp_path, pixels)
    assert sorted(bands) == sorted(f"{n}@{t}" for n in ("level", "flow") for t in (0, 1, 3))
    parts = _parts(mesh, pixels)
    assert sum(not p for p in parts) > 0
    for step, time in enumerate((0, 1, 3)):
        level = [
            [Fraction(float(run.level[step, v])) for v in corners] for corners in mesh.triangles
        ]
        flow = [[Fraction(float(value))] * 3 for value in run.flow[step]]
        for name, values in (("level", level), ("flow", flow)):
            expected = [_mean(mesh, p, values) for p in parts]
            np.testing.assert_allclose(bands[f"{name}@{time}"], expected, rtol=1e-11, atol=1e-12)


def test_means_over_time_across_180_degrees(
    program: str, tmp_path: Path, random: np.random.Generator
) -> None:
    """Longitudes that go on to 190, and the same from -180 on, which are cut there."""
    mesh = meshwalk.delaunay(random.uniform([165, -10], [190, 10], (40, 2)))
    run = _simulation(mesh, random, degrees=True)
    pixels = Pixels(Fraction(-180), Fraction(15), Fraction(5), 72, 6)
    found = []
    for _ in range(2):
        run.to_netcdf(tmp_path / "run.nc")
        found.append(_bands(program, tmp_path, pixels, "--crs", "EPSG:4326"))
        run["x"] = (run.x + 180) % 360 - 180
    assert float(run.x.min()) < -170
    assert len(found[0]) == 6
    for name, band in found[0].items():
        assert np.isfinite(band).sum() == 20, name
        # Hat functions of vertices are weighted by whole parts, and there are other parts.
        bound = 1e-11 if name.startswith("flow") else 0.02
        np.testing.assert_allclose(found[1][name], band, rtol=0, atol=bound)
