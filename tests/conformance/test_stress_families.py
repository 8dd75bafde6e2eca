"""The families of stress: what they ask is what they say, and the candidate answers as retail does."""

from __future__ import annotations

import itertools
import math
from typing import Any

import pytest

pytest.importorskip("flint", reason="the extra `exact` is not installed")

from conformance.candidates.engine_candidate import EngineCandidate
from conformance.candidates.oracle_candidate import OracleCandidate
from conformance.query import Result
from conformance.stress import degenerate, rotation, scaling, translation
from conformance.stress.asking import ErrorSweep
from conformance.stress.comparisons import COMPARISONS, Comparison
from conformance.stress.families import FAMILIES
from conformance.stress.findings import CANDIDATE, DIFFERING, RETAIL, Findings
from conformance.stress.models import Spec, make_models
from conformance.stress.moves import furnished_room, room_moves
from conformance.stress.settings import Settings, full, quick
from conformance.stress.standing import difference
from conformance.stress.steps import turning_point
from conformance.stress.thresholds import ThresholdSweep

TINY = Settings(seed=5, probes=2, grid=4, ticks=150, quick=True)
ENGINE, ORACLE = EngineCandidate(), OracleCandidate()
ERROR_FAMILIES = (translation.FAMILY, rotation.FAMILY, degenerate.FAMILY, scaling.FAMILY)


def answer(query: Any) -> Any:
    """Return the fields of the oracle's answer."""
    outcome = ORACLE.answer(query)
    assert isinstance(outcome, Result)
    return outcome.fields


def test_every_family_has_sweeps_of_different_names() -> None:
    """And sweeps know their family."""
    for name, make in FAMILIES.items():
        sweeps = make(TINY)
        assert {sweep.family for sweep in sweeps} == {name}
        assert len({sweep.name for sweep in sweeps}) == len(sweeps) > 0
        assert all(sweep.parts > 0 and sweep.axis for sweep in sweeps)


def test_a_quick_run_asks_less_but_goes_as_far() -> None:
    """First and last severity are those of a whole run; only long compositions are left out."""
    for name in ERROR_FAMILIES:
        for small, large in zip(FAMILIES[name](quick()), FAMILIES[name](full()), strict=False):
            assert isinstance(small, ErrorSweep)
            assert isinstance(large, ErrorSweep)
            assert len(small.severities) < len(large.severities)
            assert all(a < b for a, b in itertools.pairwise(large.severities))
            if small.name == large.name != "compositions":
                assert (small.severities[0], small.severities[-1]) == (
                    large.severities[0],
                    large.severities[-1],
                )


@pytest.mark.parametrize("family", ERROR_FAMILIES)
def test_the_engine_is_retail_at_every_severity(family: str) -> None:
    """One query of each, at both ends and between."""
    for sweep in FAMILIES[family](TINY):
        assert isinstance(sweep, ErrorSweep)
        for severity in (sweep.severities[0], sweep.severities[1], sweep.severities[-1]):
            probe = next(iter(sweep.probes(severity)))
            asked = ORACLE.answer(probe.query), ENGINE.answer(probe.query)
            assert difference(*asked, probe.query.op, "engine") is None, (sweep.name, severity)


def test_a_severity_measures_everyone_and_the_candidate_twice() -> None:
    """Against exact as all others, and against retail."""
    sweep = translation.sweeps(TINY)[0]
    found = sweep.run(0, make_models(Spec("engine")), lambda _: None)
    by_model = {reading.model: reading.quantities for reading in found.readings}
    assert by_model.keys() == {RETAIL, "single", "double", CANDIDATE}
    assert by_model[CANDIDATE] == {**by_model[RETAIL], DIFFERING: 0.0}
    assert by_model["double"]["contact_metres"] < 1e-12 < by_model[RETAIL]["contact_metres"] < 1e-6


def test_a_candidate_that_differs_is_told_with_its_own_errors() -> None:
    """A plane without the cell's origin is as far off as the cell is out."""
    sweep = translation.sweeps(TINY)[0]
    found: Findings = sweep.run(3, make_models(Spec("bug:cell-origin")), lambda _: None)
    told = {reading.model: reading.quantities for reading in found.readings}
    assert told[CANDIDATE][DIFFERING] > 0.0
    assert found.differences
    assert "bug:cell-origin" in found.differences[0]


