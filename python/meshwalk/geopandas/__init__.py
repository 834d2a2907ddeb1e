"""Drop-in for users of GeoPandas: joins of points with polygons and triangle meshes.

`sjoin` is `geopandas.sjoin`, exact for points and polygons, and takes a `meshwalk.Mesh`, too.
`locate` gives the triangles of points and the values there; `triangles`, `vertices` and `mesh` turn
meshes into frames and back:

>>> import geopandas, meshwalk, meshwalk.geopandas
>>> mesh = meshwalk.Mesh([[0, 0], [4, 0], [4, 4], [0, 4]], [[0, 1, 2], [0, 2, 3]],
...                      {"depth": [0, 4, 8, 4]}, crs="EPSG:32632")
>>> stations = geopandas.GeoDataFrame(
...     {"name": ["a", "b"]}, geometry=geopandas.points_from_xy([3, 9], [1, 9]), crs="EPSG:32632")
>>> found = meshwalk.geopandas.locate(stations, mesh)
>>> found[["name", "triangle", "depth"]]
  name  triangle  depth
0    a         0    4.0
1    b        -1    NaN

GeoPandas itself has to be installed.
"""

from __future__ import annotations

import warnings
from typing import TYPE_CHECKING, Any

import geopandas
import numpy as np
import pyproj
import shapely

from meshwalk._locator import Locator
from meshwalk._mesh import Mesh
from meshwalk.shapely import STRtree

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import NDArray

    from meshwalk._locations import Locations

__all__ = ["locate", "mesh", "sjoin", "triangles", "use", "vertices"]

_POINT, _POLYGON = 0, 3
_join_frames = geopandas.sjoin  # also where a program puts the one below in its place


class _Index(geopandas.sindex.SpatialIndex):  # type: ignore[misc] # it is not typed
    """The index of GeoPandas with the tree of `meshwalk.shapely`."""

    def __init__(self, geometry: NDArray[Any]) -> None:
        there = geometry.copy()
        there[shapely.is_empty(there)] = None  # as GeoPandas has it
        self._tree = STRtree(there)
        self.geometries = geometry.copy()


def use(frame: Any) -> Any:
    """Let a GeoDataFrame or GeoSeries search exactly.

    Its ``sindex`` gets the tree of `meshwalk.shapely`, so that `geopandas.sjoin` and all else that
    asks it which points are in which polygons is exact and fast. A new frame made of it has
    GeoPandas' own again, as has this one after its geometries change.

    Parameters
    ----------
    frame : geopandas.GeoDataFrame or geopandas.GeoSeries
        The polygons or points.

    Returns
    -------
    The frame itself.

    Examples
    --------
    >>> import geopandas, meshwalk.geopandas, shapely
    >>> parcels = geopandas.GeoSeries([shapely.box(0, 0, 4, 4)])
    >>> meshwalk.geopandas.use(parcels).sindex.query(shapely.Point(1, 4), predicate="within")
    array([], dtype=int64)
    """
    array = frame.geometry.array
    if not isinstance(array._sindex, _Index):
        array._sindex = _Index(np.asarray(array))
    if not isinstance(frame.sindex, _Index):
        raise RuntimeError("this version of GeoPandas keeps its index elsewhere")
    return frame


def sjoin(
    left_df: Any,
    right_df: Any,
    how: str = "inner",
    predicate: str = "intersects",
    *args: Any,
    **options: Any,
) -> Any:
    """Join frames by where their geometries lie, as `geopandas.sjoin` does.

    Parameters
    ----------
    left_df : geopandas.GeoDataFrame
        With a mesh: points.
    right_df : geopandas.GeoDataFrame or meshwalk.Mesh
        A mesh counts as the frame of its `triangles`, but a point on an edge is joined with the
        lowest triangle only.
    how, predicate, lsuffix, rsuffix, distance, on_attribute
        As of `geopandas.sjoin`. With a mesh ``how`` is "inner" or "left", and the predicate
        "intersects", "within" or "covered_by", which are one: a border of the mesh is in it.

    Returns
    -------
    geopandas.GeoDataFrame
        With the index and the coordinate system of `left_df`.

    Raises
    ------
    ValueError
        The coordinate systems of points and mesh differ, or a geometry is no point.

    Warns
    -----
    UserWarning
        Of two frames one has another coordinate system; of points and mesh one has none.

    Examples
    --------
    >>> import geopandas, meshwalk.geopandas, shapely
    >>> parcels = geopandas.GeoDataFrame({"owner": ["x"]}, geometry=[shapely.box(0, 0, 4, 4)])
    >>> at = geopandas.GeoDataFrame(geometry=geopandas.points_from_xy([1, 9], [1, 9]))
    >>> meshwalk.geopandas.sjoin(at, parcels, how="left")
          geometry  index_right owner
    0  POINT (1 1)          0.0     x
    1  POINT (9 9)          NaN   NaN
    """
    if isinstance(right_df, Mesh):
        return _join_mesh(left_df, right_df, how, predicate, *args, **options)
    # Frames of another kind are refused by geopandas.sjoin.
    if isinstance(left_df, geopandas.GeoDataFrame) and isinstance(right_df, geopandas.GeoDataFrame):
        use(left_df if predicate == "within" else right_df)
    return _join_frames(left_df, right_df, how, predicate, *args, **options)


