"""Metamorphic laws: the candidate's answers belong together, whatever retail's are (``conformance.laws``)."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

import pytest

from conformance.laws.catalogue import LAWS
from conformance.laws.law import BrokenLawError, LawRun, hold

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from conformance.candidates.base import Candidate

QUERIES: Final = 0.25
"""Queries of each law, two questions each or three, as a multiple of the profile's."""


@pytest.mark.parametrize("name", LAWS)
def test_law(name: str, candidate: Candidate, record_counts: Callable[[Mapping[str, object]], None]) -> None:
    """The candidate keeps the law, under the condition that its docstring gives."""
    run = LawRun()
    failure = ""
    try:
        hold(LAWS[name], candidate, run, multiple=QUERIES)
    except BrokenLawError as error:
        failure = str(error)
    record_counts({**run.counts(), **({"failure": failure} if failure else {})})
    if failure:
        pytest.fail(failure, pytrace=False)
    if not run.compared:
        pytest.skip("; ".join(run.skipped))
