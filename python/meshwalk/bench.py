"""``python -m meshwalk.bench``: the module beside its peers, in one run.

Points and queries are random in the unit square; all peers search the same triangles. Rounds are
interleaved, so a machine that is busy for a while slows all of them; the best round counts. A peer
that is not installed is left out.
"""

from __future__ import annotations

import argparse
import sys
import time
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

import meshwalk

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
    best = [np.inf] * len(made)
    for k in range(rounds * len(made)):
        turn = (k + k // len(made)) % len(made)  # each round begins with another one
        best[turn] = min(best[turn], _seconds(lambda turn=turn: made[turn][2](xy))[0])  # type: ignore[misc]
    return [
        Figure(peer.name, seconds, quickest / queries, float(np.mean(answers == made[0][3])))
        for (peer, seconds, _, answers), quickest in zip(made, best, strict=True)
    ]


def main(arguments: Sequence[str] | None = None) -> int:
    """Print a table; `arguments` are those of the command line."""
    parser = argparse.ArgumentParser("python -m meshwalk.bench", description=__doc__)
    parser.add_argument("--vertices", type=float, default=1e5)
    parser.add_argument("--queries", type=float, default=1e5)
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--peers", default="", help="names, separated by commas")
    given = parser.parse_args(arguments)
    names = [name.strip() for name in given.peers.split(",") if name.strip()]
    unknown = set(names) - {peer.name for peer in PEERS}
    if unknown:
        parser.error(f"no such peer: {', '.join(sorted(unknown))}")
    if min(given.vertices, given.queries, given.rounds) < 1 or given.vertices < 3:
        parser.error("three vertices, one query and one round are the least")
    figures = measure(int(given.vertices), int(given.queries), given.rounds, names, given.seed)
    print(f"{int(given.queries)} random queries in {int(given.vertices)} random vertices")
    print(f"{'':22}{'build, s':>10}{'ns a query':>12}{'ratio':>8}{'same answers':>14}")
    for figure in figures:
        ratio = figure.query / figures[0].query
        columns = f"{figure.build:10.3f}{1e9 * figure.query:12.1f}{ratio:8.1f}{figure.same:14.6f}"
        print(f"{figure.name:22}{columns}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
