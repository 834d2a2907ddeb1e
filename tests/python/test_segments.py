"""Segments: pieces that are exact, and what is made of them."""

from __future__ import annotations

import numpy as np
import pytest

import meshwalk


def test_pieces_are_where_points_are(scattered: meshwalk.Mesh, random: np.random.Generator) -> None:
    locator = meshwalk.Locator(scattered)
    a, b = random.uniform(-2, 14, (2, 300, 2))
    pieces = locator.segment(a, b)
    middle = (pieces.start + pieces.stop)[:, None] / 2
    at = a[pieces.segment] * (1 - middle) + b[pieces.segment] * middle
    long = pieces.stop - pieces.start > 1e-9
    np.testing.assert_array_equal(locator.locate(at).triangle[long], pieces.triangle[long])
    # What no piece covers is outside.
    t = random.uniform(0, 1, 300)
    inside = locator.locate(a + t[:, None] * (b - a)).inside
    covered = (pieces.start <= t[pieces.segment]) & (t[pieces.segment] <= pieces.stop)
    np.testing.assert_array_equal(np.bincount(pieces.segment[covered], minlength=300) > 0, inside)
    same = locator.segment(a, b, threads=1)
    np.testing.assert_array_equal(same.records, pieces.records)
    np.testing.assert_array_equal(same.offsets, pieces.offsets)


def test_values_are_linear(scattered: meshwalk.Mesh, random: np.random.Generator) -> None:
    a, b = random.uniform(0, 12, (2, 100, 2))
    pieces = meshwalk.Locator(scattered).segment(a, b)
    points = pieces.points()
    np.testing.assert_allclose(pieces.interpolate(scattered.points), points, atol=1e-9)
    values = random.uniform(0, 1, (scattered.vertex_count, 3))
    z = pieces.interpolate(values)
    assert z.shape == (len(pieces.records), 2, 3)
    meets = (pieces.segment[1:] == pieces.segment[:-1]) & ~pieces.gap[1:]
    assert meets.any()
    np.testing.assert_array_equal(z[1:, 0][meets], z[:-1, 1][meets])
    np.testing.assert_array_equal(points[1:, 0][meets], points[:-1, 1][meets])


def test_shapes_and_points(square: meshwalk.Mesh) -> None:
    locator = meshwalk.Locator(square)
    assert repr(locator.segment(np.empty((0, 2)), np.empty((0, 2)))) == (
        "<Segments: 0 segments, 0 pieces>"
    )
    fan = locator.segment([1, 1], np.full((2, 3, 2), 2))
    assert len(fan.offsets) == 7
    nan, inf = np.nan, np.inf
    bad = locator.segment(np.array([[nan, 1.0], [1, 1]]), np.array([[1.0, 1], [1, inf]]))
    assert bad.offsets.tolist() == [0, 0, 0]
    point = locator.segment([1, 1], [1, 1])
    assert point.start.tolist() == point.stop.tolist() == [0]
    with pytest.raises(ValueError, match="broadcast"):
        locator.segment(np.zeros((2, 2)), np.zeros((3, 2)))
    with pytest.raises(ValueError, match="must have the shape"):
        locator.segment([1, 2, 3], [1, 2])


def test_open_holes_are_refused(ring: meshwalk.Mesh) -> None:
    with pytest.raises(ValueError, match="fills pockets and holes"):
        meshwalk.Locator(ring, fill="no").segment([0, 0], [1, 1])
    through = meshwalk.Locator(ring).segment([0, 3], [6, 3])
    assert through.gap.sum() == 1
