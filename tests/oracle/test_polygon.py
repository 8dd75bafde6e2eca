"""CPolygon: its plane, what is inside it, and how a sphere overlaps it."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import pytest
from hypothesis import given
from hypothesis import strategies as st

from oracle.arithmetic import f32
from oracle.constants import EPS
from oracle.enums import Sidedness
from oracle.polygon import Polygon
from oracle.ray import Ray
from oracle.ref import Ref
from oracle.sphere import Sphere
from oracle.vector import Vector3

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    Step = Callable[[float, int], float]

UNDECIDED_BAND = 1e-4
"""Metres within which rounding may decide otherwise than exact geometry (02 7, notes)."""


def polygon(*corners: tuple[float, float, float]) -> Polygon:
    """Return a polygon of its corners."""
    return Polygon([Vector3(*corner) for corner in corners], 7)


def square(height: float = 0.0) -> Polygon:
    """Return the floor [0, 10] x [0, 10] at a height, front up."""
    return polygon((0.0, 0.0, height), (10.0, 0.0, height), (10.0, 10.0, height), (0.0, 10.0, height))


def ball(x: float, y: float, z: float, radius: float) -> Sphere:
    """Return a sphere."""
    return Sphere(Vector3(x, y, z), radius)


def slow(poly: Polygon, sphere: Sphere) -> tuple[int, Vector3 | None]:
    """Return the answer of the slow test and the contact point."""
    contact: Ref[Vector3 | None] = Ref(None)
    return poly.polygon_hits_sphere_slow_but_sure(sphere, contact), contact.value


def fast(poly: Polygon, sphere: Sphere) -> int:
    """Return the answer of the fast test."""
    return poly.polygon_hits_sphere(sphere, Ref(None))


class TestMakePlane:
    """The plane is computed from the corners, with retail's mixture of roundings."""

    def test_front_is_where_corners_run_counter_clockwise(self) -> None:
        """A floor listed counter-clockwise from above faces up, reversed it faces down."""
        assert square(2.0).plane.N.z == 1.0
        assert square(2.0).plane.d == -2.0
        flipped = Polygon(reversed(square(2.0).vertices))
        assert (flipped.plane.N.z, flipped.plane.d) == (-1.0, 2.0)

    def test_x_uses_the_unrounded_reciprocal(self) -> None:
        """On a symmetric triangle of edge 17 the three components differ in the last bit."""
        n = polygon((17.0, 0.0, 0.0), (0.0, 17.0, 0.0), (0.0, 0.0, 17.0)).plane.N
        assert (n.x, n.y, n.z) == (0.5773502588272095, 0.5773503184318542, 0.5773503184318542)

    def test_the_constant_is_the_mean_over_all_corners(self) -> None:
        """A saddle with corners at heights 0, 1, 0, 1 lies at 1/2, not at its first corner."""
        saddle = polygon((0.0, 0.0, 0.0), (4.0, 0.0, 1.0), (4.0, 4.0, 0.0), (0.0, 4.0, 1.0))
        assert (saddle.plane.N.x, saddle.plane.N.y, saddle.plane.N.z) == (0.0, 0.0, 1.0)
        assert saddle.plane.d == -0.5

    def test_z_is_rounded_at_every_step(self) -> None:
        """A tiny second triangle is lost in the float32 sum of z, but not in the sum of x."""
        small = 2.0**-14
        level = polygon((0.0, 0.0, 0.0), (4096.0, 0.0, 0.0), (4096.0, 1.0, 0.0), (4096.0 - small, 1.0, 0.0))
        upright = polygon((0.0, 0.0, 0.0), (0.0, 4096.0, 0.0), (0.0, 4096.0, 1.0), (0.0, 4096.0 - small, 1.0))
        assert level.plane.N.z == 1.0
        assert upright.plane.N.x == 1.0
        assert fan_sums(level) == (0.0, 0.0, 4096.0)
        assert fan_sums(upright) == (4096.0 + small, 0.0, 0.0)

    @pytest.mark.parametrize("corners", [0, 1, 2, 3])
    def test_a_polygon_without_area_gets_nan(self, corners: int) -> None:
        """Too few or collinear corners are kept, with a NaN normal, without an error."""
        line = polygon(*[(float(i), float(i), 0.0) for i in range(corners)])
        assert math.isnan(line.plane.N.x)
        assert math.isnan(line.plane.N.z)
        assert line.num_pts == corners


def fan_sums(poly: Polygon) -> tuple[float, float, float]:
    """Return the three cross-product sums that make_plane normalises, by MP-1 and MP-2."""
    sx = sy = sz = 0.0
    p0 = poly.vertices[0]
    for a, b in zip(poly.vertices[1:], poly.vertices[2:], strict=False):
        ax, ay, az = f32(a.x - p0.x), f32(a.y - p0.y), a.z - p0.z
        bx, by, bz = b.x - p0.x, b.y - p0.y, b.z - p0.z
        sx += f32(ay * bz - az * by)
        sy += f32(az * bx - bz * ax)
        sz = f32((by * ax - ay * bx) + sz)
    return sx, sy, sz


