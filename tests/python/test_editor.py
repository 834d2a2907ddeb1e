"""Editors: edits, their reports, undo, log and location in between."""

from __future__ import annotations

import pickle
import threading

import numpy as np
import pytest
from conftest import oracle

import meshwalk
from meshwalk import EdgeKind, EditKind


@pytest.fixture
def editor(scattered: meshwalk.Mesh) -> meshwalk.Editor:
    heights = {"z": np.arange(scattered.vertex_count), "w": np.ones(scattered.vertex_count)}
    mesh = meshwalk.Mesh(scattered.points, scattered.triangles, heights)
    return meshwalk.Editor(mesh, undo=-1, log=True)


def _edit_at_random(editor: meshwalk.Editor, random: np.random.Generator, count: int) -> None:
    for _ in range(count):
        vertex = int(random.integers(editor.describe().vertex_range))
        x, y = random.uniform(-1, 13, 2)
        try:
            if random.uniform() < 0.5:
                editor.insert(x, y)
            elif random.uniform() < 0.5:
                editor.remove(vertex)
            else:
                editor.move(vertex, x, y)
        except meshwalk.InputError:
            assert editor.vertex(vertex) is None


def test_location_between_edits(editor: meshwalk.Editor, random: np.random.Generator) -> None:
    for _ in range(5):
        _edit_at_random(editor, random, 20)
        xy = random.integers(-2, 14, (40, 2))
        hit = editor.locate(xy)
        one = [editor.locate_one(x, y).triangle for x, y in xy]
        np.testing.assert_array_equal(hit.triangle, one)
        editor.compact()
        mesh = editor.mesh()
        assert mesh.describe().delaunay
        found = editor.locate(xy).triangle
        np.testing.assert_array_equal(found, [oracle(mesh, p) for p in xy])
        np.testing.assert_array_equal(found, meshwalk.Locator(mesh).locate(xy).triangle)


def test_undo_brings_everything_back(editor: meshwalk.Editor, random: np.random.Generator) -> None:
    before = editor.mesh()
    _edit_at_random(editor, random, 50)
    while editor.describe().undoable:
        editor.undo()
    after = editor.mesh()
    np.testing.assert_array_equal(after.triangles, before.triangles)
    np.testing.assert_array_equal(after.fields["z"], before.fields["z"])
    with pytest.raises(meshwalk.InputError):
        editor.undo()


def test_the_log_gives_the_same_mesh(editor: meshwalk.Editor, random: np.random.Generator) -> None:
    other = meshwalk.Editor(editor.mesh())
    _edit_at_random(editor, random, 50)
    editor.insert_points(random.uniform(0, 10, (20, 2)))
    editor.set_value(0, 7.5)
    editor.undo()
    for edit in pickle.loads(pickle.dumps(editor.log())):
        other.apply(edit)
    np.testing.assert_array_equal(other.mesh().triangles, editor.mesh().triangles)
    np.testing.assert_array_equal(other.mesh().points, editor.mesh().points)
    assert other.log() == []


def test_reports(editor: meshwalk.Editor) -> None:
    before = {t: editor.triangle(t) for t in range(editor.describe().triangle_range)}
    change = editor.insert(3.25, 3.5)
    assert change.vertices_made == 1
    assert editor.vertex(change.vertex) == (3.25, 3.5)
    for triangle, corners in zip([*change.reused, *change.freed], change.before, strict=True):
        assert set(before[int(triangle)] or ()) == set(corners.tolist())
    for triangle in change.made:
        assert change.vertex in (editor.triangle(int(triangle)) or ())
    gone = editor.remove(change.vertex)
    assert gone.vertices_freed == 1
    assert editor.vertex(change.vertex) is None
    for triangle in gone.freed:
        assert editor.triangle(int(triangle)) is None
    at_a_vertex = editor.insert(*(editor.vertex(5) or (0, 0)))
    assert (at_a_vertex.vertex, at_a_vertex.vertices_made) == (5, 0)
    assert repr(at_a_vertex) == "<Change: vertex 5; 0 made, 0 reused, 0 freed>"


