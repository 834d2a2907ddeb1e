"""Each drop-in beside its original: the same mesh, the same queries, in turns."""

from __future__ import annotations

import os
import sys
from importlib.util import find_spec
from multiprocessing import get_context
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

import meshwalk

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from numpy.typing import NDArray

    Points = NDArray[np.float64]
    Triangles = NDArray[Any]
    Ask = Callable[[Points], NDArray[Any]]
    Make = Callable[[Points, Triangles], Ask]


class Pair(NamedTuple):
    """A drop-in and its original: each made of a mesh, then asked."""

    original: str
    """The package of the original."""
    theirs: Make
    ours: Make
    on_sphere: bool = False
    """Points are longitudes and latitudes, and the mesh covers the sphere."""


def _matplotlib(points: Points, triangles: Triangles) -> Ask:
    from matplotlib.tri import Triangulation

    finder = Triangulation(*points.T, triangles).get_trifinder()
    return lambda xy: np.asarray(finder(*xy.T))


def _our_matplotlib(points: Points, triangles: Triangles) -> Ask:
    from matplotlib.tri import Triangulation

    from meshwalk.matplotlib import TriFinder

    finder = TriFinder(Triangulation(*points.T, triangles))
    return lambda xy: finder(*xy.T)


def _scipy(points: Points, _: Triangles) -> Ask:
    from scipy.spatial import Delaunay

    find: Ask = Delaunay(points).find_simplex
    return lambda xy: find(xy) >= 0


def _our_scipy(points: Points, _: Triangles) -> Ask:
    from meshwalk.scipy import Delaunay

    find = Delaunay(points).find_simplex
    return lambda xy: find(xy) >= 0


def _xugrid(points: Points, triangles: Triangles) -> Ask:
    from numba_celltree import CellTree2d

    ask: Ask = CellTree2d(points, np.asarray(triangles, np.intp), -1).locate_points
    return ask


def _our_xugrid(points: Points, triangles: Triangles) -> Ask:
    from meshwalk.xugrid import CellTree2d

    return CellTree2d(points, triangles, -1).locate_points


def _uxarray_grid(points: Points, triangles: Triangles) -> Any:
    import uxarray

    return uxarray.Grid.from_topology(*points.T, np.asarray(triangles, np.intp))


def _uxarray(points: Points, triangles: Triangles) -> Ask:
    find = _uxarray_grid(points, triangles).get_faces_containing_point
    find(points[:1])  # its index is made by the first search
    return lambda lonlat: np.asarray(find(lonlat)[0][:, 0])


def _our_uxarray(points: Points, triangles: Triangles) -> Ask:
    from meshwalk.uxarray import FaceFinder

    find = FaceFinder(_uxarray_grid(points, triangles)).get_faces_containing_point
    return lambda lonlat: np.asarray(find(lonlat)[0])[:, 0]


def _parcels_grid(points: Points, triangles: Triangles) -> Any:
    import parcels
    import uxarray

    grid = _uxarray_grid(points, triangles)
    depth = uxarray.UxDataArray(np.array([0.0, 1.0]), dims=["zf"], uxgrid=grid)
    return parcels.UxGrid(grid, z=depth, mesh="flat")


def _parcels(points: Points, triangles: Triangles) -> Ask:
    table = _parcels_grid(points, triangles).get_spatial_hash()
    return lambda xy: np.asarray(table.query(xy[:, 1], xy[:, 0])[1])


def _our_parcels(points: Points, triangles: Triangles) -> Ask:
    from meshwalk.parcels import SpatialHash

    table = SpatialHash(_parcels_grid(points, triangles))
    return lambda xy: table.query(xy[:, 1], xy[:, 0])[1]


def _opendrift(points: Points, triangles: Triangles) -> Ask:
    """What its readers of unstructured grids do: the face whose centre is the nearest."""
    from opendrift.readers.basereader.unstructured import UnstructuredReader

    centres = points[triangles].mean(axis=1)
    index = UnstructuredReader._build_ckdtree_(None, *centres.T)
    workers = UnstructuredReader.PARALLEL_WORKERS
    return lambda xy: np.asarray(index.query(xy, k=1, workers=workers)[1])


def _our_opendrift(points: Points, triangles: Triangles) -> Ask:
    from meshwalk.opendrift import Reader

    reader = Reader(_dataset(points, triangles), proj4="+proj=utm +zone=32")
    return lambda xy: np.asarray(reader._locate(*xy.T).triangle)


def _dataset(points: Points, triangles: Triangles) -> Any:
    """A dataset by UGRID with the sum of x and y at the vertices."""
    import xarray

    topology = {
        "cf_role": "mesh_topology",
        "topology_dimension": 2,
        "node_coordinates": "x y",
        "face_node_connectivity": "corners",
    }
    x, y = points.T
    about = {"standard_name": "sea_surface_height_above_geoid"}
    return xarray.Dataset(
        {
            "mesh": ((), np.int32(0), topology),
            "corners": (("face", "three"), np.asarray(triangles, np.int32)),
            "value": ("node", x + y, about),
        },
        coords={"x": ("node", x), "y": ("node", y)},
    )


def _interpolator(points: Points, _: Triangles) -> Ask:
    from scipy.interpolate import LinearNDInterpolator

    ask: Ask = LinearNDInterpolator(points, points.sum(axis=1))
    return ask


def _our_accessor(points: Points, triangles: Triangles) -> Ask:
    import meshwalk.xarray  # noqa: F401 # gives datasets the accessor

    dataset = _dataset(points, triangles)
    dataset.meshwalk.sample(points[:1])  # finds the mesh
    return lambda xy: np.asarray(dataset.meshwalk.sample(xy).value)


