"""What the operators know about the oracle beside the node they look at."""

from __future__ import annotations

import ast
from dataclasses import dataclass
from enum import IntEnum
from importlib import import_module
from typing import TYPE_CHECKING, Any, Final

from oracle import enums

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from conformance.branches.sites import FunctionNode

ENUMS: Final[Mapping[str, type[IntEnum]]] = {
    name: value
    for name, value in vars(enums).items()
    if isinstance(value, type) and issubclass(value, IntEnum) and value is not IntEnum
}
"""Retail's enumerations by name."""
_BIT_MODULES: Final = ("oracle.enums", "oracle.physics_state", "oracle.transient_state")


@dataclass(frozen=True, slots=True)
class Facts:
    """Names of a function's module, and of the function itself.

    Attributes
    ----------
    function : FunctionNode
        The function.
    names : Mapping of str to object
        The globals of its module.
    signatures : Mapping of str to tuple of str
        Types of the positional parameters of the oracle's functions and classes, as they are written.
    local : frozenset of str
        Names that the function assigns.
    """

    function: FunctionNode
    names: Mapping[str, Any]
    signatures: Mapping[str, tuple[str, ...]]
    local: frozenset[str]

    def number(self, name: str) -> int | float | None:
        """Return the value of a named number that is no flag bit; None for any other name."""
        value = self.names.get(name)
        is_number = type(value) in {int, float} and name not in self.local and self.next_bit(name) is None
        return value if is_number else None

    def next_bit(self, name: str) -> int | None:
        """Return the flag bit after a named one, in the order of the module that names them; else None."""
        if name in self.local or name not in self.names:
            return None
        for module in _BIT_MODULES:
            bits = _bits(module)
            if name in bits:
                values = list(bits.values())
                return values[(values.index(bits[name]) + 1) % len(values)]
        return None


def facts_of(function: FunctionNode, names: Mapping[str, Any], signatures: Mapping[str, Any]) -> Facts:
    """Gather what the operators need for one function."""
    local = {node.id for node in _stored(function)} | {argument.arg for argument in function.args.args}
    return Facts(function, names, signatures, frozenset(local))


def signatures_of(sources: Mapping[str, str]) -> dict[str, tuple[str, ...]]:
    """Read the types of positional parameters; of functions that share a name, only if all are the same."""
    found: dict[str, set[tuple[str, ...]]] = {}
    for source in sources.values():
        for name, parameters in _signatures(ast.parse(source)):
            found.setdefault(name, set()).add(parameters)
    return {name: next(iter(types)) for name, types in found.items() if len(types) == 1}


def assigned_before(function: FunctionNode, statement: ast.stmt, name: str) -> bool:
    """Tell whether a function has given a name a value above a statement."""
    arguments = {argument.arg for argument in function.args.args}
    return name in arguments or any(
        node.id == name and node.lineno < statement.lineno for node in _stored(function)
    )


def _stored(function: FunctionNode) -> Iterator[ast.Name]:
    for node in ast.walk(function):
        if isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store):
            yield node


def _signatures(tree: ast.Module) -> Iterator[tuple[str, tuple[str, ...]]]:
    for node in ast.walk(tree):
        if isinstance(node, ast.ClassDef):
            for child in node.body:
                if isinstance(child, ast.FunctionDef):
                    name = node.name if child.name == "__init__" else child.name
                    yield name, _types(child)[_bound(child) :]
    for node in tree.body:
        if isinstance(node, ast.FunctionDef):
            # A function whose first parameter is `self` is called as a method of the class that takes it.
            is_method = bool(node.args.args) and node.args.args[0].arg == "self"
            yield node.name, _types(node)[int(is_method) :]


def _types(function: ast.FunctionDef) -> tuple[str, ...]:
    return tuple(ast.unparse(a.annotation) if a.annotation else "" for a in function.args.args)


def _bound(method: ast.FunctionDef) -> int:
    decorators = {ast.unparse(decorator) for decorator in method.decorator_list}
    return 0 if "staticmethod" in decorators else 1


def _bits(module: str) -> dict[str, int]:
    values = vars(import_module(module))
    return {name: value for name, value in values.items() if name.isupper() and type(value) is int}
