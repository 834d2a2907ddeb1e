"""Drop-in for users of Parcels 4: the search for the cells of particles, exact, in doubles.

`use` makes all grids of Parcels search with it: `UxGrid` of triangles, and curvilinear `XGrid`.
`SpatialHash` is the search of one grid, the object of ``grid.get_spatial_hash()``.

>>> import meshwalk.parcels
>>> meshwalk.parcels.use()
>>> meshwalk.parcels.use(False)
"""

from __future__ import annotations

import warnings
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from meshwalk._drop_ins.faces import cut_faces, cut_facets, turn
from meshwalk._drop_ins.sphere import SphereLocator
from meshwalk._errors import InputError
from meshwalk._locator import Locator
from meshwalk._where import Where

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

__all__ = ["SpatialHash", "use"]

_NOT_FOUND = -3
"""Parcels' GRID_SEARCH_ERROR."""
_TOLERANCE = 1e-6
"""How negative the weights of a particle outside of a flat grid may be, as Parcels has it: floats
hold positions by default."""

_OWN = ("_grid", "_plane", "_sphere", "_turned", "_cell", "_hints", "_original")


class SpatialHash:
    """Finds the cells of a grid that contain particles, with the calls of Parcels' own.

    Parameters
    ----------
    grid : parcels.UxGrid or parcels.XGrid
        Triangles, or quads on curved lines; flat, or on the sphere, where sides are great circles.

    Raises
    ------
    InputError
        Cells overlap; or, on the sphere, the grid is open and larger than a hemisphere, and has
        sides of more than 30 degrees. The exception names the first place.

    Notes
    -----
    The cells of the last query are kept: a query of as many points begins its searches there. One
    thread at a time may use an object. Cells with a node that is not finite contain nothing. What
    belongs to Parcels' own table, such as `describe`, makes that table.

    Examples
    --------
    See `meshwalk.parcels`.
    """

    def __init__(self, grid: Any) -> None:
        self._grid = grid
        self._is_unstructured = hasattr(grid, "uxgrid")
        lonlat, faces, self._shape = _cells_of(grid)
        finite = np.asarray(np.isfinite(lonlat).all(axis=1))
        self._cell = np.flatnonzero(finite[faces].all(axis=1))
        faces, lonlat = faces[self._cell], np.where(finite[:, None], lonlat, 0.0)
        self._hints: NDArray[np.intp] | None = None
        self._sphere = None
        if grid._mesh.is_spherical():
            nodes = _directions(*lonlat.T)
            triangles, face = cut_facets(nodes, faces)
            self._turned = (triangles[:, 1] != faces[:, 1]) if face is None else None
            self._sphere = SphereLocator(nodes, triangles)
        else:
            cells = cut_faces(lonlat, faces)
            face = cells.face
            self._plane = Locator(cells.mesh, border=True)
            sides = lonlat[faces] - lonlat[np.roll(faces, 1, axis=1)]
            self._tolerance = _TOLERANCE * float(np.hypot(sides[..., 0], sides[..., 1]).max())
        if face is not None:
            self._cell = self._cell[face]

    @cached_property
    def _original(self) -> Any:
        from parcels._core.spatialhash import SpatialHash as Original

        return Original(self._grid)

    def __getattr__(self, name: str) -> Any:
        """What belongs to Parcels' table itself, such as `describe`."""
        if name.startswith("__") or name in _OWN:
            raise AttributeError(name)
        return getattr(self._original, name)

    def query(
        self, y: ArrayLike, x: ArrayLike
    ) -> tuple[NDArray[np.int32], NDArray[np.int32], NDArray[np.float64]]:
        """Find the cells of points.

        Parameters
        ----------
        y, x : array_like, shape (n,)
            Latitudes and longitudes, or y and x of a flat grid.

        Returns
        -------
        j, i : ndarray of int32, shape (n,)
            The indices of the cell; of triangles j is 0, and i the face. -3 for points in none.
        coords : ndarray of double, shape (n, 3) or (n, 2)
            The weights of the corners of the triangle, or xsi and eta in the quad; -1 for points in
            none.
        """
        return self.query_from(y, x, None)

    def query_from(
        self, y: ArrayLike, x: ArrayLike, face: ArrayLike | None
    ) -> tuple[NDArray[np.int32], NDArray[np.int32], NDArray[np.float64]]:
        """Find the cells of points, as `query`, each from a cell where it may be.

        Parameters
        ----------
        y, x : array_like, shape (n,)
            The points.
        face : array_like of int, shape (n,), or None
            Of triangles: where searches begin; negative for anywhere. It has no part in the
            answers. By default, the cells of the last query.

        Returns
        -------
        j, i, coords
            As of `query`.
        """
        place = np.stack(
            [np.asarray(v, np.float64).reshape(-1) for v in np.broadcast_arrays(x, y)], axis=1
        )
        triangle, weights = self._locate(place, face)
        cell = np.where(triangle < 0, -1, self._cell[triangle])
        found = cell >= 0
        j, i = np.full((2, len(cell)), _NOT_FOUND, np.int32)
        j[found], i[found] = np.unravel_index(cell[found], self._shape)
        if self._is_unstructured:
            return j, i, np.where(found[:, None], weights, -1.0)
        coords = np.full((len(cell), 2), -1.0)
        if found.any():
            from parcels._core.index_search import curvilinear_point_in_cell

            x_found, y_found = place[found].T
            _, local = curvilinear_point_in_cell(self._grid, y_found, x_found, j[found], i[found])
            coords[found] = local
        return j, i, coords

    def _locate(
        self, place: NDArray[np.float64], face: ArrayLike | None
    ) -> tuple[NDArray[np.intp], NDArray[np.float64]]:
        """The triangles of points, and the weights of their corners."""
        if self._sphere is not None:
            hit = self._sphere.locate(_directions(*place.T))
            weights = hit.weights
            if self._turned is not None:  # back to the order of the grid
                turned = (hit.triangle >= 0) & self._turned[hit.triangle]
                weights = np.where(turned[:, None], weights[:, [0, 2, 1]], weights)
            return hit.triangle, weights
        hints = self._hints
        if face is not None and self._is_unstructured:
            hints = np.asarray(face, np.intp).reshape(-1)
        if hints is not None and len(hints) != len(place):
            hints = None
        found = self._plane.locate(place, tolerance=self._tolerance, hints=hints)
        triangle, weights = found.triangle.astype(np.intp), found.weights
        near = np.flatnonzero(found.where == Where.NEAR)
        if len(near):
            weights = weights.copy()
            weights[near] = self._weights_outside(place[near], triangle[near])
            triangle[near[weights[near].min(axis=1) < -_TOLERANCE]] = -1
        self._hints = triangle
        return triangle, weights

    def _weights_outside(
        self, place: NDArray[np.float64], triangle: NDArray[np.intp]
    ) -> NDArray[np.float64]:
        """Weights of points outside of triangles: negative ones tell how far."""
        mesh = self._plane.mesh
        a, b, c = np.moveaxis(mesh.points[mesh.triangles[triangle]], 1, 0)
        spanned = np.stack([turn(b, c, place), turn(c, a, place), turn(a, b, place)], axis=1)
        return np.asarray(spanned / turn(a, b, c)[:, None])


