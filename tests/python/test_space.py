"""Surfaces in space: rays from a centre, probes, nearest points, and updates."""

from __future__ import annotations

import gc
import pickle
import threading
import weakref
from fractions import Fraction
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

import meshwalk
from meshwalk import TouchState, Where

OCTAHEDRON = [[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]]
FACETS = [
    *([0, 2, 4], [2, 1, 4], [1, 3, 4], [3, 0, 4]),
    *([2, 0, 5], [1, 2, 5], [3, 1, 5], [0, 3, 5]),
]


def _globe(columns: int = 12, rows: int = 7) -> tuple[NDArray[Any], NDArray[Any]]:
    """Longitudes and latitudes with a seam and a row of vertices at each pole."""
    longitude, latitude = np.meshgrid(np.linspace(-180, 180, columns), np.linspace(-90, 90, rows))
    number = np.arange(columns * rows).reshape(rows, columns)
    a, b = number[:-1, :-1].ravel(), number[:-1, 1:].ravel()
    d, c = number[1:, :-1].ravel(), number[1:, 1:].ravel()
    at_the_poles = columns - 1
    lower = np.column_stack([a, b, c])[at_the_poles:]
    upper = np.column_stack([a, c, d])[:-at_the_poles]
    triangles = np.concatenate([lower, upper])
    return np.column_stack([longitude.ravel(), latitude.ravel()]), triangles


@pytest.fixture
def octahedron() -> meshwalk.Surface:
    return meshwalk.Surface(OCTAHEDRON, FACETS)


def _turn(a: Any, b: Any, p: Any) -> Fraction:
    (ax, ay, az), (bx, by, bz), (px, py, pz) = ([Fraction(float(v)) for v in w] for w in (a, b, p))
    return ax * (by * pz - bz * py) - ay * (bx * pz - bz * px) + az * (bx * py - by * px)


def _oracle(surface: meshwalk.Surface, point: Any) -> int:
    points = surface.points
    for number, (a, b, c) in enumerate(points[corner] for corner in surface.triangles):
        if _turn(a, b, c) == 0:
            continue
        sign = 1 if _turn(a, b, c) > 0 else -1
        if all(sign * t >= 0 for t in (_turn(a, b, point), _turn(b, c, point), _turn(c, a, point))):
            return number
    return -1


def test_rays_are_exact(octahedron: meshwalk.Surface, random: np.random.Generator) -> None:
    points = random.integers(-3, 4, (200, 3))
    hit = meshwalk.Star(octahedron).locate(points)
    for point, triangle, where in zip(points, hit.triangle, hit.where, strict=True):
        if point.any():
            assert triangle == _oracle(octahedron, point)
        else:
            assert where == Where.BAD
    assert hit.mesh is octahedron
    values = random.uniform(size=6)
    there = hit.inside
    expected = (hit.weights[there] * values[octahedron.triangles[hit.triangle[there]]]).sum(1)
    np.testing.assert_allclose(hit.interpolate(values)[there], expected, rtol=1e-14)


def test_globe(random: np.random.Generator) -> None:
    lonlat, triangles = _globe()
    surface = meshwalk.Surface.from_lonlat(lonlat, triangles, {"latitude": lonlat[:, 1]})
    globe = meshwalk.Star(surface)
    queries = np.concatenate([random.uniform([-540, -90], [540, 90], (100, 2)), lonlat])
    hit = globe.locate(queries, lonlat=True)
    turned = globe.locate(queries[:100] + np.array([360, 0]), lonlat=True)
    np.testing.assert_array_equal(turned.triangle, hit.triangle[:100])
    directions = meshwalk.lonlat_to_direction(queries)
    np.testing.assert_array_equal(hit.triangle, [_oracle(surface, p) for p in directions])
    at_vertices = hit[100:].interpolate("latitude")
    np.testing.assert_array_equal(at_vertices, lonlat[:, 1])
    assert globe.locate(np.array([[0, 91], [np.nan, 0]]), True).where.tolist() == [Where.BAD] * 2
    np.testing.assert_allclose(
        meshwalk.direction_to_lonlat(directions[:100]),
        np.column_stack([(queries[:100, 0] + 180) % 360 - 180, queries[:100, 1]]),
        atol=1e-12,
    )
    with pytest.raises(ValueError, match=r"lonlat\[1\] is not a longitude .* 0\.0, 91\.0"):
        meshwalk.Surface.from_lonlat([[0, 0], [0, 91], [90, 0]], [[0, 1, 2]])


