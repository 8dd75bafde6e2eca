"""Queries by their numbers: any of them, in any order and in any process, always the same.

Hypothesis's own loop decides what it draws next by what it has drawn before. Here each query is read from
random bytes of its own, by the same strategies.
"""

from __future__ import annotations

import random
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Final, cast

from hypothesis import HealthCheck, given, settings

from conformance.soak.families import STRATEGIES

if TYPE_CHECKING:
    from hypothesis.strategies import SearchStrategy

    from conformance.query import Query
    from conformance.soak.families import Mix

BYTES: Final = 1 << 12
"""Random bytes that a query is read from: ten times as many as the longest walk takes."""
_MOST_TRIES: Final = 100
"""Some bytes make no query, because a strategy refuses what it has drawn; this many in a row never happen."""


class NothingDrawnError(RuntimeError):
    """A family refuses whatever is drawn."""


@dataclass(frozen=True, slots=True)
class Drawn:
    """A query of a campaign.

    Attributes
    ----------
    query : Query
    family : str
        Whose strategy has read it.
    raw : bytes
        What it was read from.
    """

    query: Query
    family: str
    raw: bytes


class Drawer:
    """Draws the queries of a campaign.

    Parameters
    ----------
    seed : int
        Any whole number.
    mix : Mix
        What is drawn from.
    """

    def __init__(self, seed: int, mix: Mix) -> None:
        self._seed = seed
        self._mix = mix
        self._readers = {name: _Reader(STRATEGIES[name]) for name in mix.names}

    def draw(self, shard: int, number: int) -> Drawn:
        """Return one query of a shard, both counted from 0.

        Raises
        ------
        NothingDrawnError
        """
        # A text as the seed is hashed by SHA-512: neighbours have nothing in common, on every platform.
        numbers = random.Random(f"soak {self._seed} {shard} {number}")  # noqa: S311 - no secret
        family = numbers.choices(self._mix.names, self._mix.weights)[0]
        for _ in range(_MOST_TRIES):
            raw = numbers.randbytes(BYTES)
            query = self._readers[family].read(raw)
            if query is not None:
                return Drawn(query, family, raw)
        raise NothingDrawnError(f"{family}: {_MOST_TRIES} times in a row nothing could be drawn")


class _Reader:
    """Reads a query of a strategy from bytes."""

    def __init__(self, queries: SearchStrategy[Query]) -> None:
        self._read: Query | None = None

        @settings(database=None, deadline=None, suppress_health_check=list(HealthCheck))
        @given(queries)
        def take(query: Query) -> None:
            self._read = query

        self._feed = cast("Any", take).hypothesis.fuzz_one_input

    def read(self, raw: bytes) -> Query | None:
        """Return the query, None if the bytes make none."""
        self._read = None
        self._feed(raw)
        return self._read
