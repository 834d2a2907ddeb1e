"""Triangle meshes in the plane."""

from __future__ import annotations

from types import MappingProxyType
from typing import TYPE_CHECKING, Any, Literal, NamedTuple

import numpy as np

from meshwalk import _arrays, _core
from meshwalk._check import Check, check
from meshwalk._errors import InputError

if TYPE_CHECKING:
    import os
    from collections.abc import Mapping
    from typing import Self

    from numpy.typing import ArrayLike, NDArray

if TYPE_CHECKING:
    from meshwalk._core import Progress

_LAYOUTS = {"auto": 0, "hilbert": 1, "as-given": 2}


class MeshInfo(NamedTuple):
    """What kind of mesh it is: the answer of `Mesh.describe`.

    Holes, convexity and the embedding are decided exactly.

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
    clockwise_triangles : int
        Triangles that turn clockwise.
    clashing_edges : int
        Inner edges whose two triangles are oriented differently.
    border_edges : int
        Edges of one triangle only.
    border_loops : int
        Closed chains of border edges.
    components : int
        Pieces that share no vertex.
    holes : int
        Bounded pieces of the plane without the mesh; 0 if it is no embedding.
    oriented : bool
        There are no clashing edges.
    embedding : bool
        The triangles do not overlap and meet in whole edges and vertices only.
    convex : bool
        An embedding that fills its convex hull.
    delaunay : bool
        An embedding, and no inner edge has a vertex across it in a circle.
    low : tuple[float, float]
        Least x and y of the vertices in use.
    high : tuple[float, float]
        Largest x and y of the vertices in use.
    area : float
        Sum of the triangles' areas.
    """

    vertices: int
    triangles: int
    unused_vertices: int
    flat_triangles: int
    clockwise_triangles: int
    clashing_edges: int
    border_edges: int
    border_loops: int
    components: int
    holes: int
    oriented: bool
    embedding: bool
    convex: bool
    delaunay: bool
    low: tuple[float, float]
    high: tuple[float, float]
    area: float


class Reordered(NamedTuple):
    """A mesh with other numbers, and the old ones: the answer of `Mesh.reordered`.

    Attributes
    ----------
    mesh : Mesh
        The same mesh, whose neighbours have near numbers.
    vertices : ndarray of uint32, shape (n,)
        The old number of each new vertex: new vertex i is vertex ``vertices[i]`` of the old mesh,
        so ``values[vertices]`` are the values of the old vertices in the new order.
    triangles : ndarray of uint32, shape (m,)
        The old number of each new triangle, likewise.
    """

    mesh: Mesh
    vertices: NDArray[np.uint32]
    triangles: NDArray[np.uint32]


