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

    Notes
    -----
    A colour bar: ``ax.figure.colorbar(ax.collections[-1], ax=ax)``.

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
    """Draw how a point is located: the walk, and the triangle or triangles that contain the point.

    The picture shows the part of the mesh round the walk; ``ax.autoscale()`` shows all of it.

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
        Its title says the answer, and why; a legend says what is drawn.

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
    points, triangles = mesh.points, mesh.triangles
    path = locator.walk_path(x, y, walk=walk, start=start)
    others = _sharing(points, triangles, mesh.neighbours, location)
    found = [location.triangle] if location.triangle >= 0 else []
    shown = points[triangles[[*path, *others, *found]]]
    low, high = _frame(np.vstack([shown.reshape(-1, 2), [x, y]]))
    ax = _axes(ax)
    corners = points[triangles]
    near = ((corners.max(1) >= low) & (corners.min(1) <= high)).all(1)
    if near.any():
        ax.triplot(*points.T, triangles[near], linewidth=0.5, color="0.5")
    _fill(ax, corners[path], "tab:blue", 0.2, "visited")
    _fill(ax, corners[others], "tab:orange", 0.5, "has the point, too")
    _fill(ax, corners[found], "tab:red", 0.5, "the answer")
    ax.plot(*corners[path].mean(1).T, color="tab:blue", marker=".", label="the walk")
    ax.plot(x, y, color="black", marker="x", linestyle="none", label="the point")
    ax.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]))
    ax.legend(loc="best", fontsize="small")
    ax.set_title(textwrap.fill(_sentence(location, others), 52))
    return ax


def _frame(points: NDArray[np.float64]) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """The corners of a square round points, with a margin of a fifth of it on each side."""
    low, high = points.min(0), points.max(0)
    half = 0.7 * float((high - low).max()) or 1.0
    return (low + high) / 2 - half, (low + high) / 2 + half


def _fill(
    ax: Axes, triangles: NDArray[np.float64], colour: str, opacity: float, label: str
) -> None:
    """Fill triangles, which have one entry in the legend."""
    from matplotlib.collections import PolyCollection

    if len(triangles):
        filled = PolyCollection(
            list(triangles), label=label, facecolor=colour, alpha=opacity, linewidth=0
        )
        ax.add_collection(filled)


def _sharing(
    points: NDArray[np.float64],
    triangles: NDArray[Any],
    neighbours: NDArray[np.int32],
    location: Location,
) -> list[int]:
    """The other triangles that have the point: at the same edge, or the same place."""
    if location.where is Where.EDGE:
        other = int(neighbours[location.triangle, location.local])
        return [other] if other >= 0 else []
    if location.where is not Where.VERTEX:
        return []
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
