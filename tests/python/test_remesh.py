"""Star-shaped polyhedra sampled anew, their distances, and values at answers in space."""

from __future__ import annotations

from fractions import Fraction
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

import meshwalk

CORNERS = [[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]]
FACETS = [
    *([0, 2, 4], [2, 1, 4], [1, 3, 4], [3, 0, 4]),
    *([2, 0, 5], [1, 2, 5], [3, 1, 5], [0, 3, 5]),
]


@pytest.fixture
def asteroid(random: np.random.Generator) -> meshwalk.Surface:
    """An icosphere with bumps about (3, -2, 1), with a field and one that has a gap."""
    star = meshwalk.Star(meshwalk.Surface(CORNERS, FACETS))
    ball = star.remesh(3).surface
    radii = 1 + 0.3 * random.random(len(ball.points))
    directions = ball.points / np.linalg.norm(ball.points, axis=1)[:, None]
    points = directions * radii[:, None] + [3, -2, 1]
    gap = np.arange(len(points), dtype=float)
    gap[5] = np.nan
    fields = {"linear": points @ [1.0, 2.0, -3.0] + 7, "gap": gap}
    return meshwalk.Surface(points, ball.triangles, fields)


def _meeting(surface: meshwalk.Surface, facet: int, centre: Any, point: Any) -> list[Fraction]:
    """Where the ray meets the plane of the facet, exactly."""
    a, b, c = ([Fraction(float(v)) for v in p] for p in surface.points[surface.triangles[facet]])
    o, q = ([Fraction(float(v)) for v in p] for p in (centre, point))
    pairs = ((a, b), (a, c), (o, a), (o, q))
    u, v, w, d = ([y - x for x, y in zip(*pair, strict=True)] for pair in pairs)
    n = [u[i - 2] * v[i - 1] - u[i - 1] * v[i - 2] for i in range(3)]
    above, below = (sum((x * y for x, y in zip(n, e, strict=True)), Fraction(0)) for e in (w, d))
    t = above / below
    return [x + t * y for x, y in zip(o, d, strict=True)]


def test_projections_are_rounded_once(
    asteroid: meshwalk.Surface, random: np.random.Generator
) -> None:
    centre = (3.0, -2.0, 1.0)
    star = meshwalk.Star(asteroid, centre)
    points = random.normal(size=(100, 3)) + centre
    found = star.project(points.reshape(10, 10, 3))
    assert found.shape == (10, 10, 3)
    for point, meeting, facet in zip(
        points, found.reshape(-1, 3), star.locate(points).triangle, strict=True
    ):
        exact = _meeting(asteroid, int(facet), centre, point)
        assert [float(x) for x in exact] == meeting.tolist()
    assert np.isnan(star.project([centre, (np.inf, 0, 0)])).all()


def test_icospheres(asteroid: meshwalk.Surface) -> None:
    star = meshwalk.Star(asteroid, (3, -2, 1))
    made, hit = star.remesh(4)
    assert (made.vertex_count, made.triangle_count) == (2562, 5120)
    assert made.check().valid
    assert hit.shape == (2562,)
    np.testing.assert_allclose(made.fields["linear"], made.points @ [1, 2, -3] + 7, atol=1e-13)
    np.testing.assert_array_equal(made.fields["gap"], hit.interpolate("gap"))
    touched = np.isin(asteroid.triangles[hit.triangle], 5) & (hit.weights != 0)
    np.testing.assert_array_equal(np.isnan(made.fields["gap"]), touched.any(1))
    again, _ = star.remesh(4, threads=3)
    np.testing.assert_array_equal(made.points, again.points)
    meshwalk.Star(made, (3, -2, 1))


def test_onto_another_mesh(asteroid: meshwalk.Surface) -> None:
    star = meshwalk.Star(asteroid, (3, -2, 1))
    same, _ = star.remesh(onto=asteroid)
    np.testing.assert_array_equal(same.points, asteroid.points)
    np.testing.assert_array_equal(same.fields["linear"], asteroid.fields["linear"])
    octahedron = meshwalk.Surface(np.add(CORNERS, [3, -2, 1]), FACETS)
    coarse, hit = star.remesh(onto=octahedron)
    np.testing.assert_array_equal(coarse.triangles, FACETS)
    assert hit.shape == (6,)
    with pytest.raises(meshwalk.InputError):
        star.remesh(onto=meshwalk.Surface(CORNERS, FACETS))


