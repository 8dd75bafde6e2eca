"""Random queries in a scene, as movers ask them: near surfaces, on floors, in mid-air."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

import numpy as np

from conformance.bench.scenes import SIDE, single, turn
from conformance.bench.spots import RADIUS, above_floors, beside_walls, near_surfaces, up_in_cell
from conformance.bench.work import KernelWork, RowWork
from engine import Body, Pose, body_rows, resolve_many
from engine import layout as at
from engine.constants import (
    ACTIVE_TS,
    CONTACT,
    CONTACT_TS,
    EDGE_SLIDE,
    FLOOR_Z,
    ON_WALKABLE,
    ON_WALKABLE_TS,
)
from engine.kernels.frame import frame_cache
from engine.memory import rows_as_numbers

if TYPE_CHECKING:
    from numpy.random import Generator

    from conformance.bench.scenes import BenchScene, Floats, Indices
    from conformance.bench.spots import Surfaces
    from engine.query import Rows

SPHERES: Final = ((0.0, 0.0, 0.475, RADIUS), (0.0, 0.0, 1.35, RADIUS))
"""Those of a human, metres."""
STEP_UP: Final = 0.6
STEP_DOWN: Final = 1.5
"""Step heights of a human, metres."""
STEP: Final = 0.6
"""How far down a single step looks for ground, metres."""
TURN: Final = 0.2
"""Length of the movement of a single call of a tree, metres."""
STRIDES: Final = (0.1, 0.35)
"""Lengths of a move, metres: a tick of a runner."""
PACE: Final = 4.0
"""Speed of a body that ticks, m/s."""
QUANTUM: Final = 1.0 / 30.0
"""Length of a tick, seconds."""
AIR: Final = (2.25, 3.75)
"""Heights above the floor at which nothing is in reach, metres."""
CLEAR: Final = 2.5
"""Distance from a room's middle up to which no wall is in reach, metres."""
DROPS: Final = (0.2, 0.3)
"""Heights from which movers are put down, metres."""
ATTEMPTS: Final = 8
"""How often movers are put down till enough of them stand: not all find ground."""
SPARE: Final = 2
"""How many times more movers are put down than are needed, in an open hall, or after a first attempt."""
FEW: Final = 32
"""Movers of a later attempt at least: of one or two, none may find ground."""


class NoGroundError(Exception):
    """A scene in which too few movers find ground."""


class NoAirError(Exception):
    """A scene of which it is not known where nothing is in reach."""


def strikes(scene: BenchScene, surfaces: Surfaces, rng: Generator, count: int) -> KernelWork:
    """Return queries of a sphere that moves against a tree."""
    spheres, directions = near_surfaces(surfaces, rng, count)
    return _kernel_work(scene, spheres, TURN * directions)


def steps_down(scene: BenchScene, surfaces: Surfaces, rng: Generator, count: int) -> KernelWork:
    """Return queries of a sphere that looks for ground below it."""
    up = up_in_cell(scene)
    centers = above_floors(surfaces, rng, count, up, (RADIUS - STEP, RADIUS + 1.0))
    spheres = single(np.column_stack([centers, np.full(count, RADIUS)]))
    return _kernel_work(scene, spheres, np.tile(-STEP * up, (count, 1)))


def _kernel_work(scene: BenchScene, spheres: Floats, movements: Floats) -> KernelWork:
    count = len(spheres)
    ups = np.tile(up_in_cell(scene), (count, 1))
    allowances, interps = np.full(count, float(FLOOR_Z)), np.ones(count)
    return KernelWork(scene, spheres, single(movements), ups, allowances, interps)


def contact_walk(scene: BenchScene, surfaces: Surfaces, rng: Generator, count: int) -> RowWork:
    """Return moves of a stride along the ground: half of them anywhere, half of them at a wall.

    Raises
    ------
    NoGroundError
        If too few of the movers that are put down find ground.
    """
    found: list[Rows] = []
    missing, tried = count, 0
    for attempt in range(ATTEMPTS):
        several = max(SPARE * missing, FEW) if attempt else count
        found.append(_strides(scene, surfaces, rng, several))
        missing, tried = missing - len(found[-1]), tried + several
        if missing <= 0:
            return RowWork(scene, np.concatenate(found)[:count])
    raise NoGroundError(f"only {count - missing} of {tried} movers have found ground in {scene.name}")


