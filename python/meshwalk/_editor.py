"""Meshes in the plane that change between two queries."""

from __future__ import annotations

import enum
import threading
from typing import TYPE_CHECKING, Any, Literal, NamedTuple

import numpy as np

from meshwalk import _arrays, _core
from meshwalk._locations import LOCATION, Locations
from meshwalk._mesh import Mesh

if TYPE_CHECKING:
    from typing import Self

    from numpy.typing import ArrayLike, NDArray

    from meshwalk._core import Location, Progress

_MODES = {"auto": 0, "make": 1, "never": 2}
_NONE = np.iinfo(np.uint32).max
_CHANGED = _arrays.record_type(
    _core.CHANGED_LAYOUT, {"triangle": np.uint32, "before": (np.uint32, (3,))}
)
# An editor needs the fields in the library's mesh, which is not to be used meanwhile.
_making = threading.Lock()


class EditKind(enum.IntEnum):
    """What an edit does.

    Attributes
    ----------
    INSERT : 0
        A vertex at x, y.
    REMOVE : 1
        The vertex goes.
    MOVE : 2
        The vertex goes to x, y.
    FLIP : 3
        The edge from the vertex to the other is exchanged for the other diagonal.
    CONSTRAIN : 4
        The straight way from the vertex to the other becomes an edge that stays, or
        several.
    RELEASE : 5
        The constraints on the straight way from the vertex to the other end.
    VALUE : 6
        The field of the vertex becomes the value.
    """

    INSERT = 0
    REMOVE = 1
    MOVE = 2
    FLIP = 3
    CONSTRAIN = 4
    RELEASE = 5
    VALUE = 6


class Edit(NamedTuple):
    """One edit, to be applied or from the log; members that its kind does not name are ignored."""

    kind: EditKind
    vertex: int = 0
    other: int = 0
    field: int = 0
    x: float = 0.0
    y: float = 0.0
    value: float = float("nan")


class EdgeKind(enum.IntEnum):
    """What joins two vertices.

    Attributes
    ----------
    NONE : 0
        No edge of the mesh.
    UNCONSTRAINED : 1
        An inner edge that may be flipped away.
    CONSTRAINED : 2
        An edge that stays.
    BORDER : 3
        An edge of one triangle only.
    """

    NONE = 0
    UNCONSTRAINED = 1
    CONSTRAINED = 2
    BORDER = 3


class Change:
    """What an edit changed.

    Attributes
    ----------
    vertex : int
        The one inserted, removed or moved; where there was one at the place to insert at, that one;
        -1 where none is meant.
    vertices_made, vertices_freed : int
        How many vertices are new, or gone: `vertex`, and those next in number.
    flips : int
        Edges exchanged to make the mesh Delaunay again.
    constrained_edges : int
        Of `Editor.constrain` and `Editor.release`: edges on the way.
    """

    __slots__ = (
        "_counts",
        "_raw",
        "constrained_edges",
        "flips",
        "vertex",
        "vertices_freed",
        "vertices_made",
    )

    def __init__(self, raw: tuple[int, int, int, int, int, int, int, int, bytes | None]) -> None:
        self.vertex, self.vertices_made, self.vertices_freed = raw[:3]
        self.flips, self.constrained_edges = raw[3:5]
        self._counts = raw[5:8]
        self._raw = raw[8] or b""

    def _part(self, k: int) -> NDArray[Any]:
        start = sum(self._counts[:k])
        return np.frombuffer(self._raw, _CHANGED)[start : start + self._counts[k]]

    @property
    def made(self) -> NDArray[np.uint32]:
        """New triangles."""
        return self._part(0)["triangle"]

    @property
    def reused(self) -> NDArray[np.uint32]:
        """Triangles that have other vertices now."""
        return self._part(1)["triangle"]

    @property
    def freed(self) -> NDArray[np.uint32]:
        """Triangles that are gone."""
        return self._part(2)["triangle"]

    @property
    def before(self) -> NDArray[np.uint32]:
        """The vertices that the `reused` and then the `freed` triangles had, shape (k, 3)."""
        return np.frombuffer(self._raw, _CHANGED)[self._counts[0] :]["before"]

    def __repr__(self) -> str:
        made, reused, freed = self._counts
        return f"<Change: vertex {self.vertex}; {made} made, {reused} reused, {freed} freed>"


