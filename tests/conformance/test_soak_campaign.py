"""Campaigns come to the same, whoever works for them, in whatever order, and however often they are ended."""

from __future__ import annotations

from collections import Counter
from concurrent.futures import Future
from typing import TYPE_CHECKING, Any

import pytest
from soak_engines import MARK
from soak_runs import QUERIES, SHARD_SIZE, engine, identity, plan, run

from conformance.lint import lint
from conformance.soak import campaign as campaign_module
from conformance.soak.campaign import Campaign, NoAnswersError, WorkerLostError
from conformance.soak.crews import Alone, Processes
from conformance.soak.journal import SoakJournal
from conformance.soak.workshop import OtherInstallationError, Shard, Work, ask

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

    from conformance.soak.tally import Tally


class GoneError(Exception):
    """Whoever worked on a task is gone."""


class Careless:
    """Runs tasks last in, first out, and loses some."""

    lost = (GoneError,)
    chances = 3
    places = 4

    def __init__(self, losses: dict[int, int] | None = None) -> None:
        self.alone: list[int] = []
        self.closed = False
        self._left = Counter(losses or {})
        self._waiting: list[Callable[[], None]] = []

    def submit(self, task: Callable[..., Any], /, *args: Any) -> Future[Any]:
        """Take a task; the last of four is done first."""
        future: Future[Any] = Future()
        self._waiting.append(lambda: self._work(future, task, *args))
        if len(self._waiting) == self.places or getattr(args[1], "number", None) in self.alone:
            self._finish()
        return future

    def close(self) -> None:
        """End."""
        self.closed = True

    def _finish(self) -> None:
        while self._waiting:
            self._waiting.pop()()

    def _work(self, future: Future[Any], task: Callable[..., Any], work: Work, what: object) -> None:
        number = what.number if isinstance(what, Shard) else -1
        if self._left[number] > 0:
            self._left[number] -= 1
            self.alone.append(number)
            future.set_exception(GoneError())
        else:
            future.set_result(task(work, what))


def counts(tally: Tally) -> dict[str, Any]:
    """Return what must not depend on who has worked."""
    kinds = {kind: (failing.count, failing.first) for kind, failing in tally.failing.items()}
    return {
        "shards": tally.shards,
        "ended": (tally.agreed, tally.differed, tally.errored, tally.skipped),
        "families": tally.asked,
        "kinds": kinds,
    }


@pytest.fixture(autouse=True)
def few_cases(monkeypatch: pytest.MonkeyPatch) -> None:
    """Shrink no more than one kind of failure in a campaign: it takes a while."""
    monkeypatch.setattr(campaign_module, "MOST_KEPT", 1)


