"""Changes of text that keep it text: of numbers, words and lines.

Of bytes changed at random hardly one file in a thousand is still a file of cases: readers would be asked
about syntax alone, and what is accepted would never be looked at.
"""

from __future__ import annotations

import random
import re
from typing import TYPE_CHECKING, Final

if TYPE_CHECKING:
    from collections.abc import Callable

    Change = Callable[[str, random.Random], str]

NUMBERS: Final = (
    *("0", "-0.0", "1", "-1", "2", "255", "1e-45", "1e-5", "0.0002", "0.7071068", "3.4028235e38", "1e39"),
    *("1e308", "1e999", "2147483648", "4294967295", "4294967296", "1e400", "0xA9B40151", "0x100000000"),
)
"""Zeros, denormals, retail's epsilon, ends of float32, of float64 and of 32 bits."""
WORDS: Final = (
    *(
        "null",
        "~",
        "true",
        "false",
        "on",
        "nan",
        ".nan",
        "-.inf",
        "[]",
        "{}",
        "''",
        '"\\u0000"',
        "*a",
        "&a 1",
    ),
    *(
        "!!python/name:os.system",
        "<<",
        "both",
        "front",
        "cell",
        "contact",
        "NaN",
        "Infinity",
        "[1]",
        "{a: 1}",
    ),
)
"""What may stand in place of a word or a number: other kinds of values, and what is no value."""
BYTES_INSTEAD: Final = 0.3
"""Share of inputs that are changed byte by byte after all."""
MOST_CHANGES: Final = 2
"""Of an input at a time; libFuzzer changes some of them again and again."""
_NUMBER: Final = re.compile(r"[-+]?\.?[0-9][-+.0-9a-zA-Z]*")
_WORD: Final = re.compile(r"[A-Za-z_][A-Za-z_-]*")


def mutate(data: bytes, limit: int, seed: int, change_bytes: Callable[[bytes, int], bytes]) -> bytes:
    """Return an input that differs in a few numbers, words or lines, or in bytes.

    Parameters
    ----------
    data : bytes
        The input.
    limit : int
        Most bytes of the new one.
    seed : int
        Of the choices.
    change_bytes : callable
        The fuzzer's own way: takes data and limit.
    """
    choices = random.Random(seed)  # noqa: S311 - repeatable, not secret
    try:
        text = data.decode("utf-8")
    except UnicodeDecodeError:
        return change_bytes(data, limit)
    if not text or choices.random() < BYTES_INSTEAD:
        return change_bytes(data, limit)
    for _ in range(choices.randint(1, MOST_CHANGES)):
        text = choices.choice(CHANGES)(text, choices)
    return text.encode("utf-8")[:limit]


def _other_number(text: str, choices: random.Random) -> str:
    return _replaced(text, _NUMBER, choices, choices.choice(NUMBERS))


def _near_number(text: str, choices: random.Random) -> str:
    """Exchange one digit: most numbers that are near are as good."""
    found = list(re.finditer("[0-9]", text))
    if not found:
        return text
    place = choices.choice(found).start()
    return text[:place] + choices.choice("0123456789") + text[place + 1 :]


def _other_word(text: str, choices: random.Random) -> str:
    """Put another word of the same text in place of one, or of a number one that nobody expects."""
    known = _WORD.findall(text)
    if known and choices.random() < 0.5:
        return _replaced(text, _WORD, choices, choices.choice(known))
    return _replaced(text, choices.choice((_WORD, _NUMBER)), choices, choices.choice(WORDS))


def _line(text: str, choices: random.Random) -> str:
    """Leave out, repeat, move or indent a line."""
    lines = text.split("\n")
    at, to = choices.randrange(len(lines)), choices.randrange(len(lines))
    match choices.randrange(4):
        case 0:
            del lines[at]
        case 1:
            lines.insert(to, lines[at])
        case 2:
            lines.insert(to, lines.pop(at))
        case _:
            lines[at] = "  " + lines[at] if choices.random() < 0.5 else lines[at].removeprefix("  ")
    return "\n".join(lines)


def _replaced(text: str, token: re.Pattern[str], choices: random.Random, new: str) -> str:
    found = list(token.finditer(text))
    if not found:
        return text
    place = choices.choice(found)
    return text[: place.start()] + new + text[place.end() :]


CHANGES: Final[tuple[Change, ...]] = (_other_number, _near_number, _near_number, _other_word, _line)
"""One of these at a time; what keeps a file whole more often than what does not."""
