"""Meshes made of points."""

from __future__ import annotations

import warnings
from typing import TYPE_CHECKING, Literal

import numpy as np

from meshwalk import _arrays, _core
from meshwalk._mesh import Mesh

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

    from meshwalk._core import Progress

_KEEPS = {"auto": 0, "hull": 1, "inside": 2}


class DuplicateWarning(UserWarning):
    """Points have the same coordinates as earlier ones, and are in no triangle."""


class HoleWarning(UserWarning):
    """A point of a hole removes nothing."""


class OptimumWarning(UserWarning):
    """The triangulation is a local optimum only."""


def _warn(duplicates: int, duplicate_of: NDArray[np.uint32]) -> None:
    if duplicates:
        first = int(np.argmax(duplicate_of != np.iinfo(np.uint32).max))
        warnings.warn(
            f"{duplicates} of {len(duplicate_of)} points have the coordinates of an earlier one, "
            f"the first of them point {first}, of point {duplicate_of[first]}",
            DuplicateWarning,
            stacklevel=3,
        )


def delaunay(points: ArrayLike, threads: int = 0, *, progress: Progress | None = None) -> Mesh:
    """Delaunay triangulation of points: exact, and the same for any number of threads.

    Parameters
    ----------
    points : array_like, shape (n, 2) or (n, 3)
        x, y of each point. A third column becomes the field ``"z"``.
    threads : int, optional
        How many threads work on it; 0 lets the library choose.
    progress : callable, optional
        Called now and then with what is being done (str) and how much of it is done (from 0
        to 1), at most 300 times. An exception in it ends the call, as Ctrl-C does.

    Returns
    -------
    Mesh
        Vertex i is point i; triangles are counter-clockwise. A point with the coordinates of an
        earlier one is in no triangle.

    Raises
    ------
    InputError
        Fewer than three different points, all on one line, or a coordinate that is not finite.

    Warns
    -----
    DuplicateWarning
        Points have equal coordinates: the values of the first one count.

    References
    ----------
    Incremental insertion in random rounds along a Hilbert curve [1]_, in patches that are merged
    [2]_.

    .. [1] Amenta, Choi, Rote: Incremental constructions con BRIO, 2003.
    .. [2] Guibas, Stolfi: Primitives for the manipulation of general subdivisions, 1985.

    Examples
    --------
    >>> import meshwalk
    >>> meshwalk.delaunay([[0, 0, 7], [4, 0, 8], [0, 4, 9]])
    <Mesh: 3 vertices, 1 triangles, fields: z>
    """
    rows, width = _arrays.vertices(points, "points", (2, 3))
    duplicate_of = np.empty(len(rows), np.uint32)
    mesh, duplicates = _core.delaunay(Mesh, rows[:, :2], duplicate_of, threads, progress)
    mesh._set_fields(rows[:, 2] if width == 3 else None, None)
    _warn(duplicates, duplicate_of)
    return mesh


def triangulate(
    points: ArrayLike,
    kind: Literal["delaunay", "greedy", "min-weight", "min-max-angle", "regular"] = "delaunay",
    limit: int = 0,
    threads: int = 0,
    *,
    weights: ArrayLike | None = None,
    progress: Progress | None = None,
) -> Mesh:
    """Triangulation of points of any kind that the library has.

    Parameters
    ----------
    points : array_like, shape (n, 2) or (n, 3)
        x, y of each point. A third column becomes the field ``"z"``.
    kind : {"delaunay", "greedy", "min-weight", "min-max-angle", "regular"}, optional
        Which one: without a point in the circle of a triangle; of the shortest edge that crosses
        none, again and again; of the least sum of edge lengths; of the least largest angle;
        regular, or weighted Delaunay.
    limit : int, optional
        How far the optimum is sought: for ``"min-weight"`` in faces of so many corners, for
        ``"min-max-angle"`` for so many points. 0 ends after about half a minute.
    threads : int, optional
        For the Delaunay triangulation that each kind begins with; 0 lets the library choose.
    weights : array_like, shape (n,), optional
        For ``"regular"``: the weight of each point, such as the square of the radius of a circle
        round it. Points that others outweigh are hidden: vertices of no triangle.
    progress : callable, optional
        Called now and then with what is being done (str) and how much of it is done (from 0
        to 1), at most 300 times. An exception in it ends the call, as Ctrl-C does.

    Returns
    -------
    Mesh
        As of `delaunay`.

    Raises
    ------
    InputError
        As of `delaunay`.

    Warns
    -----
    DuplicateWarning
        Points have equal coordinates.
    OptimumWarning
        The optimum was not found within the limit: no exchange of one diagonal is better.

    Examples
    --------
    >>> import meshwalk
    >>> points = [[0, 0], [4, 0], [4, 3], [1, 3], [2, 1]]
    >>> len(meshwalk.triangulate(points, "min-weight"))
    4
    """
    rows, width = _arrays.vertices(points, "points", (2, 3))
    duplicate_of = np.empty(len(rows), np.uint32)
    if weights is not None and kind != "regular":
        raise ValueError("weights need the kind 'regular'")
    heavy = None if weights is None else _arrays.field(weights, "weights", len(rows))
    mesh, duplicates, optimal = _core.triangulate(
        Mesh, rows[:, :2], duplicate_of, kind, heavy, limit, threads, progress
    )
    mesh._set_fields(rows[:, 2] if width == 3 else None, None)
    _warn(duplicates, duplicate_of)
    if not optimal:
        warnings.warn(
            f"the {kind} triangulation is a local optimum only; a higher limit seeks on",
            OptimumWarning,
            stacklevel=2,
        )
    return mesh


