"""The stage of the cases: every pinned case, held against retail, its pins and the deviations."""

from __future__ import annotations

import re
import time
from typing import TYPE_CHECKING

from conformance.deviations.reckoning import reckon
from conformance.gate.config import PATIENCE
from conformance.gate.digests import case_digest
from conformance.gate.outcome import Check, Stage, Status
from conformance.verdict import judge

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Sequence

    from conformance.case import Case
    from conformance.deviations.files import Deviations
    from conformance.deviations.reckoning import Reckoning
    from conformance.gate.pages import Pages
    from conformance.gate.parties import Parties
    from conformance.verdict import Verdict


class GivenUpError(Exception):
    """The candidate has not answered for so long that the rest is not asked."""


def chosen(cases: Iterable[Case], patterns: Sequence[str]) -> list[Case]:
    """Return the cases whose id matches one of the patterns, in which ``*`` is anything; all, without any."""
    wanted = [re.compile(".*".join(map(re.escape, pattern.split("*")))) for pattern in patterns]
    return [case for case in cases if not wanted or any(one.fullmatch(case.id) for one in wanted)]


def unknown_deviations(deviations: Deviations, cases: Iterable[Case]) -> list[Check]:
    """Return a failed check for each deviation that is about no case, of all there are."""
    return [
        Check(
            Stage.CASES,
            entry.deviation.case,
            Status.FAILED,
            message=f"{entry.location}: the deviation is about no case",
        )
        for entry in deviations.unmatched([case.id for case in cases])
    ]


def check_cases(
    cases: Sequence[Case],
    parties: Parties,
    pages: Pages,
    record: Callable[[Check], None],
    say: Callable[[str], None],
) -> None:
    """Ask every case that is not known to be unchanged.

    Parameters
    ----------
    cases : sequence of Case
    parties : Parties
        Who is asked, and what is known of them.
    pages : Pages
        What people are shown of each case.
    record : callable
        Is told each check at once, so that it is kept if the run is broken off.
    say : callable
        Told how far it is.

    Raises
    ------
    GivenUpError
        The candidate lets the gate wait, case after case, without an answer.
    """
    waited = 0.0
    for number, case in enumerate(cases, start=1):
        say(f"cases: {number} of {len(cases)}")
        digest = case_digest(case, parties.gate.case_poses, parties.suite_digest, parties.candidate_digest)
        if digest in parties.unchanged and not parties.deviations.about(case.id):
            record(Check(Stage.CASES, case.id, Status.UNCHANGED, digest=digest))
        else:
            check = _check(case, digest, parties, pages)
            record(check)
            waited = waited + check.seconds if check.status is Status.BROKEN else 0.0
            if waited > PATIENCE:
                raise GivenUpError(f"given up at {case.id}, after {waited:.0f} s without an answer")


def _check(case: Case, digest: str, parties: Parties, pages: Pages) -> Check:
    begin = time.perf_counter()
    verdict = judge(case, parties.candidate, parties.oracle)
    seconds = time.perf_counter() - begin
    pages.add(case, verdict)
    who = parties.candidate.name
    reckoning = reckon(parties.deviations, case.id, verdict, candidate=who, today=parties.today)
    status, message = judged(verdict, reckoning)
    return Check(Stage.CASES, case.id, status, verdict.compared, seconds, message, digest)


def judged(verdict: Verdict, reckoning: Reckoning) -> tuple[Status, str]:
    """Return how a case ended, and why."""
    if reckoning.unexplained:
        wrong = next((failure for failure in reckoning.unexplained if failure.found), None)
        first = wrong or reckoning.unexplained[0]
        return Status.FAILED if wrong else Status.BROKEN, f"{first.query.label}: {first.summary}"
    if reckoning.complaints:
        return Status.FAILED, "; ".join(reckoning.complaints)
    if reckoning.held:
        return Status.RECORDED, "; ".join(dict.fromkeys(held.deviation.reason for held in reckoning.held))
    if not verdict.compared:
        return Status.SKIPPED, "; ".join(verdict.skipped)
    return Status.PASSED, ""
