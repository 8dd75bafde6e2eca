"""CPhysicsObj, placement: room, no room, no cell."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest
from oracle_bodies import STANDING, walker
from oracle_worlds import CELL, FLOOR, OTHER_CELL, RADIUS, ScriptedCell, ScriptedWorld, at, world_of, xyz

from oracle.constants import PLACEMENT_SLACK
from oracle.enums import TransitionState
from oracle.errors import NotPortedError
from oracle.physics_object_placement import DO_NOT_LOAD_CELLS, SCATTERED, SLIDE, SetPositionError
from oracle.physics_state import MISSILE_PS, REPORT_COLLISIONS_PS
from oracle.transient_state import ACTIVE_TS
from oracle.transition import Transition
from oracle.vector import Vector3
from oracle.weenie import Weenie

if TYPE_CHECKING:
    from collections.abc import Callable

    from oracle.physics_object import PhysicsObj

    Step = Callable[[float, int], float]

OK, COLLIDED = TransitionState.OK, TransitionState.COLLIDED


def in_scripted(*answers: TransitionState, cell_id: int = CELL) -> tuple[PhysicsObj, ScriptedCell]:
    """Return a missile, which looks for no ground, and a cell that answers from a script."""
    cell = ScriptedCell(answers, cell_id=cell_id)
    body = walker(world=ScriptedWorld(cell), state=MISSILE_PS, transient=ACTIVE_TS)
    return body, cell


def pushed(x: float, y: float) -> Callable[[Transition], None]:
    """Return an act that moves the check position."""
    return lambda made: made.sphere_path.add_offset_to_check_pos(Vector3(x, y, 0.0))


def stay(_made: Transition) -> None:
    """Leave the check position where it is."""


def test_an_object_is_put_on_the_floor() -> None:
    """SP-5, SP-7: it ends where it was put, and stands."""
    world = world_of(FLOOR)
    body = walker(world=world, transient=ACTIVE_TS)
    wanted = at(1.0, 2.0, 0.0)
    assert body.set_position(wanted, SLIDE, world.cells[CELL]) == SetPositionError.OK
    assert xyz(body.m_position.frame.origin)[:2] == (1.0, 2.0)
    assert body.transient_state == STANDING


def test_nothing_of_the_old_place_is_seeded() -> None:
    """06 10: no contact, whatever the object stood on."""
    body, cell = in_scripted(OK, OK)
    body.transient_state = STANDING
    assert body.set_position(at(0.0, 0.0, 0.0), 0, cell) == SetPositionError.OK
    assert body.transient_state == ACTIVE_TS


def test_no_room() -> None:
    """SP-6: the object stays where it is."""
    body, cell = in_scripted(COLLIDED)
    assert body.set_position(at(5.0, 0.0, 0.0), 0, cell) == SetPositionError.NO_VALID_POSITION
    assert body.m_position.frame.origin.x == 0.0


def test_no_room_and_somebody_is_told() -> None:
    """SP-6: what was hit decides which error it is."""
    body, cell = in_scripted(COLLIDED)
    body.state |= REPORT_COLLISIONS_PS
    body.weenie_obj = Weenie()
    cell.acts.append(lambda made: setattr(made.collision_info, "collided_with_environment", 1))
    assert body.set_position(at(5.0, 0.0, 0.0), 0, cell) == SetPositionError.COLLIDED


@pytest.mark.parametrize(
    ("x", "flags", "result"),
    [
        (0.03125, 0, SetPositionError.OK),
        (-2.0, 0, SetPositionError.OK),
        (0.0625, 0, SetPositionError.NO_VALID_POSITION),
        (0.0625, SLIDE, SetPositionError.OK),
    ],
)
def test_how_far_it_may_be_moved(x: float, flags: int, result: SetPositionError) -> None:
    """SP-5: without SLIDE less than 0.05 along the axes, any distance against them."""
    body, cell = in_scripted(OK, OK)
    cell.acts += [stay, pushed(x, 0.0)]
    wanted = at(0.0, 0.0, 0.0)
    assert body.set_position(wanted, flags, cell) == result
    kept = not flags and result == SetPositionError.OK
    assert wanted.frame.origin.x == (body.m_position.frame.origin.x if kept else 0.0)


def test_the_limit_of_being_moved(next32: Step) -> None:
    """SP-5: 0.05 itself is too far, one bit less is not; for both axes."""
    for axis in (0, 1):
        results = []
        for distance in (PLACEMENT_SLACK, next32(PLACEMENT_SLACK, -1)):
            body, cell = in_scripted(OK, OK)
            offset = [0.0, 0.0]
            offset[axis] = distance
            cell.acts += [stay, pushed(*offset)]
            results.append(body.set_position(at(0.0, 0.0, 0.0), 0, cell))
        assert results == [SetPositionError.NO_VALID_POSITION, SetPositionError.OK]


def test_the_cell_must_be_the_one_asked_for() -> None:
    """SP-5: without SLIDE a position of another cell is refused."""
    body, cell = in_scripted(OK, OK)
    cell.acts += [stay, lambda made: setattr(made.sphere_path.check_pos, "objcell_id", OTHER_CELL)]
    assert body.set_position(at(0.0, 0.0, 0.0), 0, cell) == SetPositionError.NO_VALID_POSITION


def test_no_cell() -> None:
    """SP-3: without one the object is stored and rests; that is no error."""
    body, cell = in_scripted()
    body.cell = cell
    assert body.set_position(at(5.0, 0.0, 0.0), 0, None) == SetPositionError.OK
    assert (body.cell, body.transient_state) == (None, 0)
    assert body.m_position.frame.origin.x == 5.0


def test_a_placement_that_ends_in_no_cell(monkeypatch: pytest.MonkeyPatch) -> None:
    """SP-7: it is an error, and nothing is written back."""

    def end_nowhere(self: Transition) -> int:
        self.sphere_path.curr_cell = None
        return 1

    monkeypatch.setattr(Transition, "find_valid_position", end_nowhere)
    body, cell = in_scripted()
    assert body.set_position(at(5.0, 0.0, 0.0), SLIDE, cell) == SetPositionError.NO_CELL
    assert (body.m_position.frame.origin.x, body.transient_state) == (0.0, ACTIVE_TS)


@pytest.mark.parametrize(("flags", "left_out"), [(0, 0), (DO_NOT_LOAD_CELLS, 1)])
def test_cells_that_are_not_visible_can_be_left_out(flags: int, left_out: int) -> None:
    """SP-4: the flag goes to the cell list."""
    body, cell = in_scripted(OK, OK)
    asked: list[int] = []
    cell.acts.append(lambda made: asked.append(made.cell_array.do_not_load_cells))
    assert body.set_position(at(0.0, 0.0, 0.0), flags, cell) == SetPositionError.OK
    assert asked == [left_out]


def test_random_positions_are_not_ported() -> None:
    """06 10: an error with a name."""
    body, cell = in_scripted()
    with pytest.raises(NotPortedError, match="random"):
        body.set_position(at(0.0, 0.0, RADIUS), SCATTERED, cell)
    assert xyz(body.m_position.frame.origin) == (0.0, 0.0, 0.0)
