"""YAML files as plain data that remembers where each key and value stands.

The dialect is YAML 1.2's core schema with the traps of YAML closed: `1e-3` is a number, `on`, `off`,
`yes` and `no` are text, a key stands once and is text, aliases cannot explode, and non-finite numbers,
tags, merge keys and further documents are refused. Every refusal has a place, and only what makes the
rest unreadable ends the reading: the other refusals are collected.
"""

from __future__ import annotations

import codecs
import math
import re
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any, Final, NoReturn

import yaml

from conformance.source import DocPath, Fault, Location, Problem, describe, format_path

if TYPE_CHECKING:
    import pathlib

MAX_BYTES: Final = 1 << 24
"""Longest file that is read, 16 MiB: a hundred times the largest of this suite."""
MAX_VALUES: Final = 300_000
"""Most values of a file; the place of each is remembered, which takes about 300 bytes."""
MAX_DEPTH: Final = 256
"""Deepest nesting of lists and mappings; BSP trees of cells are below 100 levels."""
MAX_ALIASED_VALUES: Final = 10_000
"""How many values all aliases of a file together may stand for."""
MAX_DIGITS: Final = 40
"""Longest integer that is read as one; a float32 has at most 39 digits before its point."""
MAX_REWORDED: Final = 1 << 17
"""Longest text, in characters, whose syntax errors are looked up with the slow parser: about a second."""

_NULL: Final = re.compile(r"~|null|Null|NULL|")
_TRUE: Final = re.compile(r"true|True|TRUE")
_FALSE: Final = re.compile(r"false|False|FALSE")
_INT: Final = re.compile(r"[-+]?[0-9]+")
_HEX: Final = re.compile(r"0x[0-9a-fA-F]+")
_FLOAT: Final = re.compile(r"[-+]?(\.[0-9]+|[0-9]+(\.[0-9]*)?)([eE][-+]?[0-9]+)?")
_NON_FINITE: Final = re.compile(r"[-+]?\.(inf|Inf|INF)|\.(nan|NaN|NAN)")
_NOT_TEXT: Final = re.compile("[^\t\n\r\x20-\x7e\x85\xa0-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")
_LINE_END: Final = re.compile("\r\n|[\n\r\x85\u2028\u2029]")
"""What ends a line for PyYAML and libyaml; Python's `splitlines` knows some more."""
_BOM: Final = "\ufeff"
_NO_KEY: Final = "\0"
"""Stands for a key that was refused; no text of a file holds it."""

_FAST_LOADER: Final[Any] = getattr(yaml, "CSafeLoader", yaml.SafeLoader)


class YamlError(Exception):
    """The file is not a document of this dialect; `problem` says where and why."""

    def __init__(self, problem: Problem) -> None:
        super().__init__(str(problem))
        self.problem = problem


