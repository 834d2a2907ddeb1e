"""`meshwalk.pyvista` and `meshwalk.meshio`: round trips, cut cells, and cells found exactly."""

from __future__ import annotations

import warnings
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest
from conftest import NOT_HERE, PAGES, run_page

import meshwalk

if TYPE_CHECKING:
    from pathlib import Path

    from numpy.typing import NDArray

pyvista = pytest.importorskip("pyvista", reason=f"pyvista {NOT_HERE}")
meshio = pytest.importorskip("meshio", reason=f"meshio {NOT_HERE}")
meshlane = pytest.importorskip("meshlane", reason=f"meshlane {NOT_HERE}")

import meshwalk.meshio  # noqa: E402
import meshwalk.pyvista  # noqa: E402

Finder = meshwalk.pyvista.Finder


@pytest.fixture
def terrain(scattered: meshwalk.Mesh, random: np.random.Generator) -> meshwalk.Mesh:
    count, cells = len(scattered.points), len(scattered)
    return meshwalk.Mesh(
        scattered.points,
        scattered.triangles,
        {
            "z": random.random(count),
            "flow[0]": random.random(count),
            "flow[1]": random.random(count),
            "a[1]": random.random(count),
        },
        triangle_fields={"soil": random.integers(0, 9, cells)},
        crs="EPSG:2056",
    )


def same(a: meshwalk.Mesh, b: meshwalk.Mesh) -> None:
    np.testing.assert_array_equal(a.points, b.points)
    np.testing.assert_array_equal(a.triangles, b.triangles)
    for ours, theirs in ((a.fields, b.fields), (a.triangle_fields, b.triangle_fields)):
        assert set(ours) == set(theirs)
        for name in ours:
            np.testing.assert_array_equal(ours[name], theirs[name])


def test_meshes_there_and_back(terrain: meshwalk.Mesh, tmp_path: Path) -> None:
    shown = meshwalk.pyvista.polydata(terrain)
    assert shown.points[:, 2].tolist() == terrain.fields["z"].tolist()
    assert shown.point_data["flow"].shape == (len(terrain.points), 2)
    assert set(shown.point_data.keys()) == {"z", "flow", "a[1]"}
    del shown.point_data["z"]  # the points have it
    again = meshwalk.pyvista.mesh(shown)
    same(again, terrain)
    assert again.crs == terrain.crs
    shown.save(tmp_path / "terrain.vtk")
    same(meshwalk.pyvista.mesh(pyvista.read(tmp_path / "terrain.vtk")), terrain)
    for library in (meshio, meshlane):
        cells = meshwalk.meshio.cells(terrain, library.__name__)
        assert isinstance(cells, library.Mesh)
        assert cells.points.shape[1] == 3
        del cells.point_data["z"]
        again = meshwalk.meshio.mesh(cells, crs="EPSG:2056")
        same(again, terrain)
        assert again.crs == "EPSG:2056"
        path = str(tmp_path / f"{library.__name__}.vtu")
        cells.write(path)
        back = meshwalk.meshio.mesh(library.read(path))
        np.testing.assert_array_equal(back.fields["z"], terrain.fields["z"])
        np.testing.assert_array_equal(back.triangle_fields["soil"], terrain.triangle_fields["soil"])
    with pytest.raises(ValueError, match="meshio"):
        meshwalk.meshio.cells(terrain, "gmsh")  # type: ignore[arg-type]


def test_flat_meshes_and_surfaces(square: meshwalk.Mesh) -> None:
    cells = meshwalk.meshio.cells(square)
    assert cells.points.shape == (4, 2)
    same(meshwalk.meshio.mesh(cells), square)
    same(meshwalk.pyvista.mesh(meshwalk.pyvista.polydata(square)), square)
    ball = pyvista.Sphere()
    surface, cell = meshwalk.pyvista.surface(ball)
    assert surface.describe().closed
    np.testing.assert_array_equal(cell, np.arange(ball.n_cells))
    np.testing.assert_array_equal(surface.points, ball.points)
    assert set(surface.fields) == {"Normals[0]", "Normals[1]", "Normals[2]"}
    back = meshwalk.pyvista.polydata(surface)
    np.testing.assert_array_equal(back.regular_faces, ball.regular_faces)
    np.testing.assert_array_equal(back.point_data["Normals"], ball.point_data["Normals"])
    other, _ = meshwalk.meshio.surface(meshwalk.meshio.cells(surface))
    np.testing.assert_array_equal(other.triangles, surface.triangles)


