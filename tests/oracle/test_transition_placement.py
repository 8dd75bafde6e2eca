"""CTransition, placement: the position itself, the rings around it, the ground below."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import pytest
from oracle_worlds import FLOOR, RADIUS, ScriptedCell, ScriptedWorld, at, mover, transition, world_of

from oracle.arithmetic import f32
from oracle.enums import TransitionState

if TYPE_CHECKING:
    from oracle.transition import Transition

OK, COLLIDED = TransitionState.OK, TransitionState.COLLIDED


def placing(
    *answers: TransitionState, radius: float = 1.0, missile: bool = True
) -> tuple[Transition, ScriptedCell]:
    """Return a placement in one cell that answers from a script; a missile looks for no ground."""
    cell = ScriptedCell(answers)
    made = transition(ScriptedWorld(cell), None, at(0.0, 0.0, 8.0), spheres=((0.0, radius),), moving=mover())
    made.object_info.step_down = 0 if missile else 1
    return made, cell


def test_a_free_place_is_taken() -> None:
    """FP-2, FP-4, PP-1: one test as initial placement, one as placement."""
    made, cell = placing(OK, OK)
    assert made.find_placement_position() == 1
    assert cell.origins == [(0.0, 0.0, 8.0)] * 2


def test_a_place_refused_at_first_is_not_searched_around() -> None:
    """FP-3: COLLIDED as initial placement fails at once."""
    made, cell = placing(COLLIDED)
    assert made.find_placement_position() == 0
    assert len(cell.origins) == 1


def test_no_cell_no_place() -> None:
    """FP-2, FP-3."""
    made, _ = placing()
    made.sphere_path.curr_cell = None
    assert made.find_placement_position() == 0


def test_without_sliding_only_the_place_itself_is_tried() -> None:
    """PP-1: placement_allows_sliding 0 ends the search."""
    made, cell = placing(COLLIDED)
    made.sphere_path.placement_allows_sliding = 0
    assert made.find_placement_pos() == 0
    assert len(cell.origins) == 1


def test_the_rings_around_a_blocked_place() -> None:
    """PP-3…5: radius 1 tries four rings, a metre apart, the first with eight places, from +y clockwise."""
    made, cell = placing(*[COLLIDED] * 5, OK)
    assert made.find_placement_pos() == 1
    first = cell.origins[1]
    assert first[:2] == pytest.approx((0.0, 1.0), abs=1e-6)
    assert cell.origins[2][:2] == pytest.approx((math.sqrt(0.5), math.sqrt(0.5)), abs=1e-6)
    assert all(math.hypot(x, y) == pytest.approx(1.0, abs=1e-6) for x, y, _ in cell.origins[1:])
    assert made.sphere_path.curr_pos.frame.origin.x == cell.origins[-1][0]


def test_every_ring_is_tried_before_giving_up() -> None:
    """PP-5, PP-6: with radius 1 the rings of 1 to 4 metres have 8, 14, 20 and 26 places."""
    made, cell = placing(*[COLLIDED] * 69)
    assert made.find_placement_pos() == 0
    distances = [round(math.hypot(x, y)) for x, y, _ in cell.origins[1:]]
    assert [distances.count(ring) for ring in (1, 2, 3, 4)] == [8, 14, 20, 26]


def test_a_mover_of_four_metres_has_no_rings() -> None:
    """PP-3: a ratio of exactly 1 is not enough."""
    made, cell = placing(COLLIDED, radius=4.0)
    assert made.find_placement_pos() == 0
    assert len(cell.origins) == 1


def test_a_thin_mover_stays_within_two_metres() -> None:
    """PP-2, PP-3: below 0.125 the reach is 2 and the ratio is halved."""
    made, cell = placing(*[COLLIDED] * 2000, radius=f32(0.1))
    assert made.find_placement_pos() == 0
    assert max(math.hypot(x, y) for x, y, _ in cell.origins) == pytest.approx(2.0, abs=1e-5)


@pytest.mark.parametrize(("height", "contact"), [(0.6, 1), (3.0, 0)])
def test_a_placed_mover_steps_down_to_ground_in_reach(height: float, contact: int) -> None:
    """FP-5: one sphere looks half its radius below; without ground it stays where it is."""
    made = transition(world_of(FLOOR), None, at(0.0, 0.0, height), moving=mover())
    assert made.find_placement_position() == 1
    origin = made.sphere_path.curr_pos.frame.origin
    assert made.collision_info.contact_plane_valid == contact
    assert origin.z == pytest.approx(RADIUS if contact else f32(height), abs=1e-6)
