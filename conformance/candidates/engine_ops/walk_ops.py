"""Recorded moves, one transition after the other (``walk.jsonl``), by the engine.

The walker here is not an object with a velocity: it carries from tick to tick exactly what FORMAT.md says.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

import numpy as np

from conformance.candidates.engine_ops.rows import query_row
from conformance.candidates.engine_ops.running import run_noting
from conformance.candidates.engine_ops.values import floats, vector
from conformance.candidates.engine_ops.world_cache import world_of
from conformance.candidates.engine_ops.worlds import engine_world
from engine import layout as at
from engine.constants import CONTACT, EPS, FLOOR_Z, ON_WALKABLE
from engine.kernels.program import RESOLVE

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from conformance.query import Fields, Query
    from engine.kernels.types import Array
    from engine.world import World

IDENTITY: Final = [1.0, 0.0, 0.0, 0.0]
"""The rotation that a tick leaves out."""
ROTATION: Final = slice(1, 5)
"""Where a pose row keeps its quaternion."""
POINT: Final = slice(5, 8)
"""Where a pose row keeps its origin."""


def _walk(query: Query) -> Fields:
    inputs = query.inputs
    walker = Walker(world_of(inputs["cells"], query.geometries), inputs["mover"], inputs["start"])
    return {"ticks": [walker.tick(tick) for tick in inputs["ticks"]]}


def _world_walk(query: Query) -> Fields:
    inputs = query.inputs
    world = engine_world(inputs["world"], query.geometries)
    walker = WorldWalker(world, inputs["mover"], inputs["start"])
    return {"ticks": [walker.tick(tick) for tick in inputs["ticks"]]}


class Walker:
    """What moves, and what it knows of the ground it stands on.

    Attributes
    ----------
    row : record of `engine.layout.QUERY_DTYPE`
        The mover, and as its start the pose that it is at.
    last : record of `engine.layout.RESULT_DTYPE` or None
        What the last successful transition ended in.
    told_cell : int
        Cell id from which a tick's is told: the start's.
    touched : list of int
        Indices of the objects that the last transition touched.
    stationary : set of int
        The flags 1, 2 (and 3) of ticks without movement.
    """

    def __init__(self, world: World, mover: Mapping[str, Any], start: Mapping[str, Any]) -> None:
        self.world: Final = world
        self.row: Final = query_row(
            {"mover": mover, "from": start, "to": start}, world.cell_index(start["cell"])
        )
        self.told_cell = int(start["cell"])
        self.touched: list[int] = []
        self.bits: Final = int(mover["state"]) & ~(CONTACT | ON_WALKABLE)
        self.last: Any = None
        self.stationary: set[int] = set()

    def tick(self, tick: Mapping[str, Any]) -> Fields:
        """Move once and write what came of it."""
        target = self._target(tick)
        if (np.abs(target[POINT] - self.row["start"][POINT]) <= EPS).all():
            self.row["start"][ROTATION] = target[ROTATION]
            return {"r": "skip"}
        self.row["end"] = target
        self._seed(contact_ok=bool(tick.get("contact_ok", 1)))
        result, trace, self.touched = run_noting(RESOLVE, self.world, self.row)
        fields: Fields = {"r": int(result["result"]), "t": trace}
        if not result["result"]:
            self.row["start"][ROTATION] = target[ROTATION]
            return fields
        self._take_over(result)
        return fields | self._written() | self._collided()

    def _target(self, tick: Mapping[str, Any]) -> Array:
        target: Array = self.row["start"].copy()
        target[POINT] = (target[POINT] + vector(tick["move"])).astype(np.float32)
        if "rotation" in tick:
            target[ROTATION] = tick["rotation"]
        return target

    @property
    def _has_contact(self) -> bool:
        return self.last is not None and bool(self.last["contact_plane_valid"])

    def _seed(self, *, contact_ok: bool) -> None:
        """Tell the query what the walker knows; `contact_ok` 0 leaves the plane."""
        row, last = self.row, self.last
        for name in _SEEDED:
            row[name] = 0.0
        row["state"] = self.bits
        row["frames_stationary_fall"] = max(self.stationary, default=0)
        if self._has_contact:
            row["last_known_contact_plane_valid"] = 1
            row["last_known_contact_plane"] = last["contact_plane"]
            row["last_known_contact_plane_is_water"] = last["contact_plane_is_water"]
            row["contact_plane_cell_id"] = last["contact_plane_cell_id"]
            if contact_ok:
                row["last_known_contact_plane_cell_id"] = last["contact_plane_cell_id"]
                row["contact_plane_valid"] = 1
                row["contact_plane"] = last["contact_plane"]
                row["contact_plane_is_water"] = last["contact_plane_is_water"]
                row["state"] = self.bits | CONTACT | (ON_WALKABLE if _walkable(last) else 0)
        if last is not None and last["sliding_normal_valid"]:
            row["sliding_normal_valid"] = 1
            row["sliding_normal"] = last["sliding_normal"]

    def _take_over(self, result: Any) -> None:
        self.last = result
        self.row["start"] = result["curr"]
        self.row["begin_cell"] = result["curr_cell"]
        frames = int(result["frames_stationary_fall"])
        if frames in {0, 3}:
            self.stationary.clear()
        else:
            self.stationary.add(frames)

    def _written(self) -> Fields:
        """Write position and contact."""
        result = self.last
        rotation, cell = floats(result["curr"][ROTATION]), int(result["curr"][0])
        fields: Fields = {"pos": floats(result["curr"][POINT])}
        if rotation != IDENTITY:
            fields["rot"] = rotation
        if cell != self.told_cell:
            fields["cell"] = cell
        if self._has_contact:
            fields["cp"] = floats(result["contact_plane"])
            fields["cp_cell"] = int(result["contact_plane_cell_id"])
            fields["onw"] = int(_walkable(result))
        if result["sliding_normal_valid"]:
            fields["sn"] = floats(result["sliding_normal"])
        return fields

    def _collided(self) -> Fields:
        """Write what was hit."""
        result = self.last
        fields: Fields = {}
        if result["collision_normal_valid"]:
            fields["cn"] = floats(result["collision_normal"])
        if result["frames_stationary_fall"]:
            fields["fsf"] = int(result["frames_stationary_fall"])
        if result["collided_with_environment"]:
            fields["env"] = 1
        kills = int(result["kill_velocity"])
        return fields | ({"kill": kills} if kills else {})


class WorldWalker(Walker):
    """A walker in a world: it also tells of water and objects, and of its cell only when that changes."""

    def _written(self) -> Fields:
        fields = super()._written()
        self.told_cell = int(self.last["curr"][0])
        return fields | ({"water": 1} if self._has_contact and self.last["contact_plane_is_water"] else {})

    def _collided(self) -> Fields:
        touched = [self.world.objects[thing].id for thing in self.touched]
        return super()._collided() | ({"objs": touched} if touched else {})


_SEEDED: Final = tuple(
    name
    for name in at.QUERY_DTYPE.names or ()
    if name.startswith(("contact_plane", "last_known_contact_plane", "sliding_normal"))
)
"""Fields of a query row that say what the walker knows."""


def _walkable(result: Any) -> bool:
    return bool(result["contact_plane"][2] >= FLOOR_Z)


OPS: Final[dict[str, Callable[[Query], Fields]]] = {"walk": _walk, "world_walk": _world_walk}
"""Operation name to function."""
