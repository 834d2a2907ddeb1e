"""Probes of a surface in space, and the point of it that is nearest."""

from __future__ import annotations

import enum
import functools
from typing import TYPE_CHECKING, Any, Literal, NamedTuple

import numpy as np

from meshwalk import _arrays, _core
from meshwalk._space.surface import Surface

if TYPE_CHECKING:
    from typing import Self

    from numpy.typing import ArrayLike, NDArray
    from scipy.sparse import csr_array

    from meshwalk._core import Progress

TOUCH = _arrays.record_type(
    _core.TOUCH_LAYOUT,
    {
        "distance": np.float64,
        "weights": (np.float64, (3,)),
        "triangle": np.int32,
        "state": np.uint8,
        "where": np.uint8,
        "local": np.uint8,
        "back": np.bool_,
    },
)
"""The type of the answer to one probe, as the library writes it."""

NEAREST = _arrays.record_type(
    _core.NEAREST_LAYOUT,
    {
        "triangle": np.int32,
        "distance": np.float64,
        "point": (np.float64, (3,)),
        "weights": (np.float64, (3,)),
    },
)
"""The type of one nearest point, as the library writes it."""


class TouchState(enum.IntEnum):
    """What a probe found: the members of ``Touches.state``.

    Attributes
    ----------
    HIT : 0
        It touches the triangle.
    NONE : 1
        Surely nothing within the distance.
    LIMIT : 2
        Nothing was found within the limit of iterations: there may be something.
    BAD : 3
        A coordinate is NaN or infinite, or the motion is zero.
    """

    HIT = 0
    NONE = 1
    LIMIT = 2
    BAD = 3


class SurfaceSide(enum.IntEnum):
    """Where a point is with respect to a closed surface: the answers of `Prober.inside`.

    Attributes
    ----------
    OUTSIDE : 0
        Outside of the surface.
    INSIDE : 1
        Surrounded by it.
    ON : 2
        Exactly on a triangle.
    BAD : 3
        A coordinate is NaN or infinite.
    """

    OUTSIDE = 0
    INSIDE = 1
    ON = 2
    BAD = 3


class Deviation(NamedTuple):
    """How far the points of a surface are from another one: the answer of `Prober.deviation`.

    Attributes
    ----------
    largest : float
        The largest distance of a sample; between samples a point may be farther.
    at_most : float
        No point is farther than this, up to rounding.
    mean : float
        By area.
    point : tuple[float, float, float]
        The sample with the largest distance.
    nearest : tuple[float, float, float]
        The point of the other surface nearest to it.
    triangle : int
        A triangle that has this sample.
    nearest_triangle : int
        The triangle of the other surface.
    samples : int
        How many distances were measured.
    area : float
        Of the surface, rounded.
    """

    largest: float
    at_most: float
    mean: float
    point: tuple[float, float, float]
    nearest: tuple[float, float, float]
    triangle: int
    nearest_triangle: int
    samples: int
    area: float


