"""Point location for dask: arrays, dataframes and xarray objects of any size.

A mesh is given as the path of a prepared file or of a folder of tiles. Tasks carry the path and a
checksum; each worker process maps the file once. Answers are those of `Locator`, bit for bit, and
come when they are computed, chunk by chunk.

>>> import dask.array, meshwalk.dask, os, tempfile
>>> name = os.path.join(tempfile.mkdtemp(), "square.mwm")
>>> mesh = meshwalk.Mesh([[0, 0], [4, 0], [4, 4], [0, 4]], [[0, 1, 2], [0, 2, 3]])
>>> meshwalk.Locator(mesh).prepare(name)
>>> xy = dask.array.from_array([[3.0, 1.0], [1.0, 3.0], [9.0, 9.0]], chunks=(2, 2))
>>> meshwalk.dask.locate(name, xy).triangle.compute()
array([ 0,  1, -1], dtype=int32)

It needs ``pip install 'meshwalk[dask]'``.
"""

from __future__ import annotations

import dataclasses
import math
import os
import threading
from collections import OrderedDict
from typing import TYPE_CHECKING, Any

import dask
import dask.array as da
import numpy as np

from meshwalk import _arrays
from meshwalk._errors import InputError
from meshwalk._locations import LOCATION
from meshwalk._locations import Locations as _Locations
from meshwalk._locator import Locator
from meshwalk._operator import Operator as _Operator
from meshwalk._prepared import map as _map
from meshwalk._tiles import TileLocations, Tiles
from meshwalk._tiling import INDEX
from meshwalk._where import Where

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from numpy.typing import ArrayLike, NDArray

    Prepared = str | os.PathLike[str] | Locator | Tiles

__all__ = ["Locations", "Operator", "locate", "operator", "sample"]

_KEPT = 16
"""So many meshes stay mapped in a process, beside those that tasks are using."""

_MEMORY = 2**30
"""Bytes of tiles that stay mapped, where nothing is said."""

_opened: OrderedDict[_Source, Locator | Tiles] = OrderedDict()
_lock = threading.Lock()


@dataclasses.dataclass(frozen=True)
class _Source:
    """A mesh as tasks carry it."""

    path: str
    trust: bool
    checksum: int
    memory: int
    """Of tiles: so many bytes stay mapped."""

    def open(self) -> Locator | Tiles:
        """The mesh, mapped when this process first asks for it."""
        with _lock:
            found = _opened.get(self)
            if found is None:
                found = _open(self.path, self.trust, self.memory)
                if _checksum(found) != self.checksum:
                    raise InputError(
                        f"{self.path}: is another prepared mesh here than where the work was"
                        " planned: prepare it anew and plan again, or copy the file"
                    )
                _opened[self] = found
            _opened.move_to_end(self)
            while len(_opened) > _KEPT:
                _opened.popitem(last=False)
            return found


def _open(path: str, trust: bool, memory: int) -> Locator | Tiles:
    if os.path.exists(os.path.join(path, INDEX)):
        return Tiles(path, trust, memory=memory)
    return _map(path, trust)


def _checksum(mesh: Locator | Tiles) -> int:
    if isinstance(mesh, Tiles):
        return mesh.checksum
    assert mesh.mesh._mapped is not None
    return mesh.mesh._mapped[2]


def _source(mesh: Prepared, trust: bool) -> _Source:
    if isinstance(mesh, Tiles):
        return _Source(mesh.folder, mesh.trust or trust, mesh.checksum, mesh.memory)
    if isinstance(mesh, Locator):
        if mesh.mesh._mapped is None:
            raise TypeError(
                "the locator is in memory only: write it to a file that workers can map"
                " (Locator.prepare), and give the path"
            )
        path, trusted, checksum = mesh.mesh._mapped
        return _Source(path, trusted or trust, checksum, _MEMORY)
    path = os.path.abspath(os.fsdecode(_arrays.path(mesh)))
    # The header tells the checksum; what it is the sum of is checked when the file is opened.
    return _Source(path, trust, _checksum(_open(path, True, _MEMORY)), _MEMORY)