def test_edges_and_neighbours(square: meshwalk.Mesh) -> None:
    editor = meshwalk.Editor(square)
    assert editor.edge(0, 2) == EdgeKind.UNCONSTRAINED
    assert editor.edge(0, 1) == EdgeKind.BORDER
    editor.flip(0, 2)
    assert editor.edge(0, 2) == EdgeKind.NONE
    assert editor.constrain(1, 3).constrained_edges == 1
    assert editor.edge(1, 3) == EdgeKind.CONSTRAINED
    with pytest.raises(meshwalk.InputError):
        editor.constrain(0, 2)
    assert editor.mesh().constrained_edges.tolist() in ([[1, 3]], [[3, 1]])
    editor.release(1, 3)
    assert editor.describe().constrained_edges == 0
    assert editor.adjacent(0) == [1, 3]
    assert editor.adjacent(99) == []
    with pytest.raises(OverflowError):
        editor.remove(-1)


def test_constraints_of_the_mesh_are_kept(random: np.random.Generator) -> None:
    points = random.uniform(size=(50, 2))
    points[:2] = [[-1, -1], [2, 2]]
    mesh = meshwalk.constrained_delaunay(points, [[0, 1]])
    editor = meshwalk.Editor(mesh)
    assert editor.edge(0, 1) == EdgeKind.CONSTRAINED
    editor.insert(0.5, 0.5)
    assert editor.describe().constrained_edges == 2


def test_fields(editor: meshwalk.Editor) -> None:
    change = editor.insert(3.25, 3.5, 42)
    assert editor.value(change.vertex) == 42
    assert editor.value(change.vertex, "w") == 1
    hit = editor.locate([[3.25, 3.5], [99.0, 99.0]])
    np.testing.assert_array_equal(hit.interpolate("z"), [42, np.nan])
    assert hit[0].interpolate("w") == 1
    editor.set_value(change.vertex, 43)
    with pytest.raises(RuntimeError, match="edited since"):
        hit.interpolate("z")
    assert editor.mesh().fields["z"][-1] == 43
    with pytest.raises(KeyError, match="no field 'height'; it has z, w"):
        editor.value(0, "height")
    with pytest.raises(TypeError, match="by name"):
        hit.interpolate([1, 2])
    with pytest.raises(TypeError, match=r"editor\.mesh\(\)"):
        hit.operator()


def test_what_is_refused(editor: meshwalk.Editor, ring: meshwalk.Mesh) -> None:
    before = editor.mesh()
    with pytest.raises(meshwalk.InputError):
        editor.insert(np.nan, 0)
    with pytest.raises(meshwalk.InputError) as raised:
        editor.remove(10**6)
    assert raised.value.vertex is None or raised.value.vertex == 10**6
    with pytest.raises(meshwalk.InputError):
        editor.insert_points([[1.0, 1.0], [np.inf, 1.0]])
    with pytest.raises(meshwalk.InputError):
        meshwalk.Editor(ring).insert(3, 3)
    with pytest.raises(TypeError, match="mesh must be"):
        meshwalk.Editor(editor)  # type: ignore[arg-type]
    with pytest.raises(ValueError, match="delaunay must be one of"):
        meshwalk.Editor(ring, delaunay="maybe")  # type: ignore[arg-type]
    with pytest.raises(ValueError, match="edit"):
        editor.apply(meshwalk.Edit(99))  # type: ignore[arg-type]
    np.testing.assert_array_equal(editor.mesh().triangles, before.triangles)
    with pytest.raises(TypeError, match=r"its mesh\(\) can"):
        pickle.dumps(editor)


def test_many_points(random: np.random.Generator) -> None:
    points = random.uniform(size=(3000, 2))
    editor = meshwalk.Editor(meshwalk.delaunay(points[:10]))
    numbers = editor.insert_points(points)
    assert numbers[:10].tolist() == list(range(10))
    np.testing.assert_array_equal(editor.mesh().points[numbers], points)
    triangles, vertices = editor.compact()
    assert len(vertices) == 3000
    assert len(triangles) == editor.describe().triangles


def test_edits_and_queries_take_turns(editor: meshwalk.Editor, random: np.random.Generator) -> None:
    xy = random.uniform(1, 10, (3000, 2))
    inside: list[bool] = []
    done = threading.Event()

    def ask() -> None:
        while not done.is_set():
            inside.append(bool(editor.locate(xy).inside.all()))

    askers = [threading.Thread(target=ask) for _ in range(2)]
    for asker in askers:
        asker.start()
    editor.insert_points([[0, 0], [0, 11], [11, 0], [11, 11]])
    for x, y in random.uniform(2, 9, (300, 2)):
        editor.insert(x, y)
        assert editor.log()[-1].kind is EditKind.INSERT
    done.set()
    for asker in askers:
        asker.join()
    assert all(inside[2:])
