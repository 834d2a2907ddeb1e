"""Rays from the centre of a star-shaped polyhedron, such as a globe."""

from __future__ import annotations

import functools
import math
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from meshwalk import _arrays, _core
from meshwalk._check import check_star
from meshwalk._errors import InputError
from meshwalk._locations import LOCATION, Locations
from meshwalk._space.surface import Surface

if TYPE_CHECKING:
    from typing import Self

    from numpy.typing import ArrayLike, NDArray

    from meshwalk._core import Progress


class StarInfo(NamedTuple):
    """What a star keeps beside its surface: the answer of `Star.describe`.

    Attributes
    ----------
    bytes : int
        All memory of the star, the surface not counted.
    angle_bytes : int
        Of it, spherical coordinates.
    flat_facets : int
        Facets without area.
    centre : tuple[float, float, float]
        Where the rays begin.
    """

    bytes: int
    angle_bytes: int
    flat_facets: int
    centre: tuple[float, float, float]


class Remeshed(NamedTuple):
    """A polyhedron sampled anew: the answer of `Star.remesh`.

    Attributes
    ----------
    surface : Surface
        The new mesh, with the fields of the polyhedron.
    hit : Locations
        The facet and the weights of each new vertex, for other values.
    """

    surface: Surface
    hit: Locations


