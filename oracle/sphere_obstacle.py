"""CSphere as an obstacle: does the mover run into it, and what happens then.

Two spheres overlap if the square of their distance is at most that of the sum of their radii, which the
mover's sphere 0 gives also for its sphere 1. The obstacle's centre is in the block of the path's check
position. The functions that take `self` are methods of `oracle.sphere.Sphere`.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from oracle.arithmetic import f32, sqrt
from oracle.constants import EPS, WALK_INTERP_LOWEST
from oracle.enums import CONTACT_OI, ON_WALKABLE_OI, PATH_CLIPPED_OI, InsertType, TransitionState
from oracle.plane import Plane
from oracle.trace import sphere_test, traced
from oracle.vector import minus, plus, scaled

if TYPE_CHECKING:
    from oracle.collision_info import CollisionInfo
    from oracle.sphere import Sphere
    from oracle.sphere_path import SpherePath
    from oracle.transition import Transition
    from oracle.vector import Vector3


def collides_with_sphere(disp: Vector3, radsum: float) -> bool:
    """Tell whether two centres that lie `disp` apart are at most `radsum` apart, metres.

    retail: CSphere::collides_with_sphere 0x005369E0, 07 2.
    """
    # 07 2.1
    return radsum * radsum >= disp.y * disp.y + disp.x * disp.x + disp.z * disp.z


def find_time_of_collision(movement: Vector3, disp: Vector3, radsum: float) -> float:
    """Return when a moving sphere touches one at rest, or -1 if it never does or overlaps already.

    Parameters
    ----------
    movement : Vector3
        The whole movement, metres.
    disp : Vector3
        From the resting centre to the moving one at the beginning, metres.
    radsum : float
        The sum of the radii, metres.

    Returns
    -------
    float
        A fraction of the movement, as a register; it may lie beyond 1 or, if the sphere moves away,
        below 0.

    Notes
    -----
    retail: CSphere::find_time_of_collision 0x005368F0, 07 3.
    """
    # 07 3.1
    a = movement.x * movement.x + movement.y * movement.y + movement.z * movement.z
    # 07 3.2
    dot = disp.z * movement.z + disp.y * movement.y + movement.x * disp.x
    b = -dot
    # 07 3.3
    c = disp.x * disp.x + disp.y * disp.y + disp.z * disp.z - radsum * radsum
    # 07 3.4
    if c < EPS:
        return -1.0
    # 07 3.5
    disc = b * b - c * a
    # 07 3.6
    if a < EPS or disc < 0.0:
        return -1.0
    # 07 3.7
    q = sqrt(disc)
    # 07 3.8
    return first_root(q, dot, b) / a


def first_root(q: float, dot: float, b: float) -> float:
    """Return the lesser of the undivided roots b - q and q - dot that is not negative, or the latter.

    `b` is minus `dot` (07 3.8).
    """
    return q - dot if b - q < 0.0 else b - q


@traced(sphere_test)
def intersects_sphere(self: Sphere, transition: Transition, *, is_creature: bool) -> TransitionState:
    """Test the path against this sphere, in the one way that the path's state asks for.

    Parameters
    ----------
    transition : Transition
        All state, in and out.
    is_creature : bool
        Whether the object is a creature or a missile; one does not stand on those.

    Notes
    -----
    retail: CSphere::intersects_sphere (global form) 0x00537A80, 07 8.
    """
    path = transition.sphere_path
    s0 = path.global_sphere[0]
    # 07 8.1
    disp = minus(s0.center, self.center)
    # 07 8.2
    radsum = f32((self.radius + s0.radius) - EPS)
    # 07 8.4
    if path.obstruction_ethereal or path.insert_type == InsertType.PLACEMENT:
        return _overlap(self, path, disp, radsum)
    # 07 8.5
    if path.step_down:
        if is_creature:
            return TransitionState.OK
        return self.step_sphere_down(path, transition.collision_info, s0, disp, radsum)
    # 07 8.6
    if path.check_walkable:
        return _overlap(self, path, disp, radsum)
    # 07 8.7
    if not path.collide:
        return _respond(self, transition, disp, radsum)
    # 07 8.8.1
    if is_creature:
        return TransitionState.OK
    # 07 8.8.2
    if _overlap(self, path, disp, radsum) == TransitionState.OK:
        return TransitionState.OK
    return _rest_upon(path, transition.collision_info, disp, radsum)


def _upper_disp(self: Sphere, path: SpherePath) -> Vector3 | None:
    """Return the way from this centre to the mover's sphere 1, if it has one (07 8.3)."""
    return minus(path.global_sphere[1].center, self.center) if path.num_sphere > 1 else None


