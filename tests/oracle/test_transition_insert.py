"""CTransition, insertion: attempts, lists of cells, landing and stepping, with scripted cells."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest
from oracle_worlds import CELL, OTHER_CELL, ScriptedCell, ScriptedWorld, at, mover, transition, vec, xyz

from oracle.constants import SMALL_STEP, Z_LANDING
from oracle.enums import CONTACT_OI, ON_WALKABLE_OI, InsertType, TransitionState
from oracle.plane import Plane

if TYPE_CHECKING:
    from collections.abc import Callable

    from oracle.transition import Transition

OK, COLLIDED, ADJUSTED, SLID = (
    TransitionState.OK,
    TransitionState.COLLIDED,
    TransitionState.ADJUSTED,
    TransitionState.SLID,
)


def scripted(*answers: TransitionState, state: int = 0) -> tuple[Transition, ScriptedCell]:
    """Return a transition in one cell that answers from a script."""
    cell = ScriptedCell(answers)
    return transition(ScriptedWorld(cell), at(0.0, 0.0, 1.0), at(1.0, 0.0, 1.0), state=state), cell


def level(made: Transition) -> None:
    """Give the transition a level contact plane, as a floor would."""
    made.collision_info.set_contact_plane(Plane(vec(0.0, 0.0, 1.0), 0.0), 0)


def collide(made: Transition) -> None:
    """Note an airborne hit of a wall, as a BSP tree would."""
    made.sphere_path.set_collide(vec(-1.0, 0.0, 0.0))


@pytest.mark.parametrize(
    ("answers", "result", "left"),
    [
        ([OK, OK], OK, 1),
        ([COLLIDED, OK], COLLIDED, 1),
        ([ADJUSTED, OK, OK], OK, 1),
        ([ADJUSTED, SLID, ADJUSTED, OK], ADJUSTED, 1),
    ],
)
def test_a_cell_is_tested_until_it_decides(
    answers: list[TransitionState], result: TransitionState, left: int
) -> None:
    """IC-2, IC-3: OK and COLLIDED end it, other answers use up an attempt."""
    made, cell = scripted(*answers)
    assert made.insert_into_cell(cell, 3) == result
    assert len(cell.answers) == left


def test_no_cell_collides_and_no_attempt_is_ok() -> None:
    """IC-1, IC-3."""
    made, cell = scripted()
    assert made.insert_into_cell(None, 3) == COLLIDED
    assert made.insert_into_cell(cell, 0) == OK


def test_sliding_in_a_cell_forgets_the_contact() -> None:
    """IC-2: SLID makes the contact plane invalid; ADJUSTED leaves it."""
    for answer, valid in ((SLID, 0), (ADJUSTED, 1)):
        made, cell = scripted(answer)
        level(made)
        made.insert_into_cell(cell, 1)
        assert made.collision_info.contact_plane_valid == valid


def test_other_cells_are_tested_and_the_containing_one_is_taken() -> None:
    """OC-2, OC-3: the current cell is not tested again; its id stays with the check position."""
    here, other = ScriptedCell([]), ScriptedCell([OK], cell_id=OTHER_CELL)
    here.neighbours = [other]
    made = transition(ScriptedWorld(here, other), at(0.0, 0.0, 1.0), at(1.0, 0.0, 1.0))
    assert made.check_other_cells(here) == OK
    assert made.sphere_path.check_cell is here
    assert len(other.origins) == 1


def test_the_list_of_cells_is_shared_with_nested_calls() -> None:
    """OC-2: a nested call that rebuilds the list changes what the outer loop still tests."""
    here = ScriptedCell([])
    last = ScriptedCell([], cell_id=OTHER_CELL + 1)
    other = ScriptedCell([OK], cell_id=OTHER_CELL, acts=[lambda made: made.cell_array.cells.clear()])
    here.neighbours = [other, last]
    made = transition(ScriptedWorld(here, other, last), at(0.0, 0.0, 1.0), at(1.0, 0.0, 1.0))
    assert made.check_other_cells(here) == OK
    assert last.origins == []


def test_another_cell_stops_the_loop() -> None:
    """OC-2: SLID forgets the contact; the check cell is then not updated."""
    here, other = ScriptedCell([]), ScriptedCell([SLID], cell_id=OTHER_CELL)
    here.neighbours = [other]
    made = transition(ScriptedWorld(here, other), at(0.0, 0.0, 1.0), at(1.0, 0.0, 1.0))
    level(made)
    made.sphere_path.check_cell = None
    assert made.check_other_cells(here) == SLID
    assert (made.sphere_path.check_cell, made.collision_info.contact_plane_valid) == (None, 0)


def test_leaving_all_cells_keeps_the_interior_id() -> None:
    """OC-6: without a containing cell there is no check cell, but the position is kept."""
    made = transition(ScriptedWorld(), at(0.0, 0.0, 1.0), at(1.0, 0.0, 1.0))
    assert made.check_other_cells(None) == OK
    assert (made.sphere_path.check_cell, made.sphere_path.check_pos.objcell_id) == (None, CELL)


def test_stepping_down_out_of_all_cells_collides() -> None:
    """OC-4."""
    made = transition(ScriptedWorld(), at(0.0, 0.0, 1.0), at(1.0, 0.0, 1.0))
    made.sphere_path.step_down = 1
    assert made.check_other_cells(None) == COLLIDED


def test_placement_inserts_into_the_check_cell_and_the_others() -> None:
    """placement_insert: without a check cell it collides."""
    made, _ = scripted(OK)
    assert made.placement_insert() == OK
    made.sphere_path.check_cell = None
    assert made.placement_insert() == COLLIDED


def test_nothing_is_inserted_without_a_cell_or_an_attempt() -> None:
    """TI-1 answers OK, TI-2 INVALID."""
    made, _ = scripted()
    assert made.transitional_insert(0) == TransitionState.INVALID
    made.sphere_path.check_cell = None
    assert made.transitional_insert(3) == OK


def test_an_adjusted_cell_is_tried_attempts_squared_times() -> None:
    """TI-3, TI-4: the attempts are passed on, and ADJUSTED on the last one is the result."""
    made, cell = scripted(*[ADJUSTED] * 9)
    assert made.transitional_insert(3) == ADJUSTED
    assert cell.answers == []


@pytest.mark.parametrize("answer", [COLLIDED, ADJUSTED, SLID])
def test_a_negative_hit_is_forgotten_after_a_failure(answer: TransitionState) -> None:
    """TI-5: also after COLLIDED, where other ports keep it."""
    made, _ = scripted(answer)
    made.sphere_path.neg_poly_hit = 1
    made.transitional_insert(1)
    assert made.sphere_path.neg_poly_hit == 0


def test_a_negative_hit_goes_back_to_the_loop() -> None:
    """TI-13: after the slide the insert is repeated, and its answer is the result."""
    made, cell = scripted(OK, OK, OK)
    cell.acts = [lambda t: t.sphere_path.set_neg_poly_hit(0, vec(1.0, 0.0, 0.0)), lambda _: None]
    made.sphere_path.add_offset_to_check_pos(vec(0.5, 0.25, 0.0))
    assert made.transitional_insert(2) == OK
    assert cell.origins == [(0.5, 0.25, 1.0), (0.0, 0.25, 1.0)]


def test_a_negative_hit_waits_while_stepping() -> None:
    """TI-13: with step_up or step_down the hit is not acted on, nor cleared."""
    made, _ = scripted(OK)
    made.sphere_path.neg_poly_hit = made.sphere_path.step_up = 1
    assert made.transitional_insert(1) == OK
    assert made.sphere_path.neg_poly_hit == 1


def test_a_landing_is_accepted_on_a_walkable_plane() -> None:
    """TI-8…11: the position must also pass as a placement; the insert type comes back from the slot."""
    seen: list[InsertType] = []

    def note(made: Transition) -> None:
        seen.append(made.sphere_path.insert_type)

    made, cell = scripted(ADJUSTED, OK, OK)
    cell.acts = [collide, level, note]
    assert made.transitional_insert(2) == OK
    assert seen == [InsertType.PLACEMENT]
    assert (made.sphere_path.insert_type, made.sphere_path.collide) == (InsertType.TRANSITION, 0)
    assert made.collision_info.contact_plane_valid == 1


def test_a_landing_without_a_plane_goes_back_and_collides() -> None:
    """TI-12: the position of the hit is restored; without a last known plane the wall is the normal."""
    made, cell = scripted(ADJUSTED, OK)
    cell.acts = [collide]
    assert made.transitional_insert(2) == COLLIDED
    assert xyz(made.collision_info.collision_normal) == (-1.0, 0.0, 0.0)
    assert made.sphere_path.collide == 0


def test_a_landing_without_room_forgets_the_plane_it_found() -> None:
    """TI-9, TI-12: the placement fails, so the contact plane is made invalid again."""
    made, cell = scripted(ADJUSTED, OK, COLLIDED)
    cell.acts = [collide, level]
    assert made.transitional_insert(2) == COLLIDED
    assert made.collision_info.contact_plane_valid == 0
    assert made.sphere_path.insert_type == InsertType.TRANSITION


def test_a_refused_landing_with_a_last_known_plane_stops_the_mover() -> None:
    """TI-12: the velocity is killed instead, the last known plane forgotten, no normal set."""
    made, cell = scripted(ADJUSTED, OK)
    cell.acts = [collide]
    made.collision_info.last_known_contact_plane_valid = 1
    assert made.transitional_insert(2) == COLLIDED
    assert made.object_info.mover().kill_velocity_calls == 1
    ci = made.collision_info
    assert (ci.last_known_contact_plane_valid, ci.collision_normal_valid) == (0, 0)


def test_contact_found_is_enough() -> None:
    """TI-14: with a valid contact plane nothing is looked for below."""
    made, cell = scripted(OK, state=CONTACT_OI | ON_WALKABLE_OI)
    cell.acts = [level]
    assert made.transitional_insert(3) == OK
    assert len(cell.origins) == 1


def test_movers_in_the_air_and_missiles_do_not_step_down() -> None:
    """TI-15: no contact, or no step_down of the mover, ends the insert."""
    made, cell = scripted(OK)
    assert made.transitional_insert(3) == OK
    assert len(cell.origins) == 1
    made, cell = scripted(OK, state=CONTACT_OI)
    made.object_info.step_down = 0
    assert made.transitional_insert(3) == OK
    assert len(cell.origins) == 1


def lowering(*, state: int, step_down: float, spheres: tuple[tuple[float, float], ...]) -> list[float]:
    """Return the heights at which a grounded mover looks for ground that is not there."""
    cell = ScriptedCell([OK] * 9)
    made = transition(
        ScriptedWorld(cell),
        at(0.0, 0.0, 8.0),
        at(0.0, 0.0, 8.0),
        state=state,
        spheres=spheres,
        moving=mover(step_down=step_down),
    )
    made.transitional_insert(1)
    return [8.0 - z for _, _, z in cell.origins]


def test_the_step_down_is_small_off_walkable_ground() -> None:
    """TI-16: with contact but not on a walkable it looks 0.04 below."""
    depths = lowering(state=CONTACT_OI, step_down=1.5, spheres=((0.0, 0.5),))
    assert depths == pytest.approx([0.0, SMALL_STEP], abs=1e-6)


@pytest.mark.parametrize(
    ("step_down", "spheres", "depths"),
    [
        (1.0, ((0.0, 0.5),), [0.0, 1.0]),
        (1.25, ((0.0, 0.5),), [0.0, 0.25]),
        (1.25, ((0.0, 0.5), (1.0, 0.5)), [0.0, 0.625, 1.25]),
        (1.0, ((0.0, 0.5), (1.0, 0.5)), [0.0, 1.0]),
    ],
)
def test_long_steps_down_are_shortened_or_halved(
    step_down: float, spheres: tuple[tuple[float, float], ...], depths: list[float]
) -> None:
    """TI-18, TI-19: one sphere steps half its radius, two step twice half; a diameter goes at once."""
    assert lowering(state=CONTACT_OI | ON_WALKABLE_OI, step_down=step_down, spheres=spheres) == depths


def test_a_step_down_that_finds_ground_keeps_contact() -> None:
    """TI-22: OK, with the walkable polygon forgotten and the landing limit as allowance."""
    finding: list[Callable[[Transition], None]] = [lambda _: None, level]
    made, cell = scripted(OK, ADJUSTED, OK, OK, state=CONTACT_OI)
    cell.acts = finding
    assert made.transitional_insert(3) == OK
    assert (made.sphere_path.walkable, made.sphere_path.walkable_allowance) == (None, Z_LANDING)
    assert made.collision_info.contact_plane_valid == 1