def constrained_delaunay(
    points: ArrayLike,
    segments: ArrayLike,
    holes: ArrayLike | None = None,
    polygons: ArrayLike | None = None,
    *,
    keep: Literal["auto", "hull", "inside"] = "auto",
    split: bool = False,
    threads: int = 0,
    progress: Progress | None = None,
) -> Mesh:
    """Constrained Delaunay triangulation: every segment is an edge, or a chain of edges.

    Parameters
    ----------
    points : array_like, shape (n, 2) or (n, 3)
        x, y of each point. A third column becomes the field ``"z"``.
    segments : array_like of int, shape (k, 2)
        Numbers of the two points of each segment.
    holes : array_like, shape (h, 2), optional
        A point in each part, bounded by segments, that is to be removed. Default: no part is.
    polygons : array_like of int, shape (k,), optional
        For each segment the number of the polygon whose ring it belongs to, -1 for a line. Inside
        of a polygon is what an odd number of its segments parts from infinity, so rings may come in
        any order and direction: outlines, holes, islands in holes.
    keep : {"auto", "hull", "inside"}, optional
        The triangles that stay: all of the convex hull; or those inside of a polygon, or, without
        polygons, those that segments part from the outside. By default the inside, if there are
        polygons or holes, else the hull.
    split : bool, optional
        Where segments cross, put a vertex there, rounded, and split them. It comes after the
        points, and has NaN as ``"z"``.
    threads : int, optional
        For the Delaunay triangulation of the points; 0 lets the library choose.
    progress : callable, optional
        Called now and then with what is being done (str) and how much of it is done (from 0
        to 1), at most 300 times. An exception in it ends the call, as Ctrl-C does.

    Returns
    -------
    Mesh
        As of `delaunay`; its `constrained_edges` tell the edges that are parts of segments, its
        `edge_segments` of which.

    Raises
    ------
    InputError
        As of `delaunay`; segments cross, and `split` is not set: then the exception's `segments`
        tell which; the rings of a polygon are not closed; nothing is left, since the outer ring is
        open, or the point of a hole lies on a segment or in a ring that is open.
    ValueError
        A segment names no point.

    Warns
    -----
    DuplicateWarning
        Points have equal coordinates.
    HoleWarning
        A point of `holes` is outside, or in a part that is removed already.

    References
    ----------
    .. [1] Chew: Constrained Delaunay triangulations, 1989.

    Examples
    --------
    A square with a square hole:

    >>> import meshwalk
    >>> points = [[0, 0], [6, 0], [6, 6], [0, 6], [2, 2], [4, 2], [4, 4], [2, 4]]
    >>> rings = [[0, 1], [1, 2], [2, 3], [3, 0], [4, 5], [5, 6], [6, 7], [7, 4]]
    >>> mesh = meshwalk.constrained_delaunay(points, rings, holes=[[3, 3]])
    >>> mesh.describe().area
    32.0
    >>> meshwalk.Locator(mesh).locate_one(3, 3)
    <Location: in hole 0>
    """
    if keep not in _KEEPS:
        raise ValueError(f"keep must be one of {', '.join(_KEEPS)}, not {keep!r}")
    rows, width = _arrays.vertices(points, "points", (2, 3))
    ends = _arrays.indices(segments, "segments", (None, 2), len(rows))
    rings = None if polygons is None else _arrays.indices(polygons, "polygons", (len(ends),), None)
    seeds, kind = _arrays.queries(() if holes is None else holes, "holes", 2)
    if len(kind) > 1:
        raise ValueError(
            f"holes must have the shape (h, 2), a point in each hole, not {(*kind, 2)}; rings of"
            " polygons are segments"
        )
    seeds = np.ascontiguousarray(seeds)
    duplicate_of = np.empty(len(rows), np.uint32)
    mesh, duplicates, edges, edge_segments, idle, first_idle = _core.constrained_delaunay(
        Mesh, rows[:, :2], duplicate_of, ends, rings, seeds, _KEEPS[keep], split, threads, progress
    )
    mesh._set_fields(_heights(rows, mesh.vertex_count) if width == 3 else None, None)
    mesh._set_constraints(
        np.frombuffer(edges, np.uint32).reshape(-1, 2), np.frombuffer(edge_segments, np.uint32)
    )
    _warn(duplicates, duplicate_of)
    if idle:
        more = f", and so do {idle - 1} more" if idle > 1 else ""
        x, y = seeds[first_idle]
        warnings.warn(
            f"holes[{first_idle}] ({x}, {y}) removes nothing{more}: it is outside, or in a part"
            " that is removed already",
            HoleWarning,
            stacklevel=2,
        )
    return mesh


def _heights(rows: NDArray[np.float64], count: int) -> NDArray[np.float64]:
    """The third column, continued by NaN for vertices that were made."""
    heights = np.full(count, np.nan)
    heights[: len(rows)] = rows[:, 2]
    return heights
