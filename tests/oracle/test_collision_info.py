"""COLLISIONINFO: validity flags, normalisation, touched objects."""

from __future__ import annotations

from oracle_worlds import mover, vec, xyz

from oracle.arithmetic import f32
from oracle.collision_info import CollisionInfo
from oracle.constants import EPS
from oracle.enums import TransitionState
from oracle.plane import Plane


def test_a_contact_plane_has_no_cell_id() -> None:
    """set_contact_plane copies the plane and never touches the cell id."""
    ci = CollisionInfo()
    ci.contact_plane_cell_id = 5
    plane = Plane(vec(0.0, 0.0, 1.0), -94.0)
    ci.set_contact_plane(plane, 1)
    plane.d = 0.0
    assert (ci.contact_plane_valid, ci.contact_plane.d, ci.contact_plane_is_water) == (1, -94.0, 1)
    assert ci.contact_plane_cell_id == 5


def test_a_collision_normal_is_normalised() -> None:
    """The stored normal has length one, each component rounded."""
    ci = CollisionInfo()
    ci.set_collision_normal(vec(3.0, 0.0, 4.0))
    assert xyz(ci.collision_normal) == (f32(3.0 * (1.0 / 5.0)), 0.0, f32(4.0 * (1.0 / 5.0)))


def test_a_tiny_collision_normal_is_zero_but_valid() -> None:
    """Below EPS the normal becomes zero and the flag stays 1; EPS itself is long enough."""
    ci = CollisionInfo()
    ci.set_collision_normal(vec(0.0, 0.0001, 0.0))
    assert (ci.collision_normal_valid, xyz(ci.collision_normal)) == (1, (0.0, 0.0, 0.0))
    ci.set_collision_normal(vec(0.0, EPS, 0.0))
    assert xyz(ci.collision_normal) == (0.0, 1.0, 0.0)


def test_a_sliding_normal_loses_its_z() -> None:
    """Z is dropped before normalising; an upright normal becomes zero but valid."""
    ci = CollisionInfo()
    ci.set_sliding_normal(vec(0.6, 0.0, 0.8))
    assert xyz(ci.sliding_normal) == (1.0, 0.0, 0.0)
    ci.set_sliding_normal(vec(0.0, 0.0, 1.0))
    assert (ci.sliding_normal_valid, xyz(ci.sliding_normal)) == (1, (0.0, 0.0, 0.0))


def test_an_object_is_recorded_once() -> None:
    """A second touch changes nothing, not even the last collided object."""
    ci, first, second = CollisionInfo(), mover(), mover()
    ci.add_object(first, TransitionState.OK)
    ci.add_object(second, TransitionState.COLLIDED)
    ci.add_object(first, TransitionState.COLLIDED)
    assert ci.collide_object == [first, second]
    assert ci.last_collided_object is second


def test_init_keeps_planes_and_water() -> None:
    """Flags, objects and one cell id are cleared; planes, water and the last known cell id stay."""
    ci = CollisionInfo()
    ci.set_contact_plane(Plane(vec(0.0, 0.0, 1.0), -1.0), 1)
    ci.contact_plane_cell_id = ci.last_known_contact_plane_cell_id = 9
    ci.add_object(mover(), TransitionState.SLID)
    ci.frames_stationary_fall = 2
    ci.init()
    assert (ci.contact_plane_valid, ci.contact_plane_cell_id, ci.frames_stationary_fall) == (0, 0, 0)
    assert (ci.collide_object, ci.last_collided_object) == ([], None)
    assert (ci.contact_plane.d, ci.contact_plane_is_water, ci.last_known_contact_plane_cell_id) == (
        -1.0,
        1,
        9,
    )


def test_forgetting_contact_keeps_plane_and_cell() -> None:
    """Only the flag and the water go."""
    ci = CollisionInfo()
    ci.set_contact_plane(Plane(vec(0.0, 0.0, 1.0), -1.0), 1)
    ci.contact_plane_cell_id = 9
    ci.forget_contact()
    assert (ci.contact_plane_valid, ci.contact_plane_is_water) == (0, 0)
    assert (ci.contact_plane.d, ci.contact_plane_cell_id) == (-1.0, 9)
