"""Writing out the aliases of a piece of YAML whose anchors are elsewhere in its file."""

from __future__ import annotations

import re
import textwrap
from typing import TYPE_CHECKING, Any, Final

import yaml

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

_ANCHOR: Final = re.compile(r"&\S+[ \t]*")
_COMMENT_LINE: Final = re.compile(r"\s*(?:#.*)?")
_KEY_COLUMN: Final = re.compile(r"[ \-]*")
_ONE_LINE: Final = 1 << 20
"""Characters; wide enough that nothing is wrapped."""
_STEP: Final = 2
"""Columns by which a block is indented below its key."""


def anchored(text: str) -> dict[str, str]:
    """Return the source of what each anchor of a text names: a value in one piece, or a block's lines.

    Of an anchor that is set again the last value counts. Blocks begin in the first column.

    Raises
    ------
    yaml.YAMLError
        The text is no YAML.
    """
    values: dict[str, str] = {}
    open_nodes: list[tuple[str | None, int, bool]] = []
    for event in _events(text):
        start, end = event.start_mark.index, event.end_mark.index
        anchor = getattr(event, "anchor", None)
        if isinstance(event, yaml.CollectionStartEvent):
            open_nodes.append((anchor, start, bool(event.flow_style)))
        elif isinstance(event, yaml.CollectionEndEvent):
            name, first, is_flow = open_nodes.pop()
            if name:
                values[name] = _value(text[first:end], is_flow=is_flow)
        elif isinstance(event, yaml.ScalarEvent) and anchor:
            values[anchor] = _value(text[start:end], is_flow=True)
    return values


def write_out(text: str, values: Mapping[str, str]) -> str:
    """Put values in the place of the aliases of a text that it has no anchors for.

    An alias that is not among the values stays as it is. Where only a value in one piece fits, a block
    becomes one, without its comments.

    Parameters
    ----------
    text : str
        A document.
    values : mapping of str to str
        By anchor, as `anchored` gives them.
    """
    for event in reversed(_foreign(text)):
        value = values.get(event.anchor)
        start, end = event.start_mark.index, event.end_mark.index
        if value is None:
            continue
        line_start = text.rfind("\n", 0, start) + 1
        if not value.startswith("\n"):
            text = f"{text[:start]}{value}{text[end:]}"
        elif _COMMENT_LINE.fullmatch(text[end:].partition("\n")[0]):
            key = _KEY_COLUMN.match(text, line_start)
            column = (key.end() - line_start if key else 0) + _STEP
            block = textwrap.indent(value, " " * column)
            text = f"{text[:start].rstrip(' ')}{block}{text[end:]}"
        else:
            text = f"{text[:start]}{_in_one_piece(value)}{text[end:]}"
    return text


def _events(text: str) -> Iterator[Any]:
    return iter(yaml.parse(text, Loader=yaml.SafeLoader))


def _value(source: str, *, is_flow: bool) -> str:
    """Return the source of a value without its anchor; a block begins with a line feed."""
    source = _ANCHOR.sub("", source, count=1)
    if is_flow:
        return source
    lines = source.split("\n")
    while lines and _COMMENT_LINE.fullmatch(lines[-1]):
        lines.pop()
    return "\n" + textwrap.dedent("\n".join(lines[1:]))


def _in_one_piece(block: str) -> str:
    """Write a block with brackets and braces; its words and numbers stay as they are spelt."""
    root = yaml.compose(block, Loader=yaml.SafeLoader)
    nodes = [root]
    while nodes:
        node = nodes.pop()
        if isinstance(node, yaml.CollectionNode):
            node.flow_style = True
            nodes += [part for item in node.value for part in (item if isinstance(item, tuple) else (item,))]
    return yaml.serialize(root, Dumper=yaml.SafeDumper, width=_ONE_LINE).strip()


def _foreign(text: str) -> list[Any]:
    """List the aliases of a text that come before, or without, an anchor of their name."""
    own: set[str] = set()
    found: list[Any] = []
    for event in _events(text):
        if isinstance(event, yaml.AliasEvent):
            if event.anchor not in own:
                found.append(event)
        elif anchor := getattr(event, "anchor", None):
            own.add(anchor)
    return found
