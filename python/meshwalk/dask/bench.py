"""``python -m meshwalk.bench --task dask``: points streamed through Dask's workers, and without it.

As many plain processes, of a pool, get the same chunks of random points: both make the points,
locate them in the same prepared file by one thread, and sum up the numbers of the triangles.
"""

from __future__ import annotations

import multiprocessing
import os
import tempfile
import time
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

import meshwalk
from meshwalk.bench import Time, best

if TYPE_CHECKING:
    from numpy.typing import NDArray


class Streams(NamedTuple):
    """What was measured, of plain processes and of Dask's workers."""

    times: list[Time]
    cpu: tuple[float, float]
    """Processor time of all processes that located, in the best round."""
    sums: tuple[int, int]
    bytes: tuple[int, int]
    """The most memory of a process."""


def _points(seed: int, chunk: int, count: int) -> NDArray[np.float64]:
    return np.random.default_rng((seed, chunk)).uniform(size=(count, 2))


def _chunk(block: NDArray[Any], seed: int, count: int) -> NDArray[np.float64]:
    """The points of a chunk of one number, its own."""
    return _points(seed, int(block[0, 0]), count)


_locators: dict[str, meshwalk.Locator] = {}


def _sum(given: tuple[str, int, int, int]) -> tuple[int, float]:
    """What a plain process does with a chunk, and the processor time that it takes.

    It maps the file when it gets its first.
    """
    path, seed, chunk, count = given
    begin = time.process_time()
    if path not in _locators:
        _locators[path] = meshwalk.map(path)
    triangles = _locators[path].locate(_points(seed, chunk, count), threads=1).triangle
    return int(triangles.sum(dtype=np.int64)), time.process_time() - begin


def _most_memory(_: int = 0) -> int:
    """The most memory that this process had at a time, in bytes; what it shares counts, too."""
    with open("/proc/self/status", encoding="ascii") as status:
        return next(int(line.split()[1]) << 10 for line in status if line.startswith("VmHWM"))


def measure_streams(
    vertices: int, queries: int, rounds: int, workers: int, chunk: int, seed: int = 1
) -> Streams:
    """Measure random points that stream through workers of Dask, and through plain processes.

    Parameters
    ----------
    vertices, queries, rounds : int
        How many; queries are rounded up to whole chunks.
    workers : int
        How many processes, of one thread each.
    chunk : int
        Points of a chunk.
    seed : int, optional
        Of the random points.

    Returns
    -------
    Streams
    """
    import dask.array as da
    from distributed import Client, LocalCluster

    import meshwalk.dask

    chunks = -(-queries // chunk)
    random = np.random.default_rng(seed)
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "mesh.mwm")
        meshwalk.Locator(meshwalk.delaunay(random.uniform(size=(vertices, 2)))).prepare(path)
        numbers = da.arange(chunks, chunks=1)[:, None]
        points = numbers.map_blocks(
            *(_chunk, seed, chunk), chunks=((chunk,) * chunks, (2,)), dtype=np.float64
        )
        total = meshwalk.dask.locate(path, points).triangle.sum(dtype=np.int64)
        work = [(path, seed, number, chunk) for number in range(chunks)]
        spawn = multiprocessing.get_context("spawn")
        with (
            spawn.Pool(workers) as pool,
            LocalCluster(workers, threads_per_worker=1, dashboard_address=None) as cluster,
            Client(cluster) as client,
        ):
            pool.map(_sum, work[:workers], 1)
            client.run(_sum, work[0])
            sums, cpu = [0, 0], [np.inf, np.inf]

            def plain() -> None:
                answers = list(pool.imap_unordered(_sum, work))
                sums[0] = sum(answer[0] for answer in answers)
                cpu[0] = min(cpu[0], sum(answer[1] for answer in answers))

            def by_dask() -> None:
                before = sum(client.run(time.process_time).values())
                sums[1] = int(total.compute())
                cpu[1] = min(cpu[1], sum(client.run(time.process_time).values()) - before)

            seconds = best([plain, by_dask], rounds)
            most = max(pool.map(_most_memory, range(workers), 1))
            most_of_dask = max(client.run(_most_memory).values())
    times = [Time("plain processes", seconds[0]), Time("Dask", seconds[1])]
    return Streams(times, (cpu[0], cpu[1]), (sums[0], sums[1]), (most, most_of_dask))
