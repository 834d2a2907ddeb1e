"""The drop-in for Parcels 4: against exact answers, and by Parcels' own tests."""

from __future__ import annotations

import io
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest
from conftest import NOT_HERE, oracle, run_page
from originals import run_their_tests, sources

import meshwalk
from meshwalk.parcels import SpatialHash, use

if TYPE_CHECKING:
    from numpy.typing import NDArray

parcels = pytest.importorskip("parcels", reason=f"parcels {NOT_HERE}")
uxarray = pytest.importorskip("uxarray", reason=f"uxarray {NOT_HERE}")


def ux_grid(points: NDArray[Any], triangles: NDArray[Any], mesh: str = "flat") -> Any:
    grid = uxarray.Grid.from_topology(*points.T, np.asarray(triangles, np.intp))
    depth = uxarray.UxDataArray(np.array([0.0, 1.0]), dims=["zf"], uxgrid=grid)
    return parcels.UxGrid(grid, z=depth, mesh=mesh)


def test_triangles_are_those_of_an_oracle(random: np.random.Generator) -> None:
    points = 10 * random.random((40, 2))
    mesh = meshwalk.delaunay(points)
    cells = SpatialHash(ux_grid(points, mesh.triangles))
    ends = points[mesh.triangles]
    middles = ((ends + np.roll(ends, 1, axis=1)) / 2).reshape(-1, 2)
    queries = np.concatenate([points, middles, 12 * random.random((99, 2)) - 1])
    hull = np.array([oracle(mesh, q) for q in queries])
    near = cells._plane.locate(queries, tolerance=cells._tolerance).where == meshwalk.Where.NEAR
    for _ in range(2):  # the second time from the cells of the first
        j, i, coords = cells.query(queries[:, 1], queries[:, 0])
        np.testing.assert_array_equal(i[~near], np.where(hull < 0, -3, hull)[~near])
        np.testing.assert_array_equal(j, np.where(i < 0, -3, 0))
        assert (coords[i < 0] == -1).all()
        again = (coords[..., None] * points[mesh.triangles[i]])[i >= 0].sum(axis=1)
        np.testing.assert_allclose(again, queries[i >= 0], atol=2 * cells._tolerance)
    wrong = np.full(len(queries), 3)
    np.testing.assert_array_equal(cells.query_from(queries[:, 1], queries[:, 0], wrong)[1], i)
    assert cells.query([np.nan], [1.0])[1].tolist() == [-3]


@pytest.mark.parametrize("mesh", ["flat", "spherical"])
def test_answers_are_those_of_parcels(random: np.random.Generator, mesh: str) -> None:
    points = 20 * random.random((300, 2))
    triangles = np.array(meshwalk.delaunay(points).triangles)
    triangles[::2] = triangles[::2, ::-1]  # clockwise
    grid = ux_grid(points, triangles, mesh)
    queries = 20 * random.random((3000, 2))
    theirs = grid.get_spatial_hash().query(queries[:, 1], queries[:, 0])
    ours = SpatialHash(grid).query(queries[:, 1], queries[:, 0])
    same = ours[1] == theirs[1]
    assert same.mean() > 0.999
    np.testing.assert_allclose(ours[2][same], theirs[2][same], atol=1e-5)


def test_quads_on_curved_lines(random: np.random.Generator) -> None:
    from parcels._datasets.structured.generated import simple_UV_dataset

    i, j = np.meshgrid(np.arange(14.0), np.arange(11.0))
    lon, lat = 3 + i + 0.3 * np.sin(j), 40 + 0.8 * j + 0.2 * np.cos(i)
    for mesh in ("flat", "spherical"):
        made = simple_UV_dataset(n_times=2, nz=2, ny=11, nx=14, mesh=mesh)
        lines = {"lon": (("YG", "XG"), lon), "lat": (("YG", "XG"), lat)}
        dataset = made.assign_coords(lines)
        grid = parcels.FieldSet.from_sgrid_conventions(dataset, mesh=mesh).U.grid
        queries = random.random((2000, 2)) * [16, 12] + [2, 39]
        theirs = grid.get_spatial_hash().query(queries[:, 1], queries[:, 0])
        ours = SpatialHash(grid).query(queries[:, 1], queries[:, 0])
        for mine, other in zip(ours[:2], theirs[:2], strict=True):
            assert (mine == other).mean() > 0.999
        same = (ours[0] == theirs[0]) & (ours[1] == theirs[1])
        np.testing.assert_allclose(ours[2][same], theirs[2][same], atol=1e-5)


def test_where_the_original_is_wrong(random: np.random.Generator) -> None:
    """Triangles of a metre, near 170 degrees east: floats step by a metre there."""
    corner, metre = np.array([170.0, 50.0]), 1e-5
    points = corner + 20 * metre * random.random((400, 2))
    triangles = meshwalk.delaunay(points).triangles
    grid = ux_grid(points, triangles)
    nodes = np.stack([grid.uxgrid.node_lon.values, grid.uxgrid.node_lat.values], axis=1)
    mesh = meshwalk.Mesh(nodes, triangles)
    queries = corner + metre * (1 + 18 * random.random((200, 2)))
    truth = np.array([oracle(mesh, q) for q in queries])
    asked = (np.zeros(200), queries[:, 1], queries[:, 0])
    theirs = grid.search(*asked)["FACE"]["index"]
    assert (theirs != truth).mean() > 0.3, "Parcels takes doubles now: the page says otherwise"
    use()
    try:
        grid._spatialhash = None
        first = grid.search(*asked)
        np.testing.assert_array_equal(first["FACE"]["index"], truth)
        at = grid.ravel_index({"Z": first["Z"]["index"], "FACE": truth})
        np.testing.assert_array_equal(grid.search(*asked, ei=at)["FACE"]["index"], truth)
    finally:
        use(False)


def test_grids_that_overlap_are_left_to_parcels() -> None:
    points = np.array([[0.0, 0], [4, 0], [0, 4], [4, 4]])
    grid = ux_grid(points, np.array([[0, 1, 2], [0, 1, 3]]))
    use()
    try:
        use()
        with pytest.warns(UserWarning, match="Parcels searches this grid"):
            assert not isinstance(grid.get_spatial_hash(), SpatialHash)
        found = grid.search(np.zeros(1), np.array([0.5]), np.array([1.0]))
        assert found["FACE"]["index"][0] in (0, 1)
        good = ux_grid(points, np.array([[0, 1, 2], [1, 3, 2]]))
        assert isinstance(good.get_spatial_hash(), SpatialHash)
        text = io.StringIO()
        good.get_spatial_hash().describe(text)
        assert text.getvalue()
    finally:
        use(False)
    assert not hasattr(parcels.UxGrid.search, "_of_parcels")


THEIR_FILES = ["uxgrid", "spatialhash", "uxadvection", "index_search", "uxarray_fieldset"]


def test_the_originals_own_tests(tmp_path: Path) -> None:
    folder = sources("parcels")
    drop_in = "import meshwalk.parcels\nmeshwalk.parcels.use()\n"
    files = [f"tests/test_{name}.py" for name in THEIR_FILES]
    # What is left out asks for a file of the web.
    run_their_tests(folder, files, drop_in, "not test_fesom_fieldset", 55, tmp_path)


def test_the_page(data: Path) -> None:
    try:
        run_page(data.parent / "docs/drop-ins/parcels.md")
    finally:
        use(False)
