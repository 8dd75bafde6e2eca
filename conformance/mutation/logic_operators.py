"""Mistakes in decisions and in what is done: conditions, states, children, arguments, writes."""

from __future__ import annotations

import ast
from typing import TYPE_CHECKING, Final

from conformance.mutation.facts import ENUMS, assigned_before

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from conformance.mutation.facts import Facts
    from conformance.mutation.places import Place

_OTHER_LIMIT: Final[Mapping[type[ast.cmpop], type[ast.cmpop]]] = {
    ast.Lt: ast.LtE,
    ast.LtE: ast.Lt,
    ast.Gt: ast.GtE,
    ast.GtE: ast.Gt,
}
_OPPOSITE: Final[Mapping[type[ast.cmpop], type[ast.cmpop]]] = {
    ast.Eq: ast.NotEq,
    ast.NotEq: ast.Eq,
    ast.Is: ast.IsNot,
    ast.IsNot: ast.Is,
    ast.In: ast.NotIn,
    ast.NotIn: ast.In,
}
_OTHER_CHILD: Final = {
    "pos_node": "neg_node",
    "neg_node": "pos_node",
    "positive": "negative",
    "negative": "positive",
}
"""A node's children, by the names of their fields and of the variables that hold them."""
_SYMMETRIC: Final = frozenset({"dot_x", "dot_z", "in_bounds", "is_equal", "min", "plus"})
"""Functions that answer the same, bit for bit, whichever of two arguments comes first."""


def other_comparison(place: Place, _facts: Facts) -> Iterator[ast.AST]:
    """Move the limit itself to the other side; of what has no order, ask the opposite."""
    if isinstance(place.node, ast.Compare):
        node = place.node
        for index, op in enumerate(node.ops):
            other = _OTHER_LIMIT.get(type(op)) or _OPPOSITE[type(op)]
            ops = [*node.ops[:index], other(), *node.ops[index + 1 :]]
            yield ast.Compare(node.left, ops, node.comparators)


def negated(place: Place, _facts: Facts) -> Iterator[ast.AST]:
    """Turn a condition, or a part of one, into its opposite."""
    is_test = place.field == "test" and isinstance(place.parent, ast.If | ast.While | ast.IfExp)
    if isinstance(place.node, ast.expr) and (is_test or isinstance(place.parent, ast.BoolOp)):
        yield _opposite(place.node)


def _opposite(test: ast.expr) -> ast.expr:
    match test:
        case ast.UnaryOp(op=ast.Not(), operand=operand):
            return operand
        case ast.Compare(left=left, ops=[op], comparators=right) if type(op) in _OPPOSITE:
            return ast.Compare(left, [_OPPOSITE[type(op)]()], right)
        case _:
            return ast.UnaryOp(ast.Not(), test)


def other_connective(place: Place, _facts: Facts) -> Iterator[ast.AST]:
    """Ask for one condition where both are needed, or the other way round."""
    match place.node:
        case ast.BoolOp(op=ast.And(), values=values):
            yield ast.BoolOp(ast.Or(), values)
        case ast.BoolOp(op=ast.Or(), values=values):
            yield ast.BoolOp(ast.And(), values)


def other_state(place: Place, facts: Facts) -> Iterator[ast.AST]:
    """Put the next member of an enumeration, or the next flag bit, in a name's place."""
    match place.node:
        case ast.Attribute(value=ast.Name(id=kind), attr=name) if kind in ENUMS and kind in facts.names:
            members = list(ENUMS[kind].__members__)
            other = members[(members.index(name) + 1) % len(members)]
            yield ast.Attribute(ast.Name(kind, ast.Load()), other, ast.Load())
        case ast.Name(id=name, ctx=ast.Load()):
            bit = facts.next_bit(name)
            if bit is not None:
                yield ast.Constant(bit)


def other_child(place: Place, _facts: Facts) -> Iterator[ast.AST]:
    """Take the other child of a node."""
    match place.node:
        case ast.Attribute(value=node, attr=name, ctx=ast.Load()) if name in _OTHER_CHILD:
            yield ast.Attribute(node, _OTHER_CHILD[name], ast.Load())
        case ast.Name(id=name, ctx=ast.Load()) if name in _OTHER_CHILD:
            yield ast.Name(_OTHER_CHILD[name], ast.Load())


def swapped_arguments(place: Place, facts: Facts) -> Iterator[ast.AST]:
    """Exchange two neighbouring arguments that have the same type, if that can matter."""
    if not isinstance(place.node, ast.Call):
        return
    call = place.node
    name = _called(call.func)
    types = () if name in _SYMMETRIC else facts.signatures.get(name, ())
    for index in range(min(len(types), len(call.args)) - 1):
        first, second = call.args[index : index + 2]
        if types[index] and types[index] == types[index + 1] and ast.dump(first) != ast.dump(second):
            arguments = [*call.args[:index], second, first, *call.args[index + 2 :]]
            yield ast.Call(call.func, arguments, call.keywords)


def _called(function: ast.expr) -> str:
    match function:
        case ast.Name(id=name) | ast.Attribute(attr=name):
            return name
        case _:
            return ""


def without_write(place: Place, facts: Facts) -> Iterator[ast.AST]:
    """Leave out a statement that changes something, or that leaves a loop or a function early.

    Where a name gets its first value, nothing would be left to run with.
    """
    node = place.node
    match node:
        case ast.Assign(targets=[ast.Name(id=name)]):
            if assigned_before(facts.function, node, name):
                yield ast.Pass()
        case (
            ast.Break()
            | ast.Continue()
            | ast.Return(value=None)
            | ast.AugAssign()
            | ast.Expr(value=ast.Call())
            | ast.Assign(targets=[ast.Attribute() | ast.Subscript()])
            | ast.AnnAssign(target=ast.Attribute())
        ):
            yield ast.Pass()
