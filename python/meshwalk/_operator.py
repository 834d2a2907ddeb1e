"""Weights that are kept: interpolation at the same points, field after field."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from meshwalk import _arrays, _core

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray
    from scipy.sparse import csr_array

    from meshwalk._core import Progress
    from meshwalk._locations import Locations
    from meshwalk._space.prober import Found


class Operator:
    """The weights of located points, as a sparse matrix that interpolates values.

    It is made once and applied to any number of fields, several times as fast as ``scipy.sparse``
    is: it holds its rows in an order in which neighbours read the same values, and works on several
    threads. The values are those of `Locations.interpolate`, bit for bit.

    Parameters
    ----------
    hit : Locations, Touches or NearestPoints
        Points that were located in a `Mesh` or in `Tiles`; or answers of a `Star` or `Prober`, at
        places of its surface. The operator keeps none of these.
    threads : int, optional
        How many threads work on it; 0 lets the library choose.
    progress : callable, optional
        As of `Locator.locate`.

    Examples
    --------
    >>> import meshwalk
    >>> mesh = meshwalk.Mesh([[0, 0], [4, 0], [0, 4]], [[0, 1, 2]])
    >>> weights = meshwalk.Operator(meshwalk.Locator(mesh).locate([[1, 1], [9, 9], [4, 0]]))
    >>> weights
    <Operator: 3 points, 3 vertices, 4 weights>
    >>> weights @ [1.0, 5.0, 9.0]
    array([ 4., nan,  5.])
    >>> weights.apply([[0, 1], [4, 1], [0, 1]])
    array([[ 1.,  1.],
           [nan, nan],
           [ 4.,  1.]])
    >>> weights.T @ [1.0, 1.0, 1.0]
    array([0.5 , 1.25, 0.25])
    """

    __slots__ = ("_columns", "_points", "_transposed", "_values", "_weights")

    def __init__(
        self,
        hit: Locations | Found,
        threads: int = 0,
        *,
        progress: Progress | None = None,
    ) -> None:
        self._weights = hit._core_operator(threads, progress)
        self._points: tuple[int, ...] = hit.shape
        self._values: tuple[int, ...] = (self._weights.describe()[1],)
        self._transposed = False
        self._columns = "vertices"

    @classmethod
    def _of(cls, weights: _core.Operator, shape: tuple[int, ...], columns: str) -> Operator:
        """An operator for results of the shape; `columns` says what its values belong to."""
        operator = object.__new__(cls)
        operator._weights = weights
        operator._points = shape
        operator._values = (weights.describe()[1],)
        operator._transposed = False
        operator._columns = columns
        return operator

    @property
    def shape(self) -> tuple[int, int]:
        """The number of points, and of vertices."""
        rows, columns, *_ = self._weights.describe()
        return rows, columns

    @property
    def nnz(self) -> int:
        """The number of weights that are not 0."""
        return self._weights.describe()[2]

    @property
    def nbytes(self) -> int:
        """Memory in bytes."""
        return self._weights.describe()[4]

    @property
    def T(self) -> Operator:  # noqa: N802, as NumPy and SciPy call it
        """The transpose: spreads values at points to the vertices; 0 where no point is near."""
        turned = object.__new__(Operator)
        turned._weights = self._weights.transpose(0, None)
        turned._points, turned._values = self._values, self._points
        turned._transposed = not self._transposed
        turned._columns = self._columns
        return turned

    def apply(
        self,
        values: ArrayLike,
        threads: int = 0,
        *,
        leave_out_missing: bool = False,
        progress: Progress | None = None,
    ) -> NDArray[Any]:
        """Interpolate values at the vertices.

        Parameters
        ----------
        values : array_like, shape (n_vertices, ...)
            As of `Locations.interpolate`, but no name of a field.
        threads : int, optional
            How many threads work on it; 0 lets the library choose. The values are the same.
        leave_out_missing : bool, optional
            Where a vertex has NaN, take the mean of the others, by their weights, instead of NaN.
        progress : callable, optional
            As of `Locator.locate`.

        Returns
        -------
        ndarray, shape ``hit.shape + values.shape[1:]``
            NaN where there is no triangle.
        """
        if isinstance(values, str):
            raise TypeError(
                "values must be an array: an operator keeps nothing of its mesh, so it knows no"
                f" field {values!r}; take mesh.fields[{values!r}]"
            )
        given = np.asanyarray(values)
        there = len(self._values)
        if there != 1 and given.shape[:there] == self._values:
            given = given.reshape((-1, *given.shape[there:]))
        of = "points" if self._transposed else self._columns
        array = _arrays.values(given, "values", self.shape[1], of)

        def apply(table: NDArray[Any], narrow: bool, out: NDArray[Any]) -> None:
            self._weights.apply(
                table, narrow, out, leave_out_missing, self._transposed, threads, progress
            )

        return _arrays.interpolated(array, self._points, apply)

    def __matmul__(self, values: ArrayLike) -> NDArray[Any]:
        return self.apply(values)

    def tocsr(self) -> csr_array:
        """Copy the weights as a matrix of SciPy, whose product is 0 where there is no triangle."""
        from scipy.sparse import csr_array

        first, column, weight = self._entries()
        arrays = weight, column.astype(np.int32), first.astype(np.int64)
        return csr_array(arrays, shape=self.shape)

    def _entries(self) -> tuple[NDArray[np.uint64], NDArray[np.uint32], NDArray[np.float64]]:
        """Compressed sparse rows."""
        rows, _, entries, *_ = self._weights.describe()
        first = np.empty(rows + 1, np.uint64)
        column = np.empty(entries, np.uint32)
        weight = np.empty(entries)
        self._weights.copy(first, column, weight)
        return first, column, weight

    def __repr__(self) -> str:
        rows, columns, entries, *_ = self._weights.describe()
        points, vertices = (columns, rows) if self._transposed else (rows, columns)
        turned = ", transposed" if self._transposed else ""
        return f"<Operator: {points} points, {vertices} {self._columns}, {entries} weights{turned}>"

    def __reduce__(self) -> tuple[Any, ...]:
        first, column, weight = self._entries()
        kept = self._points, self._values, self._transposed, self._columns
        return _restore, (type(self), self.shape, first, column, weight, *kept)


def _restore(
    cls: type[Operator],
    shape: tuple[int, int],
    first: NDArray[np.uint64],
    column: NDArray[np.uint32],
    weight: NDArray[np.float64],
    points: tuple[int, ...],
    values: tuple[int, ...],
    transposed: bool,
    what: str = "vertices",
) -> Operator:
    counts = (first[1:] - first[:-1]).astype(np.int64)
    row = np.repeat(np.arange(shape[0], dtype=np.uint32), counts)
    weights = object.__new__(cls)
    weights._weights = _core.operator_from_entries(row, column, weight, *shape)
    weights._points, weights._values, weights._transposed = points, values, transposed
    weights._columns = what
    return weights
