"""CSphere::slide_sphere: each of its five ways out."""

from __future__ import annotations

from oracle_worlds import RADIUS, at, vec, xyz

from oracle.arithmetic import f32
from oracle.collision_info import CollisionInfo
from oracle.enums import TransitionState
from oracle.plane import Plane
from oracle.sphere import Sphere
from oracle.sphere_path import SpherePath
from oracle.vector import Vector3

UP = vec(0.0, 0.0, 1.0)


def moved(x: float, y: float, z: float) -> SpherePath:
    """Return a path whose check position is displaced from its current position at the origin."""
    sp = SpherePath()
    sp.init_sphere(1, [Sphere(Vector3(), RADIUS)], 1.0)
    sp.init_path(None, at(0.0, 0.0, 0.0), at(x, y, z))
    sp.set_check_pos(at(x, y, z), None)
    return sp


def slide(sp: SpherePath, ci: CollisionInfo, normal: Vector3) -> TransitionState:
    """Slide sphere 0."""
    return sp.global_sphere[0].slide_sphere(sp, ci, normal, sp.global_curr_center[0])


def grounded() -> CollisionInfo:
    """Return collision info with a level contact plane."""
    ci = CollisionInfo()
    ci.set_contact_plane(Plane(UP.copy(), 0.0), 0)
    return ci


def test_a_zero_normal_goes_half_way_back() -> None:
    """07 6.B.1: half the displacement is taken back; no collision normal is set."""
    sp, ci = moved(1.0, 2.0, -4.0), CollisionInfo()
    assert slide(sp, ci, Vector3()) == TransitionState.ADJUSTED
    assert xyz(sp.check_pos.frame.origin) == (0.5, 1.0, -2.0)
    assert ci.collision_normal_valid == 0


def test_the_slide_follows_wall_and_floor() -> None:
    """07 6.B.7: what remains is the part along the line where both planes meet."""
    sp, ci = moved(1.0, 0.5, -0.25), grounded()
    assert slide(sp, ci, vec(-1.0, 0.0, 0.0)) == TransitionState.SLID
    assert xyz(sp.check_pos.frame.origin) == (0.0, 0.5, 0.0)
    assert xyz(ci.collision_normal) == (-1.0, 0.0, 0.0)


def test_too_short_a_slide_collides() -> None:
    """07 6.B.7.5: below EPS, squared, the sphere stays where it is."""
    sp, ci = moved(1.0, 0.0141, 0.0), grounded()
    assert slide(sp, ci, vec(-1.0, 0.0, 0.0)) == TransitionState.COLLIDED
    assert xyz(sp.check_pos.frame.origin) == (1.0, f32(0.0141), 0.0)


def test_just_long_enough_a_slide_is_done() -> None:
    """07 6.B.7.5: 0.0142 squared is above EPS."""
    sp, ci = moved(1.0, 0.0142, 0.0), grounded()
    assert slide(sp, ci, vec(-1.0, 0.0, 0.0)) == TransitionState.SLID


def test_a_parallel_normal_removes_its_component() -> None:
    """07 6.B.8: a normal like the contact plane's takes the displacement along itself away."""
    sp, ci = moved(1.0, 0.5, -0.25), grounded()
    assert slide(sp, ci, UP.copy()) == TransitionState.SLID
    assert xyz(sp.check_pos.frame.origin) == (1.0, 0.5, 0.0)


def test_an_opposed_normal_collides_and_is_rewritten() -> None:
    """07 6.B.9: the caller's normal becomes the way back, normalised; retail answers COLLIDED."""
    sp, ci, normal = moved(0.0, 3.0, 4.0), grounded(), vec(0.0, 0.0, -1.0)
    assert slide(sp, ci, normal) == TransitionState.COLLIDED
    back = tuple(f32(0.2 * v) for v in (-0.0, -3.0, -4.0))
    assert xyz(normal) == back
    assert xyz(ci.collision_normal) == back
    assert xyz(sp.check_pos.frame.origin) == (0.0, 3.0, 4.0)


def test_an_opposed_normal_without_movement_is_zeroed() -> None:
    """07 6.B.9: too short a way back leaves the collision normal that was set first."""
    sp, ci, normal = moved(0.0, 0.0, 0.0), grounded(), vec(0.0, 0.0, -1.0)
    assert slide(sp, ci, normal) == TransitionState.COLLIDED
    assert xyz(normal) == (0.0, 0.0, 0.0)
    assert xyz(ci.collision_normal) == (0.0, 0.0, -1.0)


def test_without_contact_the_last_known_plane_counts_even_if_invalid() -> None:
    """07 6.B.4: its normal is used whether or not the plane is valid."""
    sp, ci = moved(1.0, 0.5, -0.25), CollisionInfo()
    ci.last_known_contact_plane.N.assign(UP)
    assert slide(sp, ci, vec(-1.0, 0.0, 0.0)) == TransitionState.SLID
    assert xyz(sp.check_pos.frame.origin) == (0.0, 0.5, 0.0)


def test_without_any_plane_the_normal_counts_alone() -> None:
    """07 6.B.8: the zero normal of an unset plane makes no line; the component is removed."""
    sp, ci = moved(1.0, 0.5, -0.25), CollisionInfo()
    assert slide(sp, ci, vec(-1.0, 0.0, 0.0)) == TransitionState.SLID
    assert xyz(sp.check_pos.frame.origin) == (0.0, 0.5, -0.25)
