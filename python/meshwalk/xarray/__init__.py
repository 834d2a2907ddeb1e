"""Accessor for users of xarray: the values of a dataset's mesh at points.

>>> import numpy as np, xarray
>>> import meshwalk.xarray
>>> ds = xarray.Dataset(
...     {
...         "mesh": ((), 0, {"cf_role": "mesh_topology", "topology_dimension": 2,
...                          "node_coordinates": "x y", "face_node_connectivity": "corners"}),
...         "corners": (("face", "three"), np.array([[0, 1, 2], [0, 2, 3]], np.int32)),
...         "depth": (("time", "node"), [[0.0, 4.0, 8.0, 4.0], [1.0, 1.0, 1.0, 1.0]]),
...     },
...     coords={"x": ("node", [0.0, 4.0, 4.0, 0.0]), "y": ("node", [0.0, 0.0, 4.0, 4.0])},
... )
>>> ds.meshwalk.sample([[3, 1], [1, 3], [9, 9]], "depth").depth.to_numpy()
array([[ 4.,  4., nan],
       [ 1.,  1., nan]])

Importing this module gives all datasets of xarray the attribute ``meshwalk``.
"""

from __future__ import annotations

import tempfile
from functools import cached_property, partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import xarray

from meshwalk._errors import InputError
from meshwalk._files import read
from meshwalk._locator import Locator
from meshwalk._space.prober import Prober, Touches
from meshwalk._space.star import Star, lonlat_to_direction
from meshwalk._space.surface import Surface

if TYPE_CHECKING:
    from collections.abc import Callable, Hashable, Iterable

    from numpy.typing import ArrayLike, NDArray

    from meshwalk._locations import Locations
    from meshwalk._mesh import Mesh

__all__ = ["MeshAccessor"]

_PROBE = "meshwalk_number_"
_BLOCK_BYTES = 64 << 20
"""About so much of a field in a file is in memory at a time."""


