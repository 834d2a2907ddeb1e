"""Where a point lies."""

from __future__ import annotations

import enum


class Where(enum.IntEnum):
    """Where a point lies: the members of ``Locations.where``.

    Attributes
    ----------
    INSIDE : 0
        Inside the triangle.
    EDGE : 1
        On an edge of the triangle.
    VERTEX : 2
        At a vertex of the triangle.
    OUTSIDE : 3
        In no triangle and no hole.
    HOLE : 4
        In a hole: a bounded part of the plane that the mesh surrounds.
    NEAR : 5
        Outside or in a hole, but within the tolerance: the triangle, the weights and interpolated
        values are those of the nearest place of the mesh, yet `Locations.inside` is False.
    BAD : 6
        The point has a coordinate that is NaN or infinite.

    Examples
    --------
    >>> import meshwalk
    >>> meshwalk.Where(1)
    <Where.EDGE: 1>
    >>> meshwalk.Where.EDGE == 1
    True
    """

    INSIDE = 0
    EDGE = 1
    VERTEX = 2
    OUTSIDE = 3
    HOLE = 4
    NEAR = 5
    BAD = 6
