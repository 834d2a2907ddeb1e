"""Drop-in for users of trimesh: the same rays, exact.

`RayIntersector` takes the place of the object that a mesh has as ``mesh.ray``. All that trimesh
does with rays then uses it, such as ``mesh.contains`` and ``trimesh.proximity.signed_distance``::

    mesh.ray = meshwalk.trimesh.RayIntersector(mesh)

trimesh itself has to be installed.
"""

from __future__ import annotations

import threading
from typing import TYPE_CHECKING, Any, Literal, NamedTuple

import numpy as np

from meshwalk import _arrays
from meshwalk._errors import InputError
from meshwalk._space.prober import Prober, SurfaceSide
from meshwalk._space.surface import Surface

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

    Numbers = NDArray[np.int64]
    Points = NDArray[np.float64]

__all__ = ["RayIntersector"]


class _Made(NamedTuple):
    """What was made of a mesh as it was."""

    key: int
    prober: Prober | None
    """None for a mesh without faces."""
    vertices: Points
    faces: NDArray[Any]


def _rays(origins: ArrayLike, directions: ArrayLike) -> tuple[Points, Points]:
    """Both as rows of doubles, one for each ray."""
    origins = np.asanyarray(origins)
    directions = np.asanyarray(directions)
    if origins.shape != directions.shape:
        raise ValueError("Ray origin and direction don't match!")  # as trimesh says it
    if origins.ndim != 2 or origins.shape[1] != 3:
        raise ValueError(f"rays must have the shape (n, 3), not {origins.shape}")
    rows, _ = _arrays.queries(origins, "ray_origins", 3)
    ways, _ = _arrays.queries(directions, "ray_directions", 3)
    return rows, ways


def _places(made: _Made, triangle: NDArray[Any], weights: Points) -> Points:
    """Places in triangles, which keep a coordinate that all three corners have."""
    corners = made.faces[triangle]
    base = made.vertices[corners[:, 0]]
    along = [weights[:, k, None] * (made.vertices[corners[:, k]] - base) for k in (1, 2)]
    places: Points = base + (along[0] + along[1])
    return places


