from collections.abc import Callable
from typing import Any, SupportsFloat, TypeAlias, TypeVar, final

from numpy.typing import NDArray

from meshwalk._where import Where

LOCATION_LAYOUT: dict[str, int]
TOUCH_LAYOUT: dict[str, int]
NEAREST_LAYOUT: dict[str, int]
CHANGED_LAYOUT: dict[str, int]
CHANGED_VERTEX_LAYOUT: dict[str, int]
PIECE_LAYOUT: dict[str, int]
SIGHT_LAYOUT: dict[str, int]
BORDER_LAYOUT: dict[str, int]
MAX_TRIANGLES: int
MESH_FORMATS: tuple[str, ...]
WALK_NAMES: tuple[str, ...]
START_NAMES: tuple[str, ...]
version: str

Buffer: TypeAlias = NDArray[Any]
Progress: TypeAlias = Callable[[str, float], object]

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
    def _interpolate_table(
        self,
        values: Buffer,
        narrow: bool,
        locations: Buffer,
        out: Buffer,
        threads: int,
        progress: Progress | None,
        /,
    ) -> None: ...
    def _copy_field(self, name: bytes, out: Buffer, /) -> None: ...
    def _recover(self, values: Buffer, out: Buffer, /) -> None: ...
    def _hilbert_order(self, triangles: Buffer, vertices: Buffer, /) -> None: ...
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

def location_from_bytes(location: bytes, /) -> Location: ...

class Locator:
    @property
    def mesh(self) -> Mesh: ...
    def locate_one(self, x: SupportsFloat, y: SupportsFloat, /) -> Location:
        """Locate one point, as fast as a call from Python can be."""
    def _locate(
        self,
        points: Buffer,
        out: Buffer,
        hints: Buffer | None,
        walk: str,
        start: str,
        tolerance: float,
        lanes: int,
        threads: int,
        progress: Progress | None,
        /,
    ) -> None: ...
    def _walk_path(self, x: float, y: float, walk: str, start: str, seed: int, /) -> memoryview: ...
    def _segment(
        self, ends: Buffer, threads: int, progress: Progress | None, /
    ) -> tuple[memoryview, memoryview]: ...
    def _nearest_borders(self, points: Buffer, out: Buffer, /) -> None: ...
    def _nearest_border(
        self, x: float, y: float, /
    ) -> tuple[int, int, float, tuple[float, float], tuple[float, float, float]]: ...
    def _describe(self) -> dict[str, Any]: ...

class Operator:
    def transpose(self, threads: int, progress: Progress | None, /) -> Operator: ...
    def apply(
        self,
        values: Buffer,
        narrow: bool,
        out: Buffer,
        left_out: bool,
        zero: bool,
        threads: int,
        progress: Progress | None,
        /,
    ) -> None: ...
    def copy(self, first: Buffer, column: Buffer, weight: Buffer, /) -> None: ...
    def describe(self) -> tuple[int, int, int, int, int]: ...

def operator_from_locations(
    mesh: Mesh, locations: Buffer, threads: int, progress: Progress | None, /
) -> Operator: ...
def operator_on_surface(
    surface: Surface, kind: str, records: Buffer, threads: int, progress: Progress | None, /
) -> Operator: ...
def icosphere_size(level: int, /) -> tuple[int, int]: ...

_Mesh = TypeVar("_Mesh", bound=Mesh)
_Locator = TypeVar("_Locator", bound=Locator)

class Polygons:
    def at(
        self, points: Buffer, threads: int, progress: Progress | None, /
    ) -> tuple[memoryview, memoryview]: ...
    def crossing(self) -> memoryview: ...
    def describe(self) -> tuple[int, int, int]: ...

