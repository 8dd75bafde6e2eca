"""Error measures: lengths, angles, float32 steps, flips, and their summary."""

from __future__ import annotations

import math
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

pytest.importorskip("flint", reason="the extra `exact` is not installed")

from conformance.exact.candidate import ExactAnswer
from conformance.exact.errors import ErrorSample, angle_between, errors, field_errors, float32_step
from conformance.exact.summary import ErrorSummary
from conformance.exact.survey import Survey
from conformance.query import Errored, Query, Result, Skipped

POSE = {"cell": 1, "origin": [1.0, 2.0, 3.0], "rotation": [1.0, 0.0, 0.0, 0.0]}
STATE = {
    "result": "OK",
    "trace": "K",
    "check": POSE,
    "curr": POSE,
    "check_cell": 1,
    "curr_cell": 1,
    "contact_plane": {"valid": 1, "plane": [0.0, 0.0, 1.0, -64.0], "cell_id": 1, "is_water": 0},
    "walkable": 3,
}


def state(**changed: Any) -> dict[str, Any]:
    """Return a state block with some fields changed."""
    return {**STATE, **changed}


def plane(x: float, y: float, z: float, d: float) -> dict[str, Any]:
    """Return a contact plane's block."""
    return {**STATE["contact_plane"], "plane": [x, y, z, d]}  # type: ignore[dict-item]


def test_an_answer_has_no_error_against_itself() -> None:
    """All measures are zero, no decision differs."""
    assert field_errors(STATE, STATE) == ErrorSample(0.0, 0.0, 0.0, 0.0, 0.0)


def test_the_plane_is_measured_in_metres_and_float32_steps() -> None:
    """At 64 metres float32s are 2^-17 apart; a fraction of a step is a fraction."""
    step = 2.0**-17
    sample = field_errors(state(contact_plane=plane(0.0, 0.0, 1.0, -64.0 - 1.5 * step)), STATE)
    assert (sample.contact_metres, sample.contact_ulps) == (1.5 * step, 1.5)
    assert float32_step(-64.0) == step
    through_zero = field_errors(
        state(contact_plane=plane(0.0, 0.0, 1.0, 2.0**-20)), state(contact_plane=plane(0.0, 0.0, 1.0, 0.0))
    )
    assert through_zero.contact_ulps == 8.0  # steps of one metre, 2^-23
    assert float32_step(0.0) == 2.0**-149


def test_the_normal_is_measured_as_an_angle() -> None:
    """Also where the cosine would be 1 to the last bit."""
    small = 2.0**-40
    sample = field_errors(state(contact_plane=plane(small, 0.0, 1.0, -64.0)), STATE)
    assert sample.normal_radians == small
    assert angle_between((1.0, 0.0, 0.0), (0.0, 2.0, 0.0)) == math.pi / 2


def test_the_position_is_the_larger_of_current_and_check() -> None:
    """Metres, along the straight line."""
    moved = {**POSE, "origin": [4.0, 6.0, 3.0]}
    sample = field_errors(state(check=moved), STATE)
    assert (sample.position_metres, sample.largest) == (5.0, 4.0)


def test_a_vector_without_length_has_no_angle() -> None:
    """Not 0, as if it were right; but to itself."""
    assert math.isnan(angle_between((0.0, 0.0, 0.0), (0.0, 0.0, 1.0)))
    assert math.isnan(angle_between((0.0, 0.0, 1.0), (0.0, 0.0, 0.0)))
    assert angle_between((0.0, 0.0, 0.0), (0.0, 0.0, -0.0)) == 0.0


@pytest.mark.parametrize("number", [math.nan, math.inf])
@pytest.mark.parametrize("place", ["check", "curr"])
def test_what_is_no_number_is_as_wrong_as_can_be(number: float, place: str) -> None:
    """Wherever it stands, beside numbers that are right; in an answer that should have it, it is right."""
    lost = state(**{place: {**POSE, "origin": [1.0, number, 3.0]}})
    sample = field_errors(lost, STATE)
    for error in (sample.position_metres, sample.largest):
        assert error == pytest.approx(number, nan_ok=True)
    assert field_errors(lost, lost).largest == 0.0
    ticks = [{"r": 1, "pos": [0.0, 0.0, z]} for z in (0.0, number, 5.0)]
    walk = field_errors({"ticks": ticks}, {"ticks": [{"r": 1, "pos": [0.0, 0.0, 0.0]}] * 3})
    assert walk.position_metres == pytest.approx(number, nan_ok=True)


