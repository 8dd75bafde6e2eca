"""The list of comparisons: it is complete, and every square asks on both sides of what it is listed for."""

from __future__ import annotations

import ast
from pathlib import Path
from typing import TYPE_CHECKING

import pytest
from seen_comparisons import seen

from conformance.candidates.oracle_candidate import OracleCandidate
from conformance.query import Result
from conformance.stress.comparisons import COMPARISONS
from conformance.stress.comparisons.ledger import Reason, entries
from conformance.stress.comparisons.page import page
from conformance.stress.comparisons.sites import Site, compared, comparisons_in
from conformance.stress.steps import stepped, turning_point
from conformance.stress.thresholds import TOLD

if TYPE_CHECKING:
    from conformance.stress.comparisons.base import Comparison

DOCS = Path(__file__).parents[2] / "docs"
ORACLE = OracleCandidate()
NAMED = {comparison.name: comparison for comparison in COMPARISONS}
LISTED = dict(entries())
SQUARES = [(site, entry) for site, entry in LISTED.items() if isinstance(entry, str)]


def decided(comparison: Comparison, value: float) -> bool:
    """Return retail's decision at a value."""
    outcome = ORACLE.answer(comparison.query(value, comparison.beside))
    assert isinstance(outcome, Result), outcome
    return comparison.decide(outcome.fields)


def test_every_comparison_of_the_oracle_is_listed() -> None:
    """And no other: a new comparison needs a square or a reason, one that has gone must be struck out."""
    assert len(compared()) > 80
    assert [str(site) for site in set(LISTED) ^ set(compared())] == []


def test_every_square_that_is_listed_is_drawn() -> None:
    """By its name; names are unique."""
    assert len(NAMED) == len(COMPARISONS)
    assert {name for _, name in SQUARES} <= set(NAMED)
    assert len(SQUARES) > 50


@pytest.mark.parametrize(("site", "name"), SQUARES, ids=[str(site) for site, _ in SQUARES])
def test_a_square_asks_on_both_sides(site: Site, name: str) -> None:
    """At 8, 2, 1 and no steps from the turn the comparison is made, and says yes here, no there."""
    comparison = NAMED[name]
    turn = turning_point(*comparison.between, lambda value: decided(comparison, value))
    said = []
    for column in TOLD:
        with seen(site) as outcomes:
            decided(comparison, stepped(turn, column))
        said.append(tuple(outcomes))
    assert all(said)
    assert {outcomes for outcomes in said if outcomes == said[0]} != set(said)


def test_reasons_are_given_in_words() -> None:
    """Each has a kind, and a text of its own."""
    reasons = [entry for entry in LISTED.values() if isinstance(entry, Reason)]
    assert len(reasons) > 20
    assert all(len(reason.text) > 10 or reason.kind.value == "whole numbers" for reason in reasons)


def test_comparisons_are_found_by_their_operands() -> None:
    """Of numbers; not those with an integer or a member of an enumeration, nor tests of identity."""
    source = "def f(a, b):\n    if a < b or a < b: pass\n    return a is b, a == 0, b != State.OK, a <= 1.0\n"
    function = ast.parse(source).body[0]
    assert isinstance(function, ast.FunctionDef)
    assert [text for text, _ in comparisons_in(function)] == ["a < b", "a < b #2", "a <= 1.0"]


def test_the_page_is_as_it_is_written() -> None:
    """``conformance stress --comparisons`` prints it."""
    assert DOCS.joinpath("numerics-comparisons.md").read_text(encoding="utf-8") == page()
