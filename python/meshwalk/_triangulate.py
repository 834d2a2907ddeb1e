"""Meshes made of points."""

from __future__ import annotations

import warnings
from typing import TYPE_CHECKING

import numpy as np

from meshwalk import _arrays, _core
from meshwalk._mesh import Mesh

if TYPE_CHECKING:
    from numpy.typing import ArrayLike


class DuplicateWarning(UserWarning):
    """Points have the same coordinates as earlier ones, and are in no triangle."""


def delaunay(points: ArrayLike, threads: int = 0) -> Mesh:
    """Delaunay triangulation of points: exact, and the same for any number of threads.

    Parameters
    ----------
    points : array_like, shape (n, 2) or (n, 3)
        x, y of each point. A third column becomes the field ``"z"``.
    threads : int, optional
        How many threads work on it; 0 lets the library choose.

    Returns
    -------
    Mesh
        Vertex i is point i; triangles are counter-clockwise. A point with the coordinates of an
        earlier one is in no triangle.

    Raises
    ------
    InputError
        Fewer than three different points, all on one line, or a coordinate that is not finite.

    Warns
    -----
    DuplicateWarning
        Points have equal coordinates: the values of the first one count.

    References
    ----------
    Incremental insertion in random rounds along a Hilbert curve [1]_, in patches that are merged
    [2]_.

    .. [1] Amenta, Choi, Rote: Incremental constructions con BRIO, 2003.
    .. [2] Guibas, Stolfi: Primitives for the manipulation of general subdivisions, 1985.

    Examples
    --------
    >>> import meshwalk
    >>> meshwalk.delaunay([[0, 0, 7], [4, 0, 8], [0, 4, 9]])
    <Mesh: 3 vertices, 1 triangles, fields: z>
    """
    rows, width = _arrays.vertices(points, "points", (2, 3))
    duplicate_of = np.empty(len(rows), np.uint32)
    mesh, duplicates = _core.delaunay(Mesh, rows[:, :2], duplicate_of, threads)
    mesh._options = (False, "auto")
    mesh._set_fields(rows[:, 2] if width == 3 else None, None)
    if duplicates:
        first = int(np.argmax(duplicate_of != np.iinfo(np.uint32).max))
        warnings.warn(
            f"{duplicates} of {len(rows)} points have the coordinates of an earlier one, the first "
            f"of them point {first}, of point {duplicate_of[first]}",
            DuplicateWarning,
            stacklevel=2,
        )
    return mesh
