"""JSON lines, read one at a time; a bad line is located and does not end the file."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any, Final

from conformance.vector_errors import MalformedLineError

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

_STARTS: Final = {dict: "an object", list: "a list", str: "a string", int: "a number", float: "a number"}


def read_lines(path: Path) -> Iterator[tuple[int, dict[str, Any]] | MalformedLineError]:
    """Yield the number and object of every line that is not blank, or the error that it is.

    Raises
    ------
    OSError
        If the file cannot be read at all.
    """
    with path.open("rb") as file:
        for number, raw in enumerate(file, start=1):
            if raw.strip():
                yield _read_line(path, number, raw.rstrip(b"\r\n"))


def _read_line(path: Path, number: int, raw: bytes) -> tuple[int, dict[str, Any]] | MalformedLineError:
    try:
        record = json.loads(raw.decode("utf-8"), parse_constant=_refuse_constant)
    except UnicodeDecodeError as error:
        return _malformed(f"not UTF-8: {error.reason}", path, number, error.start + 1)
    except json.JSONDecodeError as error:
        return _malformed(f"not JSON: {error.msg}", path, number, error.colno)
    except (ValueError, RecursionError) as error:
        return _malformed(f"not JSON: {error}", path, number, 1)
    if not isinstance(record, dict):
        kind = _STARTS.get(type(record), "a constant")
        return _malformed(f"found {kind}, expected an object", path, number, 1)
    return number, record


def _malformed(message: str, path: Path, line: int, column: int) -> MalformedLineError:
    return MalformedLineError(message, file=path, line=line, column=column)


def _refuse_constant(name: str) -> float:
    quoted = {"NaN": "nan", "Infinity": "inf", "-Infinity": "-inf"}[name]
    raise ValueError(f'{name} is not JSON, expected the string "{quoted}"')
