"""Meshes are cut into tiles: a folder of prepared files, and its index."""

from __future__ import annotations

import hashlib
import json
import os
from fractions import Fraction
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from meshwalk import _arrays
from meshwalk._errors import InputError
from meshwalk._locator import Locator
from meshwalk._mesh import Mesh
from meshwalk._prepared import map as map_file

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from meshwalk._core import Progress

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


def _write(mesh: Mesh, chosen: NDArray[np.intp], triangles: NDArray[Any], path: str) -> int:
    """Prepare the chosen triangles (in ascending order) of the mesh; returns the checksum."""
    vertices, corners = np.unique(triangles[chosen], return_inverse=True)
    part = Mesh(
        mesh.points[vertices],
        corners.reshape(-1, 3),
        {**{name: v[vertices] for name, v in mesh.fields.items()}, VERTICES: vertices},
        triangle_fields={
            **{name: v[chosen] for name, v in mesh.triangle_fields.items()},
            TRIANGLES: chosen,
        },
        crs=mesh.crs,
    )
    Locator(part, border=True, fill="yes").prepare(path)
    mapped = map_file(path, trust=True).mesh._mapped
    assert mapped is not None
    return mapped[2]


def _cut(boxes: NDArray[np.float64], tiles: int) -> tuple[list[Node], list[NDArray[np.intp]]]:
    """Divide the boxes (low x, y, high x, y) of triangles by their middles: nodes and tiles."""
    middles = boxes[:, :2] / 2 + boxes[:, 2:] / 2
    nodes: list[Any] = []
    leaves: list[NDArray[np.intp]] = []

    def divide(chosen: NDArray[np.intp], parts: int) -> int:
        if parts == 1:
            leaves.append(np.sort(chosen))
            return -len(leaves)
        there = middles[chosen]
        axis = int(np.argmax(np.ptp(there, axis=0)))
        at = len(chosen) * (parts // 2) // parts
        order = np.argpartition(there[:, axis], at)
        low, high = chosen[order[:at]], chosen[order[at:]]
        number = len(nodes)
        nodes.append(None)
        ends = float(boxes[low, 2 + axis].max())
        begins = float(boxes[high, axis].min())
        below = divide(low, parts // 2)
        nodes[number] = Node(axis, ends, begins, below, divide(high, parts - parts // 2))
        return number

    divide(np.arange(len(boxes)), tiles)
    return nodes, leaves


def _flat(mesh: Mesh, corners: NDArray[np.float64]) -> NDArray[np.intp]:
    """Triangles without area, exactly; `corners` are the coordinates of each."""
    if mesh.describe().flat_triangles == 0:
        return np.empty(0, np.intp)
    with np.errstate(all="ignore"):
        (x, y), (u, v) = (corners[:, 1] - corners[:, 0]).T, (corners[:, 2] - corners[:, 0]).T
        left, right = x * v, y * u
        bound = 4 * 2.0**-53 * (np.abs(left) + np.abs(right))
        doubtful = np.flatnonzero(~(np.abs(left - right) > bound))
    return np.array([t for t in doubtful.tolist() if _has_no_area(corners[t])], np.intp)


def _has_no_area(corners: NDArray[np.float64]) -> bool:
    (ax, ay), (bx, by), (cx, cy) = ((Fraction(x), Fraction(y)) for x, y in corners.tolist())
    return (bx - ax) * (cy - ay) == (by - ay) * (cx - ax)


def _with_flat(
    chosen: NDArray[np.intp], triangles: NDArray[Any], flat: NDArray[np.intp]
) -> NDArray[np.intp]:
    """The chosen triangles and the flat ones that hang on them.

    Without one of these, a vertex would lie inside an edge.
    """
    marked = np.zeros(int(triangles.max()) + 1, bool)
    marked[triangles[chosen]] = True
    parts = [chosen]
    while len(flat):
        near = marked[triangles[flat]].any(axis=1)
        if not near.any():
            break
        parts.append(flat[near])
        marked[triangles[flat[near]]] = True
        flat = flat[~near]
    return np.unique(np.concatenate(parts))


def _at_border(
    triangles: NDArray[Any], neighbours: NDArray[np.int32], flat: NDArray[np.intp]
) -> NDArray[np.intp]:
    """Triangles that have a vertex of the border or of a flat triangle."""
    alone = neighbours < 0
    alone[flat] = True
    marked = np.zeros(int(triangles.max()) + 1, bool)
    for k in range(3):
        marked[triangles[alone[:, k], k]] = True
        marked[triangles[alone[:, k], (k + 1) % 3]] = True
    return np.flatnonzero(marked[triangles].any(axis=1))


def _holes(locator: Locator, overview: Locator) -> list[int]:
    """For each hole of the overview the number that the whole mesh has for it, -1 if none.

    The interior of the mesh, which the overview leaves out, makes more holes. The lowest triangle
    at a hole, and its edge there, tell which is which.
    """
    pair = (locator, overview)
    whole, part = (np.frombuffer(one._holes(), np.uint32).reshape(-1, 2) for one in pair)
    numbers = overview.mesh.triangle_fields[TRIANGLES][part[:, 0]]
    names = {(triangle, edge): hole for hole, (triangle, edge) in enumerate(whole.tolist())}
    edges = zip(numbers.astype(int).tolist(), part[:, 1].tolist(), strict=True)
    return [names.get(edge, -1) for edge in edges]


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
    All of the mesh is in memory while this works, and about 150 bytes a triangle beside it.

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
    import shutil
    import tempfile

    locator = mesh if isinstance(mesh, Locator) else Locator(mesh, fill="yes", progress=progress)
    if locator.describe().unfilled:
        locator = Locator(locator.mesh, fill="yes", progress=progress)
    count = locator.mesh.triangle_count
    if not 1 <= tiles <= count:
        raise ValueError(f"tiles must be from 1 to {count}, the number of triangles, not {tiles}")
    name = os.path.abspath(os.fsdecode(_arrays.path(folder)))
    if os.path.lexists(name):
        raise FileExistsError(f"{name}: is there already; remove it first")
    made = tempfile.mkdtemp(prefix=".tiles-", dir=os.path.dirname(name))
    try:
        os.chmod(made, 0o777 & ~_umask())
        _prepare(locator, made, tiles, progress)
        os.rename(made, name)
    except BaseException:
        shutil.rmtree(made, ignore_errors=True)
        raise


def _umask() -> int:
    value = os.umask(0)
    os.umask(value)
    return value


def _prepare(locator: Locator, folder: str, tiles: int, progress: Progress | None) -> None:
    mesh = locator.mesh
    for name in (*mesh.fields, *mesh.triangle_fields):
        if name in (TRIANGLES, VERTICES):
            raise ValueError(f"a field has the name {name!r}, which tiles need")
    triangles = mesh.triangles
    corners = mesh.points[triangles]
    boxes = np.concatenate([corners.min(axis=1), corners.max(axis=1)], axis=1)
    flat = _flat(mesh, corners)
    del corners
    solid = np.delete(np.arange(len(triangles)), flat)
    if tiles > len(solid):
        raise ValueError(f"{tiles} tiles are more than the {len(solid)} triangles with an area")
    nodes, leaves = _cut(boxes[solid], tiles)
    overview = os.path.join(folder, OVERVIEW)
    sums = [_write(mesh, _at_border(triangles, mesh.neighbours, flat), triangles, overview)]
    for number, leaf in enumerate(leaves):
        if progress:
            progress("tiles", number / tiles)
        chosen = _with_flat(solid[leaf], triangles, flat)
        sums.append(_write(mesh, chosen, triangles, os.path.join(folder, tile_name(number))))
    holes = _holes(locator, map_file(overview))
    write_index(folder, (mesh.vertex_count, mesh.triangle_count), holes, sums, nodes)
