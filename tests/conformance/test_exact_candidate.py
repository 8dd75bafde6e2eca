"""The exact candidate: closed forms worked out by fractions, decisions, precision, and what it tells."""

from __future__ import annotations

import math
from fractions import Fraction
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest

pytest.importorskip("flint", reason="the extra `exact` is not installed")

from flint import ctx

import conformance
from conformance.candidates.model_candidate import double, single
from conformance.candidates.oracle_candidate import OracleCandidate
from conformance.compare import differences
from conformance.exact.candidate import LADDER, ExactCandidate
from conformance.fields import outputs_of
from conformance.floats import is_float32, to_float32
from conformance.query import Query, Result, Skipped
from conformance.scenes.model import Geometry, Leaf, Polygon
from conformance.vector_io import VectorRecord, read_vectors
from conformance.vector_library import Library
from oracle.constants import EPS

if TYPE_CHECKING:
    from collections.abc import Sequence

VECTORS = Path(conformance.__file__).parent / "vectors"
RECORDS = 12
"""Records of a file that are asked: the exact model is some ten times slower than the oracle."""
ROOM = (0.0, 0.0, 0.0, 10.0)
"""A bounding sphere that is as large as the geometries."""


def ramp(*corners: Sequence[float]) -> Geometry:
    """Return a single polygon in a single leaf."""
    polygon = Polygon(tuple(range(len(corners))), 0)
    return Geometry("ramp", tuple(map(tuple, corners)), (polygon,), Leaf(0, False, ROOM, (0,)))  # type: ignore[arg-type]


def exactly(op: str, geometry: Geometry, **inputs: Any) -> dict[str, Any]:
    """Return the exact answer about polygon 0."""
    query = Query(op, {"geometry": geometry.name, "poly": 0, **inputs}, {geometry.name: geometry})
    outcome = ExactCandidate().unrounded(query)
    assert isinstance(outcome, Result)
    return outcome.fields


def records(name: str, count: int) -> list[VectorRecord]:
    """Return the first records of a vector file."""
    found = []
    for record in read_vectors(VECTORS / name, Library(VECTORS)):
        assert isinstance(record, VectorRecord)
        found.append(record)
        if len(found) == count:
            return found
    raise AssertionError(f"{name} has less than {count} records")


def test_a_sphere_on_a_ramp_is_where_fractions_say() -> None:
    """A 3-4-5 ramp: plane, time and centre are rational, and every one of them is the nearest double.

    The ramp rises by 3 over 4, so its normal is (-3, 0, 4) / 5. A sphere whose centre came down by 2 to the
    ramp itself is put back by the fraction radius / (8/5) of that movement.
    """
    geometry = ramp((-4.0, -5.0, -3.0), (4.0, -5.0, 3.0), (4.0, 5.0, 3.0), (-4.0, 5.0, -3.0))
    radius = to_float32(0.3)
    assert exactly("polygon_make_plane", geometry)["plane"] == [-0.6, 0.0, 0.8, 0.0]
    told = exactly(
        "polygon_adjust_sphere_to_plane",
        geometry,
        sphere=[0.0, 0.0, 0.0, radius],
        movement=[0.0, 0.0, -2.0],
        walk_interp=1.0,
    )
    time = Fraction(radius) / Fraction(8, 5)
    assert told == {"r": 1, "center": [0.0, 0.0, float(2 * time)], "walk_interp": float(1 - time)}


def test_a_tie_is_decided_as_retail_would_without_rounding() -> None:
    """What is exactly on a ramp with an irrational normal: distance 0 against radius 0."""
    geometry = ramp((-1.0, -5.0, -2.0), (1.0, -5.0, 2.0), (1.0, 5.0, 2.0), (-1.0, 5.0, -2.0))
    rests = {"movement": [0.0, 0.0, -1.0], "walk_interp": 1.0}
    told = exactly("polygon_adjust_sphere_to_plane", geometry, sphere=[0.5, 0.0, 1.0, 0.0], **rests)
    assert told["r"] == 0  # already there: the fraction is not less than it was (02 AS-4)
    inside = exactly("polygon_hits_sphere_slow", geometry, sphere=[0.5, 0.0, 1.0, EPS])
    assert inside["r"] == 1  # reach 0, distance 0: not less than the distance (02 SS-1)


def test_a_tie_is_counted_and_asked_with_more_precision_if_needed() -> None:
    """Beginning with 64 bits costs a second run; what it tells is the same."""
    geometry = ramp((-1.0, -5.0, -2.0), (1.0, -5.0, 2.0), (1.0, 5.0, 2.0), (-1.0, 5.0, -2.0))
    inputs = {"geometry": "ramp", "poly": 0, "sphere": [0.5, 0.0, 1.0, 0.0]}
    inputs |= {"movement": [0.0, 0.0, -1.0], "walk_interp": 1.0}
    query = Query("polygon_adjust_sphere_to_plane", inputs, {"ramp": geometry})
    once, twice = ExactCandidate().perform(query), ExactCandidate((64, *LADDER)).perform(query)
    assert (once.precision, once.runs, once.ties > 0) == (128, 1, True)
    assert (twice.precision, twice.runs) == (128, 2)
    assert once.outcome == twice.outcome