def test_another_centre(octahedron: meshwalk.Surface) -> None:
    away = np.array([100, 200, 300])
    moved = meshwalk.Surface(np.array(OCTAHEDRON) + away, FACETS)
    star = meshwalk.Star(moved, away)
    lonlat = [[45, 45], [-45, -45], [10, 80]]
    expected = meshwalk.Star(octahedron).locate(lonlat, lonlat=True).triangle
    np.testing.assert_array_equal(star.locate(lonlat, lonlat=True).triangle, expected)
    assert star.describe().centre == (100, 200, 300)
    with pytest.raises(meshwalk.InputError) as raised:
        meshwalk.Star(moved)
    assert raised.value.defect is not None
    assert not meshwalk.check_star(moved.points, moved.triangles).valid
    assert meshwalk.check_star(moved.points, moved.triangles, (100, 200, 300)).valid


def test_open_surfaces_are_no_stars(octahedron: meshwalk.Surface) -> None:
    with pytest.raises(meshwalk.InputError) as raised:
        meshwalk.Star(meshwalk.Surface(OCTAHEDRON, FACETS[1:]))
    assert raised.value.defect is not None
    assert raised.value.defect.kind == "edge without a neighbour"
    with pytest.raises(TypeError, match="surface must be"):
        meshwalk.Star(OCTAHEDRON)  # type: ignore[arg-type]
    star = meshwalk.Star(octahedron)
    with pytest.raises(ValueError, match="there is no walk 'ramble'"):
        star.locate([[1, 1, 1]], walk="ramble")
    with pytest.raises(ValueError, match="there is no start 'nowhere'"):
        star.locate([[1, 1, 1]], start="nowhere")
    with pytest.raises(ValueError, match=r"points must have the shape \(\.\.\., 2\)"):
        star.locate([[1, 1, 1]], lonlat=True)


@pytest.mark.parametrize("unchecked", [False, True])
def test_stars_without_memory(octahedron: meshwalk.Surface, unchecked: bool) -> None:
    directions = np.random.default_rng(7).normal(size=(500, 3))
    directions[:6] = OCTAHEDRON
    star = meshwalk.Star(octahedron)
    slim = meshwalk.Star(octahedron, borrow=True, unchecked=unchecked)
    assert slim.describe().bytes < min(500, star.describe().bytes)
    for kept in (slim, pickle.loads(pickle.dumps(slim))):
        found = kept.locate(directions)
        expected = star.locate(directions)
        np.testing.assert_array_equal(found.triangle, expected.triangle)
        np.testing.assert_array_equal(found.weights, expected.weights)
        assert kept.describe().bytes == slim.describe().bytes
    octahedron.move(2 * octahedron.points)
    np.testing.assert_array_equal(slim.locate(directions).triangle, expected.triangle)
    with pytest.raises(ValueError, match="the walk on a borrowed star is stochastic"):
        slim.locate(directions, walk="straight")
    with pytest.raises(ValueError, match="'unchecked' needs 'borrow'"):
        meshwalk.Star(octahedron, unchecked=True)
    apart = [[*p] for p in OCTAHEDRON]
    apart[4] = [0, 0, -9]
    with pytest.raises(meshwalk.InputError) as raised:
        meshwalk.Star(meshwalk.Surface(apart, FACETS), borrow=True)
    assert raised.value.defect is not None


def test_what_is_kept_follows_the_surface(octahedron: meshwalk.Surface) -> None:
    star = meshwalk.Star(octahedron)
    prober = meshwalk.Prober(octahedron, boxes=True)
    assert prober.nearest([0, 0, 5]).distance == 4
    octahedron.move(2 * octahedron.points, moved=1)
    assert prober.nearest([0, 0, 5]).distance == 3
    octahedron.move([[0, 0, 3]], vertices=[4])
    assert prober.nearest([0, 0, 5]).distance == 2
    assert star.locate([1, 1, 1]).triangle == 0
    with pytest.raises(meshwalk.InputError):
        octahedron.move([[0, 0, -9]], vertices=[4])
    assert star.locate([1, 1, 1]).where == Where.BAD
    octahedron.move(OCTAHEDRON)
    assert star.locate([1, 1, 1]).triangle == 0


