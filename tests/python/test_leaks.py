"""No leaks: the whole interface in a loop, failures too; the heaps of C and Python do not grow."""

from __future__ import annotations

import contextlib
import ctypes
import gc
import pickle
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from test_space import FACETS, OCTAHEDRON

import meshwalk
from meshwalk import _core

POINTS = np.random.default_rng(7).uniform(size=(400, 2))
TRIANGLES = meshwalk.delaunay(POINTS).triangles
SQUARE = [[0, 0], [6, 0], [6, 6], [0, 6], [1, 1]]
RING = [[0, 1], [1, 2], [2, 3], [3, 0]]
HINT = np.zeros(1, np.uint32)


def _use_meshes(folder: Path) -> None:
    mesh = meshwalk.Mesh(POINTS, TRIANGLES, {"z": POINTS[:, 0]})
    _ = mesh.points, mesh.triangles, mesh.neighbours, mesh.nbytes, mesh.describe(), mesh.check()
    mesh.write(folder / "mesh.ply")
    meshwalk.read(folder / "mesh.ply")
    (folder / "line.poly").write_text("2 2 1 0\n1 0 0 3\n2 1 0 4\n1 0\n1 1 2\n1\n1 3 3\n")
    meshwalk.read_constraints(folder / "line.poly")
    meshwalk.constrained_delaunay(SQUARE, RING, holes=[[9, 9]], polygons=[0] * 4)
    meshwalk.triangulate(POINTS[:20], "greedy")
    locator = meshwalk.Locator(mesh, border=True)
    hit = locator.locate(POINTS, 0.1)
    one = locator.locate_one(0.5, 0.5)
    _ = one.where, one.weights, one.triangle, one.hole, one.local, one.inside, repr(one)
    _ = repr(hit), hit.inside, hit[3:], locator.describe()
    borrowed = meshwalk.BorrowedMesh(POINTS, TRIANGLES, mesh.neighbours, layout="edge")
    borrowed.locate(POINTS)
    with contextlib.suppress(meshwalk.InputError):
        meshwalk.BorrowedMesh(POINTS, TRIANGLES, mesh.neighbours)
    locator.nearest_border(2, 2)
    hit.interpolate("z")
    hit.interpolate(np.zeros((400, 3), np.float32))
    cursor = meshwalk.Cursor(locator)
    cursor.locate(POINTS)
    cursor.triangle = cursor.triangle[3:]
    locator.locate(POINTS, hints=hit.triangle)
    hit.interpolate(np.zeros((3, 400)).T, progress=lambda stage, done: None)
    pickle.loads(pickle.dumps((mesh, locator, hit, cursor, meshwalk.Operator(hit))))
    parcels = meshwalk.Polygons(SQUARE, RING, [0] * 4)
    _ = (
        parcels.at(POINTS).first,
        parcels.crossing,
        len(parcels),
        pickle.loads(pickle.dumps(parcels)),
    )
    with contextlib.suppress(meshwalk.InputError):
        meshwalk.Polygons(SQUARE, RING[:3], [0] * 3)
    meshwalk.mend([*SQUARE, [6, 0]], [[0, 1, 2], [2, 3, 0], [0, 5, 2], [0, 0, 9]]).mesh()
    with contextlib.suppress(meshwalk.InputError):
        meshwalk.mend(SQUARE, [[0, 1, 9]], "weld")