class Star(_core.Star):
    """Finds the facet of a closed surface that a ray from a centre meets, exactly.

    Parameters
    ----------
    surface : Surface
        A closed polyhedron, star-shaped about the centre: each ray meets it once.
    centre : array_like, shape (3,), optional
        Where the rays begin; the origin by default.
    borrow : bool, optional
        Keep nothing but the centre: walks follow the surface's own triangles. The answers are the
        same, bit for bit, and take several times as long. It follows no `SurfaceEditor`: after
        edits it answers again once `Surface.move` has been called, or at once if `unchecked`.
    unchecked : bool, optional
        With `borrow`: trust that the surface is star-shaped, now and after every change. Then
        making the star takes no time, and moves need no check. If it is not, a facet that is
        answered meets the ray, but may not be the lowest that does.
    threads : int, optional
        How many threads prepare the star; 0 lets the library choose. The star is the same.
    progress : callable, optional
        As of `Locator`.

    Raises
    ------
    InputError
        The surface is not closed, or not star-shaped about the centre; the exception tells the
        first defect.

    Notes
    -----
    A star follows its surface: `Surface.move` brings it up to date. It keeps the surface alive, and
    any number of threads may ask it at a time.

    Examples
    --------
    >>> import meshwalk
    >>> corners = [[0, 90], [0, 0], [90, 0], [180, 0], [270, 0], [0, -90]]
    >>> triangles = [[0, 1, 2], [0, 2, 3], [0, 3, 4], [0, 4, 1],
    ...              [5, 2, 1], [5, 3, 2], [5, 4, 3], [5, 1, 4]]
    >>> globe = meshwalk.Star(meshwalk.Surface.from_lonlat(corners, triangles))
    >>> globe.locate([[1, 2, 3], [0, 0, -7]]).triangle
    array([0, 4], dtype=int32)
    >>> globe.locate([[45, 45], [-45, -45]], lonlat=True).triangle
    array([0, 7], dtype=int32)
    >>> slim = meshwalk.Star(globe.surface, borrow=True)
    >>> slim.locate([[1, 2, 3], [0, 0, -7]]).triangle
    array([0, 4], dtype=int32)
    >>> slim.describe().bytes < 500 < globe.describe().bytes
    True
    """

    __slots__ = ("__weakref__", "_borrows", "_centre")
    _borrows: tuple[bool, bool]
    _centre: tuple[float, float, float]
    if TYPE_CHECKING:
        surface: Surface

    def __new__(
        cls,
        surface: Surface,
        centre: ArrayLike = (0, 0, 0),
        *,
        borrow: bool = False,
        unchecked: bool = False,
        threads: int = 0,
        progress: Progress | None = None,
    ) -> Self:
        if not isinstance(surface, Surface):
            raise TypeError(f"surface must be a meshwalk.Surface, not {type(surface).__name__}")
        place, _ = _arrays.queries(centre, "centre", 3)
        if place.shape != (1, 3):
            raise ValueError("centre must be one point")
        x, y, z = (float(value) for value in place[0])
        with surface._lock:
            try:
                star = _core.star_from_surface(
                    cls, surface, x, y, z, borrow, unchecked, threads, progress
                )
            except InputError as error:
                weld = surface._options[0]
                found = check_star(surface.points, surface.triangles, (x, y, z), weld=weld)
                error.defect = next((d for d in found.defects if d.kind != "flat triangle"), None)
                raise
            star._borrows = (borrow, unchecked)
            star._centre = (x, y, z)
            surface._keep(star)
        return star

    def locate(
        self,
        points: ArrayLike,
        lonlat: bool = False,
        threads: int = 0,
        *,
        walk: str = "auto",
        start: str = "auto",
        progress: Progress | None = None,
    ) -> Locations:
        """Find the facets that rays from the centre meet.

        Parameters
        ----------
        points : array_like, shape (..., 3), or (..., 2) with `lonlat`
            A point on each ray but the centre; or its longitude and latitude in degrees, seen from
            the centre.
        lonlat : bool, optional
            Whether these are longitudes and latitudes.
        threads : int, optional
            How many threads answer; 0 lets the library choose. The answers are the same.
        walk, start : str, optional
            By which walk, and from which first facet. The answers are the same.
        progress : callable, optional
            As of `Locator.locate`.

        Returns
        -------
        Locations
            `weights` are those of the point where the ray meets the flat facet. ``Where.BAD`` where
            a point is the centre, not finite, or no longitude and latitude.
        """
        if lonlat:
            rows, shape = _arrays.queries(points, "points", 2)
            directions = lonlat_to_direction(rows)
            directions *= _ray_length(self._centre)
            directions += self._centre
            rows = directions
        else:
            rows, shape = _arrays.queries(points, "points", 3)
        records = np.empty(len(rows), LOCATION)
        self._locate(rows, records, walk, start, threads, progress)
        return Locations._of(self.surface, records.reshape(shape))

    def project(
        self, points: ArrayLike, threads: int = 0, *, progress: Progress | None = None
    ) -> NDArray[np.float64]:
        """Find where rays from the centre through points meet the polyhedron.

        Parameters
        ----------
        points : array_like, shape (..., 3)
            A point on each ray but the centre.
        threads : int, optional
            How many threads answer; 0 lets the library choose. The answers are the same.
        progress : callable, optional
            As of `Locator.locate`.

        Returns
        -------
        ndarray, shape (..., 3)
            Each coordinate is the double nearest to the exact one. NaN where a point is the centre,
            or not finite.
        """
        rows, shape = _arrays.queries(points, "points", 3)
        out, _ = self._project_rows(rows, threads, progress)
        return out.reshape(*shape, 3)

    def _project_rows(
        self, rows: NDArray[np.float64], threads: int, progress: Progress | None
    ) -> tuple[NDArray[np.float64], Locations]:
        out = np.empty((len(rows), 3))
        records = np.empty(len(rows), LOCATION)
        self._project(rows, out, records, threads, progress)
        return out, Locations._of(self.surface, records)

    def remesh(
        self,
        level: int | None = None,
        *,
        onto: Surface | None = None,
        threads: int = 0,
        progress: Progress | None = None,
    ) -> Remeshed:
        """Sample the polyhedron on an icosphere about the centre, or on another mesh.

        Each new vertex is where a ray from the centre meets the polyhedron: the exact point, each
        coordinate rounded once. The fields of the surface are interpolated there; NaN where a
        vertex with a weight has NaN.

        Parameters
        ----------
        level : int, optional
            How often the triangles of an icosahedron are cut into four, 0 to 12: the result has
            ``10 * 4**level + 2`` vertices.
        onto : Surface, optional
            Instead: a mesh that is star-shaped about the same centre. The result has its triangles,
            and its vertices move along their rays.
        threads : int, optional
            How many threads work on it; 0 lets the library choose. The result is the same.
        progress : callable, optional
            As of `Locator.locate`.

        Returns
        -------
        Remeshed

        Raises
        ------
        InputError
            `onto` is not star-shaped about the centre.

        Examples
        --------
        >>> import meshwalk
        >>> points = [[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]]
        >>> triangles = [[0, 2, 4], [2, 1, 4], [1, 3, 4], [3, 0, 4],
        ...              [2, 0, 5], [1, 2, 5], [3, 1, 5], [0, 3, 5]]
        >>> fields = {"height": [0, 0, 0, 0, 1, -1]}
        >>> star = meshwalk.Star(meshwalk.Surface(points, triangles, fields))
        >>> ball, hit = star.remesh(3)
        >>> ball
        <Surface: 642 vertices, 1280 triangles, fields: height>
        >>> bool(abs(ball.fields["height"] - ball.points[:, 2]).max() < 1e-15)
        True
        >>> hit.triangle.shape
        (642,)
        """
        if (level is None) == (onto is None):
            raise TypeError("remesh takes either a level or a mesh, not both or none")
        if onto is None:
            points, triangles, hit = self._on_icosphere(level or 0, threads, progress)
        else:
            points, triangles, hit = self._onto(onto, threads, progress)
        values = {
            name: hit.interpolate(field, threads) for name, field in self.surface.fields.items()
        }
        weld = onto is not None and onto._options[0]
        return Remeshed(Surface(points, triangles, values, weld=weld), hit)

    def _on_icosphere(
        self, level: int, threads: int, progress: Progress | None
    ) -> tuple[NDArray[np.float64], NDArray[np.integer[Any]], Locations]:
        vertices, count = _core.icosphere_size(level)
        points = np.empty((vertices, 3))
        triangles = np.empty((count, 3), np.uint32)
        records = np.empty(vertices, LOCATION)
        self._remesh(level, points, triangles, records, threads, progress)
        return points, triangles, Locations._of(self.surface, records)

    def _onto(
        self, onto: Surface, threads: int, progress: Progress | None
    ) -> tuple[NDArray[np.float64], NDArray[np.integer[Any]], Locations]:
        Star(onto, self._centre)
        rows = onto.points
        points, hit = self._project_rows(rows, threads, progress)
        alone = hit.triangle < 0  # of no triangle, at the centre
        points[alone] = rows[alone]
        return points, onto.triangles, hit

    def describe(self) -> StarInfo:
        """Tell what the star keeps beside its surface.

        Returns
        -------
        StarInfo
        """
        with self.surface._lock:
            return StarInfo(**self._describe())

    def __repr__(self) -> str:
        return f"<Star of {self.surface!r} about {self._centre}>"

    def __reduce__(self) -> tuple[Any, ...]:
        borrow, unchecked = self._borrows
        make = functools.partial(type(self), borrow=borrow, unchecked=unchecked)
        return make, (self.surface, self._centre)


