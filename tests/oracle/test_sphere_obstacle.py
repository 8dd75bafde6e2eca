"""CSphere as an obstacle: overlap, time of collision, which response is chosen, and resting upon it."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import pytest
from hypothesis import given
from hypothesis import strategies as st
from oracle_obstacles import (
    ATOM,
    EAST_CELL,
    RADSUM,
    approaching,
    contact,
    moved_by,
    stepping,
)
from oracle_worlds import CELL, at, trace_of, vec, xyz

from oracle.arithmetic import f32
from oracle.constants import EPS, Z_LANDING
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
from oracle.sphere_obstacle import collides_with_sphere, find_time_of_collision

if TYPE_CHECKING:
    from collections.abc import Callable

    from oracle.transition import Transition

    Step = Callable[[float, int], float]

OK, COLLIDED = TransitionState.OK, TransitionState.COLLIDED
ADJUSTED, SLID = TransitionState.ADJUSTED, TransitionState.SLID

LAST_INSIDE = 1.0000998973846436
"""The largest float32 whose square less 1 is below EPS."""
LEVEL = Plane(vec(0.0, 0.0, 1.0), 0.0)
LAST_STILL = 0.01414213515818119
"""The largest float32 whose square is below EPS."""


def obstacle(radius: float = 1.5) -> Sphere:
    """Return a sphere about the origin; with the mover's 0.5 the radii make 2."""
    return Sphere(vec(0.0, 0.0, 0.0), radius)


def ask(made: Transition, *, is_creature: bool = False) -> TransitionState:
    """Test the path against the obstacle."""
    return obstacle().intersects_sphere(made, is_creature=is_creature)


class TestCollides:
    """CSphere::collides_with_sphere (07 2)."""

    def test_touching_counts(self, next32: Step) -> None:
        """07 2.1: 3, 4 and 5 touch exactly; one ULP further they do not."""
        assert collides_with_sphere(vec(3.0, 4.0, 0.0), 5.0)
        assert not collides_with_sphere(vec(3.0, next32(4.0, 1), 0.0), 5.0)

    @pytest.mark.parametrize("disp", [(0.0, 3.0, 4.0), (4.0, 0.0, 3.0), (-3.0, -4.0, 0.0)])
    def test_every_direction_counts(self, disp: tuple[float, float, float], next32: Step) -> None:
        """07 2.1: 5 metres in any plane."""
        assert collides_with_sphere(vec(*disp), 5.0)
        assert not collides_with_sphere(vec(*disp), next32(5.0, -1))

    @given(st.tuples(*[st.floats(-50.0, 50.0, width=32)] * 3), st.floats(0.0, 100.0, width=32))
    def test_the_opposite_way_is_as_long(self, disp: tuple[float, float, float], radsum: float) -> None:
        """07 2.1: squares know no sign."""
        x, y, z = disp
        assert collides_with_sphere(vec(x, y, z), radsum) == collides_with_sphere(vec(-x, -y, -z), radsum)