def test_moves_are_the_same_for_a_seed_and_more_begin_with_fewer() -> None:
    """So a quick run asks a part of what a whole one asks."""
    geometry = furnished_room()
    few, many = list(room_moves(geometry, 3, 4)), list(room_moves(geometry, 3, 9))
    assert many[:4] == few
    assert few != list(room_moves(geometry, 4, 4))


def test_most_moves_end_in_contact() -> None:
    """Otherwise there would be no plane to measure."""
    sweep = translation.sweeps(Settings(seed=5, probes=12, grid=4, ticks=150, quick=True))[0]
    valid = [answer(probe.query)["contact_plane"]["valid"] for probe in sweep.probes(0.0)]
    assert sum(valid) >= 10


@pytest.mark.parametrize("size", [0.5, 1.0, 4.0])
def test_a_scaled_part_at_the_origin_has_its_true_plane_and_farther_out_the_formula(size: float) -> None:
    """Retail is off by (1 - s)(n . O) and by nothing else."""
    (sweep,) = (s for s in scaling.sweeps(full()) if s.name == f"scale {size:g}")
    for distance in (0.0, 100.0, 10_000.0):
        probe = next(iter(sweep.probes(distance)))
        assert probe.watch is not None
        told = probe.watch(answer(probe.query))
        rounding = 4.0 * size * 2.0**-24 * max(distance, 1.0)
        assert told["formula_metres"] <= rounding
        expected = abs(1.0 - size) * distance
        assert 0.5 * expected <= told["plane_off_metres"] <= expected + rounding


def test_a_rotation_is_as_far_off_as_it_was_made() -> None:
    """Length, noise, float32 pi and compositions."""
    lengths, turns, quarters, noise = rotation.sweeps(full())
    too_long = next(iter(lengths.probes(1e-4)))
    assert too_long.watch is not None
    assert too_long.watch(answer(too_long.query))["stretched"] == pytest.approx(2e-4, rel=0.01)
    once = next(iter(turns.probes(1.0)))
    assert once.watch is not None
    assert once.watch(answer(once.query))["turned_radians"] < 1e-6
    many = next(iter(quarters.probes(1e6)))
    assert many.watch is not None
    # Float32 pi is 8.7e-8 too large, and the product is rounded to a step of an eighth.
    assert many.watch(answer(many.query))["turned_radians"] < 0.125 / 2 + 1e6 * 8.8e-8 / 2
    noisy = next(iter(noise.probes(1000.0)))
    assert noisy.watch is not None
    assert 1e-6 < noisy.watch(answer(noisy.query))["turned_radians"] < 2e-4


@pytest.mark.parametrize("comparison", COMPARISONS, ids=lambda comparison: comparison.name)
def test_a_comparison_turns_between_its_ends(comparison: Comparison) -> None:
    """Retail's decision is another at either end, and turns once at least."""
    low, high = comparison.between
    turn = turning_point(
        low, high, lambda value: comparison.decide(answer(comparison.query(value, comparison.beside)))
    )
    assert min(low, high) < turn < max(low, high)


def test_a_square_is_drawn_about_the_exact_turn() -> None:
    """To its left one decision, to its right the other; the engine is asked at every point."""
    (comparison,) = (c for c in COMPARISONS if c.name == "frames equal within EPS")
    found = ThresholdSweep(comparison, 4).run(0, make_models(Spec("engine")), lambda _: None)
    (picture,) = found.pictures
    assert picture.signs[2] == (3, 3, 0, 0)
    whole = [reading for reading in found.readings if "band_steps" in reading.quantities]
    assert {reading.quantities["answers"] for reading in whole} == {16.0}
    assert [r.quantities[DIFFERING] for r in found.readings if r.model == CANDIDATE] == [0.0] * 5


def test_a_polygon_without_area_has_no_plane_and_hits_everything() -> None:
    """Its NaN fails retail's test for being too far away: a floor nearby is never reached."""
    plain, broken = (
        next(iter(sweep.probes(severity)))
        for sweep in degenerate.sweeps(full())
        if sweep.name == "no area"
        for severity in (0.0, 1.0)
    )
    assert not math.isnan(answer(plain.query)["contact_plane"]["plane"][3])
    assert answer(plain.query)["trace"] != answer(broken.query)["trace"]
