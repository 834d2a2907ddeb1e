"""Drop-ins beside the libraries that they stand in for, in one run: see `meshwalk.bench`.

Each task makes its queries and a list of contestants. A contestant is made, which is timed, and
then answers all queries, as many rounds as wanted. Memory is by how much the process has grown when
it is made and has answered once.
"""

from __future__ import annotations

import time
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

import meshwalk

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from numpy.typing import NDArray

    Ask = Callable[[], NDArray[Any]]


MOST_SLOW_RAYS = 20_000
"""trimesh without embreex takes milliseconds a ray: with more it is left out."""


class Row(NamedTuple):
    """What was measured of one contestant."""

    name: str
    build: float
    """Seconds to make it."""
    query: float
    """Seconds for each query, in the best round."""
    memory: float
    """Bytes by which the process grew; NaN where the system does not tell."""
    same: float
    """Part of the answers that are those of meshwalk."""


class Contestant(NamedTuple):
    """One way to answer: `make` does what is done once, and returns what answers."""

    name: str
    make: Callable[[], Ask]


def _resident() -> float:
    """Bytes of memory that the process has now."""
    try:
        with open("/proc/self/statm", encoding="ascii") as file:
            return 4096.0 * int(file.read().split()[1])
    except OSError:
        return np.nan


def measure(contestants: Sequence[Contestant], queries: int, rounds: int) -> list[Row]:
    """Measure all that can be made; the first one is meshwalk."""
    made: list[tuple[str, float, float, Ask, NDArray[Any]]] = []
    for name, make in contestants:
        before, begin = _resident(), time.perf_counter()
        try:
            ask = make()
        except ImportError:
            continue
        seconds, answer = time.perf_counter() - begin, ask()
        made.append((name, seconds, _resident() - before, ask, answer))
    best = dict.fromkeys((name for name, *_ in made), np.inf)
    for k in range(rounds):
        for name, _, _, ask, _ in made[k % len(made) :] + made[: k % len(made)]:
            begin = time.perf_counter()
            ask()
            best[name] = min(best[name], time.perf_counter() - begin)
    truth = made[0][-1]
    return [
        Row(name, seconds, best[name] / queries, memory, _same(truth, answer))
        for name, seconds, memory, _, answer in made
    ]


def _same(truth: NDArray[Any], answer: NDArray[Any]) -> float:
    return float(np.mean(truth == answer)) if truth.shape == answer.shape else 0.0


# --- rays -----------------------------------------------------------------------------------------


def _counts(intersector: Any, rays: tuple[Any, Any]) -> Ask:
    """How many hits each ray has."""

    def ask() -> NDArray[Any]:
        ray = intersector.intersects_location(*rays)[1]
        return np.bincount(ray, minlength=len(rays[0]))

    return ask


def rays(vertices: int, queries: int, seed: int) -> dict[str, list[Contestant]]:
    """Rays through a bumpy sphere, and points in its box: trimesh, with and without embreex."""
    import trimesh

    random = np.random.default_rng(seed)
    level = max(0, round(np.log2(max(vertices, 12) / 10) / 2))
    ball = trimesh.creation.icosphere(subdivisions=level)
    ball.vertices *= 1 + 0.2 * np.sin(7 * ball.vertices[:, [1]])
    origins = random.normal(size=(queries, 3))
    origins *= 3 / np.linalg.norm(origins, axis=1, keepdims=True)
    thrown = origins, random.normal(size=(queries, 3)) / 2 - origins
    points = random.uniform(-1.2, 1.2, (queries, 3))

    def ours() -> Any:
        from meshwalk.trimesh import RayIntersector

        return RayIntersector(ball)

    def embree() -> Any:
        from trimesh.ray import ray_pyembree

        return ray_pyembree.RayMeshIntersector(ball)

    def slow() -> Any:
        from trimesh.ray import ray_triangle

        return ray_triangle.RayMeshIntersector(ball)

    def ask_all(make: Callable[[], Any]) -> Callable[[], Ask]:
        def begin() -> Ask:
            intersector = make()
            intersector.intersects_any(*(part[:1] for part in thrown))  # trees are made now
            return _counts(intersector, thrown)

        return begin

    def ask_first(make: Callable[[], Any]) -> Callable[[], Ask]:
        def begin() -> Ask:
            intersector = make()
            intersector.intersects_any(*(part[:1] for part in thrown))
            return lambda: np.asarray(intersector.intersects_first(*thrown))

        return begin

    def ask_inside(make: Callable[[], Any]) -> Callable[[], Ask]:
        def begin() -> Ask:
            intersector = make()
            intersector.contains_points(points[:1])
            return lambda: np.asarray(intersector.contains_points(points))

        return begin

    makers = [("meshwalk", ours), ("trimesh, embreex", embree)]
    if queries <= MOST_SLOW_RAYS:
        makers.append(("trimesh", slow))
    tasks = (("all hits", ask_all), ("first hits", ask_first), ("insides", ask_inside))
    return {
        f"{what}, {len(ball.faces)} triangles": [Contestant(n, way(make)) for n, make in makers]
        for what, way in tasks
    }


