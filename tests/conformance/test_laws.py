"""Laws: retail keeps them, and for each there is a candidate, wrong on purpose, that does not."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import TYPE_CHECKING

import pytest
from hypothesis import settings

from conformance.bug_hunt import draw_queries
from conformance.candidates.oracle_candidate import OracleCandidate
from conformance.candidates.registry import make_candidate
from conformance.floats import next_float32
from conformance.laws.catalogue import LAWS
from conformance.laws.law import BrokenLawError, LawRun, explain, hold
from conformance.laws.renaming import SHIFT
from conformance.laws.signed_axes import HALF_TURN, MIRROR, QUARTER_TURN
from conformance.laws.splitting import RADIUS, flight
from conformance.laws.square import square_transitions
from conformance.loader import load_file
from conformance.profiles import CI, register
from conformance.query import Errored, Result, Skipped
from conformance.scenes.block_shifts import shifted_id
from conformance.scenes.model import Node

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator
    from pathlib import Path

    from conformance.query import Fields, Outcome, Query

EXAMPLES = 0.08
"""A few queries: the whole number is asked by the suite itself."""
MOST_DRAWS = 400
"""Of which one breaks a law; most do at once."""


class Faux(OracleCandidate):
    """Retail, but for one thing: what it is asked, or what it answers, is changed."""

    name = "faux"

    def __init__(
        self,
        asked: Callable[[Query], Query] = lambda query: query,
        answered: Callable[[Query, Fields], Fields] = lambda _, fields: fields,
    ) -> None:
        self._asked, self._answered = asked, answered

    def answer(self, query: Query) -> Outcome:
        """Answer what was made of the query, and change the answer."""
        outcome = super().answer(self._asked(query))
        if isinstance(outcome, Result):
            return Result(self._answered(query, dict(outcome.fields)))
        return outcome


def at_home_only(query: Query, fields: Fields) -> Fields:
    """Compute with coordinates of the whole map: anywhere but in one landblock a bit is lost."""
    lost = query.inputs["to"]["cell"] >> 16 != 0xA9B4
    interp = fields["walk_interp"]
    return {**fields, "walk_interp": next_float32(interp) if lost else interp}


def first_number(query: Query, fields: Fields) -> Fields:
    """Note the polygon with the lowest number instead of the one that was found."""
    del query
    return {**fields, "walkable": None if fields["walkable"] is None else 0}


def by_the_root(query: Query) -> Query:
    """Look on one side of the root only: behind it."""
    shapes = {
        name: replace(shape, tree=shape.tree.negative if isinstance(shape.tree, Node) else shape.tree)
        for name, shape in query.geometries.items()
    }
    return replace(query, geometries=shapes)


def everywhere(query: Query) -> Query:
    """Look into every cell that is loaded, whether a portal leads there or not."""
    if "cells" not in query.inputs:
        return query
    first, *others = query.inputs["cells"]
    cells = [{**first, "portals": [cell["id"] for cell in others]}, *others] if others else [first]
    return replace(query, inputs={**query.inputs, "cells": cells})


def never_west(query: Query, fields: Fields) -> Fields:
    """Lose the sign of a position's x."""
    del query
    x, *rest = fields["check"]["origin"]
    return {**fields, "check": {**fields["check"], "origin": [abs(x), *rest]}}


def east_is_far(query: Query, fields: Fields) -> Fields:
    """Stretch x, and x alone."""
    del query
    x, *rest = fields["check"]["origin"]
    return {**fields, "check": {**fields["check"], "origin": [2.0 * x, *rest]}}


def one_step_short(query: Query, fields: Fields) -> Fields:
    """Leave out the last step of a move."""
    start, end = query.inputs["from"]["origin"], query.inputs["to"]["origin"]
    steps = max(1, math.ceil(math.dist(start, end) / RADIUS))
    reached = [a + (b - a) * (steps - 1) / steps for a, b in zip(start, end, strict=True)]
    return {**fields, "curr": {**fields["curr"], "origin": reached}}


def drifting(query: Query, fields: Fields) -> Fields:
    """Lose a bit with every move."""
    del query
    x, *rest = fields["curr"]["origin"]
    return {**fields, "curr": {**fields["curr"], "origin": [next_float32(x), *rest]}}


BREAKERS = {
    "another landblock": Faux(answered=at_home_only),
    "renumbered": Faux(answered=first_number),
    "refined tree": Faux(asked=by_the_root),
    "lonely cell": Faux(asked=everywhere),
    "quarter turn": Faux(answered=east_is_far),
    "half turn": Faux(answered=never_west),
    "mirror": Faux(answered=never_west),
    "translation": make_candidate("bug:cell-origin"),
    "halved exactly": Faux(answered=drifting),
    "halved": Faux(answered=one_step_short),
}


@pytest.fixture(autouse=True, scope="module")
def profile() -> Iterator[None]:
    """Draw the same queries in every run, however slow the machine is."""
    before = settings.get_current_profile_name()
    register()
    settings.load_profile(CI)
    yield
    settings.load_profile(before)