def _ray_length(centre: tuple[float, float, float]) -> float:
    """As the program has it: a power of two, at least 1 and half of the largest coordinate."""
    _, exponent = math.frexp(max(abs(value) for value in centre))
    return math.ldexp(1, exponent - 1) if exponent > 0 else 1


def lonlat_to_direction(lonlat: ArrayLike) -> NDArray[np.float64]:
    """Directions of longitudes and latitudes on the unit sphere.

    Parameters
    ----------
    lonlat : array_like, shape (..., 2)
        Longitude and latitude in degrees.

    Returns
    -------
    ndarray, shape (..., 3)
        x to (0, 0), y to (90, 0), z to the north pole. Multiples of 90 degrees give exact
        directions; others are off by less than 2**-52. NaN where a number is not finite, or a
        latitude is above 90 or below -90.

    Examples
    --------
    >>> import meshwalk
    >>> meshwalk.lonlat_to_direction([[90, 0], [0, 91]])
    array([[ 0.,  1.,  0.],
           [nan, nan, nan]])
    """
    rows, shape = _arrays.queries(lonlat, "lonlat", 2)
    out = np.empty((len(rows), 3))
    _core.lonlat_to_direction(rows, out)
    return out.reshape(*shape, 3)


def direction_to_lonlat(directions: ArrayLike) -> NDArray[np.float64]:
    """Longitudes (-180 to 180) and latitudes of directions, in degrees.

    Parameters
    ----------
    directions : array_like, shape (..., 3)
        Of any length.

    Returns
    -------
    ndarray, shape (..., 2)
        Rounded; the longitude of a pole is 0. NaN for a direction of length 0.

    Examples
    --------
    >>> import meshwalk
    >>> meshwalk.direction_to_lonlat([0, 7, 0])
    array([90.,  0.])
    """
    rows, shape = _arrays.queries(directions, "directions", 3)
    out = np.empty((len(rows), 2))
    _core.direction_to_lonlat(rows, out)
    return out.reshape(*shape, 2)
