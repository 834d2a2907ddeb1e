"""Arrays of users: every type and layout that holds the numbers, and a place for what does not."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import meshwalk

POINTS = np.array([[0, 0], [4, 0], [4, 4], [0, 4]], float)
TRIANGLES = np.array([[0, 1, 2], [0, 2, 3]])
XY = np.array([[3, 1], [1, 3], [9, 9]], float)
ANSWERS = [0, 1, -1]


def _locate(xy: Any) -> list[int]:
    hit = meshwalk.Locator(meshwalk.Mesh(POINTS, TRIANGLES)).locate(xy)
    return hit.triangle.tolist()  # type: ignore[no-any-return]


@pytest.mark.parametrize("kind", ["f2", "f4", "f8", "g", ">f8", ">f4", "i1", "u2", "i8", "u8"])
def test_types_of_points(kind: str) -> None:
    mesh = meshwalk.Mesh(POINTS.astype(kind), TRIANGLES)
    np.testing.assert_array_equal(mesh.points, POINTS)
    assert _locate(XY.astype(kind)) == ANSWERS


@pytest.mark.parametrize(
    "kind", ["i1", "u1", "i2", "u2", "i4", "u4", "i8", "u8", "q", "Q", ">i4", ">u8"]
)
def test_types_of_triangles(kind: str) -> None:
    mesh = meshwalk.Mesh(POINTS, TRIANGLES.astype(kind))
    np.testing.assert_array_equal(mesh.triangles, TRIANGLES)


def _layouts(array: Any) -> list[Any]:
    wide = np.full((2 * len(array), 2 * array.shape[1] + 1), 7, array.dtype)
    wide[::2, 1::2] = array
    backwards = np.ascontiguousarray(array[::-1, ::-1])[::-1, ::-1]
    raw = np.zeros(array.nbytes + 1, np.uint8)[1:].view(array.dtype).reshape(array.shape)
    raw[:] = array
    frozen = array.copy()
    frozen.flags.writeable = False
    beside = np.full((len(array), array.shape[1] + 3), 7, array.dtype)
    beside[:, : array.shape[1]] = array
    return [
        np.asfortranarray(array),
        wide[::2, 1::2],
        backwards,
        raw,
        frozen,
        beside[:, : array.shape[1]],
        array.tolist(),
        tuple(map(tuple, array.tolist())),
        np.ma.masked_array(array),
    ]


def test_layouts() -> None:
    for points in _layouts(POINTS):
        for triangles in _layouts(TRIANGLES):
            mesh = meshwalk.Mesh(points, triangles)
            np.testing.assert_array_equal(mesh.points, POINTS)
            np.testing.assert_array_equal(mesh.triangles, TRIANGLES)
    for xy in _layouts(XY):
        assert _locate(xy) == ANSWERS
    assert _locate(np.broadcast_to(XY[0], (3, 2))) == [0, 0, 0]
    assert _locate(np.broadcast_to(1.0, (3, 2))) == [0, 0, 0]


def test_slices_of_tables_are_not_copied() -> None:
    from meshwalk import _arrays

    table = np.zeros((5, 4))
    for rows in (table[:, :2], table[::2, 1:3], table[1:2, 2:]):
        assert np.shares_memory(_arrays.queries(rows, "xy", 2)[0], table)
    for triangles in (np.zeros((4, 3), kind) for kind in ("i4", "u4", "i8")):
        assert np.shares_memory(_arrays.triangles(triangles, "t", 99), triangles)


@pytest.mark.parametrize(
    ("points", "error", "message"),
    [
        (np.zeros((4, 4)), ValueError, r"points must .* \(n, 2\) or \(n, 3\), not \(4, 4\)"),
        (np.zeros(4), ValueError, r"points must have the shape .* not \(4,\)"),
        (np.zeros((2, 2, 2)), ValueError, r"points must have the shape .* not \(2, 2, 2\)"),
        (5, ValueError, r"points must have the shape .* not \(\)"),
        ([[0, 0], [1]], ValueError, "points: .*inhomogeneous"),
        (np.zeros((4, 2), object), TypeError, "points must be real numbers, not object"),
        (np.zeros((4, 2), complex), TypeError, "points must be real numbers, not complex128"),
        (np.zeros((4, 2), bool), TypeError, "points must be real numbers, not bool"),
        ([["0", "1"]], TypeError, "points must be real numbers, not <U1"),
        (None, TypeError, "points must be real numbers, not object"),
        (np.zeros((4, 2), "M8[s]"), TypeError, "points must be real numbers"),
        ([[0, 0], [0, 2**53 + 1]], ValueError, r"points\[1, 1\] does not fit a double"),
        (np.array([[0, 2**64 - 1]], "u8"), ValueError, r"points\[0, 1\] does not fit a double"),
        (np.array([[0, 2**63 - 1]], "i8"), ValueError, r"points\[0, 1\] does not fit a double"),
        (np.array([[0, 1 + 2**-60]], "g") + np.longdouble(2) ** -60, ValueError, r"points\[0, 1\]"),
        (np.ma.masked_array(POINTS, POINTS == 4), ValueError, r"points\[1, 0\] is masked"),
    ],
)
def test_points_that_are_refused(points: Any, error: type[Exception], message: str) -> None:
    with pytest.raises(error, match=message):
        meshwalk.Mesh(points, TRIANGLES)
    with pytest.raises(error, match=message):
        meshwalk.delaunay(points)


@pytest.mark.parametrize(
    ("triangles", "error", "message"),
    [
        (np.zeros((2, 4), int), ValueError, r"triangles must .* \(m, 3\), not \(2, 4\)"),
        (np.zeros(3, int), ValueError, r"triangles must .* \(m, 3\), not \(3,\)"),
        (TRIANGLES.astype(float), TypeError, "triangles must be integers, not float64"),
        (TRIANGLES.astype(object), TypeError, "triangles must be integers, not object"),
        (TRIANGLES.astype(bool), TypeError, "triangles must be integers, not bool"),
        ([[0, 1, 2], [0, 2]], ValueError, "triangles: .*inhomogeneous"),
        (np.array([[0, 1, 2**64 - 1]], "u8"), ValueError, r"triangles\[0, 2\] .* no vertex"),
        (np.ma.masked_equal(TRIANGLES, 3), ValueError, r"triangles\[1, 2\] is masked"),
        (np.array([[0, 1, -1]], "i1"), meshwalk.InputError, "triangle 0: vertex -1 does not"),
        (np.array([[0, 1, -(2**63)]]), meshwalk.InputError, "triangle 0"),
        (np.array([[0, 1, 2**32 - 1]]), meshwalk.InputError, "triangle 0"),
        (np.array([[0, 1, 2**32]]), meshwalk.InputError, "triangle 0"),
        (np.array([[0, 1, 2**32 - 1]], "u4"), meshwalk.InputError, "triangle 0"),
        (np.array([[0, 1, 4]]), meshwalk.InputError, "vertex 4 does .* are 4, numbered from 0$"),
        (TRIANGLES + 1, meshwalk.InputError, "these seem to be numbered from 1"),
        (np.broadcast_to(TRIANGLES[0], (2**31, 3)), meshwalk.LimitError, "2147483648 rows"),
    ],
)
def test_triangles_that_are_refused(triangles: Any, error: type[Exception], message: str) -> None:
    with pytest.raises(error, match=message):
        meshwalk.Mesh(POINTS, triangles)


@pytest.mark.parametrize(
    ("xy", "error", "message"),
    [
        (np.zeros((4, 3)), ValueError, r"xy must have .* not \(4, 3\); leave columns out as in xy"),
        (np.zeros((2, 4, 1)), ValueError, r"xy must .* \(\.\.\., 2\), not \(2, 4, 1\)$"),
        (7, ValueError, r"xy must have the shape \(\.\.\., 2\), not \(\)"),
        (np.zeros((4, 2), object), TypeError, "xy must be real numbers, not object"),
        ("here", TypeError, "xy must be real numbers"),
        ([[0, 0], [0, 2**53 + 1]], ValueError, r"xy\[1, 1\] does not fit a double"),
    ],
)
def test_queries_that_are_refused(xy: Any, error: type[Exception], message: str) -> None:
    with pytest.raises(error, match=message):
        _locate(xy)


def test_empty_and_missing_queries() -> None:
    assert _locate([]) == []
    assert _locate(np.empty((0, 2))) == []
    masked = np.ma.masked_array(XY, np.array([[0, 1], [0, 0], [0, 0]], bool))
    assert _locate(masked) == [-1, 1, -1]
    assert masked.data[0].tolist() == [3, 1]


def test_empty_meshes() -> None:
    mesh = meshwalk.Mesh(np.empty((0, 2)), [])
    assert mesh.points.shape == (0, 2)
    assert mesh.triangles.shape == (0, 3)
    assert mesh.check().valid
    with pytest.raises(meshwalk.InputError):
        meshwalk.Mesh(np.empty((0, 2)), [[0, 1, 2]])


@pytest.mark.parametrize("threads", [-1, 2**40, 1.5, "two"])
def test_threads_that_are_refused(threads: Any) -> None:
    with pytest.raises((TypeError, OverflowError, ValueError)):
        meshwalk.Mesh(POINTS, TRIANGLES, threads=threads)


def test_fields_that_are_refused() -> None:
    with pytest.raises(ValueError, match=r"fields\['h'\] must have the shape \(4,\), not \(3,\)"):
        meshwalk.Mesh(POINTS, TRIANGLES, {"h": [1, 2, 3]})
    with pytest.raises(TypeError, match=r"fields\['h'\] must be real numbers"):
        meshwalk.Mesh(POINTS, TRIANGLES, {"h": ["a", "b", "c", "d"]})
