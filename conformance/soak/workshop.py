"""What a process that works for a campaign keeps, whoever has started it, and the two things it does."""

from __future__ import annotations

import threading
from dataclasses import dataclass
from functools import lru_cache, partial
from typing import TYPE_CHECKING, Any, Final, TypeAlias

from conformance.candidates.oracle_candidate import OracleCandidate
from conformance.candidates.registry import make_candidate
from conformance.soak.drawing import Drawer
from conformance.soak.families import mix_of
from conformance.soak.identity import identity_of
from conformance.soak.records import Identity
from conformance.soak.shard import ask_shard
from conformance.soak.shrinking import found_case
from conformance.workers import serve_parent

if TYPE_CHECKING:
    from multiprocessing.synchronize import Event

    from conformance.soak.kinds import FailureKind
    from conformance.soak.records import ShardResult
    from conformance.soak.shrinking import FoundCase


class OtherInstallationError(RuntimeError):
    """A process works with another suite, or another candidate, than the campaign's."""


@dataclass(frozen=True, slots=True)
class Work:
    """What every process of a campaign is told.

    Attributes
    ----------
    identity : str
        The campaign's, as JSON: it travels to other machines.
    given : str or None
        What the candidate's author says its version is.
    read_timeout : float or None
        Seconds within which an engine in a process of its own must reply.
    """

    identity: str
    given: str | None
    read_timeout: float | None


@dataclass(frozen=True, slots=True)
class Shard:
    """A task: to ask a shard.

    Attributes
    ----------
    number : int
        From 0.
    """

    number: int

    def __str__(self) -> str:
        return f"shard {self.number}"


@dataclass(frozen=True, slots=True)
class Spot:
    """A task: to shrink a failure, where it was found.

    Attributes
    ----------
    kind : FailureKind
    shard, query : int
        Numbers, from 0.
    """

    kind: FailureKind
    shard: int
    query: int

    def __str__(self) -> str:
        return f"shard {self.shard}, query {self.query} ({self.kind})"


Task: TypeAlias = Shard | Spot


class Workshop:
    """Asks shards, and shrinks what has failed.

    Parameters
    ----------
    work : Work

    Raises
    ------
    OtherInstallationError
        This process would draw or ask something else than the campaign does.
    """

    def __init__(self, work: Work) -> None:
        self._campaign = Identity.model_validate_json(work.identity)
        _check_same(self._campaign, work.given)
        self._make = partial(make_candidate, self._campaign.candidate, read_timeout=work.read_timeout)
        self._drawer = Drawer(self._campaign.seed, mix_of(self._campaign.families))
        self._oracle = OracleCandidate()

    def ask(self, shard: Shard) -> ShardResult:
        """Ask a shard; see `ask_shard`."""
        size = self._campaign.shard_size
        return ask_shard(shard.number, size, self._drawer, self._oracle, self._make(), _is_stopped)

    def shrink(self, spot: Spot) -> FoundCase:
        """Shrink a failure; see `found_case`."""
        drawn = self._drawer.draw(spot.shard, spot.query)
        provenance = f"soak, seed {self._campaign.seed}, shard {spot.shard}, query {spot.query}"
        return found_case(drawn, spot.kind, self._oracle, self._make, provenance=provenance)


def ask(work: Work, shard: Shard) -> ShardResult:
    """Ask a shard in this process."""
    with _ONE_AT_A_TIME:
        return _workshop(work).ask(shard)


def shrink(work: Work, spot: Spot) -> FoundCase:
    """Shrink a failure in this process."""
    with _ONE_AT_A_TIME:
        return _workshop(work).shrink(spot)


def open_process(stopped: Event) -> None:
    """Prepare a process of its own; Ctrl-C is for who has started it, and tells by the event."""
    serve_parent()
    _STOPS.append(stopped)


_ONE_AT_A_TIME: Final = threading.Lock()
"""A process asks one shard at a time, also if its scheduler gives it several threads: a known bug is the
oracle with parts replaced, for all threads alike."""
_STOPS: Final[list[Event]] = []
"""In a process of its own, what says that nobody waits any more."""


@lru_cache(maxsize=1)
def _workshop(work: Work) -> Workshop:
    return Workshop(work)


def _is_stopped() -> bool:
    return any(event.is_set() for event in _STOPS)


def _check_same(campaign: Identity, given: str | None) -> None:
    ours: dict[str, Any] = identity_of(
        campaign.candidate,
        given,
        seed=campaign.seed,
        shard_size=campaign.shard_size,
        families=campaign.families,
    ).model_dump()
    for name, value in campaign.model_dump().items():
        if ours[name] != value:
            raise OtherInstallationError(
                f"a worker has {name} {ours[name]!r}, expected {value!r}: install the same versions there"
            )
