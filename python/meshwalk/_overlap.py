"""What two meshes have in common: volumes, areas, and conservative weights."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Literal, NamedTuple

import numpy as np

from meshwalk import _arrays, _core, _esmf
from meshwalk._errors import InputError
from meshwalk._locator import Locator, filled
from meshwalk._mesh import Mesh
from meshwalk._operator import Operator

if TYPE_CHECKING:
    import os

    from numpy.typing import ArrayLike, NDArray

    from meshwalk._core import Progress


class VolumeInfo(NamedTuple):
    """Cut and fill: the answer of `volume`. Areas are those of the plane.

    Attributes
    ----------
    cut : float
        Volume where the surface is above the other: to be cut off.
    fill : float
        Volume where it is below, as a positive number: to be filled.
    cut_area : float
        Area where the surface is above.
    fill_area : float
        Area where it is below.
    level_area : float
        Area of common parts of triangles where both are equal throughout.
    area : float
        Area where both have a height: the sum of these three.
    surface_only : float
        Area where only the surface has a height.
    other_only : float
        Area where only the other one has.
    parts : int
        Common parts of triangles that were added.
    """

    cut: float
    fill: float
    cut_area: float
    fill_area: float
    level_area: float
    area: float
    surface_only: float
    other_only: float
    parts: int


class SurfaceAreaInfo(NamedTuple):
    """The answer of `surface_area`.

    Attributes
    ----------
    area : float
        Area of the plane that both the region and the surface cover.
    surface_area : float
        Area of the surface over it, slopes included.
    region_area : float
        Area of the region.
    parts : int
        Common parts of triangles that were added.
    """

    area: float
    surface_area: float
    region_area: float
    parts: int


def volume(
    surface: Mesh | Locator,
    other: Mesh | Locator | float,
    *,
    heights: ArrayLike | str = "z",
    other_heights: ArrayLike | str = "z",
    threads: int = 0,
    progress: Progress | None = None,
) -> VolumeInfo:
    """Compute cut and fill: the volume between a surface and another one, or a plane.

    Overlaps of triangles are decided exactly; areas and volumes are sums of doubles.

    Parameters
    ----------
    surface : Mesh or Locator
        The surface, in the plane, with a height at each vertex. A mesh gets a locator for this
        call. Bring longitudes and latitudes to a plane first.
    other : Mesh, Locator or float
        The other surface, or the height of a horizontal plane.
    heights, other_heights : array_like, shape (n_vertices,), or str, optional
        The heights at the vertices, or the name of a field. A triangle with one that is not finite
        is not there.
    threads : int, optional
        How many threads work on it; 0 lets the library choose. The answer is the same.
    progress : callable, optional
        As of `Locator.locate`.

    Returns
    -------
    VolumeInfo
        In units of the coordinates and heights.

    Raises
    ------
    InputError
        A mesh is no embedding.
    ValueError
        A locator was made with ``fill="no"``; the plane is not finite.

    Examples
    --------
    >>> import meshwalk
    >>> mesh = meshwalk.Mesh([[0, 0, 1], [4, 0, 1], [4, 4, 1], [0, 4, 1]], [[0, 1, 2], [0, 2, 3]])
    >>> meshwalk.volume(mesh, 0.5).cut
    8.0
    """
    first = filled(surface, "surface")
    values = np.ascontiguousarray(first.mesh._values(heights, "heights"))
    if not isinstance(other, (Mesh, Locator)):
        base = _number(other, "other")
        return VolumeInfo(*_core.volume_above(first, values, base, threads, progress))
    second = filled(other, "other")
    others = np.ascontiguousarray(second.mesh._values(other_heights, "other_heights"))
    return VolumeInfo(
        *_core.volume_between(first, values, second, others, threads, progress),
    )


def _number(given: Any, name: str) -> float:
    try:
        return float(given)
    except (TypeError, ValueError):
        kind = type(given).__name__
        raise TypeError(f"{name} must be a Mesh, a Locator or a number, not {kind}") from None


def surface_area(
    surface: Mesh | Locator,
    region: Mesh | Locator,
    *,
    heights: ArrayLike | str = "z",
    threads: int = 0,
    progress: Progress | None = None,
) -> SurfaceAreaInfo:
    """Compute the area of a surface over a region of the plane, such as a parcel on a slope.

    Parameters
    ----------
    surface : Mesh or Locator
        The surface, in the plane, with a height at each vertex.
    region : Mesh or Locator
        A mesh that covers the region, such as ``constrained_delaunay(points, segments,
        keep="inside")``.
    heights, threads, progress
        As of `volume`.

    Returns
    -------
    SurfaceAreaInfo

    Raises
    ------
    InputError, ValueError
        As of `volume`.

    Examples
    --------
    >>> import meshwalk
    >>> slope = meshwalk.Mesh([[0, 0, 0], [4, 0, 3], [4, 4, 3], [0, 4, 0]], [[0, 1, 2], [0, 2, 3]])
    >>> meshwalk.surface_area(slope, slope).surface_area
    20.0
    """
    first, second = filled(surface, "surface"), filled(region, "region")
    values = np.ascontiguousarray(first.mesh._values(heights, "heights"))
    return SurfaceAreaInfo(*_core.surface_area(first, values, second, threads, progress))


class Pixels(NamedTuple):
    """The pixels of a raster, as a target of `remap`: rows run east, columns run south.

    Attributes
    ----------
    west : float
        The western edge of the first pixel.
    north : float
        Its northern edge.
    width : float
        Of a pixel, positive.
    height : float
        Of a pixel, positive.
    columns : int
        Pixels in a row.
    rows : int
        Number of rows.
    """

    west: float
    north: float
    width: float
    height: float
    columns: int
    rows: int


class Remap:
    """Conservative weights: the answer of `remap`.

    Attributes
    ----------
    weights : Operator
        A row for each target cell and a column for each value of the source: ``weights @ values``.
    source_area, target_area : ndarray
        The area of each column and row; of a vertex the integral of its hat function.
    source_fraction, target_fraction : ndarray
        The fraction of it that the other mesh covers, 0 to 1.
    source_sum, common_sum : float
        The area of the source, and the area that both cover.
    """

    __slots__ = (
        *("common_sum", "source_area", "source_fraction", "source_sum"),
        *("target_area", "target_fraction", "weights"),
    )

    def __init__(
        self,
        weights: Operator,
        areas: tuple[NDArray[np.float64], ...],
        sums: tuple[float, float],
    ) -> None:
        self.weights = weights
        self.source_area, self.source_fraction, self.target_area, self.target_fraction = areas
        self.source_sum, self.common_sum = sums

    def __matmul__(self, values: ArrayLike) -> NDArray[Any]:
        return self.weights @ values

    def to_esmf(self, path: str | os.PathLike[str]) -> None:
        """Write the weights to a netCDF file in ESMF's convention, as xESMF and uxarray read it.

        Parameters
        ----------
        path : str or path-like
            The file, in the 64-bit offset format of netCDF 3. SciPy has to be installed.
        """
        there = self.target_fraction.reshape(-1) > 0
        sides = [
            ("mask_a", "i4", "n_a", np.ones(self.source_area.size, np.int32)),
            ("area_a", "f8", "n_a", self.source_area),
            ("frac_a", "f8", "n_a", self.source_fraction),
            ("mask_b", "i4", "n_b", there.astype(np.int32)),
            ("area_b", "f8", "n_b", self.target_area.reshape(-1)),
            ("frac_b", "f8", "n_b", self.target_fraction.reshape(-1)),
        ]
        matrix = self.weights.tocsr().tocoo()
        _esmf.write(path, "conservative remapping, by meshwalk", matrix, sides)

    def __repr__(self) -> str:
        rows, columns = self.weights.shape
        return f"<Remap: {columns} values to {rows} cells, {self.weights.nnz} weights>"

    def __reduce__(self) -> tuple[Any, ...]:
        areas = (self.source_area, self.source_fraction, self.target_area, self.target_fraction)
        return Remap, (self.weights, areas, (self.source_sum, self.common_sum))


def remap(
    source: Mesh | Locator,
    target: Mesh | Locator | Pixels,
    values: Literal["triangles", "vertices"] = "triangles",
    *,
    source_cells: ArrayLike | None = None,
    target_cells: ArrayLike | None = None,
    degrees: bool = False,
    covered: bool = False,
    threads: int = 0,
    progress: Progress | None = None,
) -> Remap:
    """Compute conservative weights: the sum of value times area stays the same.

    The value of a target cell is the mean, over its area, of what the source has there. Overlaps
    are decided exactly.

    With ``degrees`` a mesh that crosses the meridian of 180 degrees (or that of 0, if its
    longitudes are from 0 to 360), or a pole, is cut there as `meshwalk weights` does it; its cells
    stay whole. Edges are straight in longitude and latitude. A `Locator` is taken as it is.

    Parameters
    ----------
    source : Mesh or Locator
        The mesh with the values.
    target : Mesh, Locator or Pixels
        The mesh or raster whose cells receive values.
    values : {"triangles", "vertices"}, optional
        Whether the source has a value for each triangle or cell, or at each vertex and linear in
        between.
    source_cells, target_cells : array_like of int, shape (m,), optional
        The cell of each triangle, from 0, where cells are made of several triangles; those of a
        cell with a pole inside follow each other.
    degrees : bool, optional
        Coordinates are longitudes and latitudes, and areas those of the unit sphere.
    covered : bool, optional
        A cell gets the mean over its covered part ("fracarea"). By default the mean over the whole
        cell, so that sums are conserved ("dstarea").
    threads : int, optional
        How many threads work on it; 0 lets the library choose. The weights are the same.
    progress : callable, optional
        As of `Locator.locate`.

    Returns
    -------
    Remap
        Of a raster, results have the shape (rows, columns). Cells that nothing covers are NaN.

    Raises
    ------
    InputError
        A mesh is no embedding; longitudes or latitudes are out of range.
    ValueError
        A locator was made with ``fill="no"``; cell numbers or pixels that cannot be; values at
        vertices of a mesh that has to be cut.

    Examples
    --------
    >>> import meshwalk
    >>> mesh = meshwalk.Mesh([[0, 0], [4, 0], [4, 4], [0, 4]], [[0, 1, 2], [0, 2, 3]])
    >>> weights = meshwalk.remap(mesh, meshwalk.Pixels(0, 4, 2, 2, columns=2, rows=2))
    >>> weights @ [10.0, 20.0]
    array([[20., 15.],
           [15., 10.]])
    """
    if values not in ("triangles", "vertices"):
        raise ValueError(f"values must be 'triangles' or 'vertices', not {values!r}")
    at_vertices = values == "vertices"
    if at_vertices and source_cells is not None:
        raise ValueError("source_cells need values='triangles'")
    given = _side(source, "source", source_cells, degrees, at_vertices)
    kind = (at_vertices, degrees, covered)
    if isinstance(target, Pixels):
        if target_cells is not None:
            raise ValueError("target_cells need a mesh as the target")
        raw = _core.remap_to_pixels(*given, target, *kind, threads, progress)
        shape: tuple[int, ...] = (target.rows, target.columns)
    else:
        taker = _side(target, "target", target_cells, degrees, False)
        raw = _core.remap_to_mesh(*given, *taker, *kind, threads, progress)
        shape = (raw[0].describe()[0],)
    weights = Operator._of(raw[0], shape, "vertices" if at_vertices else "cells")
    area, fraction = (np.frombuffer(part, np.float64) for part in raw[1:3])
    target_area, target_fraction = (
        np.frombuffer(part, np.float64).reshape(shape) for part in raw[3:5]
    )
    return Remap(weights, (area, fraction, target_area, target_fraction), raw[5:])


def _side(
    given: Mesh | Locator, name: str, cells: ArrayLike | None, degrees: bool, at_vertices: bool
) -> tuple[Locator, NDArray[np.uint32] | None, int]:
    """A locator; the cell of each of its triangles, and how many there are."""
    mesh = given.mesh if isinstance(given, Locator) else given
    if not isinstance(mesh, Mesh):
        return filled(mesh, name), None, 0  # refused
    numbers, count = _cells(cells, f"{name}_cells", mesh)
    pieces = None
    if degrees and mesh is given:
        pieces = _core.seam_cut(mesh.points, mesh.triangles.astype(np.uint32), numbers)
    if pieces is None:
        return filled(given, name), numbers, count
    if at_vertices:
        raise ValueError(
            f"{name} crosses the meridian of 180 degrees, or a pole: values='vertices' is not "
            "possible there, but 'triangles' is"
        )
    points = np.frombuffer(pieces[0]).reshape(-1, 2)
    triangles = np.frombuffer(pieces[1], np.uint32).reshape(-1, 3)
    try:
        locator = filled(Mesh(points, triangles), name)
    except InputError as error:
        error.add_note(
            f"{name} goes round the globe and was cut at the meridian of {pieces[3]:g} degrees. "
            "Numbers of triangles are those of the pieces; edges are straight in longitude and "
            "latitude"
        )
        raise
    whole = count if numbers is not None else mesh.triangle_count
    return locator, np.frombuffer(pieces[2], np.uint32), whole


def _cells(given: ArrayLike | None, name: str, mesh: Mesh) -> tuple[NDArray[np.uint32] | None, int]:
    """The cell of each triangle, and how many there are."""
    if given is None:
        return None, 0
    cells = _arrays.indices(given, name, (mesh.triangle_count,), None)
    if len(cells) and int(cells.max()) > 2**31:
        raise ValueError(f"{name}[{int(np.argmax(cells))}] is no cell: cells are numbered from 0")
    return cells, int(cells.max(initial=0)) + 1 if len(cells) else 0