def test_larger_cells_are_cut() -> None:
    """A triangle, an arrowhead that only one diagonal cuts, and a star-shaped pentagon."""
    points = [[0, 0], [4, 0], [4, 4], [0, 4], [1, 5], [3, 7], [4, 9], [0, 9], [-4, 0], [-1, 1]]
    faces = [[0, 1, 2], [0, 3, 8, 9], [3, 2, 6, 7, 4]]
    blocks = [("triangle", [faces[0]]), ("line", [[0, 1]]), ("quad", [faces[1]])]
    blocks.append(("polygon", [faces[2]]))
    data = {"soil": [[10.0], [20.0], [30.0], [40.0]], "name": [["a"], ["b"], ["c"], ["d"]]}
    given = meshio.Mesh(points, blocks, cell_data=data, point_sets={"some": [1, 2]})
    with pytest.warns(UserWarning, match="left out") as told:
        mesh = meshwalk.meshio.mesh(given)
    said = "; ".join(str(warning.message) for warning in told)
    assert all(word in said for word in ("1 points and lines", "point_sets: some", "name"))
    assert mesh.triangle_fields["cell"].tolist() == [0, 2, 2, 3, 3, 3]
    assert mesh.triangle_fields["soil"].tolist() == [10, 30, 30, 40, 40, 40]
    assert mesh.check().valid
    shown = pyvista.PolyData.from_irregular_faces(np.insert(points, 2, 0.0, axis=1) * 1.0, faces)
    assert mesh.describe().area == pytest.approx(_area(points, faces))
    flat = meshwalk.pyvista.mesh(shown)
    assert flat.triangle_fields["cell"].tolist() == [0, 1, 1, 2, 2, 2]
    assert flat.describe().area == pytest.approx(_area(points, faces))
    shown.cell_data["cell"] = [1, 2, 3]
    with pytest.raises(ValueError, match="rename it"):
        meshwalk.pyvista.mesh(shown)


def _area(points: Any, faces: Any) -> float:
    total = 0.0
    for face in faces:
        x, y = np.array([points[v] for v in face], float).T
        total += abs(np.dot(x, np.roll(y, -1)) - np.dot(y, np.roll(x, -1))) / 2
    return total


def test_what_is_refused_and_left_out() -> None:
    ball = pyvista.Sphere()
    with pytest.raises(ValueError, match="cell 0 is of type TETRA"):
        meshwalk.pyvista.mesh(ball.delaunay_3d())
    with pytest.raises(ValueError, match="cell 1 is of type tetra"):
        meshwalk.meshio.mesh(
            meshio.Mesh(np.eye(4)[:, :3], [("triangle", [[0, 1, 2]]), ("tetra", [[0, 1, 2, 3]])])
        )
    with pytest.raises(TypeError, match="pyvista"):
        meshwalk.pyvista.surface([1, 2])
    comb = [[0, 0], [6, 0], [6, 3], [5, 1], [4, 3], [3, 1], [2, 3], [1, 1], [0, 3]]
    with pytest.raises(ValueError, match="cell 0 cannot be cut"):
        meshwalk.meshio.mesh(meshio.Mesh(comb, [("polygon", [list(range(9))])]))
    triangle = pyvista.Triangle([[0.0, 0, 0], [1, 0, 0], [0, 1, 0]])
    triangle.point_data["name"] = ["a", "b", "c"]
    triangle.cell_data["large"] = [2**60 + 1]
    triangle.field_data["title"] = ["x"]
    with pytest.warns(UserWarning, match="left out") as told:
        mesh = meshwalk.pyvista.mesh(triangle)
    said = "; ".join(str(warning.message) for warning in told)
    assert all(word in said for word in ("name", "large", "title"))
    assert not mesh.fields
    assert not mesh.triangle_fields
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        grid = meshwalk.pyvista.mesh(pyvista.ImageData(dimensions=(3, 4, 1)))
    assert grid.triangle_fields["cell"].tolist() == sorted([0, 1, 2, 3, 4, 5] * 2)
    assert grid.describe().area == 6


