"""What is wrong with a mesh."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from meshwalk import _arrays, _core

if TYPE_CHECKING:
    from numpy.typing import ArrayLike


class Defect(NamedTuple):
    """One defect of a mesh and its place; numbers that do not apply are -1.

    Attributes
    ----------
    kind : str
        What kind of defect, such as ``"overlap"``.
    text : str
        A sentence that names the place.
    triangle, other : int
        The triangle, and another one that is concerned.
    vertex : int
        The vertex concerned.
    edge, other_edge : int
        The local edge of `triangle`, and that of `other`: edge k joins the local vertices k and
        (k + 1) mod 3.
    """

    kind: str
    text: str
    triangle: int
    other: int
    vertex: int
    edge: int
    other_edge: int


class Check(NamedTuple):
    """The answer of `check`.

    Attributes
    ----------
    valid : bool
        True if the triangles are an embedding: they do not overlap, and meet in whole edges and
        vertices only. Then point location is exact and complete.
    defects : list of Defect
        All defects, in order of kind, then triangle. Flat triangles (without area) are listed as a
        remark; they are valid.
    """

    valid: bool
    defects: list[Defect]


def check(points: ArrayLike, triangles: ArrayLike) -> Check:
    """Find every defect of arrays that are to be a mesh, also of those that `Mesh` refuses.

    Parameters
    ----------
    points : array_like, shape (n, 2) or (n, 3)
        Vertices; a third column is not looked at.
    triangles : array_like of int, shape (m, 3)
        Vertex numbers, from 0.

    Returns
    -------
    Check

    Examples
    --------
    The second triangle lies over the first:

    >>> import meshwalk
    >>> points = [[0, 0], [4, 0], [0, 4], [1, 1]]
    >>> result = meshwalk.check(points, [[0, 1, 2], [0, 1, 3]])
    >>> result.valid
    False
    >>> print(result.defects[0].text)
    triangle 0: triangle 1 is folded back onto it at edge 0
    """
    return _check("mesh", points, triangles, False, (0, 0, 0))


def check_surface(points: ArrayLike, triangles: ArrayLike, *, weld: bool = False) -> Check:
    """Find every defect of arrays that are to be a surface in space.

    Parameters
    ----------
    points : array_like, shape (n, 3)
        Vertices.
    triangles : array_like of int, shape (m, 3)
        Vertex numbers, from 0.
    weld : bool, optional
        Vertices with equal coordinates are one.

    Returns
    -------
    Check
        `valid` if there is none but flat triangles.
    """
    return _check("surface", points, triangles, weld, (0, 0, 0))


def check_star(
    points: ArrayLike,
    triangles: ArrayLike,
    centre: tuple[float, float, float] = (0, 0, 0),
    *,
    weld: bool = False,
) -> Check:
    """Find every defect of arrays that are to be a polyhedron, star-shaped about a centre.

    Parameters
    ----------
    points : array_like, shape (n, 3)
        Vertices.
    triangles : array_like of int, shape (m, 3)
        Vertex numbers, from 0.
    centre : tuple of float, optional
        Where rays begin.
    weld : bool, optional
        Vertices with equal coordinates are one.

    Returns
    -------
    Check
        `valid` if `Star` takes it.
    """
    return _check("star", points, triangles, weld, centre)


def _check(
    kind: str,
    points: ArrayLike,
    triangles: ArrayLike,
    weld: bool,
    centre: tuple[float, float, float],
) -> Check:
    rows, _ = _arrays.vertices(points, "points", (2, 3) if kind == "mesh" else (3,))
    numbers = _arrays.triangles(triangles, "triangles", _core.MAX_TRIANGLES)
    rows = rows[:, :2] if kind == "mesh" else rows
    valid, defects = _core.check_arrays(kind, rows, numbers, weld, centre, None)
    return Check(valid, [Defect(*defect) for defect in defects])
