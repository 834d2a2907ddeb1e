"""Cells of other libraries: their corners, cut into triangles, and what stands at them."""

from __future__ import annotations

import warnings
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from meshwalk._mesh import Mesh
from meshwalk._space.surface import Surface

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping, Sequence

    from numpy.typing import NDArray

LEAST_CORNERS = 3


class Cells(NamedTuple):
    """Faces in space, and what stands at them."""

    points: NDArray[np.float64]
    """Shape (n, 3)."""
    blocks: Sequence[tuple[NDArray[np.int64], NDArray[Any]]]
    """The numbers of cells with equally many corners, and these corners, shape (m, k)."""
    cell_count: int
    """Number of all cells, those without a face included."""
    point_data: Mapping[str, Any]
    cell_data: Mapping[str, Any]
    """A row for each cell."""

    def cut(self) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
        """Corners of all triangles, and the cell of each, in the order of the cells."""
        cells, corners = [np.empty(0, np.int64)], [np.empty((0, 3), np.int64)]
        for number, faces in self.blocks:
            pieces = np.asarray(faces, np.int64)[:, None]
            if faces.shape[1] > LEAST_CORNERS:
                pieces = _cut(self.points, np.asarray(faces, np.int64), number)
            cells.append(np.repeat(number, pieces.shape[1]))
            corners.append(pieces.reshape(-1, 3))
        cell = np.concatenate(cells)
        order = np.argsort(cell, kind="stable")
        return np.concatenate(corners)[order], cell[order]


def _cut(
    points: NDArray[np.float64], faces: NDArray[np.int64], number: NDArray[np.int64]
) -> NDArray[np.int64]:
    """Cut faces of n corners into n - 2 triangles: as the fan whose least area is largest."""
    count, n = faces.shape
    at = points[faces]
    normal = np.cross(at, np.roll(at, -1, axis=1)).sum(axis=1)  # Newell's: of bent faces, too
    best, chosen = np.full(count, -np.inf), np.empty((count, n - 2, 3), np.int64)
    for apex in range(n):
        turned = np.roll(faces, -apex, axis=1)
        fan = np.stack([np.repeat(turned[:, :1], n - 2, 1), turned[:, 1:-1], turned[:, 2:]], axis=2)
        a, b, c = np.moveaxis(points[fan], 2, 0)
        areas = (np.cross(b - a, c - a) * normal[:, None]).sum(axis=2)
        better = areas.min(axis=1) > best
        best[better], chosen[better] = areas.min(axis=1)[better], fan[better]
    bad = np.flatnonzero(~(best > 0) & (normal != 0).any(axis=1))
    if len(bad):
        raise ValueError(
            f"cell {number[bad[0]]} cannot be cut into triangles from one of its corners: "
            "triangulate it first"
        )
    return chosen


def fields(given: Mapping[str, Any], rows: int, place: str) -> dict[str, NDArray[np.float64]]:
    """Arrays as fields: one for each component; with a warning that names what is left out."""
    kept: dict[str, NDArray[np.float64]] = {}
    left_out = []
    for name, array in given.items():
        values = np.asarray(array)
        real = values.dtype.kind in "biuf" and values.ndim > 0 and len(values) == rows
        if not real or not _doubles_hold(values):
            left_out.append(str(name))
            continue
        columns = values.reshape(rows, -1).astype(np.float64)
        if values.ndim == 1:
            kept[str(name)] = columns[:, 0]
        else:
            kept.update({f"{name}[{k}]": columns[:, k] for k in range(columns.shape[1])})
    warn_left_out(f"arrays of {place} that are not of real numbers", left_out)
    return kept


def _doubles_hold(values: NDArray[Any]) -> bool:
    if values.dtype.kind == "f" and values.dtype.itemsize > 8:
        return False
    return (values.dtype.kind != "i" and values.dtype.kind != "u") or bool(
        (np.abs(values.astype(np.float64)) <= 2.0**53).all()
    )


def warn_left_out(what: str, names: Iterable[str]) -> None:
    """Tell what a mesh of meshwalk does not keep."""
    listed = ", ".join(names)
    if listed:
        warnings.warn(f"left out, {what}: {listed}", UserWarning, stacklevel=4)


def mesh_of(cells: Cells, crs: str | None = None) -> Mesh:
    """Make a mesh of the plane, with a field `cell` where triangles are not the cells."""
    triangles, cell = cells.cut()
    data = fields(cells.cell_data, cells.cell_count, "cells")
    of_triangles = {name: values[cell] for name, values in data.items()}
    if len(cell) != cells.cell_count or (cell != np.arange(cells.cell_count)).any():
        if "cell" in of_triangles:
            raise ValueError("the cells have an array 'cell', where their numbers go: rename it")
        of_triangles["cell"] = cell.astype(np.float64)
    points = cells.points if (cells.points[:, 2] != 0).any() else cells.points[:, :2]
    at_points = fields(cells.point_data, len(points), "points")
    return Mesh(points, triangles, at_points, tolerant=True, triangle_fields=of_triangles, crs=crs)


def surface_of(cells: Cells) -> tuple[Surface, NDArray[np.int64]]:
    """Make a surface in space, and the cell of each triangle."""
    triangles, cell = cells.cut()
    at_points = fields(cells.point_data, len(cells.points), "points")
    return Surface(cells.points, triangles, at_points, tolerant=True), cell


def places(mesh: Mesh | Surface) -> NDArray[np.float64]:
    """Vertices in space: of a mesh its field ``z`` is the third coordinate, else 0."""
    if isinstance(mesh, Surface):
        return mesh.points
    return np.column_stack([mesh.points, mesh.fields.get("z", np.zeros(mesh.vertex_count))])


def joined(given: Mapping[str, NDArray[np.float64]]) -> dict[str, NDArray[np.float64]]:
    """Fields as arrays: components ``name[0]``, ``name[1]``, ... become one again."""
    parts: dict[str, list[NDArray[np.float64]]] = {}
    single: dict[str, NDArray[np.float64]] = {}
    for name, values in given.items():
        stem, bracket, number = name.rpartition("[")
        if bracket and number == f"{len(parts.get(stem, ()))}]":
            parts.setdefault(stem, []).append(np.asarray(values))
        else:
            single[name] = np.array(values)
    return {**single, **{stem: np.column_stack(columns) for stem, columns in parts.items()}}
