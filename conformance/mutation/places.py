"""The places of a function's syntax tree at which something can be replaced."""

from __future__ import annotations

import ast
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Final

if TYPE_CHECKING:
    from collections.abc import Iterator

    from conformance.branches.sites import FunctionNode

_SKIPPED: Final = (ast.Raise, ast.expr_context, ast.JoinedStr)
"""Errors are the port's own, their words are for people."""


@dataclass(frozen=True, slots=True)
class Place:
    """A node, and where it hangs.

    Attributes
    ----------
    node : ast.AST
        What is written there.
    parent : ast.AST
        Whose part it is.
    field : str
        Under which name.
    index : int or None
        Its number, if the field is a list.
    statement : ast.stmt
        The innermost statement that it is in.
    """

    node: ast.AST
    parent: ast.AST
    field: str
    index: int | None
    statement: ast.stmt

    @property
    def reach(self) -> range:
        """Lines that run when the statement does, without those of its body."""
        body: list[ast.stmt] = getattr(self.statement, "body", [])
        first, last = self.statement.lineno, self.statement.end_lineno or self.statement.lineno
        return range(first, max(body[0].lineno, first + 1) if body else last + 1)

    @property
    def head(self) -> str:
        """The statement in one line; of a compound one what comes before its body."""
        return ast.unparse(self.statement).split("\n", 1)[0]

    def put(self, node: ast.AST) -> None:
        """Write another node there."""
        if self.index is None:
            setattr(self.parent, self.field, node)
        else:
            getattr(self.parent, self.field)[self.index] = node


def places_of(function: FunctionNode) -> Iterator[Place]:
    """Yield every place in the body of a function, outer ones first, in the order of the source."""
    for index, statement in enumerate(function.body):
        if not _is_text(statement):
            yield from _below(Place(statement, function, "body", index, statement))


def _below(place: Place) -> Iterator[Place]:
    if isinstance(place.node, _SKIPPED):
        return
    yield place
    for name, value in ast.iter_fields(place.node):
        if name in {"annotation", "returns"}:
            continue
        children: list[Any] = value if isinstance(value, list) else [value]
        for index, child in enumerate(children):
            if isinstance(child, ast.AST):
                number = index if isinstance(value, list) else None
                statement = child if isinstance(child, ast.stmt) else place.statement
                yield from _below(Place(child, place.node, name, number, statement))


def _is_text(statement: ast.stmt) -> bool:
    return isinstance(statement, ast.Expr) and isinstance(statement.value, ast.Constant)
