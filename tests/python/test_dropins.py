"""The drop-ins for matplotlib and SciPy: against exact answers, and by the originals' own tests."""

from __future__ import annotations

import pickle
import shutil
import subprocess
import sys
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING, Any

import matplotlib.tri as mtri
import numpy as np
import pytest
import scipy.interpolate
import scipy.spatial
from conftest import oracle

import meshwalk
from meshwalk.matplotlib import LinearTriInterpolator, TriFinder
from meshwalk.scipy import Delaunay, LinearNDInterpolator, tsearch

if TYPE_CHECKING:
    from numpy.typing import NDArray


def near_edges(points: NDArray[Any], triangles: NDArray[Any]) -> NDArray[Any]:
    """Vertices, and rounded middles of edges."""
    ends = points[triangles]
    return np.concatenate([points, ((ends + np.roll(ends, 1, axis=1)) / 2).reshape(-1, 2)])


# --- matplotlib -----------------------------------------------------------------------------------


def test_finder_is_exact(scattered: meshwalk.Mesh, random: np.random.Generator) -> None:
    points = scattered.points * 0.1 + 1e-3 * random.random(scattered.points.shape)
    triangulation = mtri.Triangulation(points[:, 0], points[:, 1], scattered.triangles)
    mesh = meshwalk.Mesh(points, scattered.triangles)
    queries = near_edges(points, scattered.triangles)
    found = TriFinder(triangulation)(queries[:, 0], queries[:, 1])
    assert found.tolist() == [oracle(mesh, q) for q in queries]


def test_finder_is_exact_where_the_original_is_not(random: np.random.Generator) -> None:
    points = np.column_stack([np.linspace(0, 1, 60), 1e-13 * random.random(60)])
    mesh = meshwalk.delaunay(points)
    triangulation = mtri.Triangulation(points[:, 0], points[:, 1], mesh.triangles)
    queries = near_edges(points, mesh.triangles)[60:]
    truth = [oracle(mesh, q) for q in queries]
    x, y = queries.T
    assert TriFinder(triangulation)(x, y).tolist() == truth
    wrong = [
        t >= 0 and oracle(meshwalk.Mesh(points, mesh.triangles[[t]]), q) < 0
        for t, q in zip(triangulation.get_trifinder()(x, y), queries, strict=True)
    ]
    assert sum(wrong) > 3, "matplotlib has them right now: the page on drop-ins says otherwise"


def test_finder_honours_masks() -> None:
    triangulation = mtri.Triangulation([0, 4, 4, 0], [0, 0, 4, 4], [[0, 1, 2], [0, 2, 3]])
    finder = TriFinder(triangulation)
    assert finder([2.0], [2.0]).tolist() == [0]
    mask = np.array([True, False])
    triangulation.set_mask(mask)
    assert finder([[3.0, 2.0]], [[1.0, 2.0]]).tolist() == [[-1, 1]]
    mask[:] = True
    triangulation.set_mask(mask)
    assert finder(2.0, 2.0) == -1
    triangulation.set_mask(None)
    assert finder([2.0], [2.0]).tolist() == [0]
    assert finder == TriFinder(triangulation)
    assert hash(finder) == hash(TriFinder(triangulation))
    other = mtri.Triangulation([0, 4, 4, 0], [0, 0, 4, 4], [[0, 1, 2], [0, 2, 3]])
    assert finder != TriFinder(other)


def test_finder_refuses() -> None:
    overlapping = mtri.Triangulation([0, 4, 0, 4], [0, 0, 4, 4], [[0, 1, 2], [0, 1, 3]])
    with pytest.raises(RuntimeError, match="the triangulation is invalid: triangle 0"):
        TriFinder(overlapping)
    with pytest.raises(TypeError):
        TriFinder([[0, 1, 2]])
    good = mtri.Triangulation([0, 4, 0], [0, 0, 4], [[0, 1, 2]])
    with pytest.raises(ValueError, match="same shape"):
        TriFinder(good)([0, 1], [0])


def test_linear_interpolator_of_matplotlib(random: np.random.Generator) -> None:
    x, y = random.random((2, 300))
    triangulation, z = mtri.Triangulation(x, y), random.random(300)
    at = random.random((2, 50, 20))
    ours = LinearTriInterpolator(triangulation, z)(*at)
    theirs = mtri.LinearTriInterpolator(triangulation, z)(*at)
    np.testing.assert_array_equal(ours.mask, theirs.mask)
    np.testing.assert_allclose(ours, theirs, rtol=1e-12)


