"""Drop-ins for users of SciPy: the same calls in the plane, exact and fast.

>>> from meshwalk.scipy import Delaunay, LinearNDInterpolator
>>> triangles = Delaunay([[0, 0], [4, 0], [4, 4], [0, 4]])
>>> triangles.find_simplex([[3, 1], [9, 9]]) >= 0
array([ True, False])
>>> LinearNDInterpolator(triangles, [0.0, 4.0, 8.0, 4.0])(1, 3)
array(4.)

Points of more dimensions, and the options of Qhull, are SciPy's own: take `scipy.spatial` for them.
SciPy itself has to be installed.
"""

from __future__ import annotations

import warnings
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np
import scipy.spatial

from meshwalk._errors import InputError
from meshwalk._locator import Locator
from meshwalk._mesh import Mesh
from meshwalk._triangulate import DuplicateWarning, delaunay
from meshwalk._where import Where

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

__all__ = ["Delaunay", "LinearNDInterpolator", "tsearch"]

_EPSILON = float(np.finfo(np.float64).eps)
_TOLERANCE = 100 * _EPSILON
"""By how much a weight may be negative, as SciPy has it."""


class _Finder:
    """Finds the triangles of points, those a rounding error outside included."""

    def __init__(self, mesh: Mesh) -> None:
        self.locator = Locator(mesh, border=True)
        info = mesh.describe()
        self.extent = float(np.hypot(*np.subtract(info.high, info.low)))

    def locate(self, points: NDArray[Any], tolerance: float) -> Any:
        """Locate points; weights of those outside that count as inside are not clamped."""
        found = self.locator.locate(points, tolerance=tolerance * self.extent)
        outside = found.where == Where.NEAR
        if not outside.any():
            return found.triangle, found.weights
        triangle, weights = found.triangle.copy(), found.weights.copy()
        weights[outside] = self._weights(points[outside], triangle[outside])
        triangle[outside & ~(weights >= -tolerance).all(axis=-1)] = -1
        return triangle, weights

    def _weights(self, points: NDArray[Any], triangle: NDArray[Any]) -> NDArray[Any]:
        mesh = self.locator.mesh
        a, b, c = np.moveaxis(mesh.points[mesh.triangles[triangle]], 1, 0)
        ab, ac, ap = b - a, c - a, points - a
        area = ab[:, 0] * ac[:, 1] - ab[:, 1] * ac[:, 0]
        of_b = (ap[:, 0] * ac[:, 1] - ap[:, 1] * ac[:, 0]) / area
        of_c = (ab[:, 0] * ap[:, 1] - ab[:, 1] * ap[:, 0]) / area
        return np.stack([1 - of_b - of_c, of_b, of_c], axis=-1)


def _plane_points(points: ArrayLike) -> NDArray[np.float64]:
    """A copy of points in the plane, checked as SciPy checks them."""
    if np.ma.isMaskedArray(points):
        raise ValueError("points cannot be a masked array")
    rows = np.array(points, np.float64, order="C")
    if rows.ndim != 2:
        raise ValueError("points must have two dimensions: a row for each point")
    if rows.shape[1] != 2:
        raise ValueError(
            f"points in the plane have 2 coordinates, not {rows.shape[1]}: take "
            "scipy.spatial.Delaunay for those of other dimensions"
        )
    if not np.isfinite(rows).all():
        raise ValueError("points cannot contain NaN or infinity")
    return rows


