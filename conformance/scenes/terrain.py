"""Landblocks from a level, a formula or a table of heights, and areas of terrain types."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Final

from conformance.floats import to_float32
from conformance.scenes.errors import SceneError
from conformance.scenes.formula import Formula
from conformance.scenes.world_model import SIDE_VERTICES, VERTEX_COUNT
from oracle.constants import BLOCK_EDGE, CELL_EDGE

if TYPE_CHECKING:
    from collections.abc import Sequence

TYPE_SHIFT: Final = 2
"""A terrain word holds its type from this bit on (10 3.1)."""
FORMULA_NAMES: Final = frozenset("xyij")
_BYTE: Final = 0xFF


@dataclass(frozen=True, slots=True)
class Area:
    """Vertices of one terrain type: from [i, j] to [i, j], both included."""

    low: tuple[int, int]
    high: tuple[int, int]
    type: int


def flat_heights(z: float) -> tuple[float, ...]:
    """Return the heights of level ground, metres."""
    return (to_float32(z),) * VERTEX_COUNT


def formula_heights(text: str, block: int, frame: int) -> tuple[float, ...]:
    """Return the heights that a formula gives.

    Parameters
    ----------
    text : str
        In ``x`` and ``y``, metres in the frame of landblock `frame`, so that neighbours meet; ``i`` and ``j``
        count the vertices of the block itself, 0 to 8.
    block, frame : int
        16-bit block ids.

    Raises
    ------
    SceneError
        See `Formula`.
    """
    formula = Formula(text, FORMULA_NAMES)
    east = ((block >> 8) - (frame >> 8)) * BLOCK_EDGE
    north = ((block & _BYTE) - (frame & _BYTE)) * BLOCK_EDGE
    return tuple(
        to_float32(formula(x=east + i * CELL_EDGE, y=north + j * CELL_EDGE, i=float(i), j=float(j)))
        for i in range(SIDE_VERTICES)
        for j in range(SIDE_VERTICES)
    )


def table_heights(rows: Sequence[Sequence[float]], *, as_map: bool) -> tuple[float, ...]:
    """Return heights written as nine rows of nine.

    Parameters
    ----------
    rows : sequence of sequences of float
        Metres.
    as_map : bool
        True: rows as on a map, the northernmost first, each from west to east. False: ``rows[i][j]``, i
        from west to east, j from south to north.

    Raises
    ------
    SceneError
        It is not nine by nine.
    """
    if len(rows) != SIDE_VERTICES:
        raise SceneError("", f"{len(rows)} rows", f"{SIDE_VERTICES} rows")
    for index, row in enumerate(rows):
        if len(row) != SIDE_VERTICES:
            raise SceneError(f"[{index}]", f"{len(row)} heights", f"{SIDE_VERTICES} heights")
    columns = zip(*reversed(rows), strict=True) if as_map else rows
    return tuple(to_float32(z) for column in columns for z in column)


def terrain_words(areas: Sequence[Area]) -> tuple[int, ...]:
    """Return the terrain words of areas, later ones over earlier ones; no areas: no words."""
    if not areas:
        return ()
    words = [0] * VERTEX_COUNT
    for area in areas:
        for i in range(area.low[0], area.high[0] + 1):
            for j in range(area.low[1], area.high[1] + 1):
                words[SIDE_VERTICES * i + j] = area.type << TYPE_SHIFT
    return tuple(words)
