"""The kill table: for each known bug what catches it, for a terminal, for the documents, for a machine."""

from __future__ import annotations

from dataclasses import asdict
from typing import TYPE_CHECKING, Any, Final

from rich.table import Table

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from conformance.bug_hunt import Record

NOTHING: Final = "nothing"
"""What stands where nothing caught a bug."""
_HEADINGS: Final = ("bug", "what it does", "retail", "pinned case", "random query")


def cells(record: Record) -> tuple[str, ...]:
    """Return a record's row: bug, mistake, retail, the case, the random query.

    All but the last come from the pinned cases and the table of bugs; the draw depends on Hypothesis.
    """
    bug = record.bug
    return f"bug:{bug.id}", bug.mistake, bug.retail, _case(record), _random(record)


def kill_table(records: Iterable[Record]) -> Table:
    """Make the table that a terminal shows."""
    table = Table()
    for heading in _HEADINGS:
        if heading != "retail":
            table.add_column(heading, overflow="fold")
    for record in records:
        name, mistake, _, case, random = cells(record)
        style = "red" if record.unexplained else None
        table.add_row(name, mistake, case, random, style=style, end_section=True)
    return table


def markdown_table(records: Iterable[Record]) -> str:
    """Write the table of the documents."""
    rows = [_HEADINGS, tuple("---" for _ in _HEADINGS), *map(cells, records)]
    return "".join(f"| {' | '.join(row)} |\n" for row in rows)


def verdict(records: Sequence[Record]) -> str:
    """Say in a line how many are caught, and which are not."""
    missed = [f"bug:{r.bug.id} ({', '.join(r.unexplained)})" for r in records if r.unexplained]
    caught = f"{len(records) - len(missed)} of {len(records)} known bugs are caught or explained"
    return f"{caught}; missed by: {', '.join(missed)}" if missed else caught


def as_json(records: Iterable[Record]) -> list[dict[str, Any]]:
    """Return the records for a machine to read."""
    return [
        {
            "bug": record.bug.id,
            "mistake": record.bug.mistake,
            "retail": record.bug.retail,
            "case": record.bug.case,
            "cases": [asdict(kill) for kill in record.cases],
            "random": None if record.random is None else asdict(record.random),
            "asked": record.asked,
            "different": record.different,
            "survives": record.bug.survives,
        }
        for record in records
    ]


def _case(record: Record) -> str:
    kill = record.named_case
    if kill is None:
        return record.bug.survives or NOTHING
    return f"{kill.where}: {kill.output}"


def _random(record: Record) -> str:
    kill = record.random
    if kill is None:
        return record.bug.survives or NOTHING
    rates = f"; differs in {record.rates}" if record.bug.rated else ""
    return f"{kill.where}, draw {kill.draw}: {kill.op}, {kill.output}{rates}"