class TestPointTests:
    """Inside the edges, seen along the normal or along z."""

    @pytest.mark.parametrize(
        ("x", "y", "inside"),
        [(5.0, 5.0, 1), (0.0, 5.0, 1), (10.0, 10.0, 1), (-1e-30, 5.0, 0), (5.0, 10.000001, 0)],
    )
    def test_points_on_an_edge_are_inside(self, x: float, y: float, inside: int) -> None:
        """Edges and corners belong to the polygon; the height does not matter."""
        assert square().point_in_polygon(Vector3(x, y, 123.0)) == inside
        assert square().point_in_poly2D(Vector3(x, y, -123.0), Sidedness.POSITIVE) == inside

    def test_the_other_side_takes_a_clockwise_polygon(self) -> None:
        """Seen from below the same corners run clockwise; points on an edge are accepted again."""
        flipped = Polygon(reversed(square().vertices))
        assert flipped.point_in_poly2D(Vector3(5.0, 5.0, 0.0), Sidedness.NEGATIVE) == 1
        assert flipped.point_in_poly2D(Vector3(0.0, 5.0, 0.0), Sidedness.NEGATIVE) == 1
        assert flipped.point_in_poly2D(Vector3(-1.0, 5.0, 0.0), Sidedness.NEGATIVE) == 0
        assert flipped.point_in_poly2D(Vector3(5.0, 5.0, 0.0), Sidedness.POSITIVE) == 0

    def test_a_polygon_without_corners_contains_everything(self) -> None:
        """There is no edge to be outside of."""
        assert polygon().point_in_polygon(Vector3()) == 1
        assert polygon().point_in_poly2D(Vector3(), Sidedness.POSITIVE) == 1


class TestOverlap:
    """The slow test, which the physics uses, and the fast one, which decides nothing."""

    def test_the_plane_is_in_reach_up_to_the_radius_less_eps(self, next32: Step) -> None:
        """A sphere of radius 2 EPS at height EPS still touches, at the next height not."""
        touching = ball(5.0, 5.0, EPS, 2.0 * EPS)
        hit, contact = slow(square(), touching)
        assert hit == 1
        assert contact is not None
        assert (contact.x, contact.y, contact.z) == (5.0, 5.0, 0.0)
        assert fast(square(), touching) == 1
        beyond = ball(5.0, 5.0, next32(EPS, 1), 2.0 * EPS)
        assert slow(square(), beyond) == (0, None)
        assert fast(square(), beyond) == 0

    def test_the_contact_point_is_written_even_for_a_miss(self) -> None:
        """The plane is reached, the polygon is not: the projection is there all the same."""
        hit, contact = slow(square(), ball(20.0, 5.0, 0.25, 1.0))
        assert hit == 0
        assert contact is not None
        assert (contact.x, contact.y, contact.z) == (20.0, 5.0, 0.0)

    @pytest.mark.parametrize("height", [0.0, 0.25, -0.25])
    def test_both_faces_are_hit(self, height: float) -> None:
        """Overlap knows no direction."""
        assert slow(square(), ball(5.0, 5.0, height, 0.5))[0] == 1
        assert square().hits_sphere(ball(5.0, 5.0, height, 0.5)) == 1

    def test_an_edge_is_reached_sideways_within_the_reduced_radius(self) -> None:
        """Beyond an edge by less than radius - EPS it is a hit, by more a miss."""
        assert slow(square(), ball(5.0, -0.4997, 0.0, 0.5))[0] == 1
        assert slow(square(), ball(5.0, -0.4999, 0.0, 0.5))[0] == 0

    def test_a_corner_is_reached_after_its_first_edge_was_missed(self) -> None:
        """The edge before the corner is too short to be near; the search goes on to the corner."""
        assert slow(square(), ball(-0.3, -0.3, 0.0, 0.5))[0] == 1
        assert slow(square(), ball(-0.4, -0.4, 0.0, 0.5))[0] == 0
        assert fast(square(), ball(-0.3, -0.3, 0.0, 0.5)) == 1
        assert fast(square(), ball(-0.4, -0.4, 0.0, 0.5)) == 0

    def test_a_polygon_without_corners_is_hit_by_every_sphere(self) -> None:
        """Its NaN plane is never out of reach, and there is no edge."""
        assert slow(polygon(), ball(0.0, 0.0, 0.0, 0.5))[0] == 1
        assert fast(polygon(), ball(0.0, 0.0, 0.0, 0.5)) == 1

    @given(
        corners=st.integers(3, 8),
        start=st.floats(0.0, 1.0),
        tilt=st.floats(-1.5, 1.5),
        center=st.tuples(*[st.floats(-4.0, 4.0, width=32)] * 3),
        radius=st.floats(0.0625, 2.0, width=32),
    )
    def test_overlap_agrees_with_the_nearest_point(
        self, corners: int, start: float, tilt: float, center: tuple[float, ...], radius: float
    ) -> None:
        """Outside a narrow band, a hit means: the nearest point is within the radius less EPS."""
        points = [
            _tilted(3.0 * math.cos(angle), 2.0 * math.sin(angle), tilt)
            for angle in (2.0 * math.pi * (start + i / corners) for i in range(corners))
        ]
        distance = _distance(points, tilt, center)
        if abs(distance - (radius - EPS)) < UNDECIDED_BAND:
            return
        sphere = ball(*center, radius)
        assert slow(polygon(*points), sphere)[0] == int(distance < radius - EPS)


