"""Where points lie: the answers of a locator."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from meshwalk import _arrays, _core, _esmf
from meshwalk._where import Where

if TYPE_CHECKING:
    import os

    from numpy.typing import ArrayLike, NDArray
    from scipy.sparse import csr_array

    from meshwalk._borrowed import BorrowedMesh
    from meshwalk._core import Progress
    from meshwalk._mesh import Mesh
    from meshwalk._space.surface import Surface

LOCATION = _arrays.record_type(
    _core.LOCATION_LAYOUT,
    {
        "weights": (np.float64, (3,)),
        "triangle": np.int32,
        "hole": np.int32,
        "where": np.uint8,
        "local": np.uint8,
    },
)
"""The type of one answer, as the library writes it."""


class Locations:
    """Where points lie: the answer of `Locator.locate` or `Star.locate`, of the points' shape.

    The attributes are views of the library's own answers: they cost nothing, share memory, and
    cannot be written; ``hit.triangle.copy()`` can.

    Examples
    --------
    >>> import meshwalk
    >>> mesh = meshwalk.Mesh([[0, 0], [4, 0], [4, 4], [0, 4]], [[0, 1, 2], [0, 2, 3]])
    >>> hit = meshwalk.Locator(mesh).locate([[3, 1], [2, 2], [5, 5]])
    >>> hit
    <Locations: 3 points; 1 inside, 1 edge, 1 outside>
    >>> hit.triangle
    array([ 0,  0, -1], dtype=int32)
    >>> hit.inside
    array([ True,  True, False])
    >>> meshwalk.Where(hit.where[1])
    <Where.EDGE: 1>
    >>> hit.interpolate([10.0, 20.0, 30.0, 20.0])
    array([20., 20., nan])
    """

    __slots__ = ("_mesh", "_records")

    def __init__(self, mesh: Mesh | Surface | BorrowedMesh, records: NDArray[Any]) -> None:
        self._mesh = mesh
        self._records = _arrays.records(records, LOCATION, mesh.triangle_count)

    @classmethod
    def _of(cls, mesh: Mesh | Surface | BorrowedMesh, records: NDArray[Any]) -> Locations:
        """Answers that the library has just given: they are taken as they are."""
        hit = object.__new__(cls)
        hit._mesh = mesh
        hit._records = _arrays.frozen(records)
        return hit

    @property
    def mesh(self) -> Mesh | Surface | BorrowedMesh:
        """The mesh in which the points were located: a Mesh, Surface or BorrowedMesh."""
        return self._mesh

    @property
    def records(self) -> NDArray[Any]:
        """All answers, as a structured array."""
        return self._records

    @property
    def triangle(self) -> NDArray[np.int32]:
        """The triangle that contains each point, -1 for none.

        A point on an edge or a vertex belongs to the lowest-numbered triangle that contains it.
        """
        return self._records["triangle"]

    @property
    def where(self) -> NDArray[np.uint8]:
        """Where each point lies: the numbers of `Where`."""
        return self._records["where"]

    @property
    def weights(self) -> NDArray[np.float64]:
        """Weights of the three vertices of the triangle, shape (..., 3); NaN where there is none.

        They are not negative, sum up to 1 but for rounding, and are exactly 0 for the vertices off
        the edge that the point is on.
        """
        return self._records["weights"]

    @property
    def hole(self) -> NDArray[np.int32]:
        """Number of the hole in which each point lies, -1 for none."""
        return self._records["hole"]

    @property
    def local(self) -> NDArray[np.uint8]:
        """The local edge or vertex that a point is on; 255 for none."""
        return self._records["local"]

    @property
    def inside(self) -> NDArray[np.bool_]:
        """True where a triangle contains the point, its border included: a new array each time.

        False for points that are ``Where.NEAR``, which have a triangle and values, too: all points
        that have some are ``hit.triangle >= 0``.
        """
        return np.asarray(self.where <= Where.VERTEX)

    @property
    def shape(self) -> tuple[int, ...]:
        """The shape of the points, without their coordinates."""
        return self._records.shape

    def interpolate(
        self,
        values: ArrayLike | str,
        threads: int = 0,
        *,
        progress: Progress | None = None,
    ) -> NDArray[Any]:
        """Interpolate values at the vertices, linearly in each triangle.

        Parameters
        ----------
        values : array_like, shape (n_vertices, ...), or str
            Values at the vertices of the mesh, or the name of one of its fields. Masked values
            count as NaN. Values of a vertex side by side are the fastest; fields one after the
            other are taken as they lie, too, such as ``zeta.T`` of ``zeta[time, vertex]``.
        threads : int, optional
            How many threads work on it; 0 lets the library choose. The answers are the same.
        progress : callable, optional
            As of `Locator.locate`.

        Returns
        -------
        ndarray, shape ``hit.shape + values.shape[1:]``
            NaN where there is no triangle (points that are ``Where.NEAR`` have one), and where a
            vertex with a weight has NaN. Float32 for
            values of float16 and float32, which are interpolated in doubles and rounded once; else
            float64. The values at a vertex are exactly that vertex's.

        Examples
        --------
        >>> import meshwalk
        >>> mesh = meshwalk.Mesh([[0, 0], [4, 0], [0, 4]], [[0, 1, 2]], {"depth": [1, 5, 9]})
        >>> hit = meshwalk.Locator(mesh).locate([[1, 1], [0, 4]])
        >>> hit.interpolate("depth")
        array([4., 9.])
        >>> hit.interpolate([[0, 1], [4, 1], [0, 1]])
        array([[1., 1.],
               [0., 1.]])
        """
        if isinstance(values, str):
            array: NDArray[Any] = _arrays.named(self._mesh.fields, values)
        else:
            array = _arrays.values(values, "values", self._mesh.vertex_count)
        return self._interpolate_array(array, threads, progress)

    def gradient(self, values: ArrayLike | str) -> NDArray[np.float64]:
        """How fast values at the vertices change along x and y: constant in each triangle.

        Parameters
        ----------
        values : array_like, shape (n_vertices, ...), or str
            As of `interpolate`.

        Returns
        -------
        ndarray, shape ``hit.shape + values.shape[1:] + (2,)``
            The derivatives along x and y, in doubles, rounded. NaN where there is no triangle,
            where a vertex of the triangle has NaN, and where the triangle has no area. On an edge
            or a vertex it is that of the triangle which has the point.

        Examples
        --------
        >>> import meshwalk
        >>> mesh = meshwalk.Mesh([[0, 0], [4, 0], [0, 4]], [[0, 1, 2]])
        >>> hit = meshwalk.Locator(mesh).locate([[1, 1], [9, 9]])
        >>> hit.gradient([0.0, 4.0, 8.0])
        array([[ 1.,  2.],
               [nan, nan]])
        """
        if self._mesh.points.shape[1] != 2:
            raise TypeError("gradients are those of a mesh in the plane, not of a surface")
        if isinstance(values, str):
            values = _arrays.named(self._mesh.fields, values)
        array = _arrays.values(values, "values", self._mesh.vertex_count)
        there = self.triangle >= 0
        out = np.full((*self.shape, *array.shape[1:], 2), np.nan)
        corners = self._mesh.triangles[self.triangle[there]]
        out[there] = _gradients(self._mesh.points, array, corners)
        return out

    def of_triangles(self, values: ArrayLike | str, missing: Any = np.nan) -> NDArray[Any]:
        """Take the values of the triangles that contain the points, without interpolation.

        Parameters
        ----------
        values : array_like, shape (n_triangles, ...), or str
            Values of the triangles, of any type, or the name of one of the mesh's
            `Mesh.triangle_fields`. Masked values count as `missing`.
        missing : scalar, optional
            The value where there is no triangle. Integers stay integers if it is one, too.

        Returns
        -------
        ndarray, shape ``hit.shape + values.shape[1:]``

        See Also
        --------
        Mesh.to_vertices : makes such values continuous, for `interpolate`.

        Examples
        --------
        >>> import meshwalk
        >>> mesh = meshwalk.Mesh([[0, 0], [4, 0], [4, 4], [0, 4]], [[0, 1, 2], [0, 2, 3]])
        >>> hit = meshwalk.Locator(mesh).locate([[3, 1], [1, 3], [5, 5]])
        >>> hit.of_triangles([0.5, 0.25])
        array([0.5 , 0.25,  nan])
        >>> hit.of_triangles([7, 8], missing=-1)
        array([ 7,  8, -1])
        """
        if isinstance(values, str):
            values = _arrays.named(getattr(self._mesh, "triangle_fields", {}), values, "triangle")
        return _arrays.of_triangles(values, self._mesh.triangle_count, self.triangle, missing)

    def operator(self) -> csr_array:
        """The interpolation as a sparse matrix: values at the points are ``operator @ values``.

        Returns
        -------
        scipy.sparse.csr_array, shape (number of points, n_vertices)
            Points in the order of ``ravel``. A row holds the weights that are not 0. Rows of points
            without a triangle are empty, so the product is 0 there, where `interpolate` gives NaN:
            ``numpy.where(hit.triangle.ravel() >= 0, operator @ values, numpy.nan)``.

        Raises
        ------
        ImportError
            SciPy is not installed.

        Examples
        --------
        >>> import meshwalk
        >>> mesh = meshwalk.Mesh([[0, 0], [4, 0], [0, 4]], [[0, 1, 2]])
        >>> hit = meshwalk.Locator(mesh).locate([[1, 1], [9, 9], [4, 0]])
        >>> hit.operator().toarray()
        array([[0.5 , 0.25, 0.25],
               [0.  , 0.  , 0.  ],
               [0.  , 1.  , 0.  ]])
        """
        from scipy.sparse import csr_array

        weights = self.weights.reshape(-1, 3)
        there = self.triangle.reshape(-1) >= 0
        used = there[:, None] & (weights != 0)
        corners = self._mesh.triangles[np.where(there, self.triangle.reshape(-1), 0)]
        starts = np.zeros(len(weights) + 1, np.int64)
        np.cumsum(used.sum(1), out=starts[1:])
        shape = (len(weights), self._mesh.vertex_count)
        return csr_array((weights[used], corners[used], starts), shape=shape)

    def to_esmf(self, path: str | os.PathLike[str]) -> None:
        """Write the weights to a netCDF file in ESMF's convention, as xESMF and uxarray read it.

        Parameters
        ----------
        path : str or path-like
            The file, in the 64-bit offset format of netCDF 3.

        Notes
        -----
        The dimensions are ``n_a`` (vertices), ``n_b`` (points) and ``n_s`` (weights); the variables
        ``row`` (point, from 1), ``col`` (vertex, from 1) and ``S`` (weight), as ``start_index``
        tells; ``mask_b`` is 0 for points without a triangle, ``frac_b`` the sum of the weights,
        ``status_b`` the number in `Where`. In the plane ``xc_a`` and ``yc_a`` are the vertices.
        SciPy has to be installed.

        Examples
        --------
        >>> import meshwalk, os, tempfile
        >>> mesh = meshwalk.Mesh([[0, 0], [4, 0], [0, 4]], [[0, 1, 2]])
        >>> hit = meshwalk.Locator(mesh).locate([[1, 1], [4, 0]])
        >>> hit.to_esmf(os.path.join(tempfile.mkdtemp(), "weights.nc"))
        """
        matrix = self.operator().tocoo()
        title = "linear interpolation in triangles, by meshwalk"
        _esmf.write(path, title, matrix, self._esmf_sides(matrix))

    def _esmf_sides(self, matrix: Any) -> list[tuple[str, str, str, Any]]:
        """Tell of columns (a) and rows (b) what readers of ESMF's files want to know."""
        used = np.zeros(matrix.shape[1])
        used[matrix.col] = 1
        sums = np.bincount(matrix.row, matrix.data, matrix.shape[0])
        sides = [
            ("mask_a", "i4", "n_a", np.ones(len(used), np.int32)),
            ("area_a", "f8", "n_a", np.zeros(len(used))),
            ("frac_a", "f8", "n_a", used),
            ("mask_b", "i4", "n_b", (self.triangle.reshape(-1) >= 0).astype(np.int32)),
            ("area_b", "f8", "n_b", np.zeros(len(sums))),
            ("frac_b", "f8", "n_b", sums),
            ("status_b", "i1", "n_b", self.where.reshape(-1).astype(np.int8)),
        ]
        points = self._mesh.points
        if points.shape[1] == 2:
            sides += [(name, "f8", "n_a", points[:, k]) for k, name in enumerate(("xc_a", "yc_a"))]
        return sides

    def _interpolate_array(
        self, values: NDArray[Any], threads: int, progress: Progress | None
    ) -> NDArray[Any]:
        records = np.ascontiguousarray(self._records).reshape(-1)

        def interpolate(table: NDArray[Any], narrow: bool, out: NDArray[Any]) -> None:
            self._mesh._interpolate_table(table, narrow, records, out, threads, progress)

        return _arrays.interpolated(values, self.shape, interpolate)

    def _core_operator(self, threads: int, progress: Progress | None) -> _core.Operator:
        """The weights, for an `Operator`."""
        from meshwalk._mesh import Mesh
        from meshwalk._space.surface import Surface

        records = np.ascontiguousarray(self._records).reshape(-1)
        if isinstance(self._mesh, Mesh):
            return _core.operator_from_locations(self._mesh, records, threads, progress)
        if isinstance(self._mesh, Surface):
            return self._mesh._operator("locations", records, threads, progress)
        kind = type(self._mesh).__name__
        raise TypeError(f"points must be located in a Mesh or a Surface, not in a {kind}")

    def __getitem__(self, index: Any) -> Locations:
        return Locations._of(self._mesh, np.asarray(self._records[index]))

    def __len__(self) -> int:
        return len(self._records)

    def __array__(self, dtype: Any = None, copy: bool | None = None) -> NDArray[Any]:
        if copy:
            return self._records.astype(dtype or LOCATION)
        return self._records if dtype is None else self._records.astype(dtype, copy=False)

    def __repr__(self) -> str:
        counts = np.bincount(self.where.ravel(), minlength=len(Where))
        kinds = ", ".join(f"{counts[w]} {w.name.lower()}" for w in Where if counts[w])
        size = " x ".join(str(n) for n in self.shape) if self.shape else "1"
        noun = "point" if size == "1" else "points"
        return f"<{type(self).__name__}: {size} {noun}{'; ' if kinds else ''}{kinds}>"

    def __reduce__(self) -> tuple[Any, ...]:
        return Locations, (self._mesh, self._records)


def _gradients(
    points: NDArray[np.float64], values: NDArray[Any], corners: NDArray[Any]
) -> NDArray[np.float64]:
    """Gradients in triangles, whose vertices are `corners`: x and y of each field of each."""
    one, two, three = corners.T
    (bx, by), (cx, cy) = (points[two] - points[one]).T, (points[three] - points[one]).T
    first = values[one].astype(np.float64)
    b, c = values[two] - first, values[three] - first
    bx, by, cx, cy = (part.reshape(-1, *(1,) * (values.ndim - 1)) for part in (bx, by, cx, cy))
    with np.errstate(divide="ignore", invalid="ignore"):
        twice_area = bx * cy - by * cx
        twice_area[twice_area == 0] = np.nan
        out = np.stack([b * cy - c * by, c * bx - b * cx], axis=-1)
        return np.asarray(out / twice_area[..., None])
