"""Floats as short decimals and as bits."""

from __future__ import annotations

import json
import math

import pytest
from hypothesis import given
from hypothesis import strategies as st
from shipped_vectors import one_of_each

from conformance.floats import bits32, bits64, shortest32
from conformance.protocol.dialects import DIALECTS, read_bits, write_outputs
from conformance.protocol.readers import read_outputs
from conformance.protocol.spellings import shortest
from conformance.protocol.writing import inputs_text

FLOATS32 = st.floats(width=32)


@given(FLOATS32)
def test_a_short_decimal_is_the_shortest(value: float) -> None:
    """The same as the careful search finds, the sign of zero included; also the second time."""
    for _ in range(2):
        assert bits64(shortest(value)) == bits64(shortest32(value)) or math.isnan(value)


@given(FLOATS32, st.floats())
def test_bits_of_inputs_come_back(single: float, double: float) -> None:
    """Float32 inputs have eight digits, clock times sixteen; NaN stays NaN."""
    written = json.loads(inputs_text({"v": [single], "update_time": double}, "hex"))
    assert [len(written["v"][0]), len(written["update_time"])] == [10, 18]
    read = read_bits(written)
    assert bits32(read["v"][0]) == bits32(single) or math.isnan(single)
    assert bits64(read["update_time"]) == bits64(double) or math.isnan(double)


def test_names_that_look_like_bits_are_names() -> None:
    """People name a cell's geometry after the cell."""
    inputs = {"geometry": "0xA9B40151", "v": ["0x3f800000"], "world": "0xA9B40000"}
    assert read_bits(inputs) == {"geometry": "0xA9B40151", "v": [1.0], "world": "0xA9B40000"}


@pytest.mark.parametrize("dialect", DIALECTS)
def test_every_answer_comes_back(dialect: str) -> None:
    """Retail's answers to every operation, written and read, are the same on every bit."""
    for record in one_of_each():
        op = record.query.op
        written = json.loads(json.dumps(write_outputs(op, record.expected, dialect)))
        assert repr(read_outputs(op, written, dialect)) == repr(record.expected)


def test_decimals_are_short() -> None:
    """Not the seventeen digits of a float64; what is not finite is a text."""
    inputs = {"v": [0.10000000149011612, -0.0, math.inf], "times": [0.1]}
    assert inputs_text(inputs, "decimal") == '{"v":[0.1,-0.0,"inf"],"times":[0.1]}'
