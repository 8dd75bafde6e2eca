"""Rigid poses: identity, yaw, quarter turns, any rotation; near the origin and blocks away."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

from hypothesis import strategies as st

from conformance.scenes.rotations import rotate, round_quaternion, rows_from_quaternion, yaw_quaternion
from conformance.strategies.numbers import anywhere, grid

if TYPE_CHECKING:
    from collections.abc import Mapping

    from conformance.scenes.model import Quaternion, Vec3

CELLS: Final = st.sampled_from((0xA9B40150, 0x00010101, 0xA9B40111))
IDENTITY: Final[Quaternion] = (1.0, 0.0, 0.0, 0.0)

_BLOCK: Final = 192
"""Edge of a landblock, metres."""
_FAR_BLOCKS: Final = 254
"""Blocks from one edge of the world to the other."""
_QUARTER_TURNS: Final = tuple(
    round_quaternion(q)
    for q in (
        (1, 0, 0, 1),
        (0, 0, 0, 1),
        (1, 1, 0, 0),
        (1, 0, 1, 0),
        (0, 1, 0, 0),
        (1, 1, 1, 1),
        (1, -1, 0, 0),
    )
)
_PART: Final = grid(-1.0, 1.0)
_NEAR: Final = anywhere(-200.0, 200.0)
_FAR: Final = st.integers(-_FAR_BLOCKS, _FAR_BLOCKS).map(lambda blocks: float(blocks * _BLOCK))

UPRIGHT: Final = st.just(IDENTITY) | st.integers(0, 359).map(lambda degrees: yaw_quaternion(float(degrees)))
"""Turns about z: floors stay floors."""

ROTATIONS: Final[st.SearchStrategy[Quaternion]] = st.one_of(
    UPRIGHT,
    st.sampled_from(_QUARTER_TURNS),
    st.tuples(_PART, _PART, _PART, _PART).filter(any).map(round_quaternion),
)
"""Unit quaternions, float32: the simple ones first."""

ORIGINS: Final[st.SearchStrategy[Vec3]] = st.one_of(
    st.just((0.0, 0.0, 0.0)), st.tuples(_NEAR, _NEAR, _NEAR), st.tuples(_FAR, _FAR, _NEAR)
)
"""Origins in metres: zero, within 200, and at the scale of the whole world."""

FACINGS: Final = st.just(IDENTITY) | ROTATIONS
"""Rotations of a mover: mostly upright."""


def draw_pose(draw: st.DrawFn, cell: int, *, upright: bool = False) -> dict[str, Any]:
    """Draw a POSE block in a cell, turned about z only if `upright`."""
    return {"cell": cell, "origin": draw(ORIGINS), "rotation": draw(UPRIGHT if upright else ROTATIONS)}


def to_world(pose: Mapping[str, Any], point: Vec3, scale: float) -> Vec3:
    """Take a point of scaled geometry to the landblock's frame, float64."""
    x, y, z = turned(pose["rotation"], (point[0] * scale, point[1] * scale, point[2] * scale))
    ox, oy, oz = pose["origin"]
    return (x + ox, y + oy, z + oz)


def turned(rotation: Quaternion, direction: Vec3) -> Vec3:
    """Return a direction after a rotation, float64."""
    return rotate(rows_from_quaternion(rotation), direction)
