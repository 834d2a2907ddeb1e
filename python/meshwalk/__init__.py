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
released while the library works, and objects may be used by any number of threads.
"""

from meshwalk._borrowed import BorrowedMesh
from meshwalk._check import Check, Defect, check, check_star, check_surface
from meshwalk._core import Location
from meshwalk._core import version as __version__
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
from meshwalk._errors import Error, InputError, LimitError
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
from meshwalk._locator import Locator, LocatorInfo, NearestBorder
from meshwalk._mend import MendChange, Mended, mend
from meshwalk._mesh import Mesh, MeshInfo
from meshwalk._operator import Operator
from meshwalk._plot import explain, plot
from meshwalk._polygons import PolygonHits, Polygons
from meshwalk._prober import NearestPoints, Prober, SurfaceSide, Touches, TouchState
from meshwalk._segments import Segments
from meshwalk._star import Star, StarInfo, direction_to_lonlat, lonlat_to_direction
from meshwalk._surface import Surface, SurfaceInfo
from meshwalk._triangulate import (
    DuplicateWarning,
    OptimumWarning,
    constrained_delaunay,
    delaunay,
    triangulate,
)
from meshwalk._where import Where

__all__ = [
    "BorrowedMesh",
    "Change",
    "Check",
    "Constraints",
    "Cursor",
    "Defect",
    "DuplicateWarning",
    "EdgeKind",
    "Edit",
    "EditKind",
    "Editor",
    "EditorInfo",
    "EditorLocations",
    "Error",
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
    "PolygonHits",
    "Polygons",
    "Prober",
    "Segments",
    "SkippedRingWarning",
    "Star",
    "StarInfo",
    "Surface",
    "SurfaceInfo",
    "SurfaceSide",
    "TouchState",
    "Touches",
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
    "read",
    "read_constraints",
    "read_points",
    "triangulate",
    "write",
]
