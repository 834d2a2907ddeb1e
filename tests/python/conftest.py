"""What the tests share: meshes, an oracle in exact fractions, the examples of pages."""

from __future__ import annotations

import contextlib
import io
import os
import re
from fractions import Fraction
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

import meshwalk

if TYPE_CHECKING:
    from numpy.typing import NDArray

HEAVY = (
    "geopandas",
    "meshio",
    "opendrift",
    "parcels",
    "pyvista",
    "shapely",
    "trimesh",
    "uxarray",
    "xugrid",
)
"""Drop-ins for packages that ./test leaves out."""
NOT_HERE = "is not installed: ./test --python-all tests its drop-in"

PAGES = Path(os.environ.get("MW_SOURCE", ".")) / "docs" / "drop-ins"
"""The pages of the drop-ins."""

SEED = int(os.environ.get("MW_TEST_SEED", "20261123"))


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Skip the examples of drop-ins whose originals are not installed."""
    for item in items:
        _, _, module = getattr(getattr(item, "dtest", None), "name", "").partition("meshwalk.")
        name = module.partition(".")[0]
        if name in HEAVY and find_spec(name) is None:
            item.add_marker(pytest.mark.skip(reason=f"{name} {NOT_HERE}"))


@pytest.fixture
def random() -> np.random.Generator:
    print(f"MW_TEST_SEED={SEED}")
    return np.random.default_rng(SEED)


@pytest.fixture
def square() -> meshwalk.Mesh:
    """Two triangles; the diagonal belongs to triangle 0."""
    return meshwalk.Mesh([[0, 0], [4, 0], [4, 4], [0, 4]], [[0, 1, 2], [0, 2, 3]])


def ring_arrays() -> tuple[NDArray[Any], NDArray[Any]]:
    """A square with a square hole."""
    points = [[0, 0], [6, 0], [6, 6], [0, 6], [2, 2], [4, 2], [4, 4], [2, 4]]
    triangles = []
    for k in range(4):
        after = (k + 1) % 4
        triangles += [[k, after, 4 + k], [after, 4 + after, 4 + k]]
    return np.array(points, float), np.array(triangles)


@pytest.fixture
def ring() -> meshwalk.Mesh:
    return meshwalk.Mesh(*ring_arrays())


@pytest.fixture
def scattered(random: np.random.Generator) -> meshwalk.Mesh:
    """Points on a small grid of integers: queries meet many edges and vertices."""
    points = np.unique(random.integers(0, 12, (120, 2)), axis=0)
    return meshwalk.delaunay(points)


def run_page(page: Path) -> None:
    """Run the Python examples of a page, each alone; an `output` block is what it prints."""
    pattern = r"^```python\n(.*?)^```(?:\n+```output\n(.*?)^```)?"
    blocks = re.findall(pattern, page.read_text(), re.S | re.M)
    assert blocks
    for block, expected in blocks:
        printed = io.StringIO()
        with contextlib.redirect_stdout(printed):
            exec(compile(block, page, "exec"), {})
        if expected:
            assert printed.getvalue() == expected


def turn(a: Any, b: Any, p: Any) -> Fraction:
    """Twice the area of a triangle, positive if counter-clockwise."""
    ax, ay, bx, by, px, py = (Fraction(float(v)) for v in (*a, *b, *p))
    return (bx - ax) * (py - ay) - (by - ay) * (px - ax)


def oracle(mesh: meshwalk.Mesh, point: Any) -> int:
    """The lowest triangle that contains a point, by looking at all of them; -1 for none."""
    points, triangles = mesh.points, mesh.triangles
    for number, corners in enumerate(triangles):
        a, b, c = (points[v] for v in corners)
        turns = (turn(a, b, point), turn(b, c, point), turn(c, a, point))
        if turn(a, b, c) == 0:
            continue
        if all(t >= 0 for t in turns) or all(t <= 0 for t in turns):
            return number
    return -1


@pytest.fixture(scope="session")
def data() -> Path:
    """The folder of the data that comes with the project."""
    return Path(os.environ["MW_SOURCE"]) / "data"


@pytest.fixture(scope="session")
def program() -> str:
    """The program of the same build."""
    return os.environ["MESHWALK"]
