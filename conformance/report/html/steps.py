"""How the mover of a query goes, step by step, for retail and for the candidate."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Final

from conformance.report.html.solids import is_drawable
from conformance.scenes.algebra import add
from conformance.step_outputs import STEP_OF, start_of, steps

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping, Sequence

    from conformance.query import Fields, Query
    from conformance.report.html.solids import Frame
    from conformance.scenes.model import PlaneData, SphereData, Vec3

_MOVES: Final = ("transition", "object_transition", "world_transition", "find_transitional_position")
"""Operations whose answer is the position that is reached; of the others it is the one that is checked."""

_ILL_SHAPED: Final = (AttributeError, IndexError, KeyError, TypeError, ValueError, OverflowError)
"""What reading an answer raises that has not the shape of its operation's."""


@dataclass(frozen=True, slots=True)
class Mover:
    """Where somebody's mover is after a step.

    Attributes
    ----------
    position : Vec3
        Its origin, metres, in the frame of the view.
    spheres : tuple of SphereData
        In the same frame.
    plane : PlaneData or None
        The contact plane, as the answer says it.
    block : Vec3
        Where the landblock lies whose frame the plane is in, metres.
    points : tuple of Vec3
        Points of the answer, such as where a polygon is touched.
    polygon : int or None
        The number of a polygon that the query or the answer names.
    geometry : str
        Whose polygon it is.
    """

    position: Vec3
    spheres: tuple[SphereData, ...] = ()
    plane: PlaneData | None = None
    block: Vec3 = (0.0, 0.0, 0.0)
    points: tuple[Vec3, ...] = ()
    polygon: int | None = None
    geometry: str = ""


@dataclass(frozen=True, slots=True)
class Step:
    """A step: what it is called, and where both movers are after it; None where there is no answer."""

    label: str
    retail: Mover | None
    candidate: Mover | None


def steps_of(query: Query, retail: Fields | None, candidate: Fields | None, frame: Frame) -> list[Step]:
    """Return the steps of a query, those that are asked for first, then the answers'.

    Parameters
    ----------
    query : Query
        Any operation.
    retail, candidate : Fields or None
        The two answers.
    frame : Frame
        Of the view.
    """
    ways = [_way_as_answered(query, answer, frame) for answer in (retail, candidate)]
    length = max(map(len, ways))
    labels = [label for label, _ in max(ways, key=len)]
    movers = [[mover for _, mover in way] + [None] * (length - len(way)) for way in ways]
    return [Step(label, one, other) for label, one, other in zip(labels, *movers, strict=True)]


def _way_as_answered(query: Query, answer: Fields | None, frame: Frame) -> list[tuple[str, Mover | None]]:
    """Return the way of an answer; of one of another shape, which the table tells of, what was asked."""
    try:
        return [(label, _drawable(mover)) for label, mover in _way(query, answer, frame)]
    except _ILL_SHAPED:
        return [(label, _drawable(mover)) for label, mover in _way(query, None, frame)]


def _way(query: Query, answer: Fields | None, frame: Frame) -> list[tuple[str, Mover | None]]:
    inputs = query.inputs
    if query.op in STEP_OF:
        return list(_walk(query, answer, frame))
    if "mover" in inputs and isinstance(inputs.get("to"), dict):
        return list(_move(query, answer, frame))
    if ("sphere" in inputs or "point" in inputs) and ("geometry" in inputs or "world" in inputs):
        return list(_local(query, answer))
    if "position" in inputs:
        spheres = tuple(_shifted(frame.offset(inputs["position"]["cell"]), inputs.get("spheres", ())))
        origin = _origin(inputs["position"], frame)
        return [("asked", Mover(origin, spheres))]
    if inputs.get("body", {}).get("position"):
        return list(_body(query, answer, frame))
    return [("scene", None)]


def _walk(query: Query, answer: Fields | None, frame: Frame) -> Iterator[tuple[str, Mover | None]]:
    start = start_of(query)
    inputs = query.inputs
    pose = inputs["start"] if "start" in inputs else inputs["body"].get("position")
    rotation = pose["rotation"] if pose else [1.0, 0.0, 0.0, 0.0]
    yield "start", _standing(query, {**start, "rotation": rotation}, frame)
    ticks: Sequence[Fields] = answer["ticks"] if answer else ()
    for number, (tick, after) in enumerate(zip(ticks, steps(query.op, start, ticks), strict=True)):
        rotation = tick.get("rot", rotation)
        yield f"tick {number}", _standing(query, {**after, "rotation": rotation}, frame)


