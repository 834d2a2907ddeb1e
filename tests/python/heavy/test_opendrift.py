"""The reader for OpenDrift: values of the true triangle, and elements that drift by them."""

from __future__ import annotations

import os
from datetime import datetime, timedelta
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest
import xarray
from conftest import NOT_HERE, oracle, run_page

import meshwalk

opendrift = pytest.importorskip("opendrift", reason=f"opendrift {NOT_HERE}")
from meshwalk.opendrift import Reader  # noqa: E402

if TYPE_CHECKING:
    from numpy.typing import NDArray

START = datetime(2026, 1, 1)


def bay(random: np.random.Generator) -> tuple[xarray.Dataset, meshwalk.Mesh]:
    """A mesh with a bay that is not in it; currents at vertices, wind on faces."""
    points = np.column_stack([4 + random.random(150), 60 + random.random(150)])
    mesh = meshwalk.delaunay(points)
    middle = points[mesh.triangles].mean(axis=1)
    kept = mesh.triangles[~((middle[:, 0] > 4.4) & (np.abs(middle[:, 1] - 60.5) < 0.2))]
    lon, lat = points.T
    topology = {
        "cf_role": "mesh_topology",
        "topology_dimension": 2,
        "node_coordinates": "lon lat",
        "face_node_connectivity": "corners",
    }
    hours = np.arange(3.0)[:, None]
    names = {"u": "eastward_sea_water_velocity", "v": "northward_sea_water_velocity"}
    ds = xarray.Dataset(
        {
            "mesh": ((), np.int32(0), topology),
            "corners": (("face", "three"), kept.astype(np.int32)),
            "u": (("time", "node"), (lon - 4) + 0.1 * hours, {"standard_name": names["u"]}),
            "v": (("time", "node"), 0 * lat + 0.2 + 0 * hours, {"standard_name": names["v"]}),
            "w": (
                ("time", "face"),
                np.arange(float(len(kept))) + 0 * hours,
                {"standard_name": "x_wind"},
            ),
        },
        coords={
            "lon": ("node", lon, {"units": "degrees_east", "standard_name": "longitude"}),
            "lat": ("node", lat, {"units": "degrees_north", "standard_name": "latitude"}),
            "time": np.datetime64(START, "ns") + np.arange(3) * np.timedelta64(1, "h"),
        },
    )
    return ds, meshwalk.Mesh(points, kept)


def inner(mesh: meshwalk.Mesh, random: np.random.Generator) -> NDArray[Any]:
    return np.asarray(mesh.points[mesh.triangles[:40]].mean(axis=1) + 1e-4 * random.random((40, 2)))


def test_values_are_those_of_the_true_triangle(random: np.random.Generator) -> None:
    ds, mesh = bay(random)
    reader = Reader(ds)
    assert set(reader.variables) >= {"x_sea_water_velocity", "y_sea_water_velocity", "x_wind"}
    assert (reader.start_time, reader.time_step) == (START, timedelta(hours=1))
    anywhere = random.random((60, 2)) + np.array([4, 60])
    points = np.concatenate([inner(mesh, random), anywhere])
    truth = np.array([oracle(mesh, p) for p in points])
    assert (truth < 0).sum() > 3
    np.testing.assert_array_equal(reader.covers_positions(*points.T), truth >= 0)
    asked = ["x_sea_water_velocity", "x_wind"]
    x, y = points.T
    found = reader.get_variables(asked, START + timedelta(minutes=90), x=x, y=y, z=np.zeros(100))
    inside = truth >= 0
    np.testing.assert_array_equal(np.ma.getmaskarray(found["x_wind"]), ~inside)
    np.testing.assert_array_equal(found["x_wind"][inside], truth[inside])
    np.testing.assert_allclose(
        found["x_sea_water_velocity"][inside], points[inside, 0] - 4 + 0.15, atol=1e-12
    )