def _names(source: _Source) -> tuple[list[str], list[str]]:
    """The names of the fields of vertices, and of those of triangles."""
    mesh = source.open()
    if isinstance(mesh, Tiles):
        return mesh.field_names, mesh.triangle_field_names
    return list(mesh.mesh.fields), list(mesh.mesh.triangle_fields)


def _check_fields(source: _Source, fields: Sequence[str]) -> None:
    if not fields:
        raise ValueError("fields must name one field at least")
    of_vertices, of_triangles = _names(source)
    known = of_vertices + of_triangles
    for name in fields:
        if name not in known:
            there = ", ".join(map(repr, known)) or "none"
            raise KeyError(f"the mesh has no field {name!r}; it has {there}")


def _check_tolerance(source: _Source, tolerance: float) -> None:
    """Refuse here and now what the workers would refuse."""
    mesh = source.open()
    if isinstance(mesh, Locator):
        mesh._check_tolerance(tolerance)


def _check_kind(dtype: Any, name: str) -> None:
    if getattr(dtype, "kind", "O") not in "fiu":
        raise TypeError(f"{name} must be real numbers, not {dtype}")


# --- what tasks do: each takes a chunk and what it needs to know ---------------------------------

# An answer in tiles remembers the tile, where its triangle is looked up again.
_IN_TILES = np.dtype([("record", LOCATION), ("tile", np.int32)])


def _answer_type(source: _Source) -> np.dtype[Any]:
    return _IN_TILES if isinstance(source.open(), Tiles) else LOCATION


def _locate_chunk(xy: NDArray[Any], source: _Source, tolerance: float) -> NDArray[Any]:
    hit = source.open().locate(xy, tolerance, threads=1)
    if not isinstance(hit, TileLocations):
        return hit.records
    answers = np.zeros(hit.shape, _IN_TILES)
    answers["record"], answers["tile"] = hit.records, hit.tile
    return answers


def _hit(answers: NDArray[Any], source: _Source) -> _Locations:
    mesh = source.open()
    if isinstance(mesh, Tiles):
        return TileLocations(mesh, answers["record"], answers["tile"])
    return _Locations(mesh.mesh, answers)


def _values(hit: _Locations, source: _Source, field: str) -> NDArray[Any]:
    return hit.interpolate(field, 1) if field in _names(source)[0] else hit.of_triangles(field)


def _interpolate_chunk(answers: NDArray[Any], source: _Source, field: str) -> NDArray[Any]:
    return _values(_hit(answers, source), source, field)


def _sample_chunk(
    xy: NDArray[Any], source: _Source, fields: Sequence[str], tolerance: float
) -> NDArray[Any]:
    hit = source.open().locate(xy, tolerance, threads=1)
    return np.stack([_values(hit, source, field) for field in fields], axis=-1)


def _weights_chunk(answers: NDArray[Any]) -> NDArray[Any]:
    weights: NDArray[Any] = answers["weights"]
    return weights


def _operator_chunk(answers: NDArray[Any], source: _Source) -> NDArray[Any]:
    """The weights of a chunk of points: one object in an array of as many dimensions."""
    out = np.empty((1,) * answers.ndim, object)
    out[(0,) * answers.ndim] = _Operator(_hit(answers, source), 1)
    return out


def _apply_chunk(
    weights: NDArray[Any], values: NDArray[Any], leave_out_missing: bool
) -> NDArray[Any]:
    operator: _Operator = weights.reshape(-1)[0]
    return operator.apply(values, 1, leave_out_missing=leave_out_missing)


def _pair_chunk(x: NDArray[Any], y: NDArray[Any]) -> NDArray[Any]:
    return np.stack([x, y], axis=-1)


