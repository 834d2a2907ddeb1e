"""Triangle meshes in space."""

from __future__ import annotations

import threading
import weakref
from types import MappingProxyType
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from meshwalk import _arrays, _core
from meshwalk._check import Check, check_surface
from meshwalk._errors import InputError
from meshwalk._files import read_arrays

if TYPE_CHECKING:
    import os
    from collections.abc import Mapping
    from typing import Self

    from numpy.typing import ArrayLike, NDArray

    from meshwalk._core import Progress
    from meshwalk._space.surface_editor import SurfaceEditor


class SurfaceInfo(NamedTuple):
    """What kind of surface it is: the answer of `Surface.describe`.

    Attributes
    ----------
    vertices : int
        Number of vertices.
    triangles : int
        Number of triangles.
    unused_vertices : int
        Vertices of no triangle.
    flat_triangles : int
        Triangles without area.
    clashing_edges : int
        Inner edges whose two triangles are oriented differently.
    pinched_vertices : int
        Vertices in use where the triangles do not form one fan.
    border_edges : int
        Edges of one triangle only.
    border_loops : int
        Closed chains of border edges.
    components : int
        Pieces that share no vertex.
    closed : bool
        There are triangles, and no border edges.
    oriented : bool
        There are no clashing edges.
    euler : int
        Vertices in use - edges + triangles.
    low : tuple[float, float, float]
        Least coordinates of the vertices in use.
    high : tuple[float, float, float]
        Largest coordinates of the vertices in use.
    area : float
        Sum of the triangles' areas, rounded.
    volume : float
        Of a closed oriented surface: enclosed, positive if fronts face out; else NaN;
        rounded.
    """

    vertices: int
    triangles: int
    unused_vertices: int
    flat_triangles: int
    clashing_edges: int
    pinched_vertices: int
    border_edges: int
    border_loops: int
    components: int
    closed: bool
    oriented: bool
    euler: int
    low: tuple[float, float, float]
    high: tuple[float, float, float]
    area: float
    volume: float


def follows_edits(follower: Any) -> bool:
    """Whether it keeps something that can follow an editor: a borrowed star does not."""
    return not getattr(follower, "_borrows", (False, False))[0]


