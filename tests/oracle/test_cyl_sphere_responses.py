"""CCylSphere, what is done about a hit: step down and up, slide, land, and where the mover came from.

The cylinder stands on the origin, 2 metres high; with `TWO` the radii make exactly 2.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import pytest
from oracle_obstacles import ATOM, TWO, approaching, contact, moved_by, stepping
from oracle_worlds import CELL, at, vec, xyz

from oracle.constants import EPS, Z_LANDING
from oracle.cyl_sphere import CylSphere
from oracle.enums import TransitionState
from oracle.frame import Frame
from oracle.plane import Plane
from oracle.position import Position
from oracle.sphere import Sphere
from oracle.vector import Vector3

if TYPE_CHECKING:
    from collections.abc import Callable

    from oracle.transition import Transition

    Step = Callable[[float, int], float]
    Point = tuple[float, float, float]

OK, COLLIDED = TransitionState.OK, TransitionState.COLLIDED
ADJUSTED, SLID = TransitionState.ADJUSTED, TransitionState.SLID

TOP = 2.5 - EPS
"""How high a sphere of 0.5 still overlaps; a double."""
NEAR = EPS / 2.0
"""A distance, metres, that is too short for a normal."""
LEVEL = Plane(vec(0.0, 0.0, 1.0), 0.0)


def cylinder() -> CylSphere:
    """Return the cylinder."""
    return CylSphere(vec(0.0, 0.0, 0.0), 2.0, 1.5)


def disp_of(made: Transition, sphere_num: int = 0) -> Vector3:
    """Return the way from the low point, the origin, to one of the mover's spheres."""
    return Vector3(*xyz(made.sphere_path.global_sphere[sphere_num].center))


class TestStepDown:
    """CCylSphere::step_sphere_down (07 10.2)."""

    def lower(self, made: Transition) -> TransitionState:
        """Step down onto the cylinder."""
        path, s0 = made.sphere_path, made.sphere_path.global_sphere[0]
        return cylinder().step_sphere_down(path, made.collision_info, s0, disp_of(made), TWO)

    def test_raised_onto_the_cap(self) -> None:
        """07 10.2.3…7: dz = 2 + 0.5 - 2.25; the plane is the cap whatever x and y, and counts as water."""
        check = (0.25, -0.5, 2.25)
        made = approaching(check, check)
        assert self.lower(made) == ADJUSTED
        assert moved_by(made, check) == (0.0, 0.0, 0.25)
        assert contact(made) == (1, (0.0, 0.0, 1.0, -2.0), 1, CELL)
        assert made.sphere_path.walk_interp == 0.75

    def test_amount_and_interpolation(self) -> None:
        """07 10.2.2, 10.2.4: sd = 4 * 0.5, w = (1 - 0.25/2) * 0.5."""
        made = approaching((0.0, 0.0, 2.25), (0.0, 0.0, 2.25), step_down_amt=4.0, walk_interp=0.5)
        assert self.lower(made) == ADJUSTED
        assert moved_by(made, (0.0, 0.0, 2.25)) == (0.0, 0.0, 0.25)
        assert made.sphere_path.walk_interp == 0.4375

    def test_what_does_not_overlap(self) -> None:
        """07 10.2.1: feet at 2.5 - EPS do; the next double does not, with one sphere or a head beside."""
        for z, result in ((TOP, ADJUSTED), (math.nextafter(TOP, 3.0), OK)):
            made = approaching((0.0, 0.0, 0.0), (0.0, 0.0, 0.0))
            made.sphere_path.global_sphere[0].center.z = z
            assert self.lower(made) == result
        check = (0.0, 0.0, 3.0)
        assert self.lower(approaching(check, check, head=(2.5, 0.0, 1.0))) == OK

    def test_no_way_down(self) -> None:
        """07 10.2.2: |amount * interpolation| below EPS; EPS itself raises by EPS, to w = 0."""
        for amount, result in ((EPS, ADJUSTED), (math.nextafter(EPS, 0.0), COLLIDED), (-NEAR, COLLIDED)):
            made = approaching((0.0, 0.0, 0.0), (0.0, 0.0, 0.0), step_down_amt=amount)
            made.sphere_path.global_sphere[0].center.z = TOP
            assert self.lower(made) == result
            assert made.sphere_path.walk_interp == (0.0 if result == ADJUSTED else 1.0)

    def test_the_head_sends_the_feet(self) -> None:
        """07 10.2.3, 10.2.4: feet at 2.5 have nothing to rise; 2^-22 lower they rise by that."""
        for z, result in ((2.5, COLLIDED), (2.5 - ATOM, ADJUSTED)):
            made = approaching((0.0, 0.0, z), (0.0, 0.0, z), head=(0.0, 0.0, 1.0))
            assert self.lower(made) == result
            assert moved_by(made, (0.0, 0.0, z)) == (0.0, 0.0, ATOM if result == ADJUSTED else 0.0)

    @pytest.mark.parametrize(
        ("rise", "result"),
        [(1.125, COLLIDED), (1.1, COLLIDED), (1.0999999999999999, ADJUSTED), (1.09375, ADJUSTED)],
    )
    def test_too_far_up(self, rise: float, result: TransitionState) -> None:
        """07 10.2.4: 1 - 1.1 is below -0.1 as a double, 1 - 1.0999999999999999 is not."""
        made = approaching((0.0, 0.0, 0.0), (0.0, 0.0, 0.0))
        made.sphere_path.global_sphere[0].center.z = 2.5 - rise
        assert 2.5 - (2.5 - rise) == pytest.approx(rise, abs=2e-16)
        assert self.lower(made) == result


