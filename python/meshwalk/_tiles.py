"""Meshes in tiles, each of which is mapped when a point comes near it."""

from __future__ import annotations

import os
import threading
from collections import OrderedDict
from typing import TYPE_CHECKING, Any, NamedTuple, cast

import numpy as np

from meshwalk import _arrays, _core
from meshwalk._errors import InputError
from meshwalk._locations import LOCATION, Locations
from meshwalk._locator import Locator
from meshwalk._operator import Operator
from meshwalk._prepared import map as map_file
from meshwalk._tiling import INDEX, TRIANGLES, VERTICES, read_index

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from numpy.typing import ArrayLike, NDArray
    from scipy.sparse import csr_array

    from meshwalk._core import Progress

_NOBODY = np.iinfo(np.int32).max
# Answers are moved as bytes: NumPy moves records field by field, in ten times the time.
_BYTES = np.dtype((np.void, LOCATION.itemsize))


class _Tile(NamedTuple):
    """A file that is mapped: the part `number` of the mesh."""

    locator: Locator
    numbers: NDArray[np.float64]
    vertices: NDArray[np.float64]
    bytes: int

    def whole(self, triangle: NDArray[np.int32]) -> NDArray[np.int32]:
        """Numbers of triangles of the tile in the whole mesh, -1 where there is none."""
        numbers = self.numbers[triangle].astype(np.int32)
        numbers[triangle < 0] = -1
        return numbers

    def part(self, records: NDArray[Any]) -> Locations:
        """Answers in the numbers of the whole mesh, as answers in the tile."""
        there = records["triangle"] >= 0
        own = records.copy()
        own["triangle"][there] = np.searchsorted(self.numbers, records["triangle"][there])
        return Locations(self.locator.mesh, own)


