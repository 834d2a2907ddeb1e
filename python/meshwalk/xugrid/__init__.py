"""Drop-in for users of xugrid: the cell tree of a grid, exact, without Numba and without a tree.

`use` makes all grids of xugrid search with it, its regridders included. `CellTree2d` is the search
itself, with the calls of `numba_celltree.CellTree2d`:

>>> from meshwalk.xugrid import CellTree2d
>>> vertices = [[0, 0], [4, 0], [4, 4], [0, 4], [8, 2]]
>>> tree = CellTree2d(vertices, [[0, 1, 2, 3], [1, 4, 2, -1]], fill_value=-1)
>>> tree.locate_points([[1, 1], [5, 2], [9, 9]])
array([ 0,  1, -1])
>>> tree.compute_barycentric_weights([[1, 1]])[1]
array([[0.5625, 0.1875, 0.0625, 0.1875]])
"""

from __future__ import annotations

import warnings
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from meshwalk import _arrays
from meshwalk._drop_ins.faces import cut_faces
from meshwalk._errors import InputError
from meshwalk._locator import Locator
from meshwalk._overlap import remap

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import ArrayLike, NDArray

    from meshwalk._segments import Segments

__all__ = ["CellTree2d", "use"]

_LEAST_TOLERANCE, _RELATIVE_TOLERANCE = 1e-15, 1e-12
"""As numba_celltree has them: the second is of the largest diagonal of the faces' boxes."""
_NO_EDGE = 255
"""In `Segments.along`."""


