"""Dask: chunks as the whole, four workers of which one dies, files in and out."""

from __future__ import annotations

import contextlib
import io
import os
import re
import shutil
import signal
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import dask
import dask.array as da
import dask.dataframe as dd
import distributed
import numpy as np
import pandas as pd
import pytest
import xarray as xr
from numpy.typing import NDArray

import meshwalk
import meshwalk.dask

Random = np.random.Generator
Sources = dict[str, Any]

pytestmark = pytest.mark.filterwarnings("default")  # dask's own affairs


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("dask")


@pytest.fixture(scope="module")
def locator(folder: Path) -> meshwalk.Locator:
    """A mesh with holes, heights and a field of triangles: the serial answers, and two files."""
    random = np.random.default_rng(2)
    points = random.uniform(size=(4000, 3))
    triangles = meshwalk.delaunay(points).triangles
    kept = triangles[random.uniform(size=len(triangles)) < 0.95]
    soil = {"soil": np.arange(float(len(kept)))}
    mesh = meshwalk.Mesh(points, kept, triangle_fields=soil)
    locator = meshwalk.Locator(mesh, border=True, fill="yes")
    locator.prepare(folder / "mesh.mwm")
    meshwalk.prepare_tiles(locator, folder / "tiles", 6)
    return locator


@pytest.fixture(params=["mesh.mwm", "tiles"])
def source(request: pytest.FixtureRequest, folder: Path, locator: meshwalk.Locator) -> Path:
    return folder / str(request.param)


@pytest.fixture(scope="module")
def client() -> Iterator[distributed.Client]:
    """Four worker processes of one thread each."""
    with (
        dask.config.set({"distributed.worker.daemon": True}),
        distributed.LocalCluster(
            n_workers=4, threads_per_worker=1, processes=True, dashboard_address=None
        ) as cluster,
        distributed.Client(cluster) as client,
    ):
        yield client


@pytest.fixture
def xy(random: Random, locator: meshwalk.Locator) -> NDArray[np.float64]:
    """Points anywhere and on vertices, in no order."""
    around = random.uniform(-0.2, 1.2, (6500, 2))
    return random.permutation(np.concatenate([around, locator.mesh.points[:1500], [[np.nan, 0]]]))


def _same(got: meshwalk.Locations, wanted: meshwalk.Locations) -> None:
    for name in wanted.records.dtype.names or ():
        assert got.records[name].tobytes() == wanted.records[name].tobytes(), name


def test_arrays(source: Path, locator: meshwalk.Locator, xy: NDArray[Any]) -> None:
    wanted = locator.locate(xy, 0.01)
    points = da.from_array(xy, chunks=(1000, 1))
    hit = meshwalk.dask.locate(source, points, 0.01)
    assert hit.triangle.chunks == (points.chunks[0],)
    _same(hit.compute(), wanted)
    _same(hit.persist().compute(), wanted)
    for name in ("triangle", "where", "hole", "local", "weights", "inside"):
        lazy, expected = getattr(hit, name), getattr(wanted, name)
        assert (lazy.dtype, lazy.shape) == (expected.dtype, expected.shape)
        np.testing.assert_array_equal(lazy.compute(), expected)
    heights, soil = wanted.interpolate("z"), wanted.of_triangles("soil")
    np.testing.assert_array_equal(hit.interpolate("z"), heights)
    np.testing.assert_array_equal(hit.interpolate("soil"), soil)
    both = meshwalk.dask.sample(source, points, ["z", "soil"], 0.01)
    np.testing.assert_array_equal(both, np.stack([heights, soil], -1))
    wide = da.from_array(xy[: 75 * 50].reshape(75, 50, 2).astype(np.float32), chunks=(20, 30, 2))
    grid = meshwalk.dask.sample(source, wide)
    assert grid.chunks == wide.chunks[:2]
    np.testing.assert_array_equal(grid, locator.locate(wide.compute()).interpolate("z"))
    assert "9 chunks" in repr(hit)


def test_chunks_of_unknown_size(source: Path, locator: meshwalk.Locator, xy: NDArray[Any]) -> None:
    table = pd.DataFrame(xy, columns=["x", "y"])
    points = dd.from_pandas(table, npartitions=3).to_dask_array()
    wanted = locator.locate(xy)
    hit = meshwalk.dask.locate(source, points)
    np.testing.assert_array_equal(hit.weights.compute(), wanted.weights)
    heights = meshwalk.dask.sample(source, points).compute()
    np.testing.assert_array_equal(heights, wanted.interpolate("z"))
    values = np.arange(4000.0)
    np.testing.assert_array_equal((hit.operator() @ values).compute(), wanted.interpolate(values))


