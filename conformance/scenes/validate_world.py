"""Checks of worlds at the boundary: landblocks, cells with portals, buildings, objects, shadow lists."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Final

from conformance.scenes.errors import SceneError
from conformance.scenes.validate import geometry_errors, pose_errors
from conformance.scenes.validate_numbers import number_errors, show
from conformance.scenes.validate_objects import object_errors, shadow_errors
from conformance.scenes.validate_polygons import polygon_errors
from conformance.scenes.world_model import SIDE_CELLS, VERTEX_COUNT, is_interior
from oracle.constants import BLOCK_EDGE, CELL_EDGE, EPS

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from conformance.scenes.model import Geometry
    from conformance.scenes.world_model import Building, InteriorCell, LandBlock, World

__all__ = ["arrangement_errors", "check_world", "world_errors"]

HIGHEST: Final = 800.0
"""The greatest height that retail's height table may hold, metres; the least is 0 (10 1.)."""
BLOCKS: Final = range(255)
"""Block indices in x and in y (10 1.)."""
TERRAIN_WORDS: Final = range(1 << 16)
BLOCK_CELLS: Final = int(BLOCK_EDGE // CELL_EDGE)
"""Land cells along a landblock's edge."""
DETAILS: Final = (SIDE_CELLS, 4, 2, 1)
"""Cells along the edge of a landblock, by its distance from the viewer (10 4.1)."""
LAND_CELLS: Final = range(1, SIDE_CELLS * SIDE_CELLS + 1)
"""Low words of land cells (10 1.)."""
_BYTE: Final = 0xFF


def check_world(world: World) -> None:
    """Raise the first error of a world."""
    for error in world_errors(world):
        raise error


def world_errors(world: World) -> Iterator[SceneError]:
    """Yield everything that is wrong with a world; a geometry is reported where it is used first.

    Parameters
    ----------
    world : World
        Paths are those of its record, like ``cells[0].portals[1].polygon``.
    """
    if not world.landblocks and not world.cells:
        yield SceneError("cells", "neither a landblock nor a cell", "something to be in")
    yield from arrangement_errors(world)
    yield from shadow_errors(world)
    seen: set[int] = set()
    for geometry, path in _geometries(world):
        if id(geometry) not in seen:
            seen.add(id(geometry))
            yield from geometry_errors(geometry, path)


def arrangement_errors(world: World) -> Iterator[SceneError]:
    """Yield what is wrong with a world but for its geometries and its shadow lists."""
    yield from _block_errors(world.landblocks)
    yield from _cell_errors(world.cells)
    yield from _building_errors(world)
    yield from object_errors(world)
    yield from _restriction_errors(world)


def _block_errors(blocks: Iterable[LandBlock]) -> Iterator[SceneError]:
    ids: set[int] = set()
    for n, block in enumerate(blocks):
        path = f"landblocks[{n}]"
        if block.block >> 8 not in BLOCKS or block.block & _BYTE not in BLOCKS:
            yield SceneError(
                f"{path}.block", f"0x{block.block:04X}", "a block from 0x0000 to 0xFEFE, no byte FF"
            )
        if block.block in ids:
            yield SceneError(f"{path}.block", f"0x{block.block:04X} twice", "each landblock once")
        ids.add(block.block)
        if block.side_cell_count not in DETAILS:
            expected = f"one of {', '.join(map(str, DETAILS))}"
            yield SceneError(f"{path}.side_cell_count", repr(block.side_cell_count), expected)
        for key, values in (("heights", block.heights), ("terrain", block.terrain)):
            if len(values) != VERTEX_COUNT and (values or key == "heights"):
                yield SceneError(f"{path}.{key}", f"{len(values)} numbers", f"{VERTEX_COUNT} numbers")
        for i, z in enumerate(block.heights):
            if not 0.0 <= z <= HIGHEST:
                yield SceneError(f"{path}.heights[{i}]", f"a height of {z:.9g} m", f"0 to {HIGHEST:g} m")
        for i, word in enumerate(block.terrain):
            if word not in TERRAIN_WORDS:
                yield SceneError(f"{path}.terrain[{i}]", f"the terrain word {word}", "0 to 0xFFFF")


def _cell_errors(cells: tuple[InteriorCell, ...]) -> Iterator[SceneError]:
    ids: set[int] = set()
    for n, cell in enumerate(cells):
        path = f"cells[{n}]"
        if not is_interior(cell.id):
            yield SceneError(f"{path}.id", f"0x{cell.id:08X}", "an interior cell, low word 0x0100 or more")
        if cell.id in ids:
            yield SceneError(f"{path}.id", f"0x{cell.id:08X} twice", "a cell id of its own")
        ids.add(cell.id)
        yield from pose_errors(cell.pose, f"{path}.pose")
        if cell.pose.cell >> 16 != cell.id >> 16:
            found = f"landblock 0x{cell.pose.cell >> 16:04X}"
            yield SceneError(f"{path}.pose.cell", found, "the cell's own landblock")
        if cell.geometry.cell_planes is None:
            yield SceneError(f"{path}.geometry", "no containment planes", "the volume that the cell contains")
        yield from _portal_errors(cell, path)
        for k, seen in enumerate(cell.stab):
            if not is_interior(seen):
                yield SceneError(f"{path}.stab[{k}]", f"0x{seen:08X}", "an interior cell")


def _portal_errors(cell: InteriorCell, path: str) -> Iterator[SceneError]:
    for k, portal in enumerate(cell.portals):
        here = f"{path}.portals[{k}]"
        if portal.other == cell.id:
            yield SceneError(f"{here}.other", f"a portal from 0x{cell.id:08X} to itself", "another cell")
        elif portal.other is not None and not is_interior(portal.other):
            yield SceneError(f"{here}.other", f"0x{portal.other:08X}", "an interior cell, or outdoors")
        elif portal.other is not None and portal.other >> 16 != cell.id >> 16:
            found = f"a portal into landblock 0x{portal.other >> 16:04X}"
            yield SceneError(f"{here}.other", found, "a cell of the same landblock")
        if portal.side not in {0, 1}:
            yield SceneError(f"{here}.side", repr(portal.side), "0 or 1")
        if portal.other_portal not in range(-0x8000, 0x8000):
            yield SceneError(f"{here}.other_portal", repr(portal.other_portal), "a signed 16-bit number")
        for corner in portal.polygon:
            yield from number_errors(corner, f"{here}.polygon")
        yield from polygon_errors(portal.polygon, f"{here}.polygon")


def _building_errors(world: World) -> Iterator[SceneError]:
    """Yield what is wrong with buildings; one that its file lists in another landblock may be anywhere."""
    portals = {cell.id: len(cell.portals) for cell in world.cells}
    blocks = {block.block for block in world.landblocks}
    for n, building in enumerate(world.buildings):
        path = f"buildings[{n}]"
        wrong = list(pose_errors(building.pose, f"{path}.pose"))
        yield from wrong
        if wrong:
            continue
        place = land_cell(building)
        block = (place[0] // BLOCK_CELLS << 8) + place[1] // BLOCK_CELLS
        if building.block is None and block not in blocks:
            found = f"an origin {show(building.pose.origin)} in no loaded landblock"
            yield SceneError(f"{path}.pose.origin", found, "an origin on loaded land")
        elif building.block is not None and building.block not in blocks:
            yield SceneError(f"{path}.block", f"0x{building.block:04X}", "a loaded landblock")
        for k, (cell, portal) in enumerate(building.portals):
            if cell in portals and portal >= portals[cell]:
                found = f"portal {portal} of 0x{cell:08X}"
                yield SceneError(f"{path}.portals[{k}]", found, f"one of its {portals[cell]} portals")


def _restriction_errors(world: World) -> Iterator[SceneError]:
    cells = {cell.id for cell in world.cells}
    blocks = {block.block for block in world.landblocks}
    for cell in world.restrictions:
        on_land = cell >> 16 in blocks and cell & 0xFFFF in LAND_CELLS
        if not on_land and cell not in cells:
            yield SceneError(f"restrictions[{cell}]", f"the cell 0x{cell:08X}", "a cell of this world")


def land_cell(building: Building) -> tuple[int, int]:
    """Return the land cell that holds a building's origin, counted over the whole map from the south-west.

    As retail finds it (LandDefs::adjust_to_outside, 10 2.8), which takes a tiny coordinate for 0.
    """
    block = building.pose.cell >> 16
    x, y = (0.0 if abs(part) < EPS else part for part in building.pose.origin[:2])
    return (
        (block >> 8) * BLOCK_CELLS + math.floor(x / CELL_EDGE),
        (block & _BYTE) * BLOCK_CELLS + math.floor(y / CELL_EDGE),
    )


def _geometries(world: World) -> Iterator[tuple[Geometry, str]]:
    """Yield the geometries of a world and where they are."""
    for n, cell in enumerate(world.cells):
        yield cell.geometry, f"cells[{n}].geometry"
    for n, building in enumerate(world.buildings):
        if building.geometry is not None:
            yield building.geometry, f"buildings[{n}].geometry"
    for n, thing in enumerate(world.objects):
        for k, part in enumerate(thing.parts):
            if part.geometry is not None:
                yield part.geometry, f"objects[{n}].parts[{k}].geometry"
