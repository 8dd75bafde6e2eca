"""Drift: what becomes of a walk is measured as it is, and everyone walks the same course."""

from __future__ import annotations

import math
from typing import Any

import pytest

pytest.importorskip("flint", reason="the extra `exact` is not installed")

from conformance.scenes.algebra import add, round_point, scale, subtract
from conformance.strategies.human import RADIUS
from conformance.stress.courses import COURSES, ORIGIN, QUANTUM, SETTLED, up
from conformance.stress.drift import DriftSweep, checkpoints
from conformance.stress.findings import CANDIDATE, DIFFERING, RETAIL
from conformance.stress.gait import BELOW, Gait
from conformance.stress.models import Spec, make_models
from conformance.stress.moves import CENTER

STANDSTILL, TO_AND_FRO, CIRCLES, PUSH = COURSES
AT_REST = subtract(add(round_point(ORIGIN), scale(RADIUS, up())), CENTER)
"""Feet of a body that rests on the slope, metres."""
IN_CONTACT, IN_AIR = 0x83, 0x80


def tick(
    place: tuple[float, ...], *, velocity: tuple[float, ...] = (0.0, 0.0, 0.0), ts: int = IN_CONTACT
) -> Any:
    """Return a tick as a walk tells it."""
    return {"r": "moved", "pos": list(place), "v": list(velocity), "ts": ts}


def settled(course: Any) -> Gait:
    """Return a walk whose body has just come to rest."""
    gait = Gait(course)
    for _ in range(SETTLED + 1):
        gait.take(tick(AT_REST))
    return gait


def test_what_happens_before_a_body_has_settled_does_not_count() -> None:
    """It may fall as it likes."""
    gait = Gait(STANDSTILL)
    gait.take(tick((0.0, 0.0, -1000.0), ts=IN_AIR))
    assert gait.quantities() == {"ticks": 1.0}


def test_a_body_at_rest_is_off_by_rounding_only() -> None:
    """Height and place."""
    told = settled(STANDSTILL).quantities()
    assert told["height_metres"] < 1e-6
    assert (told["falls"], told["airborne"], told["stuck"]) == (0.0, 0.0, 0.0)


def test_a_fall_through_the_floor_is_counted() -> None:
    """Each tick below; a little below is a height error, not a fall."""
    gait = settled(STANDSTILL)
    gait.take(tick(add(AT_REST, scale(-0.9 * BELOW, up()))))
    assert gait.quantities()["falls"] == 0.0
    gait.take(tick(add(AT_REST, scale(-2.0 * BELOW, up())), ts=IN_AIR))
    told = gait.quantities()
    assert (told["falls"], told["airborne"]) == (1.0, 1.0)
    assert told["height_metres"] == pytest.approx(2.0 * BELOW, abs=1e-6)


@pytest.mark.parametrize("number", [math.nan, math.inf])
def test_a_body_that_is_nowhere_is_as_wrong_as_can_be(number: float) -> None:
    """Whatever comes after; the walk goes on."""
    for course in (STANDSTILL, CIRCLES):
        gait = settled(course)
        gait.take(tick((number, 0.0, number)))
        gait.take(tick(AT_REST, velocity=(number, 0.0, 0.0)))
        gait.take(tick(AT_REST))
        told = gait.quantities()
        assert not told["height_metres"] <= 1e9
        assert course.free == ("astray_metres" in told and math.isnan(told["astray_metres"]))
    gait = Gait(CIRCLES)
    for _ in range(SETTLED + 2):
        gait.take(tick((math.nan, 0.0, 0.0)))
    assert math.isnan(gait.quantities()["astray_metres"])


def test_a_body_that_should_walk_and_does_not_is_stuck() -> None:
    """A body that should stand is not."""
    assert settled(CIRCLES).quantities()["stuck"] == 1.0
    assert settled(STANDSTILL).quantities()["stuck"] == 0.0


def test_a_body_goes_astray_by_what_its_velocity_does_not_explain() -> None:
    """One metre a second is a thirtieth of a metre in a tick."""
    gait = settled(CIRCLES)
    gait.take(tick(add(AT_REST, (QUANTUM, 0.0, 0.0)), velocity=(1.0, 0.0, 0.0)))
    assert gait.quantities()["astray_metres"] < 1e-12
    gait.take(tick(AT_REST, velocity=(1.0, 0.0, 0.0)))
    assert gait.quantities()["astray_metres"] == pytest.approx(2.0 * QUANTUM)
    assert "astray_metres" not in settled(PUSH).quantities()


def test_no_two_rounds_of_a_walk_are_the_same() -> None:
    """Or it would repeat itself to the bit, and nothing could add up."""
    ticks = range(SETTLED, SETTLED + 600)
    for course in (TO_AND_FRO, CIRCLES):
        velocities = {tuple(course.tick(number)["set_velocity"]) for number in ticks}
        assert len(velocities) == (600 if course is CIRCLES else 20)


def test_walks_are_told_at_powers_of_ten() -> None:
    """After the body has settled, and at the end."""
    assert checkpoints(100_000) == [300, 1000, 3000, 10_000, 30_000, 100_000]
    assert checkpoints(200) == [200]


@pytest.mark.parametrize("course", COURSES, ids=lambda course: course.name)
def test_retail_and_the_engine_walk_the_same_way(course: Any) -> None:
    """For a few ticks after the body has settled; it stays on the slope."""
    said: list[str] = []
    found = DriftSweep(course, 160 * course.share).run(0, make_models(Spec("engine")), said.append)
    told = {reading.model: reading for reading in found.readings}
    assert found.differences == []
    assert told[CANDIDATE].severity == told[RETAIL].severity == 160.0
    assert told[CANDIDATE].quantities == {**told[RETAIL].quantities, DIFFERING: 0.0}
    assert told[RETAIL].quantities["height_metres"] < 1e-5
    assert told[RETAIL].quantities["falls"] == 0.0
    assert f"drift, {course.name}: retail, part 0, tick 0 of 160" in said
