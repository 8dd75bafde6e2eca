"""The work of a query as a table."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from rich.table import Table

if TYPE_CHECKING:
    from conformance.work import WorkReport

_ROWS: Final = (
    ("transitions", "queries"),
    ("nodes visited", "nodes"),
    ("polygons tested", "polygons"),
    ("objects tested", "objects"),
    ("cells listed", "cells"),
)
_SHORTCUTS: Final = (
    ("portals not looked behind", "portals"),
    ("objects passed over", "things"),
    ("grounds passed over", "grounds"),
    ("sub-steps flown freely", "flights"),
    ("walks without bounding spheres", "unbounded"),
    ("walks not made", "unwalked"),
)


def work_table(report: WorkReport) -> Table:
    """Return the table: with shortcuts, without, and by brute force."""
    table = Table(caption=f"{report.avoided:.1%} of the polygon tests of brute force are avoided")
    for name in ("", "with shortcuts", "without", "brute force"):
        table.add_column(name, justify="right" if name else "left")
    for title, name in _ROWS:
        brute = str(report.scanned) if name == "polygons" else ""
        table.add_row(title, str(getattr(report.planned, name)), str(getattr(report.unplanned, name)), brute)
    table.add_row("walks through trees", "", str(report.walks), str(report.walks))
    table.add_section()
    for title, name in _SHORTCUTS:
        table.add_row(title, str(getattr(report.planned, name)))
    return table
