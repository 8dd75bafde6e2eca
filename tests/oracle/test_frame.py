"""Frame: the cached matrix, the transforms' roundings, rotations put together and interpolated."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import pytest
from hypothesis import given
from hypothesis import strategies as st

from oracle.arithmetic import f32
from oracle.constants import EPS
from oracle.frame import Frame
from oracle.vector import Vector3

if TYPE_CHECKING:
    from collections.abc import Callable

    Step = Callable[[float, int], float]

HALF_ROOT = 0.7071067690849304
"""The float32 nearest to the square root of 1/2."""
ROUND_TRIP_BOUND = 5e-5
"""Metres: half a float32 step at 256 for each of three stores, and a matrix rounded to 2^-24."""

coordinates = st.floats(-200.0, 200.0, width=32)
local_coordinates = st.floats(-10.0, 10.0, width=32)
components = st.floats(-1.0, 1.0, width=32)


def matrix(frame: Frame) -> tuple[float, ...]:
    """Return m0 … m8."""
    return tuple(getattr(frame, f"m{i}") for i in range(9))


def quarter_turn() -> Frame:
    """Return a rotation by 90 degrees about z, origin (1, 2, 3), unnormalised as from a file."""
    return Frame.unpack(Vector3(1.0, 2.0, 3.0), HALF_ROOT, 0.0, 0.0, HALF_ROOT)


def components_of(v: Vector3) -> tuple[float, float, float]:
    """Return x, y, z."""
    return v.x, v.y, v.z


def test_a_new_frame_is_the_identity() -> None:
    """Its matrix is cached at once."""
    assert matrix(Frame()) == (1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0)
    assert Frame().is_valid()


def test_the_matrix_keeps_what_the_quaternion_lacks() -> None:
    """A quarter turn in float32 is not quite orthonormal; nothing repairs it."""
    frame = quarter_turn()
    near_one = 1.0 - 2.0**-24
    tiny = f32(1.0 - 2.0 * HALF_ROOT * HALF_ROOT)
    assert matrix(frame) == (tiny, near_one, 0.0, -near_one, tiny, 0.0, 0.0, 0.0, 1.0)
    assert tiny == 3.422854177870249e-08


def test_unpacking_does_not_normalise() -> None:
    """A quaternion of length 2 stays and gives a scaled, wrong matrix, as in retail."""
    frame = Frame.unpack(Vector3(), 2.0, 0.0, 0.0, 0.0)
    assert (frame.qw, frame.m0) == (2.0, 1.0)
    assert not frame.is_valid()


@pytest.mark.parametrize(("steps", "valid"), [(0, True), (1, False)])
def test_validity_ends_at_five_eps(next32: Step, steps: int, valid: bool) -> None:
    """The squared length, as float32, may be off by 5 EPS and no more."""
    largest = 1.0004998445510864
    frame = Frame.unpack(Vector3(), next32(largest, steps), 0.0, 0.0, 0.0)
    assert frame.is_valid() is valid


def test_nan_is_never_valid() -> None:
    """A NaN in the origin or the quaternion makes a frame invalid."""
    assert not Frame.unpack(Vector3(0.0, math.nan, 0.0), 1.0, 0.0, 0.0, 0.0).is_valid()
    assert not Frame.unpack(Vector3(), 1.0, 0.0, math.nan, 0.0).is_valid()


def test_set_rotate_normalises() -> None:
    """A long quaternion becomes a unit one, and the matrix follows."""
    frame = Frame()
    frame.set_rotate(0.0, 0.0, 0.0, 5.0)
    assert (frame.qw, frame.qx, frame.qy, frame.qz) == (0.0, 0.0, 0.0, 1.0)
    assert matrix(frame) == (-1.0, 0.0, 0.0, 0.0, -1.0, 0.0, 0.0, 0.0, 1.0)


def test_set_rotate_refuses_the_zero_quaternion() -> None:
    """1/0 makes NaNs, so the old quaternion comes back and the matrix was never touched."""
    frame = quarter_turn()
    before = matrix(frame)
    frame.set_rotate(0.0, 0.0, 0.0, 0.0)
    assert (frame.qw, frame.qz) == (HALF_ROOT, HALF_ROOT)
    assert matrix(frame) == before


def test_assigning_copies_the_matrix_without_computing_it() -> None:
    """A matrix that does not fit its quaternion is copied as it is."""
    frame = Frame()
    frame.m5 = 0.25
    other = Frame()
    other.assign(frame)
    assert other.m5 == 0.25
    assert frame.copy().m5 == 0.25
    frame.origin.x = 1.0
    assert other.origin.x == 0.0


def test_directions_turn_by_the_matrix() -> None:
    """Local x becomes global y under a quarter turn, and back."""
    frame = quarter_turn()
    near_one, tiny = frame.m1, frame.m0
    assert components_of(frame.localtoglobalvec(Vector3(1.0, 0.0, 0.0))) == (tiny, near_one, 0.0)
    assert components_of(frame.globaltolocalvec(Vector3(0.0, 1.0, 0.0))) == (near_one, tiny, 0.0)


def test_a_point_is_moved_after_it_is_turned() -> None:
    """Local (1, 0, 0) ends one unit north of the origin."""
    assert components_of(quarter_turn().localtoglobal(Vector3(1.0, 0.0, 0.0))) == (1.0, 3.0, 3.0)


def test_the_y_term_is_added_last() -> None:
    """The x and z terms cancel exactly before y is added."""
    frame = Frame()
    frame.m0, frame.m3, frame.m6 = 1.0, 1.0, -1.0
    v = Vector3(2.0**60, 1.0, 2.0**60)
    assert frame.localtoglobalvec(v).x == 1.0
    assert frame.localtoglobal(v).x == 1.0


def test_globaltolocal_rounds_x_and_y_differences_only() -> None:
    """The z row reads the unrounded difference, the x and y rows the rounded one."""
    frame = Frame()
    frame.origin.assign(Vector3(2.0**-25, 2.0**-25, 2.0**-25))
    frame.m6, frame.m7 = -1.0, 0.0
    local = frame.globaltolocal(Vector3(1.0, 0.0, 1.0))
    # dx stored: 1 - 2^-25 is a tie, rounded to even 1; dz in the register keeps it.
    assert local.x == 1.0
    assert local.z == -(2.0**-25)


@given(
    st.tuples(components, components, components, components),
    st.tuples(coordinates, coordinates, coordinates),
    st.tuples(local_coordinates, local_coordinates, local_coordinates),
)
def test_a_point_comes_back_from_global_space(
    q: tuple[float, ...], origin: tuple[float, ...], point: tuple[float, ...]
) -> None:
    """Local to global to local loses no more than the roundings allow."""
    frame = Frame()
    frame.set_rotate(*q)
    frame.origin.assign(Vector3(*origin))
    back = frame.globaltolocal(frame.localtoglobal(Vector3(*point)))
    for got, wanted in zip(components_of(back), point, strict=True):
        assert abs(got - wanted) <= ROUND_TRIP_BOUND


def half_turn(axis: int, x: float, y: float, z: float) -> Frame:
    """Return a rotation by 180 degrees about an axis, whose matrix is exact, with an origin."""
    vector_part = [0.0, 0.0, 0.0]
    vector_part[axis] = 1.0
    return Frame.unpack(Vector3(x, y, z), 0.0, *vector_part)


@pytest.mark.parametrize("combine", [Frame.combine, Frame.combine_aframe])
def test_combining_turns_the_second_by_the_first(combine: Callable[[Frame, Frame, Frame], None]) -> None:
    """A half turn about z and then one about x is one about y; the order matters for the sign."""
    frame = Frame()
    combine(frame, half_turn(2, 10.0, 20.0, 30.0), half_turn(0, 1.0, 2.0, 3.0))
    assert components_of(frame.origin) == (9.0, 18.0, 33.0)
    assert (frame.qw, frame.qx, frame.qy, frame.qz) == (0.0, 0.0, 1.0, 0.0)
    combine(frame, half_turn(0, 1.0, 2.0, 3.0), half_turn(2, 10.0, 20.0, 30.0))
    assert components_of(frame.origin) == (11.0, -18.0, -27.0)
    assert (frame.qw, frame.qx, frame.qy, frame.qz) == (0.0, 0.0, -1.0, 0.0)


def test_scaled_combination_scales_the_second_origin_only() -> None:
    """Each axis has its own scale; it applies before the rotation."""
    frame = Frame()
    scale = Vector3(10.0, 100.0, 1000.0)
    frame.combine_scaled(half_turn(2, 10.0, 20.0, 30.0), half_turn(0, 1.0, 2.0, 3.0), scale)
    assert components_of(frame.origin) == (0.0, -180.0, 3030.0)
    assert (frame.qw, frame.qx, frame.qy, frame.qz) == (0.0, 0.0, 1.0, 0.0)


def test_combining_into_an_operand_reads_it_first() -> None:
    """``f.combine(f, g)`` is the same as combining into a third frame."""
    wanted = Frame()
    wanted.combine(quarter_turn(), quarter_turn())
    frame = quarter_turn()
    frame.combine(frame, quarter_turn())
    assert frame.is_equal(wanted)


def test_origins_are_interpolated_per_axis() -> None:
    """A quarter of the way; x keeps one product unrounded."""
    a, b, frame = Frame(), Frame(), Frame()
    a.origin.assign(Vector3(0.0, 8.0, -4.0))
    b.origin.assign(Vector3(4.0, 0.0, 4.0))
    frame.interpolate_origin(a, b, 0.25)
    assert components_of(frame.origin) == (1.0, 6.0, -2.0)


def test_rotation_goes_the_short_way() -> None:
    """A quaternion and its negative are the same rotation; half way is half the angle."""
    start, end, frame = Frame(), quarter_turn(), Frame()
    frame.interpolate_rotation(start, end, 0.5)
    minus = Frame.unpack(Vector3(), -HALF_ROOT, 0.0, 0.0, -HALF_ROOT)
    other = Frame()
    other.interpolate_rotation(start, minus, 0.5)
    assert (frame.qw, frame.qz) == (other.qw, other.qz)
    assert frame.qw == f32(math.cos(math.pi / 8.0))
    assert frame.qz == f32(math.sin(math.pi / 8.0))


def test_close_rotations_are_interpolated_linearly(next32: Step) -> None:
    """Up to 1 - EPS between the quaternions the components are mixed, beyond by angle."""
    c = f32(1.0 - EPS)
    assert 1.0 - c <= EPS
    near = Frame.unpack(Vector3(), c, f32(math.sqrt(1.0 - c * c)), 0.0, 0.0)
    frame = Frame()
    frame.interpolate_rotation(Frame(), near, 0.25)
    w, x = 0.75 + 0.25 * near.qw, 0.25 * near.qx
    length = math.sqrt(f32(w) ** 2 + f32(x) ** 2)
    assert (frame.qw, frame.qx) == (f32(f32(w) * (1.0 / length)), f32(f32(x) * (1.0 / length)))
    c = next32(c, -1)
    assert 1.0 - c > EPS
    apart = Frame.unpack(Vector3(), c, f32(math.sqrt(1.0 - c * c)), 0.0, 0.0)
    frame.interpolate_rotation(Frame(), apart, 0.25)
    assert frame.qx == f32(math.sin(0.25 * math.acos(c)))


def test_extrapolated_rotation_falls_back_to_linear() -> None:
    """A weight beyond [0, 1] makes the components be mixed instead."""
    frame, end = Frame(), quarter_turn()
    frame.interpolate_rotation(Frame(), end, 1.5)
    w, z = f32(-0.5 + 1.5 * HALF_ROOT), f32(1.5 * HALF_ROOT)
    inv = 1.0 / math.sqrt(w * w + z * z)
    assert (frame.qw, frame.qz) == (f32(w * inv), f32(z * inv))


@pytest.mark.parametrize(
    ("degrees", "direction"),
    [(0.0, (0.0, 1.0)), (90.0, (1.0, 0.0)), (180.0, (0.0, -1.0)), (270.0, (-1.0, 0.0))],
)
def test_headings_turn_local_y_clockwise_from_north(degrees: float, direction: tuple[float, float]) -> None:
    """After set_heading local y points there, and get_heading says so."""
    frame = Frame()
    frame.set_heading(degrees)
    heading = frame.get_vector_heading()
    assert heading.x == pytest.approx(direction[0], abs=1e-6)
    assert heading.y == pytest.approx(direction[1], abs=1e-6)
    assert heading.z == 0.0
    assert math.cos(math.radians(frame.get_heading() - degrees)) == pytest.approx(1.0, abs=1e-12)


def test_a_sloping_heading_raises_local_y() -> None:
    """A direction that climbs at 30 degrees keeps its height."""
    frame = Frame()
    frame.set_vector_heading(Vector3(0.0, 2.0 * math.cos(math.pi / 6.0), 1.0))
    assert frame.get_vector_heading().z == pytest.approx(0.5, abs=1e-6)


def test_a_short_heading_vector_changes_nothing(next32: Step) -> None:
    """Below EPS there is no direction."""
    frame = quarter_turn()
    frame.set_vector_heading(Vector3(next32(EPS, -1), 0.0, 0.0))
    assert matrix(frame) == matrix(quarter_turn())


def test_euler_angles_turn_about_one_axis_each() -> None:
    """Each angle alone is a rotation about its axis."""
    for axis in range(3):
        angles = [0.0, 0.0, 0.0]
        angles[axis] = 0.5
        frame = Frame()
        frame.euler_set_rotate(*angles)
        vector_part = [frame.qx, frame.qy, frame.qz]
        assert frame.qw == pytest.approx(math.cos(0.25), abs=1e-7)
        assert vector_part[axis] == pytest.approx(math.sin(0.25), abs=1e-7)
        assert [q for i, q in enumerate(vector_part) if i != axis] == [0.0, 0.0]


def test_frames_are_equal_within_eps(next32: Step) -> None:
    """Origins may differ by EPS, quaternion components only by less."""
    a, b = Frame(), Frame()
    b.origin.x = EPS
    assert a.is_equal(b)
    b.origin.x = next32(EPS, 1)
    assert not a.is_equal(b)
    b.origin.x = 0.0
    b.qx = EPS
    assert not a.is_equal(b)
    b.qx = next32(EPS, -1)
    assert a.is_equal(b)


def test_repr_names_origin_and_rotation() -> None:
    """A frame in a failure message can be read."""
    assert repr(Frame()) == "Frame(Vector3(0.0, 0.0, 0.0), 1.0, 0.0, 0.0, 0.0)"


def test_turning_about_a_global_axis() -> None:
    """A quarter turn about z, then one about the global x: y and z of the quaternion follow the axes."""
    frame = Frame()
    frame.grotate(Vector3(0.0, 0.0, f32(math.pi / 2.0)))
    assert (frame.qw, frame.qx, frame.qy, frame.qz) == (HALF_ROOT, 0.0, 0.0, HALF_ROOT)
    frame.grotate(Vector3(f32(math.pi), 0.0, 0.0))
    assert abs(frame.qw) < EPS
    assert (frame.qx, frame.qy) == (HALF_ROOT, -HALF_ROOT)
    assert components_of(frame.origin) == (0.0, 0.0, 0.0)


def test_turning_by_less_than_eps_is_none(next32: Step) -> None:
    """An angle of EPS turns, one bit less does not."""
    still, turned = Frame(), Frame()
    still.grotate(Vector3(0.0, next32(EPS, -1), 0.0))
    turned.grotate(Vector3(0.0, EPS, 0.0))
    assert (still.qy, turned.qy) == (0.0, f32(math.sin(EPS * 0.5)))
