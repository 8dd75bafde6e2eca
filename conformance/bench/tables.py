"""A report on the terminal."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from rich.table import Table

from conformance.bench.machine import machine, versions

if TYPE_CHECKING:
    from collections.abc import Sequence

    from rich.console import Console

    from conformance.bench.report import Curve, MessageCost, Point, Ratio, Report

_MICROSECOND: Final = 1000.0
"""Nanoseconds."""
_SECOND: Final = 1e9
"""Nanoseconds."""
MESSAGE_COLUMNS: Final = (
    "op",
    "floats",
    "queries",
    "in process",
    "messages add",
    "that is",
    "of all messages",
)
MOST_OPERATIONS: Final = 8
"""Operations that are told of each dialect: the rest of fifty costs next to nothing."""


def show(console: Console, report: Report) -> None:
    """Print everything that was found."""
    kind = machine()
    console.print(f"{kind['processor']}, {kind['cores']} cores, {kind['architecture']}, {kind['system']}")
    console.print(", ".join(f"{name} {version}" for name, version in versions().items()))
    console.print(f"seed {report.seed} (--seed {report.seed} asks the same queries again)")
    for name, sizes in report.facts.get("polygons", {}).items():
        console.print(f"scene {name}: {', '.join(str(size) for size in sizes)} polygons")
    if report.ratios:
        console.print(ratio_table(report.ratios), soft_wrap=False)
    if report.messages:
        console.print(message_table(report.messages), soft_wrap=False)
    if report.points:
        console.print(point_table(report.points), soft_wrap=False)
    if report.curves:
        console.print(curve_table(report.curves), soft_wrap=False)
    if report.omissions:
        console.print("omissions", style="bold")
        for line in report.omissions:
            console.print(f"  {line}", style="yellow")
    for line in report.failures:
        console.print(line, style="red")


def ratio_table(ratios: list[Ratio]) -> Table:
    """Return a line for each ratio."""
    table = Table(title="our rate / theirs, median of rounds (quartiles)")
    for column in ("scene", "op", "reference"):
        table.add_column(column)
    for column in ("batch", "threads", "ratio", "quartiles", "ours", "theirs", "rounds"):
        table.add_column(column, justify="right")
    table.add_column("note")
    for line in ratios:
        found = line.comparison
        table.add_row(
            line.scene,
            line.op,
            line.reference,
            f"{line.batch}",
            f"{line.threads}",
            f"{found.ratio.middle:.2f}",
            f"{found.ratio.low:.2f} - {found.ratio.high:.2f}",
            duration(found.ours.middle),
            duration(found.theirs.middle),
            f"{found.rounds}",
            line.note,
        )
    return table


def message_table(costs: Sequence[MessageCost]) -> Table:
    """Return a line for each operation on which messages spend most, in each dialect."""
    table = Table(title="processor time of a query, by operation of the case")
    for column in MESSAGE_COLUMNS:
        table.add_column(column, justify="left" if column in {"op", "floats"} else "right")
    for row in message_rows(costs):
        table.add_row(*row)
    return table


def message_rows(costs: Sequence[MessageCost]) -> list[tuple[str, ...]]:
    """Return the cells of `MESSAGE_COLUMNS`, for `MOST_OPERATIONS` of each dialect."""
    rows: list[tuple[str, ...]] = []
    for dialect in dict.fromkeys(cost.dialect for cost in costs):
        of_dialect = [cost for cost in costs if cost.dialect == dialect]
        all_of_them = sum(cost.messages for cost in of_dialect)
        rows += [
            (
                cost.op,
                cost.dialect,
                f"{cost.queries}",
                duration(_SECOND * cost.in_process / cost.queries),
                duration(_SECOND * cost.messages / cost.queries),
                f"{cost.share:.0%}",
                f"{cost.messages / all_of_them:.0%}",
            )
            for cost in of_dialect[:MOST_OPERATIONS]
        ]
    return rows


def curve_table(curves: list[Curve]) -> Table:
    """Return a line for each curve."""
    table = Table(title="growth of the engine's cost")
    for column in ("against", "op", "sizes", "cost of a query"):
        table.add_column(column)
    table.add_column("exponent", justify="right")
    for curve in curves:
        table.add_row(
            curve.name,
            curve.op,
            ", ".join(str(size) for size in curve.sizes),
            ", ".join(duration(cost.middle) for cost in curve.costs),
            "" if curve.exponent is None else f"{curve.exponent:.2f}",
        )
    return table


def point_table(points: list[Point]) -> Table:
    """Return a line for each implementation of the work-precision plot."""
    table = Table(title="work and precision")
    table.add_column("scene")
    table.add_column("implementation")
    table.add_column("cost of a query", justify="right")
    names = list(points[0].errors)
    for name in names:
        table.add_column(name, justify="right")
    for point in points:
        errors = (f"{point.errors[name]:.3g}" for name in names)
        table.add_row(point.scene, point.label, duration(point.cost), *errors)
    return table


def duration(nanoseconds: float) -> str:
    """Write a duration with a unit that suits it."""
    if nanoseconds < _MICROSECOND:
        return f"{nanoseconds:.0f} ns"
    if nanoseconds < _MICROSECOND**2:
        return f"{nanoseconds / _MICROSECOND:.3g} us"
    return f"{nanoseconds / _MICROSECOND**2:.3g} ms"
