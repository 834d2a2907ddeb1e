"""`meshwalk.geopandas` and `meshwalk.shapely`: exact, else as the originals, and in their tests."""

from __future__ import annotations

import pickle
import shutil
import warnings
from fractions import Fraction
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest
from conftest import NOT_HERE, PAGES, run_page
from originals import run_their_tests

import meshwalk

if TYPE_CHECKING:
    from numpy.typing import NDArray

shapely = pytest.importorskip("shapely", reason=f"shapely {NOT_HERE}")
geopandas = pytest.importorskip("geopandas", reason=f"geopandas {NOT_HERE}")

import meshwalk.geopandas  # noqa: E402
import meshwalk.shapely  # noqa: E402

STRtree = meshwalk.shapely.STRtree
PREDICATES = sorted(
    ["intersects", "within", "contains", "covers", "covered_by", "touches", "contains_properly"]
)


def pairs(found: NDArray[Any]) -> list[tuple[int, int]]:
    return sorted(zip(*found.tolist(), strict=True))


def side_of_ring(ring: Any, point: Any) -> int:
    """1 inside, 0 on the ring, -1 outside, in fractions."""
    x, y = (Fraction(float(v)) for v in point)
    inside = False
    corners = [[Fraction(float(v)) for v in row] for row in ring]
    for (ax, ay), (bx, by) in zip(corners, corners[1:] + corners[:1], strict=True):
        turn = (bx - ax) * (y - ay) - (by - ay) * (x - ax)
        if turn == 0 and min(ax, bx) <= x <= max(ax, bx) and min(ay, by) <= y <= max(ay, by):
            return 0
        if (ay > y) != (by > y) and (turn > 0) == (by > ay):
            inside = not inside
    return 1 if inside else -1


@pytest.fixture
def areas() -> NDArray[Any]:
    """Areas with holes, in parts, that touch and overlap; one missing and one empty."""
    holes = [[(1, 1), (3, 1), (3, 3), (1, 3)], [(3, 3), (5, 3), (4, 5)]]
    ring = shapely.Polygon([(0, 0), (6, 0), (6, 6), (0, 6)], holes)
    parts = shapely.MultiPolygon([shapely.box(6, 0, 8, 2), shapely.box(8, 2, 10, 4)])
    star = shapely.Polygon([(2, -1), (4, 7), (-1, 2), (7, 2), (0, 7)]).buffer(0)
    return np.array(
        [ring, parts, None, shapely.box(1, 1, 3, 3), shapely.Polygon(), star], dtype=object
    )


@pytest.mark.parametrize("predicate", PREDICATES)
def test_tree_is_as_the_original(areas: NDArray[Any], predicate: str) -> None:
    x, y = np.meshgrid(np.arange(-2, 22) / 2, np.arange(-2, 16) / 2)
    points = np.append(shapely.points(x.ravel(), y.ravel()), [None, shapely.Point()])
    theirs, ours = shapely.STRtree(areas), STRtree(areas)
    assert pairs(ours.query(points, predicate)) == pairs(theirs.query(points, predicate))
    assert pairs(STRtree(points).query(areas, predicate)) == pairs(
        shapely.STRtree(points).query(areas, predicate)
    )
    for k in (0, 100, 300):
        one = ours.query(points[k], predicate)
        assert one.tolist() == sorted(theirs.query(points[k], predicate))
    again = pickle.loads(pickle.dumps(ours))
    assert type(again) is STRtree
    assert pairs(again.query(points, predicate)) == pairs(ours.query(points, predicate))
    # Other geometries are the original's.
    lines = shapely.linestrings([[[0, 0], [9, 9]], [[-1, -1], [-1, 5]]])
    assert pairs(ours.query(lines, predicate)) == pairs(theirs.query(lines, predicate))
    assert ours.nearest(points[0]) == theirs.nearest(points[0])
    assert len(ours) == len(theirs)


def test_tree_is_exact(random: np.random.Generator) -> None:
    corners = random.random((40, 3, 2))
    tree = STRtree(shapely.polygons(corners))
    t = random.random((40, 30, 1))
    near = (corners[:, :1] * (1 - t) + corners[:, 1:2] * t).reshape(-1, 2)
    found = set(pairs(tree.query(shapely.points(near), "intersects")))
    within = set(pairs(tree.query(shapely.points(near), "within")))
    for k, point in enumerate(near):
        for area in range(40):
            side = side_of_ring(corners[area], point)
            assert ((k, area) in found) == (side >= 0)
            assert ((k, area) in within) == (side > 0)