class Mesh(_core.Mesh):
    """A triangle mesh in the plane, with your numbering.

    Parameters
    ----------
    points : array_like, shape (n, 2) or (n, 3)
        x, y of each vertex, of any real type that fits doubles exactly. A third column becomes the
        field ``"z"``. Nothing is copied on the way if these are doubles whose rows have no gaps
        within.
    triangles : array_like of int, shape (m, 3)
        Vertex numbers from 0, turned either way.
    fields : mapping of str to array_like, shape (n,), optional
        Values at the vertices, such as heights, by name.
    tolerant : bool, optional
        Take also triangles with a vertex twice, vertices that are not finite, and edges of three
        triangles. The triangles concerned are kept, but own no point.
    layout : {"auto", "hilbert", "as-given"}, optional
        How the mesh lies in memory. No number shows it.
    triangle_fields : mapping of str to array_like, shape (m,), optional
        Values of the triangles, such as materials, by name.
    crs : str, optional
        The coordinate system of the points: WKT, or a code such as ``"EPSG:2056"``.
    threads : int, optional
        How many threads build it; 0 lets the library choose.
    progress : callable, optional
        Called now and then with what is being done (str) and how much of it is done (from 0
        to 1), at most 300 times. An exception in it ends the call, as Ctrl-C does.

    Raises
    ------
    InputError
        A triangle names a vertex that does not exist, or has a vertex twice, or one with a
        coordinate that is NaN or infinite, or an edge belongs to three triangles. `check` lists all
        such places. Vertices of no triangle may have any coordinates.
    LimitError
        More than 2**30 triangles.
    TypeError, ValueError
        Arrays of the wrong type or shape, or with masked members.

    See Also
    --------
    delaunay : a mesh of points.
    read : a mesh from a file.
    Locator : finds the triangle of a point.

    Notes
    -----
    The mesh keeps its own copy of the arrays: what you change in them later does not change it. A
    mesh never changes, so any number of threads may use it. It pickles with its arrays.

    Examples
    --------
    >>> import meshwalk
    >>> mesh = meshwalk.Mesh([[0, 0], [4, 0], [4, 4], [0, 4]], [[0, 1, 2], [0, 2, 3]],
    ...                      fields={"height": [10, 20, 30, 20]})
    >>> mesh
    <Mesh: 4 vertices, 2 triangles, fields: height>
    >>> mesh.triangles
    array([[0, 1, 2],
           [0, 2, 3]], dtype=int32)
    """

    __slots__ = (
        *("__weakref__", "_constraints", "_crs", "_fields"),
        *("_mapped", "_options", "_triangle_fields"),
    )
    _constraints: tuple[NDArray[np.uint32], NDArray[np.uint32]]
    _crs: str | None
    _fields: dict[str, NDArray[np.float64]]
    _mapped: tuple[str, bool, int] | None
    _options: tuple[bool, Literal["auto", "hilbert", "as-given"]]
    _triangle_fields: dict[str, NDArray[np.float64]]

    def __new__(
        cls,
        points: ArrayLike,
        triangles: ArrayLike,
        fields: Mapping[str, ArrayLike] | None = None,
        *,
        tolerant: bool = False,
        layout: Literal["auto", "hilbert", "as-given"] = "auto",
        triangle_fields: Mapping[str, ArrayLike] | None = None,
        crs: str | None = None,
        threads: int = 0,
        progress: Progress | None = None,
    ) -> Self:
        rows, width = _arrays.vertices(points, "points", (2, 3))
        numbers = _arrays.triangles(triangles, "triangles", _core.MAX_TRIANGLES)
        if layout not in _LAYOUTS:
            raise ValueError(f"layout must be one of {', '.join(_LAYOUTS)}, not {layout!r}")
        try:
            mesh = _core.mesh_from_arrays(
                cls, rows[:, :2], numbers, tolerant, _LAYOUTS[layout], threads, progress
            )
        except InputError as error:
            error.defect = next(iter(check(rows, numbers).defects), None)
            raise
        mesh._set_fields(rows[:, 2] if width == 3 else None, fields)
        mesh._triangle_fields = _arrays.fields(
            triangle_fields, mesh.triangle_count, "triangle_fields"
        )
        mesh._options = (tolerant, layout)
        mesh.crs = crs
        return mesh

    def _set_fields(
        self, heights: NDArray[np.float64] | None, fields: Mapping[str, ArrayLike] | None
    ) -> None:
        self._options = (False, "auto")
        self._mapped = None
        self._crs = None
        self._triangle_fields = {}
        self._constraints = (np.empty((0, 2), np.uint32), np.empty(0, np.uint32))
        own = _arrays.fields(fields, self.vertex_count)
        if heights is not None:
            if "z" in own:
                raise ValueError("z is given twice: as a field, and as the third column of points")
            own = {**_arrays.fields({"z": heights}, self.vertex_count), **own}
        self._fields = own

    def _set_mapped(
        self,
        mapped: tuple[str, bool, int],
        fields: dict[str, NDArray[np.float64]],
        triangle_fields: dict[str, NDArray[np.float64]],
        crs: str | None,
    ) -> None:
        """Tell that the mesh is in a file: its path, whether it is trusted, and its checksum."""
        self._set_fields(None, None)
        self._mapped = mapped
        self._fields = fields
        self._triangle_fields = triangle_fields
        self._crs = crs

    def _values(self, given: ArrayLike | str, name: str) -> NDArray[np.float64]:
        """One double for each vertex: the field with the name, or an array."""
        if isinstance(given, str):
            return _arrays.named(self._fields, given)
        return _arrays.field(given, name, self.vertex_count)

    def _set_constraints(self, edges: NDArray[np.uint32], segments: NDArray[np.uint32]) -> None:
        self._constraints = (edges, segments)

    @property
    def points(self) -> NDArray[np.float64]:
        """x, y of each vertex, shape (n, 2): a new array each time."""
        out = np.empty((self.vertex_count, 2))
        self._copy_points(out)
        return out

    @property
    def triangles(self) -> NDArray[np.int32] | NDArray[np.int64]:
        """Vertex numbers of each triangle as given, shape (m, 3): a new array each time.

        Of int32, or of int64 in meshes of more than 2**31 vertices.
        """
        out = np.empty((self.triangle_count, 3), np.uint32)
        self._copy_triangles(out)
        return _arrays.numbers(out)

    @property
    def neighbours(self) -> NDArray[np.int32]:
        """The triangle across each local edge, -1 for none, shape (m, 3): a new array each time.

        Local edge k of a triangle joins its local vertices k and (k + 1) mod 3.
        """
        out = np.empty((self.triangle_count, 3), np.uint32)
        self._copy_neighbours(out)
        return out.view(np.int32)

    @property
    def fields(self) -> Mapping[str, NDArray[np.float64]]:
        """Values at the vertices by name, which cannot be written."""
        return MappingProxyType(self._fields)

    @property
    def triangle_fields(self) -> Mapping[str, NDArray[np.float64]]:
        """Values of the triangles by name, which cannot be written."""
        return MappingProxyType(self._triangle_fields)

    def to_vertices(self, values: ArrayLike | str) -> NDArray[np.float64]:
        """Make values of triangles continuous: the mean round each vertex, weighted by area.

        Parameters
        ----------
        values : array_like, shape (m,), or str
            Values of the triangles, or the name of one of the `triangle_fields`. NaN and masked
            values do not count.

        Returns
        -------
        ndarray, shape (n,)
            Values at the vertices, for `Locations.interpolate`; NaN where no triangle has one.

        Examples
        --------
        >>> import meshwalk
        >>> mesh = meshwalk.Mesh([[0, 0], [4, 0], [4, 4], [0, 4]], [[0, 1, 2], [0, 2, 3]])
        >>> mesh.to_vertices([10, 20])
        array([15., 10., 15., 20.])
        """
        if isinstance(values, str):
            values = _arrays.named(self._triangle_fields, values, "triangle")
        given = _arrays.field(values, "values", self.triangle_count)
        out = np.empty(self.vertex_count)
        self._recover(given, out)
        return out

    def reordered(self) -> Reordered:
        """Renumber vertices and triangles along a Hilbert curve: neighbours get near numbers.

        Where a large mesh is numbered at random, values at its vertices lie far apart in memory,
        and particles or fields take several times as long. The new mesh has all fields,
        constrained edges and the coordinate system; nothing is rounded. Points on edges and
        vertices may belong to another triangle, since the lowest number decides.

        Returns
        -------
        Reordered
            The new mesh, and the old numbers of its vertices and triangles.

        Examples
        --------
        >>> import meshwalk
        >>> mesh = meshwalk.delaunay([[0, 0], [9, 9], [1, 0], [9, 8], [0, 1]])
        >>> near, vertices, triangles = mesh.reordered()
        >>> bool((near.points == mesh.points[vertices]).all())
        True
        """
        triangles = np.empty(self.triangle_count, np.uint32)
        vertices = np.empty(self.vertex_count, np.uint32)
        self._hilbert_order(triangles, vertices)
        number = np.empty(self.vertex_count, np.uint32)
        number[vertices] = np.arange(self.vertex_count, dtype=np.uint32)
        tolerant, layout = self._options
        mesh = Mesh(
            self.points[vertices],
            number[self.triangles[triangles]],
            {name: values[vertices] for name, values in self._fields.items()},
            tolerant=tolerant,
            layout=layout,
            triangle_fields={n: values[triangles] for n, values in self._triangle_fields.items()},
            crs=self._crs,
        )
        edges, segments = self._constraints
        mesh._set_constraints(number[edges], segments)
        return Reordered(mesh, vertices, triangles)

    @property
    def crs(self) -> str | None:
        """The coordinate system of the points, as WKT or a code; None: not known.

        It may be set. It changes no number: nothing is transformed. `write` keeps it.
        """
        return self._crs

    @crs.setter
    def crs(self, crs: str | None) -> None:
        if crs is not None and not isinstance(crs, str):
            raise TypeError(f"crs must be str or None, not {type(crs).__name__}")
        if crs is not None and ("\0" in crs or not crs.strip()):
            raise ValueError("crs must be WKT or a code such as EPSG:2056")
        self._crs = crs

    @property
    def constrained_edges(self) -> NDArray[np.int32] | NDArray[np.int64]:
        """The edges that are parts of segments, shape (k, 2), of `constrained_delaunay`; or none.

        Each joins two vertices, in the direction of its segment.
        """
        return _arrays.numbers(self._constraints[0])

    @property
    def edge_segments(self) -> NDArray[np.int32] | NDArray[np.int64]:
        """The segment that each of the `constrained_edges` is a part of, shape (k,)."""
        return _arrays.numbers(self._constraints[1])

    def check(self) -> Check:
        """Find every defect of the mesh, and decide whether it is an embedding.

        Returns
        -------
        Check
            With `valid` and the list `defects`. Each defect names its triangles, vertex and edges.

        See Also
        --------
        meshwalk.check : the same for arrays that `Mesh` refuses.

        Examples
        --------
        >>> import meshwalk
        >>> meshwalk.Mesh([[0, 0], [1, 0], [0, 1]], [[0, 1, 2]]).check()
        Check(valid=True, defects=[])
        """
        return check(self.points, self.triangles)

    def describe(self) -> MeshInfo:
        """Tell what kind of mesh it is: holes, components, convex, Delaunay, extent, area.

        Returns
        -------
        MeshInfo

        Examples
        --------
        >>> import meshwalk
        >>> info = meshwalk.Mesh([[0, 0], [4, 0], [0, 2]], [[0, 1, 2]]).describe()
        >>> info.convex, info.area
        (True, 4.0)
        """
        return MeshInfo(**self._describe())

    def write(self, path: str | os.PathLike[str], format: str | None = None) -> None:
        """Write the mesh to a file, see `meshwalk.write`."""
        from meshwalk._files import write

        write(path, self, format)

    def __len__(self) -> int:
        """Number of triangles."""
        return self.triangle_count

    def __repr__(self) -> str:
        fields = f", fields: {', '.join(self._fields)}" if self._fields else ""
        if self._triangle_fields:
            fields += f", of triangles: {', '.join(self._triangle_fields)}"
        return f"<Mesh: {self.vertex_count} vertices, {self.triangle_count} triangles{fields}>"

    def __reduce__(self) -> tuple[Any, ...]:
        if self._mapped is not None:
            from meshwalk._prepared import map_mesh_again

            return map_mesh_again, self._mapped
        arrays = (self.points, self.triangles, self._fields, *self._constraints)
        return _restore, (type(self), *arrays, *self._options, self._crs, self._triangle_fields)


def _restore(
    cls: type[Mesh],
    points: NDArray[np.float64],
    triangles: NDArray[Any],
    fields: Mapping[str, NDArray[np.float64]],
    edges: NDArray[np.uint32],
    edge_segments: NDArray[np.uint32],
    tolerant: bool,
    layout: Literal["auto", "hilbert", "as-given"],
    crs: str | None = None,
    triangle_fields: Mapping[str, NDArray[np.float64]] | None = None,
) -> Mesh:
    mesh = cls(
        points,
        triangles,
        fields,
        tolerant=tolerant,
        layout=layout,
        triangle_fields=triangle_fields,
        crs=crs,
    )
    mesh._set_constraints(edges, edge_segments)
    return mesh
