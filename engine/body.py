"""Bodies: what ticks by itself, given as plain numbers, checked, and kept as rows."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Final

import numpy as np

from engine import layout as at
from engine.body_layout import BODY_DTYPE
from engine.checks import finite, flag, number, optional, record, sequence, told, whole
from engine.constants import ACTIVE_TS, DEFAULT_ELASTICITY, DEFAULT_FRICTION, DEFAULT_STATE
from engine.errors import QueryError
from engine.float32 import float32_array
from engine.memory import rows_as_numbers
from engine.pose import Pose, check_pose, position_row
from engine.world import CHECK_WORLD

if TYPE_CHECKING:
    from collections.abc import Sequence

    from engine.kernels.types import Array
    from engine.query import Rows
    from engine.world import World

STILLNESS = (0.0, 0.0, 0.0)


@dataclass(frozen=True, slots=True)
class Body:
    """An object that moves by its velocity, as it is before its first tick.

    Attributes
    ----------
    pose : Pose
        Where it is; its cell is one of the world's.
    spheres : sequence of sequences of float
        None, one or two: centre x, y, z in its own frame, and radius; metres, before `scale`.
    scale : float
        Multiplies the spheres.
    step_up_height, step_down_height : float
        Metres, as used.
    state : int
        PhysicsState bits (`engine.constants`).
    transient_state : int
        Bits of 04, 1.4: 1 contact, 2 on walkable, 4 sliding, 8 water, 0x70 stationary, 0x80 active.
    velocity, acceleration : sequence of float
        Metres per second, and per second squared; global axes.
    omega : sequence of float
        Radians per second about the global axes.
    friction, elasticity : float
        Parts of the speed: lost in a second of sliding, and kept in a bounce.
    contact_plane : sequence of float
        Normal x, y, z and d; counts with the contact bit.
    contact_plane_cell : int
        Cell id in whose block's coordinates that plane is.
    sliding_normal : sequence of float
        Counts with the sliding bit.
    has_movement_manager : bool
        It is steered, and so does not come to rest for good when it stands still.
    free_heading : bool
        Its rotation is free of collisions.
    weenie_bits : int or None
        ObjectInfo bits that its game object adds: 0x80 impenetrable, 0x100 player, 0x800 and 0x1000
        player killers. None: it has no game object.
    bypasses_restrictions : bool
        Its game object lets it into every cell; one that does not, and is a player, enters a restricted
        cell only where the cell's `Restriction` admits its id.
    colliding_with_environment : bool
        It is known to touch the environment, so that this is not reported again.
    tracks_objects : bool
        It takes notice of the objects that it touches.
    has_parent : bool
        It is attached to another object.
    id : int
        Its object id; 0 for none. It never collides with an obstacle of that id.
    update_time : float
        Up to when it is simulated, seconds.
    """

    pose: Pose
    spheres: Sequence[Sequence[float]]
    scale: float = 1.0
    step_up_height: float = 0.0
    step_down_height: float = 0.0
    state: int = DEFAULT_STATE
    transient_state: int = int(ACTIVE_TS)
    velocity: Sequence[float] = STILLNESS
    acceleration: Sequence[float] = STILLNESS
    omega: Sequence[float] = STILLNESS
    friction: float = DEFAULT_FRICTION
    elasticity: float = DEFAULT_ELASTICITY
    contact_plane: Sequence[float] = (0.0, 0.0, 0.0, 0.0)
    contact_plane_cell: int = 0
    sliding_normal: Sequence[float] = STILLNESS
    has_movement_manager: bool = False
    free_heading: bool = False
    weenie_bits: int | None = None
    bypasses_restrictions: bool = False
    colliding_with_environment: bool = False
    tracks_objects: bool = True
    has_parent: bool = False
    id: int = 0
    update_time: float = 0.0


_CHECK_BODY: Final = record(
    Body,
    pose=check_pose,
    spheres=sequence,
    scale=number,
    **dict.fromkeys(("state", "transient_state", "contact_plane_cell", "id"), whole()),
    **dict.fromkeys(
        (
            *("has_movement_manager", "free_heading", "bypasses_restrictions"),
            *("colliding_with_environment", "tracks_objects", "has_parent"),
        ),
        flag,
    ),
    weenie_bits=optional(whole()),
    update_time=finite,
)
_VECTORS = {
    "velocity": at.VECTOR_SIZE,
    "acceleration": at.VECTOR_SIZE,
    "omega": at.VECTOR_SIZE,
    "sliding_normal": at.VECTOR_SIZE,
    "contact_plane": at.PLANE_SIZE,
}
_NUMBERS = ("scale", "step_up_height", "step_down_height", "friction", "elasticity")
_EXACT = (
    "state",
    "transient_state",
    "has_movement_manager",
    "free_heading",
    "bypasses_restrictions",
    "colliding_with_environment",
    "tracks_objects",
    "has_parent",
    "id",
    "update_time",
)


def body_rows(world: World, bodies: Sequence[Body]) -> Rows:
    """Return a record of `engine.body_layout.BODY_DTYPE` for each body.

    Raises
    ------
    QueryError, PoseError
        Naming the body and what is wrong with it.
    """
    CHECK_WORLD(world, "world", QueryError)
    sequence(bodies, "bodies", QueryError)
    rows = np.zeros(len(bodies), dtype=BODY_DTYPE)
    for index, body in enumerate(bodies):
        where = f"body {index}"
        _CHECK_BODY(body, where, QueryError)
        row = rows[index]
        row["cell"] = world.cell_index(body.pose.cell)
        if row["cell"] == at.NO_CELL:
            raise QueryError(f"{where}, cell", f"{body.pose.cell:#010x} is not in the world")
        _fill_body(row, body, where)
        rows_as_numbers(rows)[index, : at.POSITION_SIZE] = position_row(body.pose, where)
    return rows


def given_body(world: World, body: Any) -> Rows:
    """Return one row for a body, or for a record that an earlier tick or placement returned: a copy.

    Raises
    ------
    QueryError, PoseError
        If it is neither, or cannot be simulated.
    """
    if isinstance(body, Body):
        return body_rows(world, [body])
    if getattr(body, "dtype", None) != BODY_DTYPE or body.shape not in {(), (1,)}:
        raise QueryError("body", f"{told(body)} where a Body, or a record of BODY_DTYPE, is needed")
    rows = np.empty(1, dtype=BODY_DTYPE)
    rows[:] = body
    return rows


def body_numbers(rows: Any) -> Array:
    """Return bodies as kernels see them, who write to them: one row of numbers for each, the same memory.

    Raises
    ------
    QueryError
        If they are not records of `BODY_DTYPE` in one row, contiguous, aligned and writable.
    """
    if not isinstance(rows, np.ndarray):
        raise QueryError("rows", f"{type(rows).__name__} where an array of BODY_DTYPE is needed")
    if rows.dtype != BODY_DTYPE:
        raise QueryError("rows", "not of engine.body_layout.BODY_DTYPE")
    if rows.ndim != 1:
        raise QueryError("rows", f"shape {rows.shape} where one row for each body is needed")
    if not rows.flags.c_contiguous:
        raise QueryError("rows", "not contiguous")
    numbers = rows_as_numbers(rows)
    if not (rows.flags.writeable and numbers.flags.aligned):
        raise QueryError("rows", "not writable, or not aligned")
    return numbers


def _fill_body(row: Any, body: Body, where: str) -> None:
    """Write everything but the position and the cell."""
    _fill_spheres(row, body, where)
    for name, size in _VECTORS.items():
        row[name] = float32_array(getattr(body, name), (size,), f"{where}, {name}", QueryError)
    for name in _NUMBERS:
        row[name] = float32_array([getattr(body, name)], (1,), f"{where}, {name}", QueryError)[0]
    for name in _EXACT:
        row[name] = getattr(body, name)
    row["contact_plane_cell_id"] = body.contact_plane_cell
    row["has_weenie"] = body.weenie_bits is not None
    row["weenie_bits"] = body.weenie_bits or 0


def _fill_spheres(row: Any, body: Body, where: str) -> None:
    count = len(body.spheres)
    if count > at.MAX_SPHERES:
        raise QueryError(f"{where}, spheres", f"{count} spheres where at most 2 are possible")
    row["num_sphere"] = count
    if not count:
        return
    spheres = float32_array(body.spheres, (count, at.SPHERE_SIZE), f"{where}, spheres", QueryError)
    row["spheres"][:count] = spheres
    if not spheres[0, at.RADIUS] * body.scale > 0.0:
        raise QueryError(f"{where}, spheres", "the first sphere has no radius")
