"""Triangles of the unit sphere, closed or not, and the directions that they contain."""

from __future__ import annotations

from fractions import Fraction
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from meshwalk._errors import InputError
from meshwalk._locator import Locator
from meshwalk._mesh import Mesh
from meshwalk._space.prober import Prober, TouchState
from meshwalk._space.star import Star
from meshwalk._space.surface import Surface
from meshwalk._where import Where

if TYPE_CHECKING:
    from numpy.typing import NDArray

_LEAST_HEIGHT = 0.05
"""How high nodes must stand above the plane through the centre, to be projected from it."""
_MOST_STEPS = 200
_NEAR = 1e-12
"""Points outside by so much are decided exactly; the projection errs by some 1e-15."""
_SIDE_ERROR = 1e-14
"""More than the rounding error of the determinant of three vectors of length 1: of its 6 products
of 3 factors each errs by at most 5 * 2^-53, and so do the nodes' lengths."""


class Directions(NamedTuple):
    """Where directions lie: the answer of `SphereLocator.locate`."""

    triangle: NDArray[np.intp]
    """The lowest triangle that contains each, -1 for none."""
    where: NDArray[np.uint8]
    """The numbers of `Where`."""
    local: NDArray[np.intp]
    """The local edge or vertex that each is on."""
    weights: NDArray[np.float64]
    """Weights of the corners, of the point in the plane of the triangle; NaN without one."""


class SphereLocator:
    """Finds triangles between great circles that contain directions, exactly.

    Triangles that cover the sphere are searched by `Star`. Others may lie within a hemisphere:
    there, straight lines of a plane are great circles seen from the centre. The plane tells the
    triangle, and near its sides the vectors themselves decide, in fractions if need be. Small
    triangles on more than a hemisphere, as those of an ocean, are searched by rays (`Prober`), once
    such planes have shown in parts that none overlap.

    Parameters
    ----------
    nodes : ndarray of double, shape (n, 3)
        Of length 1, but for rounding.
    triangles : ndarray of intp, shape (m, 3)
        Their corners, counter-clockwise from outside.

    Raises
    ------
    InputError
        The triangles overlap; or they leave a part of the sphere open, reach beyond a hemisphere,
        and one has a side of more than 30 degrees.
    """

    def __init__(self, nodes: NDArray[np.float64], triangles: NDArray[np.intp]) -> None:
        self._nodes, self._triangles = nodes, triangles
        self._star: Star | None = None
        self._prober: Prober | None = None
        self._fans: tuple[NDArray[np.intp], NDArray[np.intp], NDArray[np.intp]] | None = None
        surface = Surface(nodes, triangles, weld=True, tolerant=True)
        try:
            self._star = Star(surface)
            return
        except InputError as error:
            centre = _pole_of(nodes[np.unique(triangles)])
            if centre is None:
                _check_parts(nodes, triangles, error)
                self._prober = Prober(surface, boxes=True)
                return
            self._plane = _Plane(centre)
        flat = Mesh(self._plane.project(nodes), triangles, tolerant=True)
        self._locator = Locator(flat, border=True)

    def locate(self, directions: NDArray[np.float64]) -> Directions:
        """Find the triangles of directions, shape (n, 3)."""
        if self._star is not None:
            hit = self._star.locate(directions)
            return Directions(
                hit.triangle.astype(np.intp), hit.where, hit.local.astype(np.intp), hit.weights
            )
        if self._prober is not None:
            centre = np.zeros_like(directions)
            met = self._prober.probe(centre, directions, certain=True, extent="ray", faces="both")
            where = np.where(met.state == TouchState.NONE, np.uint8(Where.OUTSIDE), met.where)
            local = met.records["local"].astype(np.intp)
            return Directions(met.triangle.astype(np.intp), where, local, met.weights)
        near = self._locator.locate(self._plane.project(directions), tolerance=_NEAR)
        triangle = near.triangle.astype(np.intp)
        where = np.array(near.where)
        local = np.full(len(triangle), 255, np.intp)
        found = np.flatnonzero(triangle >= 0)
        sides = np.full((len(triangle), 3), np.nan)
        sides[found] = self._sides(triangle[found], directions[found])
        length = np.linalg.norm(directions, axis=1)
        where[found] = Where.INSIDE
        with np.errstate(invalid="ignore"):
            doubtful = np.flatnonzero(sides.min(axis=1) <= _SIDE_ERROR * length)
        for k in doubtful:
            triangle[k], where[k], local[k] = self._decide(int(triangle[k]), directions[k])
        if len(doubtful):
            there = doubtful[triangle[doubtful] >= 0]
            sides[doubtful] = np.nan
            sides[there] = np.maximum(self._sides(triangle[there], directions[there]), 0)
        # The side from corner k to the next one is opposite to corner k + 2.
        weights = np.roll(sides, -1, axis=1)
        return Directions(triangle, where, local, weights / weights.sum(axis=1, keepdims=True))

    def _sides(
        self, triangle: NDArray[np.intp], directions: NDArray[np.float64]
    ) -> NDArray[np.float64]:
        """On which side of each edge's great circle directions lie: positive inside."""
        corners = self._nodes[self._triangles[triangle]]
        normals = np.cross(corners, np.roll(corners, -1, axis=1))
        return np.asarray((normals * directions[:, None]).sum(axis=2))

    def _decide(self, triangle: int, direction: NDArray[np.float64]) -> tuple[int, int, int]:
        """The lowest triangle round the corners of one that contains a direction, in fractions."""
        place, begin, around = self._fans_of_places()
        corners = place[self._triangles[triangle]]
        near = np.unique(np.concatenate([around[begin[c] : begin[c + 1]] for c in corners]))
        point = [Fraction(float(v)) for v in direction]
        for candidate in near.tolist():
            ends = [
                [Fraction(float(v)) for v in self._nodes[c]] for c in self._triangles[candidate]
            ]
            sides = [_determinant(ends[k], ends[(k + 1) % 3], point) for k in range(3)]
            if min(sides) < 0 or max(sides) <= 0:
                continue
            zero = [k for k in range(3) if sides[k] == 0]
            if not zero:
                return candidate, int(Where.INSIDE), 255
            if len(zero) == 1:
                return candidate, int(Where.EDGE), zero[0]
            # Two sides meet at the corner where the second of them begins.
            return candidate, int(Where.VERTEX), 0 if zero == [0, 2] else zero[1]
        return -1, int(Where.OUTSIDE), 255

    def _fans_of_places(self) -> tuple[NDArray[np.intp], NDArray[np.intp], NDArray[np.intp]]:
        if self._fans is None:
            self._fans = fans_of_places(self._nodes, self._triangles)
        return self._fans


