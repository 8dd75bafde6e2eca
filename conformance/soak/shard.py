"""A shard: a fixed number of queries that are asked in one go, by a candidate that is made for it.

What comes of it depends on the campaign and on the shard's number alone, not on who asked what before.
"""

from __future__ import annotations

import hashlib
import time
from collections import Counter
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Final

from conformance.candidates.base import ask_ahead, close
from conformance.gate.config import PATIENCE
from conformance.soak.asking import Ending, judge
from conformance.soak.records import Failures, ShardResult

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from conformance.candidates.base import Candidate
    from conformance.soak.asking import Verdict
    from conformance.soak.drawing import Drawer, Drawn
    from conformance.soak.kinds import FailureKind

_WINDOW: Final = 64
"""Queries that are drawn before they are asked, so that an engine in a process of its own is never idle."""
_DIGITS: Final = 16


class StoppedError(Exception):
    """The campaign has ended while a shard was being asked: nobody waits for it."""


class SilentCandidateError(Exception):
    """A candidate lets the campaign wait without an answer."""


@dataclass(slots=True)
class _Count:
    """What is known of a shard so far."""

    endings: Counter[Ending] = field(default_factory=Counter)
    skipped: Counter[str] = field(default_factory=Counter)
    asked: Counter[str] = field(default_factory=Counter)
    kinds: Counter[FailureKind] = field(default_factory=Counter)
    first: dict[FailureKind, tuple[int, str]] = field(default_factory=dict)
    answers: hashlib._Hash = field(default_factory=hashlib.sha256)

    def take(self, number: int, drawn: Drawn, verdict: Verdict) -> None:
        self.endings[verdict.ending] += 1
        self.asked[drawn.family] += 1
        self.answers.update(repr(verdict.truth).encode("utf-8", "replace"))
        if verdict.ending is Ending.SKIPPED:
            self.skipped[verdict.said] += 1
        elif verdict.kind is not None:
            self.kinds[verdict.kind] += 1
            self.first.setdefault(verdict.kind, (number, verdict.said))

    def failures(self) -> list[Failures]:
        return [
            Failures(**kind._asdict(), count=count, query=self.first[kind][0], said=self.first[kind][1])
            for kind, count in self.kinds.items()
        ]


def ask_shard(
    shard: int,
    size: int,
    drawer: Drawer,
    oracle: Candidate,
    candidate: Candidate,
    stopped: Callable[[], bool],
) -> ShardResult:
    """Ask all queries of a shard.

    Parameters
    ----------
    shard, size : int
        Its number, and how many queries it has.
    drawer : Drawer
        What draws them.
    oracle, candidate : Candidate
        Who answers for retail, and who is tested; the latter was asked nothing before, and is closed.
    stopped : callable
        Whether nobody waits for the result any more.

    Raises
    ------
    StoppedError
        Nobody does.
    SilentCandidateError
        The candidate let too much time pass in a row without an answer.
    """
    began = time.perf_counter()
    count = _Count()
    try:
        waited = 0.0
        for number, drawn in _windows(shard, size, drawer, candidate):
            if stopped():
                raise StoppedError(f"shard {shard} was not asked to its end")
            asked = time.perf_counter()
            verdict = judge(drawn.query, oracle, candidate)
            count.take(number, drawn, verdict)
            waited = waited + time.perf_counter() - asked if verdict.ending is Ending.ERRORED else 0.0
            if waited > PATIENCE:
                raise SilentCandidateError(f"shard {shard}: no answer for {waited:.0f} s; {verdict.said}")
    finally:
        complaints = close(candidate)
    return ShardResult(
        shard=shard,
        agreed=count.endings[Ending.AGREED],
        differed=count.endings[Ending.DIFFERED],
        errored=count.endings[Ending.ERRORED],
        skipped=dict(count.skipped),
        asked=dict(count.asked),
        failures=count.failures(),
        complaints=list(complaints),
        answers=count.answers.hexdigest()[:_DIGITS],
        seconds=round(time.perf_counter() - began, 3),
    )


def _windows(shard: int, size: int, drawer: Drawer, candidate: Candidate) -> Iterator[tuple[int, Drawn]]:
    """Draw queries, and tell the candidate which ones come next."""
    for begin in range(0, size, _WINDOW):
        numbers = range(begin, min(begin + _WINDOW, size))
        drawn = [drawer.draw(shard, number) for number in numbers]
        ask_ahead(candidate, [one.query for one in drawn])
        yield from zip(numbers, drawn, strict=True)
