"""`meshwalk.trimesh`: against exact fractions and trimesh, and in the tests of trimesh."""

from __future__ import annotations

import copy
import gzip
import io
import os
import pickle
import shutil
from fractions import Fraction
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest
from conftest import NOT_HERE, PAGES, run_page
from originals import run_their_tests, sources

import meshwalk.trimesh

if TYPE_CHECKING:
    from numpy.typing import NDArray

trimesh = pytest.importorskip("trimesh", reason=f"trimesh {NOT_HERE}")
RayIntersector = meshwalk.trimesh.RayIntersector


def _exact(rows: Any) -> list[list[Fraction]]:
    return [[Fraction(float(v)) for v in row] for row in rows]


def _minus(a: list[Fraction], b: list[Fraction]) -> list[Fraction]:
    return [u - v for u, v in zip(a, b, strict=True)]


def _cross(a: list[Fraction], b: list[Fraction]) -> list[Fraction]:
    return [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]


def _dot(a: list[Fraction], b: list[Fraction]) -> Fraction:
    return sum((u * v for u, v in zip(a, b, strict=True)), Fraction(0))


def _near(mesh: Any, origin: Any, direction: Any) -> NDArray[Any]:
    """The triangles that a line may meet: doubles, with room for their errors, rule out others."""
    corners = np.asarray(mesh.triangles) - origin
    sides = np.stack(
        [np.cross(corners[:, k], corners[:, (k + 1) % 3]) @ direction for k in range(3)], axis=1
    )
    room = 1e-9 * np.abs(corners).max() ** 2 * np.abs(direction).max()
    return np.flatnonzero(~((sides < -room).any(axis=1) & (sides > room).any(axis=1)))


def exact_hits(mesh: Any, origin: Any, direction: Any) -> list[tuple[Fraction, int]]:
    """All triangles that a ray meets, in order: how far along it, and which."""
    (q, m), hits = _exact([origin, direction]), []
    for number in _near(mesh, origin, direction).tolist():
        a, b, c = _exact(mesh.triangles[number])
        sides = [_dot(m, _cross(_minus(u, q), _minus(v, q))) for u, v in ((a, b), (b, c), (c, a))]
        if all(s == 0 for s in sides) or (min(sides) < 0 < max(sides)):
            continue
        normal = _cross(_minus(b, a), _minus(c, a))
        along = _dot(normal, _minus(a, q)) / _dot(normal, m)
        if along >= 0:
            hits.append((along, number))
    return sorted(hits)


def lattice_rays(random: np.random.Generator, n: int) -> tuple[NDArray[Any], NDArray[Any]]:
    """Rays with small numbers, many of which meet edges and vertices of boxes."""
    directions = random.integers(-2, 3, (n, 3)).astype(float)
    directions[~directions.any(axis=1)] = 1
    return random.integers(-6, 7, (n, 3)) / 4, directions


@pytest.fixture
def boxes() -> Any:
    """A box round another one, and one beside them, with vertices on a lattice."""
    outer = trimesh.creation.box(extents=[2, 2, 2]).subdivide()
    inner = trimesh.creation.box(extents=[1, 1, 1])
    inner.invert()
    beside = trimesh.creation.box(extents=[0.5, 0.5, 0.5])
    beside.apply_translation([1.25, 0, 0])
    return trimesh.util.concatenate([outer, inner, beside])


def test_all_hits_are_exact(boxes: Any, random: np.random.Generator) -> None:
    origins, directions = lattice_rays(random, 150)
    every = RayIntersector(boxes, edges="all")
    once = RayIntersector(boxes)
    index_tri, index_ray = every.intersects_id(origins, directions)
    locations, ray_of_place, tri_of_place = once.intersects_location(origins, directions)
    first = once.intersects_first(origins, directions)
    some = once.intersects_any(origins, directions)
    several = 0
    for i in range(len(origins)):
        hits = exact_hits(boxes, origins[i], directions[i])
        assert index_tri[index_ray == i].tolist() == [t for _, t in hits]
        places = [hit for k, hit in enumerate(hits) if k == 0 or hits[k - 1][0] != hit[0]]
        assert tri_of_place[ray_of_place == i].tolist() == [t for _, t in places]
        at = np.array([origins[i] + float(along) * directions[i] for along, _ in places])
        np.testing.assert_allclose(locations[ray_of_place == i], at.reshape(-1, 3), atol=1e-14)
        assert first[i] == (hits[0][1] if hits else -1)
        assert some[i] == bool(hits)
        several += len(hits) > len(places)
    assert several > 20


