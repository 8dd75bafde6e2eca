"""Where documents 02 to 05 compare numbers: read from the oracle's source, so that none is forgotten."""

from __future__ import annotations

import ast
from collections import Counter
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Final, NamedTuple

import oracle
from conformance.branches.sites import functions_of, nodes_of
from conformance.mutation.operators import HELPERS
from conformance.mutation.places import places_of

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from conformance.branches.sites import FunctionNode
    from conformance.mutation.places import Place

DOCUMENTS: Final = ("02", "03", "04", "05")
"""Polygons, trees, the transition's state, and the transition."""
_ORDERING: Final = (ast.Lt, ast.LtE, ast.Gt, ast.GtE, ast.Eq, ast.NotEq)


@dataclass(frozen=True, slots=True, order=True)
class Site:
    """A comparison of two numbers.

    Attributes
    ----------
    module, function : str
        File of the oracle without its ending; the function's qualified name.
    text : str
        The comparison in one line; the second of the same text in a function ends with ``#2``, and so on.
    """

    module: str
    function: str
    text: str

    def __str__(self) -> str:
        return f"{self.module}.{self.function}: {self.text}"


class Written(NamedTuple):
    """A comparison in the source.

    Attributes
    ----------
    tree : ast.Module
        The module.
    place : Place
        Where in the tree it is.
    document : str
        Two digits of the document that the function is ported from.
    """

    tree: ast.Module
    place: Place
    document: str


@cache
def compared() -> Mapping[Site, Written]:
    """Find every comparison of numbers in the functions of `DOCUMENTS`, in the order of the files."""
    folder = Path(oracle.__file__).parent
    files = sorted(folder.glob("*.py"))
    return {site: found for file in files for site, found in _in_module(file)}


def _in_module(file: Path) -> Iterator[tuple[Site, Written]]:
    source = file.read_text(encoding="utf-8")
    functions, tree = functions_of(source), ast.parse(source)
    for name, node in nodes_of(tree):
        document = functions[name].document or HELPERS.get(file.name, "")
        if document in DOCUMENTS:
            for text, place in comparisons_in(node):
                yield Site(file.stem, name, text), Written(tree, place, document)


def comparisons_in(function: FunctionNode) -> Iterator[tuple[str, Place]]:
    """Yield the comparisons of numbers in a function, with their texts as a `Site` has them."""
    seen: Counter[str] = Counter()
    for place in places_of(function):
        if isinstance(place.node, ast.Compare) and _is_of_numbers(place.node):
            text = ast.unparse(place.node)
            seen[text] += 1
            yield (text if seen[text] == 1 else f"{text} #{seen[text]}"), place


def _is_of_numbers(node: ast.Compare) -> bool:
    """Tell whether no operand shows that there is nothing between two values."""
    operands = (node.left, *node.comparators)
    return all(isinstance(operator, _ORDERING) for operator in node.ops) and not any(
        _is_whole(operand) for operand in operands
    )


def _is_whole(operand: ast.expr) -> bool:
    """Tell an integer, and a member of an enumeration, by how they are written."""
    match operand:
        case ast.Constant(value=int() | str()):
            return True
        case ast.Attribute(value=ast.Name(id=owner), attr=member):
            return owner[0].isupper() and member.isupper()
    return False