def _overlap(self: Sphere, path: SpherePath, disp: Vector3, radsum: float) -> TransitionState:
    """Return COLLIDED if either sphere of the mover overlaps, else OK (07 8.4, 8.6, 8.8.2)."""
    if collides_with_sphere(disp, radsum):
        return TransitionState.COLLIDED
    disp1 = _upper_disp(self, path)
    if disp1 is not None and collides_with_sphere(disp1, radsum):
        return TransitionState.COLLIDED
    return TransitionState.OK


def _respond(self: Sphere, transition: Transition, disp: Vector3, radsum: float) -> TransitionState:
    """Step up, slide, stop or begin a landing, as the mover's state asks for (07 8.7)."""
    oi, path, coll = transition.object_info, transition.sphere_path, transition.collision_info
    s0, s1 = path.global_sphere
    hit = collides_with_sphere(disp, radsum)
    if oi.state & (CONTACT_OI | ON_WALKABLE_OI):
        if hit:
            return self.step_sphere_up(transition, s0, disp, radsum)
        disp1 = _upper_disp(self, path)
        if disp1 is not None and collides_with_sphere(disp1, radsum):
            return self.slide_sphere_off(path, coll, s1, 1)
        return TransitionState.OK
    if oi.state & PATH_CLIPPED_OI:
        return self.collide_with_point(oi, path, coll, s0, radsum, 0) if hit else TransitionState.OK
    if hit:
        return self.land_on_sphere(path)
    disp1 = _upper_disp(self, path)
    if disp1 is not None and collides_with_sphere(disp1, radsum):
        return self.collide_with_point(oi, path, coll, s1, radsum, 1)
    return TransitionState.OK


def _rest_upon(path: SpherePath, coll: CollisionInfo, disp: Vector3, radsum: float) -> TransitionState:
    """Move sphere 0 back along its way until it rests upon the obstacle, if that is flat enough (07 8.8).

    If only sphere 1 overlaps, the way may miss the obstacle: then the root is NaN, no comparison with it
    holds, and the answer is COLLIDED (07 11).
    """
    s0 = path.global_sphere[0]
    # 07 8.8.3
    back = minus(path.global_curr_center[0], s0.center)
    mv = minus(back, path.get_curr_pos_check_pos_block_offset())
    # 07 8.8.4
    radsum = f32(radsum + EPS)
    # 07 8.8.5
    a = mv.z * mv.z + mv.y * mv.y + mv.x * mv.x
    dot = mv.y * disp.y + mv.x * disp.x + mv.z * disp.z
    b = -dot
    # 07 8.8.6
    if abs(a) < EPS:
        return TransitionState.COLLIDED
    # 07 8.8.7
    gap = disp.y * disp.y + disp.x * disp.x + disp.z * disp.z - radsum * radsum
    t = sqrt(b * b - gap * a) - dot
    # 07 8.8.8: the root is not divided by `a` yet
    if t > 1.0:
        t = b + b - t
    # 07 8.8.9
    u = t / a
    w = (1.0 - u) * path.walk_interp
    # 07 8.8.10
    if not (w < path.walk_interp and w >= WALK_INTERP_LOWEST):
        return TransitionState.COLLIDED
    # 07 8.8.11
    mv = scaled(u, mv)
    disp = plus(mv, disp)
    disp.divide_by(radsum)
    # 07 8.8.12
    if not path.is_walkable_allowable(disp.z):
        return TransitionState.OK
    # 07 8.8.13
    pt = minus(s0.center, scaled(s0.radius, disp))
    plane = Plane.from_point(disp, pt)
    # 07 8.8.14
    coll.set_contact_plane(plane, 1)
    coll.contact_plane_cell_id = path.check_pos.objcell_id
    path.walk_interp = f32(w)
    path.add_offset_to_check_pos(mv)
    return TransitionState.ADJUSTED
