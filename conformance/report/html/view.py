"""What a 3-D view of a case shows: the solids, and of each step the movers, their planes and polygons."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Final

from conformance.floats import decimal32
from conformance.report.html.solids import Frame, is_drawable, solids_of
from conformance.report.html.steps import steps_of
from conformance.report.values import format_point
from conformance.scenes.algebra import add, cross, dot, length, scale, subtract

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Sequence

    from conformance.report.html.entries import Details, Entry
    from conformance.report.html.solids import Corners, Solid
    from conformance.report.html.steps import Mover, Step
    from conformance.scenes.model import PlaneData, Vec3

_PATCH: Final = 0.9
"""Half the edge of the square that a plane is drawn as, metres."""
_SAME_WAY: Final = 0.9999
"""Cosine from which on a polygon faces as a plane does; a pure number."""
_IN_PLANE: Final = 0.005
"""How far a corner may be from a plane that its polygon lies in, metres; for drawing only."""
_DIGITS: Final = 6
"""Decimals of a coordinate in the page: micrometres."""


@dataclass(frozen=True, slots=True)
class View:
    """A scene to look at.

    Attributes
    ----------
    solids : sequence of Solid
        What does not move.
    steps : sequence of Step
        What does.
    names : tuple of str
        What the two movers are called: retail, and the candidate.
    shown : int
        The number of the step to begin with.
    """

    solids: Sequence[Solid]
    steps: Sequence[Step]
    names: tuple[str, str]
    shown: int


def view_of(details: Details, candidate: str) -> View | None:
    """Return the view of a page; None where an operation has neither a scene nor a mover.

    Parameters
    ----------
    details : Details
        The page.
    candidate : str
        What the candidate is called.
    """
    query = details.query
    frame = Frame(_first_cell(query.inputs))
    solids = solids_of(query, frame)
    steps = steps_of(query, details.retail, details.candidate, frame)
    if not solids and not any(step.retail or step.candidate for step in steps):
        return None
    last = len(steps) - 1
    shown = last if details.tick is None else min(details.tick + 1, last)  # the first step is the start
    return View(solids, steps, ("retail", candidate), shown)


def views_of(entries: Iterable[Entry], candidate: str) -> dict[str, dict[str, Any]]:
    """Return by case id the data of every view; cases without a page, or with nothing to see, have none."""
    pages = ((entry.case.id, entry.details) for entry in entries if entry.details)
    views = ((case_id, view_of(details, candidate)) for case_id, details in pages)
    return {case_id: view_data(view) for case_id, view in views if view}


def view_data(view: View) -> dict[str, Any]:
    """Return a view as the page's script reads it; coordinates in metres, rounded."""
    return {
        "names": list(view.names),
        "at": view.shown,
        "solids": [{"name": one.name, "polygons": _rounded(one.polygons)} for one in view.solids],
        "steps": [_step_data(step, view) for step in view.steps],
    }


def polygon_in_question(mover: Mover, solids: Sequence[Solid]) -> Corners | None:
    """Return the polygon that is named, or else the one that lies in the contact plane next to the mover."""
    found = list(_named(mover, solids))
    if not found and mover.plane is not None:
        plane = _in_view(mover.plane, mover.block)
        found = [corners for solid in solids for corners in solid.polygons if _lies_in(corners, plane)]
    return min(found, key=lambda corners: _distance(corners, mover.position), default=None)


def plane_patch(mover: Mover) -> Corners | None:
    """Return a square of the contact plane under the mover."""
    if mover.plane is None:
        return None
    nx, ny, nz, d = _in_view(mover.plane, mover.block)
    normal = (nx, ny, nz)
    size = dot(normal, normal)
    if size == 0.0:
        return None
    foot = subtract(mover.position, scale((dot(normal, mover.position) + d) / size, normal))
    along = _unit(cross(normal, (1.0, 0.0, 0.0) if abs(nx) < abs(nz) else (0.0, 0.0, 1.0)))
    across = _unit(cross(normal, along))
    signs = ((1, 1), (-1, 1), (-1, -1), (1, -1))
    patch = tuple(add(foot, add(scale(_PATCH * a, along), scale(_PATCH * b, across))) for a, b in signs)
    return patch if is_drawable(patch) else None


