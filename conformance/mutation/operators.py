"""All mistakes of one kind each, and the mutants that they make of the oracle's functions."""

from __future__ import annotations

import ast
from collections import Counter
from importlib import import_module
from typing import TYPE_CHECKING, Final, NamedTuple, TypeAlias

from conformance.branches.sites import functions_of, nodes_of
from conformance.mutation import arithmetic_operators as arithmetic
from conformance.mutation import logic_operators as logic
from conformance.mutation.facts import facts_of, signatures_of
from conformance.mutation.mutant import Mutant, Operator
from conformance.mutation.places import places_of

if TYPE_CHECKING:
    from collections.abc import Callable, Collection, Iterator, Mapping

    from conformance.branches.sites import FunctionNode
    from conformance.mutation.facts import Facts
    from conformance.mutation.places import Place

    Mistake: TypeAlias = Callable[[Place, Facts], Iterator[ast.AST]]

OPERATORS: Final[Mapping[Operator, Mistake]] = {
    Operator.COMPARISON: logic.other_comparison,
    Operator.CONDITION: logic.negated,
    Operator.CONNECTIVE: logic.other_connective,
    Operator.ROUNDING: arithmetic.without_rounding,
    Operator.ASSOCIATION: arithmetic.other_order,
    Operator.SIGN: arithmetic.other_sign,
    Operator.OPERANDS: arithmetic.swapped_operands,
    Operator.CONSTANT: arithmetic.other_constant,
    Operator.STATE: logic.other_state,
    Operator.CHILDREN: logic.other_child,
    Operator.ARGUMENTS: logic.swapped_arguments,
    Operator.WRITE: logic.without_write,
}
"""What makes the replacements of each kind; of equal ones, the first kind's counts."""
HELPERS: Final = {"polygon_edges.py": "02"}
"""Documents of modules that hold shared parts of retail functions, and cite no address of their own."""
_LEFT_OUT: Final = ("__init__", "__repr__")
"""Constructors make fields that retail's own functions fill; the others are for people who debug."""


class Plan(NamedTuple):
    """A mutant, and how to make it.

    Attributes
    ----------
    mutant : Mutant
        The mutant.
    tree : ast.Module
        The module, as it is written.
    place : Place
        Where in the tree the change is.
    other : ast.AST
        What is put there.
    """

    mutant: Mutant
    tree: ast.Module
    place: Place
    other: ast.AST


def plans(sources: Mapping[str, str], documents: Collection[str]) -> Iterator[Plan]:
    """Make the mutants of every function that is ported from certain documents.

    Parameters
    ----------
    sources : Mapping of str to str
        The oracle's modules: file name and text.
    documents : collection of str
        Two digits each.

    Yields
    ------
    Plan
        By file, in the order of the source; always the same.
    """
    signatures = signatures_of(sources)
    for file, source in sources.items():
        tree = ast.parse(source)
        read = functions_of(source)
        names = vars(import_module(f"oracle.{file.removesuffix('.py')}"))
        for name, node in nodes_of(tree):
            document = read[name].document or HELPERS.get(file, "")
            if document in documents and not name.endswith(_LEFT_OUT):
                facts = facts_of(node, names, signatures)
                yield from _plans_of(tree, (file, name, document), node, facts)


def _plans_of(
    tree: ast.Module, site: tuple[str, str, str], node: FunctionNode, facts: Facts
) -> Iterator[Plan]:
    seen: Counter[tuple[Operator, str, str]] = Counter()
    for place in places_of(node):
        texts: set[str] = set()
        for operator, mistake in OPERATORS.items():
            for other in mistake(place, facts):
                before, after = ast.unparse(place.node), _text(other)
                if after in texts:
                    continue
                texts.add(after)
                seen[operator, before, after] += 1
                nth = seen[operator, before, after]
                line = getattr(place.node, "lineno", place.reach.start)
                mutant = Mutant(*site, operator, before, after, nth, line, place.head, place.reach)
                yield Plan(mutant, tree, place, other)


def _text(node: ast.AST) -> str:
    return ast.unparse(ast.fix_missing_locations(node))
