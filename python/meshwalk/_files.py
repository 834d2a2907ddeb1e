"""Meshes and points in files."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from meshwalk import _arrays, _core
from meshwalk._mesh import Mesh

if TYPE_CHECKING:
    import os
    from collections.abc import Iterable

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
        raise _found(error, name) from None


def _found(error: OSError, name: bytes) -> OSError:
    """The same error, or FileNotFoundError where there is no such file."""
    import os

    return error if os.path.exists(name) else FileNotFoundError(*error.args)


def read_points(
    path: str | os.PathLike[str],
    columns: str | None = None,
    classes: Iterable[int] = (),
) -> tuple[NDArray[np.float64], list[str]]:
    r"""Read points from a table of text or from LAS; from LAZ where laspy is installed.

    Parameters
    ----------
    path : str or path-like
        CSV or columns separated by semicolons, tabs or blanks, with or without a header, gzipped or
        not; LAS; LAZ.
    columns : str, optional
        Names or numbers from 1 of the columns wanted, such as ``"x,y,z"``. By default those that
        hold numbers in the first row; x and y (or lon and lat) and z first where a header has them;
        of LAS and LAZ x, y, z.
    classes : iterable of int, optional
        Of LAS and LAZ: only points of these classes; by default all.

    Returns
    -------
    points : ndarray, shape (n, number of columns)
        A row for each point. An empty field is NaN.
    names : list of str
        Of the columns.

    Raises
    ------
    OSError
        The file cannot be opened or read; ``FileNotFoundError`` where there is none.
    InputError
        It is malformed; the exception's `line` tells where.
    ImportError
        The file is LAZ, and ``laspy[lazrs]`` is not installed.

    Examples
    --------
    >>> import meshwalk, os, tempfile
    >>> name = os.path.join(tempfile.mkdtemp(), "points.csv")
    >>> with open(name, "w") as file:
    ...     _ = file.write("z,x,y\n7,1,2\n8,3,4\n")
    >>> points, names = meshwalk.read_points(name)
    >>> names
    ['x', 'y', 'z']
    >>> points
    array([[1., 2., 7.],
           [3., 4., 8.]])
    """
    name = _arrays.path(path)
    wanted = bytearray(256)
    for number in classes:
        if not 0 <= number < 256:
            raise ValueError(f"there is no class {number}")
        wanted[number] = 1
    if name.lower().endswith(b".laz"):
        return _read_laz(name, columns, wanted)
    try:
        values, names = _core.read_points(name, columns, bytes(wanted))
    except OSError as error:
        raise _found(error, name) from None
    return np.frombuffer(values, np.float64).reshape(-1, len(names)), names


def _read_laz(
    name: bytes, columns: str | None, classes: bytearray
) -> tuple[NDArray[np.float64], list[str]]:
    try:
        import laspy
    except ImportError:
        raise ImportError("to read LAZ, install laspy[lazrs]; or unpack it to LAS") from None
    import os

    las = laspy.read(os.fsdecode(name))
    names = [column.strip() for column in (columns or "x,y,z").split(",")]
    chosen = np.asarray(classes, bool)[las.classification] if any(classes) else slice(None)
    table = [np.asarray(las[column], np.float64)[chosen] for column in names]
    return np.column_stack(table), names


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
