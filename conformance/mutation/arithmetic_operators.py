"""Mistakes in formulas: roundings, orders of addition, signs, operands, constants."""

from __future__ import annotations

import ast
import math
from typing import TYPE_CHECKING, Final

from conformance.floats import is_float32, next_float32

if TYPE_CHECKING:
    from collections.abc import Iterator

    from conformance.mutation.facts import Facts
    from conformance.mutation.places import Place

_FLAG_HOLDERS: Final = (ast.Assign, ast.AnnAssign, ast.Return, ast.IfExp, ast.Call, ast.Tuple)
"""What holds a 0 or 1 that says no or yes; elsewhere it counts."""
_COUNTING_CALL: Final = "range"


def without_rounding(place: Place, _facts: Facts) -> Iterator[ast.AST]:
    """Leave out an f32(): the register goes on unrounded."""
    match place.node:
        case ast.Call(func=ast.Name("f32"), args=[register]):
            yield register


def other_order(place: Place, _facts: Facts) -> Iterator[ast.AST]:
    """Add three terms in the two other ways."""
    match place.node:
        case ast.BinOp(
            left=ast.BinOp(left=a, op=(ast.Add() | ast.Sub()) as first, right=b),
            op=(ast.Add() | ast.Sub()) as second,
            right=c,
        ):
            inner = _sum(b, c, negative=type(first) is not type(second))
            yield ast.BinOp(a, first, inner)
            yield ast.BinOp(ast.BinOp(a, second, c), first, b)
        case ast.BinOp(
            left=a,
            op=(ast.Add() | ast.Sub()) as first,
            right=ast.BinOp(left=b, op=(ast.Add() | ast.Sub()) as second, right=c),
        ):
            last = ast.Add() if type(first) is type(second) else ast.Sub()
            yield ast.BinOp(ast.BinOp(a, first, b), last, c)
            yield ast.BinOp(ast.BinOp(a, last, c), first, b)


def _sum(a: ast.expr, b: ast.expr, *, negative: bool) -> ast.expr:
    return ast.BinOp(a, ast.Sub() if negative else ast.Add(), b)


def other_sign(place: Place, _facts: Facts) -> Iterator[ast.AST]:
    """Leave out a minus, or subtract what is added."""
    match place.node:
        case ast.UnaryOp(op=ast.USub(), operand=positive):
            yield positive
        case ast.BinOp(left=a, op=ast.Add(), right=b):
            yield ast.BinOp(a, ast.Sub(), b)


def swapped_operands(place: Place, _facts: Facts) -> Iterator[ast.AST]:
    """Subtract, or divide, the other way round; of an absolute difference it would change nothing."""
    if isinstance(place.parent, ast.Call) and ast.unparse(place.parent.func) == "abs":
        return
    match place.node:
        case ast.BinOp(left=a, op=(ast.Sub() | ast.Div()) as op, right=b):
            yield ast.BinOp(b, op, a)


def other_constant(place: Place, facts: Facts) -> Iterator[ast.AST]:
    """Move a constant to its neighbours: one ULP of the format that it has, or one."""
    match place.node:
        case ast.Constant(value=bool() as truth):
            yield ast.Constant(not truth)
        case ast.Constant(value=int() as number):
            yield from _wholes(number, place)
        case ast.Constant(value=float() as number):
            yield from _floats(number)
        case ast.Name(id=name, ctx=ast.Load()):
            named = facts.number(name)
            if isinstance(named, int):
                yield from _wholes(named, place)
            elif named is not None:
                yield from _floats(named)


def _wholes(number: int, place: Place) -> Iterator[ast.AST]:
    if number in {0, 1} and _is_flag(place.parent):
        yield ast.Constant(1 - number)
        return
    yield ast.Constant(number + 1)
    if number > 0:
        yield ast.Constant(number - 1)


def _is_flag(parent: ast.AST) -> bool:
    counts = isinstance(parent, ast.Call) and ast.unparse(parent.func) == _COUNTING_CALL
    return isinstance(parent, _FLAG_HOLDERS) and not counts


def _floats(number: float) -> Iterator[ast.AST]:
    if number == 0.0:
        yield ast.Constant(1.0)
        return
    if is_float32(number):
        neighbours = next_float32(number), -next_float32(-number)
    else:
        neighbours = math.nextafter(number, math.inf), math.nextafter(number, -math.inf)
    yield from map(ast.Constant, neighbours)