def test_a_campaign_counts_every_query_once(tmp_path: Path) -> None:
    """It keeps one case of the first kind of failure, which `lint` accepts, and says how far it is."""
    said: list[str] = []
    tally = run(tmp_path, engine("Faulty"), said=said)
    assert (tally.shards, tally.queries) == (QUERIES // SHARD_SIZE, QUERIES)
    assert tally.differed
    assert tally.errored
    assert sum(failing.count for failing in tally.failing.values()) == tally.differed + tally.errored
    kept = [failing.kept for failing in tally.failing.values() if failing.kept is not None]
    assert [one.file for one in kept] == [path.name for path in (tmp_path / "found").iterdir()]
    assert len(tally.failing) > len(kept) == 1
    assert lint([tmp_path / "found"]) == []
    assert said[-1].startswith(f"{QUERIES} of {QUERIES} queries (")


def test_queries_are_rounded_up_to_shards(tmp_path: Path) -> None:
    """No shard is asked in part."""
    assert run(tmp_path, engine("Right"), SHARD_SIZE + 1).queries == 2 * SHARD_SIZE


def test_a_campaign_in_two_runs_is_the_same(tmp_path: Path) -> None:
    """Also one that becomes longer; what was kept is not shrunk again."""
    whole = run(tmp_path / "whole", engine("Faulty"))
    run(tmp_path / "parts", engine("Faulty"), SHARD_SIZE)
    assert counts(run(tmp_path / "parts", engine("Faulty"), resume=True)) == counts(whole)
    journal = (tmp_path / "parts" / "journal.jsonl").read_text(encoding="utf-8")
    assert journal.count('"kept"') == 1


def test_a_case_that_has_gone_is_made_again(tmp_path: Path) -> None:
    """A journal may be gone on with in another folder."""
    run(tmp_path, engine("Faulty"))
    (case,) = (tmp_path / "found").iterdir()
    case.unlink()
    run(tmp_path, engine("Faulty"), resume=True)
    assert case.is_file()


@pytest.mark.parametrize("losses", [{}, {0: 1}, {1: 2, 2: 1}])
def test_neither_order_nor_losses_count(tmp_path: Path, losses: dict[int, int]) -> None:
    """What was lost is done again, one task at a time."""
    crew = Careless(losses)
    tally = run(tmp_path / "careless", engine("Right"), 4 * SHARD_SIZE, crew=crew)
    assert crew.closed
    assert counts(tally) == counts(run(tmp_path / "alone", engine("Right"), 4 * SHARD_SIZE))


def test_a_task_that_ends_whoever_works_on_it_ends_the_campaign(tmp_path: Path) -> None:
    """It is named; what the others have found is in the journal."""
    crew = Careless({2: 3})
    with pytest.raises(WorkerLostError, match=r"^shard 2 has ended who worked on it, 3 times$"):
        run(tmp_path, engine("Right"), 4 * SHARD_SIZE, crew=crew)
    assert crew.closed
    journal = SoakJournal(tmp_path / "journal.jsonl", identity(engine("Right")), resume=True)
    assert [number for number in range(4) if number in journal.tally] == [0, 1, 3]


class Slow(Careless):
    """Finishes nothing."""

    def submit(self, task: Callable[..., Any], /, *args: Any) -> Future[Any]:
        """Take a task, and leave it."""
        return Future()


def test_a_suspect_is_alone(tmp_path: Path) -> None:
    """Tasks that have lost who worked on them are tried one by one: then it is known which one it is."""
    journal = SoakJournal(tmp_path / "journal.jsonl", identity(engine("Right")), resume=False)
    campaign = Campaign(plan(tmp_path, engine("Right")), Slow(), journal, [].append)
    for number in (0, 1):
        campaign._lose(Shard(number), GoneError())
    for _ in range(2):
        assert campaign._submit()
        assert list(campaign._waiting.values()) == [Shard(0)]


def test_who_answers_nothing_is_not_asked_on(tmp_path: Path) -> None:
    """After a shard without an answer."""
    with pytest.raises(NoAnswersError, match=r"^no answer to anything in shard 0: .* failed: out of order"):
        run(tmp_path, engine("Silent"))


def test_no_shard_is_begun_when_the_time_is_up(tmp_path: Path) -> None:
    """What there is stays."""
    journal = SoakJournal(tmp_path / "journal.jsonl", identity(engine("Right")), resume=False)
    with journal:
        Campaign(plan(tmp_path, engine("Right"), seconds=0.0), Alone(), journal, [].append).run()
    assert journal.tally.shards == 0


def test_another_installation_is_not_asked() -> None:
    """A machine with another suite would draw other queries."""
    theirs = identity(engine("Right")).model_copy(update={"suite": "0123456789abcdef"})
    with pytest.raises(
        OtherInstallationError, match=r"^a worker has suite '.*', expected '0123456789abcdef'"
    ):
        ask(Work(theirs.model_dump_json(), None, None), Shard(0))


def test_processes_that_die_are_replaced(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Two processes, one of which the candidate ends, come to what one alone does."""
    monkeypatch.chdir(tmp_path)
    tally = run(tmp_path / "processes", engine("Mortal"), crew=Processes(2))
    assert MARK.exists()
    assert counts(tally) == counts(run(tmp_path / "alone", engine("Right")))
