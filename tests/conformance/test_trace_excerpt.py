"""What a failure shows of who wrote what."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest
from shipped_cases import shipped_cases

from conformance.candidates.oracle_candidate import OracleCandidate
from conformance.candidates.registry import make_candidate
from conformance.compare import differences
from conformance.query import Errored, Query, Result
from conformance.report.excerpts import compared_writes, lone_writes
from conformance.trace_excerpt import excerpt
from conformance.traced import TopicsError, parse_topics

if TYPE_CHECKING:
    from conformance.candidates.base import Candidate
    from conformance.compare import Difference
    from conformance.query import Outcome

CASES = shipped_cases()
ORACLE = OracleCandidate()
MOST_LINES = 30


def numbered(first: int, last: int) -> list[str]:
    """Return lines to be compared."""
    return [f"line {number}" for number in range(first, last + 1)]


def test_the_first_line_that_differs_is_marked() -> None:
    """After the last of those that both have."""
    shown = list(compared_writes(["a", "b", "c", "d"], ["a", "b", "x"], "mine"))
    assert shown == ["    a", "    b", "  > retail: c", "    d", "  > mine: x"]


def test_one_may_have_nothing_more() -> None:
    """Where the other goes on."""
    assert list(compared_writes(["a"], ["a", "b"], "mine")) == [
        "    a",
        "  > retail: nothing more",
        "  > mine: b",
    ]


def test_equal_traces_are_told_to_be_equal() -> None:
    """The difference is then in what is not traced."""
    assert list(compared_writes(["a"], ["a"], "mine")) == ["    a", "    both write the same"]
    assert list(compared_writes([], [], "mine")) == ["    both write the same"]


def test_an_excerpt_stays_short() -> None:
    """However much is written."""
    shown = list(compared_writes(numbered(1, 500), [*numbered(1, 200), *numbered(900, 999)], "mine"))
    assert len(shown) < MOST_LINES
    assert shown[0] == "    ... 194 lines of both"
    assert shown[7:9] == ["  > retail: line 201", "    line 202"]
    assert shown[-1] == "    ... 92 lines more"
    assert len(list(lone_writes(numbered(1, 500)))) < MOST_LINES


class Untraceable:
    """Answers as another candidate and cannot be traced."""

    name = "foreign"

    def __init__(self, other: Candidate) -> None:
        self._other = other

    def answer(self, query: Query) -> Outcome:
        """Ask the other."""
        return self._other.answer(query)


def wrong(query: Query, candidate: Candidate) -> list[Difference]:
    """Return where a candidate's answer is wrong."""
    truth, given = ORACLE.answer(query), candidate.answer(query)
    assert isinstance(truth, Result)
    assert isinstance(given, Result)
    return differences(truth.fields, given.fields, op=query.op, zero_signs="distinct")


def test_of_a_walk_the_writes_of_the_first_wrong_tick() -> None:
    """Those before are the same; the line that differs says which value the wrong one has written."""
    query, bug = CASES["walk-cellar-descent"].queries[0], make_candidate("bug:no-substep-reset")
    shown = excerpt(query, wrong(query, bug), ORACLE, bug, ("cp-write", "bsp"))
    assert len(shown) <= MOST_LINES
    assert shown[0] == "  writes in tick 1 (cp-write, bsp):"
    marked = [line for line in shown if line.startswith("  > ")]
    assert marked == [
        "  > retail: [cp-write] ContactPlaneValid: 1 -> 0 caller=find_transitional_position",
        "  > bug:no-substep-reset: [bsp] Call: K -> OK caller=find_env_collisions",
    ]


def test_of_a_call_all_of_its_writes() -> None:
    """The plane through the world's origin beside that of the floor."""
    query, bug = CASES["origin-step-down-touching"].queries[0], make_candidate("bug:cell-origin")
    shown = excerpt(query, wrong(query, bug), ORACLE, bug, ("cp-write",))
    plane = "[cp-write] ContactPlane: n=(0,0,0) D=0.000 -> n=(0,0,1)"
    assert shown == (
        "  writes (cp-write):",
        "    [cp-write] ContactPlaneValid: 0 -> 1 caller=step_sphere_down",
        f"  > retail: {plane} D=-94.000 caller=step_sphere_down",
        "    [cp-write] ContactPlaneCellId: 0x00000000 -> 0xA9B40151 caller=step_sphere_down",
        f"  > bug:cell-origin: {plane} D=-0.000 caller=step_sphere_down",
        "    [cp-write] ContactPlaneCellId: 0x00000000 -> 0xA9B40151 caller=step_sphere_down",
    )


def test_a_candidate_that_cannot_be_traced() -> None:
    """Retail's writes are shown alone."""
    query = CASES["origin-step-down-touching"].queries[0]
    foreign = Untraceable(make_candidate("bug:cell-origin"))
    shown = excerpt(query, wrong(query, foreign), ORACLE, foreign, ("cp-write",))
    assert shown[0] == "  retail's writes (cp-write); foreign shows none:"
    assert len(shown) == 4


def test_the_oracle_that_misses_a_pin_is_shown_alone() -> None:
    """There is nothing to compare it with."""
    query, bug = CASES["origin-step-down-touching"].queries[0], make_candidate("bug:cell-origin")
    shown = excerpt(query, wrong(query, bug), ORACLE, ORACLE, ("cp-write",))
    assert shown[0] == "  writes (cp-write):"
    assert not any(line.startswith("  > ") for line in shown)


def test_an_operation_that_calls_no_tree_has_no_writes() -> None:
    """A frame's matrix."""
    query = Query("frame_cache", {"rotation": [1.0, 0.0, 0.0, 0.0]})
    assert excerpt(query, (), ORACLE, ORACLE, ("cp-write",)) == ()


class Failing(OracleCandidate):
    """Fails when it is asked again."""

    def answer(self, query: Query) -> Outcome:
        """Fail."""
        return Errored(f"no {query.op}")


def test_who_fails_when_asked_again_is_not_shown() -> None:
    """Nor is anything made up."""
    query, bug = CASES["origin-step-down-touching"].queries[0], make_candidate("bug:cell-origin")
    shown = excerpt(query, wrong(query, bug), ORACLE, Failing(), ("cp-write",))
    assert shown[0] == "  retail's writes (cp-write); oracle shows none:"


def test_topics_are_read() -> None:
    """Separated by commas; a wrong one is refused with the nearest."""
    assert parse_topics("cp-write, bsp") == ("cp-write", "bsp")
    with pytest.raises(TopicsError, match=r"unknown topic 'cell-transits'\. Did you mean 'cell-transit'?"):
        parse_topics("bsp,cell-transits")
