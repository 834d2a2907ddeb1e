"""The tasks of the benchmark for drop-ins run, and answers agree; nothing is timed."""

from __future__ import annotations

import pytest
from conftest import NOT_HERE

import meshwalk.bench

NEEDED = {"rays": "trimesh", "joins": "geopandas", "cells": "pyvista"}


@pytest.mark.parametrize("task", NEEDED)
def test_tasks(task: str, capsys: pytest.CaptureFixture[str]) -> None:
    pytest.importorskip(NEEDED[task], reason=f"{NEEDED[task]} {NOT_HERE}")
    options = ["--vertices", "300", "--queries", "200", "--rounds", "1", "--task", task]
    assert meshwalk.bench.main(options) == 0
    lines = capsys.readouterr().out.splitlines()
    rows = [line for line in lines if line and not line.startswith(" ") and "queries" not in line]
    assert sum(row.startswith("meshwalk") for row in rows) >= 2
    assert len(rows) >= 4
    for row in rows:
        assert float(row.split()[-1]) > 0.98