def _join_mesh(
    points: Any,
    mesh: Mesh,
    how: str,
    predicate: str,
    lsuffix: str = "left",
    rsuffix: str = "right",
    **refused: Any,
) -> Any:
    if how not in ("inner", "left"):
        raise ValueError(f"with a mesh how must be 'inner' or 'left', not {how!r}")
    if predicate not in ("intersects", "within", "covered_by"):
        raise ValueError(
            f"with a mesh the predicate must be 'intersects', 'within' or 'covered_by', not "
            f"{predicate!r}"
        )
    if refused:
        raise TypeError(f"with a mesh sjoin() takes no {next(iter(refused))!r}")
    triangle = _locate(points, Locator(mesh)).triangle
    right = f"index_{rsuffix}"
    values = {name: np.asarray(field) for name, field in mesh.triangle_fields.items()}
    both = [name for name in values if name in points.columns]
    joined = points.rename(columns={name: f"{name}_{lsuffix}" for name in both})
    renamed = {f"{name}_{rsuffix}" if name in both else name: v for name, v in values.items()}
    if right in joined.columns or right in renamed:
        raise ValueError(f"'{right}' cannot be a column name in the frames being joined")
    found = triangle >= 0
    if how == "inner":
        joined, triangle = joined[found], triangle[found]
        return joined.assign(**{right: triangle.astype(np.int64)}, **_at(renamed, triangle))
    number = np.where(found, triangle, np.nan)
    return joined.assign(**{right: number}, **_at(renamed, triangle))


def _at(values: Mapping[str, Any], triangle: Any) -> dict[str, Any]:
    """Values of triangles; NaN where there is none."""
    return {name: np.where(triangle < 0, np.nan, v[triangle]) for name, v in values.items()}


def locate(points: Any, mesh: Mesh | Locator) -> Any:
    """Find the triangles of points and the values there.

    Parameters
    ----------
    points : geopandas.GeoDataFrame or geopandas.GeoSeries
        Points.
    mesh : meshwalk.Mesh or meshwalk.Locator
        The mesh. A locator saves its making, where several frames of points are located.

    Returns
    -------
    geopandas.GeoDataFrame
        The points with their index, columns and coordinate system, and new columns: ``triangle``,
        -1 for points in none; ``where``, a number of `meshwalk.Where`; each field of the vertices,
        interpolated; each field of the triangles. NaN where there is no triangle.

    Raises
    ------
    ValueError
        As `sjoin`; a column of the name is there already.

    Warns
    -----
    UserWarning
        Either the points or the mesh have no coordinate system.
    """
    locator = mesh if isinstance(mesh, Locator) else Locator(mesh)
    hits = _locate(points, locator)
    columns: dict[str, Any] = {
        "triangle": np.array(hits.triangle),
        "where": np.array(hits.where),
    }
    for name in locator.mesh.fields:
        _add(columns, name, hits.interpolate(name))
    for name, values in _at(locator.mesh.triangle_fields, hits.triangle).items():
        _add(columns, name, values)
    frame = points.to_frame("geometry") if isinstance(points, geopandas.GeoSeries) else points
    there = [name for name in columns if name in frame.columns]
    if there:
        raise ValueError(f"the points have a column {there[0]!r} already")
    return frame.assign(**columns)


def _add(columns: dict[str, Any], name: str, values: Any) -> None:
    if name in columns:
        raise ValueError(f"{name!r} names two columns: rename a field of the mesh")
    columns[name] = values


def _locate(points: Any, locator: Locator) -> Locations:
    if not isinstance(points, (geopandas.GeoDataFrame, geopandas.GeoSeries)):
        raise TypeError(f"points must be a GeoDataFrame or GeoSeries, not {type(points).__name__}")
    _check_systems(points.crs, locator.mesh.crs)
    return locator.locate(_coordinates(points.geometry))