def test_moves_that_are_refused(octahedron: meshwalk.Surface) -> None:
    with pytest.raises(ValueError, match="points must have 6 rows, not 1"):
        octahedron.move([[0, 0, 0]])
    with pytest.raises(ValueError, match="points must have 2 rows, not 1"):
        octahedron.move([[0, 0, 0]], vertices=[1, 2])
    with pytest.raises(ValueError, match=r"vertices\[1\] is no point: 6"):
        octahedron.move([[0, 0, 0], [0, 0, 0]], vertices=[1, 6])
    np.testing.assert_array_equal(octahedron.points, OCTAHEDRON)


def test_flips(octahedron: meshwalk.Surface) -> None:
    prober = meshwalk.Prober(octahedron, boxes=True)
    before = octahedron.triangles
    octahedron.flip(0, 0)
    assert (octahedron.triangles != before).any()
    assert prober.nearest([0, 0, 5]).distance == 4
    with pytest.raises(ValueError, match="no triangle 8"):
        octahedron.flip(8, 0)
    with pytest.raises(ValueError, match="edge must be 0, 1 or 2, not 3"):
        octahedron.flip(0, 3)
    with pytest.raises(meshwalk.InputError):
        meshwalk.Surface([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]]).flip(0, 0)


def test_rays(octahedron: meshwalk.Surface) -> None:
    prober = meshwalk.Prober(octahedron, boxes=True)
    up = prober.probe([0.1, 0.2, 0], [0, 0, 1], certain=True, extent="ray", faces="both")
    assert up.distance == pytest.approx(0.7)
    assert bool(up.back)
    assert prober.probe([0.1, 0.2, 0], [0, 0, 1], certain=True, extent="ray").triangle == -1
    for top, state in ((0.5, TouchState.NONE), (0.75, TouchState.HIT)):
        end = prober.probe(
            [0.1, 0.2, 0], [0.1, 0.2, top], certain=True, extent="segment", faces="both"
        )
        assert end.state == state
    both = prober.probe_all([0.1, 0.2, -5], [0, 0, 1])
    assert both.distance == pytest.approx([4.3, 5.7])
    assert both.back.tolist() == [False, True]
    assert len(prober.probe_all([0, 0, -5], [0, 0, 1]).triangle) == 8
    assert prober.probe_all([0.1, 0.2, -5], [0, 0, 1], 5).distance == pytest.approx([4.3])
    assert prober.probe_all([9, 9, 9], [0, 0, 1]).shape == (0,)
    wrong: Any
    for wrong in ({"extent": "curve"}, {"faces": "none"}, {"min_distance": -1}):
        with pytest.raises(ValueError, match=r"no extent|no faces|least distance"):
            prober.probe_all([0, 0, -5], [0, 0, 1], **wrong)
    with pytest.raises(ValueError, match="motion is zero"):
        prober.probe_all([0, 0, -5], [0, 0, 0])
    with pytest.raises(ValueError, match="need 'certain'"):
        prober.probe([0, 0, -5], [0, 0, 1], extent="ray")