def _strides(scene: BenchScene, surfaces: Surfaces, rng: Generator, count: int) -> Rows:
    """Put down about so many movers, and let those that stand make a stride."""
    up = up_in_cell(scene)
    half = (count + 1) // 2
    open_spots = above_floors(surfaces, rng, half, up, DROPS)
    wall_spots, against = beside_walls(surfaces, rng, half, up, DROPS)
    order = rng.permutation(2 * half)
    spots = np.concatenate([open_spots, wall_spots])[order]
    ways = np.concatenate([_level(rng, half), against @ scene.rows()])[order]
    rows, found = _put_down(scene, spots, rng)
    lengths = rng.uniform(*STRIDES, size=(len(rows), 1))
    rows["end"][:, -3:] = single(rows["start"][:, -3:] + lengths * ways[found])
    return rows


def open_walk(scene: BenchScene, rng: Generator, count: int, length: float, stray: float) -> RowWork:
    """Return moves of one length along the ground of `conformance.bench.scenes.hall_scene`.

    They begin up to `stray` metres from the middle of the hall, along each side.

    Raises
    ------
    NoGroundError
        If too few of the movers that are put down find ground.
    """
    half = stray * rng.uniform(-1.0, 1.0, size=(SPARE * count, 2))
    places = np.column_stack([half, rng.uniform(*DROPS, size=len(half))])
    rows, _ = _put_down(scene, np.array([turn((x, y, z)) for x, y, z in places.tolist()]), rng)
    if len(rows) < count:
        raise NoGroundError(f"only {len(rows)} of {len(places)} movers have found ground in {scene.name}")
    rows["end"][:, -3:] = single(rows["start"][:, -3:] + length * _level(rng, len(rows)))
    return RowWork(scene, rows[:count])


def _put_down(scene: BenchScene, spots: Floats, rng: Generator) -> tuple[Rows, Indices]:
    """Let movers fall at points of the cell; return those that stand then, and which they are."""
    begin = scene.to_block(spots)
    rows = _movers(scene, len(spots), int(EDGE_SLIDE))
    rows["start"][:, :5] = rows["end"][:, :5] = _facing(scene, rng, len(spots))
    rows["start"][:, -3:] = begin
    rows["end"][:, -3:] = single(begin - (0.0, 0.0, STEP))
    landed = resolve_many(scene.world, rows)
    ground = (landed["result"] == 1) & (landed["contact_plane_valid"] == 1)
    ground &= landed["contact_plane"][:, 2] >= float(FLOOR_Z)
    found = np.flatnonzero(ground)
    return _grounded(rows[found], landed, found), found


def free_flight(scene: BenchScene, rng: Generator, count: int) -> RowWork:
    """Return moves through the air, as long as `contact_walk`'s, with nothing in reach of the whole move.

    Raises
    ------
    NoAirError
        For a scene that is not made of rooms.
    """
    if scene.grid is None:
        raise NoAirError(f"{scene.name} is not made of rooms that are known to be empty above")
    rooms = np.column_stack([rng.integers(size, size=count) for size in scene.grid])
    middles = SIDE * rooms + rng.uniform(-CLEAR, CLEAR, size=(count, 2))
    places = np.column_stack([middles, rng.uniform(*AIR, size=count)])
    begin = scene.to_block(np.array([turn((x, y, z)) for x, y, z in places.tolist()]))
    rows = _movers(scene, count, int(EDGE_SLIDE))
    rows["start"][:, :5] = rows["end"][:, :5] = _facing(scene, rng, count)
    rows["start"][:, -3:] = begin
    rows["end"][:, -3:] = single(begin + rng.uniform(*STRIDES, size=(count, 1)) * _level(rng, count))
    return RowWork(scene, rows)


