"""Formulas of terrain heights: arithmetic, and nothing else."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from conformance.scenes.errors import SceneError
from conformance.scenes.formula import LONGEST, Formula

NAMES = frozenset("xy")
NUMBERS = st.floats(-1000.0, 1000.0)


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("94", 94.0),
        (" 94 + x / 24", 95.0),
        ("-x + +y", -21.0),
        ("2 * (x - y) / 3", 14.0),
        ("max(0, x - 20, y)", 4.0),
        ("min(x, y)", 3.0),
        ("abs(y - x)", 21.0),
        ("floor(x / 7)", 3.0),
    ],
)
def test_known_values(text: str, value: float) -> None:
    """At x = 24, y = 3, by hand."""
    assert Formula(text, NAMES)(x=24.0, y=3.0) == value


@given(NUMBERS, NUMBERS)
def test_it_is_plain_arithmetic(x: float, y: float) -> None:
    """In float64, with the precedence that everyone knows."""
    assert Formula("x - y * 3 + max(x, y)", NAMES)(x=x, y=y) == x - y * 3 + max(x, y)


@pytest.mark.parametrize(
    "text",
    [
        "",
        "x +",
        "(x",
        "z",
        "x ** 2",
        "x % 2",
        "x // 2",
        "not x",
        "x if y else 1",
        "'x'",
        "True",
        "1j",
        "[x]",
        "x.real",
        "x[0]",
        "exit()",
        "__import__('os')",
        "max(x)",
        "max()",
        "abs(x, y)",
        "max(x, y, key=abs)",
        "max(*x)",
        "(lambda: x)()",
        "(y := x)",
        "x; y",
        "x" + " + x" * LONGEST,
        "(" * 150 + "x",
    ],
)
def test_what_is_no_formula_is_refused_before_it_is_evaluated(text: str) -> None:
    """Other names, other operators, other functions, code."""
    with pytest.raises(SceneError):
        Formula(text, NAMES)


@pytest.mark.parametrize("text", ["1 / x", "1e400", "1e308 * 10", "floor(1e400)", "1" + "0" * 190 + "0" * 5])
def test_a_height_is_a_finite_number(text: str) -> None:
    """Where a formula has no value, the point is named."""
    formula = Formula(text, NAMES)
    if text.startswith("10"):
        assert formula(x=0.0) == 1e195
        return
    with pytest.raises(SceneError, match="at x = 0"):
        formula(x=0.0)
