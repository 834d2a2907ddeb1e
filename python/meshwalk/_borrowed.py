"""Location in arrays that stay the caller's."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from meshwalk import _arrays, _core
from meshwalk._locations import LOCATION, Locations

if TYPE_CHECKING:
    from typing import Self

    from numpy.typing import ArrayLike, NDArray

    from meshwalk._core import Progress

_LAYOUTS = {"opposite": False, "edge": True}


class BorrowedMesh:
    """Your own points, triangles and neighbours, in which points are located as they are.

    Nothing is copied or built, so with ``check=False`` it is made in no time. Each query takes
    longer than in a `Mesh` with a `Locator`: use this for some thousand queries in a mesh that is
    used once, or where memory is short. The answers are the same, but for points in holes, which
    are ``Where.OUTSIDE``.

    Parameters
    ----------
    points : array_like, shape (n, 2) or (n, 3)
        x, y of each vertex. Doubles whose rows have no gaps within are not copied.
    triangles : array_like of int, shape (m, 3)
        Vertex numbers from 0, turned either way. int32, uint32 and int64 are not copied.
    neighbours : array_like of int, shape (m, 3)
        The triangles beside each triangle; a number that is no triangle, such as -1, is none. Not
        copied if of the type of `triangles`.
    layout : {"opposite", "edge"}, optional
        Neighbour k is opposite to vertex k, as SciPy has it, or across the edge from vertex k to
        vertex k + 1, as matplotlib has it.
    check : bool, optional
        Look at all triangles first, which takes about as long as making a `Mesh`. Without it,
        neighbours that are wrong do no harm, but may hide the lowest triangle of several.
    convex : bool, optional
        With ``check=False``: you know that the triangles fill their convex hull exactly. If they
        do not, or it is not known, a query that meets the border looks at all triangles.
    threads : int, optional
        How many threads check; 0 lets the library choose.
    progress : callable, optional
        As of `Mesh`.

    Raises
    ------
    InputError
        The check found neighbours that are wrong; `triangle` of the error is the first.

    Notes
    -----
    Do not change the arrays while this object is used.

    Examples
    --------
    >>> import meshwalk
    >>> mesh = meshwalk.BorrowedMesh(
    ...     [[0, 0], [1, 0], [1, 1], [0, 1]], [[0, 1, 2], [0, 3, 2]], [[-1, 1, -1], [-1, 0, -1]])
    >>> mesh.locate([[0.2, 0.7], [2, 2]]).triangle
    array([ 1, -1], dtype=int32)
    """

    __slots__ = ("_across", "convex", "neighbours", "points", "triangles")

    points: NDArray[np.float64]
    """x, y of each vertex."""
    triangles: NDArray[Any]
    """Three vertices of each triangle."""
    neighbours: NDArray[Any]
    """Three neighbours of each triangle."""
    convex: bool
    """The triangles fill their convex hull, as the check found or the caller knew."""

    def __init__(
        self,
        points: ArrayLike,
        triangles: ArrayLike,
        neighbours: ArrayLike,
        *,
        layout: Literal["opposite", "edge"] = "opposite",
        check: bool = True,
        convex: bool = False,
        threads: int = 0,
        progress: Progress | None = None,
    ) -> None:
        if layout not in _LAYOUTS:
            raise ValueError(f"layout must be one of {', '.join(_LAYOUTS)}, not {layout!r}")
        if check and convex:
            raise ValueError("convex=True needs check=False: the check decides this by itself")
        self.points = _arrays.vertices(points, "points", (2, 3))[0][:, :2]
        corners = _arrays.triangles(triangles, "triangles", _core.MAX_TRIANGLES)
        beside = _arrays.triangles(neighbours, "neighbours", _core.MAX_TRIANGLES)
        if corners.shape != beside.shape:
            raise ValueError(f"neighbours must have the shape {corners.shape}, not {beside.shape}")
        if corners.dtype.itemsize != beside.dtype.itemsize:
            corners, beside = corners.astype(np.int64), beside.astype(np.int64)
        self.triangles, self.neighbours = corners, beside
        self._across = _LAYOUTS[layout]
        self.convex = convex
        nothing = np.empty((0, 2)), np.empty(0, LOCATION)
        if check:
            self.convex = self._run(*nothing, True, "auto", threads, progress)

    @classmethod
    def from_scipy(cls, delaunay: Any, *, check: bool = True) -> Self:
        """Borrow a ``scipy.spatial.Delaunay`` of points in the plane.

        Parameters
        ----------
        delaunay : scipy.spatial.Delaunay
            Its arrays are not copied.
        check : bool, optional
            Look at all triangles first, which tells whether they fill their convex hull: SciPy
            rounds, and may leave gaps along the hull. Without it, each point that is outside is
            looked for in all triangles; leave it out only for points that are inside.

        Returns
        -------
        BorrowedMesh

        Notes
        -----
        ``Mesh(delaunay.points, delaunay.simplices)`` with a `Locator` takes about half as long as
        the check, and its queries are faster; it needs memory of its own.

        Examples
        --------
        >>> import meshwalk
        >>> from scipy.spatial import Delaunay
        >>> mesh = meshwalk.BorrowedMesh.from_scipy(Delaunay([[0, 0], [4, 0], [4, 4], [0, 3]]))
        >>> bool(mesh.locate([1, 1]).inside)
        True
        """
        return cls(delaunay.points, delaunay.simplices, delaunay.neighbors, check=check)

    @classmethod
    def from_matplotlib(cls, triangulation: Any, *, check: bool = True) -> Self:
        """Borrow a ``matplotlib.tri.Triangulation``, without a mask.

        Parameters
        ----------
        triangulation : matplotlib.tri.Triangulation
            Its x and y are copied, since they lie apart.
        check : bool, optional
            As of `from_scipy`.

        Returns
        -------
        BorrowedMesh
        """
        if triangulation.mask is not None:
            raise ValueError("a masked triangulation cannot be borrowed; make a Mesh of the rest")
        points = np.column_stack((triangulation.x, triangulation.y))
        neighbours = triangulation.neighbors  # asked for first: it may turn triangles
        return cls(points, triangulation.triangles, neighbours, layout="edge", check=check)

    @property
    def vertex_count(self) -> int:
        """Number of vertices."""
        return len(self.points)

    @property
    def triangle_count(self) -> int:
        """Number of triangles."""
        return len(self.triangles)

    def locate(
        self,
        xy: ArrayLike,
        threads: int = 0,
        *,
        walk: Literal["auto", "remembering", "barycentric", "direct"] = "auto",
        progress: Progress | None = None,
    ) -> Locations:
        """Find the triangles that contain points.

        Parameters
        ----------
        xy : array_like, shape (..., 2)
            The points, as of `Locator.locate`.
        threads : int, optional
            How many threads answer; 0 lets the library choose. The answers are the same.
        walk : str, optional
            ``"barycentric"`` and ``"direct"`` are the published walks for triangles of mixed
            orientation. The answers are the same.
        progress : callable, optional
            As of `Locator.locate`.

        Returns
        -------
        Locations
            Of the shape ``xy.shape[:-1]``.
        """
        points, shape = _arrays.queries(xy, "xy", 2)
        records = np.empty(len(points), LOCATION)
        self._run(points, records, False, walk, threads, progress)
        return Locations._of(self, records.reshape(shape))

    @property
    def fields(self) -> dict[str, NDArray[np.float64]]:
        """Always empty: values are given to `Locations.interpolate`."""
        return {}

    def _run(
        self,
        points: NDArray[np.float64],
        records: NDArray[Any],
        check: bool,
        walk: str,
        threads: int,
        progress: Progress | None,
    ) -> bool:
        return _core.borrowed_locate(
            self.points,
            self.triangles,
            self.neighbours,
            self._across,
            not check,
            self.convex and not check,
            points,
            records,
            walk,
            threads,
            progress,
        )

    def _interpolate_table(
        self,
        values: NDArray[Any],
        narrow: bool,
        locations: NDArray[Any],
        out: NDArray[Any],
        threads: int,
        progress: Progress | None,
    ) -> None:
        """Fill `out`, rows of points or of fields, with the interpolated `values`."""
        there = locations["triangle"] >= 0
        weights = locations["weights"][there][..., None]
        corners = values[self.triangles[locations["triangle"][there]]].astype(np.float64)
        inside = np.where(weights == 0, 0.0, weights * corners).sum(1)
        rows = out if out.shape[0] == len(locations) and _arrays.lies_in_rows(values) else out.T
        rows[...] = np.nan
        rows[there] = inside

    def __len__(self) -> int:
        """Number of triangles."""
        return self.triangle_count

    def __repr__(self) -> str:
        return (
            f"<BorrowedMesh: {self.vertex_count} vertices, {self.triangle_count} triangles"
            f"{', convex' if self.convex else ''}>"
        )
