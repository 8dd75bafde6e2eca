"""Every output field is compared, exactly, and a difference says which."""

from __future__ import annotations

import copy
import math
from typing import Any

import pytest
from answers import changed, full_answer, single_changes
from shipped_vectors import one_of_each

from conformance.compare import Difference, Tolerance, differences, pin_differences
from conformance.fields import MISSING, FieldError, UnknownFieldError, UnknownOperationError, canonical_path
from conformance.floats import next_float32
from conformance.outputs import OUTPUTS
from conformance.pins import Pin
from conformance.shapes import FLOAT_KINDS, Kind

PLANE = {"valid": 1, "plane": [0.0, 0.0, 1.0, -94.0], "cell_id": 0xA9B40150, "is_water": 0}


def state(**changes: Any) -> dict[str, Any]:
    """Return a full find_collisions answer with some fields replaced."""
    return {**full_answer(OUTPUTS["find_collisions"]), "contact_plane": PLANE, **changes}


def compare(expected: dict[str, Any], actual: dict[str, Any]) -> list[Difference]:
    """Compare two find_collisions answers as two engines are compared."""
    return differences(expected, actual, op="find_collisions", zero_signs="distinct")


@pytest.mark.parametrize("op", sorted(OUTPUTS))
def test_a_smallest_change_of_any_field_is_found_and_named(op: str) -> None:
    """One ULP, one unit, another name: exactly that field differs, under a path that leads back to it."""
    answer = full_answer(OUTPUTS[op])
    assert differences(answer, copy.deepcopy(answer), op=op, zero_signs="distinct") == []
    names = set()
    for place, kind, other in single_changes(OUTPUTS[op], answer):
        found = differences(answer, other, op=op, zero_signs="equal")
        assert [(d.path, d.name, d.kind) for d in found] == [(place.path, place.name, kind)]
        assert found[0].ulps == (1 if kind in FLOAT_KINDS else None)
        assert canonical_path(op, place.name) == canonical_path(op, place.path) == place.path
        names.add(place.name)
    assert names


def test_a_smallest_change_in_retails_answers_is_found() -> None:
    """The same on one shipped record of each operation and outcome."""
    count = 0
    for record in one_of_each():
        if "ticks" in record.expected:
            continue  # thousands of values; walks are compared by the test above
        op, answer = record.query.op, record.expected
        for place, kind, other in single_changes(OUTPUTS[op], answer):
            found = differences(answer, other, op=op, zero_signs="equal")
            assert [(d.path, d.kind) for d in found] == [(place.path, kind)], record.id
            count += 1
    assert count > 4000


@pytest.mark.parametrize("op", sorted(OUTPUTS))
def test_a_field_on_one_side_only_is_a_difference(op: str) -> None:
    """Leaving out a field differs like any value does; so does inventing one."""
    answer = full_answer(OUTPUTS[op])
    for key in answer:
        less = {k: v for k, v in answer.items() if k != key}
        (missing,) = differences(answer, less, op=op, zero_signs="equal")
        (extra,) = differences(less, answer, op=op, zero_signs="equal")
        assert (missing.path, missing.candidate) == (key, MISSING)
        assert (extra.path, extra.retail) == (key, MISSING)
    (unknown,) = differences(answer, {**answer, "tarce": "K1"}, op=op, zero_signs="equal")
    assert (unknown.path, unknown.retail, unknown.candidate) == ("tarce", MISSING, "K1")


def test_the_name_of_a_plane_distance() -> None:
    """People read `contact_plane.d` where records say `contact_plane.plane[3]`."""
    other = {**PLANE, "plane": [0.0, 0.0, 1.0, 0.0]}
    (difference,) = compare(state(), state(contact_plane=other))
    assert difference.path == "contact_plane.plane[3]"
    assert difference.name == "contact_plane.d"
    assert (difference.retail, difference.candidate, difference.ulps) == (-94.0, 0.0, 0x42BC0000)


def test_null_is_a_value() -> None:
    """No collision normal is not the same as a zero one."""
    (difference,) = compare(state(collision_normal=None), state(collision_normal=[0.0, 0.0, 0.0]))
    assert difference.path == "collision_normal"
    assert difference.kind is Kind.BLOCK
    assert difference.retail is None


def test_a_polygon_against_none() -> None:
    """A walkable polygon on one side only is a polygon difference."""
    (difference,) = compare(state(walkable=None), state(walkable=0))
    assert (difference.path, difference.kind) == ("walkable", Kind.POLYGON)


def test_signs_of_zero() -> None:
    """Two engines must agree on the sign of zero; vector files do not keep it."""
    plus, minus = state(walk_interp=0.0), state(walk_interp=-0.0)
    (difference,) = differences(plus, minus, op="find_collisions", zero_signs="distinct")
    assert (difference.name, difference.note, difference.ulps) == ("walk_interp", "the sign of zero", 0)
    assert differences(plus, minus, op="find_collisions", zero_signs="equal") == []
    vector = state(step_up_normal=[0.0, 0.0, 1.0]), state(step_up_normal=[0.0, -0.0, 1.0])
    assert [d.name for d in compare(*vector)] == ["step_up_normal.y"]


def test_nan_equals_nan_only() -> None:
    """Any NaN equals any NaN; against a number it differs, without a distance."""
    nan = state(walk_interp=math.nan)
    assert compare(nan, state(walk_interp=-math.nan)) == []
    (difference,) = compare(nan, state(walk_interp=1.0))
    assert difference.ulps is None


