"""Reader for users of OpenDrift: currents on a triangle mesh, from the triangle of each element.

>>> from meshwalk.opendrift import Reader
>>> Reader.__mro__[1].__name__
'UnstructuredReader'
"""

from __future__ import annotations

import warnings
from bisect import bisect_right
from typing import TYPE_CHECKING, Any

import numpy as np
import xarray
from opendrift.readers.basereader.unstructured import UnstructuredReader

import meshwalk.xarray
from meshwalk._locator import Locator
from meshwalk.opendrift import _layers

if TYPE_CHECKING:
    import os
    from collections.abc import Hashable, Sequence
    from datetime import datetime

    from numpy.typing import ArrayLike, NDArray

    from meshwalk._locations import Locations

__all__ = ["Reader"]

_ALIASES = {
    "eastward_sea_water_velocity": "x_sea_water_velocity",
    "northward_sea_water_velocity": "y_sea_water_velocity",
    "eastward_wind": "x_wind",
    "northward_wind": "y_wind",
    "sea_floor_depth_below_geoid": "sea_floor_depth_below_sea_level",
}
"""CF names, in lower case, and those of OpenDrift, as its own readers of FVCOM have them."""


class Reader(UnstructuredReader):  # type: ignore[misc] # OpenDrift is not typed
    """Values on a mesh for OpenDrift, each from the triangle that contains the element.

    Parameters
    ----------
    dataset : xarray.Dataset, str or path-like
        A dataset, or its file, in any layout that `meshwalk.xarray` knows.
    name : str, optional
        What OpenDrift calls the reader.
    proj4 : str, optional
        The projection of the mesh. Not needed for longitudes and latitudes in degrees, nor where
        the dataset tells it.

    Attributes
    ----------
    variable_mapping : dict
        The variable of the dataset for each of OpenDrift's names. Variables are known by their CF
        standard names.

    Raises
    ------
    InputError
        No mesh is found, or its triangles overlap.
    ValueError
        The projection is not known; no variable along the mesh has a standard name.

    Notes
    -----
    Values at vertices are interpolated in the triangle, those of faces taken as they are, and both
    are interpolated between two times. Elements outside of the mesh, in its bays and holes too, are
    not covered, so that OpenDrift asks the next reader.

    Values in layers are interpolated linearly between the two layers at the depth of the element;
    above the first and below the last layer they are that layer's. Known are sigma layers (a CF
    standard name, and the depth of the bottom), SCHISM's heights of layers, and layers with one
    depth or height in metres and the attribute ``positive``. As in OpenDrift's own readers, depths
    of sigma layers do not follow the tide. Variables with a standard name whose layers are not
    known are left out, with a warning that names them: choose a layer first, such as
    ``dataset.isel(layer=0)``.
    """

    def __init__(
        self,
        dataset: xarray.Dataset | str | os.PathLike[str],
        name: str | None = None,
        proj4: str | None = None,
    ) -> None:
        if not isinstance(dataset, xarray.Dataset):
            name = name or str(dataset)
            dataset = xarray.open_dataset(dataset)
        self.name = name or "meshwalk"
        self.dataset = dataset
        self._access = dataset.meshwalk
        mesh = self._access.mesh
        self.proj4 = proj4 or ("+proj=latlong" if mesh.crs == "EPSG:4326" else mesh.crs)
        if self.proj4 is None:
            raise ValueError("the dataset tells no projection: give it as proj4")
        self._locator = Locator(mesh)
        self.x, self.y = mesh.points.T
        used = mesh.points[np.unique(mesh.triangles)]
        (self.xmin, self.ymin), (self.xmax, self.ymax) = used.min(axis=0), used.max(axis=0)
        self._set_times()
        self._layers: dict[Hashable, _layers.Layers] = {}
        self.variable_mapping = self._names()
        if not self.variable_mapping:
            raise ValueError("no variable along the mesh has a CF standard name")
        self.variables = list(self.variable_mapping)
        self._step: dict[tuple[Hashable, int], NDArray[np.float64]] = {}
        super().__init__()

    def _set_times(self) -> None:
        axis = meshwalk.xarray._time_dim(self.dataset)
        self._time_axis = axis if axis in self.dataset.variables else None
        self.times: list[datetime] | None = None
        self.start_time = self.end_time = self.time_step = None
        if self._time_axis is None:
            return
        stamps = self.dataset[self._time_axis].to_numpy()
        if stamps.dtype.kind != "M":
            raise ValueError(f"the times {self._time_axis} are no dates: open it with decode_times")
        self.times = stamps.astype("datetime64[us]").astype(object).tolist()
        self.start_time, self.end_time = self.times[0], self.times[-1]
        if len(self.times) > 1:
            self.time_step = self.times[1] - self.times[0]

    def _names(self) -> dict[str, Hashable]:
        names: dict[str, Hashable] = {}
        left_out: list[str] = []
        for name, variable in self.dataset.data_vars.items():
            along = set(variable.dims) & {self._access.vertex_dim, self._access.face_dim}
            standard = str(variable.attrs.get("standard_name", "")).lower().replace(" ", "_")
            others = set(variable.dims) - along - {self._time_axis}
            if not standard or not along:
                continue
            if others and not self._find_layers(others):
                left_out.append(f"{name} (along {', '.join(sorted(map(str, others)))})")
            else:
                names[_ALIASES.get(standard, standard)] = name
        if left_out:
            warnings.warn(
                f"left out, for nothing tells where its layers are: {'; '.join(left_out)}. Choose"
                " a layer first, with dataset.isel",
                stacklevel=3,
            )
        coordinates = {layers.coordinate for layers in self._layers.values()}
        return {known: name for known, name in names.items() if name not in coordinates}

    def _find_layers(self, dims: set[Hashable]) -> bool:
        """Find whether the dimensions are one of layers whose heights are known."""
        if len(dims) != 1:
            return False
        (dim,) = dims
        if dim not in self._layers:
            vertex_dim, axis = self._access.vertex_dim, self._time_axis
            found = _layers.find_layers(self.dataset, dim, vertex_dim, axis)
            if found is None:
                return False
            self._layers[dim] = found
        return True

    def covers_positions(self, x: ArrayLike, y: ArrayLike, z: Any = 0) -> NDArray[np.bool_]:
        """Tell which positions are in a triangle."""
        return self._locate(x, y).inside

    def _locate(self, x: ArrayLike, y: ArrayLike) -> Locations:
        place = np.stack([np.atleast_1d(x), np.atleast_1d(y)], axis=-1).astype(np.float64)
        return self._locator.locate(place)

    def get_variables(
        self,
        requested_variables: Sequence[str],
        time: datetime | None = None,
        x: ArrayLike | None = None,
        y: ArrayLike | None = None,
        z: ArrayLike | None = None,
    ) -> dict[str, Any]:
        """Take the values of variables at positions and a time, for OpenDrift.

        Returns
        -------
        dict
            A masked array for each variable: masked where a position is in no triangle, and where
            there is no value.
        """
        names, time, x, y, z, _ = self.check_arguments(requested_variables, time, x, y, z)
        hit = self._locate(x, y)
        depth = np.broadcast_to(np.asarray(0 if z is None else z, np.float64), hit.shape)
        before, part = self._between(time)
        result: dict[str, Any] = {}
        for name in names:
            values = self._at(name, before, hit, depth)
            if part > 0:
                values = (1 - part) * values + part * self._at(name, before + 1, hit, depth)
            result[name] = np.ma.masked_invalid(values)
        return result

    def _between(self, time: datetime | None) -> tuple[int, float]:
        """The step before a time, and which part of the way to the next one it is."""
        if self.times is None or time is None or len(self.times) < 2:
            return 0, 0.0
        before = min(max(bisect_right(self.times, time) - 1, 0), len(self.times) - 1)
        if before == len(self.times) - 1:
            return before, 0.0
        passed = (time - self.times[before]).total_seconds()
        return before, passed / (self.times[before + 1] - self.times[before]).total_seconds()

    def _at(
        self, name: str, step: int, hit: Locations, z: NDArray[np.float64]
    ) -> NDArray[np.float64]:
        known = self.variable_mapping[name]
        dims = self.dataset[known].dims
        at_vertices = self._access.vertex_dim in dims
        values = self._load(known, step)
        if at_vertices:
            found = np.asarray(hit.interpolate(values))
        else:
            face = self._access._found[3]
            found = np.asarray(hit.of_triangles(values if face is None else values[face]))
        if found.ndim == 1:
            return found
        layers = next(self._layers[dim] for dim in dims if dim in self._layers)
        axes = self._time_axis, self._access.vertex_dim
        return _layers.between(found, _layers.heights(layers, self.dataset, axes, step, hit), z)

    def _load(self, known: Hashable, step: int) -> NDArray[np.float64]:
        """The values of a step: along the mesh, then along layers if there are some."""
        variable = self.dataset[known]
        steady = self._time_axis not in variable.dims
        key = known, 0 if steady else step
        if key not in self._step:
            # Two steps are in use at a time.
            self._step = {k: v for k, v in self._step.items() if k[1] >= step - 1 or k[0] != known}
            chosen = variable if steady else variable.isel({self._time_axis: step})
            along = {self._access.vertex_dim, self._access.face_dim} & set(chosen.dims)
            self._step[key] = np.asarray(chosen.transpose(*along, ...).to_numpy(), np.float64)
        return self._step[key]