class Found:
    """What several queries of a surface found: views of the library's own answers."""

    __slots__ = ("records", "surface")
    _KIND: str
    """Which record of the library it is."""

    def __init__(self, surface: Surface, records: NDArray[Any]) -> None:
        self.surface = surface
        self.records = _arrays.frozen(records)

    @property
    def triangle(self) -> NDArray[np.int32]:
        """The triangle found, -1 for none."""
        return self.records["triangle"]

    @property
    def distance(self) -> NDArray[np.float64]:
        """How far it is; NaN for none."""
        return self.records["distance"]

    @property
    def weights(self) -> NDArray[np.float64]:
        """The point found as weights of the triangle's vertices, shape (..., 3); NaN for none."""
        return self.records["weights"]

    @property
    def shape(self) -> tuple[int, ...]:
        """The shape of the points, without their coordinates."""
        return self.records.shape

    def interpolate(
        self,
        values: ArrayLike | str,
        threads: int = 0,
        *,
        progress: Progress | None = None,
    ) -> NDArray[Any]:
        """Interpolate values at the vertices of the surface, linearly in each triangle.

        Parameters
        ----------
        values, threads, progress
            As of `Locations.interpolate`.

        Returns
        -------
        ndarray, shape ``hit.shape + values.shape[1:]``
            NaN where nothing was found, and where a vertex with a weight has NaN.

        Examples
        --------
        >>> import meshwalk
        >>> floor = meshwalk.Surface([[0, 0, 0], [4, 0, 0], [0, 4, 0]], [[0, 1, 2]])
        >>> prober = meshwalk.Prober(floor, boxes=True)
        >>> prober.nearest([[1, 1, 5], [9, 0, 0]]).interpolate([0.0, 4.0, 8.0])
        array([3., 4.])
        """
        from meshwalk._operator import Operator

        if isinstance(values, str):
            values = _arrays.named(self.surface.fields, values)
        return Operator(self, threads, progress=progress).apply(values, threads, progress=progress)

    def of_triangles(self, values: ArrayLike, missing: Any = np.nan) -> NDArray[Any]:
        """Take the values of the triangles found, without interpolation.

        Parameters
        ----------
        values : array_like, shape (n_triangles, ...)
            Values of the triangles, of any type. Masked values count as `missing`.
        missing : scalar, optional
            The value where nothing was found. Integers stay integers if it is one, too.

        Returns
        -------
        ndarray, shape ``hit.shape + values.shape[1:]``

        Examples
        --------
        >>> import meshwalk
        >>> floor = meshwalk.Surface([[0, 0, 0], [4, 0, 0], [0, 4, 0]], [[0, 1, 2]])
        >>> touches = meshwalk.Prober(floor).probe([[1, 1, 5], [9, 9, 5]], [0, 0, -1])
        >>> touches.of_triangles([0.5])
        array([0.5, nan])
        """
        return _arrays.of_triangles(values, self.surface.triangle_count, self.triangle, missing)

    def _core_operator(self, threads: int, progress: Progress | None) -> _core.Operator:
        """The weights, for an `Operator`."""
        records = np.ascontiguousarray(self.records).reshape(-1)
        return self.surface._operator(self._KIND, records, threads, progress)

    def operator(self) -> csr_array:
        """The interpolation as a sparse matrix, as of `Locations.operator`.

        Returns
        -------
        scipy.sparse.csr_array, shape (number of points, n_vertices)

        See Also
        --------
        Operator : the same weights, which does without SciPy.
        """
        from meshwalk._operator import Operator

        return Operator(self).tocsr()


class Touches(Found):
    """What probes touch: the answer of `Prober.probe`, of the shape of the points.

    `distance` is from the point along the motion, negative behind it. The attributes are views of
    the library's own answers.
    """

    __slots__ = ()
    _KIND = "touches"

    @property
    def state(self) -> NDArray[np.uint8]:
        """What was found: the numbers of `TouchState`."""
        return self.records["state"]

    @property
    def where(self) -> NDArray[np.uint8]:
        """Inside of the triangle, on an edge or at a vertex: the numbers of `Where`."""
        return self.records["where"]

    @property
    def back(self) -> NDArray[np.bool_]:
        """Whether the motion points at the triangle's back."""
        return self.records["back"]

    def __repr__(self) -> str:
        counts = np.bincount(self.state.ravel(), minlength=len(TouchState))
        kinds = ", ".join(f"{counts[s]} {s.name.lower()}" for s in TouchState if counts[s])
        return f"<Touches: {self.records.size} probes{'; ' if kinds else ''}{kinds}>"


class TouchLists(Touches):
    """All that many probes touch: the answer of `Prober.probe_each`.

    The touches of a probe stand one after the other, in their order along its motion.

    Attributes
    ----------
    offsets : ndarray of int64, shape (n + 1,)
        Probe i has the touches from ``offsets[i]`` up to ``offsets[i + 1]``, which is not its.
    """

    __slots__ = ("offsets",)

    def __init__(self, surface: Surface, records: NDArray[Any], offsets: NDArray[np.int64]) -> None:
        super().__init__(surface, records)
        self.offsets = _arrays.frozen(offsets)

    @property
    def count(self) -> NDArray[np.int64]:
        """How many touches each probe has: a new array each time."""
        return np.diff(self.offsets)

    @property
    def probe(self) -> NDArray[np.int64]:
        """The probe of each touch: a new array each time."""
        return np.repeat(np.arange(len(self.offsets) - 1), self.count)

    def __repr__(self) -> str:
        return f"<TouchLists: {len(self.offsets) - 1} probes, {len(self.records)} touches>"


class NearestPoints(Found):
    """The points of a surface that are nearest: the answer of `Prober.nearest`.

    The attributes are views of the library's own answers.
    """

    __slots__ = ()
    _KIND = "nearest"

    @property
    def point(self) -> NDArray[np.float64]:
        """The nearest point, shape (..., 3); NaN for none."""
        return self.records["point"]

    def __repr__(self) -> str:
        found = int((self.triangle >= 0).sum())
        return f"<NearestPoints: {found} of {self.records.size}>"


