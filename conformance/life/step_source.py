"""The steps of the specification, read from the oracle's sources: each is a comment beside its statement."""

from __future__ import annotations

import ast
import functools
import io
import re
import tokenize
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Final

import oracle

if TYPE_CHECKING:
    from collections.abc import Iterator

ORACLE: Final = Path(oracle.__file__).parent

_LABEL: Final = re.compile(r"((?:\d\d )?(?:[A-Z][A-Z0-9]*-\d|\d+\.[\dA-Z])[^:]*)(?:: (.*))?")
"""``FC-7``, ``07 4.2`` or several of them, and what else the comment says."""
_WIDEST_STATEMENT: Final = 90
"""Characters of a statement that are shown."""


@dataclass(frozen=True, slots=True)
class Statement:
    """A statement of the oracle, with the step that begins there.

    Attributes
    ----------
    text : str
        Its source in one line; of a condition or loop, the head.
    label : str
        ``FC-7``, or ``07 4.2`` for a section of document 07; empty if no step begins here.
    remark : str
        What the oracle's comment says besides.
    body : tuple of int or None
        Of a condition or loop, the first and last line of what runs if it holds.
    is_loop : bool
        Whether it goes through the items of something.
    """

    text: str
    label: str
    remark: str
    body: tuple[int, int] | None
    is_loop: bool


@functools.cache
def statements_of(file: str) -> dict[int, Statement]:
    """Read a module of the oracle: the statement at each line, heads of conditions and loops included.

    Parameters
    ----------
    file : str
        Path of the module.
    """
    source = Path(file).read_text(encoding="utf-8")
    nodes = sorted(_nodes(ast.parse(source)), key=lambda node: node.lineno)
    labels: dict[int, tuple[str, str]] = {}
    for row, own_line, label, remark in _labels(source):
        target = _labelled(nodes, row, own_line=own_line)
        if target is not None:
            labels.setdefault(target.lineno, (label, remark))
    at_line: dict[int, Statement] = {}
    for node in nodes:
        statement = Statement(
            _text(node), *labels.get(node.lineno, ("", "")), _body(node), isinstance(node, ast.For)
        )
        at_line |= dict.fromkeys(range(node.lineno, _last_line(node) + 1), statement)
    return at_line


def _nodes(tree: ast.AST) -> Iterator[ast.stmt]:
    for node in ast.walk(tree):
        if isinstance(node, ast.stmt) and not isinstance(node, ast.FunctionDef | ast.ClassDef):
            yield node


def _labels(source: str) -> Iterator[tuple[int, bool, str, str]]:
    """Yield each label: its row, whether the comment has a line of its own, the label and the rest."""
    for token in tokenize.generate_tokens(io.StringIO(source).readline):
        if token.type == tokenize.COMMENT:
            match = _LABEL.fullmatch(token.string.lstrip("# "))
            if match:
                yield token.start[0], token.line.lstrip().startswith("#"), match[1], match[2] or ""


def _labelled(nodes: list[ast.stmt], row: int, *, own_line: bool) -> ast.stmt | None:
    """Return the statement that a comment speaks of: the next one, or the one at whose side it stands."""
    if own_line:
        return next((node for node in nodes if node.lineno > row), None)
    return next((node for node in reversed(nodes) if node.lineno <= row <= _last_line(node)), None)


def _last_line(node: ast.stmt) -> int:
    """Return the last line of a statement or, if others are inside it, of its head."""
    body = getattr(node, "body", None)
    end = body[0].lineno - 1 if body else node.end_lineno
    return max(node.lineno, end or node.lineno)


def _body(node: ast.stmt) -> tuple[int, int] | None:
    if not isinstance(node, ast.If | ast.While | ast.For):
        return None
    return node.body[0].lineno, node.body[-1].end_lineno or node.body[-1].lineno


def _text(node: ast.stmt) -> str:
    match node:
        case ast.If() | ast.While():
            text = f"{'if' if isinstance(node, ast.If) else 'while'} {ast.unparse(node.test)}"
        case ast.For():
            text = f"for {ast.unparse(node.target)} in {ast.unparse(node.iter)}"
        case _:
            text = ast.unparse(node).partition("\n")[0]
    return text if len(text) <= _WIDEST_STATEMENT else f"{text[: _WIDEST_STATEMENT - 1]}…"