@xarray.register_dataset_accessor("meshwalk")
class MeshAccessor:
    """The mesh of a dataset: ``dataset.meshwalk``, once `meshwalk.xarray` is imported.

    UGRID, and all layouts of netCDF files that `meshwalk.read` knows, wherever the dataset comes
    from: a file, Zarr, a server, memory. The mesh is made when it is first needed.

    Examples
    --------
    >>> import xarray, meshwalk.xarray
    >>> try:
    ...     xarray.Dataset({"depth": ("x", [1.0, 2.0])}).meshwalk.mesh
    ... except meshwalk.InputError as error:
    ...     print("no mesh")
    no mesh
    """

    def __init__(self, dataset: xarray.Dataset) -> None:
        self._dataset = dataset

    @cached_property
    def _found(self) -> tuple[Mesh, Hashable | None, Hashable | None, NDArray[np.intp] | None]:
        """The mesh; the dimension of its vertices; that of its faces; the face of each triangle.

        Which variables hold the mesh, and what is a vertex or a face there, is known to the reader
        of files. So it gets a file of all that can belong to a mesh, and in it numbers along every
        dimension.
        """
        static = _static(self._dataset)
        names = {f"{_PROBE}{k}": name for k, name in enumerate(static.sizes)}
        probes = {n: (d, np.arange(float(static.sizes[d]))) for n, d in names.items()}
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder, "mesh.nc")
            static.assign(probes).to_netcdf(path)
            try:
                mesh = read(path)
            except InputError as error:
                raise InputError(f"no mesh in this dataset: {error}") from None
        vertex = next((names[n] for n in mesh.fields if n in names), None)
        of_faces = [n for n in mesh.triangle_fields if n in names]
        if not of_faces:
            return mesh, vertex, None, None
        face = mesh.triangle_fields[of_faces[0]].astype(np.intp)
        return mesh, vertex, names[of_faces[0]], face

    @property
    def mesh(self) -> Mesh:
        """The mesh. Faces of more than three corners are cut into triangles."""
        return self._found[0]

    @property
    def vertex_dim(self) -> Hashable | None:
        """The dimension along which the vertices lie; None if they have no values (ICON)."""
        return self._found[1]

    @property
    def face_dim(self) -> Hashable | None:
        """The dimension along which the faces lie; None if the dataset has none."""
        return self._found[2]

    @cached_property
    def _locate(self) -> Callable[[NDArray[np.float64]], Locations | Touches]:
        """Finds triangles of `mesh`: in the plane, or on the globe if it goes round it."""
        mesh = self.mesh
        try:
            return Locator(mesh).locate
        except InputError as error:
            if mesh.crs != "EPSG:4326":
                raise
            globe = Surface.from_lonlat(mesh.points, mesh.triangles, weld=True, tolerant=True)
            try:
                return partial(Star(globe).locate, lonlat=True)
            except InputError as other:
                if not _crosses_180(mesh):
                    raise InputError(
                        f"in the plane of longitudes and latitudes {error}; on the globe {other}"
                    ) from None
            return partial(_rays_locate, Prober(globe, boxes=True))

    def sample(
        self,
        points: Any,
        fields: str | Iterable[str] | None = None,
        time: Any = None,
    ) -> xarray.Dataset:
        """Sample fields at points: interpolated between vertices, or the value of the face.

        Parameters
        ----------
        points : array_like of shape (n, 2), or (x, y)
            The points, in the units of the mesh; or a tuple of x and y. DataArrays keep their
            dimensions and coordinates.
        fields : str or iterable of str, optional
            Names of variables, or their CF standard names. By default all variables of real numbers
            that lie along vertices or faces.
        time : optional
            What `xarray.Dataset.sel` takes for the dimension of time: a time, several, or a slice.
            By default all.

        Returns
        -------
        xarray.Dataset
            The fields, with their attributes, where vertices or faces gave way to ``points`` as the
            last dimension; NaN for points in no triangle. The coordinates x and y have the names
            and attributes of the mesh's own, and ``face`` is the face of each point, -1 for none.

        Raises
        ------
        InputError
            No mesh is found, or its triangles overlap.
        KeyError
            There is no such field, or no such time.
        ValueError
            A field lies along neither vertices nor faces.

        Notes
        -----
        Points are located once: in the plane, or on the sphere where the mesh goes round it. There,
        of triangles that overlap, the one nearest to the centre of the sphere counts.
        Fields that are Dask arrays stay lazy. Fields in a file are read block by block, so that one
        need not fit in memory.
        """
        place, dims, coords = self._points(points)
        hit = self._locate(place)
        chosen = self._fields(fields)
        if time is not None:
            axis = _time_dim(self._dataset)
            if axis is None:
                raise KeyError("the dataset has no dimension of time")
            chosen = {name: d.sel({axis: time}) if axis in d.dims else d
                      for name, d in chosen.items()}  # fmt: skip
        sampled = {name: self._sample(field, hit, dims) for name, field in chosen.items()}
        face = hit.triangle.astype(np.intp)
        if self._found[3] is not None:
            face = np.where(face < 0, -1, self._found[3][face])
        result = xarray.Dataset(sampled, attrs=self._dataset.attrs)
        return result.assign_coords({**coords, "face": (dims, face)})

    def _points(
        self, points: Any
    ) -> tuple[NDArray[np.float64], tuple[Hashable, ...], dict[Hashable, Any]]:
        """The points, shape (..., 2); their dimensions; the coordinates that tell them."""
        if isinstance(points, tuple):
            x, y = points
        else:
            rows = np.asarray(points, np.float64)
            if rows.ndim != 2 or rows.shape[1] != 2:
                raise ValueError(f"points must have the shape (n, 2), not {rows.shape}")
            x, y = rows.T
        x, y = (given if isinstance(given, xarray.DataArray) else _bare(given) for given in (x, y))
        x, y = xarray.broadcast(x, y)
        place = np.stack([x.to_numpy(), y.to_numpy()], axis=-1).astype(np.float64)
        coords = {name: (x.dims, value.to_numpy(), attributes) for value, (name, attributes)
                  in zip((x, y), self._coordinate_names(), strict=True)}  # fmt: skip
        kept = {name: value for name, value in x.coords.items() if name not in coords}
        return place, x.dims, {**kept, **coords}

    def _coordinate_names(self) -> list[tuple[Hashable, dict[str, Any]]]:
        """The name and the attributes of x and of y in the dataset, by their values."""
        found: list[tuple[Hashable, dict[str, Any]]] = [("x", {}), ("y", {})]
        for axis, values in enumerate(self.mesh.points.T):
            for name, variable in self._dataset.variables.items():
                along = variable.dims == (self.vertex_dim,) and variable.dtype.kind == "f"
                if along and np.array_equal(variable.to_numpy().astype(np.float64), values):
                    about = {k: v for k, v in variable.attrs.items() if k != "bounds"}
                    found[axis] = (name, about)
                    break
        return found

    def _fields(self, fields: str | Iterable[str] | None) -> dict[Hashable, xarray.DataArray]:
        """The fields wanted, by name."""
        along = {self.vertex_dim, self.face_dim} - {None}
        dataset = self._dataset
        if fields is None:
            return {
                name: field
                for name, field in dataset.data_vars.items()
                if along & set(field.dims) and field.dtype.kind == "f" and not _is_mesh(field)
            }
        chosen = {}
        for name in [fields] if isinstance(fields, str) else fields:
            known = name if name in dataset.variables else _of_standard_name(dataset, name)
            chosen[known] = dataset[known]
            if not along & set(dataset[known].dims):
                dims = ", ".join(map(str, dataset[known].dims))
                raise ValueError(f"{known} ({dims}) lies along neither vertices nor faces")
        return chosen

    def _sample(
        self, field: xarray.DataArray, hit: Locations | Touches, dims: tuple[Hashable, ...]
    ) -> xarray.DataArray:
        """One field at the points, which are its last dimensions."""
        at_vertices = self.vertex_dim in field.dims
        dim = self.vertex_dim if at_vertices else self.face_dim
        face = self._found[3]

        def of_block(block: NDArray[Any]) -> NDArray[Any]:
            values = np.moveaxis(block, -1, 0)
            if at_vertices:
                found = hit.interpolate(values)
            else:
                found = hit.of_triangles(values if face is None else values[face])
            return np.moveaxis(found, range(len(hit.shape)), range(-len(hit.shape), 0))

        def apply(part: xarray.DataArray) -> xarray.DataArray:
            kind = part.dtype if part.dtype.kind == "f" else np.dtype(np.float64)
            result: xarray.DataArray = xarray.apply_ufunc(
                of_block,
                part,
                input_core_dims=[[dim]],
                output_core_dims=[list(dims)],
                dask="parallelized",
                dask_gufunc_kwargs={"output_sizes": dict(zip(dims, hit.shape, strict=True))},
                output_dtypes=[kind],
                keep_attrs=True,
            )
            return result

        field = field.drop_vars([n for n, c in field.coords.items() if dim in c.dims])
        if field.chunks is not None:
            return apply(field.chunk({dim: -1}))
        return _by_blocks(field, dim, apply)


