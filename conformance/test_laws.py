"""Metamorphic laws: the candidate's answers belong together, whatever retail's are (``conformance.laws``)."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest
from hypothesis import settings

from conformance.found import found_cases_dir
from conformance.laws.catalogue import LAWS
from conformance.laws.law import BrokenLawError, LawRun, explain, hold

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from conformance.candidates.base import Candidate


@pytest.mark.parametrize("name", LAWS)
def test_law(
    name: str,
    candidate: Candidate,
    record_counts: Callable[[Mapping[str, object]], None],
    request: pytest.FixtureRequest,
) -> None:
    """The candidate keeps the law, under the condition that its docstring gives."""
    run = LawRun()
    failure = ""
    try:
        hold(LAWS[name], candidate, run)
    except BrokenLawError as error:
        failure = str(error)
        directory = found_cases_dir(request.config.rootpath)
        profile = settings.get_current_profile_name()
        explanation = explain(run, directory, candidate, broken=failure, profile=profile)
        request.node.add_report_section("call", "law", explanation)
    record_counts({**run.counts(), **({"failure": failure} if failure else {})})
    if failure:
        pytest.fail(failure, pytrace=False)
    if not run.compared:
        pytest.skip("; ".join(run.skipped))
