"""Sites: the worlds that random queries are asked in, each made once."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cache
from typing import TYPE_CHECKING, Any, Final

from conformance.inputs import read_block
from conformance.scenes.algebra import subtract
from conformance.scenes.planes import signed_distance
from conformance.strategies.poses import turned
from conformance.strategies.worlds.buildings import Ground, put_up
from conformance.strategies.worlds.furniture import furnished
from conformance.strategies.worlds.land import CELL, global_vertex, height_at, land_cell, landblock
from conformance.strategies.worlds.things import thing_geometries

if TYPE_CHECKING:
    from collections.abc import Mapping

    from conformance.scenes.model import Geometry, Vec3
    from conformance.strategies.worlds.buildings import House


@dataclass(frozen=True, slots=True)
class Spec:
    """What a site is made of.

    Attributes
    ----------
    block : int
        16-bit id of its south-western landblock.
    land, water : str
        How high and how wet it is (`land`).
    columns, rows : int
        Landblocks that are loaded, eastwards and northwards.
    houses : tuple of Ground
        What is built, and where.
    things : int
        How many objects stand about.
    short_stab : bool
        Whether a room's stab list names its neighbours only, not the whole house.
    """

    block: int
    land: str = "flat"
    water: str = "dry"
    columns: int = 1
    rows: int = 1
    houses: tuple[Ground, ...] = ()
    things: int = 0
    short_stab: bool = False


@dataclass(frozen=True, slots=True, eq=False)
class Site:
    """A world, and what queries are aimed at.

    Attributes
    ----------
    world : Mapping
        A WORLD record, numbers exact; the same object for every query, so that it is compiled once.
    geometries : Mapping of str to Geometry
        Every geometry that it names, and more.
    blocks, rooms : frozenset of int
        The landblocks and interior cells that are loaded.
    """

    world: Mapping[str, Any]
    geometries: Mapping[str, Geometry] = field(repr=False)
    blocks: frozenset[int] = frozenset()
    rooms: frozenset[int] = frozenset()

    @property
    def name(self) -> str:
        """What the world is called."""
        return str(self.world["name"])

    def cell_at(self, block: int, point: Vec3, *, otherwise: int) -> int:
        """Return the loaded cell that a point of a landblock's frame is in, a room first, or `otherwise`."""
        for cell in self.world["cells"]:
            if cell["id"] >> 16 == block and self._inside(cell, point):
                return int(cell["id"])
        return land_cell(block, *point[:2]) if block in self.blocks else otherwise

    def _inside(self, cell: Mapping[str, Any], point: Vec3) -> bool:
        w, x, y, z = cell["pose"]["rotation"]
        local = turned((w, -x, -y, -z), subtract(point, cell["pose"]["origin"]))
        planes = self.geometries[cell["geometry"]].cell_planes or ()
        return all(signed_distance(plane, local) >= 0.0 for plane in planes)


_TOWN: Final = 0xA9B4
_NORTH_EAST: Final = 0xFEFE
"""The last landblock of the world."""

_SPECS: Final[Mapping[str, Spec]] = {
    "meadow": Spec(_TOWN),
    "farm": Spec(_TOWN, houses=(Ground("cottage", 0, (108.0, 84.0)),), things=6),
    "hamlet": Spec(
        _TOWN,
        land="rolling",
        houses=(Ground("cottage", 0, (60.0, 108.0), yaw=30), Ground("hut", 0, (130.0, 40.0), yaw=200)),
        things=10,
    ),
    "hills": Spec(_TOWN, land="rolling", water="ponds", columns=2, rows=2, things=12),
    "border-house": Spec(
        0x1103, columns=2, rows=2, houses=(Ground("cottage", 0, (189.0, 100.0), yaw=10),), things=8
    ),
    "corner-house": Spec(
        0xFC02,
        land="rolling",
        columns=2,
        rows=2,
        houses=(Ground("cottage", 3, (1.5, 2.0), yaw=75), Ground("hut", 0, (190.5, 60.0), yaw=90)),
        things=8,
        short_stab=True,
    ),
    "half-loaded": Spec(
        _TOWN, houses=(Ground("cottage", 0, (108.0, 84.0), yaw=45, missing=(1, 2)),), things=4
    ),
    "no-loft": Spec(_TOWN, houses=(Ground("cottage", 0, (80.0, 84.0), missing=(2, 3)),), short_stab=True),
    "dungeon": Spec(
        _TOWN, houses=(Ground("dungeon", 0, (50.0, 60.0), yaw=20, height=-60.0),), things=5, short_stab=True
    ),
    "broken-dungeon": Spec(
        _TOWN, houses=(Ground("dungeon", 0, (90.0, 96.0), height=-8.0, missing=(2,)),), things=3
    ),
    "limit": Spec(_TOWN, land="limit", columns=2, things=6),
    "tilted": Spec(0x1202, land="tilted", water="ponds", rows=2, things=6),
    "cliff": Spec(
        0x11FC, land="cliff", columns=2, rows=2, houses=(Ground("hut", 1, (66.0, 70.0), yaw=135),), things=6
    ),
    "rough": Spec(0xB4A9, land="rough", water="ponds", columns=2, things=8),
    "sea": Spec(_TOWN, water="sea", columns=2, houses=(Ground("hut", 1, (12.0, 100.0)),), things=4),
    "shallows": Spec(_TOWN, land="flat", water="ponds", rows=2, things=4),
    "first-block": Spec(
        0x0000, land="rolling", columns=2, rows=2, houses=(Ground("hut", 0, (3.0, 3.0), yaw=15),), things=4
    ),
    "last-block": Spec(
        _NORTH_EAST, land="rolling", houses=(Ground("hut", 0, (189.0, 189.0), yaw=300),), things=4
    ),
    "no-land": Spec(_TOWN, columns=0, houses=(Ground("cottage", 0, (108.0, 84.0), yaw=5),), things=3),
}
"""Every site by its name, the simplest first: random queries shrink towards it."""
SITES: Final = tuple(_SPECS)


@cache
def site(name: str) -> Site:
    """Make a site; asked again, it is the same one."""
    spec = _SPECS[name]
    houses = [_put_up(spec, ground, number) for number, ground in enumerate(spec.houses)]
    level = {vertex: z for house in houses for vertex, z in house.level.items()}
    geometries = {shape.name: shape for house in houses for shape in house.geometries()}
    world: dict[str, Any] = {
        "kind": "world",
        "name": name,
        "landblocks": [landblock(block, spec.land, spec.water, level) for block in _blocks(spec)],
        "cells": [cell for house in houses for cell in house.cells(short_stab=spec.short_stab)],
        "buildings": [house.building for house in houses if house.building is not None],
        "objects": [],
        "shadow": {},
    }
    world = read_block(furnished(world, geometries, spec.things))
    return Site(
        world,
        {**geometries, **thing_geometries()},
        frozenset(_blocks(spec)),
        frozenset(cell["id"] for cell in world["cells"]),
    )


def _blocks(spec: Spec) -> list[int]:
    """Return the ids of the landblocks that are loaded, column by column."""
    return [spec.block + (column << 8) + row for column in range(spec.columns) for row in range(spec.rows)]


def _put_up(spec: Spec, ground: Ground, number: int) -> House:
    block = (_blocks(spec) or [spec.block])[ground.block]
    x, y = ground.origin
    vertex = global_vertex(block, round(x / CELL), round(y / CELL))
    return put_up(ground, block, number, height_at(spec.land, vertex))