@dataclass(frozen=True, slots=True)
class Document:
    """A file's data and the places of its parts.

    Attributes
    ----------
    file : str
        Name, as problems show it.
    lines : list of str
        The text.
    data : Any
        Mappings, lists, text, numbers, truth values, None.
    values, keys : dict
        DocPath of a value to the (line, column) of the value, and of its key; both count from 1.
    refusals : list of (path, Problem)
        What was refused without ending the reading; the value at such a path is not what the file says.
    """

    file: str
    lines: list[str]
    data: Any = None
    values: dict[DocPath, tuple[int, int]] = field(default_factory=dict)
    keys: dict[DocPath, tuple[int, int]] = field(default_factory=dict)
    refusals: list[tuple[DocPath, Problem]] = field(default_factory=list)

    def locate(self, path: DocPath, *, key: bool = False) -> Location:
        """Return the place of a value (or its key), or of the nearest ancestor that stands in the file."""
        if key and path in self.keys:
            return Location(self.file, *self.keys[path])
        for length in range(len(path), -1, -1):
            if path[:length] in self.values:
                return Location(self.file, *self.values[path[:length]])
        return Location(self.file)

    def problem(self, fault: Fault, below: DocPath = ()) -> Problem:
        """Give a mistake its place; `below` is the way to what the fault's path starts from."""
        path = (*below, *fault.path)
        location = self.locate(path, key=fault.key)
        shown = self.line(location.line)
        return Problem(location, format_path(path), fault.found, fault.expected, fault.hint, shown)

    def first_line(self, path: DocPath) -> int:
        """Return the number of the first line of the whole document, or of one item of a list."""
        return self.values[path][0] if path else 1

    def excerpt(self, path: DocPath) -> str:
        """Return the lines of the whole document, or of one item of a list."""
        end = len(self.lines) + 1
        if path and isinstance(path[-1], int):
            end = self.values.get((*path[:-1], path[-1] + 1), (end, 1))[0]
        return "\n".join(self.lines[self.first_line(path) - 1 : end - 1]).rstrip()

    def is_refused(self, path: DocPath) -> bool:
        """Tell whether a value, or something it is part of, was refused."""
        return any(path[: len(refused)] == refused for refused, _ in self.refusals)

    def refused_below(self, path: DocPath) -> list[Problem]:
        """Return what was refused in a value."""
        return [problem for refused, problem in self.refusals if refused[: len(path)] == path]

    def line(self, number: int) -> str:
        """Return a line of the text by its number, without its end."""
        return self.lines[number - 1] if 0 < number <= len(self.lines) else ""


def read_document(path: pathlib.Path, name: str | None = None) -> Document:
    """Read a file.

    Raises
    ------
    YamlError
        It is too long, not UTF-8 or not a document of this dialect.
    """
    with path.open("rb") as stream:
        raw = stream.read(MAX_BYTES + 1)
    return parse(raw, name if name is not None else str(path))


def parse(raw: bytes, name: str) -> Document:
    """Parse the bytes of a file; see `read_document`."""
    if len(raw) > MAX_BYTES:
        raise YamlError(Problem(Location(name), "", f"more than {MAX_BYTES} bytes", "a shorter file"))
    text = _decode(raw, name)
    try:
        return _Composer(text, name, _FAST_LOADER).document()
    except yaml.YAMLError as error:
        raise YamlError(_syntax_problem(text, name, error)) from None


def _decode(raw: bytes, name: str) -> str:
    try:
        text = raw.decode("utf-8").removeprefix(_BOM)
    except UnicodeDecodeError as error:
        before = raw[: error.start].decode("utf-8")
        is_utf16 = raw.startswith((codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE))
        found = "text in UTF-16" if is_utf16 else f"the byte 0x{raw[error.start]:02X}"
        raise YamlError(_problem_at(before, len(before), name, found, "text in UTF-8")) from None
    if bad := _NOT_TEXT.search(text):
        found = f"the control character U+{ord(bad[0]):04X}"
        raise YamlError(_problem_at(text, bad.start(), name, found, "printable text"))
    return text


def _problem_at(text: str, offset: int, name: str, found: str, expected: str) -> Problem:
    before = split_lines(text[:offset])
    line, column = len(before), len(before[-1]) + 1
    return Problem(Location(name, line, column), "", found, expected, source_line=_line(text, line))


def split_lines(text: str) -> list[str]:
    """Split a text where YAML's lines end; what is behind the last end is a line, too, empty or not."""
    return _LINE_END.split(text)


def _line(text: str, number: int) -> str:
    return (split_lines(text)[number - 1 : number] or [""])[0]


def _syntax_problem(text: str, name: str, error: yaml.YAMLError) -> Problem:
    """Word a syntax error as the pure-Python parser does, so that it reads the same on every machine."""
    if _FAST_LOADER is not yaml.SafeLoader and len(text) <= MAX_REWORDED:
        try:
            _Composer(text, name, yaml.SafeLoader).document()
        except yaml.YAMLError as same:
            error = same
    mark = getattr(error, "problem_mark", None) or getattr(error, "context_mark", None)
    line, column = (mark.line + 1, mark.column + 1) if mark else (1, 1)
    said = " ".join(str(part) for part in (getattr(error, "problem", None),) if part) or str(error)
    context = getattr(error, "context", None)
    if context and (start := getattr(error, "context_mark", None)):
        context += f" that starts at {start.line + 1}:{start.column + 1}"
    source = _line(text, line)
    hint = "indent with spaces, not tabs" if "\t" in source[:column] else ""
    found = f"a YAML syntax error: {said}" + (f" {context}" if context else "")
    return Problem(Location(name, line, column), "", found, "YAML 1.2", hint, source)


