"""CPhysicsObj, registration: which list an object gets, and what the cells then hold."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest
from oracle_land import BLOCK, box_part, ids, land, land_cell, land_id, room
from oracle_worlds import at, vec

from oracle.cell_array import CellArray
from oracle.cyl_sphere import CylSphere
from oracle.env_cell import CellPortal
from oracle.physics_object import PhysicsObj
from oracle.physics_part import PartArray, Setup
from oracle.physics_state import HAS_PHYSICS_BSP_PS, PARTICLE_EMITTER_PS, STATIC_PS
from oracle.plane import Plane
from oracle.sphere import Sphere
from oracle.transition import Transition

if TYPE_CHECKING:
    from collections.abc import Sequence

    from oracle.physics_part import PhysicsPart
    from oracle.world import World

HERE, EAST = land_id(3, 3), land_id(4, 3)
HALL = 0xA9B40140
ONE = vec(1.0, 1.0, 1.0)
WIDE = (CylSphere(vec(0.0, 0.0, 0.0), 1.0, 13.0),)
"""A cylinder that reaches over the neighbours from anywhere in a cell."""


def thing(
    world: World,
    setup: Setup | None = None,
    parts: Sequence[PhysicsPart | None] = (),
    *,
    x: float = 84.0,
    state: int = STATIC_PS,
    scale: float = 1.0,
) -> PhysicsObj:
    """Return an object at (x, 84, 0), in its land cell."""
    array = PartArray(parts, setup or Setup(), ONE)
    made = PhysicsObj(7, state, at(x, 84.0, 0.0, HERE), scale=scale, part_array=array, world=world)
    made.cell = world.get_visible(HERE)
    return made


def held(world: World, *columns: int) -> list[list[int]]:
    """Return the ids of the objects in cells of row 3."""
    return [[other.id for other in land_cell(world, i).shadow_object_list] for i in columns]


class TestStatic:
    """08 9.1: calc_cross_cells_static."""

    def test_cylinders(self) -> None:
        """Without a physics BSP they count, by their low points, unscaled."""
        world = land()
        setup = Setup(cylsphere=(CylSphere(vec(11.8, 0.0, 0.0), 1.0, 0.5),))
        array = thing(world, setup, scale=0.1).calc_cross_cells_static()
        assert (ids(array), array.do_not_load_cells) == ([HERE, EAST], 1)
        assert held(world, 2, 3, 4) == [[], [7], [7]]

    def test_parts(self) -> None:
        """With a physics BSP, or without cylinders, the boxes of the parts count."""
        parts = [box_part((95.8, 84.0, 0.0), 0.5)]
        with_bsp = thing(land(), Setup(cylsphere=WIDE), parts, state=STATIC_PS | HAS_PHYSICS_BSP_PS)
        assert ids(with_bsp.calc_cross_cells_static()) == [HERE, EAST]
        assert ids(thing(land(), None, parts).calc_cross_cells_static()) == [HERE, EAST]

    def test_cells_that_are_not_visible_are_left_out(self) -> None:
        """do_not_load_cells: from an interior cell, only what its stab list has."""
        world = land()
        door = CellPortal(None, 0, Plane(vec(1.0, 0.0, 0.0), 0.0))
        hall = room(world, HALL, door, origin=(84.0, 84.0, 0.0))
        inside = thing(world, Setup(cylsphere=WIDE))
        inside.m_position.objcell_id, inside.cell = HALL, hall
        assert ids(inside.calc_cross_cells_static()) == [HALL]
        assert len(inside.calc_cross_cells().cells) == 1 + 9


class TestDynamic:
    """08 9.2: calc_cross_cells."""

    def test_a_physics_bsp_goes_first(self) -> None:
        """The boxes of the parts, not the cylinders."""
        parts = [box_part((84.0, 84.0, 0.0), 0.5)]
        made = thing(land(), Setup(cylsphere=WIDE), parts, state=HAS_PHYSICS_BSP_PS)
        array = made.calc_cross_cells()
        assert (ids(array), array.do_not_load_cells) == ([HERE], 0)

    def test_then_cylinders(self) -> None:
        """13 metres around the low point."""
        setup = Setup(cylsphere=WIDE, sorting_sphere=Sphere(vec(0.0, 0.0, 0.0), 0.5))
        assert len(thing(land(), setup, state=0).calc_cross_cells().cells) == 9

    def test_then_the_sorting_sphere(self) -> None:
        """Unscaled, and the parts do not count."""
        setup = Setup(sorting_sphere=Sphere(vec(11.8, 0.0, 0.0), 0.5))
        made = thing(land(), setup, [box_part((0.0, 84.0, 0.0), 50.0)], state=0, scale=0.1)
        assert ids(made.calc_cross_cells()) == [HERE, EAST]

    @pytest.mark.parametrize(("x", "cells"), [(95.85, [HERE]), (95.95, [HERE, EAST])])
    def test_else_a_small_sphere(self, x: float, cells: list[int]) -> None:
        """Radius 0.1: without a part array, a setup or a sorting sphere."""
        for parts in (None, PartArray((), None, ONE), PartArray((), Setup(), ONE)):
            made = thing(land(), x=x, state=0)
            made.part_array = parts
            assert ids(made.calc_cross_cells()) == cells


class TestBoxes:
    """08 9.3: find_bbox_cell_list."""

    def test_it_goes_on_through_the_cells_it_finds(self) -> None:
        """The land leads into nothing; a hall leads to the exterior, and the land cells follow it."""
        world = land()
        hall = room(
            world, HALL, CellPortal(None, 0, Plane(vec(1.0, 0.0, 0.0), 0.0)), origin=(84.0, 84.0, 0.0)
        )
        made = thing(world, None, [box_part((84.0, 84.0, 0.0), 0.5, cell_id=HALL)])
        made.m_position.objcell_id, made.cell = HALL, hall
        array = CellArray()
        array.do_not_load_cells = array.added_outside = 1
        array.add_cell(1, None)
        made.find_bbox_cell_list(array)
        assert (ids(array), array.do_not_load_cells) == ([HALL, HERE], 1)

    def test_only_its_own_cell(self) -> None:
        """08 9.3.2, 08 9.3.3: it is listed even if it is not loaded, or there are no parts to go by."""
        made, array = thing(land(), None, [box_part((95.8, 84.0, 0.0), 0.5)]), CellArray()
        made.part_array = None
        made.find_bbox_cell_list(array)
        assert ids(array) == [HERE]
        made = thing(land(), None, [box_part((95.8, 84.0, 0.0), 0.5)])
        made.cell = None
        made.find_bbox_cell_list(array)
        assert [(entry.cell_id, entry.cell) for entry in array.cells] == [(HERE, None)]

    def test_cells_that_are_not_loaded_are_passed_over(self) -> None:
        """08 9.3.3: the neighbour in the next block is listed without a cell."""
        made = thing(land(), None, [box_part((191.9, 84.0, 0.0), 0.5)], x=191.9)
        made.m_position.objcell_id, made.cell = land_id(7, 3), made.world.get_visible(land_id(7, 3))
        array = CellArray()
        made.find_bbox_cell_list(array)
        assert [(e.cell_id, e.cell is None) for e in array.cells] == [
            (land_id(7, 3), False),
            (land_id(0, 3, BLOCK + 0x100), True),
        ]


class TestShadows:
    """08 9.4, 08 9.5: what is noted in cells, and taken out again."""

    def test_registering_again_replaces(self) -> None:
        """08 9.1.3: the object is in the cells of the new list only, behind those that are there."""
        world = land()
        moving = thing(world, Setup(sorting_sphere=Sphere(vec(0.0, 0.0, 0.0), 0.5)), state=0, x=95.8)
        moving.calc_cross_cells()
        assert held(world, 3, 4) == [[7], [7]]
        other = thing(world, state=0)
        other.id = 8
        other.calc_cross_cells()
        moving.m_position.frame.origin.x = 84.0
        moving.calc_cross_cells()
        assert held(world, 3, 4) == [[8, 7], []]
        assert [cell_id for cell_id, _ in moving.shadow_objects] == [HERE]

    def test_a_cell_that_is_not_loaded_is_noted(self) -> None:
        """08 9.4.2: without anything to be in."""
        made, array = thing(land()), CellArray()
        array.add_cell(HALL, None)
        made.add_shadows_to_cells(array)
        assert made.shadow_objects == [(HALL, None)]
        made.remove_shadows_from_cells()
        assert made.shadow_objects == []

    def test_particle_emitters(self) -> None:
        """08 9.4.1: only in their own cell, whatever the list says."""
        world, array = land(), CellArray()
        array.add_cell(EAST, land_cell(world, 4))
        thing(world, state=PARTICLE_EMITTER_PS).add_shadows_to_cells(array)
        assert held(world, 3, 4) == [[7], []]

    def test_children(self) -> None:
        """08 9.4.3: in the same cells, and out of them again with their parent."""
        world = land()
        parent, child = thing(world, state=0), thing(world, state=0)
        child.id, child.parent = 8, parent
        parent.children.append(child)
        parent.calc_cross_cells()
        assert held(world, 3) == [[7, 8]]
        parent.remove_shadows_from_cells()
        assert held(world, 3) == [[]]

    def test_the_last_one_moves_forward(self) -> None:
        """08 9.5: a removed object's place is taken by the last; who is not there is not missed."""
        cell = land_cell(land())
        things = [thing(land()) for _ in range(4)]
        for k, made in enumerate(things):
            made.id = k
            cell.add_shadow_object(made)
        cell.remove_shadow_object(things[1])
        assert [made.id for made in cell.shadow_object_list] == [0, 3, 2]
        cell.remove_shadow_object(things[2])
        cell.remove_shadow_object(things[2])
        assert [made.id for made in cell.shadow_object_list] == [0, 3]


