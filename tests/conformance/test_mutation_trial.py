"""Judging mutants with a few questions."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from conformance.branches.measure import oracle_sources
from conformance.mutation import trial as module
from conformance.mutation.asking import Question
from conformance.mutation.operators import plans
from conformance.mutation.reach import reaches
from conformance.mutation.trial import TIMED_OUT, Trial, Verdict
from conformance.query import Query

if TYPE_CHECKING:
    from conformance.mutation.operators import Plan

LONG = Question(Query("normalize_check_small", {"v": [3.0, 0.0, 4.0]}), "long", pose=False)
SHORT = Question(Query("normalize_check_small", {"v": [0.0001, 0.0, 0.0]}), "short", pose=True)
NO_SUCH = Question(Query("no_such_operation", {}), "none", pose=False)


@pytest.fixture(scope="module")
def mutants() -> list[Plan]:
    """Make the mutants of vectors."""
    return list(plans({"vector.py": oracle_sources()["vector.py"]}, {"01"}))


@pytest.fixture(scope="module")
def trial() -> Trial:
    """Ask two vectors; what the oracle does not answer is left out."""
    asked = [NO_SUCH, SHORT, LONG]
    reached = reaches(asked, lambda _: None)
    assert set(reached) == {"short", "long"}
    return Trial(asked, reached)


def plan_of(mutants: list[Plan], function: str, before: str, after: str) -> Plan:
    """Return a mutant by what it changes."""
    return next(
        plan
        for plan in mutants
        if (plan.mutant.function, plan.mutant.before, plan.mutant.after) == (function, before, after)
    )


def test_a_difference_is_noticed(trial: Trial, mutants: list[Plan]) -> None:
    """The finding names the question and the output."""
    finding = trial.judge(plan_of(mutants, "Vector3.normalize_check_small", "1.0 / m", "m / 1.0"))
    assert (finding.verdict, finding.by, finding.output) == (Verdict.CASE, "long", "v.x")


def test_what_only_a_pose_notices_is_told(trial: Trial, mutants: list[Plan]) -> None:
    """Cases are asked first."""
    finding = trial.judge(plan_of(mutants, "Vector3.normalize_check_small", "1", "0"))
    assert (finding.verdict, finding.by, finding.killed) == (Verdict.POSE, "short", True)


def test_a_hint_is_asked_first(trial: Trial, mutants: list[Plan]) -> None:
    """So a known killer saves the others."""
    plan = plan_of(mutants, "Vector3.normalize_check_small", "1", "0")
    assert trial.judge(plan, "short").asked == 1
    assert trial.judge(plan, "gone").killed


def test_a_limit_that_nobody_stands_on_survives(trial: Trial, mutants: list[Plan]) -> None:
    """Neither vector is exactly EPS long."""
    finding = trial.judge(plan_of(mutants, "Vector3.normalize_check_small", "m < EPS", "m <= EPS"))
    assert (finding.verdict, finding.asked, finding.by) == (Verdict.SURVIVED, 2, "")


def test_code_that_never_runs_is_told_apart(trial: Trial, mutants: list[Plan]) -> None:
    """No question needs Vector3.differs."""
    plan = next(plan for plan in mutants if plan.mutant.function == "Vector3.is_zero")
    assert trial.judge(plan).verdict is Verdict.UNREACHED


def test_no_answer_in_time_is_noticed(
    trial: Trial, mutants: list[Plan], monkeypatch: pytest.MonkeyPatch
) -> None:
    """A limit of nothing stands for an endless loop."""
    monkeypatch.setattr(module, "LEAST_BUDGET", -1e9)
    monkeypatch.setattr(module, "ask", lambda _candidate, _query: [None for _ in iter(int, 1)])
    monkeypatch.setattr(trial, "_truths", dict.fromkeys(("short", "long"), (None, "")))
    plan = plan_of(mutants, "Vector3.normalize_check_small", "m < EPS", "m <= EPS")
    assert trial.judge(plan).output == TIMED_OUT
