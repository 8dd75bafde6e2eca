"""Ball: enclosure of what fractions give, decisions, ties, and refusal to guess."""

from __future__ import annotations

import math
import operator
from fractions import Fraction
from typing import TYPE_CHECKING, Any

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

pytest.importorskip("flint", reason="the extra `exact` is not installed")

from flint import ctx

from conformance.exact.ball import Ball
from conformance.exact.ties import UndecidedError, counting_ties
from oracle import arithmetic
from oracle.errors import UndeterminedError

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

FLOATS = st.floats(-1e6, 1e6, width=32)
SMALL = st.integers(1, 50).map(float)
OPERATIONS = (operator.add, operator.sub, operator.mul, operator.truediv)
COMPARISONS = (operator.lt, operator.le, operator.gt, operator.ge, operator.eq)
THIRD = Ball(1.0) / 3.0


@pytest.fixture(autouse=True)
def _precision() -> Iterator[None]:
    """Compute with 128 bits; the library's precision is global."""
    before = ctx.prec
    ctx.prec = 128
    yield
    ctx.prec = before


def contains(ball: Ball, exact: Fraction) -> bool:
    """Tell whether a ball contains a rational number."""
    (low, k), (high, n) = ball.arb.lower().man_exp(), ball.arb.upper().man_exp()
    return Fraction(int(low)) * Fraction(2) ** int(k) <= exact <= Fraction(int(high)) * Fraction(2) ** int(n)


@given(
    operations=st.lists(st.tuples(st.sampled_from(OPERATIONS), FLOATS), min_size=1, max_size=12), first=FLOATS
)
def test_balls_contain_what_fractions_give(
    operations: list[tuple[Callable[[Any, Any], Any], float]], first: float
) -> None:
    """Any chain of sums, differences, products and quotients stays enclosed."""
    ball, exact = Ball(first), Fraction(first)
    for operation, operand in operations:
        assume(operation is not operator.truediv or operand)
        ball, exact = operation(ball, operand), operation(exact, Fraction(operand))
        assert contains(ball, exact)


@given(x=st.floats(0.0, 1e6, width=32))
def test_roots_are_enclosed(x: float) -> None:
    """The ends of a root's ball, squared, enclose the radicand."""
    (low, k), (high, n) = (end.man_exp() for end in (Ball(x).sqrt().arb.lower(), Ball(x).sqrt().arb.upper()))
    lower, upper = Fraction(int(low)) * Fraction(2) ** int(k), Fraction(int(high)) * Fraction(2) ** int(n)
    assert lower**2 <= Fraction(x) <= upper**2


@pytest.mark.parametrize("compare", COMPARISONS)
@given(a=FLOATS, b=FLOATS, c=SMALL)
def test_comparisons_are_those_of_fractions(
    compare: Callable[[Any, Any], bool], a: float, b: float, c: float
) -> None:
    """Quotients are compared as the fractions are, equal ones included."""
    exact = compare(Fraction(a) / Fraction(c), Fraction(b) / Fraction(c))
    assert compare(Ball(a) / c, Ball(b) / c) is exact
    assert compare(a, Ball(b)) is compare(a, b)


@given(numerator=SMALL, denominator=SMALL)
def test_rational_ties_are_found(numerator: float, denominator: float) -> None:
    """A quotient multiplied by its divisor is the dividend again, which balls alone do not tell."""
    with counting_ties() as ties:
        assert Ball(numerator) / denominator * denominator == numerator
    exact = (Ball(numerator) / denominator).arb.is_exact()
    assert ties.count == (0 if exact else 1)


@given(a=SMALL, b=SMALL)
def test_ties_of_roots_are_found(a: float, b: float) -> None:
    """The third binomial formula, and a root squared."""
    root, other = Ball(a).sqrt(), Ball(b).sqrt()
    assert root * root == a
    assert (root + other) * (root - other) == a - b
    assert not root * root < a
    assert root * root >= a


def test_dependent_roots_are_found() -> None:
    """Roots of 12, 27 and 75 are multiples of that of 3: only some primes give all of them fitting signs."""
    assert Ball(12.0).sqrt() + Ball(27.0).sqrt() == Ball(75.0).sqrt()


