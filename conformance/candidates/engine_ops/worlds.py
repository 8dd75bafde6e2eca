"""World records of FORMAT.md as worlds of the engine; a record is compiled once."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

from conformance.candidates.engine_ops.obstacles import obstacle
from conformance.candidates.engine_ops.world_cache import engine_pose, engine_shape
from conformance.candidates.kept_worlds import KeptWorlds
from engine.cells import Cell, Portal, Restriction
from engine.landscape import Building, BuildingPortal, LandBlock
from engine.world import World

if TYPE_CHECKING:
    from collections.abc import Mapping

    from conformance.scenes.model import Geometry
    from engine.geometry import Shape
    from engine.objects import Obstacle


def engine_world(record: Mapping[str, Any], geometries: Mapping[str, Geometry]) -> World:
    """Return the engine's form of a world record."""
    return _CACHE.world_of(record, geometries)


def build_world(record: Mapping[str, Any], geometries: Mapping[str, Geometry]) -> World:
    """Compile a world record.

    Parameters
    ----------
    record : Mapping
        A WORLD of FORMAT.md, numbers exact.
    geometries : Mapping of str to Geometry
        Those that cells, buildings and objects name.
    """
    objects = {block["id"]: obstacle(block, geometries) for block in record["objects"]}
    return World(
        [_cell(block, geometries) for block in record["cells"]],
        [land_block(block) for block in record["landblocks"]],
        [_building(block, geometries) for block in record["buildings"]],
        _shadows(record["shadow"], objects),
        restrictions=_restrictions(record.get("restrictions", {})),
    )


_CACHE: Final = KeptWorlds(build_world)


def land_block(record: Mapping[str, Any]) -> LandBlock:
    """Return the engine's form of a landblock record."""
    return LandBlock(
        record["block"], record["heights"], record.get("terrain"), record.get("side_cell_count", 8)
    )


def _shadows(shadow: Mapping[str, list[int]], objects: Mapping[int, Obstacle]) -> dict[int, list[Obstacle]]:
    return {int(cell_id): [objects[thing] for thing in ids] for cell_id, ids in shadow.items()}


def _restrictions(records: Mapping[str, Mapping[str, Any]]) -> dict[int, Restriction]:
    return {
        int(cell_id): Restriction(record.get("admits", ()), is_known=bool(record.get("object", 1)))
        for cell_id, record in records.items()
    }


def _cell(record: Mapping[str, Any], geometries: Mapping[str, Geometry]) -> Cell:
    portals = record["portals"]
    return Cell(
        record["id"],
        engine_pose(record["pose"]),
        _shape(record["geometry"], geometries),
        portals=portals and [Portal(p["other"], p["polygon"], p["side"]) for p in portals],
        stab=record["stab"],
    )


def _shape(name: str | None, geometries: Mapping[str, Geometry]) -> Shape | None:
    return None if name is None else engine_shape(geometries[name])


def _building(record: Mapping[str, Any], geometries: Mapping[str, Geometry]) -> Building:
    portals = [BuildingPortal(portal["other"], portal["other_portal"]) for portal in record["portals"]]
    shape = _shape(record["geometry"], geometries)
    return Building(engine_pose(record["pose"]), shape, portals, record.get("block"))
