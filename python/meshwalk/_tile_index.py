"""The index of a mesh in tiles: what stands in `tiles.json`."""

from __future__ import annotations

import hashlib
import json
import os
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from meshwalk._errors import InputError

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


def write_index(
    folder: str,
    counts: tuple[int, int],
    holes: list[int],
    checksums: list[int],
    nodes: list[Node],
) -> None:
    """Write the index.

    `counts` are those of vertices and triangles; `holes` tells for each hole of the overview its
    number in the whole mesh; `checksums` are those of the overview and of the tiles.
    """
    index = {
        "format": _FORMAT,
        "version": _VERSION,
        "vertices": counts[0],
        "triangles": counts[1],
        "holes": holes,
        "checksums": [f"{value:016x}" for value in checksums],
        "cuts": nodes,
    }
    index["checksum"] = _checksum(index)
    with open(os.path.join(folder, INDEX), "x", encoding="ascii") as file:
        json.dump(index, file)
        file.flush()
        os.fsync(file.fileno())
