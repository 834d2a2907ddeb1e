"""Pictures of meshes and walks, by matplotlib."""

from __future__ import annotations

import textwrap
from typing import TYPE_CHECKING, Any

import numpy as np

from meshwalk import _arrays
from meshwalk._where import Where

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from numpy.typing import ArrayLike, NDArray

    from meshwalk._core import Location
    from meshwalk._locator import Locator
    from meshwalk._mesh import Mesh


def _axes(ax: Axes | None) -> Axes:
    if ax is None:
        import matplotlib.pyplot as plt

        _, ax = plt.subplots()
    ax.set_aspect("equal")
    return ax


def _check_kind(given: Any, name: str, wanted: str, hint: str) -> None:
    import meshwalk

    if not isinstance(given, getattr(meshwalk, wanted)):
        kind = type(given).__name__
        raise TypeError(f"{name} must be a meshwalk.{wanted}, not {kind}; {hint}")


def plot(
    mesh: Mesh, values: ArrayLike | str | None = None, ax: Axes | None = None, **style: Any
) -> Axes:
    """Draw a mesh: its edges, or values at its vertices or of its triangles in colours.

    Parameters
    ----------
    mesh : Mesh
        The mesh.
    values : array_like, shape (n_vertices,), or str, optional
        Values at the vertices, or the name of a field, also of a `Mesh.triangle_fields`.
    ax : matplotlib.axes.Axes, optional
        Where to draw; new ones by default.
    **style
        For ``Axes.tripcolor`` if there are values, else for ``Axes.triplot``.

    Returns
    -------
    matplotlib.axes.Axes

    Raises
    ------
    ImportError
        matplotlib is not installed.

    Examples
    --------
    >>> import meshwalk
    >>> mesh = meshwalk.delaunay([[0, 0, 5], [4, 0, 6], [0, 4, 7]])
    >>> meshwalk.plot(mesh, "z").get_aspect()
    1.0
    """
    _check_kind(mesh, "mesh", "Mesh", "draw its mesh: plot(locator.mesh)")
    ax = _axes(ax)
    x, y = mesh.points.T
    if values is None:
        ax.triplot(x, y, mesh.triangles, **{"linewidth": 0.5, "color": "0.5", **style})
        return ax
    if isinstance(values, str) and values in mesh.triangle_fields and values not in mesh.fields:
        ax.tripcolor(x, y, mesh.triangles, facecolors=mesh.triangle_fields[values], **style)
        return ax
    given = _arrays.named(mesh.fields, values) if isinstance(values, str) else values
    heights = _arrays.values(given, "values", mesh.vertex_count)
    ax.tripcolor(x, y, mesh.triangles, heights, **{"shading": "gouraud", **style})
    return ax


def explain(
    locator: Locator,
    x: float,
    y: float,
    ax: Axes | None = None,
    *,
    walk: str = "auto",
    start: str = "auto",
) -> Axes:
    """Draw how a point is located: the walk, the triangle and, of a tie, all that have the point.

    Parameters
    ----------
    locator : Locator
        The locator.
    x, y : float
        A finite point.
    ax : matplotlib.axes.Axes, optional
        Where to draw; new ones by default.
    walk, start : str, optional
        Of `Locator.walk_path`.

    Returns
    -------
    matplotlib.axes.Axes
        Its title says the answer, and why.

    Raises
    ------
    ImportError
        matplotlib is not installed.

    Examples
    --------
    >>> import meshwalk
    >>> mesh = meshwalk.Mesh([[0, 0], [4, 0], [4, 4], [0, 4]], [[0, 1, 2], [0, 2, 3]])
    >>> print(meshwalk.explain(meshwalk.Locator(mesh), 2, 2).get_title())
    on edge 2 of triangle 0; triangle 1 has it, too, and
    a higher number
    """
    _check_kind(locator, "locator", "Locator", "make one: Locator(mesh)")
    location = locator.locate_one(x, y)
    if location.where is Where.BAD:
        raise ValueError(f"the point {x}, {y} is not finite")
    mesh = locator.mesh
    ax = plot(mesh, ax=ax)
    path = locator.walk_path(x, y, walk=walk, start=start)
    others = _sharing(mesh, location)
    _fill(ax, mesh, path, "tab:blue", 0.2)
    _fill(ax, mesh, np.array(others, int), "tab:orange", 0.5)
    if location.triangle >= 0:
        _fill(ax, mesh, np.array([location.triangle]), "tab:red", 0.5)
    middles = mesh.points[mesh.triangles[path]].mean(1)
    ax.plot(*middles.T, color="tab:blue", marker=".")
    ax.plot(x, y, color="black", marker="x", linestyle="none")
    ax.set_title(textwrap.fill(_sentence(location, others), 52))
    return ax


def _fill(ax: Axes, mesh: Mesh, triangles: NDArray[Any], colour: str, opacity: float) -> None:
    for corners in mesh.points[mesh.triangles[triangles]]:
        ax.fill(*corners.T, color=colour, alpha=opacity, linewidth=0)


def _sharing(mesh: Mesh, location: Location) -> list[int]:
    """The other triangles that have the point: at the same edge, or the same place."""
    if location.where is Where.EDGE:
        other = int(mesh.neighbours[location.triangle, location.local])
        return [other] if other >= 0 else []
    if location.where is not Where.VERTEX:
        return []
    points, triangles = mesh.points, mesh.triangles
    place = points[triangles[location.triangle, location.local]]
    here = np.flatnonzero((points == place).all(1))
    found = np.flatnonzero(np.isin(triangles, here).any(1))
    return [int(t) for t in found if t != location.triangle]


def _sentence(location: Location, others: list[int]) -> str:
    where = location.where
    if where is Where.HOLE:
        return f"in hole {location.hole}"
    if location.triangle < 0:
        return "outside"
    if where is Where.INSIDE:
        return f"inside of triangle {location.triangle}"
    place = f"{'on edge' if where is Where.EDGE else 'at vertex'} {location.local}"
    tie = ""
    if len(others) == 1:
        tie = f"; triangle {others[0]} has it, too, and a higher number"
    elif others:
        names = ", ".join(str(t) for t in others)
        tie = f"; triangles {names} have it, too, and higher numbers"
    return f"{place} of triangle {location.triangle}{tie}"