@pytest.mark.parametrize(
    ("changed", "flips"),
    [
        ({"result": "COLLIDED"}, ("result",)),
        ({"walkable": None}, ("walkable",)),
        ({"curr_cell": 2, "check_cell": 2}, ("check_cell", "curr_cell")),
        ({"contact_plane": {"valid": 0}}, ("contact_plane",)),
        ({"trace": "KD"}, ()),
    ],
)
def test_flips_are_decisions_that_differ(changed: dict[str, Any], flips: tuple[str, ...]) -> None:
    """Lengths are told only without one; another path to the same answer is none."""
    sample = field_errors(state(**changed), STATE)
    assert sample.flips == flips
    assert (sample.position_metres is None) == bool(flips)
    assert sample.other_path == (not flips)


def test_single_calls_flip_in_what_is_no_number() -> None:
    """Numbers differ by errors, flags, ids and null by decision."""
    exact = {"r": 1, "center": [0.0, 0.0, 1.0], "walk_interp": 0.5}
    assert field_errors({**exact, "walk_interp": 0.25}, exact) == ErrorSample(largest=0.25)
    assert field_errors({**exact, "r": 0}, exact).flips == ("r",)
    assert field_errors({**exact, "center": None}, exact).flips == ("center",)


def test_walks_are_measured_until_a_tick_decides_otherwise() -> None:
    """The largest error of the ticks; or the first tick that flips, and no length."""
    ticks = [{"r": 1, "t": "K", "pos": [float(i), 0.0, 0.0], "cp": [0.0, 0.0, 1.0, 2.0]} for i in range(3)]
    drifted = [{**tick, "pos": [tick["pos"][0], 0.125 * i, 0.0]} for i, tick in enumerate(ticks)]  # type: ignore[index]
    assert field_errors({"ticks": drifted}, {"ticks": ticks}).position_metres == 0.25
    skipping = [ticks[0], {"r": "skip"}, {**ticks[2], "r": 0}]
    sample = field_errors({"ticks": skipping}, {"ticks": ticks})
    assert sample == ErrorSample(flips=("tick 1: r",))


def test_what_is_no_answer_is_not_measured() -> None:
    """Neither a skipped query nor a failed one."""
    assert errors(Skipped("no"), Result(STATE)) is None
    assert errors(Result(STATE), Errored("no")) is None
    assert errors(Result(STATE), Result(STATE)) == field_errors(STATE, STATE)


@given(values=st.lists(st.floats(0.0, 1e3), min_size=1, max_size=50))
def test_spread(values: list[float]) -> None:
    """The median, and the query of the largest."""
    summary = ErrorSummary()
    queries = [Query("fly", {"n": value}) for value in values]
    for value, query in zip(values, queries, strict=True):
        summary.add(ErrorSample(position_metres=value), query)
    spread = summary.spread("position_metres")
    assert spread is not None
    assert spread.count == len(values)
    assert spread.worst.inputs["n"] == spread.largest == max(values)
    assert sorted(values)[(len(values) - 1) // 2] <= spread.median <= sorted(values)[len(values) // 2]
    assert spread.median <= spread.p99 <= spread.largest
    assert summary.spread("contact_metres") is None


def test_flips_are_counted_by_decision() -> None:
    """The rate is of queries; a tick's number is left out of the decision's name."""
    summary = ErrorSummary()
    assert math.isnan(summary.flip_rate)
    for flips in ((), ("result", "walkable"), ("tick 4: walkable",), ()):
        summary.add(ErrorSample(flips=flips, other_path=not flips), Query("fly", {}))
    assert summary.other_paths == 2
    assert summary.flips == {"result": 1, "walkable": 2}
    assert (summary.flipped, summary.flip_rate) == (2, 0.5)


class Fixed:
    """Stands for the exact model: answers as it is told."""

    name = "exact"

    def __init__(self, *answers: ExactAnswer) -> None:
        self.answers = iter(answers)

    def perform(self, _query: Query) -> ExactAnswer:
        """Return the next answer."""
        return next(self.answers)


def test_survey() -> None:
    """Every query is counted once: answered, undecided, or not answered for another reason."""
    exact = Fixed(
        ExactAnswer(Result(STATE), 128, 1, 2),
        ExactAnswer(Skipped("undecided: 0 against 0"), 1024, 4, 0),
        ExactAnswer(Errored("broken"), 128, 1, 0),
    )
    survey = Survey({"other": lambda _query: Result(state(walkable=4))}, exact)  # type: ignore[arg-type]
    for label in "abc":
        survey.ask(Query("fly", {}, label=label))
    assert (survey.asked, survey.tied, survey.precisions) == (3, 1, {128: 2, 1024: 1})
    assert [query.label for query in survey.undecided] == ["b"]
    assert survey.unanswered == {"broken": 1}
    assert survey.summaries["other"].flips == {"walkable": 1}
    assert survey.seconds.keys() == {"other", "exact"}
