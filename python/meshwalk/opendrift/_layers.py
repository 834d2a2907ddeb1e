"""Layers of ocean models for OpenDrift: how high they are, and values between two of them."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Hashable

    import xarray
    from numpy.typing import NDArray

    from meshwalk._locations import Locations

_SIGMA = {"ocean_sigma_coordinate", "ocean_sigma/general_coordinate"}
_HEIGHTS = {"zcor", "zCoordinates"}
"""SCHISM's heights of layers, which have no attribute that tells."""
_METRES = {"m", "meter", "meters", "metre", "metres"}


class Layers(NamedTuple):
    """The heights of the layers along one dimension."""

    dim: Hashable
    coordinate: Hashable
    """The variable of the dataset that tells where the layers are."""
    sign: int
    """1 if its values grow upwards, -1 if they grow downwards."""
    depth: Hashable | None
    """Of sigma layers: the depth of the bottom, of which the values are fractions. Else None."""


def find_layers(
    dataset: xarray.Dataset,
    dim: Hashable,
    vertex_dim: Hashable | None,
    time_axis: Hashable | None,
) -> Layers | None:
    """Find what tells the heights of the layers along `dim`: None if nothing does."""
    for name, variable in dataset.variables.items():
        if dim not in variable.dims or not set(variable.dims) <= {dim, vertex_dim, time_axis}:
            continue
        positive = variable.attrs.get("positive")
        sign = {"up": 1, "down": -1}.get(str(positive).lower(), 0)
        if variable.attrs.get("standard_name") in _SIGMA:
            depth = _formula_term(variable, "depth") or "h"
            if depth in dataset.variables and set(dataset[depth].dims) <= {vertex_dim}:
                return Layers(dim, name, sign or 1, depth)
        elif name in _HEIGHTS or (sign and variable.attrs.get("units") in _METRES):
            return Layers(dim, name, sign or 1, None)
    return None


def _formula_term(variable: xarray.Variable, term: str) -> str | None:
    """The variable that CF's `formula_terms` names for a term, as in ``"sigma: s depth: h"``."""
    words = str(variable.attrs.get("formula_terms", "")).replace(":", " : ").split()
    for i in range(len(words) - 2):
        if words[i] == term and words[i + 1] == ":":
            return words[i + 2]
    return None


def heights(
    layers: Layers,
    dataset: xarray.Dataset,
    axes: tuple[Hashable | None, Hashable | None],
    step: int,
    hit: Locations,
) -> NDArray[np.float64]:
    """The heights of the layers at places, in metres: shape (places, layers).

    `axes` are the dimensions of time and of vertices.
    """
    vertex_dim = axes[1]
    at = layers.sign * _at_places(dataset[layers.coordinate], layers.dim, axes, step, hit)
    if layers.depth is None:
        return at
    depth = dataset[layers.depth]
    bottom = hit.interpolate(depth.to_numpy()) if vertex_dim in depth.dims else depth.to_numpy()
    return at * np.reshape(bottom, (-1, 1))


def _at_places(
    variable: xarray.DataArray,
    dim: Hashable,
    axes: tuple[Hashable | None, Hashable | None],
    step: int,
    hit: Locations,
) -> NDArray[np.float64]:
    time_axis, vertex_dim = axes
    if time_axis in variable.dims:
        variable = variable.isel({time_axis: step})
    if vertex_dim not in variable.dims:
        return np.broadcast_to(variable.to_numpy().astype(np.float64), (len(hit), variable.size))
    return np.asarray(hit.interpolate(variable.transpose(vertex_dim, dim).to_numpy()), np.float64)


def between(
    values: NDArray[np.float64], heights: NDArray[np.float64], z: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Interpolate linearly between layers; beyond the first and the last their values.

    Parameters
    ----------
    values, heights : ndarray, shape (n, layers)
        For each place. Layers without a height, or without a value, count for nothing.
    z : ndarray, shape (n,)
        Heights wanted.

    Returns
    -------
    ndarray, shape (n,)
        NaN for places without any layer.
    """
    known = np.isfinite(values) & np.isfinite(heights)
    below = np.where(known & (heights <= z[:, None]), heights, -np.inf)
    above = np.where(known & (heights >= z[:, None]), heights, np.inf)
    low, high = below.argmax(axis=1), above.argmin(axis=1)
    row = np.arange(len(values))
    no_low, no_high = np.isinf(below[row, low]), np.isinf(above[row, high])
    low, high = np.where(no_low, high, low), np.where(no_high, low, high)
    span = heights[row, high] - heights[row, low]
    part = np.where(span > 0, (z - heights[row, low]) / np.where(span > 0, span, 1), 0)
    found = (1 - part) * values[row, low] + part * values[row, high]
    return np.where(no_low & no_high, np.nan, found)