# --- dask arrays ---------------------------------------------------------------------------------


def _array_points(points: Any) -> Any:
    """Points as a dask array whose last axis, of two, is in one chunk."""
    if not isinstance(points, da.Array):
        raise TypeError(
            "points must be a dask array, a dask dataframe or an xarray Dataset, not"
            f" {type(points).__module__}.{type(points).__name__}"
        )
    if points.ndim == 0 or points.shape[-1] != 2:
        raise ValueError(f"points must have the shape (..., 2), not {points.shape}")
    _check_kind(points.dtype, "points")
    return points.rechunk({points.ndim - 1: -1})


def _located(source: _Source, points: Any, tolerance: float) -> Locations:
    _check_tolerance(source, tolerance)
    kind = _answer_type(source)
    answers = da.map_blocks(
        _locate_chunk,
        points,
        source,
        tolerance,
        drop_axis=points.ndim - 1,
        dtype=kind,
        meta=np.empty((0,) * (points.ndim - 1), kind),
    )
    return Locations(source, answers)


class Locations:
    """Where points of a dask array lie: the answer of `locate`, as dask arrays."""

    def __init__(self, source: _Source, answers: Any) -> None:
        self._source = source
        self._answers = answers

    @property
    def records(self) -> Any:
        """All answers, of the points' shape and chunks, as `meshwalk.Locations.records`."""
        return self._answers["record"] if self._answers.dtype == _IN_TILES else self._answers

    @property
    def triangle(self) -> Any:
        """The triangle that contains each point, -1 for none."""
        return self.records["triangle"]

    @property
    def where(self) -> Any:
        """Where each point lies: the numbers of `meshwalk.Where`."""
        return self.records["where"]

    @property
    def hole(self) -> Any:
        """Number of the hole in which each point lies, -1 for none."""
        return self.records["hole"]

    @property
    def local(self) -> Any:
        """The local edge or vertex that a point is on; 255 for none."""
        return self.records["local"]

    @property
    def weights(self) -> Any:
        """Weights of the three vertices of the triangle, shape (..., 3)."""
        records = self.records
        return da.map_blocks(
            _weights_chunk,
            records,
            new_axis=records.ndim,
            chunks=(*records.chunks, (3,)),
            dtype=np.float64,
        )

    @property
    def inside(self) -> Any:
        """True where a triangle contains the point, its border included."""
        return self.where <= int(Where.VERTEX)

    @property
    def shape(self) -> tuple[int, ...]:
        """The shape of the points, without their coordinates."""
        shape: tuple[int, ...] = self._answers.shape
        return shape

    def interpolate(self, field: str) -> Any:
        """Interpolate a field of the mesh's file.

        Parameters
        ----------
        field : str
            Of vertices; of triangles, their values are taken as they are. For other values see
            `operator`.

        Returns
        -------
        dask.array.Array
            Of float64, NaN where there is no triangle.
        """
        _check_fields(self._source, [field])
        return da.map_blocks(_interpolate_chunk, self._answers, self._source, field, dtype=float)

    def operator(self) -> Operator:
        """The weights, kept for field after field.

        Returns
        -------
        Operator
        """
        return Operator._of(self._source, self._answers)

    def persist(self, **options: Any) -> Locations:
        """Compute the answers, and keep them in the workers' memory.

        Returns
        -------
        Locations
        """
        return Locations(self._source, self._answers.persist(**options))

    def compute(self, **options: Any) -> _Locations:
        """Compute the answers as one `meshwalk.Locations` of this process.

        Returns
        -------
        meshwalk.Locations
        """
        return _hit(self._answers.compute(**options), self._source)

    def __repr__(self) -> str:
        return f"<dask Locations: shape {self.shape}, {self._answers.npartitions} chunks>"


