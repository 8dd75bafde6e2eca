"""Recorded moves, one transition after the other (``walk.jsonl``, ``world_walk.jsonl``), by the oracle.

The walker here is not an object with a velocity: it carries from tick to tick exactly what FORMAT.md says.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

from conformance.candidates.oracle_ops.blocks import take_mover
from conformance.candidates.oracle_ops.scene import build_world
from conformance.candidates.oracle_ops.state_block import struck, touched_objects
from conformance.candidates.oracle_ops.values import frame, nxyzd, position, quaternion, vector, xyz
from conformance.candidates.oracle_ops.world import oracle_world
from oracle.arithmetic import f32
from oracle.constants import FLOOR_Z
from oracle.enums import CONTACT_OI, ON_WALKABLE_OI
from oracle.plane import Plane
from oracle.transition import Transition
from oracle.vector import Vector3

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from conformance.query import Fields, Query
    from oracle.position import Position
    from oracle.world import World

IDENTITY: Final = [1.0, 0.0, 0.0, 0.0]
"""The rotation that a tick leaves out."""


def _walk(query: Query) -> Fields:
    inputs = query.inputs
    world = build_world(inputs["cells"], query.geometries)
    walker = Walker(world, inputs["mover"], position(inputs["start"]))
    return {"ticks": [walker.tick(tick) for tick in inputs["ticks"]]}


def _world_walk(query: Query) -> Fields:
    inputs = query.inputs
    world = oracle_world(inputs["world"], query.geometries)
    walker = WorldWalker(world, inputs["mover"], position(inputs["start"]))
    return {"ticks": [walker.tick(tick) for tick in inputs["ticks"]]}


class Walker:
    """What moves, and what it knows of the ground it stands on.

    Attributes
    ----------
    contact, on_walkable, sliding : bool
        Whether `plane` and `sliding_normal` count, and whether the plane can be stood on.
    told_cell : int
        Cell id from which a tick's is told: the start's.
    is_water : int
        Whether the plane is that of water.
    stationary : set of int
        The flags 1, 2 (and 3) of ticks without movement.
    """

    def __init__(self, world: World, mover: Mapping[str, Any], start: Position) -> None:
        self.world = world
        self.mover = mover
        self.position = start
        self.told_cell = start.objcell_id
        self.cell = world.get_visible(start.objcell_id)
        self.contact = False
        self.plane = Plane(Vector3(), 0.0)
        self.plane_cell = 0
        self.is_water = 0
        self.on_walkable = False
        self.sliding = False
        self.sliding_normal = Vector3()
        self.stationary: set[int] = set()

    def tick(self, tick: Mapping[str, Any]) -> Fields:
        """Move once and write what came of it."""
        target = self._target(tick)
        if target.frame.origin.equals(self.position.frame.origin):
            self._turn(target)
            return {"r": "skip"}
        made = self._seeded(contact_ok=bool(tick.get("contact_ok", 1)))
        made.init_path(self.cell, self.position.copy(), target)
        moved = made.find_valid_position()
        fields: Fields = {"r": moved, "t": "".join(made.trace or ())}
        if not moved:
            self._turn(target)
            return fields
        self._take_over(made)
        return fields | self._written() | self._collided(made)

    def _target(self, tick: Mapping[str, Any]) -> Position:
        target = self.position.copy()
        origin, move = target.frame.origin, vector(tick["move"])
        moved = Vector3(f32(origin.x + move.x), f32(origin.y + move.y), f32(origin.z + move.z))
        if "rotation" in tick:
            target.frame.assign(frame(tick["rotation"]))
        target.frame.origin.assign(moved)
        return target

    def _turn(self, target: Position) -> None:
        """Take the rotation only."""
        origin = self.position.frame.origin.copy()
        self.position.frame.assign(target.frame)
        self.position.frame.origin.assign(origin)

    def _seeded(self, *, contact_ok: bool) -> Transition:
        """Make a transition that knows what the walker knows; `contact_ok` 0 leaves the plane."""
        made = Transition(self.world, trace=[])
        state = self.mover["state"] & ~(CONTACT_OI | ON_WALKABLE_OI)
        if self.contact and contact_ok:
            state |= CONTACT_OI | (ON_WALKABLE_OI if self.on_walkable else 0)
        take_mover(made, {**self.mover, "state": state}, self.position)
        if self.contact and contact_ok:
            made.init_contact_plane(self.plane_cell, self.plane, self.is_water)
        elif self.contact:
            made.init_last_known_contact_plane(self.plane_cell, self.plane, self.is_water)
        if self.sliding:
            made.init_sliding_normal(self.sliding_normal)
        made.collision_info.frames_stationary_fall = max(self.stationary, default=0)
        return made

    def _take_over(self, made: Transition) -> None:
        sp, ci = made.sphere_path, made.collision_info
        self.position = sp.curr_pos.copy()
        self.cell = sp.curr_cell
        self.plane.assign(ci.contact_plane)
        self.plane_cell = ci.contact_plane_cell_id
        self.is_water = ci.contact_plane_is_water
        self.contact = bool(ci.contact_plane_valid)
        self.on_walkable = self.contact and self.plane.N.z >= FLOOR_Z
        self.sliding_normal.assign(ci.sliding_normal)
        self.sliding = bool(ci.sliding_normal_valid)
        if ci.frames_stationary_fall in {0, 3}:
            self.stationary.clear()
        else:
            self.stationary.add(ci.frames_stationary_fall)

    def _written(self) -> Fields:
        """Write position and contact."""
        rotation = quaternion(self.position.frame)
        fields: Fields = {"pos": xyz(self.position.frame.origin)}
        if rotation != IDENTITY:
            fields["rot"] = rotation
        if self.position.objcell_id != self.told_cell:
            fields["cell"] = self.position.objcell_id
        if self.contact:
            fields |= {"cp": nxyzd(self.plane), "cp_cell": self.plane_cell, "onw": int(self.on_walkable)}
        if self.sliding:
            fields["sn"] = xyz(self.sliding_normal)
        return fields

    def _collided(self, made: Transition) -> Fields:
        """Write what was hit."""
        kills = made.object_info.mover().kill_velocity_calls
        return struck(made.collision_info) | ({"kill": kills} if kills else {})


class WorldWalker(Walker):
    """A walker in a world: it also tells of water and objects, and of its cell only when that changes."""

    def _written(self) -> Fields:
        fields = super()._written()
        self.told_cell = self.position.objcell_id
        return fields | ({"water": 1} if self.contact and self.is_water else {})

    def _collided(self, made: Transition) -> Fields:
        return super()._collided(made) | touched_objects(made.collision_info)


OPS: Final[dict[str, Callable[[Query], Fields]]] = {"walk": _walk, "world_walk": _world_walk}
"""Operation name to function."""
