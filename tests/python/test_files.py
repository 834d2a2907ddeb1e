"""Files: what is written is read, and faulty ones are told with their place."""

from __future__ import annotations

import gzip
import pickle
import sys
from pathlib import Path

import numpy as np
import pytest
from conftest import ring_arrays

import meshwalk


@pytest.mark.parametrize("ending", ["off", "ply", "obj", "node"])
def test_round_trip(tmp_path: Path, ending: str, random: np.random.Generator) -> None:
    _, triangles = ring_arrays()
    mesh = meshwalk.Mesh(random.uniform(size=(8, 2)), triangles, {"z": random.uniform(size=8)})
    path = tmp_path / f"mesh.{ending}"
    mesh.write(path)
    again = meshwalk.read(path)
    np.testing.assert_array_equal(again.points, mesh.points)
    np.testing.assert_array_equal(again.triangles, mesh.triangles)
    np.testing.assert_array_equal(again.fields["z"], mesh.fields["z"])


def test_fields_and_formats(tmp_path: Path) -> None:
    mesh = meshwalk.Mesh(*ring_arrays(), {"z": np.arange(8), "depth": np.arange(8) / 3})
    for number, name in enumerate(meshwalk.mesh_formats):
        meshwalk.write(tmp_path / f"{number}.{name}", mesh, name)
    again = meshwalk.read(str(tmp_path / "2.ply-ascii"))
    assert list(again.fields) == ["z", "depth"]
    np.testing.assert_array_equal(again.fields["depth"], mesh.fields["depth"])
    with pytest.raises(ValueError, match="xyz"):
        mesh.write(tmp_path / "mesh.xyz")


@pytest.mark.parametrize("ending", ["vtk", "vtu", "nc"])
def test_values_of_triangles(tmp_path: Path, ending: str) -> None:
    depth = np.arange(8) / 3
    mesh = meshwalk.Mesh(*ring_arrays(), triangle_fields={"depth": depth})
    path = tmp_path / f"mesh.{ending}"
    try:
        mesh.write(path)
    except OSError as error:
        if "libnetcdf" not in str(error):
            raise
        pytest.skip("libnetcdf is not found")
    again = meshwalk.read(path)
    assert list(again.triangle_fields) == ["depth"]
    np.testing.assert_array_equal(again.triangle_fields["depth"], depth)
    assert repr(again).endswith("of triangles: depth>")


def test_without_heights_and_gzipped(tmp_path: Path) -> None:
    path = tmp_path / "mesh.off"
    meshwalk.Mesh(*ring_arrays()).write(path)
    (tmp_path / "mesh.off.gz").write_bytes(gzip.compress(path.read_bytes()))
    assert len(meshwalk.read(tmp_path / "mesh.off.gz")) == 8


def test_netcdf(tmp_path: Path) -> None:
    path = tmp_path / "mesh.nc"
    mesh = meshwalk.Mesh(*ring_arrays(), crs="EPSG:2056")
    try:
        mesh.write(path)
    except OSError as error:
        if "libnetcdf" not in str(error):
            raise
        pytest.skip("libnetcdf is not found")
    again = meshwalk.read(path, layout="ugrid")
    assert not (tmp_path / "mesh.prj").exists()
    assert again.crs == "EPSG:2056"
    assert again.triangles.tolist() == mesh.triangles.tolist()
    with pytest.raises(meshwalk.InputError, match="no mesh in the layout fvcom"):
        meshwalk.read(path, layout="fvcom")
    with pytest.raises(ValueError, match="no layout 'ugrit'"):
        meshwalk.read(path, layout="ugrit")


@pytest.mark.parametrize("ending", ["ply", "off", "node", "vtk"])
def test_coordinate_systems(tmp_path: Path, ending: str) -> None:
    mesh = meshwalk.Mesh(*ring_arrays(), crs="EPSG:2056")
    path = tmp_path / f"mesh.{ending}"
    mesh.write(path)
    assert (tmp_path / "mesh.prj").exists() == (ending != "ply")
    assert sorted(p.suffix for p in tmp_path.iterdir() if p.name.startswith(".")) == []
    again = meshwalk.read(path)
    assert again.crs == "EPSG:2056"
    again.crs = 'GEOGCS["a",  \n DATUM["b"]]'
    again.write(path)
    assert meshwalk.read(path).crs == 'GEOGCS["a", DATUM["b"]]'
    assert pickle.loads(pickle.dumps(again)).crs == again.crs


def test_coordinate_systems_that_clash(tmp_path: Path) -> None:
    mesh = meshwalk.Mesh(*ring_arrays())
    assert mesh.crs is None
    (tmp_path / "mesh.prj").write_text("EPSG:21781\n")
    with pytest.warns(UserWarning, match=r"mesh\.prj says EPSG:21781, and the mesh's own"):
        mesh.write(tmp_path / "mesh.off")
    (tmp_path / "mesh.off").unlink()
    mesh.crs = "EPSG:2056"
    with pytest.raises(FileExistsError, match=r"mesh\.prj, which is there already, says EPSG:217"):
        mesh.write(tmp_path / "mesh.off")
    assert not (tmp_path / "mesh.off").exists()
    mesh.crs = "EPSG:21781"
    mesh.write(tmp_path / "mesh.off")
    assert meshwalk.read(tmp_path / "mesh.off").crs == "EPSG:21781"
    for crs in ("", " ", "a\0b"):
        with pytest.raises(ValueError, match="WKT or a code"):
            mesh.crs = crs
    with pytest.raises(TypeError, match="not int"):
        meshwalk.Mesh(*ring_arrays(), crs=2056)  # type: ignore[arg-type]


