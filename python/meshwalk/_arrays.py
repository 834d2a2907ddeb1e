"""Arrays of users, as the library takes them; what cannot be taken is told with its place.

Each function says when it copies. Nothing here changes a number: a conversion that would round
one is refused.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from meshwalk._errors import LimitError

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import ArrayLike, NDArray

    Rejected = NDArray[np.bool_]


def _place(name: str, rejected: Rejected) -> str:
    """``name[3, 1]``: the first place where `rejected` is true."""
    index = np.unravel_index(int(np.argmax(rejected)), rejected.shape)
    return f"{name}[{', '.join(str(int(i)) for i in index)}]" if rejected.ndim else name


def _as_array(given: ArrayLike, name: str) -> NDArray[Any]:
    try:
        array = np.asanyarray(given)
    except ValueError as error:
        raise ValueError(f"{name}: {error}") from None
    if isinstance(array, np.ma.MaskedArray):
        return array
    return np.asarray(array)


def _no_masked(array: NDArray[Any], name: str) -> NDArray[Any]:
    if not isinstance(array, np.ma.MaskedArray):
        return array
    mask = np.ma.getmaskarray(array)
    if mask.any():
        raise ValueError(f"{_place(name, mask)} is masked")
    return np.asarray(array.data)


def _masked_to_nan(array: NDArray[Any], name: str) -> NDArray[Any]:
    if not isinstance(array, np.ma.MaskedArray):
        return array
    doubles = np.array(_as_doubles(np.asarray(array.data), name))
    doubles[np.ma.getmaskarray(array)] = np.nan
    return doubles


def _as_doubles(array: NDArray[Any], name: str) -> NDArray[np.float64]:
    """The same numbers as doubles: a copy unless they are doubles of this machine."""
    if array.dtype.kind not in "fiu":
        raise TypeError(f"{name} must be real numbers, not {array.dtype}")
    if array.dtype.kind == "f" and array.dtype.itemsize <= 8:
        return array.astype(np.float64, copy=False)
    with np.errstate(over="ignore"):
        doubles = array.astype(np.float64)
    if array.dtype.itemsize >= 8:
        changed = _rounded(array, doubles)
        if changed.any():
            raise ValueError(f"{_place(name, changed)} does not fit a double without rounding")
    return doubles


def _rounded(array: NDArray[Any], doubles: NDArray[np.float64]) -> Rejected:
    """Which numbers are others as doubles."""
    if array.dtype.kind == "f":
        return np.asarray((doubles.astype(array.dtype) != array) & ~np.isnan(array))
    # 2**63 and 2**64 are doubles, but no integers of these types: a cast of them is undefined.
    limit = 2.0**63 if array.dtype.kind == "i" else 2.0**64
    fits = doubles < limit
    return np.asarray(~fits | (np.where(fits, doubles, 0).astype(array.dtype) != array))


def _rows_apart(array: NDArray[np.float64]) -> bool:
    """Whether the library can step over the rows of a two-dimensional array as they lie."""
    size = array.itemsize
    across, along = array.strides
    return array.shape[0] <= 1 or (
        along == size and across % size == 0 and across >= size * array.shape[1]
    )


def _as_rows(array: NDArray[np.float64]) -> NDArray[np.float64]:
    """The same rows, so that the library can step over them: a copy where it cannot."""
    if array.flags.aligned and (
        array.flags.c_contiguous or (array.shape[0] > 1 and _rows_apart(array))
    ):
        return array
    return np.require(array, requirements=("C", "A"))


def vertices(
    given: ArrayLike, name: str, widths: tuple[int, ...]
) -> tuple[NDArray[np.float64], int]:
    """Points of a mesh as rows of doubles, and their width, which is one of `widths`."""
    array = _as_doubles(_no_masked(_as_array(given, name), name), name)
    if array.ndim != 2 or array.shape[1] not in widths:
        wanted = " or ".join(f"(n, {width})" for width in widths)
        across = array.ndim == 2 and array.shape[0] in widths
        hint = _shape_hint(array.shape, name, array.shape[0]) if across else ""
        raise ValueError(f"{name} must have the shape {wanted}, not {array.shape}{hint}")
    return _as_rows(array), array.shape[1]


def _shape_hint(shape: tuple[int, ...], name: str, width: int) -> str:
    """How to make points of an array of another shape."""
    stacked = f"np.column_stack(({', '.join('xyz'[:width])}))"
    if len(shape) == 1:
        return f"; coordinates in arrays of their own are joined by {stacked}"
    if len(shape) == 2 and shape[0] == width:
        return f"; take {name}.T, or {stacked}"
    more = len(shape) > 1 and shape[-1] > width
    return f"; leave columns out as in {name}[..., :{width}]" if more else ""


def queries(given: ArrayLike, name: str, width: int) -> tuple[NDArray[np.float64], tuple[int, ...]]:
    """Points to be located: rows of doubles, and the shape of the answers.

    A point with a masked coordinate becomes NaN, which is located nowhere (``Where.BAD``).
    """
    array = _as_doubles(_masked_to_nan(_as_array(given, name), name), name)
    if array.shape == (0,):
        array = array.reshape(0, width)
    if array.ndim == 0 or array.shape[-1] != width:
        raise ValueError(
            f"{name} must have the shape (..., {width}), not {array.shape}"
            f"{_shape_hint(array.shape, name, width)}"
        )
    rows = array if array.ndim == 2 else array.reshape(-1, width)
    return _as_rows(rows), array.shape[:-1]


def triangles(given: ArrayLike, name: str, most: int) -> NDArray[Any]:
    """Vertex numbers, three a row, as the library takes them.

    int32, uint32 and int64 without gaps are taken as they are; others are copied.
    """
    array = _no_masked(_as_array(given, name), name)
    if array.shape == (0,):
        array = np.empty((0, 3), np.int32)
    if array.dtype.kind not in "iu":
        raise TypeError(f"{name} must be integers, not {array.dtype}")
    if array.ndim != 2 or array.shape[1] != 3:
        raise ValueError(f"{name} must have the shape (m, 3), not {array.shape}")
    if array.shape[0] > most:
        raise LimitError(f"{name} has {array.shape[0]} rows; at most {most} triangles are possible")
    return np.require(array, _integer_type(array, name), ("C", "A"))


def indices(
    given: ArrayLike, name: str, shape: tuple[int | None, ...], count: int | None
) -> NDArray[np.uint32]:
    """A copy of numbers below `count`; if that is None, of any numbers, where -1 is none."""
    array = _no_masked(_as_array(given, name), name)
    if array.shape == (0,):
        array = np.empty((0, *(size or 0 for size in shape[1:])), np.int64)
    if array.dtype.kind not in "iu":
        raise TypeError(f"{name} must be integers, not {array.dtype}")
    fits = array.ndim == len(shape) and all(
        wanted in (None, size) for wanted, size in zip(shape, array.shape, strict=True)
    )
    if not fits:
        wanted = ", ".join("k" if size is None else str(size) for size in shape)
        comma = "," if len(shape) == 1 else ""
        raise ValueError(f"{name} must have the shape ({wanted}{comma}), not {array.shape}")
    low, high = (-1, 2**32 - 1) if count is None else (0, count)
    wrong = (array < low) | (array >= high)
    if wrong.any():
        kind = "number" if count is None else "point"
        raise ValueError(f"{_place(name, wrong)} is no {kind}: {array[wrong][0]}")
    return np.require(array.astype(np.int64).astype(np.uint32), requirements=("C", "A"))


def hints(given: ArrayLike, name: str, shape: tuple[int, ...] | None) -> NDArray[np.uint32]:
    """Triangles where queries begin, as the library takes them: a copy of the same shape.

    What is negative, masked or too large to be a triangle is no hint.
    """
    array = _as_array(given, name)
    if array.dtype.kind not in "iu" and array.size:
        raise TypeError(f"{name} must be integers, not {array.dtype}")
    if shape is not None and array.shape != shape:
        raise ValueError(f"{name} must have the shape of the points, {shape}, not {array.shape}")
    none = np.iinfo(np.uint32).max
    numbers = np.asarray(np.ma.getdata(array))
    unusable = (numbers < 0) | (numbers > none) | np.ma.getmaskarray(array)
    out = numbers.astype(np.uint32, order="C")
    out[unusable] = none
    return out


def _integer_type(array: NDArray[Any], name: str) -> type[np.integer[Any]]:
    """The type, of those that the library takes, that holds the numbers."""
    if array.dtype.kind == "u" and array.dtype.itemsize == 8:
        large = array > np.iinfo(np.int64).max
        if large.any():
            raise ValueError(f"{_place(name, large)} is no vertex: {array[large][0]}")
        return np.int64
    if array.dtype.itemsize == 8:
        return np.int64
    return np.uint32 if array.dtype.kind == "u" and array.dtype.itemsize == 4 else np.int32


def columns(array: NDArray[Any], kind: type[np.floating[Any]]) -> NDArray[Any]:
    """Two-dimensional values of the type as the library can step over them: a copy if it cannot."""
    table = np.require(array, kind, ("A",))
    forward = all(
        size <= 1 or (step > 0 and step % table.itemsize == 0)
        for size, step in zip(table.shape, table.strides, strict=True)
    )
    overlapping = (
        table.shape[0] > 1
        and lies_in_rows(table)
        and table.strides[0] < table.itemsize * table.shape[1]
    )
    return table if forward and not overlapping else np.ascontiguousarray(table)


def lies_in_rows(table: NDArray[Any]) -> bool:
    """Whether what belongs to one vertex lies side by side, so that the answers do, too."""
    return table.shape[1] <= 1 or table.strides[1] == table.itemsize


def values(given: ArrayLike, name: str, count: int, of: str = "vertices") -> NDArray[Any]:
    """Values at vertices, of any real type, as they are: ``(count, ...)``; masked ones are NaN."""
    array = _as_array(given, name)
    if isinstance(array, np.ma.MaskedArray):
        mask = np.ma.getmaskarray(array)
        array = np.array(array.data, array.dtype if array.dtype.kind == "f" else np.float64)
        array[mask] = np.nan
    if array.dtype.kind not in "fiu":
        raise TypeError(f"{name} must be real numbers, not {array.dtype}")
    if array.ndim == 0 or array.shape[0] != count:
        raise ValueError(
            f"{name} must have a row for each of the {count} {of}; its shape is {array.shape}"
        )
    return array


def interpolated(
    values: NDArray[Any],
    shape: tuple[int, ...],
    interpolate: Callable[[NDArray[Any], bool, NDArray[Any]], None],
) -> NDArray[Any]:
    """Values at points of the shape, by a call of the library that takes them as a table.

    `interpolate` gets the table, whether it holds floats, and room for the answers, which lie as
    the table does.
    """
    narrow = values.dtype.kind == "f" and values.dtype.itemsize <= 4
    kind = np.float32 if narrow else np.float64
    inner = values.shape[1:]
    # Fields in time, transposed, lie field by field, and do so still in the other order.
    by_field = values.flags.f_contiguous and len(inner) > 1
    flat = (len(values), math.prod(inner))
    table = columns(values.reshape(flat, order="F" if by_field else "C"), kind)
    in_rows = lies_in_rows(table)
    points = math.prod(shape)
    out = np.empty((points, flat[1]) if in_rows else (flat[1], points), kind)
    interpolate(table, narrow, out)
    result = out if in_rows else out.T
    if not by_field:
        return result.reshape(shape + inner)
    # The inner axes were counted from the first on.
    result = result.reshape(shape + inner[::-1])
    here = len(shape)
    return result.transpose(*range(here), *reversed(range(here, result.ndim)))


def number(given: Any, name: str) -> float:
    """One number, of any real type."""
    if isinstance(given, (str, bytes)) or np.ndim(given):
        raise TypeError(f"{name} must be a number, not {type(given).__name__}")
    try:
        return float(given)
    except TypeError:
        raise TypeError(f"{name} must be a number, not {type(given).__name__}") from None


def field(given: ArrayLike, name: str, count: int) -> NDArray[np.float64]:
    """Values of a field of a mesh: one double for each vertex, a copy that cannot be written."""
    array = _as_doubles(_masked_to_nan(_as_array(given, name), name), name)
    if array.shape != (count,):
        vector = array.ndim == 2 and len(array) == count
        hint = "; of a vector make a field of each component" if vector else ""
        raise ValueError(f"{name} must have the shape ({count},), not {array.shape}{hint}")
    own = np.array(array, order="C")
    own.flags.writeable = False
    return own


def fields(
    given: Mapping[str, ArrayLike] | None, count: int, what: str = "fields"
) -> dict[str, NDArray[np.float64]]:
    """Fields of a mesh by name, each a copy that cannot be written."""
    if given is not None and not isinstance(given, Mapping):
        raise TypeError(
            f"{what} must be a mapping of names to values, such as {{'z': z}}, not"
            f" {type(given).__name__}"
        )
    return {
        name: field(values, f"{what}[{name!r}]", count) for name, values in (given or {}).items()
    }


def of_triangles(
    values: ArrayLike, count: int, triangle: NDArray[Any], missing: Any
) -> NDArray[Any]:
    """The values of the triangles found; `missing` where `triangle` is -1."""
    array = np.asanyarray(values)
    if array.ndim == 0 or array.shape[0] != count:
        raise ValueError(
            f"values must have a row for each of the {count} triangles; its shape is {array.shape}"
        )
    nothing: Any = np.asarray(missing)
    kind = np.result_type(array.dtype, missing if array.dtype.kind in "iufc" else nothing)
    there = triangle >= 0
    out = np.full(triangle.shape + array.shape[1:], nothing, kind)
    out[there] = np.ma.filled(array[triangle[there]].astype(kind), nothing)
    return out


def named(
    fields: Mapping[str, NDArray[np.float64]], name: str, what: str = ""
) -> NDArray[np.float64]:
    """The field of a mesh with the name; `what` says of what its values are."""
    if name in fields:
        return fields[name]
    there = f"it has {', '.join(fields)}" if fields else "it has none"
    raise KeyError(f"the mesh has no {what + ' ' if what else ''}field {name!r}; {there}")


def record_type(layout: dict[str, int], members: dict[str, Any]) -> np.dtype[Any]:
    """The type of one of the library's answers; the library tells where its members stand."""
    return np.dtype(
        {
            "names": list(members),
            "formats": list(members.values()),
            "offsets": [layout[name] for name in members],
            "itemsize": layout["itemsize"],
        }
    )