def polygons_from_rings(
    points: Buffer,
    segments: Buffer,
    polygon: Buffer,
    threads: int,
    progress: Progress | None,
    /,
) -> Polygons: ...
def operator_from_entries(
    row: Buffer,
    column: Buffer,
    weight: Buffer,
    rows: int,
    columns: int,
    /,
) -> Operator: ...
def mesh_from_arrays(
    cls: type[_Mesh],
    points: Buffer,
    triangles: Buffer,
    tolerant: bool,
    layout: int,
    threads: int,
    progress: Progress | None,
    /,
) -> _Mesh: ...
def borrowed_locate(
    points: Buffer,
    triangles: Buffer,
    neighbours: Buffer,
    across_edge: bool,
    unchecked: bool,
    convex: bool,
    xy: Buffer,
    out: Buffer,
    walk: str,
    threads: int,
    progress: Progress | None,
    /,
) -> bool: ...
def segment_weights(
    mesh: Mesh,
    ends: Buffer,
    segment: Buffer,
    pieces: Buffer,
    weights: Buffer,
    points: Buffer,
    /,
) -> None: ...
def locator_from_mesh(
    cls: type[_Locator],
    mesh: Mesh,
    any: bool,
    border: bool,
    areas: bool,
    late_chains: bool,
    fill: int,
    queries: int,
    threads: int,
    progress: Progress | None,
    /,
) -> _Locator: ...

class Surface:
    @property
    def vertex_count(self) -> int: ...
    @property
    def triangle_count(self) -> int: ...
    def _copy_points(self, out: Buffer, /) -> None: ...
    def _copy_triangles(self, out: Buffer, /) -> None: ...
    def _move(
        self,
        points: Buffer,
        vertices: Buffer | None,
        kept: list[Any],
        moved: float,
        threads: int,
        /,
    ) -> None: ...
    def _flip(self, triangle: int, edge: int, kept: list[Any], threads: int, /) -> None: ...
    def _describe(self) -> dict[str, Any]: ...

class Star:
    @property
    def surface(self) -> Surface: ...
    @property
    def ready(self) -> bool: ...
    def _locate(
        self,
        points: Buffer,
        out: Buffer,
        walk: str,
        start: str,
        threads: int,
        progress: Progress | None,
        /,
    ) -> None: ...
    def _project(
        self,
        points: Buffer,
        out: Buffer,
        locations: Buffer,
        threads: int,
        progress: Progress | None,
        /,
    ) -> None: ...
    def _remesh(
        self,
        level: int,
        points: Buffer,
        triangles: Buffer,
        locations: Buffer,
        threads: int,
        progress: Progress | None,
        /,
    ) -> None: ...
    def _describe(self) -> dict[str, Any]: ...

class Prober:
    @property
    def surface(self) -> Surface: ...
    def _probe(
        self,
        queries: Buffer,
        out: Buffer,
        min_distance: float,
        max_distance: float,
        certain: bool,
        extent: str,
        faces: str,
        start: str,
        iterations: int,
        threads: int,
        progress: Progress | None,
        /,
    ) -> None: ...
    def _nearest(
        self,
        points: Buffer,
        out: Buffer,
        max_distance: float,
        threads: int,
        progress: Progress | None,
        /,
    ) -> None: ...
    def _deviation(
        self, surface: Surface, threads: int, progress: Progress | None, /
    ) -> dict[str, Any]: ...
    def _all(
        self,
        query: tuple[float, float, float, float, float, float],
        extent: str,
        faces: str,
        min_distance: float,
        max_distance: float,
        /,
    ) -> memoryview: ...
    def _any(
        self,
        queries: Buffer,
        out: Buffer,
        extent: str,
        faces: str,
        min_distance: float,
        max_distance: float,
        threads: int,
        progress: Progress | None,
        /,
    ) -> None: ...
    def _lists(
        self,
        queries: Buffer,
        one_per_place: bool,
        extent: str,
        faces: str,
        min_distance: float,
        max_distance: float,
        threads: int,
        progress: Progress | None,
        /,
    ) -> tuple[memoryview, memoryview]: ...
    def _inside(self, points: Buffer, out: Buffer, threads: int, /) -> None: ...

_RawChange: TypeAlias = tuple[int, int, int, int, int, int, int, int, bytes | None]

class SurfaceEditor:
    @property
    def surface(self) -> Surface: ...
    def _attach(self, follower: Prober | Star, /) -> None: ...
    def _detach(self, follower: Prober | Star, /) -> None: ...
    def _apply(
        self,
        kind: int,
        triangle: int,
        v0: int,
        v1: int,
        v2: int,
        x: float,
        y: float,
        z: float,
        path: Buffer | None,
        other: Buffer | None,
        /,
    ) -> tuple[int, int, int, int, int, int, bytes, bytes]: ...
    def _undo(self) -> tuple[int, int, int, int, int, int, bytes, bytes]: ...
    def _compact(self, triangles: Buffer, vertices: Buffer, /) -> None: ...
    def _describe(self) -> dict[str, Any]: ...
    def _triangle(self, triangle: int, /) -> tuple[int, int, int] | None: ...
    def _vertex(self, vertex: int, /) -> tuple[float, float, float] | None: ...
    def _living(self, out: Buffer, /) -> None: ...
    def _triangles_of(self, vertex: int, /) -> list[int]: ...
    def _edge(self, a: int, b: int, /) -> list[int]: ...