def _tilted(x: float, y: float, tilt: float) -> tuple[float, float, float]:
    return f32(x), f32(y * math.cos(tilt)), f32(y * math.sin(tilt))


def _distance(points: Sequence[tuple[float, ...]], tilt: float, center: Sequence[float]) -> float:
    """Return the distance of a point from a convex polygon that was tilted about x."""
    flat = [(x, y * math.cos(tilt) + z * math.sin(tilt)) for x, y, z in points]
    px, py = center[0], center[1] * math.cos(tilt) + center[2] * math.sin(tilt)
    height = center[2] * math.cos(tilt) - center[1] * math.sin(tilt)
    edges = list(zip(flat, flat[1:] + flat[:1], strict=True))
    if all((bx - ax) * (py - ay) - (by - ay) * (px - ax) >= 0.0 for (ax, ay), (bx, by) in edges):
        return abs(height)
    return math.hypot(height, min(_segment_distance(px, py, *a, *b) for a, b in edges))


def _segment_distance(px: float, py: float, ax: float, ay: float, bx: float, by: float) -> float:
    ex, ey = bx - ax, by - ay
    t = ((px - ax) * ex + (py - ay) * ey) / (ex * ex + ey * ey)
    t = min(1.0, max(0.0, t))
    return math.hypot(px - ax - t * ex, py - ay - t * ey)


class TestPosHitsSphere:
    """Overlap and direction: a polygon is one-sided for movement."""

    @pytest.mark.parametrize(("dz", "hit"), [(-1.0, 1), (-1e-45, 1), (0.0, 0), (-0.0, 0), (1.0, 0)])
    def test_only_movement_against_the_normal_hits(self, dz: float, hit: int) -> None:
        """Moving along or away is no hit, but the polygon is reported as struck."""
        struck: Ref[Polygon | None] = Ref(None)
        poly = square()
        movement = Vector3(3.0, 0.0, f32(dz))
        assert poly.pos_hits_sphere(ball(5.0, 5.0, 0.25, 0.5), movement, Ref(None), struck) == hit
        assert struck.value is poly

    def test_a_miss_reports_nothing(self) -> None:
        """What does not overlap leaves the struck polygon of the caller alone."""
        other = square()
        struck: Ref[Polygon | None] = Ref(other)
        down = Vector3(0.0, 0.0, -1.0)
        assert square().pos_hits_sphere(ball(5.0, 5.0, 2.0, 0.5), down, Ref(None), struck) == 0
        assert struck.value is other

    def test_surfaces_on_both_sides_do_not_matter(self) -> None:
        """A polygon drawn on both sides is still one-sided for movement."""
        poly = Polygon(square().vertices, 0, 1)
        up = Vector3(0.0, 0.0, 1.0)
        assert poly.pos_hits_sphere(ball(5.0, 5.0, -0.25, 0.5), up, Ref(None), Ref(None)) == 0


class TestPolygonHitsRay:
    """Mouse picking: the only place that reads sides_type."""

    def test_a_ray_from_the_front_hits(self) -> None:
        """Straight down into the square, at time 2; beside it not."""
        time = Ref(0.0)
        down = Vector3(0.0, 0.0, -1.0)
        assert square().polygon_hits_ray(Ray(Vector3(5.0, 5.0, 2.0), down), time) == 1
        assert time.value == 2.0
        assert square().polygon_hits_ray(Ray(Vector3(15.0, 5.0, 2.0), down), time) == 0

    @pytest.mark.parametrize(("sides", "hit"), [(0, 0), (1, 1), (2, 1)])
    def test_a_ray_from_behind_needs_a_second_side(self, sides: int, hit: int) -> None:
        """A one-sided polygon cannot be picked from behind."""
        poly = Polygon(square().vertices, 0, sides)
        ray = Ray(Vector3(5.0, 5.0, -2.0), Vector3(0.0, 0.0, 1.0))
        assert poly.polygon_hits_ray(ray, Ref(0.0)) == hit

    def test_a_polygon_behind_the_ray_is_not_hit(self) -> None:
        """Its time would be negative."""
        ray = Ray(Vector3(5.0, 5.0, -2.0), Vector3(0.0, 0.0, -1.0))
        assert square().polygon_hits_ray(ray, Ref(0.0)) == 0


def test_a_polygon_knows_itself() -> None:
    """Its id and corners are in its repr."""
    assert repr(polygon((1.0, 2.0, 3.0))) == "Polygon(7, [Vector3(1.0, 2.0, 3.0)])"
