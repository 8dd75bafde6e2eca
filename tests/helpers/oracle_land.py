"""Landblocks, parts and cells of the oracle for tests, with round numbers."""

from __future__ import annotations

from typing import TYPE_CHECKING

from oracle_worlds import at, transition, tree, vec

from oracle.bbox import BBox
from oracle.bsp_node import BSPNode
from oracle.bsp_tree import BSPTree
from oracle.env_cell import CellPortal, CellStruct, EnvCell
from oracle.land_block import LandBlock
from oracle.landscape import Landscape
from oracle.physics_part import GfxObj, PhysicsPart
from oracle.plane import Plane
from oracle.sphere import Sphere
from oracle.world import World

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from oracle_worlds import Corner

    from oracle.cell_array import CellArray
    from oracle.land_cell import LandCell
    from oracle.physics_object import PhysicsObj
    from oracle.transition import Transition

BLOCK = 0xA9B4
"""The landblock of the tests; its first cell is (1352, 1440): 8 * 0xA9 and 8 * 0xB4."""
FIRST_X, FIRST_Y = 1352, 1440
VERTICES = 81
GROUND = 10.0
"""Height of flat land, metres."""
STANDING_RADIUS = 0.5
"""Radius of the sphere of `standing`, metres."""
DRY, WATER = 0, 16 << 2
"""Terrain words of barren rock and of running water: the type is in bits 2 to 6."""


def land_id(i: int, j: int, block: int = BLOCK) -> int:
    """Return the id of a block's cell, column i from the west and row j from the south."""
    return block << 16 | (8 * i + j + 1)


def land_block(
    world: World,
    block: int = BLOCK,
    *,
    heights: Sequence[float] = (GROUND,) * VERTICES,
    terrain: Sequence[int] = (DRY,) * VERTICES,
) -> LandBlock:
    """Return a generated landblock."""
    made = LandBlock(world, block << 16 | 0xFFFF, range(VERTICES), terrain, heights)
    made.generate()
    return made


def land(
    *blocks: int,
    heights: Sequence[float] = (GROUND,) * VERTICES,
    terrain: Sequence[int] = (DRY,) * VERTICES,
) -> World:
    """Return a world of landblocks that are all alike, by default of one."""
    world = World()
    made = {block: land_block(world, block, heights=heights, terrain=terrain) for block in blocks or (BLOCK,)}
    world.landscape = Landscape(made)
    return world


def land_cell(world: World, i: int = 3, j: int = 3, block: int = BLOCK) -> LandCell:
    """Return a land cell; by default the one from (72, 72) to (96, 96)."""
    cell = world.landscape.get_landcell(land_id(i, j, block))
    assert cell is not None
    return cell


def half_space(x: float = 1.0, y: float = 0.0, z: float = 0.0) -> CellStruct:
    """Return a structure that contains what is in front of a plane through its origin."""
    node = BSPNode(Plane(vec(x, y, z), 0.0), Sphere(vec(0.0, 0.0, 0.0), 0.0), None, None)
    return CellStruct(None, BSPTree(node))


def room(
    world: World,
    cell_id: int,
    *portals: CellPortal,
    origin: Corner = (0.0, 0.0, 0.0),
    structure: CellStruct | None = None,
) -> EnvCell:
    """Load an interior cell, by default the half space x >= 0 of its own."""
    pose = at(*origin, cell_id)
    made = EnvCell(cell_id, pose, structure or half_space(), world, portals=portals)
    world.add_cell(made)
    return made


def box_part(
    origin: Corner, half: float, *, radius: float | None = None, cell_id: int = land_id(3, 3)
) -> PhysicsPart:
    """Return a part: a cube of `half` metres to each side, its sphere of that radius unless given."""
    gfxobj = GfxObj(None, bounding_box=BBox(vec(-half, -half, -half), vec(half, half, half)))
    gfxobj.drawing_sphere = Sphere(vec(0.0, 0.0, 0.0), half if radius is None else radius)
    return PhysicsPart(gfxobj, at(*origin, cell_id), vec(1.0, 1.0, 1.0))


def solid_part(origin: Corner, cell_id: int, *shapes: Iterable[Corner]) -> PhysicsPart:
    """Return a part with a physics tree."""
    return PhysicsPart(GfxObj(tree(*shapes)), at(*origin, cell_id), vec(1.0, 1.0, 1.0))


def ids(array: CellArray) -> list[int]:
    """Return the listed ids, in order."""
    return [entry.cell_id for entry in array.cells]


def standing(
    world: World,
    z: float = 0.0,
    *,
    x: float = 84.0,
    y: float = 80.0,
    state: int = 0,
    moving: PhysicsObj | None = None,
    cell: int = land_id(3, 3),
) -> Transition:
    """Return a transition whose sphere of half a metre has its lowest point `z` above the ground."""
    end = at(x, y, GROUND + z, cell)
    return transition(
        world, end, end, state=state, spheres=((STANDING_RADIUS, STANDING_RADIUS),), moving=moving
    )
