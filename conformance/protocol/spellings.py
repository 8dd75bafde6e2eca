"""How single floats are spelt, and remembered: most numbers of a run are sent again and again."""

from __future__ import annotations

import functools
import math
import struct
from typing import TYPE_CHECKING, Final

import numpy as np

from conformance.floats import bits32, bits64

if TYPE_CHECKING:
    from collections.abc import Mapping

    from conformance.protocol.dialects import Dialect

_KEPT: Final = 1 << 16
"""Spellings that are remembered."""


def spell_single(value: float, dialect: Dialect) -> float | str:
    """Return what JSON is given for a float32."""
    if dialect == "hex":
        return f"0x{bits32(value):08x}"
    return shortest(value) if math.isfinite(value) else str(value)


def spell_double(value: float, dialect: Dialect) -> float | str:
    """Return what JSON is given for a float64, a clock time."""
    if dialect == "hex":
        return f"0x{bits64(value):016x}"
    return value if math.isfinite(value) else str(value)


def text_of(spelling: float | str) -> str:
    """Return the JSON text of a spelling."""
    return f'"{spelling}"' if isinstance(spelling, str) else repr(spelling)


class _Texts(dict[float, str]):
    """JSON texts of float32 values, worked out where they are first asked for.

    A mapping, so that a vector is written without a Python call for each number that is known.
    """

    def __init__(self, dialect: Dialect) -> None:
        super().__init__()
        self._dialect = dialect

    def __missing__(self, value: float) -> str:
        text = text_of(spell_single(value, self._dialect))
        if not math.isfinite(value):
            return text  # a NaN is no key: it would be kept again and again
        if len(self) >= _KEPT:
            self.clear()
        self[value] = text
        return text


SINGLES: Final[Mapping[Dialect, Mapping[float, str]]] = {"decimal": _Texts("decimal"), "hex": _Texts("hex")}
"""The JSON text of every float32 but zeros, in each dialect: ``SINGLES["decimal"][1.0] == "1.0"``."""
ZEROS: Final[Mapping[Dialect, Mapping[str, str]]] = {
    "decimal": {"0.0": "0.0", "-0.0": "-0.0"},
    "hex": {"0.0": '"0x00000000"', "-0.0": '"0x80000000"'},
}
"""The JSON text of either zero by its ``repr``; as keys the two would be one."""


def shortest(value: float) -> float:
    """Return the float64 that prints as the shortest decimal of a float32.

    The same as `conformance.floats.shortest32`, which needs no NumPy and takes ten times as long.
    """
    return value if value == 0.0 or not math.isfinite(value) else _shortest(value)


@functools.lru_cache(_KEPT)
def _shortest(value: float) -> float:
    return float(str(np.float32(value)))


def of_bits(text: str) -> float:
    """Read ``0x`` and the 8 digits of a float32, or the 16 of a float64, most significant first."""
    digits = text[2:]
    value: float = struct.unpack(">f" if len(digits) == 8 else ">d", bytes.fromhex(digits))[0]
    return value
