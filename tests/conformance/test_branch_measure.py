"""What coverage.py sees of a run, and what is recorded about the rest."""

from __future__ import annotations

import sys

import pytest

from conformance.branches.known_gaps import REASONS
from conformance.branches.measure import (
    INSTRUMENTS,
    ORACLE,
    CoverageMissingError,
    Measurement,
    Site,
    measure,
    oracle_sources,
)
from conformance.branches.reasons import (
    NEVER_CALLED,
    Kind,
    Reason,
    gaps,
    stale_reasons,
    unknown_reasons,
)
from conformance.branches.sites import functions_of
from conformance.query import Query

SMALL = Site("vector.py", "Vector3.normalize_check_small")
FLOOR = Site("plane.py", "Plane.snap_to_plane")
TINY = Reason(Kind.NO_INPUT, "never so small")
UNASKED = Reason(Kind.NOT_ASKED, "not asked")


@pytest.fixture(scope="module")
def measurement() -> Measurement:
    """Measure the normalisation of one vector that is long enough, and of nothing else."""
    return measure(lambda ask: ask(Query("normalize_check_small", {"v": [3.0, 0.0, 4.0]})))


def test_a_branch_that_ran_is_reached(measurement: Measurement) -> None:
    """The other way of the same condition is not."""
    reach = measurement.reached[SMALL]
    assert measurement.queries == 1
    assert measurement.failures == []
    assert reach.called
    assert [branch.way for branch in reach.taken] == ["false"]
    assert [branch.way for branch in reach.missed] == ["true"]
    assert reach.total == 2


def test_a_function_that_did_not_run_is_not_called(measurement: Measurement) -> None:
    """All of its branches are missed, and it is one gap."""
    reach = measurement.reached[FLOOR]
    assert not reach.called
    assert not reach.taken
    (gap,) = [gap for gap in gaps(measurement.reached, {}) if gap.site == FLOOR]
    assert gap.branch is None
    assert gap.branches == len(reach.missed) == 2


def test_a_reason_belongs_to_a_branch(measurement: Measurement) -> None:
    """By function and condition; None where nothing is recorded."""
    missed = measurement.reached[SMALL].missed[0]
    recorded = {SMALL.key: {missed.key: TINY}, FLOOR.key: {NEVER_CALLED: UNASKED}}
    reasons = {gap.site: gap.reason for gap in gaps(measurement.reached, recorded)}
    assert reasons[SMALL] == TINY
    assert reasons[FLOOR] == UNASKED
    assert set(reasons.values()) == {TINY, UNASKED, None}


def test_a_reason_for_what_is_reached_is_stale(measurement: Measurement) -> None:
    """A branch that is taken, and a function that is called, need none."""
    taken = measurement.reached[SMALL].taken[0]
    recorded = {SMALL.key: {taken.key: TINY, NEVER_CALLED: TINY}, FLOOR.key: {NEVER_CALLED: UNASKED}}
    assert list(stale_reasons(measurement.reached, recorded)) == [
        f"{SMALL.key}: it is called",
        f"{SMALL.key}: {taken.key} is taken",
    ]


def test_a_reason_for_what_is_not_there_is_told(measurement: Measurement) -> None:
    """With what comes nearest."""
    functions = {site.key: reach.function for site, reach in measurement.reached.items()}
    recorded = {"plane.Plane.snap_to_plain": {}, SMALL.key: {"if x > EPS: true": TINY}}
    function, branch = unknown_reasons(functions, recorded)
    assert function.startswith("plane.Plane.snap_to_plain: the oracle has no such function. Did you mean ")
    assert function.endswith("'plane.Plane.snap_to_plane'?")
    assert branch.startswith(f"{SMALL.key}: it has no branch 'if x > EPS: true'. Did you mean ")


def test_a_query_without_an_answer_is_told() -> None:
    """What the oracle cannot do would count as not reached without a word."""
    told = measure(lambda ask: ask(Query("no_such_operation", {}, label="a-case")))
    assert told.queries == 0
    (failure,) = told.failures
    assert failure.startswith("a-case: ")


def test_without_coverage_the_error_says_what_to_install(monkeypatch: pytest.MonkeyPatch) -> None:
    """The extra that brings it."""
    monkeypatch.setitem(sys.modules, "coverage", None)
    with pytest.raises(CoverageMissingError, match=r"pip install 'retail-conformance\[coverage\]'"):
        measure(lambda _: None)


def test_every_module_of_the_oracle_is_measured_or_left_out_by_name() -> None:
    """An instrument that is gone must not stay in the list."""
    files = {path.name for path in ORACLE.glob("*.py")}
    assert files == {*oracle_sources(), *INSTRUMENTS}
    assert len(oracle_sources()) > 40


def test_every_recorded_reason_speaks_of_a_branch() -> None:
    """The table holds together with the oracle's source; whether a branch is reached, `coverage` tells."""
    functions = {
        Site(file, name).key: function
        for file, source in oracle_sources().items()
        for name, function in functions_of(source).items()
    }
    assert list(unknown_reasons(functions, REASONS)) == []
    assert all(reason.text.strip() for entries in REASONS.values() for reason in entries.values())
