"""The number model: rounding at stores, and what retail's masked exceptions give."""

from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from oracle import arithmetic
from oracle.arithmetic import acos, asin, atan2, ceil, cos, divide, f32, floor, fmod, is_nan, power, sin, sqrt
from oracle.errors import UndeterminedError

MIN_SUBNORMAL = 2.0**-149
MAX_FINITE = (2.0 - 2.0**-23) * 2.0**127


@pytest.mark.parametrize(
    ("register", "stored"),
    [
        (0.1, 0.10000000149011612),
        (1.0 + 2.0**-24, 1.0),
        (1.0 + 3.0 * 2.0**-24, 1.0 + 2.0**-22),
        (1.0 + 2.0**-24 + 2.0**-52, 1.0 + 2.0**-23),
        (MIN_SUBNORMAL, MIN_SUBNORMAL),
        (MIN_SUBNORMAL / 2.0, 0.0),
        (MAX_FINITE * 2.0, math.inf),
        (3, 3.0),
    ],
)
def test_a_store_rounds_to_nearest_even(register: float, stored: float) -> None:
    """A store rounds once to float32, ties to even, with subnormals and infinities."""
    assert f32(register) == stored
    assert f32(register).__class__ is float


def test_a_store_keeps_the_sign_of_zero() -> None:
    """Minus zero survives a store, and is what a tiny negative number becomes."""
    assert math.copysign(1.0, f32(-0.0)) == -1.0
    assert math.copysign(1.0, f32(-1e-60)) == -1.0


@given(st.floats(allow_nan=False))
def test_a_store_is_idempotent(x: float) -> None:
    """Storing what was stored changes nothing."""
    assert f32(f32(x)) == f32(x)


@given(st.floats(allow_nan=False), st.floats(allow_nan=False))
def test_a_store_keeps_order(a: float, b: float) -> None:
    """Rounding never swaps two numbers."""
    low, high = min(a, b), max(a, b)
    assert f32(low) <= f32(high)


@pytest.mark.parametrize(
    ("a", "b", "quotient"),
    [
        (1.0, 0.0, math.inf),
        (1.0, -0.0, -math.inf),
        (-1.0, 0.0, -math.inf),
        (-math.inf, -0.0, math.inf),
        (1.0, 4.0, 0.25),
    ],
)
def test_division_by_zero_is_a_signed_infinity(a: float, b: float, quotient: float) -> None:
    """The masked exception gives infinity with the sign of both operands."""
    assert divide(a, b) == quotient


def test_undefined_results_are_nan() -> None:
    """0/0 and the root of a negative number are NaN, and execution goes on."""
    assert is_nan(divide(0.0, 0.0))
    assert is_nan(divide(math.nan, 0.0))
    assert is_nan(sqrt(-1.0))
    assert not is_nan(sqrt(2.0))
    assert math.copysign(1.0, sqrt(0.0)) == 1.0


class Number:
    """A number type of its own: it only records what it was asked."""

    def __init__(self) -> None:
        self.asked: list[str] = []

    def __getattr__(self, name: str) -> object:
        def method(*_: object) -> float:
            self.asked.append(name)
            return 0.0

        return method


def test_another_number_type_answers_for_itself() -> None:
    """Every function hands a foreign number to that number's own method."""
    x = Number()
    for function in (f32, sqrt, is_nan, sin, cos, asin, acos):
        function(x)  # type: ignore[operator]
    divide(x, 1.0)  # type: ignore[arg-type]
    divide(1.0, x)  # type: ignore[arg-type]
    atan2(x, x)  # type: ignore[arg-type]
    fmod(x, 1.0)  # type: ignore[arg-type]
    power(x, 1.0)  # type: ignore[arg-type]
    assert x.asked == [
        "stored",
        "sqrt",
        "is_nan",
        "sin",
        "cos",
        "asin",
        "acos",
        "divided_by",
        "dividing",
        "atan2",
        "fmod",
        "power",
    ]


def test_functions_of_floats_are_the_c_library_s() -> None:
    """On floats the transcendental functions are those of the host's C library, in double."""
    for name in ("sin", "cos", "asin", "acos"):
        assert getattr(arithmetic, name)(0.5) == getattr(math, name)(0.5)
    assert atan2(1.0, -2.0) == math.atan2(1.0, -2.0)
    assert fmod(450.0, 360.0) == 90.0
    assert power(0.0625, 0.5) == 0.25


def test_a_negative_number_has_only_whole_powers() -> None:
    """Any other is NaN, as in C; nothing is raised."""
    assert power(-2.0, 3.0) == -8.0
    assert is_nan(power(-2.0, 0.5))
    assert (power(0.0, 0.5), power(0.0, 0.0)) == (0.0, 1.0)
    assert power(0.0, -0.5) == math.inf


@pytest.mark.parametrize("x", [math.inf, -math.inf, math.nan])
def test_what_is_no_number_has_no_whole_one(x: float) -> None:
    """What retail makes of it is not known, and said so; a number however large has its own."""
    for function in (floor, ceil):
        with pytest.raises(UndeterminedError, match=f"not known: {x} as a whole number"):
            function(x)
    assert (floor(-0.5), ceil(-0.5), floor(2.0**80)) == (-1, 0, 2**80)


def test_functions_of_what_is_no_number_are_none() -> None:
    """The masked x87 gives NaN, no error (NM-9a)."""
    for function in (sin, cos):
        assert is_nan(function(math.inf))
        assert is_nan(function(-math.inf))
        assert is_nan(function(math.nan))
    assert is_nan(fmod(math.inf, 360.0))
    assert is_nan(fmod(1.0, 0.0))
    assert fmod(1.0, math.inf) == 1.0
