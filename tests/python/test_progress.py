"""Long calls: they report, and end by Ctrl-C or by an exception of who watches."""

from __future__ import annotations

import contextlib
import subprocess
import sys
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

import meshwalk

POINTS = np.random.default_rng(5).uniform(size=(60_000, 2))
MESH = meshwalk.delaunay(POINTS)
TRIANGLES = MESH.triangles
LOCATOR = meshwalk.Locator(MESH)
CALLS: dict[str, Callable[[Any], Any]] = {
    "delaunay": lambda watch: meshwalk.delaunay(POINTS, progress=watch),
    "greedy": lambda watch: meshwalk.triangulate(POINTS[:5000], "greedy", progress=watch),
    "constrained": lambda watch: meshwalk.constrained_delaunay(POINTS, [[0, 1]], progress=watch),
    "mesh": lambda watch: meshwalk.Mesh(POINTS, TRIANGLES, progress=watch),
    "locator": lambda watch: meshwalk.Locator(MESH, progress=watch),
    "locate": lambda watch: LOCATOR.locate(POINTS, progress=watch),
}


@pytest.mark.parametrize("call", CALLS.values(), ids=CALLS)
def test_reports(call: Callable[[Any], Any]) -> None:
    reports: list[tuple[str, float]] = []
    call(lambda *report: reports.append(report))
    assert 1 <= len(reports) <= 300
    fractions = [fraction for _, fraction in reports]
    assert fractions == sorted(fractions)
    assert fractions[-1] == 1
    assert all(stage for stage, _ in reports)


@pytest.mark.parametrize("call", CALLS.values(), ids=CALLS)
def test_an_exception_ends_the_call(call: Callable[[Any], Any]) -> None:
    class EnoughError(Exception):
        pass

    def watch(stage: str, fraction: float) -> None:
        if fraction < 1:
            raise EnoughError(stage)

    # A call that is done in one piece is not ended.
    with contextlib.suppress(EnoughError):
        call(watch)
    call(None)


def test_an_exception_ends_long_calls() -> None:
    def watch(stage: str, fraction: float) -> None:
        raise RuntimeError(f"enough of {stage}")

    with pytest.raises(RuntimeError, match="enough of "):
        meshwalk.delaunay(POINTS, progress=watch)


def test_control_c_ends_the_call() -> None:
    program = """
import os, signal, threading, time
import numpy as np, meshwalk
points = np.random.default_rng(1).uniform(size=(3_000_000, 2))
threading.Timer(0.3, os.kill, (os.getpid(), signal.SIGINT)).start()
begin = time.monotonic()
try:
    meshwalk.delaunay(points)
    print("not interrupted")
except KeyboardInterrupt:
    print("interrupted")
"""
    ended = subprocess.run(
        [sys.executable, "-c", program], capture_output=True, text=True, timeout=100
    )
    assert (ended.returncode, ended.stdout, ended.stderr) == (0, "interrupted\n", "")


def test_what_is_no_function() -> None:
    with pytest.raises(TypeError, match="callable"):
        meshwalk.delaunay(POINTS, progress=3)  # type: ignore[arg-type]
