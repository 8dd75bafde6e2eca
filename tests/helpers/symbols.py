"""Numbers that remember how they were computed, for tests of roundings and of the order of sums.

A `Symbol` is a value with its expression. A formula of the specification, written with symbols, is
compared with what the port computed; sums and products of two commute, nothing else does. So a store too
many or too few, or another association, fails whatever the numbers are.
"""

from __future__ import annotations

import math
from typing import Any, ClassVar

from oracle.frame import Frame
from oracle.vector import Vector3


def text_of(x: Any) -> str:
    """Return how a symbol was computed, or a plain number's digits."""
    return x.text if isinstance(x, Symbol) else repr(float(x))


def value_of(x: Any) -> float:
    """Return a symbol's value, or a plain number."""
    return x.value if isinstance(x, Symbol) else float(x)


class Symbol:
    """A value and the expression that it comes from; comparisons and floors go by value and are noted."""

    compared: ClassVar[list[tuple[str, str, str]]] = []

    def __init__(self, value: float, text: str) -> None:
        self.value = value
        self.text = text

    def __repr__(self) -> str:
        return f"{self.text} = {self.value}"

    def stored(self) -> Symbol:
        """Note the store; the value is left exact."""
        return Symbol(self.value, f"f32({self.text})")

    def sqrt(self) -> Symbol:
        """Note the root."""
        return Symbol(math.sqrt(self.value), f"sqrt({self.text})")

    def is_nan(self) -> bool:
        """Tell whether the value is NaN."""
        return math.isnan(self.value)

    def sin(self) -> Symbol:
        """Note the sine."""
        return Symbol(math.sin(self.value), f"sin({self.text})")

    def cos(self) -> Symbol:
        """Note the cosine."""
        return Symbol(math.cos(self.value), f"cos({self.text})")

    def power(self, exponent: Any) -> Symbol:
        """Note the power."""
        return Symbol(self.value ** value_of(exponent), f"pow({self.text}, {text_of(exponent)})")

    def divided_by(self, other: Any) -> Symbol:
        """Divide as the operator does."""
        return self / other

    def dividing(self, other: float) -> Symbol:
        """Divide a float as the operator does."""
        return other / self

    def _commuting(self, other: Any, operator: str, value: float) -> Symbol:
        first, second = sorted((self.text, text_of(other)))
        return Symbol(value, f"({first} {operator} {second})")

    def __add__(self, other: Any) -> Symbol:
        return self._commuting(other, "+", self.value + value_of(other))

    __radd__ = __add__

    def __mul__(self, other: Any) -> Symbol:
        return self._commuting(other, "*", self.value * value_of(other))

    __rmul__ = __mul__

    def __sub__(self, other: Any) -> Symbol:
        return Symbol(self.value - value_of(other), f"({self.text} - {text_of(other)})")

    def __rsub__(self, other: Any) -> Symbol:
        return Symbol(value_of(other) - self.value, f"({text_of(other)} - {self.text})")

    def __truediv__(self, other: Any) -> Symbol:
        return Symbol(self.value / value_of(other), f"({self.text} / {text_of(other)})")

    def __rtruediv__(self, other: Any) -> Symbol:
        return Symbol(value_of(other) / self.value, f"({text_of(other)} / {self.text})")

    def __neg__(self) -> Symbol:
        return Symbol(-self.value, f"-{self.text}")

    def __abs__(self) -> Symbol:
        return Symbol(abs(self.value), f"|{self.text}|")

    def __floor__(self) -> int:
        self.compared.append((self.text, "floor", repr(math.floor(self.value))))
        return math.floor(self.value)

    def __eq__(self, other: object) -> bool:
        self.compared.append((self.text, "==", text_of(other)))
        return self.value == value_of(other)

    __hash__ = None  # type: ignore[assignment]

    def __lt__(self, other: Any) -> bool:
        self.compared.append((self.text, "<", text_of(other)))
        return self.value < value_of(other)

    def __le__(self, other: Any) -> bool:
        self.compared.append((self.text, "<=", text_of(other)))
        return self.value <= value_of(other)

    def __gt__(self, other: Any) -> bool:
        self.compared.append((self.text, ">", text_of(other)))
        return self.value > value_of(other)

    def __ge__(self, other: Any) -> bool:
        self.compared.append((self.text, ">=", text_of(other)))
        return self.value >= value_of(other)


def f(x: Any) -> Any:
    """Write a store."""
    return x.stored()


def vec(name: str, x: float = 0.5, y: float = 0.25, z: float = 0.125) -> Any:
    """Return a vector of symbols, ``name.x`` and so on."""
    return Vector3(Symbol(x, f"{name}.x"), Symbol(y, f"{name}.y"), Symbol(z, f"{name}.z"))  # type: ignore[arg-type]


def frame(name: str) -> Any:
    """Return a frame of symbols, ``name.m0`` and so on, that is the identity by value."""
    made: Any = Frame()
    for i in range(9):
        setattr(made, f"m{i}", Symbol(1.0 if i % 4 == 0 else 0.0, f"{name}.m{i}"))
    for part in ("qw", "qx", "qy", "qz"):
        setattr(made, part, Symbol(0.5, f"{name}.{part}"))
    made.origin = vec(f"{name}.o")
    return made


def assert_vector(got: Any, *wanted: Any) -> None:
    """Compare three components by how they were computed."""
    assert [text_of(c) for c in (got.x, got.y, got.z)] == [text_of(c) for c in wanted]


def assert_floored(*arguments: Any) -> None:
    """Demand that whole numbers below these expressions were asked for, in this order."""
    assert [left for left, operator, _ in Symbol.compared if operator == "floor"] == [
        text_of(x) for x in arguments
    ]


def assert_compared(left: Any, operator: str, right: Any) -> None:
    """Demand that two expressions were compared so."""
    assert (text_of(left), operator, text_of(right)) in Symbol.compared
