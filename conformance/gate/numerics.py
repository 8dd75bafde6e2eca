"""The stage of numerical stress: families of sweeps, held against retail and an error budget."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING

from conformance.gate.outcome import Check, Stage, Status
from conformance.stress.budgets import broken_bounds
from conformance.stress.findings import CANDIDATE, Findings
from conformance.stress.models import Spec
from conformance.stress.runner import Plan, run_plan
from conformance.stress.settings import quick
from conformance.workers import one_for_each_core

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from conformance.gate.parties import Parties
    from conformance.stress.budgets import Budget


def check_stress(
    parties: Parties, budget: Budget, record: Callable[[Check], None], say: Callable[[str], None]
) -> None:
    """Run the families and hold what was found against the budget.

    Of a bound that is about no severity of a quick run, nothing is said.
    """
    gate = parties.gate
    begin = time.perf_counter()
    findings = Findings()
    plan = Plan(quick(), gate.stress, Spec(parties.spec, parties.read_timeout), one_for_each_core())
    run_plan(plan, findings, lambda text: say(f"stress: {text}"))
    seconds = time.perf_counter() - begin
    broken = [f"budget: {text}" for text in broken_bounds(budget, findings, whole=False)]
    for family in gate.stress:
        wrong = [text for text in broken if text.startswith((f"budget: {family}:", f"budget: {family},"))]
        answers = [r for r in findings.readings if (r.model, r.family) == (CANDIDATE, family)]
        spent = seconds * findings.costs.get(family, 0.0) / (sum(findings.costs.values()) or 1.0)
        status, told = _outcome(findings, family, wrong, bool(answers))
        record(Check(Stage.STRESS, family, status, len(answers), spent, "; ".join(told)))
    for text in findings.failures:
        record(Check(Stage.STRESS, "run", Status.FAILED, message=text))


def _outcome(
    findings: Findings, family: str, wrong: Sequence[str], has_answered: bool
) -> tuple[Status, Sequence[str]]:
    """Return how a family ended, and what is to be said of it."""
    errors = [text for text in findings.errors if text.startswith(f"{family},")]
    skips = [note for note in findings.notes if note.startswith(f"{family}:")]
    if wrong:
        return Status.FAILED, wrong
    if errors:
        others = [f"and {len(errors) - 1} others"] if len(errors) > 1 else []
        return Status.BROKEN, [errors[0], *others]
    if has_answered:
        return Status.PASSED, skips
    return Status.SKIPPED, skips or findings.notes or ["no reading"]
