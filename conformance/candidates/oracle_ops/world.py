"""World records of FORMAT.md, as an oracle world: landblocks are made when they are first looked at."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, Final

from conformance.candidates.kept_worlds import KeptWorlds
from conformance.candidates.oracle_ops.geometry import oracle_geometry
from conformance.candidates.oracle_ops.objects import physics_object
from conformance.candidates.oracle_ops.values import position, vector
from oracle.arithmetic import f32
from oracle.building import BldPortal, BuildingObj
from oracle.env_cell import CellPortal, CellStruct, EnvCell
from oracle.land_block import LandBlock
from oracle.land_defs import SIDE_CELLS, WHOLE_BLOCK, adjust_to_outside
from oracle.landscape import Landscape
from oracle.physics_part import PartArray, PhysicsPart
from oracle.polygon import Polygon
from oracle.vector import Vector3
from oracle.world import World

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Sequence

    from conformance.scenes.model import Geometry
    from oracle.obj_cell import Restriction
    from oracle.physics_object import PhysicsObj
    from oracle.plane import Plane

VERTICES: Final = 81
"""Vertices of a landblock."""


def oracle_world(record: Mapping[str, Any], geometries: Mapping[str, Geometry]) -> World:
    """Return the oracle's form of a world record, which a query may look at but not change."""
    return CACHE.world_of(record, geometries)


def build_world(record: Mapping[str, Any], geometries: Mapping[str, Geometry]) -> World:
    """Make a world of its own of a record.

    Parameters
    ----------
    record : Mapping
        A WORLD of FORMAT.md, numbers exact.
    geometries : Mapping of str to Geometry
        Those that cells, buildings and objects name.
    """
    return world_and_objects(record, geometries)[0]


def world_and_objects(
    record: Mapping[str, Any], geometries: Mapping[str, Geometry]
) -> tuple[World, Callable[[int], PhysicsObj]]:
    """Make a world of its own, and what returns its objects by their ids; see `build_world`."""
    world = World()
    things = _Things(record, geometries, world)
    for block in record["cells"]:
        world.add_cell(_env_cell(block, things))
    world.landscape = Landscape(_Blocks(record, things))
    return world, things.named


CACHE: KeptWorlds[World] = KeptWorlds(build_world)
"""What has been built; a candidate whose worlds differ from retail's swaps in its own."""


class _Things:
    """The objects of a record by id, made when they are first asked for."""

    def __init__(self, record: Mapping[str, Any], geometries: Mapping[str, Geometry], world: World) -> None:
        self.geometries = geometries
        self.world = world
        self._blocks = {block["id"]: block for block in record["objects"]}
        self._made: dict[int, PhysicsObj] = {}
        self._shadow = {int(cell_id): ids for cell_id, ids in record["shadow"].items()}
        self._restricted = {int(cell_id): one for cell_id, one in record.get("restrictions", {}).items()}

    def in_cell(self, cell_id: int) -> list[PhysicsObj]:
        """Return a cell's shadow list, made anew of the same objects."""
        return [self.named(object_id) for object_id in self._shadow.get(cell_id, ())]

    def restriction(self, cell_id: int) -> Restriction | None:
        """Return what a cell asks of those who want to enter, if it is a house's."""
        block = self._restricted.get(cell_id)
        return None if block is None else _restriction(block)

    def named(self, object_id: int) -> PhysicsObj:
        """Return an object."""
        made = self._made.get(object_id)
        if made is None:
            made = physics_object(self._blocks[object_id], self.geometries, self.world)
            self._made[object_id] = made
        return made


class _Blocks(Mapping[int, LandBlock]):
    """The landblocks of a record by their 16-bit id, generated when they are first asked for."""

    def __init__(self, record: Mapping[str, Any], things: _Things) -> None:
        self._records = {block["block"]: block for block in record["landblocks"]}
        self._things = things
        self._buildings: dict[int, list[Mapping[str, Any]]] = defaultdict(list)
        for building in record["buildings"]:
            listed = building.get("block")
            self._buildings[_block_under(building) if listed is None else listed].append(building)
        self._made: dict[int, LandBlock] = {}

    def __getitem__(self, block_id: int) -> LandBlock:
        made = self._made.get(block_id)
        if made is None:
            made = self._made[block_id] = self._make(self._records[block_id])
        return made

    def __iter__(self) -> Iterator[int]:
        return iter(self._records)

    def __len__(self) -> int:
        return len(self._records)

    def _make(self, record: Mapping[str, Any]) -> LandBlock:
        things = self._things
        block = land_block(record, things.world)
        block.init_buildings(_building(item, things) for item in self._buildings[record["block"]])
        for cell in block.cells:
            cell.shadow_object_list = things.in_cell(cell.id)
            cell.restriction = things.restriction(cell.id)
        return block


def land_block(record: Mapping[str, Any], world: World) -> LandBlock:
    """Make a landblock of a record, whose heights are its own height table."""
    block_id = record["block"] << 16 | WHOLE_BLOCK
    heights = [f32(z) for z in record["heights"]]
    terrain = record.get("terrain") or (0,) * VERTICES
    block = LandBlock(world, block_id, range(VERTICES), terrain, heights)
    block.side_cell_count = record.get("side_cell_count", SIDE_CELLS)
    block.generate()
    return block


def _block_under(building: Mapping[str, Any]) -> int:
    """Return the 16-bit id of the block that a building's origin is in; 0xFFFF, which is none, without."""
    p = position(building["pose"])
    found, cell_id = adjust_to_outside(p.objcell_id, p.frame.origin)
    return cell_id >> 16 if found else WHOLE_BLOCK


def _building(record: Mapping[str, Any], things: _Things) -> BuildingObj:
    """Make a building, its pose in the block that its origin is in."""
    pose = position(record["pose"])
    parts: PartArray | None = None
    if record["geometry"] is not None:
        gfxobj = oracle_geometry(things.geometries[record["geometry"]]).gfx_obj
        one = Vector3(1.0, 1.0, 1.0)
        parts = PartArray([PhysicsPart(gfxobj, pose.copy(), one)], None, one)
    portals = [BldPortal(portal["other"], portal["other_portal"]) for portal in record["portals"]]
    return BuildingObj(pose, parts, portals, things.world)


def _env_cell(record: Mapping[str, Any], things: _Things) -> EnvCell:
    """Make an interior cell with its objects."""
    built = oracle_geometry(things.geometries[record["geometry"]])
    cell = EnvCell(
        record["id"],
        position(record["pose"]),
        CellStruct(built.tree, built.cell_tree),
        things.world,
        portals=None if record["portals"] is None else [_portal(portal) for portal in record["portals"]],
    )
    cell.stab_list = tuple(record["stab"])
    cell.shadow_object_list = things.in_cell(cell.id)
    cell.restriction = things.restriction(cell.id)
    return cell


def _restriction(block: Mapping[str, Any]) -> Restriction:
    """Make the question of a restricted cell; without its restriction object nobody is answered."""
    known, admitted = block.get("object", 1), frozenset(block.get("admits", ()))
    return lambda weenie: weenie.id in admitted if known else None


def _portal(record: Mapping[str, Any]) -> CellPortal:
    return CellPortal(record["other"], record["side"], _plane_of(record["polygon"]))


def _plane_of(corners: Sequence[Sequence[float]]) -> Plane:
    return Polygon([vector(corner) for corner in corners]).plane
