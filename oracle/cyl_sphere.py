"""CCylSphere: an upright cylinder as an obstacle.

It stands upright in the *world*: an object's rotation turns its low point, never its axis. Both of its
caps are flat.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from oracle import cyl_sphere_clip, cyl_sphere_responses
from oracle.arithmetic import f32
from oracle.constants import EPS, WALK_INTERP_LOWEST
from oracle.enums import CONTACT_OI, ON_WALKABLE_OI, PATH_CLIPPED_OI, InsertType, TransitionState
from oracle.plane import Plane
from oracle.trace import cylinder_test, traced
from oracle.vector import Vector3, minus, plus, scaled

if TYPE_CHECKING:
    from oracle.collision_info import CollisionInfo
    from oracle.position import Position
    from oracle.sphere import Sphere
    from oracle.sphere_path import SpherePath
    from oracle.transition import Transition

UNSCALED: Final = 1.0
"""Local space is the object's, whatever the object's scale (07 10.9.1)."""


class CylSphere:
    """A cylinder: the middle of its lower cap, its height and its radius, metres.

    Like a sphere it owns its point. In an object's setup it is in object space; the functions that do
    not say otherwise take one in the block of the path's check position.
    """

    __slots__ = ("height", "low_pt", "radius")

    def __init__(self, low_pt: Vector3, height: float, radius: float) -> None:
        self.low_pt = low_pt
        self.height = height
        self.radius = radius

    def __repr__(self) -> str:
        return f"CylSphere({self.low_pt!r}, {self.height!r}, {self.radius!r})"

    def collides_with_sphere(self, check_pos: Sphere, disp: Vector3, radsum: float) -> bool:
        """Tell whether a sphere overlaps, by its own height and by the radius sum of the mover's sphere 0.

        retail: CCylSphere::collides_with_sphere 0x0053A880, 07 10.1.
        """
        # 07 10.1.1
        beside = radsum * radsum >= disp.x * disp.x + disp.y * disp.y
        # 07 10.1.2
        half = self.height * 0.5
        return beside and (check_pos.radius - EPS) + half >= abs(half - disp.z)

    def intersects_sphere_at(self, p: Position, scale: float, transition: Transition) -> TransitionState:
        """Test the path against this cylinder of an object's setup (object space, metres).

        Parameters
        ----------
        p : Position
            The object's.
        scale : float
            The object's.
        transition : Transition
            All state, in and out; its local space becomes that of `p`.

        Notes
        -----
        retail: CCylSphere::intersects_sphere (local form) 0x0053B8F0, 07 10.9.
        """
        path = transition.sphere_path
        # 07 10.9.1
        path.cache_localspace_sphere(p, UNSCALED)
        # 07 10.9.2
        radius = f32(scale * self.radius)
        height = f32(scale * self.height)
        low_pt = path.check_pos.localtoglobal(p, scaled(scale, self.low_pt))
        # 07 10.9.3
        return CylSphere(low_pt, height, radius).intersects_sphere(transition)

    @traced(cylinder_test)
    def intersects_sphere(self, transition: Transition) -> TransitionState:
        """Test the path against this cylinder, in the one way that the path's state asks for.

        retail: CCylSphere::intersects_sphere (global form) 0x0053B440, 07 10.8.
        """
        path, coll = transition.sphere_path, transition.collision_info
        s0 = path.global_sphere[0]
        # 07 10.8.1
        disp = minus(s0.center, self.low_pt)
        radsum = f32((self.radius - EPS) + s0.radius)
        # 07 10.8.2
        if path.insert_type == InsertType.PLACEMENT or path.obstruction_ethereal:
            return TransitionState.COLLIDED if self.overlaps(path, disp, radsum) else TransitionState.OK
        # 07 10.8.3
        if path.step_down:
            return self.step_sphere_down(path, coll, s0, disp, radsum)
        # 07 10.8.4
        if path.check_walkable:
            return TransitionState.COLLIDED if self.overlaps(path, disp, radsum) else TransitionState.OK
        # 07 10.8.5
        if not path.collide:
            return self._respond(transition, disp, radsum)
        # 07 10.8.6
        if not self.overlaps(path, disp, radsum):
            return TransitionState.OK
        return self._rest_upon(path, coll, disp, radsum)

    def overlaps(self, path: SpherePath, disp: Vector3, radsum: float) -> bool:
        """Tell whether either sphere of the mover overlaps (07 10.2.1, 07 10.8.2)."""
        s0, s1 = path.global_sphere
        if self.collides_with_sphere(s0, disp, radsum):
            return True
        return path.num_sphere > 1 and self.collides_with_sphere(s1, minus(s1.center, self.low_pt), radsum)

    def _respond(self, transition: Transition, disp: Vector3, radsum: float) -> TransitionState:
        """Step up, slide, stop or begin a landing, as the mover's state asks for (07 10.8.5)."""
        oi, path, coll = transition.object_info, transition.sphere_path, transition.collision_info
        s0, s1 = path.global_sphere
        disp1 = minus(s1.center, self.low_pt)
        feet = self.collides_with_sphere(s0, disp, radsum)
        head = not feet and path.num_sphere > 1 and self.collides_with_sphere(s1, disp1, radsum)
        if oi.state & (CONTACT_OI | ON_WALKABLE_OI):
            if feet:
                return self.step_sphere_up(transition, s0, disp, radsum)
            return self.slide_sphere(path, coll, s1, disp1, radsum, 1) if head else TransitionState.OK
        if oi.state & PATH_CLIPPED_OI:
            if feet:
                return self.collide_with_point(oi, path, coll, s0, disp, radsum, 0)
            return TransitionState.OK
        if feet:
            return self.land_on_cylinder(path, s0, disp, radsum)
        if head:
            return self.collide_with_point(oi, path, coll, s1, disp1, radsum, 1)
        return TransitionState.OK

    def _rest_upon(
        self, path: SpherePath, coll: CollisionInfo, disp: Vector3, radsum: float
    ) -> TransitionState:
        """Move sphere 0 back along its way until it rests upon the upper cap (07 10.8.6)."""
        s0 = path.global_sphere[0]
        # 07 10.8.6.1
        back = minus(path.global_curr_center[0], s0.center)
        mv = minus(back, path.get_curr_pos_check_pos_block_offset())
        if abs(mv.z) < EPS:
            return TransitionState.COLLIDED
        # 07 10.8.6.2
        t = (self.height + s0.radius - disp.z) / mv.z
        off = scaled(f32(t), mv)
        # 07 10.8.6.3
        x, y = off.x + disp.x, off.y + disp.y
        if radsum * radsum < y * y + x * x:
            return TransitionState.OK
        # 07 10.8.6.4
        w = (1.0 - t) * path.walk_interp
        if not (w < path.walk_interp and w >= WALK_INTERP_LOWEST):
            return TransitionState.COLLIDED
        # 07 10.8.6.5
        pt = plus(s0.center, off)
        pt.z = f32(pt.z - s0.radius)
        coll.set_contact_plane(Plane.from_point(Vector3(0.0, 0.0, 1.0), pt), 1)
        coll.contact_plane_cell_id = path.check_pos.objcell_id
        path.walk_interp = f32(w)
        path.add_offset_to_check_pos(off)
        return TransitionState.ADJUSTED

    normal_of_collision = cyl_sphere_responses.normal_of_collision
    step_sphere_down = cyl_sphere_responses.step_sphere_down
    step_sphere_up = cyl_sphere_responses.step_sphere_up
    slide_sphere = cyl_sphere_responses.slide_sphere
    land_on_cylinder = cyl_sphere_responses.land_on_cylinder
    collide_with_point = cyl_sphere_clip.collide_with_point
