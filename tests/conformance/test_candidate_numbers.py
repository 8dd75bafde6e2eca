"""Single: what float32 hardware computes, in the oracle's number model."""

from __future__ import annotations

import math
import operator
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from conformance.candidates.number_models import Single, plain
from oracle import arithmetic
from oracle.arithmetic import f32
from oracle.errors import UndeterminedError

FLOATS = st.floats(-1e6, 1e6, width=32)
TENTH = float(np.float32(0.1))


def same(a: float, b: Any) -> bool:
    """Tell whether two numbers are the same bits, or both NaN."""
    return a == float(b) or (math.isnan(a) and math.isnan(float(b)))


@pytest.mark.parametrize("op", [operator.add, operator.sub, operator.mul, operator.truediv])
@given(a=FLOATS, b=FLOATS)
def test_operations_are_those_of_float32(op: Any, a: float, b: float) -> None:
    """Rounding a double result to float32 is the float32 result; either side may be a plain number."""
    if op is operator.truediv and b == 0.0:
        return
    with np.errstate(all="ignore"):
        expected = op(np.float32(a), np.float32(b))
    assert same(op(Single(a), Single(b)).value, expected)
    assert same(op(Single(a), b).value, expected)
    assert same(op(a, Single(b)).value, expected)


@given(a=FLOATS, b=FLOATS)
def test_comparisons_are_those_of_the_values(a: float, b: float) -> None:
    """Mixed ones too."""
    x, y = Single(a), Single(b)
    assert [x < y, x <= y, x > y, x >= y, x == y] == [a < b, a <= b, a > b, a >= b, a == b]
    assert [x < b, x <= b, x > b, x >= b, x == b] == [a < b, a <= b, a > b, a >= b, a == b]
    assert hash(x) == hash(a)


def test_a_literal_is_a_float32() -> None:
    """A plain number is rounded before it takes part: 0.1 is 0.1f."""
    assert (Single(0.0) + 0.1).value == TENTH
    assert Single(TENTH) == 0.1
    assert not Single(TENTH) > 0.1


def test_the_functions_of_the_number_model() -> None:
    """Each is the double function of the value, rounded."""
    x = Single(0.3)
    for name in ("sin", "cos", "asin", "acos"):
        expected = f32(getattr(math, name)(x.value))
        assert getattr(arithmetic, name)(x).value == expected
    assert arithmetic.sqrt(x).value == f32(math.sqrt(x.value))
    assert arithmetic.atan2(x, Single(2.0)).value == f32(math.atan2(x.value, 2.0))
    assert arithmetic.fmod(Single(7.5), 2.0).value == 1.5
    assert arithmetic.power(Single(2.0), 3.0).value == 8.0
    assert (arithmetic.floor(Single(2.5)), arithmetic.ceil(Single(2.5))) == (2, 3)
    assert (abs(-x).value, f32(x)) == (x.value, x)
    assert repr(Single(0.5)) == "Single(0.5)"


def test_a_divisor_may_be_zero() -> None:
    """As in retail's registers: infinity or NaN."""
    assert arithmetic.divide(Single(1.0), Single(0.0)).value == math.inf
    assert arithmetic.divide(-1.0, Single(0.0)).value == -math.inf
    assert arithmetic.is_nan(arithmetic.divide(Single(0.0), 0.0))


def test_answers_become_plain() -> None:
    """Whatever the nesting; what is no number stays."""
    fields = {"a": Single(0.5), "b": [Single(1.0), 2, None], "c": {"d": (Single(3.0),)}, "e": "OK"}
    assert plain(fields) == {"a": 0.5, "b": [1.0, 2, None], "c": {"d": [3.0]}, "e": "OK"}
    assert type(plain(fields)["a"]) is float


@pytest.mark.parametrize("x", [math.inf, -math.inf, math.nan])
def test_what_is_no_number_is_so_in_every_model(x: float) -> None:
    """Its functions are NaN, and which whole number it is nobody knows, as in retail's model."""
    for function in (arithmetic.sin, arithmetic.cos):
        assert arithmetic.is_nan(function(Single(x)))
    assert arithmetic.is_nan(arithmetic.fmod(Single(x), 360.0))
    for function in (arithmetic.floor, arithmetic.ceil):
        with pytest.raises(UndeterminedError):
            function(Single(x))
