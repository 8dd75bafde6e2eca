"""Where something stands in a text file, and how a mistake there is told to a person."""

from __future__ import annotations

import difflib
import re
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any, Final, TypeAlias

if TYPE_CHECKING:
    from collections.abc import Iterable

SHOWN_WIDTH: Final = 100
"""Of a longer source line, this many characters about the column are shown."""

_PATH_PART: Final = re.compile(r"\[(\d+)\]|\.?([^.\[\]]+)")

DocPath: TypeAlias = tuple[str | int, ...]
"""The way to a value inside a document: keys and list indices."""


@dataclass(frozen=True, slots=True, order=True)
class Location:
    """A place in a file; line and column count from 1."""

    file: str
    line: int = 1
    column: int = 1

    def __str__(self) -> str:
        return f"{self.file}:{self.line}:{self.column}"


@dataclass(frozen=True, slots=True)
class Problem:
    """One mistake of a file.

    Attributes
    ----------
    location : Location
        Where it is.
    path : str
        The same, inside the document: ``scene.cells[0].pose.origin``.
    found, expected : str
        What is there and what should be.
    hint : str
        How to mend it, such as the nearest allowed key; may be empty.
    source_line : str
        The line of the file, shown with a caret under the column.
    case_id : str
        The id of the case it belongs to, if it is known.
    """

    location: Location
    path: str
    found: str
    expected: str
    hint: str = ""
    source_line: str = ""
    case_id: str = ""

    @property
    def summary(self) -> str:
        """The problem in one line."""
        where = f" {self.path}:" if self.path else ""
        hint = f" ({self.hint})" if self.hint else ""
        return f"{self.location}:{where} found {self.found}, expected {self.expected}{hint}"

    def __str__(self) -> str:
        lines = [f"{self.location}: {self.path}".rstrip(": ")]
        lines += [f"  found     {self.found}", f"  expected  {self.expected}"]
        if self.hint:
            lines.append(f"  hint      {self.hint}")
        if self.source_line:
            shown, before = self._window()
            # Tabs are kept, so that the caret stays under its column whatever a tab's width is.
            caret = "".join("\t" if c == "\t" else " " for c in before) + "^"
            lines += [f"{self.location.line:>6} | {shown}", f"{'':>6} | {caret}"]
        return "\n".join(lines)

    def _window(self) -> tuple[str, str]:
        """Return the part of the source line to show, and what of it stands before the column."""
        column = self.location.column - 1
        start = max(0, column - SHOWN_WIDTH // 2) if len(self.source_line) > SHOWN_WIDTH else 0
        shown = self.source_line[start : start + SHOWN_WIDTH]
        return shown, self.source_line[start:column]

    def of_case(self, case_id: str) -> Problem:
        """Return the same problem, attributed to a case."""
        return replace(self, case_id=case_id)


def format_path(path: DocPath) -> str:
    """Write a path as ``scene.cells[0].pose``."""
    text = ""
    for part in path:
        text += f"[{part}]" if isinstance(part, int) else f".{part}" if text else str(part)
    return text


def describe(value: Any) -> str:
    """Say what a value of a document is, in the words of its author."""
    match value:
        case None:
            return "nothing (null)"
        case bool():
            return f"the truth value {str(value).lower()}"
        case int() | float():
            return f"the number {value!r}"
        case str():
            return f"the text {_shortened(value)!r}"
        case list():
            return f"a list of {len(value)}"
        case dict():
            return f"a mapping with the keys {quoted(value) or '(none)'}"
        case _:
            return f"a {type(value).__name__}"


def nearest(name: str, allowed: Iterable[str]) -> str:
    """Return a hint that names the closest allowed name, or nothing."""
    matches = difflib.get_close_matches(name, list(allowed), n=1, cutoff=0.5)
    return f"did you mean {matches[0]!r}?" if matches else ""


def quoted(names: Iterable[str]) -> str:
    """Join names for a sentence."""
    return ", ".join(repr(str(name)) for name in names)


def _shortened(text: str, limit: int = 60) -> str:
    return text if len(text) <= limit else text[: limit - 1] + "…"


@dataclass(frozen=True, slots=True)
class Fault:
    """A mistake at a path, before it is known where in the file the path is.

    `key` says that the mistake is the last key itself, not the value under it.
    """

    path: DocPath
    found: str
    expected: str
    hint: str = ""
    key: bool = False


def parse_path(text: str) -> DocPath:
    """Read a path written as ``cells[0].polygons[3]``."""
    return tuple(int(index) if index else key for index, key in _PATH_PART.findall(text))
