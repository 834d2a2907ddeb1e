"""Prepared meshes: in a file that is mapped, with their locators."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from meshwalk import _arrays, _core
from meshwalk._locator import Locator
from meshwalk._mesh import Mesh

if TYPE_CHECKING:
    import os

    from numpy.typing import NDArray

    from meshwalk._core import Progress


def map(
    path: str | os.PathLike[str],
    trust: bool = False,
    *,
    threads: int = 0,
    progress: Progress | None = None,
) -> Locator:
    """Map a prepared file (``.mwm``): a mesh and its locator, ready at once and not copied.

    All processes that map the file share one copy in memory.

    Parameters
    ----------
    path : str or path-like
        The file, as `Locator.prepare` or ``meshwalk prepare`` writes it; not gzipped.
    trust : bool, optional
        Check the header only, and read nothing else before it is needed. For files of your own:
        queries in a damaged file may crash. By default all of the file is checked.
    threads : int, optional
        How many threads check it; 0 lets the library choose.
    progress : callable, optional
        As of `Locator`.

    Returns
    -------
    Locator
        Its `mesh` has the fields and the coordinate system of the file. A tolerance and
        `nearest_border` need a file with the index of the border. Locator and mesh pickle as the
        path of the file: it has to be there, unchanged, where they are loaded.

    Raises
    ------
    OSError
        The file cannot be opened; ``FileNotFoundError`` where there is none.
    InputError
        It is no prepared file, or is damaged.

    Notes
    -----
    Do not write into a mapped file, nor cut it shorter: `Locator.prepare` replaces it in one step,
    and what is mapped stays as it is.

    Examples
    --------
    >>> import meshwalk, os, tempfile
    >>> name = os.path.join(tempfile.mkdtemp(), "square.mwm")
    >>> mesh = meshwalk.Mesh([[0, 0], [4, 0], [4, 4], [0, 4]], [[0, 1, 2], [0, 2, 3]])
    >>> meshwalk.Locator(mesh).prepare(name)
    >>> locator = meshwalk.map(name)
    >>> locator.locate([[3, 1], [1, 3]]).triangle
    array([0, 1], dtype=int32)
    """
    import os

    name = _arrays.path(path)
    try:
        locator, fields, of_triangles, crs, checksum, border = _core.map_prepared(
            Mesh, Locator, name, trust, threads, progress
        )
    except OSError as error:
        raise error if os.path.exists(name) else FileNotFoundError(*error.args) from None
    mapped = (os.path.abspath(os.fsdecode(name)), trust, checksum)
    locator.mesh._set_mapped(mapped, _columns(fields), _columns(of_triangles), crs)
    locator._options = {"border": border, "mapped": True}
    return locator


def _columns(fields: dict[str, memoryview]) -> dict[str, NDArray[np.float64]]:
    return {name: np.frombuffer(values, np.float64) for name, values in fields.items()}


def map_again(path: str, trust: bool, checksum: int) -> Locator:
    """The locator of a file that must not have changed since it was pickled."""
    from meshwalk._errors import InputError

    locator = map(path, trust)
    mapped = locator.mesh._mapped
    if mapped is None or mapped[2] != checksum:
        raise InputError(f"{path}: is another prepared mesh than the one that was pickled")
    return locator


def map_mesh_again(path: str, trust: bool, checksum: int) -> Mesh:
    """As `map_again`: the mesh."""
    return map_again(path, trust, checksum).mesh
