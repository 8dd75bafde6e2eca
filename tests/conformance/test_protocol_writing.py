"""Inputs as JSON text."""

from __future__ import annotations

import json
import math
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st
from shipped_vectors import one_of_each

from conformance.floats import shortest32
from conformance.protocol.dialects import DIALECTS, read_bits
from conformance.protocol.writing import inputs_text

FLOATS32 = st.floats(width=32, allow_nan=False, allow_infinity=False)
LEAVES = st.none() | st.booleans() | st.integers() | st.text() | FLOATS32
RECORDS = st.recursive(
    LEAVES,
    lambda inner: (
        st.lists(inner)
        | st.lists(FLOATS32)
        | st.lists(st.integers())
        | st.dictionaries(st.text(), inner)
        | st.dictionaries(st.sampled_from(["times", "v"]), inner)
    ),
    max_leaves=12,
)


def plainly(value: Any, *, double: bool = False) -> Any:
    """Return what JSON's own writer must be given, number by number."""
    if isinstance(value, dict):
        return {key: plainly(item, double=key == "times") for key, item in value.items()}
    if isinstance(value, list | tuple):
        return [plainly(item, double=double) for item in value]
    return shortest32(value) if isinstance(value, float) and not double else value


@given(RECORDS)
def test_it_is_what_json_s_own_writer_writes(record: Any) -> None:
    """Of float32 values the shortest decimals, of clock times all digits, of everything else the same."""
    text = json.dumps(plainly(record), separators=(",", ":"), ensure_ascii=False)
    for _ in range(2):  # the second time from memory
        assert inputs_text(record, "decimal") == text


@pytest.mark.parametrize("dialect", DIALECTS)
def test_the_inputs_of_every_operation_come_back(dialect: Any) -> None:
    """The same on every bit, signs of zero included."""
    for record in one_of_each():
        inputs = json.loads(inputs_text(record.query.inputs, dialect))
        read = read_bits(inputs) if dialect == "hex" else inputs
        assert plainly(read) == plainly(dict(record.query.inputs))


@pytest.mark.parametrize("dialect", DIALECTS)
def test_blocks_that_poses_share_are_written_as_any_other(dialect: Any) -> None:
    """Remembered by identity: equal blocks with zeros of another sign stay apart, long after."""
    movers = [{"spheres": [[0.0, zero, 1.0, 0.5]]} for zero in (0.0, -0.0) * 50]
    texts = [inputs_text({"mover": mover, "world": {"heights": [mover]}}, dialect) for mover in movers]
    again = [inputs_text({"mover": mover, "world": {"heights": [mover]}}, dialect) for mover in movers]
    assert texts == again
    assert [text.replace("mover", "m").replace("heights", "h") for text in texts] == [
        inputs_text({"m": mover, "world": {"h": [mover]}}, dialect) for mover in movers
    ]
    assert len(set(texts)) == 2


def test_what_is_not_finite_is_a_text() -> None:
    """JSON has no number for it."""
    numbers = [math.nan, math.inf, -math.inf]
    assert inputs_text({"v": numbers, "times": numbers}, "decimal") == (
        '{"v":["nan","inf","-inf"],"times":["nan","inf","-inf"]}'
    )


def test_too_deep_is_told() -> None:
    """Not cut off: whoever sends it must know."""
    deep: list[Any] = []
    for _ in range(100_000):
        deep = [deep]
    with pytest.raises(RecursionError):
        inputs_text(deep, "decimal")
