"""Queries of LandDefs, and of a landblock's terrain by itself."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

from hypothesis import strategies as st

from conformance.inputs import FORMAT_OPS, REQUIRED
from conformance.strategies.numbers import EPS, NEARLY, anywhere
from conformance.strategies.worlds.land import BLOCK, CELL, LANDS, WATERS, landblock
from conformance.vector_io import query_from_record

if TYPE_CHECKING:
    from conformance.query import Query

LAND_DEFS_OPS: Final = (
    *(op for op in FORMAT_OPS if op.startswith("landdefs_")),
    "terrain_split",
    "terrain_block",
)

_SIDES: Final = st.sampled_from((0x00, 0xFE, 0xFF, 0x01, 0xA9)) | st.integers(0, 255)
"""Block coordinates: the first, the last of the world, one beyond it."""
_LOW_WORDS: Final = st.sampled_from(
    (0x0001, 0x0040, 0x0000, 0x0041, 0x00FF, 0x0100, 0xFFFD, 0xFFFE, 0xFFFF)
) | st.integers(0, 0xFFFF)
"""Low words at both ends of every range (10 1)."""
_CELLS: Final = st.builds(lambda x, y, low: x << 24 | y << 16 | low, _SIDES, _SIDES, _LOW_WORDS) | st.just(0)
_BLOCKS: Final = st.builds(lambda x, y: x << 8 | y, _SIDES, _SIDES)
_COORDINATES: Final = st.sampled_from((0, 2039, 2040, -1)) | st.integers(-50, 2100)
_EDGES: Final = st.tuples(
    st.sampled_from((0.0, CELL, BLOCK, -BLOCK, 2 * BLOCK, 254 * BLOCK, 255 * BLOCK)), NEARLY
).map(sum)
_TINY: Final = st.sampled_from((EPS, -EPS, 0.5 * EPS, -0.5 * EPS, 7e-6, -7e-6))
_ACROSS: Final = anywhere(-400.0, 400.0) | _EDGES | _TINY
_POINTS: Final = st.tuples(_ACROSS, _ACROSS, anywhere(-100.0, 100.0))


@st.composite
def land_defs_queries(draw: st.DrawFn, op: str) -> Query:
    """Generate queries of ids and coordinates, at the edges of their ranges, and of whole landblocks."""
    if op == "terrain_block":
        return query_from_record({"op": op, **_draw_block(draw)}, {})
    inputs = {key: draw(_VALUES[key]) for key in REQUIRED[op]}
    return query_from_record({"op": op, **inputs}, {})


def _draw_block(draw: st.DrawFn) -> dict[str, Any]:
    """Draw a landblock: of any kind, a few of its vertices higher or lower than the rule has them."""
    block = landblock(draw(_BLOCKS), draw(_LANDS), draw(_WATERS), {})
    heights = list(block["heights"])
    for vertex, height in draw(_BUMPS):
        heights[vertex] = height
    return {**block, "heights": heights}


_LANDS: Final = st.sampled_from(LANDS)
_WATERS: Final = st.sampled_from(WATERS)
_BUMPS: Final = st.lists(st.tuples(st.integers(0, 80), anywhere(0.0, 800.0)), max_size=8)
_VALUES: Final = {
    "cell": _CELLS,
    "from_cell": _CELLS,
    "to_cell": _CELLS.filter(bool),
    "x": _COORDINATES,
    "y": _COORDINATES,
    "point": _POINTS,
    "block": _BLOCKS,
}
"""By name of the input; an offset *to* no cell reads uninitialised memory in retail (10 2.6)."""