class TestNormal:
    """CCylSphere::normal_of_collision (07 10.3)."""

    def came_from(self, curr: Point, disp: Point, *, sphere_num: int = 0) -> tuple[int, Point]:
        """Return what the function returns, and the normal."""
        made = approaching((0.0, 0.0, 0.0), (0.0, 0.0, 0.0), head=(0.0, 0.0, 1.0))
        path, normal = made.sphere_path, vec(9.0, 9.0, 9.0)
        path.global_curr_center[sphere_num].assign(Vector3(*curr))
        ball = Sphere(vec(0.0, 0.0, 0.0), 0.5)
        definite = cylinder().normal_of_collision(path, ball, Vector3(*disp), 5.0, sphere_num, normal)
        return definite, xyz(normal)

    def test_beside_or_not(self, next32: Step) -> None:
        """07 10.3.2: 3, 4 and 5: at the radius sum it was above; one ULP further out beside, no unit."""
        assert self.came_from((3.0, 4.0, 9.0), (0.0, 0.0, 1.0)) == (1, (0.0, 0.0, 1.0))
        further = next32(4.0, 1)
        assert self.came_from((3.0, further, 1.0), (0.0, 0.0, 1.0)) == (1, (3.0, further, 0.0))
        further = next32(3.0, 1)
        assert self.came_from((-further, -4.0, 1.0), (0.0, 0.0, 1.0)) == (1, (-further, -4.0, 0.0))

    def test_the_low_point_is_subtracted(self) -> None:
        """07 10.3.1: in every axis."""
        made = approaching((17.0, 21.0, 31.0), (17.0, 21.0, 31.0))
        normal = Vector3()
        other = CylSphere(vec(10.0, 20.0, 30.0), 2.0, 1.5)
        s0 = made.sphere_path.global_sphere[0]
        assert other.normal_of_collision(made.sphere_path, s0, vec(7.0, 1.0, 1.0), 5.0, 0, normal) == 1
        assert xyz(normal) == (7.0, 1.0, 0.0)

    @pytest.mark.parametrize(("last", "further"), [(TOP, 2.0**-20), (EPS - 0.5, -(2.0**-20))])
    def test_beside_the_cylinder_s_height_it_is_definite(self, last: float, further: float) -> None:
        """07 10.3.2: the sphere was as high as the cylinder, to 0.5 - EPS below and above.

        The height where it was is stored, so the step is one that float32 sees.
        """
        assert self.came_from((9.0, 0.0, last - further), (0.0, 0.0, -50.0))[0] == 1
        assert self.came_from((9.0, 0.0, last + further), (0.0, 0.0, -50.0))[0] == 0

    def test_a_level_way_is_definite(self) -> None:
        """07 10.3.2: above, but by no more than EPS lower now (10 - EPS is exact as a double)."""
        for z, definite in ((10.0 - EPS, 1), (10.0 - EPS - 2.0**-49, 0), (10.0 + EPS, 1)):
            assert self.came_from((9.0, 0.0, 10.0), (0.0, 0.0, z))[0] == definite
        assert self.came_from((9.0, 0.0, 10.0), (0.0, 0.0, 10.0 + EPS + 2.0**-49))[0] == 0

    def test_from_above_or_below(self, next32: Step) -> None:
        """07 10.3.3: moving up it came from below; level or down from above."""
        for z, up in ((1.0, 1.0), (next32(1.0, 1), -1.0), (next32(1.0, -1), 1.0)):
            assert self.came_from((1.0, 1.0, 1.0), (0.0, 0.0, z)) == (1, (0.0, 0.0, up))

    def test_the_sphere_asked_about(self) -> None:
        """07 10.3.1: each by its own current centre."""
        assert self.came_from((9.0, 0.0, 1.0), (0.0, 0.0, 1.0), sphere_num=1) == (1, (9.0, 0.0, 0.0))