class Delaunay:
    """The Delaunay triangulation of points in the plane, as `scipy.spatial.Delaunay` has it.

    Parameters
    ----------
    points : array_like, shape (n, 2)
        The points, copied.
    incremental : bool, optional
        Allow `add_points`.
    furthest_site, qhull_options
        What Qhull offers. Refused if given: take `scipy.spatial.Delaunay`.

    Attributes
    ----------
    points : ndarray of double, shape (n, 2)
        The points.
    simplices : ndarray of int32, shape (m, 3)
        Corners of the triangles, counter-clockwise.
    neighbors : ndarray of int32, shape (m, 3)
        The triangle opposite to each corner, or -1.
    coplanar : ndarray of int32, shape (k, 3)
        Points with the coordinates of another one, which are in no triangle: the point, a triangle
        of the other one, the other one.
    npoints, nsimplex, ndim : int
        Numbers of points, triangles and dimensions.
    min_bound, max_bound : ndarray of double, shape (2,)
        Extent of the points.

    Raises
    ------
    ValueError
        Points of other than two dimensions, masked ones, NaN or infinite ones.
    scipy.spatial.QhullError
        Fewer than three different points, or all on one line.

    Notes
    -----
    SciPy's own interpolators, such as ``scipy.interpolate.CloughTocher2DInterpolator``, take a
    triangulation of Qhull only: give them points, or a ``scipy.spatial.Delaunay``.

    Every triangle is a Delaunay triangle, decided exactly, and every point that no other one equals
    is a corner. Where four points lie on one circle, and in the order of triangles and of their
    corners, the result may differ from Qhull's. Any number of threads may use an object. O(n log n)
    for n points.

    Examples
    --------
    >>> from meshwalk.scipy import Delaunay
    >>> triangles = Delaunay([[0, 0], [4, 0], [0, 4]])
    >>> triangles.neighbors
    array([[-1, -1, -1]], dtype=int32)
    """

    ndim = 2
    furthest_site = False
    paraboloid_scale, paraboloid_shift = 1.0, 0.0

    def __init__(
        self,
        points: ArrayLike,
        furthest_site: bool = False,
        incremental: bool = False,
        qhull_options: str | bytes | None = None,
    ) -> None:
        if furthest_site or qhull_options:
            raise ValueError(
                "furthest_site and qhull_options are Qhull's: take scipy.spatial.Delaunay for them"
            )
        self._incremental = bool(incremental)
        self._triangulate(_plane_points(points))

    def _triangulate(self, points: NDArray[np.float64]) -> None:
        self.points = points
        try:
            with warnings.catch_warnings():
                warnings.simplefilter("ignore", DuplicateWarning)
                self._mesh = delaunay(self.points)
        except InputError as error:
            raise scipy.spatial.QhullError(str(error)) from error
        self.npoints = len(self.points)
        self.simplices = np.ascontiguousarray(self._mesh.triangles, np.int32)
        self.nsimplex = len(self.simplices)
        self.neighbors = np.roll(self._mesh.neighbours, -1, axis=1)
        self.min_bound, self.max_bound = self.points.min(axis=0), self.points.max(axis=0)

    @cached_property
    def _finder(self) -> _Finder:
        return _Finder(self._mesh)

    def find_simplex(
        self, xi: ArrayLike, bruteforce: bool = False, tol: float | None = None
    ) -> NDArray[np.int32]:
        """Find the triangles that contain points.

        Parameters
        ----------
        xi : array_like, shape (..., 2)
            The points.
        bruteforce : bool, optional
            Makes no difference: each answer is exact.
        tol : float, optional
            How negative the least weight of a point outside may be in the nearest triangle for the
            point to count as inside. By default 100 times the machine's epsilon, as SciPy has it;
            0 takes points outside for what they are.

        Returns
        -------
        ndarray of int32, shape (...)
            The triangles; -1 for points in none. Of several, the lowest.
        """
        points = np.asanyarray(xi)
        if points.shape[-1] != 2:
            raise ValueError(f"xi must have 2 columns, not {points.shape[-1]}")
        tolerance = _TOLERANCE if tol is None else max(float(tol), 0.0)
        triangle, _ = self._finder.locate(np.asarray(points, np.float64), tolerance)
        return np.ascontiguousarray(triangle)

    @cached_property
    def transform(self) -> NDArray[np.float64]:
        """Of each triangle the matrix that makes two weights of ``x - r``, and below it r.

        The weights are those of the first two corners, and r is the third. NaN where the triangle
        is so flat that rounding spoils them.
        """
        corners = self.points[self.simplices]
        r = corners[:, 2]
        edges = np.moveaxis(corners[:, :2] - r[:, None], 1, 2)
        determinant = edges[:, 0, 0] * edges[:, 1, 1] - edges[:, 0, 1] * edges[:, 1, 0]
        adjugate = np.empty_like(edges)
        adjugate[:, 0, 0], adjugate[:, 1, 1] = edges[:, 1, 1], edges[:, 0, 0]
        adjugate[:, 0, 1], adjugate[:, 1, 0] = -edges[:, 0, 1], -edges[:, 1, 0]
        norms = np.abs(edges).sum(axis=1).max(axis=1) * np.abs(adjugate).sum(axis=1).max(axis=1)
        with np.errstate(divide="ignore", invalid="ignore"):
            inverse = adjugate / determinant[:, None, None]
            inverse[~(np.abs(determinant) > 10 * _TOLERANCE * norms)] = np.nan
        return np.concatenate([inverse, r[:, None]], axis=1)

    @cached_property
    def coplanar(self) -> NDArray[np.int32]:
        """Points with the coordinates of another one, which are in no triangle."""
        used = np.zeros(self.npoints, bool)
        used[self.simplices] = True
        left_out = np.flatnonzero(~used)
        if len(left_out) == 0:
            return np.empty((0, 3), np.int32)
        triangle = self._finder.locator.locate(self.points[left_out]).triangle
        corners = self.simplices[triangle]
        same = (self.points[corners] == self.points[left_out][:, None]).all(axis=2)
        vertex = corners[np.arange(len(corners)), same.argmax(axis=1)]
        return np.column_stack([left_out, triangle, vertex]).astype(np.int32)

    @cached_property
    def vertex_to_simplex(self) -> NDArray[np.int32]:
        """Of each point a triangle that has it, or that has the point of the same coordinates."""
        triangle = np.full(self.npoints, -1, np.int32)
        triangle[self.simplices] = np.arange(self.nsimplex, dtype=np.int32)[:, None]
        triangle[self.coplanar[:, 0]] = self.coplanar[:, 1]
        return triangle

    @cached_property
    def vertex_neighbor_vertices(self) -> tuple[NDArray[np.int32], NDArray[np.int32]]:
        """The neighbours of point k are ``indices[indptr[k]:indptr[k + 1]]``."""
        ends = np.concatenate([self.simplices[:, [i, j]] for i in range(3) for j in range(3)])
        ends = np.unique(ends[ends[:, 0] != ends[:, 1]], axis=0)
        indptr = np.searchsorted(ends[:, 0], np.arange(self.npoints + 1))
        return indptr.astype(np.int32), ends[:, 1].astype(np.int32)

    @cached_property
    def convex_hull(self) -> NDArray[np.int32]:
        """Edges of the convex hull: the two ends of each, shape (k, 2)."""
        triangle, corner = np.nonzero(self.neighbors < 0)
        ends = [self.simplices[triangle, (corner + k) % 3] for k in (1, 2)]
        return np.stack(ends, axis=1)

    def lift_points(self, x: ArrayLike) -> NDArray[np.float64]:
        """Points on the paraboloid ``z = x**2 + y**2``, shape (..., 3)."""
        points = np.asarray(x, np.float64)
        return np.concatenate([points, (points**2).sum(axis=-1, keepdims=True)], axis=-1)

    @cached_property
    def equations(self) -> NDArray[np.float64]:
        """Of each triangle on the paraboloid its plane, shape (m, 4).

        The unit normal, which points downwards, then the offset.
        """
        a, b, c = np.moveaxis(self.lift_points(self.points[self.simplices]), 1, 0)
        normal = -np.cross(b - a, c - a)
        normal /= np.linalg.norm(normal, axis=1, keepdims=True)
        return np.column_stack([normal, -(normal * a).sum(axis=1)])

    def plane_distance(self, xi: ArrayLike) -> NDArray[np.float64]:
        """Distances of points on the paraboloid to the planes of all triangles, shape (..., m)."""
        return self.lift_points(xi) @ self.equations[:, :3].T + self.equations[:, 3]

    def add_points(self, points: ArrayLike, restart: bool = False) -> None:
        """Add points to a triangulation that was made with ``incremental=True``.

        Parameters
        ----------
        points : array_like, shape (k, 2)
            The points, which come after those that are there.
        restart : bool, optional
            Makes no difference.

        Notes
        -----
        All points are triangulated anew. For many small changes take `meshwalk.Editor`, which
        follows each in the time of its surroundings. No other thread may use the object meanwhile.
        """
        if not self._incremental:
            raise RuntimeError("the triangulation was not made with incremental=True, or is closed")
        added = _plane_points(points)
        for name in ("_finder", "transform", "coplanar", "vertex_to_simplex", "convex_hull"):
            self.__dict__.pop(name, None)
        for name in ("vertex_neighbor_vertices", "equations"):
            self.__dict__.pop(name, None)
        self._triangulate(np.concatenate([self.points, added]))

    def close(self) -> None:
        """Take no more points."""
        self._incremental = False


