"""The accessor of xarray: against the locator, the program, and SciPy; lazily, by blocks."""

from __future__ import annotations

import subprocess
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest
import xarray
from conftest import run_page

import meshwalk.xarray

if TYPE_CHECKING:
    from numpy.typing import NDArray

NODES = {"lon": ("x", "longitude", "degrees_east"), "lat": ("y", "latitude", "degrees_north")}


def ugrid(random: np.random.Generator, start: int = 1) -> Any:
    """A dataset of triangles and quads; the mesh is counted from `start`."""
    x, y = np.meshgrid(np.linspace(3, 5, 9), np.linspace(50, 52, 9))
    points = np.stack([x, y], axis=-1).reshape(-1, 2) + 0.02 * random.random((81, 2))
    corner = (np.arange(8) + 9 * np.arange(8)[:, None]).reshape(-1)
    quads = np.stack([corner, corner + 1, corner + 10, corner + 9], axis=1).astype(float) + start
    quads[::3, 3] = np.nan
    late = quads[::3, :3].copy()
    late[:, 1] = late[:, 2]
    late[:, 2] = corner[::3] + 9 + start
    faces = np.concatenate([quads, np.column_stack([late, np.full(len(late), np.nan)])])
    topology = {
        "cf_role": "mesh_topology",
        "topology_dimension": 2,
        "node_coordinates": "lon lat",
        "face_node_connectivity": "corners",
    }
    ds = xarray.Dataset(
        {
            "mesh": ((), np.int32(0), topology),
            "corners": (("cell", "four"), faces, {"start_index": np.int32(start)}),
            "zeta": (
                ("time", "node"),
                random.random((5, 81)).astype(np.float32),
                {"standard_name": "sea_surface_height_above_geoid", "units": "m"},
            ),
            "u": (("time", "cell", "layer"), random.random((5, len(faces), 2))),
            "h": ("node", 10 * random.random(81)),
        },
        coords={
            name: ("node", points[:, k], {"standard_name": standard, "units": units})
            for k, (name, (_, standard, units)) in enumerate(NODES.items())
        }
        | {"time": np.datetime64("2026-01-01", "ns") + np.arange(5) * np.timedelta64(1, "h")},
        attrs={"title": "a bay"},
    )
    ds.corners.encoding.update(dtype="int32", _FillValue=-999)
    return ds


@pytest.fixture
def queries(random: np.random.Generator) -> NDArray[Any]:
    return random.random((200, 2)) * 2.4 + [2.8, 49.8]


@pytest.mark.parametrize("start", [0, 1])
def test_answers_are_those_of_the_mesh(
    random: np.random.Generator, queries: NDArray[Any], start: int, tmp_path: Path
) -> None:
    ds = ugrid(random, start)
    ds.to_netcdf(tmp_path / "bay.nc")
    mesh = meshwalk.read(tmp_path / "bay.nc")
    hit = meshwalk.Locator(mesh).locate(queries)
    assert 50 < hit.inside.sum() < 200
    with xarray.open_dataset(tmp_path / "bay.nc") as opened:
        for dataset in (ds, opened):
            access = dataset.meshwalk
            np.testing.assert_array_equal(access.mesh.triangles, mesh.triangles)
            assert (access.vertex_dim, access.face_dim) == ("node", "cell")
            out = access.sample(queries)
            assert set(out.data_vars) == {"zeta", "u", "h"}
            assert out.zeta.dims == ("time", "points")
            assert out.zeta.dtype == np.float32
            np.testing.assert_array_equal(out.zeta, hit.interpolate(ds.zeta.to_numpy().T).T)
            np.testing.assert_array_equal(out.h, hit.interpolate("h"))
            assert out.u.dims == ("time", "layer", "points")
            inside = hit.inside
            face = out.face.to_numpy()
            assert (face[~inside] == -1).all()
            np.testing.assert_array_equal(
                out.u.to_numpy()[..., inside], np.moveaxis(ds.u.to_numpy()[:, face[inside]], 1, 2)
            )
            assert np.isnan(out.u.to_numpy()[..., ~inside]).all()
            assert out.lon.attrs["standard_name"] == "longitude"
            assert out.zeta.attrs["units"] == "m"
            assert out.attrs["title"] == "a bay"
            np.testing.assert_array_equal(out.lat, queries[:, 1])


