"""CObjCell: who may enter, objects in order, and the lists of cells."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest
from oracle_worlds import CELL, OTHER_CELL, ScriptedCell, ScriptedWorld, at, mover, transition

from oracle.cell_array import CellArray
from oracle.enums import IS_PLAYER, InsertType, TransitionState
from oracle.errors import NotPortedError
from oracle.obj_cell import ObjCell, find_cell_list
from oracle.physics_object import PhysicsObj
from oracle.ref import Ref
from oracle.weenie import Weenie

if TYPE_CHECKING:
    from oracle.transition import Transition

OK, COLLIDED, SLID = TransitionState.OK, TransitionState.COLLIDED, TransitionState.SLID


class Scripted(PhysicsObj):
    """An object that answers a fixed state, and counts."""

    def __init__(self, answer: TransitionState, parent: PhysicsObj | None = None) -> None:
        super().__init__(2, 0, at(0.0, 0.0, 0.0), scale=1.0, part_array=None, parent=parent)
        self.answer = answer
        self.asked = 0

    def find_obj_collisions(self, transition: Transition) -> TransitionState:
        """Answer."""
        assert transition.object_info.object is not None
        self.asked += 1
        return self.answer


def in_cell() -> tuple[Transition, ScriptedCell]:
    """Return a transition in one cell."""
    cell = ScriptedCell([])
    return transition(ScriptedWorld(cell), at(0.0, 0.0, 1.0), at(1.0, 0.0, 1.0)), cell


def test_objects_are_tested_in_order_until_one_blocks() -> None:
    """09 3.2.2."""
    made, cell = in_cell()
    objects = [Scripted(OK), Scripted(SLID), Scripted(COLLIDED)]
    cell.shadow_object_list = list(objects)
    assert cell.find_obj_collisions(made) == SLID
    assert [thing.asked for thing in objects] == [1, 1, 0]


def test_the_mover_and_attached_objects_are_skipped() -> None:
    """09 3.2.2."""
    made, cell = in_cell()
    attached = Scripted(COLLIDED, parent=mover())
    cell.shadow_object_list = [made.object_info.mover(), attached]
    assert cell.find_obj_collisions(made) == OK
    assert attached.asked == 0


def test_an_initial_placement_ignores_objects() -> None:
    """09 3.2.1."""
    made, cell = in_cell()
    cell.shadow_object_list = [Scripted(COLLIDED)]
    made.sphere_path.insert_type = InsertType.INITIAL_PLACEMENT
    assert cell.find_obj_collisions(made) == OK


@pytest.mark.parametrize(
    ("weenie", "state", "admits", "result"),
    [
        (None, IS_PLAYER, False, OK),
        (Weenie(), IS_PLAYER, None, OK),
        (Weenie(), IS_PLAYER, True, OK),
        (Weenie(), IS_PLAYER, False, COLLIDED),
        (Weenie(), 0, False, OK),
        (Weenie(can_bypass_move_restrictions=True), IS_PLAYER, False, OK),
    ],
)
def test_restricted_cells_refuse_players(
    weenie: Weenie | None, state: int, admits: bool | None, result: TransitionState
) -> None:
    """09 3.1: only players with a game object that may not enter are stopped."""
    made, cell = in_cell()
    made.object_info.mover().weenie_obj = weenie
    made.object_info.state = state
    cell.restriction = None if admits is None else lambda _: bool(admits)
    assert cell.check_entry_restrictions(made) == result


def test_nobody_may_not_enter() -> None:
    """09 3.1: without a mover the entry is refused."""
    made, cell = in_cell()
    made.object_info.object = None
    assert cell.check_entry_restrictions(made) == COLLIDED


def listed(*cells: ScriptedCell, no_load: int = 0, spheres: int = 1) -> tuple[list[int], object]:
    """Return the ids that a search from `CELL` lists, and what it says of the containing cell."""
    world = ScriptedWorld(*cells)
    made = transition(world, at(0.0, 0.0, 1.0), at(0.0, 0.0, 1.0))
    array, found = CellArray(), Ref[ObjCell | None](ScriptedCell([], cell_id=1))
    array.do_not_load_cells = no_load
    path = made.sphere_path
    find_cell_list(world, path.check_pos, spheres, path.global_sphere, array, found, path)
    return [entry.cell_id for entry in array.cells], None if found.value is None else found.value.id


def test_the_search_goes_on_through_neighbours() -> None:
    """09 5.1.5: cells that the loop appends are searched too; the first that contains wins."""
    first, second, third = (ScriptedCell([], cell_id=CELL + i) for i in range(3))
    first.neighbours, second.neighbours = [second], [first, third]
    assert listed(first, second, third) == ([CELL, CELL + 1, CELL + 2], CELL)


def test_a_starting_cell_that_is_not_loaded_is_listed_alone() -> None:
    """09 5.1.4: the containing cell is left as it was; so it is without spheres."""
    assert listed() == ([CELL], 1)
    assert listed(ScriptedCell([]), spheres=0) == ([CELL], 1)


def test_a_search_begins_anew() -> None:
    """09 5.1.1: the list is emptied, and land cells have not been added."""
    made, cell = in_cell()
    array = CellArray()
    array.added_outside = 1
    array.add_cell(1, None)
    find_cell_list(made.world, made.sphere_path.check_pos, 0, [], array, None, None)
    assert ([entry.cell_id for entry in array.cells], array.added_outside) == ([cell.id], 0)


def test_pruning_keeps_what_is_visible_from_the_start() -> None:
    """09 5.1.7: with do_not_load_cells only the start and its stab list stay, order changed by removal."""
    first = ScriptedCell([])
    others = [ScriptedCell([], cell_id=CELL + i) for i in range(1, 4)]
    first.neighbours = list(others)
    first.stab_list = (CELL + 3,)
    assert listed(first, *others, no_load=1) == ([CELL, CELL + 3], CELL)


def test_a_search_from_outdoors_is_not_ported() -> None:
    """09 5.1.3: land cells are a typed error, not an empty list."""
    made, _ = in_cell()
    with pytest.raises(NotPortedError, match=r"09 6\.4"):
        find_cell_list(made.world, at(0.0, 0.0, 0.0, 0xA9B40001), 0, [], CellArray(), None, None)


def test_a_cell_is_named_by_its_id() -> None:
    """The repr helps in failures; interior is decided by the low word."""
    cell = ScriptedCell([], cell_id=OTHER_CELL)
    assert repr(cell) == "ScriptedCell(0xa9b40112)"
    assert cell.is_interior
    assert not ScriptedCell([], cell_id=0xA9B40040).is_interior