def _standing(query: Query, state: Fields, frame: Frame) -> Mover:
    pose = {"cell": state["cell"], "origin": state["position"], "rotation": state["rotation"]}
    return _mover(query, pose, frame, plane=state["contact_plane"])


def _move(query: Query, answer: Fields | None, frame: Frame) -> Iterator[tuple[str, Mover | None]]:
    inputs = query.inputs
    if isinstance(inputs["from"], dict):
        yield "from", _mover(query, inputs["from"], frame)
    yield "to, as asked", _mover(query, inputs["to"], frame)
    pose = _answered_pose(query, answer or {})
    if answer is not None and pose is not None:
        plane = answer.get("contact_plane", {})
        reached = _mover(
            query,
            pose,
            frame,
            plane=plane["plane"] if plane.get("valid") else None,
            plane_cell=plane.get("cell_id"),
            polygon=answer.get("walkable"),
            geometry=answer.get("walkable_geometry") or inputs.get("geometry") or "",
        )
        yield "answer", reached


def _answered_pose(query: Query, answer: Fields) -> Mapping[str, Any] | None:
    if "check_origin" in answer:
        return {**query.inputs["to"], "origin": answer["check_origin"]}
    pose: Mapping[str, Any] | None = answer.get("curr" if query.op in _MOVES else "check")
    return pose


def _local(query: Query, answer: Fields | None) -> Iterator[tuple[str, Mover | None]]:
    """Tell of a sphere or a point in a geometry's own frame."""
    inputs = query.inputs
    *centre, radius = inputs.get("sphere") or (*inputs["point"], 0.0)
    named = {"polygon": inputs.get("poly"), "geometry": inputs.get("geometry", "")}

    def at(point: Any, **more: Any) -> Mover:
        x, y, z = point
        spheres = ((x, y, z, radius),) if radius else ()
        return Mover((x, y, z), spheres, **{"points": () if radius else ((x, y, z),), **named, **more})

    if "curr" in inputs:
        yield "before", at(inputs["curr"])
    yield "asked", at(centre)
    if "movement" in inputs and "curr" not in inputs:
        yield "asked, moved", at(add(tuple(centre), tuple(inputs["movement"])))
    if answer is not None:
        contact = answer.get("contact")
        number = answer.get("poly", named["polygon"])
        points = (tuple(contact),) if contact else ()
        yield "answer", at(answer.get("center", centre), points=points, polygon=number)


def _body(query: Query, answer: Fields | None, frame: Frame) -> Iterator[tuple[str, Mover | None]]:
    before = query.inputs["body"]["position"]
    yield "before", _mover(query, before, frame)
    asked = query.inputs.get("to")
    if isinstance(asked, dict):
        yield "to, as asked", _mover(query, asked, frame)
    if answer is not None:
        moved: dict[str, Any] = {key: answer[key] for key in ("origin", "rotation") if key in answer}
        yield "answer", _mover(query, answer.get("position") or {**before, **moved}, frame)


def _mover(
    query: Query,
    pose: Mapping[str, Any],
    frame: Frame,
    *,
    plane: Any = None,
    plane_cell: int | None = None,
    polygon: int | None = None,
    geometry: str = "",
) -> Mover:
    body = query.inputs.get("mover") or query.inputs.get("body", {})
    factor = body.get("scale", 1.0)
    spheres = body.get("spheres", ())
    centres = frame.place(pose, [sphere[:3] for sphere in spheres], factor)
    return Mover(
        _origin(pose, frame),
        tuple((*centre, sphere[3] * factor) for centre, sphere in zip(centres, spheres, strict=True)),
        None if plane is None else tuple(plane),
        frame.offset(plane_cell or pose["cell"]),
        polygon=polygon,
        geometry=geometry,
    )


def _origin(pose: Mapping[str, Any], frame: Frame) -> Vec3:
    return add(tuple(pose["origin"]), frame.offset(pose["cell"]))


def _shifted(by: Vec3, spheres: Sequence[Sequence[float]]) -> Iterator[SphereData]:
    for x, y, z, radius in spheres:
        yield (*add((x, y, z), by), radius)


def _drawable(mover: Mover | None) -> Mover | None:
    """Leave out a mover that is nowhere, or too far away."""
    if mover is None or not isinstance(mover.polygon, int | None):
        return None
    rows = [mover.position, mover.block, mover.plane or (), *mover.spheres, *mover.points]
    return mover if is_drawable(rows) else None
