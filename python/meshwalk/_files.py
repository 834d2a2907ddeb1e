"""Meshes and points in files."""

from __future__ import annotations

import warnings
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from meshwalk import _arrays, _core
from meshwalk._mesh import Mesh

if TYPE_CHECKING:
    import os
    from collections.abc import Iterable

    from numpy.typing import NDArray

    from meshwalk._core import Progress

mesh_formats: tuple[str, ...] = _core.MESH_FORMATS
"""Names of the formats that `write` takes."""


def read(
    path: str | os.PathLike[str], *, layout: str | None = None, progress: Progress | None = None
) -> Mesh:
    """Read a mesh from a file, gzipped or not.

    Parameters
    ----------
    path : str or path-like
        OFF, OBJ, PLY, STL, Triangle's ``.node``/``.ele``, ``fort.14``, ``.gr3``, ``.2dm``,
        Selafin, ``.msh``, VTK, VTU, SU2, ``.npz``, netCDF (UGRID, FVCOM, SCHISM, ADCIRC, ANUGA,
        FESOM2, ICON, MPAS, TUFLOW-FV) or prepared ``.mwm``: recognised by content, else by name.
    layout : str, optional
        Of netCDF: how the file is laid out, such as ``"fvcom"``, with ``":0"`` or ``":1"`` behind
        it for the number of the first vertex. Default: recognised.
    progress : callable, optional
        As of `Locator`.

    Returns
    -------
    Mesh
        With the file's numbering. z, and further values at the vertices, are its fields, values of
        faces (cell data of VTK, physical groups of Gmsh, variables of netCDF) its
        `Mesh.triangle_fields`. Faces of more than three corners are cut into triangles. `Mesh.crs`
        is the coordinate system that the file tells, or a ``.prj`` file beside it.

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
    xyz, triangles, has_z, fields, of_triangles, crs = _read_all(path, layout, progress)
    points = xyz if has_z else xyz[:, :2]
    return Mesh(points, triangles, fields, triangle_fields=of_triangles, crs=crs)


def read_arrays(
    path: str | os.PathLike[str], progress: Progress | None = None
) -> tuple[NDArray[np.float64], NDArray[np.uint32], bool, dict[str, NDArray[np.float64]]]:
    """x, y, z; triangles; whether the file has z; further values at the vertices by name."""
    return _read_all(path, None, progress)[:4]


def _read_all(
    path: str | os.PathLike[str], layout: str | None, progress: Progress | None
) -> tuple[
    NDArray[np.float64],
    NDArray[np.uint32],
    bool,
    dict[str, NDArray[np.float64]],
    dict[str, NDArray[np.float64]],
    str | None,
]:
    """As `read_arrays`; values of the triangles; the coordinate system."""
    name = _arrays.path(path)
    try:
        points, triangles, has_z, fields, of_triangles, crs = _core.read_mesh(
            name, layout, progress
        )
    except OSError as error:
        raise _found(error, name) from None
    return (
        np.frombuffer(points, np.float64).reshape(-1, 3),
        np.frombuffer(triangles, np.uint32).reshape(-1, 3),
        bool(has_z),
        _columns(fields),
        _columns(of_triangles),
        crs,
    )


def _columns(fields: dict[str, memoryview]) -> dict[str, NDArray[np.float64]]:
    return {name: np.frombuffer(values, np.float64) for name, values in fields.items()}


def _found(error: OSError, name: bytes) -> OSError:
    """The same error, or FileNotFoundError where there is no such file."""
    import os

    return error if os.path.exists(name) else FileNotFoundError(*error.args)


def read_points(
    path: str | os.PathLike[str],
    columns: str | None = None,
    classes: Iterable[int] = (),
    *,
    progress: Progress | None = None,
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
    progress : callable, optional
        As of `Locator`; not of LAZ, nor of a pipe.

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
        values, names = _core.read_points(name, columns, bytes(wanted), progress)
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


class SkippedRingWarning(UserWarning):
    """A ring of a file has fewer than three different points, and is left out."""


class Constraints(NamedTuple):
    """What a file has for `constrained_delaunay`: the answer of `read_constraints`.

    Attributes
    ----------
    points : ndarray of float64
        x, y of each point, shape (n, 2); and z, NaN where there is none, if the file has
        any.
    segments : NDArray[np.int32] | NDArray[np.int64]
        The two points of each segment, shape (k, 2).
    holes : ndarray of float64
        A point in each part that is to be removed, shape (h, 2).
    polygons : NDArray[np.int32] | NDArray[np.int64]
        The polygon that each segment bounds, -1 for a line, shape (k,).
    records : ndarray of uint32
        Where each segment comes from: the number of a line or feature, shape (k,).
    record : str
        What `records` counts: ``"line"``, from 1, or ``"feature"``, from 0.
    fields : dict[str, ndarray of float64]
        Further values at the points by name.
    """

    points: NDArray[np.float64]
    segments: NDArray[np.int32] | NDArray[np.int64]
    holes: NDArray[np.float64]
    polygons: NDArray[np.int32] | NDArray[np.int64]
    records: NDArray[np.uint32]
    record: str
    fields: dict[str, NDArray[np.float64]]


def read_constraints(
    path: str | os.PathLike[str], *, progress: Progress | None = None
) -> Constraints:
    r"""Read points, lines and polygons from GeoJSON or from Triangle's ``.poly``, gzipped or not.

    Parameters
    ----------
    path : str or path-like
        The file, which is recognised by content.
    progress : callable, optional
        As of `Locator`.

    Returns
    -------
    Constraints
        Its first four members are the first arguments of `constrained_delaunay`.

    Raises
    ------
    OSError
        The file cannot be opened or read; ``FileNotFoundError`` where there is none.
    InputError
        It is malformed, or of another format; GeoJSON, where the library was built without Jansson.

    Warns
    -----
    SkippedRingWarning
        A ring of a polygon has fewer than three different points.

    Examples
    --------
    >>> import meshwalk, os, tempfile
    >>> name = os.path.join(tempfile.mkdtemp(), "square.poly")
    >>> with open(name, "w") as file:
    ...     _ = file.write("4 2 0 0\n1 0 0\n2 6 0\n3 6 6\n4 0 6\n4 0\n")
    ...     _ = file.write("1 1 2\n2 2 3\n3 3 4\n4 4 1\n0\n")
    >>> given = meshwalk.read_constraints(name)
    >>> given.segments.tolist()
    [[0, 1], [1, 2], [2, 3], [3, 0]]
    >>> meshwalk.constrained_delaunay(*given[:4])
    <Mesh: 4 vertices, 2 triangles>
    """
    name = _arrays.path(path)
    try:
        raw = _core.read_constraints(name, progress)
    except OSError as error:
        raise _found(error, name) from None
    xyz = np.frombuffer(raw[0], np.float64).reshape(-1, 3)
    numbers = [np.frombuffer(part, np.uint32) for part in raw[2:5]]
    _warn_of_rings(np.frombuffer(raw[8], np.uint32).reshape(-1, 3))
    return Constraints(
        points=xyz if raw[1] else xyz[:, :2],
        segments=_arrays.numbers(numbers[0].reshape(-1, 2)),
        holes=np.frombuffer(raw[5], np.float64).reshape(-1, 2),
        polygons=_arrays.numbers(numbers[1]),
        records=numbers[2],
        record=raw[7],
        fields=_columns(raw[6]),
    )


def _warn_of_rings(skipped: NDArray[np.uint32]) -> None:
    if len(skipped):
        feature, polygon, ring = skipped[0]
        warnings.warn(
            f"{len(skipped)} rings have fewer than three different points and are left out; the"
            f" first is ring {ring} of polygon {polygon} of feature {feature}",
            SkippedRingWarning,
            stacklevel=3,
        )


def write(
    path: str | os.PathLike[str],
    mesh: Mesh,
    format: str | None = None,
    *,
    progress: Progress | None = None,
) -> None:
    """Write a mesh to a file, which appears when it is complete.

    Parameters
    ----------
    path : str or path-like
        The file.
    mesh : Mesh
        The mesh; its field ``"z"`` is the third coordinate, others are written where the format has
        values at the vertices (PLY, ``.node``, netCDF, VTK, VTU, ``.msh``, CSV), and its
        `triangle_fields` where it has values of faces (netCDF, VTK, VTU; whole numbers
        ``"physical"`` in ``.msh``). PLY and netCDF keep its coordinate system; beside files of
        other formats it goes to a ``.prj`` file.
    format : str, optional
        One of `mesh_formats`; by default the ending of the path says it.
    progress : callable, optional
        As of `Locator`.

    Raises
    ------
    OSError
        The file cannot be written; ``FileExistsError`` where a ``.prj`` file of another file stands
        beside it, with another coordinate system.
    ValueError
        The format is not known.

    Warns
    -----
    UserWarning
        A ``.prj`` file stands beside it, and the mesh's coordinate system is not known.

    See Also
    --------
    read : the opposite.

    Examples
    --------
    >>> import meshwalk
    >>> meshwalk.mesh_formats[:6]
    ('off', 'ply', 'ply-ascii', 'node', 'obj', 'stl')
    """
    points = np.zeros((mesh.vertex_count, 3))
    points[:, :2] = mesh.points
    fields = dict(mesh.fields)
    heights = fields.pop("z", None)
    if heights is not None:
        points[:, 2] = heights
    named = [(_arrays.field_name(name), values) for name, values in fields.items()]
    of_triangles = mesh.triangle_fields.items()
    others = [(_arrays.field_name(name), values) for name, values in of_triangles]
    triangles = mesh.triangles.astype(np.uint32, copy=False)
    name, has_z = _arrays.path(path), heights is not None
    crs = None if mesh.crs is None else mesh.crs.encode()
    prj = None if _keeps_crs(name, format) else _prj_to_write(name, crs)
    _core.write_mesh(name, format, points, has_z, triangles, named, others, mesh.crs, progress)
    if prj is not None and crs is not None:
        _write_prj(prj, crs)


def _keeps_crs(name: bytes, format: str | None) -> bool:
    if format:
        return format in ("ply", "ply-ascii", "netcdf")
    return name.lower().endswith((b".ply", b".nc", b".nc4"))


def _prj_to_write(name: bytes, crs: bytes | None) -> bytes | None:
    """The .prj file that is to be written beside a file; None: it is right as it is."""
    import os

    prj = os.path.splitext(name)[0] + b".prj"
    try:
        with open(prj, "rb") as file:
            there = b" ".join(file.read().split())
    except FileNotFoundError:
        return prj
    shown, said = os.fsdecode(prj), there[:60].decode("utf-8", "replace")
    if crs is None:
        warnings.warn(
            f"{shown} says {said}, and the mesh's own coordinate system is not known", stacklevel=3
        )
        return None
    if there == b" ".join(crs.split()):
        return None
    if not os.path.exists(name):
        raise FileExistsError(f"{shown}, which is there already, says {said}: choose another path")
    return prj


def _write_prj(prj: bytes, crs: bytes) -> None:
    import os
    import tempfile

    folder = os.path.dirname(prj) or b"."
    handle, temporary = tempfile.mkstemp(prefix=b".meshwalk-", dir=folder)
    try:
        with open(handle, "wb") as file:
            file.write(crs + b"\n")
        os.chmod(temporary, 0o666 & ~_mask())
        os.replace(temporary, prj)
    except BaseException:
        os.unlink(temporary)
        raise


def _mask() -> int:
    import os

    mask = os.umask(0o022)
    os.umask(mask)
    return mask