class CellTree2d:
    """Finds faces, with the calls of `numba_celltree.CellTree2d`.

    Parameters
    ----------
    vertices : array_like, shape (n, 2)
        The vertices.
    faces : array_like of int, shape (m, k)
        Corners of the faces, turned either way; `fill_value` behind the last one of those with
        fewer.
    fill_value : int
        What stands for no corner.
    n_buckets, cells_per_leaf : int, optional
        Of the original's tree. They make no difference but to calls that are passed on to it.

    Raises
    ------
    InputError
        The faces overlap; the exception names the first defect.
    ValueError
        A face has fewer than three corners, or crosses itself.

    Notes
    -----
    Faces of more than three corners are cut into triangles; the answers are faces. Any number of
    threads may ask one tree at a time. Calls that are not listed here (`locate_boxes`,
    `intersect_boxes`, `locate_faces`, `bb_coords` ...) go to a tree of numba_celltree, which is
    made when the first of them comes. O(n) for n faces.

    Examples
    --------
    >>> from meshwalk.xugrid import CellTree2d
    >>> tree = CellTree2d([[0, 0], [4, 0], [0, 4]], [[0, 1, 2]], fill_value=-1)
    >>> tree.intersect_edges([[[-1, 1], [9, 1]]])
    (array([0]), array([0]), array([[[0., 1.],
            [3., 1.]]]))
    """

    def __init__(
        self,
        vertices: ArrayLike,
        faces: ArrayLike,
        fill_value: int,
        n_buckets: int = 4,
        cells_per_leaf: int = 2,
    ) -> None:
        self.vertices: NDArray[np.float64] = np.array(vertices, np.float64)
        self.faces: NDArray[np.intp] = np.array(faces, np.intp)
        if self.vertices.ndim != 2 or self.vertices.shape[1] != 2:
            raise ValueError("vertices must have shape (n_points, 2)")
        if self.faces.ndim != 2:
            raise ValueError("faces must have shape (n_face, n_max_vert)")
        self.faces[self.faces == fill_value] = -1
        self._cells = cut_faces(self.vertices, self.faces)
        self._locator = Locator(self._cells.mesh, border=True, fill="yes")
        self._of_original = (n_buckets, cells_per_leaf)

    @cached_property
    def _default_tolerance(self) -> float:
        corners = np.where(self.faces < 0, self.faces[:, :1], self.faces)
        sides = np.ptp(self.vertices[corners], axis=1)
        return max(_LEAST_TOLERANCE, _RELATIVE_TOLERANCE * float(np.hypot(*sides.T).max()))

    def _locate(self, points: ArrayLike, tolerance: float | None) -> Any:
        if tolerance is None:
            tolerance = self._default_tolerance
        # Less than the tolerance, as the original has it, not just as much.
        return self._locator.locate(points, tolerance=max(0.0, float(np.nextafter(tolerance, 0))))

    def locate_points(self, points: ArrayLike, tolerance: float | None = None) -> NDArray[np.intp]:
        """Find the faces that contain points.

        Parameters
        ----------
        points : array_like, shape (n, 2)
            The points.
        tolerance : float, optional
            Points outside of the grid by less than this count as in the nearest face. By default
            1e-12 of the largest face, as numba_celltree has it. Within the grid, and with 0,
            answers are exact.

        Returns
        -------
        ndarray of int, shape (n,)
            The faces, -1 for points in none. Of several, the lowest.
        """
        return self._cells.face_of(self._locate(points, tolerance).triangle)

    def compute_barycentric_weights(
        self, points: ArrayLike, tolerance: float | None = None
    ) -> tuple[NDArray[np.intp], NDArray[np.float64]]:
        """Find the faces that contain points, and the weights of their corners.

        Parameters
        ----------
        points, tolerance
            As of `locate_points`.

        Returns
        -------
        face : ndarray of int, shape (n,)
            The faces, -1 for points in none.
        weights : ndarray of double, shape (n, k)
            Of the corners in the order of `faces`, also where these turn clockwise; barycentric in
            triangles, Wachspress's in larger faces. 0 for points in no face.
        """
        hit = self._locate(points, tolerance)
        face = self._cells.face_of(hit.triangle)
        rows, _ = _arrays.queries(points, "points", 2)
        return face, self._cells.weights(rows, face, hit.weights)

    def intersect_edges(
        self, edge_coords: ArrayLike
    ) -> tuple[NDArray[np.intp], NDArray[np.intp], NDArray[np.float64]]:
        """Cut straight edges by the faces.

        Parameters
        ----------
        edge_coords : array_like, shape (n, 2, 2)
            Beginning and end of each edge, x and y of each.

        Returns
        -------
        edge : ndarray of int, shape (p,)
            The edge of each part, ascending.
        face : ndarray of int, shape (p,)
            The face in which the part lies. A part along a side of two faces comes twice.
        ends : ndarray of double, shape (p, 2, 2)
            Where the part begins and ends, along the edge.
        """
        edges = np.asarray(edge_coords, np.float64)
        if edges.ndim != 3 or edges.shape[1:] != (2, 2):
            raise ValueError("edges must have shape (n_edge, 2, 2)")
        pieces = self._locator.segment(edges[:, 0], edges[:, 1])
        edge, ends = pieces.segment.astype(np.intp), pieces.points()
        face = self._cells.face_of(pieces.triangle)
        beside = self._beside(pieces, face)
        if self._cells.face is not None:
            # Pieces that follow each other in one face are one part.
            on = (edge[1:] == edge[:-1]) & (face[1:] == face[:-1]) & ~pieces.gap[1:]
            on &= beside[1:] == beside[:-1]
            first = np.flatnonzero(np.concatenate([[True], ~on])[: len(edge)])
            last = np.flatnonzero(np.concatenate([~on, [True]])[: len(edge)])
            ends = np.stack([ends[first, 0], ends[last, 1]], axis=1)
            edge, face, beside = edge[first], face[first], beside[first]
        times = 1 + (beside >= 0)
        times[(edges[edge, 0] == edges[edge, 1]).all(axis=1)] = 0
        if (times == 1).all():
            return edge, face, ends
        part = np.repeat(np.arange(len(edge)), times)
        second = np.concatenate([[False], part[1:] == part[:-1]])[: len(part)]
        return edge[part], np.where(second, beside[part], face[part]), ends[part]

    def _beside(self, pieces: Segments, face: NDArray[np.intp]) -> NDArray[np.intp]:
        """The other face of pieces that run along a side of two faces; -1 for none."""
        beside = np.full(len(face), -1, np.intp)
        along = np.flatnonzero(pieces.along != _NO_EDGE)
        if len(along):
            across = self._locator.mesh.neighbours[pieces.triangle[along], pieces.along[along]]
            beside[along] = self._cells.face_of(across)
            beside[beside == face] = -1
        return beside

    def intersect_faces(
        self, vertices: ArrayLike, faces: ArrayLike, fill_value: int
    ) -> tuple[NDArray[np.intp], NDArray[np.intp], NDArray[np.float64]]:
        """Find which faces of another grid overlap with these, and the areas of the overlaps.

        Parameters
        ----------
        vertices, faces, fill_value
            The other grid, as of the class.

        Returns
        -------
        other : ndarray of int, shape (p,)
            The face of the other grid, ascending.
        face : ndarray of int, shape (p,)
            The face of this tree.
        area : ndarray of double, shape (p,)
            The area that they have in common. Overlaps are decided exactly.

        Raises
        ------
        InputError
            Faces of the other grid overlap each other.
        """
        corners: NDArray[np.intp] = np.array(faces, np.intp)
        corners[corners == fill_value] = -1
        other = cut_faces(np.asarray(vertices, np.float64), corners)
        common = remap(
            self._locator, other.mesh, source_cells=self._cells.face, target_cells=other.face
        )
        matrix = common.weights.tocsr()
        row = np.repeat(np.arange(matrix.shape[0]), np.diff(matrix.indptr))
        area = matrix.data * common.target_area[row]
        kept = area > 0
        return row[kept], matrix.indices[kept].astype(np.intp), area[kept]

    @cached_property
    def _original(self) -> Any:
        from numba_celltree import CellTree2d as Original

        return Original(self.vertices, self.faces, -1, *self._of_original)

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_"):
            raise AttributeError(name)
        return getattr(self._original, name)


