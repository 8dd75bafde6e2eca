"""A view as a picture that does not move, for issues and mails: PNG, drawn by matplotlib."""

from __future__ import annotations

import io
from typing import TYPE_CHECKING, Any, Final

from conformance.report.html.library import viz_module
from conformance.report.html.solids import sphere_polygons
from conformance.report.html.view import plane_patch, polygon_in_question, words_of
from conformance.scenes.algebra import add, scale, subtract

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from conformance.report.html.solids import Corners
    from conformance.report.html.steps import Mover
    from conformance.report.html.view import View
    from conformance.scenes.model import Vec3

_INCHES: Final = (9.0, 7.5)
_DPI: Final = 120
_MARGIN: Final = 1.5
"""How much is shown about the movers, metres."""
_COLOURS: Final = ("#1261a0", "#d1520a")
_SOLID: Final = "#9fb0bf"
_EDGE: Final = "#5c6b7a"
_POLYGON: Final = "#c2a000"


def picture(view: View, title: str) -> bytes:
    """Draw the step that a view begins with, and the way of both movers.

    Parameters
    ----------
    view : View
        What to draw.
    title : str
        A line above it.

    Returns
    -------
    bytes
        A PNG file.

    Raises
    ------
    MissingVizError
        matplotlib is not installed.
    """
    figure = viz_module("matplotlib.figure", "matplotlib").Figure(_INCHES, dpi=_DPI, layout="constrained")
    axes = figure.add_subplot(projection="3d")
    low, high = _box(view)
    for setter, first, last in zip((axes.set_xlim, axes.set_ylim, axes.set_zlim), low, high, strict=True):
        setter(first, last)
    axes.set_box_aspect(subtract(high, low))
    axes.set(xlabel="x (m)", ylabel="y (m)", zlabel="z (m)")
    solids = [part for solid in view.solids for part in _clipped(solid.polygons, low, high)]
    _add(axes, solids, facecolor=_SOLID, edgecolor=_EDGE, alpha=0.3, linewidth=0.6)
    step = view.steps[view.shown]
    movers = [step.retail, None if step.candidate == step.retail else step.candidate]
    for number, (mover, colour) in enumerate(zip(movers, _COLOURS, strict=True)):
        _draw_way(axes, view, number, colour, (low, high))
        if mover is not None:
            _draw_mover(axes, mover, view, colour, (low, high))
    text = "\n".join((f"{title}: {step.label}", *words_of(step, view.names)))
    figure.suptitle(text, fontsize=8, x=0.02, ha="left", parse_math=False)
    stream = io.BytesIO()
    figure.savefig(stream, format="png")
    return stream.getvalue()


def _draw_mover(axes: Any, mover: Mover, view: View, colour: str, box: tuple[Vec3, Vec3]) -> None:
    for *centre, radius in mover.spheres:
        x, y, z = centre
        surface = sphere_polygons((x, y, z), radius)
        _add(axes, surface, facecolor=colour, edgecolor=colour, alpha=0.25, linewidth=0.3)
    patch = plane_patch(mover)
    _add(axes, _clipped([patch] if patch else [], *box), facecolor=colour, alpha=0.45)
    polygon = polygon_in_question(mover, view.solids)
    _add(
        axes, _clipped([polygon] if polygon else [], *box), edgecolor=_POLYGON, facecolor="none", linewidth=3
    )
    for point in (*mover.points, *(() if mover.spheres else (mover.position,))):
        axes.plot(*([number] for number in point), "o", color=colour)


def _draw_way(axes: Any, view: View, number: int, colour: str, box: tuple[Vec3, Vec3]) -> None:
    movers = [(step.retail, step.candidate)[number] for step in view.steps]
    way = [mover.position for mover in movers if mover is not None and _is_inside(mover.position, box)]
    if way:
        axes.plot(*zip(*way, strict=True), ".-", color=colour, linewidth=1, label=view.names[number])


def _add(axes: Any, polygons: Sequence[Corners], **style: Any) -> None:
    if polygons:
        collections = viz_module("mpl_toolkits.mplot3d.art3d", "matplotlib")
        axes.add_collection3d(collections.Poly3DCollection(polygons, **style))


def _box(view: View) -> tuple[Vec3, Vec3]:
    """Return the corners of what is shown: what is about the movers at this step, or else everything."""
    step = view.steps[view.shown]
    movers = [mover for mover in (step.retail, step.candidate) if mover is not None]
    points = [point for mover in movers for point in _extent(mover)]
    points = points or [point for solid in view.solids for corners in solid.polygons for point in corners]
    axes = list(zip(*points, strict=True))
    low, high = (tuple(pick(axis) for axis in axes) for pick in (min, max))
    margin = (_MARGIN, _MARGIN, _MARGIN)
    return subtract(low, margin), add(high, margin)


def _extent(mover: Mover) -> Iterator[Vec3]:
    yield mover.position
    yield from mover.points
    for x, y, z, radius in mover.spheres:
        yield (x - radius, y - radius, z - radius)
        yield (x + radius, y + radius, z + radius)


def _is_inside(point: Vec3, box: tuple[Vec3, Vec3]) -> bool:
    return all(low <= number <= high for number, low, high in zip(point, *box, strict=True))


def _clipped(polygons: Sequence[Corners], low: Vec3, high: Vec3) -> list[Corners]:
    """Return what of polygons is in a box, which matplotlib does not cut off by itself."""
    found = []
    for corners in polygons:
        kept = corners
        for axis in range(3):
            kept = _cut(kept, axis, low[axis], 1.0)
            kept = _cut(kept, axis, high[axis], -1.0)
        if len(kept) >= 3:
            found.append(kept)
    return found


def _cut(corners: Corners, axis: int, at: float, way: float) -> Corners:
    """Return what of a convex polygon is on one side of a plane across an axis (Sutherland and Hodgman)."""
    kept: list[Vec3] = []
    for a, b in zip(corners, (*corners[1:], *corners[:1]), strict=True):
        before, after = way * (a[axis] - at), way * (b[axis] - at)
        if before >= 0.0:
            kept.append(a)
        if before * after < 0.0:
            kept.append(add(a, scale(before / (before - after), subtract(b, a))))
    return tuple(kept)