def words_of(step: Step, names: tuple[str, str]) -> Iterator[str]:
    """Say where both movers are, and on which planes; once if they agree."""
    if step.retail is None and step.candidate is None:
        yield "nothing moves here"
    elif step.retail == step.candidate:
        yield f"{' and '.join(names)}: {_words(step.retail)}"
    else:
        movers = (step.retail, step.candidate)
        yield from (f"{name}: {_words(mover)}" for name, mover in zip(names, movers, strict=True))


def _named(mover: Mover, solids: Sequence[Solid]) -> Iterator[Corners]:
    """Yield the polygons of a name: several, where a geometry stands in several places."""
    if mover.polygon is not None and mover.geometry:
        for solid in solids:
            if solid.geometry == mover.geometry and 0 <= mover.polygon < len(solid.polygons):
                yield solid.polygons[mover.polygon]


def _step_data(step: Step, view: View) -> dict[str, Any]:
    movers = [step.retail, step.candidate]
    return {
        "label": step.label,
        "text": "\n".join(words_of(step, view.names)),
        "same": step.retail == step.candidate,
        "movers": [mover and _mover_data(mover, view.solids) for mover in movers],
    }


def _mover_data(mover: Mover, solids: Sequence[Solid]) -> dict[str, Any]:
    return {
        "position": _rounded(mover.position),
        "spheres": _rounded(mover.spheres),
        "points": _rounded(mover.points),
        "plane": _rounded(plane_patch(mover)),
        "polygon": _rounded(polygon_in_question(mover, solids)),
    }


def _words(mover: Mover | None) -> str:
    if mover is None:
        return "nowhere"
    position = f"at {format_point(mover.position)}"
    if mover.plane is None:
        return f"{position}, no contact plane"
    nx, ny, nz, d = mover.plane
    return f"{position}, contact plane n={format_point((nx, ny, nz))} d={decimal32(d)}"


def _first_cell(inputs: Any) -> int:
    """Return a cell of the landblock that a query begins in; 0 if it names none."""
    for key in ("from", "start", "position", "to", "pose"):
        if isinstance(inputs.get(key), dict):
            return int(inputs[key]["cell"])
    body = inputs.get("body", {}).get("position")
    if body:
        return int(body["cell"])
    if isinstance(inputs.get("block"), int):
        return int(inputs["block"]) << 16
    cell = inputs.get("cell")
    return cell if isinstance(cell, int) else 0


def _in_view(plane: PlaneData, block: Vec3) -> PlaneData:
    nx, ny, nz, d = plane
    return (nx, ny, nz, d - dot((nx, ny, nz), block))


def _lies_in(corners: Corners, plane: PlaneData) -> bool:
    nx, ny, nz, d = plane
    normal = (nx, ny, nz)
    if any(abs(dot(normal, corner) + d) > _IN_PLANE for corner in corners):
        return False
    own = cross(subtract(corners[1], corners[0]), subtract(corners[2], corners[0]))
    return dot(own, normal) > _SAME_WAY * length(own) * length(normal)


def _distance(corners: Corners, point: Vec3) -> float:
    """Return how far a point is from a polygon, seen from above its plane; 0 inside, metres."""
    normal = cross(subtract(corners[1], corners[0]), subtract(corners[2], corners[0]))
    beyond = 0.0
    for a, b in zip(corners, (*corners[1:], corners[0]), strict=True):
        outwards = _unit(cross(subtract(b, a), normal))
        beyond = max(beyond, dot(subtract(point, a), outwards))
    return beyond


def _unit(vector: Vec3) -> Vec3:
    size = length(vector)
    return scale(1.0 / size, vector) if size > 0.0 else (0.0, 0.0, 0.0)


def _rounded(value: Any) -> Any:
    if isinstance(value, float):
        return round(value, _DIGITS)
    return [_rounded(item) for item in value] if isinstance(value, tuple | list) else value
