"""What the tests share: meshes, and an oracle in exact fractions."""

from __future__ import annotations

import os
from fractions import Fraction
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

import meshwalk

if TYPE_CHECKING:
    from numpy.typing import NDArray

HEAVY = ("geopandas", "meshio", "pyvista", "shapely", "trimesh")
"""Drop-ins for packages that ./test leaves out."""
NOT_HERE = "is not installed: ./test --python-all tests its drop-in"

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


def _turn(a: Any, b: Any, p: Any) -> Fraction:
    ax, ay, bx, by, px, py = (Fraction(float(v)) for v in (*a, *b, *p))
    return (bx - ax) * (py - ay) - (by - ay) * (px - ax)


def oracle(mesh: meshwalk.Mesh, point: Any) -> int:
    """The lowest triangle that contains a point, by looking at all of them; -1 for none."""
    points, triangles = mesh.points, mesh.triangles
    for number, corners in enumerate(triangles):
        a, b, c = (points[v] for v in corners)
        turns = (_turn(a, b, point), _turn(b, c, point), _turn(c, a, point))
        if _turn(a, b, c) == 0:
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