def test_sides_and_counts(boxes: Any, random: np.random.Generator) -> None:
    origins, directions = lattice_rays(random, 300)
    tri, ray = RayIntersector(boxes, edges="all").intersects_id(origins, directions)
    corners = np.asarray(boxes.triangles[tri])
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    behind = (normals * directions[ray]).sum(axis=1) > 0
    for faces, wanted in (("front", ~behind), ("back", behind)):
        one_sided = RayIntersector(boxes, edges="all", faces=faces)  # type: ignore[arg-type]
        np.testing.assert_array_equal(one_sided.intersects_id(origins, directions)[0], tri[wanted])
        hit = one_sided.intersects_any(origins, directions)
        np.testing.assert_array_equal(np.flatnonzero(hit), np.unique(ray[wanted]))
        first = one_sided.intersects_first(origins, directions)
        np.testing.assert_array_equal(first >= 0, hit)
    both = RayIntersector(boxes, threads=2)
    everything = both.intersects_id(origins, directions, return_locations=True)
    for most in (1, 2):
        some: Any = both.intersects_id(origins, directions, True, most, True)
        kept = [np.flatnonzero(everything[1] == i)[:most] for i in range(len(origins))]
        for part, whole in zip(some, everything, strict=True):
            np.testing.assert_array_equal(part, whole[np.concatenate(kept)])
    one: Any = both.intersects_id(origins, directions, multiple_hits=False, return_locations=True)
    np.testing.assert_array_equal(one[0], both.intersects_first(origins, directions)[one[1]])
    np.testing.assert_allclose(one[2], both.intersects_id(origins, directions, True, 1, True)[2])


def test_inside_is_exact(boxes: Any, random: np.random.Generator) -> None:
    boxes.ray = RayIntersector(boxes)
    points = random.integers(-7, 8, (4000, 3)) / 4
    far = np.abs(points).max(axis=1)
    beside = (np.abs(points - [1.25, 0, 0]) < 0.25).all(axis=1)
    # In two pieces means in none; the surface is outside.
    shell = (far < 1) & (far > 0.5)
    on = ((np.abs(points - [1.25, 0, 0]) <= 0.25).all(axis=1) & ~beside) | (far == 1) | (far == 0.5)
    np.testing.assert_array_equal(boxes.contains(points), (shell ^ beside) & ~on)
    # With corners of its own for each triangle, as in a file of STL.
    faces = np.arange(3 * len(boxes.faces)).reshape(-1, 3)
    torn = trimesh.Trimesh(boxes.triangles.reshape(-1, 3), faces, process=False)
    assert not torn.is_watertight
    torn.ray = RayIntersector(torn)
    np.testing.assert_array_equal(torn.contains(points), boxes.contains(points))


def test_open_meshes_by_the_rule_of_trimesh() -> None:
    bowl = trimesh.creation.icosphere(subdivisions=3)
    bowl.update_faces(bowl.triangles_center[:, 2] < 0.9)
    intersector = RayIntersector(bowl)
    points = np.array([[0, 0, 0], [0.3, 0.2, -0.1], [0, 0, -3]])
    bowl.ray = intersector
    assert bowl.contains(points).tolist() == [True, True, False]


@pytest.mark.parametrize("thickness", [1e-7, 1e-9])
def test_plates_that_the_original_does_not_see(
    thickness: float, random: np.random.Generator
) -> None:
    plate = trimesh.creation.box(extents=[1, 1, thickness]).subdivide().subdivide()
    origins = np.column_stack([random.uniform(-0.49, 0.49, (200, 2)), np.ones(200)])
    down = np.tile([0.0, 0.0, -1.0], (200, 1))
    points = np.column_stack([origins[:, :2], random.uniform(-thickness, thickness, 200)])
    truth = np.abs(points[:, 2]) < thickness / 2

    def wrong(intersector: Any) -> tuple[int, int]:
        ray = intersector.intersects_location(origins, down)[1]
        inside = intersector.contains_points(points)
        return int((np.bincount(ray, minlength=200) != 2).sum()), int((inside != truth).sum())

    assert wrong(RayIntersector(plate)) == (0, 0)
    theirs = trimesh.ray.ray_triangle.RayMeshIntersector(plate)
    assert sum(wrong(theirs)) > 3, "trimesh sees it now: the page says otherwise"
    embree = pytest.importorskip("trimesh.ray.ray_pyembree").RayMeshIntersector(plate)
    assert wrong(embree)[0] > 100, "embreex sees it now: the page says otherwise"