class Tiles:
    """A mesh in tiles; only tiles near the points are mapped.

    Answers are those of the whole mesh, bit for bit: the numbers of triangles, vertices and holes
    are its own, and ties belong to the lowest triangle of all.

    Parameters
    ----------
    folder : str or path-like
        The folder that `prepare_tiles` made.
    trust : bool, optional
        As of `map`: for files of your own. By default each file is checked when it is first
        mapped.
    memory : int, optional
        So many bytes of tiles stay mapped, beside the overview; beyond that, the tile that was not
        asked for longest is given up, and mapped anew when it is needed.

    Raises
    ------
    OSError
        A file cannot be opened; ``FileNotFoundError`` where there is none.
    InputError
        A file is damaged, or is not the one that the index names.

    Notes
    -----
    Any number of threads may ask at a time. It pickles as the path of the folder, which has to be
    there, unchanged, where it is loaded.

    Examples
    --------
    >>> import meshwalk, os, tempfile
    >>> folder = os.path.join(tempfile.mkdtemp(), "tiles")
    >>> mesh = meshwalk.delaunay([[0, 0, 0], [4, 0, 4], [4, 4, 8], [0, 4, 4]])
    >>> meshwalk.prepare_tiles(mesh, folder, 2)
    >>> hit = meshwalk.Tiles(folder).locate([[3, 1], [2, 2], [5, 5]])
    >>> hit
    <TileLocations: 3 points; 1 inside, 1 edge, 1 outside>
    >>> hit.interpolate("z")
    array([ 4.,  4., nan])
    """

    def __init__(
        self, folder: str | os.PathLike[str], trust: bool = False, *, memory: int = 2**30
    ) -> None:
        self.folder = os.path.abspath(os.fsdecode(_arrays.path(folder)))
        self.trust = trust
        self.memory = memory
        self._index = read_index(self.folder)
        self._mapped: OrderedDict[int, _Tile] = OrderedDict()
        self._checked: dict[int, tuple[int, int, int]] = {}
        self._lock = threading.Lock()
        self._overview = self._map(-1)

    @property
    def checksum(self) -> int:
        """The checksum of the index, which holds the checksums of all files."""
        return self._index.checksum

    @property
    def tile_count(self) -> int:
        """The number of tiles, the overview not counted."""
        return len(self._index.files) - 1

    @property
    def vertex_count(self) -> int:
        """The number of vertices of the whole mesh."""
        return self._index.vertices

    @property
    def triangle_count(self) -> int:
        """The number of triangles of the whole mesh."""
        return self._index.triangles

    @property
    def crs(self) -> str | None:
        """The coordinate system, as of `Mesh.crs`."""
        return self._overview.locator.mesh.crs

    @property
    def field_names(self) -> list[str]:
        """The names of the fields of vertices."""
        return [name for name in self._overview.locator.mesh.fields if name != VERTICES]

    @property
    def triangle_field_names(self) -> list[str]:
        """The names of the fields of triangles."""
        return [name for name in self._overview.locator.mesh.triangle_fields if name != TRIANGLES]

    def locate(self, xy: ArrayLike, tolerance: float = 0, threads: int = 0) -> TileLocations:
        """Find the triangles that contain points.

        Parameters
        ----------
        xy : array_like, shape (..., 2)
        tolerance : float, optional
        threads : int, optional
            As of `Locator.locate`.

        Returns
        -------
        TileLocations
            As of `Locator.locate`, in the numbers of the whole mesh.
        """
        points, shape = _arrays.queries(xy, "xy", 2)
        records = np.zeros(len(points), LOCATION)
        tile = np.full(len(points), -1, np.int32)
        best = np.full(len(points), _NOBODY, np.int32)
        bytes_ = records.view(_BYTES)
        for number, chosen in self._route(points):
            mapped = self._tile(number)
            found = mapped.locator.locate(points[chosen], threads=threads).records
            triangle = mapped.whole(found["triangle"])
            better = np.flatnonzero((triangle >= 0) & (triangle < best[chosen]))
            chosen = chosen[better]
            bytes_[chosen] = found.view(_BYTES)[better]
            records["triangle"][chosen] = triangle[better]
            tile[chosen], best[chosen] = number, triangle[better]
        missing = np.flatnonzero(best == _NOBODY)
        if len(missing):
            records[missing] = self._locate_outside(points[missing], tolerance, threads)
        return TileLocations._in(self, records.reshape(shape), tile.reshape(shape))

    def _locate_outside(
        self, points: NDArray[np.float64], tolerance: float, threads: int
    ) -> NDArray[Any]:
        """Answer points in no triangle, by the overview."""
        overview = self._overview
        hit = overview.locator.locate(points, tolerance, threads=threads)
        found = hit.records.view(_BYTES).copy().view(LOCATION)
        found["triangle"] = overview.whole(found["triangle"])
        hole = found["hole"] >= 0
        found["hole"][hole] = self._index.holes[found["hole"][hole]]
        return found

    def _route(self, points: NDArray[np.float64]) -> Iterator[tuple[int, NDArray[np.intp]]]:
        """Tell for each tile which points it may contain."""
        waiting = [(0 if self._index.nodes else -1, np.arange(len(points)))]
        while waiting:
            number, chosen = waiting.pop()
            if not len(chosen):
                continue
            if number < 0:
                yield -1 - number, chosen
                continue
            node = self._index.nodes[number]
            place = points[chosen, node.axis]
            waiting.append((node.high, chosen[place >= node.high_begins]))
            waiting.append((node.low, chosen[place <= node.low_ends]))

    def _tile(self, number: int) -> _Tile:
        """The file of a tile, mapped; -1 is the overview."""
        if number < 0:
            return self._overview
        with self._lock:
            tile = self._mapped.get(number)
            if tile is None:
                tile = self._map(number)
                self._mapped[number] = tile
            self._mapped.move_to_end(number)
            room = self.memory - sum(other.bytes for other in self._mapped.values())
            while room < 0 and len(self._mapped) > 1:
                room += self._mapped.popitem(last=False)[1].bytes
            return tile

    def _map(self, number: int) -> _Tile:
        name, checksum = self._index.files[number + 1]
        path = os.path.join(self.folder, name)
        try:
            told = os.stat(path)
        except FileNotFoundError:
            raise FileNotFoundError(f"{path}: a tile of the mesh is missing") from None
        state = told.st_ino, told.st_size, told.st_mtime_ns
        locator = map_file(path, self.trust or self._checked.get(number) == state)
        mesh = locator.mesh
        if mesh._mapped is None or mesh._mapped[2] != checksum:
            raise InputError(f"{path}: is not the tile that {INDEX} names")
        if TRIANGLES not in mesh.triangle_fields or VERTICES not in mesh.fields:
            raise InputError(f"{path}: does not tell its numbers in the whole mesh")
        tile = _Tile(locator, mesh.triangle_fields[TRIANGLES], mesh.fields[VERTICES], told.st_size)
        if not self.trust and self._checked.get(number) != state:
            _check_numbers(path, tile.numbers, self._index.triangles)
            _check_numbers(path, tile.vertices, self._index.vertices)
            self._checked[number] = state
        return tile

    def __repr__(self) -> str:
        return (
            f"<Tiles: {self.tile_count} tiles, {self.vertex_count} vertices,"
            f" {self.triangle_count} triangles>"
        )

    def __reduce__(self) -> tuple[Any, ...]:
        return _open_again, (self.folder, self.trust, self.memory, self.checksum)


