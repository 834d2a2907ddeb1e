"""Which triangles lie along segments: the pieces that a locator lists."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from meshwalk import _arrays, _core

if TYPE_CHECKING:
    from collections.abc import Iterator

    from numpy.typing import ArrayLike, NDArray

    from meshwalk._core import Progress
    from meshwalk._locator import Locator
    from meshwalk._mesh import Mesh

_BLOCK = 1 << 18
"""Pieces that are worked on at a time: Ctrl-C is looked for in between."""

PIECE = _arrays.record_type(
    _core.PIECE_LAYOUT,
    {
        "start": np.float64,
        "stop": np.float64,
        "triangle": np.int32,
        "start_at": np.uint8,
        "stop_at": np.uint8,
        "along": np.uint8,
        "gap": np.bool_,
    },
)
"""The type of one piece, as the library writes it."""


class Exits(NamedTuple):
    """Where segments leave the mesh for the first time: the answer of `Segments.exits`.

    Each is an array with a row for each segment; a segment that does not leave has NaN and -1. So
    has one that leaves so near its end that the parameter rounds to 1.

    Attributes
    ----------
    parameter : ndarray of float64, shape (n,)
        Where on the segment, from 0 at its beginning to 1 at its end; rounded.
    point : ndarray of float64, shape (n, 2)
        The same place, in the units of the mesh; rounded unless it is a vertex.
    triangle : ndarray of int32, shape (n,)
        The triangle that the segment leaves.
    edge : ndarray of int32, shape (n,)
        The local edge of that triangle which it crosses; -1 where it leaves at a vertex.
    hole : ndarray of int32, shape (n,)
        The hole that it enters; -1 for the outside, and where the gap is a few roundings wide.
    """

    parameter: NDArray[np.float64]
    point: NDArray[np.float64]
    triangle: NDArray[np.int32]
    edge: NDArray[np.int32]
    hole: NDArray[np.int32]


class Segments:
    """The triangles along segments: the answer of `Locator.segment`.

    A piece is a longest part of a segment, of positive length, in one triangle: the one that
    `Locator.locate` finds for each of its points but finitely many. A part along an edge belongs
    to the lower-numbered triangle there, and parts outside the mesh to no piece. A segment that is
    a point has one piece, if it is in the mesh. All of this is exact; the attributes are views of
    the library's own answers, which cannot be written.

    ``len(pieces)`` is the number of segments, and an index chooses among them: ``pieces[3]``,
    ``pieces[10:20]`` and ``pieces[mask]`` have the pieces of these segments only, at no cost but
    theirs.

    Attributes
    ----------
    mesh : Mesh
        The mesh that the segments were followed in.
    ends : ndarray, shape (n, 4)
        The segments: x and y of the beginning, x and y of the end.
    offsets : ndarray of int64, shape (n + 1,)
        Segment i has the pieces from ``offsets[i]`` up to ``offsets[i + 1]``, which is not its.
    records : ndarray
        All pieces, as a structured array.

    Examples
    --------
    >>> import meshwalk
    >>> mesh = meshwalk.Mesh([[0, 0], [4, 0], [4, 4], [0, 4]], [[0, 1, 2], [0, 2, 3]])
    >>> road = [[1, 2], [3, 2], [3, 9]]
    >>> pieces = meshwalk.Locator(mesh).segment(road[:-1], road[1:])
    >>> pieces
    <Segments: 2 segments, 4 pieces>
    >>> pieces.segment
    array([0, 0, 1, 1])
    >>> pieces.triangle
    array([1, 0, 0, 1], dtype=int32)
    >>> pieces[1]
    <Segments: 1 segments, 2 pieces>

    See Also
    --------
    Locator.segment : makes them.
    Cursor : has an example of particles that leave the mesh.
    """

    __slots__ = ("_locator", "ends", "mesh", "offsets", "records")

    def __init__(
        self,
        mesh: Mesh,
        ends: NDArray[np.float64],
        offsets: NDArray[np.int64],
        records: NDArray[Any],
        locator: Locator | None = None,
    ) -> None:
        self.mesh = mesh
        self._locator = locator
        self.ends = _arrays.frozen(ends)
        self.offsets = _arrays.frozen(offsets)
        self.records = _arrays.frozen(records)

    @property
    def segment(self) -> NDArray[np.int64]:
        """The segment of each piece: a new array each time."""
        return np.repeat(np.arange(len(self.offsets) - 1), np.diff(self.offsets))

    @property
    def triangle(self) -> NDArray[np.int32]:
        """The triangle of each piece."""
        return self.records["triangle"]

    @property
    def start(self) -> NDArray[np.float64]:
        """Where each piece begins: the parameter, 0 at the beginning of the segment, 1 at its end.

        Rounded, by less than 2**-40 of itself. Parameters never decrease along a segment, and are
        equal where pieces meet.
        """
        return self.records["start"]

    @property
    def stop(self) -> NDArray[np.float64]:
        """Where each piece ends."""
        return self.records["stop"]

    @property
    def start_at(self) -> NDArray[np.uint8]:
        """Where in its triangle each piece begins.

        0, 1, 2: on that local edge; 3, 4, 5: at local vertex 0, 1, 2; 6: inside, where the segment
        itself begins.
        """
        return self.records["start_at"]

    @property
    def stop_at(self) -> NDArray[np.uint8]:
        """Where in its triangle each piece ends; as `start_at`."""
        return self.records["stop_at"]

    @property
    def along(self) -> NDArray[np.uint8]:
        """The local edge that a piece runs along; 255 for none."""
        return self.records["along"]

    @property
    def gap(self) -> NDArray[np.bool_]:
        """True where the segment is in no triangle just before the piece."""
        return self.records["gap"]

    def points(self, *, progress: Progress | None = None) -> NDArray[np.float64]:
        """Where the pieces begin and end, in the units of the mesh.

        Parameters
        ----------
        progress : callable, optional
            As of `Locator.locate`.

        Returns
        -------
        ndarray, shape (pieces, 2, 2)
            Beginning and end of each piece, x and y of each: the ends of segments and vertices as
            they are, others rounded.

        Notes
        -----
        A rounded point on the border may lie a rounding error outside: `Locator.locate` can answer
        that it is outside or in a hole. What is exact is the piece: its triangle and its edge.

        One thread works on it: a tenth of a microsecond a piece in a small mesh, several times that
        in one larger than the cache. Ctrl-C ends it. For a few segments of many, choose first:
        ``pieces[mask].points()``.
        """
        out = np.empty((len(self.records), 2, 2))
        for block in self._blocks("finding points", progress):
            out[block] = self._weights(block)[1]
        return out

    def interpolate(
        self, values: ArrayLike | str, *, progress: Progress | None = None
    ) -> NDArray[np.float64]:
        """Interpolate values at the vertices, where the pieces begin and end.

        In between they are linear.

        Parameters
        ----------
        values : array_like, shape (n_vertices, ...), or str
            Values at the vertices of the mesh, or the name of one of its fields.
        progress : callable, optional
            As of `Locator.locate`.

        Returns
        -------
        ndarray, shape (pieces, 2, ...)
            At the beginning and the end of each piece; equal, to the last bit, where pieces meet.
            NaN where a vertex with a weight has NaN.

        Notes
        -----
        One thread works on it: some 0.15 microseconds a piece and field in a small mesh, several
        times that in one larger than the cache. Ctrl-C ends it. For a few segments of many, choose
        first: ``pieces[mask].interpolate(values)``.
        """
        if isinstance(values, str):
            values = _arrays.named(self.mesh.fields, values)
        array = _arrays.values(values, "values", self.mesh.vertex_count).astype(float, copy=False)
        corners = self.mesh.triangles
        result = np.zeros((len(self.records), 2, *array.shape[1:]))
        for block in self._blocks("interpolating", progress):
            weights, _ = self._weights(block)
            there = array[corners[self.triangle[block]]]
            for k in range(3):
                weight = weights[:, :, k].reshape(*weights.shape[:2], *(1,) * (array.ndim - 1))
                result[block] += np.where(weight != 0, weight * there[:, None, k], 0)
        return result

    def exits(self) -> Exits:
        """Where each segment leaves the mesh for the first time, and into which hole.

        Returns
        -------
        Exits
            NaN and -1 for a segment that ends before it leaves, and for one that is nowhere in the
            mesh.

        Notes
        -----
        A segment that ends on the border does not leave. A segment that begins on the border and
        goes outwards has no piece, as one that is wholly outside: both have no exit, since the
        first is in the mesh in one point only; tell them apart by ``locate`` of where they begin.

        To restart a particle from where it met the coast, go back a little: take
        ``a + 0.999 * parameter * (b - a)``, which lies in the mesh, instead of the rounded point.

        Examples
        --------
        >>> import meshwalk
        >>> mesh = meshwalk.Mesh([[0, 0], [4, 0], [4, 4], [0, 4]], [[0, 1, 2], [0, 2, 3]])
        >>> way = meshwalk.Locator(mesh).segment([[1, 2], [1, 2]], [[9, 2], [3, 2]])
        >>> out = way.exits()
        >>> out.point
        array([[ 4.,  2.],
               [nan, nan]])
        >>> out.triangle, out.edge, out.hole
        (array([ 0, -1], dtype=int32), array([ 1, -1], dtype=int32), array([-1, -1], dtype=int32))
        """
        segment, last, until = self._first_gaps()
        at = self.stop_at[last].astype(np.int32)
        numbers = np.full((3, len(self)), -1, np.int32)
        out = Exits(np.full(len(self), np.nan), np.full((len(self), 2), np.nan), *numbers)
        out.parameter[segment] = self.stop[last]
        out.point[segment] = self._weights(last)[1][:, 1]
        out.triangle[segment] = self.triangle[last]
        out.edge[segment] = np.where(at < 3, at, -1)
        out.hole[segment] = self._holes(segment, (self.stop[last] + until) / 2)
        return out

    def _first_gaps(self) -> tuple[NDArray[np.intp], NDArray[np.intp], NDArray[np.float64]]:
        """The segments that leave the mesh, the last piece of each before, and where it ends."""
        final = np.zeros(len(self.records), bool)  # of its segment
        final[self.offsets[1:][np.diff(self.offsets) > 0] - 1] = True
        gap = np.append(self.gap[1:], False)[: len(final)]
        place = np.flatnonzero(np.where(final, self.stop < 1, gap))
        segment, first = np.unique(self._segments_of(place), return_index=True)
        long = (self.ends[segment, :2] != self.ends[segment, 2:]).any(axis=1)  # others are a point
        segment, last = segment[long], place[first[long]]
        until = np.ones(len(last))
        until[~final[last]] = self.start[last[~final[last]] + 1]
        return segment, last, until

    def _segments_of(self, pieces: NDArray[np.intp]) -> NDArray[np.intp]:
        return np.searchsorted(self.offsets, pieces, "right") - 1

    def _holes(
        self, segment: NDArray[np.intp], parameter: NDArray[np.float64]
    ) -> NDArray[np.int32]:
        """The holes in which places of segments are, which are in no triangle."""
        if self._locator is None:
            from meshwalk._locator import Locator

            self._locator = Locator(self.mesh, fill="yes")
        a, b = self.ends[segment, :2], self.ends[segment, 2:]
        return self._locator.locate(a + parameter[:, None] * (b - a)).hole

    def _blocks(self, stage: str, progress: Progress | None) -> Iterator[slice]:
        count = len(self.records)
        for first in range(0, count, _BLOCK):
            if progress is not None:
                progress(stage, first / count)
            yield slice(first, first + _BLOCK)
        if progress is not None:
            progress(stage, 1.0)

    def _weights(
        self, chosen: slice | NDArray[np.intp]
    ) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Weights and points of both ends of some pieces."""
        records = _arrays.chosen(self.records, chosen)
        if isinstance(chosen, slice):
            chosen = np.arange(len(self.records))[chosen]
        segment = self._segments_of(chosen).astype(np.int64)
        weights, points = np.empty((len(records), 2, 3)), np.empty((len(records), 2, 2))
        _core.segment_weights(self.mesh, self.ends, segment, records, weights, points)
        return weights, points

    def __len__(self) -> int:
        return len(self.offsets) - 1

    def __getitem__(self, index: Any) -> Segments:
        chosen = np.atleast_1d(np.arange(len(self))[index])
        if chosen.ndim != 1:
            raise IndexError("segments are chosen by a number, a slice, a mask or numbers")
        counts = np.diff(self.offsets)[chosen]
        offsets = np.zeros(len(chosen) + 1, np.int64)
        np.cumsum(counts, out=offsets[1:])
        before = np.repeat(self.offsets[:-1][chosen] - offsets[:-1], counts)
        records = _arrays.chosen(self.records, before + np.arange(offsets[-1]))
        return Segments(self.mesh, self.ends[chosen], offsets, records, self._locator)

    def __repr__(self) -> str:
        return f"<Segments: {len(self)} segments, {len(self.records)} pieces>"

    def __reduce__(self) -> tuple[Any, ...]:
        return Segments, (self.mesh, self.ends, self.offsets, self.records)
