"""CPolygon: a convex polygon and everything the collision asks of it."""

from __future__ import annotations

from typing import TYPE_CHECKING

from oracle.arithmetic import divide, f32, sqrt
from oracle.constants import EPS, LEAST_WALK_INTERP
from oracle.enums import Sidedness
from oracle.plane import Plane
from oracle.polygon_edges import along_up, foot_of, reached_edge_by_edge
from oracle.ref import Ref
from oracle.vector import Vector3, dot_x

if TYPE_CHECKING:
    from collections.abc import Iterable

    from oracle.ray import Ray
    from oracle.sphere import Sphere
    from oracle.sphere_path import SpherePath


class Polygon:
    """A convex polygon, wound counter-clockwise when seen from the front of its plane.

    Everything is in the space of the polygon's owner (cell, part), metres. The plane comes from the
    vertices; they must not change afterwards.

    Attributes
    ----------
    vertices : list of Vector3
        The corners.
    edges : list of (Vector3, Vector3)
        Start and end of each edge, beginning with the one that ends in the first corner (02 0.4).
    poly_id : int
        The polygon's index in its owner.
    sides_type : int
        0 one-sided, 1 same surface behind, 2 another surface behind; no collision function reads it.
    plane : Plane
        The mean plane of the corners.
    """

    __slots__ = ("edges", "plane", "poly_id", "sides_type", "vertices")

    def __init__(self, vertices: Iterable[Vector3], poly_id: int = 0, sides_type: int = 0) -> None:
        self.vertices = list(vertices)
        self.edges = list(zip(self.vertices[-1:] + self.vertices[:-1], self.vertices, strict=True))
        self.poly_id = poly_id
        self.sides_type = sides_type
        self.plane = Plane(Vector3(), 0.0)
        self.make_plane()

    def __repr__(self) -> str:
        return f"Polygon({self.poly_id}, {self.vertices!r})"

    @property
    def num_pts(self) -> int:
        """Number of corners."""
        return len(self.vertices)

    def make_plane(self) -> None:
        """Compute the plane from the corners; a polygon without area gets NaNs.

        retail: CPolygon::make_plane 0x005383D0, 02 MP-1…6.
        """
        # MP-1
        sx = sy = 0.0
        sz = 0.0
        # MP-2
        if self.num_pts - 1 > 1:
            p0 = self.vertices[0]
            for k in range(1, self.num_pts - 1):
                a = self.vertices[k]
                b = self.vertices[k + 1]
                bx = b.x - p0.x
                by = b.y - p0.y
                bz = b.z - p0.z
                ax = f32(a.x - p0.x)
                ay = f32(a.y - p0.y)
                az = a.z - p0.z
                cx = f32(ay * bz - az * by)
                cy = f32(az * bx - bz * ax)
                sx = sx + cx
                sy = sy + cy
                sz = f32((by * ax - ay * bx) + sz)
        # MP-3
        inv = divide(1.0, sqrt((sz * sz + sy * sy) + sx * sx))
        inv32 = f32(inv)
        # MP-4
        N = self.plane.N
        N.x = f32(inv * sx)
        N.y = f32(inv32 * sy)
        N.z = f32(inv32 * sz)
        # MP-5
        total = 0.0
        for v in self.vertices:
            total = ((total + N.z * v.z) + N.y * v.y) + N.x * v.x
        # MP-6
        self.plane.d = f32(-divide(total, float(self.num_pts)))

    def point_in_poly2D(self, point: Vector3, side: Sidedness) -> int:
        """Tell whether a point is inside every edge, seen along z; edges belong to both sides.

        retail: CPolygon::point_in_poly2D 0x00538060, 02 P2-1…4.
        """
        # P2-1
        if not self.vertices:
            return 1
        prev = self.vertices[0]
        for cur in reversed(self.vertices):
            # P2-2
            a = prev.y - cur.y
            b = cur.x - prev.x
            s = ((-(a * cur.x) - b * cur.y) + b * point.y) + a * point.x
            # P2-3
            if side == Sidedness.POSITIVE:
                if s > 0.0:
                    return 0
            elif s < 0.0:
                return 0
            prev = cur
        # P2-4
        return 1

    def point_in_polygon(self, point: Vector3) -> int:
        """Tell whether a point is inside every edge, seen along the normal.

        retail: CPolygon::point_in_polygon 0x00538D90, 02 PP-1…3.
        """
        # PP-1: without corners there is no edge to be outside of.
        N = self.plane.N
        for prev, cur in self.edges:
            # PP-2
            ex = cur.x - prev.x
            ey = cur.y - prev.y
            ez = cur.z - prev.z
            cx = f32(ez * N.y - ey * N.z)
            cy = f32(ex * N.z - ez * N.x)
            cz = ey * N.x - ex * N.y
            s = ((point.z - prev.z) * cz + (point.y - prev.y) * cy) + (point.x - prev.x) * cx
            # PP-3
            if s < 0.0:
                return 0
        return 1

    def adjust_sphere_to_poly(self, check_pos: Sphere, curr_pos: Vector3, movement: Vector3) -> float:
        """Return the fraction of `movement` at which a sphere from `curr_pos` touches the plane.

        A register, not clamped. Exactly 1.0 when it touches at the start, 0.0 when it moves along the
        plane. Of `check_pos` only the radius is read.

        retail: CPolygon::adjust_sphere_to_poly 0x00538170, 02 AP-1…5.
        """
        N = self.plane.N
        # AP-1
        dist0 = f32(dot_x(curr_pos, N) + self.plane.d)
        # AP-2
        if abs(dist0) < check_pos.radius:
            return 1.0
        # AP-3
        v = dot_x(movement, N)
        if abs(v) < EPS:
            return 0.0
        # AP-4
        r = check_pos.radius
        if dist0 <= 0.0:
            r = -r
        # AP-5
        return (r - dist0) / v

    def adjust_sphere_to_plane(self, path: SpherePath, valid_pos: Sphere, movement: Vector3) -> int:
        """Move a sphere back along `movement` until it rests on the plane; 1 if that was allowed.

        Ratchets ``path.walk_interp`` down: a further success multiplies, it does not add. A rejected
        sphere and path are unchanged.

        retail: CPolygon::adjust_sphere_to_plane 0x00538210, 02 AS-1…6.
        """
        N = self.plane.N
        center = valid_pos.center
        # AS-1
        dist = dot_x(center, N) + self.plane.d
        v = dot_x(movement, N)
        # AS-2
        if v > EPS:
            num = -valid_pos.radius - dist
        elif v >= -EPS:
            return 0
        else:
            num = dist - valid_pos.radius
        # AS-3
        t = num / v
        w = (1.0 - t) * path.walk_interp
        w32 = f32(w)
        # AS-4
        if w >= path.walk_interp or w32 < LEAST_WALK_INTERP:
            return 0
        # AS-5
        oy = f32(t * movement.y)
        oz = f32(t * movement.z)
        center.x = f32(center.x - t * movement.x)
        center.y = f32(center.y - oy)
        center.z = f32(center.z - oz)
        # AS-6
        path.walk_interp = w32
        return 1

    def polygon_hits_sphere(self, object_: Sphere, contact_pt: Ref[Vector3 | None]) -> int:
        """Tell whether a sphere overlaps the polygon: the fast version, whose answer decides nothing.

        retail: CPolygon::polygon_hits_sphere 0x005387C0, 02 PH-1…7.
        """
        # PH-1
        dist = dot_x(object_.center, self.plane.N) + self.plane.d
        rad = object_.radius - EPS
        if rad < abs(dist):
            return 0
        # PH-2
        rsq = f32(rad * rad - dist * dist)
        # PH-3
        contact = foot_of(self.plane, object_.center, dist)
        contact_pt.value = contact
        # PH-4…7
        return reached_edge_by_edge(self.plane, self.edges, contact, rsq, 1)

    def polygon_hits_sphere_slow_but_sure(self, object_: Sphere, contact_pt: Ref[Vector3 | None]) -> int:
        """Tell whether a sphere, EPS smaller, overlaps the polygon: the test of the physics.

        `contact_pt` becomes the centre projected onto the plane, whatever the answer, unless the plane
        is out of reach.

        retail: CPolygon::polygon_hits_sphere_slow_but_sure 0x00538A10, 02 SS-1…6.
        """
        # SS-1
        dist = dot_x(object_.center, self.plane.N) + self.plane.d
        rad = object_.radius - EPS
        if rad < abs(dist):
            return 0
        # SS-2
        rsq = f32(rad * rad - dist * dist)
        contact = foot_of(self.plane, object_.center, dist)
        contact_pt.value = contact
        # SS-3, SS-4: inlined in retail, the same arithmetic.
        if self.point_in_polygon(contact):
            return 1
        # SS-5, SS-6
        return reached_edge_by_edge(self.plane, self.edges, contact, rsq, 0)

    def pos_hits_sphere(
        self,
        object_: Sphere,
        movement: Vector3,
        contact_pt: Ref[Vector3 | None],
        struck_poly: Ref[Polygon | None],
    ) -> int:
        """Tell whether a sphere overlaps the polygon and moves against its normal.

        `struck_poly` becomes this polygon at any overlap, even if the answer is 0.

        retail: CPolygon::pos_hits_sphere 0x005394F0, 02 PS-1…3.
        """
        # PS-1
        hit = self.polygon_hits_sphere_slow_but_sure(object_, contact_pt)
        # PS-2
        if hit:
            struck_poly.value = self
        # PS-3
        if dot_x(movement, self.plane.N) >= 0.0:
            return 0
        return hit

    def hits_sphere(self, object_: Sphere) -> int:
        """Tell whether a sphere overlaps the polygon, from either side.

        retail: CPolygon::hits_sphere 0x00539540, 02 9.
        """
        return self.polygon_hits_sphere_slow_but_sure(object_, Ref(None))

    def walkable_hits_sphere(self, path: SpherePath, object_: Sphere, up: Vector3) -> int:
        """Tell whether a sphere overlaps the polygon and one may walk on it.

        `up` is the world's z axis in the polygon's space.

        retail: CPolygon::walkable_hits_sphere 0x00539560, 02 WH-1…2.
        """
        # WH-1
        if not dot_x(self.plane.N, up) > path.walkable_allowance:
            return 0
        # WH-2: retail also runs the fast version here and ignores what it says.
        return self.polygon_hits_sphere_slow_but_sure(object_, Ref(None))

    def check_walkable(self, sphere: Sphere, up: Vector3) -> int:
        """Tell whether a sphere, projected along `up` onto the plane, still touches the polygon.

        retail: CPolygon::check_walkable 0x00538E60, 02 CW-1…7.
        """
        # CW-4
        return self._stands_on(sphere, up, f32(sphere.radius * sphere.radius))

    def check_small_walkable(self, sphere: Sphere, up: Vector3) -> int:
        """Tell the same as `check_walkable` for half the radius.

        retail: CPolygon::check_small_walkable 0x005390B0, 02 12.
        """
        return self._stands_on(sphere, up, f32((sphere.radius * sphere.radius) * 0.25))

    def find_crossed_edge(self, sphere: Sphere, up: Vector3, normal: Vector3) -> int:
        """Find the first edge that a sphere's centre, projected along `up`, is outside of.

        Returns 1 and writes that edge's unit normal, pointing inwards; 0 leaves `normal` alone.

        retail: CPolygon::find_crossed_edge 0x00539300, 02 FE-1…5.
        """
        N = self.plane.N
        # FE-1
        v = dot_x(N, up)
        if abs(v) < EPS:
            return 0
        # FE-2
        p = along_up(self.plane, sphere.center, up, v)
        # FE-3
        for prev, cur in self.edges:
            ex = f32(cur.x - prev.x)
            ey = f32(cur.y - prev.y)
            ez = cur.z - prev.z
            ez32 = f32(ez)
            side = ((p.z - prev.z) * (ey * N.x - ex * N.y) + (p.y - prev.y) * (ex * N.z - ez32 * N.x)) + (
                p.x - prev.x
            ) * (ez * N.y - ey * N.z)
            if side < 0.0:
                # FE-4
                normal.x = f32(ez32 * N.y - ey * N.z)
                normal.y = f32(ex * N.z - ez32 * N.x)
                normal.z = f32(ey * N.x - ex * N.y)
                # FE-5: the arithmetic of Vector3::normalize
                normal.normalize()
                return 1
        return 0

    def adjust_to_placement_poly(
        self, struck: Sphere, other: Sphere, radius: float, center_solid: int, solid_check: int
    ) -> None:
        """Push two spheres along the normal until `struck` is `radius` away from the plane.

        retail: CPolygon::adjust_to_placement_poly 0x00538CE0, 02 AQ-1…4.
        """
        N = self.plane.N
        # AQ-1
        dist = dot_x(struck.center, N) + self.plane.d
        # AQ-2: two independent flips of the sign.
        r = radius
        if solid_check:
            if center_solid:
                r = r * -1.0
            if dist <= 0.0:
                r = -r
        k = r - dist
        # AQ-3
        oy = f32(k * N.y)
        ox = k * N.x
        oz = f32(k * N.z)
        # AQ-4
        for center in (struck.center, other.center):
            center.x = f32(ox + center.x)
            center.y = f32(oy + center.y)
            center.z = f32(oz + center.z)

    def polygon_hits_ray(self, ray: Ray, time: Ref[float]) -> int:
        """Tell whether a ray meets the polygon, from the front only if it is one-sided (picking).

        retail: CPolygon::polygon_hits_ray 0x005395E0, 02 HR-1…3.
        """
        # HR-1
        if self.sides_type == 0 and dot_x(ray.dir, self.plane.N) > 0.0:
            return 0
        # HR-2
        if not self.plane.compute_time_of_intersection(ray, time):
            return 0
        # HR-3
        t = time.value
        ax = f32(t * ray.dir.x)
        ay = f32(t * ray.dir.y)
        p = Vector3(f32(ax + ray.pt.x), f32(ay + ray.pt.y), f32(t * ray.dir.z + ray.pt.z))
        return self.point_in_polygon(p)

    def _stands_on(self, sphere: Sphere, up: Vector3, rsq: float) -> int:
        """Do what check_walkable and check_small_walkable share (02 CW-1…3, CW-5…7)."""
        # CW-1: an absolute value, so a polygon that faces down is not rejected here.
        v = dot_x(self.plane.N, up)
        if abs(v) < EPS:
            return 0
        # CW-2, CW-3
        p = along_up(self.plane, sphere.center, up, v)
        # CW-5…7
        return reached_edge_by_edge(self.plane, self.edges, p, rsq, 1)
