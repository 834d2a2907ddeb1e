"""What is seen over a terrain."""

from __future__ import annotations

import csv
import pickle
import subprocess
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import meshwalk
from meshwalk import SightState


@pytest.fixture
def terrain(random: np.random.Generator) -> meshwalk.Mesh:
    xy = random.uniform(size=(400, 2)) * 100
    return meshwalk.delaunay(np.column_stack([xy, 9 * random.uniform(size=400)]))


def test_as_the_program(
    terrain: meshwalk.Mesh, random: np.random.Generator, program: str, tmp_path: Path
) -> None:
    targets = random.uniform(-5, 105, (500, 2))
    terrain.write(tmp_path / "t.ply")
    np.savetxt(tmp_path / "p.csv", targets, "%.17g", ",", header="x,y", comments="")
    command = [program, "visible", "t.ply", "--from", "50,50", "--height", "9", "--to", "p.csv"]
    answers = subprocess.run(
        [*command, "--target-height", "1"], cwd=tmp_path, check=True, capture_output=True, text=True
    ).stdout
    rows = list(csv.DictReader(answers.splitlines()))
    locator = meshwalk.Locator(terrain, fill="yes")
    seen = meshwalk.visible(locator, [50, 50], targets, 9, 1)
    told = {"1": SightState.VISIBLE, "0": SightState.HIDDEN, "": SightState.UNKNOWN}
    assert seen.state.tolist() == [told[row["visible"]] for row in rows]
    assert set(seen.state) == {0, 1, 2}
    places = [[float(row[f"obstacle_{k}"] or "nan") for k in "xy"] for row in rows]
    np.testing.assert_allclose(seen.obstacle, places)


def test_a_wall_hides() -> None:
    """A wall along x = 5, which the line passes at half its height."""
    points = [[0, 0, 0], [5, 0, 4], [9, 0, 0], [0, 9, 0], [5, 9, 4], [9, 9, 0]]
    mesh = meshwalk.Mesh(points, [[0, 1, 4], [0, 4, 3], [1, 2, 5], [1, 5, 4]])
    looks: Any = [[[4, 4], [9, 4]], [[7, 4], [np.nan, 4]]]
    seen = meshwalk.visible(mesh, [0, 4], looks, height=1)
    assert seen.shape == (2, 2)
    assert seen.visible.tolist() == [[True, False], [False, False]]
    assert seen.state[1, 1] == SightState.UNKNOWN
    assert seen.triangle[0, 0] == -1
    assert seen.at[0, 0] == 1
    x, y = seen.obstacle[0, 1]
    assert 0 < x < 9
    assert y == 4
    assert repr(seen) == "<Sights: 4 targets; 1 visible, 2 hidden, 1 unknown>"
    again = pickle.loads(pickle.dumps(seen))
    np.testing.assert_array_equal(again.obstacle, seen.obstacle)
    high = meshwalk.visible(mesh, [0, 4, 8], [[9, 4, 0], [9, 4, 8]])
    # The line from 8 to 0 passes 3.6 at the wall of 4; one at 8 is free.
    assert high.visible.tolist() == [False, True]
    assert meshwalk.visible(mesh, [0, 4, 9], [9, 4, 0]).visible
    assert len(meshwalk.visible(mesh, [0, 4, 9], np.empty((0, 2)))) == 0


@pytest.mark.parametrize(
    ("viewpoint", "targets", "options", "error", "message"),
    [
        ([500, 4], [1, 1], {}, meshwalk.InputError, "ground"),
        ([50, 50, -9], [1, 1], {}, meshwalk.InputError, "below the ground"),
        ([np.nan, 50], [1, 1], {}, ValueError, "viewpoint is not finite: nan, 50.0, 0.0"),
        ([[1, 1], [2, 2]], [1, 1], {}, ValueError, "viewpoint must be one point"),
        ([1], [1, 1], {}, ValueError, r"viewpoint must have the shape \(..., 2\)"),
        ([50, 50], [1, 2, 3, 4], {}, ValueError, r"targets must have the shape \(..., 2\)"),
        ([50, 50], [1, 1], {"heights": "h"}, KeyError, "no field 'h'"),
    ],
)
def test_refusals(
    terrain: meshwalk.Mesh,
    viewpoint: Any,
    targets: Any,
    options: dict[str, Any],
    error: type[Exception],
    message: str,
) -> None:
    with pytest.raises(error, match=message):
        meshwalk.visible(terrain, viewpoint, targets, **options)


def test_cancelled(terrain: meshwalk.Mesh) -> None:
    def stop(stage: str, done: float) -> None:
        raise ZeroDivisionError

    with pytest.raises(ZeroDivisionError):
        meshwalk.visible(terrain, [50, 50], terrain.points, 20, progress=stop)
