"""What can be asked: movers, what they bring along, and rows of many queries."""

from __future__ import annotations

from dataclasses import dataclass, field, fields
from typing import TYPE_CHECKING, Any, Final, TypeAlias

import numpy as np
import numpy.typing as npt

from engine import layout as at
from engine.checks import LARGEST_INDEX, flag, optional, record, sequence, whole
from engine.effort import check_way
from engine.errors import QueryError
from engine.float32 import float32_array
from engine.pose import Pose, check_pose, pose_row
from engine.world import CHECK_WORLD

if TYPE_CHECKING:
    from collections.abc import Sequence

    from engine.world import World

Rows: TypeAlias = npt.NDArray[np.void]
"""An array of `engine.layout.QUERY_DTYPE` or `RESULT_DTYPE` records."""
MOST_STATIONARY: Final = 3
"""Frames without movement in the air that retail counts (05, frames_stationary_fall)."""


@dataclass(frozen=True, slots=True)
class Mover:
    """Who moves.

    Attributes
    ----------
    spheres : sequence of sequences of float
        One or two: centre x, y, z in the mover's own frame, and radius; metres, before `scale`.
    scale : float
        Multiplies the spheres.
    state : int
        ObjectInfo bits: 1 contact, 2 on walkable, 4 viewer, 8 path clipped, 0x10 free rotate,
        0x40 perfect clip, 0x80 impenetrable, 0x100 player, 0x200 edge slide, 0x400 ignores creatures,
        0x800 and 0x1000 player killers.
    step_up_height, step_down_height : float
        Metres, as used.
    ethereal : bool
        Passes through what is not static.
    may_step_down : bool
        Looks for ground; a missile does not.
    gravity : bool
        Falls; then standing still in the air is counted.
    id : int
        Its object id; 0 for none. It never collides with an obstacle of that id.
    missile : bool
        A missile: ethereal game objects, and creatures that are not its target, are not in its way.
    target_id : int
        Id of the object that a missile is meant for; 0 for none.
    restricted : bool
        Has a game object that can't bypass entry restrictions: as a player it enters a restricted cell
        only where the cell's `Restriction` admits its id.
    """

    spheres: Sequence[Sequence[float]]
    scale: float = 1.0
    state: int = 0
    step_up_height: float = 0.0
    step_down_height: float = 0.0
    ethereal: bool = False
    may_step_down: bool = True
    gravity: bool = True
    id: int = 0
    missile: bool = False
    target_id: int = 0
    restricted: bool = False


@dataclass(frozen=True, slots=True)
class ContactPlane:
    """The plane that a mover stands on.

    Attributes
    ----------
    plane : sequence of float
        Normal x, y, z and d, with n . p + d = 0, in the coordinates of the block of `cell`.
    cell : int
        Cell id.
    is_water : bool
        Water, or the top of an object: the mover is not lifted out of it.
    """

    plane: Sequence[float]
    cell: int
    is_water: bool = False


@dataclass(frozen=True, slots=True)
class Seed:
    """What a mover brings along from its last move.

    Attributes
    ----------
    contact, last_known : ContactPlane or None
        Both are usually the same.
    sliding_normal : sequence of float or None
        x, y, z; made horizontal and of unit length.
    frames_stationary_fall : int
        0 to 3.
    """

    contact: ContactPlane | None = None
    last_known: ContactPlane | None = None
    sliding_normal: Sequence[float] | None = None
    frames_stationary_fall: int = 0


@dataclass(frozen=True, slots=True)
class PathState:
    """The SPHEREPATH fields that a single collision call depends on (04, 2.3)."""

    insert_type: int = 0
    step_down: int = 0
    step_down_amt: float = 0.0
    walk_interp: float = 0.0
    walkable_allowance: float = 0.0
    check_walkable: int = 0
    collide: int = 0
    obstruction_ethereal: int = 0
    bldg_check: int = 0
    hits_interior_cell: int = 0


@dataclass(frozen=True, slots=True)
class Move:
    """A transition: from where to where, in which cell, by whom.

    Attributes
    ----------
    mover : Mover
    end : Pose
        Where to.
    begin_cell : int
        Id of the cell in which the mover is.
    start : Pose or None
        Where from; None puts the mover down at `end`.
    seed : Seed
    placement_allows_sliding : bool
        Whether a placement may search nearby.
    """

    mover: Mover
    end: Pose
    begin_cell: int
    start: Pose | None = None
    seed: Seed = field(default_factory=Seed)
    placement_allows_sliding: bool = True


@dataclass(frozen=True, slots=True)
class CollisionCall:
    """One call of a tree: the mover at `move.end`, having come from `move.start`.

    Attributes
    ----------
    move : Move
        `begin_cell` is the cell that is tested, or whose object is.
    object_index : int or None
        Which object of that cell; None for the cell's own tree.
    path : PathState
    """

    move: Move
    object_index: int | None = None
    path: PathState = field(default_factory=PathState)


_CHECK_CONTACT: Final = record(ContactPlane, cell=whole(), is_water=flag)
_CHECK_MOVER: Final = record(
    Mover,
    spheres=sequence,
    state=whole(),
    **dict.fromkeys(("ethereal", "may_step_down", "gravity", "missile", "restricted"), flag),
    id=whole(),
    target_id=whole(),
)
CHECK_MOVE: Final = record(
    Move,
    mover=_CHECK_MOVER,
    end=check_pose,
    begin_cell=whole(),
    start=optional(check_pose),
    seed=record(
        Seed,
        contact=optional(_CHECK_CONTACT),
        last_known=optional(_CHECK_CONTACT),
        frames_stationary_fall=whole(0, MOST_STATIONARY),
    ),
    placement_allows_sliding=flag,
)
_CHECK_CALL: Final = record(
    CollisionCall,
    move=CHECK_MOVE,
    object_index=optional(whole(-LARGEST_INDEX, LARGEST_INDEX)),
    path=record(PathState),
)


