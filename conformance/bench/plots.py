"""Plots of a report, as SVG and PNG; matplotlib comes with an extra."""

from __future__ import annotations

import itertools
import math
from functools import partial
from importlib import import_module
from typing import TYPE_CHECKING, Any, Final

from conformance.bench.figures import pareto
from conformance.bench.machine import machine
from conformance.bench.peers import MODULES

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence
    from pathlib import Path

    from conformance.bench.report import Curve, Point, Ratio, Report

FORMATS: Final = ("svg", "png")
_SVG_SALT: Final = "conformance bench"
"""Ids in SVG files are derived from it, so that the same numbers make the same file."""

_WIDTH: Final = 11.0
_ROW: Final = 3.25
_MARGIN: Final = 1.0
"""Width of a sheet, height of a row of panels, and what is about them, inches."""
_COLUMNS: Final = 2
"""Panels beside each other."""
_BARS: Final = 25
"""Bars that are as high as a row of panels."""
_TICKS: Final = 6
_HEADROOM: Final = 3.0
"""How much farther than what is measured an axis of costs reaches, so that noise does not fill a panel."""
_MARKS: Final = "osD^v"


class NoPlotsError(Exception):
    """matplotlib is not installed."""


def write_plots(report: Report, folder: Path) -> list[Path]:
    """Draw everything that was measured; return the files.

    Raises
    ------
    NoPlotsError
        If matplotlib is not installed.
    """
    figures = import_matplotlib()
    folder.mkdir(parents=True, exist_ok=True)
    sheets: list[tuple[str, int, Callable[[Any], None]]] = []
    if report.ratios:
        sheets.append(("ratios", len(report.ratios) // _BARS, partial(_draw_ratios, ratios=report.ratios)))
    if report.curves:
        names = len({curve.name for curve in report.curves})
        sheets.append(("scaling", _rows(names), partial(_draw_curves, curves=report.curves)))
    if report.points:
        measures = len(report.points[0].errors)
        sheets.append(("work-precision", _rows(measures), partial(_draw_points, points=report.points)))
    return [path for sheet in sheets for path in _save(figures, folder, *sheet)]


def import_matplotlib() -> Any:
    """Return matplotlib's module of figures.

    Raises
    ------
    NoPlotsError
        If matplotlib is not installed.
    """
    try:
        matplotlib = import_module("matplotlib")
        figures = import_module("matplotlib.figure")
    except ImportError as error:
        raise NoPlotsError("plots need matplotlib (extra `bench`)") from error
    matplotlib.rcParams["svg.hashsalt"] = _SVG_SALT
    return figures


def _rows(panels: int) -> int:
    return math.ceil(panels / _COLUMNS)


def _save(figures: Any, folder: Path, name: str, rows: int, draw: Callable[[Any], None]) -> list[Path]:
    """Draw a sheet, as high as its rows need."""
    figure = figures.Figure(figsize=(_WIDTH, _ROW * max(rows, 1) + _MARGIN), layout="constrained")
    draw(figure)
    kind = machine()
    figure.supxlabel(f"{kind['processor']}, {kind['cores']} cores", fontsize="x-small", color="gray")
    paths = [folder / f"{name}.{suffix}" for suffix in FORMATS]
    for path in paths:
        metadata = {"Date": None} if path.suffix == ".svg" else {}
        figure.savefig(path, metadata=metadata)
    return paths


def _panels(figure: Any, count: int) -> list[Any]:
    """Return axes for so many panels; a row that is not full has room left."""
    grid = figure.subplots(_rows(count), min(count, _COLUMNS), squeeze=False).ravel().tolist()
    for unused in grid[count:]:
        unused.set_axis_off()
    return list(grid[:count])


def _draw_ratios(figure: Any, ratios: Sequence[Ratio]) -> None:
    """Draw a bar for each ratio, on a logarithmic axis, with its quartiles."""
    axes = figure.subplots()
    found = [ratio.comparison.ratio for ratio in ratios]
    labels = [_label(ratio) for ratio in ratios]
    spread = [[each.middle - each.low for each in found], [each.high - each.middle for each in found]]
    places = range(len(ratios))
    axes.barh(places, [each.middle for each in found], xerr=spread, color="steelblue", ecolor="black")
    axes.set_yticks(places, labels, fontsize="x-small")
    axes.invert_yaxis()
    axes.margins(y=0.01)
    axes.set_xscale("log")
    axes.axvline(1.0, color="black", linewidth=0.8)
    axes.set_xlabel("our rate / theirs (scene: op / reference, batch x threads), median and quartiles")


def _label(line: Ratio) -> str:
    """Say what a bar is; what a peer's note says of differing answers has no room there."""
    beside = (
        line.reference if line.reference in MODULES or not line.note else f"{line.reference} ({line.note})"
    )
    return f"{line.scene}: {line.op} / {beside}, {line.batch} x {line.threads}"


def _draw_curves(figure: Any, curves: Sequence[Curve]) -> None:
    """Draw a panel for each thing that grows."""
    names = list(dict.fromkeys(curve.name for curve in curves))
    for panel, name in zip(_panels(figure, len(names)), names, strict=True):
        for curve in (c for c in curves if c.name == name):
            costs = [cost.middle for cost in curve.costs]
            spread = [[c.middle - c.low for c in curve.costs], [c.high - c.middle for c in curve.costs]]
            fitted = "" if curve.exponent is None else f": exponent {curve.exponent:.2f}"
            label = f"{curve.op}{fitted}"
            panel.errorbar(curve.sizes, costs, yerr=spread, marker="o", capsize=3, label=label)
        panel.set_xscale("log")
        panel.set_yscale("log")
        medians = [cost.middle for curve in curves if curve.name == name for cost in curve.costs]
        panel.set_ylim(min(medians) / _HEADROOM, max(medians) * _HEADROOM)
        panel.set_xlabel(name)
        panel.set_ylabel("nanoseconds a query")
        panel.legend(fontsize="x-small")


def _draw_points(figure: Any, points: Sequence[Point]) -> None:
    """Draw error against cost: colours are implementations, marks are scenes.

    The line of each scene joins what no other implementation beats in both.
    """
    measures = list(points[0].errors)
    scenes = list(dict.fromkeys(point.scene for point in points))
    labels = list(dict.fromkeys(point.label for point in points))
    panels = _panels(figure, len(measures))
    for panel, measure in zip(panels, measures, strict=True):
        for scene, mark in zip(scenes, itertools.cycle(_MARKS), strict=False):
            there = [p for p in points if p.scene == scene and math.isfinite(p.errors[measure])]
            for point in there:
                colour = f"C{labels.index(point.label)}"
                label = f"{scene}: {point.label}"
                panel.plot(point.errors[measure], point.cost, mark, color=colour, linestyle="", label=label)
            places = [(point.errors[measure], point.cost) for point in there]
            line = [places[i] for i in pareto(places)]
            panel.plot([x for x, _ in line], [y for _, y in line], "--", color="gray", linewidth=0.8)
        panel.set_xscale("symlog", linthresh=_smallest(points, measure))
        panel.xaxis.get_major_locator().set_params(numticks=_TICKS)
        panel.set_yscale("log")
        panel.set_xlabel(f"{measure}, against exact")
        panel.set_ylabel("nanoseconds a query")
    handles, named = panels[0].get_legend_handles_labels()
    figure.legend(handles, named, loc="outside right upper", fontsize="x-small")


def _smallest(points: Sequence[Point], measure: str) -> float:
    """Return the smallest error that is not 0: below it the axis is linear, so that 0 has a place."""
    return min((p.errors[measure] for p in points if p.errors[measure] > 0.0), default=1.0)
