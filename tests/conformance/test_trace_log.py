"""Logs of writes: what is counted, what is suspect, and that neither grows with the log."""

from __future__ import annotations

import io

import pytest

from conformance import trace_log
from conformance.trace_lines import LONGEST_LINE
from conformance.trace_log import Rule, bounded_lines, read_log

RULE = Rule(radius=0.5, step_height=1.5)
FLOOR = "n=(0,0,1) D=-94.000"
NONE = "n=(0,0,0) D=0.000"


def cp(before: str, after: str, rest: str = "caller=f") -> str:
    """Return a write of the contact plane."""
    return f"[cp-write] ContactPlane: {before} -> {after} {rest}"


def reasons(*lines: str) -> list[tuple[int, str]]:
    """Return line number and reason of each suspect write."""
    return [(suspect.line, suspect.reason) for suspect in read_log(lines, RULE).suspects]


def test_writes_are_counted_by_caller_and_plane() -> None:
    """Flags count for their caller too; what is no trace line is only counted."""
    flag = "[cp-write] ContactPlaneValid: 0 -> 1 caller=g"
    report = read_log(["", flag, cp(NONE, FLOOR), "x", cp(NONE, FLOOR), cp("none", "none")], RULE)
    assert (report.lines, report.writes, report.ignored, report.malformed) == (6, 4, 2, 0)
    assert report.callers.counts == {("cp-write", "g"): 1, ("cp-write", "f"): 3}
    assert report.planes.counts == {("ContactPlane", FLOOR): 2, ("ContactPlane", "none"): 1}
    assert report.suspect == 0


def test_a_malformed_line_is_located_and_the_rest_is_read() -> None:
    """Line and column of the mistake."""
    report = read_log([cp(NONE, FLOOR), "[cp-write] nonsense", cp(NONE, FLOOR)], RULE)
    assert (report.writes, report.malformed) == (2, 1)
    assert [(bad.line, bad.error.column) for bad in report.bad_lines] == [(2, 11)]


@pytest.mark.parametrize(
    ("z", "reason"),
    [
        ("94.0", ""),
        ("96.0", ""),
        ("92.0", ""),
        ("96.0001", "2.000 m from the foot"),
        ("0.0", "94.000 m from the foot"),
    ],
)
def test_a_plane_far_from_the_foot_is_suspect(z: str, reason: str) -> None:
    """More than radius and step height together, on either side; exactly as much is not."""
    line = cp(NONE, FLOOR, f"caller=f foot=(10,20,{z})")
    assert reasons(line) == ([(1, reason)] if reason else [])


def test_the_distance_is_measured_along_the_normal() -> None:
    """A normal need not have unit length, and a jump of D does not matter where there is a foot."""
    assert not reasons(cp(FLOOR, "n=(0,0,2) D=-188.0", "caller=f foot=(0,0,95.9)"))
    assert reasons(cp(FLOOR, "n=(0.6,0,0.8) D=-8.0", "caller=f foot=(5,0,0)")) == [
        (1, "5.000 m from the foot")
    ]


def test_a_jump_is_suspect_without_a_foot() -> None:
    """The line's own plane before is what counts; the limit itself is allowed, as decimals say it."""
    lines = [cp("n=(0,0,1) D=-94.020", "n=(0,0,1) D=-96.00")]
    assert not read_log(lines, Rule(radius=0.48, step_height=1.5)).suspects
    assert read_log(lines, Rule(radius=0.47, step_height=1.5)).suspects
    assert reasons(cp(FLOOR, "n=(0,0,1) D=-96.0"), cp(FLOOR, "n=(0,0,1) D=-0.000")) == [
        (2, "D jumps by 94.000 m")
    ]


def test_a_jump_from_no_plane_is_measured_from_the_last_one() -> None:
    """A transition that begins empty does not hide the jump; each field has its own last plane."""
    lkp = f"[lkp-write] LastKnownContactPlane: {NONE} -> n=(0,0,1) D=-0.000 caller=f"
    assert reasons(cp(NONE, FLOOR), lkp, cp("none", "none"), cp(NONE, "n=(0,0,1) D=0.000")) == [
        (4, "D jumps by 94.000 m")
    ]


def test_a_jump_to_another_normal_is_not_judged() -> None:
    """Without a foot nothing is known of a plane that is turned by more than 2.6 degrees."""
    assert not reasons(cp(FLOOR, "n=(0.05,0,0.99875) D=-0.0"))
    assert reasons(cp(FLOOR, "n=(0.04,0,0.9992) D=-0.0")) == [(1, "D jumps by 94.000 m")]


def test_a_plane_that_is_not_finite_is_suspect() -> None:
    """With a foot and without; the next plane is not measured from it."""
    bad = "n=(0,0,1) D=NaN"
    assert reasons(cp(FLOOR, bad), cp(bad, FLOOR), cp(NONE, bad, "caller=f foot=(0,0,0)")) == [
        (1, "not a finite plane"),
        (3, "not a finite plane"),
    ]


def test_the_report_is_bounded(monkeypatch: pytest.MonkeyPatch) -> None:
    """Keys beyond the limit are counted together, examples beyond theirs not kept."""
    monkeypatch.setattr(trace_log, "_MOST_KEYS", 3)
    monkeypatch.setattr(trace_log, "_EXAMPLES", 2)
    lines = [cp(FLOOR, f"n=(0,0,1) D={d}.0", f"caller=f{d}") for d in range(5)]
    report = read_log([*lines, *lines, *["[bsp]"] * 4], RULE)
    assert (len(report.planes.counts), report.planes.others) == (3, 4)
    assert (report.suspect, len(report.suspects)) == (10, 2)
    assert (report.malformed, len(report.bad_lines)) == (4, 2)


def test_lines_are_read_in_pieces() -> None:
    """An overlong line is cut, stays one line, and any line end is one."""
    stream = io.StringIO(f"a\n{'b' * 3 * LONGEST_LINE}\nc\n\nd")
    assert [len(line) for line in bounded_lines(stream)] == [1, LONGEST_LINE + 1, 1, 0, 1]


@pytest.mark.parametrize("extra", [-1, 0, 1])
def test_a_line_about_the_limit_is_one_line(extra: int) -> None:
    """The line end may fall before, on and behind the first piece's end."""
    stream = io.StringIO(f"{'b' * (LONGEST_LINE + extra)}\nc\n")
    assert [len(line) for line in bounded_lines(stream)] == [LONGEST_LINE + extra, 1]
