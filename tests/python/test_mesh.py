"""Meshes: what goes in comes out, defects are named, and nothing changes them."""

from __future__ import annotations

import copy
import gc
import pickle
import subprocess
import sys
import weakref

import numpy as np
import pytest
from conftest import ring_arrays

import meshwalk


def test_modules_are_imported_when_they_are_used() -> None:
    program = """
import sys, meshwalk
early = [name for name in sys.modules if name.startswith("meshwalk._")]
assert "meshwalk._editor" not in early and "meshwalk._arrays" not in early, early
assert dir(meshwalk) == sorted([*meshwalk.__all__, "map"])
for name in meshwalk.__all__:
    assert getattr(meshwalk, name) is not None, name
assert sorted(meshwalk._HOMES) == [name for name in dir(meshwalk) if name not in early_names]
"""
    early = ["Error", "InputError", "LimitError", "Location", "Where", "__version__"]
    subprocess.run([sys.executable, "-c", f"early_names = {early}\n{program}"], check=True)
    with pytest.raises(AttributeError, match="module 'meshwalk' has no attribute 'Mash'"):
        _ = meshwalk.Mash


def test_arrays_come_back(square: meshwalk.Mesh) -> None:
    assert square.vertex_count == 4
    assert len(square) == square.triangle_count == 2
    np.testing.assert_array_equal(square.points, [[0, 0], [4, 0], [4, 4], [0, 4]])
    np.testing.assert_array_equal(square.triangles, [[0, 1, 2], [0, 2, 3]])
    np.testing.assert_array_equal(square.neighbours, [[-1, -1, 1], [0, -1, -1]])


def test_scattered_arrays_keep_their_numbers(random: np.random.Generator) -> None:
    mesh = meshwalk.delaunay(random.uniform(size=(5000, 2)))
    points, triangles = mesh.points, mesh.triangles
    order = random.permutation(len(triangles))
    again = meshwalk.Mesh(points, triangles[order])
    np.testing.assert_array_equal(again.points, points)
    np.testing.assert_array_equal(again.triangles, triangles[order])


def test_changes_of_the_arrays_do_not_change_the_mesh() -> None:
    points, triangles = ring_arrays()
    heights = np.arange(8.0)
    mesh = meshwalk.Mesh(points, triangles, {"h": heights})
    points[:] = np.nan
    triangles[:] = 99
    heights[:] = -1
    assert mesh.describe().holes == 1
    np.testing.assert_array_equal(mesh.fields["h"], np.arange(8))
    mesh.points[:] = np.nan
    mesh.triangles[:] = 99
    assert mesh.describe().holes == 1
    with pytest.raises(ValueError, match="read-only"):
        mesh.fields["h"][0] = 7
    with pytest.raises(TypeError):
        mesh.fields["h"] = heights  # type: ignore[index]


def test_third_column_is_a_field() -> None:
    mesh = meshwalk.Mesh([[0, 0, 7], [4, 0, 8], [0, 4, 9]], [[0, 1, 2]], {"t": [1, 2, 3]})
    assert list(mesh.fields) == ["z", "t"]
    np.testing.assert_array_equal(mesh.fields["z"], [7, 8, 9])
    with pytest.raises(ValueError, match="z is given twice"):
        meshwalk.Mesh([[0, 0, 7], [4, 0, 8], [0, 4, 9]], [[0, 1, 2]], {"z": [1, 2, 3]})


def test_description(ring: meshwalk.Mesh) -> None:
    info = ring.describe()
    assert (info.vertices, info.triangles, info.holes, info.border_loops) == (8, 8, 1, 2)
    assert info.embedding
    assert not info.convex
    assert info.area == 32
    assert (info.low, info.high) == ((0, 0), (6, 6))


def test_check_lists_all_defects() -> None:
    points = [[0, 0], [4, 0], [0, 4], [1, 1]]
    result = meshwalk.check(points, [[0, 1, 2], [0, 1, 3], [2, 2, 9]])
    assert not result.valid
    assert result.defects[0].kind == "vertex that does not exist"
    assert result.defects[0].triangle == 2


