"""Meetings: a mover about to touch something, whatever that is."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Final

from hypothesis import strategies as st

from conformance.strategies.movers import draw_mover, draw_seed, foot_of
from conformance.strategies.numbers import DIRECTIONS, FLAGS, along, anywhere, unit, vectors
from conformance.strategies.poses import FACINGS, turned

if TYPE_CHECKING:
    from conformance.scenes.model import Quaternion, Vec3

SELDOM: Final = st.sampled_from((False, False, False, True))
_WAYS: Final = st.sampled_from(("into", "down", "aslant", "into", "any"))
_LENGTHS: Final = st.sampled_from((0.25, 0.0)) | anywhere(0.0, 1.0)


@dataclass(frozen=True, slots=True)
class Target:
    """Where a sphere is put to touch something.

    Attributes
    ----------
    normal : Vec3
        The surface's unit normal there, in the landblock's frame, float64.
    center : Vec3
        Centre of the sphere in the landblock's frame, float64.
    overlap : float
        How far the sphere must go back along the normal to be clear, metres.
    """

    normal: Vec3
    center: Vec3
    overlap: float


@dataclass(frozen=True, slots=True)
class Meeting:
    """A mover about to meet something: MOVER, two POSE blocks, SEED."""

    mover: dict[str, Any]
    start: dict[str, Any]
    end: dict[str, Any]
    seed: dict[str, Any]


@dataclass(frozen=True, slots=True)
class Probe:
    """A mover, and which of its spheres is to touch something.

    Attributes
    ----------
    mover : dict
        Its MOVER block.
    offset : Vec3
        Centre of the sphere in the mover's frame, scaled, metres.
    radius : float
        Scaled, metres.
    """

    mover: dict[str, Any]
    offset: Vec3
    radius: float


def draw_probe(draw: st.DrawFn, state: int) -> Probe:
    """Draw a mover in a given state: mostly its first sphere is the one that touches."""
    mover = draw_mover(draw, state)
    sphere = mover["spheres"][-1 if draw(SELDOM) else 0]
    x, y, z, radius = (part * mover["scale"] for part in sphere)
    return Probe(mover, (x, y, z), radius)


def draw_meeting(draw: st.DrawFn, probe: Probe, target: Target, cell: int) -> Meeting:
    """Draw a movement that ends where the probe's sphere touches the target, in a cell's landblock."""
    facing = draw(FACINGS)
    end = along(target.center, turned(facing, probe.offset), -1.0)
    start = along(end, draw_movement(draw, target.normal, target.overlap), -1.0)
    start_facing = draw(FACINGS) if draw(SELDOM) else facing
    foot = foot_of(probe.mover, start)
    seed = draw_seed(draw, probe.mover["state"], foot, target.normal, cell)
    return Meeting(probe.mover, _position(cell, start, start_facing), _position(cell, end, facing), seed)


def draw_movement(draw: st.DrawFn, normal: Vec3, overlap: float) -> Vec3:
    """Draw a displacement: into the surface, aslant, down, anywhere; half of them began clear of it."""
    into = (-normal[0], -normal[1], -normal[2])
    match draw(_WAYS):
        case "into":
            direction = into
        case "aslant":
            direction = unit(along(into, draw(vectors(1.0)), 1.0))
        case "down":
            direction = (0.0, 0.0, -1.0)
        case _:
            direction = draw(DIRECTIONS)
    length = draw(_LENGTHS) + draw(FLAGS) * overlap
    return (direction[0] * length, direction[1] * length, direction[2] * length)


def _position(cell: int, origin: Vec3, rotation: Quaternion) -> dict[str, Any]:
    return {"cell": cell, "origin": origin, "rotation": rotation}
