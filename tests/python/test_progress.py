"""Long calls: they report, and end by Ctrl-C or by an exception of who watches."""

from __future__ import annotations

import contextlib
import subprocess
import sys
import tempfile
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import meshwalk

POINTS = np.random.default_rng(5).uniform(size=(60_000, 2))
MESH = meshwalk.delaunay(POINTS)
TRIANGLES = MESH.triangles
LOCATOR = meshwalk.Locator(MESH)
SURFACE = meshwalk.Surface(np.column_stack([POINTS, POINTS[:, 0]]), TRIANGLES)
PROBER = meshwalk.Prober(SURFACE, boxes=True)
SPACE = SURFACE.points[:2000] + np.array([0, 0, 0.1])
FOLDER = Path(tempfile.mkdtemp())
MESH.write(FOLDER / "mesh.off")
np.savetxt(FOLDER / "points.csv", POINTS, delimiter=",")
(FOLDER / "lines.poly").write_text(
    f"{len(POINTS)} 2 0 0\n"
    + "".join(f"{i} {x} {y}\n" for i, (x, y) in enumerate(POINTS))
    + "1 0\n0 0 1\n0\n"
)


def _sphere() -> meshwalk.Surface:
    """A globe of triangles between circles of latitude."""
    n, m = 60, 30
    lon, lat = np.meshgrid(np.arange(n) * 360 / n, np.linspace(-90, 90, m)[1:-1])
    corners = np.vstack([np.column_stack([lon.ravel(), lat.ravel()]), [[0, -90], [0, 90]]])
    cells = np.arange(n * (m - 3)).reshape(m - 3, n)
    right, up = np.roll(cells, -1, 1), cells + n
    body = np.stack([cells, right, np.roll(up, -1, 1), cells, np.roll(up, -1, 1), up], -1)
    first = np.arange(n)
    south = np.column_stack([np.full(n, n * (m - 2)), np.roll(first, -1), first])
    top = first + n * (m - 3)
    north = np.column_stack([np.full(n, n * (m - 2) + 1), top, np.roll(top, -1)])
    return meshwalk.Surface.from_lonlat(corners, np.vstack([body.reshape(-1, 3), south, north]))


GLOBE = _sphere()
STAR = meshwalk.Star(GLOBE)


def _edit(watch: Any) -> meshwalk.Mesh:
    """All calls of an editor that may be long."""
    editor = meshwalk.Editor(MESH, undo=1)
    before = editor.describe()
    try:
        editor.insert_points(POINTS[:3000] + 1e-4, progress=watch)
        editor.undo(progress=watch)
        editor.locate(POINTS, progress=watch)
        editor.compact(progress=watch)
    except BaseException:
        now = editor.describe()
        assert (now.vertices, now.triangles) in {
            (before.vertices, before.triangles),
            (before.vertices + 3000, before.triangles + 6000),
        }
        raise
    return editor.mesh()


CALLS: dict[str, Callable[[Any], Any]] = {
    "delaunay": lambda watch: meshwalk.delaunay(POINTS, progress=watch),
    "greedy": lambda watch: meshwalk.triangulate(POINTS[:5000], "greedy", progress=watch),
    "constrained": lambda watch: meshwalk.constrained_delaunay(POINTS, [[0, 1]], progress=watch),
    "mesh": lambda watch: meshwalk.Mesh(POINTS, TRIANGLES, progress=watch),
    "locator": lambda watch: meshwalk.Locator(MESH, progress=watch),
    "locate": lambda watch: LOCATOR.locate(POINTS, progress=watch),
    "interpolate": lambda watch: LOCATOR.locate(POINTS).interpolate(POINTS, progress=watch),
    "editor": lambda watch: meshwalk.Editor(MESH, progress=watch),
    "mesh of an editor": lambda watch: meshwalk.Editor(MESH).mesh(progress=watch),
    "surface": lambda watch: meshwalk.Surface(SURFACE.points, TRIANGLES, progress=watch),
    "prober": lambda watch: meshwalk.Prober(SURFACE, boxes=True, progress=watch),
    "probe": lambda watch: PROBER.probe(SPACE, [0, 0, -1], certain=True, progress=watch),
    "nearest": lambda watch: PROBER.nearest(SPACE, progress=watch),
    "star": lambda watch: meshwalk.Star(GLOBE, progress=watch),
    "star locate": lambda watch: STAR.locate(POINTS, lonlat=True, progress=watch),
    "read": lambda watch: meshwalk.read(FOLDER / "mesh.off", progress=watch),
    "write": lambda watch: meshwalk.write(FOLDER / "copy.ply", MESH, progress=watch),
    "points": lambda watch: meshwalk.read_points(FOLDER / "points.csv", progress=watch),
    "lines": lambda watch: meshwalk.read_constraints(FOLDER / "lines.poly", progress=watch),
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


@pytest.mark.parametrize("stop", range(6))
def test_calls_of_an_editor_end(stop: int) -> None:
    """After a call that was ended the editor is as before, and goes on."""
    seen = 0

    def watch(stage: str, fraction: float) -> None:
        nonlocal seen
        seen += fraction < 1
        if seen > stop and fraction < 1:
            raise RuntimeError("enough")

    with contextlib.suppress(RuntimeError):
        _edit(watch)


def test_what_watches_an_editor_keeps_off() -> None:
    editor = meshwalk.Editor(MESH)
    with pytest.raises(RuntimeError, match="at work: what watches it may not use it"):
        editor.compact(progress=lambda stage, done: editor.insert(0.1, 0.1))
    assert editor.locate_one(0.5, 0.5).inside


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
    with pytest.raises(TypeError, match="progress must be a function of a text"):
        meshwalk.delaunay(POINTS, progress=3)  # type: ignore[arg-type]