def _cells_of(
    grid: Any,
) -> tuple[NDArray[np.float64], NDArray[np.intp], tuple[int, int]]:
    """Coordinates of the nodes, the corners of the cells, and how the cells are counted."""
    if hasattr(grid, "uxgrid"):
        nodes = grid.uxgrid
        faces = np.asarray(nodes.face_node_connectivity.values, np.intp)
        lonlat = np.stack([nodes.node_lon.values, nodes.node_lat.values], axis=1)
        return lonlat.astype(np.float64), faces, (1, len(faces))
    lon, lat = np.asarray(grid.lon, np.float64), np.asarray(grid.lat, np.float64)
    if lon.ndim != 2:
        raise ValueError("the cells of a rectilinear grid need no search")
    rows, columns = lon.shape
    corner = (np.arange(columns - 1) + columns * np.arange(rows - 1)[:, None]).reshape(-1)
    faces = np.stack([corner, corner + 1, corner + columns + 1, corner + columns], axis=1)
    return np.stack([lon, lat], axis=-1).reshape(-1, 2), faces, (rows - 1, columns - 1)


def _directions(lon: NDArray[Any], lat: NDArray[Any]) -> NDArray[np.float64]:
    """Directions of longitudes and latitudes in degrees, as Parcels computes them."""
    from parcels._core.index_search import _latlon_rad_to_xyz

    return np.stack(_latlon_rad_to_xyz(np.deg2rad(lat), np.deg2rad(lon)), axis=-1)


