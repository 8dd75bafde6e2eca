"""What a run has found, for a terminal."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from rich.table import Table

from conformance.stress.findings import CANDIDATE, DIFFERING, RETAIL
from conformance.stress.limits import EVERYWHERE, LIMITS, limits
from conformance.stress.quantities import HEADINGS

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from rich.console import Console

    from conformance.stress.findings import Findings, Reading
    from conformance.stress.limits import Limit

SHOWN: Final = 10
"""Lines of what differs, and of what is not answered."""
MODELS: Final = (RETAIL, "single", "double")
_JSON_ONLY: Final = frozenset({DIFFERING, "contact_ulps", "normal_radians"})
"""Quantities without a column of this name."""
_COUNTS: Final = frozenset({"refused", "undecided", "other_paths"})
"""Counts that get a column only if one of them is not 0."""


def show(console: Console, findings: Findings, candidate: str) -> None:
    """Print a table for each family, how far errors stay small, and what was noticed."""
    for family in findings.families:
        console.print(family_table(findings, family, candidate))
    reached = list(limits(findings, MODELS))
    if reached:
        console.print(limit_table(reached))
    _show_some(console, "differs", findings.differences, "differences")
    _show_some(console, "no answer", findings.errors, "answers that are missing")
    for note in findings.notes:
        console.print(f"note: {note}", style="yellow")
    for failure in findings.failures:
        console.print(f"failure: {failure}", style="red")


def _show_some(console: Console, what: str, texts: list[str], of_all: str) -> None:
    for text in texts[:SHOWN]:
        console.print(f"{what}: {text}", style="red")
    if (left := len(texts) - SHOWN) > 0:
        console.print(f"... and {left} other {of_all}", style="red")


def family_table(findings: Findings, family: str, candidate: str) -> Table:
    """Make a family's table: a line for each severity, each quantity for retail / single / double."""
    seconds = findings.costs.get(family, 0.0)
    rows: dict[tuple[str, float], dict[str, Reading]] = {}
    for reading in findings.readings:
        if reading.family == family:
            rows.setdefault((reading.sweep, reading.severity), {})[reading.model] = reading
    rows = {place: row for place, row in rows.items() if _is_whole(row)} or rows
    names = [name for name in HEADINGS if name not in _JSON_ONLY and _is_shown(name, rows)]
    told = "largest of each severity: retail / single / double, or one for all"
    table = Table(title=family, caption=f"{told}; {seconds:.1f} s of work")
    for heading in ("sweep", "at", *(HEADINGS[name] for name in names), f"{candidate}: not retail's"):
        table.add_column(heading, overflow="fold")
    order = {sweep: place for place, sweep in enumerate(sorted(findings.sweeps(family)))}
    for sweep, severity in sorted(rows, key=lambda row: (order[row[0]], row[1])):
        readings = rows[sweep, severity]
        cells = [_cell(readings, name) for name in names]
        table.add_row(sweep, f"{severity:g}", *cells, _one(readings.get(CANDIDATE), DIFFERING))
    return table


def limit_table(found: list[Limit]) -> Table:
    """Make the table of how far each rounding keeps a length within a millimetre and a centimetre."""
    table = Table(
        title="up to which severity errors stay small",
        caption="retail / single / double; lengths that stay small everywhere are left out",
    )
    headings = ("family", "sweep", "length", *(f"within {limit:g} m" for limit in LIMITS))
    for heading in headings:
        table.add_column(heading, overflow="fold")
    rows: dict[tuple[str, str, str], dict[float, list[str]]] = {}
    for limit in found:
        row = rows.setdefault((limit.family, limit.sweep, limit.quantity), {})
        row.setdefault(limit.limit, []).append(limit.words)
    for (family, sweep, quantity), reached in rows.items():
        if all(words == EVERYWHERE for told in reached.values() for words in told):
            continue
        columns = (" / ".join(reached.get(limit, ())) for limit in LIMITS)
        table.add_row(family, sweep, HEADINGS[quantity], *columns)
    return table


def _is_whole(row: Mapping[str, Reading]) -> bool:
    """Tell whether readings are those of a whole square: its single columns are for plots and JSON."""
    return any("band_steps" in reading.quantities for reading in row.values())


def _is_shown(name: str, rows: Mapping[tuple[str, float], Mapping[str, Reading]]) -> bool:
    values = [r.quantities[name] for row in rows.values() for r in row.values() if name in r.quantities]
    return any(values) if name in _COUNTS else bool(values)


def _cell(readings: Mapping[str, Reading], name: str) -> str:
    told = list(_told(readings, name))
    return told[0] if len(set(told)) == 1 else " / ".join(told)


def _told(readings: Mapping[str, Reading], name: str) -> Iterator[str]:
    for model in MODELS:
        yield _one(readings.get(model), name)


def _one(reading: Reading | None, name: str) -> str:
    value = None if reading is None else reading.quantities.get(name)
    return "-" if value is None else f"{value:.2g}" if value < 1.0 else f"{value:.5g}"
