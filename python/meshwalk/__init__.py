"""Exact point location in triangle meshes, by walking.

`Mesh` takes your arrays, `delaunay` makes a mesh of points, `read` one of a file. `Locator` finds
the triangles that contain points, and `Locations.interpolate` the values there:

>>> import meshwalk
>>> mesh = meshwalk.delaunay([[0, 0], [4, 0], [4, 4], [0, 4]])
>>> hit = meshwalk.Locator(mesh).locate([[3, 1], [5, 5]])
>>> hit.inside
array([ True, False])
>>> hit.interpolate([0.0, 4.0, 8.0, 4.0])
array([ 4., nan])

Arrays of any real type are taken if doubles hold their numbers exactly. The interpreter lock is
released while the library works, and any number of threads may use an object at a time, but a
`Cursor`, which serves one.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

from meshwalk._core import Location
from meshwalk._core import version as __version__
from meshwalk._errors import Error, InputError, LimitError
from meshwalk._where import Where

if TYPE_CHECKING:
    from meshwalk._borrowed import BorrowedMesh
    from meshwalk._check import Check, Defect, check, check_star, check_surface
    from meshwalk._cursor import Cursor
    from meshwalk._editor import (
        Change,
        EdgeKind,
        Edit,
        EditKind,
        Editor,
        EditorInfo,
        EditorLocations,
    )
    from meshwalk._files import (
        Constraints,
        SkippedRingWarning,
        mesh_formats,
        read,
        read_constraints,
        read_points,
        write,
    )
    from meshwalk._locations import Locations
    from meshwalk._locator import Locator, LocatorInfo, NearestBorder, start_names, walk_names
    from meshwalk._mend import MendChange, Mended, mend
    from meshwalk._mesh import Mesh, MeshInfo, Reordered
    from meshwalk._operator import Operator
    from meshwalk._overlap import (
        Pixels,
        Remap,
        SurfaceAreaInfo,
        VolumeInfo,
        remap,
        surface_area,
        volume,
    )
    from meshwalk._plot import explain, plot
    from meshwalk._polygons import PolygonHits, Polygons
    from meshwalk._prepared import map as map
    from meshwalk._segments import Exits, Segments
    from meshwalk._sight import Sights, SightState, visible
    from meshwalk._space.prober import (
        Deviation,
        NearestPoints,
        Prober,
        SurfaceSide,
        Touches,
        TouchLists,
        TouchState,
    )
    from meshwalk._space.star import (
        Remeshed,
        Star,
        StarInfo,
        direction_to_lonlat,
        lonlat_to_direction,
    )
    from meshwalk._space.surface import Surface, SurfaceInfo
    from meshwalk._space.surface_editor import SurfaceChange, SurfaceEditor, SurfaceEditorInfo
    from meshwalk._tiles import TileLocations, Tiles
    from meshwalk._tiling import prepare_tiles
    from meshwalk._triangulate import (
        DuplicateWarning,
        HoleWarning,
        OptimumWarning,
        constrained_delaunay,
        delaunay,
        triangulate,
    )

# Modules are imported when one of their names is first used: `import meshwalk` takes no time.
_MODULES = {
    "_borrowed": ("BorrowedMesh",),
    "_check": ("Check", "Defect", "check", "check_star", "check_surface"),
    "_cursor": ("Cursor",),
    "_editor": (
        "Change",
        "EdgeKind",
        "Edit",
        "EditKind",
        "Editor",
        "EditorInfo",
        "EditorLocations",
    ),
    "_files": (
        "Constraints",
        "SkippedRingWarning",
        "mesh_formats",
        "read",
        "read_constraints",
        "read_points",
        "write",
    ),
    "_locations": ("Locations",),
    "_locator": ("Locator", "LocatorInfo", "NearestBorder", "start_names", "walk_names"),
    "_mend": ("MendChange", "Mended", "mend"),
    "_mesh": ("Mesh", "MeshInfo", "Reordered"),
    "_operator": ("Operator",),
    "_overlap": (
        "Pixels",
        "Remap",
        "SurfaceAreaInfo",
        "VolumeInfo",
        "remap",
        "surface_area",
        "volume",
    ),
    "_plot": ("explain", "plot"),
    "_polygons": ("PolygonHits", "Polygons"),
    "_prepared": ("map",),
    "_space.prober": (
        "Deviation",
        "NearestPoints",
        "Prober",
        "SurfaceSide",
        "TouchLists",
        "TouchState",
        "Touches",
    ),
    "_segments": ("Exits", "Segments"),
    "_sight": ("SightState", "Sights", "visible"),
    "_space.star": ("Remeshed", "Star", "StarInfo", "direction_to_lonlat", "lonlat_to_direction"),
    "_space.surface": ("Surface", "SurfaceInfo"),
    "_space.surface_editor": ("SurfaceChange", "SurfaceEditor", "SurfaceEditorInfo"),
    "_tiles": ("TileLocations", "Tiles"),
    "_tiling": ("prepare_tiles",),
    "_triangulate": (
        "DuplicateWarning",
        "HoleWarning",
        "OptimumWarning",
        "constrained_delaunay",
        "delaunay",
        "triangulate",
    ),
}
_HOMES = {name: module for module, names in _MODULES.items() for name in names}

# All but `map`, which `from meshwalk import *` would put in the place of Python's own.
__all__ = [
    "BorrowedMesh",
    "Change",
    "Check",
    "Constraints",
    "Cursor",
    "Defect",
    "Deviation",
    "DuplicateWarning",
    "EdgeKind",
    "Edit",
    "EditKind",
    "Editor",
    "EditorInfo",
    "EditorLocations",
    "Error",
    "Exits",
    "HoleWarning",
    "InputError",
    "LimitError",
    "Location",
    "Locations",
    "Locator",
    "LocatorInfo",
    "MendChange",
    "Mended",
    "Mesh",
    "MeshInfo",
    "NearestBorder",
    "NearestPoints",
    "Operator",
    "OptimumWarning",
    "Pixels",
    "PolygonHits",
    "Polygons",
    "Prober",
    "Remap",
    "Remeshed",
    "Reordered",
    "Segments",
    "SightState",
    "Sights",
    "SkippedRingWarning",
    "Star",
    "StarInfo",
    "Surface",
    "SurfaceAreaInfo",
    "SurfaceChange",
    "SurfaceEditor",
    "SurfaceEditorInfo",
    "SurfaceInfo",
    "SurfaceSide",
    "TileLocations",
    "Tiles",
    "TouchLists",
    "TouchState",
    "Touches",
    "VolumeInfo",
    "Where",
    "__version__",
    "check",
    "check_star",
    "check_surface",
    "constrained_delaunay",
    "delaunay",
    "direction_to_lonlat",
    "explain",
    "lonlat_to_direction",
    "mend",
    "mesh_formats",
    "plot",
    "prepare_tiles",
    "read",
    "read_constraints",
    "read_points",
    "remap",
    "start_names",
    "surface_area",
    "triangulate",
    "visible",
    "volume",
    "walk_names",
    "write",
]


def __getattr__(name: str) -> Any:
    if name not in _HOMES:
        raise AttributeError(f"module 'meshwalk' has no attribute {name!r}")
    value = getattr(import_module(f"meshwalk.{_HOMES[name]}"), name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return sorted([*__all__, "map"])