def test_faulty_files(tmp_path: Path) -> None:
    with pytest.raises(FileNotFoundError, match=r"none\.off"):
        meshwalk.read(tmp_path / "none.off")
    path = tmp_path / "mesh.off"
    path.write_text("OFF\n3 1 0\n0 0 0\n1 0 zero\n0 1 0\n3 0 1 2\n")
    with pytest.raises(meshwalk.InputError, match=r"mesh\.off:4:") as raised:
        meshwalk.read(path)
    assert raised.value.line == 4
    path.write_text("OFF\n3 1 0\n0 0 0\n1 0 nan\n0 nan 0\n3 0 1 2\n")
    with pytest.raises(meshwalk.InputError) as raised:
        meshwalk.read(path)
    assert raised.value.vertex == 2
    with pytest.raises(OSError, match="no such folder"):
        meshwalk.Mesh(*ring_arrays()).write(tmp_path / "no such folder" / "mesh.off")
    with pytest.raises(ValueError, match="null"):
        meshwalk.read("mesh\0.off")
    with pytest.raises(TypeError):
        meshwalk.read(3)  # type: ignore[arg-type]


def test_names_that_are_no_text(tmp_path: Path) -> None:
    path = tmp_path / "m\udce9sh.off"
    meshwalk.Mesh(*ring_arrays()).write(path)
    assert len(meshwalk.read(path)) == 8
    with pytest.raises(OSError, match=r"n\\xe9none\.off"):
        meshwalk.read(tmp_path / "n\udce9none.off")


def test_points(tmp_path: Path, random: np.random.Generator) -> None:
    path = tmp_path / "points.csv"
    table = random.uniform(size=(70_000, 3))
    np.savetxt(path, table, "%.17g", ",", header="z,x,y", comments="")
    points, names = meshwalk.read_points(path)
    assert names == ["x", "y", "z"]
    np.testing.assert_array_equal(points, table[:, [1, 2, 0]])
    points, names = meshwalk.read_points(path, "z,2")
    assert names == ["z", "x"]
    np.testing.assert_array_equal(points, table[:, :2])
    path.write_text("x,y\n")
    assert meshwalk.read_points(path)[0].shape == (0, 2)
    path.write_text("x,y\n1,2\n3,four\n")
    with pytest.raises(meshwalk.InputError, match=r"points\.csv:3:") as raised:
        meshwalk.read_points(path)
    assert raised.value.line == 3
    with pytest.raises(FileNotFoundError):
        meshwalk.read_points(tmp_path / "none.csv")
    with pytest.raises((ValueError, meshwalk.InputError), match="height"):
        meshwalk.read_points(path, "x,height")
    with pytest.raises(ValueError, match="no class 256"):
        meshwalk.read_points(path, classes=[2, 256])


def test_laz_needs_laspy(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "laspy", None)
    with pytest.raises(ImportError, match=r"laspy\[lazrs\]"):
        meshwalk.read_points(tmp_path / "points.laz")


def test_constraints(tmp_path: Path) -> None:
    path = tmp_path / "lake.geojson"
    path.write_text(
        """{"type": "FeatureCollection", "features": [
        {"type": "Feature", "properties": {}, "geometry": {"type": "Polygon", "coordinates": [
            [[0, 0, 5], [6, 0], [6, 6], [0, 6], [0, 0]], [[2, 2], [4, 2], [4, 4], [2, 2]]]}},
        {"type": "Feature", "properties": {}, "geometry": {"type": "LineString",
            "coordinates": [[1, 1], [1, 5]]}},
        {"type": "Feature", "properties": {}, "geometry": {"type": "Polygon",
            "coordinates": [[[1, 1], [2, 1], [1, 1]]]}}]}"""
    )
    with pytest.warns(meshwalk.SkippedRingWarning, match=r"1 rings .* of feature 2"):
        given = meshwalk.read_constraints(path)
    assert given.points.shape == (9, 3)
    assert (given.points[0, 2], np.isnan(given.points[1, 2])) == (5, True)
    assert given.polygons.tolist() == [0] * 7 + [-1]
    assert (given.record, given.records.tolist()) == ("feature", [0] * 7 + [1])
    mesh = meshwalk.constrained_delaunay(*given[:4])
    assert mesh.describe().area == 36 - 2
    assert not meshwalk.Locator(mesh).locate_one(3.5, 2.5).inside


def test_constraints_of_triangle(tmp_path: Path) -> None:
    path = tmp_path / "ring.poly"
    square = "1 0 0 7\n2 6 0 7\n3 6 6 7\n4 0 6 7\n5 2 2 8\n6 4 2 8\n7 3 4 8\n"
    lines = "1 1 2\n2 2 3\n3 3 4\n4 4 1\n5 5 6\n6 6 7\n7 7 5\n"
    path.write_text(f"7 2 1 0\n{square}7 0\n{lines}1\n1 3 3\n")
    given = meshwalk.read_constraints(path)
    assert given.points.shape == (7, 2)
    assert given.holes.tolist() == [[3, 3]]
    assert (given.polygons == -1).all()
    assert given.record == "line"
    assert [values.tolist() for values in given.fields.values()] == [[7] * 4 + [8] * 3]
    assert meshwalk.constrained_delaunay(*given[:4]).describe().area == 36 - 2
    with pytest.raises(FileNotFoundError):
        meshwalk.read_constraints(tmp_path / "none.poly")
    path.write_text("7 2 1 0\n1 0 0 7\n")
    with pytest.raises(meshwalk.InputError, match="ring"):
        meshwalk.read_constraints(path)
