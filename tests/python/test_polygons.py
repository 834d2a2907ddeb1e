"""Which polygons contain a point."""

from __future__ import annotations

import pickle
from fractions import Fraction
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import meshwalk


def inside(ring: list[list[float]], x: float, y: float) -> str:
    """Decide in fractions where a point lies: even-odd, and the border apart."""
    p = Fraction(x), Fraction(y)
    odd = False
    for a, b in zip(ring, ring[1:] + ring[:1], strict=True):
        (ax, ay), (bx, by) = ((Fraction(v) for v in corner) for corner in (a, b))
        turn = (bx - ax) * (p[1] - ay) - (by - ay) * (p[0] - ax)
        if turn == 0 and min(ax, bx) <= p[0] <= max(ax, bx) and min(ay, by) <= p[1] <= max(ay, by):
            return "border"
        if (ay > p[1]) != (by > p[1]) and (turn > 0) == (by > ay):
            odd = not odd
    return "inside" if odd else "outside"


def test_against_fractions(random: np.random.Generator) -> None:
    rings: list[list[list[float]]] = [
        random.integers(0, 12, (int(random.integers(3, 9)), 2)).astype(float).tolist()
        for _ in range(12)
    ]
    parcels = meshwalk.Polygons.from_rings([[ring] for ring in rings])
    xy = np.concatenate([random.integers(0, 12, (60, 2)), random.uniform(0, 12, (60, 2))])
    hits = parcels.at(xy.reshape(4, 30, 2))
    assert hits.count.shape == hits.first.shape == (4, 30)
    for i, (x, y) in enumerate(xy.tolist()):
        where = [inside(ring, x, y) for ring in rings]
        got = slice(hits.offsets[i], hits.offsets[i + 1])
        want = [k for k, place in enumerate(where) if place != "outside"]
        assert hits.polygon[got].tolist() == want
        assert hits.border[got].tolist() == [where[k] == "border" for k in want]
        assert hits.first.ravel()[i] == (want[0] if want else -1)
        assert hits.point[got].tolist() == [i] * len(want)
    for threads in (1, 2):
        np.testing.assert_array_equal(parcels.at(xy, threads).polygon, hits.polygon)


def test_life_and_files(tmp_path: Path) -> None:
    square = [[0, 0], [6, 0], [6, 6], [0, 6], [0, 0]]  # closed twice
    parcels = meshwalk.Polygons.from_rings([[square], [[[2, 2], [3, 2], [3, 3]]]])
    back = pickle.loads(pickle.dumps(parcels))
    assert repr(back) == repr(parcels)
    assert len(back) == 2
    xy = np.array([[2.5, 2.25], [np.nan, 1], [9, 9]])
    np.testing.assert_array_equal(back.at(xy).polygon, [0, 1])
    hits = pickle.loads(pickle.dumps(parcels.at(xy)))
    assert repr(hits) == "<PolygonHits: 3 points, 1 in polygons, 2 pairs>"
    assert hits.count.tolist() == [2, 0, 0]
    assert parcels.at(np.zeros((0, 2))).first.shape == (0,)
    assert parcels.crossing.tolist() == []
    assert meshwalk.Polygons.from_rings([[[[0, 0], [4, 4], [4, 0], [0, 4]]]]).crossing.tolist() == [
        0
    ]
    name = tmp_path / "parcels.geojson"
    name.write_text(f'{{"type": "Polygon", "coordinates": [{square}]}}')
    try:
        assert meshwalk.Polygons.read(name).at([1, 1]).first == 0
    except meshwalk.InputError as error:
        if "Jansson" not in str(error):
            raise


@pytest.mark.parametrize(
    ("given", "error", "text"),
    [
        (([[0, 0], [1, 0], [0, 1]], [[0, 1], [1, 2]], [0, 0]), meshwalk.InputError, "closed"),
        (([[0, 0], [1, 0], [0, 1]], [[0, 1], [1, 3]], [0, 0]), ValueError, "segments"),
        (([[0, 0], [1, 0], [0, 1]], [[0, 1], [1, 2]], [0]), ValueError, "polygons must have"),
        (
            ([[0, 0], [1, 0], [0, np.inf]], [[0, 1], [1, 2], [2, 0]], [0] * 3),
            meshwalk.InputError,
            "finite",
        ),
        (([[0, 0], [1, 0], [0, 1]], [[0, 1]], [-1]), meshwalk.InputError, "polygon"),
        ((np.ma.array(np.zeros((3, 2)), mask=True), [[0, 1]], [0]), ValueError, "masked"),
        ((np.zeros((3, 2), object), [[0, 1]], [0]), TypeError, "real numbers"),
    ],
)
def test_what_is_refused(given: Any, error: type[Exception], text: str) -> None:
    with pytest.raises(error, match=text):
        meshwalk.Polygons(*given)
