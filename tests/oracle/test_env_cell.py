"""CEnvCell: environment before objects, containment, and transit through portals."""

from __future__ import annotations

from contextlib import nullcontext

import pytest
from oracle_worlds import CELL, FLOOR, OTHER_CELL, at, trace_of, transition, tree, vec, world_of

from oracle.arithmetic import f32
from oracle.bsp_node import BSPNode
from oracle.bsp_tree import BSPTree
from oracle.cell_array import CellArray
from oracle.constants import CELL_SLACK, EPS
from oracle.enums import CONTACT_OI, IS_PLAYER, InsertType, TransitionState
from oracle.env_cell import CellPortal, CellStruct, EnvCell
from oracle.errors import NotPortedError
from oracle.frame import Frame
from oracle.physics_object import PhysicsObj
from oracle.physics_part import GfxObj, PartArray, PhysicsPart
from oracle.physics_state import HAS_PHYSICS_BSP_PS, STATIC_PS
from oracle.plane import Plane
from oracle.sphere import Sphere
from oracle.weenie import Weenie
from oracle.world import World

OK, COLLIDED = TransitionState.OK, TransitionState.COLLIDED
RADIUS = 0.5


def half_space() -> CellStruct:
    """Return a structure that contains x >= 0."""
    node = BSPNode(Plane(vec(1.0, 0.0, 0.0), 0.0), Sphere(vec(0.0, 0.0, 0.0), 0.0), None, None)
    return CellStruct(None, BSPTree(node))


def cell(
    world: World,
    *portals: CellPortal,
    cell_id: int = CELL,
    x: float = 0.0,
    structure: CellStruct | None = None,
) -> EnvCell:
    """Load a cell."""
    made = EnvCell(cell_id, at(x, 0.0, 0.0, cell_id), structure or half_space(), world, portals=portals)
    world.add_cell(made)
    return made


def reached(one: EnvCell, x: float) -> list[tuple[int, bool]]:
    """Return the ids that a sphere of half a metre at `x` adds, and whether they are loaded."""
    array = CellArray()
    one.find_transit_cells(at(0.0, 0.0, 0.0), 1, [Sphere(vec(x, 0.0, 0.0), RADIUS)], array)
    return [(entry.cell_id, entry.cell is not None) for entry in array.cells]


def test_the_environment_comes_before_the_objects() -> None:
    """09 3.3: an object is only asked if the environment said OK."""
    world, pose = world_of(FLOOR), at(0.0, 0.0, 3.0)
    one = vec(1.0, 1.0, 1.0)
    parts = PartArray([PhysicsPart(GfxObj(tree(FLOOR)), pose, one)], None, one)
    shelf = PhysicsObj(1, HAS_PHYSICS_BSP_PS | STATIC_PS, pose, scale=1.0, part_array=parts)
    world.cells[CELL].shadow_object_list = [shelf]
    for z, result, trace in ((0.25, COLLIDED, "P2"), (3.25, COLLIDED, "P1P2"), (1.5, OK, "P1P1")):
        made = transition(world, None, at(0.0, 0.0, z))
        made.sphere_path.insert_type = InsertType.PLACEMENT
        assert world.cells[CELL].find_collisions(made) == result
        assert trace_of(made) == trace


@pytest.mark.parametrize(("state", "environment"), [(0, 1), (CONTACT_OI, 0)])
def test_a_hit_in_the_air_is_a_hit_of_the_environment(state: int, environment: int) -> None:
    """09 3.4.3: only without contact is collided_with_environment set; ethereal is cleared first."""
    made = transition(world_of(FLOOR), None, at(0.0, 0.0, 0.25), state=state)
    made.sphere_path.insert_type = InsertType.PLACEMENT
    made.sphere_path.obstruction_ethereal = 1
    assert made.world.cells[CELL].find_env_collisions(made) == COLLIDED
    assert made.collision_info.collided_with_environment == environment
    assert made.sphere_path.obstruction_ethereal == 0


def test_a_cell_without_geometry_is_free() -> None:
    """09 3.4.3: no physics BSP, nothing tested, nothing cached."""
    made = transition(world_of(), None, at(0.0, 0.0, 0.25))
    assert made.world.cells[CELL].find_env_collisions(made) == OK
    assert (trace_of(made), made.sphere_path.localspace_pos.objcell_id) == ("", 0)


def test_an_initial_placement_inserts() -> None:
    """09 3.4.3: insert type 2 calls the tree's placement insert."""
    made = transition(world_of(FLOOR), None, at(0.0, 0.0, 5.0))
    made.sphere_path.insert_type = InsertType.INITIAL_PLACEMENT
    assert made.world.cells[CELL].find_env_collisions(made) == OK
    assert trace_of(made) == "I1"