class TestWriteBack:
    """06 WB-2, WB-12: a tick registers the object where it ended."""

    def ended(self, made: PhysicsObj, x: float, *, listed: bool = True) -> Transition:
        """Return a finished transition to `x`, whose list has one neighbour more than the object reaches."""
        transition = Transition(made.world)
        transition.sphere_path.curr_cell = made.world.get_visible(HERE)
        transition.sphere_path.curr_pos.assign(at(x, 84.0, 0.0, HERE))
        if listed:
            for cell_id in (HERE, land_id(2, 3)):
                transition.cell_array.add_cell(cell_id, made.world.get_visible(cell_id))
        return transition

    def test_by_the_transition_s_list(self) -> None:
        """As it is, without a new search."""
        made = thing(land(), state=0)
        made.set_position_internal(self.ended(made, 84.0))
        assert held(made.world, 2, 3) == [[7], [7]]

    def test_a_transition_without_a_list(self) -> None:
        """The object stays where it was registered."""
        made = thing(land(), state=0)
        made.calc_cross_cells()
        made.set_position_internal(self.ended(made, 84.0, listed=False))
        assert held(made.world, 2, 3) == [[], [7]]

    def test_a_physics_bsp_is_searched_anew(self) -> None:
        """With its parts, not with the transition's list."""
        parts = [box_part((95.8, 84.0, 0.0), 0.5)]
        made = thing(land(), None, parts, state=HAS_PHYSICS_BSP_PS)
        made.set_position_internal(self.ended(made, 84.0))
        assert held(made.world, 2, 3, 4) == [[], [7], [7]]

    def test_a_lost_object(self) -> None:
        """06 WB-2: it is in no cell any more."""
        made = thing(land(), state=0)
        made.calc_cross_cells()
        transition = self.ended(made, 84.0)
        transition.sphere_path.curr_cell = None
        made.set_position_internal(transition)
        assert (made.cell, made.shadow_objects, held(made.world, 3)) == (None, [], [[]])