class _Plane:
    """The plane that touches the sphere at a direction, the centre."""

    def __init__(self, centre: NDArray[np.float64]) -> None:
        across = np.cross(centre, np.eye(3)[np.abs(centre).argmin()])
        across /= np.linalg.norm(across)
        self._centre = centre
        self._axes = np.stack([across, np.cross(centre, across)], axis=1)

    def project(self, directions: NDArray[np.float64]) -> NDArray[np.float64]:
        """From the centre of the sphere onto the plane; NaN from the other side."""
        height = directions @ self._centre
        height = np.where(height > 0, height, np.nan)
        return np.asarray((directions @ self._axes) / height[:, None])


def _check_parts(
    nodes: NDArray[np.float64], triangles: NDArray[np.intp], error: InputError
) -> None:
    """Refuse triangles that overlap, on more than a hemisphere.

    Where two overlap, an axis is at most 55 degrees away. With sides of at most 30 degrees both lie
    within 85 degrees of that axis, and so in one of six planes.
    """
    sides = nodes[triangles] * nodes[np.roll(triangles, 1, axis=1)]
    if sides.sum(axis=2).min() < np.cos(np.radians(30)):
        raise InputError(
            f"{error}; and it does not fit in a hemisphere, and has sides of more than 30 degrees"
        )
    for centre in np.concatenate([np.eye(3), -np.eye(3)]):
        near = (nodes @ centre > _LEAST_HEIGHT)[triangles].all(axis=1)
        if near.any():
            part, corners = np.unique(triangles[near], return_inverse=True)
            flat = _Plane(centre).project(nodes[part])
            Locator(Mesh(flat, corners.reshape(-1, 3), tolerant=True))


def _pole_of(nodes: NDArray[np.float64]) -> NDArray[np.float64] | None:
    """A direction above whose equator all nodes lie: their mean, moved to the lowest in turns.

    Such steps end at one if there is one with room below the nodes.
    """
    pole = nodes.mean(axis=0)
    for _ in range(_MOST_STEPS):
        height = nodes @ (pole / (np.linalg.norm(pole) or 1.0))
        lowest = int(height.argmin())
        if height[lowest] > _LEAST_HEIGHT:
            return np.asarray(pole / np.linalg.norm(pole))
        pole = pole + 0.1 * nodes[lowest]
    return None


def _determinant(a: list[Fraction], b: list[Fraction], p: list[Fraction]) -> Fraction:
    normal = (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])
    return normal[0] * p[0] + normal[1] * p[1] + normal[2] * p[2]


def fans_of_places(
    nodes: NDArray[np.float64], faces: NDArray[np.intp]
) -> tuple[NDArray[np.intp], NDArray[np.intp], NDArray[np.intp]]:
    """List the faces around each place; nodes with equal coordinates have one place.

    Returns
    -------
    place : ndarray, shape (n,)
        The place of each node.
    begin, around : ndarray
        Place p has the faces ``around[begin[p]:begin[p + 1]]``, ascending.
    """
    _, place = np.unique(nodes, axis=0, return_inverse=True)
    place = place.reshape(-1).astype(np.intp)
    row, column = np.nonzero(faces >= 0)
    pairs = np.unique(np.stack([place[faces[row, column]], row], axis=1), axis=0)
    begin = np.searchsorted(pairs[:, 0], np.arange(int(place.max()) + 2))
    return place, begin, pairs[:, 1]
