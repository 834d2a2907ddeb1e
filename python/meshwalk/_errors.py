"""Exceptions: what was wrong, and where."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from meshwalk._check import Defect


class Error(Exception):
    """What all exceptions of meshwalk's own are derived from.

    Attributes
    ----------
    triangle, vertex : int or None
        The triangle and the vertex concerned, numbered as yours; None where that does not apply.
    line : int or None
        The line of a text file, from 1.
    segments : tuple of int or None
        Two segments that cross, of `constrained_delaunay`.
    defect : Defect or None
        The defect of the mesh, where it has one.

    Notes
    -----
    Beside these, a wrong argument is a ``TypeError`` or ``ValueError``, a file that cannot be
    opened or written an ``OSError``, and too little memory a ``MemoryError``.
    """

    triangle: int | None = None
    vertex: int | None = None
    line: int | None = None
    segments: tuple[int, int] | None = None
    defect: Defect | None = None


class InputError(Error, ValueError):
    """The data is wrong: a mesh with a defect, a malformed file, points on one line."""


class LimitError(Error, ValueError):
    """The data is larger than the library can hold, such as more than 2**30 triangles."""