def frozen(array: NDArray[Any]) -> NDArray[Any]:
    """A view of the array that nobody can write, nor what it is a view of."""
    view = array.view()
    owner: Any = view
    while isinstance(owner, np.ndarray):  # a view could be made writable again as its owner is
        owner.flags.writeable = False
        owner = owner.base
    return view


def records(given: NDArray[Any], kind: np.dtype[Any], count: int) -> NDArray[Any]:
    """Answers that did not come from the library just now: a checked copy that nobody can write.

    Their triangles must be numbers below `count`, or -1.
    """
    array = np.asarray(given)
    if array.dtype != kind:
        raise TypeError(f"records must be of the type that locate gives, not {array.dtype}")
    # As bytes: NumPy copies records field by field, which takes ten times as long.
    own = np.array(array.view((np.void, kind.itemsize)), order="C").view(kind)
    triangle = own["triangle"]
    wrong = (triangle < -1) | (triangle >= count)
    if wrong.any():
        raise ValueError(
            f"{_place('records', wrong)} names triangle {triangle[wrong][0]}; the mesh has {count}"
            " triangles: are these answers of another mesh?"
        )
    return frozen(own)


def chosen(records: NDArray[Any], index: slice | NDArray[np.intp]) -> NDArray[Any]:
    """Some of a row of answers, moved as bytes: NumPy moves records field by field."""
    kind = records.dtype
    part = np.ascontiguousarray(records).view((np.void, kind.itemsize))[index]
    return np.ascontiguousarray(part).view(kind)


def numbers(array: NDArray[np.uint32]) -> NDArray[np.int32] | NDArray[np.int64]:
    """Numbers of vertices or triangles as signed integers, -1 for none, without a copy."""
    signed: NDArray[np.int32] = array.view(np.int32)
    if array.size and int(signed.min()) < -1:  # more than 2**31 vertices
        wide = array.astype(np.int64)
        wide[array == np.iinfo(np.uint32).max] = -1
        return wide
    return signed


def field_name(name: str) -> bytes:
    """The name of a field as the library takes it."""
    encoded = name.encode("utf-8", "surrogateescape")
    if b"\0" in encoded:
        raise ValueError("the name of a field has no null characters")
    return encoded


def path(given: Any) -> bytes:
    """The name of a file as the system takes it."""
    import os

    name = os.fsencode(given)
    if b"\0" in name:
        raise ValueError("a path has no null characters")
    return name
