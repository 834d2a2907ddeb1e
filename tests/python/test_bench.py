"""The benchmark runs, and peers agree; nothing is timed."""

from __future__ import annotations

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
    for wrong in (["--peers", "none"], ["--vertices", "2"], ["--rounds", "0"]):
        with pytest.raises(SystemExit):
            meshwalk.bench.main(wrong)
