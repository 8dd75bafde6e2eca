"""CLandCell: who may enter, what is tested in which order, and where it leads."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest
from oracle_land import (
    BLOCK,
    GROUND,
    box_part,
    ids,
    land,
    land_cell,
    land_id,
    standing,
)
from oracle_worlds import at, mover, trace_of, vec, xyz

from oracle.building import BuildingObj
from oracle.cell_array import CellArray
from oracle.enums import IS_PLAYER, InsertType, TransitionState
from oracle.physics_object import PhysicsObj
from oracle.sphere import Sphere
from oracle.weenie import Weenie

if TYPE_CHECKING:
    from oracle.transition import Transition
    from oracle.world import World

OK, COLLIDED, ADJUSTED = TransitionState.OK, TransitionState.COLLIDED, TransitionState.ADJUSTED
HERE = land_id(3, 3)
EAST = BLOCK + 0x100


class TestRestrictions:
    """09 3.1: a player who may not enter is stopped, with a normal away from the cell."""

    def refused(self, x: float, y: float, *, admits: bool | None = False) -> tuple[TransitionState, object]:
        """Return the answer of the cell, and the collision normal, for a player standing there."""
        world = land(BLOCK, EAST)
        moving = mover()
        moving.weenie_obj = Weenie(is_player=True)
        made = standing(world, x=x, y=y, state=IS_PLAYER, moving=moving)
        cell = land_cell(world)
        cell.restriction = lambda _: admits
        result = cell.find_env_collisions(made)
        ci = made.collision_info
        return result, xyz(ci.collision_normal) if ci.collision_normal_valid else None

    @pytest.mark.parametrize(
        ("x", "y", "normal"),
        [
            (84.0, 71.9, (0.0, -1.0, 0.0)),
            (84.0, 96.1, (0.0, 1.0, 0.0)),
            (71.9, 84.0, (-1.0, 0.0, 0.0)),
            (96.1, 84.0, (1.0, 0.0, 0.0)),
            (84.0, 72.0, (1.0, 0.0, 0.0)),
            (84.0, 96.0, (1.0, 0.0, 0.0)),
            (72.0, 84.0, (1.0, 0.0, 0.0)),
            (60.0, 60.0, (0.0, -1.0, 0.0)),
            (292.0, 84.0, (1.0, 0.0, 0.0)),
        ],
    )
    def test_the_normal_tells_the_side(self, x: float, y: float, normal: tuple[float, ...]) -> None:
        """12 metres from the centre (84, 84) is still inside; y is asked before x, east is the rest."""
        assert self.refused(x, y) == (COLLIDED, normal)

    def test_nobody_there_to_ask(self) -> None:
        """Refused without a normal if what restricts the cell is missing; free if it admits."""
        assert self.refused(84.0, 60.0, admits=None) == (COLLIDED, None)
        assert self.refused(84.0, 84.0, admits=True)[0] == OK


class Blocking(BuildingObj):
    """A building that answers a state and counts."""

    asked = 0

    def __init__(self, world: World, answer: TransitionState) -> None:
        super().__init__(at(84.0, 84.0, GROUND, HERE), None, (), world)
        self.answer = answer

    def find_building_collisions(self, transition: Transition) -> TransitionState:
        """Answer."""
        type(self).asked += 1
        return self.answer


class TestOrder:
    """09 3.5: terrain, building, objects; the first that is in the way ends it."""

    @pytest.mark.parametrize(
        ("z", "building", "result", "asked"),
        [(1.0, OK, COLLIDED, (1, 1)), (1.0, ADJUSTED, ADJUSTED, (1, 0)), (-0.25, COLLIDED, ADJUSTED, (0, 0))],
    )
    def test_the_first_obstacle_ends_it(
        self, z: float, building: TransitionState, result: TransitionState, asked: tuple[int, int]
    ) -> None:
        """How often the building and then the object are asked."""

        class Thing(PhysicsObj):
            asked = 0

            def find_obj_collisions(self, transition: Transition) -> TransitionState:
                Thing.asked += 1
                return COLLIDED

        made = standing(land(), z)
        cell = land_cell(made.world)
        Blocking.asked = 0
        cell.add_building(Blocking(made.world, building))
        cell.add_shadow_object(Thing(9, 0, at(0.0, 0.0, 0.0), scale=1.0, part_array=None))
        assert cell.find_collisions(made) == result
        assert (Blocking.asked, Thing.asked) == asked

    def test_nothing_in_the_way(self) -> None:
        """Without building and objects a cell is its terrain; initial placements skip the objects."""
        made = standing(land(), 1.0)
        assert land_cell(made.world).find_collisions(made) == OK
        made.sphere_path.insert_type = InsertType.INITIAL_PLACEMENT
        assert land_cell(made.world).find_collisions(made) == OK
        assert trace_of(made) == "T1T1"


class TestTransit:
    """09 6.3: first the land around, then the rooms of the building."""

    def test_of_spheres(self) -> None:
        """The building adds its rooms after the land cells."""
        world = land()
        array, cell = CellArray(), land_cell(world)
        cell.add_building(Doors(world))
        cell.find_transit_cells(at(0.0, 0.0, 0.0, HERE), 1, [Sphere(vec(95.8, 84.0, 0.0), 0.5)], array, None)
        assert ids(array) == [HERE, land_id(4, 3), 0xA9B40177]

    def test_of_parts(self) -> None:
        """The same for an object's parts."""
        world = land()
        array, cell = CellArray(), land_cell(world)
        cell.add_building(Doors(world))
        cell.find_transit_cells_of_parts([box_part((95.8, 84.0, 0.0), 0.5)], array)
        assert ids(array) == [HERE, land_id(4, 3), 0xA9B40178]

    def test_without_a_building(self) -> None:
        """Only land cells."""
        array, cell = CellArray(), land_cell(land())
        cell.find_transit_cells(at(0.0, 0.0, 0.0, HERE), 1, [Sphere(vec(84.0, 84.0, 0.0), 0.5)], array, None)
        cell.find_transit_cells_of_parts([box_part((84.0, 84.0, 0.0), 0.5)], array)
        assert ids(array) == [HERE]


class Doors(BuildingObj):
    """A building whose rooms are always reached."""

    def __init__(self, world: World) -> None:
        super().__init__(at(84.0, 84.0, GROUND, HERE), None, (), world)

    def find_building_transit_cells(self, *args: object) -> None:
        """Add a room."""
        array = args[3]
        assert isinstance(array, CellArray)
        array.add_cell(0xA9B40177, None)

    def find_building_transit_cells_of_parts(self, parts: object, array: CellArray) -> None:
        """Add another room."""
        array.add_cell(0xA9B40178, None)
