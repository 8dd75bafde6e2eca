"""Making the oracle wrong for a while: the code of one function is exchanged in place.

Everybody who has imported the function, or bound it as a method, runs the changed code; nothing is
imported anew, and nothing is written to disk.
"""

from __future__ import annotations

import ast
import inspect
from contextlib import contextmanager
from copy import copy
from functools import cached_property
from importlib import import_module
from types import CodeType, FunctionType
from typing import TYPE_CHECKING, Any, Final

if TYPE_CHECKING:
    from collections.abc import Iterator

    from conformance.mutation.operators import Plan

_FUTURE: Final = ast.parse("from __future__ import annotations").body
_NAMED: Final = (ast.ClassDef, ast.FunctionDef)


class Seed:
    """A mutant, ready to be planted."""

    def __init__(self, plan: Plan) -> None:
        self._plan = plan

    @contextmanager
    def planted(self) -> Iterator[None]:
        """Run the mutant's code instead of retail's inside the block."""
        function: Any = self.function
        retail = function.__code__
        function.__code__ = self.code
        try:
            yield
        finally:
            function.__code__ = retail

    @cached_property
    def function(self) -> FunctionType:
        """The function of the running oracle, without what decorates it."""
        mutant = self._plan.mutant
        owner: Any = import_module(f"oracle.{mutant.file.removesuffix('.py')}")
        *outer, name = mutant.function.split(".")
        for part in outer:
            owner = vars(owner)[part]
        return _bare(vars(owner)[name])

    @cached_property
    def code(self) -> CodeType:
        """The changed code; the syntax tree is as it was when this returns."""
        place = self._plan.place
        place.put(self._plan.other)
        try:
            return self._compiled()
        finally:
            place.put(place.node)

    def _compiled(self) -> CodeType:
        mutant = self._plan.mutant
        free = self.function.__code__.co_freevars
        statement = _alone(self._plan.tree, mutant.function.split("."), free)
        module = ast.Module([*_FUTURE, statement], [])
        compiled = compile(ast.fix_missing_locations(module), self.function.__code__.co_filename, "exec")
        return next(code for code in _nested(compiled) if code.co_qualname == mutant.function)


def _bare(attribute: Any) -> FunctionType:
    if isinstance(attribute, staticmethod | classmethod):
        attribute = attribute.__func__
    elif isinstance(attribute, property):
        attribute = attribute.fget
    function: FunctionType = inspect.unwrap(attribute)
    return function


def _alone(owner: ast.Module | ast.ClassDef, names: list[str], free: tuple[str, ...]) -> ast.stmt:
    """Return a function inside the classes that it is defined in, and nothing beside it.

    Code can only be exchanged for code with the same free variables, and a mutant may have lost the `super()`
    that made `__class__` one of them: they are named once more, where it does not matter.
    """
    name, *inner = names
    found = next(node for node in owner.body if isinstance(node, _NAMED) and node.name == name)
    alone = copy(found)
    alone.decorator_list = []
    if isinstance(alone, ast.ClassDef):
        alone.bases = []
        alone.body = [_alone(alone, inner, free)]
    else:
        alone.body = [*alone.body, *(ast.Expr(ast.Name(name, ast.Load())) for name in free)]
    return alone


def _nested(code: CodeType) -> Iterator[CodeType]:
    yield code
    for constant in code.co_consts:
        if isinstance(constant, CodeType):
            yield from _nested(constant)
