"""Thousands of random moves in a world of the suite, made at once: in rooms, over land, at things."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt
from engine_scenes import prepared

from conformance.candidates.engine_ops.worlds import engine_world
from conformance.strategies.poses import to_world
from conformance.strategies.worlds.sites import site
from engine import Body, Pose
from engine import layout as at
from engine.constants import (
    CONTACT,
    EDGE_SLIDE,
    FREE_ROTATE,
    IS_VIEWER,
    ON_WALKABLE,
    PATH_CLIPPED,
    PERFECT_CLIP,
)

if TYPE_CHECKING:
    from numpy.random import Generator

    from engine.query import Rows
    from engine.world import World

Floats = npt.NDArray[np.float64]

STATES = np.array(
    [
        EDGE_SLIDE,
        EDGE_SLIDE,
        0,
        CONTACT | ON_WALKABLE | EDGE_SLIDE,
        CONTACT | EDGE_SLIDE,
        PATH_CLIPPED,
        PATH_CLIPPED | PERFECT_CLIP,
        IS_VIEWER | FREE_ROTATE,
    ],
    dtype=np.float64,
)
SPHERES = np.array([(0.0, 0.0, 0.475, 0.48), (0.0, 0.0, 1.35, 0.48)], dtype=np.float32)
LONGEST = 1.5
"""Metres."""


def world_at(name: str) -> World:
    """Return the engine's world of a site of the random worlds, prepared."""
    place = site(name)
    return prepared(engine_world(place.world, place.geometries))


def random_moves(name: str, rng: Generator, count: int) -> Rows:
    """Return rows of moves: a third each from a room, over the land, and at a thing, where there are such."""
    place, world = site(name), world_at(name)
    starts = [_in_cell(cell, world, rng) for cell in place.world["cells"]]
    starts += [_over_land(block, rng) for block in place.world["landblocks"]]
    starts += [_at_thing(thing, rng) for thing in place.world["objects"]]
    rows = np.zeros(count, dtype=at.QUERY_DTYPE)
    give_mover(rows, rng)
    for index, draw in enumerate(rng.integers(len(starts), size=count)):
        cell, origin = starts[draw]()
        rows["start"][index, 0] = rows["end"][index, 0] = cell
        rows["start"][index, -3:] = origin
        rows["begin_cell"][index] = world.cell_index(int(cell))
    rows["start"][:, 1:5], rows["end"][:, 1:5] = rotations(rng, count), rotations(rng, count)
    ways = rng.normal(size=(count, 3)) * (1.0, 1.0, 0.4)
    ways *= rng.uniform(0.0, LONGEST, size=(count, 1)) / np.linalg.norm(ways, axis=1, keepdims=True)
    rows["end"][:, -3:] = single(rows["start"][:, -3:] + ways)
    inside: Rows = rows[rows["begin_cell"] != at.NO_CELL]
    return inside


def random_bodies(name: str, rng: Generator, count: int) -> list[Body]:
    """Return bodies where random moves begin, as fast as those are long."""
    return [
        Body(
            Pose(int(move["start"][0]), move["start"][-3:].tolist()),
            move["spheres"].tolist(),
            velocity=(10.0 * (move["end"] - move["start"])[-3:]).tolist(),
        )
        for move in random_moves(name, rng, count)
    ]


def give_mover(rows: Rows, rng: Generator) -> None:
    """Make the movers of rows humans of several sizes, in every state, some of them falling or sliding."""
    count = len(rows)
    rows["num_sphere"] = rng.integers(1, 3, size=count)
    rows["spheres"] = SPHERES
    rows["scale"] = single(rng.choice([0.25, 0.5, 1.0, 1.0, 1.7], size=count))
    rows["state"] = rng.choice(STATES, size=count)
    rows["step_up_height"], rows["step_down_height"] = np.float32(0.6), 1.5
    rows["ethereal"] = rng.random(count) < 0.1
    rows["may_step_down"] = rng.random(count) < 0.8
    rows["gravity"] = rng.random(count) < 0.8
    rows["has_start"] = rng.random(count) < 0.95
    rows["placement_allows_sliding"] = 1
    falling = rng.random(count) < 0.1
    rows["frames_stationary_fall"] = np.where(falling, rng.integers(4, size=count), 0)
    slides = rng.random(count) < 0.1
    rows["sliding_normal_valid"] = slides
    rows["sliding_normal"][slides, 0] = 1.0


def _in_cell(cell: Any, world: World, rng: Generator) -> Any:
    shape = world.shapes[0]
    for candidate in world.shapes:
        shape = candidate if candidate.name == cell["geometry"] else shape
    low, high = shape.bounds[:3], shape.bounds[3:]

    def draw() -> tuple[float, Floats]:
        x, y, z = rng.uniform(low, high).tolist()
        return float(cell["id"]), single(to_world(cell["pose"], (x, y, z), 1.0))

    return draw


def _over_land(block: Any, rng: Generator) -> Any:
    heights = np.array(block["heights"], dtype=np.float64).reshape(9, 9)

    def draw() -> tuple[float, Floats]:
        x, y = rng.uniform(0.0, 192.0, size=2)
        i, j = int(x // 24.0), int(y // 24.0)
        z = heights[i : i + 2, j : j + 2].max() + rng.uniform(-1.0, 3.0)
        return float((block["block"] << 16) + 8 * i + j + 1), single(np.array([x, y, z]))

    return draw


def _at_thing(thing: Any, rng: Generator) -> Any:
    pose = thing["pose"]

    def draw() -> tuple[float, Floats]:
        return float(pose["cell"]), single(np.array(pose["origin"]) + rng.uniform(-3.0, 3.0, size=3))

    return draw


def rotations(rng: Generator, count: int) -> Floats:
    """Return quaternions: half of them yaws, the others anything."""
    quaternions = rng.normal(size=(count, 4))
    quaternions[: count // 2, 1:3] = 0.0
    return single(quaternions / np.linalg.norm(quaternions, axis=1, keepdims=True))


def single(values: Any) -> Floats:
    """Return numbers as rows hold them: rounded to float32."""
    return np.asarray(values, dtype=np.float32).astype(np.float64)