def test_what_no_precision_decides_is_skipped_by_name() -> None:
    """With 64 bits only, a tie stays open: the outcome says so, and the library's precision is restored."""
    geometry = ramp((-1.0, -5.0, -2.0), (1.0, -5.0, 2.0), (1.0, 5.0, 2.0), (-1.0, 5.0, -2.0))
    inputs = {"geometry": "ramp", "poly": 0, "sphere": [0.5, 0.0, 1.0, EPS]}
    before = ctx.prec
    outcome = ExactCandidate((64,)).answer(Query("polygon_hits_sphere_slow", inputs, {"ramp": geometry}))
    assert isinstance(outcome, Skipped)
    assert outcome.reason.startswith("undecided: ")
    assert ctx.prec == before


@pytest.mark.parametrize("name", ["math.jsonl", "polygon.jsonl", "bsp.jsonl", "find_collisions.jsonl"])
def test_models_answer_what_the_oracle_answers(name: str) -> None:
    """Every model tells the fields that the record has; numbers are float32s close to retail's."""
    for record in records(name, RECORDS):
        query = record.query
        for candidate in (single(), double(), ExactCandidate()):
            outcome = candidate.answer(query)
            assert isinstance(outcome, Result), outcome
            assert set(outcome.fields) <= set(outputs_of(query.op).fields)
            for difference in differences(record.expected, outcome.fields, op=query.op, zero_signs="equal"):
                if isinstance(difference.candidate, float):
                    assert is_float32(difference.candidate)


def test_the_oracle_is_itself_again_after_a_model() -> None:
    """What the models replace is put back, and no number of theirs stays in a cache of the oracle."""
    (record,) = records("transition.jsonl", 1)
    oracle = OracleCandidate()
    before = oracle.answer(record.query)
    ExactCandidate().answer(record.query)
    single().answer(record.query)
    assert oracle.answer(record.query) == before


def test_answers_are_rounded_once() -> None:
    """`answer` is `unrounded`, each number rounded to float32."""
    query = Query("normalize_check_small", {"v": [1.0, 2.0, 3.0]})
    for candidate in (double(), ExactCandidate()):
        exact, rounded = candidate.unrounded(query), candidate.answer(query)
        assert isinstance(exact, Result)
        assert isinstance(rounded, Result)
        assert exact.fields["v"] == pytest.approx([k / math.sqrt(14.0) for k in (1, 2, 3)], rel=1e-15)
        assert rounded.fields["v"] == [to_float32(x) for x in exact.fields["v"]]
    assert single().unrounded(query) == single().answer(query)


def test_a_number_beside_the_middle_of_two_float32_goes_to_the_nearer() -> None:
    """Its nearest double is the middle: 1 + 2^-23 + 2^-24 (1 - 2^-79), which two roundings take upwards."""
    pose: dict[str, Any] = {"cell": 1, "origin": [1.0 + 2.0**-23, 0.0, 0.0]}
    pose["rotation"] = [1.0, 0.0, 0.0, 2.0**-40]
    query = Query("frame_localtoglobal", {"pose": pose, "point": [2.0**-24, 0.0, 0.0]})
    candidate = ExactCandidate()
    exact, rounded = candidate.unrounded(query), candidate.answer(query)
    assert isinstance(exact, Result)
    assert isinstance(rounded, Result)
    assert exact.fields["v"][0] == 1.0 + 2.0**-23 + 2.0**-24
    assert (to_float32(exact.fields["v"][0]), rounded.fields["v"][0]) == (1.0 + 2.0**-22, 1.0 + 2.0**-23)
    pose["rotation"] = [1.0, 0.0, 0.0, 0.0]
    rounded = candidate.answer(query)
    assert isinstance(rounded, Result)
    assert rounded.fields["v"][0] == 1.0 + 2.0**-22  # the middle itself: to the even one


def test_what_may_be_zero_is_told_as_zero() -> None:
    """A wall through the origin: its normal is irrational, its constant is not."""
    wall = ramp((0, 0, 0), (11, -7, 0), (11, -7, 2), (0, 0, 2))
    assert exactly("polygon_make_plane", wall)["plane"][3] == 0.0


def test_an_operation_that_does_not_exist_is_skipped() -> None:
    """As the oracle skips it."""
    assert ExactCandidate().answer(Query("fly", {})) == OracleCandidate().answer(Query("fly", {}))
