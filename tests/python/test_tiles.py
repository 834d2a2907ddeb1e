"""Meshes in tiles: every bit as in the whole mesh; what is missing, damaged or odd."""

from __future__ import annotations

import json
import os
import pickle
import shutil
import subprocess
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from conftest import ring_arrays
from numpy.typing import NDArray

import meshwalk

Random = np.random.Generator


def _queries(mesh: meshwalk.Mesh, random: Random) -> NDArray[np.float64]:
    """Points around the mesh, its vertices, middles of edges, points that are none."""
    points, triangles = mesh.points, mesh.triangles
    low, high = points.min(axis=0), points.max(axis=0)
    around = random.uniform(low - (high - low) / 4, high + (high - low) / 4, (4000, 2))
    middles = points[triangles[:, 0]] / 2 + points[triangles[:, 1]] / 2
    bad = [[np.nan, 0.5], [0.5, np.nan], [np.inf, 0.5]]
    return np.concatenate([around, points, middles, bad])


def _with_flat_triangles(random: Random) -> meshwalk.Mesh:
    """A grid; many of its cells have a flat triangle along the diagonal, others are holes."""
    side = 8
    corners = [[4 * x, 4 * y] for y in range(side + 1) for x in range(side + 1)]
    middles = [[4 * x + 2, 4 * y + 2] for y in range(side) for x in range(side)]
    triangles = []
    for y in range(side):
        for x in range(side):
            a, m = y * (side + 1) + x, len(corners) + y * side + x
            b, c, d = a + 1, a + side + 2, a + side + 1
            kind = random.integers(4)
            if kind > 0:
                triangles += [[a, b, c]]
            if kind > 1:
                triangles += [[a, m, c], [a, m, d], [m, c, d]]
    return meshwalk.Mesh(corners + middles, random.permutation(triangles))


def _meshes(random: Random) -> dict[str, meshwalk.Mesh]:
    points = random.uniform(size=(2000, 2))
    whole = meshwalk.delaunay(points)
    grid = np.unique(random.integers(0, 25, (600, 2)), axis=0)
    small = meshwalk.delaunay(grid)
    mixed = whole.triangles[random.permutation(len(whole))]
    turned = random.uniform(size=len(mixed)) < 0.5
    mixed[turned] = mixed[turned][:, [0, 2, 1]]
    kept = small.triangles[random.uniform(size=len(small)) < 0.7]
    torn = small.points[small.triangles].reshape(-1, 2)
    return {
        "convex": whole,
        "in any order": meshwalk.Mesh(points, mixed),
        "holes": meshwalk.Mesh(points, whole.triangles[random.uniform(size=len(whole)) < 0.8]),
        "holes on a grid": meshwalk.Mesh(grid, kept),
        "not welded": meshwalk.Mesh(torn, np.arange(len(torn)).reshape(-1, 3)),
        "flat triangles": _with_flat_triangles(random),
        "ring": meshwalk.Mesh(*ring_arrays()),
    }


@pytest.mark.parametrize("tiles", [1, 2, 7, 40])
def test_every_bit_is_that_of_the_whole_mesh(tmp_path: Path, random: Random, tiles: int) -> None:
    for name, mesh in _meshes(random).items():
        count = min(tiles, len(mesh))
        meshwalk.prepare_tiles(mesh, tmp_path / name, count)
        parts = meshwalk.Tiles(tmp_path / name)
        assert (parts.tile_count, parts.triangle_count) == (count, len(mesh))
        locator = meshwalk.Locator(mesh, border=True, fill="yes")
        xy = _queries(mesh, random)
        for tolerance in (0.0, float(np.ptp(mesh.points)) / 30):
            wanted, got = locator.locate(xy, tolerance), parts.locate(xy, tolerance)
            assert got.records.tobytes() == wanted.records.tobytes(), name
        values = random.uniform(size=(mesh.vertex_count, 2))
        same = np.testing.assert_array_equal
        same(got.interpolate(values), wanted.interpolate(values))
        soil = np.arange(len(mesh))
        same(got.of_triangles(soil, -1), wanted.of_triangles(soil, -1))
        same(meshwalk.Operator(got) @ values, meshwalk.Operator(wanted) @ values)
        assert (got.operator() != wanted.operator()).nnz == 0


