"""CCylSphere as an obstacle: overlap, which response is chosen, and resting upon the upper cap.

The cylinder stands on the origin, 2 metres high; with its radius of 1.5 and the mover's 0.5 the radii
make 2. A sphere of 0.5 overlaps it from -0.5 to 2.5, less EPS.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest
from oracle_obstacles import ATOM, EAST_CELL, approaching, contact, moved_by, stepping
from oracle_worlds import CELL, at, trace_of, vec, xyz

from oracle.arithmetic import f32
from oracle.constants import EPS, Z_LANDING
from oracle.cyl_sphere import CylSphere
from oracle.enums import (
    CONTACT_OI,
    ON_WALKABLE_OI,
    PATH_CLIPPED_OI,
    PERFECT_CLIP_OI,
    InsertType,
    TransitionState,
)
from oracle.frame import Frame
from oracle.plane import Plane
from oracle.position import Position
from oracle.sphere import Sphere
from oracle.vector import Vector3

if TYPE_CHECKING:
    from collections.abc import Callable

    from oracle.transition import Transition

    Step = Callable[[float, int], float]

OK, COLLIDED = TransitionState.OK, TransitionState.COLLIDED
ADJUSTED, SLID = TransitionState.ADJUSTED, TransitionState.SLID

RADSUM = f32((1.5 - EPS) + 0.5)
"""The radius sum, in the cylinder's order."""
TOP = 2.5 - EPS
"""How high a sphere of 0.5 still overlaps; a double."""
BELOW_TOP = 2.5 - 2.0**-12
"""A float32 that is below `TOP`."""
LEVEL = Plane(vec(0.0, 0.0, 1.0), 0.0)


def cylinder() -> CylSphere:
    """Return the cylinder."""
    return CylSphere(vec(0.0, 0.0, 0.0), 2.0, 1.5)


def ask(made: Transition) -> TransitionState:
    """Test the path against the cylinder."""
    return cylinder().intersects_sphere(made)


def test_a_cylinder_shows_its_numbers() -> None:
    """A failure message can be read."""
    assert repr(cylinder()) == "CylSphere(Vector3(0.0, 0.0, 0.0), 2.0, 1.5)"


class TestCollides:
    """CCylSphere::collides_with_sphere (07 10.1)."""

    def hit(self, x: float, y: float, z: float, *, radius: float = 0.5, radsum: float = 5.0) -> bool:
        """Ask about a sphere."""
        return cylinder().collides_with_sphere(Sphere(vec(0.0, 0.0, 0.0), radius), Vector3(x, y, z), radsum)

    def test_beside(self, next32: Step) -> None:
        """07 10.1.1: 3, 4 and 5 touch; one ULP more in either direction does not."""
        assert self.hit(3.0, 4.0, 1.0)
        assert not self.hit(3.0, next32(4.0, 1), 1.0)
        assert not self.hit(-next32(3.0, 1), -4.0, 1.0)

    @pytest.mark.parametrize(("last", "further"), [(TOP, 2.0**-51), (EPS - 0.5, -(2.0**-51))])
    def test_above_and_below(self, last: float, further: float) -> None:
        """07 10.1.2: (0.5 - EPS) + 1 against |1 - z|: from 0.5 - EPS below to 2.5 - EPS."""
        assert self.hit(0.0, 0.0, last)
        assert not self.hit(0.0, 0.0, last + further)

    def test_the_height_is_that_of_the_sphere_asked_about(self) -> None:
        """07 10.1: its own radius counts upward, the given sum sideways."""
        assert self.hit(0.0, 0.0, 3.5, radius=2.0)
        assert not self.hit(0.0, 0.0, 3.5, radius=1.0)
        assert not self.hit(1.0, 0.0, 1.0, radius=2.0, radsum=0.5)