class Editor:
    def _apply(
        self, kind: int, vertex: int, other: int, field: int, x: float, y: float, value: float, /
    ) -> _RawChange: ...
    def _insert_points(
        self, points: Buffer, vertices: Buffer, progress: Progress | None, /
    ) -> None: ...
    def _undo(self, progress: Progress | None, /) -> _RawChange: ...
    def _log(self) -> list[tuple[int, int, int, int, float, float, float]]: ...
    def _compact(
        self, triangles: Buffer, vertices: Buffer, progress: Progress | None, /
    ) -> None: ...
    def _mesh(
        self, cls: type[_Mesh], numbers: tuple[Buffer, Buffer, Progress | None], /
    ) -> _Mesh: ...
    def _describe(self) -> dict[str, Any]: ...
    def _triangle(self, triangle: int, /) -> tuple[int, int, int] | None: ...
    def _vertex(self, vertex: int, /) -> tuple[float, float] | None: ...
    def _adjacent(self, vertex: int, /) -> list[int]: ...
    def _edge(self, vertex: int, other: int, /) -> int: ...
    def _field(self, name: bytes, /) -> int: ...
    def _value(self, field: int, vertex: int, /) -> float: ...
    def _constrained_edges(self) -> memoryview: ...
    def _locate(
        self,
        points: Buffer,
        out: Buffer,
        hints: Buffer | None,
        threads: int,
        progress: Progress | None,
        /,
    ) -> None: ...
    def _locate_one(self, x: float, y: float, /) -> Location: ...
    def _interpolate(self, field: int, locations: Buffer, out: Buffer, /) -> None: ...

_Editor = TypeVar("_Editor", bound=Editor)
_SurfaceEditor = TypeVar("_SurfaceEditor", bound=SurfaceEditor)

def editor_from_mesh(
    cls: type[_Editor],
    mesh: Mesh,
    fields: list[tuple[bytes, Buffer]],
    delaunay: int,
    undo: int,
    log: bool,
    constrained_edges: Buffer,
    threads: int,
    progress: Progress | None,
    /,
) -> _Editor: ...

_Surface = TypeVar("_Surface", bound=Surface)
_Star = TypeVar("_Star", bound=Star)
_Prober = TypeVar("_Prober", bound=Prober)