def test_odd_points(source: Path) -> None:
    masked = da.ma.masked_array(da.full((2, 2), 0.5), [[False, False], [True, False]])
    where = meshwalk.dask.locate(source, masked).where.compute()
    assert where[0] != where[1] == meshwalk.Where.BAD
    assert meshwalk.dask.locate(source, da.zeros((0, 2))).triangle.compute().shape == (0,)
    assert meshwalk.dask.locate(source, da.ones((2,), dtype=int)).triangle.compute() == -1
    one = meshwalk.dask.sample(source, xr.Dataset({"x": 0.5, "y": 0.5}))
    assert one["z"].shape == ()


def test_operators(
    source: Path, locator: meshwalk.Locator, xy: NDArray[Any], random: Random
) -> None:
    serial = meshwalk.Operator(locator.locate(xy))
    lazy = meshwalk.dask.operator(source, da.from_array(xy, chunks=(2000, 2)))
    assert lazy.shape == serial.shape
    assert repr(lazy) == "<dask Operator: 8001 points, 4000 vertices>"
    fields = random.uniform(size=(4000, 3, 5)).astype(np.float32)
    fields[17] = np.nan
    kept = lazy.persist()
    for values in (fields, da.from_array(fields, chunks=(1500, 2, 4))):
        got = kept @ values
        assert got.dtype == np.float32
        np.testing.assert_array_equal(got, serial @ fields)
    filled = lazy.apply(fields[:, 0, 0], leave_out_missing=True)
    np.testing.assert_array_equal(filled, serial.apply(fields[:, 0, 0], leave_out_missing=True))
    with pytest.raises(ValueError, match="each of the 4000 vertices"):
        lazy @ fields[:-1]


def test_dataframes_and_parquet(
    source: Path, locator: meshwalk.Locator, xy: NDArray[Any], tmp_path: Path
) -> None:
    table = pd.DataFrame({"id": np.arange(len(xy)), "east": xy[:, 0], "north": xy[:, 1]})
    dd.from_pandas(table, npartitions=5).to_parquet(tmp_path / "in")
    frame = dd.read_parquet(tmp_path / "in")
    wanted = locator.locate(xy, 0.01)
    names: dict[str, Any] = {"x": "east", "y": "north"}
    meshwalk.dask.locate(source, frame, 0.01, **names).to_parquet(tmp_path / "located")
    back = pd.read_parquet(tmp_path / "located")
    np.testing.assert_array_equal(back["id"], table["id"])
    np.testing.assert_array_equal(back["triangle"], wanted.triangle)
    np.testing.assert_array_equal(back[["w0", "w1", "w2"]], wanted.weights)
    meshwalk.dask.sample(source, frame, ["z"], 0.01, **names).to_parquet(tmp_path / "out")
    back = pd.read_parquet(tmp_path / "out")
    assert list(back.columns) == ["id", "east", "north", "z"]
    np.testing.assert_array_equal(back["z"], wanted.interpolate("z"))
    values = np.arange(4000.0)
    weights = meshwalk.dask.operator(source, frame, 0.01, **names)
    np.testing.assert_array_equal(weights @ values, wanted.interpolate(values))
    with pytest.raises(KeyError, match="no column 'x'"):
        meshwalk.dask.locate(source, frame)
    with pytest.raises(ValueError, match="column 'z' already"):
        meshwalk.dask.sample(source, frame.rename(columns={"id": "z", "east": "x", "north": "y"}))


def test_a_missing_number_in_a_dataframe(source: Path) -> None:
    table = pd.DataFrame({"x": pd.array([0.5, None], "Float64"), "y": [0.5, 0.5]})
    frame = meshwalk.dask.locate(source, dd.from_pandas(table, npartitions=1)).compute()
    assert frame["where"].iloc[1] == meshwalk.Where.BAD
    words = dd.from_pandas(pd.DataFrame({"x": ["a"], "y": [1.0]}), npartitions=1)
    with pytest.raises(TypeError, match="column 'x' must be real numbers"):
        meshwalk.dask.sample(source, words)