def _check_numbers(path: str, numbers: NDArray[np.float64], count: int) -> None:
    """Whole numbers below the count, in ascending order."""
    if len(numbers) and not (
        numbers[0] >= 0
        and numbers[-1] < count
        and (np.diff(numbers) > 0).all()
        and (np.floor(numbers) == numbers).all()
    ):
        raise InputError(f"{path}: its numbers in the whole mesh are out of range")


def _open_again(folder: str, trust: bool, memory: int, checksum: int) -> Tiles:
    tiles = Tiles(folder, trust, memory=memory)
    if tiles.checksum != checksum:
        raise InputError(f"{folder}: holds other tiles than those that were pickled")
    return tiles


class TileLocations(Locations):
    """Where points lie in a mesh of tiles: the answer of `Tiles.locate`.

    Attributes and methods are those of `Locations`; `Operator` takes it, too.

    Attributes
    ----------
    tiles : Tiles
        The mesh; `mesh` is the same.
    tile : ndarray
        The tile of each point's triangle, -1 for none or where the overview answered.
    """

    __slots__ = ("tile", "tiles")

    def __init__(self, tiles: Tiles, records: NDArray[Any], tile: NDArray[np.int32]) -> None:
        super().__init__(cast(Any, tiles), records)
        self.tiles = tiles
        self.tile = _arrays.frozen(np.array(tile))

    @classmethod
    def _in(cls, tiles: Tiles, records: NDArray[Any], tile: NDArray[np.int32]) -> TileLocations:
        """Answers that the tiles have just given: they are taken as they are."""
        hit = cast(TileLocations, cls._of(cast(Any, tiles), records))
        hit.tiles = tiles
        hit.tile = _arrays.frozen(tile)
        return hit

    def _by_tile(self) -> Iterator[tuple[NDArray[np.intp], _Tile, Locations]]:
        """Points of each tile: their places, and the same answers in the tile's own numbers."""
        records, tile = self.records.reshape(-1), self.tile.reshape(-1)
        order = np.argsort(tile, kind="stable")
        starts = np.flatnonzero(np.diff(tile[order], prepend=-2))
        for places in np.split(order, starts[1:]):
            if len(places):
                mapped = self.tiles._tile(int(tile[places[0]]))
                yield places, mapped, mapped.part(records[places])

    def _gather(
        self,
        given: Any,
        count: int,
        what: str,
        take: Callable[[_Tile, Locations, Any], NDArray[Any]],
    ) -> NDArray[Any]:
        """Values at all points; `given` is the name of a field, or an array of `count` rows."""
        if not isinstance(given, str):
            given = np.asanyarray(given)
            if given.ndim == 0 or given.shape[0] != count:
                raise ValueError(
                    f"values must have a row for each of the {count} {what}; their shape is"
                    f" {given.shape}"
                )
        out: NDArray[Any] | None = None
        for places, mapped, hit in self._by_tile():
            values = take(mapped, hit, given)
            if out is None:
                out = np.empty((self.records.size, *values.shape[1:]), values.dtype)
            out[places] = values
        if out is None:
            overview = self.tiles._overview
            out = take(overview, overview.part(self.records.reshape(-1)), given)
        return out.reshape(self.shape + out.shape[1:])

    def interpolate(
        self, values: ArrayLike | str, threads: int = 0, *, progress: Progress | None = None
    ) -> NDArray[Any]:
        """Interpolate values at the vertices, as `Locations.interpolate` does.

        Parameters
        ----------
        values : array_like, shape (n_vertices of the whole mesh, ...), or str
        threads : int, optional
        progress : callable, optional
            As of `Locations.interpolate`.

        Returns
        -------
        ndarray
        """

        def take(mapped: _Tile, hit: Locations, given: Any) -> NDArray[Any]:
            if not isinstance(given, str):
                given = given[mapped.vertices.astype(np.int64)]
            return hit.interpolate(given, threads, progress=progress)

        return self._gather(values, self.tiles.vertex_count, "vertices", take)

    def gradient(self, values: ArrayLike | str) -> NDArray[np.float64]:
        """Tell how fast values change along x and y, as `Locations.gradient` does.

        Parameters
        ----------
        values : array_like, shape (n_vertices of the whole mesh, ...), or str
            As of `Locations.gradient`.

        Returns
        -------
        ndarray
        """

        def take(mapped: _Tile, hit: Locations, given: Any) -> NDArray[Any]:
            if not isinstance(given, str):
                given = given[mapped.vertices.astype(np.int64)]
            return hit.gradient(given)

        return self._gather(values, self.tiles.vertex_count, "vertices", take)

    def of_triangles(self, values: ArrayLike | str, missing: Any = np.nan) -> NDArray[Any]:
        """Take the values of the triangles, as `Locations.of_triangles` does.

        Parameters
        ----------
        values : array_like, shape (n_triangles of the whole mesh, ...), or str
        missing : scalar, optional
            As of `Locations.of_triangles`.

        Returns
        -------
        ndarray
        """

        def take(mapped: _Tile, hit: Locations, given: Any) -> NDArray[Any]:
            if not isinstance(given, str):
                given = given[mapped.numbers.astype(np.int64)]
            return hit.of_triangles(given, missing)

        return self._gather(values, self.tiles.triangle_count, "triangles", take)

    def _core_operator(self, threads: int, progress: Progress | None) -> _core.Operator:
        rows, columns, weights = [np.empty(0, np.uint32)], [np.empty(0, np.uint32)], [np.empty(0)]
        for places, mapped, hit in self._by_tile():
            first, column, weight = Operator(hit, threads, progress=progress)._entries()
            counts = (first[1:] - first[:-1]).astype(np.int64)
            rows.append(np.repeat(places, counts).astype(np.uint32))
            columns.append(mapped.vertices[column].astype(np.uint32))
            weights.append(weight)
        row = np.concatenate(rows)
        order = np.argsort(row, kind="stable")
        return _core.operator_from_entries(
            row[order],
            np.concatenate(columns)[order],
            np.concatenate(weights)[order],
            self.records.size,
            self.tiles.vertex_count,
        )

    def operator(self) -> csr_array:
        """Copy the weights as a matrix of SciPy, as `Locations.operator` does.

        Returns
        -------
        scipy.sparse.csr_array
        """
        return Operator(self).tocsr()

    def to_esmf(self, path: str | os.PathLike[str]) -> None:
        """Refused: the centres of cells are in many files."""
        raise TypeError("answers in tiles are not written for ESMF; locate in the whole mesh")

    def __getitem__(self, index: Any) -> TileLocations:
        return TileLocations._in(
            self.tiles, np.asarray(self.records[index]), np.asarray(self.tile[index])
        )

    def __reduce__(self) -> tuple[Any, ...]:
        return TileLocations, (self.tiles, self.records, self.tile)