def test_many_rays(octahedron: meshwalk.Surface, random: np.random.Generator) -> None:
    prober = meshwalk.Prober(octahedron, boxes=True)
    points = random.integers(-4, 5, (40, 5, 3)) / 4
    motions = random.integers(-2, 3, (40, 5, 3)).astype(float)
    motions[~motions.any(axis=2)] = 1
    motions[0, 0], points[0, 1] = 0, np.nan
    some: Any = {"max_distance": 3, "extent": "ray", "min_distance": 0.25}
    found = prober.probe_each(points, motions, **some)
    once = prober.probe_each(points, motions, **some, one_per_place=True)
    assert found.count.sum() == len(found.probe) == len(found.triangle) > len(once.triangle) > 30
    touched = prober.probe_any(points, motions, **some)
    assert touched.shape == (40, 5)
    np.testing.assert_array_equal(touched.ravel(), found.count > 0)
    rays = np.concatenate([points, motions], axis=2).reshape(-1, 6)
    for i, ray in enumerate(rays):
        part = slice(found.offsets[i], found.offsets[i + 1])
        if i < 2:
            assert found.count[i] == 0
            continue
        one = prober.probe_all(ray[:3], ray[3:], **some)
        np.testing.assert_array_equal(found.records[part], one.records)
        # In the octahedron all rounded distances at one place are equal.
        _, first = np.unique(one.distance.round(12), return_index=True)
        part = slice(once.offsets[i], once.offsets[i + 1])
        np.testing.assert_array_equal(once.triangle[part], one.triangle[first])
    assert repr(once) == f"<TouchLists: 200 probes, {len(once.triangle)} touches>"
    line = prober.probe_each([0.1, 0.2, -5], [0, 0, 1], faces="back")
    assert line.distance == pytest.approx([5.7])
    assert prober.probe_any([0.1, 0.2, 5], [0, 0, 1])
    wrong: Any
    for wrong in ({"extent": "curve"}, {"faces": "none"}, {"min_distance": -1}):
        with pytest.raises(ValueError, match=r"no extent|no faces|least distance"):
            prober.probe_each([0, 0, -5], [0, 0, 1], **wrong)
        with pytest.raises(ValueError, match=r"no extent|no faces|least distance"):
            prober.probe_any([0, 0, -5], [0, 0, 1], **wrong)
    bare = meshwalk.Prober(octahedron)
    for ask in (bare.probe_each, bare.probe_any):
        with pytest.raises(ValueError, match="boxes"):
            ask([0, 0, -5], [0, 0, 1])


def test_inside(octahedron: meshwalk.Surface) -> None:
    points = np.array([[[0, 0, 0], [1, 0, 0]], [[1, 1, 1], [np.nan, 0, 0]]])
    side = meshwalk.SurfaceSide
    expected = [[side.INSIDE, side.ON], [side.OUTSIDE, side.BAD]]
    assert meshwalk.Prober(octahedron, boxes=True).inside(points).tolist() == expected
    with pytest.raises(ValueError, match="boxes"):
        meshwalk.Prober(octahedron).inside(points)
    sheet = meshwalk.Surface(OCTAHEDRON, FACETS[:5])
    with pytest.raises(meshwalk.InputError):
        meshwalk.Prober(sheet, boxes=True).inside(points)


def test_probes(octahedron: meshwalk.Surface) -> None:
    prober = meshwalk.Prober(octahedron, boxes=True)
    points = np.array([[0.1, 0.2, 5], [5, 5, 5], [np.nan, 0, 0]])
    for certain in (False, True):
        touch = prober.probe(points, [0, 0, -1], certain=certain)
        assert touch.triangle.tolist() == [0, -1, -1]
        assert touch.state[0] == TouchState.HIT
        assert touch.state[1] == (TouchState.NONE if certain else TouchState.LIMIT)
        assert touch.state[2] == TouchState.BAD
        assert touch.distance[0] == pytest.approx(4.3)
        assert touch.weights[0].sum() == pytest.approx(1)
        assert touch.where[0] == Where.INSIDE
    near = prober.probe(points, np.full((3, 3), [0, 0, -1]), 2, certain=True)
    assert near.state[0] == TouchState.NONE
    assert prober.probe(np.empty((0, 3)), [0, 0, 1]).shape == (0,)
    with pytest.raises(ValueError, match=r"motions must .* points, \(3,\), not \(2,\)"):
        prober.probe(points, [[0, 0, 1], [0, 0, 1]])
    with pytest.raises(ValueError, match="box"):
        meshwalk.Prober(octahedron).probe(points, [0, 0, 1], certain=True)
    with pytest.raises(ValueError, match="there is no start 'nowhere'"):
        prober.probe(points, [0, 0, 1], start="nowhere")  # type: ignore[arg-type]


def test_nearest(octahedron: meshwalk.Surface) -> None:
    prober = meshwalk.Prober(octahedron, boxes=True)
    near = prober.nearest([[[3, 0, 0], [0, -4, 0]]], max_distance=2.5)
    assert near.shape == (1, 2)
    assert near.triangle.tolist() == [[0, -1]]
    np.testing.assert_array_equal(near.point[0, 0], [1, 0, 0])
    np.testing.assert_array_equal(near.weights[0, 0], [1, 0, 0])
    assert repr(near) == "<NearestPoints: 1 of 2>"
    with pytest.raises(ValueError, match="box"):
        meshwalk.Prober(octahedron).nearest([0, 0, 0])
    with pytest.raises(ValueError, match="distance"):
        prober.nearest([0, 0, 0], -1)