def test_xarray_zarr_and_netcdf(source: Path, locator: meshwalk.Locator, tmp_path: Path) -> None:
    axes = {"x": np.linspace(-0.1, 1.1, 60), "y": np.linspace(0, 1, 40)}
    pairs = np.stack(np.meshgrid(axes["x"], axes["y"], indexing="ij"), -1)
    wanted = locator.locate(pairs)
    raster = meshwalk.dask.sample(source, xr.Dataset(coords=axes).chunk({"x": 25}), ["z", "soil"])
    assert raster["z"].dims == ("x", "y")
    raster.to_zarr(tmp_path / "raster.zarr")
    np.testing.assert_array_equal(
        xr.open_zarr(tmp_path / "raster.zarr")["z"], wanted.interpolate("z")
    )
    tracks = xr.Dataset(
        {"lon": (("time", "drifter"), pairs[..., 0]), "lat": (("time", "drifter"), pairs[..., 1])}
    )
    tracks.to_netcdf(tmp_path / "tracks.nc")
    with xr.open_dataset(tmp_path / "tracks.nc", chunks={"time": 13}) as read:
        located = meshwalk.dask.locate(source, read, x="lon", y="lat")
        located.to_netcdf(tmp_path / "located.nc")
    with xr.open_dataset(tmp_path / "located.nc") as back:
        np.testing.assert_array_equal(back["triangle"], wanted.triangle)
        np.testing.assert_array_equal(back["w1"], wanted.weights[..., 1])
    tracks.chunk({"time": 7}).to_zarr(tmp_path / "tracks.zarr")
    weights = meshwalk.dask.operator(
        source, xr.open_zarr(tmp_path / "tracks.zarr"), x="lon", y="lat"
    )
    values = np.arange(4000.0)
    np.testing.assert_array_equal(weights @ values, wanted.interpolate(values))
    with pytest.raises(KeyError, match="no variable 'x'"):
        meshwalk.dask.locate(source, tracks)
    with pytest.raises(ValueError, match="variable 'lon' already"):
        meshwalk.dask._added(tracks, (), {"lon": 0})


def test_what_is_refused_at_once(
    folder: Path, locator: meshwalk.Locator, square: meshwalk.Mesh
) -> None:
    points = da.zeros((10, 2), chunks=5)
    with pytest.raises(TypeError, match="in memory only"):
        meshwalk.dask.locate(locator, points)
    with pytest.raises(FileNotFoundError):
        meshwalk.dask.locate(folder / "none.mwm", points)
    with pytest.raises(KeyError, match="no field 'depth'; it has 'z', 'soil'"):
        meshwalk.dask.sample(folder / "mesh.mwm", points, "depth")
    with pytest.raises(ValueError, match="one field at least"):
        meshwalk.dask.sample(folder / "mesh.mwm", points, [])
    with pytest.raises(ValueError, match="shape"):
        meshwalk.dask.locate(folder / "mesh.mwm", da.zeros((10, 3)))
    with pytest.raises(TypeError, match="dask array"):
        meshwalk.dask.locate(folder / "mesh.mwm", np.zeros((10, 2)))
    with pytest.raises(TypeError, match="real numbers"):
        meshwalk.dask.locate(folder / "mesh.mwm", points.astype(complex))
    meshwalk.Locator(square).prepare(folder / "plain.mwm")
    with pytest.raises(ValueError, match="tolerance"):
        meshwalk.dask.locate(folder / "plain.mwm", points, 1)


def _maps(path: str) -> int:
    return Path("/proc/self/maps").read_text().count(path + "\n")


def test_each_process_maps_the_file_once(
    client: distributed.Client, folder: Path, locator: meshwalk.Locator, xy: NDArray[Any]
) -> None:
    path = str(folder / "once.mwm")
    shutil.copy(folder / "mesh.mwm", path)
    points = da.from_array(xy, chunks=(100, 2))
    wanted = locator.locate(xy, 0.01)
    for trust in (False, True):
        for _ in range(2):
            _same(meshwalk.dask.locate(path, points, 0.01, trust=trust).compute(), wanted)
    counts = client.run(_maps, path)
    assert len(counts) == 4
    assert all(count <= 2 for count in counts.values())  # checked, and trusted
    assert any(counts.values())


def test_workers_give_tiles_up(
    client: distributed.Client, folder: Path, locator: meshwalk.Locator, xy: NDArray[Any]
) -> None:
    path = folder / "few"
    shutil.copytree(folder / "tiles", path)
    tiles = meshwalk.Tiles(path, memory=1)
    hit = meshwalk.dask.locate(tiles, da.from_array(xy, chunks=(1000, 2)), 0.01)
    _same(hit.compute(), locator.locate(xy, 0.01))
    assert all(count <= 1 for count in client.run(_tiles_mapped, str(path)).values())
    hit = meshwalk.dask.locate(meshwalk.Tiles(path), da.from_array(xy, chunks=(1000, 2)), 0.01)
    _same(hit.compute(), locator.locate(xy, 0.01))
    assert max(client.run(_tiles_mapped, str(path)).values()) > 1  # with room for them they stay


