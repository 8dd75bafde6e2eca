"""JSON of cell dumps: read with the place of every mistake."""

from __future__ import annotations

import json
import math
from typing import TYPE_CHECKING, Any, Final

from conformance.json_reading import LooseJsonError, once_each, refuse_halves
from conformance.scenes.errors import SceneError

if TYPE_CHECKING:
    from pathlib import Path

MAX_BYTES: Final = 1 << 24
"""Longest dump that is read, 16 MiB: a cell of retail takes less than 1."""
MAX_DIGITS: Final = 40
"""Longest whole number that is read; a float32 has at most 39 digits before its point."""


class DumpError(SceneError):
    """A dump that cannot be read.

    Attributes
    ----------
    file : str
        Its name.
    line, column : int or None
        Where, for a mistake of the JSON text; counted from 1.
    """

    def __init__(
        self, file: str, error: SceneError, line: int | None = None, column: int | None = None
    ) -> None:
        super().__init__(error.path, error.found, error.expected)
        self.file = file
        self.line = line
        self.column = column

    def __str__(self) -> str:
        place = [self.file, *(str(number) for number in (self.line, self.column) if number is not None)]
        return f"{':'.join(place)}: {super().__str__()}"


def read_json(file: Path) -> Any:
    """Parse a dump; ``-0`` keeps its sign, and no number is infinite or NaN.

    Raises
    ------
    DumpError
        The file is not there, too long, not UTF-8, not JSON (with line and column), nested too deeply, or
        holds a number that is none, a key twice or half a character.
    """
    text = _read_text(file)
    try:
        value = json.loads(
            text,
            parse_int=_whole,
            parse_float=_float,
            parse_constant=_refuse,
            object_pairs_hook=once_each,
        )
        refuse_halves(text, value)
    except json.JSONDecodeError as error:
        wrong = SceneError("", error.msg, "JSON")
        raise DumpError(str(file), wrong, error.lineno, error.colno) from error
    except RecursionError as error:
        wrong = SceneError("", "lists or objects nested too deeply", "a dump")
        raise DumpError(str(file), wrong) from error
    except LooseJsonError as error:
        raise DumpError(str(file), SceneError("", error.found, error.expected)) from error
    except SceneError as error:
        raise DumpError(str(file), error) from error
    return value


def _read_text(file: Path) -> str:
    try:
        with file.open("rb") as stream:
            raw = stream.read(MAX_BYTES + 1)
        if len(raw) > MAX_BYTES:
            raise DumpError(str(file), SceneError("", f"more than {MAX_BYTES} bytes", "a shorter file"))
        return raw.decode("utf-8")
    except OSError as error:
        reason = error.strerror or type(error).__name__
        raise DumpError(str(file), SceneError("", reason, "a readable file")) from error
    except UnicodeDecodeError as error:
        found = f"byte {error.object[error.start]:#04x} at offset {error.start}"
        raise DumpError(str(file), SceneError("", found, "UTF-8 text")) from error


def _whole(text: str) -> int | float:
    if len(text) > MAX_DIGITS:
        raise SceneError("", f"a number of {len(text)} digits", f"at most {MAX_DIGITS}")
    return -0.0 if text == "-0" else int(text)


def _float(text: str) -> float:
    number = float(text)
    return number if math.isfinite(number) else _refuse(text)


def _refuse(text: str) -> float:
    raise SceneError("", text, "finite numbers")
