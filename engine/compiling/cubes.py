"""Boxes about shapes divided into cubes, and what is known of the cubes in few bits."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Final

import numpy as np

from engine import layout as at

if TYPE_CHECKING:
    from collections.abc import Iterator

    from engine.geometry import Shape
    from engine.kernels.types import Array, Bytes, Ints

_COARSER: Final = 1.1
"""How much longer edges are made until there are few enough cubes."""


@dataclass(frozen=True, slots=True)
class Cubes:
    """The cubes of a box.

    Attributes
    ----------
    corner : ndarray, shape (3,)
        The box's least x, y, z, metres, in the shape's own frame.
    counts : ndarray, shape (3,)
        Cubes along x, y and z.
    edge : float
        Of a cube, metres.
    """

    corner: Array
    counts: Array
    edge: float

    @property
    def size(self) -> int:
        """Number of cubes."""
        return int(self.counts.prod())


def cubes_about(shape: Shape, least_edge: float, most: int, block: int = 1) -> Iterator[Cubes]:
    """Yield ways to divide the box about a shape, each coarser than the last.

    Parameters
    ----------
    shape : Shape
    least_edge : float
        Metres; cubes are not smaller.
    most : int
        How many there may be, at least one block.
    block : int
        Of how many cubes there are multiples along x, y and z; the last ones are beyond the box then.
    """
    low, high = shape.bounds.reshape(2, int(at.VECTOR_SIZE))
    edge = least_edge
    while True:
        counts = block * (np.floor((high - low) / (block * edge)) + 1.0)
        if counts.prod() <= max(most, block**3):
            yield Cubes(low, counts, edge)
        edge *= _COARSER


def packed(numbers: Bytes | Ints, bits: int) -> Ints:
    """Put as many numbers of so many bits into each integer as there is room for, the first one lowest."""
    each = 64 // bits
    groups = np.pad(numbers, (0, -len(numbers) % each)).reshape(-1, each).astype(np.int64)
    found: Ints = np.bitwise_or.reduce(groups << bits * np.arange(each), axis=1)
    return found
