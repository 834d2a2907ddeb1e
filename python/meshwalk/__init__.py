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

from meshwalk._check import Check, Defect, check
from meshwalk._core import Location
from meshwalk._core import version as __version__
from meshwalk._errors import Error, InputError, LimitError
from meshwalk._files import mesh_formats, read, write
from meshwalk._locations import Locations
from meshwalk._locator import Locator, LocatorInfo, NearestBorder
from meshwalk._mesh import Mesh, MeshInfo
from meshwalk._triangulate import DuplicateWarning, delaunay
from meshwalk._where import Where

__all__ = [
    "Check",
    "Defect",
    "DuplicateWarning",
    "Error",
    "InputError",
    "LimitError",
    "Location",
    "Locations",
    "Locator",
    "LocatorInfo",
    "Mesh",
    "MeshInfo",
    "NearestBorder",
    "Where",
    "__version__",
    "check",
    "delaunay",
    "mesh_formats",
    "read",
    "write",
]
