"""Triangulations: the constraints are kept, what is wrong is told by number."""

from __future__ import annotations

import pickle
from typing import Any

import numpy as np
import pytest

import meshwalk

SQUARE = [[0, 0], [6, 0], [6, 6], [0, 6]]
HOLE = [[2, 2], [4, 2], [4, 4], [2, 4]]
RING = [[0, 1], [1, 2], [2, 3], [3, 0]]
RINGS = RING + [[a + 4, b + 4] for a, b in RING]


def test_what_is_kept() -> None:
    points = SQUARE + HOLE
    areas = {
        mesh.describe().area
        for mesh in (
            meshwalk.constrained_delaunay(points, RINGS, [[3, 3]]),
            meshwalk.constrained_delaunay(points, RINGS, polygons=[0] * 8),
            meshwalk.constrained_delaunay(points, RINGS, polygons=[7] * 8, keep="inside"),
        )
    }
    assert areas == {32}
    for keep, area in (("auto", 36), ("hull", 36), ("inside", 36)):
        assert meshwalk.constrained_delaunay(points, RINGS, keep=keep).describe().area == area  # type: ignore[arg-type]


def test_edges_of_segments(random: np.random.Generator) -> None:
    points = random.uniform(size=(200, 2))
    points[:2] = [[-1, -1], [2, 2]]
    mesh = meshwalk.constrained_delaunay(points, [[0, 1]])
    assert mesh.constrained_edges.tolist() == [[0, 1]]
    assert mesh.edge_segments.tolist() == [0]
    corners = mesh.triangles
    assert any({0, 1} <= set(t) for t in corners.tolist())
    again = pickle.loads(pickle.dumps(mesh))
    assert again.constrained_edges.tolist() == [[0, 1]]
    assert meshwalk.delaunay(points).constrained_edges.shape == (0, 2)


def test_crossings() -> None:
    crossing = [[0, 2], [1, 3]]
    with pytest.raises(meshwalk.InputError) as raised:
        meshwalk.constrained_delaunay(SQUARE, crossing)
    assert raised.value.segments is not None
    assert sorted(raised.value.segments) == [0, 1]
    heights = np.column_stack([SQUARE, [1, 2, 3, 4]])
    mesh = meshwalk.constrained_delaunay(heights, crossing, split=True)
    np.testing.assert_array_equal(mesh.points[4], [3, 3])
    np.testing.assert_array_equal(mesh.fields["z"], [1, 2, 3, 4, np.nan])
    assert sorted(mesh.edge_segments.tolist()) == [0, 0, 1, 1]


@pytest.mark.parametrize(
    ("options", "error", "message"),
    [
        ({"segments": [[0, 4]]}, ValueError, r"segments\[0, 1\] is no point: 4"),
        ({"segments": [[0, 1], [-1, 2]]}, ValueError, r"segments\[1, 0\] is no point: -1"),
        ({"segments": [[0, 1, 2]]}, ValueError, r"segments must have the shape \(k, 2\)"),
        ({"segments": [[0.0, 1.0]]}, TypeError, "segments must be integers"),
        ({"polygons": [0, 0]}, ValueError, r"polygons must have the shape \(4,\), not \(2,\)"),
        ({"polygons": [0, 0, -2, 0]}, ValueError, r"polygons\[2\] is no number: -2"),
        ({"polygons": [0, 0, 0, 1]}, meshwalk.InputError, "closed"),
        ({"holes": [[np.nan, 1]]}, ValueError, "finite"),
        ({"holes": [1, 2, 3]}, ValueError, "holes must have the shape"),
        ({"holes": [[1, 1]]}, meshwalk.InputError, "left"),
        ({"keep": "some"}, ValueError, "keep must be one of auto, hull, inside"),
    ],
)
def test_refusals(options: dict[str, Any], error: type[Exception], message: str) -> None:
    given = {"segments": RING, **options}
    with pytest.raises(error, match=message):
        meshwalk.constrained_delaunay(SQUARE, **given)


