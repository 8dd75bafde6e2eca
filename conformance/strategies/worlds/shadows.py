"""Shadow lists: a simple rule of which cells an object is registered in.

It is not retail's rule, and need not be: a world's shadow lists are input. It registers in every cell that
the object may reach, so that objects are met from the cells around, too.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, Final

from conformance.strategies.worlds.land import BLOCK, CELL, CELLS_PER_SIDE

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from conformance.scenes.model import Geometry, Vec3

_INTERIOR: Final = 0x100
"""Low words from here on are interior cells."""


def registered(
    world: Mapping[str, Any], geometries: Mapping[str, Geometry], thing: Mapping[str, Any]
) -> dict[str, Any]:
    """Return a world with one more object, in the list of each cell that it may reach."""
    shadow = dict(world["shadow"])
    for cell in cells_within(world, geometries, thing["pose"], reach(thing, geometries)):
        shadow[str(cell)] = [*shadow.get(str(cell), ()), thing["id"]]
    return {**world, "objects": [*world["objects"], thing], "shadow": shadow}


def cells_within(
    world: Mapping[str, Any], geometries: Mapping[str, Geometry], pose: Mapping[str, Any], radius: float
) -> Iterator[int]:
    """Yield the loaded cells that a ball about a pose's origin may reach: its own first, then all others."""
    own = pose["cell"]
    loaded = {cell["id"]: cell for cell in world["cells"]}
    if own in loaded:
        yield own
    for cell_id, cell in loaded.items():
        if cell_id != own and _room_within(cell, geometries, pose, radius):
            yield cell_id
    for block in world["landblocks"]:
        yield from _land_within(block["block"], _seen_from(pose, block["block"]), radius)


def reach(thing: Mapping[str, Any], geometries: Mapping[str, Geometry]) -> float:
    """Return the radius of a ball about an object's origin that holds all its shapes, metres."""
    ends = [math.hypot(*shape[:3]) + shape[3] for shape in thing.get("spheres", ())]
    ends += [math.hypot(*shape[:3]) + shape[3] + shape[4] for shape in thing.get("cylspheres", ())]
    whole: float = thing["scale"] * max(ends, default=0.0)
    for part in thing.get("parts", ()):
        if part["geometry"] is not None:
            origin = part.get("pose", thing["pose"])["origin"]
            size = max(math.hypot(*vertex) for vertex in geometries[part["geometry"]].vertices)
            aside = math.dist(origin, thing["pose"]["origin"])
            whole = max(whole, aside + size * part.get("scale", thing["scale"]))
    return whole


def _room_within(
    cell: Mapping[str, Any], geometries: Mapping[str, Geometry], pose: Mapping[str, Any], radius: float
) -> bool:
    room = geometries[cell["geometry"]]
    size = max(math.hypot(*vertex) for vertex in room.vertices)
    return math.dist(_seen_from(pose, cell["id"] >> 16), cell["pose"]["origin"]) <= radius + size


def _land_within(block: int, origin: Vec3, radius: float) -> Iterator[int]:
    columns, rows = (
        range(
            max(math.floor((v - radius) / CELL), 0),
            min(math.floor((v + radius) / CELL), CELLS_PER_SIDE - 1) + 1,
        )
        for v in origin[:2]
    )
    for i in columns:
        for j in rows:
            yield block << 16 | i * CELLS_PER_SIDE + j + 1


def _seen_from(pose: Mapping[str, Any], block: int) -> Vec3:
    """Return a pose's origin in the frame of a landblock."""
    home = pose["cell"] >> 16
    x, y, z = pose["origin"]
    return (
        x + BLOCK * ((home >> 8) - (block >> 8)),
        y + BLOCK * ((home & 0xFF) - (block & 0xFF)),
        z,
    )