PAIRS = {
    "matplotlib": Pair("matplotlib", _matplotlib, _our_matplotlib),
    "scipy": Pair("scipy", _scipy, _our_scipy),
    "xugrid": Pair("numba_celltree", _xugrid, _our_xugrid),
    "uxarray": Pair("uxarray", _uxarray, _our_uxarray, on_sphere=True),
    "parcels": Pair("parcels", _parcels, _our_parcels),
    "opendrift": Pair("opendrift", _opendrift, _our_opendrift),
    "xarray": Pair("scipy", _interpolator, _our_accessor),
}


class Figure(NamedTuple):
    """What was measured of a drop-in, or of an original."""

    name: str
    build: float
    """Seconds from arrays to the first question."""
    query: float
    """Seconds for each query, in the best round."""
    bytes: int | None
    """Memory that it keeps; None where the system does not tell."""
    same: float
    """Part of the answers that are those of the other, to 9 digits if they are no integers."""


def _on_square(count: int, random: np.random.Generator) -> Points:
    return random.uniform(size=(count, 2))


def _on_sphere(count: int, random: np.random.Generator) -> Points:
    longitude, height = random.uniform([[-180], [-1]], [[180], [1]], (2, count))
    return np.column_stack([longitude, np.rad2deg(np.arcsin(height))])


def _mesh(pair: Pair, vertices: int, random: np.random.Generator) -> tuple[Points, Triangles]:
    if not pair.on_sphere:
        points = _on_square(vertices, random)
        return points, meshwalk.delaunay(points).triangles
    from scipy.spatial import ConvexHull

    points = _on_sphere(vertices, random)
    directions = meshwalk.lonlat_to_direction(points)
    triangles = ConvexHull(directions).simplices.astype(np.intp)
    a, b, c = np.moveaxis(directions[triangles], 1, 0)
    turned = (np.cross(a, b) * c).sum(axis=1) < 0
    triangles[turned] = triangles[turned][:, ::-1]
    return points, triangles


def _resident() -> int | None:
    """Memory of this process in bytes."""
    try:
        with open("/proc/self/statm") as file:
            return int(file.read().split()[1]) * os.sysconf("SC_PAGE_SIZE")
    except OSError:
        return None


def _kept(name: str, which: str, vertices: int, seed: int) -> int | None:
    """By how much this process grows for what one side keeps. Runs in a process of its own."""
    pair = PAIRS[name]
    make: Make = getattr(pair, which)
    random = np.random.default_rng(seed)
    draw = _on_sphere if pair.on_sphere else _on_square
    make(*_mesh(pair, 50, random))(draw(9, random))  # loads and compiles what it needs
    points, triangles = _mesh(pair, vertices, random)
    before = _resident()
    ask = make(points, triangles)
    after = _resident()
    ask(points[:1])
    return None if before is None or after is None else max(after - before, 0)


def measure(
    names: Sequence[str], vertices: int, queries: int, rounds: int, seed: int = 1
) -> list[tuple[Figure, Figure]]:
    """Measure drop-ins beside their originals.

    Parameters
    ----------
    names : sequence of str
        Of `PAIRS`. Those whose original is not installed are left out.
    vertices, queries, rounds : int
        How many.
    seed : int, optional
        Of the random points.

    Returns
    -------
    list of pairs of Figure
        The original, then the drop-in.
    """
    there = [name for name in names if find_spec(PAIRS[name].original) is not None]
    return [_measure_pair(name, vertices, queries, rounds, seed) for name in there]


def _measure_pair(
    name: str, vertices: int, queries: int, rounds: int, seed: int
) -> tuple[Figure, Figure]:
    from meshwalk.bench import _seconds, best

    pair = PAIRS[name]
    random = np.random.default_rng(seed)
    draw = _on_sphere if pair.on_sphere else _on_square
    points, triangles = _mesh(pair, vertices, random)
    xy, small = draw(queries, random), _mesh(pair, 50, random)
    for make in (pair.theirs, pair.ours):
        make(*small)(xy[:9])  # loads and compiles what it needs
    built, theirs = _seconds(lambda: pair.theirs(points, triangles))
    our_built, ours = _seconds(lambda: pair.ours(points, triangles))
    same = float(np.mean(np.isclose(theirs(xy), ours(xy), rtol=1e-9, atol=0, equal_nan=True)))
    quickest = best([lambda: theirs(xy), lambda: ours(xy)], rounds)
    with get_context("spawn").Pool(1, maxtasksperchild=1) as pool:
        sides = [(name, side, vertices, seed) for side in ("theirs", "ours")]
        kept = pool.starmap(_kept, sides, chunksize=1)
    return (
        Figure(pair.original, built, quickest[0] / queries, kept[0], same),
        Figure(f"meshwalk.{name}", our_built, quickest[1] / queries, kept[1], same),
    )


def report(figures: Sequence[tuple[Figure, Figure]]) -> None:
    """Print a table."""
    head = f"{'build, s':>10}{'queries/s':>12}{'ratio':>8}{'MB':>8}{'same answers':>14}"
    print(f"{'':22}{head}", file=sys.stdout)
    for pair in figures:
        for figure in pair:
            ratio = pair[0].query / figure.query
            size = "" if figure.bytes is None else f"{figure.bytes / 1e6:.1f}"
            row = f"{figure.build:10.3f}{1 / figure.query:12.0f}{ratio:8.1f}{size:>8}"
            print(f"{figure.name:22}{row}{figure.same:14.6f}")