class RayIntersector:
    """Rays against a `trimesh.Trimesh`, exact: which triangles they hit, and what is inside.

    Parameters
    ----------
    mesh : trimesh.Trimesh
        The mesh. It may have borders and several pieces, cross itself and have faces without area.
        It is followed: after a change the next question makes boxes anew.
    scale_to_box : bool, optional
        Makes no difference: nothing is scaled.
    faces : {"both", "front", "back"}, optional
        Which triangles rays hit: all, or only those at whose front or back they point. The front is
        the side to which the normal points.
    edges : {"once", "all"}, optional
        What a ray through an edge or a vertex hits: the lowest of the triangles there, or all of
        them. The same holds for faces that lie in one place.
    threads : int, optional
        How many threads answer; 0 lets the library choose. The answers are the same.

    Notes
    -----
    Decisions are exact for the doubles of the mesh and of the rays; directions are taken as they
    are, of any length. A ray hits what it begins on, and does not hit a triangle along which it
    lies. A ray hits nothing if a number of it is not finite or its direction is zero. Hits are
    ordered by ray, then along the ray.

    Any number of threads may ask one object, while nothing changes the mesh. O(n log n) for a mesh
    of n faces, at the first question after a change; O(log n) a ray typically.

    Examples
    --------
    >>> import meshwalk.trimesh, trimesh
    >>> mesh = trimesh.creation.box()
    >>> mesh.ray = meshwalk.trimesh.RayIntersector(mesh)
    >>> mesh.ray.intersects_location([[0, 0, -5]], [[0, 0, 1]])[0]
    array([[ 0. ,  0. , -0.5],
           [ 0. ,  0. ,  0.5]])
    >>> mesh.contains([[0, 0, 0], [1, 0, 0]])
    array([ True, False])
    """

    def __init__(
        self,
        mesh: Any,
        scale_to_box: bool = True,
        *,
        faces: Literal["both", "front", "back"] = "both",
        edges: Literal["once", "all"] = "once",
        threads: int = 0,
    ) -> None:
        if faces not in ("both", "front", "back"):
            raise ValueError(f"faces must be 'both', 'front' or 'back', not {faces!r}")
        if edges not in ("once", "all"):
            raise ValueError(f"edges must be 'once' or 'all', not {edges!r}")
        self.mesh = mesh
        self._options: tuple[Any, ...] = (scale_to_box, faces, edges, threads)
        self._faces = faces
        self._once = edges == "once"
        self._threads = threads
        self._lock = threading.Lock()
        self._made: _Made | None = None
        self._solid: tuple[int, Prober | None] | None = None

    def _follow(self) -> _Made:
        """What was made of the mesh as it is now."""
        with self._lock:
            key = hash(self.mesh)
            if self._made is None or self._made.key != key:
                vertices = np.array(self.mesh.vertices, np.float64)
                faces = np.array(self.mesh.faces)
                prober = None
                if len(faces):
                    surface = Surface(vertices, faces, tolerant=True)
                    prober = Prober(surface, boxes=True, threads=self._threads)
                self._made = _Made(key, prober, vertices, faces)
            return self._made

    @property
    def prober(self) -> Prober | None:
        """What answers: for all that `meshwalk.Prober` can; None for a mesh without faces."""
        return self._follow().prober

    def intersects_id(
        self,
        ray_origins: ArrayLike,
        ray_directions: ArrayLike,
        multiple_hits: bool = True,
        max_hits: int | None = None,
        return_locations: bool = False,
    ) -> tuple[NDArray[Any], ...]:
        """Find the triangles that rays hit.

        Parameters
        ----------
        ray_origins, ray_directions : array_like, shape (n, 3)
            The rays.
        multiple_hits : bool, optional
            All hits of each ray, or only the first one.
        max_hits : int, optional
            At most as many hits of each ray, the first ones. By default all, where trimesh with
            embreex gives 100.
        return_locations : bool, optional
            Give locations, too.

        Returns
        -------
        index_tri : ndarray of int64, shape (m,)
            The faces hit.
        index_ray : ndarray of int64, shape (m,)
            Their rays.
        locations : ndarray of float64, shape (m, 3)
            Where, if asked for.
        """
        rows, ways = _rays(ray_origins, ray_directions)
        made = self._follow()
        if made.prober is None:
            nothing = np.zeros(0, np.int64)
            return (nothing, nothing, np.zeros((0, 3))) if return_locations else (nothing, nothing)
        if multiple_hits:
            triangle, ray, weights = self._all(made.prober, rows, ways, max_hits)
        else:
            touches = self._first(made.prober, rows, ways)
            ray = np.flatnonzero(touches.triangle >= 0)
            triangle, weights = touches.triangle[ray], touches.weights[ray]
        index_tri = triangle.astype(np.int64)
        if not return_locations:
            return index_tri, ray
        return index_tri, ray, _places(made, index_tri, weights)

    def _all(
        self, prober: Prober, rows: Points, ways: Points, max_hits: int | None
    ) -> tuple[NDArray[Any], Numbers, Points]:
        found = prober.probe_each(
            rows,
            ways,
            extent="ray",
            faces=self._faces,
            one_per_place=self._once,
            threads=self._threads,
        )
        triangle, ray, weights = found.triangle, found.probe, found.weights
        if max_hits is None:
            return triangle, ray, weights
        kept = np.arange(len(triangle)) - found.offsets[ray] < max_hits
        return triangle[kept], ray[kept], weights[kept]

    def _first(self, prober: Prober, rows: Points, ways: Points) -> Any:
        return prober.probe(
            rows, ways, certain=True, extent="ray", faces=self._faces, threads=self._threads
        )

    def intersects_location(
        self,
        ray_origins: ArrayLike,
        ray_directions: ArrayLike,
        multiple_hits: bool = True,
        **options: Any,
    ) -> tuple[Points, Numbers, Numbers]:
        """Find where rays hit the mesh.

        Parameters
        ----------
        ray_origins, ray_directions, multiple_hits
            As of `intersects_id`, as ``max_hits``.

        Returns
        -------
        locations : ndarray of float64, shape (m, 3)
            The places, on their triangles up to rounding.
        index_ray : ndarray of int64, shape (m,)
            Their rays.
        index_tri : ndarray of int64, shape (m,)
            Their faces.
        """
        options["return_locations"] = True
        found: Any = self.intersects_id(ray_origins, ray_directions, multiple_hits, **options)
        return found[2], found[1], found[0]

    def intersects_first(
        self, ray_origins: ArrayLike, ray_directions: ArrayLike, **options: Any
    ) -> Numbers:
        """Find the first triangle that each ray hits.

        Parameters
        ----------
        ray_origins, ray_directions : array_like, shape (n, 3)
            The rays.

        Returns
        -------
        ndarray of int64, shape (n,)
            The faces, -1 for rays that hit none. Of several at one place, the lowest.
        """
        rows, ways = _rays(ray_origins, ray_directions)
        prober = self._follow().prober
        if prober is None:
            return np.full(len(rows), -1, np.int64)
        first: Numbers = self._first(prober, rows, ways).triangle.astype(np.int64)
        return first

    def intersects_any(
        self, ray_origins: ArrayLike, ray_directions: ArrayLike, **options: Any
    ) -> NDArray[np.bool_]:
        """Tell which rays hit anything.

        Parameters
        ----------
        ray_origins, ray_directions : array_like, shape (n, 3)
            The rays.

        Returns
        -------
        ndarray of bool, shape (n,)
        """
        rows, ways = _rays(ray_origins, ray_directions)
        prober = self._follow().prober
        if prober is None:
            return np.zeros(len(rows), bool)
        return prober.probe_any(rows, ways, extent="ray", faces=self._faces, threads=self._threads)

    def contains_points(self, points: ArrayLike) -> NDArray[np.bool_]:
        """Tell which points are inside of the mesh.

        Parameters
        ----------
        points : array_like, shape (n, 3)
            The points.

        Returns
        -------
        ndarray of bool, shape (n,)
            Exact for a watertight mesh: a point inside of two pieces is in neither. False for
            points on the surface. For a mesh with borders, or with edges of more than two faces,
            trimesh's own rule, with exact rays.
        """
        rows, shape = _arrays.queries(points, "points", 3)
        if len(shape) != 1:
            raise ValueError("points must be (n,3)")
        if self._follow().prober is None:
            return np.zeros(len(rows), bool)
        solid = self._follow_solid()
        if solid is not None:
            inside: NDArray[np.bool_] = solid.inside(rows, threads=self._threads) == (
                SurfaceSide.INSIDE
            )
            return inside
        from trimesh.ray.ray_util import contains_points

        return np.asarray(contains_points(self, rows), bool)

    def _follow_solid(self) -> Prober | None:
        """The prober of a surface that has an inside; None if the mesh has none."""
        made = self._follow()
        with self._lock:
            if self._solid is None or self._solid[0] != made.key:
                self._solid = made.key, self._make_solid(made)
            return self._solid[1]

    def _make_solid(self, made: _Made) -> Prober | None:
        """As it is; else with the vertices welded that lie in one place."""
        assert made.prober is not None
        try:
            made.prober.inside(made.vertices[:1])
        except InputError:
            welded = Surface(made.vertices, made.faces, weld=True, tolerant=True)
            if not welded.describe().closed:
                return None
            prober = Prober(welded, boxes=True, threads=self._threads)
            try:
                prober.inside(made.vertices[:1])
            except InputError:
                return None
            return prober
        return made.prober

    def __getstate__(self) -> dict[str, Any]:
        return {"mesh": self.mesh, "options": self._options}

    def __setstate__(self, state: dict[str, Any]) -> None:
        scale_to_box, faces, edges, threads = state["options"]
        RayIntersector.__init__(
            self, state["mesh"], scale_to_box, faces=faces, edges=edges, threads=threads
        )

    def __copy__(self) -> RayIntersector:
        copy = RayIntersector.__new__(RayIntersector)
        copy.__setstate__(self.__getstate__())
        return copy

    def __deepcopy__(self, memo: Any) -> RayIntersector:
        """As trimesh has it: of the same mesh."""
        return self.__copy__()