def test_where_the_original_is_wrong(random: np.random.Generator) -> None:
    """OpenDrift takes the nearest node or centre, and covers the convex hull."""
    from opendrift.readers.basereader.unstructured import UnstructuredReader

    ds, mesh = bay(random)
    reader = Reader(ds)
    points = np.column_stack([4 + random.random(400), 60 + random.random(400)])
    truth = np.array([oracle(mesh, p) for p in points])
    centres = mesh.points[mesh.triangles].mean(axis=1)
    reader.faces_idx = reader._build_ckdtree_(*centres.T)
    nearest = UnstructuredReader._nearest_face_(reader, *points.T)
    inside = truth >= 0
    wrong = (nearest != truth)[inside].mean()
    assert wrong > 0.1, "OpenDrift finds the triangle now: the page says otherwise"
    reader.boundary = reader._build_boundary_polygon_(reader.x, reader.y)
    covered = UnstructuredReader.covers_positions(reader, *points.T)
    assert (covered & ~inside).sum() > 20


def test_elements_drift(random: np.random.Generator) -> None:
    from opendrift.models.oceandrift import OceanDrift

    ds, mesh = bay(random)
    ds["u"] = ds.u * 0 + 0.1
    ds["u"].attrs["standard_name"] = "eastward_sea_water_velocity"
    model = OceanDrift(loglevel=50)
    model.set_config("general:use_auto_landmask", False)
    for name in ("land_binary_mask", "x_wind", "y_wind"):
        model.set_config(f"environment:constant:{name}", 0)
    model.add_reader(Reader(ds))
    lon, lat = inner(mesh, random)[:20].T
    model.seed_elements(lon=lon, lat=lat, time=START)
    model.run(duration=timedelta(hours=1), time_step=600)
    moved = (model.elements.lat - lat[model.elements.ID]) * 111_200
    np.testing.assert_allclose(moved, 0.2 * 3600, rtol=0.01)


def layered(random: np.random.Generator) -> tuple[xarray.Dataset, meshwalk.Mesh]:
    """As FVCOM writes it: sigma layers that differ from vertex to vertex."""
    ds, mesh = bay(random)
    n, faces = mesh.vertex_count, mesh.triangle_count
    sigma = -np.sort(random.random((4, n)), axis=0)
    terms = {
        "standard_name": "ocean_sigma/general_coordinate",
        "positive": "up",
        "formula_terms": "sigma: siglay eta: zeta depth: bottom",
    }
    ds["siglay"] = ("siglay", "node"), sigma, terms
    ds["bottom"] = ("node",), 10 + 20 * random.random(n), {"standard_name": "depth_of_sea"}
    for name, along, size in (("heat", "node", n), ("upward", "face", faces)):
        values = random.random((3, 4, size))
        ds[name] = ("time", "siglay", along), values, {"standard_name": f"sea_water_{name}"}
    return ds, mesh


def test_values_between_sigma_layers(random: np.random.Generator) -> None:
    ds, mesh = layered(random)
    reader = Reader(ds)
    points = inner(mesh, random)
    z = -35 * random.random(40)
    when = START + timedelta(minutes=60)
    names = ["sea_water_heat", "sea_water_upward"]
    found = reader.get_variables(names, when, x=points[:, 0], y=points[:, 1], z=z)
    heights = ds.siglay.to_numpy() * 1.0
    for i, point in enumerate(points):
        face = oracle(mesh, point)
        corners = mesh.triangles[face]
        weights = np.linalg.solve(np.vstack([mesh.points[corners].T, np.ones(3)]), [*point, 1])
        at = (heights[:, corners] @ weights) * (ds.bottom.to_numpy()[corners] @ weights)
        for name, layers in (
            ("sea_water_heat", ds.heat.to_numpy()[1][:, corners] @ weights),
            ("sea_water_upward", ds.upward.to_numpy()[1][:, face]),
        ):
            wanted = np.interp(z[i], at[::-1], layers[::-1])
            np.testing.assert_allclose(found[name][i], wanted, rtol=1e-9)
    assert "ocean_sigma/general_coordinate" not in reader.variables
    surface = reader.get_variables(names[:1], when, x=points[:, 0], y=points[:, 1])
    top = meshwalk.Locator(mesh).locate(points).interpolate(ds.heat.to_numpy()[1, 0])
    np.testing.assert_allclose(surface["sea_water_heat"], top)


