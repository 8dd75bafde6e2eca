"""Running a gate: its stages, one after the other."""

from __future__ import annotations

from typing import TYPE_CHECKING

from conformance.candidates.base import close
from conformance.gate.at_random import check_poses, check_walks
from conformance.gate.outcome import Check, Stage, Status
from conformance.gate.pages import Pages
from conformance.gate.pinned import GivenUpError, check_cases
from conformance.gate.speed import check_speed

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from conformance.case import Case
    from conformance.gate.outcome import GateRun
    from conformance.gate.parties import Parties
    from conformance.gate.speed import Baseline
    from conformance.stress.budgets import Budget


def run_gate(
    run: GateRun,
    parties: Parties,
    cases: Sequence[Case],
    baseline: Baseline | None,
    budget: Budget | None,
    say: Callable[[str], None],
) -> Baseline | None:
    """Run every stage that was asked for; what was seen is in `run` also after Ctrl-C.

    Parameters
    ----------
    run : GateRun
        Where checks are recorded.
    parties : Parties
    cases : sequence of Case
        Those that are left after filtering.
    baseline : Baseline or None
        What the speed is held against; None: it is measured only.
    budget : Budget or None
        What errors under stress are held against; None: there is no such stage.
    say : callable
        Told how far it is.

    Returns
    -------
    Baseline or None
        What was measured, if that was asked for without a baseline.
    """
    measured = None
    pages = Pages(parties)
    try:
        if Stage.CASES in run.asked:
            check_cases(cases, parties, pages, run.checks.append, say)
        if Stage.POSES in run.asked:
            check_poses(parties, run.checks.append, say)
        if Stage.WALKS in run.asked:
            check_walks(parties, run.checks.append, say)
        if Stage.PERFORMANCE in run.asked:
            measured = check_speed(parties, cases, baseline, run.checks.append, say)
    except GivenUpError as error:
        run.notes.append(str(error))
        return None
    finally:
        complaints = list(close(parties.candidate))
        run.checks += [Check(Stage.CASES, "stop", Status.BROKEN, message=text) for text in complaints]
        run.report = pages.html(complaints)
    if budget is not None:
        from conformance.gate.numerics import check_stress

        check_stress(parties, budget, run.checks.append, say)
    run.whole = True
    return measured