def test_faces_hold_their_points(random: np.random.Generator, queries: NDArray[Any]) -> None:
    ds = ugrid(random)
    face = ds.meshwalk.sample(queries, "u").face.to_numpy()
    corners = ds.corners.to_numpy()
    points = np.column_stack([ds.lon, ds.lat])
    for k in np.flatnonzero(face >= 0):
        ring = points[corners[face[k]][~np.isnan(corners[face[k]])].astype(int) - 1]
        before, after = ring - queries[k], np.roll(ring, -1, axis=0) - queries[k]
        assert (before[:, 0] * after[:, 1] >= before[:, 1] * after[:, 0]).all()


def test_points_fields_and_times(random: np.random.Generator) -> None:
    ds = ugrid(random)
    access = ds.meshwalk
    one = access.sample([[4.0, 51.0]], "sea_surface_height_above_geoid", time="2026-01-01T02")
    assert list(one.data_vars) == ["zeta"]
    assert one.zeta.shape == (1, 1) or one.zeta.shape == (1,)
    few = access.sample([[4, 51]], ["zeta", "h"], time=slice("2026-01-01T01", "2026-01-01T03"))
    np.testing.assert_array_equal(few.time, ds.time[1:4])
    ships = xarray.Dataset(
        {"lon": ("ship", [3.5, 4.0, 9.0]), "lat": ("ship", [51.0, 51.0, 51.0])},
        coords={"ship": ["a", "b", "c"]},
    )
    out = access.sample((ships.lon, ships.lat), "zeta")
    assert out.zeta.dims == ("time", "ship")
    assert out.ship.to_numpy().tolist() == ["a", "b", "c"]
    assert np.isnan(out.zeta.sel(ship="c")).all()
    grid = access.sample((xarray.DataArray([3.5, 4.0], dims="column"),
                          xarray.DataArray([51.0, 51.1, 51.2], dims="row")), "h")  # fmt: skip
    assert grid.h.dims == ("column", "row")
    assert float(grid.h[1, 0]) == float(access.sample([[4, 51]], "h").h[0])
    with pytest.raises(KeyError, match="no variable has the name"):
        access.sample([[4, 51]], "salt")
    with pytest.raises(ValueError, match="neither vertices nor faces"):
        access.sample([[4, 51]], "time")
    with pytest.raises(ValueError, match="shape"):
        access.sample([4, 51, 3])
    with pytest.raises(meshwalk.InputError, match="no mesh in this dataset"):
        xarray.Dataset({"a": ("x", [1.0])}).meshwalk.sample([[0, 0]])


def test_dask_stays_lazy_and_files_come_by_blocks(
    random: np.random.Generator, queries: NDArray[Any], monkeypatch: pytest.MonkeyPatch
) -> None:
    ds = ugrid(random)
    wanted = ds.meshwalk.sample(queries)
    lazy = ds.chunk({"time": 2, "node": 30}).meshwalk.sample(queries)
    assert lazy.zeta.chunks is not None
    assert lazy.zeta.chunks[0] == (2, 2, 1)
    xarray.testing.assert_identical(lazy.compute(), wanted)
    monkeypatch.setattr(meshwalk.xarray, "_BLOCK_BYTES", 700)
    blocks: list[int] = []
    whole = meshwalk.Locations.interpolate

    def watched(self: Any, values: Any, *rest: Any) -> Any:
        blocks.append(values.nbytes)
        return whole(self, values, *rest)

    monkeypatch.setattr(meshwalk.Locations, "interpolate", watched)
    xarray.testing.assert_identical(ds.meshwalk.sample(queries), wanted)
    assert max(blocks[:-1]) <= 700
    assert len(blocks) > 3