@pytest.mark.parametrize(
    ("points", "triangles", "triangle", "vertex", "kind"),
    [
        ([[0, 0], [4, 0], [0, 4]], [[0, 1, 2], [0, 1, 3]], 1, None, "does not exist"),
        ([[0, 0], [4, 0], [0, 4]], [[0, 1, -1]], 0, None, "does not exist"),
        ([[0, 0], [4, 0], [0, 4]], [[0, 1, 2**31 - 1]], 0, None, "does not exist"),
        ([[0, 0], [4, 0], [0, np.nan]], [[0, 1, 2]], 0, 2, "not finite"),
        ([[0, 0], [4, 0], [0, np.inf]], [[0, 1, 2]], 0, 2, "not finite"),
        ([[0, 0], [4, 0], [0, 4]], [[0, 1, 1]], 0, 1, "twice"),
    ],
)
def test_unusable_arrays_are_refused_with_the_place(
    points: list[list[float]],
    triangles: list[list[int]],
    triangle: int,
    vertex: int | None,
    kind: str,
) -> None:
    with pytest.raises(meshwalk.InputError) as raised:
        meshwalk.Mesh(points, triangles)
    assert raised.value.triangle == triangle
    assert raised.value.vertex == vertex
    assert raised.value.defect is not None
    assert kind in raised.value.defect.kind
    assert isinstance(raised.value, ValueError)


def test_an_edge_of_three_triangles() -> None:
    points = [[0, 0], [4, 0], [0, 4], [0, -4], [4, 4]]
    triangles = [[0, 1, 2], [0, 3, 1], [0, 1, 4]]
    with pytest.raises(meshwalk.InputError):
        meshwalk.Mesh(points, triangles)
    assert len(meshwalk.Mesh(points, triangles, tolerant=True)) == 3


def test_layouts(scattered: meshwalk.Mesh) -> None:
    for layout in ("auto", "hilbert", "as-given"):
        mesh = meshwalk.Mesh(scattered.points, scattered.triangles, layout=layout)
        np.testing.assert_array_equal(mesh.triangles, scattered.triangles)
    with pytest.raises(ValueError, match="layout must be one of auto, hilbert, as-given"):
        meshwalk.Mesh(scattered.points, scattered.triangles, layout="wild")  # type: ignore[arg-type]


def test_pickle_and_copy(ring: meshwalk.Mesh) -> None:
    mesh = meshwalk.Mesh(ring.points, ring.triangles, {"h": np.arange(8)}, layout="hilbert")
    for again in (pickle.loads(pickle.dumps(mesh)), copy.deepcopy(mesh)):
        np.testing.assert_array_equal(again.points, mesh.points)
        np.testing.assert_array_equal(again.triangles, mesh.triangles)
        np.testing.assert_array_equal(again.fields["h"], mesh.fields["h"])
        assert again._options == (False, "hilbert")


def test_representation(ring: meshwalk.Mesh) -> None:
    assert repr(ring) == "<Mesh: 8 vertices, 8 triangles>"
    assert repr(meshwalk.Locator(ring)) == "<Locator of <Mesh: 8 vertices, 8 triangles>>"


def test_no_attributes_are_invented(ring: meshwalk.Mesh) -> None:
    with pytest.raises(AttributeError):
        ring.point = 3  # type: ignore[attr-defined]


def test_a_mesh_ends_with_its_last_reference(ring: meshwalk.Mesh) -> None:
    mesh = meshwalk.Mesh(ring.points, ring.triangles)
    gone = weakref.ref(mesh)
    locator = meshwalk.Locator(mesh)
    hit = locator.locate([[1, 1]])
    del mesh
    gc.collect()
    assert gone() is not None
    assert locator.locate_one(1, 0.5).triangle == 0
    del locator
    assert hit.interpolate(np.ones(8)) == 1
    del hit
    gc.collect()
    assert gone() is None


def test_delaunay(random: np.random.Generator) -> None:
    points = random.uniform(size=(1000, 2))
    mesh = meshwalk.delaunay(points)
    np.testing.assert_array_equal(mesh.points, points)
    info = mesh.describe()
    assert info.delaunay
    assert info.convex
    assert info.clockwise_triangles == 0
    np.testing.assert_array_equal(meshwalk.delaunay(points, threads=1).triangles, mesh.triangles)


def test_duplicates_are_warned_about() -> None:
    points = [[0, 0], [4, 0], [0, 4], [4, 0], [0, 4]]
    with pytest.warns(meshwalk.DuplicateWarning, match=r"2 of 5 .* point 3, of point 1"):
        mesh = meshwalk.delaunay(points)
    assert mesh.triangles.max() == 2


