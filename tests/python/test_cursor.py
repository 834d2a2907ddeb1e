"""Points that move: hints and cursors give the answers of a search without them."""

from __future__ import annotations

import pickle
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

import meshwalk

if TYPE_CHECKING:
    from numpy.typing import NDArray


def _walk(random: np.random.Generator) -> list[NDArray[np.float64]]:
    """Places of forty points at ten times; some leave the mesh and come back."""
    start = random.uniform(0, 11, (40, 2))
    return [start + random.normal(0, 0.4 * k, (40, 2)) for k in range(10)]


@pytest.mark.parametrize("kind", ["i1", "i4", "u4", "i8", "u8", ">i4"])
def test_hints_do_not_change_answers(
    kind: str, scattered: meshwalk.Mesh, random: np.random.Generator
) -> None:
    locator = meshwalk.Locator(scattered)
    for xy in _walk(random):
        want = locator.locate(xy)
        info = np.iinfo(kind)
        hints = random.integers(info.min, info.max, 40, info.dtype.newbyteorder("="), endpoint=True)
        given = hints.astype(kind)
        for start in ("auto", "last", "sample"):
            hit = locator.locate(xy, hints=given, start=start)
            assert hit.records.tobytes() == want.records.tobytes()
        np.testing.assert_array_equal(given, hints)  # never written
        assert locator.locate(xy, hints=want.triangle).records.tobytes() == want.records.tobytes()


def test_hints_of_any_layout(square: meshwalk.Mesh) -> None:
    locator = meshwalk.Locator(square)
    xy = np.array([[[3.0, 1], [1, 3]], [[9, 9], [2, 2]]])
    want = locator.locate(xy).triangle
    hints: Any
    masked = np.ma.masked_less(want, 1)
    for hints in (want, want.tolist(), np.asfortranarray(want), want[::-1], masked):
        np.testing.assert_array_equal(locator.locate(xy, hints=hints).triangle, want)
    with pytest.raises(ValueError, match=r"hints must have the shape of the points, \(2, 2\)"):
        locator.locate(xy, hints=want.ravel())
    with pytest.raises(TypeError, match="hints must be integers, not float64"):
        locator.locate(xy, hints=want.astype(float))
    with pytest.raises(ValueError, match="hints: setting an array element"):
        locator.locate(xy, hints=[[0, 1], [2]])


def test_a_cursor_follows(scattered: meshwalk.Mesh, random: np.random.Generator) -> None:
    locator = meshwalk.Locator(scattered, border=True)
    cursor = meshwalk.Cursor(locator)
    assert cursor.triangle.shape == (0,)
    assert repr(cursor).startswith("<Cursor: any points in <Locator of")
    last = np.full(40, -1)
    for xy in _walk(random):
        want, hit = locator.locate(xy), cursor.locate(xy)
        assert hit.records.tobytes() == want.records.tobytes()
        last = np.where(want.triangle >= 0, want.triangle, last)
        np.testing.assert_array_equal(cursor.triangle, last)
    near = cursor.locate(xy, tolerance=5, threads=1)
    assert near.records.tobytes() == locator.locate(xy, 5).records.tobytes()


def test_fewer_and_more_points(square: meshwalk.Mesh) -> None:
    cursor = meshwalk.Cursor(meshwalk.Locator(square), [0, 0, -1])
    xy = np.array([[3.0, 1], [1, 3], [9, 9]])
    assert list(cursor.locate(xy).triangle) == [0, 1, -1]
    with pytest.raises(ValueError, match=r"shape \(3, 2\), as the last time, not \(2, 2\)"):
        cursor.locate(xy[:2])
    cursor.triangle = cursor.triangle[:2]
    assert list(cursor.locate(xy[1::-1]).triangle) == [1, 0]
    cursor.triangle = np.append(cursor.triangle, [-1, 7])
    assert list(cursor.locate(xy[[0, 1, 2, 0]]).triangle) == [0, 1, -1, 0]
    cursor.triangle[:] = 5  # a copy
    assert list(cursor.triangle) == [0, 1, -1, 0]
    again = pickle.loads(pickle.dumps(cursor))
    np.testing.assert_array_equal(again.triangle, cursor.triangle)
    with pytest.raises(TypeError, match="triangle must be integers"):
        cursor.triangle = np.array([0.5])
    assert list(cursor.triangle) == [0, 1, -1, 0]
    with pytest.raises(ValueError, match="made with border=True"):
        cursor.locate(xy, tolerance=1)
    with pytest.raises(ValueError, match=r"threads must be from 0 to 2\*\*32 - 1, not -1"):
        cursor.locate(xy[[0, 1, 2, 0]], threads=-1)
    assert cursor.locator.locate([], hints=[]).shape == (0,)
    with pytest.raises(TypeError, match=r"a meshwalk\.Locator or Editor, not Mesh"):
        meshwalk.Cursor(square)  # type: ignore[arg-type]


def test_a_cursor_of_an_editor(random: np.random.Generator) -> None:
    editor = meshwalk.Editor(meshwalk.delaunay(random.uniform(size=(50, 2))), undo=3)
    cursor = meshwalk.Cursor(editor)
    xy = random.uniform(size=(30, 2))
    for k in range(20):
        editor.insert(*random.uniform(size=2))
        if k % 3 == 2:
            editor.undo()
        xy += random.normal(0, 0.02, xy.shape)
        want = editor.locate(xy)
        hit = cursor.locate(xy)
        assert isinstance(hit, meshwalk.EditorLocations)
        assert hit.records.tobytes() == want.records.tobytes()
        hinted = editor.locate(xy, hints=cursor.triangle)
        assert hinted.records.tobytes() == want.records.tobytes()
    with pytest.raises(ValueError, match="an editor has no tolerance"):
        cursor.locate(xy, tolerance=1)
