"""Small oracle worlds for tests: a floor, cells that answer from a script, movers at rest."""

from __future__ import annotations

from typing import TYPE_CHECKING

from oracle.arithmetic import f32
from oracle.bsp_leaf import BSPLeaf
from oracle.bsp_tree import BSPTree
from oracle.env_cell import CellStruct, EnvCell
from oracle.frame import Frame
from oracle.obj_cell import ObjCell
from oracle.physics_object import PhysicsObj
from oracle.physics_part import PartArray, Setup
from oracle.physics_state import GRAVITY_PS
from oracle.polygon import Polygon
from oracle.position import Position
from oracle.sphere import Sphere
from oracle.transition import Transition
from oracle.vector import Vector3
from oracle.world import World

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Sequence

    from oracle.cell_array import CellArray
    from oracle.enums import TransitionState
    from oracle.physics_part import PhysicsPart
    from oracle.sphere_path import SpherePath

Corner = tuple[float, float, float]

CELL = 0xA9B40111
"""An interior cell; its landblock is 0xA9B4."""
OTHER_CELL = 0xA9B40112
RADIUS = f32(0.48)
FLOOR: tuple[Corner, ...] = ((-5.0, -5.0, 0.0), (5.0, -5.0, 0.0), (5.0, 5.0, 0.0), (-5.0, 5.0, 0.0))
"""A square floor of 10 metres at z = 0, facing up."""
WALL: tuple[Corner, ...] = ((1.0, -5.0, 0.0), (1.0, -5.0, 3.0), (1.0, 5.0, 3.0), (1.0, 5.0, 0.0))
"""A wall at x = 1 that faces -x."""


def vec(x: float, y: float, z: float) -> Vector3:
    """Return a vector of float32 numbers."""
    return Vector3(f32(x), f32(y), f32(z))


def xyz(v: Vector3) -> tuple[float, float, float]:
    """Return a vector's components."""
    return v.x, v.y, v.z


def at(x: float, y: float, z: float, cell: int = CELL) -> Position:
    """Return an unrotated position."""
    return Position(cell, Frame.unpack(vec(x, y, z), 1.0, 0.0, 0.0, 0.0))


def polygon(corners: Iterable[Corner], poly_id: int = 0) -> Polygon:
    """Return a polygon."""
    return Polygon([vec(*corner) for corner in corners], poly_id)


def tree(*shapes: Iterable[Corner]) -> BSPTree:
    """Return a physics tree of one leaf, not solid, that holds polygons."""
    polygons = [polygon(corners, i) for i, corners in enumerate(shapes)]
    return BSPTree(BSPLeaf(0, 0, Sphere(Vector3(), 100.0), polygons))


def world_of(*shapes: Iterable[Corner]) -> World:
    """Return a world of one unbounded cell with these polygons."""
    world = World()
    structure = CellStruct(tree(*shapes) if shapes else None, None)
    world.add_cell(EnvCell(CELL, at(0.0, 0.0, 0.0), structure, world, portals=()))
    return world


class ScriptedCell(ObjCell):
    """A cell that answers each test from a list, and may do something to the transition first."""

    def __init__(
        self,
        answers: Iterable[TransitionState],
        *,
        cell_id: int = CELL,
        acts: Iterable[Callable[[Transition], None]] = (),
    ) -> None:
        super().__init__(cell_id, at(0.0, 0.0, 0.0, cell_id))
        self.answers = list(answers)
        self.acts = list(acts)
        self.origins: list[tuple[float, float, float]] = []
        self.neighbours: list[ObjCell] = []

    def find_collisions(self, transition: Transition) -> TransitionState:
        """Give the next answer; the check position is noted."""
        self.origins.append(xyz(transition.sphere_path.check_pos.frame.origin))
        if self.acts:
            self.acts.pop(0)(transition)
        return self.answers.pop(0)

    def point_in_cell(self, point: Vector3) -> int:
        """Contain everything."""
        return 1

    def find_transit_cells(
        self,
        p: Position,
        num_sphere: int,
        spheres: Sequence[Sphere],
        array: CellArray,
        path: SpherePath | None,
    ) -> None:
        """Add the neighbours, whatever the spheres."""
        for cell in self.neighbours:
            array.add_cell(cell.id, cell)

    def find_transit_cells_of_parts(self, parts: Sequence[PhysicsPart | None], array: CellArray) -> None:
        """Add the neighbours, whatever the parts."""
        for cell in self.neighbours:
            array.add_cell(cell.id, cell)


class ScriptedWorld(World):
    """A world of scripted cells."""

    def __init__(self, *cells: ScriptedCell) -> None:
        super().__init__()
        self.scripted = {cell.id: cell for cell in cells}

    def get_visible(self, cell_id: int) -> ObjCell | None:
        """Return the scripted cell."""
        return self.scripted.get(cell_id)


def mover(state: int = GRAVITY_PS, *, step_up: float = 0.6, step_down: float = 1.5) -> PhysicsObj:
    """Return a moving object."""
    setup = Setup(step_up_height=f32(step_up), step_down_height=f32(step_down))
    parts = PartArray([], setup, vec(1.0, 1.0, 1.0))
    return PhysicsObj(7, state, at(0.0, 0.0, 0.0), scale=1.0, part_array=parts)


def transition(
    world: World,
    begin: Position | None,
    end: Position,
    *,
    state: int = 0,
    spheres: Sequence[tuple[float, float]] = ((0.0, RADIUS),),
    moving: PhysicsObj | None = None,
) -> Transition:
    """Return a transition from `begin` to `end` in the cell of `end`, check position at the beginning.

    `spheres` are height of the centre and radius, metres.
    """
    made = Transition(world, trace=[])
    made.init_object(mover() if moving is None else moving, state)
    made.init_sphere(len(spheres), [Sphere(vec(0.0, 0.0, z), f32(r)) for z, r in spheres], 1.0)
    made.init_path(world.get_visible(end.objcell_id), begin, end)
    sp = made.sphere_path
    sp.set_check_pos(sp.curr_pos, sp.curr_cell)
    return made


def trace_of(made: Transition) -> str:
    """Return what the transition has asked of BSP trees."""
    return "".join(made.trace or ())
