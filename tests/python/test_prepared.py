"""Prepared meshes: written, mapped, shared, refused."""

from __future__ import annotations

import gc
import multiprocessing
import pickle
import subprocess
from pathlib import Path

import numpy as np
import pytest
from conftest import ring_arrays
from numpy.typing import NDArray

import meshwalk


@pytest.fixture
def prepared(random: np.random.Generator, tmp_path: Path) -> tuple[Path, meshwalk.Locator]:
    points = random.uniform(size=(3000, 3))
    plain = meshwalk.delaunay(points)
    soil = np.arange(float(plain.triangle_count))
    mesh = meshwalk.Mesh(points, plain.triangles, triangle_fields={"soil": soil}, crs="EPSG:2056")
    locator = meshwalk.Locator(mesh, border=True, fill="yes")
    locator.prepare(tmp_path / "mesh.mwm")
    return tmp_path / "mesh.mwm", locator


@pytest.mark.parametrize("trust", [False, True])
def test_answers_are_the_same(
    prepared: tuple[Path, meshwalk.Locator], random: np.random.Generator, trust: bool
) -> None:
    path, locator = prepared
    mapped = meshwalk.map(str(path), trust)
    xy = random.uniform(-0.2, 1.2, (5000, 2))
    expected = locator.locate(xy, 0.01)
    hit = mapped.locate(xy, 0.01)
    assert hit.records.tobytes() == expected.records.tobytes()
    np.testing.assert_array_equal(hit.interpolate("z"), expected.interpolate("z"))
    np.testing.assert_array_equal(hit.of_triangles("soil"), expected.of_triangles("soil"))
    assert mapped.nearest_border(2, 2) == locator.nearest_border(2, 2)
    assert mapped.locate_one(0.5, 0.5).triangle == locator.locate_one(0.5, 0.5).triangle
    np.testing.assert_array_equal(mapped.mesh.points, locator.mesh.points)
    np.testing.assert_array_equal(mapped.mesh.triangles, locator.mesh.triangles)
    assert mapped.mesh.crs == "EPSG:2056"
    assert mapped.mesh.describe() == locator.mesh.describe()
    assert repr(mapped) == repr(locator)
    particles = meshwalk.Cursor(mapped)
    np.testing.assert_array_equal(particles.locate(xy).triangle, locator.locate(xy).triangle)
    with pytest.raises(ValueError, match="read-only"):
        mapped.mesh.fields["z"][0] = 1


def test_as_the_program_writes_it(tmp_path: Path, program: str) -> None:
    mesh = meshwalk.Mesh(*ring_arrays(), {"z": np.arange(8)})
    mesh.write(tmp_path / "ring.ply")
    command = [program, "prepare", "ring.ply", "-o", "ring.mwm"]
    subprocess.run(command, cwd=tmp_path, check=True, capture_output=True)
    mapped = meshwalk.map(tmp_path / "ring.mwm")
    assert mapped.locate_one(3, 3).hole == 0
    assert meshwalk.read(tmp_path / "ring.mwm").fields["z"].tolist() == list(range(8))
    with pytest.raises(ValueError, match="tolerance"):
        mapped.locate([[-1, 3]], tolerance=2)
    with pytest.raises(ValueError, match="border"):
        mapped.nearest_border(-1, 3)


def test_what_is_mapped_lives_on(prepared: tuple[Path, meshwalk.Locator]) -> None:
    path, locator = prepared
    mapped = meshwalk.map(path)
    mesh, heights = mapped.mesh, mapped.mesh.fields["z"]
    path.unlink()
    del mapped
    gc.collect()
    np.testing.assert_array_equal(mesh.points, locator.mesh.points)
    del mesh
    gc.collect()
    np.testing.assert_array_equal(heights, locator.mesh.fields["z"])


def _ask(given: tuple[meshwalk.Locator, NDArray[np.float64]]) -> int:
    locator, xy = given
    return int(locator.locate(xy, threads=1).triangle.sum())


def test_pickles_are_paths(
    prepared: tuple[Path, meshwalk.Locator], random: np.random.Generator
) -> None:
    path, locator = prepared
    mapped = meshwalk.map(path)
    kept = pickle.dumps(mapped)
    assert len(kept) < 1000
    assert len(pickle.dumps(mapped.mesh)) < 1000
    xy = random.uniform(size=(1000, 2))
    with multiprocessing.get_context("spawn").Pool(1) as pool:
        answer = pool.map(_ask, [(mapped, xy)])
    assert answer == [int(locator.locate(xy).triangle.sum())]
    assert len(pickle.loads(pickle.dumps(mapped.mesh))) == len(mapped.mesh)
    meshwalk.Locator(meshwalk.Mesh(*ring_arrays())).prepare(path)
    with pytest.raises(meshwalk.InputError, match="another prepared mesh"):
        pickle.loads(kept)
    assert _ask((mapped, xy)) == answer[0]
    path.unlink()
    with pytest.raises(FileNotFoundError):
        pickle.loads(kept)


def test_damaged_files(prepared: tuple[Path, meshwalk.Locator], tmp_path: Path) -> None:
    bytes_ = bytearray(prepared[0].read_bytes())
    bytes_[len(bytes_) // 2] ^= 4
    (tmp_path / "damaged.mwm").write_bytes(bytes_)
    with pytest.raises(meshwalk.InputError, match="damaged"):
        meshwalk.map(tmp_path / "damaged.mwm")
    (tmp_path / "short.mwm").write_bytes(bytes_[:1000])
    with pytest.raises(meshwalk.InputError, match=r"short\.mwm"):
        meshwalk.map(tmp_path / "short.mwm", trust=True)
    (tmp_path / "other.mwm").write_text("OFF 0 0 0")
    with pytest.raises(meshwalk.InputError, match="prepared"):
        meshwalk.map(tmp_path / "other.mwm")
    with pytest.raises(FileNotFoundError):
        meshwalk.map(tmp_path / "none.mwm")
    open_one = meshwalk.Locator(meshwalk.Mesh(*ring_arrays()), fill="no")
    with pytest.raises(ValueError, match="pockets and holes are not filled"):
        open_one.prepare(tmp_path / "open.mwm")
    assert not (tmp_path / "open.mwm").exists()
