"""Surfaces that are edited between two queries: probers and stars follow."""

from __future__ import annotations

import gc
import pickle
import threading
import weakref

import numpy as np
import pytest

import meshwalk
from meshwalk import InputError, Prober, Star, Surface, SurfaceEditor, Where

CORNERS = [[0, 0, 3], [3, 0, 0], [0, 3, 0], [-3, 0, 0], [0, -3, 0], [0, 0, -3]]
FACETS = [[0, 1, 2], [0, 2, 3], [0, 3, 4], [0, 4, 1], [5, 2, 1], [5, 3, 2], [5, 4, 3], [5, 1, 4]]
SQUARES = [[0, 0, 0], [1, 0, 0], [2, 0, 0], [0, 1, 0], [1, 1, 0], [2, 1, 0]]
HALVES = [[0, 1, 3], [1, 4, 3], [1, 2, 4], [2, 5, 4]]


def octahedron(level: int = 0) -> Surface:
    surface = Surface(CORNERS, FACETS)
    if level == 0:
        return surface
    sphere = Star(surface).remesh(level).surface
    return Surface(sphere.points, sphere.triangles)


def touched(prober: Prober, point: list[float]) -> int:
    return int(prober.probe([point], [[0, 0, -1]], certain=True).triangle[0])


def same_answers(
    editor: SurfaceEditor, star: Star, prober: Prober, rng: np.random.Generator
) -> None:
    """The answers of a copy without gaps, whose triangles are in the same order."""
    copy = editor.copy()
    numbers = np.flatnonzero(
        [editor.triangle(t) is not None for t in range(star.surface.triangle_count)]
    )
    rays = rng.normal(size=(40, 3))
    probes = Prober(copy, boxes=True).probe(4 * rays, -rays, certain=True)
    mine = prober.probe(4 * rays, -rays, certain=True)
    assert np.array_equal(mine.distance, probes.distance, equal_nan=True)
    assert (mine.triangle == np.where(probes.triangle < 0, -1, numbers[probes.triangle])).all()
    try:
        other = Star(copy)
    except InputError:
        assert not star.ready
        assert (star.locate(rays).where == Where.BAD).all()
        return
    assert star.ready
    assert (star.locate(rays).triangle == numbers[other.locate(rays).triangle]).all()


def test_edits_of_each_kind() -> None:
    surface = Surface(SQUARES, HALVES)
    editor = SurfaceEditor(surface, undo=-1)
    change = editor.add_vertex([0.5, 0.5, 1])
    assert change.vertices_made.tolist() == [6]
    assert change.copied.tolist() == [-1]
    assert editor.vertex(6) == (0.5, 0.5, 1)
    assert editor.vertex(7) is None
    assert editor.move_vertex(6, [3, 1, 0]).vertices_moved.tolist() == [6]
    assert editor.add_triangle(5, 2, 6).made.tolist() == [4]
    assert editor.edge(2, 5) == [3, 4]
    assert editor.edge(0, 5) == []
    change = editor.split_edge(1, 3)
    assert change.made.tolist() == [5, 6]
    assert change.reused.tolist() == [0, 1]
    assert change.before.tolist() == [[0, 1, 3], [1, 4, 3]]
    assert editor.split_triangle(2, [1.25, 0.5, 2]).vertices_made.tolist() == [8]
    assert editor.vertex(8) == (1.25, 0.5, 2)
    change = editor.collapse(8, 1)
    assert change.vertices_freed.tolist() == [8]
    assert change.heirs.tolist() == [1]
    assert editor.flip(2, 4).reused.tolist() == [3, 7]
    assert editor.flip(1, 5).reused.tolist() == [3, 7]
    change = editor.cut([1, 4])
    assert change.vertices_made.tolist() == [9, 10]
    assert change.copied.tolist() == [1, 4]
    assert surface.describe().components == 2
    assert editor.sew([1, 4], [9, 10]).vertices_freed.tolist() == [9, 10]
    assert editor.remove_triangle(4).freed.tolist() == [4]
    assert editor.remove_vertex(6).vertices_freed.tolist() == [6]
    assert editor.triangle(4) is None
    assert editor.triangles_of(3) == [5, 6]
    info = editor.describe()
    assert info.undoable == 12
    assert info.vertices == 7
    triangles, vertices = editor.compact()
    assert vertices.tolist() == [0, 1, 2, 3, 4, 5, -1, 6, -1, -1, -1]
    assert triangles.max() == surface.triangle_count - 1
    with pytest.raises(InputError, match="no edit to undo"):
        editor.undo()


def test_undo_restores_everything() -> None:
    surface = octahedron(1)
    points, triangles = surface.points, surface.triangles
    editor = SurfaceEditor(surface, undo=-1)
    rng = np.random.default_rng(1)
    for _ in range(60):
        a, b, _ = surface.triangles[rng.integers(surface.triangle_count)]
        try:
            match rng.integers(3):
                case 0:
                    editor.split_edge(a, b)
                case 1:
                    editor.collapse(a, b)
                case _:
                    editor.flip(a, b)
        except InputError:
            continue
    while editor.describe().undoable:
        editor.undo()
    assert (surface.points == points).all()
    assert (surface.triangles == triangles).all()


def test_probers_and_stars_follow() -> None:
    surface = octahedron(2)
    star, prober = Star(surface), Prober(surface, boxes=True)
    editor = SurfaceEditor(surface, undo=-1)
    later = Prober(surface, boxes=True)
    rng = np.random.default_rng(2)
    for step in range(80):
        t = int(rng.integers(surface.triangle_count))
        corners = editor.triangle(t)
        if corners is None:
            continue
        a, b, c = corners
        try:
            if step % 5 == 0:
                editor.split_triangle(t)
            elif step % 5 == 1:
                editor.flip(a, b)
            elif step % 5 == 2:
                editor.collapse(b, c)
            elif step % 5 == 3:
                editor.move_vertex(a, 1.125 * np.array(editor.vertex(a)))
            else:
                editor.remove_triangle(t)
                same_answers(editor, star, prober, rng)
                editor.undo()
        except InputError:
            continue
        same_answers(editor, star, prober, rng)
        same_answers(editor, star, later, rng)
    editor.compact()
    same_answers(editor, star, later, rng)


