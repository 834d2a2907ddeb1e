"""Answers cannot be written, and answers from elsewhere are looked at: nothing crashes."""

from __future__ import annotations

import pickle
from typing import Any

import numpy as np
import pytest

import meshwalk


@pytest.fixture
def cube() -> meshwalk.Surface:
    corners = [[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]
    sides = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]]
    return meshwalk.Surface(corners, [t for a, b, c, d in sides for t in ([a, b, c], [a, c, d])])


def arrays_of(answer: Any) -> dict[str, np.ndarray[Any, Any]]:
    names = "triangle where weights hole local records distance state offsets polygon border ends"
    found = {name: getattr(answer, name, None) for name in (*names.split(), "start", "at", "tile")}
    return {name: array for name, array in found.items() if isinstance(array, np.ndarray)}


def test_no_answer_can_be_written(square: meshwalk.Mesh, cube: meshwalk.Surface) -> None:
    locator = meshwalk.Locator(square)
    hit = locator.locate([[3, 1], [1, 3]])
    borrowed = meshwalk.BorrowedMesh(square.points, square.triangles, [[-1, 1, -1], [-1, -1, 0]])
    polygons = meshwalk.Polygons.from_rings([[[[0, 0], [4, 0], [0, 4]]]])
    prober = meshwalk.Prober(cube, boxes=True)
    answers = [
        hit,
        hit[:1],
        hit[hit.inside],
        hit[0],
        pickle.loads(pickle.dumps(hit)),
        meshwalk.Locations(square, hit.records.copy()),
        meshwalk.Cursor(locator).locate([3, 1]),
        meshwalk.Editor(square).locate([[3, 1]]),
        borrowed.locate([[3, 1]]),
        locator.segment([1, 2], [9, 2]),
        polygons.at([[1, 1]]),
        meshwalk.visible(square, [1, 1, 2], [[3, 3, 2]], heights=np.zeros(4)),
        meshwalk.Star(cube).locate([[1, 2, 3]]),
        prober.probe([[0, 0, 5]], [0, 0, -1], certain=True),
        prober.probe_each([[0, 0, 5]], [0, 0, -1]),
        prober.nearest([[0, 0, 5]]),
    ]
    for answer in answers:
        arrays = arrays_of(answer)
        assert len(arrays) >= 3, answer
        for name, array in arrays.items():
            assert not array.flags.writeable, (answer, name)
    with pytest.raises(ValueError, match="read-only"):
        hit.triangle[0] = 10**6
    triangle = hit.triangle
    with pytest.raises(ValueError, match="read-only"):
        triangle += 1
    with pytest.raises(ValueError, match="WRITEABLE flag to True"):
        triangle.flags.writeable = True
    with pytest.raises(ValueError, match="WRITEABLE flag to True"):
        hit.records.flags.writeable = True
    with pytest.raises(AttributeError):
        hit.records = np.zeros(3)  # type: ignore[misc]
    with pytest.raises(AttributeError):
        hit.mesh = square  # type: ignore[misc]
    assert np.array(hit).flags.writeable
    assert hit.triangle.copy().flags.writeable


def test_answers_of_another_mesh_are_refused(
    square: meshwalk.Mesh, random: np.random.Generator
) -> None:
    large = meshwalk.delaunay(random.random((1000, 2)))
    hit = meshwalk.Locator(large).locate(random.uniform(0.2, 0.8, (10, 2)))
    assert hit.triangle.min() >= 2
    first = int(hit.triangle[0])
    message = rf"records\[0\] names triangle {first}; the mesh has 2 triangles: are these answers"
    with pytest.raises(ValueError, match=message):
        meshwalk.Locations(square, hit.records)
    records = np.zeros((2, 3), hit.records.dtype)
    records["triangle"][1, 2] = -7
    with pytest.raises(ValueError, match=r"records\[1, 2\] names triangle -7; the mesh has 2"):
        meshwalk.Locations(square, records)

    class Forged:
        """What a pickle may hold."""

        def __reduce__(self) -> tuple[Any, ...]:
            return meshwalk.Locations, (square, hit.records)

    with pytest.raises(ValueError, match=message):
        pickle.loads(pickle.dumps(Forged()))


def test_records_are_copied_before_they_are_checked(square: meshwalk.Mesh) -> None:
    records = meshwalk.Locator(square).locate([[3, 1], [1, 3]]).records.copy()
    hit = meshwalk.Locations(square, records)
    records["triangle"] = 10**6
    assert hit.interpolate([0.0, 1, 2, 3]).tolist() == pytest.approx([1, 2.5], abs=2)
    assert hit.triangle.tolist() == [0, 1]


def test_probes_of_another_surface_are_refused(cube: meshwalk.Surface) -> None:
    prober = meshwalk.Prober(cube, boxes=True)
    floor = meshwalk.Surface([[0, 0, 0], [4, 0, 0], [0, 4, 0]], [[0, 1, 2]])
    for found in (
        prober.probe([[0.1, 0.3, 5]], [0, 0, -1], certain=True),
        prober.nearest([[0.1, 0.3, 5]]),
    ):
        assert found.triangle[0] > 0
        with pytest.raises(ValueError, match="triangle"):
            type(found)(floor, found.records).interpolate([1.0, 2, 3])
