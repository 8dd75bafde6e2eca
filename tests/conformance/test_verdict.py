"""Judging a case: what is compared, what is skipped, what failed and why."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from conformance.loader import Vary, load_file
from conformance.query import Errored, Query, Result, Skipped
from conformance.verdict import judge

if TYPE_CHECKING:
    from pathlib import Path

    from conformance.case import Case
    from conformance.query import Outcome

CASE = """\
id: eye
title: The identity
why: To be judged.
retail: [Frame::cache §4.2]
query: {op: frame_cache, rotation: [1, 0, 0, 0]}
expect: {m: [1, 0, 0, 0, 1, 0, 0, 0, 1]}
"""
EYE = [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0]


class Fixed:
    """A candidate with one answer to everything."""

    def __init__(self, name: str, outcome: Outcome) -> None:
        self.name = name
        self.outcome = outcome

    def answer(self, query: Query) -> Outcome:
        """Give the answer."""
        del query
        return self.outcome


RIGHT = Fixed("oracle", Result({"m": EYE}))
WRONG = Result({"m": [*EYE[:8], 1.0000001192092896]})


@pytest.fixture
def case(tmp_path: Path) -> Case:
    """Return a case of one query."""
    path = tmp_path / "eye.yaml"
    path.write_text(CASE, encoding="utf-8")
    (case,) = load_file(path, Vary()).cases
    return case


def test_agreement(case: Case) -> None:
    """One query compared, nothing failed."""
    verdict = judge(case, Fixed("same", Result({"m": EYE})), RIGHT)
    assert (verdict.compared, verdict.skipped.total(), verdict.failures) == (1, 0, [])


def test_a_difference_of_one_ulp(case: Case) -> None:
    """The field, both values, bits and distance are in the summary."""
    verdict = judge(case, Fixed("other", WRONG), RIGHT)
    (failure,) = verdict.failures
    assert failure.summary == "m.m8: retail 1.0 (0x3F800000), other 1.0000001 (0x3F800001), 1 ULP"
    assert "rerun: pytest x" in failure.render(case, "pytest x")


def test_a_sign_of_zero_is_a_difference(case: Case) -> None:
    """Between engines -0 and 0 are told apart."""
    verdict = judge(case, Fixed("other", Result({"m": [1.0, -0.0, *EYE[2:]]})), RIGHT)
    assert "the sign of zero" in verdict.failures[0].summary


def test_a_skip_is_counted_with_its_reason(case: Case) -> None:
    """Nothing was compared, nothing failed."""
    verdict = judge(case, Fixed("half", Skipped("needs wings")), RIGHT)
    assert (verdict.compared, verdict.skipped, verdict.failures) == (0, {"half: needs wings": 1}, [])


def test_an_error_is_a_failure(case: Case) -> None:
    """A candidate that breaks has not passed."""
    verdict = judge(case, Fixed("broken", Errored("boom")), RIGHT)
    assert verdict.failures[0].summary == "broken failed: boom"
    assert "broken failed: boom" in verdict.failures[0].render(case, "pytest x")


def test_retail_itself_must_meet_the_pins(case: Case) -> None:
    """If the oracle misses a pin the candidate is not even asked."""
    verdict = judge(case, Fixed("same", WRONG), Fixed("oracle", WRONG))
    (failure,) = verdict.failures
    assert failure.summary == "m.m8: pinned 1.0 (0x3F800000), oracle 1.0000001 (0x3F800001), 1 ULP"
    assert verdict.compared == 0


def test_what_retail_cannot_answer_is_skipped(case: Case) -> None:
    """Also counted, under the oracle's name."""
    verdict = judge(case, Fixed("same", WRONG), Fixed("oracle", Skipped("not yet")))
    assert verdict.skipped == {"oracle: not yet": 1}
