"""Queries of one object, or a cell full of them: calls of every path, and whole transitions."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

from hypothesis import strategies as st

from conformance.strategies.collisions import DISPATCHES, draw_path
from conformance.strategies.meetings import SELDOM, draw_meeting, draw_probe
from conformance.strategies.movers import (
    CONTACT,
    EDGE_SLIDE,
    IGNORE_CREATURES,
    IMPENETRABLE,
    ON_WALKABLE,
    PATH_CLIPPED,
    PERFECT_CLIP,
    PLAYER,
    PLAYER_KILLER,
    PLAYER_KILLER_LITE,
    VIEWER,
    draw_identity,
)
from conformance.strategies.numbers import EPS, FLAGS, along, anywhere, pick, vectors
from conformance.strategies.obstacles import draw_obstacle, draw_shaped, draw_target
from conformance.strategies.poses import CELLS, IDENTITY, ORIGINS
from conformance.strategies.scenes import PRIMITIVES
from conformance.strategies.worlds.furniture import FIRST_THING
from conformance.strategies.worlds.things import thing_geometries
from conformance.vector_io import query_from_record

if TYPE_CHECKING:
    from collections.abc import Mapping

    from conformance.query import Query
    from conformance.scenes.model import Geometry, Vec3
    from conformance.strategies.meetings import Probe, Target

FUNCTIONS: Final = ("sphere", "cylsphere", "object", "cell_objects", "cell")
"""What an `object_call` asks (FORMAT.md)."""

_EXTRA_STATES: Final = st.sampled_from(
    (
        0,
        0,
        0,
        PLAYER,
        PLAYER | PLAYER_KILLER,
        PLAYER | PLAYER_KILLER_LITE,
        PLAYER | IMPENETRABLE,
        IGNORE_CREATURES,
        VIEWER,
        PERFECT_CLIP,
        PERFECT_CLIP,
    )
)
"""What besides contact makes a difference to objects (08 11)."""
_GROUNDED: Final = CONTACT | ON_WALKABLE
_STATES: Final = st.sampled_from(
    (_GROUNDED | EDGE_SLIDE, _GROUNDED, EDGE_SLIDE, 0, PATH_CLIPPED, PATH_CLIPPED | PERFECT_CLIP)
)
_DISPATCHES: Final = st.sampled_from(
    (*(name for name in DISPATCHES if name not in {"initial_placement", "ethereal"}), "path_clipped")
)
_APPROACHES: Final = anywhere(0.0, 2.0)
"""How far one goes towards a ball, as a multiple of its distance."""
_RADSUMS: Final = anywhere(0.0, 2.0)
_NEXT_BLOCKS: Final = st.sampled_from((0x01000000, 0x00010000, 0x01010000))
"""What is added to a cell's id for the block to the east, to the north, to the north-east."""
_BLOCK: Final = 192.0


@st.composite
def object_calls(draw: st.DrawFn, function: str) -> Query:
    """Generate queries of one function of the object tests, on every path."""
    way = DISPATCHES[draw(_DISPATCHES)]
    above = way.floors and not draw(SELDOM)
    things, probe, target = _draw_scene(draw, function, pick(draw, way.states), above=above)
    cell = things[0]["pose"]["cell"]
    met = draw_meeting(draw, probe, target, cell)
    block, geometries = _draw_cell(draw, cell, things)
    record: dict[str, Any] = {
        "op": "object_call",
        "function": function,
        "cell": block,
        "objects": things,
        "mover": met.mover | draw_identity(draw, [thing["id"] for thing in things]),
        "from": _draw_next_block(draw, met.start) if draw(SELDOM) else met.start,
        "to": met.end,
        "seed": met.seed,
        "path": draw_path(draw, way) | {"obstruction_ethereal": int(draw(SELDOM) and draw(SELDOM))},
    }
    if function == "sphere":
        record["is_creature"] = draw(FLAGS)
    return query_from_record(record, geometries)


@st.composite
def object_transitions(draw: st.DrawFn) -> Query:
    """Generate transitions in a cell with objects in it."""
    things, probe, target = _draw_scene(draw, "cell", draw(_STATES), above=draw(SELDOM))
    cell = things[0]["pose"]["cell"]
    met = draw_meeting(draw, probe, target, cell)
    block, geometries = _draw_cell(draw, cell, things)
    return query_from_record(
        {
            "op": "object_transition",
            "cell": block,
            "objects": things,
            "mover": met.mover | draw_identity(draw, [thing["id"] for thing in things]),
            "from": None if draw(SELDOM) else met.start,
            "to": met.end,
            "seed": met.seed,
            "placement_allows_sliding": draw(FLAGS),
        },
        geometries,
    )


@st.composite
def times_of_collision(draw: st.DrawFn) -> Query:
    """Generate movements towards a ball, past it, and next to none."""
    disp = draw(vectors(3.0))
    movement = along(draw(vectors(1.0)), disp, -draw(_APPROACHES))
    if draw(SELDOM):
        movement = along((0.0, 0.0, 0.0), movement, EPS)
    return query_from_record(
        {"op": "find_time_of_collision", "movement": movement, "disp": disp, "radsum": draw(_RADSUMS)}, {}
    )


def _draw_scene(
    draw: st.DrawFn, function: str, state: int, *, above: bool
) -> tuple[list[dict[str, Any]], Probe, Target]:
    """Draw objects, a mover, and where it is put to touch one of them."""
    cell, origin = draw(CELLS), draw(ORIGINS)
    if function in {"sphere", "cylsphere"}:
        things = [draw_shaped(draw, f"{function}s", FIRST_THING, cell, origin)]
    elif function == "object":
        things = [draw_obstacle(draw, FIRST_THING, cell, origin)]
    else:
        things = [_draw_any(draw, FIRST_THING + k, cell, origin) for k in range(draw(st.integers(1, 3)))]
    probe = draw_probe(draw, state | draw(_EXTRA_STATES))
    thing = things[0] if function in {"sphere", "cylsphere", "object"} else pick(draw, things)
    return things, probe, draw_target(draw, thing, thing_geometries(), probe.radius, above=above)


def _draw_any(draw: st.DrawFn, ident: int, cell: int, origin: Vec3) -> dict[str, Any]:
    if draw(SELDOM):
        return draw_shaped(draw, pick(draw, ("spheres", "cylspheres")), ident, cell, origin)
    return draw_obstacle(draw, ident, cell, origin)


def _draw_cell(
    draw: st.DrawFn, cell: int, things: list[dict[str, Any]]
) -> tuple[dict[str, Any], Mapping[str, Geometry]]:
    """Draw what the objects are in: mostly nothing, else a geometry at the first object's feet."""
    pose = {"cell": cell, "origin": things[0]["pose"]["origin"], "rotation": IDENTITY}
    block = {"id": cell, "pose": pose, "geometry": None}
    if not draw(SELDOM):
        return block, thing_geometries()
    inside = draw(PRIMITIVES)
    return {**block, "geometry": inside.name}, {**thing_geometries(), inside.name: inside}


def _draw_next_block(draw: st.DrawFn, pose: dict[str, Any]) -> dict[str, Any]:
    """Name a position from the landblock to the east, north or north-east of its own."""
    step = draw(_NEXT_BLOCKS)
    x, y, z = pose["origin"]
    east, north = step >> 24, step >> 16 & 0xFF
    return {**pose, "cell": pose["cell"] + step, "origin": (x - _BLOCK * east, y - _BLOCK * north, z)}