def use(enabled: bool = True) -> None:
    """Let all grids of Parcels search with `SpatialHash`, from now on.

    `UxGrid.search` then takes positions in doubles, and begins each search at the particle's last
    cell.

    Parameters
    ----------
    enabled : bool, optional
        False goes back to Parcels' own search, for grids that have not searched yet.

    Warns
    -----
    UserWarning
        Later, for a grid that `SpatialHash` refuses: it is left to Parcels.

    Examples
    --------
    >>> import meshwalk.parcels
    >>> meshwalk.parcels.use()
    >>> meshwalk.parcels.use(False)
    """
    from parcels._core.basegrid import BaseGrid
    from parcels._core.uxgrid import UxGrid

    own = getattr(BaseGrid.get_spatial_hash, "_of_parcels", None)
    if enabled and own is None:
        BaseGrid.get_spatial_hash = _hash_of(BaseGrid.get_spatial_hash)
        UxGrid.search = _search_of(UxGrid.search)
    elif not enabled and own is not None:
        BaseGrid.get_spatial_hash = own
        UxGrid.search = UxGrid.search._of_parcels


def _hash_of(own: Any) -> Any:
    def get_spatial_hash(grid: Any, reconstruct: bool = False) -> Any:
        if grid._spatialhash is None or reconstruct:
            try:
                grid._spatialhash = SpatialHash(grid)
            except (InputError, ValueError) as error:
                warnings.warn(f"Parcels searches this grid: {error}", stacklevel=2)
                return own(grid, reconstruct)
        return grid._spatialhash

    get_spatial_hash.__doc__ = own.__doc__
    get_spatial_hash._of_parcels = own  # type: ignore[attr-defined]
    return get_spatial_hash


def _search_of(own: Any) -> Any:
    def search(
        grid: Any,
        z: ArrayLike,
        y: ArrayLike,
        x: ArrayLike,
        ei: Any = None,
        ti: Any = None,
        tau: Any = None,
        tol: float = 1e-6,
    ) -> dict[str, dict[str, Any]]:
        cells = grid.get_spatial_hash()
        if not isinstance(cells, SpatialHash):
            result: dict[str, dict[str, Any]] = own(grid, z, y, x, ei, ti, tau, tol)
            return result
        from parcels._core.index_search import _search_1d_array

        z = np.asarray(z, np.float32)
        face = grid.unravel_index(ei).get("FACE") if np.any(ei) else None
        _, found, coords = cells.query_from(y, x, face)
        if grid.z.ndim == 3:
            layer, zeta = grid._search_time_varying_z(z, found, coords, ti, tau)
        else:
            layer, zeta = _search_1d_array(grid.z.values, z)
        return {
            "Z": {"index": layer, "bcoord": zeta},
            "FACE": {"index": found, "bcoord": coords},
        }

    search.__doc__ = own.__doc__
    search._of_parcels = own  # type: ignore[attr-defined]
    return search