def tsearch(tri: Delaunay, xi: ArrayLike) -> NDArray[np.int32]:
    """Find the triangles that contain points, as `Delaunay.find_simplex` does."""
    return tri.find_simplex(xi)


def _mesh_of(points: Any) -> Mesh | None:
    """The mesh of what has triangles already; None of points."""
    if isinstance(points, Mesh):
        return points
    if isinstance(points, Delaunay):
        return points._mesh
    if isinstance(points, scipy.spatial.Delaunay):
        if points.ndim != 2:
            raise ValueError("the triangulation must be one in the plane")
        return Mesh(points.points, points.simplices)
    return None


def _columns(points: Any, name: str) -> NDArray[np.float64]:
    """Points as rows: from rows, or from a tuple of arrays that broadcast."""
    if isinstance(points, tuple):
        points = np.stack(np.broadcast_arrays(*points), axis=-1)
    rows = np.asarray(points, np.float64)
    if rows.ndim == 0 or rows.shape[-1] != 2:
        raise ValueError(f"{name} must have 2 columns, or be a tuple of 2 arrays")
    return rows


class LinearNDInterpolator:
    """Linear interpolation in triangles, as `scipy.interpolate.LinearNDInterpolator` has it.

    Parameters
    ----------
    points : array_like of shape (n, 2), tuple of two arrays, Delaunay, or Mesh
        The points; or a triangulation that is there already: `meshwalk.scipy.Delaunay`,
        `scipy.spatial.Delaunay`, or a `meshwalk.Mesh`, which may have holes.
    values : array_like, shape (n, ...)
        The values at the points, real or complex.
    fill_value : scalar, optional
        What points outside get.
    rescale : bool, optional
        Triangulate the points after scaling both coordinates to a range of 1. Not for a
        triangulation.

    Raises
    ------
    ValueError
        Other than two dimensions, or values that do not fit the points.
    scipy.spatial.QhullError
        Fewer than three different points, or all on one line.

    Notes
    -----
    A point outside by a rounding error, whose least weight is above -100 times the machine's
    epsilon, counts as inside, as SciPy has it. Any number of threads may call an object.

    Examples
    --------
    >>> from meshwalk.scipy import LinearNDInterpolator
    >>> at = LinearNDInterpolator([[0, 0], [4, 0], [4, 4], [0, 4]], [0.0, 4.0, 8.0, 4.0])
    >>> at([[3, 1], [9, 9]])
    array([ 4., nan])
    """

    def __init__(
        self,
        points: Any,
        values: ArrayLike,
        fill_value: complex = np.nan,
        rescale: bool = False,
    ) -> None:
        mesh = _mesh_of(points)
        if mesh is not None and rescale:
            # SciPy's tests match its words.
            raise ValueError(
                "Rescaling is not supported when passing a Delaunay triangulation as ``points``."
            )
        self.offset, self.scale = np.zeros(2), np.ones(2)
        if mesh is None:
            mesh, self.tri = self._triangulate(_columns(points, "points"), rescale)
        else:
            self.tri = points
        self.points = mesh.points
        self.values = np.asarray(values)
        if self.values.ndim == 0 or len(self.values) != len(mesh.points):
            raise ValueError(
                f"values must have a row for each of the {len(mesh.points)} points, not the shape "
                f"{self.values.shape}"
            )
        self.is_complex = np.iscomplexobj(self.values)
        self.values = self.values.astype(np.complex128 if self.is_complex else np.float64)
        self.values_shape = self.values.shape[1:]
        self.fill_value = self.values.dtype.type(fill_value)
        self._finder = _Finder(mesh)

    def _triangulate(self, rows: NDArray[np.float64], rescale: bool) -> tuple[Mesh, Delaunay]:
        if rows.ndim != 2:
            raise ValueError("points must have two dimensions: a row for each point")
        if rescale:
            self.offset = rows.mean(axis=0)
            self.scale = np.ptp(rows, axis=0)
            self.scale[~(self.scale > 0)] = 1.0
            rows = (rows - self.offset) / self.scale
        tri = Delaunay(rows)
        return tri._mesh, tri

    def __call__(self, *args: ArrayLike) -> NDArray[Any]:
        """Interpolate at points.

        Parameters
        ----------
        *args : array_like
            Points of shape (..., 2), or x and y that broadcast against each other.

        Returns
        -------
        ndarray of double or complex, shape (..., ...)
            The shape of the points, then that of a value.
        """
        rows = _columns(args[0] if len(args) == 1 else args, "xi")
        if (self.offset != 0).any() or (self.scale != 1).any():
            rows = (rows - self.offset) / self.scale
        shape = rows.shape[:-1]
        triangle, weights = self._finder.locate(rows.reshape(-1, 2), _TOLERANCE)
        result = np.full((len(triangle), *self.values_shape), self.fill_value)
        inside = np.flatnonzero(triangle >= 0)
        corners = self._finder.locator.mesh.triangles[triangle[inside]]
        total = np.zeros((len(inside), *self.values_shape), self.values.dtype)
        for k in range(3):
            weight = weights[inside, k].reshape(-1, *[1] * len(self.values_shape))
            total += weight * self.values[corners[:, k]]
        result[inside] = total
        return result.reshape(shape + self.values_shape)