def test_fields(tmp_path: Path, random: Random) -> None:
    points = random.uniform(size=(500, 3))
    triangles = meshwalk.delaunay(points).triangles
    soil = {"soil": np.arange(float(len(triangles)))}
    mesh = meshwalk.Mesh(points, triangles, triangle_fields=soil, crs="EPSG:2056")
    meshwalk.prepare_tiles(meshwalk.Locator(mesh), tmp_path / "t", 5)
    parts = meshwalk.Tiles(tmp_path / "t")
    assert parts.field_names == ["z"]
    assert parts.triangle_field_names == ["soil"]
    assert parts.crs == "EPSG:2056"
    xy = random.uniform(-0.1, 1.1, (10, 20, 2))
    hit, wanted = parts.locate(xy), meshwalk.Locator(mesh).locate(xy)
    assert hit.shape == (10, 20)
    np.testing.assert_array_equal(hit.interpolate("z"), wanted.interpolate("z"))
    np.testing.assert_array_equal(hit[3].of_triangles("soil"), wanted[3].of_triangles("soil"))
    assert np.isnan(parts.locate([[9, 9]]).interpolate("z")).all()
    assert parts.locate(np.empty((0, 2))).interpolate("z").shape == (0,)
    with pytest.raises(KeyError, match="soul"):
        hit.of_triangles("soul")
    with pytest.raises(ValueError, match="500 vertices"):
        hit.interpolate([1, 2])
    with pytest.raises(TypeError, match="ESMF"):
        hit.to_esmf(tmp_path / "w.nc")


def test_the_program_makes_the_same_files(tmp_path: Path, random: Random) -> None:
    points = random.uniform(size=(500, 3))
    triangles = meshwalk.delaunay(points).triangles[40:]
    mesh = meshwalk.Mesh(points, triangles, {"depth": points[:, 1]}, crs="EPSG:2056")
    mesh.write(tmp_path / "mesh.ply")
    meshwalk.prepare_tiles(meshwalk.read(tmp_path / "mesh.ply"), tmp_path / "module", 5)
    program = os.environ["MESHWALK"]
    arguments = ["prepare", "mesh.ply", "--tiles", "5", "-o", "program"]
    subprocess.run([program, *arguments], cwd=tmp_path, check=True)
    names = sorted(path.name for path in (tmp_path / "module").iterdir())
    assert names == sorted(path.name for path in (tmp_path / "program").iterdir())
    assert len(names) == 7
    for name in names:
        assert (tmp_path / "module" / name).read_bytes() == (
            tmp_path / "program" / name
        ).read_bytes()


def test_tiles_are_given_up(tmp_path: Path, random: Random) -> None:
    mesh = meshwalk.delaunay(random.uniform(size=(2000, 2)))
    meshwalk.prepare_tiles(mesh, tmp_path / "t", 8)
    parts = meshwalk.Tiles(tmp_path / "t", memory=1)
    xy = random.uniform(size=(1000, 2))
    wanted = meshwalk.Locator(mesh).locate(xy).triangle
    for _ in range(2):
        np.testing.assert_array_equal(parts.locate(xy).triangle, wanted)
        assert str(Path("/proc/self/maps").read_text()).count(str(tmp_path)) <= 2


def test_only_tiles_near_points_are_mapped(tmp_path: Path, random: Random) -> None:
    mesh = meshwalk.delaunay(random.uniform(size=(2000, 2)))
    meshwalk.prepare_tiles(mesh, tmp_path / "t", 16)
    parts = meshwalk.Tiles(tmp_path / "t")
    parts.locate(random.uniform(0.1, 0.12, (1000, 2)))
    assert str(Path("/proc/self/maps").read_text()).count(str(tmp_path / "t" / "tile-")) <= 4


def test_pickles_are_paths(tmp_path: Path, square: meshwalk.Mesh) -> None:
    meshwalk.prepare_tiles(square, tmp_path / "t", 2)
    parts = meshwalk.Tiles(tmp_path / "t")
    kept = pickle.dumps(parts.locate([[3, 1], [9, 9]]))
    assert pickle.loads(kept).triangle.tolist() == [0, -1]
    shutil.rmtree(tmp_path / "t")
    meshwalk.prepare_tiles(square, tmp_path / "t", 1)
    with pytest.raises(meshwalk.InputError, match="other tiles"):
        pickle.loads(kept)


