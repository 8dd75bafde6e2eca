"""From the segments of a walk to its ticks: the input blocks that FORMAT.md names."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

from conformance.floats import to_float32
from conformance.scenes.rotations import yaw_quaternion
from conformance.source import Fault

if TYPE_CHECKING:
    from collections.abc import Iterator

    from conformance.scenes.model import Vec3
    from conformance.schema.walk_queries import (
        BodyModel,
        BodyWalkQuery,
        InputModel,
        MoveModel,
        SegmentModel,
        WalkQuery,
    )
    from conformance.source import DocPath


class Planner:
    """Knows where the ticks so far would lead if nothing were in the way.

    Attributes
    ----------
    place : (float, float) or None
        x and y in the landblock's frame, metres; None after a movement in the body's own frame.
    faults : list of Fault
        Points that cannot be headed for; paths start at the case.
    """

    def __init__(self, origin: Vec3) -> None:
        self.place: tuple[float, float] | None = (origin[0], origin[1])
        self.faults: list[Fault] = []

    def toward(self, segment: SegmentModel, pace: float, index: int) -> list[float]:
        """Return a level vector of length `pace` that leads to a segment's point; zero with a fault."""
        x, y = segment.toward or (0.0, 0.0)
        path: DocPath = ("query", "ticks", index, "toward")
        if self.place is None:
            found = "a point after a velocity in the body's own frame"
            self.faults.append(Fault(path, found, "'velocity': where the body then is, is not known"))
            return [0.0, 0.0, 0.0]
        dx, dy = x - self.place[0], y - self.place[1]
        distance = math.sqrt(dx * dx + dy * dy)
        if distance == 0.0:
            found = "the point where the ticks before lead"
            self.faults.append(Fault(path, found, "another point, or 'still'"))
            return [0.0, 0.0, 0.0]
        return [to_float32(dx / distance * pace), to_float32(dy / distance * pace), 0.0]

    def go(self, step: list[float], times: float) -> None:
        """Note a movement; `step` times `times` is in metres."""
        if self.place is not None:
            self.place = (self.place[0] + step[0] * times, self.place[1] + step[1] * times)


def recorded_moves(query: WalkQuery) -> tuple[list[dict[str, Any]], list[Fault]]:
    """Return the ticks of a walk of recorded moves, and what is wrong with them."""
    planner = Planner(query.start.origin)
    ticks = [tick for index, segment in enumerate(query.ticks) for tick in _moves(planner, segment, index)]
    return ticks, planner.faults


def _moves(planner: Planner, segment: MoveModel, index: int) -> Iterator[dict[str, Any]]:
    step = list(segment.move or (0.0, 0.0, 0.0))
    if segment.stride is not None:
        step = planner.toward(segment, segment.stride, index)
    planner.go(step, segment.count)
    more: dict[str, Any] = {}
    if segment.yaw is not None:
        more["rotation"] = list(yaw_quaternion(segment.yaw))
    if not segment.contact_ok:
        more["contact_ok"] = 0
    for _ in range(segment.count):
        yield {"move": step, **more}


def held_inputs(query: BodyWalkQuery) -> tuple[list[dict[str, Any]], list[Fault]]:
    """Return the ticks of a body that moves by itself, and what is wrong with them."""
    planner = Planner(query.start.origin)
    ticks: list[dict[str, Any]] = []
    for index, segment in enumerate(query.ticks):
        quantum = query.quantum if segment.quantum is None else segment.quantum
        ticks += [{"q": quantum, **_input(planner, segment, index, quantum)}] * segment.count
    return ticks, planner.faults


def _input(planner: Planner, segment: InputModel, index: int, quantum: float) -> dict[str, Any]:
    """Return what a body is given in each tick of a segment."""
    given: dict[str, Any] = {} if segment.omega is None else {"omega": list(segment.omega)}
    if segment.local_velocity is not None:
        planner.place = None
        return {**given, "set_local_velocity": list(segment.local_velocity)}
    if segment.still is not None:
        return given
    velocity = list(segment.velocity or (0.0, 0.0, 0.0))
    if segment.speed is not None:
        velocity = planner.toward(segment, segment.speed, index)
    planner.go(velocity, quantum * segment.count)
    return {**given, "set_velocity": velocity}


def body_block(body: BodyModel, position: dict[str, Any]) -> dict[str, Any]:
    """Return the BODY block of a body that stands at a POSE."""
    keys = ("state", "transient_state", "scale", "step_up_height", "step_down_height", "movement_manager")
    block = {key: getattr(body, key) for key in keys}
    block |= {"position": position, "spheres": [list(sphere) for sphere in body.spheres]}
    for key in ("velocity", "acceleration", "friction", "elasticity"):
        if (value := getattr(body, key)) is not None:
            block[key] = list(value) if isinstance(value, tuple) else value
    if body.id is not None:
        block["id"] = body.id
    if body.weenie is not None:
        block["weenie"] = dict.fromkeys(body.weenie, 1)
    if body.contact is not None:
        block |= {"contact_plane": list(body.contact.plane), "contact_plane_cell": body.contact.cell}
    return block
