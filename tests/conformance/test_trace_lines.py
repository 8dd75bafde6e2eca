"""Lines of a trace: what is one, what is none, and where one goes wrong."""

from __future__ import annotations

import pytest

from conformance.trace_lines import (
    LONGEST_LINE,
    LoggedWrite,
    Plane,
    TraceLineError,
    parse_line,
    parse_plane,
)
from conformance.trace_text import line_of
from oracle.transition import Transition
from oracle.world import World
from oracle.write_trace import _snapshot
from oracle.writes import FIELDS, Write

UP = (0.0, 0.0, 1.0)
LINE = "[cp-write] ContactPlane: n=(0,0,1) D=-94.020 -> n=(0,0,1) D=-0.000 caller=step_sphere_down"


def test_a_line_is_read() -> None:
    """Tag, field, both values and the caller."""
    write = parse_line(LINE)
    assert write == LoggedWrite(
        "cp-write", "ContactPlane", "n=(0,0,1) D=-94.020", "n=(0,0,1) D=-0.000", "step_sphere_down", None
    )
    assert write is not None
    assert write.is_plane
    assert parse_plane(write.before) == Plane(UP, -94.02)


def test_a_foot_is_read() -> None:
    """It stands at the end, its numbers written in any way that a float can be."""
    write = parse_line(f"{LINE} foot=(100, -5e1,94.)  ")
    assert write is not None
    assert write.foot == (100.0, -50.0, 94.0)


@pytest.mark.parametrize("line", ["", "12:00 something", f" {LINE}", "[probe] x", f"INFO {LINE}", "cp-write"])
def test_other_lines_are_none(line: str) -> None:
    """What does not begin with the tag of a topic is no trace line."""
    assert parse_line(line) is None


@pytest.mark.parametrize(
    ("old", "new", "column", "expected"),
    [
        (" ContactPlane", "ContactPlane", 11, "' FIELD: '"),
        ("ContactPlane", "ContactPlan", 12, "the name of a field (did you mean 'ContactPlane'?)"),
        ("n=(0,0,1) D=-94.020", "n=(0,0) D=-94.020", 26, "a value of ContactPlane"),
        ("-94.020", "-94,020", 41, "' -> '"),
        ("->", "=>", 45, "' -> '"),
        ("n=(0,0,1) D=-0.000", "nothing", 49, "a value of ContactPlane"),
        (" caller=step_sphere_down", "", 67, "' caller=FUNCTION'"),
        ("down", "down feet=(1,2,3)", 91, "the end of the line, or ' foot=(x,y,z)'"),
        ("down", "down foot=(1,2)", 91, "the end of the line, or ' foot=(x,y,z)'"),
    ],
)
def test_a_malformed_line_says_where(old: str, new: str, column: int, expected: str) -> None:
    """A line with a tag must go on as one; the column is where it does not."""
    with pytest.raises(TraceLineError) as caught:
        parse_line(LINE.replace(old, new, 1))
    assert (caught.value.column, caught.value.expected) == (column, expected)


def test_an_overlong_line_is_malformed() -> None:
    """It is judged by its beginning, however long it is."""
    with pytest.raises(TraceLineError, match=f"column {LONGEST_LINE + 1}: expected a line of at most"):
        parse_line(LINE + " " * LONGEST_LINE)
    assert parse_line("x" * 2 * LONGEST_LINE) is None


@pytest.mark.parametrize("text", ["none", "n=(0,0,0) D=0.000", "n=(-0.0,0,0) D=5"])
def test_no_plane(text: str) -> None:
    """None is no plane, and a plane without a normal is the field before its first write."""
    assert parse_plane(text) is None


@pytest.mark.parametrize("text", ["n=(0,0,NaN) D=0", "n=(0,0,1) D=-inf", "n=(nan,0,1) D=Infinity"])
def test_a_plane_that_is_not_finite(text: str) -> None:
    """Infinities and NaN are read as what they are, in the spelling of several languages."""
    plane = parse_plane(text)
    assert plane is not None
    assert not plane.is_finite


@pytest.mark.parametrize("name", FIELDS)
def test_every_field_of_the_oracles_trace_can_be_read(name: str) -> None:
    """Its label is known, and so is the way in which its values are written."""
    transition = Transition(World())
    topic, label = FIELDS[name]
    parts = (transition.collision_info, transition.sphere_path, transition.object_info)
    (first,) = [_snapshot(getattr(part, name)) for part in parts if hasattr(part, name)]
    line = line_of(Write(topic, label, first, first, "f", 1, None, None))
    write = parse_line(line)
    assert write is not None
    assert (write.label, write.after) == (label, write.before)
    assert f"{label}: {write.after} -> {write.after} " in line