class Operator:
    """Weights of located points, chunk by chunk: interpolates values at the vertices.

    Each chunk of points has a `meshwalk.Operator`, which is made by the workers.

    Attributes
    ----------
    shape : tuple of int
        The number of points, and of vertices.
    """

    def __init__(self, chunks: tuple[tuple[int, ...], ...], vertices: int, weights: Any) -> None:
        self._chunks = chunks
        self._weights = weights
        self.shape = (math.prod(map(sum, chunks)), vertices)

    @classmethod
    def _of(cls, source: _Source, answers: Any) -> Operator:
        mesh = source.open()
        vertices = mesh.vertex_count if isinstance(mesh, Tiles) else mesh.mesh.vertex_count
        weights = da.map_blocks(
            _operator_chunk,
            answers,
            source,
            dtype=object,
            chunks=tuple((1,) * len(sizes) for sizes in answers.chunks),
            meta=np.empty((0,) * answers.ndim, object),
        )
        return cls(answers.chunks, vertices, weights)

    def apply(self, values: ArrayLike | Any, *, leave_out_missing: bool = False) -> Any:
        """Interpolate values at the vertices.

        Parameters
        ----------
        values : dask.array.Array or array_like, shape (n_vertices, ...)
            Further axes may have any chunks; along the vertices one chunk is made of all, and each
            task holds it.
        leave_out_missing : bool, optional
            As of `meshwalk.Operator.apply`.

        Returns
        -------
        dask.array.Array, shape ``points.shape + values.shape[1:]``
        """
        given = values if isinstance(values, da.Array) else _as_dask(values)
        if given.ndim == 0 or given.shape[0] != self.shape[1]:
            raise ValueError(
                f"values must have a row for each of the {self.shape[1]} vertices; their shape is"
                f" {given.shape}"
            )
        _check_kind(given.dtype, "values")
        given = given.rechunk({0: -1})
        axes = iter(range(len(self._chunks) + given.ndim))
        points = tuple(next(axes) for _ in self._chunks)
        vertices, *others = axes
        kind = np.float32 if given.dtype in (np.float16, np.float32) else np.float64
        return da.blockwise(
            _apply_chunk,
            (*points, *others),
            self._weights,
            points,
            given,
            (vertices, *others),
            adjust_chunks=dict(zip(points, self._chunks, strict=True)),
            concatenate=True,
            leave_out_missing=leave_out_missing,
            dtype=kind,
            meta=np.empty((0,) * (len(points) + len(others)), kind),
        )

    def __matmul__(self, values: ArrayLike | Any) -> Any:
        return self.apply(values)

    def persist(self, **options: Any) -> Operator:
        """Make the weights, and keep them in the workers' memory.

        Returns
        -------
        Operator
        """
        return Operator(self._chunks, self.shape[1], self._weights.persist(**options))

    def __repr__(self) -> str:
        points, vertices = self.shape
        return f"<dask Operator: {points} points, {vertices} vertices>"


def _as_dask(values: ArrayLike) -> Any:
    array = np.asanyarray(values)
    return da.from_array(array, chunks=array.shape)


# --- dataframes and xarray -----------------------------------------------------------------------

_COLUMNS: dict[str, Any] = {
    "triangle": np.dtype(np.int32),
    "where": np.dtype(np.uint8),
    "hole": np.dtype(np.int32),
    "w0": np.dtype(np.float64),
    "w1": np.dtype(np.float64),
    "w2": np.dtype(np.float64),
}


def _is_frame(points: Any) -> bool:
    return hasattr(points, "map_partitions") and hasattr(points, "columns")


def _is_dataset(points: Any) -> bool:
    return hasattr(points, "data_vars") and hasattr(points, "coords")


def _frame_points(frame: Any, x: str, y: str) -> NDArray[np.float64]:
    """Points of a part of a dataframe; missing numbers are NaN."""
    columns = [frame[name].to_numpy(dtype=np.float64, na_value=np.nan) for name in (x, y)]
    return np.stack(columns, axis=-1)


