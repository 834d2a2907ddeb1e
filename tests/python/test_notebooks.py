"""The notebooks run from top to bottom, in a fresh namespace, and draw what they say they draw.

Without Jupyter: a notebook here has cells of plain Python only. The folder MW_NOTEBOOK_PICTURES
keeps the pictures, to be looked at.
"""

from __future__ import annotations

import contextlib
import json
import os
from pathlib import Path
from typing import Any

import matplotlib.pyplot as plt
import pytest

NOTEBOOKS = Path(os.environ["MW_SOURCE"]) / "python" / "notebooks"
KEPT = os.environ.get("MW_NOTEBOOK_PICTURES")
PICTURES = {"terrain": 2, "particles": 1, "weights": 2, "globe": 1, "deforming": 2}


def _sources(notebook: Path) -> list[str]:
    cells = json.loads(notebook.read_text())["cells"]
    code = [cell for cell in cells if cell["cell_type"] == "code"]
    assert all(not cell["outputs"] and cell["execution_count"] is None for cell in code)
    return ["".join(cell["source"]) for cell in code]


def _run(notebook: Path) -> None:
    namespace: dict[str, Any] = {}
    for number, source in enumerate(_sources(notebook)):
        exec(compile(source, f"{notebook.name}, cell {number}", "exec"), namespace)


def test_each_is_tried() -> None:
    assert {path.stem for path in NOTEBOOKS.glob("*.ipynb")} == set(PICTURES)


@pytest.mark.parametrize("name", PICTURES)
def test_notebook(name: str) -> None:
    plt.close("all")
    with contextlib.chdir(NOTEBOOKS):
        _run(NOTEBOOKS / f"{name}.ipynb")
    numbers = plt.get_fignums()
    for number in numbers:
        figure = plt.figure(number)
        figure.canvas.draw()
        assert all(axes.get_children() for axes in figure.axes)
        if KEPT:
            figure.savefig(Path(KEPT) / f"{name}-{number}.png", dpi=70)
    plt.close("all")
    assert len(numbers) == PICTURES[name]