# --- joins ----------------------------------------------------------------------------------------


def joins(vertices: int, queries: int, seed: int) -> dict[str, list[Contestant]]:
    """Points joined with the triangles of a mesh: GeoPandas, and shapely's tree below it."""
    import geopandas
    import shapely

    random = np.random.default_rng(seed)
    mesh = meshwalk.delaunay(random.uniform(size=(vertices, 2)))
    areas = shapely.polygons(mesh.points[mesh.triangles])
    points = shapely.points(random.uniform(size=(queries, 2)))
    frame = geopandas.GeoDataFrame({"number": np.arange(queries)}, geometry=points)

    def lowest(point: Any, area: Any) -> NDArray[Any]:
        found = np.full(queries, len(areas))
        np.minimum.at(found, np.asarray(point), np.asarray(area))
        return found

    def tree(make: Callable[[Any], Any]) -> Callable[[], Ask]:
        def begin() -> Ask:
            made = make(areas)
            made.query(points[:1], predicate="intersects")
            return lambda: lowest(*made.query(points, predicate="intersects"))

        return begin

    def ours(given: Any) -> Any:
        from meshwalk.shapely import STRtree

        return STRtree(given)

    def join(sjoin: Callable[[Any, Any], Any], right: Any) -> Ask:
        def ask() -> NDArray[Any]:
            found = sjoin(frame, right)
            return lowest(found["number"], found["index_right"])

        return ask

    def our_join() -> Ask:
        from meshwalk.geopandas import sjoin

        return join(sjoin, geopandas.GeoDataFrame(geometry=areas))

    def mesh_join() -> Ask:
        from meshwalk.geopandas import sjoin

        return join(sjoin, mesh)

    def their_join() -> Ask:
        return join(geopandas.sjoin, geopandas.GeoDataFrame(geometry=areas))

    trees = [Contestant("meshwalk", tree(ours)), Contestant("shapely", tree(shapely.STRtree))]
    frames = [
        Contestant("meshwalk", our_join),
        Contestant("meshwalk, a mesh", mesh_join),
        Contestant("geopandas", their_join),
    ]
    return {
        f"STRtree.query, {len(areas)} polygons": trees,
        f"sjoin, {len(areas)} polygons": frames,
    }


# --- cells ----------------------------------------------------------------------------------------


def cells(vertices: int, queries: int, seed: int) -> dict[str, list[Contestant]]:
    """Cells that contain points, or are closest to them: pyvista."""
    from meshwalk.pyvista import Finder, polydata

    random = np.random.default_rng(seed)
    dataset = polydata(meshwalk.delaunay(random.uniform(size=(vertices, 2))))
    flat = np.column_stack([random.uniform(size=(queries, 2)), np.zeros(queries)])
    above = flat + np.array([0, 0, 0.01])

    def begin(make: Callable[[], Any], method: str, points: NDArray[Any]) -> Callable[[], Ask]:
        def made() -> Ask:
            finder = make()
            getattr(finder, method)(points[:1])  # locators are made now
            return lambda: np.asarray(getattr(finder, method)(points))

        return made

    makers: tuple[tuple[str, Callable[[], Any]], ...] = (
        ("meshwalk", lambda: Finder(dataset)),
        ("pyvista", dataset.copy),
    )
    return {
        f"{method}, {dataset.n_cells} triangles": [
            Contestant(name, begin(make, method, points)) for name, make in makers
        ]
        for method, points in (("find_containing_cell", flat), ("find_closest_cell", above))
    }


TASKS = {"rays": rays, "joins": joins, "cells": cells}
