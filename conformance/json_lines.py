"""JSON lines, read one at a time; a bad line is located and does not end the file."""

from __future__ import annotations

import codecs
import json
import math
import re
from typing import TYPE_CHECKING, Any, Final

from conformance.json_reading import LooseJsonError, read_json
from conformance.vector_errors import MalformedLineError

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path
    from typing import BinaryIO

MAX_LINE_BYTES: Final = 1 << 24
"""Longest line that is read, 16 MiB: ten times the largest of a real dungeon's."""

_STARTS: Final = {dict: "an object", list: "a list", str: "a string", int: "a number", float: "a number"}
_UTF16_MARKS: Final = (codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)
_PERHAPS_TOO_LARGE: Final = re.compile(r"[eE]\+?[0-9]{3}|[0-9]{300}")
"""What a number beyond float64 looks like."""


def lines_of(stream: BinaryIO, name: Path) -> Iterator[tuple[int, dict[str, Any]] | MalformedLineError]:
    """Yield the number and object of every line that is not blank, or the error that it is.

    Parameters
    ----------
    stream : binary file
        Read line by line, so that a file may be of any size.
    name : Path
        What errors call the file.
    """
    number = 0
    while raw := stream.readline(MAX_LINE_BYTES + 1):
        number += 1
        if len(raw) > MAX_LINE_BYTES:
            yield _malformed(f"a line longer than {MAX_LINE_BYTES} bytes", name, number, 1)
            _skip_line(stream, raw)
        elif raw.strip():
            yield _read_line(name, number, raw.rstrip(b"\r\n"))


def _skip_line(stream: BinaryIO, raw: bytes) -> None:
    """Read on to the end of a line without keeping it."""
    while raw and not raw.endswith(b"\n"):
        raw = stream.readline(MAX_LINE_BYTES)


def _read_line(name: Path, number: int, raw: bytes) -> tuple[int, dict[str, Any]] | MalformedLineError:
    try:
        text = raw.decode("utf-8-sig" if number == 1 else "utf-8")
        record = read_json(text, _finite if _PERHAPS_TOO_LARGE.search(text) else float)
    except UnicodeDecodeError as error:
        reason = "UTF-16" if raw.startswith(_UTF16_MARKS) else error.reason
        return _malformed(f"not UTF-8: {reason}", name, number, error.start + 1)
    except json.JSONDecodeError as error:
        return _malformed(f"not JSON: {error.msg}", name, number, error.colno)
    except LooseJsonError as error:
        return _malformed(str(error), name, number, 1)
    except RecursionError:
        return _malformed("not JSON that can be read: nested too deeply", name, number, 1)
    except ValueError as error:
        return _malformed(f"not JSON: {error}", name, number, 1)
    if not isinstance(record, dict):
        kind = _STARTS.get(type(record), "a constant")
        return _malformed(f"found {kind}, expected an object", name, number, 1)
    return number, record


def _malformed(message: str, file: Path, line: int, column: int) -> MalformedLineError:
    return MalformedLineError(message, file=file, line=line, column=column)


def _finite(text: str) -> float:
    number = float(text)
    if math.isinf(number):
        raise ValueError(f"{text[:20]} is beyond any float")
    return number