def test_answers_are_those_of_the_program(
    random: np.random.Generator, queries: NDArray[Any], tmp_path: Path, program: str
) -> None:
    ds = ugrid(random)
    ds.to_netcdf(tmp_path / "bay.nc")
    np.savetxt(tmp_path / "q.csv", queries, delimiter=",", header="lon,lat", comments="")
    command = [program, "sample", "bay.nc", "q.csv", "--field", "zeta", "--time", "all"]
    ran = subprocess.run(command, cwd=tmp_path, check=True, capture_output=True, text=True)
    lines = [line.split(",") for line in ran.stdout.splitlines()]
    columns = [k for k, name in enumerate(lines[0]) if name.startswith("zeta")]
    values = np.array([float(row[columns[0]] or "nan") for row in lines[1:]])
    ours = ds.meshwalk.sample(queries, "zeta").zeta.to_numpy()
    if len(columns) == 5:
        table = np.array([[float(row[c] or "nan") for c in columns] for row in lines[1:]])
        np.testing.assert_allclose(ours.T, table, rtol=1e-6)
    else:
        by_time = sorted(values[~np.isnan(values)])
        np.testing.assert_allclose(sorted(ours[~np.isnan(ours)]), by_time, rtol=1e-6)


def eight_facets() -> xarray.Dataset:
    """Eight facets of the sphere, which overlap in the plane."""
    lon, lat = [0.0, 90, 180, 270, 0, 0], [0.0, 0, 0, 0, 90, -90]
    faces = [[k, (k + 1) % 4, 4] for k in range(4)] + [[(k + 1) % 4, k, 5] for k in range(4)]
    about = {"lon": "degrees_east", "lat": "degrees_north"}
    topology = {
        "cf_role": "mesh_topology",
        "topology_dimension": 2,
        "node_coordinates": "lon lat",
        "face_node_connectivity": "corners",
    }
    return xarray.Dataset(
        {
            "mesh": ((), np.int32(0), topology),
            "corners": (("cell", "three"), np.array(faces, np.int32)),
            "t": ("node", [1.0, 1, 1, 1, 5, 5]),
            "of_cells": ("cell", np.arange(8.0)),
        },
        coords={
            name: ("node", values, {"units": about[name], "standard_name": NODES[name][1]})
            for name, values in (("lon", lon), ("lat", lat))
        },
    )


def test_globe() -> None:
    ds = eight_facets()
    out = ds.meshwalk.sample([[300, 45], [-60, -45], [10, 90]])
    assert out.face.to_numpy().tolist() == [3, 7, 0]
    assert float(out.t[2]) == 5


def test_an_ocean_across_180_degrees() -> None:
    """Two facets are land: what is in the others is as on the whole globe."""
    ds = eight_facets()
    ocean = ds.isel(cell=[1, 2, 3, 5, 6, 7])
    random = np.random.default_rng(4)
    points = np.column_stack([random.uniform(-180, 180, 500), random.uniform(-90, 90, 500)])
    whole, part = (d.meshwalk.sample(points) for d in (ds, ocean))
    kept = np.array([-1, 0, 1, 2, -1, 3, 4, 5])[whole.face.to_numpy()]
    assert set(kept) == {-1, 0, 1, 2, 3, 4, 5}
    np.testing.assert_array_equal(part.face, kept)
    np.testing.assert_array_equal(np.isnan(part.t), kept < 0)
    np.testing.assert_allclose(part.t[kept >= 0], whole.t[kept >= 0], rtol=1e-14)
    np.testing.assert_array_equal(part.of_cells[kept >= 0], whole.of_cells[kept >= 0])
    shared = ocean.meshwalk.sample([[180, 0], [45, 45], [0, 90]])
    assert shared.face.to_numpy().tolist() == [0, -1, 0]
    overlapping = ocean.assign_coords(lon=("node", [0.0, 60, 120, 170, 0, 0], ocean.lon.attrs))
    with pytest.raises(meshwalk.InputError, match="in the plane of longitudes"):
        overlapping.meshwalk.sample(points)


def test_the_page(data: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    page = data.parent / "docs/drop-ins/xarray.md"
    monkeypatch.chdir(tmp_path)
    run_page(page)
