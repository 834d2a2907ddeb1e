from typing import Any, SupportsFloat, TypeAlias, TypeVar, final

from numpy.typing import NDArray

from meshwalk._where import Where

LOCATION_LAYOUT: dict[str, int]
MAX_TRIANGLES: int
MESH_FORMATS: tuple[str, ...]
version: str

Buffer: TypeAlias = NDArray[Any]

class Mesh:
    @property
    def vertex_count(self) -> int: ...
    @property
    def triangle_count(self) -> int: ...
    @property
    def nbytes(self) -> int: ...
    def _copy_points(self, out: Buffer, /) -> None: ...
    def _copy_triangles(self, out: Buffer, /) -> None: ...
    def _copy_neighbours(self, out: Buffer, /) -> None: ...
    def _interpolate(self, values: Buffer, locations: Buffer, out: Buffer, /) -> None: ...
    def _describe(self) -> dict[str, Any]: ...

@final
class Location:
    """Where one point lies: the answer of `Locator.locate_one`."""

    @property
    def triangle(self) -> int:
        """Number of the triangle, -1 for none."""
    @property
    def where(self) -> Where:
        """A member of `Where`: inside, on an edge, outside ..."""
    @property
    def local(self) -> int:
        """The local edge or vertex that the point is on, else -1."""
    @property
    def weights(self) -> tuple[float, float, float]:
        """Weights of the triangle's three vertices; NaN without a triangle."""
    @property
    def hole(self) -> int:
        """Number of the hole that the point is in, -1 for none."""
    @property
    def inside(self) -> bool:
        """True if a triangle contains the point, its border included."""

class Locator:
    @property
    def mesh(self) -> Mesh: ...
    def locate_one(self, x: SupportsFloat, y: SupportsFloat, /) -> Location:
        """Locate one point, as fast as a call from Python can be."""
    def _locate(
        self,
        points: Buffer,
        out: Buffer,
        walk: str,
        start: str,
        tolerance: float,
        lanes: int,
        threads: int,
        /,
    ) -> None: ...
    def _nearest_border(
        self, x: float, y: float, /
    ) -> tuple[int, int, float, tuple[float, float], tuple[float, float, float]]: ...
    def _describe(self) -> dict[str, Any]: ...

_Mesh = TypeVar("_Mesh", bound=Mesh)
_Locator = TypeVar("_Locator", bound=Locator)

def mesh_from_arrays(
    cls: type[_Mesh],
    points: Buffer,
    triangles: Buffer,
    tolerant: bool,
    layout: int,
    threads: int,
    /,
) -> _Mesh: ...
def locator_from_mesh(
    cls: type[_Locator],
    mesh: Mesh,
    any: bool,
    border: bool,
    areas: bool,
    fill: int,
    queries: int,
    threads: int,
    /,
) -> _Locator: ...
def check_arrays(
    points: Buffer, triangles: Buffer, /
) -> tuple[bool, list[tuple[str, str, int, int, int, int, int]]]: ...
def delaunay(
    cls: type[_Mesh], points: Buffer, duplicate_of: Buffer, threads: int, /
) -> tuple[_Mesh, int]: ...
def read_mesh(path: bytes, /) -> tuple[memoryview, memoryview, int, dict[str, memoryview], int]: ...
def write_mesh(
    path: bytes,
    format: str | None,
    points: Buffer,
    has_z: bool,
    triangles: Buffer,
    fields: list[tuple[bytes, Buffer]],
    /,
) -> None: ...