# --- SciPy ----------------------------------------------------------------------------------------


def test_delaunay_has_what_scipy_has(random: np.random.Generator) -> None:
    points = random.random((500, 2))
    ours, theirs = Delaunay(points), scipy.spatial.Delaunay(points)
    order = np.lexsort(np.sort(ours.simplices, axis=1).T)
    wanted = np.lexsort(np.sort(theirs.simplices, axis=1).T)
    np.testing.assert_array_equal(
        np.sort(ours.simplices[order], axis=1), np.sort(theirs.simplices[wanted], axis=1)
    )
    for t, row in enumerate(ours.neighbors):
        for corner, other in enumerate(row):
            rest = set(ours.simplices[t]) - {ours.simplices[t, corner]}
            assert other < 0 or rest < set(ours.simplices[other])
    queries = random.random((1000, 2)) * 1.2 - 0.1
    np.testing.assert_array_equal(
        ours.find_simplex(queries) >= 0, theirs.find_simplex(queries) >= 0
    )
    triangle = ours.find_simplex(queries)
    inside = triangle >= 0
    matrix = ours.transform[triangle[inside]]
    weights = np.einsum("ijk,ik->ij", matrix[:, :2], queries[inside] - matrix[:, 2])
    assert weights.min() > -1e-9
    assert weights.sum(axis=1).max() < 1 + 1e-9
    hull = {tuple(sorted(edge)) for edge in ours.convex_hull.tolist()}
    assert hull == {tuple(sorted(edge)) for edge in theirs.convex_hull.tolist()}
    np.testing.assert_array_equal(ours.vertex_to_simplex >= 0, True)
    np.testing.assert_array_equal(tsearch(ours, queries), triangle)


def test_find_simplex_is_exact(random: np.random.Generator) -> None:
    points = np.column_stack([np.linspace(0, 1, 60), 1e-13 * random.random(60)])
    ours, theirs = Delaunay(points), scipy.spatial.Delaunay(points)
    queries = near_edges(points, ours.simplices)
    truth = [oracle(meshwalk.Mesh(points, ours.simplices), q) for q in queries]
    assert ours.find_simplex(queries, tol=0).tolist() == truth
    lost = (theirs.find_simplex(queries) < 0) & (np.array(truth) >= 0)
    assert lost.sum() > 3, "SciPy finds them now: the page on drop-ins says otherwise"


def test_tolerance_of_scipy() -> None:
    triangles = Delaunay([[0, 0], [1, 0], [0, 1]])
    outside = [0.5, -1e-15]
    assert triangles.find_simplex(outside) == 0
    assert triangles.find_simplex(outside, tol=0) == -1
    assert triangles.find_simplex([0.5, -1e-3]) == -1
    assert triangles.find_simplex([0.5, -1e-3], tol=1e-2) == 0
    assert LinearNDInterpolator(triangles, [0, 1, 0])(outside) == pytest.approx(0.5)
    assert triangles.find_simplex(np.full((2, 3, 2), np.nan)).tolist() == [[-1] * 3] * 2


def test_delaunay_refuses() -> None:
    with pytest.raises(ValueError, match="2 coordinates, not 3"):
        Delaunay(np.zeros((4, 3)))
    with pytest.raises(ValueError, match="Qhull's"):
        Delaunay([[0, 0], [1, 0], [0, 1]], qhull_options="QJ")
    with pytest.raises(scipy.spatial.QhullError, match="line"):
        Delaunay([[0, 0], [1, 1], [2, 2]])
    triangles = Delaunay([[0, 0], [1, 0], [0, 1]], incremental=True)
    assert triangles.transform.shape == (1, 3, 2)
    triangles.add_points([[1, 1]])
    assert triangles.transform.shape == (2, 3, 2)
    triangles.close()
    with pytest.raises(RuntimeError, match="incremental"):
        triangles.add_points([[2, 2]])
    with pytest.raises(ValueError, match="2 columns"):
        triangles.find_simplex([1, 2, 3])