def test_transcendental_ties_are_found_where_the_value_does_not_matter() -> None:
    """The same sine twice, and sin^2 + cos^2; that the arc of a sine is the angle is not guessed."""
    angle = THIRD
    assert arithmetic.sin(angle) * 3.0 - arithmetic.sin(angle) == arithmetic.sin(Ball(1.0) / 3.0) * 2.0
    assert angle.sin() * angle.sin() + angle.cos() * angle.cos() == 1.0
    with pytest.raises(UndecidedError, match="at 128 bits"):
        _ = angle.sin().asin() == angle


def test_what_balls_leave_open_is_raised() -> None:
    """Numbers 2^-140 apart are not told apart with 128 bits, not called equal, and decided with 256."""
    step = 2.0**-140

    def differ() -> bool:
        return THIRD + step > Ball(1.0) / 3.0

    with pytest.raises(UndecidedError):
        differ()
    ctx.prec = 256
    assert Ball(1.0) / 3.0 + step > Ball(1.0) / 3.0


def test_no_tie_is_found_with_too_few_bits() -> None:
    """Below 128 bits even an equality has to be asked again."""
    ctx.prec = 64
    with pytest.raises(UndecidedError, match="at 64 bits"):
        _ = Ball(1.0) / 3.0 * 3.0 == 1.0


def test_whole_numbers() -> None:
    """Floor and ceiling, also of a number that is whole only by residues."""
    one = THIRD * 3.0
    assert (arithmetic.floor(one), arithmetic.ceil(one)) == (1, 1)
    assert (arithmetic.floor(-THIRD), arithmetic.ceil(-THIRD)) == (-1, 0)
    assert (arithmetic.floor(Ball(2.5)), arithmetic.ceil(Ball(2.5))) == (2, 3)
    assert arithmetic.floor(Ball(2.0**100) + 0.5) == 2**100
    with pytest.raises(UndeterminedError, match=r"inf.* as a whole number"):
        arithmetic.floor(Ball(math.inf))


def test_divisors_of_zero() -> None:
    """Retail's division gives infinity or NaN; one that the specification guards raises."""
    nothing = THIRD * 3.0 - 1.0
    assert arithmetic.divide(1.0, nothing) == math.inf
    assert arithmetic.divide(Ball(-1.0), 0.0) == -math.inf
    assert arithmetic.is_nan(arithmetic.divide(nothing, 0.0))
    with pytest.raises(ZeroDivisionError):
        _ = 1.0 / nothing


def test_nan_compares_false() -> None:
    """As in IEEE arithmetic; only `!=` holds."""
    nan = Ball(math.nan)
    assert not any(compare(nan, 1.0) for compare in COMPARISONS)
    assert nan != nan  # noqa: PLR0124 - the point
    assert all(f(nan).is_nan() for f in (Ball.sqrt, Ball.sin, Ball.cos, Ball.asin, Ball.acos))
    assert nan.fmod(2.0).is_nan()
    assert arithmetic.is_nan(arithmetic.sqrt(Ball(-1.0)))


def test_the_other_functions() -> None:
    """The rest of the number model, at values that are known."""
    half_pi = arithmetic.atan2(Ball(1.0), 0.0)
    assert float(half_pi) == math.pi / 2
    assert float(arithmetic.atan2(THIRD * 3.0 - 1.0, Ball(-1.0))) == math.pi
    assert float(arithmetic.asin(THIRD * 3.0)) == math.pi / 2
    assert float(arithmetic.acos(THIRD * -3.0)) == math.pi
    assert arithmetic.is_nan(arithmetic.acos(Ball(1.5)))
    assert float(arithmetic.cos(Ball(0.0))) == 1.0
    assert arithmetic.fmod(Ball(-7.5), 2.0) == -1.5
    assert arithmetic.fmod(Ball(1e20), 360.0) == 280.0
    assert float(arithmetic.power(Ball(2.0), Ball(0.5))) == math.sqrt(2.0)
    assert arithmetic.power(0.25, Ball(0.0)) == 1.0
    assert float(arithmetic.power(0.25, Ball(0.5))) == 0.5
    assert arithmetic.power(Ball(0.0), 2.0) == 0.0
    assert abs(-THIRD) == THIRD
    assert bool(THIRD)
    assert not THIRD * 3.0 - 1.0
    assert repr(Ball(0.5)).startswith("Ball(0.5")