def test_layers_at_depths_and_of_schism(random: np.random.Generator) -> None:
    ds, mesh = layered(random)
    points = inner(mesh, random)[:10]
    x, y = points.T
    face = np.array([oracle(mesh, p) for p in points])
    plain = ds.drop_vars(["siglay", "heat"]).assign_coords(
        siglay=("siglay", [0.0, 5, 10, 20], {"units": "m", "positive": "down"})
    )
    found = Reader(plain).get_variables(["sea_water_upward"], START, x=x, y=y, z=np.full(10, -7.5))
    values = ds.upward.to_numpy()[0][:, face]
    np.testing.assert_allclose(found["sea_water_upward"], values[1:3].mean(axis=0))
    # SCHISM's layers are those above the bottom; they move with the water.
    heights = np.broadcast_to(np.array([np.nan, -30, -10, 0]), (3, mesh.vertex_count, 4))
    moving = heights + np.arange(3.0)[:, None, None]
    schism = ds.drop_vars(["siglay", "heat"])
    schism["zcor"] = ("time", "node", "siglay"), moving
    later = START + timedelta(hours=2)
    found = Reader(schism).get_variables(["sea_water_upward"], later, x=x, y=y, z=np.full(10, -18))
    values = ds.upward.to_numpy()[2][:, face]
    np.testing.assert_allclose(found["sea_water_upward"], values[1:3].mean(axis=0))


def test_layers_that_are_not_known_are_named(random: np.random.Generator) -> None:
    ds, _ = layered(random)
    ds = ds.drop_vars("siglay")
    with pytest.warns(UserWarning, match=r"heat \(along siglay\); upward \(along siglay\)"):
        reader = Reader(ds)
    assert "sea_water_heat" not in reader.variables
    assert "sea_water_heat" in Reader(ds.isel(siglay=0)).variables


def test_a_real_model() -> None:
    """OpenDrift's example of FVCOM, with a real file: elements follow the tide."""
    from opendrift.models.oceandrift import OceanDrift

    path = Path(os.environ["MW_SOURCE"]).parent / "shared/data/ocean/fvcom_example.nc"
    if not path.exists():
        pytest.skip("shared/data is not here")
    reader = Reader(path)
    assert {"x_sea_water_velocity", "sea_water_salinity", "x_wind"} <= set(reader.variables)
    model = OceanDrift(loglevel=50)
    model.set_config("general:use_auto_landmask", False)
    model.set_config("environment:constant:land_binary_mask", 0)
    model.add_reader(reader)
    model.seed_elements(lon=-122.485, lat=37.878, radius=300, number=50, time=reader.start_time)
    start = model.elements_scheduled.lon.copy(), model.elements_scheduled.lat.copy()
    model.run(duration=timedelta(hours=1), time_step=600)
    moved = np.hypot(model.elements.lon - start[0], model.elements.lat - start[1]) * 100_000
    assert np.median(moved) > 100


def test_refusals(random: np.random.Generator, tmp_path: Path) -> None:
    ds, _ = bay(random)
    plain = ds.copy(deep=True).rename(lon="x", lat="y")
    plain.mesh.attrs["node_coordinates"] = "x y"
    for name in ("x", "y"):
        plain[name].attrs.clear()
    with pytest.raises(ValueError, match="no projection"):
        Reader(plain)
    with pytest.raises(ValueError, match="standard name"):
        Reader(ds.drop_vars(["u", "v", "w"]))
    ds.to_netcdf(tmp_path / "bay.nc")
    reader = Reader(tmp_path / "bay.nc")
    assert reader.name.endswith("bay.nc")
    reader.dataset.close()


def test_the_page(data: Path) -> None:
    run_page(data.parent / "docs/drop-ins/opendrift.md")
