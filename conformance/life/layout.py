"""The layout of case files: keys in the order of the documentation, even spacing, comments kept."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final, NamedTuple

import yaml

from conformance.schema.case import CaseModel
from conformance.yaml_source import YamlError, parse, split_lines

if TYPE_CHECKING:
    from collections.abc import Iterator

    from conformance.source import DocPath
    from conformance.yaml_source import Document

ORDER: Final = tuple(CaseModel.model_fields)
"""The keys of a case, as the documentation lists them."""

_CASES: Final = "cases"
_COMMENT: Final = "#"
_DASH: Final = "-"


class LayoutError(ValueError):
    """A file cannot be laid out anew without changing what it says."""

    def __init__(self, name: str) -> None:
        super().__init__(
            f"{name}: laid out anew it would say something else (does an anchor come behind its alias,"
            " is the case written with braces, or with tabs?)"
        )


class _Block(NamedTuple):
    """The lines of a key, from the comments above it to its last one."""

    key: str
    lines: list[str]


def lay_out(raw: bytes, name: str) -> str:
    """Return the text of a case file in the layout of this project.

    The keys of each case are in the order of `ORDER`, each with the comments above it; comments above the
    first one speak of the whole case or file, and stay where they are. There is an empty line between cases,
    none at the beginning and never more than one. Lines end with a line feed and have no blanks at their
    end. What is in the values of keys, texts of several lines above all, stays as it is.

    Parameters
    ----------
    raw : bytes
        The file.
    name : str
        What messages call it.

    Raises
    ------
    YamlError
        It cannot be read, or something in it was refused.
    LayoutError
        Then it would say something else, because an anchor comes behind an alias of it, for instance.
    """
    document = parse(raw, name)
    if document.refusals:
        raise YamlError(document.refusals[0][1])
    ordered = "\n".join(_in_order(document))
    text = "".join(f"{line}\n" for line in _spaced(ordered, _same(document, ordered, name)))
    _same(document, text, name)
    return text


def _same(document: Document, text: str, name: str) -> Document:
    """Read a text that has to say what a document says."""
    try:
        again = parse(text.encode("utf-8"), name)
    except YamlError as error:
        raise LayoutError(name) from error
    if again.data != document.data or again.refusals:
        raise LayoutError(name)
    return again


def _in_order(document: Document) -> list[str]:
    """Return the lines of a document with the keys of each case in order."""
    lines = list(document.lines)
    keys_of = _keys(document)
    for below, end in _cases(document):
        keys = sorted(keys_of.get(below, []))
        if keys and len({line for line, _ in keys}) == len(keys):
            first = keys[0][0] - 1
            lines[first:end] = _sorted(lines[first:end], [(line - first, key) for line, key in keys])
    return lines


def _cases(document: Document) -> Iterator[tuple[DocPath, int]]:
    """Yield the way to each case, and the number of its last line."""
    data = document.data
    if not isinstance(data, dict) or not data:
        return
    last = len(document.lines)
    if not isinstance(data.get(_CASES), list):
        yield (), last
        return
    items = [(_CASES, index) for index, item in enumerate(data[_CASES]) if isinstance(item, dict) and item]
    if not items:
        return
    ends = [document.first_line(path) - 1 for path in items[1:]]
    yield from zip(items, [*ends, last], strict=True)


def _keys(document: Document) -> dict[DocPath, list[tuple[int, str]]]:
    """List the keys of each mapping with their lines."""
    keys: dict[DocPath, list[tuple[int, str]]] = {}
    for path, place in document.keys.items():
        keys.setdefault(path[:-1], []).append((place[0], str(path[-1])))
    return keys


def _sorted(lines: list[str], keys: list[tuple[int, str]]) -> list[str]:
    """Sort the lines of a case by its keys, whose lines are counted from 1; the first key is in the first."""
    head = lines[0]
    is_item = head.lstrip().startswith(f"{_DASH} ")
    dash = head.index(_DASH) if is_item else 0
    own = [f"{head[:dash]} {head[dash + 1 :]}" if is_item else head, *lines[1:]]
    end = len(own)
    while end > keys[-1][0] and _is_aside(own[end - 1]):
        end -= 1
    starts = [0, *(_lead(own, line) for line, _ in keys[1:]), end]
    blocks = [
        _Block(key, own[first:last])
        for (_, key), first, last in zip(keys, starts[:-1], starts[1:], strict=True)
    ]
    ordered = [line for block in sorted(blocks, key=_rank) for line in block.lines]
    if is_item:
        first = next(index for index, line in enumerate(ordered) if not _is_aside(line))
        ordered[first] = f"{ordered[first][:dash]}{_DASH}{ordered[first][dash + 1 :]}"
    return [*ordered, *own[end:]]


def _rank(block: _Block) -> int:
    return ORDER.index(block.key) if block.key in ORDER else len(ORDER)


def _lead(lines: list[str], number: int) -> int:
    """Return the index of the first of the comment lines right above a line."""
    index = number - 1
    while index and lines[index - 1].lstrip().startswith(_COMMENT):
        index -= 1
    return index


def _is_aside(line: str) -> bool:
    return not line.strip() or line.lstrip().startswith(_COMMENT)


def _spaced(text: str, document: Document) -> list[str]:
    """Return the lines of a document with even spacing; texts of several lines are kept as they are."""
    lines = split_lines(text)
    kept = _inside_texts(text, document.file)
    items = [document.first_line(path) for path, _ in _cases(document)]
    heads = {_lead(lines, number) for number in items[1:]}
    spaced: list[str] = []
    for index, line in enumerate(lines):
        after_empty = not spaced or not spaced[-1].strip()
        if index in kept:
            spaced.append(line)
            continue
        if index in heads and not after_empty:
            spaced.append("")
        if line.strip() or not after_empty:
            spaced.append(line.rstrip())
    last = max(kept, default=-1) == len(lines) - 1
    while spaced and not spaced[-1] and not last:
        spaced.pop()
    return spaced


def _inside_texts(text: str, name: str) -> set[int]:
    """Return the indices of the lines that texts of several lines have behind their first one.

    Only PyYAML's own parser tells where they end; it refuses some tabs and marks that libyaml reads.
    """
    inside: set[int] = set()
    events: Iterator[Any] = iter(yaml.parse(text, Loader=yaml.SafeLoader))
    try:
        for event in events:
            if isinstance(event, yaml.ScalarEvent):
                first: Any = event.start_mark
                last: Any = event.end_mark
                inside |= set(range(first.line + 1, last.line + (last.column > 0)))
    except yaml.YAMLError as error:
        raise LayoutError(name) from error
    return inside
