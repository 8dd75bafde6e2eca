"""CPhysicsObj, the seed: what a transition is told by the object that makes it."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest
from oracle_bodies import ORDINARY, STANDING, walker
from oracle_worlds import CELL, FLOOR, RADIUS, at, world_of, xyz

from oracle.constants import DUMMY_RADIUS, EPS
from oracle.enums import CONTACT_OI, EDGE_SLIDE, FREE_ROTATE_OI, IS_PLAYER, ON_WALKABLE_OI, PATH_CLIPPED_OI
from oracle.physics_state import MISSILE_PS
from oracle.transient_state import (
    ACTIVE_TS,
    CONTACT_TS,
    ON_WALKABLE_TS,
    SLIDING_TS,
    STATIONARY_FALL_TS,
    STATIONARY_STOP_TS,
    STATIONARY_STUCK_TS,
    WATER_CONTACT_TS,
)
from oracle.vector import Vector3
from oracle.weenie import Weenie

if TYPE_CHECKING:
    from collections.abc import Callable

    from oracle.physics_object import PhysicsObj
    from oracle.transition import Transition

    Step = Callable[[float, int], float]


def seeded(body: PhysicsObj, *, admin_move: int = 0) -> Transition:
    """Return a transition that would take an object a metre to the east."""
    return body.seed_transition(body.m_position, at(1.0, 0.0, 0.0), admin_move)


def flags(body: PhysicsObj, *, admin_move: int = 0) -> int:
    """Return the mover's bits."""
    return seeded(body, admin_move=admin_move).object_info.state


def test_an_object_that_stands() -> None:
    """GO-1, GO-4: both planes are seeded, and the bits say contact and walkable."""
    made = seeded(walker())
    ci = made.collision_info
    assert made.object_info.state == EDGE_SLIDE | CONTACT_OI | ON_WALKABLE_OI
    assert (ci.contact_plane_valid, ci.last_known_contact_plane_valid) == (1, 1)
    assert (ci.contact_plane_cell_id, ci.last_known_contact_plane_cell_id) == (CELL, CELL)
    assert (xyz(ci.contact_plane.N), ci.contact_plane_is_water) == ((0.0, 0.0, 1.0), 0)


def test_an_object_on_a_steep_plane() -> None:
    """GO-4: contact without walkable."""
    assert flags(walker(transient=CONTACT_TS, state=0)) == CONTACT_OI


def test_an_object_in_water() -> None:
    """GO-3: the water bit goes with the plane."""
    body = walker(transient=STANDING | WATER_CONTACT_TS)
    assert seeded(body).collision_info.contact_plane_is_water == WATER_CONTACT_TS


@pytest.mark.parametrize(("steps", "valid"), [(0, 1), (1, 0)])
def test_an_object_that_jumps_keeps_the_last_known_plane(steps: int, valid: int, next32: Step) -> None:
    """GO-4, GO-5: above EPS metres per second only that; its cell id is the contact plane's."""
    made = seeded(walker(velocity=(0.0, 0.0, next32(EPS, steps)), state=0))
    ci = made.collision_info
    assert made.object_info.state == (CONTACT_OI | ON_WALKABLE_OI if valid else 0)
    assert (ci.contact_plane_valid, ci.last_known_contact_plane_valid) == (valid, 1)
    assert (ci.contact_plane_cell_id, ci.last_known_contact_plane_cell_id) == (CELL, CELL if valid else 0)


def test_an_object_in_the_air_knows_no_plane() -> None:
    """GO-3: walkable without contact counts for nothing."""
    made = seeded(walker(transient=ACTIVE_TS | ON_WALKABLE_TS, state=0))
    assert (made.object_info.state, made.collision_info.last_known_contact_plane_valid) == (0, 0)


