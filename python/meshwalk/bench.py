"""``python -m meshwalk.bench``: the module beside its peers, in one run.

Points and queries are random in the unit square. The task ``locate`` finds the triangles of
queries: all peers search the same triangles. ``interpolate`` takes values of many fields to the
queries, beside ``scipy.sparse``. ``particles`` carries them round the middle of the square by steps
of second order, which locate each of them twice, with a `Cursor` and without. ``dask`` streams
queries through Dask's workers, and through as many plain processes. ``drop-ins`` asks drop-ins and
their originals (``--peers xugrid,uxarray`` chooses), and tells the memory that they keep. ``rays``,
``joins`` and ``cells`` do that for trimesh, for GeoPandas and shapely, and for pyvista. Rounds are
interleaved, so a machine that is busy for a while slows all; the best round counts. A peer that is
not installed is left out.
"""

from __future__ import annotations

import argparse
import sys
import time
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

import meshwalk
from meshwalk._drop_ins import tasks as own_tasks

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from numpy.typing import NDArray

    Points = NDArray[np.float64]
    Triangles = NDArray[Any]
    Ask = Callable[[Points], NDArray[Any]]


class Peer(NamedTuple):
    """One way to find triangles: made of a mesh, then asked."""

    name: str
    make: Callable[[Points, Triangles], Ask]


def _batch(threads: int) -> Callable[[Points, Triangles], Ask]:
    def make(points: Points, triangles: Triangles) -> Ask:
        mesh = meshwalk.Mesh(points, triangles, threads=threads)
        locator = meshwalk.Locator(mesh, threads=threads)
        return lambda xy: locator.locate(xy, threads=threads).triangle

    return make


def _one_by_one(points: Points, triangles: Triangles) -> Ask:
    locate_one = meshwalk.Locator(meshwalk.Mesh(points, triangles)).locate_one
    return lambda xy: np.array([locate_one(x, y).triangle for x, y in xy.tolist()])


def _scipy(points: Points, triangles: Triangles) -> Ask:
    """Its own triangulation: the only one it searches."""
    from scipy.spatial import Delaunay

    ask: Ask = Delaunay(points).find_simplex
    return ask


def _matplotlib(points: Points, triangles: Triangles) -> Ask:
    from matplotlib.tri import Triangulation

    finder = Triangulation(*points.T, triangles).get_trifinder()
    return lambda xy: np.asarray(finder(*xy.T))


def _shapely(points: Points, triangles: Triangles) -> Ask:
    import shapely

    tree = shapely.STRtree(shapely.polygons(points[triangles]))

    def ask(xy: Points) -> NDArray[Any]:
        which, found = tree.query(shapely.points(xy), predicate="intersects")
        answer = np.full(len(xy), len(triangles))
        np.minimum.at(answer, which, found)
        return np.where(answer == len(triangles), -1, answer)

    return ask


def _celltree(points: Points, triangles: Triangles) -> Ask:
    from numba_celltree import CellTree2d

    ask: Ask = CellTree2d(points, np.asarray(triangles, np.intp), -1).locate_points
    return ask


PEERS = (
    Peer("meshwalk", _batch(0)),
    Peer("meshwalk 1 thread", _batch(1)),
    Peer("meshwalk one by one", _one_by_one),
    Peer("scipy", _scipy),
    Peer("matplotlib", _matplotlib),
    Peer("shapely", _shapely),
    Peer("numba_celltree", _celltree),
)


class Figure(NamedTuple):
    """What was measured of one peer."""

    name: str
    build: float
    """Seconds from arrays to the first question."""
    query: float
    """Seconds for each query, in the best round."""
    same: float
    """Part of the answers that are those of meshwalk; ties apart others may differ."""


def _seconds(work: Callable[[], Any]) -> tuple[float, Any]:
    begin = time.perf_counter()
    result = work()
    return time.perf_counter() - begin, result


