"""Single calls of obstacles: one shape, one object, a cell's objects, or a whole cell."""

from __future__ import annotations

from dataclasses import dataclass, field
from enum import IntEnum
from typing import TYPE_CHECKING, Final

import numpy as np

from engine import constants
from engine import layout as at
from engine.checks import LARGEST_INDEX, record, sequence, whole
from engine.errors import QueryError
from engine.query import CHECK_MOVE, Move, PathState, fill_call, fill_path
from engine.world import CHECK_WORLD

if TYPE_CHECKING:
    from collections.abc import Sequence

    from engine.query import Rows
    from engine.world import World


class Target(IntEnum):
    """What an object call tests."""

    FIRST_SHAPE = int(constants.TARGET_FIRST_SHAPE)
    """An object's first shape alone, whatever exempts the mover from the object."""
    OBJECT = int(constants.TARGET_OBJECT)
    """One object: its shapes in order, and what a touch means."""
    OBJECTS = int(constants.TARGET_OBJECTS)
    """All objects of the cell, in order."""
    CELL = int(constants.TARGET_CELL)
    """The cell's environment, then its objects."""
    ENTRY = int(constants.TARGET_ENTRY)
    """Nothing: whether the mover may enter the cell at all."""


@dataclass(frozen=True, slots=True)
class ObjectCall:
    """One call of obstacles: the mover at `move.end`, having come from `move.start`.

    Attributes
    ----------
    move : Move
        `begin_cell` is the cell whose obstacles are tested.
    target : Target
    object_index : int
        Which object of that cell, where `target` is one.
    path : PathState
    """

    move: Move
    target: Target = Target.OBJECT
    object_index: int = 0
    path: PathState = field(default_factory=PathState)


_CHECK_CALL: Final = record(
    ObjectCall,
    move=CHECK_MOVE,
    target=record(Target),
    object_index=whole(-LARGEST_INDEX, LARGEST_INDEX),
    path=record(PathState),
)


def object_rows(world: World, calls: Sequence[ObjectCall]) -> Rows:
    """Return a row for each call; raises `QueryError` or `PoseError` naming the call."""
    CHECK_WORLD(world, "world", QueryError)
    sequence(calls, "calls", QueryError)
    rows = np.zeros(len(calls), dtype=at.QUERY_DTYPE)
    for index, call in enumerate(calls):
        where = f"call {index}"
        _CHECK_CALL(call, where, QueryError)
        row = rows[index]
        fill_call(row, world, call.move, where)
        fill_path(row, call.path, where)
        row["target_kind"] = call.target
        row["target_object"] = _object(world, call, where)
    return rows


def _object(world: World, call: ObjectCall, where: str) -> int:
    """Return the index in the world of the object that is called, if it is one."""
    if call.target not in (Target.FIRST_SHAPE, Target.OBJECT):
        return int(at.NO_OBJECT)
    things = world.objects_of(world.cell_index(call.move.begin_cell))
    if not 0 <= call.object_index < len(things):
        raise QueryError(f"{where}, object", f"{call.object_index} does not exist ({len(things)} objects)")
    thing = things[call.object_index]
    if call.target == Target.FIRST_SHAPE and not world.shape_count(thing):
        raise QueryError(f"{where}, object", f"{call.object_index} has no shape to call")
    return thing
