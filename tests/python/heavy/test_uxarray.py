"""The drop-in for uxarray: against an oracle in fractions, and against uxarray itself."""

from __future__ import annotations

from fractions import Fraction
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest
import scipy.spatial
from conftest import NOT_HERE, run_page

from meshwalk import InputError
from meshwalk.uxarray import FaceFinder, use

if TYPE_CHECKING:
    from numpy.typing import NDArray

uxarray = pytest.importorskip("uxarray", reason=f"uxarray {NOT_HERE}")


def triangles(count: int, random: np.random.Generator) -> Any:
    """A grid of triangles between random places of the sphere."""
    nodes = random.normal(size=(count, 3))
    nodes /= np.linalg.norm(nodes, axis=1, keepdims=True)
    corners = scipy.spatial.ConvexHull(nodes).simplices.astype(np.intp)
    a, b, c = (nodes[corners[:, k]] for k in range(3))
    turned = (np.cross(b - a, c - a) * a).sum(axis=1) < 0
    corners[turned] = corners[turned][:, ::-1]
    lon, lat = np.arctan2(nodes[:, 1], nodes[:, 0]), np.arcsin(nodes[:, 2])
    return uxarray.Grid.from_topology(np.rad2deg(lon), np.rad2deg(lat), corners)


def globe(columns: int, rows: int) -> Any:
    """Longitudes by latitudes: quads, with triangles round the poles."""
    across, up = np.arange(columns) * 360 / columns - 180, np.linspace(-90, 90, rows + 1)
    x, y = np.meshgrid(across, up[1:-1])
    lon, lat = np.append(x, [0, 0]), np.append(y, [-90, 90])
    south, north = len(lon) - 2, len(lon) - 1
    fill = uxarray.constants.INT_FILL_VALUE
    faces = []
    for k in range(columns):
        after = (k + 1) % columns
        faces.append([south, after, k, fill])
        for row in range(rows - 2):
            below, above = columns * row, columns * (row + 1)
            faces.append([below + k, below + after, above + after, above + k])
        top = columns * (rows - 2)
        faces.append([top + k, top + after, north, fill])
    return uxarray.Grid.from_topology(lon, lat, np.array(faces), fill_value=fill)


def oracle(grid: Any, point: NDArray[Any]) -> list[int]:
    """All faces whose cone contains a direction; their corners turn counter-clockwise."""
    nodes = np.stack([grid.node_x.values, grid.node_y.values, grid.node_z.values], axis=1)
    p = [Fraction(float(v)) for v in point]
    found = []
    for number, corners in enumerate(grid.face_node_connectivity.values):
        ring = [[Fraction(float(v)) for v in nodes[c]] for c in corners if c >= 0]
        sides = []
        for (ax, ay, az), (bx, by, bz) in zip(ring, ring[1:] + ring[:1], strict=True):
            normal = (ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx)
            sides.append(sum(n * q for n, q in zip(normal, p, strict=True)))
        if all(side >= 0 for side in sides):
            found.append(number)
    return found


def faces_of(grid: Any, points: NDArray[Any]) -> tuple[NDArray[Any], NDArray[Any]]:
    found = FaceFinder(grid).get_faces_containing_point(points)
    assert isinstance(found, tuple)
    return found


def nodes_of(grid: Any) -> NDArray[Any]:
    return np.stack([grid.node_x.values, grid.node_y.values, grid.node_z.values], axis=1)


def test_faces_of_triangles_are_those_of_an_oracle(random: np.random.Generator) -> None:
    grid = triangles(40, random)
    nodes = nodes_of(grid)
    corners = grid.face_node_connectivity.values
    middles = (nodes[corners] + nodes[np.roll(corners, 1, axis=1)]).reshape(-1, 3)
    points = np.concatenate([random.normal(size=(100, 3)), nodes, middles])
    found = FaceFinder(grid).get_faces_containing_point(points, return_counts=False)
    assert found == [oracle(grid, p) for p in points]
    assert sum(len(row) > 1 for row in found) > 40


def test_faces_of_quads_hold_their_points(random: np.random.Generator) -> None:
    """Four corners of a quad lie in no plane, so its sides are compared."""
    grid = globe(12, 7)
    points = random.normal(size=(300, 3))
    points /= np.linalg.norm(points, axis=1, keepdims=True)
    points = np.concatenate([points, nodes_of(grid)])
    face, count = faces_of(grid, points)
    assert face.shape == (len(points), 12)  # twelve faces meet at the poles
    for row, n, point in zip(face, count, points, strict=True):
        assert row[:n].tolist() == oracle(grid, point)
        assert (row[n:] == uxarray.constants.INT_FILL_VALUE).all()


