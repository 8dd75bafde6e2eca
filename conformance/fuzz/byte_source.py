"""Bytes as a stream of choices: small numbers mostly, and now and then one that nobody expects."""

from __future__ import annotations

import math
import struct
from typing import Final

HOSTILE: Final = (
    *(0.0, -0.0, 1.0, -1.0, 0.5, 0.00019999999494757503, 1e-5, -1e-5, 1e-30, 1e-45, 1e6, -1e6, 1e9),
    *(3.4028234663852886e38, 3.5e38, 1e308, math.inf, -math.inf, math.nan, 0.7071067690849304, 192.0, 24.0),
)
"""Zeros, retail's epsilon, denormals, what no float32 holds, what is no number, and edges of land."""
_GRID: Final = 0.25
"""Metres between the ordinary numbers."""
_ORDINARY: Final = 0xC0
"""Bytes below stand for a number of the grid, one of them for four bytes of a float32."""


class ByteSource:
    """Reads choices from bytes; behind their end every byte is 0."""

    def __init__(self, data: bytes) -> None:
        self._data = data
        self._at = 0

    def byte(self) -> int:
        """Return the next byte."""
        value = self._data[self._at] if self._at < len(self._data) else 0
        self._at += 1
        return value

    def below(self, limit: int) -> int:
        """Return a number from 0 to `limit` - 1."""
        return self.byte() % limit

    def flag(self) -> bool:
        """Return true for one byte of eight."""
        return self.byte() % 8 == 1

    def whole(self) -> int:
        """Return four bytes as an unsigned number."""
        return int.from_bytes(bytes(self.byte() for _ in range(4)), "little")

    def number(self) -> float:
        """Return a number: of a grid about 0, one of `HOSTILE`, or any float32."""
        byte = self.byte()
        if byte < _ORDINARY:
            return _GRID * (byte - _ORDINARY // 2)
        if byte - _ORDINARY < len(HOSTILE):
            return HOSTILE[byte - _ORDINARY]
        return float(struct.unpack("<f", bytes(self.byte() for _ in range(4)))[0])

    def numbers(self, count: int) -> tuple[float, ...]:
        """Return some numbers; one time in sixteen one more or one less than asked for."""
        short = self.byte()
        count += {1: 1, 2: -1}.get(short % 32, 0)
        return tuple(self.number() for _ in range(count))
