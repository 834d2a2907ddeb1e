"""Where segments leave the mesh, and segments that are chosen among many."""

from __future__ import annotations

import pickle

import numpy as np
import pytest

import meshwalk


def test_exits_are_where_the_first_gap_begins(
    ring: meshwalk.Mesh, random: np.random.Generator
) -> None:
    locator = meshwalk.Locator(ring)
    a, b = random.uniform(-1, 7, (2, 500, 2))
    pieces = locator.segment(a, b)
    out = pieces.exits()
    assert out.point.shape == (500, 2)
    for i in range(500):
        own = slice(pieces.offsets[i], pieces.offsets[i + 1])
        stops = list(pieces.stop[own])
        gaps = [*pieces.gap[own][1:], bool(stops) and stops[-1] < 1]
        first = next((k for k, gap in enumerate(gaps[: len(stops)]) if gap), None)
        if first is None:
            assert out.triangle[i] == out.edge[i] == out.hole[i] == -1
            assert np.isnan(out.parameter[i])
            assert np.isnan(out.point[i]).all()
            continue
        assert out.parameter[i] == stops[first]
        assert out.triangle[i] == pieces.triangle[own][first]
        assert ring.neighbours[out.triangle[i], out.edge[i]] == -1
        just_after = out.parameter[i] + 1e-9
        beyond = locator.locate_one(*(a[i] + just_after * (b[i] - a[i])))
        assert not beyond.inside
        assert out.hole[i] == beyond.hole
    there = out.triangle >= 0
    assert {-1, 0} == set(out.hole[there])
    along = a + out.parameter[:, None] * (b - a)
    np.testing.assert_allclose(out.point[there], along[there], atol=1e-12)
    again = pickle.loads(pickle.dumps(pieces)).exits()  # without its locator
    for one, two in zip(out, again, strict=True):
        np.testing.assert_array_equal(one, two)


def test_what_does_not_leave(square: meshwalk.Mesh) -> None:
    locator = meshwalk.Locator(square)
    begin = np.array([[1, 1], [1, 1], [4, 1], [9, 9], [1, 1], [1, 1], [np.nan, 1]])
    end = [[3, 1], [4, 1], [9, 1], [8, 9], [1, 1], [5, 5], [9, 9]]
    out = locator.segment(begin, end).exits()
    assert out.triangle.tolist() == [-1, -1, -1, -1, -1, 0, -1]
    assert out.edge[5] == -1, "at a vertex"
    assert out.point[5].tolist() == [4, 4]
    assert out.parameter[5] == 0.75
    empty = locator.segment(np.empty((0, 2)), np.empty((0, 2))).exits()
    assert [len(array) for array in empty] == [0] * 5
    assert locator.segment([8, 8], [9, 9]).exits().triangle.tolist() == [-1]


def test_segments_are_chosen(ring: meshwalk.Mesh, random: np.random.Generator) -> None:
    a, b = random.uniform(-1, 7, (2, 50, 2))
    pieces = meshwalk.Locator(ring).segment(a, b)
    assert len(pieces) == 50
    points, values = pieces.points(), random.uniform(size=ring.vertex_count)
    mask = random.uniform(size=50) < 0.5
    for index in (mask, slice(3, 40, 7), [5, 5, 2], 7, -1):
        part = pieces[index]
        numbers = np.atleast_1d(np.arange(50)[index])
        np.testing.assert_array_equal(part.ends, pieces.ends[numbers])
        own = np.concatenate([np.flatnonzero(pieces.segment == i) for i in numbers])
        np.testing.assert_array_equal(part.triangle, pieces.triangle[own])
        np.testing.assert_array_equal(part.points(), points[own])
        np.testing.assert_array_equal(part.interpolate(values), pieces.interpolate(values)[own])
    assert repr(pieces[:0]) == "<Segments: 0 segments, 0 pieces>"
    with pytest.raises(IndexError):
        pieces[50]


def test_fields_by_name(square: meshwalk.Mesh) -> None:
    mesh = meshwalk.Mesh(square.points, square.triangles, {"h": [1, 2, 3, 4]})
    pieces = meshwalk.Locator(mesh).segment([1, 2], [9, 2])
    np.testing.assert_array_equal(pieces.interpolate("h"), pieces.interpolate([1, 2, 3, 4]))
    with pytest.raises(KeyError, match="the mesh has no field 'z'; it has h"):
        pieces.interpolate("z")


def test_long_work_is_watched_and_cancelled(
    square: meshwalk.Mesh, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("meshwalk._segments._BLOCK", 3)
    pieces = meshwalk.Locator(square).segment([1, 2], np.full((5, 2), [9, 2]))
    seen: list[tuple[str, float]] = []
    whole = pieces.interpolate(square.points, progress=lambda *report: seen.append(report))
    np.testing.assert_array_equal(whole, pieces.points())
    assert seen == [("interpolating", part) for part in (0, 0.3, 0.6, 0.9, 1)]

    def stop(stage: str, done: float) -> None:
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        pieces.points(progress=stop)
