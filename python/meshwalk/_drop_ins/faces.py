"""Faces of any number of corners, cut into triangles."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from meshwalk._mesh import Mesh
from meshwalk._triangulate import constrained_delaunay

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import NDArray


class CutFaces(NamedTuple):
    """A mesh made of faces, and the face that each of its triangles is a part of."""

    mesh: Mesh
    faces: NDArray[np.intp]
    """Corners of the faces, -1 behind the last one of those that have fewer, shape (m, n)."""
    sizes: NDArray[np.intp]
    """Number of corners of each face."""
    face: NDArray[np.intp] | None
    """The face of each triangle, ascending; None where all faces are triangles."""

    def face_of(self, triangle: NDArray[Any]) -> NDArray[np.intp]:
        """Return the faces of triangles; -1 stays -1."""
        numbers = np.asarray(triangle).astype(np.intp)
        return numbers if self.face is None else np.where(numbers < 0, -1, self.face[numbers])

    def weights(
        self, points: NDArray[np.float64], face: NDArray[np.intp], local: NDArray[np.float64]
    ) -> NDArray[np.float64]:
        """Weights of the corners of faces, in the order of the corners; 0 without a face.

        Of a triangle they are those of its location, `local`. Of a larger face they are
        Wachspress's: in a convex face none is negative, and those of an edge are linear.
        """
        width = self.faces.shape[1]
        out = np.zeros((len(points), width))
        for n in np.unique(self.sizes):
            chosen = np.flatnonzero((face >= 0) & (self.sizes[face] == n))
            if n == 3:
                out[chosen, :3] = local[chosen]
            else:
                corners = self.mesh.points[self.faces[face[chosen], :n]]
                out[chosen, :n] = _wachspress(corners, points[chosen])
        return out


def turn(a: NDArray[Any], b: NDArray[Any], c: NDArray[Any]) -> NDArray[Any]:
    """Twice the areas of triangles, positive if counter-clockwise."""
    u, v = b - a, c - a
    area: NDArray[Any] = u[..., 0] * v[..., 1] - u[..., 1] * v[..., 0]
    return area


def _wachspress(corners: NDArray[Any], points: NDArray[Any]) -> NDArray[np.float64]:
    """Weights of the corners of convex polygons, shape (k, n, 2), at a point of each.

    The weight of a corner is the area that it spans with its neighbours, times the areas that the
    point spans with all edges but the corner's two. No quotient of them can be 0 / 0.
    """
    n = corners.shape[1]
    before, after = np.roll(corners, 1, axis=1), np.roll(corners, -1, axis=1)
    spanned = turn(before, corners, after)
    whole = spanned.sum(axis=1, keepdims=True)
    areas = turn(corners, after, points[:, None]) / whole
    areas = np.maximum(areas, 0)
    weights = spanned / whole
    for k in range(n):
        for edge in range(n):
            if edge not in (k, (k - 1) % n):
                weights[:, k] *= areas[:, edge]
    weights /= weights.sum(axis=1, keepdims=True)
    return np.asarray(weights)


def cut_faces(points: NDArray[np.float64], faces: NDArray[np.intp]) -> CutFaces:
    """Make a mesh of faces of any number of corners, which may turn either way.

    Parameters
    ----------
    points : ndarray of double, shape (n, 2)
        The vertices.
    faces : ndarray of intp, shape (m, k)
        Their corners, -1 behind the last one.

    Raises
    ------
    InputError
        A face names a vertex that does not exist, or has a vertex twice.
    ValueError
        A face has fewer than three corners.
    """
    sizes, first = _sizes(faces)
    if (sizes == 3).all():
        return CutFaces(Mesh(points, faces[:, :3], tolerant=True), faces, sizes, None)
    triangles = np.empty((first[-1], 3), np.intp)
    for n in np.unique(sizes):
        chosen = np.flatnonzero(sizes == n)
        places = first[chosen][:, None] + np.arange(n - 2)
        rows = faces[chosen, :n]
        triangles[places] = rows[:, None] if n == 3 else _cut(points, rows)
    face_of = np.repeat(np.arange(len(faces)), sizes - 2)
    return CutFaces(Mesh(points, triangles, tolerant=True), faces, sizes, face_of)


def _sizes(faces: NDArray[np.intp]) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """Numbers of corners; the first triangle of each face, and the one behind the last."""
    there = faces >= 0
    sizes = there.sum(axis=1)
    wrong = (sizes < 3) | (there != (np.arange(faces.shape[1]) < sizes[:, None])).any(axis=1)
    if wrong.any():
        face = int(wrong.argmax())
        raise ValueError(f"face {face} has no three corners, or a gap between them: {faces[face]}")
    first = np.zeros(len(faces) + 1, np.intp)
    np.cumsum(sizes - 2, out=first[1:])
    return sizes, first


def _best_fans(
    points: NDArray[Any], faces: NDArray[np.intp], area: Callable[..., NDArray[Any]]
) -> tuple[NDArray[np.intp], NDArray[Any]]:
    """Cut faces of n corners each into n - 2 triangles, and tell the least area in each face.

    Of the n fans the one whose least area is largest is taken; a negative one is turned over.
    """
    count, n = faces.shape
    best, chosen = np.full(count, -np.inf), np.zeros((count, n - 2, 3), np.intp)
    side = np.zeros((count, 1))
    for apex in range(n):
        turned = np.roll(faces, -apex, axis=1)
        fan = np.stack([np.repeat(turned[:, :1], n - 2, 1), turned[:, 1:-1], turned[:, 2:]], 2)
        areas = area(*np.moveaxis(points[fan], 2, 0))
        if apex == 0:
            side = np.sign(areas.sum(axis=1, keepdims=True))
        least = (side * areas).min(axis=1)
        better = least > best
        best[better], chosen[better] = least[better], fan[better]
    return chosen, best


def _cut(points: NDArray[Any], faces: NDArray[np.intp]) -> NDArray[np.intp]:
    """Cut faces of the plane of n corners each into n - 2 triangles."""
    chosen, best = _best_fans(points, faces, turn)
    for k in np.flatnonzero(best < 0):  # no fan: not star-shaped about a corner
        chosen[k] = _cut_one(points, faces[k])
    return chosen


def _cut_one(points: NDArray[Any], face: NDArray[np.intp]) -> NDArray[np.intp]:
    ends = np.arange(len(face))
    mesh = constrained_delaunay(
        points[face], np.column_stack([ends, np.roll(ends, -1)]), keep="inside"
    )
    if mesh.triangle_count != len(face) - 2:
        raise ValueError(f"a face with the corners {face} crosses itself")
    return face[mesh.triangles]


def _turn_in_space(a: NDArray[Any], b: NDArray[Any], c: NDArray[Any]) -> NDArray[Any]:
    """Six times the volumes of tetrahedra with the origin: positive if counter-clockwise there."""
    volume: NDArray[Any] = (np.cross(a, b) * c).sum(axis=-1)
    return volume


def cut_facets(
    points: NDArray[np.float64], faces: NDArray[np.intp]
) -> tuple[NDArray[np.intp], NDArray[np.intp] | None]:
    """Cut faces of a sphere about the origin into triangles that turn counter-clockwise.

    Parameters
    ----------
    points : ndarray of double, shape (n, 3)
        The nodes.
    faces : ndarray of intp, shape (m, k)
        Corners of the faces, -1 behind the last one. A corner may follow itself.

    Returns
    -------
    triangles : ndarray of intp, shape (p, 3)
        Their corners. The first one of a triangle stays the first.
    face : ndarray of intp, shape (p,), or None
        The face of each triangle, ascending; None where all faces are triangles.

    Raises
    ------
    ValueError
        A face has fewer than three corners.
    """
    sizes, first = _sizes(faces)
    triangles = np.empty((first[-1], 3), np.intp)
    for n in np.unique(sizes):
        chosen = np.flatnonzero(sizes == n)
        rows = faces[chosen, :n]
        fans = rows[:, None] if n == 3 else _best_fans(points, rows, _turn_in_space)[0]
        triangles[first[chosen][:, None] + np.arange(n - 2)] = fans
    turned = _turn_in_space(*np.moveaxis(points[triangles], 1, 0)) < 0
    triangles[turned] = triangles[turned][:, [0, 2, 1]]
    return triangles, None if (sizes == 3).all() else np.repeat(np.arange(len(faces)), sizes - 2)
