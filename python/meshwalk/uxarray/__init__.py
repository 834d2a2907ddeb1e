"""Drop-in for users of uxarray: which faces of a grid of the sphere contain points, exactly.

`use` makes all grids of uxarray answer `get_faces_containing_point` with it. `FaceFinder` answers
for one grid:

>>> import numpy as np, uxarray
>>> from meshwalk.uxarray import FaceFinder
>>> lon, lat = [0.0, 90, 180, 270, 0, 0], [0.0, 0, 0, 0, 90, -90]
>>> corners = [[k, (k + 1) % 4, 4] for k in range(4)] + [[(k + 1) % 4, k, 5] for k in range(4)]
>>> grid = uxarray.Grid.from_topology(np.array(lon), np.array(lat), np.array(corners))
>>> faces, counts = FaceFinder(grid).get_faces_containing_point([[45, 45], [-45, -45]])
>>> faces.tolist(), counts.tolist()
([[0], [7]], [1, 1])
"""

from __future__ import annotations

import warnings
from typing import TYPE_CHECKING, Any

import numpy as np

from meshwalk._drop_ins.faces import cut_facets
from meshwalk._drop_ins.sphere import Directions, SphereLocator, fans_of_places
from meshwalk._errors import InputError
from meshwalk._where import Where

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

__all__ = ["FaceFinder", "use"]

_FILL = np.iinfo(np.intp).min
"""Behind the last face of a point, as uxarray has it."""


class FaceFinder:
    """Finds the faces of a `uxarray.Grid` that contain points.

    Parameters
    ----------
    grid : uxarray.Grid
        Its faces cover the whole sphere, or lie within a hemisphere, or have sides of at most 30
        degrees. They may have any number of corners; their sides are arcs of great circles.

    Raises
    ------
    InputError
        The faces overlap, or leave a part of the sphere open, reach beyond a hemisphere and have
        longer sides; the exception names the first place.

    Notes
    -----
    A point is a ray from the centre of the sphere, and answers are exact: for the directions and
    nodes that uxarray itself makes of longitudes and latitudes. A point has several faces only if
    it lies exactly on a side or a node of theirs. Any number of threads may ask one finder at a
    time.

    Examples
    --------
    See `meshwalk.uxarray`.
    """

    def __init__(self, grid: Any) -> None:
        nodes = np.stack([grid.node_x.values, grid.node_y.values, grid.node_z.values], axis=1)
        faces = np.array(grid.face_node_connectivity.values, np.intp)
        faces[faces < 0] = -1
        triangles, self._face = cut_facets(nodes, faces)
        self._locator = SphereLocator(nodes, triangles)
        self._triangles, self._faces, self._nodes = triangles, faces, nodes
        self._of_place: tuple[NDArray[np.intp], ...] | None = None

    def get_faces_containing_point(
        self, points: ArrayLike, return_counts: bool = True
    ) -> tuple[NDArray[np.intp], NDArray[np.intp]] | list[list[int]]:
        """Find the faces that contain points.

        Parameters
        ----------
        points : array_like, shape (n, 2), (2,), (n, 3) or (3,)
            Longitudes and latitudes in degrees, or directions.
        return_counts : bool, optional
            Whether an array and the numbers of faces come back, or a list for each point.

        Returns
        -------
        face : ndarray of int, shape (n, k)
            The faces of each point, ascending; behind them the least integer.
        count : ndarray of int, shape (n,)
            How many faces each point has; or, without `return_counts`, a list of lists.
        """
        from uxarray.grid.coordinates import points_atleast_2d_xyz

        hit = self._locator.locate(np.asarray(points_atleast_2d_xyz(points), np.float64))
        first = hit.triangle
        if self._face is not None:
            first = np.where(first < 0, -1, self._face[first])
        shared = (hit.where == Where.EDGE) | (hit.where == Where.VERTEX)
        count = (first >= 0).astype(np.intp)
        face = np.where(first < 0, _FILL, first)[:, None]
        if shared.any():
            face, count = self._all_faces(hit, np.flatnonzero(shared), face, count)
        if return_counts:
            return face, count
        return [row[:n] for row, n in zip(face.tolist(), count.tolist(), strict=True)]

    def _all_faces(
        self,
        hit: Directions,
        rows: NDArray[np.intp],
        face: NDArray[np.intp],
        count: NDArray[np.intp],
    ) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
        """Add the other faces of points on sides and nodes."""
        place, begin, around = self._places()
        triangle, local = hit.triangle[rows], hit.local[rows]
        node = place[self._triangles[triangle, local]]
        end = place[self._triangles[triangle, (local + 1) % 3]]
        many = begin[node + 1] - begin[node]
        of = np.repeat(np.arange(len(rows)), many)
        step = np.arange(len(of)) - np.repeat(np.cumsum(many) - many, many)
        found = around[begin[node[of]] + step]
        has_end = np.zeros(len(of), bool)
        for corner in self._faces[found].T:
            has_end |= (corner >= 0) & (place[corner] == end[of])
        kept = (hit.where[rows[of]] == Where.VERTEX) | has_end
        of, found = of[kept], found[kept]
        count = count.copy()
        count[rows] = np.bincount(of, minlength=len(rows))
        if count.max() > 1:
            wide = np.full((len(face), max(self._faces.shape[1], int(count.max()))), _FILL)
            wide[:, :1] = face
            number = np.arange(len(of)) - np.searchsorted(of, of)
            wide[rows[of], number] = found
            face = wide
        return face, count

    def _places(self) -> tuple[NDArray[np.intp], ...]:
        """The place of each node, equal nodes have one; and the faces around each place."""
        if self._of_place is None:
            self._of_place = fans_of_places(self._nodes, self._faces)
        return self._of_place


def use(enabled: bool = True) -> None:
    """Let all grids of uxarray find faces with `FaceFinder`, from now on.

    Parameters
    ----------
    enabled : bool, optional
        False goes back to uxarray's own search.

    Warns
    -----
    UserWarning
        Later, for a grid that `FaceFinder` refuses: it is left to uxarray.

    Examples
    --------
    >>> import meshwalk.uxarray
    >>> meshwalk.uxarray.use()
    >>> meshwalk.uxarray.use(False)
    """
    import uxarray

    method = uxarray.Grid.get_faces_containing_point
    own = getattr(method, "_of_uxarray", None)
    if not enabled:
        if own is not None:
            uxarray.Grid.get_faces_containing_point = own
        return
    if own is not None:
        return

    def get_faces_containing_point(grid: Any, points: ArrayLike, return_counts: bool = True) -> Any:
        if not hasattr(grid, "_meshwalk_finder"):
            try:
                grid._meshwalk_finder = FaceFinder(grid)
            except (InputError, ValueError) as error:
                warnings.warn(f"uxarray searches this grid: {error}", stacklevel=2)
                grid._meshwalk_finder = None
        if grid._meshwalk_finder is None:
            return method(grid, points, return_counts)
        return grid._meshwalk_finder.get_faces_containing_point(points, return_counts)

    get_faces_containing_point.__doc__ = method.__doc__
    get_faces_containing_point._of_uxarray = method  # type: ignore[attr-defined]
    uxarray.Grid.get_faces_containing_point = get_faces_containing_point