class TestTime:
    """CSphere::find_time_of_collision (07 3)."""

    def test_the_first_touch(self) -> None:
        """07 3.8: a = 16, b = 12, c = 9 - 1; q = sqrt(144 - 128) = 4; (12 - 4)/16."""
        assert find_time_of_collision(vec(4.0, 0.0, 0.0), vec(-3.0, 0.0, 0.0), 1.0) == 0.5

    def test_beyond_the_movement(self) -> None:
        """07 3.8: a = 1, b = 3, c = 8, q = 1; (3 - 1)/1: the caller compares with 1."""
        assert find_time_of_collision(vec(1.0, 0.0, 0.0), vec(-3.0, 0.0, 0.0), 1.0) == 2.0

    def test_moving_away(self) -> None:
        """07 3.8: b = -12, so b - q < 0 and the root is (q - dot)/a = (4 - 12)/16."""
        assert find_time_of_collision(vec(-4.0, 0.0, 0.0), vec(-3.0, 0.0, 0.0), 1.0) == -0.5

    def test_inside_is_never(self, next32: Step) -> None:
        """07 3.4: c below EPS; the squared gap of the next float32 is not below any more."""
        x = LAST_INSIDE
        assert x * x - 1.0 < EPS
        assert find_time_of_collision(vec(4.0, 0.0, 0.0), vec(-x, 0.0, 0.0), 1.0) == -1.0
        y = next32(x, 1)
        b = 4.0 * y
        time = (b - math.sqrt(b * b - (y * y - 1.0) * 16.0)) / 16.0
        assert find_time_of_collision(vec(4.0, 0.0, 0.0), vec(-y, 0.0, 0.0), 1.0) == time > 0.0

    def test_without_movement_never(self, next32: Step) -> None:
        """07 3.6: a below EPS. With m = 2^-6: a = m², b = 3m, c = 8, q = m; 2m/m² = 128."""
        disp = vec(-3.0, 0.0, 0.0)
        assert find_time_of_collision(vec(2.0**-6, 0.0, 0.0), disp, 1.0) == 128.0
        assert find_time_of_collision(vec(2.0**-7, 0.0, 0.0), disp, 1.0) == -1.0
        assert LAST_STILL * LAST_STILL < EPS
        assert find_time_of_collision(vec(LAST_STILL, 0.0, 0.0), disp, 1.0) == -1.0
        assert find_time_of_collision(vec(next32(LAST_STILL, 1), 0.0, 0.0), disp, 1.0) > 100.0

    def test_passing_by_is_never(self, next32: Step) -> None:
        """07 3.6: beside at y = 1 the radicand is 144 - 9*16 = 0 and counts: 12/16; one ULP further not."""
        assert find_time_of_collision(vec(4.0, 0.0, 0.0), vec(-3.0, 1.0, 0.0), 1.0) == 0.75
        assert find_time_of_collision(vec(4.0, 0.0, 0.0), vec(-3.0, next32(1.0, 1), 0.0), 1.0) == -1.0