def test_unused_vertices_stay() -> None:
    star = meshwalk.Star(meshwalk.Surface(CORNERS, FACETS, {"a": range(6)}))
    other = meshwalk.Surface([*(np.multiply(CORNERS, 2)), (0, 0, 0)], FACETS)
    made, hit = star.remesh(onto=other)
    np.testing.assert_array_equal(made.points, [*CORNERS, (0, 0, 0)])
    assert hit.triangle[6] == -1
    assert np.isnan(made.fields["a"][6])


def test_arguments(asteroid: meshwalk.Surface) -> None:
    star = meshwalk.Star(asteroid, (3, -2, 1))
    with pytest.raises(TypeError, match="either a level or a mesh"):
        star.remesh()
    with pytest.raises(TypeError, match="either a level or a mesh"):
        star.remesh(2, onto=asteroid)
    with pytest.raises(ValueError, match="level 13"):
        star.remesh(13)
    with pytest.raises(ValueError, match="boxes"):
        meshwalk.Prober(asteroid).deviation(asteroid)


def test_deviation_both_ways() -> None:
    box = meshwalk.Surface(np.multiply(CORNERS, 2), FACETS)
    small = meshwalk.Surface(CORNERS, FACETS)
    there = meshwalk.Prober(box, boxes=True).deviation(small)
    back = meshwalk.Prober(small, boxes=True).deviation(box)
    assert there.largest == pytest.approx(1 / 3**0.5)  # between parallel facets
    assert there.mean == pytest.approx(1 / 3**0.5)
    assert back.largest == 1  # at a corner
    assert sorted(np.abs(back.point)) == [0, 0, 2]
    assert back.nearest == tuple(np.divide(back.point, 2))
    assert back.at_most >= back.largest
    assert back.area == pytest.approx(16 * 3**0.5)
    assert meshwalk.Prober(box, boxes=True).deviation(small, threads=3) == there


@pytest.mark.parametrize("dtype", [np.float64, np.float32])
def test_values_at_answers(
    asteroid: meshwalk.Surface, random: np.random.Generator, dtype: type
) -> None:
    """Rays, probes and nearest points: each sum as NumPy has it, and as a matrix."""
    prober = meshwalk.Prober(asteroid, boxes=True)
    star = meshwalk.Star(asteroid, (3, -2, 1))
    points = random.normal(size=(8, 25, 3)) * 1.5 + (3, -2, 1)
    values: NDArray[Any] = random.random((asteroid.vertex_count, 3)).astype(dtype)
    values[7] = np.nan
    answers: list[Any] = [
        star.locate(points),
        prober.probe(points, (0, 0, 1), certain=True),
        prober.nearest(points, 0.8),
    ]
    for hit in answers:
        got = hit.interpolate(values)
        there = hit.triangle >= 0
        assert got.shape == (8, 25, 3)
        assert got.dtype == dtype
        want = _sums(hit, asteroid, values)
        np.testing.assert_array_equal(got, want)
        by_field = hit.interpolate(np.asfortranarray(values))
        np.testing.assert_array_equal(by_field, want)
        weights = meshwalk.Operator(hit)
        assert weights.shape == (200, asteroid.vertex_count)
        np.testing.assert_array_equal(weights.apply(values), want)
        matrix = hit.operator()
        product = (matrix @ np.nan_to_num(values.astype(float))).reshape(8, 25, 3)
        clean = _sums(hit, asteroid, np.nan_to_num(values.astype(float)))
        np.testing.assert_allclose(product[there], clean[there], rtol=1e-12)
        np.testing.assert_allclose(hit.interpolate("linear")[there].min(), _linear(hit, asteroid))


def _sums(hit: Any, surface: meshwalk.Surface, values: NDArray[Any]) -> NDArray[Any]:
    out = np.full((*hit.shape, values.shape[1]), np.nan)
    there = hit.triangle >= 0
    corners, weights = surface.triangles[hit.triangle[there]], hit.weights[there]
    total = np.zeros((len(weights), values.shape[1]))
    for k in range(3):
        used = weights[:, k] != 0
        total[used] += weights[used, k, None] * values[corners[used, k]].astype(float)
    out[there] = total
    return out.astype(values.dtype)


def _linear(hit: Any, surface: meshwalk.Surface) -> float:
    there = hit.triangle >= 0
    corners = surface.points[surface.triangles[hit.triangle[there]]]
    places = (hit.weights[there][..., None] * corners).sum(1)
    return float((places @ [1, 2, -3] + 7).min())