def best(works: Sequence[Callable[[], Any]], rounds: int) -> list[float]:
    """Seconds of each in its best round."""
    least = [np.inf] * len(works)
    for k in range(rounds * len(works)):
        turn = (k + k // len(works)) % len(works)  # each round begins with another one
        least[turn] = min(least[turn], _seconds(works[turn])[0])
    return least


def measure(
    vertices: int, queries: int, rounds: int, names: Sequence[str] = (), seed: int = 1
) -> list[Figure]:
    """Measure all peers that are installed, or those named.

    Parameters
    ----------
    vertices, queries, rounds : int
        How many.
    names : sequence of str, optional
        Which peers; meshwalk itself is always among them.
    seed : int, optional
        Of the random points.

    Returns
    -------
    list of Figure
    """
    random = np.random.default_rng(seed)
    points, xy = random.uniform(size=(vertices, 2)), random.uniform(size=(queries, 2))
    triangles = meshwalk.delaunay(points).triangles
    made = []
    for peer in PEERS:
        if names and peer.name not in names and peer is not PEERS[0]:
            continue
        try:
            seconds, ask = _seconds(lambda peer=peer: peer.make(points, triangles))  # type: ignore[misc]
        except ImportError:
            continue
        made.append((peer, seconds, ask, ask(xy)))  # the first answers warm up
    least = best([lambda ask=ask: ask(xy) for _, _, ask, _ in made], rounds)  # type: ignore[misc]
    return [
        Figure(peer.name, seconds, quickest / queries, float(np.mean(answers == made[0][3])))
        for (peer, seconds, _, answers), quickest in zip(made, least, strict=True)
    ]


class Time(NamedTuple):
    """What one way of doing a task took."""

    name: str
    seconds: float
    """In the best round."""


def measure_interpolation(
    vertices: int, queries: int, rounds: int, columns: int = 24, seed: int = 1
) -> list[Time]:
    """Measure the interpolation of many fields, side by side and one after the other in time.

    Parameters
    ----------
    vertices, queries, rounds, columns : int
        How many; `columns` of fields.
    seed : int, optional
        Of the random points.

    Returns
    -------
    list of Time
    """
    random = np.random.default_rng(seed)
    mesh = meshwalk.delaunay(random.uniform(size=(vertices, 2)))
    hit = meshwalk.Locator(mesh).locate(random.uniform(size=(queries, 2)))
    rows = random.uniform(size=(vertices, columns))
    fields = np.ascontiguousarray(rows.T)
    ways: dict[str, Callable[[], Any]] = {
        "meshwalk": lambda: hit.interpolate(rows),
        "meshwalk 1 thread": lambda: hit.interpolate(rows, threads=1),
        "meshwalk, in time": lambda: hit.interpolate(fields.T),
    }
    weights = meshwalk.Operator(hit)
    ways["Operator"] = lambda: weights @ rows
    ways["Operator 1 thread"] = lambda: weights.apply(rows, 1)
    ways["Operator, in time"] = lambda: weights @ fields.T
    ways["copying"] = lambda: rows.copy()
    try:
        operator = hit.operator()
    except ImportError:
        pass
    else:
        ways["scipy.sparse"] = lambda: operator @ rows
        ways["scipy.sparse, in time"] = lambda: operator @ fields.T
    return [Time(*pair) for pair in zip(ways, best(list(ways.values()), rounds), strict=True)]


def _drift(ask: Callable[[Points], meshwalk.Locations], place: Points, steps: int) -> Points:
    """Carry particles round the middle of the square by a tenth of an edge or so a step."""
    points = ask(place).mesh.points
    current = np.column_stack([0.5 - points[:, 1], points[:, 0] - 0.5])
    step = 0.3 / np.sqrt(len(points))
    place = place.copy()
    for _ in range(steps):
        middle = place + step / 2 * ask(place).interpolate(current)
        place += step * ask(middle).interpolate(current)
    return place


def measure_particles(
    vertices: int, particles: int, rounds: int, steps: int = 288, seed: int = 1
) -> list[Time]:
    """Measure particles that drift, each search from the particle's last triangle or anew.

    Parameters
    ----------
    vertices, particles, rounds, steps : int
        How many; two searches and two interpolations a step.
    seed : int, optional
        Of the random points.

    Returns
    -------
    list of Time
    """
    random = np.random.default_rng(seed)
    locator = meshwalk.Locator(meshwalk.delaunay(random.uniform(size=(vertices, 2))))
    place = random.uniform(0.2, 0.8, (particles, 2))
    ways: dict[str, Callable[[], Any]] = {
        "meshwalk, Cursor": lambda: _drift(meshwalk.Cursor(locator).locate, place, steps),
        "meshwalk, Locator": lambda: _drift(locator.locate, place, steps),
    }
    return [Time(*pair) for pair in zip(ways, best(list(ways.values()), rounds), strict=True)]


def _print_times(times: Sequence[Time], values: int, what: str) -> None:
    print(f"{'':22}{'s':>10}{what:>14}{'ratio':>8}")
    for time_ in times:
        each = 1e9 * time_.seconds / values
        ratio = time_.seconds / times[0].seconds
        print(f"{time_.name:22}{time_.seconds:10.3f}{each:14.1f}{ratio:8.2f}")


def _measure_dropin(task: str, vertices: int, queries: int, rounds: int, seed: int) -> None:
    for title, contestants in own_tasks.TASKS[task](vertices, queries, seed).items():
        rows = own_tasks.measure(contestants, queries, rounds)
        print(f"{title}, {queries} queries")
        print(f"{'':22}{'build, s':>10}{'ns a query':>12}{'ratio':>8}{'MB':>8}{'same answers':>14}")
        for row in rows:
            ratio = row.query / rows[0].query
            columns = f"{row.build:10.3f}{1e9 * row.query:12.1f}{ratio:8.1f}"
            print(f"{row.name:22}{columns}{row.memory / 1e6:8.0f}{row.same:14.6f}")


def main(arguments: Sequence[str] | None = None) -> int:
    """Print a table; `arguments` are those of the command line."""
    from meshwalk._drop_ins.bench import PAIRS, report
    from meshwalk._drop_ins.bench import measure as measure_drop_ins

    parser = argparse.ArgumentParser("python -m meshwalk.bench", description=__doc__)
    tasks = ("locate", "interpolate", "particles", "dask", "drop-ins", *own_tasks.TASKS)
    parser.add_argument("--task", choices=tasks, default="locate")
    parser.add_argument("--vertices", type=float, default=1e5)
    parser.add_argument("--queries", type=float, default=1e5)
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--columns", type=int, default=24, help="fields to interpolate")
    parser.add_argument("--steps", type=int, default=288, help="of particles")
    parser.add_argument("--workers", type=int, default=2, help="processes of the task dask")
    parser.add_argument("--chunk", type=float, default=1e6, help="points of a chunk of it")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--peers", default="", help="names, separated by commas")
    given = parser.parse_args(arguments)
    names = [name.strip() for name in given.peers.split(",") if name.strip()]
    unknown = set(names) - (set(PAIRS) if given.task == "drop-ins" else {p.name for p in PEERS})
    if unknown:
        parser.error(f"no such peer: {', '.join(sorted(unknown))}")
    counts = (given.queries, given.rounds, given.columns, given.steps, given.workers, given.chunk)
    if min(counts) < 1 or given.vertices < 3:
        parser.error("three vertices, and one of everything else, are the least")
    sizes = int(given.vertices), int(given.queries), given.rounds
    if given.task == "interpolate":
        print(f"{given.columns} fields of {sizes[0]} vertices at {sizes[1]} random queries")
        times = measure_interpolation(*sizes, given.columns, given.seed)
        _print_times(times, sizes[1] * given.columns, "ns a value")
        return 0
    if given.task == "drop-ins":
        print(f"{sizes[1]} random queries in {sizes[0]} random vertices")
        report(measure_drop_ins(names or tuple(PAIRS), *sizes, given.seed))
        return 0
    if given.task == "dask":
        from meshwalk.dask.bench import measure_streams

        streams = measure_streams(*sizes, given.workers, int(given.chunk), given.seed)
        print(f"{sizes[1]} random queries in {sizes[0]} random vertices, {given.workers} processes")
        _print_times(streams.times, sizes[1], "ns a query")
        print("the same sums" if len(set(streams.sums)) == 1 else f"other sums: {streams.sums}")
        each = [f"{1e9 * cpu / sizes[1]:.1f}" for cpu in streams.cpu]
        print("processor time, ns a query:", *each)
        print("memory of a process at most, MB:", *(size >> 20 for size in streams.bytes))
        return 0
    if given.task == "particles":
        print(f"{sizes[1]} particles among {sizes[0]} random vertices, {given.steps} steps")
        times = measure_particles(*sizes, given.steps, given.seed)
        _print_times(times, sizes[1] * given.steps * 2, "ns a location")
        return 0
    if given.task in own_tasks.TASKS:
        try:
            _measure_dropin(given.task, *sizes, given.seed)
        except ImportError as missing:
            parser.error(f"the task {given.task} needs a package: {missing}")
        return 0
    figures = measure(*sizes, names, given.seed)
    print(f"{sizes[1]} random queries in {sizes[0]} random vertices")
    print(f"{'':22}{'build, s':>10}{'ns a query':>12}{'ratio':>8}{'same answers':>14}")
    for figure in figures:
        ratio = figure.query / figures[0].query
        columns = f"{figure.build:10.3f}{1e9 * figure.query:12.1f}{ratio:8.1f}{figure.same:14.6f}"
        print(f"{figure.name:22}{columns}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
