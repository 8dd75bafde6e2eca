"""Input of the wrong kind, refused where it comes in: with its place, before anything is computed from it.

A check is made once, of the fields of a class, and then applied to whatever is given as one. Numbers that
become part of an array are looked at there (`engine.float32`); what is not used at all is not.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping, Sized
from typing import TYPE_CHECKING, Any, Final, TypeAlias

import numpy as np

if TYPE_CHECKING:
    from engine.errors import InputError

    Check: TypeAlias = Callable[[Any, str, type[InputError]], None]
    """Raises the error, with the place, if a value is not what it should be."""

LARGEST_ID: Final = 0xFFFF_FFFF
"""Ids and bit fields of retail have 32 bits."""
LARGEST_INDEX: Final = 0x7FFF_FFFF
"""Indices of retail are signed."""
_SHOWN: Final = (int, float, str, np.number)
"""What a message shows; everything else may be as long or as deep as it likes."""


def told(value: object) -> str:
    """Return a value as messages show it: in full if it is short, else by its type."""
    text = repr(value) if isinstance(value, _SHOWN) or value is None else ""
    return text if 0 < len(text) <= 40 else f"a value of type {type(value).__name__}"


def whole(least: int = 0, most: int = LARGEST_ID) -> Check:
    """Return a check of a whole number within limits, which belong to it."""

    def check(value: Any, where: str, error: type[InputError]) -> None:
        if not isinstance(value, int | np.integer):
            raise error(where, f"{told(value)} where a whole number is needed")
        if not least <= value <= most:
            limits = "a 32-bit number" if (least, most) == (0, LARGEST_ID) else f"between {least} and {most}"
            raise error(where, f"{told(value)} is not {limits}")

    return check


def flag(value: Any, where: str, error: type[InputError]) -> None:
    """Check a truth value; 0 and 1 are two."""
    if not isinstance(value, bool | np.bool_ | int | np.integer) or value not in (0, 1):
        raise error(where, f"{told(value)} where true or false is needed")


def number(value: Any, where: str, error: type[InputError]) -> None:
    """Check a number, finite or not."""
    if not isinstance(value, int | float | np.number):
        raise error(where, f"{told(value)} where a number is needed")


def finite(value: Any, where: str, error: type[InputError]) -> None:
    """Check a finite number, which need not fit into a float32."""
    number(value, where, error)
    if not math.isfinite(value):
        raise error(where, f"{told(value)} where a finite number is needed")


def sequence(value: Any, where: str, error: type[InputError]) -> None:
    """Check that something has items, in an order; text and mappings are taken for a mistake."""
    if isinstance(value, str | bytes | Mapping) or not (
        isinstance(value, Sized) and isinstance(value, Iterable)
    ):
        raise error(where, f"{told(value)} where a sequence is needed")


def several(item: Check) -> Check:
    """Return a check of a sequence, each item of which passes another."""

    def check(value: Any, where: str, error: type[InputError]) -> None:
        sequence(value, where, error)
        for index, one in enumerate(value):
            item(one, f"{where}[{index}]", error)

    return check


def optional(known: Check) -> Check:
    """Return a check that also passes None."""

    def check(value: Any, where: str, error: type[InputError]) -> None:
        if value is not None:
            known(value, where, error)

    return check


def record(kind: type | tuple[type, ...], /, **fields: Check) -> Check:
    """Return a check of an object of a class, and of some of its fields."""
    kinds = kind if isinstance(kind, tuple) else (kind,)
    names = " or ".join(one.__name__ for one in kinds)

    def check(value: Any, where: str, error: type[InputError]) -> None:
        if not isinstance(value, kinds):
            raise error(where, f"{told(value)} where a {names} is needed")
        for name, known in fields.items():
            known(getattr(value, name), f"{where}, {name.replace('_', ' ')}", error)

    return check


def keyed(item: Check) -> Check:
    """Return a check of a mapping from cell ids, each value of which passes another."""

    def check(value: Any, where: str, error: type[InputError]) -> None:
        if not isinstance(value, Mapping):
            raise error(where, f"{told(value)} where a mapping from cell ids is needed")
        for key, one in value.items():
            whole()(key, where, error)
            item(one, f"{where}, {key:#010x}", error)

    return check