class TestSlide:
    """CCylSphere::slide_sphere (07 10.5)."""

    def slide(self, made: Transition, sphere_num: int, radsum: float = TWO) -> TransitionState:
        """Slide a sphere along the cylinder."""
        path = made.sphere_path
        made.collision_info.set_contact_plane(LEVEL, 0)
        s, disp = path.global_sphere[sphere_num], disp_of(made, sphere_num)
        return cylinder().slide_sphere(path, made.collision_info, s, disp, radsum, sphere_num)

    def test_along_the_side(self) -> None:
        """07 10.5.3: from (-3, 0, 1) by (1.5, 0.5, 0): y remains."""
        check = (-1.5, 0.5, 1.0)
        made = approaching((-3.0, 0.0, 1.0), check)
        assert self.slide(made, 0) == SLID
        assert moved_by(made, check) == (-1.5, 0.0, 0.0)

    def test_the_head_by_its_own_way(self) -> None:
        """07 10.5.1, 10.5.3: from (0, -3, 1), while the feet came from above."""
        check = (0.5, -1.5, 3.0)
        made = approaching((0.0, -3.0, 3.0), check, head=(0.5, -1.5, 1.0))
        made.sphere_path.global_curr_center[0].assign(vec(0.0, 0.0, 9.0))
        assert self.slide(made, 1) == SLID
        assert xyz(made.collision_info.collision_normal) == (0.0, -1.0, 0.0)
        assert moved_by(made, check) == (0.0, -1.5, 0.0)

    def test_a_definite_normal_is_not_needed(self) -> None:
        """07 10.5.1: from beside and above, the answer 0 is not looked at."""
        made = approaching((-3.0, 0.0, 9.0), (-1.5, 0.5, 1.0))
        assert self.slide(made, 0) == SLID
        assert xyz(made.collision_info.collision_normal) == (-1.0, 0.0, 0.0)

    def test_from_the_axis_it_collides(self) -> None:
        """07 10.5.2: with radii of 0, beside by less than EPS: no normal, and none set; EPS has one."""
        for x, result in ((EPS, SLID), (NEAR, COLLIDED)):
            made = approaching((x, 0.0, 1.0), (0.5, 0.5, 1.0))
            assert self.slide(made, 0, radsum=0.0) == result
            assert made.collision_info.collision_normal_valid == int(result == SLID)


