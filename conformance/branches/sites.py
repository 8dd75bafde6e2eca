"""The branches of a module, read from its source: conditions and loops, and the ways they can go."""

from __future__ import annotations

import ast
import re
from collections import Counter
from dataclasses import dataclass
from typing import TYPE_CHECKING, Final, TypeAlias

if TYPE_CHECKING:
    from collections.abc import Iterator

Statement: TypeAlias = ast.If | ast.While | ast.For
"""What branches."""
FunctionNode: TypeAlias = ast.FunctionDef | ast.AsyncFunctionDef

TRUE: Final = "true"
FALSE: Final = "false"
NEXT: Final = "an item"
END: Final = "no item left"

_CITED: Final = re.compile(r"\b0x[0-9A-F]{8}(?:, (\d\d))?\b")
"""The address of a function of retail in a docstring, and the document that specifies it."""


class UnknownBranchError(LookupError):
    """A line that is said to branch holds no condition and no loop."""


@dataclass(frozen=True, slots=True)
class Branch:
    """One way that a condition or loop can go.

    Attributes
    ----------
    line : int
        Where the condition begins.
    condition : str
        Its text in one line; the second of the same text in a function ends with ``#2``, and so on.
    way : str
        `TRUE` or `FALSE`; of a ``for``, `NEXT` or `END`.
    body : tuple of int
        First and last line of what runs if the condition is true.
    """

    line: int
    condition: str
    way: str
    body: tuple[int, int]

    @property
    def key(self) -> str:
        """What reasons call it within its function."""
        return f"{self.condition}: {self.way}"

    def is_taken(self, line: int, target: int) -> bool:
        """Tell whether it leads from a line to another (negative: out of the function)."""
        inside = self.body[0] <= target <= self.body[1]
        return self.line == line and inside == (self.way in {TRUE, NEXT})


@dataclass(frozen=True, slots=True)
class Function:
    """A function or method with its branches.

    Attributes
    ----------
    name : str
        Qualified within its module, as coverage.py reports it: ``BSPTree.find_collisions``.
    document : str
        Two digits of the document it is ported from: the one that its docstring cites, else the one that
        most of its module cites; empty for a module that cites none.
    branches : tuple of Branch
        In the order of the source, both ways of each condition.
    """

    name: str
    document: str
    branches: tuple[Branch, ...]

    def taken(self, line: int, target: int) -> Branch:
        """Return the branch that leads from a line to another (negative: out of the function).

        Raises
        ------
        UnknownBranchError
            No condition of the function begins in that line.
        """
        for branch in self.branches:
            if branch.is_taken(line, target):
                return branch
        raise UnknownBranchError(f"{self.name} has no condition in line {line}")


def functions_of(source: str) -> dict[str, Function]:
    """Read every function of a module, by its qualified name."""
    tree = ast.parse(source)
    majority = _most_cited(tree)
    return {name: _read(name, node, majority) for name, node in _functions(tree, "")}


def nodes_of(tree: ast.Module) -> Iterator[tuple[str, FunctionNode]]:
    """Yield every function of a parsed module, with its qualified name."""
    return _functions(tree, "")


def _functions(node: ast.AST, prefix: str) -> Iterator[tuple[str, FunctionNode]]:
    for child in ast.iter_child_nodes(node):
        if isinstance(child, FunctionNode):
            yield f"{prefix}{child.name}", child
            yield from _functions(child, f"{prefix}{child.name}.")
        elif isinstance(child, ast.ClassDef):
            yield from _functions(child, f"{prefix}{child.name}.")
        else:
            yield from _functions(child, prefix)


def _read(name: str, node: FunctionNode, majority: str) -> Function:
    statements = sorted(_statements(node), key=lambda statement: statement.lineno)
    seen: Counter[str] = Counter()
    branches: list[Branch] = []
    for statement in statements:
        text = _condition(statement)
        seen[text] += 1
        condition = text if seen[text] == 1 else f"{text} #{seen[text]}"
        ways = (NEXT, END) if isinstance(statement, ast.For) else (TRUE, FALSE)
        first, last = statement.body[0].lineno, statement.body[-1].end_lineno or statement.lineno
        branches += [Branch(statement.lineno, condition, way, (first, last)) for way in ways]
    return Function(name, _cited(node) or majority, tuple(branches))


def _statements(node: ast.AST) -> Iterator[Statement]:
    """Yield the conditions of a function but not those of functions inside it."""
    for child in ast.iter_child_nodes(node):
        if isinstance(child, FunctionNode | ast.ClassDef | ast.Lambda):
            continue
        if isinstance(child, Statement):
            yield child
        yield from _statements(child)


def _condition(statement: Statement) -> str:
    if isinstance(statement, ast.For):
        return f"for {ast.unparse(statement.target)} in {ast.unparse(statement.iter)}"
    keyword = "while" if isinstance(statement, ast.While) else "if"
    return f"{keyword} {ast.unparse(statement.test)}"


def _cited(node: FunctionNode) -> str:
    match = _CITED.search(ast.get_docstring(node) or "")
    return (match[1] or "") if match else ""


def _most_cited(tree: ast.Module) -> str:
    """Return the document that most functions of a module cite: its helpers are counted there."""
    cited = Counter(filter(None, (_cited(node) for _, node in _functions(tree, ""))))
    return cited.most_common(1)[0][0] if cited else ""
