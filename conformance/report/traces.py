"""Traces of writes as text: the summary of a run, and what a log holds."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from conformance.trace_text import NO_CALL, line_of, summarise
from oracle.enums import TransitionState
from oracle.writes import UNFINISHED

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Sequence

    from conformance.trace_log import LogReport, Rule, Tally
    from conformance.trace_text import Entry

_RESULTS: Final = (*(state.name for state in TransitionState if state), NO_CALL, UNFINISHED)
_MOST_PLANES: Final = 10
_MOST_CALLERS: Final = 40


def trace_lines(entries: Sequence[Entry], *, with_foot: bool) -> Iterator[str]:
    """Write one line an entry and, where there are several transitions, one at the start of each."""
    several = len({entry.transition for entry in entries}) > 1
    current = 0
    for entry in entries:
        if several and entry.transition != current:
            yield f"transition {entry.transition}:"
        current = entry.transition
        yield line_of(entry, with_foot=with_foot)


def summary_lines(entries: Sequence[Entry]) -> list[str]:
    """Write a table: one row for each topic and caller, one column for each state that occurs."""
    summary = summarise(entries)
    if not summary:
        return ["  no writes"]
    columns = [name for name in _RESULTS if any(counts[name] for counts in summary.values())]
    heading = ("topic", "caller", "entries", *columns)
    rows = [
        (topic, caller, str(counts.total()), *(str(counts[name] or "") for name in columns))
        for (topic, caller), counts in summary.items()
    ]
    return [f"  {line}" for line in _table([heading, *rows])]


def log_lines(name: str, report: LogReport, rule: Rule) -> Iterator[str]:
    """Write what a log holds.

    Parameters
    ----------
    name : str
        How places in the log are called.
    report : LogReport
        What was found.
    rule : Rule
        What was looked for.
    """
    yield (
        f"{name}: {report.lines} lines, {report.writes} writes, {report.ignored} other lines ignored, "
        f"{report.malformed} malformed"
    )
    for bad in report.bad_lines:
        yield f"  {name}:{bad.line}:{bad.error.column}: expected {bad.error.expected}"
    yield from _more(report.malformed - len(report.bad_lines), "malformed lines")
    yield from _counted("writes by caller", report.callers, _MOST_CALLERS)
    yield from _counted("planes written most often", report.planes, _MOST_PLANES)
    yield (
        f"suspect writes: {report.suspect} (limit {rule.limit:.3f} m = radius {rule.radius:.3f} "
        f"+ step height {rule.step_height:.3f})"
    )
    for suspect in report.suspects:
        write = suspect.write
        yield (
            f"  {name}:{suspect.line}: {write.label} {write.before} -> {write.after} "
            f"caller={write.caller}: {suspect.reason}"
        )
    yield from _more(report.suspect - len(report.suspects), "suspect writes")
    if report.suspect:
        yield from _counted("suspect writes by caller", report.suspect_callers, _MOST_CALLERS)


def _counted(title: str, tally: Tally[tuple[str, str]], most: int) -> Iterator[str]:
    if not tally.counts:
        return
    shown = tally.counts.most_common(most)
    rest = tally.counts.total() + tally.others - sum(count for _, count in shown)
    yield f"{title}:"
    yield from (f"  {line}" for line in _table([(str(count), *key) for key, count in shown]))
    yield from _more(rest, "writes")


def _more(count: int, what: str) -> Iterator[str]:
    if count:
        yield f"  ... and {count} more {what}"


def _table(rows: Iterable[Sequence[str]]) -> list[str]:
    """Align columns to the left, two spaces apart."""
    rows = list(rows)
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    return ["  ".join(map(str.ljust, row, widths)).rstrip() for row in rows]