class TestChoice:
    """CSphere::intersects_sphere, which of the responses (07 8)."""

    @pytest.mark.parametrize("mode", [{"insert_type": InsertType.PLACEMENT}, {"obstruction_ethereal": 1}])
    def test_placement_and_ethereal_only_look(self, mode: dict[str, int], next32: Step) -> None:
        """07 8.2, 8.4: overlap up to f32((1.5 + 0.5) - EPS), that distance included, and nothing moves."""
        touching = approaching((0.0, 0.0, 0.0), (RADSUM, 0.0, 0.0), step_down=1, **mode)
        assert ask(touching) == COLLIDED
        beside = approaching((0.0, 0.0, 0.0), (next32(RADSUM, 1), 0.0, 0.0), step_down=1, **mode)
        assert ask(beside) == OK
        assert (trace_of(touching), trace_of(beside)) == ("S2", "S1")
        assert touching.collision_info.collision_normal_valid == 0

    @pytest.mark.parametrize(
        "mode", [{"insert_type": InsertType.PLACEMENT}, {"obstruction_ethereal": 1}, {"check_walkable": 1}]
    )
    def test_the_head_is_looked_at_with_the_radius_of_the_feet(
        self, mode: dict[str, int], next32: Step
    ) -> None:
        """07 8.2, 8.3, 8.4, 8.6: sphere 1 counts by its centre; its own radius, here 9, is not read."""
        for x, result in ((RADSUM, COLLIDED), (next32(RADSUM, 1), OK)):
            made = approaching((4.0, 0.0, 0.0), (4.0, 0.0, 0.0), head=(x, 0.0, 0.0), head_radius=9.0, **mode)
            assert ask(made) == result

    def test_a_step_down_spares_creatures(self) -> None:
        """07 8.5: nobody stands on a creature; on anything else the sphere is raised by 0.5."""
        creature = approaching((0.0, 0.0, 1.5), (0.0, 0.0, 1.5), step_down=1)
        assert ask(creature, is_creature=True) == OK
        assert moved_by(creature, (0.0, 0.0, 1.5)) == (0.0, 0.0, 0.0)
        thing = approaching((0.0, 0.0, 1.5), (0.0, 0.0, 1.5), step_down=1, check_walkable=1, collide=1)
        assert ask(thing) == ADJUSTED
        assert moved_by(thing, (0.0, 0.0, 1.5)) == (0.0, 0.0, 0.5)

    def test_a_walkable_check_collides_with_the_feet(self, next32: Step) -> None:
        """07 8.6: before `collide` is looked at, and creatures count."""
        for x, result in ((RADSUM, COLLIDED), (next32(RADSUM, 1), OK)):
            made = approaching((4.0, 0.0, 0.0), (x, 0.0, 0.0), check_walkable=1, collide=1)
            assert ask(made, is_creature=True) == result

    @pytest.mark.parametrize("state", [CONTACT_OI, ON_WALKABLE_OI, CONTACT_OI | PATH_CLIPPED_OI])
    def test_on_the_ground_feet_step_up(self, state: int, next32: Step) -> None:
        """07 8.7: either bit of the ground is enough, and both come before path clipping."""
        made = stepping(approaching((3.0, 0.0, 1.5), (RADSUM, 0.0, 0.0), state=state), succeeds=1)
        made.object_info.step_up_height = 5.0
        assert ask(made) == OK
        assert made.step_up_normals == [(3.0, 0.0, 1.5)]
        beside = stepping(
            approaching((3.0, 0.0, 1.5), (next32(RADSUM, 1), 0.0, 0.0), state=state), succeeds=1
        )
        assert ask(beside) == OK
        assert beside.step_up_normals == []

    @pytest.mark.parametrize("state", [CONTACT_OI, ON_WALKABLE_OI])
    def test_on_the_ground_the_head_slides(self, state: int) -> None:
        """07 8.7, 6.C: the head came from (-2, 0, 0), so the wall faces -x: of (0.5, 0.5, 0) y remains."""
        check = (-4.0, 0.5, -3.0)
        made = approaching((-4.5, 0.0, -3.0), check, head=(-1.5, 0.5, 0.0), state=state)
        made.collision_info.set_contact_plane(LEVEL, 0)
        assert ask(made) == SLID
        assert moved_by(made, check) == (-0.5, 0.0, 0.0)
        assert xyz(made.collision_info.collision_normal) == (-1.0, 0.0, 0.0)

    @pytest.mark.parametrize("state", [CONTACT_OI, 0])
    def test_a_head_beside_is_free(self, state: int, next32: Step) -> None:
        """07 8.7: the head is at (x, 0, 0), the feet at x = 4; without a head nothing is tested."""
        for x, free in ((RADSUM, False), (next32(RADSUM, 1), True)):
            made = approaching((4.0, 0.0, 0.0), (4.0, 0.0, 0.0), head=(x, 0.0, 0.0), state=state)
            assert (ask(made) == OK) is free
        assert ask(approaching((4.0, 0.0, 0.0), (4.0, 0.0, 0.0), state=state)) == OK

    def test_a_clipped_path_ends_at_the_feet(self, next32: Step) -> None:
        """07 8.7, 7.2.1: COLLIDED, with the normal from where the sphere was; the head is never tested."""
        made = approaching((4.0, 0.0, 0.0), (RADSUM, 0.0, 0.0), state=PATH_CLIPPED_OI)
        assert ask(made) == COLLIDED
        assert xyz(made.collision_info.collision_normal) == (1.0, 0.0, 0.0)
        beside = (next32(RADSUM, 1), 0.0, 0.0)
        assert ask(approaching((4.0, 0.0, 0.0), beside, state=PATH_CLIPPED_OI)) == OK
        assert ask(approaching((4.0, 0.0, 0.0), beside, head=(0.0,) * 3, state=PATH_CLIPPED_OI)) == OK

    def test_in_the_air_feet_begin_to_land(self) -> None:
        """07 8.7, 7.1: the normal points from the obstacle to where sphere 0 was."""
        made = approaching((0.0, 0.0, 3.0), (0.0, 0.0, RADSUM))
        assert ask(made) == ADJUSTED
        sp = made.sphere_path
        assert (sp.collide, xyz(sp.step_up_normal), sp.walkable_allowance) == (1, (0.0, 0.0, 1.0), Z_LANDING)

    def test_in_the_air_the_head_collides(self) -> None:
        """07 8.7, 7.2: the head was at (0, 2, 0) while the feet were at (4, 2, 0)."""
        made = approaching((4.0, 2.0, 0.0), (4.0, 0.0, 0.0), head=(0.0, 0.0, 0.0))
        assert ask(made) == COLLIDED
        assert xyz(made.collision_info.collision_normal) == (0.0, 1.0, 0.0)
        assert made.sphere_path.collide == 0

    def test_in_the_air_a_perfect_head_stops_where_it_touches(self) -> None:
        """07 7.2: from x = -5 to -1 towards radii of 2: t = 0.75, one metre back."""
        check = (-1.0, 0.0, 9.0)
        made = approaching((-5.0, 0.0, 9.0), check, head=(-1.0, 0.0, 0.0), state=PERFECT_CLIP_OI)
        assert ask(made) == ADJUSTED
        assert moved_by(made, check) == (-1.0, 0.0, 0.0)

    @pytest.mark.parametrize(
        "mode", [{"state": CONTACT_OI}, {}, {"check_walkable": 1}, {"step_down": 1}, {"collide": 1}]
    )
    def test_a_head_that_the_mover_does_not_have_is_not_looked_at(self, mode: dict[str, int]) -> None:
        """07 8.4…8.8: whatever the second sphere's place holds from an earlier path."""
        made = approaching((9.0, 0.0, 0.0), (9.0, 0.0, 0.0), **mode)
        made.sphere_path.global_sphere[1].assign(Sphere(vec(0.0, 0.0, 0.0), 0.5))
        assert ask(made) == OK


