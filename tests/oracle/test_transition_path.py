"""CTransition, the walk along the path: how many sub-steps, which offset, when it gives up."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import pytest
from oracle_worlds import CELL, RADIUS, WALL, at, mover, trace_of, transition, vec, world_of, xyz

from oracle.arithmetic import f32
from oracle.constants import EPS, FLOOR_Z
from oracle.enums import (
    CONTACT_OI,
    FREE_ROTATE_OI,
    IS_VIEWER_OI,
    ON_WALKABLE_OI,
    PATH_CLIPPED_OI,
)
from oracle.frame import Frame
from oracle.plane import Plane
from oracle.position import Position

if TYPE_CHECKING:
    from oracle.transition import Transition

HALF = 0.5
"""A radius that is exact, so that the number of sub-steps can be met exactly."""


def step(
    dx: float, *, state: int = 0, dz: float = 0.0, radius: float = HALF
) -> tuple[tuple[float, ...], tuple[float, ...], int]:
    """Return what calc_num_steps makes of a move."""
    made = transition(
        world_of(), at(0.0, 0.0, 1.0), at(dx, 0.0, 1.0 + dz), state=state, spheres=((0.0, radius),)
    )
    offset, one, count = made.calc_num_steps()
    return xyz(offset), xyz(one), count


def test_a_move_of_exactly_a_radius_is_one_step() -> None:
    """NS-5: the ratio must exceed 1; one ULP more makes two steps."""
    assert step(HALF) == ((0.5, 0.0, 0.0), (0.5, 0.0, 0.0), 1)
    more = f32(math.nextafter(HALF, 1.0) + 6e-8)
    assert step(more) == ((more, 0.0, 0.0), (more / 2.0, 0.0, 0.0), 2)


def test_no_move_is_no_step() -> None:
    """NS-5: only an offset of exactly zero has no sub-step; a denormal one has one."""
    assert step(0.0)[2] == 0
    assert step(1e-40)[2] == 1


def test_the_camera_rounds_down_and_adds_one() -> None:
    """NS-4: steps as long as the radius, the last one shorter; within EPS there is none."""
    assert step(1.0, state=IS_VIEWER_OI) == ((1.0, 0.0, 0.0), (0.5, 0.0, 0.0), 3)
    assert step(f32(0.0001), state=IS_VIEWER_OI)[2] == 0


def test_without_a_beginning_there_is_one_empty_step() -> None:
    """NS-1: a placement has no offset."""
    offset, one, count = transition(world_of(), None, at(1.0, 0.0, 0.0)).calc_num_steps()
    assert (xyz(offset), xyz(one), count) == ((0.0, 0.0, 0.0), (0.0, 0.0, 0.0), 1)


def standing(
    *, normal: tuple[float, float, float] = (0.0, 0.0, 1.0), sliding: tuple[float, float, float] | None = None
) -> Transition:
    """Return a transition whose sphere rests on a plane through the origin."""
    made = transition(world_of(), at(0.0, 0.0, RADIUS), at(1.0, 0.0, RADIUS))
    made.init_contact_plane(CELL, Plane(vec(*normal), 0.0), 0)
    if sliding is not None:
        made.init_sliding_normal(vec(*sliding))
    return made


def test_an_offset_into_the_plane_loses_that_part() -> None:
    """AD-5: the part along the normal is taken away."""
    assert xyz(standing().adjust_offset(vec(0.25, 0.0, -0.5))) == (0.25, 0.0, 0.0)


def test_an_offset_away_from_the_plane_is_snapped_to_it() -> None:
    """AD-6: x and y stay, z follows the plane."""
    assert xyz(standing().adjust_offset(vec(0.25, 0.0, 0.5))) == (0.25, 0.0, 0.0)


def test_sliding_on_a_plane_follows_their_common_line() -> None:
    """AD-4: with an opposed sliding normal only the part along N x S remains."""
    made = standing(sliding=(-1.0, 0.0, 0.0))
    assert xyz(made.adjust_offset(vec(0.5, 0.25, 0.0))) == (0.0, 0.25, 0.0)
    assert made.collision_info.sliding_normal_valid == 1


def test_sliding_on_a_plane_like_the_wall_stops() -> None:
    """AD-4: parallel normals have no common line."""
    made = standing(normal=(-1.0, 0.0, 0.0), sliding=(-1.0, 0.0, 0.0))
    assert xyz(made.adjust_offset(vec(0.5, 0.25, 0.0))) == (0.0, 0.0, 0.0)


def test_a_sliding_normal_that_does_not_oppose_is_dropped() -> None:
    """AD-1: an offset along or beside it clears the flag; so does a zero sliding normal."""
    for sliding in ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)):
        made = standing(sliding=sliding)
        made.adjust_offset(vec(0.5, 0.0, 0.0))
        assert made.collision_info.sliding_normal_valid == 0


def test_sliding_in_the_air_removes_the_component() -> None:
    """AD-8: without a contact plane the sliding normal alone counts; its z is zero, so falling goes on."""
    made = transition(world_of(), at(0.0, 0.0, 5.0), at(1.0, 0.0, 5.0))
    made.init_sliding_normal(vec(-1.0, 0.0, 0.0))
    assert xyz(made.adjust_offset(vec(0.5, 0.25, -0.5))) == (0.0, 0.25, -0.5)


def test_a_sphere_in_the_plane_is_lifted_along_z() -> None:
    """AD-7: the check position rises until the sphere is tangent, measured along z."""
    made = standing()
    made.sphere_path.add_offset_to_check_pos(vec(0.0, 0.0, -0.25))
    made.adjust_offset(vec(0.1, 0.0, 0.0))
    assert made.sphere_path.check_pos.frame.origin.z == RADIUS


def test_the_lift_is_measured_in_the_block_of_the_contact_plane() -> None:
    """AD-7: the sphere at x = 192 is at x = 0 of the next block, where the plane is given."""
    made = transition(world_of(), at(192.0, 0.0, 0.5), at(193.0, 0.0, 0.5))
    made.init_contact_plane(0xAAB40111, Plane(vec(0.6, 0.0, 0.8), 0.0), 0)
    made.adjust_offset(vec(0.1, 0.0, 0.0))
    lifted = 0.5 + (RADIUS - 0.5 * f32(0.8)) / f32(0.8)
    assert made.sphere_path.check_pos.frame.origin.z == pytest.approx(lifted, abs=1e-7)


@pytest.mark.parametrize(("water", "cell"), [(1, CELL), (0, 0)])
def test_water_and_planes_without_cell_do_not_lift(water: int, cell: int) -> None:
    """AD-7: is_water (also object tops) and a zero cell id switch the lift off."""
    made = standing()
    made.sphere_path.add_offset_to_check_pos(vec(0.0, 0.0, -0.25))
    made.collision_info.contact_plane_is_water = water
    made.collision_info.contact_plane_cell_id = cell
    made.adjust_offset(vec(0.1, 0.0, 0.0))
    assert made.sphere_path.check_pos.frame.origin.z == f32(RADIUS - 0.25)


def test_a_lift_of_a_radius_or_more_is_not_done() -> None:
    """AD-7: the radius must exceed the lift."""
    made = standing()
    made.sphere_path.set_check_pos(at(0.0, 0.0, 0.0), made.sphere_path.check_cell)
    made.adjust_offset(vec(0.1, 0.0, 0.0))
    assert made.sphere_path.check_pos.frame.origin.z == 0.0


def test_a_vertical_plane_does_not_lift() -> None:
    """AD-7: a division by a zero normal z gives an infinite lift, which is refused, not an error."""
    made = standing(normal=(1.0, 0.0, 0.0))
    made.adjust_offset(vec(0.0, 0.1, 0.0))
    assert xyz(made.sphere_path.check_pos.frame.origin) == (0.0, 0.0, RADIUS)


def test_without_a_begin_cell_nothing_moves() -> None:
    """FT-1: an unknown beginning fails."""
    made = transition(world_of(), at(0.0, 0.0, 1.0), at(1.0, 0.0, 1.0))
    made.sphere_path.begin_cell = None
    assert made.find_transitional_position() == 0


def test_a_move_that_is_too_short_fails() -> None:
    """FT-9: a first sub-step within EPS, after adjusting, is no movement at all."""
    made = transition(world_of(), at(0.0, 0.0, 1.0), at(f32(0.0001), 0.0, 1.0))
    assert made.find_transitional_position() == 0
    made = transition(world_of(), at(0.0, 0.0, 1.0), at(f32(EPS * 1.01), 0.0, 1.0))
    assert made.find_transitional_position() == 1


def test_turning_on_the_spot_takes_the_rotation_only() -> None:
    """FT-5: without offset nothing is validated; the seeded state stays and the rotation is taken."""
    turned = Position(CELL, Frame.unpack(vec(0.0, 0.0, RADIUS), 0.0, 0.0, 0.0, 1.0))
    made = transition(world_of(WALL), at(0.0, 0.0, RADIUS), turned, state=CONTACT_OI | ON_WALKABLE_OI)
    assert made.find_transitional_position() == 1
    assert made.sphere_path.curr_pos.frame.qz == 1.0
    assert (made.object_info.state, trace_of(made)) == (CONTACT_OI | ON_WALKABLE_OI, "")


def test_free_rotation_is_taken_at_once() -> None:
    """FT-3, FT-10: with FREE_ROTATE the end's rotation holds from the beginning."""
    end = Position(CELL, Frame.unpack(vec(0.4, 0.0, 1.0), 0.0, 0.0, 0.0, 1.0))
    made = transition(world_of(), at(0.0, 0.0, 1.0), end, state=FREE_ROTATE_OI)
    assert made.find_transitional_position() == 1
    assert made.sphere_path.curr_pos.frame.qz == 1.0


