"""Rows of float64 with named fields, and the records that occur in all of them."""

from __future__ import annotations

import math
from typing import Final

import numpy as np

from engine.constants import frozen


class Row:
    """Assigns consecutive offsets, and remembers names and shapes."""

    def __init__(self) -> None:
        self.size = 0
        self.names: list[str] = []
        self.shapes: list[tuple[int, ...]] = []

    def field(self, name: str, *shape: int) -> int:
        """Take the next place for a field and return its offset."""
        offset = self.size
        self.names.append(name)
        self.shapes.append(shape)
        self.size += math.prod(shape)
        return frozen(offset)

    def block(self, source: Row, first: int, size: int) -> int:
        """Take over consecutive fields of another row, names and all; return where they begin."""
        begin = self.size
        offset = 0
        for name, shape in zip(source.names, source.shapes, strict=True):
            if first <= offset < first + size:
                self.field(name, *shape)
            offset += math.prod(shape)
        return frozen(begin)

    def dtype(self) -> np.dtype[np.void]:
        """Return the structured type that views a row by name."""
        fields = [(name, np.float64, shape) for name, shape in zip(self.names, self.shapes, strict=True)]
        return np.dtype(fields)


# --- a Position: cell id, quaternion w x y z, matrix m0..m8, origin x y z (01, 4.1 and 5) -----------
POSITION_SIZE: Final = frozen(17)
QUATERNION: Final = frozen(1)
MATRIX: Final = frozen(5)
ORIGIN: Final = frozen(14)

# --- a plane record: normal x y z, d;  a sphere record: centre x y z, radius ------------------------
QUATERNION_SIZE: Final = frozen(4)
VECTOR_SIZE: Final = frozen(3)
PLANE_SIZE: Final = frozen(4)
SPHERE_SIZE: Final = frozen(4)
RADIUS: Final = frozen(3)
MAX_SPHERES: Final = frozen(2)