class EditorInfo(NamedTuple):
    """Counts of the mesh and the memory that it takes: the answer of `Editor.describe`.

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
    constrained_edges : int
        Edges that are fixed, the border not counted.
    delaunay : bool
        The mesh is kept Delaunay.
    convex : bool
        It fills its convex hull, which grows and shrinks; else its border is fixed.
    undoable : int
        Edits that can be undone.
    bytes : int
        Memory in use.
    undo_bytes : int
        Of it, for undo and the log.
    index_bytes : int
        Of it, of what leads to the first triangle of a walk.
    edits : int
        Edits carried out, those undone too.
    refreshes : int
        Times that what leads to the first triangle was built anew.
    """

    vertices: int
    triangles: int
    vertex_range: int
    triangle_range: int
    constrained_edges: int
    delaunay: bool
    convex: bool
    undoable: int
    bytes: int
    undo_bytes: int
    index_bytes: int
    edits: int
    refreshes: int


class Editor(_core.Editor):
    """A triangle mesh that changes between two queries, with a locator that follows the edits.

    Parameters
    ----------
    mesh : Mesh
        An embedding without flat triangles. It is copied with its fields, and does not change. Its
        `constrained_edges` are constraints of the editor.
    delaunay : {"auto", "make", "never"}, optional
        A mesh that is Delaunay is kept so; one that is not is made so first; or no edge is flipped
        unless asked for.
    undo : int, optional
        So many edits can be undone; -1 means all.
    log : bool, optional
        Keep a list of all edits.
    threads : int, optional
        How many threads make it; 0 lets the library choose.
    progress : callable, optional
        As of `Locator`. It may not use the editor: here, and in the calls below.

    Raises
    ------
    InputError
        The mesh is no embedding, has flat triangles, or used vertices at one place.

    Notes
    -----
    What an edit costs depends on the triangles it touches, not on the mesh. Numbers are handles: an
    edit renumbers nothing that it does not touch, and the numbers of what it frees are not used
    again before `compact`. Edits and queries of several threads take turns.

    Examples
    --------
    >>> import meshwalk
    >>> editor = meshwalk.Editor(meshwalk.delaunay([[0, 0], [4, 0], [4, 4], [0, 4]]), undo=10)
    >>> change = editor.insert(3, 1)
    >>> change
    <Change: vertex 4; 2 made, 2 reused, 0 freed>
    >>> editor.locate_one(3, 1.5).triangle in [*change.made, *change.reused]
    True
    >>> editor.undo().vertices_freed
    1
    >>> editor
    <Editor: 4 vertices, 2 triangles>
    """

    __slots__ = ("__weakref__", "_edits", "_field_names", "_lock")
    _edits: int
    _field_names: tuple[str, ...]
    _lock: threading.RLock

    def __new__(
        cls,
        mesh: Mesh,
        *,
        delaunay: Literal["auto", "make", "never"] = "auto",
        undo: int = 0,
        log: bool = False,
        threads: int = 0,
        progress: Progress | None = None,
    ) -> Self:
        if not isinstance(mesh, Mesh):
            raise TypeError(f"mesh must be a meshwalk.Mesh, not {type(mesh).__name__}")
        if delaunay not in _MODES:
            raise ValueError(f"delaunay must be one of {', '.join(_MODES)}, not {delaunay!r}")
        kept = 2**64 - 1 if undo == -1 else undo
        fields = [(_arrays.field_name(name), values) for name, values in mesh.fields.items()]
        edges = mesh._constraints[0]
        with _making:
            editor = _core.editor_from_mesh(
                cls, mesh, fields, _MODES[delaunay], kept, log, edges, threads, progress
            )
        editor._field_names = tuple(mesh.fields)
        editor._edits = 0
        editor._lock = threading.RLock()
        return editor

    def _edit(self, edit: Edit) -> Change:
        numbers = (edit.vertex, edit.other, edit.field)
        with self._lock:
            raw = self._apply(edit.kind, *numbers, edit.x, edit.y, edit.value)
            self._edits += 1
        return Change(raw)

    def insert(self, x: float, y: float, value: float = float("nan"), field: str = "z") -> Change:
        """Insert a vertex.

        Parameters
        ----------
        x, y : float
            Its place. Outside of a mesh that fills its convex hull the hull grows.
        value : float, optional
            Of `field` at the new vertex; by default it is interpolated, as the other fields are.
        field : str, optional
            The field of the value.

        Returns
        -------
        Change
            Its `vertex` is the new one, or the one that is there already.

        Raises
        ------
        InputError
            The place is not finite, or outside of a mesh with a fixed border.
        """
        number = 0 if np.isnan(value) else self._field_number(field)
        return self._edit(Edit(EditKind.INSERT, x=x, y=y, field=number, value=value))

    def insert_points(
        self, points: ArrayLike, *, progress: Progress | None = None
    ) -> NDArray[np.int32] | NDArray[np.int64]:
        """Insert many vertices as one edit, faster than one by one.

        Parameters
        ----------
        points : array_like, shape (n, 2)
            Their places. Fields are interpolated.
        progress : callable, optional
            As of `Locator.locate`; a call that is ended changes nothing.

        Returns
        -------
        ndarray of int, shape (n,)
            The vertex at each point.

        Raises
        ------
        InputError
            A point cannot be inserted: nothing has changed.
        """
        rows, _ = _arrays.vertices(points, "points", (2,))
        out = np.empty(len(rows), np.uint32)
        with self._lock:
            self._insert_points(rows, out, progress)
            self._edits += 1
        return _arrays.numbers(out)

    def remove(self, vertex: int) -> Change:
        """Remove a vertex; its triangles are replaced by two fewer.

        Raises
        ------
        InputError
            There is no such vertex, or its border or constraints forbid it.
        """
        return self._edit(Edit(EditKind.REMOVE, vertex))

    def move(self, vertex: int, x: float, y: float) -> Change:
        """Move a vertex, which keeps its number and values.

        Raises
        ------
        InputError
            There is no such vertex, or a constraint or fixed border forbids the place.
        """
        return self._edit(Edit(EditKind.MOVE, vertex, x=x, y=y))

    def flip(self, vertex: int, other: int) -> Change:
        """Exchange the edge between two vertices for the other diagonal.

        Raises
        ------
        InputError
            The two triangles do not form a strictly convex quadrilateral. If the mesh is not
            Delaunay after the exchange, it is no longer kept Delaunay.
        """
        return self._edit(Edit(EditKind.FLIP, vertex, other))

    def constrain(self, vertex: int, other: int) -> Change:
        """Make the segment between two vertices an edge that stays, or a chain of such edges.

        Raises
        ------
        InputError
            The way crosses a constraint or leaves the mesh.
        """
        return self._edit(Edit(EditKind.CONSTRAIN, vertex, other))

    def release(self, vertex: int, other: int) -> Change:
        """Release the constraints along the segment between two vertices.

        Raises
        ------
        InputError
            A part of the segment is not a constraint, or is border.
        """
        return self._edit(Edit(EditKind.RELEASE, vertex, other))

    def set_value(self, vertex: int, value: float, field: str = "z") -> Change:
        """Change the value of a field at a vertex.

        Raises
        ------
        InputError
            There is no such vertex.
        KeyError
            There is no such field.
        """
        number = self._field_number(field)
        return self._edit(Edit(EditKind.VALUE, vertex, field=number, value=value))

    def apply(self, edit: Edit) -> Change:
        """Carry out an edit, such as one of `log`."""
        return self._edit(edit)

    def undo(self, *, progress: Progress | None = None) -> Change:
        """Undo the latest edit that has not been undone; restore the mesh and all numbers.

        Parameters
        ----------
        progress : callable, optional
            As of `insert_points`.

        Raises
        ------
        InputError
            There is none, or none kept.
        """
        with self._lock:
            raw = self._undo(progress)
            self._edits += 1
        return Change(raw)

    def log(self) -> list[Edit]:
        """List the edits since the editor was made or compacted, without those undone.

        Applied in this order to the same mesh they give the same one, numbers too. Empty without
        ``log=True``.
        """
        with self._lock:
            return [Edit(EditKind(raw[0]), *raw[1:]) for raw in self._log()]

    def compact(self, *, progress: Progress | None = None) -> tuple[NDArray[Any], NDArray[Any]]:
        """Renumber vertices and triangles without gaps, in the same order.

        Parameters
        ----------
        progress : callable, optional
            As of `insert_points`.

        Returns
        -------
        triangles, vertices : ndarray of int
            The new number of each, -1 for those that are gone.
        """
        with self._lock:
            triangles, vertices = self._numbers()
            self._compact(triangles, vertices, progress)
            self._edits += 1
        return _arrays.numbers(triangles), _arrays.numbers(vertices)

    def mesh(self, *, progress: Progress | None = None) -> Mesh:
        """Copy the present mesh, numbered as by `compact`, with its fields.

        Parameters
        ----------
        progress : callable, optional
            As of `insert_points`.

        Returns
        -------
        Mesh
            Its `constrained_edges` are the constraints that are there now.
        """
        with self._lock:
            triangles, vertices = self._numbers()
            mesh = self._mesh(Mesh, (triangles, vertices, progress))
            edges = np.frombuffer(self._constrained_edges(), np.uint32).reshape(-1, 2)
        fields = {}
        for name in self._field_names:
            fields[name] = np.empty(mesh.vertex_count)
            mesh._copy_field(_arrays.field_name(name), fields[name])
        mesh._set_fields(None, fields)
        mesh._set_constraints(vertices[edges], np.full(len(edges), _NONE, np.uint32))
        return mesh

    def _numbers(self) -> tuple[NDArray[np.uint32], NDArray[np.uint32]]:
        """Room for the new number of each triangle and vertex."""
        info = self.describe()
        return np.empty(info.triangle_range, np.uint32), np.empty(info.vertex_range, np.uint32)

    def triangle(self, triangle: int) -> tuple[int, int, int] | None:
        """The vertices of a triangle; None if no triangle has that number."""
        with self._lock:
            return self._triangle(triangle)

    def vertex(self, vertex: int) -> tuple[float, float] | None:
        """The coordinates of a vertex; None if no vertex has that number."""
        with self._lock:
            return self._vertex(vertex)

    def adjacent(self, vertex: int) -> list[int]:
        """The vertices joined to one by an edge, counter-clockwise round it."""
        with self._lock:
            return self._adjacent(vertex)

    def edge(self, vertex: int, other: int) -> EdgeKind:
        """What kind of edge joins two vertices."""
        with self._lock:
            return EdgeKind(self._edge(vertex, other))

    def value(self, vertex: int, field: str = "z") -> float:
        """The value of a field at a vertex; NaN for a vertex that does not exist."""
        number = self._field_number(field)
        with self._lock:
            return self._value(number, vertex)

    def _field_number(self, field: str) -> int:
        number = self._field(_arrays.field_name(field))
        if number < 0:
            names = ", ".join(self._field_names)
            there = f"it has {names}" if names else "it has none"
            raise KeyError(f"the editor has no field {field!r}; {there}")
        return number

    def locate(
        self,
        xy: ArrayLike,
        threads: int = 0,
        *,
        hints: ArrayLike | None = None,
        progress: Progress | None = None,
    ) -> EditorLocations:
        """Find the triangles that contain points, as the mesh is now.

        Parameters
        ----------
        xy : array_like, shape (..., 2)
            The points, see `Locator.locate`.
        threads : int, optional
            How many threads answer; 0 lets the library choose.
        hints : array_like of int, optional
            Triangles where searches begin, see `Locator.locate`; those that edits have replaced
            lead to their heirs.
        progress : callable, optional
            As of `Locator.locate`.

        Returns
        -------
        EditorLocations
        """
        points, shape = _arrays.queries(xy, "xy", 2)
        first = None if hints is None else _arrays.hints(hints, "hints", shape)
        return self._locate_rows(points, first, shape, threads, progress)

    def _locate_rows(
        self,
        points: NDArray[np.float64],
        hints: NDArray[np.uint32] | None,
        shape: tuple[int, ...],
        threads: int,
        progress: Progress | None,
    ) -> EditorLocations:
        """Locate points as the library takes them; the hints are written."""
        records = np.empty(len(points), LOCATION)
        with self._lock:
            self._locate(points, records, hints, threads, progress)
            edits = self._edits
        return EditorLocations(self, records.reshape(shape), edits)

    def locate_one(self, x: float, y: float) -> Location:
        """Locate one point, as the mesh is now."""
        with self._lock:
            return self._locate_one(x, y)

    def describe(self) -> EditorInfo:
        """Tell counts, and the memory that the editor takes.

        Returns
        -------
        EditorInfo
        """
        with self._lock:
            return EditorInfo(**self._describe())

    def __repr__(self) -> str:
        info = self.describe()
        return f"<Editor: {info.vertices} vertices, {info.triangles} triangles>"

    def __reduce__(self) -> Any:
        raise TypeError("an editor cannot be pickled; its mesh() can")


