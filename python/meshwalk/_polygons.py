"""Which polygons contain a point."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from meshwalk import _arrays, _core

if TYPE_CHECKING:
    import os
    from collections.abc import Iterable, Sequence
    from typing import Self

    from numpy.typing import ArrayLike, NDArray

    from meshwalk._core import Progress

    Numbers = NDArray[np.int32] | NDArray[np.int64]


class PolygonHits:
    """The polygons that contain points: the answer of `Polygons.at`.

    Attributes
    ----------
    shape : tuple of int
        The shape of the points, without their coordinates.
    offsets : ndarray of int64, shape (number of points + 1,)
        Point i, in the order of ``ravel``, has the members from ``offsets[i]`` up to
        ``offsets[i + 1]``, which is not its, of `polygon` and `border`.
    polygon : ndarray of int
        The polygons, ascending for each point.
    border : ndarray of bool
        True where the point is on the polygon's border, not inside.
    """

    __slots__ = ("border", "offsets", "polygon", "shape")

    def __init__(
        self,
        shape: tuple[int, ...],
        offsets: NDArray[np.int64],
        polygon: Numbers,
        border: NDArray[np.bool_],
    ) -> None:
        self.shape = shape
        self.offsets = _arrays.frozen(offsets)
        self.polygon = _arrays.frozen(polygon)
        self.border = _arrays.frozen(border)

    @property
    def count(self) -> NDArray[np.int64]:
        """How many polygons contain each point: a new array each time."""
        return np.diff(self.offsets).reshape(self.shape)

    @property
    def first(self) -> Numbers:
        """The lowest-numbered polygon of each point, -1 for none: a new array each time."""
        out = np.full(len(self.offsets) - 1, -1, self.polygon.dtype)
        there = self.offsets[1:] > self.offsets[:-1]
        out[there] = self.polygon[self.offsets[:-1][there]]
        return out.reshape(self.shape)

    @property
    def point(self) -> NDArray[np.int64]:
        """The point of each member of `polygon`, in the order of ``ravel``: a new array."""
        return np.repeat(np.arange(len(self.offsets) - 1), self.offsets[1:] - self.offsets[:-1])

    def __repr__(self) -> str:
        inside = int(np.count_nonzero(self.offsets[1:] > self.offsets[:-1]))
        return (
            f"<PolygonHits: {len(self.offsets) - 1} points, {inside} in polygons,"
            f" {len(self.polygon)} pairs>"
        )

    def __reduce__(self) -> tuple[Any, ...]:
        return PolygonHits, (self.shape, self.offsets, self.polygon, self.border)


class Polygons:
    """Polygons prepared to tell exactly which of them contain a point.

    A point is inside a polygon if every way from it to infinity crosses the polygon's segments an
    odd number of times. So rings may come in any order and direction, a hole is a ring in another,
    and polygons may overlap. Nothing is rounded.

    Parameters
    ----------
    points : array_like, shape (n, 2)
        The corners.
    segments : array_like of int, shape (k, 2)
        The two points of each segment.
    polygons : array_like of int, shape (k,)
        The polygon that each segment bounds; -1: none.
    threads : int, optional
        How many threads prepare them; 0 lets the library choose.
    progress : callable, optional
        As of `Mesh`.

    Raises
    ------
    InputError
        There is no polygon, or a ring is not closed; a coordinate is NaN or infinite.

    See Also
    --------
    from_rings : of lists of rings.
    read : of a file.

    Notes
    -----
    It pickles with its arrays, and any number of threads may use it.

    Examples
    --------
    >>> import meshwalk
    >>> square = [[0, 0], [4, 0], [4, 4], [0, 4]]
    >>> hole = [[1, 1], [3, 1], [3, 3], [1, 3]]
    >>> parcels = meshwalk.Polygons.from_rings([[square, hole], [[[2, 2], [9, 2], [9, 9]]]])
    >>> parcels
    <Polygons: 2 polygons of 11 points>
    >>> hits = parcels.at([[0.5, 2], [2, 2.5], [5, 3], [3.5, 3], [4, 0]])
    >>> hits.first
    array([ 0, -1,  1,  0,  0], dtype=int32)
    >>> hits.count
    array([1, 0, 1, 2, 1])
    >>> hits.border
    array([False, False, False, False,  True])
    """

    __slots__ = ("__weakref__", "_core", "_given")

    def __init__(
        self,
        points: ArrayLike,
        segments: ArrayLike,
        polygons: ArrayLike,
        threads: int = 0,
        *,
        progress: Progress | None = None,
    ) -> None:
        rows, _ = _arrays.vertices(points, "points", (2,))
        ends = _arrays.indices(segments, "segments", (None, 2), len(rows))
        owner = _arrays.indices(polygons, "polygons", (len(ends),), None)
        self._core = _core.polygons_from_rings(rows, ends, owner, threads, progress)
        own: NDArray[np.float64] = np.array(rows)
        self._given = own, ends, owner

    @classmethod
    def from_rings(cls, polygons: Iterable[Sequence[ArrayLike]], threads: int = 0) -> Self:
        """Make polygons of their rings.

        Parameters
        ----------
        polygons : iterable of sequences of array_like, each of shape (n, 2)
            The rings of each polygon, such as the ``coordinates`` of a polygon of GeoJSON. The last
            point of a ring may repeat the first one or not.
        threads : int, optional
            As of `Polygons`.
        """
        points, segments, owner = [np.empty((0, 2))], [np.empty((0, 2), np.int64)], []
        total = 0
        for number, rings in enumerate(polygons):
            for k, ring in enumerate(rings):
                rows, _ = _arrays.vertices(ring, f"polygons[{number}][{k}]", (2,))
                first = np.arange(len(rows)) + total
                points.append(rows)
                segments.append(np.column_stack([first, np.roll(first, -1)]))
                owner += [number] * len(rows)
                total += len(rows)
        numbers = np.array(owner, np.int64)
        return cls(np.concatenate(points), np.concatenate(segments), numbers, threads)

    @classmethod
    def read(cls, path: str | os.PathLike[str], threads: int = 0) -> Self:
        """Read polygons from GeoJSON or ``.poly``: those that `read_constraints` numbers."""
        from meshwalk._files import read_constraints

        given = read_constraints(path)
        return cls(given.points[:, :2], given.segments, given.polygons, threads)

    def at(
        self, xy: ArrayLike, threads: int = 0, *, progress: Progress | None = None
    ) -> PolygonHits:
        """List the polygons that contain points, or have them on their border.

        Parameters
        ----------
        xy : array_like, shape (..., 2)
            The points. One that is NaN, infinite or masked is in no polygon.
        threads : int, optional
            How many threads locate them; 0 lets the library choose. The answers are the same.
        progress : callable, optional
            As of `Locator.locate`.

        Returns
        -------
        PolygonHits
        """
        points, shape = _arrays.queries(xy, "xy", 2)
        offsets, found = self._core.at(points, threads, progress)
        pairs = np.frombuffer(found, np.uint32).reshape(-1, 2)
        polygon = _arrays.numbers(np.ascontiguousarray(pairs[:, 0]))
        return PolygonHits(shape, np.frombuffer(offsets, np.int64), polygon, pairs[:, 1] != 0)

    @property
    def crossing(self) -> Numbers:
        """The polygons whose own segments cross, or run along each other; ascending."""
        return _arrays.numbers(np.frombuffer(self._core.crossing(), np.uint32))

    @property
    def nbytes(self) -> int:
        """Memory in bytes, that of the triangulation not counted."""
        return self._core.describe()[2]

    def __len__(self) -> int:
        """Number of polygons."""
        return self._core.describe()[0]

    def __repr__(self) -> str:
        polygons, points, _ = self._core.describe()
        return f"<Polygons: {polygons} polygons of {points} points>"

    def __reduce__(self) -> tuple[Any, ...]:
        points, ends, owner = self._given
        numbers = owner.astype(np.int64)
        numbers[owner == np.iinfo(np.uint32).max] = -1
        return type(self), (points, ends, numbers)