def test_where_the_original_is_not_exact(random: np.random.Generator) -> None:
    """A border through the origin with ends 2^60 away: GEOS takes differences of 106 bits."""
    far = 2.0**60
    corners = np.array([[-3 * far, -far], [3 * far, far], [-3 * far, 3 * far]])
    x = random.random(2000)
    points = np.column_stack([x, x / 3])
    truth = [side_of_ring(corners, point) >= 0 for point in points]
    geometry = shapely.points(points)

    def wrong(tree: Any) -> int:
        found = np.zeros(len(points), bool)
        found[tree.query(geometry, "intersects")[0]] = True
        return int((found != truth).sum())

    assert wrong(STRtree([shapely.Polygon(corners)])) == 0
    assert wrong(shapely.STRtree([shapely.Polygon(corners)])) > 3, "GEOS is exact now"


def test_a_coordinate_that_is_not_finite(areas: NDArray[Any]) -> None:
    bad = shapely.Polygon([(0, 0), (1, 0), (np.inf, 1)])
    geometries = np.append(areas, bad)
    point = shapely.points([[0.5, 0.5]])
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", RuntimeWarning)
        theirs = shapely.STRtree(geometries).query(point, "intersects")
        assert pairs(STRtree(geometries).query(point, "intersects")) == pairs(theirs)


# --- frames ---------------------------------------------------------------------------------------


@pytest.fixture
def mesh() -> meshwalk.Mesh:
    return meshwalk.Mesh(
        [[0, 0], [4, 0], [4, 4], [0, 4]],
        [[0, 1, 2], [0, 2, 3]],
        {"depth": [0, 4, 8, 4]},
        triangle_fields={"kind": [10, 20]},
        crs="EPSG:32632",
    )


def stations(x: Any, y: Any, crs: Any = 32632) -> Any:
    return geopandas.GeoDataFrame(
        {"name": [f"s{k}" for k in range(len(x))]},
        geometry=geopandas.points_from_xy(x, y),
        crs=crs,
        index=[f"row {k}" for k in range(len(x))],
    )


def test_locate(mesh: meshwalk.Mesh) -> None:
    points = stations([3, 9, 1, np.nan], [1, 9, 3, np.nan])
    points.loc["row 3", "geometry"] = None
    found = meshwalk.geopandas.locate(points, mesh)
    assert found.index.tolist() == points.index.tolist()
    assert found.crs == points.crs
    assert found.columns.tolist() == ["name", "geometry", "triangle", "where", "depth", "kind"]
    assert found.triangle.tolist() == [0, -1, 1, -1]
    np.testing.assert_array_equal(found.depth, [4, np.nan, 4, np.nan])
    np.testing.assert_array_equal(found.kind, [10, np.nan, 20, np.nan])
    series = meshwalk.geopandas.locate(points.geometry, meshwalk.Locator(mesh))
    assert series.triangle.tolist() == [0, -1, 1, -1]
    with pytest.raises(ValueError, match="column 'kind' already"):
        meshwalk.geopandas.locate(points.assign(kind=1), mesh)
    lines = points.copy()
    lines.loc["row 1", "geometry"] = shapely.LineString([(0, 0), (1, 1)])
    with pytest.raises(ValueError, match="'row 1' is a LineString, not a Point"):
        meshwalk.geopandas.locate(lines, mesh)
    with pytest.raises(TypeError, match="not DataFrame"):
        meshwalk.geopandas.locate(points.drop(columns="geometry"), mesh)


def test_coordinate_systems_are_checked(mesh: meshwalk.Mesh) -> None:
    points = stations([3], [1])
    with pytest.raises(ValueError, match=r"points are in WGS 84, the mesh is in .* 32N.*to_crs"):
        meshwalk.geopandas.locate(points.to_crs(4326), mesh)
    with pytest.raises(ValueError, match="to_crs"):
        meshwalk.geopandas.sjoin(points.to_crs(32633), mesh)
    mesh.crs = points.crs.to_wkt()  # the same in other words
    assert len(meshwalk.geopandas.sjoin(points, mesh)) == 1
    with pytest.warns(UserWarning, match="points have no coordinate system"):
        meshwalk.geopandas.sjoin(stations([3], [1], None), mesh)
    mesh.crs = None
    with pytest.warns(UserWarning, match="mesh have no coordinate system"):
        meshwalk.geopandas.locate(points, mesh)
    assert len(meshwalk.geopandas.locate(stations([3], [1], None), mesh)) == 1
    with pytest.warns(UserWarning, match="CRS mismatch"):
        meshwalk.geopandas.sjoin(points, meshwalk.geopandas.triangles(mesh))