def move_rows(world: World, moves: Sequence[Move]) -> Rows:
    """Return a row for each move; raises `QueryError` or `PoseError` naming the move."""
    CHECK_WORLD(world, "world", QueryError)
    sequence(moves, "moves", QueryError)
    rows = np.zeros(len(moves), dtype=at.QUERY_DTYPE)
    for index, move in enumerate(moves):
        CHECK_MOVE(move, f"move {index}", QueryError)
        row = rows[index]
        fill_move(row, world, move, f"move {index}")
        start = None if move.start is None else row["start"]
        check_way(start, row["end"], float(row["spheres"][0, at.RADIUS] * row["scale"]), f"move {index}")
    return rows


def fill_call(row: Any, world: World, move: Move, where: str) -> None:
    """Fill in the move of a single call, which is made in the cell where it begins."""
    if move.start is None:
        raise QueryError(f"{where}, start", "a collision call comes from somewhere")
    fill_move(row, world, move, where)
    row["target_cell"] = row["begin_cell"]


def collision_rows(world: World, calls: Sequence[CollisionCall]) -> Rows:
    """Return a row for each call; raises `QueryError` or `PoseError` naming the call."""
    CHECK_WORLD(world, "world", QueryError)
    sequence(calls, "calls", QueryError)
    rows = np.zeros(len(calls), dtype=at.QUERY_DTYPE)
    for index, call in enumerate(calls):
        where = f"call {index}"
        _CHECK_CALL(call, where, QueryError)
        row = rows[index]
        fill_call(row, world, call.move, where)
        row["target_object"] = _object(world, call, where)
        fill_path(row, call.path, where)
    return rows


def _object(world: World, call: CollisionCall, where: str) -> int:
    cell = world.cell_index(call.move.begin_cell)
    if call.object_index is None:
        if world.tree_of(cell) == at.NO_TREE:
            raise QueryError(f"{where}, cell", "it has no tree to collide with")
        return at.NO_OBJECT
    things = world.objects_of(cell)
    if not 0 <= call.object_index < len(things):
        raise QueryError(f"{where}, object", f"{call.object_index} does not exist ({len(things)} objects)")
    thing = things[call.object_index]
    if not world.has_parts(thing):
        raise QueryError(f"{where}, object", f"{call.object_index} has no part with a tree to collide with")
    return thing


def fill_path(row: Any, path: PathState, where: str) -> None:
    """Write a path's state into a row; raises `QueryError` naming the field."""
    for name in (f.name for f in fields(PathState)):
        row[name] = _number(getattr(path, name), f"{where}, {name}")


def fill_move(row: Any, world: World, move: Move, where: str) -> None:
    """Write a move into a row; raises `QueryError` or `PoseError` naming what is wrong."""
    _fill_mover(row, move.mover, f"{where}, mover")
    _fill_seed(row, move.seed, f"{where}, seed")
    row["has_start"] = move.start is not None
    if move.start is not None:
        row["start"] = pose_row(move.start, f"{where}, start")
    row["end"] = pose_row(move.end, f"{where}, end")
    row["begin_cell"] = world.cell_index(move.begin_cell)
    if row["begin_cell"] == at.NO_CELL:
        raise QueryError(f"{where}, begin cell", f"{move.begin_cell:#010x} is not in the world")
    row["placement_allows_sliding"] = move.placement_allows_sliding


def _fill_mover(row: Any, mover: Mover, where: str) -> None:
    count = len(mover.spheres)
    if not 1 <= count <= at.MAX_SPHERES:
        raise QueryError(f"{where}, spheres", f"{count} spheres where 1 or 2 are needed")
    spheres = float32_array(mover.spheres, (count, at.SPHERE_SIZE), f"{where}, spheres", QueryError)
    row["num_sphere"] = count
    row["spheres"][:count] = spheres
    row["scale"] = _number(mover.scale, f"{where}, scale")
    if not spheres[0, at.RADIUS] * row["scale"] > 0.0:
        raise QueryError(f"{where}, spheres", "the first sphere has no radius")
    row["state"] = mover.state
    row["step_up_height"] = _number(mover.step_up_height, f"{where}, step-up height")
    row["step_down_height"] = _number(mover.step_down_height, f"{where}, step-down height")
    row["ethereal"] = mover.ethereal
    row["may_step_down"] = mover.may_step_down
    row["gravity"] = mover.gravity
    row["mover_id"] = mover.id
    row["mover_missile"] = mover.missile
    row["target_id"] = mover.target_id
    row["mover_restricted"] = mover.restricted


def _fill_seed(row: Any, seed: Seed, where: str) -> None:
    planes = {"contact_plane": seed.contact, "last_known_contact_plane": seed.last_known}
    for name, contact in planes.items():
        if contact is not None:
            row[f"{name}_valid"] = 1
            row[name] = float32_array(contact.plane, (at.PLANE_SIZE,), f"{where}, {name}", QueryError)
            row[f"{name}_cell_id"] = contact.cell
            row[f"{name}_is_water"] = contact.is_water
    if seed.sliding_normal is not None:
        row["sliding_normal_valid"] = 1
        row["sliding_normal"] = float32_array(
            seed.sliding_normal, (at.VECTOR_SIZE,), f"{where}, sliding normal", QueryError
        )
    row["frames_stationary_fall"] = seed.frames_stationary_fall


def _number(value: float, where: str) -> float:
    return float(float32_array([value], (1,), where, QueryError)[0])