def test_a_sliding_normal() -> None:
    """GO-6: its z is dropped, and a zero one is valid too."""
    body = walker(transient=SLIDING_TS)
    body.sliding_normal = Vector3(0.0, 0.5, 4.0)
    ci = seeded(body).collision_info
    assert (ci.sliding_normal_valid, xyz(ci.sliding_normal)) == (1, (0.0, 1.0, 0.0))
    body.sliding_normal = Vector3()
    assert seeded(body).collision_info.sliding_normal_valid == 1
    body.transient_state = 0
    assert seeded(body).collision_info.sliding_normal_valid == 0


def test_an_administrator_s_move_is_not_seeded() -> None:
    """GO-2: only the bits that come from state and setup."""
    body = walker(transient=STANDING | SLIDING_TS)
    made = seeded(body, admin_move=1)
    ci = made.collision_info
    assert made.object_info.state == EDGE_SLIDE
    assert (ci.contact_plane_valid, ci.last_known_contact_plane_valid, ci.sliding_normal_valid) == (0, 0, 0)


def test_bits_from_setup_state_and_game_object() -> None:
    """GO-7, GO-8, SEED-3."""
    assert flags(walker(free_heading=True, state=0, transient=0)) == FREE_ROTATE_OI
    all_of_them = walker(state=ORDINARY | MISSILE_PS, free_heading=True)
    assert flags(all_of_them) == 0x21B
    missile = seeded(walker(state=MISSILE_PS, transient=0))
    assert (missile.object_info.state, missile.object_info.step_down) == (PATH_CLIPPED_OI, 0)
    player = walker(state=0, transient=0, weenie=Weenie(is_player=True))
    assert flags(player) == IS_PLAYER
    player.part_array = None
    assert flags(player) == IS_PLAYER


@pytest.mark.parametrize(
    ("bits", "frames"),
    [
        (0, 0),
        (STATIONARY_FALL_TS, 1),
        (STATIONARY_FALL_TS | STATIONARY_STOP_TS, 2),
        (STATIONARY_FALL_TS | STATIONARY_STOP_TS | STATIONARY_STUCK_TS, 3),
    ],
)
def test_ticks_without_movement(bits: int, frames: int) -> None:
    """SEED-6: the highest bit counts."""
    assert seeded(walker(transient=bits)).collision_info.frames_stationary_fall == frames


def test_the_spheres() -> None:
    """SEED-4: scaled; an object without any has a small one that is not."""
    body = walker(spheres=2)
    body.m_scale = 2.0
    sp = seeded(body).sphere_path
    assert (sp.num_sphere, sp.local_sphere[1].radius) == (2, 2.0 * RADIUS)
    bare = walker(spheres=0)
    bare.m_scale = 2.0
    sp = seeded(bare).sphere_path
    assert (sp.num_sphere, sp.local_sphere[0].radius) == (1, DUMMY_RADIUS)
    assert xyz(sp.local_sphere[0].center) == (0.0, 0.0, DUMMY_RADIUS)


def test_the_path() -> None:
    """SEED-5: from the object's cell and position."""
    body = walker()
    sp = seeded(body).sphere_path
    assert sp.begin_cell is body.cell
    assert sp.curr_pos.frame.origin.x == 0.0
    assert sp.end_pos is not None
    assert sp.end_pos.frame.origin.x == 1.0


def test_the_result() -> None:
    """SEED-7, SEED-8: the finished transition, or nothing if there is no cell to begin in."""
    body = walker(world=world_of(FLOOR))
    made = body.transition(body.m_position, at(0.25, 0.0, 0.0), 0)
    assert made is not None
    assert made.sphere_path.curr_pos.frame.origin.x == 0.25
    body.cell = None
    assert body.transition(body.m_position, at(0.25, 0.0, 0.0), 0) is None


def test_edge_sliding_is_the_object_s_choice() -> None:
    """GO-1."""
    assert flags(walker(transient=0, state=ORDINARY)) == EDGE_SLIDE
    assert flags(walker(transient=0, state=0)) == 0
