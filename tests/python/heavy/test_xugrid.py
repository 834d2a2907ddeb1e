"""The drop-in for xugrid: against exact answers, and by xugrid's own tests."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest
from conftest import NOT_HERE, oracle, run_page, turn
from originals import run_their_tests, sources

import meshwalk
from meshwalk.xugrid import CellTree2d, use

if TYPE_CHECKING:
    from numpy.typing import NDArray

pytest.importorskip("xugrid", reason=f"xugrid {NOT_HERE}")
import numba_celltree
import xugrid


def quads(count: int, random: np.random.Generator) -> tuple[NDArray[Any], NDArray[Any]]:
    """A grid of convex quads on crooked lines; a third are cut into triangles, some turned."""
    x, y = np.meshgrid(np.arange(count + 1.0), np.arange(count + 1.0))
    points = np.stack([x, y], axis=-1).reshape(-1, 2) + 0.2 * random.random(((count + 1) ** 2, 2))
    corner = (np.arange(count) + (count + 1) * np.arange(count)[:, None]).reshape(-1).tolist()
    faces = [[c, c + 1, c + count + 2, c + count + 1] for c in corner]
    mixed: list[list[int]] = []
    for k, face in enumerate(faces):
        if k % 3 == 0:
            mixed += [[*face[:3], -1], [face[0], face[2], face[3], -1]]
        else:
            mixed.append(face[:: -1 if k % 2 else 1])
    return points, np.array(mixed)


def holds(points: NDArray[Any], face: NDArray[Any], xy: NDArray[Any]) -> bool:
    """Whether a convex face contains a point, decided in fractions."""
    corners = points[face[face >= 0]]
    turns = [turn(a, b, xy) for a, b in zip(corners, np.roll(corners, -1, axis=0), strict=True)]
    return all(t >= 0 for t in turns) or all(t <= 0 for t in turns)


def middles(points: NDArray[Any], faces: NDArray[Any]) -> NDArray[Any]:
    """Rounded middles of sides."""
    ends = points[faces]
    return np.asarray(((ends + np.roll(ends, 1, axis=1)) / 2).reshape(-1, 2))


def test_faces_are_those_of_an_oracle(random: np.random.Generator) -> None:
    points, faces = quads(6, random)
    tree = CellTree2d(points, faces, -1)
    queries = np.concatenate([points, 8 * random.random((150, 2)) - 1])
    found = tree.locate_points(queries, 0)
    wanted = [
        next((k for k, face in enumerate(faces) if holds(points, face, q)), -1) for q in queries
    ]
    assert found.tolist() == wanted


def test_answers_are_those_of_numba_celltree(random: np.random.Generator) -> None:
    points, faces = quads(30, random)
    ours, theirs = CellTree2d(points, faces, -1), numba_celltree.CellTree2d(points, faces, -1)
    queries = 34 * random.random((20000, 2)) - 2
    np.testing.assert_array_equal(ours.locate_points(queries), theirs.locate_points(queries))
    (face, weights), (their_face, theirs_) = (
        tree.compute_barycentric_weights(queries) for tree in (ours, theirs)
    )
    np.testing.assert_array_equal(face, their_face)
    # Theirs stand in the order of counter-clockwise corners, without saying so.
    turned = np.array([k for k, row in enumerate(faces) if (theirs.faces[k] != row).any()])
    assert len(turned) > 50
    same = ~np.isin(face, turned)
    np.testing.assert_allclose(weights[same], theirs_[same], atol=1e-9)
    inside = face >= 0
    corners = np.where(faces[face, :, None] < 0, 0, points[faces[face]])
    again = (weights[..., None] * corners).sum(axis=1)
    np.testing.assert_allclose(again[inside], queries[inside], atol=1e-9)
    edges = 34 * random.random((2000, 2, 2)) - 2
    edges[::5, 1] = edges[::5, 0]  # of no length
    edges[1::5] = np.round(edges[1::5])
    for mine, other in zip(ours.intersect_edges(edges), theirs.intersect_edges(edges), strict=True):
        np.testing.assert_allclose(mine, other, atol=1e-9)


def test_areas_of_overlaps(random: np.random.Generator) -> None:
    points, faces = quads(12, random)
    other, others = quads(9, random)
    ours = CellTree2d(points, faces, -1).intersect_faces(other, others, -1)
    theirs = numba_celltree.CellTree2d(points, faces, -1).intersect_faces(other, others, -1)
    order = np.lexsort(theirs[1::-1])
    mine = np.lexsort(ours[1::-1])
    large = theirs[2][order] > 1e-12
    kept = ours[2][mine] > 1e-12
    for k in range(3):
        np.testing.assert_allclose(ours[k][mine][kept], theirs[k][order][large], atol=1e-11)


def test_sides_of_two_faces_and_concave_ones() -> None:
    points = np.array([[0, 0], [2, 0], [2, 2], [0, 2], [4, 0], [4, 2]], float)
    faces = np.array([[0, 1, 2, 3], [1, 4, 5, 2]])
    edges = np.array([[[2, 0], [2, 2]], [[1, 1], [1, 1]], [[0, 0], [4, 0]]], float)
    for tree in (CellTree2d(points, faces, -1), numba_celltree.CellTree2d(points, faces, -1)):
        edge, face, _ = tree.intersect_edges(edges)
        assert (edge.tolist(), face.tolist()) == ([0, 0, 2, 2], [0, 1, 0, 1])
    arrow = np.array([[0, 0], [4, 0], [1, 1], [0, 4]], float)
    across = np.array([[[3, 0], [0, 3]]], float)
    tree = CellTree2d(arrow, np.array([[0, 1, 2, 3]]), -1)
    np.testing.assert_array_equal(
        tree.intersect_edges(across)[2], [[[3, 0], [2.5, 0.5]], [[0.5, 2.5], [0, 3]]]
    )
    # The original takes the whole line, half of which is outside of the face.
    theirs = numba_celltree.CellTree2d(arrow, np.array([[0, 1, 2, 3]]), -1)
    assert theirs.intersect_edges(across)[2].tolist() == across.tolist()
    # A face that is star-shaped about none of its corners.
    comb = np.array([[0, 0], [6, 0], [6, 4], [5, 4], [5, 1], [1, 1], [1, 4], [0, 4]], float)
    tree = CellTree2d(comb, np.arange(8)[None], -1)
    inside = tree.locate_points([[0.5, 3.0], [5.5, 3.0], [3.0, 0.5], [3.0, 2.0]])
    assert inside.tolist() == [0, 0, 0, -1]
    crossed = [[0, 0], [6, 0], [0, 4], [6, 4], [3, 9], [9, 3]]
    with pytest.raises(ValueError, match="cross"):
        CellTree2d(crossed, [list(range(6))], -1)


def test_where_the_original_is_wrong(random: np.random.Generator) -> None:
    points = random.random((70, 2)) + np.array([5e5, 5e6])
    mesh = meshwalk.delaunay(points)
    queries = middles(points, mesh.triangles)
    theirs = numba_celltree.CellTree2d(points, mesh.triangles, -1).locate_points(queries)
    ours = CellTree2d(points, mesh.triangles, -1).locate_points(queries, 0)
    assert ours.tolist() == [oracle(mesh, q) for q in queries]

    def wrong(answers: NDArray[Any]) -> int:
        pairs = zip(answers, queries, strict=True)
        return sum(t >= 0 and not holds(points, mesh.triangles[t], q) for t, q in pairs)

    assert wrong(ours) == 0
    assert wrong(theirs) > 20, "numba_celltree has them right now: the page says otherwise"
    # Weights of a clockwise face: the point that they make is another one.
    corners, face = np.array([[0, 0], [4, 0], [0, 4.0]]), np.array([[0, 2, 1]])
    place = np.array([[3, 0.5]])
    for tree, right in ((CellTree2d, True), (numba_celltree.CellTree2d, False)):
        _, weights = tree(corners, face, -1).compute_barycentric_weights(place)
        assert np.allclose(weights[0] @ corners[face[0]], place[0]) == right


def test_grids_that_overlap_are_left_to_the_original() -> None:
    use()
    try:
        x, y = np.array([0.0, 4, 0, 4]), np.array([0.0, 0, 4, 4])
        grid = xugrid.Ugrid2d(x, y, -1, np.array([[0, 1, 2], [0, 1, 3]]))
        with pytest.warns(UserWarning, match="numba_celltree searches this grid"):
            assert isinstance(grid.celltree, numba_celltree.CellTree2d)
        good = xugrid.Ugrid2d(x, y, -1, np.array([[0, 1, 2], [1, 3, 2]]))
        assert isinstance(good.celltree, CellTree2d)
        assert sorted(good.celltree.locate_boxes(np.array([[0.0, 1, 0, 1]]))[1]) == [0, 1]
    finally:
        use(False)
    assert isinstance(vars(xugrid.Ugrid2d)["celltree"], property)


THEIR_FILES = ["burn", "interpolate", "regrid", "snap", "ugrid2d", "ugrid_dataset"]
# The first wants an object of numba_celltree's class. The others ask for files of the web.
LEFT_OUT = "not test_celltree and not elevation_nl"


def test_the_originals_own_tests(tmp_path: Path) -> None:
    folder = sources("xugrid")
    files = [f"tests/test_{name}{'' if name == 'regrid' else '.py'}" for name in THEIR_FILES]
    drop_in = "import meshwalk.xugrid\nmeshwalk.xugrid.use()\n"
    run_their_tests(folder, files, drop_in, LEFT_OUT, 300, tmp_path)


def test_the_page(data: Path) -> None:
    try:
        run_page(data.parent / "docs/drop-ins/xugrid.md")
    finally:
        use(False)
