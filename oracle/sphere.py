"""CSphere: a sphere, moving, bounding or in the way."""

from __future__ import annotations

from typing import TYPE_CHECKING

from oracle import sphere_obstacle, sphere_responses
from oracle.arithmetic import f32
from oracle.constants import EPS
from oracle.enums import TransitionState
from oracle.vector import Vector3, scaled

if TYPE_CHECKING:
    from oracle.collision_info import CollisionInfo
    from oracle.position import Position
    from oracle.sphere_path import SpherePath
    from oracle.transition import Transition


class Sphere:
    """A centre and a radius, metres. A sphere owns its centre: pass a copy if the vector lives on."""

    __slots__ = ("center", "radius")

    def __init__(self, center: Vector3, radius: float) -> None:
        self.center = center
        self.radius = radius

    def __repr__(self) -> str:
        return f"Sphere({self.center!r}, {self.radius!r})"

    def copy(self) -> Sphere:
        """Return a bit copy."""
        return Sphere(self.center.copy(), self.radius)

    def assign(self, other: Sphere) -> None:
        """Copy the four floats of `other`."""
        self.center.assign(other.center)
        self.radius = other.radius

    def intersects(self, other: Sphere) -> bool:
        """Tell whether two spheres overlap or nearly touch: the squared gap is below EPS.

        retail: CSphere::intersects 0x005344A0, 01 3.1.
        """
        dx = self.center.x - other.center.x
        dy = self.center.y - other.center.y
        dz = self.center.z - other.center.z
        rs = other.radius + self.radius
        gap = ((dx * dx + dy * dy) + dz * dz) - rs * rs
        return gap < EPS

    def intersects_sphere_at(
        self, p: Position, scale: float, transition: Transition, *, is_creature: bool
    ) -> TransitionState:
        """Test the path against this sphere of an object's setup (object space, metres).

        Parameters
        ----------
        p : Position
            The object's.
        scale : float
            The object's.
        transition : Transition
            All state, in and out.
        is_creature : bool
            Whether the object is a creature or a missile; one does not stand on those.

        Notes
        -----
        retail: CSphere::intersects_sphere (local form) 0x00537FD0, 07 9.
        """
        # 07 9.1
        radius = f32(scale * self.radius)
        v = scaled(scale, self.center)
        # 07 9.2
        center = transition.sphere_path.check_pos.localtoglobal(p, v)
        # 07 9.3
        return Sphere(center, radius).intersects_sphere(transition, is_creature=is_creature)

    intersects_sphere = sphere_obstacle.intersects_sphere
    step_sphere_down = sphere_responses.step_sphere_down
    step_sphere_up = sphere_responses.step_sphere_up
    slide_sphere_along = sphere_responses.slide_sphere_along
    slide_sphere_off = sphere_responses.slide_sphere_off
    land_on_sphere = sphere_responses.land_on_sphere
    collide_with_point = sphere_responses.collide_with_point

    def slide_sphere(
        self, path: SpherePath, collisions: CollisionInfo, normal: Vector3, curr_center: Vector3
    ) -> TransitionState:
        """Slide this moving sphere along an obstacle and along the plane it stands on.

        Parameters
        ----------
        path : SpherePath
            Its check position is moved.
        collisions : CollisionInfo
            Takes the collision normal; gives the contact plane or, without one, the last known plane,
            valid or not.
        normal : Vector3
            The obstacle's normal, in block coordinates. The caller's own vector: the last branch
            overwrites it.
        curr_center : Vector3
            This sphere's centre at the current position, in that position's block, metres.

        Returns
        -------
        TransitionState
            SLID, COLLIDED, or ADJUSTED for a zero normal.

        Notes
        -----
        retail: CSphere::slide_sphere 0x00537440, 07 6.B.
        """
        cn, c, this = normal, curr_center, self.center
        # 07 6.B.1
        if cn.x == 0.0 and cn.y == 0.0 and cn.z == 0.0:
            x = f32((c.x - this.x) * 0.5)
            y = f32(f32(c.y - this.y) * 0.5)
            z = f32(f32(c.z - this.z) * 0.5)
            path.add_offset_to_check_pos(Vector3(x, y, z))
            return TransitionState.ADJUSTED
        # 07 6.B.2
        collisions.set_collision_normal(cn)
        # 07 6.B.3
        b = path.get_curr_pos_check_pos_block_offset()
        gx = f32(b.x + (this.x - c.x))
        gy = f32(b.y + (this.y - c.y))
        tz = f32(this.z - c.z)
        gz = f32(b.z + tz)
        # 07 6.B.4
        plane = (
            collisions.contact_plane
            if collisions.contact_plane_valid
            else collisions.last_known_contact_plane
        )
        n = plane.N
        # 07 6.B.5
        dx = f32(cn.y * n.z - cn.z * n.y)
        dy = n.x * cn.z - n.z * cn.x
        dzr = n.y * cn.x - n.x * cn.y
        dz = f32(dzr)
        # 07 6.B.6
        length = dzr * dz + dy * dy + dx * dx
        length_stored = f32(length)
        # 07 6.B.7
        if length >= EPS:
            d = dz * gz + dy * gy + dx * gx
            oy = f32(dy * d)
            oz = f32(dz * d)
            inv = 1.0 / length_stored
            inv_stored = f32(inv)
            ox = dx * d * inv
            py = f32(oy * inv_stored)
            pz = f32(oz * inv_stored)
            if pz * pz + py * py + ox * ox < EPS:
                return TransitionState.COLLIDED
            path.add_offset_to_check_pos(Vector3(f32(ox - gx), f32(py - gy), f32(pz - gz)))
            return TransitionState.SLID
        # 07 6.B.8
        if cn.z * n.z + cn.y * n.y + n.x * cn.x >= 0.0:
            d = f32(gx * cn.x + gz * cn.z + gy * cn.y)
            path.add_offset_to_check_pos(Vector3(f32(-cn.x * d), f32(-cn.y * d), f32(-cn.z * d)))
            return TransitionState.SLID
        # 07 6.B.9
        cn.assign(Vector3(f32(-gx), f32(-gy), f32(-gz)))
        if cn.normalize_check_small() == 0:
            collisions.set_collision_normal(cn)
        return TransitionState.COLLIDED
