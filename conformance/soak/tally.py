"""What a campaign has come to: each shard counted once."""

from __future__ import annotations

import hashlib
from collections import Counter
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from conformance import exit_codes
from conformance.soak.workshop import Spot

if TYPE_CHECKING:
    from conformance.soak.kinds import FailureKind
    from conformance.soak.records import Kept, ShardResult


class UnlikeShardError(RuntimeError):
    """A shard that was asked twice has come out differently."""


@dataclass(slots=True)
class Failing:
    """The failures of one kind.

    Attributes
    ----------
    count : int
        How many there are.
    first : Spot
        The one in the first shard, and there the first.
    said : str
        What is wrong with it.
    kept : Kept or None
        The case that one of them was kept as.
    """

    count: int
    first: Spot
    said: str
    kept: Kept | None = None


@dataclass(slots=True)
class Tally:
    """What a campaign has come to.

    Attributes
    ----------
    agreed, differed, errored : int
        Queries that ended so.
    skipped : Counter of str
        Queries that somebody does not do, by who and why.
    asked : Counter of str
        Queries by family.
    failing : dict of FailureKind to Failing
    complaints : Counter of str
        What was wrong with how the candidate stopped.
    seconds : float
        Sum over all shards.
    """

    agreed: int = 0
    differed: int = 0
    errored: int = 0
    skipped: Counter[str] = field(default_factory=Counter)
    asked: Counter[str] = field(default_factory=Counter)
    failing: dict[FailureKind, Failing] = field(default_factory=dict)
    complaints: Counter[str] = field(default_factory=Counter)
    seconds: float = 0.0
    _marks: dict[int, bytes] = field(default_factory=dict)

    def __contains__(self, shard: int) -> bool:
        return shard in self._marks

    @property
    def shards(self) -> int:
        """How many shards are counted."""
        return len(self._marks)

    @property
    def queries(self) -> int:
        """How many queries have ended, in whatever way."""
        return self.agreed + self.differed + self.errored + self.skipped.total()

    @property
    def exit_code(self) -> int:
        """How a campaign ends that has come to this: a wrong answer counts more than a missing one."""
        if self.differed:
            return exit_codes.FAILURES
        if self.errored or self.complaints:
            return exit_codes.BROKEN
        return exit_codes.OK if self.agreed else exit_codes.NOTHING_RAN

    def add(self, result: ShardResult) -> bool:
        """Count a shard, unless it is counted already; return whether it was not.

        Raises
        ------
        UnlikeShardError
            It is counted already, and has come out differently this time.
        """
        mark = _mark(result)
        known = self._marks.setdefault(result.shard, mark)
        if known != mark:
            raise UnlikeShardError(
                f"shard {result.shard} was asked twice and came out differently: the candidate, or the "
                "machine, does not answer the same question in the same way"
            )
        if known is not mark:
            return False
        self.agreed += result.agreed
        self.differed += result.differed
        self.errored += result.errored
        self.skipped.update(result.skipped)
        self.asked.update(result.asked)
        self.complaints.update(result.complaints)
        self.seconds += result.seconds
        self._add_failures(result)
        return True

    def keep(self, kept: Kept) -> None:
        """Note the case that a failure was kept as."""
        self.failing[kept.kind].kept = kept

    def _add_failures(self, result: ShardResult) -> None:
        for found in result.failures:
            spot = Spot(found.kind, result.shard, found.query)
            failing = self.failing.setdefault(found.kind, Failing(0, spot, found.said))
            failing.count += found.count
            if (spot.shard, spot.query) < (failing.first.shard, failing.first.query):
                failing.first, failing.said = spot, found.said


def _mark(result: ShardResult) -> bytes:
    """Return what two answers to the same shard have in common; how long they took does not count."""
    return hashlib.sha256(result.model_dump_json(exclude={"seconds"}).encode("utf-8")).digest()