def _queries(points: ArrayLike, motions: ArrayLike) -> tuple[NDArray[np.float64], tuple[int, ...]]:
    """Points beside motions, six doubles a row, and the shape of the points."""
    rows, shape = _arrays.queries(points, "points", 3)
    ways, way_shape = _arrays.queries(motions, "motions", 3)
    if way_shape not in ((), shape):
        raise ValueError(f"motions must have the shape of points, {shape}, not {way_shape}")
    queries = np.empty((len(rows), 6))
    queries[:, :3] = rows
    queries[:, 3:] = ways
    return queries, shape


class Prober(_core.Prober):
    """Finds the triangle of a surface that a probe touches, and the nearest point.

    Parameters
    ----------
    surface : Surface
        Any surface: open or closed, in pieces.
    boxes : bool, optional
        Build boxes over the triangles, for ``certain=True`` and `nearest`.
    guide : bool, optional
        Make a coarse grid that leads the walks of probes that are not certain to their first
        triangle; for many probes in any order.
    threads : int, optional
        How many threads build them; 0 lets the library choose.
    progress : callable, optional
        As of `Locator`.

    Raises
    ------
    InputError
        The surface has no triangle.

    Notes
    -----
    A prober follows its surface: `Surface.move` brings it up to date. It keeps the surface alive,
    and any number of threads may ask it at a time.

    Examples
    --------
    >>> import meshwalk
    >>> floor = meshwalk.Surface([[0, 0, 0], [4, 0, 0], [0, 4, 0]], [[0, 1, 2]])
    >>> prober = meshwalk.Prober(floor, boxes=True)
    >>> touch = prober.probe([[1, 1, 5], [9, 9, 5]], [0, 0, -1], certain=True)
    >>> touch
    <Touches: 2 probes; 1 hit, 1 none>
    >>> touch.distance
    array([ 5., nan])
    >>> prober.nearest([1, -2, 0]).point
    array([1., 0., 0.])
    """

    __slots__ = ("__weakref__", "_boxes", "_guide")
    _boxes: bool
    _guide: bool
    if TYPE_CHECKING:
        surface: Surface

    def __new__(
        cls,
        surface: Surface,
        boxes: bool = False,
        *,
        guide: bool = False,
        threads: int = 0,
        progress: Progress | None = None,
    ) -> Self:
        if not isinstance(surface, Surface):
            raise TypeError(f"surface must be a meshwalk.Surface, not {type(surface).__name__}")
        with surface._lock:
            prober = _core.prober_from_surface(cls, surface, boxes, guide, threads, progress)
            prober._boxes = boxes
            prober._guide = guide
            surface._keep(prober)
        return prober

    def probe(
        self,
        points: ArrayLike,
        motions: ArrayLike,
        max_distance: float = 0,
        *,
        certain: bool = False,
        extent: Literal["line", "ray", "segment"] = "line",
        faces: Literal["front", "back", "both"] = "front",
        min_distance: float = 0,
        start: Literal["auto", "last", "sample", "random"] = "auto",
        iterations: int = 0,
        threads: int = 0,
        progress: Progress | None = None,
    ) -> Touches:
        """Find the triangles that lines through points touch, on either side of the points.

        Parameters
        ----------
        points : array_like, shape (..., 3)
            Where the probes are.
        motions : array_like, shape (..., 3)
            Their motions; only triangles whose fronts these point at are touched. One motion may
            serve all points.
        max_distance : float, optional
            In units of length, how far a touch may be; 0 means any distance.
        certain : bool, optional
            Find the nearest touch, and none is missed. Needs a prober with ``boxes=True``. Else the
            walks as published: fast, and where their iterations end without a touch the state is
            ``TouchState.LIMIT``.
        extent : {"line", "ray", "segment"}, optional
            Which part of the line counts: all of it, the point and what is ahead of it, or from
            the point to ``motions``, which then are the other ends. Ray and segment need
            ``certain=True``, as do the two that follow.
        faces : {"front", "back", "both"}, optional
            Which triangles count: those at whose front or back the motion points, or both.
        min_distance : float, optional
            What is nearer to the point than this does not count.
        start : {"auto", "last", "sample", "random"}, optional
            The first triangle of a walk.
        iterations : int, optional
            Walks at most, from different first triangles; 0 means 10.
        threads : int, optional
            How many threads answer; 0 lets the library choose. The answers are the same.
        progress : callable, optional
            As of `Locator.locate`.

        Returns
        -------
        Touches
        """
        queries, shape = _queries(points, motions)
        records = np.empty(len(queries), TOUCH)
        self._probe(
            queries,
            records,
            min_distance,
            max_distance,
            certain,
            extent,
            faces,
            start,
            iterations,
            threads,
            progress,
        )
        return Touches(self.surface, records.reshape(shape))

    def probe_all(
        self,
        point: ArrayLike,
        motion: ArrayLike,
        max_distance: float = 0,
        *,
        extent: Literal["line", "ray", "segment"] = "line",
        faces: Literal["front", "back", "both"] = "both",
        min_distance: float = 0,
    ) -> Touches:
        """Find all triangles that a line through a point touches, in their order along it.

        Parameters
        ----------
        point : array_like, shape (3,)
            Where the probe is.
        motion : array_like, shape (3,)
            Its motion; the other end of a segment.
        max_distance, extent, faces, min_distance
            As of `probe`, but both faces count unless told otherwise.

        Returns
        -------
        Touches
            One for each triangle; those at one place are ordered by number.

        Raises
        ------
        ValueError
            The prober has no boxes, a number is not finite, or the motion is zero.

        Examples
        --------
        >>> import meshwalk
        >>> floor = meshwalk.Surface([[0, 0, 0], [4, 0, 0], [0, 4, 0]], [[0, 1, 2]])
        >>> prober = meshwalk.Prober(floor, boxes=True)
        >>> prober.probe_all([1, 1, -5], [0, 0, 1], extent="ray").distance
        array([5.])
        """
        rows, shape = _arrays.queries(point, "point", 3)
        ways, way_shape = _arrays.queries(motion, "motion", 3)
        if shape or way_shape:
            raise ValueError("point and motion must be one each, three numbers")
        x, y, z, a, b, c = (float(v) for v in (*rows[0], *ways[0]))
        found = self._all((x, y, z, a, b, c), extent, faces, min_distance, max_distance)
        return Touches(self.surface, np.frombuffer(found, TOUCH))

    def probe_each(
        self,
        points: ArrayLike,
        motions: ArrayLike,
        max_distance: float = 0,
        *,
        extent: Literal["line", "ray", "segment"] = "line",
        faces: Literal["front", "back", "both"] = "both",
        min_distance: float = 0,
        one_per_place: bool = False,
        threads: int = 0,
        progress: Progress | None = None,
    ) -> TouchLists:
        """Find all triangles that each of many lines touches, in their order along it.

        Parameters
        ----------
        points, motions : array_like, shape (..., 3)
            As of `probe`.
        max_distance, extent, faces, min_distance
            As of `probe_all`.
        one_per_place : bool, optional
            Of several triangles that a line touches at one place, exactly, give only the lowest: a
            line through an edge touches once there.
        threads : int, optional
            How many threads answer; 0 lets the library choose. The answers are the same.
        progress : callable, optional
            As of `Locator.locate`.

        Returns
        -------
        TouchLists
            In the order of the points' ``ravel``. A point or motion that is not finite, or a motion
            of zero, touches nothing.

        Raises
        ------
        ValueError
            The prober has no boxes.

        Examples
        --------
        >>> import meshwalk
        >>> floor = meshwalk.Surface([[0, 0, 0], [4, 0, 0], [0, 4, 0]], [[0, 1, 2]])
        >>> prober = meshwalk.Prober(floor, boxes=True)
        >>> found = prober.probe_each([[1, 1, 5], [9, 9, 5], [1, 2, 3]], [0, 0, -1])
        >>> found.probe
        array([0, 2])
        >>> found.distance
        array([5., 3.])
        """
        queries, _ = _queries(points, motions)
        offsets, touches = self._lists(
            queries, one_per_place, extent, faces, min_distance, max_distance, threads, progress
        )
        return TouchLists(
            self.surface, np.frombuffer(touches, TOUCH), np.frombuffer(offsets, np.int64)
        )

    def probe_any(
        self,
        points: ArrayLike,
        motions: ArrayLike,
        max_distance: float = 0,
        *,
        extent: Literal["line", "ray", "segment"] = "line",
        faces: Literal["front", "back", "both"] = "both",
        min_distance: float = 0,
        threads: int = 0,
        progress: Progress | None = None,
    ) -> NDArray[np.bool_]:
        """Tell which lines touch any triangle: faster than to find the nearest.

        Parameters
        ----------
        points, motions : array_like, shape (..., 3)
            As of `probe`.
        max_distance, extent, faces, min_distance
            As of `probe_all`.
        threads : int, optional
            How many threads answer; 0 lets the library choose.
        progress : callable, optional
            As of `Locator.locate`.

        Returns
        -------
        ndarray of bool, shape (...)
            False, too, where a point or motion is not finite or a motion is zero.

        Raises
        ------
        ValueError
            The prober has no boxes.

        Examples
        --------
        >>> import meshwalk
        >>> floor = meshwalk.Surface([[0, 0, 0], [4, 0, 0], [0, 4, 0]], [[0, 1, 2]])
        >>> prober = meshwalk.Prober(floor, boxes=True)
        >>> prober.probe_any([[1, 1, 5], [9, 9, 5]], [0, 0, -1], extent="ray")
        array([ True, False])
        """
        queries, shape = _queries(points, motions)
        states = np.empty(len(queries), np.uint8)
        self._any(queries, states, extent, faces, min_distance, max_distance, threads, progress)
        touched: NDArray[np.bool_] = states == TouchState.HIT
        return touched.reshape(shape)

    def inside(self, points: ArrayLike, *, threads: int = 0) -> NDArray[np.uint8]:
        """Decide which points are inside of the surface, exactly.

        Parameters
        ----------
        points : array_like, shape (..., 3)
            The points.
        threads : int, optional
            How many threads answer; 0 lets the library choose.

        Returns
        -------
        ndarray
            For each point a number of `SurfaceSide`.

        Raises
        ------
        InputError
            The surface is not closed.
        ValueError
            The prober has no boxes.

        Examples
        --------
        >>> import meshwalk
        >>> corners = [[0, 0, 0], [4, 0, 0], [0, 4, 0], [0, 0, 4]]
        >>> solid = meshwalk.Surface(corners, [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]])
        >>> meshwalk.Prober(solid, boxes=True).inside([[1, 1, 1], [3, 3, 3], [0, 0, 0]])
        array([1, 0, 2], dtype=uint8)
        """
        rows, shape = _arrays.queries(points, "points", 3)
        sides = np.empty(len(rows), np.uint8)
        self._inside(rows, sides, threads)
        return sides.reshape(shape)

    def nearest(
        self,
        points: ArrayLike,
        max_distance: float = np.inf,
        *,
        threads: int = 0,
        progress: Progress | None = None,
    ) -> NearestPoints:
        """Find the points of the surface that are nearest to points.

        Parameters
        ----------
        points : array_like, shape (..., 3)
            The points.
        max_distance : float, optional
            Look no farther.
        threads : int, optional
            How many threads answer; 0 lets the library choose. The answers are the same.
        progress : callable, optional
            As of `Locator.locate`.

        Returns
        -------
        NearestPoints

        Raises
        ------
        ValueError
            The prober has no boxes, or the distance is negative or NaN.
        """
        rows, shape = _arrays.queries(points, "points", 3)
        records = np.empty(len(rows), NEAREST)
        self._nearest(rows, records, max_distance, threads, progress)
        return NearestPoints(self.surface, records.reshape(shape))

    def deviation(
        self, surface: Surface, *, threads: int = 0, progress: Progress | None = None
    ) -> Deviation:
        """Measure how far another surface is from that of the prober, by samples.

        Samples are the vertices and the centroids of triangles, of which large ones are cut. This
        is one direction: the Hausdorff distance is the larger of both.

        Parameters
        ----------
        surface : Surface
            The surface with the samples.
        threads : int, optional
            How many threads work on it; 0 lets the library choose. The answer is the same.
        progress : callable, optional
            As of `Locator.locate`.

        Returns
        -------
        Deviation

        Raises
        ------
        InputError
            A surface has no triangles, or a vertex that is not finite.
        ValueError
            The prober has no boxes.

        Examples
        --------
        >>> import meshwalk
        >>> floor = meshwalk.Surface([[0, 0, 0], [4, 0, 0], [0, 4, 0]], [[0, 1, 2]])
        >>> tilted = meshwalk.Surface([[0, 0, 1], [4, 0, 2], [0, 4, 3]], [[0, 1, 2]])
        >>> found = meshwalk.Prober(floor, boxes=True).deviation(tilted)
        >>> found.largest, found.mean, found.point
        (3.0, 2.0, (0.0, 4.0, 3.0))
        """
        with surface._lock:
            return Deviation(**self._deviation(surface, threads, progress))

    def __repr__(self) -> str:
        return f"<Prober of {self.surface!r}{', with boxes' if self._boxes else ''}>"

    def __reduce__(self) -> tuple[Any, ...]:
        make = functools.partial(type(self), guide=self._guide)
        return make, (self.surface, self._boxes)
