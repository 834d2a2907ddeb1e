"""Surfaces whose topology changes between two queries."""

from __future__ import annotations

import weakref
from enum import IntEnum
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from meshwalk import _arrays, _core
from meshwalk._space.surface import Surface, follows_edits

if TYPE_CHECKING:
    from typing import Self

    from numpy.typing import ArrayLike, NDArray

    from meshwalk._space.prober import Prober
    from meshwalk._space.star import Star

_TRIANGLE = _arrays.record_type(
    _core.CHANGED_LAYOUT, {"triangle": np.uint32, "before": (np.uint32, (3,))}
)
_VERTEX = _arrays.record_type(
    _core.CHANGED_VERTEX_LAYOUT, {"vertex": np.uint32, "other": np.uint32}
)
_ANYWHERE = (float("nan"),) * 3


class _Kind(IntEnum):
    """The kinds of edits, as the library numbers them."""

    ADD_VERTEX = 0
    REMOVE_VERTEX = 1
    MOVE_VERTEX = 2
    ADD_TRIANGLE = 3
    REMOVE_TRIANGLE = 4
    SPLIT_EDGE = 5
    SPLIT_TRIANGLE = 6
    FLIP = 7
    COLLAPSE = 8
    CUT = 9
    SEW = 10


class SurfaceChange:
    """What an edit of a surface changed; each list is in ascending order."""

    __slots__ = ("_counts", "_triangles", "_vertices")

    def __init__(self, raw: tuple[int, int, int, int, int, int, bytes, bytes]) -> None:
        self._counts = raw[:6]
        self._triangles = np.frombuffer(raw[6], _TRIANGLE)
        self._vertices = np.frombuffer(raw[7], _VERTEX)

    def _triangle_part(self, k: int) -> NDArray[Any]:
        start = sum(self._counts[:k])
        return self._triangles[start : start + self._counts[k]]

    def _vertex_part(self, k: int) -> NDArray[Any]:
        start = sum(self._counts[3 : 3 + k])
        return self._vertices[start : start + self._counts[3 + k]]

    @property
    def made(self) -> NDArray[np.uint32]:
        """New triangles."""
        return self._triangle_part(0)["triangle"]

    @property
    def reused(self) -> NDArray[np.uint32]:
        """Triangles that have other vertices now, or the same in another order."""
        return self._triangle_part(1)["triangle"]

    @property
    def freed(self) -> NDArray[np.uint32]:
        """Triangles that are gone."""
        return self._triangle_part(2)["triangle"]

    @property
    def before(self) -> NDArray[np.uint32]:
        """The vertices that the `reused` and then the `freed` triangles had, shape (k, 3)."""
        return self._triangles[self._counts[0] :]["before"]

    @property
    def vertices_made(self) -> NDArray[np.uint32]:
        """New vertices."""
        return self._vertex_part(0)["vertex"]

    @property
    def copied(self) -> NDArray[np.int32] | NDArray[np.int64]:
        """Of each new vertex: the vertex that it is a copy of, where a cut made it; else -1."""
        return _arrays.numbers(np.ascontiguousarray(self._vertex_part(0)["other"]))

    @property
    def vertices_freed(self) -> NDArray[np.uint32]:
        """Vertices that are gone."""
        return self._vertex_part(1)["vertex"]

    @property
    def heirs(self) -> NDArray[np.int32] | NDArray[np.int64]:
        """Of each vertex that is gone: the vertex that took its place, or -1."""
        return _arrays.numbers(np.ascontiguousarray(self._vertex_part(1)["other"]))

    @property
    def vertices_moved(self) -> NDArray[np.uint32]:
        """Vertices that are at another place."""
        return self._vertex_part(2)["vertex"]

    def __repr__(self) -> str:
        made, reused, freed, vertices_made, vertices_freed, moved = self._counts
        return (
            f"<SurfaceChange: triangles {made} made, {reused} reused, {freed} freed; "
            f"vertices {vertices_made} made, {vertices_freed} freed, {moved} moved>"
        )