def test_a_star_waits_for_triangles_with_area() -> None:
    surface = octahedron(1)
    star = Star(surface)
    editor = SurfaceEditor(surface)
    a, b, _ = surface.triangles[0]
    new = editor.split_edge(a, b).vertices_made[0]
    editor.move_vertex(new, surface.points[a])
    assert not star.ready
    surface.move(surface.points)
    assert star.ready
    editor.move_vertex(new, (surface.points[a] + surface.points[b]) / 2)
    assert not star.ready
    surface.move(surface.points)
    assert star.ready
    editor.split_triangle(3)
    assert star.ready


def test_detach_and_attach() -> None:
    surface = Surface(SQUARES, HALVES)
    prober, star = Prober(surface, boxes=True), Star(octahedron())
    editor = SurfaceEditor(surface)
    editor.detach(prober)
    editor.remove_triangle(0)
    assert prober.probe([[0.25, 0.25, 1]], [[0, 0, -1]], certain=True).state[0] == (
        meshwalk.TouchState.BAD
    )
    editor.attach(prober)
    surface.move(surface.points)
    assert touched(prober, [0.25, 0.25, 1]) == -1
    editor.add_triangle(0, 1, 3)
    assert touched(prober, [0.25, 0.25, 1]) == 4
    with pytest.raises(ValueError, match="not of this surface"):
        editor.attach(star)


def test_refusals() -> None:
    surface = Surface(SQUARES, HALVES)
    editor = SurfaceEditor(surface)
    points, triangles = surface.points, surface.triangles
    with pytest.raises(InputError, match="no edge joins the vertices 0 and 4"):
        editor.flip(0, 4)
    with pytest.raises(InputError, match="would have a third triangle"):
        editor.add_triangle(1, 4, 0)
    with pytest.raises(InputError, match="there is no triangle 9"):
        editor.remove_triangle(9)
    with pytest.raises(InputError, match="both ends lie on a border"):
        editor.collapse(1, 4)
    with pytest.raises(InputError, match="not finite"):
        editor.move_vertex(0, [0, float("inf"), 0])
    with pytest.raises(ValueError, match="not finite"):
        editor.split_edge(1, 4, [float("nan"), 0, 0])
    with pytest.raises(ValueError, match="the same shape"):
        editor.sew([0, 1], [1, 2, 5])
    with pytest.raises(ValueError, match="shape"):
        editor.add_vertex([1, 2])
    with pytest.raises(OverflowError):
        editor.remove_vertex(-1)
    assert (surface.points == points).all()
    assert (surface.triangles == triangles).all()


def test_surfaces_that_are_not_edited() -> None:
    with pytest.raises(ValueError, match="welded"):
        SurfaceEditor(Surface(SQUARES, HALVES, weld=True))
    with pytest.raises(ValueError, match="fields"):
        SurfaceEditor(Surface(SQUARES, HALVES, {"z": np.zeros(6)}))
    with pytest.raises(TypeError, match=r"meshwalk\.Surface"):
        SurfaceEditor(HALVES)  # type: ignore[arg-type]
    surface = Surface(SQUARES, HALVES)
    editor = SurfaceEditor(surface)
    with pytest.raises(ValueError, match="has an editor already"):
        SurfaceEditor(surface)
    assert repr(editor) == "<SurfaceEditor: 6 vertices, 4 triangles>"
    del editor
    assert SurfaceEditor(surface).surface is surface


def test_pickling() -> None:
    surface = Surface(SQUARES, HALVES)
    editor = SurfaceEditor(surface)
    editor.remove_triangle(1)
    with pytest.raises(TypeError, match="copy"):
        pickle.dumps(editor)
    with pytest.raises(TypeError, match="freed triangles"):
        pickle.dumps(surface)
    assert pickle.loads(pickle.dumps(editor.copy())).triangle_count == 3
    editor.compact()
    assert pickle.loads(pickle.dumps(surface)).triangles.tolist() == surface.triangles.tolist()


def test_lifetimes() -> None:
    """The editor keeps alive what follows it, and nothing longer."""
    surface = Surface(SQUARES, HALVES)
    prober = Prober(surface, boxes=True)
    editor = SurfaceEditor(surface)
    known = weakref.ref(prober)
    del prober
    gc.collect()
    editor.cut([1, 4])
    assert known() is not None
    del editor
    gc.collect()
    assert known() is None
    assert SurfaceEditor(surface).surface is surface


def test_threads_query_while_one_edits() -> None:
    surface = octahedron(2)
    star, prober = Star(surface), Prober(surface, boxes=True)
    editor = SurfaceEditor(surface, undo=-1)
    done = threading.Event()
    wrong: list[str] = []

    def ask() -> None:
        rays = np.random.default_rng(3).normal(size=(50, 3))
        while not done.is_set():
            if (star.locate(rays).where == Where.BAD).any():
                wrong.append("a ray")
            if (prober.probe(9 * rays, -rays, certain=True).triangle < 0).any():
                wrong.append("a probe")

    threads = [threading.Thread(target=ask) for _ in range(2)]
    for thread in threads:
        thread.start()
    for t in range(200):
        editor.split_triangle(t % surface.triangle_count)
    done.set()
    for thread in threads:
        thread.join()
    assert not wrong
