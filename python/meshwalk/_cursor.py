"""Points that move and are located again and again."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from meshwalk import _arrays
from meshwalk._editor import Editor
from meshwalk._locations import LOCATION, Locations
from meshwalk._locator import Locator

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

_NONE = np.iinfo(np.uint32).max


class Cursor:
    """Locates points that move, such as particles: each search begins where the last one ended.

    It remembers the last triangle of each point, in 4 bytes. The answers are those of
    `Locator.locate`; they come sooner where points move by an edge or less.

    Parameters
    ----------
    locator : Locator or Editor
        In whose mesh the points are located. Through the edits of an editor a cursor stays good.
    triangle : array_like of int, optional
        Where the first searches begin, -1 for anywhere; its shape is that of the points. By
        default the first call of `locate` tells how many points there are.

    Notes
    -----
    One thread at a time may use a cursor; a locator serves any number of them.

    Examples
    --------
    Two particles in a current, by the midpoint rule; one of them leaves the mesh:

    >>> import meshwalk, numpy as np
    >>> mesh = meshwalk.delaunay([[0, 0], [8, 0], [8, 4], [0, 4]])
    >>> current = np.array([[1.0, 0], [1, 0], [2, 0], [2, 0]])  # at the vertices
    >>> cursor = meshwalk.Cursor(meshwalk.Locator(mesh))
    >>> xy = np.array([[1.0, 1], [1, 3]])
    >>> for step in range(4):
    ...     middle = xy + 0.5 * cursor.locate(xy).interpolate(current)
    ...     xy += cursor.locate(middle).interpolate(current)
    >>> xy
    array([[6., 1.],
           [8., 3.]])
    >>> before, xy = xy, xy + [1, 0]
    >>> hit = cursor.locate(xy)
    >>> hit
    <Locations: 2 points; 1 inside, 1 outside>

    Where did it leave the mesh?

    >>> gone = hit.triangle < 0
    >>> way = cursor.locator.segment(before[gone], xy[gone])
    >>> way.exits().point  # none: it was on the border, and has gone outwards
    array([[nan, nan]])
    >>> way = cursor.locator.segment(before[gone] - [1, 0], xy[gone])
    >>> out = way.exits()
    >>> out.point, out.triangle, out.hole
    (array([[8., 3.]]), array([1], dtype=int32), array([-1], dtype=int32))

    See Also
    --------
    Segments.exits : where segments leave the mesh, and how a particle goes on from there.
    """

    __slots__ = ("_hints", "locator")

    def __init__(self, locator: Locator | Editor, triangle: ArrayLike | None = None) -> None:
        if not isinstance(locator, (Locator, Editor)):
            raise TypeError(
                f"locator must be a meshwalk.Locator or Editor, not {type(locator).__name__}"
            )
        self.locator = locator
        self._hints: NDArray[np.uint32] | None = None
        if triangle is not None:
            self.triangle = triangle

    @property
    def triangle(self) -> NDArray[np.int32]:
        """The triangle where each point was last, -1 for those that were in none so far.

        A point that has left the mesh keeps its last one. Assign an array of another length to go
        on with fewer or more points: ``cursor.triangle = cursor.triangle[afloat]``.
        """
        hints = np.empty(0, np.uint32) if self._hints is None else self._hints
        return hints.view(np.int32).copy()

    @triangle.setter
    def triangle(self, numbers: ArrayLike) -> None:
        self._hints = _arrays.hints(numbers, "triangle", None)

    def locate(self, xy: ArrayLike, tolerance: float = 0, threads: int = 0) -> Locations:
        """Find the triangles that contain the points now.

        Parameters
        ----------
        xy : array_like, shape (..., 2)
            As many points as the last time, in the same order; see `Locator.locate`.
        tolerance : float, optional
            As of `Locator.locate`; not with an editor.
        threads : int, optional
            How many threads answer; 0 lets the library choose.

        Returns
        -------
        Locations
            Of an editor, EditorLocations.

        Raises
        ------
        ValueError
            There are more or fewer points than the last time; assign to `triangle` first.
        """
        if isinstance(self.locator, Locator):
            self.locator._check_tolerance(tolerance)
        elif tolerance:
            raise ValueError("an editor has no tolerance")
        points, shape = _arrays.queries(xy, "xy", 2)
        if self._hints is None:
            self._hints = np.full(shape, _NONE, np.uint32)
        if shape != self._hints.shape:
            last = (*self._hints.shape, 2)
            raise ValueError(
                f"xy must have the shape {last}, as the last time, not {(*shape, 2)};"
                " assign to the cursor's triangle to go on with other points"
            )
        if isinstance(self.locator, Editor):
            return self.locator._locate_rows(points, self._hints, shape, threads, None)
        records = np.empty(len(points), LOCATION)
        self.locator._locate(
            points, records, self._hints, "auto", "auto", tolerance, 0, threads, None
        )
        return Locations._of(self.locator.mesh, records.reshape(shape))

    def __repr__(self) -> str:
        count = "any" if self._hints is None else str(self._hints.size)
        return f"<Cursor: {count} points in {self.locator!r}>"

    def __reduce__(self) -> tuple[Any, ...]:
        return Cursor, (self.locator, None if self._hints is None else self.triangle)
