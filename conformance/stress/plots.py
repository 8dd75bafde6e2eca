"""Plots of a run, as SVG and PNG: a sheet for each family, quantity against severity."""

from __future__ import annotations

import math
from functools import partial
from importlib import import_module
from typing import TYPE_CHECKING, Any, Final

from conformance.bench.plots import FORMATS, import_matplotlib
from conformance.stress.families import FAMILIES
from conformance.stress.findings import RETAIL
from conformance.stress.quantities import HEADINGS

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence
    from pathlib import Path

    from conformance.stress.findings import Findings
    from conformance.stress.runner import Plan

DRAWN: Final[Mapping[str, tuple[str, ...]]] = {
    "translation": ("contact_metres", "position_metres", "effect_metres"),
    "rotation": ("effect_metres", "turned_radians"),
    "degenerate": ("contact_metres", "effect_metres"),
    "drift": ("contact_metres", "height_metres", "astray_metres"),
    "scale": ("plane_off_metres", "formula_metres"),
}
"""Quantities of each family that are drawn as curves."""
CHANGE: Final = 5.0
"""By what factor a quantity must change along its sweep to be drawn."""
LEVEL_IS_NEWS: Final = frozenset({"drift"})
"""Families of which every quantity is drawn: that it does not change is what is found."""
SIGN_COLOURS: Final = ("#f2f2f2", "#d95f02", "#1b9e77", "#4575b4")
"""Of a sign picture: neither says yes; retail alone; exact alone; both."""
SIGN_NAMES: Final = ("no", "yes to retail alone", "yes to exact alone", "yes")
_MODELS: Final = (RETAIL, "single", "double")
_MARKS: Final = {RETAIL: "o-", "single": "s--", "double": "^:"}
_WIDTH: Final = 11.0
_ROW: Final = 3.25
_MARGIN: Final = 1.0
"""Width of a sheet, height of a row of panels, and what is about them, inches."""
_COLUMNS: Final = 2
_PICTURE_COLUMNS: Final = 4
_PICTURE_ROW: Final = 2.9


def write_plots(findings: Findings, plan: Plan, folder: Path) -> list[Path]:
    """Draw everything that was found; return the files.

    Raises
    ------
    NoPlotsError
        If matplotlib is not installed.
    """
    figures = import_matplotlib()
    folder.mkdir(parents=True, exist_ok=True)
    paths: list[Path] = []
    for family in findings.families:
        panels = _panels(findings, plan, family)
        if panels:
            paths += _save(figures, folder / family, panels, _COLUMNS, _ROW)
    if findings.pictures:
        pictures: list[Panel] = [partial(_draw_signs, picture=picture) for picture in findings.pictures]
        paths += _save(figures, folder / "signs", pictures, _PICTURE_COLUMNS, _PICTURE_ROW, _sign_legend)
    return paths


if TYPE_CHECKING:
    Panel = Callable[[Any], None]


def _panels(findings: Findings, plan: Plan, family: str) -> list[Panel]:
    """Return what draws each sweep's errors in metres, side by side."""
    axes = {sweep.name: sweep.axis for sweep in FAMILIES[family](plan.settings)}
    panels: list[Panel] = []
    for sweep, axis in axes.items():
        for quantity in DRAWN.get(family, ()):
            curves = {model: findings.curve(family, sweep, model, quantity) for model in _MODELS}
            if curves[RETAIL] and (family in LEVEL_IS_NEWS or _changes(curves[RETAIL])):
                panels.append(partial(_draw_curves, title=sweep, axis=axis, quantity=quantity, curves=curves))
    return panels


def _changes(curve: Sequence[tuple[float, float]]) -> bool:
    """Tell whether a quantity depends on severity at all: mostly a level line is not worth a panel."""
    sizes = [abs(value) for _, value in curve]
    return len(sizes) > 1 and max(sizes) > CHANGE * min(sizes)


def _draw_curves(
    axes: Any, *, title: str, axis: str, quantity: str, curves: dict[str, list[tuple[float, float]]]
) -> None:
    """Draw a quantity against severity, a line for each rounding; 0 has a place on both axes."""
    for model, curve in curves.items():
        if curve:
            axes.plot(*zip(*curve, strict=True), _MARKS[model], label=model, markersize=4)
    axes.set_title(title, fontsize="small")
    axes.set_xscale("symlog", linthresh=_smallest(s for curve in curves.values() for s, _ in curve))
    axes.set_yscale("symlog", linthresh=_smallest(v for curve in curves.values() for _, v in curve))
    axes.yaxis.get_major_locator().set_params(numticks=8)
    axes.set_xlabel(axis, fontsize="small")
    axes.set_ylabel(HEADINGS[quantity], fontsize="small")
    axes.tick_params(labelsize="x-small")
    axes.grid(visible=True, linewidth=0.3)
    axes.legend(fontsize="x-small")


def _smallest(values: Any) -> float:
    """Return the smallest size that is not 0: below it an axis is linear."""
    return min((abs(value) for value in values if value and math.isfinite(value)), default=1.0)


def _draw_signs(axes: Any, *, picture: Any) -> None:
    """Draw a grid of decisions, the threshold in the middle."""
    colours = [[SIGN_COLOURS[sign] for sign in row] for row in picture.signs]
    half = len(picture.signs) // 2
    shown = [[[int(colour[i : i + 2], 16) for i in (1, 3, 5)] for colour in row] for row in colours]
    axes.imshow(shown, origin="lower", extent=(-half, half, -half, half), interpolation="nearest")
    axes.set_title(picture.name, fontsize="x-small")
    axes.set_xlabel(f"{picture.axes[0]} (steps)", fontsize="x-small")
    axes.set_ylabel(f"{picture.axes[1]} (steps)", fontsize="x-small")
    axes.tick_params(labelsize="x-small")


def _sign_legend(figure: Any) -> None:
    patch = import_module("matplotlib.patches").Patch
    patches = [patch(color=colour, label=name) for colour, name in zip(SIGN_COLOURS, SIGN_NAMES, strict=True)]
    figure.legend(handles=patches, loc="outside lower center", ncols=len(patches), fontsize="x-small")


def _save(
    figures: Any,
    stem: Path,
    panels: Sequence[Panel],
    columns: int,
    row: float,
    decorate: Callable[[Any], None] | None = None,
) -> list[Path]:
    """Draw a sheet of panels, as high as its rows need."""
    rows = math.ceil(len(panels) / columns)
    figure = figures.Figure(figsize=(_WIDTH, row * rows + _MARGIN), layout="constrained")
    grid = figure.subplots(rows, columns, squeeze=False).ravel().tolist()
    for axes, draw in zip(grid, panels, strict=False):
        draw(axes)
    for unused in grid[len(panels) :]:
        unused.set_axis_off()
    if decorate is not None:
        decorate(figure)
    paths = [stem.with_suffix(f".{suffix}") for suffix in FORMATS]
    for path in paths:
        figure.savefig(path, metadata={"Date": None} if path.suffix == ".svg" else {})
    return paths
