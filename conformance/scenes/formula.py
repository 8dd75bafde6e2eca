"""Formulas of terrain heights: a little arithmetic in named numbers, read from text and never run as code."""

from __future__ import annotations

import ast
import math
import operator
from types import MappingProxyType
from typing import TYPE_CHECKING, Final

from conformance.scenes.errors import SceneError

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

LONGEST: Final = 200
"""Characters of a formula; longer ones belong in a table of heights."""
HOW: Final = "numbers, x, y, i, j, + - * / ( ) and min, max, abs, floor"

_OPERATORS: Final[Mapping[type[ast.operator], Callable[[float, float], float]]] = MappingProxyType(
    {ast.Add: operator.add, ast.Sub: operator.sub, ast.Mult: operator.mul, ast.Div: operator.truediv}
)
_SIGNS: Final[Mapping[type[ast.unaryop], Callable[[float], float]]] = MappingProxyType(
    {ast.UAdd: operator.pos, ast.USub: operator.neg}
)
_FUNCTIONS: Final[Mapping[str, tuple[Callable[..., float], int]]] = MappingProxyType(
    {"min": (min, 2), "max": (max, 2), "abs": (abs, 1), "floor": (math.floor, 1)}
)
"""Functions by name, each with the least number of its arguments; only min and max take more."""


class Formula:
    """A formula that was read and may be evaluated.

    Parameters
    ----------
    text : str
        Such as ``94 + max(0, x - 96) / 4``.
    names : frozenset of str
        What it may speak of.

    Raises
    ------
    SceneError
        It is not a formula, or speaks of something else.
    """

    def __init__(self, text: str, names: frozenset[str]) -> None:
        if len(text) > LONGEST:
            raise SceneError("", f"a formula of {len(text)} characters", f"at most {LONGEST}")
        try:
            self._body = ast.parse(text.strip(), mode="eval").body
        except (SyntaxError, ValueError, RecursionError, MemoryError):
            raise SceneError("", f"the formula {text!r}", HOW) from None
        self._text = text
        self._names = names
        self._check(self._body)

    def __call__(self, **values: float) -> float:
        """Evaluate it in float64; raises `SceneError` where that is not a finite number."""
        try:
            result = float(self._value(self._body, values))
        except (ArithmeticError, ValueError):
            result = math.nan
        if not math.isfinite(result):
            where = ", ".join(f"{name} = {value:g}" for name, value in values.items())
            raise SceneError(
                "", f"no finite height of {self._text!r} at {where}", "a finite number everywhere"
            )
        return result

    def _check(self, node: ast.expr) -> None:
        match node:
            case ast.Constant(value=int() | float()) if not isinstance(node.value, bool):
                return
            case ast.Name(id=name) if name in self._names:
                return
            case ast.BinOp(left, sign, right) if type(sign) in _OPERATORS:
                self._check(left)
                self._check(right)
            case ast.UnaryOp(sign, operand) if type(sign) in _SIGNS:
                self._check(operand)
            case ast.Call(ast.Name(id=name), arguments, []) if name in _FUNCTIONS:
                least = _FUNCTIONS[name][1]
                if len(arguments) < least or (least == 1 and len(arguments) > 1):
                    raise SceneError("", f"{name} of {len(arguments)} numbers", f"{name} of {least}")
                for argument in arguments:
                    self._check(argument)
            case _:
                raise SceneError("", f"{ast.unparse(node)!r} in the formula {self._text!r}", HOW)

    def _value(self, node: ast.expr, values: Mapping[str, float]) -> float:
        match node:
            case ast.Name(id=name):
                return values[name]
            case ast.BinOp(left, sign, right):
                return _OPERATORS[type(sign)](self._value(left, values), self._value(right, values))
            case ast.UnaryOp(sign, operand):
                return _SIGNS[type(sign)](self._value(operand, values))
            case ast.Call(ast.Name(id=name), arguments, _):
                return _FUNCTIONS[name][0](*(self._value(argument, values) for argument in arguments))
            case ast.Constant(value=number):
                return float(number)  # type: ignore[arg-type]
            case _:  # pragma: no cover - _check has refused everything else
                raise AssertionError(node)
