"""Names of the types that kernels are annotated with; Numba infers the real ones."""

from __future__ import annotations

from typing import TypeAlias

import numpy as np
import numpy.typing as npt

Array: TypeAlias = npt.NDArray[np.float64]
"""Float64 numbers: a world's floats or a query's row."""
Ints: TypeAlias = npt.NDArray[np.int64]
"""A world's integers."""
Bytes: TypeAlias = npt.NDArray[np.uint8]
"""Small numbers, many of them."""
Order: TypeAlias = npt.NDArray[np.int32]
"""Numbers of rows, in the order in which they are answered."""
Vector: TypeAlias = tuple[float, float, float]
"""x, y, z."""
Quaternion: TypeAlias = tuple[float, float, float, float]
"""w, x, y, z."""
Matrix: TypeAlias = tuple[float, float, float, float, float, float, float, float, float]
"""m0...m8 of a frame."""
Sphere: TypeAlias = tuple[float, float, float, float]
"""x, y, z of the centre, radius."""