def tree_calls(scene: BenchScene, surfaces: Surfaces, rng: Generator, count: int) -> RowWork:
    """Return single calls of the cell's tree: every other one moves along, the others look for ground."""
    rows = contact_walk(scene, surfaces, rng, count).rows
    rows["target_object"] = at.NO_OBJECT
    rows["walk_interp"], rows["walkable_allowance"] = 1.0, float(FLOOR_Z)
    rows["step_down"][1::2], rows["step_down_amt"][1::2] = 1, float(np.float32(STEP))
    return RowWork(scene, rows)


def bodies(scene: BenchScene, surfaces: Surfaces, rng: Generator, count: int) -> RowWork:
    """Return bodies that walk along the ground, where `contact_walk` walks."""
    moves = contact_walk(scene, surfaces, rng, count).rows
    ways = moves["end"][:, -3:] - moves["start"][:, -3:]
    speeds = rng.uniform(PACE / 2.0, PACE, size=(count, 1))
    rows = np.repeat(body_rows(scene.world, [_walker(scene)]), count)
    rows["cell_id"], rows["rotation"] = moves["start"][:, 0], moves["start"][:, 1:5]
    rows["origin"] = moves["start"][:, -3:]
    for place in rows_as_numbers(rows):
        frame_cache(place, 0)
    rows["velocity"] = single(speeds * ways / np.linalg.norm(ways, axis=1, keepdims=True))
    rows["contact_plane"] = moves["contact_plane"]
    rows["contact_plane_cell_id"] = moves["contact_plane_cell_id"]
    return RowWork(scene, rows)


def _walker(scene: BenchScene) -> Body:
    """Return a body that walks on ground; where and how fast is not said."""
    return Body(
        Pose(scene.pose.cell),
        SPHERES,
        step_up_height=STEP_UP,
        step_down_height=STEP_DOWN,
        transient_state=int(ACTIVE_TS) | int(CONTACT_TS) | int(ON_WALKABLE_TS),
        has_movement_manager=True,
        tracks_objects=False,
    )


def _movers(scene: BenchScene, count: int, state: int) -> Rows:
    """Return moves of humans; from where and to where is not said."""
    rows = np.zeros(count, dtype=at.QUERY_DTYPE)
    rows["num_sphere"] = len(SPHERES)
    rows["spheres"] = single(np.array(SPHERES))
    rows["scale"] = 1.0
    rows["state"] = state
    rows["step_up_height"], rows["step_down_height"] = float(np.float32(STEP_UP)), STEP_DOWN
    rows["may_step_down"] = rows["gravity"] = rows["has_start"] = 1
    rows["placement_allows_sliding"] = 1
    rows["begin_cell"] = rows["target_cell"] = scene.world.cell_index(scene.pose.cell)
    return rows


def _grounded(rows: Rows, landed: Rows, found: Indices) -> Rows:
    """Let movers stand where those that are found have landed, and know what they stand on."""
    rows["state"] = int(EDGE_SLIDE) | int(CONTACT) | int(ON_WALKABLE)
    rows["start"] = rows["end"] = landed["curr"][found]
    for name in ("contact_plane", "last_known_contact_plane"):
        rows[f"{name}_valid"] = 1
        for suffix in ("", "_cell_id", "_is_water"):
            rows[f"{name}{suffix}"] = landed[f"contact_plane{suffix}"][found]
    return rows


def _facing(scene: BenchScene, rng: Generator, count: int) -> Floats:
    """Return cell id and a random yaw for each pose; shape (count, 5)."""
    half = rng.uniform(0.0, np.pi, size=count)
    nothing = np.zeros(count)
    cells = np.full(count, float(scene.pose.cell))
    return np.column_stack([cells, single(np.cos(half)), nothing, nothing, single(np.sin(half))])


def _level(rng: Generator, count: int) -> Floats:
    """Return level unit vectors in random directions; shape (count, 3)."""
    angle = rng.uniform(0.0, 2.0 * np.pi, size=count)
    return np.column_stack([np.cos(angle), np.sin(angle), np.zeros(count)])