def _frame_array(frame: Any, x: str, y: str) -> Any:
    """The points of a dataframe as a dask array with a chunk for each part."""
    _check_columns(frame, x, y)
    lengths = frame.map_partitions(len).compute()
    parts = [
        da.from_delayed(dask.delayed(_frame_points)(part, x, y), (int(length), 2), np.float64)
        for part, length in zip(frame[[x, y]].to_delayed(), lengths, strict=True)
    ]
    return da.concatenate(parts)


def _check_columns(frame: Any, x: str, y: str) -> None:
    for name in (x, y):
        if name not in frame.columns:
            raise KeyError(f"there is no column {name!r}; there are {list(frame.columns)}")
        _check_kind(frame[name].dtype, f"column {name!r}")


def _locate_frame(frame: Any, source: _Source, x: str, y: str, tolerance: float) -> Any:
    hit = source.open().locate(_frame_points(frame, x, y), tolerance, threads=1)
    arrays = {name: getattr(hit, name) for name in ("triangle", "where", "hole")}
    return frame.assign(**arrays, **{f"w{k}": hit.weights[:, k] for k in range(3)})


def _sample_frame(
    frame: Any, source: _Source, x: str, y: str, fields: Sequence[str], tolerance: float
) -> Any:
    values = _sample_chunk(_frame_points(frame, x, y), source, fields, tolerance)
    return frame.assign(**{name: values[:, k] for k, name in enumerate(fields)})


def _map_frame(
    frame: Any, work: Callable[..., Any], added: dict[str, Any], x: str, y: str, *rest: Any
) -> Any:
    _check_columns(frame, x, y)
    for name in added:
        if name in frame.columns:
            raise ValueError(f"there is a column {name!r} already: rename it")
    meta = frame._meta.assign(**{name: np.empty(0, kind) for name, kind in added.items()})
    return frame.map_partitions(work, *rest, meta=meta)


def _grid(dataset: Any, x: str, y: str) -> tuple[Any, tuple[Any, ...]]:
    """The points of a dataset as a dask array (..., 2), and the names of its axes."""
    import xarray as xr

    for name in (x, y):
        if name not in dataset.variables:
            known = ", ".join(map(repr, dataset.variables))
            raise KeyError(f"the dataset has no variable {name!r}; it has {known}")
        _check_kind(dataset[name].dtype, f"variable {name!r}")
    form = [one.variable for one in xr.broadcast(dataset[x], dataset[y])]
    chunks = {axis: dataset.chunksizes.get(axis, -1) for axis in form[0].dims}
    pair = [one.to_base_variable().astype(np.float64).chunk(chunks).data for one in form]
    kinds = {"new_axis": pair[0].ndim, "chunks": (*pair[0].chunks, (2,)), "dtype": np.float64}
    return da.map_blocks(_pair_chunk, *pair, **kinds), form[0].dims


def _added(dataset: Any, axes: tuple[Any, ...], arrays: dict[str, Any]) -> Any:
    for name in arrays:
        if name in dataset.variables:
            raise ValueError(f"there is a variable {name!r} already: rename it")
    return dataset.assign({name: (axes, array) for name, array in arrays.items()})