class _Composer:
    """Builds plain data from parser events, noting the place of everything."""

    def __init__(self, text: str, name: str, loader: Any) -> None:
        self._loader = loader(text)
        self._doc = Document(name, split_lines(text))
        self._anchors: dict[str, tuple[Any, int]] = {}
        self._open_anchors: set[str] = set()
        self._aliased = 0
        self._count = 0

    def document(self) -> Document:
        try:
            self._loader.get_event()  # stream start
            if isinstance(self._loader.get_event(), yaml.StreamEndEvent):
                return self._doc
            data = self._value((), 0)
            self._loader.get_event()  # document end
            event = self._loader.get_event()
            if not isinstance(event, yaml.StreamEndEvent):
                self._refuse(event, (), "a second document", "one document a file", "list them in `cases:`")
            return replace(self._doc, data=data)
        finally:
            self._loader.dispose()

    def _value(self, path: DocPath, depth: int) -> Any:
        event = self._loader.get_event()
        self._doc.values.setdefault(path, _place(event))
        if isinstance(event, yaml.AliasEvent):
            return self._alias(event, path)
        if self._count == MAX_VALUES:
            self._give_up(event, path[:3], f"more than {MAX_VALUES} values", "a shorter document")
        if event.tag is not None and event.tag != "!":
            self._refuse(event, path, f"the tag {event.tag!r}", "a plain value, without a tag")
        if event.anchor in self._open_anchors or event.anchor in self._anchors:
            self._refuse(event, path, f"the anchor &{event.anchor} a second time", "another name")
        before = self._count
        if event.anchor:
            self._open_anchors.add(event.anchor)
        value = self._plain_value(event, path, depth)
        self._count += 1
        if event.anchor:
            self._open_anchors.discard(event.anchor)
            self._anchors[event.anchor] = (value, self._count - before)
        return value

    def _plain_value(self, event: Any, path: DocPath, depth: int) -> Any:
        if isinstance(event, yaml.ScalarEvent):
            return self._scalar(event, path)
        if depth == MAX_DEPTH:
            self._give_up(event, path[:3], f"more than {MAX_DEPTH} nested levels", "a shallower document")
        return self._mapping(path, depth) if _starts_mapping(event) else self._sequence(path, depth)

    def _mapping(self, path: DocPath, depth: int) -> dict[str, Any]:
        mapping: dict[str, Any] = {}
        while not self._at_end(yaml.MappingEndEvent):
            key = self._key(path)
            value = self._value((*path, key), depth + 1)
            mapping.setdefault(key, value)
        mapping.pop(_NO_KEY, None)
        return mapping

    def _sequence(self, path: DocPath, depth: int) -> list[Any]:
        items: list[Any] = []
        while not self._at_end(yaml.SequenceEndEvent):
            items.append(self._value((*path, len(items)), depth + 1))
        return items

    def _at_end(self, kind: type) -> bool:
        if not isinstance(self._loader.peek_event(), kind):
            return False
        self._loader.get_event()
        return True

    def _key(self, path: DocPath) -> str:
        event = self._loader.peek_event()
        if not isinstance(event, yaml.ScalarEvent):
            self._skip()
            return self._refuse_key(event, path, "a list, mapping or alias as a key")
        self._loader.get_event()
        if event.anchor:
            return self._refuse_key(
                event, path, f"the anchor &{event.anchor} of a key", "only values have anchors"
            )
        if not event.style and event.value == "<<":
            return self._refuse_key(event, path, "the merge key '<<'", "write the keys out")
        key = self._scalar(event, path)
        if not isinstance(key, str):
            return self._refuse_key(event, path, f"{describe(key)} as a key", "put it in quotes")
        first = self._doc.keys.setdefault((*path, key), _place(event))
        if first != _place(event):
            found = f"the key {key!r} a second time (first at {first[0]}:{first[1]})"
            self._refuse(event, (*path, key), found, "each key once")
        return key

    def _skip(self) -> None:
        """Pass over a value without looking into it, however deep it is."""
        level = 0
        while True:
            event = self._loader.get_event()
            level += isinstance(event, yaml.CollectionStartEvent)
            level -= isinstance(event, yaml.CollectionEndEvent)
            if level == 0:
                return

    def _refuse_key(self, event: Any, path: DocPath, found: str, hint: str = "") -> str:
        self._refuse(event, path, found, "text as a key", hint)
        return _NO_KEY

    def _scalar(self, event: Any, path: DocPath) -> Any:
        text = event.value
        if event.style or event.tag == "!":
            if event.style == '"' and (bad := _NOT_TEXT.search(text)):
                self._refuse(event, path, f"the control character U+{ord(bad[0]):04X}", "printable text")
                return _NOT_TEXT.sub("?", text)
            return text
        if _NON_FINITE.fullmatch(text):
            self._refuse(event, path, f"the number {text}", "a finite number")
            return 0.0
        if _INT.fullmatch(text):
            return self._int(event, path)
        if _HEX.fullmatch(text):
            return self._hexadecimal(event, path)
        if _FLOAT.fullmatch(text):
            return self._float(event, path)
        if _NULL.fullmatch(text):
            return None
        return True if _TRUE.fullmatch(text) else False if _FALSE.fullmatch(text) else text

    def _int(self, event: Any, path: DocPath) -> int | float:
        # Python refuses to read integers of thousands of digits; the file can hold none that fits.
        return int(event.value) if len(event.value) <= MAX_DIGITS else self._float(event, path)

    def _hexadecimal(self, event: Any, path: DocPath) -> int:
        if len(event.value) > MAX_DIGITS:
            found = f"a number of {len(event.value) - 2} hexadecimal digits"
            self._refuse(event, path, found, f"at most {MAX_DIGITS - 2}")
            return 0
        return int(event.value, 16)

    def _float(self, event: Any, path: DocPath) -> float:
        value = float(event.value)
        if math.isinf(value):
            self._refuse(event, path, f"the number {event.value[:20]}", "a number that fits in a float32")
            return 0.0
        return value

    def _alias(self, event: Any, path: DocPath) -> Any:
        if event.anchor in self._open_anchors:
            return self._refuse(event, path, f"the alias *{event.anchor} inside its own value", "a value")
        if event.anchor not in self._anchors:
            expected = f"an anchor &{event.anchor} before it"
            return self._refuse(event, path, f"the alias *{event.anchor}", expected)
        value, size = self._anchors[event.anchor]
        self._aliased += size
        self._count += size
        if self._aliased > MAX_ALIASED_VALUES:
            found = f"aliases that stand for more than {MAX_ALIASED_VALUES} values"
            self._give_up(event, path, found, "the values written out")
        return value

    def _refuse(self, event: Any, path: DocPath, found: str, expected: str, hint: str = "") -> None:
        self._doc.refusals.append((path, self._problem(event, path, found, expected, hint)))

    def _give_up(self, event: Any, path: DocPath, found: str, expected: str) -> NoReturn:
        raise YamlError(self._problem(event, path, found, expected))

    def _problem(self, event: Any, path: DocPath, found: str, expected: str, hint: str = "") -> Problem:
        line, column = _place(event)
        location = Location(self._doc.file, line, column)
        return Problem(location, format_path(path), found, expected, hint, self._doc.line(line))


def _place(event: Any) -> tuple[int, int]:
    return event.start_mark.line + 1, event.start_mark.column + 1


def _starts_mapping(event: Any) -> bool:
    return isinstance(event, yaml.MappingStartEvent)
