"""Queries of frames, positions, planes, and of the slides that need no geometry."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

from hypothesis import strategies as st

from conformance.inputs import FORMAT_OPS, REQUIRED
from conformance.strategies.movers import (
    CONTACT,
    EDGE_SLIDE,
    ON_WALKABLE,
    SCALES,
    draw_mover,
    draw_seed,
    foot_of,
)
from conformance.strategies.numbers import DIRECTIONS, EPS, FLAGS, along, anywhere, vectors
from conformance.strategies.poses import CELLS, ROTATIONS, draw_pose
from conformance.vector_io import query_from_record

if TYPE_CHECKING:
    from conformance.query import Query

FRAME_OPS: Final = (
    *(op for op in FORMAT_OPS if op.startswith(("frame_", "position_", "plane_", "block_"))),
    "normalize_check_small",
    "interpolate_rotation",
    "snap_to_plane",
)
MOVER_OPS: Final = ("cache_localspace_sphere", "slide_sphere", "adjust_offset", "cliff_slide")

_STATES: Final = st.sampled_from((CONTACT | ON_WALKABLE | EDGE_SLIDE, EDGE_SLIDE, 0))
_ANY_ROTATION: Final = ROTATIONS | vectors(2.0).map(lambda v: (0.5, *v))
"""Unit quaternions, and some that are not: frames take them as they are."""
_ANY_CELL: Final = st.integers(0, 0xFFFFFFFF)
_DISTANCES: Final = anywhere(-200.0, 200.0)
_UNIT_INTERVAL: Final = anywhere(0.0, 1.0)


@st.composite
def frame_queries(draw: st.DrawFn, op: str) -> Query:
    """Generate queries of one operation on frames, positions, planes or vectors."""
    inputs = {key: _draw_input(draw, key, op) for key in REQUIRED[op]}
    return query_from_record({"op": op, **inputs}, {})


@st.composite
def mover_queries(draw: st.DrawFn, op: str) -> Query:
    """Generate queries of one operation on a mover's spheres, between two positions, with a seed."""
    state = draw(_STATES)
    mover = draw_mover(draw, state)
    start = draw_pose(draw, draw(CELLS))
    end = {**start, "origin": along(start["origin"], draw(vectors(1.0)), 1.0)}
    seed = draw_seed(draw, state, foot_of(mover, start["origin"]), draw(DIRECTIONS), start["cell"])
    given = {"mover": mover, "from": start, "to": end, "seed": seed}
    inputs = {key: given[key] if key in given else _draw_input(draw, key, op) for key in REQUIRED[op]}
    return query_from_record({"op": op, **inputs}, {})


def _draw_input(draw: st.DrawFn, key: str, op: str) -> Any:
    match key:
        case "from" | "to" if op == "interpolate_rotation":
            return draw(ROTATIONS)
        case "from" | "to" | "pose" | "a" | "b":
            return draw_pose(draw, draw(CELLS))
        case "rotation":
            return draw(_ANY_ROTATION)
        case "point":
            return draw(vectors(100.0))
        case "v":
            return along((0.0, 0.0, 0.0), draw(vectors(1.0)), EPS if draw(FLAGS) else 1.0)
        case "plane":
            return [*draw(DIRECTIONS), draw(_DISTANCES)]
        case "normal":
            return draw(DIRECTIONS)
        case "offset":
            return draw(vectors(1.0))
        case "t":
            return draw(_UNIT_INTERVAL)
        case "scale":
            return draw(SCALES)
        case "from_cell" | "to_cell":
            return draw(_ANY_CELL)
        case _:
            raise NotImplementedError(f"input {key!r} of {op}")
