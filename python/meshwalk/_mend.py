"""What can be mended in a mesh without a guess."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from meshwalk import _arrays, _core
from meshwalk._mesh import Mesh

if TYPE_CHECKING:
    from collections.abc import Collection, Mapping

    from numpy.typing import ArrayLike, NDArray

    from meshwalk._core import Progress

_REPAIRS = {"weld": 1, "drop": 2, "split": 4, "orient": 8}
_KINDS = (
    "welded",
    "dropped, missing vertex",
    "dropped, not finite",
    "dropped, vertex twice",
    "dropped, duplicate",
    "dropped, flat",
    "split",
    "turned",
)


class MendChange(NamedTuple):
    """One change of `mend`, in the numbers of the arrays given; -1 where one does not apply.

    Attributes
    ----------
    kind : str
        Such as ``"welded"``, ``"dropped, flat"``, ``"split"``, ``"turned"``.
    text : str
        A sentence that names the place.
    triangle : int
        The triangle that was changed.
    vertex : int
        The vertex concerned: welded, missing, or where the triangle was split.
    other : int
        What `vertex` was welded to, or the triangle that `triangle` repeated.
    """

    kind: str
    text: str
    triangle: int
    vertex: int
    other: int


class Mended(NamedTuple):
    """A mended mesh and its changes: the answer of `mend`.

    Attributes
    ----------
    points : ndarray of float64
        The vertices that are left, in their order, with the columns given.
    triangles : NDArray[np.int32] | NDArray[np.int64]
        Their triangles, in their order; the parts of one that was split follow each other.
    vertex_from : NDArray[np.int32] | NDArray[np.int64]
        The old number of each new vertex: ``values[vertex_from]`` are its values.
    vertex_to : NDArray[np.int32] | NDArray[np.int64]
        The new number of each old vertex.
    triangle_from : NDArray[np.int32] | NDArray[np.int64]
        The old triangle that each new one is, or is a part of.
    changes : list[MendChange]
        What was done, in order.
    """

    points: NDArray[np.float64]
    triangles: NDArray[np.int32] | NDArray[np.int64]
    vertex_from: NDArray[np.int32] | NDArray[np.int64]
    vertex_to: NDArray[np.int32] | NDArray[np.int64]
    triangle_from: NDArray[np.int32] | NDArray[np.int64]
    changes: list[MendChange]

    def mesh(
        self, fields: Mapping[str, ArrayLike] | None = None, *, crs: str | None = None
    ) -> Mesh:
        """Make a mesh of it; `fields` are values at the old vertices."""
        count = len(self.vertex_to)
        given = _arrays.fields(fields, count)
        kept = {name: values[self.vertex_from] for name, values in given.items()}
        return Mesh(self.points, self.triangles, kept, crs=crs)


def mend(
    points: ArrayLike,
    triangles: ArrayLike,
    repairs: Collection[str] = ("weld", "drop", "split", "orient"),
    *,
    tolerance: float = 0.0,
    space: bool = False,
    progress: Progress | None = None,
) -> Mended:
    """Mend arrays that `Mesh` refuses, or whose triangles are no embedding.

    Parameters
    ----------
    points : array_like, shape (n, 2) or (n, 3)
        Vertices. In the plane a third column is kept, but decides nothing.
    triangles : array_like of int, shape (m, 3)
        Vertex numbers, from 0.
    repairs : collection of str, optional
        ``"weld"``: coincident vertices become one. ``"drop"``: unusable, duplicate and flat
        triangles go. ``"split"``: where a vertex lies inside a border edge of another triangle,
        that is split. ``"orient"``: all triangles turn counter-clockwise. They are carried out in
        this order.
    tolerance : float, optional
        Vertices no farther apart are welded, and vertices no farther from a border edge split it,
        in the units of the points. 0: only what is equal, exactly.
    space : bool, optional
        The points are a surface in space, of three columns; triangles turn like their neighbours.
    progress : callable, optional
        As of `Mesh`.

    Returns
    -------
    Mended
        No vertex has moved, and none is new. Overlaps and edges of three triangles stay:
        `check` names them.

    Raises
    ------
    InputError
        A triangle names a vertex that does not exist, and ``"drop"`` is not among the repairs.
    ValueError
        A repair that is not known; a tolerance that is negative or not finite.

    See Also
    --------
    check : lists what is wrong.

    Examples
    --------
    >>> import meshwalk
    >>> points = [[0, 0], [2, 0], [0, 2], [2, 0], [0, 2], [2, 2]]
    >>> mended = meshwalk.mend(points, [[0, 1, 2], [3, 4, 5], [0, 0, 1]])
    >>> for change in mended.changes:
    ...     print(change.text)
    vertex 3: welded to vertex 1
    vertex 4: welded to vertex 2
    triangle 2: dropped: it has vertex 0 twice
    triangle 1: turned
    >>> mended.mesh({"depth": [1, 2, 3, 2, 3, 4]})
    <Mesh: 4 vertices, 2 triangles, fields: depth>
    """
    rows, width = _arrays.vertices(points, "points", (3,) if space else (2, 3))
    numbers = _arrays.triangles(triangles, "triangles", _core.MAX_TRIANGLES)
    if isinstance(repairs, str):
        repairs = (repairs,)
    for name in repairs:
        if name not in _REPAIRS:
            raise ValueError(f"repairs must be of {', '.join(_REPAIRS)}, not {name!r}")
    if not repairs:
        raise ValueError("repairs must name at least one")
    used = rows if space else rows[:, :2]
    total = sum({_REPAIRS[name] for name in repairs})
    raw = _core.mend_arrays(used, numbers, total, space, tolerance, progress)
    mended, vertex_from, vertex_to, triangle_from = (
        np.frombuffer(part, np.uint32) for part in raw[:4]
    )
    return Mended(
        points=rows[vertex_from].reshape(-1, width),
        triangles=_arrays.numbers(mended.reshape(-1, 3)),
        vertex_from=_arrays.numbers(vertex_from),
        vertex_to=_arrays.numbers(vertex_to),
        triangle_from=_arrays.numbers(triangle_from),
        changes=[MendChange(_KINDS[change[0]], *change[1:]) for change in raw[4]],
    )