def test_it_follows_the_mesh() -> None:
    mesh = trimesh.creation.box()
    mesh.ray = RayIntersector(mesh)
    up = [[0.1, 0.2, -50]], [[0, 0, 1]]
    assert mesh.ray.intersects_location(*up)[0][:, 2].tolist() == [-0.5, 0.5]
    mesh.apply_scale(2)
    assert mesh.ray.intersects_location(*up)[0][:, 2].tolist() == [-1, 1]
    assert mesh.contains([[0.9, 0.9, 0.9]]).tolist() == [True]
    mesh.vertices[:, 2] += 7
    assert mesh.ray.intersects_location(*up)[0][:, 2].tolist() == [6, 8]
    assert mesh.contains([[0.9, 0.9, 0.9], [0, 0, 7]]).tolist() == [False, True]
    mesh.update_faces(np.zeros(len(mesh.faces), bool))
    assert mesh.ray.prober is None
    assert [part.shape for part in mesh.ray.intersects_location(*up)] == [(0, 3), (0,), (0,)]
    assert [part.shape for part in mesh.ray.intersects_id(*up)] == [(0,), (0,)]
    assert not mesh.contains([[0, 0, 0]]).any()
    assert mesh.ray.intersects_first(*up).tolist() == [-1]
    assert mesh.ray.intersects_any(*up).tolist() == [False]


def test_copies_and_refusals() -> None:
    mesh = trimesh.creation.box()
    intersector = RayIntersector(mesh, faces="back", edges="all", threads=1)
    up = [[0.1, 0.2, -50]], [[0, 0, 1]]
    for other in (copy.copy(intersector), copy.deepcopy(intersector)):
        assert other.mesh is mesh
        assert other.intersects_location(*up)[0][:, 2].tolist() == [0.5]
    restored = pickle.loads(pickle.dumps(intersector))
    assert restored.intersects_location(*up)[0][:, 2].tolist() == [0.5]
    with pytest.raises(ValueError, match="don't match"):
        intersector.intersects_any([[0, 0, 1]], [[0, 0, 1], [0, 0, 1]])
    with pytest.raises(ValueError, match=r"\(n, 3\), not \(3,\)"):
        intersector.intersects_any([0, 0, 1], [0, 0, 1])
    with pytest.raises(ValueError, match="points must be"):
        intersector.contains_points([0, 0, 1])
    wrong: Any
    for wrong in ({"faces": "left"}, {"edges": "twice"}):
        with pytest.raises(ValueError, match="must be"):
            RayIntersector(mesh, **wrong)
    bad: Any = [[0, 0, -5], [np.nan, 0, 0]], [[0, 0, 0], [0, 0, 1]]
    assert intersector.intersects_any(*bad).tolist() == [False, False]
    assert intersector.intersects_first(*bad).tolist() == [-1, -1]


def test_beside_the_original(random: np.random.Generator) -> None:
    """Rays in general position hit the same; what trimesh makes of rays is the same."""
    mesh = trimesh.creation.torus(2, 0.7)
    origins, directions = random.normal(size=(2, 400, 3)) * 3
    theirs, ours = trimesh.ray.ray_triangle.RayMeshIntersector(mesh), RayIntersector(mesh)
    pairs = []
    for intersector in (theirs, ours):
        found = intersector.intersects_id(origins, directions)
        assert [part.dtype for part in found] == [np.int64, np.int64]
        pairs.append(sorted(np.stack(found, axis=1).tolist()))
    assert pairs[0] == pairs[1]
    np.testing.assert_array_equal(
        theirs.intersects_first(origins, directions), ours.intersects_first(origins, directions)
    )
    distances = trimesh.proximity.signed_distance(mesh, origins)
    longest = trimesh.proximity.longest_ray(mesh, origins, directions)
    mesh.ray = ours
    np.testing.assert_allclose(trimesh.proximity.signed_distance(mesh, origins), distances)
    np.testing.assert_allclose(trimesh.proximity.longest_ray(mesh, origins, directions), longest)