class TestChoice:
    """CCylSphere::intersects_sphere, which of the responses (07 10.8)."""

    @pytest.mark.parametrize(
        "mode", [{"insert_type": InsertType.PLACEMENT}, {"obstruction_ethereal": 1}, {"check_walkable": 1}]
    )
    def test_placement_ethereal_and_walkable_only_look(self, mode: dict[str, int], next32: Step) -> None:
        """07 10.8.1, 10.8.2, 10.8.4: overlap up to f32((1.5 - EPS) + 0.5), the head by the same sum."""
        more = {"collide": 1, **mode}
        for x, result in ((RADSUM, COLLIDED), (next32(RADSUM, 1), OK)):
            feet = approaching((4.0, 0.0, 1.0), (x, 0.0, 1.0), **more)
            assert (ask(feet), trace_of(feet)) == (result, f"C{result.value}")
            head = approaching((4.0, 0.0, 1.0), (4.0, 0.0, 1.0), head=(x, 0.0, 1.0), head_radius=9.0, **more)
            assert ask(head) == result
            assert head.collision_info.collision_normal_valid == 0

    @pytest.mark.parametrize("mode", [{"insert_type": InsertType.PLACEMENT}, {"obstruction_ethereal": 1}])
    def test_looking_comes_before_stepping_down(self, mode: dict[str, int]) -> None:
        """07 10.8.2, 10.8.3: an ethereal one is no ground."""
        made = approaching((0.0, 0.0, 2.25), (0.0, 0.0, 2.25), step_down=1, **mode)
        assert ask(made) == COLLIDED
        assert contact(made)[0] == 0

    def test_a_step_down(self) -> None:
        """07 10.8.3: before the walkable check, and whatever the object is."""
        made = approaching((0.0, 0.0, 2.25), (0.0, 0.0, 2.25), step_down=1, check_walkable=1, collide=1)
        assert ask(made) == ADJUSTED
        assert moved_by(made, (0.0, 0.0, 2.25)) == (0.0, 0.0, 0.25)

    @pytest.mark.parametrize("state", [CONTACT_OI, ON_WALKABLE_OI, CONTACT_OI | PATH_CLIPPED_OI])
    def test_on_the_ground_feet_step_up(self, state: int, next32: Step) -> None:
        """07 10.8.5: with the normal of the side that they came from."""
        for x, normals in ((RADSUM, [(1.0, 0.0, 0.0)]), (next32(RADSUM, 1), [])):
            made = approaching((3.0, 0.0, 1.0), (x, 0.0, 1.0), state=state)
            made.object_info.step_up_height = 5.0
            made.sphere_path.localspace_pos.assign(at(0.0, 0.0, 0.0))
            stepped = stepping(made, succeeds=1)
            assert ask(stepped) == OK
            assert stepped.step_up_normals == normals

    @pytest.mark.parametrize("state", [CONTACT_OI, ON_WALKABLE_OI])
    def test_on_the_ground_the_head_slides(self, state: int, next32: Step) -> None:
        """07 10.8.5, 10.5: the head from (-3, 0, 1) to (-1.5, 0.5, 1), by its own way: y remains."""
        check = (-4.0, 0.5, -3.0)
        made = approaching((-5.5, 0.0, -3.0), check, head=(-1.5, 0.5, 1.0), state=state)
        made.collision_info.set_contact_plane(LEVEL, 0)
        assert ask(made) == SLID
        assert moved_by(made, check) == (-1.5, 0.0, 0.0)
        assert xyz(made.collision_info.collision_normal) == (-1.0, 0.0, 0.0)

    @pytest.mark.parametrize("state", [CONTACT_OI, PATH_CLIPPED_OI, 0])
    def test_what_is_beside_is_free(self, state: int, next32: Step) -> None:
        """07 10.8.5: neither feet nor head, or no head."""
        x = next32(RADSUM, 1)
        made = approaching((9.0, 0.0, 1.0), (9.0, 0.0, 1.0), head=(x, 0.0, 1.0), state=state)
        assert ask(made) == OK
        assert ask(approaching((9.0, 0.0, 1.0), (x, 0.0, 1.0), state=state)) == OK

    @pytest.mark.parametrize(
        "mode", [{"state": CONTACT_OI}, {}, {"check_walkable": 1}, {"step_down": 1}, {"collide": 1}]
    )
    def test_a_head_that_the_mover_does_not_have_is_not_looked_at(self, mode: dict[str, int]) -> None:
        """07 10.8: whatever the second sphere's place holds from an earlier path."""
        made = approaching((9.0, 0.0, 1.0), (9.0, 0.0, 1.0), **mode)
        made.sphere_path.global_sphere[1].assign(Sphere(vec(0.0, 0.0, 1.0), 0.5))
        assert ask(made) == OK

    def test_a_clipped_path_ends_at_the_feet(self) -> None:
        """07 10.8.5, 10.4.2: the normal of the side, normalised; the head is never tested."""
        made = approaching((4.0, 0.0, 1.0), (RADSUM, 0.0, 1.0), state=PATH_CLIPPED_OI)
        assert ask(made) == COLLIDED
        assert xyz(made.collision_info.collision_normal) == (1.0, 0.0, 0.0)
        head = approaching((9.0, 0.0, 1.0), (9.0, 0.0, 1.0), head=(0.0, 0.0, 1.0), state=PATH_CLIPPED_OI)
        assert ask(head) == OK

    def test_in_the_air_feet_begin_to_land(self) -> None:
        """07 10.8.5, 10.7: from above."""
        made = approaching((0.0, 0.0, 3.0), (0.0, 0.0, BELOW_TOP))
        assert ask(made) == ADJUSTED
        sp = made.sphere_path
        assert (sp.collide, xyz(sp.step_up_normal), sp.walkable_allowance) == (1, (0.0, 0.0, 1.0), Z_LANDING)

    def test_in_the_air_the_head_collides(self) -> None:
        """07 10.8.5, 10.4: the head was at (0, 4, 1), the feet at (4, 4, 1)."""
        made = approaching((4.0, 4.0, 1.0), (4.0, 0.0, 1.0), head=(0.0, 0.0, 1.0))
        assert ask(made) == COLLIDED
        assert xyz(made.collision_info.collision_normal) == (0.0, 1.0, 0.0)

    def test_in_the_air_a_perfect_head_is_stopped(self) -> None:
        """07 10.4.3: by the way of the *feet*, from (0, -4, 1) to the head at (0, -1, 1): t = 2/3."""
        check = (4.0, -1.0, 1.0)
        made = approaching((0.0, -4.0, 1.0), check, head=(0.0, -1.0, 1.0), state=PERFECT_CLIP_OI)
        assert ask(made) == ADJUSTED
        off = f32(f32((12.0 - 6.0) / 9.0) * 3.0)
        assert moved_by(made, check) == (0.0, f32(f32(off - 4.0) + 1.0), 0.0)