def rest(made: Transition, **path: float) -> TransitionState:
    """Let a landing mover rest upon the obstacle; every step below is of 07 8.8."""
    for name, value in {"collide": 1, **path}.items():
        setattr(made.sphere_path, name, value)
    return ask(made)


class TestRest:
    """CSphere::intersects_sphere, a landing (07 8.8)."""

    def test_creatures_and_misses_are_free(self, next32: Step) -> None:
        """8.8.1 and 8.8.2: a creature is no ground; neither is what does not overlap."""
        assert ask(approaching((0.0, 0.0, 3.0), (0.0, 0.0, 1.0), collide=1), is_creature=True) == OK
        for z, free in ((RADSUM, False), (next32(RADSUM, 1), True)):
            made = approaching((0.0, 0.0, 3.0), (0.0, 0.0, z))
            assert (rest(made) == OK) is free
        for z, free in ((RADSUM, False), (next32(RADSUM, 1), True)):
            made = approaching((9.0, 0.0, 3.0), (9.0, 0.0, 0.0), head=(0.0, 0.0, z))
            assert (rest(made) == OK) is free

    def test_half_the_way_back(self) -> None:
        """8.8.3…14: mv = (0, 0, 0.5), dot = 0.875, t = 1 - 0.875, u = 0.125/0.25 = 0.5.

        The plane goes through the lowest point of the sphere where it *was*: 1.75 - 0.5.
        """
        check = (0.0, 0.0, 1.75)
        made = approaching((0.0, 0.0, 2.25), check)
        assert rest(made) == ADJUSTED
        assert moved_by(made, check) == (0.0, 0.0, 0.25)
        assert contact(made) == (1, (0.0, 0.0, 1.0, -1.25), 1, CELL)
        assert made.sphere_path.walk_interp == 0.5

    def test_the_interpolation_shrinks(self) -> None:
        """8.8.9, 8.8.14: with half a step left, half of that is left."""
        made = approaching((0.0, 0.0, 2.25), (0.0, 0.0, 1.75), walk_interp=0.5)
        assert rest(made) == ADJUSTED
        assert made.sphere_path.walk_interp == 0.25

    def test_a_slanted_normal(self) -> None:
        """8.8.11: mv = (0, 0, 1), disp = (1.2, 0, 1): t = sqrt(1 - (1.2² + 1 - 4)) - 1, up to z = 1.6."""
        x = f32(1.2)
        made = approaching((x, 0.0, 2.0), (x, 0.0, 1.0))
        assert rest(made) == ADJUSTED
        u = math.sqrt(1.0 - (x * x + 1.0 - 4.0)) - 1.0
        n = (f32(0.5 * x), 0.0, f32(0.5 * f32(f32(u) + 1.0)))
        assert contact(made)[1][:3] == n
        assert n == pytest.approx((0.6, 0.0, 0.8), rel=1e-7)

    def test_without_movement_it_collides(self, next32: Step) -> None:
        """8.8.6: the squared movement below EPS; at 2^-6, from 2 - 2^-7, u = 2^-13 / 2^-12."""
        z = 2.0 - 2.0**-7
        still = approaching((0.0, 0.0, z + 2.0**-7), (0.0, 0.0, z))
        assert rest(still) == COLLIDED
        made = approaching((0.0, 0.0, z + 2.0**-6), (0.0, 0.0, z))
        assert rest(made) == ADJUSTED
        assert moved_by(made, (0.0, 0.0, z)) == (0.0, 0.0, 2.0**-7)

    def test_the_root_is_reflected_beyond_one_undivided(self) -> None:
        """8.8.8: t = m(2 - 1) with m = 1 counts; a longer way back makes t = b + b - t, and u = -3."""
        made = approaching((0.0, 0.0, 2.0), (0.0, 0.0, 1.0))
        assert rest(made) == ADJUSTED
        assert made.sphere_path.walk_interp == 0.0
        longer = approaching((0.0, 0.0, 2.0 + ATOM), (0.0, 0.0, 1.0))
        assert rest(longer) == COLLIDED

    def test_the_reflected_root_can_hold(self) -> None:
        """8.8.8: only the head overlaps, the feet at z = -3 are above it if one goes back by 2 metres.

        mv = (0, 0, 2): dot = -6, b = 6, gap = 9 - 4, t = sqrt(36 - 20) + 6 = 10, then 12 - 10; u = 2/4.
        """
        check = (0.0, 0.0, -3.0)
        made = approaching((0.0, 0.0, -1.0), check, head=(0.0, 0.0, 0.0))
        assert rest(made, walkable_allowance=-2.0) == ADJUSTED
        assert moved_by(made, check) == (0.0, 0.0, 1.0)
        assert contact(made)[1] == (0.0, 0.0, -1.0, -2.5)

    def test_no_way_back_left(self) -> None:
        """8.8.10: feet at exactly 2 (only the head overlaps) have t = 0, w = 1; below that w < 1."""
        for z, result in ((2.0, COLLIDED), (2.0 - ATOM, ADJUSTED)):
            made = approaching((0.0, 0.0, z + 0.5), (0.0, 0.0, z), head=(0.0, 0.0, z - 1.0))
            assert rest(made) == result

    def test_too_far_back(self) -> None:
        """8.8.10: mv = (0, 0, 0.5): u = (2 - z)/0.5; 1.125 leaves w = -0.125, 1.09375 leaves -0.09375."""
        for u, result in ((1.125, COLLIDED), (1.09375, ADJUSTED)):
            z = 2.0 - 0.5 * u
            made = approaching((0.0, 0.0, z + 0.5), (0.0, 0.0, z))
            assert rest(made) == result
            assert made.sphere_path.walk_interp == (1.0 if result == COLLIDED else 1.0 - u)

    def test_the_lowest_interpolation_counts(self) -> None:
        """8.8.10: mv = (0, 0, 0.5), u = (2 - 1)/0.5 = 2: (1 - 2) * 0.1 is -0.1 itself, as a double."""
        made = approaching((0.0, 0.0, 1.5), (0.0, 0.0, 1.0), walk_interp=0.1)
        assert rest(made) == ADJUSTED
        assert made.sphere_path.walk_interp == f32(-0.1)

    def test_only_what_is_flat_enough(self, next32: Step) -> None:
        """8.8.12: the allowance itself is too steep, strictly; nothing is changed then."""
        check = (0.0, 0.0, 1.75)
        made = approaching((0.0, 0.0, 2.25), check)
        assert rest(made, walkable_allowance=1.0) == OK
        assert moved_by(made, check) == (0.0, 0.0, 0.0)
        assert contact(made)[0] == 0
        assert rest(approaching((0.0, 0.0, 2.25), check), walkable_allowance=next32(1.0, -1)) == ADJUSTED

    def test_the_head_hits_and_the_feet_pass_by(self) -> None:
        """8.8.7 and 07 11: dot = 0, gap = 9 - 4, so the root is that of -5: COLLIDED."""
        made = approaching((3.0, 0.0, 1.0), (3.0, 0.0, 0.0), head=(0.0, 0.0, 0.0))
        assert rest(made) == COLLIDED

    def test_across_a_border(self) -> None:
        """8.8.3: from x = 190 to -1.75 of the block 192 metres east: mv = 190 + 1.75 - 192 = -0.25."""
        check = (-1.75, 0.0, 0.0)
        made = approaching((190.0, 0.0, 0.0), check, to_cell=EAST_CELL, walkable_allowance=-1.0)
        assert rest(made) == ADJUSTED
        assert moved_by(made, check) == (-0.25, 0.0, 0.0)
        assert contact(made)[3] == EAST_CELL


