"""Drop-ins for users of matplotlib: the same calls, exact, and fast to make.

`TriFinder` takes the place of the finder that ``triangulation.get_trifinder()`` makes:

>>> import matplotlib.tri as mtri
>>> from meshwalk.matplotlib import LinearTriInterpolator, TriFinder
>>> triangulation = mtri.Triangulation([0, 4, 4, 0], [0, 0, 4, 4], [[0, 1, 2], [0, 2, 3]])
>>> finder = TriFinder(triangulation)
>>> finder([3, 1, 9], [1, 3, 9])
array([ 0,  1, -1], dtype=int32)
>>> float(mtri.LinearTriInterpolator(triangulation, [0, 4, 8, 4], trifinder=finder)(1.0, 3.0))
4.0
>>> float(LinearTriInterpolator(triangulation, [0, 4, 8, 4])(1.0, 3.0))
4.0

matplotlib itself has to be installed.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import matplotlib.tri as mtri
import numpy as np

from meshwalk._errors import InputError
from meshwalk._locator import Locator
from meshwalk._mesh import Mesh

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

__all__ = ["LinearTriInterpolator", "TriFinder"]


class TriFinder(mtri.TriFinder):  # type: ignore[misc] # matplotlib is not typed
    """Finds the triangles of a `matplotlib.tri.Triangulation` that contain points, exactly.

    Of several triangles that contain a point, on an edge or a vertex, the lowest one is the answer.

    Parameters
    ----------
    triangulation : matplotlib.tri.Triangulation
        Its mask is honoured, also one that is set later.

    Raises
    ------
    RuntimeError
        The triangles that are not masked overlap; the message names the first defect.
    TypeError
        Not a Triangulation.

    Notes
    -----
    Two finders of one triangulation compare equal. Several threads may ask one finder at a time.
    Making it takes O(n) time for n triangles.

    Examples
    --------
    >>> import matplotlib.tri as mtri
    >>> import meshwalk.matplotlib
    >>> triangulation = mtri.Triangulation([0, 4, 4, 0], [0, 0, 4, 4], [[0, 1, 2], [0, 2, 3]])
    >>> finder = meshwalk.matplotlib.TriFinder(triangulation)
    >>> triangulation.set_mask([True, False])
    >>> finder([3, 1], [1, 3])
    array([-1,  1], dtype=int32)
    """

    def __init__(self, triangulation: mtri.Triangulation) -> None:
        super().__init__(triangulation)
        self._initialize()

    def _initialize(self) -> None:
        """Make the locator anew. `Triangulation.set_mask` calls this for its own finder."""
        t: Any = self._triangulation
        self._mask = None if t.mask is None else np.array(t.mask, bool)
        self._kept = None if self._mask is None else np.flatnonzero(~self._mask).astype(np.int32)
        triangles = t.triangles if self._kept is None else t.triangles[self._kept]
        self._locator = None
        if len(triangles) == 0:
            return
        try:
            mesh = Mesh(np.column_stack([t.x, t.y]), triangles, tolerant=True)
            self._locator = Locator(mesh)
        except InputError as error:
            raise RuntimeError(f"the triangulation is invalid: {error}") from error

    def _follow_mask(self) -> None:
        """Follow a mask that was set since the locator was made."""
        mask = self._triangulation.mask
        same = mask is None if self._mask is None else np.array_equal(self._mask, mask)
        if not same:
            self._initialize()

    def __call__(self, x: ArrayLike, y: ArrayLike) -> NDArray[np.int32]:
        """Find the triangles of points.

        Parameters
        ----------
        x, y : array_like
            Of the same shape, of any number of dimensions.

        Returns
        -------
        ndarray of int32
            Of the same shape: the triangles, -1 for points in none.
        """
        x, y = np.asarray(x, np.float64), np.asarray(y, np.float64)
        if x.shape != y.shape:
            raise ValueError("x and y must be array-like with the same shape")
        self._follow_mask()
        if self._locator is None:
            return np.full(x.shape, -1, np.int32)
        found = np.ascontiguousarray(self._locator.locate(np.stack([x, y], axis=-1)).triangle)
        return found if self._kept is None else np.where(found < 0, found, self._kept[found])

    def __eq__(self, other: object) -> bool:
        return isinstance(other, TriFinder) and other._triangulation is self._triangulation

    def __hash__(self) -> int:
        return hash((TriFinder, id(self._triangulation)))


class LinearTriInterpolator(mtri.LinearTriInterpolator):  # type: ignore[misc] # as above
    """`matplotlib.tri.LinearTriInterpolator` with a `TriFinder`.

    Parameters
    ----------
    triangulation : matplotlib.tri.Triangulation
        The triangles.
    z : array_like, shape (n,)
        The values at its points.
    trifinder : matplotlib.tri.TriFinder, optional
        A finder that is there already; by default a new one.

    Examples
    --------
    >>> import matplotlib.tri as mtri
    >>> import meshwalk.matplotlib
    >>> triangulation = mtri.Triangulation([0, 4, 4, 0], [0, 0, 4, 4], [[0, 1, 2], [0, 2, 3]])
    >>> at = meshwalk.matplotlib.LinearTriInterpolator(triangulation, [0.0, 4.0, 8.0, 4.0])
    >>> at([3, 9], [1, 9])
    masked_array(data=[4.0, --],
                 mask=[False,  True],
           fill_value=1e+20)
    """

    def __init__(
        self,
        triangulation: mtri.Triangulation,
        z: ArrayLike,
        trifinder: mtri.TriFinder | None = None,
    ) -> None:
        if trifinder is None:
            trifinder = TriFinder(triangulation)
        super().__init__(triangulation, z, trifinder)