@pytest.mark.parametrize(
    "points", [[[0, 0], [1, 1]], [[0, 0], [1, 1], [2, 2]], [[0, 0], [1, 1], [2, np.nan]], []]
)
def test_points_without_a_triangulation(points: list[list[float]]) -> None:
    with pytest.raises(meshwalk.InputError):
        meshwalk.delaunay(np.reshape(points, (-1, 2)))


def test_values_of_triangles() -> None:
    points = [[0, 0], [4, 0], [4, 4], [0, 4]]
    mesh = meshwalk.Mesh(points, [[0, 1, 2], [0, 2, 3]], triangle_fields={"soil": [1, 2]})
    back = pickle.loads(pickle.dumps(mesh))
    assert back.triangle_fields["soil"].tolist() == [1, 2]
    assert not back.triangle_fields["soil"].flags.writeable
    hit = meshwalk.Locator(mesh).locate([[[3, 1], [1, 3]], [[9, 9], [2, 2]]])
    np.testing.assert_array_equal(hit.of_triangles("soil"), [[1, 2], [np.nan, 1]])
    assert hit.of_triangles(np.array([1, 2], np.float32)).dtype == np.float32
    whole = hit.of_triangles(np.array([5, 6], np.int8), missing=-1)
    assert whole.dtype == np.int8
    assert whole.tolist() == [[5, 6], [-1, 5]]
    assert hit.of_triangles(np.array(["clay", "silt"]), missing="").tolist() == [
        ["clay", "silt"],
        ["", "clay"],
    ]
    assert hit.of_triangles(np.zeros((2, 3))).shape == (2, 2, 3)
    masked = np.ma.array([1.0, 2.0], mask=[False, True])
    np.testing.assert_array_equal(hit.of_triangles(masked), [[1, np.nan], [np.nan, 1]])
    np.testing.assert_array_equal(mesh.to_vertices(masked), [1, 1, 1, np.nan])
    np.testing.assert_array_equal(mesh.to_vertices("soil"), [1.5, 1, 1.5, 2])
    with pytest.raises(KeyError, match="no triangle field 'rock'; it has soil"):
        hit.of_triangles("rock")
    with pytest.raises(KeyError, match="no triangle field 'rock'"):
        mesh.to_vertices("rock")
    with pytest.raises(ValueError, match="each of the 2 triangles"):
        hit.of_triangles([1, 2, 3])
    with pytest.raises(ValueError, match=r"triangle_fields\['soil'\] must have the shape \(2,\)"):
        meshwalk.Mesh(points, [[0, 1, 2], [0, 2, 3]], triangle_fields={"soil": [1, 2, 3]})


def test_reordered(random: np.random.Generator) -> None:
    points = random.uniform(size=(2000, 3))
    given = meshwalk.constrained_delaunay(points, [[0, 1]])
    assert len(given.constrained_edges) == 1
    soil = np.arange(float(given.triangle_count))
    plain = meshwalk.Mesh(points, given.triangles, triangle_fields={"soil": soil}, crs="EPSG:2056")
    mesh, vertices, triangles = plain.reordered()
    np.testing.assert_array_equal(np.sort(vertices), np.arange(2000))
    np.testing.assert_array_equal(mesh.points, points[vertices, :2])
    np.testing.assert_array_equal(vertices[mesh.triangles], plain.triangles[triangles])
    np.testing.assert_array_equal(mesh.triangle_fields["soil"], triangles)
    assert mesh.crs == "EPSG:2056"
    xy = random.uniform(size=(500, 2))
    before, after = (meshwalk.Locator(m).locate(xy) for m in (plain, mesh))
    there = after.inside
    np.testing.assert_array_equal(before.inside, there)
    np.testing.assert_array_equal(triangles[after.triangle[there]], before.triangle[there])
    np.testing.assert_array_equal(after.interpolate("z"), before.interpolate("z"))
    edge = given.reordered()
    np.testing.assert_array_equal(
        edge.vertices[edge.mesh.constrained_edges], given.constrained_edges
    )
    apart = np.abs(np.diff(mesh.triangles)).mean()
    assert apart < np.abs(np.diff(plain.triangles)).mean() / 4
    nothing = meshwalk.Mesh(np.empty((0, 2)), np.empty((0, 3), int)).reordered()
    assert nothing.mesh.vertex_count == 0
