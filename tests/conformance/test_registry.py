"""Candidates by name."""

from __future__ import annotations

import pytest

from conformance.candidates.known_bugs import list_bugs
from conformance.candidates.oracle_candidate import OracleCandidate
from conformance.candidates.registry import BUILT_IN, UnknownCandidateError, candidate_names, make_candidate


def test_the_oracle_is_made() -> None:
    """The name gives the class."""
    assert isinstance(make_candidate("oracle"), OracleCandidate)


@pytest.mark.parametrize("name", candidate_names())
def test_every_name_makes_a_candidate_of_that_name(name: str) -> None:
    """What is listed can be made, and calls itself so."""
    assert make_candidate(name).name == name


def test_every_bug_has_a_name() -> None:
    """``bug:`` and its id."""
    assert set(candidate_names()) == set(BUILT_IN) | {f"bug:{bug.id}" for bug in list_bugs()}


def test_an_unknown_name_is_an_error_that_helps() -> None:
    """It lists what there is and names the nearest."""
    with pytest.raises(UnknownCandidateError, match="Did you mean 'bug:cell-origin'") as caught:
        make_candidate("bug:cell-orgin")
    assert caught.value.known == candidate_names()
    assert caught.value.nearest == "bug:cell-origin"


def test_a_name_like_nothing_has_no_hint() -> None:
    """The list is still there."""
    with pytest.raises(UnknownCandidateError, match=r"'zzz'\. There are: engine, oracle, ") as caught:
        make_candidate("zzz")
    assert caught.value.nearest is None