def rest(made: Transition) -> TransitionState:
    """Let a landing mover rest upon the cylinder; every step below is of 07 10.8.6."""
    made.sphere_path.collide = 1
    return ask(made)


class TestRest:
    """CCylSphere::intersects_sphere, a landing (07 10.8.6)."""

    def test_misses_are_free(self, next32: Step) -> None:
        """10.8.6: neither sphere overlaps."""
        for x, free in ((RADSUM, False), (next32(RADSUM, 1), True)):
            assert (rest(approaching((x, 0.0, 3.0), (x, 0.0, 2.0))) == OK) is free
            head = approaching((9.0, 0.0, 3.0), (9.0, 0.0, 3.0), head=(x, 0.0, 1.0))
            assert (rest(head) == OK) is free

    def test_half_the_way_back(self) -> None:
        """10.8.6.1…5: mv = (0, 0, 1), T = (2 + 0.5 - 2)/1; the plane is the cap, and counts as water."""
        check = (0.25, 0.0, 2.0)
        made = approaching((0.25, 0.0, 3.0), check)
        assert rest(made) == ADJUSTED
        assert moved_by(made, check) == (0.0, 0.0, 0.5)
        assert contact(made) == (1, (0.0, 0.0, 1.0, -2.0), 1, CELL)
        assert made.sphere_path.walk_interp == 0.5

    def test_the_interpolation_shrinks(self) -> None:
        """10.8.6.4, 10.8.6.5: half of the half that is left."""
        made = approaching((0.0, 0.0, 3.0), (0.0, 0.0, 2.0), walk_interp=0.5)
        assert rest(made) == ADJUSTED
        assert made.sphere_path.walk_interp == 0.25

    def test_a_slanted_way(self) -> None:
        """10.8.6.2: mv = (-1, 0.5, 1), half of it."""
        check = (1.0, 0.0, 2.0)
        made = approaching((0.0, 0.5, 3.0), check)
        assert rest(made) == ADJUSTED
        assert moved_by(made, check) == (-0.5, 0.25, 0.5)

    def test_a_level_way_collides(self) -> None:
        """10.8.6.1: |mv.z| below EPS: 2^-13 is, 2^-12 is not, and leads just up to the cap."""
        for rise, result in ((2.0**-13, COLLIDED), (2.0**-12, ADJUSTED)):
            made = approaching((1.0, 0.0, BELOW_TOP + rise), (0.0, 0.0, BELOW_TOP))
            assert rest(made) == result

    def test_beside_the_cap_it_is_free(self) -> None:
        """10.8.6.3: the radius sum itself still rests; 2^-22 further out nothing is changed."""
        for x, result in ((0.0, ADJUSTED), (2.0 * ATOM, OK)):
            made = approaching((RADSUM + x, 0.0, 3.0), (RADSUM, 0.0, 2.0))
            assert rest(made) == result
            assert contact(made)[0] == int(result == ADJUSTED)
            made = approaching((0.0, RADSUM + x, 3.0), (0.0, RADSUM, 2.0))
            assert rest(made) == result

    def test_no_way_back_left(self) -> None:
        """10.8.6.4: feet at 2.5 (only the head overlaps) have T = 0 and w = 1, which is no less than 1."""
        for z, result in ((2.5, COLLIDED), (2.5 - ATOM, ADJUSTED)):
            made = approaching((0.0, 0.0, z + 1.0), (0.0, 0.0, z), head=(0.0, 0.0, 1.0))
            assert rest(made) == result

    @pytest.mark.parametrize(("t", "result"), [(1.125, COLLIDED), (1.09375, ADJUSTED)])
    def test_too_far_back(self, t: float, result: TransitionState) -> None:
        """10.8.6.4: 1 - 1.125 is below -0.1, 1 - 1.09375 is not."""
        made = approaching((0.0, 0.0, 3.5 - t), (0.0, 0.0, 2.5 - t))
        assert rest(made) == result
        assert made.sphere_path.walk_interp == (1.0 - t if result == ADJUSTED else 1.0)

    def test_the_lowest_interpolation_counts(self) -> None:
        """10.8.6.4: (1 - 2) * 0.1 is -0.1 itself; 0.1 as a double, which only a test can store."""
        made = approaching((0.0, 0.0, 1.5), (0.0, 0.0, 0.5), walk_interp=0.1)
        assert rest(made) == ADJUSTED
        assert made.sphere_path.walk_interp == f32(-0.1)

    def test_across_a_border(self) -> None:
        """10.8.6.1: from 190 to -1 of the block 192 metres east: mv.x = 190 + 1 - 192 = -1."""
        check = (-1.0, 0.0, 2.0)
        made = approaching((190.0, 0.0, 3.0), check, to_cell=EAST_CELL)
        assert rest(made) == ADJUSTED
        assert moved_by(made, check) == (-0.5, 0.0, 0.5)
        assert contact(made)[3] == EAST_CELL


