"""Answers of engines, read fast where they are right and with care where they are not."""

from __future__ import annotations

import math
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st
from shipped_vectors import one_of_each

from conformance.fields import FieldError, normalise
from conformance.protocol import readers
from conformance.protocol.dialects import DIALECTS, write_outputs
from conformance.protocol.readers import read_outputs
from conformance.protocol.replies import outcome_of, read_reply
from conformance.query import Result

OP = "block_offset"
SMALL = "normalize_check_small"
ODD = st.none() | st.booleans() | st.integers() | st.floats() | st.text(max_size=4) | st.just(10**400)


@pytest.mark.parametrize(
    ("value", "found"), [(1.0, "1.0"), ("0x3f8000", "'0x3f8000'"), ("0x3ff0000000000000", "'0x3ff")]
)
def test_other_things_than_bits_are_mistakes(value: object, found: str) -> None:
    """A number, and bits of another length, where an engine has promised bits."""
    with pytest.raises(FieldError) as caught:
        read_outputs("block_offset", {"v": ["0x00000000", value, "0x00000000"]}, "hex")
    assert caught.value.path == "v[1]"
    assert caught.value.found.startswith(found)
    assert caught.value.expected == "the bits of a float32, as in '0x3f800000'"


@pytest.mark.parametrize("dialect", DIALECTS)
def test_what_is_right_is_read_fast(dialect: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    """Retail's answers to all operations never need care, but where they are not finite."""

    def careful(op: str, *_: object) -> None:
        raise AssertionError(op)

    monkeypatch.setattr(readers, "_read_with_care", careful)
    for record in one_of_each():
        if "nan" not in repr(record.expected) and "inf" not in repr(record.expected):
            read_outputs(record.query.op, write_outputs(record.query.op, record.expected, dialect), dialect)


@given(st.lists(ODD, max_size=4) | ODD, ODD)
def test_both_ways_read_the_same(vector: Any, flag: Any) -> None:
    """Whatever an engine writes: the same answer, or the same complaint."""
    fields = {"small": flag, "v": vector}

    def told(read: Any) -> str:
        try:
            return repr(read())
        except FieldError as error:
            return str(error)

    assert told(lambda: read_outputs(SMALL, fields, "decimal")) == told(lambda: normalise(SMALL, fields))


@pytest.mark.parametrize(
    ("value", "read"),
    [(1, 1.0), (0.1, 0.10000000149011612), (-0.0, -0.0), ("inf", math.inf), (1e-60, 0.0)],
)
def test_numbers_are_rounded_to_float32(value: object, read: float) -> None:
    """Whole numbers and texts for what is not finite included."""
    assert repr(read_outputs(OP, {"v": [value, 0.0, 0.0]}, "decimal")) == repr({"v": [read, 0.0, 0.0]})


@pytest.mark.parametrize("zero", ["-0", "-0.0", "-0e0", "0", "0.0"])
def test_zeros_keep_their_sign(zero: str) -> None:
    """Also written without a point, as some writers of JSON do; whole numbers beside it stay whole."""
    reply = read_reply(f'{{"seq":1,"result":{{"small":1,"v":[{zero},-0,2]}}}}\n'.encode(), 1)
    sign = -0.0 if zero.startswith("-") else 0.0
    assert repr(outcome_of(reply, SMALL, "decimal")) == repr(Result({"small": 1, "v": [sign, -0.0, 2.0]}))


@pytest.mark.parametrize(
    ("value", "found"),
    [
        (1e39, "the number 1e+39"),
        (True, "True (bool)"),
        (None, "None (NoneType)"),
        (10**400, "a number beyond"),
    ],
)
def test_mistakes_are_told_with_their_place(value: object, found: str) -> None:
    """As careful reading tells them."""
    with pytest.raises(FieldError) as caught:
        read_outputs(OP, {"v": [0.0, value, 0.0]}, "decimal")
    assert caught.value.path == "v[1]"
    assert caught.value.found.startswith(found)


@pytest.mark.parametrize("fields", [{}, {"v": [0.0, 0.0, 0.0], "w": 1}, [], {"v": [0.0, 0.0]}, {"v": "0"}])
def test_other_shapes_are_mistakes(fields: object) -> None:
    """Missing and unknown keys, lists of another length, and what is no block at all."""
    with pytest.raises(FieldError):
        read_outputs(OP, fields, "decimal")
