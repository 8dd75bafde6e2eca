"""Asking at random: what disagrees is found, shrunk, kept and counted."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest
from hypothesis import settings

from conformance.candidates.registry import make_candidate
from conformance.loader import load_file
from conformance.profiles import CI, profiles
from conformance.query import Errored, Outcome, Query, Result, Skipped
from conformance.random_run import DisagreementError, RandomRun, ask_at_random, explain
from conformance.strategies.collisions import find_collisions
from conformance.strategies.math_queries import frame_queries

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

ORACLE = make_candidate("oracle")


@pytest.fixture(autouse=True)
def ci_profile() -> Iterator[None]:
    """Run under the profile that asks the same queries every time."""
    before = settings.get_current_profile_name()
    settings.register_profile("random-run-tests", profiles()[CI])
    settings.load_profile("random-run-tests")
    yield
    settings.load_profile(before)


class Answering:
    """A candidate that gives one outcome to everything."""

    name = "answering"

    def __init__(self, outcome: Outcome) -> None:
        self.outcome = outcome

    def answer(self, query: Query) -> Outcome:
        """Give the outcome."""
        del query
        return self.outcome


def ask(candidate: object, run: RandomRun, *, op: str = "block_offset") -> None:
    """Ask a candidate random queries of an operation on frames."""
    ask_at_random(frame_queries(op), candidate, ORACLE, name="law[x]", multiple=0.2, run=run)  # type: ignore[arg-type]


def test_agreement_is_counted() -> None:
    """A candidate that is retail agrees on all queries asked."""
    run = RandomRun()
    ask(ORACLE, run)
    assert run.counts() == {"random": 20, "skipped": {}}
    assert run.failing is None


def test_skips_are_counted_by_reason() -> None:
    """A candidate that does nothing is not in agreement, nor in disagreement."""
    run = RandomRun()
    ask(Answering(Skipped("not mine")), run)
    assert run.counts() == {"random": 0, "skipped": {"answering: not mine": 20}}


def test_a_crash_is_a_failure() -> None:
    """A candidate that fails to answer is reported with what it said."""
    run = RandomRun()
    with pytest.raises(DisagreementError, match="answering failed: boom"):
        ask(Answering(Errored("boom")), run)
    assert run.failing is not None
    assert run.failing[2] == "answering failed: boom"


def test_signs_of_zero_are_distinct() -> None:
    """Between two engines -0 is not 0."""
    run = RandomRun()
    with pytest.raises(DisagreementError, match="the sign of zero"):
        ask(Answering(Result({"v": [-0.0, -0.0, -0.0]})), run)


def test_a_known_bug_is_found_shrunk_and_kept(tmp_path: Path) -> None:
    """The lost cell origin is found, in a simple scene, and kept as a case that fails again."""
    bug = make_candidate("bug:cell-origin")
    run = RandomRun()
    with pytest.raises(DisagreementError, match=r"contact_plane\.d: retail"):
        ask_at_random(find_collisions("step_down"), bug, ORACLE, name="t", multiple=1.0, run=run)
    text = explain(run, tmp_path, bug, name="t", profile="ci")
    (path,) = tmp_path.iterdir()
    assert f'rerun: pytest "{path}" --candidate bug:cell-origin' in text
    (case,) = load_file(path).cases
    assert case.queries[0].inputs["pose"]["rotation"] == [1.0, 0.0, 0.0, 0.0]
    answers = [who.answer(case.queries[0]) for who in (bug, ORACLE)]
    planes = [answer.fields["contact_plane"]["plane"] for answer in answers if isinstance(answer, Result)]
    assert planes[0][3] != planes[1][3]


def test_there_is_nothing_to_explain_without_a_failure(tmp_path: Path) -> None:
    """Explaining a run that agreed is a mistake of the caller."""
    with pytest.raises(ValueError, match="t has not failed"):
        explain(RandomRun(), tmp_path, ORACLE, name="t", profile="ci")
