"""A report on the terminal."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from rich.table import Table

from conformance.bench.machine import machine, versions

if TYPE_CHECKING:
    from rich.console import Console

    from conformance.bench.report import Curve, Point, Ratio, Report

_MICROSECOND: Final = 1000.0
"""Nanoseconds."""


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