class _Property:
    """What stands in for the property `celltree` of `xugrid.Ugrid2d`."""

    def __init__(self, original: property) -> None:
        self.original = original

    def __get__(self, grid: Any, _: type) -> Any:
        if grid is None:
            return self
        if grid._celltree is None:
            try:
                grid._celltree = CellTree2d(grid.node_coordinates, grid.face_node_connectivity, -1)
            except (InputError, ValueError) as error:
                warnings.warn(f"numba_celltree searches this grid: {error}", stacklevel=3)
                make: Callable[[Any], Any] = self.original.fget  # type: ignore[assignment]
                return make(grid)
        return grid._celltree


def use(enabled: bool = True) -> None:
    """Let all grids of xugrid search with `CellTree2d`, from now on.

    Parameters
    ----------
    enabled : bool, optional
        False goes back to numba_celltree, for grids that have not searched yet.

    Warns
    -----
    UserWarning
        Later, for a grid whose faces overlap: it is left to numba_celltree.

    Examples
    --------
    >>> import meshwalk.xugrid
    >>> meshwalk.xugrid.use()
    >>> import numpy as np, xugrid
    >>> grid = xugrid.Ugrid2d(np.array([0.0, 4, 0]), np.array([0.0, 0, 4]), -1,
    ...                       np.array([[0, 1, 2]]))
    >>> grid.locate_points(np.array([[1.0, 1.0], [3.0, 3.0]]))
    array([ 0, -1])
    >>> meshwalk.xugrid.use(False)
    """
    import xugrid

    current = vars(xugrid.Ugrid2d)["celltree"]
    if enabled and not isinstance(current, _Property):
        xugrid.Ugrid2d.celltree = _Property(current)
    elif not enabled and isinstance(current, _Property):
        xugrid.Ugrid2d.celltree = current.original
