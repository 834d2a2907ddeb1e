"""Threads: the interpreter lock is released, and forks and ends of the program are safe."""

from __future__ import annotations

import multiprocessing
import subprocess
import sys
import threading
import time
from concurrent.futures import ThreadPoolExecutor

import numpy as np
from numpy.typing import NDArray

import meshwalk


def test_one_locator_for_many_threads(
    scattered: meshwalk.Mesh, random: np.random.Generator
) -> None:
    locator = meshwalk.Locator(scattered)
    xy = random.uniform(-1, 13, (2000, 2))
    expected = locator.locate(xy, threads=1).records

    def ask(number: int) -> bool:
        one = locator.locate_one(*xy[number])
        same = one.triangle == expected["triangle"][number]
        return same and locator.locate(xy, threads=1 + number % 2).records.tobytes() == whole

    whole = expected.tobytes()
    with ThreadPoolExecutor(8) as pool:
        assert all(pool.map(ask, range(64)))


def test_the_lock_is_released(random: np.random.Generator) -> None:
    """Another thread counts while a batch is answered."""
    locator = meshwalk.Locator(meshwalk.delaunay(random.uniform(size=(1000, 2))))
    xy = random.uniform(size=(1_000_000, 2))
    counts, done = [0], threading.Event()

    def count() -> None:
        while not done.is_set():
            counts[0] += 1
            time.sleep(0)

    counter = threading.Thread(target=count)
    interval = sys.getswitchinterval()
    sys.setswitchinterval(100)  # only a released lock lets the other thread run
    counter.start()
    try:
        before = counts[0]
        locator.locate(xy, threads=1)
        after = counts[0]
    finally:
        done.set()
        sys.setswitchinterval(interval)
        counter.join()
    assert after > before


def _ask(xy: NDArray[np.float64]) -> int:
    locator = meshwalk.Locator(meshwalk.delaunay([[0, 0], [4, 0], [4, 4], [0, 4]]))
    return int(locator.locate(xy, threads=2).inside.sum())


def test_fork_after_threads(square: meshwalk.Mesh, random: np.random.Generator) -> None:
    xy = random.uniform(0, 5, (100_000, 2))
    expected = int(meshwalk.Locator(square).locate(xy, threads=2).inside.sum())
    with multiprocessing.get_context("fork").Pool(2) as pool:
        assert pool.map(_ask, [xy, xy]) == [expected, expected]


def test_exit_while_threads_work() -> None:
    """A daemon thread that is within the library when the interpreter ends does no harm."""
    program = """
import threading, time
import numpy as np, meshwalk
xy = np.random.default_rng(1).uniform(size=(300_000, 2))
locator = meshwalk.Locator(meshwalk.delaunay(xy[:10_000]))
def work():
    while True:
        locator.locate(xy)
for _ in range(3):
    threading.Thread(target=work, daemon=True).start()
time.sleep(0.05)
print("end")
"""
    ended = subprocess.run(
        [sys.executable, "-c", program], capture_output=True, text=True, timeout=60
    )
    assert (ended.returncode, ended.stdout, ended.stderr) == (0, "end\n", "")
