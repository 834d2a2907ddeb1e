"""Drop-in for users of shapely: the tree of geometries, exact and fast for points and polygons.

>>> import shapely
>>> from meshwalk.shapely import STRtree
>>> tree = STRtree([shapely.box(0, 0, 4, 4), shapely.box(4, 0, 8, 4)])
>>> tree.query(shapely.points([[1, 1], [4, 2]]), predicate="intersects")
array([[0, 1, 1],
       [0, 0, 1]])

shapely itself has to be installed.
"""

from __future__ import annotations

import threading
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np
import shapely

from meshwalk._errors import InputError
from meshwalk._polygons import Polygons

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

    Numbers = NDArray[np.intp]

__all__ = ["STRtree"]

_POINT, _POLYGON, _MULTIPOLYGON = 0, 3, 6
_ANY, _INSIDE, _BORDER = "any", "inside", "border"
# What a predicate wants of a point and a polygon.
_POINT_TO_POLYGON = {
    "intersects": _ANY,
    "covered_by": _ANY,
    "within": _INSIDE,
    "touches": _BORDER,
}
_POLYGON_TO_POINT = {
    "intersects": _ANY,
    "covers": _ANY,
    "contains": _INSIDE,
    "contains_properly": _INSIDE,
    "touches": _BORDER,
}


def _are(geometries: NDArray[Any], *types: int) -> bool:
    """Tell whether all geometries are of these types or missing, and not all are missing."""
    kinds = shapely.get_type_id(geometries)
    return bool(np.isin(kinds, (*types, -1)).all() and (kinds >= 0).any())


class _Areas:
    """Polygons and multipolygons, prepared for points."""

    def __init__(self, geometries: NDArray[Any]) -> None:
        parts, self._owner = shapely.get_parts(geometries, return_index=True)
        rings, part = shapely.get_rings(parts, return_index=True)
        points, ring = shapely.get_coordinates(rings, return_index=True)
        # The last point of a ring repeats the first one.
        last = np.flatnonzero(np.append(ring[1:] != ring[:-1], True))
        first = np.append(0, last[:-1] + 1)
        after = np.arange(1, len(points) + 1)
        after[last - 1] = first
        kept = np.ones(len(points), bool)
        kept[last] = False
        segments = np.column_stack([np.arange(len(points)), after])[kept]
        self._polygons = Polygons(points, segments, part[ring[kept]])
        self._single = len(parts) == len(geometries) and bool(
            (self._owner == np.arange(len(parts))).all()
        )

    def find(self, points: NDArray[np.float64], numbers: Numbers, what: str) -> Numbers:
        """Pairs of a point's number and an area, in two rows: in order of points, then areas."""
        hits = self._polygons.at(points)
        pairs = np.empty((2, len(hits.polygon)), np.intp)
        pairs[0] = np.repeat(numbers, np.diff(hits.offsets))
        pairs[1] = hits.polygon if self._single else self._owner[hits.polygon]
        border = hits.border
        if not self._single:  # inside of one part is inside of the area
            order = np.lexsort((border, pairs[1], pairs[0]))
            pairs, border = pairs[:, order], border[order]
            new = np.ones(len(border), bool)
            new[1:] = (pairs[:, 1:] != pairs[:, :-1]).any(axis=0)
            pairs, border = pairs[:, new], border[new]
        return pairs if what == _ANY else pairs[:, border == (what == _BORDER)]


_Tree = shapely.STRtree  # also where a program puts the one below in its place


class STRtree(shapely.STRtree):  # type: ignore[misc] # shapely is not typed
    """`shapely.STRtree`, which tells exactly which points are in which polygons.

    Parameters
    ----------
    geoms : sequence of shapely geometries
        The geometries.
    node_capacity : int, optional
        As of `shapely.STRtree`.

    Notes
    -----
    Where all inputs are points and the tree has polygons and multipolygons only, or the other way
    round, `query` answers exactly, by `meshwalk.Polygons`. All else is done by `shapely.STRtree`:
    other geometries, no predicate, ``dwithin``, nearest ones.

    A point inside of one part of a multipolygon is inside of it. In polygons whose rings cross a
    point is inside if every way out crosses the rings an odd number of times.

    Any number of threads may ask one tree. The first question with points takes O(n log n) for n
    corners.

    Examples
    --------
    >>> import shapely
    >>> from meshwalk.shapely import STRtree
    >>> tree = STRtree([shapely.box(0, 0, 4, 4)])
    >>> tree.query(shapely.Point(4, 2), predicate="within")
    array([], dtype=int64)
    """

    def __init__(self, geoms: Any, node_capacity: int = 10) -> None:
        self._lock = threading.Lock()
        self._areas: _Areas | None = None
        self._geometries = np.array(geoms, np.object_)
        self._node_capacity = node_capacity
        self._holds_areas = _are(self.geometries, _POLYGON, _MULTIPOLYGON)
        self._holds_points = not self._holds_areas and _are(self.geometries, _POINT)

    @cached_property
    def _tree(self) -> Any:
        """What `shapely.STRtree` asks: made when something does."""
        return _Tree(self._geometries, self._node_capacity)._tree

    def query(
        self, geometry: Any, predicate: str | None = None, distance: ArrayLike | None = None
    ) -> NDArray[np.intp]:
        """Find all pairs of an input and a geometry of the tree, as `shapely.STRtree.query` does.

        Parameters
        ----------
        geometry : geometry or array_like
            The inputs.
        predicate, distance
            As of `shapely.STRtree.query`.

        Returns
        -------
        ndarray of int, shape (k,) or (2, k)
            The geometries of the tree; of several inputs these first. In order.
        """
        given = np.asarray(geometry)
        inputs = np.atleast_1d(given)
        pairs = None
        if inputs.ndim == 1:
            try:
                pairs = self._points_in_areas(inputs, predicate)
            except InputError:  # such as a coordinate that is not finite
                pairs = None
        if pairs is None:
            found: NDArray[np.intp] = super().query(geometry, predicate, distance)
            return found
        return pairs[1] if given.ndim == 0 else pairs

    def _points_in_areas(self, inputs: NDArray[Any], predicate: str | None) -> Numbers | None:
        """The pairs; None if these are not points and areas."""
        if self._holds_areas and predicate in _POINT_TO_POLYGON and _are(inputs, _POINT):
            areas, what = self._prepared(), _POINT_TO_POLYGON[predicate]
            numbers, points = _coordinates(inputs)
            return areas.find(points, numbers, what)
        if (
            self._holds_points
            and predicate in _POLYGON_TO_POINT
            and _are(inputs, _POLYGON, _MULTIPOLYGON)
        ):
            numbers, points = _coordinates(self.geometries)
            pairs = _Areas(inputs).find(points, numbers, _POLYGON_TO_POINT[predicate])
            found: Numbers = pairs[::-1, np.argsort(pairs[1], kind="stable")]
            return found
        return None

    def _prepared(self) -> _Areas:
        with self._lock:
            if self._areas is None:
                self._areas = _Areas(self.geometries)
            return self._areas

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self), (self.geometries,)


def _coordinates(points: NDArray[Any]) -> tuple[Numbers, NDArray[np.float64]]:
    """Numbers and coordinates of the points that are there and not empty."""
    rows = shapely.get_coordinates(points)
    if len(rows) == len(points):
        return np.arange(len(points)), rows
    rows, index = shapely.get_coordinates(points, return_index=True)
    return np.asarray(index, np.intp), rows
