"""Which triangle contains a point."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Literal, NamedTuple

import numpy as np

from meshwalk import _arrays, _core
from meshwalk._errors import InputError
from meshwalk._locations import LOCATION, Locations
from meshwalk._mesh import Mesh
from meshwalk._segments import PIECE, Segments

if TYPE_CHECKING:
    import os
    from typing import Self

    from numpy.typing import ArrayLike, NDArray

    from meshwalk._core import Progress

walk_names: tuple[str, ...] = _core.WALK_NAMES
"""The walks of `Locator.locate` and `Locator.walk_path`; ``"auto"`` lets the library choose."""

start_names: tuple[str, ...] = _core.START_NAMES
"""The ways to find the first triangle of a walk; ``"auto"`` lets the library choose."""

_BORDER = _arrays.record_type(
    _core.BORDER_LAYOUT,
    {
        "triangle": np.int32,
        "edge": np.int32,
        "distance": np.float64,
        "point": (np.float64, (2,)),
        "weights": (np.float64, (3,)),
    },
)
_BLOCK = 1 << 14
"""Points that are worked on at a time: Ctrl-C is looked for in between."""

_FILLS = {"auto": 0, "yes": 1, "no": 2}


class NearestBorder(NamedTuple):
    """The border edge nearest to a point: the answer of `Locator.nearest_border`.

    For an array of points, each member is an array.

    Attributes
    ----------
    triangle : int
        The triangle that has the edge; of several at the same distance the lowest.
    edge : int
        Its local edge, which joins the local vertices k and (k + 1) mod 3.
    distance : float
        In units of the mesh, rounded; 0 for a point on the border.
    point : tuple[float, float]
        The nearest point of that edge, rounded.
    weights : tuple[float, float, float]
        The same point as weights of the triangle's vertices.
    """

    triangle: Any
    edge: Any
    distance: Any
    point: Any
    weights: Any


class LocatorInfo(NamedTuple):
    """What a locator has built beside the mesh: the answer of `Locator.describe`.

    Attributes
    ----------
    bytes : int
        All memory of the locator, the mesh not counted.
    border_bytes : int
        Of it, the index of the border.
    area_bytes : int
        Of it, stored areas.
    fill_bytes : int
        Of it, the triangles that fill pockets and holes, and the copy that they are in.
    guide_bytes : int
        Of it, the guide and chains.
    chain_bytes : int
        Of these, chains, which name the triangle of a point whatever the mesh. They are the guide,
        or end long walks beside it. Queries may make them, once: then all sums grow.
    guide : str or None
        The start that leads queries to their first triangle where nothing is said;
        ``"chains"`` where walks from the others would be long; None if nothing is built.
    ghost_triangles : int
        Triangles that fill pockets and holes.
    holes : int
        Holes of the mesh.
    components : int
        Pieces that share no place; only where pockets and holes are open, else 1.
    copied : bool
        Walks run on a copy of the triangles.
    embedding : bool
        False only with ``any=True``.
    unfilled : bool
        Pockets and holes are not filled.
    void_promise : str or None
        Of a mesh that is no embedding: which promise does not hold.
    """

    bytes: int
    border_bytes: int
    area_bytes: int
    fill_bytes: int
    guide_bytes: int
    chain_bytes: int
    guide: str | None
    ghost_triangles: int
    holes: int
    components: int
    copied: bool
    embedding: bool
    unfilled: bool
    void_promise: str | None


class Locator(_core.Locator):
    """Finds the triangle that contains a point: exactly, and without an index of the triangles.

    Parameters
    ----------
    mesh : Mesh
        Any embedding: convex or not, with holes, in pieces, Delaunay or not.
    border : bool, optional
        Build what `nearest_border` and a `tolerance` need.
    any : bool, optional
        Take also a mesh that is no embedding; `describe` says which promise is void then.
    fill : {"auto", "yes", "no"}, optional
        Whether pockets and holes of a mesh that is not convex are filled with triangles of the
        locator's own, which walks can cross.
    queries : int, optional
        For ``fill="auto"``: about so many are to come; few do not pay for filling. 0 means many.
    areas : bool, optional
        Store twice the area of each triangle, for the walk ``"direct"``.
    late_chains : bool, optional
        Whether queries may make chains for all triangles, once, if their walks are long: when
        these have visited 16 times as many triangles as there are. It takes 68 to 88 bytes a
        triangle, and some tenths of a second for a million. False: no query takes memory for it,
        and walks stay long where the guide leads badly.
    threads : int, optional
        How many threads build it; 0 lets the library choose.
    progress : callable, optional
        Called now and then with what is being done (str) and how much of it is done (from 0
        to 1), at most 300 times. An exception in it ends the call, as Ctrl-C does.

    Raises
    ------
    InputError
        The mesh has no triangle with an area, or is no embedding; the exception tells the first
        defect, `Mesh.check` all of them.

    Notes
    -----
    A locator keeps its mesh alive. Any number of threads may ask it at a time.

    Examples
    --------
    >>> import meshwalk
    >>> mesh = meshwalk.Mesh([[0, 0], [4, 0], [4, 4], [0, 4]], [[0, 1, 2], [0, 2, 3]])
    >>> locator = meshwalk.Locator(mesh)
    >>> locator.locate([[3, 1], [1, 3], [9, 9]]).triangle
    array([ 0,  1, -1], dtype=int32)
    >>> locator.locate_one(3, 1)
    <Location: inside of triangle 0, weights (0.25, 0.5, 0.25)>
    """

    __slots__ = ("__weakref__", "_options")
    _options: dict[str, Any]
    if TYPE_CHECKING:
        mesh: Mesh

    def __new__(
        cls,
        mesh: Mesh,
        border: bool = False,
        *,
        any: bool = False,
        fill: Literal["auto", "yes", "no"] = "auto",
        queries: int = 0,
        areas: bool = False,
        late_chains: bool = True,
        threads: int = 0,
        progress: Progress | None = None,
    ) -> Self:
        if not isinstance(mesh, Mesh):
            raise TypeError(f"mesh must be a meshwalk.Mesh, not {type(mesh).__name__}")
        if fill not in _FILLS:
            raise ValueError(f"fill must be one of {', '.join(_FILLS)}, not {fill!r}")
        try:
            locator = _core.locator_from_mesh(
                cls, mesh, any, border, areas, late_chains, _FILLS[fill], queries, threads, progress
            )
        except InputError as error:
            defects = mesh.check().defects
            error.defect = next((d for d in defects if d.triangle == error.triangle), None)
            raise
        locator._options = {
            "border": border,
            "any": any,
            "fill": fill,
            "queries": queries,
            "areas": areas,
            "late_chains": late_chains,
        }
        return locator

    def locate(
        self,
        xy: ArrayLike,
        tolerance: float = 0,
        hints: ArrayLike | None = None,
        threads: int = 0,
        *,
        walk: str = "auto",
        start: str = "auto",
        lanes: int = 0,
        progress: Progress | None = None,
    ) -> Locations:
        """Find the triangles that contain points.

        Parameters
        ----------
        xy : array_like, shape (..., 2)
            The points, in the units of the mesh, of any real type that fits doubles exactly. Not
            copied if these are doubles whose rows have no gaps within, such as
            ``table[:, :2]``. A point that is NaN, infinite or masked is ``Where.BAD``.
        tolerance : float, optional
            Points outside at most so far from the mesh are ``Where.NEAR``: they get the nearest
            triangle and its values, though `Locations.inside` is False for them. Needs a locator
            with ``border=True``.
        hints : array_like of int, optional
            For each point a triangle where its search begins, such as `triangle` of the answer
            before; of the shape of the answer. -1 is no hint, and a number that no triangle has is
            none either. Good ones save time where a mesh is large; the answers are the same. A
            `Cursor` keeps them from call to call.
        threads : int, optional
            How many threads answer; 0 lets the library choose. The answers are the same.
        walk, start : str, optional
            By which walk, and from which first triangle: one of `meshwalk.walk_names`, such as
            ``"straight"``, and of `meshwalk.start_names`. The answers are the same.
        lanes : int, optional
            Walks in flight at a time; 0 lets the library choose.
        progress : callable, optional
            Called now and then with what is being done (str) and how much of it is done (from 0
            to 1), at most 300 times. An exception in it ends the call, as Ctrl-C does.

        Returns
        -------
        Locations
            Of the shape ``xy.shape[:-1]``, with the attributes `triangle`, `where`, `weights`,
            `hole`, `inside` and the method `interpolate`.

        Examples
        --------
        >>> import meshwalk
        >>> mesh = meshwalk.delaunay([[0, 0], [4, 0], [4, 4], [0, 4]])
        >>> hit = meshwalk.Locator(mesh, border=True).locate([[2, 5], [2, 9]], tolerance=1)
        >>> [meshwalk.Where(where).name for where in hit.where]
        ['NEAR', 'OUTSIDE']
        """
        self._check_tolerance(tolerance)
        points, shape = _arrays.queries(xy, "xy", 2)
        first = None if hints is None else _arrays.hints(hints, "hints", shape)
        records = np.empty(len(points), LOCATION)
        self._locate(points, records, first, walk, start, tolerance, lanes, threads, progress)
        return Locations._of(self.mesh, records.reshape(shape))

    def prepare(self, path: str | os.PathLike[str], *, progress: Progress | None = None) -> None:
        """Write the mesh and this locator to a prepared file (``.mwm``), for `meshwalk.map`.

        The file has the fields and the coordinate system of the mesh; the index of the border, if
        the locator has one. It appears under its name when it is complete.

        Parameters
        ----------
        path : str or path-like
            The file.
        progress : callable, optional
            As of `Locator`.

        Raises
        ------
        OSError
            The file cannot be written.
        ValueError
            Pockets and holes of the mesh are open: make the locator with ``fill="yes"``; or the
            mesh is no embedding.
        """
        self._write(_arrays.path(path), 0, progress)

    def _write(self, path: bytes, tiles: int, progress: Progress | None) -> None:
        """Write a prepared file, or, where `tiles` is not 0, a folder of tiles."""
        mesh = self.mesh
        fields = [(_arrays.field_name(name), v) for name, v in mesh.fields.items()]
        others = [(_arrays.field_name(name), v) for name, v in mesh.triangle_fields.items()]
        _core.write_prepared(self, path, fields, others, mesh.crs, tiles, progress)

    def _check_tolerance(self, tolerance: float) -> None:
        if np.ndim(tolerance):
            raise TypeError(
                "tolerance must be a number, not an array; points are one array of shape (..., 2),"
                " such as np.column_stack((x, y))"
            )
        if _arrays.number(tolerance, "tolerance") > 0 and not self._options["border"]:
            raise ValueError("a tolerance needs a Locator that was made with border=True")

    def nearest_border(self, x: ArrayLike, y: float | None = None) -> NearestBorder:
        """Find the border edge nearest to a point, or to each of many, exactly.

        Parameters
        ----------
        x, y : float, or one array_like of shape (..., 2)
            A finite point, in the units of the mesh; or an array of points, as of `locate`.

        Returns
        -------
        NearestBorder
            Of an array, its members are arrays of the shape of the points; a point that is NaN,
            infinite or masked has -1 and NaN.

        Raises
        ------
        ValueError
            The locator was made without ``border=True``, or the one point is not finite.

        Notes
        -----
        One thread works on an array; Ctrl-C ends it.

        Examples
        --------
        >>> import meshwalk
        >>> mesh = meshwalk.Mesh([[0, 0], [4, 0], [0, 4]], [[0, 1, 2]])
        >>> locator = meshwalk.Locator(mesh, border=True)
        >>> locator.nearest_border(1, -2)
        NearestBorder(triangle=0, edge=0, distance=2.0, point=(1.0, 0.0), weights=(0.75, 0.25, 0.0))
        >>> locator.nearest_border([[1, -2], [-3, 1]]).distance
        array([2., 3.])
        """
        if y is not None:
            one = _arrays.number(x, "x"), _arrays.number(y, "y")
            return NearestBorder(*self._nearest_border(*one))
        points, shape = _arrays.queries(x, "x", 2)
        out = np.empty(len(points), _BORDER)
        for first in range(0, max(len(points), 1), _BLOCK):
            part = slice(first, first + _BLOCK)
            self._nearest_borders(points[part], out[part])
        out = out.reshape(shape)
        return NearestBorder(*(out[name] for name in NearestBorder._fields))

    def walk_path(
        self, x: float, y: float, *, walk: str = "auto", start: str = "auto", seed: int = 0
    ) -> NDArray[np.int32]:
        """List the triangles that a query visits, in order, the first one included.

        Parameters
        ----------
        x, y : float
            The point, in the units of the mesh.
        walk, start : str, optional
            By which walk, and from which first triangle: one of `meshwalk.walk_names`, such as
            ``"straight"``, and of `meshwalk.start_names`, such as ``"random"``.
        seed : int, optional
            Of random choices.

        Returns
        -------
        ndarray of int32
            Each is entered over an edge of the one before, but for those with a pocket or hole in
            between. Empty for a point that is not finite.

        Examples
        --------
        >>> import meshwalk
        >>> mesh = meshwalk.Mesh([[0, 0], [4, 0], [4, 4], [0, 4]], [[0, 1, 2], [0, 2, 3]])
        >>> path = meshwalk.Locator(mesh).walk_path(1, 3, walk="straight", start="centre")
        >>> int(path[-1])
        1
        """
        path = np.frombuffer(self._walk_path(x, y, walk, start, seed), np.uint32)
        return path.view(np.int32)

    def segment(
        self, a: ArrayLike, b: ArrayLike, threads: int = 0, *, progress: Progress | None = None
    ) -> Segments:
        """List the triangles along straight segments, exactly.

        Parameters
        ----------
        a, b : array_like, shape (..., 2)
            Where the segments begin and end, in the units of the mesh; they are broadcast. A
            polyline `xy` has the segments from ``xy[:-1]`` to ``xy[1:]``. A segment with a point
            that is NaN, infinite or masked has no pieces.
        threads : int, optional
            How many threads work on it; 0 lets the library choose. The answers are the same.
        progress : callable, optional
            As of `locate`.

        Returns
        -------
        Segments
            All pieces, in the order of the segments: their triangles, where they begin and end.

        Raises
        ------
        ValueError
            Pockets and holes are open (``fill="no"``), or the mesh is no embedding.

        See Also
        --------
        Segments.exits : where each segment leaves the mesh for the first time.

        Notes
        -----
        A segment that begins on the border and goes outwards has no pieces, as one that is wholly
        outside: `locate` its beginning to tell them apart.

        Examples
        --------
        >>> import meshwalk
        >>> mesh = meshwalk.Mesh([[0, 0], [4, 0], [4, 4], [0, 4]], [[0, 1, 2], [0, 2, 3]])
        >>> pieces = meshwalk.Locator(mesh).segment([1, 2], [9, 2])
        >>> pieces.triangle
        array([1, 0], dtype=int32)
        >>> pieces.start, pieces.stop
        (array([0.   , 0.125]), array([0.125, 0.375]))
        >>> pieces.interpolate([10, 20, 30, 20])
        array([[17.5, 20. ],
               [20. , 25. ]])
        """
        begin, end = _arrays.queries(a, "a", 2), _arrays.queries(b, "b", 2)
        shape = np.broadcast_shapes(begin[1], end[1])
        ends = np.empty((*shape, 4))
        ends[..., :2] = begin[0].reshape(*begin[1], 2)
        ends[..., 2:] = end[0].reshape(*end[1], 2)
        rows = ends.reshape(-1, 4)
        offsets, records = self._segment(rows, threads, progress)
        first, pieces = np.frombuffer(offsets, np.int64), np.frombuffer(records, PIECE)
        return Segments(self.mesh, rows, first, pieces, self)

    def describe(self) -> LocatorInfo:
        """Tell what the locator has built beside the mesh, in bytes.

        Returns
        -------
        LocatorInfo
        """
        return LocatorInfo(**self._describe())

    def __repr__(self) -> str:
        return f"<Locator of {self.mesh!r}>"

    def __reduce__(self) -> tuple[Any, ...]:
        if self._options.get("mapped"):
            from meshwalk._prepared import map_again

            assert self.mesh._mapped is not None
            return map_again, self.mesh._mapped
        return _restore, (type(self), self.mesh, self._options)


def _restore(cls: type[Locator], mesh: Mesh, options: dict[str, Any]) -> Locator:
    return cls(mesh, **options)


def filled(given: Mesh | Locator, name: str) -> Locator:
    """The locator itself, or one of a mesh that fills pockets and holes."""
    if isinstance(given, Mesh):
        return Locator(given, fill="yes")
    if isinstance(given, Locator):
        return given
    raise TypeError(f"{name} must be a Mesh or a Locator, not {type(given).__name__}")