class TestLocalForm:
    """CSphere::intersects_sphere of an object's setup (07 9)."""

    def test_scaled_turned_and_moved(self, next32: Step) -> None:
        """07 9.1, 9.2: (1, 0, 0.5) doubled, turned half round about z, moved by (2, 0, -1): the origin."""
        p = Position(CELL, Frame.unpack(vec(2.0, 0.0, -1.0), 0.0, 0.0, 0.0, 1.0))
        shape = Sphere(vec(1.0, 0.0, 0.5), 0.75)
        for x, result in ((RADSUM, COLLIDED), (next32(RADSUM, 1), OK)):
            made = approaching((x, 0.0, 0.0), (x, 0.0, 0.0), insert_type=InsertType.PLACEMENT)
            assert shape.intersects_sphere_at(p, 2.0, made, is_creature=False) == result

    def test_an_object_of_the_next_block(self) -> None:
        """07 9.2: seen from the block of the check position, the object at x = 1 is at 193."""
        check = (192.0, 0.0, 0.0)
        made = approaching(check, check, insert_type=InsertType.PLACEMENT)
        assert (
            obstacle().intersects_sphere_at(at(1.0, 0.0, 0.0, EAST_CELL), 1.0, made, is_creature=False)
            == COLLIDED
        )
        here = approaching(check, check, insert_type=InsertType.PLACEMENT)
        assert obstacle().intersects_sphere_at(at(1.0, 0.0, 0.0), 1.0, here, is_creature=False) == OK

    def test_the_kind_of_object_is_passed_on(self) -> None:
        """07 9.3: stepping down, a creature is free."""
        made = approaching((0.0, 0.0, 1.5), (0.0, 0.0, 1.5), step_down=1)
        assert obstacle().intersects_sphere_at(at(0.0, 0.0, 0.0), 1.0, made, is_creature=True) == OK
        assert obstacle().intersects_sphere_at(at(0.0, 0.0, 0.0), 1.0, made, is_creature=False) == ADJUSTED