class EditorLocations(Locations):
    """Where points lie in the mesh of an editor: as `Locations`, as long as nothing is edited."""

    __slots__ = ("_edits", "editor")

    def __init__(self, editor: Editor, records: NDArray[Any], edits: int) -> None:
        self._records = _arrays.frozen(records)
        self.editor = editor
        self._edits = edits

    def interpolate(
        self, values: ArrayLike | str, threads: int = 0, *, progress: Progress | None = None
    ) -> NDArray[np.float64]:
        """Interpolate a field of the editor.

        Parameters
        ----------
        values : str
            Name of a field.
        threads, progress
            Not used: one thread does it.

        Raises
        ------
        RuntimeError
            The mesh was edited since the points were located.
        """
        if not isinstance(values, str):
            raise TypeError("the locations of an editor interpolate fields, by name")
        number = self.editor._field_number(values)
        records = np.ascontiguousarray(self.records).reshape(-1)
        out = np.empty(records.size)
        with self.editor._lock:
            if self.editor._edits != self._edits:
                raise RuntimeError("the mesh was edited since the points were located")
            self.editor._interpolate(number, records, out)
        return out.reshape(self.shape)

    def gradient(self, values: Any) -> Any:
        """Refused for the mesh of an editor: locate in `Editor.mesh`."""
        raise TypeError("the mesh of an editor has no gradients; locate in editor.mesh()")

    def operator(self) -> Any:
        """Refused for the mesh of an editor: locate in `Editor.mesh`."""
        raise TypeError("the mesh of an editor has no operator; locate in editor.mesh()")

    def __getitem__(self, index: Any) -> EditorLocations:
        return EditorLocations(self.editor, np.asarray(self.records[index]), self._edits)

    def __reduce__(self) -> Any:
        raise TypeError("locations of an editor cannot be pickled; their records can")
