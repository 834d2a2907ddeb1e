"""What new users get wrong is told in words of theirs."""

from __future__ import annotations

import pickle
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

import meshwalk

X, Y = np.linspace(0, 4, 9), np.linspace(0, 3, 9)
XY = np.column_stack((X, Y))
WRONG: Any = [1, 2, 3, 4]


@pytest.mark.parametrize(
    ("call", "error", "message"),
    [
        (lambda g: g.locate(XY.T), ValueError, r"take xy\.T, or np\.column_stack\(\(x, y\)\)"),
        (lambda g: g.locate((X, Y)), ValueError, r"take xy\.T, or np\.column_stack\(\(x, y\)\)"),
        (lambda g: g.locate(X), ValueError, r"joined by np\.column_stack\(\(x, y\)\)"),
        (lambda g: g.locate(np.zeros((5, 3))), ValueError, r"columns out as in xy\[\.\.\., :2\]"),
        (lambda g: g.segment(XY.T, XY), ValueError, r"take a\.T, or np\.column_stack"),
        (lambda g: meshwalk.delaunay((X, Y)), ValueError, r"take points\.T, or np\.column_stack"),
        (lambda g: g.locate(X, Y), TypeError, r"tolerance must be a number, not an array; points"),
        (lambda g: g.locate(XY, "1"), TypeError, "tolerance must be a number, not str"),
        (lambda g: g.nearest_border(X, Y), TypeError, "x must be a number, not ndarray"),
        (lambda g: g.locate(XY, threads=-1), ValueError, r"threads must be from 0 to .*, not -1"),
        (lambda g: g.locate(XY, threads="2"), TypeError, "threads must be a whole number, not '2'"),
        (lambda g: g.locate(XY, progress=5), TypeError, "progress must be a function .*, not 5"),
        (lambda g: g.locate(XY, walk="foo"), ValueError, "no walk 'foo'; there are auto, lawson"),
        (lambda g: g.locate(XY, start="x"), ValueError, "no start 'x'; there are auto, random"),
        (lambda g: meshwalk.plot(g), TypeError, r"must be a meshwalk\.Mesh, not Locator"),
        (lambda g: meshwalk.explain(g.mesh, 1, 1), TypeError, r"a meshwalk\.Locator, not Mesh"),
        (
            lambda g: meshwalk.Mesh(g.mesh.points, g.mesh.triangles, WRONG),
            TypeError,
            "fields must be a mapping of names to values, such as {'z': z}, not list",
        ),
        (
            lambda g: meshwalk.Mesh(g.mesh.points, g.mesh.triangles, {"u": np.zeros((4, 2))}),
            ValueError,
            r"fields\['u'\] must have the shape \(4,\).*; of a vector make a field of each",
        ),
        (
            lambda g: meshwalk.Operator(g.locate(XY)) @ "h",
            TypeError,
            r"it knows no field 'h'; take mesh\.fields\['h'\]",
        ),
    ],
)
def test_messages(
    square: meshwalk.Mesh, call: Callable[[Any], Any], error: type[Exception], message: str
) -> None:
    locator = meshwalk.Locator(square, border=True)
    with pytest.raises(error, match=message):
        call(locator)


def test_names_of_walks_and_starts(square: meshwalk.Mesh) -> None:
    locator = meshwalk.Locator(square)
    assert {"auto", "straight", "celestial"} <= set(meshwalk.walk_names)
    assert {"auto", "random", "kd-tree"} <= set(meshwalk.start_names)
    for walk in meshwalk.walk_names:
        assert locator.locate([[3, 1]], walk=walk).triangle.tolist() == [0]


def test_points_near_the_mesh_have_values(square: meshwalk.Mesh) -> None:
    hit = meshwalk.Locator(square, border=True).locate([[2, 5], [2, 9], [3, 1]], tolerance=1)
    values = np.array([1.0, 2, 3, 4])
    assert hit.inside.tolist() == [False, False, True]
    product = np.where(hit.triangle >= 0, hit.operator() @ values, np.nan)
    np.testing.assert_array_equal(product, hit.interpolate(values))


def test_the_nearest_border_of_many_points(
    ring: meshwalk.Mesh, random: np.random.Generator
) -> None:
    locator = meshwalk.Locator(ring, border=True)
    xy = random.uniform(-2, 8, (7, 6, 2))
    many = locator.nearest_border(xy)
    assert many.point.shape == (7, 6, 2)
    for i in np.ndindex(7, 6):
        one = locator.nearest_border(*xy[i])
        assert [many.triangle[i], many.edge[i], many.distance[i]] == list(one[:3])
        assert (tuple(many.point[i]), tuple(many.weights[i])) == one[3:]
    bad = locator.nearest_border(np.array([[np.nan, 1], [3, 7]]))
    assert bad.triangle.tolist()[0] == -1
    assert np.isnan(bad.distance).tolist() == [True, False]
    with pytest.raises(ValueError, match="border"):
        meshwalk.Locator(ring).nearest_border([[1, 1]])


def test_one_location_pickles(ring: meshwalk.Mesh) -> None:
    locator = meshwalk.Locator(ring)
    for point in ((1, 1), (3, 3), (9, 9), (np.nan, 1)):
        one = locator.locate_one(*point)
        again = pickle.loads(pickle.dumps(one))
        assert repr(again) == repr(one)
        assert (again.where, again.hole, again.triangle) == (one.where, one.hole, one.triangle)
    reduced: Any = one.__reduce__()
    make, (record,) = reduced
    for wrong in (record[1:], b"\xff" * len(record)):
        with pytest.raises(ValueError, match="this is no location"):
            make(wrong)


def test_unused_vertices_may_be_anywhere() -> None:
    mesh = meshwalk.Mesh(np.array([[0, 0], [4, 0], [0, 4], [np.nan, 1]]), [[0, 1, 2]])
    assert mesh.describe().unused_vertices == 1


def test_a_star_import_keeps_map() -> None:
    names: dict[str, Any] = {}
    exec("from meshwalk import *", names)
    assert "map" not in names
    assert "Mesh" in names
    assert callable(meshwalk.map)


def test_help_explains_fields() -> None:
    for kind in (meshwalk.MeshInfo, meshwalk.LocatorInfo, meshwalk.NearestBorder, meshwalk.Exits):
        for name in kind._fields:
            assert f"    {name} : " in (kind.__doc__ or ""), (kind, name)
    for where in meshwalk.Where:
        assert f"    {where.name} : {where.value}\n" in (meshwalk.Where.__doc__ or "")