def locate(
    mesh: Prepared,
    points: Any,
    tolerance: float = 0,
    *,
    x: str = "x",
    y: str = "y",
    trust: bool = False,
) -> Any:
    """Find the triangles that contain points, lazily.

    Parameters
    ----------
    mesh : str, path-like, Locator or Tiles
        A prepared file (``.mwm``) or a folder that `prepare_tiles` made, at the same place for
        all workers; or what `map` gave, or `Tiles`, whose `memory` then holds for each worker.
    points : dask.array.Array, dask.dataframe.DataFrame or xarray.Dataset
        An array of the shape (..., 2); a dataframe or dataset that has x and y. A dataset's x and y
        are broadcast, as of a grid with the axes x and y; one without chunks is one chunk.
    tolerance : float, optional
        As of `Locator.locate`.
    x, y : str, optional
        The names of the columns or variables.
    trust : bool, optional
        As of `map`: nothing is checked. Otherwise each worker process checks the file once.

    Returns
    -------
    Locations, dask.dataframe.DataFrame or xarray.Dataset
        For an array `Locations`, of dask arrays. For a dataframe the same with the columns
        ``triangle``, ``where``, ``hole``, ``w0``, ``w1`` and ``w2``; for a dataset, with variables
        of these names.

    Raises
    ------
    OSError
        The mesh cannot be opened: here, or, when it is computed, in a worker.
    InputError
        It is damaged; or a worker has another file at its place.

    Notes
    -----
    Each task uses one thread. A task that is lost with its worker is done again by another, with
    the same result. The process keeps up to 16 meshes mapped.
    """
    source = _source(mesh, trust)
    if _is_frame(points):
        _check_tolerance(source, tolerance)
        return _map_frame(points, _locate_frame, _COLUMNS, x, y, source, x, y, tolerance)
    if not _is_dataset(points):
        return _located(source, _array_points(points), tolerance)
    pairs, axes = _grid(points, x, y)
    hit = _located(source, pairs, tolerance)
    arrays = {name: getattr(hit, name) for name in ("triangle", "where", "hole")}
    return _added(points, axes, arrays | {f"w{k}": hit.weights[..., k] for k in range(3)})


def sample(
    mesh: Prepared,
    points: Any,
    fields: str | Sequence[str] = "z",
    tolerance: float = 0,
    *,
    x: str = "x",
    y: str = "y",
    trust: bool = False,
) -> Any:
    """Interpolate fields of the mesh's file at points, lazily.

    Parameters
    ----------
    mesh, points, tolerance, x, y, trust
        As of `locate`.
    fields : str or sequence of str, optional
        Fields of vertices are interpolated; of fields of triangles, the triangle's value is taken.

    Returns
    -------
    dask.array.Array, dask.dataframe.DataFrame or xarray.Dataset
        For an array one of its shape, with a last axis more where `fields` is a sequence. For a
        dataframe or dataset the same with a column or variable for each field. NaN where there is
        no triangle.
    """
    source = _source(mesh, trust)
    names = [fields] if isinstance(fields, str) else list(fields)
    _check_fields(source, names)
    _check_tolerance(source, tolerance)
    if _is_frame(points):
        added = dict.fromkeys(names, np.dtype(np.float64))
        return _map_frame(points, _sample_frame, added, x, y, source, x, y, names, tolerance)
    is_dataset = _is_dataset(points)
    pairs, axes = _grid(points, x, y) if is_dataset else (_array_points(points), ())
    values = da.map_blocks(
        _sample_chunk,
        pairs,
        source,
        names,
        tolerance,
        dtype=np.float64,
        chunks=(*pairs.chunks[:-1], (len(names),)),
    )
    if is_dataset:
        return _added(points, axes, {name: values[..., k] for k, name in enumerate(names)})
    return values[..., 0] if isinstance(fields, str) else values


def operator(
    mesh: Prepared,
    points: Any,
    tolerance: float = 0,
    *,
    x: str = "x",
    y: str = "y",
    trust: bool = False,
) -> Operator:
    """Locate points once, and keep their weights for field after field.

    Parameters
    ----------
    mesh, points, tolerance, x, y, trust
        As of `locate`; of a dataframe the points are its rows.

    Returns
    -------
    Operator
        ``operator @ values`` interpolates values at the vertices; `Operator.persist` keeps the
        weights in the workers' memory.
    """
    source = _source(mesh, trust)
    if _is_frame(points):
        pairs = _frame_array(points, x, y)
    elif _is_dataset(points):
        pairs, _ = _grid(points, x, y)
    else:
        pairs = points
    return _located(source, _array_points(pairs), tolerance).operator()