def fields_of(query: Query) -> Fields:
    """Return retail's answer to a query that has one."""
    outcome = OracleCandidate().answer(query)
    assert isinstance(outcome, Result)
    return outcome.fields


@pytest.mark.parametrize("name", LAWS)
def test_retail_keeps_the_law(name: str) -> None:
    """The oracle's answers belong together as the law says."""
    run = LawRun()
    hold(LAWS[name], OracleCandidate(), run, multiple=EXAMPLES)
    assert run.compared > 0
    assert not run.skipped


@pytest.mark.parametrize("name", LAWS)
def test_the_law_can_fail(name: str) -> None:
    """A candidate that is wrong in what the law is about breaks it; what breaks it is not shrunk here."""
    law, candidate = LAWS[name], BREAKERS[name]

    def ask(query: Query) -> Fields:
        outcome = candidate.answer(query)
        assert isinstance(outcome, Result)
        return outcome.fields

    def once(query: Query, _: int) -> None:
        if broken := law.breach(query, ask):
            raise BrokenLawError(broken)

    with pytest.raises(BrokenLawError):
        draw_queries(law.queries, MOST_DRAWS, once)


def test_the_suite_asks_enough_to_see_planes_in_cell_space(tmp_path: Path) -> None:
    """They break the law of translation; what was asked is kept, and retail answers some of it otherwise."""
    candidate, run = make_candidate("bug:cell-origin"), LawRun()
    with pytest.raises(BrokenLawError, match=r"^translation: contact_plane\.d: ") as caught:
        hold(LAWS["translation"], candidate, run)
    broken, *told = explain(run, tmp_path, candidate, broken=str(caught.value), profile=CI).splitlines()
    assert broken == str(caught.value)
    kept = [case.queries[0] for path in tmp_path.iterdir() for case in load_file(path).cases]
    assert len(kept) == len(run.breaking) == 2
    assert [line.partition(": ")[0] for line in told if line] == [
        *("  question 1", "  against retail"),
        *("  question 2", "  against retail"),
    ]
    assert [OracleCandidate().answer(query) == candidate.answer(query) for query in kept].count(False) > 0


def test_a_placement_has_a_north() -> None:
    """Room is looked for in compass order: retail itself does not keep the mirror's law there."""

    def once(query: Query, _: int) -> None:
        placement = replace(query, inputs={**query.inputs, "from": None})
        if broken := LAWS["mirror"].breach(placement, fields_of):
            raise BrokenLawError(broken)

    with pytest.raises(BrokenLawError):
        draw_queries(square_transitions(), MOST_DRAWS, once)


def test_every_law_says_when_it_holds() -> None:
    """Each docstring gives the exact condition."""
    for law in LAWS.values():
        assert "Condition: " in (law.breach.__doc__ or "")


def test_a_turn_four_times_is_none() -> None:
    """The maps of the axes are what they are called."""
    point = [1.0, 2.0, 3.0]
    assert QUARTER_TURN(point) == [-2.0, 1.0, 3.0]
    assert QUARTER_TURN(QUARTER_TURN(point)) == HALF_TURN(point)
    assert MIRROR(MIRROR(point)) == point
    assert (QUARTER_TURN.mirrors, HALF_TURN.mirrors, MIRROR.mirrors) == (False, False, True)


def test_a_mirrored_face_still_looks_out() -> None:
    """The corners are listed the other way round, so that the normal is mirrored, and no more."""
    from conformance.scenes.bsp_builder import TreeStyle, build
    from conformance.scenes.planes import unit_normal
    from conformance.scenes.primitives import make

    box = build("box", make("box", {"size": (2.0, 1.5, 0.5)}), style=TreeStyle.FRONT, kind="box")
    query = replace(flight((0, 0, 0), (1, 0, 0)), geometries={"box": box})
    mirrored = MIRROR.query(query).geometries["box"]
    for number in range(len(box.polygons)):
        assert list(unit_normal(mirrored.corners(number))) == MIRROR(unit_normal(box.corners(number)))


def test_a_candidate_that_skips_is_counted() -> None:
    """What is not answered is a reason to skip, not a law kept."""

    class Idle(OracleCandidate):
        name = "idle"

        def answer(self, query: Query) -> Outcome:
            return Skipped("idle")

    run = LawRun()
    hold(LAWS["halved"], Idle(), run, multiple=EXAMPLES)
    assert run.compared == 0
    assert run.counts()["skipped"]["idle: idle"] > 0


def test_a_candidate_that_fails_breaks_the_law() -> None:
    """An error is told with the law that was asked about."""

    class Failing(OracleCandidate):
        name = "failing"

        def answer(self, query: Query) -> Outcome:
            return Errored("boom")

    with pytest.raises(BrokenLawError, match="halved exactly: failing failed: boom"):
        hold(LAWS["halved exactly"], Failing(), LawRun(), multiple=EXAMPLES)


def test_the_shift_leaves_the_map_alone() -> None:
    """A cell in the middle of the map is shifted by whole landblocks, and its low word stays."""
    assert shifted_id(0xA9B40151, SHIFT) == 0xAAB30151
