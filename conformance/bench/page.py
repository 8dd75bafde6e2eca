"""The numbers of a run as Markdown, put between two marks of a page whose words stay as they are."""

from __future__ import annotations

from operator import itemgetter
from typing import TYPE_CHECKING, Final

from conformance.bench.machine import machine, versions
from conformance.bench.tables import MESSAGE_COLUMNS, duration, message_rows
from conformance.files import write_text

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Sequence
    from pathlib import Path

    from conformance.bench.report import Report

BEGIN: Final = "<!-- numbers: written by `conformance bench --page` -->"
END: Final = "<!-- end of numbers -->"


class PageError(Exception):
    """A page without the two marks."""


def write_page(path: Path, report: Report, command: str) -> None:
    """Replace the numbers of a page.

    Parameters
    ----------
    path : Path
        A Markdown file that has `BEGIN` and `END`, each on a line of its own.
    report : Report
    command : str
        What makes these numbers.

    Raises
    ------
    PageError
        If the marks are not there, in this order.
    """
    before, after = split_page(path)
    text = f"{before}{numbers(report, command)}\n{after}"
    write_text(path, text)


def split_page(path: Path) -> tuple[str, str]:
    """Return what is before the numbers of a page, the mark included, and what is after them.

    Raises
    ------
    PageError
        If the marks are not there, in this order.
    """
    before, begin, rest = path.read_text(encoding="utf-8").partition(f"{BEGIN}\n")
    _, end, after = rest.partition(END)
    if not (begin and end):
        raise PageError(f"{path} has no lines {BEGIN!r} and {END!r}")
    return before + begin, end + after


def numbers(report: Report, command: str) -> str:
    """Return everything that was found, as Markdown."""
    sections = [
        _made_with(report, command),
        _section("Ratios, scene by scene", _overview(report)),
        _section("Ratios, with their spread", _ratios(report)),
        _section("What messages add, by operation of the case", _messages(report)),
        _section("Work and precision", _points(report)),
        _section("Growth", _curves(report)),
        _section("Omissions", [f"- {line}" for line in report.omissions]),
        _section("Failures", [f"- {line}" for line in report.failures]),
    ]
    return "\n\n".join(section for section in sections if section)


def _made_with(report: Report, command: str) -> str:
    kind = machine()
    software = ", ".join(f"{name} {version}" for name, version in versions().items())
    facts = [f"`{command} --seed {report.seed}`", f"{kind['processor']}, {kind['cores']} cores"]
    facts += [f"{kind['architecture']}, {kind['system']}", software]
    sizes = report.facts.get("polygons", {})
    facts += [f"{name}: {', '.join(map(str, counts))} polygons" for name, counts in sizes.items()]
    if "samples" in report.facts:
        asked = ", ".join(f"{op} {count}" for op, count in report.facts["samples"].items())
        facts.append(f"queries of a round that are asked one by one in Python: {asked}")
    if "native" in report.facts:
        facts.append(f"yardstick: `{report.facts['native']}`")
    for name, exact in report.facts.get("exact", {}).items():
        undecided = f"{exact['undecided']} undecided"
        facts.append(
            f"exact, {name}: {exact['queries']} moves, {undecided}, {duration(exact['exact_ns'])} each"
        )
    return "\n".join(f"- {fact}" for fact in facts)


def _section(title: str, lines: Iterable[str]) -> str:
    """Return a section, or nothing if it has no lines."""
    written = list(lines)
    return "\n".join([f"### {title}", "", *written]) if written else ""


def _table(head: Sequence[str], rows: Iterable[Sequence[str]]) -> Iterator[str]:
    yield f"| {' | '.join(head)} |"
    yield f"|{'|'.join(['---'] * len(head))}|"
    for row in rows:
        yield f"| {' | '.join(row)} |"


def _overview(report: Report) -> Iterable[str]:
    """Return a line for each comparison, with the ratio in each scene."""
    scenes = list(report.facts.get("polygons", {}))
    found: dict[tuple[str, ...], dict[str, str]] = {}
    for line in report.ratios:
        if line.scene in scenes:
            compared = (line.reference, line.op, f"{line.batch}", f"{line.threads}")
            found.setdefault(compared, {})[line.scene] = f"{line.comparison.ratio.middle:.2f}"
    rows = [
        (*compared, *(found[compared].get(scene, "") for scene in scenes))
        for compared in sorted(found, key=itemgetter(0))
    ]
    return _table(("reference", "op", "batch", "threads", *scenes), rows) if rows else ()


def _ratios(report: Report) -> Iterable[str]:
    head = ("scene", "op", "reference", "batch", "threads", "ratio", "quartiles", "ours", "theirs", "note")
    rows = [
        (
            line.scene,
            line.op,
            line.reference,
            f"{line.batch}",
            f"{line.threads}",
            f"{line.comparison.ratio.middle:.2f}",
            f"{line.comparison.ratio.low:.2f} - {line.comparison.ratio.high:.2f}",
            duration(line.comparison.ours.middle),
            duration(line.comparison.theirs.middle),
            line.note,
        )
        for line in report.ratios
    ]
    return _table(head, rows) if rows else ()


def _messages(report: Report) -> Iterable[str]:
    return _table(MESSAGE_COLUMNS, message_rows(report.messages)) if report.messages else ()


def _points(report: Report) -> Iterable[str]:
    if not report.points:
        return ()
    names = list(report.points[0].errors)
    rows = [
        (point.scene, point.label, duration(point.cost), *(f"{point.errors[name]:.3g}" for name in names))
        for point in report.points
    ]
    return _table(("scene", "implementation", "cost of a query", *names), rows)


def _curves(report: Report) -> Iterable[str]:
    head = ("against", "op", "sizes", "cost of a query", "exponent")
    rows = [
        (
            curve.name,
            curve.op,
            ", ".join(map(str, curve.sizes)),
            ", ".join(duration(cost.middle) for cost in curve.costs),
            "" if curve.exponent is None else f"{curve.exponent:.2f}",
        )
        for curve in report.curves
    ]
    return _table(head, rows) if rows else ()
