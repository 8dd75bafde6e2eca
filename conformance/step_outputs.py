"""A walk's ticks as people pin them: what the mover is after each, whether the tick says so or not.

FORMAT.md leaves out of a tick what has not changed, or has its usual value; a pin must not depend on that.
"""

from __future__ import annotations

from types import MappingProxyType
from typing import TYPE_CHECKING, Any, Final

from conformance.output_shapes import CELL, COUNT, FLAG, OPTIONAL_POINT, PLANE, POINT, TEXT
from conformance.shapes import Block, Listing, Nullable

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping, Sequence

    from conformance.query import Fields, Query
    from conformance.shapes import Shape

_CONTACT: Final = 0x1
_ON_WALKABLE: Final = 0x2
_SLIDING: Final = 0x4
"""Bits of a body's transient state (04 1.4)."""

_STEP: Final[dict[str, Shape]] = {
    "outcome": TEXT,
    "position": POINT,
    "cell": CELL,
    "contact": FLAG,
    "on_walkable": FLAG,
    "contact_plane": Nullable(PLANE),
    "contact_plane_cell": Nullable(CELL),
    "sliding_normal": OPTIONAL_POINT,
    "collision_normal": OPTIONAL_POINT,
    "frames_stationary_fall": COUNT,
    "collided_with_environment": FLAG,
    "kill_velocity": COUNT,
    "objects": Listing(COUNT),
    "trace": TEXT,
}
TICKS: Final = Listing(Block(_STEP), step="tick")
"""The list of a walk's ticks."""
_WALK_STEP: Final = Block({**_STEP, "water": FLAG})
_BODY_STEP: Final = Block({**_STEP, "velocity": POINT})

STEP_OF: Final[Mapping[str, str]] = MappingProxyType(
    {op: f"a tick of {op}" for op in ("walk", "world_walk", "body_walk")}
)
"""The operations that are walks, and what one of their ticks is called in messages."""
STEP_OUTPUTS: Final[Mapping[str, Block]] = MappingProxyType(
    {
        STEP_OF["walk"]: _WALK_STEP,
        STEP_OF["world_walk"]: _WALK_STEP,
        STEP_OF["body_walk"]: _BODY_STEP,
    }
)
"""What can be pinned of a tick.

`outcome` is ``moved``, ``failed``, ``still`` or another word of a body walk. Position, cell, contact, plane,
water, sliding normal and velocity are those after the tick; collisions, objects touched and trace are those
of the tick itself.
"""

_OUTCOMES: Final[Mapping[Any, str]] = MappingProxyType({1: "moved", 0: "failed", "skip": "still"})
"""Words for the result of a recorded move."""


def start_of(query: Query) -> Fields:
    """Return what the mover of a walk is before its first tick."""
    body = query.inputs.get("body", {})
    pose = body.get("position") if body else query.inputs["start"]
    bits = body.get("transient_state", 0)
    return {
        "position": pose["origin"] if pose else [0.0, 0.0, 0.0],
        "cell": pose["cell"] if pose else 0,
        "water": 0,
        "contact": bits & _CONTACT,
        "contact_plane": body.get("contact_plane"),
        "contact_plane_cell": body.get("contact_plane_cell"),
        "sliding_normal": body.get("sliding_normal"),
    }


def steps(op: str, start: Fields, ticks: Sequence[Fields]) -> Iterator[Fields]:
    """Yield what the mover is after each tick, with every field of `STEP_OUTPUTS`.

    Parameters
    ----------
    op : str
        A walk, one of `STEP_OF`.
    start : Fields
        See `start_of`.
    ticks : sequence of Fields
        The answer's own.
    """
    known = {"on_walkable": 0, **start}
    for tick in ticks:
        if op == "body_walk":
            known = _after_body_tick(known, tick)
        else:
            # A walk in cells gives another cell in every tick, one in a world only when it has changed.
            known = _after_tick(known, tick, known["cell"] if op == "world_walk" else start["cell"])
        yield _shown(known, tick)


def _shown(known: Fields, tick: Fields) -> Fields:
    contact = known["contact"]
    return {
        **known,
        "contact_plane": known["contact_plane"] if contact else None,
        "contact_plane_cell": known["contact_plane_cell"] if contact else None,
        "outcome": _OUTCOMES.get(tick["r"], tick["r"]),
        "collision_normal": tick.get("cn"),
        "frames_stationary_fall": tick.get("fsf", 0),
        "collided_with_environment": tick.get("env", 0),
        "kill_velocity": tick.get("kill", 0),
        "objects": tick.get("objs", []),
        "trace": tick.get("t", ""),
    }


def _after_tick(known: Fields, tick: Fields, cell: int) -> Fields:
    """Take over a recorded move: only one that succeeds changes anything, and then everything.

    `cell` is the one that a tick without a cell ends in.
    """
    if tick["r"] != 1:
        return known
    return {
        "position": tick["pos"],
        "cell": tick.get("cell", cell),
        "water": tick.get("water", 0),
        "contact": int("cp" in tick),
        "on_walkable": tick.get("onw", 0),
        "contact_plane": tick.get("cp"),
        "contact_plane_cell": tick.get("cp_cell"),
        "sliding_normal": tick.get("sn"),
    }


def _after_body_tick(known: Fields, tick: Fields) -> Fields:
    """Take over a body's tick, which says what has changed; the transient state says what counts."""
    bits = tick["ts"]
    sliding = tick.get("sn", known["sliding_normal"])
    return {
        "position": tick["pos"],
        "velocity": tick["v"],
        "cell": tick.get("cell", known["cell"]),
        "contact": bits & _CONTACT,
        "on_walkable": (bits & _ON_WALKABLE) // _ON_WALKABLE,
        "contact_plane": tick.get("cp", known["contact_plane"]),
        "contact_plane_cell": tick.get("cp_cell", known["contact_plane_cell"]),
        "sliding_normal": sliding if bits & _SLIDING else None,
    }
