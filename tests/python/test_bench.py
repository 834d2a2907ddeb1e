"""The benchmark runs, and peers agree; nothing is timed."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import meshwalk.bench


def test_peers_agree() -> None:
    figures = meshwalk.bench.measure(500, 400, 1)
    assert [figure.name for figure in figures[:4]] == [
        *("meshwalk", "meshwalk 1 thread", "meshwalk one by one", "scipy")
    ]
    for figure in figures:
        # SciPy numbers its own triangles.
        assert figure.same == 1 or figure.name == "scipy"


def test_the_table(capsys: pytest.CaptureFixture[str]) -> None:
    options = ["--vertices", "200", "--queries", "100", "--rounds", "1", "--peers", "scipy"]
    assert meshwalk.bench.main(options) == 0
    lines = capsys.readouterr().out.splitlines()
    assert lines[0] == "100 random queries in 200 random vertices"
    assert [line.split()[0] for line in lines[2:]] == ["meshwalk", "scipy"]
    for wrong in (["--peers", "none"], ["--vertices", "2"], ["--rounds", "0"], ["--task", "none"]):
        with pytest.raises(SystemExit):
            meshwalk.bench.main(wrong)


@pytest.mark.parametrize(("task", "first"), [("interpolate", "3 fields"), ("particles", "50 part")])
def test_other_tasks(task: str, first: str, capsys: pytest.CaptureFixture[str]) -> None:
    options = ["--vertices", "200", "--queries", "50", "--rounds", "1", "--columns", "3"]
    assert meshwalk.bench.main([*options, "--steps", "4", "--task", task]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert lines[0].startswith(first)
    assert lines[2].split()[0].startswith("meshwalk")
    assert lines[2].split()[-1] == "1.00"


def test_streams_have_the_same_sums() -> None:
    from meshwalk.dask.bench import measure_streams

    streams = measure_streams(200, 1000, 1, workers=1, chunk=300)
    assert streams.sums[0] == streams.sums[1] > 0
    assert [time.name for time in streams.times] == ["plain processes", "Dask"]


def test_the_model_of_scaling(data: Path, tmp_path: Path, program: str) -> None:
    routing = tmp_path / "routing.tsv"
    options = ["--ranks", "1,8", "--sizes", "1000", "--queries", "2000", "--format", "tsv"]
    subprocess.run([program, "bench", "scale", *options, "-q", "-o", routing], check=True)
    script = data.parent / "bench" / "programs" / "bench_scaling.py"
    sizes = ["--sizes", "500", "--points", "1000", "--mesh", "1e9", "--queries", "1e9"]
    ran = subprocess.run(
        [sys.executable, script, *sizes, "--routing", routing],
        check=True,
        capture_output=True,
        text=True,
    )
    constants, names, *rows = ran.stdout.splitlines()
    assert constants.startswith("vertices: 500  bytes a vertex: ")
    assert names.split("\t")[:3] == ["queries", "ranks", "memory_MB"]
    figures = {tuple(row.split("\t")[:2]): row.split("\t")[2:] for row in rows}
    assert len(figures) == 6
    assert figures["uniform", "1"][3:] == ["0", "0"]  # nothing travels to another rank
    assert float(figures["uniform", "1"][0]) > 7 * float(figures["uniform", "8"][0])


def test_particles_go_the_same_way() -> None:
    random = np.random.default_rng(4)
    locator = meshwalk.Locator(meshwalk.delaunay(random.uniform(size=(300, 2))))
    place = random.uniform(0.2, 0.8, (40, 2))
    by_cursor = meshwalk.bench._drift(meshwalk.Cursor(locator).locate, place, 30)
    np.testing.assert_array_equal(by_cursor, meshwalk.bench._drift(locator.locate, place, 30))
    radius = np.hypot(*(by_cursor - 0.5).T)
    np.testing.assert_allclose(radius, np.hypot(*(place - 0.5).T), rtol=0.01)


def test_drop_ins_agree_with_their_originals(capsys: pytest.CaptureFixture[str]) -> None:
    options = ["--task", "drop-ins", "--vertices", "300", "--queries", "200", "--rounds", "1"]
    assert meshwalk.bench.main([*options, "--peers", "matplotlib,scipy"]) == 0
    rows = [line.split() for line in capsys.readouterr().out.splitlines()[2:]]
    assert [row[0] for row in rows] == [
        *("matplotlib", "meshwalk.matplotlib", "scipy", "meshwalk.scipy")
    ]
    assert all(float(row[-1]) == 1 for row in rows)
    with pytest.raises(SystemExit):
        meshwalk.bench.main([*options, "--peers", "shapely"])