@pytest.mark.parametrize("kind", ["triangles", "globe"])
def test_answers_are_those_of_uxarray(random: np.random.Generator, kind: str) -> None:
    grid = triangles(400, random) if kind == "triangles" else globe(24, 12)
    lonlat = np.column_stack([360 * random.random(2000) - 180, 160 * random.random(2000) - 80])
    face, count = faces_of(grid, lonlat)
    theirs, their_count = grid.get_faces_containing_point(lonlat)
    np.testing.assert_array_equal(count, their_count)
    np.testing.assert_array_equal(face, theirs)
    one, _ = faces_of(grid, lonlat[0])
    assert one.tolist() == [face[0].tolist()]


def test_where_the_original_is_wrong(random: np.random.Generator) -> None:
    """At a node of six triangles it has room for three faces."""
    grid = triangles(60, random)
    nodes = nodes_of(grid)
    face, count = faces_of(grid, nodes[:1])
    assert face[0, : count[0]].tolist() == oracle(grid, nodes[0])
    theirs, their_count = grid.get_faces_containing_point(nodes)
    assert their_count.max() > theirs.shape[1], "uxarray has room now: the page says otherwise"


def test_part_of_a_hemisphere(random: np.random.Generator) -> None:
    """Sides, nodes and the border are decided exactly here, too."""
    whole = triangles(80, random)
    nodes, corners = nodes_of(whole), whole.face_node_connectivity.values
    kept = corners[(nodes[corners] @ [0.6, 0.0, 0.8] > 0.1).all(axis=1)]
    assert len(kept) > 20
    lon, lat = whole.node_lon.values, whole.node_lat.values
    grid = uxarray.Grid.from_topology(lon, lat, kept)
    nodes = nodes_of(grid)
    middles = (nodes[kept] + nodes[np.roll(kept, 1, axis=1)]).reshape(-1, 3)
    points = np.concatenate([random.normal(size=(100, 3)), nodes, middles])
    found = FaceFinder(grid).get_faces_containing_point(points, return_counts=False)
    assert found == [oracle(grid, p) for p in points]
    assert [] in found
    assert max(map(len, found)) > 2


def test_an_ocean(random: np.random.Generator) -> None:
    """More than a hemisphere, with land; and one that overlaps."""
    whole = triangles(400, random)
    nodes, corners = nodes_of(whole), whole.face_node_connectivity.values
    small = (nodes[corners] * nodes[np.roll(corners, 1, axis=1)]).sum(axis=2).min(axis=1) > 0.87
    land = (nodes[corners] @ [0.6, 0.0, 0.8] > 0.9).all(axis=1)
    kept = corners[small & ~land]
    assert len(corners) - 60 < len(kept) < len(corners) - 10
    lon, lat = whole.node_lon.values, whole.node_lat.values
    grid = uxarray.Grid.from_topology(lon, lat, kept)
    nodes = nodes_of(grid)
    middles = (nodes[kept] + nodes[np.roll(kept, 1, axis=1)]).reshape(-1, 3)[:100]
    points = np.concatenate([random.normal(size=(100, 3)), nodes[:60], middles])
    found = FaceFinder(grid).get_faces_containing_point(points, return_counts=False)
    assert found == [oracle(grid, p) for p in points]
    assert [] in found
    assert max(map(len, found)) > 2
    folded = np.concatenate([kept, kept[:1, [0, 1, 1]]])
    folded[-1, 2] = kept[~np.isin(kept, kept[0]).any(axis=1)][0, 0]
    with pytest.raises(InputError):
        FaceFinder(uxarray.Grid.from_topology(lon, lat, folded))


def test_open_grids_are_left_to_uxarray(random: np.random.Generator) -> None:
    whole = triangles(60, random)
    lon, lat = whole.node_lon.values, whole.node_lat.values
    part = uxarray.Grid.from_topology(lon, lat, whole.face_node_connectivity.values[1:])
    middle = nodes_of(whole)[whole.face_node_connectivity.values[5]].mean(axis=0)
    use()
    try:
        use()
        assert whole.get_faces_containing_point(middle, return_counts=False) == [[5]]
        assert isinstance(whole._meshwalk_finder, FaceFinder)
        with pytest.warns(
            UserWarning, match="uxarray searches this grid: .*not closed.*hemi.*sides of"
        ):
            found = part.get_faces_containing_point(middle / np.linalg.norm(middle), False)
        assert found == [[4]]
    finally:
        use(False)
    assert not hasattr(uxarray.Grid.get_faces_containing_point, "_of_uxarray")


def test_the_page(data: Path) -> None:
    try:
        run_page(data.parent / "docs/drop-ins/uxarray.md")
    finally:
        use(False)