@pytest.mark.parametrize("shape", [(), (3,), (2, 2)])
@pytest.mark.parametrize("kind", [np.float32, np.int64, np.complex128])
def test_linear_interpolator_of_scipy(
    random: np.random.Generator, shape: tuple[int, ...], kind: type
) -> None:
    points = random.random((200, 2)) * [1, 50]
    values: NDArray[Any] = (random.random((200, *shape)) * 100).astype(kind)
    if kind is np.complex128:
        values = values + 1j * values[::-1]
    x, y = random.random((4, 5)), 50 * random.random((4, 5))
    for rescale in (False, True):
        ours = LinearNDInterpolator(points, values, fill_value=-7, rescale=rescale)
        theirs = scipy.interpolate.LinearNDInterpolator(points, values, -7, rescale)
        assert ours(x, y).dtype == theirs(x, y).dtype
        np.testing.assert_allclose(ours(x, y), theirs(x, y), rtol=1e-9)
        np.testing.assert_array_equal(pickle.loads(pickle.dumps(ours))(x, y), ours(x, y))
    given = LinearNDInterpolator(scipy.spatial.Delaunay(points), values)
    np.testing.assert_allclose(
        given((x, y)), LinearNDInterpolator(Delaunay(points), values)((x, y)), rtol=1e-9
    )
    with pytest.raises(ValueError, match="a row for each of the 200 points"):
        LinearNDInterpolator(points, values[1:])


# --- their own tests ------------------------------------------------------------------------------

# What SciPy's tests want of Qhull and not of a Delaunay triangulation: its order of triangles and
# corners, which diagonal of a square it takes, its options, more dimensions, and how many of its
# triangles are flat.
OF_QHULL = (
    "(TestUtilities and test_find_simplex) or test_convex_hull or test_2d_square or test_joggle "
    "or test_furthest_site or test_nd_simplex or test_degenerate_barycentric "
    "or test_more_barycentric or 3d or 4d or 5d or 6d or 7d or 8d or some-points or test_volume "
    "or test_random_volume or test_incremental_vol"
)
DROP_INS = {
    "matplotlib": """
import matplotlib.tri._trifinder as finders
import meshwalk.matplotlib
finders.TrapezoidMapTriFinder = meshwalk.matplotlib.TriFinder
""",
    "scipy": """
import scipy.interpolate._interpnd as interpolators, scipy.spatial._qhull as qhull
import meshwalk.scipy
qhull.Delaunay, qhull.tsearch = meshwalk.scipy.Delaunay, meshwalk.scipy.tsearch
interpolators.LinearNDInterpolator = meshwalk.scipy.LinearNDInterpolator
""",
}
THEIR_TESTS = [
    # The pictures that the others are compared with are in no wheel.
    ("matplotlib", "matplotlib/tests/test_triangulation.py", "not png", 40),
    (
        "scipy",
        "scipy/spatial/tests/test_qhull.py",
        "(TestDelaunay or TestVertexNeighbor or TestUtilities or find_simplex_ndim or 21286)"
        f" and not ({OF_QHULL})",
        15,
    ),
    (
        "scipy",
        "scipy/interpolate/tests/test_interpnd.py",
        "TestLinearND and not test_square",
        9,
    ),
]


@pytest.mark.parametrize(("peer", "file", "choice", "least"), THEIR_TESTS)
def test_the_originals_own_tests(
    tmp_path: Path, peer: str, file: str, choice: str, least: int
) -> None:
    spec = find_spec(peer)
    assert spec is not None
    assert spec.origin is not None
    source = Path(spec.origin).parents[1] / file
    if not source.exists():
        pytest.skip(f"{peer} was installed without its tests")
    shutil.copy(source, tmp_path)
    (tmp_path / "drop_in.py").write_text(DROP_INS[peer])
    plugins = ["-p", "drop_in", "-p", "no:cacheprovider"]
    if peer == "matplotlib":
        plugins += ["-p", "matplotlib.testing.conftest"]
    ran = subprocess.run(
        [sys.executable, "-m", "pytest", "-q", *plugins, "-k", choice, source.name],
        cwd=tmp_path,
        env={"PYTHONPATH": str(tmp_path), "MPLBACKEND": "agg", "PATH": "/usr/bin:/bin"},
        capture_output=True,
        text=True,
        check=False,
    )
    assert ran.returncode == 0, ran.stdout[-3000:]
    passed = int(ran.stdout.rsplit(" passed", 1)[0].split()[-1])
    assert passed >= least, ran.stdout[-500:]
