"""What JSON leaves open, decided once for all that people and engines write."""

from __future__ import annotations

import functools
import json
import re
from typing import TYPE_CHECKING, Any, Final

if TYPE_CHECKING:
    from collections.abc import Callable

_SPELLINGS: Final = {"NaN": "nan", "Infinity": "inf", "-Infinity": "-inf"}
_MINUS_ZERO: Final = re.compile(r"-0(?![.0-9eE])")
_SURROGATE: Final = re.compile(r"\\u[dD][89a-fA-F]")
"""How half of a character may be spelled that takes two code units; most of these are whole pairs."""


class LooseJsonError(ValueError):
    """JSON that Python would read, and another reader otherwise or not at all.

    Attributes
    ----------
    found, expected : str
        What the text has, and what it should have.
    """

    def __init__(self, found: str, expected: str) -> None:
        self.found = found
        self.expected = expected
        super().__init__(f"found {found}, expected {expected}")


def read_json(text: str, read_float: Callable[[str], float] = float) -> Any:
    """Parse JSON; a ``-0``, as .NET and Go write the float -0.0, keeps its sign.

    Parameters
    ----------
    text : str
    read_float : callable, optional
        What makes numbers of those that have a point or an exponent.

    Raises
    ------
    json.JSONDecodeError
        It is not JSON.
    LooseJsonError
        An object has a key twice, there is a bare NaN or infinity, or a text has half of a surrogate pair,
        which no file and no terminal takes.
    ValueError
        A whole number has more digits than Python reads.
    RecursionError
        It is nested too deeply.
    """
    read_whole = _keep_sign if _MINUS_ZERO.search(text) else int  # `int` itself is read without a call
    value = _decoder(read_float, read_whole).decode(text)
    refuse_halves(text, value)
    return value


def once_each(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    """Make an object of its members, for ``object_pairs_hook``; raises `LooseJsonError` for a key twice."""
    record = dict(pairs)
    if len(record) != len(pairs):
        keys = [key for key, _ in pairs]
        twice = next(key for key in keys if keys.count(key) > 1)
        raise LooseJsonError(f"the key {twice!a} twice in an object", "each key once")
    return record


@functools.cache
def _decoder(read_float: Callable[[str], float], read_whole: Callable[[str], float]) -> json.JSONDecoder:
    return json.JSONDecoder(
        parse_float=read_float,
        parse_int=read_whole,
        parse_constant=_refuse_constant,
        object_pairs_hook=once_each,
    )


def refuse_halves(text: str, value: Any) -> None:
    """Raise `LooseJsonError` if what was made of a text has half of a surrogate pair."""
    if not _SURROGATE.search(text):
        return
    try:
        json.dumps(value, ensure_ascii=False, default=str).encode()
    except UnicodeEncodeError as error:
        half = ord(error.object[error.start])
        raise LooseJsonError(f"half a character, U+{half:04X}", "text") from None


def _refuse_constant(name: str) -> float:
    raise LooseJsonError(f"{name}, which is not JSON", f'the string "{_SPELLINGS[name]}"')


def _keep_sign(digits: str) -> float:
    return -0.0 if digits == "-0" else int(digits)