def _use_overlaps(folder: Path) -> None:
    first = TRIANGLES[:, 0]
    mesh = meshwalk.Mesh(POINTS, TRIANGLES, {"z": POINTS[:, 0]}, triangle_fields={"a": first})
    locator = meshwalk.Locator(mesh, fill="yes")
    meshwalk.volume(locator, 0.5)
    meshwalk.volume(mesh, locator)
    meshwalk.surface_area(locator, locator)
    for target in (locator, meshwalk.Pixels(0, 1, 0.1, 0.1, 10, 10)):
        weights = meshwalk.remap(locator, target, source_cells=np.arange(len(mesh)) // 2)
        _ = pickle.loads(pickle.dumps(weights)), repr(weights), weights.target_fraction
    seen = meshwalk.visible(locator, [0.5, 0.5], POINTS, 1)
    _ = seen.visible, seen.obstacle, repr(seen), pickle.loads(pickle.dumps(seen))
    _ = mesh.reordered()
    locator.prepare(folder / "mesh.mwm")
    mapped = meshwalk.map(folder / "mesh.mwm", trust=True)
    _ = mapped.mesh.fields["z"], pickle.loads(pickle.dumps(mapped)), mapped.locate_one(0.5, 0.5)
    for failure in (
        lambda: meshwalk.volume(locator, np.nan),
        lambda: meshwalk.remap(locator, meshwalk.Pixels(0, 1, 0, 0, 2, 2)),
        lambda: meshwalk.remap(locator, locator, target_cells=[0]),
        lambda: meshwalk.visible(locator, [9, 9], POINTS),
        lambda: meshwalk.map(folder / "none.mwm"),
        lambda: meshwalk.map(folder / "mesh.ply"),
        lambda: locator.prepare(folder / "none" / "mesh.mwm"),
        lambda: _core.sights(locator, POINTS, (0, 0, 0, True), POINTS, True, HINT, None),
        lambda: _core.remap_to_mesh(
            *(locator, HINT, 1, locator, None, 0, False, False, False, 0, None)
        ),
        lambda: mesh._hilbert_order(HINT, HINT),
    ):
        with pytest.raises(Exception):  # noqa: B017, PT011
            failure()


def _use_editors() -> None:
    mesh = meshwalk.Mesh(POINTS, TRIANGLES, {"z": POINTS[:, 0]})
    editor = meshwalk.Editor(mesh, undo=-1, log=True)
    change = editor.insert(0.5, 0.5)
    _ = change.made, change.reused, change.freed, change.before
    editor.insert_points(POINTS[:10] + 0.001)
    editor.remove(change.vertex)
    editor.undo()
    editor.locate(POINTS).interpolate("z")
    _ = editor.log(), editor.vertex(1), editor.triangle(1), editor.adjacent(3), editor.describe()
    _ = editor.locate_one(0.1, 0.1), editor.compact(), editor.mesh()


def _use_surfaces() -> None:
    surface = meshwalk.Surface(OCTAHEDRON, FACETS)
    star = meshwalk.Star(surface)
    prober = meshwalk.Prober(surface, boxes=True)
    star.locate([[1, 1, 1]]).interpolate(np.ones(6))
    star.locate([[1, 1]], lonlat=True)
    prober.probe([[0, 0, 5]], [0, 0, -1], certain=True)
    prober.nearest([[1, 2, 3]])
    surface.move(2 * surface.points)
    _ = surface.check(), surface.describe(), star.describe()
    pickle.loads(pickle.dumps((star, prober)))
    meshwalk.Surface(OCTAHEDRON, FACETS).flip(0, 0)
    edited = meshwalk.Surface(OCTAHEDRON, FACETS)
    followers = meshwalk.Star(edited), meshwalk.Prober(edited, boxes=True)
    editor = meshwalk.SurfaceEditor(edited, undo=9)
    change = editor.split_triangle(0)
    _ = repr(change), change.copied, change.heirs, change.before, editor.describe(), editor.copy()
    editor.cut([0, 2, 1])
    editor.undo()
    editor.detach(followers[1])
    editor.attach(followers[1])
    editor.remove_triangle(1)
    _ = editor.triangle(1), editor.triangles_of(0), editor.edge(0, 2), followers[0].ready
    with contextlib.suppress(meshwalk.InputError):
        editor.sew([0, 1], [1, 2])
    editor.compact()


def _failures(folder: Path) -> list[Callable[[], Any]]:
    mesh = meshwalk.Mesh(POINTS, TRIANGLES)
    locator = meshwalk.Locator(mesh)
    records = locator.locate(POINTS).records
    editor = meshwalk.Editor(mesh)
    surface = meshwalk.Surface(OCTAHEDRON, FACETS)
    star = meshwalk.Star(surface)
    prober = meshwalk.Prober(surface)
    wrong: Any = "wrong"
    return [
        lambda: meshwalk.Mesh(POINTS, TRIANGLES + 500),
        lambda: meshwalk.Mesh(POINTS, wrong),
        lambda: meshwalk.Mesh(POINTS, TRIANGLES, threads=-1),
        lambda: meshwalk.Locator(meshwalk.Mesh(SQUARE, [[0, 1, 2], [0, 1, 4]])),
        lambda: meshwalk.Editor(mesh, undo=-7),
        lambda: meshwalk.delaunay([[0, 0], [1, 1]]),
        lambda: meshwalk.constrained_delaunay(SQUARE, [[0, 2], [1, 3]]),
        lambda: meshwalk.constrained_delaunay(SQUARE, RING, holes=[[np.nan, 0]]),
        lambda: meshwalk.triangulate(POINTS, wrong),
        lambda: meshwalk.read(folder / "none.off"),
        lambda: meshwalk.read_constraints(folder / "none.poly"),
        lambda: meshwalk.Star(surface, progress=wrong),
        lambda: editor.insert_points(POINTS + 0.01, progress=wrong),
        lambda: prober.probe([[0, 0, 5]], [0, 0, -1], progress=wrong),
        lambda: mesh.write(folder / "mesh.none"),
        lambda: locator.locate(POINTS, walk=wrong),
        lambda: locator.locate(POINTS, -1),
        lambda: locator.locate(POINTS[:, :1]),
        lambda: locator.locate_one(wrong, 1),
        lambda: locator.nearest_border(1, 1),
        lambda: locator._locate(POINTS, np.empty(3), None, "auto", "auto", 0, 0, 0, None),
        lambda: locator._locate(POINTS, records, HINT, "auto", "auto", 0, 0, 0, None),
        lambda: locator.locate(POINTS, hints=[1]),
        lambda: mesh._copy_points(np.empty(3)),
        lambda: mesh._interpolate_table(POINTS, False, records, HINT, 1, None),
        lambda: locator.locate(POINTS).interpolate(POINTS, progress=wrong),
        lambda: editor.remove(10**7),
        lambda: editor.insert(np.nan, 0),
        lambda: editor.undo(),
        lambda: meshwalk.Star(meshwalk.Surface(OCTAHEDRON, FACETS[1:])),
        lambda: star.locate([1, 1, 1], walk=wrong),
        lambda: surface.move([[0, 0, -9]], [4]),
        lambda: prober.probe([[0, 0, 5]], [0, 0, -1], start=wrong),
        lambda: prober.probe([[0, 0, 5]], [0, 0, -1], certain=True),
        lambda: prober.nearest([0, 0, 0]),
    ]


def _fail(folder: Path) -> None:
    for failure in _failures(folder):
        with pytest.raises(Exception):  # noqa: B017, PT011
            failure()


class _Heap(ctypes.Structure):
    """As mallinfo2 of the C library fills it."""

    _fields_ = tuple((f"_{k}", ctypes.c_size_t) for k in range(4)) + (  # noqa: RUF005
        ("mapped", ctypes.c_size_t),
        ("_5", ctypes.c_size_t),
        ("_6", ctypes.c_size_t),
        ("used", ctypes.c_size_t),
        ("_8", ctypes.c_size_t),
        ("_9", ctypes.c_size_t),
    )


def _held() -> tuple[int, int]:
    """Bytes of the C heap, and blocks of Python."""
    gc.collect()
    heap = ctypes.CDLL(None).mallinfo2
    heap.restype = _Heap
    info = heap()
    return info.used + info.mapped, sys.getallocatedblocks()


@pytest.mark.parametrize(
    "use",
    [_use_meshes, _use_overlaps, _use_editors, _use_surfaces, _fail],
    ids=lambda use: use.__name__[1:],
)
def test_nothing_is_left(use: Callable[..., None], tmp_path: Path) -> None:
    if not hasattr(ctypes.CDLL(None), "mallinfo2"):
        pytest.skip("this C library does not tell what its heap holds")
    arguments = [tmp_path] if use in (_use_meshes, _use_overlaps, _fail) else []
    rounds = 20
    grown = []
    for _ in range(12):  # caches fill in the first rounds
        before = _held()
        for _ in range(rounds):
            with contextlib.suppress(Warning):
                use(*arguments)
        after = _held()
        grown.append((after[0] - before[0], after[1] - before[1]))
        if grown[-1][0] < 32 * rounds and grown[-1][1] < rounds:
            return  # less than the smallest leak in each round
    pytest.fail(f"the C heap and the blocks of Python grow, in {rounds} rounds each: {grown}")