@pytest.mark.parametrize("name", ["surface/anchor_dense.off", "cad/gears.stl", "surface/cow.off"])
def test_real_models(name: str, random: np.random.Generator) -> None:
    """Where trimesh counts other hits, or another side, fractions say that it is wrong."""
    path = Path(os.environ["MW_SOURCE"]).parent / "shared" / "data" / f"{name}.gz"
    if not path.exists():
        pytest.skip(f"there is no {path}")
    embree = pytest.importorskip("trimesh.ray.ray_pyembree", reason=f"embreex {NOT_HERE}")
    file = io.BytesIO(gzip.decompress(path.read_bytes()))
    mesh = trimesh.load(file, file_type=path.suffixes[-2][1:], force="mesh")
    ours, theirs, count = RayIntersector(mesh), embree.RayMeshIntersector(mesh), 800
    # Rays at the middles of edges, and points beside the middles of faces.
    middles = mesh.vertices[mesh.edges_unique].mean(axis=1)
    origins = mesh.bounds.mean(axis=0) + mesh.scale * random.normal(size=(count, 3))
    directions = middles[random.integers(0, len(middles), count)] - origins
    hits = [
        np.bincount(intersector.intersects_location(origins, directions)[1], minlength=count)
        for intersector in (ours, theirs)
    ]
    differ = np.flatnonzero(hits[0] != hits[1])
    assert len(differ) > 3, "embreex counts right now: the page says otherwise"
    for i in differ[:40]:
        places = {along for along, _ in exact_hits(mesh, origins[i], directions[i])}
        assert hits[0][i] == len(places)
    beside = mesh.triangles_center[random.integers(0, len(mesh.faces), count)]
    points = beside + 1e-7 * mesh.scale * random.normal(size=(count, 3))
    inside, other = ours.contains_points(points), theirs.contains_points(points)
    for i in np.flatnonzero(inside != other)[:40]:
        # In a direction that meets no edge.
        assert inside[i] == len(exact_hits(mesh, points[i], random.normal(size=3))) % 2


# --- its own tests --------------------------------------------------------------------------------

# The source archive has the tests, but neither the models nor the module that loads them. These
# stand for the models: a cube and a sphere are what their names say.
GENERIC = """
import logging, time
import numpy as np
import trimesh
log = logging.getLogger("trimesh")
random = np.random.default_rng(0).random
MADE = {
    "unit_cube.STL": lambda: trimesh.creation.box(),
    "unit_sphere.STL": lambda: trimesh.creation.icosphere(radius=0.5),
    "featuretype.STL": lambda: trimesh.creation.annulus(1, 2, 0.5),
}
def get_mesh(name, **options):
    if name not in MADE:
        import pytest
        pytest.skip(f"there is no {name}")
    return MADE[name]()
"""
DROP_IN = """
import meshwalk.trimesh
from trimesh.ray import ray_pyembree, ray_triangle
ray_pyembree.RayMeshIntersector = meshwalk.trimesh.RayIntersector
ray_triangle.RayMeshIntersector = meshwalk.trimesh.RayIntersector
"""
# test_rays reads all models.


def test_the_originals_own_tests(tmp_path: Path) -> None:
    for peer in ("trimesh.ray.ray_pyembree", "manifold3d"):
        pytest.importorskip(peer, reason=f"{peer} {NOT_HERE}")
    tests, work = tmp_path / "tests", tmp_path / "work"
    shutil.copytree(sources("trimesh") / "tests", tests)
    work.mkdir()
    (tests / "generic.py").write_text(GENERIC)
    run_their_tests(
        tests, ["test_ray.py", "test_ray_upstream.py"], DROP_IN, "not test_rays", 12, work
    )


def test_the_page() -> None:
    pytest.importorskip("trimesh.ray.ray_pyembree", reason=f"embreex {NOT_HERE}")
    run_page(PAGES / "trimesh.md")