class TestLocalForm:
    """CCylSphere::intersects_sphere of an object's setup (07 10.9)."""

    def test_scaled_and_moved(self, next32: Step) -> None:
        """07 10.9.2: radius 2 * 0.75, height 2 * 1, low point doubled and turned by 180 degrees about z."""
        p = Position(CELL, Frame.unpack(vec(2.0, 0.0, -1.0), 0.0, 0.0, 0.0, 1.0))
        shape = CylSphere(vec(1.0, 0.0, 0.5), 1.0, 0.75)
        for check, result in (
            ((RADSUM, 0.0, 1.0), COLLIDED),
            ((next32(RADSUM, 1), 0.0, 1.0), OK),
            ((0.0, 0.0, BELOW_TOP), COLLIDED),
            ((0.0, 0.0, 2.5), OK),
        ):
            made = approaching(check, check, insert_type=InsertType.PLACEMENT)
            assert shape.intersects_sphere_at(p, 2.0, made) == result

    def test_it_stands_upright_whatever_the_rotation(self) -> None:
        """07 10: turned upside down about x, the low point goes to z = -1; the height still goes up."""
        p = Position(CELL, Frame.unpack(vec(0.0, 0.0, 0.0), 0.0, 1.0, 0.0, 0.0))
        shape = CylSphere(vec(0.0, 0.0, 1.0), 2.0, 1.5)
        for z, result in ((1.25, COLLIDED), (1.75, OK), (-1.25, COLLIDED), (-1.75, OK)):
            made = approaching((0.0, 0.0, z), (0.0, 0.0, z), insert_type=InsertType.PLACEMENT)
            assert shape.intersects_sphere_at(p, 1.0, made) == result

    def test_local_space_becomes_the_object_s_unscaled(self) -> None:
        """07 10.9.1: first of all, whatever the outcome, at scale 1."""
        p = at(1.0, 2.0, 3.0)
        made = approaching((8.0, 8.0, 8.0), (9.0, 8.0, 8.0))
        assert cylinder().intersects_sphere_at(p, 4.0, made) == OK
        sp = made.sphere_path
        assert xyz(sp.localspace_pos.frame.origin) == (1.0, 2.0, 3.0)
        assert (xyz(sp.localspace_sphere[0].center), sp.localspace_sphere[0].radius) == ((8.0, 6.0, 5.0), 0.5)

    def test_an_object_of_the_next_block(self) -> None:
        """07 10.9.2: seen from the block of the check position, the object at x = 1 is at 193."""
        for cell, result in ((EAST_CELL, COLLIDED), (CELL, OK)):
            made = approaching((192.0, 0.0, 1.0), (192.0, 0.0, 1.0), insert_type=InsertType.PLACEMENT)
            assert cylinder().intersects_sphere_at(at(1.0, 0.0, 0.0, cell), 1.0, made) == result