def test_a_blocked_move_is_a_successful_transition() -> None:
    """FT-15: the mover ends in front of the wall, and the result is 1."""
    made = transition(world_of(WALL), at(0.0, 0.0, 1.0), at(2.0, 0.0, 1.0))
    assert made.find_transitional_position() == 1
    assert made.sphere_path.curr_pos.frame.origin.x < 1.0 - RADIUS
    assert xyz(made.collision_info.collision_normal) == (-1.0, 0.0, 0.0)


def test_a_clipped_path_stops_at_the_first_collision() -> None:
    """FT-14: with PATH_CLIPPED the loop ends there; without, it goes on along the wall."""
    clipped = transition(world_of(WALL), at(0.0, 0.0, 1.0), at(2.0, 0.0, 1.0), state=PATH_CLIPPED_OI)
    assert clipped.find_transitional_position() == 1
    assert trace_of(clipped).count("M2") == 1


def test_contact_is_forgotten_in_each_sub_step() -> None:
    """FT-11: a mover that walks off into the air ends without contact, on walkable or not."""
    made = transition(
        world_of(),
        at(0.0, 0.0, RADIUS),
        at(0.4, 0.0, RADIUS),
        state=CONTACT_OI | ON_WALKABLE_OI,
        moving=mover(),
    )
    made.init_contact_plane(CELL, Plane(vec(0.0, 0.0, FLOOR_Z), 0.0), 0)
    assert made.find_transitional_position() == 1
    assert (made.collision_info.contact_plane_valid, made.object_info.state) == (0, 0)
