"""Files of weights in ESMF's convention."""

from __future__ import annotations

import os
from typing import Any

import numpy as np


def write(
    path: str | os.PathLike[str],
    title: str,
    matrix: Any,
    sides: list[tuple[str, str, str, Any]],
) -> None:
    """Write a sparse matrix of coordinates; `sides` are name, type, dimension, and values."""
    from scipy.io import netcdf_file

    with netcdf_file(os.fspath(path), "w", version=2) as file:
        file.title = title
        for name, size in (("n_a", matrix.shape[1]), ("n_b", matrix.shape[0])):
            file.createDimension(name, size)
        file.createDimension("n_s", matrix.nnz)
        for name, number in (("row", matrix.row), ("col", matrix.col)):
            variable = file.createVariable(name, "i4", ("n_s",))
            variable[:] = number + 1
            variable.start_index = np.int32(1)
        file.createVariable("S", "f8", ("n_s",))[:] = matrix.data
        for name, kind, dimension, values in sides:
            file.createVariable(name, kind, (dimension,))[:] = values