def test_no_segments() -> None:
    mesh = meshwalk.constrained_delaunay(SQUARE, [])
    assert len(mesh) == len(meshwalk.constrained_delaunay(SQUARE, [], holes=None)) == 2
    assert mesh.constrained_edges.shape == (0, 2)


def test_kinds(random: np.random.Generator) -> None:
    points = random.uniform(size=(60, 3))
    lengths = {}
    for kind in ("delaunay", "greedy", "min-weight", "min-max-angle"):
        mesh = meshwalk.triangulate(points, kind, limit=60)
        assert mesh.describe().convex
        np.testing.assert_array_equal(mesh.fields["z"], points[:, 2])
        ends = np.sort(mesh.triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2))
        a, b = mesh.points[np.unique(ends, axis=0).T]
        lengths[kind] = np.hypot(*(a - b).T).sum()
    assert lengths["min-weight"] <= min(lengths.values()) * (1 + 1e-12)
    with pytest.raises(ValueError, match="there is no kind of triangulation 'wild'"):
        meshwalk.triangulate(points, "wild")  # type: ignore[arg-type]


def test_regular() -> None:
    square = [[0, 0], [8, 0], [8, 8], [0, 8], [4, 4], [4, 3]]
    light = meshwalk.triangulate(square, "regular")
    assert light.describe().delaunay
    assert light.describe().unused_vertices == 0
    heavy = meshwalk.triangulate(square, "regular", weights=[0, 0, 0, 0, 9, -1])
    assert np.setdiff1d(np.arange(6), heavy.triangles).tolist() == [5]
    with pytest.raises(meshwalk.InputError, match="weight of point 2 is not finite"):
        meshwalk.triangulate(square, "regular", weights=[0, 0, np.nan, 0, 0, 0])
    with pytest.raises(ValueError, match="weights"):
        meshwalk.triangulate(square, "regular", weights=[0, 0])
    with pytest.raises(ValueError, match="need the kind 'regular'"):
        meshwalk.triangulate(square, weights=[0] * 6)


def test_local_optima_are_warned_about(random: np.random.Generator) -> None:
    with pytest.warns(meshwalk.OptimumWarning, match="local optimum"):
        meshwalk.triangulate(random.uniform(size=(60, 2)), "min-max-angle", limit=5)


def test_holes_that_remove_too_little_or_too_much() -> None:
    points = [*SQUARE, [1, 1], [3, 1], [3, 3], [1, 3]]
    outer = [[0, 1], [1, 2], [2, 3], [3, 0]]
    inner = [[4, 5], [5, 6], [6, 7], [7, 4]]
    with pytest.warns(meshwalk.HoleWarning, match=r"holes\[1\] \(9.0, 9.0\) removes nothing: it"):
        mesh = meshwalk.constrained_delaunay(points, outer + inner, [[2, 2], [9, 9]])
    assert mesh.describe().holes == 1
    with pytest.warns(meshwalk.HoleWarning, match=r"removes nothing, and so do 1 more"):
        meshwalk.constrained_delaunay(points, outer + inner, [[8, 8], [2, 2], [9, 9]])
    cases = [
        (outer[1:] + inner, [[2, 2]], "no ring of segments is closed|reaches all"),
        (outer[1:], [[2, 2]], "no ring of segments is closed"),
        (outer + inner[1:], [[2, 2]], r"the point of hole 0 \(2, 2\) reaches all that was left"),
        (outer, [[6, 2]], r"the point of hole 0 \(6, 2\) is on a segment"),
    ]
    for segments, holes, message in cases:
        with pytest.raises(meshwalk.InputError, match=message):
            meshwalk.constrained_delaunay(points, segments, holes)
    with pytest.raises(ValueError, match=r"holes must have the shape \(h, 2\), a point in each"):
        meshwalk.constrained_delaunay(points, outer + inner, [[[1, 1], [3, 1], [2, 3]]])
