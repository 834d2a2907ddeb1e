"""For users of meshio and meshlane: meshes in and out.

>>> import meshio
>>> import meshwalk.meshio
>>> given = meshio.Mesh([[0, 0], [4, 0], [4, 4], [0, 4]], [("quad", [[0, 1, 2, 3]])])
>>> mesh = meshwalk.meshio.mesh(given)
>>> mesh
<Mesh: 4 vertices, 2 triangles, of triangles: cell>
>>> meshwalk.meshio.cells(mesh).cells
[<meshio CellBlock, type: triangle, num cells: 2, tags: []>]

`cells` gives a mesh of meshio, or of meshlane if that is named; the other functions take both.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from meshwalk._drop_ins import cells as _cells
from meshwalk._mesh import Mesh

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from meshwalk._space.surface import Surface

__all__ = ["cells", "mesh", "surface"]

_FACES = ("triangle", "quad", "polygon")
_LINES = ("vertex", "line")


def _cells_of(given: Any) -> _cells.Cells:
    """The faces of a mesh and what stands at them."""
    blocks, first, lines = [], 0, 0
    for block in given.cells:
        count = len(block.data)
        if block.type in _LINES:
            lines += count
        elif block.type in _FACES and count:
            blocks.append((np.arange(first, first + count), np.asarray(block.data)))
        elif count:
            raise ValueError(
                f"cell {first} is of type {block.type}: no face with straight edges; take the "
                "surface of solids, and the corners of curved cells, first"
            )
        first += count
    if lines:
        _cells.warn_left_out("cells without area", [f"{lines} points and lines"])
    for what in ("field_data", "point_sets", "cell_sets"):
        _cells.warn_left_out(what, map(str, getattr(given, what, None) or ()))
    points = np.zeros((len(given.points), 3))
    points[:, : np.shape(given.points)[1]] = given.points
    data = {name: np.concatenate(parts) for name, parts in given.cell_data.items() if parts}
    return _cells.Cells(points, blocks, first, given.point_data, data)


def mesh(given: Any, crs: str | None = None) -> Mesh:
    """Make a mesh of the plane of a mesh of meshio or meshlane.

    Parameters
    ----------
    given : meshio.Mesh or meshlane.Mesh
        Its cells are triangles, quads and polygons.
    crs : str, optional
        The coordinate system, for which these have no place.

    Returns
    -------
    meshwalk.Mesh
        Larger cells are cut into triangles; then, and where cells are left out, the field ``cell``
        of the triangles has the number of the cell, counted over all blocks. Heights other than 0
        become the field ``z``. Data of real numbers become fields, those with components several,
        ``name[0]`` and so on.

    Raises
    ------
    ValueError
        A cell is no face with straight edges, or cannot be cut.
    InputError
        Cells overlap, see `meshwalk.Mesh`.

    Warns
    -----
    UserWarning
        Something is left out: points and lines, data of other types, ``field_data``, sets. The
        message names it.
    """
    return _cells.mesh_of(_cells_of(given), crs)


def surface(given: Any) -> tuple[Surface, NDArray[np.int64]]:
    """Make a surface in space of a mesh of meshio or meshlane.

    Parameters
    ----------
    given : meshio.Mesh or meshlane.Mesh
        As of `mesh`.

    Returns
    -------
    surface : meshwalk.Surface
        With the data of the points as fields.
    cell : ndarray of int64, shape (m,)
        The cell that each triangle is a part of, counted over all blocks.
    """
    return _cells.surface_of(_cells_of(given))


def cells(mesh: Mesh | Surface, library: Literal["meshio", "meshlane"] = "meshio") -> Any:
    """Make a mesh of meshio or meshlane of a mesh or a surface.

    Parameters
    ----------
    mesh : meshwalk.Mesh or meshwalk.Surface
        The field ``z`` of a mesh gives the heights; without it points have two coordinates.
    library : {"meshio", "meshlane"}, optional
        Whose mesh is wanted.

    Returns
    -------
    meshio.Mesh or meshlane.Mesh
        With all fields; ``name[0]``, ``name[1]`` become one array. The coordinate system has no
        place there.
    """
    if library not in ("meshio", "meshlane"):
        raise ValueError(f"library must be 'meshio' or 'meshlane', not {library!r}")
    flat = isinstance(mesh, Mesh) and "z" not in mesh.fields
    points = mesh.points if flat else _cells.places(mesh)
    of_triangles = mesh.triangle_fields if isinstance(mesh, Mesh) else {}
    return import_module(library).Mesh(
        points,
        [("triangle", mesh.triangles)],
        point_data=_cells.joined(mesh.fields),
        cell_data={name: [values] for name, values in _cells.joined(of_triangles).items()},
    )