def test_a_refused_entry_is_a_collision() -> None:
    """09 3.4.1: nothing of the geometry is tested."""
    made = transition(world_of(FLOOR), None, at(0.0, 0.0, 5.0), state=IS_PLAYER)
    made.object_info.mover().weenie_obj = Weenie(is_player=True)
    made.world.cells[CELL].restriction = lambda _: False
    assert made.world.cells[CELL].find_collisions(made) == COLLIDED
    assert trace_of(made) == ""


def test_containment_is_asked_in_cell_space() -> None:
    """09 4.1: the point goes through the cell's pose, down to -EPS; without portals there is no inside."""
    one = cell(World(), x=10.0)
    assert one.point_in_cell(vec(10.0, 0.0, 0.0)) == 1
    assert one.point_in_cell(vec(9.5, 0.0, 0.0)) == 0
    assert one.structure.point_in_cell(vec(-EPS, 0.0, 0.0)) == 1
    one.portals = None
    assert one.point_in_cell(vec(10.0, 0.0, 0.0)) == 0


@pytest.mark.parametrize(("x", "inside"), [(-0.5, True), (-0.5 - CELL_SLACK * 1.01, False)])
def test_a_loaded_neighbour_is_reached_through_its_own_cell_tree(x: float, inside: bool) -> None:
    """09 4.2 B: the sphere, enlarged by the slack, must reach into the other cell."""
    world = World()
    one = cell(world, CellPortal(OTHER_CELL, 0, None))
    cell(world, cell_id=OTHER_CELL)
    assert reached(one, f32(x)) == ([(OTHER_CELL, True)] if inside else [])


@pytest.mark.parametrize(
    ("side", "x", "inside"),
    [(1, -0.6, False), (1, -0.4, True), (1, 9.0, True), (0, 0.6, False), (0, 0.4, True), (0, -9.0, True)],
)
def test_an_unloaded_neighbour_is_reached_through_the_portal_plane(side: int, x: float, inside: bool) -> None:
    """09 4.2 C: by the side of the portal, enlarged by EPS; it is listed without a cell."""
    one = cell(World(), CellPortal(OTHER_CELL, side, Plane(vec(1.0, 0.0, 0.0), 0.0)))
    assert reached(one, x) == ([(OTHER_CELL, False)] if inside else [])


def test_an_exterior_portal_that_is_touched_is_not_ported() -> None:
    """09 4.2 A: away from the plane nothing happens, on it land cells would be needed."""
    one = cell(World(), CellPortal(None, 0, Plane(vec(1.0, 0.0, 0.0), 0.0)))
    assert reached(one, 2.0) == []
    with pytest.raises(NotPortedError, match=r"09 6\.4"):
        reached(one, 0.25)


@pytest.mark.parametrize("side", [1.0, -1.0])
@pytest.mark.parametrize(("gap", "touched"), [(0.499, True), (0.501, False)])
def test_an_exterior_portal_is_asked_in_the_space_of_its_cell(side: float, gap: float, touched: bool) -> None:
    """09 4.2 A: the point is taken through the cell's rotation; both sides of the plane are touched."""
    one = cell(World(), CellPortal(None, 0, Plane(vec(0.48, 0.6, 0.64), 0.0)))
    one.pos.frame.assign(Frame.unpack(vec(7.0, 3.0, 9.0), f32(0.8), f32(0.36), f32(0.48), 0.0))
    center = one.pos.frame.localtoglobal(vec(side * gap * 0.48, side * gap * 0.6, side * gap * 0.64))
    expectation = pytest.raises(NotPortedError) if touched else nullcontext()
    with expectation:
        one.find_transit_cells(at(0.0, 0.0, 0.0), 1, [Sphere(center, RADIUS)], CellArray())


def test_an_exterior_portal_exactly_a_radius_and_eps_away_is_not_touched() -> None:
    """09 4.2 A: both comparisons are strict, with the radius rounded to float32."""
    one = cell(World(), CellPortal(None, 0, Plane(vec(1.0, 0.0, 0.0), 0.0)))
    assert reached(one, f32(RADIUS + EPS)) == []
    assert reached(one, -f32(RADIUS + EPS)) == []


def test_a_portal_whose_plane_is_needed_must_have_one() -> None:
    """A portal that only names a cell is enough as long as that cell is loaded."""
    one = cell(World(), CellPortal(OTHER_CELL, 0, None))
    with pytest.raises(ValueError, match="needs its plane"):
        reached(one, 0.0)


def test_only_interior_cells_are_visible() -> None:
    """The world finds loaded interior cells; land cells and unknown ids are None."""
    world = World()
    one = cell(world)
    assert world.get_visible(CELL) is one
    assert world.get_visible(OTHER_CELL) is None
    assert world.get_visible(0xA9B40001) is None
