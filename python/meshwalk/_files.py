"""Meshes in files."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from meshwalk import _arrays, _core
from meshwalk._mesh import Mesh

if TYPE_CHECKING:
    import os

    from numpy.typing import NDArray

mesh_formats: tuple[str, ...] = _core.MESH_FORMATS
"""Names of the formats that `write` takes."""


def read(path: str | os.PathLike[str]) -> Mesh:
    """Read a mesh from a file, gzipped or not.

    Parameters
    ----------
    path : str or path-like
        OFF, OBJ, PLY, STL or Triangle's ``.node``/``.ele``: recognised by content, else by name.

    Returns
    -------
    Mesh
        With the file's numbering. z, and further values at the vertices, are its fields. Faces of
        more than three corners are cut into triangles.

    Raises
    ------
    OSError
        The file cannot be opened or read; ``FileNotFoundError`` where there is none.
    InputError
        It is malformed, of no known format, or its mesh has a defect that `Mesh` refuses.

    See Also
    --------
    write : the opposite.

    Examples
    --------
    >>> import meshwalk, os, tempfile
    >>> name = os.path.join(tempfile.mkdtemp(), "small.ply")
    >>> meshwalk.Mesh([[0, 0, 7], [4, 0, 8], [0, 4, 9]], [[0, 1, 2]]).write(name)
    >>> meshwalk.read(name).fields["z"]
    array([7., 8., 9.])
    """
    xyz, triangles, has_z, fields = read_arrays(path)
    return Mesh(xyz if has_z else xyz[:, :2], triangles, fields)


def read_arrays(
    path: str | os.PathLike[str],
) -> tuple[NDArray[np.float64], NDArray[np.uint32], bool, dict[str, NDArray[np.float64]]]:
    """x, y, z; triangles; whether the file has z; further values at the vertices by name."""
    points, triangles, has_z, fields, _ = _read(_arrays.path(path))
    return (
        np.frombuffer(points, np.float64).reshape(-1, 3),
        np.frombuffer(triangles, np.uint32).reshape(-1, 3),
        bool(has_z),
        {name: np.frombuffer(values, np.float64) for name, values in fields.items()},
    )


def _read(name: bytes) -> tuple[memoryview, memoryview, int, dict[str, memoryview], int]:
    try:
        return _core.read_mesh(name)
    except OSError as error:
        import os

        if os.path.exists(name):
            raise
        raise FileNotFoundError(*error.args) from None


def write(path: str | os.PathLike[str], mesh: Mesh, format: str | None = None) -> None:
    """Write a mesh to a file, which appears when it is complete.

    Parameters
    ----------
    path : str or path-like
        The file.
    mesh : Mesh
        The mesh; its field ``"z"`` is the third coordinate, others are written where the format has
        values at the vertices (PLY, ``.node``, VTK, CSV).
    format : str, optional
        One of `mesh_formats`; by default the ending of the path says it.

    Raises
    ------
    OSError
        The file cannot be written.
    ValueError
        The format is not known.

    See Also
    --------
    read : the opposite.

    Examples
    --------
    >>> import meshwalk
    >>> meshwalk.mesh_formats
    ('off', 'ply', 'ply-ascii', 'node', 'obj', 'stl', 'csv', 'vtk')
    """
    points = np.zeros((mesh.vertex_count, 3))
    points[:, :2] = mesh.points
    fields = dict(mesh.fields)
    heights = fields.pop("z", None)
    if heights is not None:
        points[:, 2] = heights
    named = [(_arrays.field_name(name), values) for name, values in fields.items()]
    triangles = mesh.triangles.astype(np.uint32, copy=False)
    _core.write_mesh(_arrays.path(path), format, points, heights is not None, triangles, named)