class TestStepUp:
    """CCylSphere::step_sphere_up (07 10.6)."""

    def step(self, made: Transition, radsum: float = TWO) -> TransitionState:
        """Step up onto the cylinder."""
        s0 = made.sphere_path.global_sphere[0]
        return cylinder().step_sphere_up(made, s0, disp_of(made), radsum)

    def test_too_high(self, next32: Step) -> None:
        """07 10.6.1: (0.5 + 2) - 1.5 metres are stepped if the mover steps 1 metre, and no ULP less."""
        for height, stepped in ((1.0, True), (next32(1.0, -1), False)):
            made = stepping(approaching((-3.0, 0.0, 1.5), (-1.5, 0.5, 1.5)), succeeds=1)
            made.collision_info.set_contact_plane(LEVEL, 0)
            made.object_info.step_up_height = height
            assert self.step(made) == (OK if stepped else SLID)
            assert bool(made.step_up_normals) is stepped

    def test_the_normal_is_turned_by_the_object(self) -> None:
        """07 10.6.3: a world normal, turned once more: by 180 degrees about z it points the wrong way."""
        made = approaching((-3.0, 0.0, 1.5), (-1.5, 0.0, 1.5))
        made.object_info.step_up_height = 5.0
        frame = Frame.unpack(vec(0.0, 0.0, 0.0), 0.0, 0.0, 0.0, 1.0)
        made.sphere_path.localspace_pos.assign(Position(CELL, frame))
        stepped = stepping(made, succeeds=1)
        assert self.step(stepped) == OK
        assert stepped.step_up_normals == [(1.0, 0.0, 0.0)]

    def test_a_failed_step_slides(self) -> None:
        """07 10.6.4: step_up_slide answers, with the path's own normal; the contact plane is given up."""
        check = (-1.5, 0.5, 1.5)
        made = approaching((-3.0, 0.0, 1.5), check, step_up=1)
        made.object_info.step_up_height = 5.0
        made.collision_info.set_contact_plane(LEVEL, 0)
        made.collision_info.last_known_contact_plane.assign(LEVEL)
        made.sphere_path.step_up_normal.assign(vec(0.0, -1.0, 0.0))
        assert self.step(stepping(made, succeeds=0)) == SLID
        assert moved_by(made, check) == (0.0, -0.5, 0.0)
        assert (made.sphere_path.step_up, contact(made)[0]) == (0, 0)

    def test_from_the_axis_it_collides(self) -> None:
        """07 10.6.2: nothing is tried without a normal."""
        for x, result in ((EPS, OK), (NEAR, COLLIDED)):
            made = stepping(approaching((x, 0.0, 1.5), (0.0, 0.0, 1.5)), succeeds=1)
            made.object_info.step_up_height = 5.0
            made.sphere_path.localspace_pos.assign(at(0.0, 0.0, 0.0))
            assert self.step(made, radsum=0.0) == result
            assert len(made.step_up_normals) == int(result == OK)


class TestLand:
    """CCylSphere::land_on_cylinder (07 10.7)."""

    def test_a_landing_begins(self) -> None:
        """07 10.7.1, 10.7.3: from (-3, 0, 4): the normal of the side; the position is kept."""
        made = approaching((-3.0, 0.0, 4.0), (-1.0, 0.0, 2.0), walk_interp=0.25)
        sp = made.sphere_path
        assert cylinder().land_on_cylinder(sp, sp.global_sphere[0], disp_of(made), TWO) == ADJUSTED
        assert xyz(sp.step_up_normal) == (-1.0, 0.0, 0.0)
        assert (sp.collide, sp.walk_interp, sp.walkable_allowance) == (1, 1.0, Z_LANDING)
        assert xyz(sp.backup_check_pos.frame.origin) == (-1.0, 0.0, 2.0)

    def test_from_the_axis_it_collides(self) -> None:
        """07 10.7.2: nothing is changed."""
        made = approaching((NEAR, 0.0, 1.0), (0.0, 0.0, 1.0))
        sp = made.sphere_path
        assert cylinder().land_on_cylinder(sp, sp.global_sphere[0], disp_of(made), 0.0) == COLLIDED
        assert sp.collide == 0
