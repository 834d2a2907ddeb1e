"""Meshes in tiles: a folder of prepared files, and its index."""

from __future__ import annotations

import hashlib
import json
import os
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from meshwalk import _arrays
from meshwalk._errors import InputError
from meshwalk._locator import Locator

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from meshwalk._core import Progress
    from meshwalk._mesh import Mesh

INDEX = "tiles.json"
OVERVIEW = "overview.mwm"
# Fields of each file: the numbers of its triangles and vertices in the whole mesh.
TRIANGLES = "meshwalk:triangle"
VERTICES = "meshwalk:vertex"
_FORMAT = "meshwalk tiles"
_VERSION = 1


class Node(NamedTuple):
    """A cut of the triangles in two: numbers of nodes, or of tiles as -1 - number.

    No triangle below the cut reaches farther than `low_ends` along the axis, none above it begins
    before `high_begins`. The two may overlap.
    """

    axis: int
    low_ends: float
    high_begins: float
    low: int
    high: int


def _checksum(index: dict[str, Any]) -> str:
    """Of all that an index says beside its checksum."""
    text = json.dumps({key: index[key] for key in sorted(index) if key != "checksum"})
    return hashlib.blake2b(text.encode(), digest_size=8).hexdigest()


def tile_name(number: int) -> str:
    """The name of a tile's file."""
    return f"tile-{number:05}.mwm"


class Index(NamedTuple):
    """What `tiles.json` says; files are the overview and then the tiles."""

    checksum: int
    vertices: int
    triangles: int
    holes: NDArray[np.int32]
    """For each hole of the overview its number in the whole mesh, -1 for none."""
    files: list[tuple[str, int]]
    nodes: list[Node]


def read_index(folder: str) -> Index:
    """Read the index of a folder; one that is damaged is refused."""
    path = os.path.join(folder, INDEX)
    with open(path, "rb") as file:
        text = file.read()
    try:
        index = json.loads(text)
        if index["format"] != _FORMAT:
            raise InputError(f"{path}: is no index of tiles")
        if index["version"] != _VERSION:
            raise InputError(
                f"{path}: has the format version {index['version']}; this meshwalk reads version"
                f" {_VERSION}: prepare the tiles again"
            )
        if index["checksum"] != _checksum(index):
            raise InputError(f"{path}: a damaged index of tiles: its checksum is wrong")
        sums = [int(value, 16) for value in index["checksums"]]
        nodes = [Node(*node) for node in index["cuts"]]
        _check_nodes(nodes, len(sums) - 1)
        read = Index(
            int(index["checksum"], 16),
            int(index["vertices"]),
            int(index["triangles"]),
            np.array(index["holes"], np.int32).reshape(-1),
            [(OVERVIEW, sums[0]), *((tile_name(i), value) for i, value in enumerate(sums[1:]))],
            nodes,
        )
    except InputError:
        raise
    except (LookupError, OverflowError, RecursionError, TypeError, ValueError) as error:
        raise InputError(f"{path}: a damaged index of tiles: {error}") from None
    return read


def _check_nodes(nodes: list[Node], tiles: int) -> None:
    """Each node and each tile is below one other, which has a lower number."""
    if len(nodes) != max(tiles, 1) - 1:
        raise ValueError(f"{len(nodes)} cuts do not make {tiles} tiles")
    below = set()
    for number, node in enumerate(nodes):
        if node.axis not in (0, 1):
            raise ValueError(f"cut {number} is along no axis")
        for child in (node.low, node.high):
            inside = number < child < len(nodes) or -tiles <= child < 0
            if type(child) is not int or not inside:
                raise ValueError(f"cut {number} leads nowhere")
            below.add(child)
    if len(below) != 2 * len(nodes):
        raise ValueError("two cuts lead to one tile")


def prepare_tiles(
    mesh: Mesh | Locator,
    folder: str | os.PathLike[str],
    tiles: int,
    *,
    progress: Progress | None = None,
) -> None:
    """Write a mesh as a folder of prepared files that are mapped one by one: see `Tiles`.

    Parameters
    ----------
    mesh : Mesh or Locator
        The mesh, whole: an embedding, as `Locator.prepare` needs it. Of a locator its mesh is
        taken.
    folder : str or path-like
        The folder to be made. It appears under its name when it is complete.
    tiles : int
        Into how many tiles; each has about the same number of triangles.
    progress : callable, optional
        As of `Locator`.

    Raises
    ------
    OSError
        The folder cannot be written; ``FileExistsError`` where there is one.
    InputError
        The mesh is no embedding.

    Notes
    -----
    All of the mesh is in memory while this works, and about 80 bytes a triangle beside it.
    ``meshwalk prepare --tiles`` writes the same files.

    Each triangle is in one tile, but flat ones, which are in all tiles that touch them. The
    overview has all triangles with a vertex of the border, so that points in no tile are told
    apart: outside, in which hole, near which edge.

    Examples
    --------
    >>> import meshwalk, os, tempfile
    >>> import numpy as np
    >>> folder = os.path.join(tempfile.mkdtemp(), "tiles")
    >>> mesh = meshwalk.delaunay(np.random.default_rng(1).uniform(size=(1000, 2)))
    >>> meshwalk.prepare_tiles(mesh, folder, 4)
    >>> meshwalk.Tiles(folder)
    <Tiles: 4 tiles, 1000 vertices, 1982 triangles>
    """
    locator = mesh if isinstance(mesh, Locator) else Locator(mesh, fill="yes", progress=progress)
    if locator.describe().unfilled:
        locator = Locator(locator.mesh, fill="yes", progress=progress)
    count = locator.mesh.triangle_count
    if not 1 <= tiles <= count:
        raise ValueError(f"tiles must be from 1 to {count}, the number of triangles, not {tiles}")
    name = os.path.abspath(os.fsdecode(_arrays.path(folder)))
    if os.path.lexists(name):
        raise FileExistsError(f"{name}: exists already; remove it first")
    os.stat(os.path.dirname(name))
    locator._write(os.fsencode(name), tiles, progress)