def test_descriptions_and_checks(octahedron: meshwalk.Surface) -> None:
    info = octahedron.describe()
    assert info.closed
    assert info.oriented
    assert info.euler == 2
    assert info.volume == pytest.approx(4 / 3)
    assert octahedron.check().valid
    turned = [FACETS[0][::-1], *FACETS[1:]]
    assert meshwalk.Surface(OCTAHEDRON, turned).check().defects[0].triangle == 0
    with pytest.raises(meshwalk.InputError) as raised:
        meshwalk.Surface(OCTAHEDRON, [[0, 1, 1]])
    assert raised.value.defect is not None
    with pytest.raises(ValueError, match=r"points must have the shape \(n, 3\)"):
        meshwalk.Surface([[0, 0]], FACETS)


def test_pickle(octahedron: meshwalk.Surface) -> None:
    octahedron.move([[0, 0, 3]], vertices=[4])
    star, prober = pickle.loads(
        pickle.dumps((meshwalk.Star(octahedron), meshwalk.Prober(octahedron, boxes=True)))
    )
    assert star.surface is prober.surface
    assert star.locate([1, 1, 1]).triangle == 0
    assert prober.nearest([0, 0, 5]).distance == 2


def test_lives() -> None:
    surface = meshwalk.Surface(OCTAHEDRON, FACETS)
    gone = weakref.ref(surface)
    star = meshwalk.Star(surface)
    prober = meshwalk.Prober(surface)
    del star
    gc.collect()
    assert list(surface._kept) == [prober]
    del surface
    gc.collect()
    assert gone() is prober.surface
    del prober
    gc.collect()
    assert gone() is None


def test_queries_wait_for_moves(random: np.random.Generator) -> None:
    lonlat, triangles = _globe(60, 40)
    surface = meshwalk.Surface.from_lonlat(lonlat, triangles)
    star = meshwalk.Star(surface)
    prober = meshwalk.Prober(surface, boxes=True)
    points = surface.points
    queries = random.normal(size=(2000, 3))
    expected = star.locate(queries).triangle
    wrong: list[str] = []
    done = threading.Event()

    def ask() -> None:
        while not done.is_set():
            if (star.locate(queries).triangle != expected).any():
                wrong.append("star")
            if not (prober.nearest(queries[:50]).distance < 10).all():
                wrong.append("prober")

    askers = [threading.Thread(target=ask) for _ in range(2)]
    for asker in askers:
        asker.start()
    for scale in (2.0, 0.5, 1.0, 4.0) * 3:
        surface.move(points * scale)
    done.set()
    for asker in askers:
        asker.join()
    assert not wrong


def test_all_touches_while_vertices_move() -> None:
    """Floors one above the other, half of which step aside: a probe meets all of them or half."""
    floors = 400
    floor = np.array([[0.0, 0, 0], [4, 0, 0], [0, 4, 0]])
    below = np.vstack([floor + np.array([0, 0, k]) for k in range(floors)])
    aside = below + np.where(np.arange(3 * floors) // 3 % 2, 9, 0)[:, None] * [1, 0, 0]
    surface = meshwalk.Surface(below, np.arange(3 * floors).reshape(-1, 3))
    prober = meshwalk.Prober(surface, boxes=True)
    done = threading.Event()

    def move() -> None:
        while not done.is_set():
            surface._move(aside, None, [prober], -1, 1)
            surface._move(below, None, [prober], -1, 1)

    mover = threading.Thread(target=move)
    mover.start()
    try:
        for _ in range(300):
            touches = prober.probe_all([1, 1, -1], [0, 0, 1], extent="ray")
            assert len(touches.triangle) in (floors // 2, floors)
            assert (touches.state == TouchState.HIT).all()
            assert (touches.distance == touches.triangle + 1.0).all()
            assert (np.diff(touches.triangle) > 0).all()
    finally:
        done.set()
        mover.join()
