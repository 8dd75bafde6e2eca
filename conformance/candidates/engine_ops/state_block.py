"""The state block of FORMAT.md, of a result row and a row of state of the engine."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from conformance.candidates.engine_ops.values import floats, pose_block
from engine import layout as at

if TYPE_CHECKING:
    from collections.abc import Sequence

    from conformance.query import Fields
    from engine.kernels.types import Array, Ints
    from engine.world import World


def state_block(result: Any, world: World) -> Fields:
    """Write everything that FORMAT.md lists, except the trace and `walkable_geometry`."""
    block: Fields = {
        "check": pose_block(result["check"]),
        "curr": pose_block(result["curr"]),
        "check_cell": _cell_id(result["check_cell"], world),
        "curr_cell": _cell_id(result["curr_cell"], world),
        "global_spheres": [floats(s[:3]) for s in result["global_spheres"][: int(result["num_sphere"])]],
        "contact_plane": _plane_block(result, "contact_plane"),
        "last_known_contact_plane": _plane_block(result, "last_known_contact_plane"),
        "collision_normal": normal_or_null(result, "collision_normal"),
        "sliding_normal": normal_or_null(result, "sliding_normal"),
        "walkable": None if result["walkable"] < 0 else int(result["walkable"]),
        "walk_interp": float(result["walk_interp"]),
        "walkable_allowance": float(result["walkable_allowance"]),
        "collide": int(result["collide"]),
        "step_up": int(result["step_up"]),
        "step_up_normal": floats(result["step_up_normal"]),
        "neg_poly_hit": int(result["neg_poly_hit"]),
    }
    if result["neg_poly_hit"]:
        block["neg_step_up"] = int(result["neg_step_up"])
        block["neg_normal"] = floats(result["neg_collision_normal"])
    for name in ("frames_stationary_fall", "collided_with_environment", "state", "kill_velocity"):
        block[name] = int(result[name])
    return block


def object_block(result: Any, touched: Sequence[int], world: World) -> Fields:
    """Write what the state block has besides where there are objects; `touched` are their indices."""
    last = int(result["last_collided_object"])
    return {
        "collide_objects": [world.objects[thing].id for thing in touched],
        "last_collided": 0 if last == at.NO_OBJECT else world.objects[last].id,
        "obstruction_ethereal": int(result["obstruction_ethereal"]),
        "hits_interior_cell": int(result["hits_interior_cell"]),
    }


def walkable_geometry(result: Any, world: World) -> str | None:
    """Return the name of the geometry that the walkable polygon belongs to."""
    shape = int(result["walkable_shape"])
    return None if shape < 0 else world.shapes[shape].name


def trace_text(row: Array, ints: Ints) -> str | None:
    """Return the trace of a row of state, or None if it had no room for all of it."""
    length = int(row[at.TRACE_LENGTH])
    if length > row[at.TRACE_CAPACITY]:
        return None
    first = int(ints[at.WORLD_ROW])
    return "".join(chr(int(c)) for c in row[first : first + length])


def _cell_id(index: float, world: World) -> int:
    return 0 if index < 0 else world.cell_ids[int(index)]


def _plane_block(result: Any, name: str) -> dict[str, Any]:
    if not result[f"{name}_valid"]:
        return {"valid": 0}
    return {
        "valid": 1,
        "plane": floats(result[name]),
        "cell_id": int(result[f"{name}_cell_id"]),
        "is_water": int(result[f"{name}_is_water"]),
    }


def normal_or_null(result: Any, name: str) -> list[float] | None:
    """Write a normal that may not be valid."""
    return floats(result[name]) if result[f"{name}_valid"] else None
