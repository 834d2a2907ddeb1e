"""For users of pyvista: meshes in and out, and cells that are found exactly.

>>> import pyvista
>>> import meshwalk.pyvista
>>> plane = pyvista.Plane(i_resolution=4, j_resolution=4)
>>> meshwalk.pyvista.Finder(plane).find_containing_cell([0.3, 0.3, 0.0])
15
>>> meshwalk.pyvista.polydata(meshwalk.pyvista.mesh(plane)).n_cells
32

pyvista itself has to be installed.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
import pyvista

from meshwalk import _arrays
from meshwalk._drop_ins import cells as _cells
from meshwalk._locator import Locator
from meshwalk._mesh import Mesh
from meshwalk._space.prober import Prober

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

    from meshwalk._space.surface import Surface

__all__ = ["Finder", "mesh", "polydata", "surface"]

_LINES = ("VERTEX", "POLY_VERTEX", "LINE", "POLY_LINE")
_FACES = ("TRIANGLE", "QUAD", "POLYGON", "PIXEL")


def _cells_of(dataset: Any) -> _cells.Cells:
    """The faces of a dataset and what stands at them."""
    if not isinstance(dataset, pyvista.DataSet):
        raise TypeError(f"dataset must be a pyvista.DataSet, not {type(dataset).__name__}")
    grid = dataset.cast_to_unstructured_grid()
    kinds = np.asarray(grid.celltypes)
    known = {int(pyvista.CellType[name]) for name in (*_FACES, *_LINES)}
    for kind in np.unique(kinds):
        if int(kind) not in known:
            name, first = pyvista.CellType(int(kind)).name, int(np.argmax(kinds == kind))
            raise ValueError(
                f"cell {first} is of type {name}: no face with straight edges; take its surface "
                "first, such as by extract_surface()"
            )
    blocks = _blocks(grid, kinds)
    lines = np.isin(kinds, [int(pyvista.CellType[name]) for name in _LINES])
    if lines.any():
        _cells.warn_left_out("cells without area", [f"{int(lines.sum())} points and lines"])
    _cells.warn_left_out("data of the whole dataset", set(dataset.field_data.keys()) - {"crs"})
    points = np.asarray(dataset.points, np.float64)
    return _cells.Cells(points, blocks, len(kinds), dataset.point_data, dataset.cell_data)


def _blocks(grid: Any, kinds: NDArray[Any]) -> list[tuple[NDArray[np.int64], NDArray[Any]]]:
    """Cells by their number of corners."""
    first, corners = np.asarray(grid.cell_offsets), np.asarray(grid.cell_connectivity)
    sizes = np.diff(first)
    face = np.isin(kinds, [int(pyvista.CellType[name]) for name in _FACES])
    pixel = kinds == int(pyvista.CellType.PIXEL)
    blocks = []
    for size in np.unique(sizes[face]):
        number = np.flatnonzero(face & (sizes == size))
        rows = corners[first[number][:, None] + np.arange(size)]
        if size == 4:
            turned = pixel[number]
            rows[turned] = rows[turned][:, [0, 1, 3, 2]]
        blocks.append((number, rows))
    return blocks


def mesh(dataset: Any) -> Mesh:
    """Make a mesh of the plane of a dataset of pyvista.

    Parameters
    ----------
    dataset : pyvista.DataSet
        Its cells are triangles, quads, pixels and polygons: a ``PolyData``, or a grid of one layer.

    Returns
    -------
    meshwalk.Mesh
        Larger cells are cut into triangles; then the field ``cell`` of the triangles has the number
        of the cell. Heights other than 0 become the field ``z``. Arrays of real numbers become
        fields, those with components several, ``name[0]`` and so on. ``field_data["crs"]`` becomes
        the coordinate system.

    Raises
    ------
    ValueError
        A cell is no face with straight edges, or cannot be cut.
    InputError
        Cells overlap, see `meshwalk.Mesh`.

    Warns
    -----
    UserWarning
        Something is left out: points and lines, arrays of other types, other data of the whole
        dataset. The message names it.
    """
    crs = dataset.field_data["crs"][0] if "crs" in getattr(dataset, "field_data", ()) else None
    return _cells.mesh_of(_cells_of(dataset), None if crs is None else str(crs))


def surface(dataset: Any) -> tuple[Surface, NDArray[np.int64]]:
    """Make a surface in space of a dataset of pyvista.

    Parameters
    ----------
    dataset : pyvista.DataSet
        As of `mesh`.

    Returns
    -------
    surface : meshwalk.Surface
        With the arrays of the points as fields.
    cell : ndarray of int64, shape (m,)
        The cell that each triangle is a part of; ``dataset.cell_data[name][cell]`` are the values
        of triangles.
    """
    return _cells.surface_of(_cells_of(dataset))


def polydata(mesh: Mesh | Surface) -> Any:
    """Make a ``pyvista.PolyData`` of a mesh or a surface.

    Parameters
    ----------
    mesh : meshwalk.Mesh or meshwalk.Surface
        The field ``z`` of a mesh gives the heights, which otherwise are 0.

    Returns
    -------
    pyvista.PolyData
        With all fields; ``name[0]``, ``name[1]`` become one array. ``field_data["crs"]`` has the
        coordinate system.
    """
    made = pyvista.PolyData.from_regular_faces(_cells.places(mesh), mesh.triangles)
    for name, values in _cells.joined(mesh.fields).items():
        made.point_data[name] = values
    if isinstance(mesh, Mesh):
        for name, values in _cells.joined(mesh.triangle_fields).items():
            made.cell_data[name] = values
        if mesh.crs is not None:
            made.field_data["crs"] = [mesh.crs]
    return made


class Finder:
    """Finds cells of a dataset, with the calls of ``pyvista.DataSet``.

    Parameters
    ----------
    dataset : pyvista.DataSet
        As of `mesh`. It is read once: make a new finder when it changes.
    from_above : bool, optional
        Look along z: heights of cells and points make no difference to `find_containing_cell`.

    Notes
    -----
    Any number of threads may ask one finder. O(n) for n cells, and O(n log n) at the first question
    for closest cells.

    Examples
    --------
    >>> import pyvista
    >>> from meshwalk.pyvista import Finder
    >>> finder = Finder(pyvista.Plane(i_resolution=4, j_resolution=4))
    >>> finder.find_containing_cell([[0.3, 0.3, 0], [0.3, 0.3, 1], [0.25, 0.25, 0]])
    array([15, -1, 10])
    >>> finder.find_closest_cell([0.3, 0.3, 1])
    15
    """

    def __init__(self, dataset: Any, *, from_above: bool = False) -> None:
        self._given = _cells_of(dataset)
        self._triangles, self._cell = self._given.cut()
        self._from_above = from_above
        self._locator: Locator | None = None
        self._prober: Prober | None = None

    def _ask_locator(self) -> Locator:
        if self._locator is None:
            points = self._given.points
            if not self._from_above and (points[:, 2] != points[0, 2]).any():
                raise ValueError(
                    "the cells are not in one plane z = const, so nearly no point is in one: ask "
                    "for the closest cell, or look from_above"
                )
            self._locator = Locator(Mesh(points[:, :2], self._triangles, tolerant=True))
        return self._locator

    def _ask_prober(self) -> Prober:
        if self._prober is None:
            surface, _ = _cells.surface_of(self._given._replace(point_data={}))
            self._prober = Prober(surface, boxes=True)
        return self._prober

    def _number(self, triangle: NDArray[Any]) -> NDArray[np.int64]:
        number = np.full(len(triangle), -1)
        number[triangle >= 0] = self._cell[triangle[triangle >= 0]]
        return number

    def find_containing_cell(self, point: ArrayLike) -> Any:
        """Find the cell that contains a point, or those of many points.

        Parameters
        ----------
        point : array_like, shape (3,) or (n, 3)
            The points.

        Returns
        -------
        int, or ndarray of int64, shape (n,)
            The cells, -1 for points in none. Of several, the lowest.

        Raises
        ------
        ValueError
            The cells are not all at one height.
        """
        rows, shape = _arrays.queries(point, "point", 3)
        triangle = np.full(len(rows), -1)
        if len(self._cell):
            triangle = np.array(self._ask_locator().locate(rows[:, :2]).triangle)
            if not self._from_above:
                triangle[rows[:, 2] != self._given.points[0, 2]] = -1
        number = self._number(triangle)
        return number.reshape(shape) if shape else int(number[0])

    def find_closest_cell(self, point: ArrayLike, return_closest_point: bool = False) -> Any:
        """Find the cell that is closest to a point, or those of many points.

        Parameters
        ----------
        point : array_like, shape (3,) or (n, 3)
            The points.
        return_closest_point : bool, optional
            Give the closest points of the cells, too.

        Returns
        -------
        cell : int, or ndarray of int64, shape (n,)
            The cells; of several at the same rounded distance the lowest. -1 for a point that is
            not finite.
        closest : ndarray, shape (3,) or (n, 3)
            The closest points, if asked for; NaN for a point that is not finite.
        """
        rows, shape = _arrays.queries(point, "point", 3)
        found = self._ask_prober().nearest(rows)
        number = self._number(found.triangle)
        cell: Any = number.reshape(shape) if shape else int(number[0])
        return (cell, found.point.reshape(*shape, 3)) if return_closest_point else cell