# --- finding --------------------------------------------------------------------------------------


def holds(dataset: Any, cell: int, point: NDArray[Any]) -> bool:
    """Whether a triangle contains a point, by a mesh of it alone."""
    corners = dataset.points[dataset.regular_faces[cell], :2]
    alone = meshwalk.Locator(meshwalk.Mesh(corners, [[0, 1, 2]]))
    return bool(alone.locate(point[:2]).inside)


def test_containing_cells_are_exact(random: np.random.Generator) -> None:
    mesh = meshwalk.delaunay(random.random((300, 2)))
    dataset = meshwalk.pyvista.polydata(mesh)
    corners = mesh.points[mesh.triangles]
    middles = ((corners + np.roll(corners, 1, axis=1)) / 2).reshape(-1, 2)
    points = np.column_stack([middles, np.zeros(len(middles))])
    ours = Finder(dataset).find_containing_cell(points)
    theirs = dataset.find_containing_cell(points)
    np.testing.assert_array_equal(ours, meshwalk.Locator(mesh).locate(middles).triangle)
    wrong = [t >= 0 and not holds(dataset, t, p) for t, p in zip(theirs, points, strict=True)]
    assert sum(wrong) > 50, "VTK has them right now: the page says otherwise"
    inside = np.column_stack([random.random((2000, 2)), np.zeros(2000)])
    np.testing.assert_array_equal(
        Finder(dataset).find_containing_cell(inside), dataset.find_containing_cell(inside)
    )


def test_containing_cells_of_quads_and_planes() -> None:
    plane = pyvista.Plane(i_resolution=4, j_resolution=4)
    plane.translate([0, 0, 7], inplace=True)
    finder = Finder(plane)
    cell = finder.find_containing_cell([0.3, 0.3, 7.0])
    assert isinstance(cell, int)
    assert cell == plane.find_containing_cell([0.3, 0.3, 7.0])
    points: Any = [[0.3, 0.3, 7], [0.3, 0.3, 7.1], [np.nan, 0, 7], [3, 3, 7], [0, 0, 7]]
    assert finder.find_containing_cell(points).tolist() == [cell, -1, -1, -1, 5]
    assert Finder(plane, from_above=True).find_containing_cell(points)[:2].tolist() == [cell, cell]
    plane.points[0, 2] = 8
    with pytest.raises(ValueError, match="not in one plane"):
        Finder(plane).find_containing_cell(points)
    assert Finder(plane, from_above=True).find_containing_cell([0.3, 0.3, 9.0]) == cell
    assert Finder(pyvista.PolyData()).find_containing_cell(points).tolist() == [-1] * 5


def test_closest_cells(random: np.random.Generator) -> None:
    ball = pyvista.Sphere()
    points = random.normal(size=(500, 3))
    cell, closest = Finder(ball).find_closest_cell(points, return_closest_point=True)
    theirs, at = ball.find_closest_cell(points, return_closest_point=True)
    np.testing.assert_allclose(closest, at, atol=1e-6)
    away = np.linalg.norm(closest - points, axis=1)
    assert (away <= np.linalg.norm(at - points, axis=1) + 1e-15).all()
    # Where the closest point is on an edge, VTK takes one of the cells, and this the lowest.
    faces = ball.regular_faces
    for mine, other in zip(faces[cell], faces[theirs], strict=True):
        assert set(mine) & set(other)
    one, place = Finder(ball).find_closest_cell(points[0], return_closest_point=True)
    assert one == cell[0]
    assert place.shape == (3,)
    assert Finder(ball).find_closest_cell([np.nan, 0, 0]) == -1


def test_the_page() -> None:
    run_page(PAGES / "pyvista.md")