def surface_from_arrays(
    cls: type[_Surface],
    points: Buffer,
    triangles: Buffer,
    tolerant: bool,
    weld: bool,
    progress: Progress | None,
    /,
) -> _Surface: ...
def surface_editor_from_surface(
    cls: type[_SurfaceEditor], surface: Surface, undo: int, /
) -> _SurfaceEditor: ...
def star_from_surface(
    cls: type[_Star],
    surface: Surface,
    x: float,
    y: float,
    z: float,
    borrow: bool,
    unchecked: bool,
    threads: int,
    progress: Progress | None,
    /,
) -> _Star: ...
def prober_from_surface(
    cls: type[_Prober],
    surface: Surface,
    boxes: bool,
    guide: bool,
    threads: int,
    progress: Progress | None,
    /,
) -> _Prober: ...
def lonlat_to_direction(lonlat: Buffer, out: Buffer, /) -> None: ...
def direction_to_lonlat(directions: Buffer, out: Buffer, /) -> None: ...
def check_arrays(
    kind: str,
    points: Buffer,
    triangles: Buffer,
    weld: bool,
    centre: tuple[float, float, float],
    progress: Progress | None,
    /,
) -> tuple[bool, list[tuple[str, str, int, int, int, int, int]]]: ...
def mend_arrays(
    points: Buffer,
    triangles: Buffer,
    repairs: int,
    space: bool,
    tolerance: float,
    progress: Progress | None,
    /,
) -> tuple[
    memoryview, memoryview, memoryview, memoryview, list[tuple[int, str, int, int, int]]
]: ...
def delaunay(
    cls: type[_Mesh],
    points: Buffer,
    duplicate_of: Buffer,
    threads: int,
    progress: Progress | None,
    /,
) -> tuple[_Mesh, int]: ...
def triangulate(
    cls: type[_Mesh],
    points: Buffer,
    duplicate_of: Buffer,
    kind: str,
    weights: Buffer | None,
    limit: int,
    threads: int,
    progress: Progress | None,
    /,
) -> tuple[_Mesh, int, bool]: ...
def constrained_delaunay(
    cls: type[_Mesh],
    points: Buffer,
    duplicate_of: Buffer,
    segments: Buffer,
    polygons: Buffer | None,
    seeds: Buffer,
    keep: int,
    split: bool,
    threads: int,
    progress: Progress | None,
    /,
) -> tuple[_Mesh, int, memoryview, memoryview, int, int]: ...
def read_mesh(
    path: bytes, layout: str | None, progress: Progress | None, /
) -> tuple[
    memoryview, memoryview, int, dict[str, memoryview], dict[str, memoryview], str | None
]: ...
def read_constraints(
    path: bytes, progress: Progress | None, /
) -> tuple[
    memoryview,
    int,
    memoryview,
    memoryview,
    memoryview,
    memoryview,
    dict[str, memoryview],
    str,
    memoryview,
]: ...
def read_points(
    path: bytes, columns: str | None, classes: bytes, progress: Progress | None, /
) -> tuple[memoryview, list[str]]: ...
def write_mesh(
    path: bytes,
    format: str | None,
    points: Buffer,
    has_z: bool,
    triangles: Buffer,
    fields: list[tuple[bytes, Buffer]],
    triangle_fields: list[tuple[bytes, Buffer]],
    crs: str | None,
    progress: Progress | None,
    /,
) -> None: ...
def volume_above(
    surface: Locator,
    heights: Buffer,
    base: float,
    threads: int,
    progress: Progress | None,
    /,
) -> tuple[float, float, float, float, float, float, float, float, int]: ...
def volume_between(
    surface: Locator,
    heights: Buffer,
    other: Locator,
    other_heights: Buffer,
    threads: int,
    progress: Progress | None,
    /,
) -> tuple[float, float, float, float, float, float, float, float, int]: ...
def surface_area(
    surface: Locator,
    heights: Buffer,
    region: Locator,
    threads: int,
    progress: Progress | None,
    /,
) -> tuple[float, float, float, int]: ...

_RawRemap: TypeAlias = tuple[Operator, memoryview, memoryview, memoryview, memoryview, float, float]

def remap_to_mesh(
    source: Locator,
    source_cells: Buffer | None,
    source_count: int,
    target: Locator,
    target_cells: Buffer | None,
    target_count: int,
    vertices: bool,
    degrees: bool,
    covered: bool,
    threads: int,
    progress: Progress | None,
    /,
) -> _RawRemap: ...
def remap_to_pixels(
    source: Locator,
    source_cells: Buffer | None,
    source_count: int,
    pixels: tuple[float, float, float, float, int, int],
    vertices: bool,
    degrees: bool,
    covered: bool,
    threads: int,
    progress: Progress | None,
    /,
) -> _RawRemap: ...
def seam_cut(
    points: Buffer, triangles: Buffer, cells: Buffer | None, /
) -> tuple[memoryview, memoryview, memoryview, float] | None: ...
def sights(
    locator: Locator,
    heights: Buffer,
    viewpoint: tuple[float, float, float, bool],
    targets: Buffer,
    absolute: bool,
    out: Buffer,
    progress: Progress | None,
    /,
) -> None: ...
def map_prepared(
    mesh: type[_Mesh],
    locator: type[_Locator],
    path: bytes,
    trust: bool,
    threads: int,
    progress: Progress | None,
    /,
) -> tuple[_Locator, dict[str, memoryview], dict[str, memoryview], str | None, int, bool]: ...
def write_prepared(
    locator: Locator,
    path: bytes,
    fields: list[tuple[bytes, Buffer]],
    triangle_fields: list[tuple[bytes, Buffer]],
    crs: str | None,
    tiles: int,
    progress: Progress | None,
    /,
) -> None: ...
