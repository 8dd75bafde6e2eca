"""CEnvCell: environment before objects, containment, and the cells near it."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest
from oracle_land import room
from oracle_worlds import CELL, FLOOR, OTHER_CELL, at, trace_of, transition, tree, vec, world_of

from oracle.constants import EPS
from oracle.enums import CONTACT_OI, IS_PLAYER, InsertType, TransitionState
from oracle.env_cell import CellPortal
from oracle.physics_object import PhysicsObj
from oracle.physics_part import GfxObj, PartArray, PhysicsPart
from oracle.physics_state import HAS_PHYSICS_BSP_PS, STATIC_PS
from oracle.weenie import Weenie
from oracle.world import World

if TYPE_CHECKING:
    from oracle.env_cell import EnvCell

OK, COLLIDED = TransitionState.OK, TransitionState.COLLIDED


def cell(world: World, *portals: CellPortal, cell_id: int = CELL, x: float = 0.0) -> EnvCell:
    """Load a cell, the half space from `x` to the east."""
    return room(world, cell_id, *portals, origin=(x, 0.0, 0.0))


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


def test_only_loaded_cells_are_visible() -> None:
    """09 2: interior cells that are loaded; nothing is loaded for being asked for."""
    world = World()
    one = cell(world)
    assert world.get_visible(CELL) is one
    assert world.get_visible(OTHER_CELL) is None
    assert world.get_visible(0xA9B40001) is None


class TestVisibleChild:
    """09 7: find_visible_child_cell, among half spaces that begin at x = 0, 10 and 20."""

    def found(self, x: float, *, search_stabs: bool, loaded: bool = True) -> int | None:
        """Return the id of the cell that is found at `x` from a cell in which that is not."""
        world = World()
        behind = CELL + 9
        first = cell(world, CellPortal(None, 0, None), CellPortal(OTHER_CELL, 0, None), x=20.0)
        first.stab_list = (behind, CELL + 2)
        if loaded:
            cell(world, cell_id=OTHER_CELL, x=10.0)
            cell(world, cell_id=CELL + 2, x=0.0)
        found = first.find_visible_child_cell(vec(x, 0.0, 0.0), search_stabs=search_stabs)
        return None if found is None else found.id

    @pytest.mark.parametrize("search_stabs", [True, False])
    def test_the_cell_itself_comes_first(self, search_stabs: bool) -> None:
        """09 7.1: though others contain the point too."""
        assert self.found(25.0, search_stabs=search_stabs) == CELL

    def test_visible_cells(self) -> None:
        """09 7.2: those of the stab list that are loaded, and not the neighbours."""
        assert self.found(15.0, search_stabs=True) == CELL + 2

    def test_neighbours(self) -> None:
        """09 7.3: the cells behind the portals, and not the visible ones; the exterior is none."""
        assert self.found(15.0, search_stabs=False) == OTHER_CELL
        assert self.found(5.0, search_stabs=False) is None

    @pytest.mark.parametrize("search_stabs", [True, False])
    def test_nothing(self, search_stabs: bool) -> None:
        """09 7.4: nothing contains the point, or nothing else is loaded."""
        assert self.found(-5.0, search_stabs=search_stabs) is None
        assert self.found(15.0, search_stabs=search_stabs, loaded=False) is None

    def test_without_portals(self) -> None:
        """09 4.1.1: a cell without a portal array contains nothing and leads nowhere."""
        one = cell(World())
        one.portals = None
        assert one.find_visible_child_cell(vec(5.0, 0.0, 0.0), search_stabs=False) is None
