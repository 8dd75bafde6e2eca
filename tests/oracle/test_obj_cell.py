"""CObjCell: who may enter, objects in order, and the lists of cells."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest
from oracle_worlds import OTHER_CELL, ScriptedCell, ScriptedWorld, at, mover, transition

from oracle.enums import IS_PLAYER, InsertType, TransitionState
from oracle.physics_object import PhysicsObj
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


@pytest.mark.parametrize(("object_id", "mover_id", "asked"), [(7, 7, 0), (7, 8, 1), (0, 0, 1)])
def test_the_mover_is_known_by_its_id_too(object_id: int, mover_id: int, asked: int) -> None:
    """09 3.2.2: retail compares pointers; an object that stands for the mover has its id, and 0 is none."""
    made, cell = in_cell()
    other = Scripted(OK)
    other.id = object_id
    made.object_info.mover().id = mover_id
    cell.shadow_object_list = [other]
    assert cell.find_obj_collisions(made) == OK
    assert other.asked == asked


def test_objects_that_come_while_testing_are_tested() -> None:
    """09 3.2.2: the count is read anew each time."""
    made, cell = in_cell()
    late = Scripted(SLID)

    class Bringing(Scripted):
        def find_obj_collisions(self, transition: Transition) -> TransitionState:
            cell.add_shadow_object(late)
            return OK

    cell.shadow_object_list = [Bringing(OK)]
    assert cell.find_obj_collisions(made) == SLID


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
        (Weenie(), IS_PLAYER, "nobody", COLLIDED),
        (Weenie(), 0, False, OK),
        (Weenie(can_bypass_move_restrictions=True), IS_PLAYER, False, OK),
    ],
)
def test_restricted_cells_refuse_players(
    weenie: Weenie | None, state: int, admits: bool | str | None, result: TransitionState
) -> None:
    """09 3.1: only players with a game object that may not enter are stopped."""
    made, cell = in_cell()
    made.object_info.mover().weenie_obj = weenie
    made.object_info.state = state
    if admits is not None:
        cell.restriction = lambda _: None if admits == "nobody" else bool(admits)
    assert cell.check_entry_restrictions(made) == result
    assert made.collision_info.collision_normal_valid == 0


def test_nobody_may_not_enter() -> None:
    """09 3.1: without a mover the entry is refused."""
    made, cell = in_cell()
    made.object_info.object = None
    assert cell.check_entry_restrictions(made) == COLLIDED


def test_a_cell_is_named_by_its_id() -> None:
    """The repr helps in failures; interior is decided by the low word."""
    cell = ScriptedCell([], cell_id=OTHER_CELL)
    assert repr(cell) == "ScriptedCell(0xa9b40112)"
    assert cell.is_interior
    assert not ScriptedCell([], cell_id=0xA9B40040).is_interior