def test_a_value_that_is_not_float32_is_told() -> None:
    """A candidate that forgot a store gives a double between two float32 values."""
    (difference,) = compare(state(walk_interp=0.5), state(walk_interp=math.nextafter(0.5, 1.0)))
    assert difference.note == "not a float32"


@pytest.mark.parametrize(
    ("field", "value"),
    [("collide", 0.0), ("result", 1), ("walk_interp", "0.5"), ("check_cell", None), ("check", 3)],
)
def test_a_value_of_another_type_differs(field: str, value: Any) -> None:
    """A flag as a float, a state as a number: not what was asked for."""
    (difference,) = compare(state(), state(**{field: value}))
    assert (difference.path, difference.candidate) == (field, value)


def test_lists_of_different_length() -> None:
    """A missing sphere is one difference of the whole list; the common part is still compared."""
    two = state(global_spheres=[[1.0, 2.0, 3.0], [1.0, 2.0, 4.0]])
    one = state(global_spheres=[[1.0, 2.5, 3.0]])
    assert [d.name for d in compare(two, one)] == ["global_spheres[0].y", "global_spheres"]
    short = state(step_up_normal=[0.0, 1.0])
    assert [d.name for d in compare(state(), short)] == ["step_up_normal"]


def test_a_walk_stops_at_its_first_diverging_step() -> None:
    """Later ticks of a walk mean nothing after one that differs."""
    tick = full_answer(OUTPUTS["walk"])["ticks"][0]
    right = {"ticks": [tick, tick, tick]}
    moved = {**tick, "pos": [next_float32(v) for v in tick["pos"]]}
    found = differences(right, {"ticks": [tick, moved, moved]}, op="walk", zero_signs="equal")
    assert [d.name for d in found] == [f"tick 1: position.{axis}" for axis in "xyz"]
    (ended,) = differences(right, {"ticks": [tick]}, op="walk", zero_signs="equal")
    assert (ended.name, ended.note) == ("ticks", "3 items, candidate 1")


def test_an_unknown_operation() -> None:
    """A mistyped operation is refused with the nearest one."""
    with pytest.raises(UnknownOperationError, match="did you mean 'find_collisions'"):
        differences({}, {}, op="find_colisions", zero_signs="equal")


@pytest.mark.parametrize(
    ("unit", "inclusive", "off", "admitted"),
    [
        ("m", True, 0.25, True),
        ("m", False, 0.25, False),
        ("m", False, 0.125, True),
        ("m", True, 0.5, False),
        ("m", True, math.nan, False),
        ("ulp", True, 0.0, True),
    ],
)
def test_tolerance(unit: str, inclusive: bool, off: float, admitted: bool) -> None:
    """A tolerance says aloud whether its limit still passes, and admits no NaN."""
    tolerance = Tolerance(0.25, unit, inclusive, "a test")
    assert tolerance.admits(-94.0, -94.0 + off) is admitted


def test_tolerance_in_ulps() -> None:
    """Two ULPs are allowed, three are not."""
    tolerance = Tolerance(2, "ulp", inclusive=True, reason="a test")
    two = next_float32(next_float32(1.0))
    assert tolerance.admits(1.0, two)
    assert not tolerance.admits(1.0, next_float32(two))
    assert not tolerance.admits(1.0, math.nan)


def test_pins_take_either_spelling() -> None:
    """A pin may be written as in records or as read by people, for one value or a whole vector."""
    pins = [
        Pin("contact_plane.d", -94.0),
        Pin("contact_plane.plane[3]", -94),
        Pin("contact_plane.plane", [0, 0, 1, -94]),
        Pin("contact_plane.n.z", 1),
        Pin("result", "OK"),
        Pin("walkable", 7),
    ]
    assert pin_differences(pins, state(), op="find_collisions") == []


def test_pins_are_exact_unless_they_say_otherwise() -> None:
    """A pin fails by one ULP; with a tolerance it fails beyond it, and the failure tells the tolerance."""
    answer = state(walk_interp=changed(Kind.FLOAT32, 0.5))
    (exact,) = pin_differences([Pin("walk_interp", 0.5)], answer, op="find_collisions")
    assert exact.ulps == 1
    wide = Tolerance(1e-4, "1", inclusive=True, reason="a test")
    assert pin_differences([Pin("walk_interp", 0.5, wide)], answer, op="find_collisions") == []
    (beyond,) = pin_differences([Pin("walk_interp", 0.501, wide)], answer, op="find_collisions")
    assert str(beyond.tolerance) == "<= 0.0001 1 (a test)"


def test_a_pinned_field_that_is_not_there() -> None:
    """An answer without the pinned field differs from the pin."""
    answer = state(contact_plane={"valid": 0})
    (difference,) = pin_differences([Pin("contact_plane.d", -94.0)], answer, op="find_collisions")
    assert (difference.name, difference.candidate) == ("contact_plane.d", MISSING)


def test_wrong_pins_are_refused() -> None:
    """A pin of no field, or of a value that cannot be, is a mistake of the case."""
    with pytest.raises(UnknownFieldError, match=r"did you mean 'contact_plane\.d'"):
        pin_differences([Pin("contact_plane.D", -94.0)], state(), op="find_collisions")
    with pytest.raises(FieldError, match="expected a number"):
        pin_differences([Pin("walk_interp", "half")], state(), op="find_collisions")