class SurfaceEditorInfo(NamedTuple):
    """Counts of the surface and the memory that it takes: the answer of `SurfaceEditor.describe`.

    Attributes
    ----------
    vertices : int
        Vertices that are there.
    triangles : int
        Triangles that are there.
    vertex_range : int
        All numbers of vertices are below this.
    triangle_range : int
        All numbers of triangles are below this.
    border_edges : int
        Edges of one triangle.
    undoable : int
        Edits that can be undone.
    bytes : int
        Memory of the editor, with the room in the surface that edits will use.
    undo_bytes : int
        Of it, for undo.
    edits : int
        Edits carried out, those undone too.
    """

    vertices: int
    triangles: int
    vertex_range: int
    triangle_range: int
    border_edges: int
    undoable: int
    bytes: int
    undo_bytes: int
    edits: int


class SurfaceEditor(_core.SurfaceEditor):
    """Changes the topology of a surface between two queries; its probers and stars follow.

    Parameters
    ----------
    surface : Surface
        The surface, which is changed in place. It must not be welded, nor have fields, which would
        not follow. It has one editor at a time, and only the editor changes it then, but for
        `Surface.move`.
    undo : int, optional
        So many edits can be undone; -1 means all.

    Raises
    ------
    InputError
        A triangle has a vertex twice, or an edge more than two triangles.
    ValueError
        The surface is welded, has fields, or has an editor.

    Notes
    -----
    What an edit costs depends on the triangles it touches, not on the surface. Probers and stars of
    the surface follow, those made later too: each answers as one made anew. The editor keeps them
    alive until `detach`. A star answers ``Where.BAD`` while the surface is not star-shaped, and
    where a triangle has no area, until `Surface.move` is called.

    Numbers are handles: an edit renumbers nothing that it does not touch, and the numbers of what
    it frees are not used again before `compact`. Until then a freed triangle stays in
    `Surface.triangles` as one vertex three times, and its vertices stay in `Surface.points`.

    A refused edit changes nothing. Edits of several threads take turns, and queries wait for the
    end of an edit.

    Examples
    --------
    >>> import meshwalk
    >>> points = [[0, 0, 0], [1, 0, 0], [2, 0, 0], [0, 1, 0], [1, 1, 0], [2, 1, 0]]
    >>> squares = meshwalk.Surface(points, [[0, 1, 3], [1, 4, 3], [1, 2, 4], [2, 5, 4]])
    >>> prober = meshwalk.Prober(squares, boxes=True)
    >>> editor = meshwalk.SurfaceEditor(squares, undo=10)
    >>> change = editor.cut([1, 4])
    >>> change.vertices_made, change.copied
    (array([6, 7], dtype=uint32), array([1, 4], dtype=int32))
    >>> squares.describe().components
    2
    >>> change = editor.remove_triangle(0)
    >>> prober.probe([[0.25, 0.25, 1]], [[0, 0, -1]], certain=True).triangle
    array([-1], dtype=int32)
    >>> change = editor.undo()
    >>> prober.probe([[0.25, 0.25, 1]], [[0, 0, -1]], certain=True).triangle
    array([0], dtype=int32)
    >>> editor
    <SurfaceEditor: 8 vertices, 4 triangles>
    """

    __slots__ = ("__weakref__",)
    if TYPE_CHECKING:
        surface: Surface

    def __new__(cls, surface: Surface, *, undo: int = 0) -> Self:
        if not isinstance(surface, Surface):
            raise TypeError(f"surface must be a meshwalk.Surface, not {type(surface).__name__}")
        if surface.fields:
            raise ValueError("the surface has fields, which would not follow edits")
        with surface._lock:
            editor = _core.surface_editor_from_surface(
                cls, surface, 2**64 - 1 if undo == -1 else undo
            )
            for follower in surface._kept:
                if follows_edits(follower):
                    editor._attach(follower)
            surface._editor = weakref.ref(editor)
        return editor

    def _edit(
        self,
        kind: _Kind,
        *,
        triangle: int = 0,
        vertices: tuple[int, ...] = (),
        point: ArrayLike | None = None,
        path: ArrayLike | None = None,
        other: ArrayLike | None = None,
    ) -> SurfaceChange:
        x, y, z = _ANYWHERE if point is None else _place(point)
        v0, v1, v2 = (*vertices, 0, 0, 0)[:3]
        chains = [
            None if chain is None else _arrays.indices(chain, name, (None,), None)
            for name, chain in (("path", path), ("other", other))
        ]
        with self.surface._lock:
            return SurfaceChange(self._apply(kind, triangle, v0, v1, v2, x, y, z, *chains))

    def add_vertex(self, point: ArrayLike) -> SurfaceChange:
        """Add a vertex of no triangle.

        Parameters
        ----------
        point : array_like, shape (3,)
            Its place.

        Returns
        -------
        SurfaceChange
            Its `vertices_made` has the number.
        """
        return self._edit(_Kind.ADD_VERTEX, point=point)

    def remove_vertex(self, vertex: int) -> SurfaceChange:
        """Remove a vertex and all triangles round it, which leaves a hole.

        Raises
        ------
        InputError
            There is no such vertex, or no triangle would be left.
        """
        return self._edit(_Kind.REMOVE_VERTEX, vertices=(vertex,))

    def move_vertex(self, vertex: int, point: ArrayLike) -> SurfaceChange:
        """Move a vertex; its triangles stay as they are, whatever shape they get.

        Raises
        ------
        InputError
            There is no such vertex, or the place is not finite.
        """
        return self._edit(_Kind.MOVE_VERTEX, vertices=(vertex,), point=point)

    def add_triangle(self, a: int, b: int, c: int) -> SurfaceChange:
        """Add a triangle of three vertices, counter-clockwise as seen from its front.

        Raises
        ------
        InputError
            A vertex is named twice, or an edge has two triangles, or one of opposite orientation.
        """
        return self._edit(_Kind.ADD_TRIANGLE, vertices=(a, b, c))

    def remove_triangle(self, triangle: int) -> SurfaceChange:
        """Remove a triangle; its vertices stay.

        Raises
        ------
        InputError
            There is no such triangle, or it is the last one.
        """
        return self._edit(_Kind.REMOVE_TRIANGLE, triangle=triangle)

    def split_edge(self, a: int, b: int, point: ArrayLike | None = None) -> SurfaceChange:
        """Split an edge by a new vertex, and with it the triangles at the edge.

        Parameters
        ----------
        a, b : int
            The ends of the edge.
        point : array_like, shape (3,), optional
            The place of the vertex; the middle by default.

        Raises
        ------
        InputError
            No edge joins the vertices.
        """
        return self._edit(_Kind.SPLIT_EDGE, vertices=(a, b), point=point)

    def split_triangle(self, triangle: int, point: ArrayLike | None = None) -> SurfaceChange:
        """Split a triangle in three by a new vertex.

        Parameters
        ----------
        triangle : int
            The triangle.
        point : array_like, shape (3,), optional
            The place of the vertex; the centre of gravity by default.

        Raises
        ------
        InputError
            There is no such triangle.
        """
        return self._edit(_Kind.SPLIT_TRIANGLE, triangle=triangle, point=point)

    def flip(self, a: int, b: int) -> SurfaceChange:
        """Exchange the edge between two vertices for the other diagonal of its two triangles.

        Raises
        ------
        InputError
            No edge joins the vertices, it is a border, its triangles have opposite orientation, or
            the other diagonal is an edge already.
        """
        return self._edit(_Kind.FLIP, vertices=(a, b))

    def collapse(self, gone: int, kept: int, point: ArrayLike | None = None) -> SurfaceChange:
        """Merge a vertex into another one that an edge joins to it.

        Parameters
        ----------
        gone, kept : int
            The ends of the edge.
        point : array_like, shape (3,), optional
            Where `kept` goes; by default it stays.

        Raises
        ------
        InputError
            No edge joins the vertices, or the surface would become another one [Dey, Edelsbrunner,
            Guha, Nekhayev 1999].
        """
        return self._edit(_Kind.COLLAPSE, vertices=(gone, kept), point=point)

    def cut(self, path: ArrayLike) -> SurfaceChange:
        """Cut along a path of edges, which become borders.

        Parameters
        ----------
        path : array_like of int, shape (k,)
            At least two vertices, each joined to the next one by an edge.

        Raises
        ------
        InputError
            It is no path of inner edges, or too short to open anything.
        """
        return self._edit(_Kind.CUT, path=path)

    def sew(self, path: ArrayLike, other: ArrayLike) -> SurfaceChange:
        """Sew one chain of border edges to another.

        Parameters
        ----------
        path, other : array_like of int, shape (k,)
            The chains, vertex by vertex; those of `other` merge into those of `path`.

        Raises
        ------
        InputError
            A chain is no border, or an edge would have a third triangle or opposite orientations.
        """
        chains = [np.shape(path), np.shape(other)]
        if chains[0] != chains[1]:
            raise ValueError(
                f"the chains must have the same shape, not {chains[0]} and {chains[1]}"
            )
        return self._edit(_Kind.SEW, path=path, other=other)

    def undo(self) -> SurfaceChange:
        """Undo the latest edit that has not been undone; restore the surface and all numbers.

        Returns
        -------
        SurfaceChange
            What undoing changed.

        Raises
        ------
        InputError
            There is none, or none kept.
        """
        with self.surface._lock:
            return SurfaceChange(self._undo())

    def compact(self) -> tuple[NDArray[Any], NDArray[Any]]:
        """Renumber without gaps, in the same order; earlier edits cannot be undone then.

        Returns
        -------
        triangles, vertices : ndarray of int
            The new number of each, -1 for those that are gone.
        """
        with self.surface._lock:
            info = self.describe()
            triangles = np.empty(info.triangle_range, np.uint32)
            vertices = np.empty(info.vertex_range, np.uint32)
            self._compact(triangles, vertices)
        return _arrays.numbers(triangles), _arrays.numbers(vertices)

    def attach(self, follower: Prober | Star) -> None:
        """Let a prober or a star follow again after `detach`."""
        if getattr(follower, "surface", None) is not self.surface:
            raise ValueError("the prober or star is not of this surface")
        with self.surface._lock:
            self._detach(follower)
            self._attach(follower)

    def detach(self, follower: Prober | Star) -> None:
        """Stop a prober or a star from following edits: edits get faster, it gets out of date."""
        with self.surface._lock:
            self._detach(follower)

    def copy(self) -> Surface:
        """Copy the present surface, numbered as by `compact`.

        Returns
        -------
        Surface
        """
        surface = self.surface
        with surface._lock:
            there = np.empty(surface.vertex_count, np.bool_)
            self._living(there)
            points, triangles = surface.points[there], surface.triangles
        triangles = triangles[(triangles != triangles[:, :1]).any(axis=1)]
        numbers = np.cumsum(there) - 1
        return type(surface)(points, numbers[triangles])

    def triangle(self, triangle: int) -> tuple[int, int, int] | None:
        """The vertices of a triangle; None if no triangle has that number."""
        with self.surface._lock:
            return self._triangle(triangle)

    def vertex(self, vertex: int) -> tuple[float, float, float] | None:
        """The coordinates of a vertex; None if no vertex has that number."""
        with self.surface._lock:
            return self._vertex(vertex)

    def triangles_of(self, vertex: int) -> list[int]:
        """The triangles round a vertex, in ascending order."""
        with self.surface._lock:
            return self._triangles_of(vertex)

    def edge(self, a: int, b: int) -> list[int]:
        """The triangles at the edge between two vertices, none if there is no such edge."""
        with self.surface._lock:
            return self._edge(a, b)

    def describe(self) -> SurfaceEditorInfo:
        """Tell counts, and the memory that the editor takes.

        Returns
        -------
        SurfaceEditorInfo
        """
        with self.surface._lock:
            return SurfaceEditorInfo(**self._describe())

    def __repr__(self) -> str:
        info = self.describe()
        return f"<SurfaceEditor: {info.vertices} vertices, {info.triangles} triangles>"

    def __reduce__(self) -> Any:
        raise TypeError("an editor cannot be pickled; its copy() can")


def _place(point: ArrayLike) -> tuple[float, float, float]:
    """One point in space; what is not finite is the library's to refuse."""
    rows, _ = _arrays.queries(point, "point", 3)
    if np.shape(point) != (3,):
        raise ValueError(f"point must have the shape (3,), not {np.shape(point)}")
    if np.isnan(rows[0, 0]):
        raise ValueError("point is not finite")
    x, y, z = (float(value) for value in rows[0])
    return x, y, z