def test_what_is_refused(tmp_path: Path, square: meshwalk.Mesh) -> None:
    with pytest.raises(ValueError, match="from 1 to 2"):
        meshwalk.prepare_tiles(square, tmp_path / "t", 3)
    with pytest.raises(FileNotFoundError):
        meshwalk.prepare_tiles(square, tmp_path / "none" / "t", 1)
    flat = meshwalk.Mesh([[0, 0], [4, 0], [0, 4], [2, 0]], [[0, 1, 2], [0, 3, 1]])
    with pytest.raises(ValueError, match="2 tiles are more than the 1 triangles with an area"):
        meshwalk.prepare_tiles(flat, tmp_path / "t", 2)
    overlapping = meshwalk.Mesh([[0, 0], [4, 0], [2, 3], [2, 2]], [[0, 1, 2], [0, 1, 3]])
    with pytest.raises(meshwalk.InputError):
        meshwalk.prepare_tiles(overlapping, tmp_path / "t", 1)
    named = meshwalk.Mesh(square.points, square.triangles, {"meshwalk:vertex": np.zeros(4)})
    with pytest.raises(ValueError, match="which tiles need"):
        meshwalk.prepare_tiles(named, tmp_path / "t", 1)

    def stop(stage: str, done: float) -> None:
        if stage == "tiles" and done > 0:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        meshwalk.prepare_tiles(square, tmp_path / "t", 2, progress=stop)
    assert list(tmp_path.iterdir()) == []
    meshwalk.prepare_tiles(square, tmp_path / "t", 2)
    with pytest.raises(FileExistsError, match="remove it first"):
        meshwalk.prepare_tiles(square, tmp_path / "t", 2)


def test_files_that_are_not_what_they_were(tmp_path: Path, square: meshwalk.Mesh) -> None:
    folder = tmp_path / "t"
    meshwalk.prepare_tiles(square, folder, 2)
    xy = [[3, 1], [1, 3]]
    parts = meshwalk.Tiles(folder)
    (folder / "tile-00001.mwm").rename(tmp_path / "kept")
    with pytest.raises(FileNotFoundError, match=r"tile-00001\.mwm: a tile of the mesh is missing"):
        parts.locate(xy)
    shutil.copy(folder / "tile-00000.mwm", folder / "tile-00001.mwm")
    with pytest.raises(meshwalk.InputError, match=r"is not the tile that tiles\.json names"):
        parts.locate(xy)
    changed = bytearray((tmp_path / "kept").read_bytes())
    changed[-70] ^= 1
    (folder / "tile-00001.mwm").write_bytes(changed)
    with pytest.raises(meshwalk.InputError, match="damaged"):
        parts.locate(xy)
    shutil.copy(tmp_path / "kept", folder / "tile-00001.mwm")
    assert parts.locate(xy).triangle.tolist() == [0, 1]
    with pytest.raises(FileNotFoundError):
        meshwalk.Tiles(tmp_path)


def _replaced(index: dict[str, Any], **changes: Any) -> str:
    from meshwalk import _tiling

    changed = {**index, **changes}
    if "checksum" not in changes:
        changed["checksum"] = _tiling._checksum(changed)
    return json.dumps(changed)


def test_a_damaged_index(tmp_path: Path, random: Random) -> None:
    mesh = meshwalk.delaunay(random.uniform(size=(300, 2)))
    meshwalk.prepare_tiles(mesh, tmp_path / "t", 4)
    path = tmp_path / "t" / "tiles.json"
    text = path.read_text()
    index = json.loads(text)
    cuts = index["cuts"]
    for changed, told in [
        (_replaced(index, version=2), "format version 2.*prepare the tiles again"),
        (_replaced(index, format="x"), "no index"),
        (_replaced(index, checksum="00"), "its checksum is wrong"),
        (_replaced(index, cuts=[]), "0 cuts do not make 4 tiles"),
        (_replaced(index, cuts=[[2, *cuts[0][1:]], *cuts[1:]]), "no axis"),
        (_replaced(index, cuts=[[*cuts[0][:3], 0, -1], *cuts[1:]]), "leads nowhere"),
        (_replaced(index, cuts=[[*cuts[0][:3], 1, 1], *cuts[1:]]), "two cuts"),
        (_replaced(index, cuts=[cuts[0][:4], *cuts[1:]]), "damaged"),
        (_replaced(index, checksums=[]), "damaged"),
        (_replaced(index, holes=[[2**40]]), "damaged"),
        ("[" * 100000, "damaged"),
        ("[1, 2]", "damaged"),
        ("\0", "damaged"),
    ]:
        path.write_text(changed)
        with pytest.raises(meshwalk.InputError, match=told):
            meshwalk.Tiles(tmp_path / "t")
    for _ in range(200):
        at, letter = int(random.integers(len(text))), chr(int(random.integers(32, 127)))
        path.write_text(text[:at] + letter + text[at + 1 :])
        if json_equal(path, index):
            continue
        with pytest.raises(meshwalk.InputError):
            meshwalk.Tiles(tmp_path / "t")


def json_equal(path: Path, index: dict[str, Any]) -> bool:
    """Whether a file still says the same."""
    try:
        return bool(json.loads(path.read_text()) == index)
    except ValueError:
        return False
