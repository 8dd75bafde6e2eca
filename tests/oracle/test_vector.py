"""Vector3: lengths, thresholds, and the order in which a dot product is added."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import pytest
from hypothesis import given
from hypothesis import strategies as st

from oracle.constants import EPS
from oracle.vector import Vector3, dot_x, dot_z

if TYPE_CHECKING:
    from collections.abc import Callable

    Step = Callable[[float, int], float]

UNIT_LENGTH_BOUND = 2.0**-22
"""Three components rounded by at most 2^-25 each, and the reciprocal's rounding, with room."""


def test_the_dot_products_differ_in_what_is_added_last() -> None:
    """A large pair of terms that cancels leaves or swallows the small one, by association."""
    a = Vector3(2.0**60, 1.0, 2.0**60)
    b = Vector3(1.0, 1.0, -1.0)
    assert dot_x(a, b) == 0.0
    assert dot_z(a, b) == 0.0
    assert dot_z(Vector3(2.0**60, 2.0**60, 1.0), Vector3(1.0, -1.0, 1.0)) == 1.0
    assert dot_x(Vector3(1.0, 2.0**60, 2.0**60), Vector3(1.0, 1.0, -1.0)) == 1.0


def test_normalize_check_small_is_strict(next32: Step) -> None:
    """A vector of exactly EPS is normalised, the next shorter one is left alone."""
    v = Vector3(EPS, 0.0, 0.0)
    assert v.normalize_check_small() == 0
    assert (v.x, v.y, v.z) == (1.0, 0.0, 0.0)
    shorter = Vector3(next32(EPS, -1), 0.0, 0.0)
    assert shorter.normalize_check_small() == 1
    assert shorter.x == next32(EPS, -1)


def test_normalize_multiplies_by_the_rounded_reciprocal() -> None:
    """(3, 4, 0) gives 3 * (1/5), not 3/5, before the store."""
    v = Vector3(3.0, 4.0, 0.0)
    v.normalize()
    assert (v.x, v.y, v.z) == (0.6000000238418579, 0.800000011920929, 0.0)


def test_normalize_has_no_guard() -> None:
    """The zero vector becomes NaN (zero times infinity), without an error."""
    v = Vector3()
    v.normalize()
    assert v.x != v.x


@given(*[st.floats(-1e6, 1e6, width=32)] * 3)
def test_a_normalized_vector_has_unit_length(x: float, y: float, z: float) -> None:
    """What is not too short becomes a unit vector, to float32 accuracy."""
    v = Vector3(x, y, z)
    if v.normalize_check_small() == 0:
        assert abs(v.magnitude() - 1.0) <= UNIT_LENGTH_BOUND


def test_is_zero_is_strict_per_component(next32: Step) -> None:
    """One component of EPS is not zero; three just below are, though the length is above EPS."""
    below = next32(EPS, -1)
    assert Vector3(below, -below, below).is_zero()
    assert not Vector3(EPS, 0.0, 0.0).is_zero()
    assert not Vector3(0.0, 0.0, EPS).is_zero()
    assert not Vector3(0.0, -EPS, 0.0).is_zero()


def test_equality_accepts_a_difference_of_eps(next32: Step) -> None:
    """Each component may differ by EPS, not by more."""
    assert Vector3(EPS, -EPS, EPS).equals(Vector3())
    assert not Vector3(0.0, next32(EPS, 1), 0.0).equals(Vector3())


def test_a_difference_above_eps_on_one_axis_differs(next32: Step) -> None:
    """EPS on every axis does not; a NaN neither differs nor is equal."""
    assert not Vector3(EPS, -EPS, EPS).differs(Vector3())
    for axis in ("x", "y", "z"):
        v = Vector3()
        setattr(v, axis, next32(EPS, 1))
        assert v.differs(Vector3())
    nan = Vector3(math.nan, 0.0, 0.0)
    assert (nan.differs(Vector3()), nan.equals(Vector3())) == (False, False)


def test_assigning_copies_and_does_not_share() -> None:
    """A later change of the source does not reach the copy."""
    a, b = Vector3(1.0, 2.0, 3.0), Vector3()
    b.assign(a)
    c = a.copy()
    a.x = 9.0
    assert (b.x, b.y, b.z) == (1.0, 2.0, 3.0)
    assert (c.x, c.y, c.z) == (1.0, 2.0, 3.0)
    assert repr(b) == "Vector3(1.0, 2.0, 3.0)"


@pytest.mark.parametrize(
    ("v", "heading"),
    [
        ((0.0, 1.0, 0.0), 0.0),
        ((1.0, 0.0, 0.0), 90.0),
        ((0.0, -2.0, 5.0), 180.0),
        ((-3.0, 0.0, 0.0), 270.0),
        ((0.0, 0.0, 1.0), 0.0),
    ],
)
def test_heading_is_clockwise_from_north(v: tuple[float, float, float], heading: float) -> None:
    """North is +y, east is +x; the height does not matter; straight up has heading 0."""
    assert Vector3(*v).get_heading() == heading
