"""What is seen from a point, over a terrain."""

from __future__ import annotations

import enum
import math
from typing import TYPE_CHECKING, Any

import numpy as np

from meshwalk import _arrays, _core
from meshwalk._locator import filled

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

    from meshwalk._core import Progress
    from meshwalk._locator import Locator
    from meshwalk._mesh import Mesh

SIGHT = _arrays.record_type(
    _core.SIGHT_LAYOUT, {"at": np.float64, "triangle": np.int32, "state": np.uint8}
)
"""The type of one line of sight, as the library writes it."""


class SightState(enum.IntEnum):
    """Whether a target is seen: the numbers in `Sights.state`.

    Attributes
    ----------
    VISIBLE : 0
        No terrain is above the line.
    HIDDEN : 1
        Terrain is above the line.
    UNKNOWN : 2
        The ground at the target has no height, or the target is not finite.
    """

    VISIBLE = 0
    HIDDEN = 1
    UNKNOWN = 2


class Sights:
    """What is seen from a point: the answer of `visible`, of the shape of the targets.

    Attributes
    ----------
    viewpoint, targets : ndarray
        x and y of the viewpoint, shape (2,), and of the targets, shape (..., 2).
    records : ndarray
        All answers, as a structured array, of which the attributes are views.
    """

    __slots__ = ("records", "targets", "viewpoint")

    def __init__(
        self,
        viewpoint: NDArray[np.float64],
        targets: NDArray[np.float64],
        records: NDArray[Any],
    ) -> None:
        self.viewpoint = viewpoint
        self.targets = targets
        self.records = _arrays.frozen(records)

    @property
    def state(self) -> NDArray[np.uint8]:
        """The numbers of `SightState`."""
        return self.records["state"]

    @property
    def visible(self) -> NDArray[np.bool_]:
        """True where the target is seen: a new array each time."""
        return np.asarray(self.state == SightState.VISIBLE)

    @property
    def at(self) -> NDArray[np.float64]:
        """Where terrain is first above the line: 0 at the viewpoint, 1 at the target, rounded."""
        return self.records["at"]

    @property
    def triangle(self) -> NDArray[np.int32]:
        """The triangle there, -1 where the target is not hidden."""
        return self.records["triangle"]

    @property
    def obstacle(self) -> NDArray[np.float64]:
        """X and y of that place, shape (..., 2); NaN where the target is not hidden."""
        place = self.viewpoint + self.at[..., None] * (self.targets - self.viewpoint)
        return np.where((self.state == SightState.HIDDEN)[..., None], place, np.nan)

    @property
    def shape(self) -> tuple[int, ...]:
        """The shape of the targets, without their coordinates."""
        return self.records.shape

    def __len__(self) -> int:
        return len(self.records)

    def __repr__(self) -> str:
        counts = np.bincount(self.state.ravel(), minlength=len(SightState))
        kinds = ", ".join(f"{counts[s]} {s.name.lower()}" for s in SightState if counts[s])
        return f"<Sights: {self.records.size} targets{'; ' if kinds else ''}{kinds}>"

    def __reduce__(self) -> tuple[Any, ...]:
        return Sights, (self.viewpoint, self.targets, self.records)


def visible(
    surface: Mesh | Locator,
    viewpoint: ArrayLike,
    targets: ArrayLike,
    height: float = 0,
    target_height: float = 0,
    *,
    heights: ArrayLike | str = "z",
    progress: Progress | None = None,
) -> Sights:
    """Tell which targets are seen from a viewpoint, over a terrain. Decided exactly.

    A target is seen if no point of the straight line to it lies below the terrain; a line that
    touches the terrain is free. The earth is a plane.

    Parameters
    ----------
    surface : Mesh or Locator
        The terrain. A mesh gets a locator for this call: give a locator to look again and again.
    viewpoint : array_like, shape (2,) or (3,)
        x and y; and z, if it is not `height` above the ground.
    targets : array_like, shape (..., 2) or (..., 3)
        x and y; and z, if they are not `target_height` above the ground.
    height, target_height : float, optional
        Above the ground, of a viewpoint and of targets without z.
    heights : array_like, shape (n_vertices,), or str, optional
        The heights of the terrain at its vertices, or the name of a field. In triangles with an
        unknown height (NaN) there is no terrain.
    progress : callable, optional
        As of `Locator.locate`.

    Returns
    -------
    Sights

    Raises
    ------
    InputError
        There is no ground at the viewpoint, or it lies below the ground.
    ValueError
        The viewpoint is not finite; the locator was made with ``fill="no"``.

    Examples
    --------
    A ridge of height 5 along x = 2, seen from x = 0:

    >>> import meshwalk
    >>> points = [[0, 0, 0], [2, 0, 5], [4, 0, 0], [0, 2, 0], [2, 2, 5], [4, 2, 0]]
    >>> mesh = meshwalk.Mesh(points, [[0, 1, 4], [0, 4, 3], [1, 2, 5], [1, 5, 4]])
    >>> seen = meshwalk.visible(mesh, [0, 1], [[1, 1], [4, 1]], height=1)
    >>> seen.visible
    array([ True, False])
    >>> meshwalk.visible(mesh, [0, 1], [[4, 1, 12]], height=1).visible
    array([ True])
    """
    locator = filled(surface, "surface")
    at = _ends(viewpoint, "viewpoint", height)
    if at[1] != ():
        raise ValueError(f"viewpoint must be one point, of the shape (2,) or (3,), not {at[1]}")
    x, y, z = (float(number) for number in at[0][0])
    if not all(math.isfinite(number) for number in (x, y, z)):
        raise ValueError(f"viewpoint is not finite: {x}, {y}, {z}")
    to, shape, absolute = _ends(targets, "targets", target_height)
    values = np.ascontiguousarray(locator.mesh._values(heights, "heights"))
    records = np.empty(len(to), SIGHT)
    _core.sights(locator, values, (x, y, z, at[2]), to, absolute, records, progress)
    return Sights(np.array([x, y]), to[:, :2].reshape(*shape, 2), records.reshape(shape))


def _ends(
    given: ArrayLike, name: str, height: float
) -> tuple[NDArray[np.float64], tuple[int, ...], bool]:
    """Rows of x, y and a height; the shape of the points; whether the heights are absolute."""
    width = np.shape(given)[-1] if np.ndim(given) else 0
    rows, shape = _arrays.queries(given, name, 3 if width == 3 else 2)
    if width == 3:
        return np.ascontiguousarray(rows), shape, True
    return np.column_stack([rows, np.full(len(rows), float(height))]), shape, False
