"""CPolygon: what one can stand on, the edge one has crossed, and how a sphere is put to rest."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import pytest
from hypothesis import given
from hypothesis import strategies as st

from oracle.arithmetic import f32
from oracle.constants import EPS
from oracle.polygon import Polygon
from oracle.sphere import Sphere
from oracle.sphere_path import SpherePath
from oracle.vector import Vector3

if TYPE_CHECKING:
    from collections.abc import Callable

    Step = Callable[[float, int], float]

UP = Vector3(0.0, 0.0, 1.0)
RESTING_BOUND = 1e-5
"""Metres: float32 stores of coordinates below 16 and of the products."""


def square(*, face_down: bool = False) -> Polygon:
    """Return the floor [0, 10] x [0, 10] at height 0."""
    corners = [
        Vector3(0.0, 0.0, 0.0),
        Vector3(10.0, 0.0, 0.0),
        Vector3(10.0, 10.0, 0.0),
        Vector3(0.0, 10.0, 0.0),
    ]
    return Polygon(reversed(corners) if face_down else corners)


def ball(x: float, y: float, z: float, radius: float) -> Sphere:
    """Return a sphere."""
    return Sphere(Vector3(x, y, z), radius)


def path(*, walk_interp: float = 1.0, walkable_allowance: float = 0.0) -> SpherePath:
    """Return a path of which only these two fields are read here."""
    sphere_path = SpherePath()
    sphere_path.walk_interp = walk_interp
    sphere_path.walkable_allowance = walkable_allowance
    return sphere_path


class TestWalkableHitsSphere:
    """Overlap with something that is not too steep."""

    def test_the_allowance_itself_is_too_steep(self, next32: Step) -> None:
        """The comparison is strict: a normal exactly at the limit is refused."""
        sphere = ball(5.0, 5.0, 0.25, 0.5)
        assert square().walkable_hits_sphere(path(walkable_allowance=1.0), sphere, UP) == 0
        allowance = next32(1.0, -1)
        assert square().walkable_hits_sphere(path(walkable_allowance=allowance), sphere, UP) == 1

    def test_it_must_overlap(self) -> None:
        """Walkable but out of reach."""
        assert square().walkable_hits_sphere(path(), ball(5.0, 5.0, 0.75, 0.5), UP) == 0


class TestCheckWalkable:
    """The sphere, dropped along up, still touches the polygon or not."""

    @pytest.mark.parametrize("height", [0.0, 100.0, -100.0])
    def test_the_height_does_not_matter(self, height: float) -> None:
        """The full radius counts, however far above or below the centre is."""
        assert square().check_walkable(ball(-0.5, 5.0, height, 0.5), UP) == 1
        assert square().check_walkable(ball(-0.625, 5.0, height, 0.5), UP) == 0

    def test_an_up_along_the_plane_is_refused(self, next32: Step) -> None:
        """The cosine between normal and up must reach EPS, from either side."""
        sphere = ball(5.0, 5.0, 0.0, 0.5)
        assert square().check_walkable(sphere, Vector3(1.0, 0.0, EPS)) == 1
        assert square().check_walkable(sphere, Vector3(1.0, 0.0, -EPS)) == 1
        assert square().check_walkable(sphere, Vector3(1.0, 0.0, next32(EPS, -1))) == 0

    def test_a_polygon_that_faces_down_is_accepted(self) -> None:
        """The cosine is compared by absolute value."""
        assert square(face_down=True).check_walkable(ball(5.0, 5.0, 0.0, 0.5), UP) == 1

    def test_the_distance_to_an_edge_is_inclusive(self, next32: Step) -> None:
        """Exactly the radius away touches; a radius one step smaller does not."""
        assert square().check_walkable(ball(5.0, -5.0, 0.0, 5.0), UP) == 1
        assert square().check_walkable(ball(5.0, -5.0, 0.0, next32(5.0, -1)), UP) == 0

    def test_the_distance_to_a_corner_is_inclusive(self, next32: Step) -> None:
        """(-3, -4) is 5 from the corner; the edges missed before it do not end the search."""
        assert square().check_walkable(ball(-3.0, -4.0, 0.0, 5.0), UP) == 1
        assert square().check_walkable(ball(-3.0, -4.0, 0.0, next32(5.0, -1)), UP) == 0

    def test_a_foot_at_the_end_of_an_edge_is_on_it(self, next32: Step) -> None:
        """Straight below the corner the foot is the corner itself."""
        assert square().check_walkable(ball(0.0, -5.0, 0.0, 5.0), UP) == 1
        assert square().check_walkable(ball(10.0, -5.0, 0.0, 5.0), UP) == 1
        assert square().check_walkable(ball(0.0, -5.0, 0.0, next32(5.0, -1)), UP) == 0

    def test_a_polygon_without_corners_is_stood_on(self) -> None:
        """Its NaN normal is not along the plane, and it has no edge."""
        assert Polygon([]).check_walkable(ball(0.0, 0.0, 0.0, 0.5), UP) == 1

    def test_the_small_check_takes_half_the_radius(self, next32: Step) -> None:
        """Radius 10 reaches what the full check reaches with 5."""
        assert square().check_small_walkable(ball(-3.0, -4.0, 0.0, 10.0), UP) == 1
        assert square().check_small_walkable(ball(-3.0, -4.0, 0.0, next32(10.0, -1)), UP) == 0

    def test_a_slanted_up_projects_sideways(self) -> None:
        """Dropped along (1, 0, 1), a centre 3 m up lands 3 m further west."""
        slanted = Vector3(1.0, 0.0, 1.0)
        assert square().check_walkable(ball(12.0, 5.0, 3.0, 0.5), slanted) == 1
        assert square().check_walkable(ball(2.0, 5.0, 3.0, 0.5), slanted) == 0


class TestFindCrossedEdge:
    """The edge that the projected centre has left the polygon over."""

    @pytest.mark.parametrize(
        ("x", "y", "inward"),
        [
            (5.0, -1.0, (0.0, 1.0, 0.0)),
            (11.0, 5.0, (-1.0, 0.0, 0.0)),
            (5.0, 11.0, (0.0, -1.0, 0.0)),
            (-1.0, 5.0, (1.0, 0.0, 0.0)),
            (-1.0, -1.0, (1.0, 0.0, 0.0)),
        ],
    )
    def test_the_first_crossed_edge_s_normal_points_inwards(
        self, x: float, y: float, inward: tuple[float, float, float]
    ) -> None:
        """Beyond a corner it is the edge that comes first, the one into corner 0."""
        normal = Vector3()
        assert square().find_crossed_edge(ball(x, y, 3.0, 0.5), UP, normal) == 1
        assert (normal.x, normal.y, normal.z) == inward

    @pytest.mark.parametrize(("x", "y"), [(5.0, 5.0), (0.0, 5.0), (10.0, 10.0)])
    def test_inside_and_on_an_edge_none_is_crossed(self, x: float, y: float) -> None:
        """The normal stays as it was."""
        normal = Vector3(7.0, 8.0, 9.0)
        assert square().find_crossed_edge(ball(x, y, 3.0, 0.5), UP, normal) == 0
        assert (normal.x, normal.y, normal.z) == (7.0, 8.0, 9.0)

    def test_an_up_along_the_plane_finds_nothing(self, next32: Step) -> None:
        """Both sides of EPS, far outside of the polygon."""
        sphere = ball(-5.0, 5.0, 0.0, 0.5)
        assert square().find_crossed_edge(sphere, Vector3(1.0, 0.0, EPS), Vector3()) == 1
        assert square().find_crossed_edge(sphere, Vector3(1.0, 0.0, next32(EPS, -1)), Vector3()) == 0


class TestAdjustSphereToPlane:
    """Moving a sphere back along its movement until it rests on the plane."""

    def test_a_sphere_comes_to_rest(self) -> None:
        """Half of the movement is undone, and half of the walk remains."""
        sphere_path, sphere = path(), ball(5.0, 5.0, 0.375, 0.5)
        assert square().adjust_sphere_to_plane(sphere_path, sphere, Vector3(0.0, 0.0, -0.25)) == 1
        assert sphere.center.z == 0.5
        assert sphere_path.walk_interp == 0.5

    def test_successes_multiply(self) -> None:
        """Half of what remained, not half of the whole."""
        sphere_path = path(walk_interp=0.5)
        movement = Vector3(0.0, 0.0, -0.25)
        assert square().adjust_sphere_to_plane(sphere_path, ball(5.0, 5.0, 0.375, 0.5), movement) == 1
        assert sphere_path.walk_interp == 0.25

    def test_all_components_move_back(self) -> None:
        """The undone part goes along the movement, not along the normal."""
        sphere = ball(5.0, 5.0, 0.375, 0.5)
        assert square().adjust_sphere_to_plane(path(), sphere, Vector3(1.0, -2.0, -0.25)) == 1
        assert (sphere.center.x, sphere.center.y, sphere.center.z) == (4.5, 6.0, 0.5)

    def test_movement_along_the_plane_is_refused(self, next32: Step) -> None:
        """Up to EPS in either direction nothing can be undone."""
        for dz in (EPS, -EPS):
            sphere = ball(5.0, 5.0, 0.5 - 1e-5, 0.5)
            assert square().adjust_sphere_to_plane(path(), sphere, Vector3(0.0, 0.0, dz)) == 0
        behind = ball(5.0, 5.0, f32(-0.5001), 0.5)
        assert square().adjust_sphere_to_plane(path(), behind, Vector3(0.0, 0.0, EPS)) == 0
        assert square().adjust_sphere_to_plane(path(), behind, Vector3(0.0, 0.0, next32(EPS, 1))) == 1
        sphere = ball(5.0, 5.0, 0.5 - 1e-5, 0.5)
        down = Vector3(0.0, 0.0, -next32(EPS, 1))
        assert square().adjust_sphere_to_plane(path(), sphere, down) == 1

    def test_a_sphere_that_has_not_arrived_is_refused(self, next32: Step) -> None:
        """Exactly resting undoes nothing and is refused; the next lower height is accepted."""
        movement = Vector3(0.0, 0.0, -0.25)
        resting = ball(5.0, 5.0, 0.5, 0.5)
        assert square().adjust_sphere_to_plane(path(), resting, movement) == 0
        assert resting.center.z == 0.5
        lower = ball(5.0, 5.0, next32(0.5, -1), 0.5)
        assert square().adjust_sphere_to_plane(path(), lower, movement) == 1

    def test_the_lower_limit_is_compared_after_rounding(self, next32: Step) -> None:
        """Undoing one and a half movements is allowed; the first excess is rounded away."""
        movement = Vector3(0.0, 0.0, -0.25)
        at_limit, rounded, beyond = path(), path(), path()
        assert square().adjust_sphere_to_plane(at_limit, ball(5.0, 5.0, 0.125, 0.5), movement) == 1
        assert at_limit.walk_interp == -0.5
        lower = ball(5.0, 5.0, next32(0.125, -1), 0.5)
        assert square().adjust_sphere_to_plane(rounded, lower, movement) == 1
        assert rounded.walk_interp == -0.5
        too_low = ball(5.0, 5.0, next32(0.125, -2), 0.5)
        assert square().adjust_sphere_to_plane(beyond, too_low, movement) == 0
        assert (beyond.walk_interp, too_low.center.z) == (1.0, next32(0.125, -2))

    def test_a_negative_rest_turns_the_comparison_round(self) -> None:
        """Once walk_interp is negative only a movement forward is accepted."""
        movement = Vector3(0.0, 0.0, -0.25)
        refused, accepted = path(walk_interp=-0.25), path(walk_interp=-0.25)
        assert square().adjust_sphere_to_plane(refused, ball(5.0, 5.0, 0.375, 0.5), movement) == 0
        assert square().adjust_sphere_to_plane(accepted, ball(5.0, 5.0, 0.625, 0.5), movement) == 1
        assert accepted.walk_interp == -0.375

    def test_moving_out_of_the_front_reads_the_other_formula(self) -> None:
        """With the normal only a sphere wholly behind is moved, by minus radius minus distance."""
        up = Vector3(0.0, 0.0, 1.0)
        sphere_path, sphere = path(), ball(5.0, 5.0, -0.75, 0.5)
        assert square().adjust_sphere_to_plane(sphere_path, sphere, up) == 1
        assert (sphere.center.z, sphere_path.walk_interp) == (-1.0, 0.75)
        assert square().adjust_sphere_to_plane(path(), ball(5.0, 5.0, -0.25, 0.5), up) == 0

    @given(
        height=st.floats(-0.5, 0.5, width=32),
        movement=st.tuples(*[st.floats(-2.0, 2.0, width=32)] * 3),
        walk_interp=st.floats(0.0625, 1.0, width=32),
    )
    def test_an_accepted_sphere_rests_in_front_and_has_less_to_walk(
        self, height: float, movement: tuple[float, ...], walk_interp: float
    ) -> None:
        """Against the normal a success means: at +radius, with a smaller walk_interp of at least -1/2."""
        sphere_path, sphere = path(walk_interp=walk_interp), ball(5.0, 5.0, height, 0.5)
        if movement[2] > 0.0 or not square().adjust_sphere_to_plane(sphere_path, sphere, Vector3(*movement)):
            return
        assert abs(sphere.center.z - 0.5) <= RESTING_BOUND
        assert -0.5 <= sphere_path.walk_interp <= walk_interp


class TestAdjustSphereToPoly:
    """The time at which a sphere from its current centre touches the plane."""

    def test_the_time_is_a_register(self) -> None:
        """One third is not rounded to float32."""
        t = square().adjust_sphere_to_poly(
            ball(0.0, 0.0, 0.0, 0.5), Vector3(5.0, 5.0, 1.5), Vector3(0.0, 0.0, -3.0)
        )
        assert t == 1.0 / 3.0

    def test_touching_at_the_start_is_exactly_one(self, next32: Step) -> None:
        """Nearer than the radius is 1; exactly the radius away the time is 0."""
        down, sphere = Vector3(0.0, 0.0, -1.0), ball(0.0, 0.0, 0.0, 0.5)
        assert square().adjust_sphere_to_poly(sphere, Vector3(5.0, 5.0, next32(0.5, -1)), down) == 1.0
        assert square().adjust_sphere_to_poly(sphere, Vector3(5.0, 5.0, 0.5), down) == 0.0
        assert square().adjust_sphere_to_poly(sphere, Vector3(5.0, 5.0, next32(-0.5, 1)), down) == 1.0

    def test_movement_along_the_plane_is_exactly_zero(self, next32: Step) -> None:
        """Slower than EPS there is no time; at EPS there is a huge one."""
        sphere, curr = ball(0.0, 0.0, 0.0, 0.5), Vector3(5.0, 5.0, 1.0)
        assert square().adjust_sphere_to_poly(sphere, curr, Vector3(1.0, 0.0, next32(-EPS, 1))) == 0.0
        assert square().adjust_sphere_to_poly(sphere, curr, Vector3(1.0, 0.0, -EPS)) == 0.5 / EPS

    def test_from_behind_it_touches_behind(self) -> None:
        """On or behind the plane the touching distance is minus the radius."""
        sphere = ball(0.0, 0.0, 0.0, 0.5)
        up = Vector3(0.0, 0.0, 1.0)
        assert square().adjust_sphere_to_poly(sphere, Vector3(5.0, 5.0, -1.0), up) == 0.5
        point = ball(0.0, 0.0, 0.0, 0.0)
        assert math.copysign(1.0, square().adjust_sphere_to_poly(point, Vector3(5.0, 5.0, 0.0), up)) == -1.0


class TestAdjustToPlacementPoly:
    """Pushing two spheres along the normal."""

    @pytest.mark.parametrize(
        ("height", "center_solid", "solid_check", "pushed"),
        [
            (0.25, 0, 0, 0.5),
            (-0.25, 1, 0, 0.5),
            (0.25, 0, 1, 0.5),
            (0.25, 1, 1, -0.5),
            (-0.25, 0, 1, -0.5),
            (-0.25, 1, 1, 0.5),
            (0.0, 0, 1, -0.5),
            (0.0, 1, 1, 0.5),
        ],
    )
    def test_two_independent_flips(
        self, height: float, center_solid: int, solid_check: int, pushed: float
    ) -> None:
        """A solid centre flips, being on or behind the plane flips, both together do not."""
        struck, other = ball(5.0, 5.0, height, 0.5), ball(5.0, 5.0, 1.0, 0.5)
        square().adjust_to_placement_poly(struck, other, 0.5, center_solid, solid_check)
        assert struck.center.z == pushed
        assert other.center.z == 1.0 + (pushed - height)

    def test_the_push_is_along_the_normal_for_the_given_radius(self) -> None:
        """The radius is the argument, not the sphere's; both spheres take the same push."""
        wall = Polygon([Vector3(0.0, 0.0, 0.0), Vector3(0.0, 1.0, 0.0), Vector3(0.0, 1.0, 1.0)])
        struck, other = ball(0.25, 0.0, 0.0, 0.5), ball(-7.0, 1.0, 2.0, 0.5)
        wall.adjust_to_placement_poly(struck, other, 2.0, 0, 0)
        assert (struck.center.x, struck.center.y, struck.center.z) == (2.0, 0.0, 0.0)
        assert (other.center.x, other.center.y, other.center.z) == (-5.25, 1.0, 2.0)
        assert f32(struck.radius) == 0.5
