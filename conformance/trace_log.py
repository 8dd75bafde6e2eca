"""Reading a log of writes of any length: who wrote which planes, and which writes look wrong."""

from __future__ import annotations

import math
from collections import Counter
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Final, Generic, TypeVar

from conformance.trace_lines import LONGEST_LINE, LoggedWrite, TraceLineError, parse_line, parse_plane

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator
    from typing import TextIO

    from conformance.trace_lines import Plane

SAME_NORMAL_COSINE: Final = 0.999
"""Two normals are nearly the same if the cosine of the angle between them is at least this (2.6 degrees)."""
_ROUNDING: Final = 1e-9
"""Metres by which a distance may be above its limit: numbers of a log are decimals, which doubles are not."""
_MOST_KEYS: Final = 10_000
"""Distinct callers or planes that are counted one by one; a log may hold any number."""
_EXAMPLES: Final = 20
"""Suspect writes and malformed lines that are kept to be shown."""

K = TypeVar("K")


@dataclass(frozen=True, slots=True)
class Rule:
    """How far a plane that a mover stands on can be from its foot.

    Attributes
    ----------
    radius, step_height : float
        Of the mover, metres.
    """

    radius: float
    step_height: float

    @property
    def limit(self) -> float:
        """The largest distance that is not suspect, metres."""
        return self.radius + self.step_height


@dataclass(slots=True)
class Tally(Generic[K]):
    """A counter of bounded size: new keys beyond the limit are counted together, as `others`."""

    counts: Counter[K] = field(default_factory=Counter)
    others: int = 0

    def add(self, key: K) -> None:
        """Count one."""
        if key in self.counts or len(self.counts) < _MOST_KEYS:
            self.counts[key] += 1
        else:
            self.others += 1


@dataclass(frozen=True, slots=True)
class Suspect:
    """A write that looks wrong: its line number, the write, and why."""

    line: int
    write: LoggedWrite
    reason: str


@dataclass(frozen=True, slots=True)
class BadLine:
    """A line that begins as a trace line and is none."""

    line: int
    error: TraceLineError


@dataclass(slots=True)
class LogReport:
    """What a log holds; its size does not depend on the log's.

    Attributes
    ----------
    lines, writes, ignored, malformed, suspect : int
        Numbers of lines; all but the first and the last add up to it.
    callers : Tally of (topic, caller)
        Writes by who made them.
    planes : Tally of (field, plane)
        Writes of planes by the value written.
    suspect_callers : Tally of (topic, caller)
        Suspect writes by who made them.
    suspects, bad_lines : list
        The first of them.
    """

    lines: int = 0
    writes: int = 0
    ignored: int = 0
    malformed: int = 0
    suspect: int = 0
    callers: Tally[tuple[str, str]] = field(default_factory=Tally)
    planes: Tally[tuple[str, str]] = field(default_factory=Tally)
    suspect_callers: Tally[tuple[str, str]] = field(default_factory=Tally)
    suspects: list[Suspect] = field(default_factory=list)
    bad_lines: list[BadLine] = field(default_factory=list)


def bounded_lines(stream: TextIO) -> Iterator[str]:
    """Yield the lines of a stream without their ends; of an overlong line, only its beginning."""
    while line := stream.readline(LONGEST_LINE + 1):
        piece = line
        while piece and not piece.endswith("\n"):
            piece = stream.readline(LONGEST_LINE)
        yield line.rstrip("\r\n")


def read_log(lines: Iterable[str], rule: Rule) -> LogReport:
    """Count the writes of a log and judge those of planes.

    Parameters
    ----------
    lines : iterable of str
        The log; read once, line by line.
    rule : Rule
        Which planes are suspect, see `Judge`.
    """
    report, judge = LogReport(), Judge(rule)
    for number, line in enumerate(lines, start=1):
        report.lines = number
        try:
            write = parse_line(line)
        except TraceLineError as error:
            report.malformed += 1
            if len(report.bad_lines) < _EXAMPLES:
                report.bad_lines.append(BadLine(number, error))
            continue
        if write is None:
            report.ignored += 1
        else:
            _count(report, number, write, judge.reason(write))
    return report


def _count(report: LogReport, number: int, write: LoggedWrite, reason: str) -> None:
    who = write.topic, write.caller
    report.writes += 1
    report.callers.add(who)
    if write.is_plane:
        report.planes.add((write.label, write.after))
    if reason:
        report.suspect += 1
        report.suspect_callers.add(who)
        if len(report.suspects) < _EXAMPLES:
            report.suspects.append(Suspect(number, write, reason))


class Judge:
    """Tells which writes of planes are suspect.

    With a foot in the line, a plane further from it than radius + step height. Without, a plane whose
    constant differs by more than that from the plane before it, the normals being nearly the same. The
    plane before it is the one that the line says is replaced or, if that is none, the last one written
    to the same field. A plane with an infinity or NaN is always suspect, no plane never.
    """

    def __init__(self, rule: Rule) -> None:
        self._limit = rule.limit
        self._last: dict[str, Plane] = {}

    def reason(self, write: LoggedWrite) -> str:
        """Return why a write is suspect; empty if it is not."""
        plane = parse_plane(write.after) if write.is_plane else None
        if plane is None:
            return ""
        previous = parse_plane(write.before) or self._last.get(write.label)
        self._last[write.label] = plane
        if not plane.is_finite:
            return "not a finite plane"
        if write.foot is not None:
            away = abs(_dot(plane.normal, write.foot) + plane.d) / math.hypot(*plane.normal)
            return "" if away <= self._limit + _ROUNDING else f"{away:.3f} m from the foot"
        if previous is None or not previous.is_finite or not _nearly_parallel(plane, previous):
            return ""
        jump = abs(plane.d - previous.d)
        return "" if jump <= self._limit + _ROUNDING else f"D jumps by {jump:.3f} m"


def _nearly_parallel(a: Plane, b: Plane) -> bool:
    lengths = math.hypot(*a.normal) * math.hypot(*b.normal)
    return _dot(a.normal, b.normal) >= SAME_NORMAL_COSINE * lengths


def _dot(a: tuple[float, float, float], b: tuple[float, float, float]) -> float:
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
