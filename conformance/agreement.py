"""The assertion of every random property: a candidate and retail agree on a strategy's queries."""

from __future__ import annotations

from typing import TYPE_CHECKING, Protocol

import pytest
from hypothesis import settings

from conformance.found import found_cases_dir
from conformance.random_run import DisagreementError, RandomRun, ask_at_random, explain
from conformance.summary import PROPERTY

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from hypothesis.strategies import SearchStrategy

    from conformance.candidates.base import Candidate
    from conformance.query import Query


class Agree(Protocol):
    """Assert that candidate and oracle agree on a strategy's queries."""

    def __call__(self, queries: SearchStrategy[Query], *, multiple: float) -> None:
        """Ask `multiple` times the profile's number of queries."""


@pytest.fixture
def record_counts(request: pytest.FixtureRequest) -> Callable[[Mapping[str, object]], None]:
    """Return what a test tells how much it has asked; the summary adds it up.

    What pytest has for it, ``record_property``, warns beside ``--junitxml``, and warnings may be errors.
    """
    return lambda counts: request.node.user_properties.append((PROPERTY, dict(counts)))


@pytest.fixture
def agree(
    request: pytest.FixtureRequest,
    record_counts: Callable[[Mapping[str, object]], None],
    candidate: Candidate,
    oracle: Candidate,
) -> Agree:
    """Return the assertion, bound to this run's candidate; it counts, and keeps what fails as a case."""

    def assertion(queries: SearchStrategy[Query], *, multiple: float) -> None:
        __tracebackhide__ = True
        run = RandomRun()
        name = request.node.name
        failure = ""
        try:
            ask_at_random(queries, candidate, oracle, name=name, multiple=multiple, run=run)
        except DisagreementError as error:
            directory = found_cases_dir(request.config.rootpath)
            profile = settings.get_current_profile_name()
            failure = f"{name}: {error}"
            explanation = explain(run, directory, candidate, name=name, profile=profile)
            request.node.add_report_section("call", "disagreement", explanation)
        record_counts({**run.counts(), **({"failure": failure} if failure else {})})
        if failure:
            pytest.fail(failure, pytrace=False)
        if not run.compared:
            pytest.skip("; ".join(run.skipped))

    return assertion
