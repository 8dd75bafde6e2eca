"""CBuildingObj: its shell, the flag while that is tested, and the way into its rooms."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest
from oracle_land import box_part, half_space, ids, room, solid_part
from oracle_worlds import FLOOR, at, trace_of, transition, vec

from oracle.building import BldPortal, BuildingObj
from oracle.cell_array import CellArray
from oracle.enums import CONTACT_OI, InsertType, TransitionState
from oracle.env_cell import CellPortal
from oracle.physics_part import PartArray, PhysicsPart
from oracle.plane import Plane
from oracle.sphere import Sphere
from oracle.sphere_path import SpherePath
from oracle.world import World

if TYPE_CHECKING:
    from collections.abc import Sequence

    from oracle.transition import Transition

OK, COLLIDED = TransitionState.OK, TransitionState.COLLIDED
SHELL = 0xA9B4FFFF
HALL, CELLAR = 0xA9B40140, 0xA9B40141
RADIUS = 0.5


def building(world: World, parts: Sequence[PhysicsPart | None] | None, *portals: BldPortal) -> BuildingObj:
    """Return a building at the origin of its block; `parts` None is no part array."""
    one = vec(1.0, 1.0, 1.0)
    array = None if parts is None else PartArray(parts, None, one)
    return BuildingObj(at(0.0, 0.0, 0.0, SHELL), array, portals, world)


def placing(z: float, *, state: int = 0) -> Transition:
    """Return a placement of a sphere of half a metre, its centre `z` above the building's floor."""
    made = transition(World(), None, at(0.0, 0.0, z, 0xA9B40001), state=state, spheres=((0.0, RADIUS),))
    made.sphere_path.insert_type = InsertType.PLACEMENT
    return made


class Watching(PhysicsPart):
    """A part that notes `bldg_check` when it is tested, and collides."""

    def find_obj_collisions(self, transition: Transition) -> TransitionState:
        """Note the flag in `seen`."""
        self.degrade_modes = (transition.sphere_path.bldg_check,)
        return COLLIDED


def watching() -> Watching:
    """Return such a part."""
    return Watching(None, at(0.0, 0.0, 0.0, SHELL), vec(1.0, 1.0, 1.0))


class TestShell:
    """09 3.7: find_building_collisions."""

    @pytest.mark.parametrize(("state", "environment"), [(0, 1), (CONTACT_OI, 0)])
    def test_a_hit(self, state: int, environment: int) -> None:
        """Its letter holds that of the tree; in the air it is a hit of the environment."""
        made = placing(0.25, state=state)
        shell = building(made.world, [solid_part((0.0, 0.0, 0.0), SHELL, FLOOR)])
        assert shell.find_building_collisions(made) == COLLIDED
        assert trace_of(made) == "BP22"
        assert made.collision_info.collided_with_environment == environment
        assert made.collision_info.collide_object == []

    def test_a_miss(self) -> None:
        """Outside of the bounding sphere (radius 100) the tree is not asked; nothing is recorded."""
        made = placing(101.0)
        shell = building(made.world, [solid_part((0.0, 0.0, 0.0), SHELL, FLOOR)])
        assert shell.find_building_collisions(made) == OK
        assert (trace_of(made), made.collision_info.collided_with_environment) == ("B1", 0)

    def test_the_flag_is_set_for_the_test_only(self) -> None:
        """bldg_check is 1 while the part is tested and 0 afterwards, whatever it was."""
        made, part = placing(0.25), watching()
        made.sphere_path.bldg_check = 1
        assert building(made.world, [part]).find_building_collisions(made) == COLLIDED
        assert part.degrade_modes == (1,)
        assert made.sphere_path.bldg_check == 0

    def test_only_the_first_part_collides(self) -> None:
        """The second is not tested, not even if the first is missing."""
        made, second = placing(0.25), watching()
        shell = building(made.world, [None, second])
        assert shell.find_building_collisions(made) == OK
        assert second.degrade_modes == ()

    def test_without_parts(self) -> None:
        """Without a part array there is nothing to hit, and the flag stays."""
        made = placing(0.25)
        made.sphere_path.bldg_check = 1
        assert building(made.world, None).find_building_collisions(made) == OK
        assert made.sphere_path.bldg_check == 1


class TestTransit:
    """09 6.3 and 09 4.4, 09 4.5: each portal's cell is asked, in order."""

    def reached(self, portals: Sequence[BldPortal], x: float) -> tuple[list[int], int]:
        """Return the rooms (x >= 0 each) that a sphere at `x` reaches, and hits_interior_cell."""
        world, array, path = World(), CellArray(), SpherePath()
        room(world, HALL)
        room(world, CELLAR)
        spheres = [Sphere(vec(x, 0.0, 0.0), RADIUS)]
        building(world, None, *portals).find_building_transit_cells(
            at(0.0, 0.0, 0.0, 0xA9B40001), 1, spheres, array, path
        )
        return ids(array), path.hits_interior_cell

    def test_in_the_order_of_the_portals(self) -> None:
        """Both rooms are reached, the second portal's first."""
        portals = BldPortal(CELLAR, 0), BldPortal(HALL, 0)
        assert self.reached(portals, 0.0) == ([CELLAR, HALL], 1)

    def test_a_sphere_that_does_not_reach(self) -> None:
        """0.6 m outside of the wall."""
        assert self.reached([BldPortal(HALL, 0)], -0.6) == ([], 0)

    def test_a_room_without_a_way_back_or_not_loaded(self) -> None:
        """09 4.4.1: a negative portal id; and a cell that is not loaded is passed over, not listed."""
        assert self.reached([BldPortal(HALL, -1), BldPortal(0xA9B40199, 0)], 0.0) == ([], 0)

    def test_of_parts(self) -> None:
        """The parts version asks the same cells with the same portal ids."""
        world, array = World(), CellArray()
        door = CellPortal(None, 0, Plane(vec(1.0, 0.0, 0.0), 0.0))
        room(world, HALL, door, structure=half_space())
        room(world, CELLAR, door, structure=half_space())
        portals = BldPortal(CELLAR, -1), BldPortal(0xA9B40199, 0), BldPortal(HALL, 0)
        building(world, None, *portals).find_building_transit_cells_of_parts(
            [box_part((0.0, 0.0, 0.0), 0.5, cell_id=0xA9B40001)], array
        )
        assert ids(array) == [HALL]