def _coordinates(points: Any) -> Any:
    """x, y of points, NaN for those that are missing or empty."""
    given = np.asarray(points.array)
    kinds = shapely.get_type_id(given)
    other = np.flatnonzero((kinds != _POINT) & (kinds != -1))
    if len(other):
        kind, label = given[other[0]].geom_type, points.index[other[0]]
        raise ValueError(f"the geometry at {label!r} is a {kind}, not a Point")
    return np.column_stack([shapely.get_x(given), shapely.get_y(given)])


def _check_systems(points: Any, mesh: str | None) -> None:
    """Refuse coordinate systems that differ."""
    if points is None and mesh is None:
        return
    if points is None or mesh is None:
        which = "points" if points is None else "mesh"
        warnings.warn(
            f"the {which} have no coordinate system; it is taken for that of the others",
            UserWarning,
            stacklevel=4,
        )
        return
    theirs = pyproj.CRS.from_user_input(mesh)
    if not theirs.equals(points, ignore_axis_order=True):
        raise ValueError(
            f"the points are in {points.name}, the mesh is in {theirs.name}: bring the points "
            "there with to_crs()"
        )


def triangles(mesh: Mesh) -> Any:
    """Make a frame of the triangles of a mesh.

    Parameters
    ----------
    mesh : meshwalk.Mesh
        The mesh.

    Returns
    -------
    geopandas.GeoDataFrame
        A polygon for each triangle, in their order, with the fields of the triangles as columns and
        the coordinate system of the mesh. Fields of the vertices are in `vertices`.
    """
    corners = mesh.points[mesh.triangles[:, [0, 1, 2, 0]]]
    return geopandas.GeoDataFrame(
        {name: np.array(values) for name, values in mesh.triangle_fields.items()},
        geometry=shapely.polygons(corners),
        crs=mesh.crs,
    )


def vertices(mesh: Mesh) -> Any:
    """Make a frame of the vertices of a mesh.

    Parameters
    ----------
    mesh : meshwalk.Mesh
        The mesh.

    Returns
    -------
    geopandas.GeoDataFrame
        A point for each vertex, in their order, with the fields of the vertices as columns and the
        coordinate system of the mesh.
    """
    return geopandas.GeoDataFrame(
        {name: np.array(values) for name, values in mesh.fields.items()},
        geometry=shapely.points(mesh.points),
        crs=mesh.crs,
    )


def mesh(frame: Any) -> Mesh:
    """Make a mesh of a frame of triangles.

    Parameters
    ----------
    frame : geopandas.GeoDataFrame or geopandas.GeoSeries
        Polygons with three corners. Corners with the same coordinates become one vertex; if the
        polygons have z, it becomes the field ``z``.

    Returns
    -------
    meshwalk.Mesh
        Triangle i is row i. Columns of numbers become fields of the triangles, the others are left
        in the frame; the coordinate system is kept as WKT.

    Raises
    ------
    ValueError
        A geometry is no triangle, or one corner has two heights.
    InputError
        The triangles overlap, see `meshwalk.Mesh`.

    Examples
    --------
    >>> import meshwalk, meshwalk.geopandas
    >>> square = meshwalk.Mesh([[0, 0], [4, 0], [4, 4], [0, 4]], [[0, 1, 2], [0, 2, 3]])
    >>> meshwalk.geopandas.mesh(meshwalk.geopandas.triangles(square))
    <Mesh: 4 vertices, 2 triangles>
    """
    geometry = np.asarray(frame.geometry.array)
    good = shapely.get_type_id(geometry) == _POLYGON
    good &= shapely.get_num_coordinates(geometry) == 4
    if not good.all():
        row = int(np.argmin(good))
        raise ValueError(f"the geometry at {frame.index[row]!r} is no triangle")
    high = bool(len(geometry)) and bool(shapely.has_z(geometry).all())
    corners = shapely.get_coordinates(geometry, include_z=high).reshape(-1, 4, 2 + high)[:, :3]
    rows, number = np.unique(corners.reshape(-1, 2 + high), axis=0, return_inverse=True)
    twice = (rows[1:, :2] == rows[:-1, :2]).all(axis=1)
    if twice.any():
        x, y = rows[int(np.argmax(twice)), :2]
        raise ValueError(f"the corner at {x}, {y} has two heights")
    columns = {}
    if isinstance(frame, geopandas.GeoDataFrame):
        numbers = frame.select_dtypes(["number", "bool"])
        columns = {str(name): numbers[name].to_numpy(np.float64) for name in numbers.columns}
    return Mesh(
        rows,
        number.reshape(-1, 3),
        triangle_fields=columns,
        crs=None if frame.crs is None else frame.crs.to_wkt(),
    )