@pytest.mark.parametrize("how", ["inner", "left"])
def test_join_with_a_mesh_is_one_with_its_triangles(
    mesh: meshwalk.Mesh, how: str, random: np.random.Generator
) -> None:
    points = stations(*(6 * random.random((2, 300)) - 1)).assign(kind="x")
    ours = meshwalk.geopandas.sjoin(points, mesh, how)
    theirs = geopandas.sjoin(points, meshwalk.geopandas.triangles(mesh), how)
    assert ours.index.tolist() == theirs.index.tolist()
    assert set(ours.columns) == set(theirs.columns) > {"index_right", "kind_left", "kind_right"}
    for name in ("index_right", "kind_right"):
        np.testing.assert_array_equal(ours[name], theirs[name])
    assert ours.crs == theirs.crs
    for wrong in ({"how": "right"}, {"predicate": "touches"}):
        with pytest.raises(ValueError, match="with a mesh"):
            meshwalk.geopandas.sjoin(points, mesh, **wrong)
    with pytest.raises(TypeError, match="distance"):
        meshwalk.geopandas.sjoin(points, mesh, distance=3)
    with pytest.raises(ValueError, match="index_right"):
        meshwalk.geopandas.sjoin(points.assign(index_right=1), mesh)


def test_meshes_as_frames(scattered: meshwalk.Mesh, random: np.random.Generator) -> None:
    count = len(scattered)
    given = meshwalk.Mesh(
        scattered.points,
        scattered.triangles,
        {"z": random.random(len(scattered.points))},
        triangle_fields={"soil": np.arange(count)},
        crs="EPSG:2056",
    )
    frame, corners = meshwalk.geopandas.triangles(given), meshwalk.geopandas.vertices(given)
    assert (len(frame), len(corners)) == (count, len(given.points))
    np.testing.assert_array_equal(corners["z"], given.fields["z"])
    back = meshwalk.geopandas.mesh(frame.assign(name="text"))
    np.testing.assert_array_equal(back.points[back.triangles], given.points[given.triangles])
    np.testing.assert_array_equal(back.triangle_fields["soil"], np.arange(count))
    assert list(back.triangle_fields) == ["soil"]
    assert geopandas.GeoSeries([], crs=back.crs).crs == "EPSG:2056"
    high = geopandas.GeoSeries(shapely.polygons([[[0, 0, 5], [4, 0, 6], [0, 4, 7]]]))
    assert sorted(meshwalk.geopandas.mesh(high).fields["z"]) == [5, 6, 7]
    torn = geopandas.GeoSeries(
        shapely.polygons([[[0, 0, 5], [4, 0, 6], [0, 4, 7]], [[0, 0, 4], [0, 4, 7], [-4, 0, 1]]])
    )
    with pytest.raises(ValueError, match=r"0\.0, 0\.0 has two heights"):
        meshwalk.geopandas.mesh(torn)
    with pytest.raises(ValueError, match="at 1 is no triangle"):
        meshwalk.geopandas.mesh(geopandas.GeoSeries([high[0], shapely.box(0, 0, 1, 1)]))


# --- their own tests ------------------------------------------------------------------------------

DROP_IN = """
import shapely, shapely.strtree, meshwalk.shapely
shapely.STRtree = shapely.strtree.STRtree = meshwalk.shapely.STRtree
"""
FRAMES = """
import geopandas, geopandas.tools, meshwalk.geopandas
geopandas.sjoin = geopandas.tools.sjoin = meshwalk.geopandas.sjoin
"""


@pytest.mark.parametrize(
    ("peer", "files", "plugin", "least"),
    [
        ("shapely", ["tests/test_strtree.py", "tests/common.py"], DROP_IN, 700),
        (
            "geopandas",
            ["tools/tests/test_sjoin.py", "tests/test_sindex.py", "conftest.py"],
            DROP_IN + FRAMES,
            400,
        ),
    ],
)
def test_the_originals_own_tests(
    tmp_path: Path, peer: str, files: list[str], plugin: str, least: int
) -> None:
    spec = find_spec(peer)
    assert spec is not None
    assert spec.origin is not None
    for file in files:
        source = Path(spec.origin).parent / file
        if not source.exists():
            pytest.skip(f"{peer} was installed without its tests")
        shutil.copy(source, tmp_path)
    work = tmp_path / "work"
    work.mkdir()
    tests = [Path(file).name for file in files if Path(file).name.startswith("test_")]
    run_their_tests(tmp_path, tests, plugin, "test", least, work)


def test_the_page() -> None:
    run_page(PAGES / "geopandas.md")
