"""A candidate under stress that takes no part, or gives no answer: neither is a wrong answer."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import pytest

pytest.importorskip("flint", reason="the extra `exact` is not installed")

from conformance import exit_codes
from conformance.cli import main
from conformance.gate import numerics
from conformance.gate.outcome import Status
from conformance.query import Errored, Outcome, Query, Skipped
from conformance.stress import drift, runner, thresholds, translation
from conformance.stress.budgets import bit_for_bit, broken_bounds
from conformance.stress.findings import CANDIDATE, DIFFERING, RETAIL, Findings
from conformance.stress.models import Models, Spec, make_models
from conformance.stress.settings import Settings

if TYPE_CHECKING:
    from conformance.stress.sweep import Sweep

TINY = Settings(seed=5, probes=2, grid=4, ticks=150, quick=True)
FIRST_OF: dict[str, Sweep] = {
    "translation": translation.sweeps(TINY)[0],
    "drift": drift.sweeps(TINY)[0],
    "thresholds": thresholds.sweeps(TINY)[0],
}
"""A sweep of each kind."""


@dataclass
class Saying:
    """Says the same to everything."""

    outcome: Outcome
    name: str = "mine"

    def answer(self, query: Query) -> Outcome:
        """Answer a query."""
        del query
        return self.outcome


def found_with(family: str, outcome: Outcome) -> Findings:
    """Run the first part of a family's first sweep with a candidate that says this to everything."""
    models: Models = replace(make_models(Spec("oracle")), candidate=Saying(outcome))
    return FIRST_OF[family].run(0, models, lambda _: None)


@pytest.mark.parametrize("family", FIRST_OF)
def test_who_skips_has_no_reading(family: str) -> None:
    """Retail has its own, nothing differs, and the reason is told once."""
    found = found_with(family, Skipped("operation transition is not declared"))
    assert {reading.model for reading in found.readings} == {RETAIL, "single", "double"}
    assert found.differences == found.errors == []
    assert found.notes.count(f"{family}: skipped by mine: operation transition is not declared") == 1
    assert not found.has_answered(family)
    assert list(broken_bounds(bit_for_bit("mine"), found, whole=True)) == []


@pytest.mark.parametrize("family", FIRST_OF)
def test_who_fails_is_not_another_answer(family: str) -> None:
    """What went wrong is told, and no difference; the candidate was asked all the same."""
    found = found_with(family, Errored("the engine ended with exit status 3 before it replied"))
    assert found.differences == []
    assert found.errors
    assert found.errors[0].endswith(
        ": mine has no answer: the engine ended with exit status 3 before it replied"
    )
    assert found.has_answered(family)
    assert {r.quantities[DIFFERING] for r in found.readings if r.model == CANDIDATE} == {0.0}


@pytest.mark.parametrize(
    ("outcome", "code", "said"),
    [
        (
            Skipped("no transitions"),
            exit_codes.NOTHING_RAN,
            "note: translation: skipped by mine: no transitions",
        ),
        (Errored("crashed"), exit_codes.BROKEN, "no answer: translation, "),
    ],
)
def test_the_command_ends_by_what_came(
    outcome: Outcome,
    code: int,
    said: str,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    """4 and 3: neither has failed, and neither has passed."""
    monkeypatch.setattr(
        runner, "run_plan", lambda _plan, into, _say: into.add(found_with("translation", outcome))
    )
    assert main(["stress", "--quick", "--family", "translation", "--candidate", "oracle"]) == code
    assert said in capsys.readouterr().out


@pytest.mark.parametrize(
    ("outcome", "status", "said"),
    [
        (Skipped("no transitions"), Status.SKIPPED, "translation: skipped by mine: no transitions"),
        (Errored("crashed"), Status.BROKEN, "mine has no answer: crashed"),
    ],
)
def test_the_gate_tells_them_apart(outcome: Outcome, status: Status, said: str) -> None:
    """What is not offered is skipped, and what has crashed is broken, unless something is wrong as well."""
    found = found_with("translation", outcome)
    ended, told = numerics._outcome(found, "translation", (), found.has_answered("translation"))
    assert ended is status
    assert said in told[0]
    assert numerics._outcome(found, "translation", ("budget",), True) == (Status.FAILED, ("budget",))
