"""Which triangles lie along segments: the pieces that a locator lists."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from meshwalk import _arrays, _core

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

    from meshwalk._mesh import Mesh

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


class Segments:
    """The triangles along segments: the answer of `Locator.segment`.

    A piece is a longest part of a segment, of positive length, in one triangle: the one that
    `Locator.locate` finds for each of its points but finitely many. A part along an edge belongs
    to the lower-numbered triangle there, and parts outside the mesh to no piece. A segment that is
    a point has one piece, if it is in the mesh. All of this is exact; the attributes are views of
    the library's own answers, which cannot be written.

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
    """

    __slots__ = ("ends", "mesh", "offsets", "records")

    def __init__(
        self,
        mesh: Mesh,
        ends: NDArray[np.float64],
        offsets: NDArray[np.int64],
        records: NDArray[Any],
    ) -> None:
        self.mesh = mesh
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

    def points(self) -> NDArray[np.float64]:
        """Where the pieces begin and end, in the units of the mesh.

        Returns
        -------
        ndarray, shape (pieces, 2, 2)
            Beginning and end of each piece, x and y of each: the ends of segments and vertices as
            they are, others rounded.
        """
        return self._weights()[1]

    def interpolate(self, values: ArrayLike) -> NDArray[np.float64]:
        """Interpolate values at the vertices, where the pieces begin and end.

        In between they are linear.

        Parameters
        ----------
        values : array_like, shape (n_vertices, ...)
            Values at the vertices of the mesh.

        Returns
        -------
        ndarray, shape (pieces, 2, ...)
            At the beginning and the end of each piece; equal, to the last bit, where pieces meet.
            NaN where a vertex with a weight has NaN.
        """
        array = _arrays.values(values, "values", self.mesh.vertex_count).astype(float, copy=False)
        weights, _ = self._weights()
        corners = array[self.mesh.triangles[self.triangle]]
        result = np.zeros((*weights.shape[:2], *array.shape[1:]))
        for k in range(3):
            weight = weights[:, :, k].reshape(*weights.shape[:2], *(1,) * (array.ndim - 1))
            result += np.where(weight != 0, weight * corners[:, None, k], 0)
        return result

    def _weights(self) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        weights = np.empty((len(self.records), 2, 3))
        points = np.empty((len(self.records), 2, 2))
        segment = np.ascontiguousarray(self.segment, np.int64)
        _core.segment_weights(self.mesh, self.ends, segment, self.records, weights, points)
        return weights, points

    def __len__(self) -> int:
        return len(self.records)

    def __repr__(self) -> str:
        return f"<Segments: {len(self.offsets) - 1} segments, {len(self)} pieces>"