def _crosses_180(mesh: Mesh) -> bool:
    """Tell whether triangles are wider than half of the globe: longitudes jump there."""
    lon = mesh.points[:, 0][mesh.triangles]
    return bool(len(lon) and np.ptp(lon, axis=1).max() > 180)


def _rays_locate(prober: Prober, place: NDArray[np.float64]) -> Touches:
    """What rays from the centre meet first, in a globe that may be open."""
    rays = lonlat_to_direction(place)
    return prober.probe(np.zeros_like(rays), rays, certain=True, extent="ray", faces="both")


def _bare(given: ArrayLike) -> xarray.DataArray:
    values = np.asarray(given, np.float64)
    if values.ndim > 1:
        raise ValueError("x and y of more than one dimension must be DataArrays")
    return xarray.DataArray(values, dims=("points",) * values.ndim)


def _by_blocks(
    field: xarray.DataArray,
    dim: Hashable | None,
    apply: Callable[[xarray.DataArray], xarray.DataArray],
) -> xarray.DataArray:
    """Apply to slices along the first other dimension, so that little is in memory at a time."""
    others = [name for name in field.dims if name != dim]
    step = int(max(1, _BLOCK_BYTES * field.sizes[others[0]] // field.nbytes)) if others else 0
    if not others or step >= field.sizes[others[0]]:
        return apply(field)
    first = others[0]
    slices = range(0, field.sizes[first], step)
    parts = [apply(field.isel({first: slice(k, k + step)})) for k in slices]
    return xarray.concat(parts, first)


def _is_time(variable: Any) -> bool:
    about = {**variable.encoding, **variable.attrs}
    return (
        variable.dtype.kind == "M"
        or about.get("standard_name") == "time"
        or about.get("axis") == "T"
        or " since " in str(about.get("units", ""))
    )


def _time_dim(dataset: xarray.Dataset) -> Hashable | None:
    """The dimension of time, by CF, else by its name."""
    name: Hashable
    for name in dataset.sizes:
        if name in dataset.variables and _is_time(dataset.variables[name]):
            return name
    return "time" if "time" in dataset.sizes else None


def _static(dataset: xarray.Dataset) -> xarray.Dataset:
    """What can belong to the mesh: variables without time, of at most two dimensions."""
    time = _time_dim(dataset)
    kept = []
    for name, variable in dataset.variables.items():
        is_static = time not in variable.dims and not _is_time(variable)
        fits = variable.dtype.kind in "iuf" or "cf_role" in variable.attrs
        if variable.ndim <= 2 and is_static and fits:
            kept.append(name)
    others = [name for name in dataset.coords if name not in kept]
    static = dataset[kept].drop_vars(others, errors="ignore")
    for name in kept:
        if static[name].dtype.kind not in "iuf":
            static[name] = ((), np.int32(0), static[name].attrs)
        static[name].attrs.pop("coordinates", None)
    for encoding in (static.encoding, *(v.encoding for v in static.variables.values())):
        for name in ("unlimited_dims", "coordinates", "chunksizes", "original_shape"):
            encoding.pop(name, None)
    return static


def _is_mesh(field: xarray.DataArray) -> bool:
    return any(key in field.attrs for key in ("cf_role", "start_index"))


def _of_standard_name(dataset: xarray.Dataset, name: str) -> Hashable:
    known: Hashable
    for known, variable in dataset.variables.items():
        if variable.attrs.get("standard_name") == name:
            return known
    raise KeyError(f"no variable has the name or the CF standard name {name!r}")