def _tiles_mapped(path: str) -> int:
    return Path("/proc/self/maps").read_text().count(f"{path}/tile-")


def test_a_file_that_workers_do_not_have(
    client: distributed.Client, folder: Path, locator: meshwalk.Locator, square: meshwalk.Mesh
) -> None:
    path = folder / "moved.mwm"
    shutil.copy(folder / "mesh.mwm", path)
    hits = [meshwalk.dask.locate(path, da.full((10, 2), k, chunks=5)) for k in range(3)]
    path.unlink()
    with pytest.raises(FileNotFoundError, match=r"moved\.mwm"):
        hits[0].triangle.compute()
    meshwalk.Locator(square).prepare(path)
    with pytest.raises(meshwalk.InputError, match=r"moved\.mwm: is another prepared mesh here"):
        hits[1].triangle.compute()
    changed = bytearray((folder / "mesh.mwm").read_bytes())
    changed[-70] ^= 1
    path.write_bytes(changed)
    with pytest.raises(meshwalk.InputError, match="damaged"):
        hits[2].triangle.compute()
    shutil.copytree(folder / "tiles", folder / "lost")
    hit = meshwalk.dask.locate(folder / "lost", da.ones((10, 2), chunks=5) / 2)
    for tile in (folder / "lost").glob("tile-*"):
        tile.unlink()
    with pytest.raises(FileNotFoundError, match="a tile of the mesh is missing"):
        hit.triangle.compute()


def _slowly(chunk: NDArray[Any]) -> NDArray[Any]:
    time.sleep(0.02)
    return chunk


def _wait(is_so: Callable[[], bool]) -> None:
    until = time.monotonic() + 120
    while not is_so():
        assert time.monotonic() < until
        time.sleep(0.01)


def _kill_one(client: distributed.Client) -> None:
    os.kill(next(iter(client.run(os.getpid).values())), signal.SIGKILL)


def test_a_worker_is_killed(
    client: distributed.Client, source: Path, locator: meshwalk.Locator, xy: NDArray[Any]
) -> None:
    points = da.from_array(xy, chunks=(50, 2)).map_blocks(_slowly)
    kept = meshwalk.dask.locate(source, points, 0.01).persist()
    _wait(lambda: sum(map(len, client.has_what().values())) >= 40)
    _kill_one(client)
    _same(kept.compute(), locator.locate(xy, 0.01))


def test_a_worker_is_killed_while_it_writes(
    client: distributed.Client,
    folder: Path,
    locator: meshwalk.Locator,
    xy: NDArray[Any],
    tmp_path: Path,
) -> None:
    points = da.from_array(xy, chunks=(100, 2)).map_blocks(_slowly)
    frame = dd.from_dask_array(points, columns=["x", "y"])
    located = meshwalk.dask.locate(folder / "mesh.mwm", frame, 0.01)
    work = client.compute(located.to_parquet(tmp_path / "out", compute=False))
    _wait(lambda: len(list((tmp_path / "out").glob("*.parquet"))) >= 20)
    assert work.status == "pending"
    _kill_one(client)
    work.result()
    back = dd.read_parquet(tmp_path / "out").compute()
    wanted = locator.locate(xy, 0.01)
    np.testing.assert_array_equal(back[["x", "y"]], xy)
    np.testing.assert_array_equal(back["triangle"], wanted.triangle)
    np.testing.assert_array_equal(back[["w0", "w1", "w2"]], wanted.weights)


def test_the_page(data: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    text = (data.parent / "docs" / "dask.md").read_text()
    blocks = re.findall(r"^```python\n(.*?)^```(?:\n+```output\n(.*?)^```)?", text, re.S | re.M)
    assert len(blocks) > 5
    (tmp_path / "data").symlink_to(data)
    monkeypatch.chdir(tmp_path)
    names: dict[str, Any] = {}
    for block, expected in blocks:
        printed = io.StringIO()
        with contextlib.redirect_stdout(printed):
            exec(compile(block, "dask.md", "exec"), names)
        if expected:
            assert printed.getvalue() == expected