class Surface(_core.Surface):
    """A triangle mesh in space, with your numbering, whose vertices may move.

    Parameters
    ----------
    points : array_like, shape (n, 3)
        x, y, z of each vertex.
    triangles : array_like of int, shape (m, 3)
        Vertex numbers from 0. The front of a triangle is the side from which its vertices are seen
        counter-clockwise.
    fields : mapping of str to array_like, shape (n,), optional
        Values at the vertices by name.
    weld : bool, optional
        Vertices with equal coordinates are one where neighbours are looked for: wanted for spheres
        with a seam.
    tolerant : bool, optional
        Take also triangles with a vertex twice, vertices that are not finite, and edges of three
        triangles.
    progress : callable, optional
        As of `Locator`.

    Raises
    ------
    InputError
        As of `Mesh`.

    See Also
    --------
    Star : which facet a ray from a centre meets.
    Prober : which triangle a probe touches, and the nearest point.
    SurfaceEditor : splits, cuts and sews a surface.

    Notes
    -----
    The surface keeps its own copy of the arrays. Queries of other threads wait while it changes, so
    it may be used by any number of threads.

    Examples
    --------
    >>> import meshwalk
    >>> points = [[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]]
    >>> triangles = [[0, 2, 4], [2, 1, 4], [1, 3, 4], [3, 0, 4],
    ...              [2, 0, 5], [1, 2, 5], [3, 1, 5], [0, 3, 5]]
    >>> octahedron = meshwalk.Surface(points, triangles)
    >>> octahedron
    <Surface: 6 vertices, 8 triangles>
    >>> octahedron.describe().euler
    2
    """

    __slots__ = ("__weakref__", "_editor", "_fields", "_kept", "_lock", "_options")
    _editor: weakref.ref[SurfaceEditor] | None
    _fields: dict[str, NDArray[np.float64]]
    _kept: weakref.WeakSet[Any]
    _lock: threading.RLock
    _options: tuple[bool, bool]

    def __new__(
        cls,
        points: ArrayLike,
        triangles: ArrayLike,
        fields: Mapping[str, ArrayLike] | None = None,
        *,
        weld: bool = False,
        tolerant: bool = False,
        progress: Progress | None = None,
    ) -> Self:
        rows, _ = _arrays.vertices(points, "points", (3,))
        numbers = _arrays.triangles(triangles, "triangles", _core.MAX_TRIANGLES)
        try:
            surface = _core.surface_from_arrays(cls, rows, numbers, tolerant, weld, progress)
        except InputError as error:
            error.defect = next(iter(check_surface(rows, numbers, weld=weld).defects), None)
            raise
        surface._fields = _arrays.fields(fields, len(rows))
        surface._options = (weld, tolerant)
        surface._editor = None
        surface._kept = weakref.WeakSet()
        surface._lock = threading.RLock()
        return surface

    @classmethod
    def read(
        cls, path: str | os.PathLike[str], *, weld: bool = False, tolerant: bool = False
    ) -> Self:
        """Read a surface from a file: OFF, OBJ, PLY, STL, ``.node``/``.ele``, gzipped or not.

        Parameters
        ----------
        path : str or path-like
            The file, see `meshwalk.read`.
        weld, tolerant : bool, optional
            As of `Surface`.

        Returns
        -------
        Surface
        """
        points, triangles, _, fields = read_arrays(path)
        return cls(points, triangles, fields, weld=weld, tolerant=tolerant)

    @classmethod
    def from_lonlat(
        cls,
        lonlat: ArrayLike,
        triangles: ArrayLike,
        fields: Mapping[str, ArrayLike] | None = None,
        *,
        weld: bool = True,
        tolerant: bool = False,
    ) -> Self:
        """Make a surface of vertices on the unit sphere, by longitude and latitude in degrees.

        Parameters
        ----------
        lonlat : array_like, shape (n, 2)
            Longitude and latitude of each vertex.
        triangles, fields, weld, tolerant
            As of `Surface`; welding closes the seam where longitudes meet, and the poles.

        Returns
        -------
        Surface

        Raises
        ------
        ValueError
            A latitude is above 90 or below -90 degrees, or a number is not finite.
        """
        rows, _ = _arrays.vertices(lonlat, "lonlat", (2,))
        points = np.empty((len(rows), 3))
        _core.lonlat_to_direction(rows, points)
        wrong = np.isnan(points[:, 0])
        if wrong.any():
            first = int(np.argmax(wrong))
            longitude, latitude = rows[first]
            raise ValueError(
                f"lonlat[{first}] is not a longitude and latitude: {longitude}, {latitude}"
            )
        return cls(points, triangles, fields, weld=weld, tolerant=tolerant)

    @property
    def points(self) -> NDArray[np.float64]:
        """x, y, z of each vertex as they are now, shape (n, 3): a new array each time."""
        out = np.empty((self.vertex_count, 3))
        with self._lock:
            self._copy_points(out)
        return out

    @property
    def triangles(self) -> NDArray[np.int32] | NDArray[np.int64]:
        """Vertex numbers of each triangle, shape (m, 3): a new array each time."""
        out = np.empty((self.triangle_count, 3), np.uint32)
        with self._lock:
            self._copy_triangles(out)
        return _arrays.numbers(out)

    @property
    def fields(self) -> Mapping[str, NDArray[np.float64]]:
        """Values at the vertices by name, which cannot be written."""
        return MappingProxyType(self._fields)

    def move(
        self,
        points: ArrayLike,
        vertices: ArrayLike | None = None,
        *,
        moved: float | None = None,
        threads: int = 0,
    ) -> None:
        """Move vertices, and bring up to date all stars and probers of the surface.

        Parameters
        ----------
        points : array_like, shape (n, 3) or (k, 3)
            The new places: of all vertices, or of those that `vertices` names.
        vertices : array_like of int, shape (k,), optional
            Which vertices move.
        moved : float, optional
            No vertex moved farther than that: then the boxes of probers are taken to be so much
            larger, which is quick, and fitted anew only now and then. By default they are fitted
            anew.
        threads : int, optional
            How many threads fit boxes and check stars; 0 lets the library choose.

        Raises
        ------
        InputError
            The vertices have moved, but the surface is no longer star-shaped about the centre of a
            star; its queries are ``Where.BAD`` until it is again.

        Examples
        --------
        >>> import meshwalk
        >>> surface = meshwalk.Surface([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]])
        >>> surface.move([[0, 0, 5]], vertices=[0])
        >>> surface.points[0]
        array([0., 0., 5.])
        """
        rows = np.ascontiguousarray(_arrays.vertices(points, "points", (3,))[0])
        numbers = None
        if vertices is not None:
            numbers = _arrays.indices(vertices, "vertices", (None,), self.vertex_count)
        wanted = self.vertex_count if numbers is None else len(numbers)
        if len(rows) != wanted:
            raise ValueError(f"points must have {wanted} rows, not {len(rows)}")
        with self._lock:
            kept = list(self._kept)
            self._move(rows, numbers, kept, -1.0 if moved is None else moved, threads)

    def flip(self, triangle: int, edge: int) -> None:
        """Exchange the edge between two triangles for the other diagonal of their quadrilateral.

        Parameters
        ----------
        triangle : int
            One of the two triangles.
        edge : int
            Its local edge: edge k joins the local vertices k and (k + 1) mod 3.

        Raises
        ------
        InputError
            The edge has one triangle only, or the other diagonal is an edge already: nothing has
            changed.
        """
        if not 0 <= triangle < self.triangle_count:
            raise ValueError(f"there is no triangle {triangle}")
        if edge not in (0, 1, 2):
            raise ValueError(f"edge must be 0, 1 or 2, not {edge}")
        with self._lock:
            self._flip(triangle, edge, list(self._kept), 0)

    def _keep(self, follower: Any) -> None:
        """What was made beside the surface is to be brought up to date with it."""
        self._kept.add(follower)
        editor = None if self._editor is None else self._editor()
        if editor is not None and follows_edits(follower):
            editor._attach(follower)

    def check(self) -> Check:
        """Find every defect of the surface.

        Returns
        -------
        Check
            `valid` if there is none but flat triangles.
        """
        return check_surface(self.points, self.triangles, weld=self._options[0])

    def describe(self) -> SurfaceInfo:
        """Tell what kind of surface it is: closed, oriented, its pieces, area and volume.

        Returns
        -------
        SurfaceInfo
        """
        return SurfaceInfo(**self._describe())

    def _operator(
        self, kind: str, records: NDArray[Any], threads: int, progress: Progress | None
    ) -> _core.Operator:
        """The weights of answers: "locations", "touches" or "nearest"."""
        with self._lock:
            return _core.operator_on_surface(self, kind, records, threads, progress)

    def _interpolate_table(
        self,
        values: NDArray[Any],
        narrow: bool,
        records: NDArray[Any],
        out: NDArray[Any],
        threads: int,
        progress: Progress | None,
    ) -> None:
        weights = self._operator("locations", records, threads, progress)
        weights.apply(values, narrow, out, False, False, threads, progress)

    def __len__(self) -> int:
        """Number of triangles."""
        return self.triangle_count

    def __repr__(self) -> str:
        fields = f", fields: {', '.join(self._fields)}" if self._fields else ""
        return f"<Surface: {self.vertex_count} vertices, {self.triangle_count} triangles{fields}>"

    def __reduce__(self) -> tuple[Any, ...]:
        with self._lock:
            arrays = (self.points, self.triangles, self._fields)
        triangles = arrays[1]
        if not self._options[1] and (triangles[:, 0] == triangles[:, 1]).any():
            raise TypeError(
                "a surface with freed triangles cannot be pickled: call SurfaceEditor.compact() "
                "first, or pickle SurfaceEditor.copy()"
            )
        return _restore, (type(self), *arrays, *self._options)


def _restore(
    cls: type[Surface],
    points: NDArray[np.float64],
    triangles: NDArray[Any],
    fields: Mapping[str, NDArray[np.float64]],
    weld: bool,
    tolerant: bool,
) -> Surface:
    return cls(points, triangles, fields, weld=weld, tolerant=tolerant)
