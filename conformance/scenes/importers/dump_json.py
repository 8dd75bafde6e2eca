"""JSON of cell dumps: read with the place of every mistake."""

from __future__ import annotations

import json
import math
from typing import TYPE_CHECKING, Any

from conformance.scenes.errors import SceneError

if TYPE_CHECKING:
    from pathlib import Path


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
        The file is not there, not UTF-8, not JSON (with line and column), or holds a number that is none.
    """
    try:
        text = file.read_text(encoding="utf-8")
    except OSError as error:
        reason = error.strerror or type(error).__name__
        raise DumpError(str(file), SceneError("", reason, "a readable file")) from error
    except UnicodeDecodeError as error:
        found = f"byte {error.object[error.start]:#04x} at offset {error.start}"
        raise DumpError(str(file), SceneError("", found, "UTF-8 text")) from error
    try:
        return json.loads(text, parse_int=_whole, parse_float=_float, parse_constant=_refuse)
    except json.JSONDecodeError as error:
        wrong = SceneError("", error.msg, "JSON")
        raise DumpError(str(file), wrong, error.lineno, error.colno) from error
    except SceneError as error:
        raise DumpError(str(file), error) from error


def _whole(text: str) -> int | float:
    return -0.0 if text == "-0" else int(text)


def _float(text: str) -> float:
    number = float(text)
    return number if math.isfinite(number) else _refuse(text)


def _refuse(text: str) -> float:
    raise SceneError("", text, "finite numbers")
