"""A campaign: shards are given to a crew, what they come to is noted, and what fails is shrunk."""

from __future__ import annotations

import math
from collections import Counter, deque
from concurrent.futures import FIRST_COMPLETED, wait
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Final

from conformance.files import write_text
from conformance.soak import workshop
from conformance.soak.pace import Pace
from conformance.soak.records import Kept
from conformance.soak.shrinking import UnusableCaseError
from conformance.soak.workshop import OtherInstallationError, Shard, Spot

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator
    from concurrent.futures import Future
    from pathlib import Path

    from conformance.soak.crews import Crew
    from conformance.soak.journal import SoakJournal
    from conformance.soak.kinds import FailureKind
    from conformance.soak.records import ShardResult
    from conformance.soak.shrinking import FoundCase
    from conformance.soak.workshop import Task

MOST_KEPT: Final = 25
"""Kinds of failure that are shrunk and kept; of others only the numbers are."""
_POLL_SECONDS: Final = 0.5


class WorkerLostError(RuntimeError):
    """Whoever works on a certain task is gone before it is done."""


class NoAnswersError(RuntimeError):
    """A candidate answers nothing: asking on would show nothing."""


@dataclass(frozen=True, slots=True)
class Plan:
    """What a campaign does.

    Attributes
    ----------
    queries : int
        How many; rounded up to whole shards.
    shard_size : int
        Queries of a shard.
    work : workshop.Work
        What every process is told.
    found : Path
        Folder for failures.
    seconds : float
        After which no further shard is begun.
    """

    queries: int
    shard_size: int
    work: workshop.Work
    found: Path
    seconds: float = math.inf

    @property
    def shards(self) -> int:
        """How many shards that makes."""
        return -(-self.queries // self.shard_size)


class Campaign:
    """Runs a plan with a crew, and notes everything in a journal.

    Parameters
    ----------
    plan : Plan
    crew : Crew
        Closed when the campaign ends.
    journal : SoakJournal
        Open for writing.
    say : callable
        Told how far it is.

    Attributes
    ----------
    notes : list of str
        What a reader should know besides the counts.
    pace : Pace
        How fast it is.
    """

    def __init__(self, plan: Plan, crew: Crew, journal: SoakJournal, say: Callable[[str], None]) -> None:
        self.notes: list[str] = []
        self.pace = Pace(plan.shards * plan.shard_size, journal.tally.queries)
        self._plan = plan
        self._crew = crew
        self._journal = journal
        self._say = say
        self._shards = self._missing()
        self._spots: deque[Spot] = deque()
        self._suspects: deque[Task] = deque()
        self._losses: Counter[Task] = Counter()
        self._wanted: set[FailureKind] = set()
        self._waiting: dict[Future[Any], Task] = {}

    @property
    def kinds_left(self) -> int:
        """How many kinds of failure are only counted, because `MOST_KEPT` others came before them."""
        return len(self._journal.tally.failing) - len(self._wanted)

    def run(self) -> None:
        """Ask every shard that the journal does not have, until all are done or the time is up.

        Raises
        ------
        NoAnswersError, SilentCandidateError
            The candidate is broken.
        WorkerLostError
            A task has ended whoever worked on it, again and again.
        OtherInstallationError
            A worker has another suite, or none.
        ClusterError
            The scheduler of other machines is gone.
        UnlikeShardError
            A shard was asked twice and came out differently.
        OSError
            A result cannot be written.
        """
        self._want()
        try:
            while self._submit():
                done, _ = wait(self._waiting, timeout=_POLL_SECONDS, return_when=FIRST_COMPLETED)
                for future in done:
                    self._take(self._waiting.pop(future), future)
                self._say(self.pace.line(self._journal.tally))
        finally:
            self._crew.close()

    def _submit(self) -> bool:
        """Give the crew what it has places for; return whether anything is on its way."""
        while len(self._waiting) < self._crew.places:
            task = self._next()
            if task is None:
                break
            if isinstance(task, Spot):
                self._waiting[self._crew.submit(workshop.shrink, self._plan.work, task)] = task
            else:
                self._waiting[self._crew.submit(workshop.ask, self._plan.work, task)] = task
        return bool(self._waiting)

    def _next(self) -> Task | None:
        if any(self._losses[task] for task in self._waiting.values()):
            return None  # who ends its process is to do so alone
        if self._suspects:
            return None if self._waiting else self._suspects.popleft()
        if self._spots:
            return self._spots.popleft()
        return None if self.pace.seconds >= self._plan.seconds else next(self._shards, None)

    def _take(self, task: Task, future: Future[Any]) -> None:
        """Note what has come of a task."""
        try:
            result = future.result()
        except self._crew.lost as error:
            self._lose(task, error)
        except UnusableCaseError as error:
            self.notes.append(f"{task} could not be kept as a case: {error}")
        except ImportError as error:
            raise OtherInstallationError(f"a worker cannot do {task}: {error}") from error
        else:
            if isinstance(task, Spot):
                self._keep(task, result)
            else:
                self._note(result)

    def _lose(self, task: Task, error: BaseException) -> None:
        self._losses[task] += 1
        if self._losses[task] >= self._crew.chances:
            raise WorkerLostError(f"{task} has ended who worked on it, {self._losses[task]} times") from error
        self._suspects.append(task)

    def _note(self, result: ShardResult) -> None:
        self._journal.note(result)
        self._want()
        if result.errored and result.errored == result.queries:
            raise NoAnswersError(f"no answer to anything in shard {result.shard}: {result.failures[0].said}")

    def _want(self) -> None:
        """Have failures shrunk that are of a new kind, or whose case is not where it should be."""
        for kind, failing in self._journal.tally.failing.items():
            kept = failing.kept
            if kind in self._wanted or len(self._wanted) == MOST_KEPT:
                continue
            self._wanted.add(kind)
            if kept is None or not (self._plan.found / kept.file).is_file():
                self._spots.append(failing.first)

    def _keep(self, spot: Spot, case: FoundCase) -> None:
        write_text(self._plan.found / case.name, case.text)
        self._journal.keep(
            Kept(**spot.kind._asdict(), shard=spot.shard, query=spot.query, file=case.name, alone=case.alone)
        )

    def _missing(self) -> Iterator[Shard]:
        return (Shard(n) for n in range(self._plan.shards) if n not in self._journal.tally)
