"""Movers, the state they start in, and what they remember of the last step."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

from hypothesis import strategies as st

from conformance.strategies.numbers import anywhere, grid, pick, unit

if TYPE_CHECKING:
    from collections.abc import Sequence

    from conformance.scenes.model import Vec3

CONTACT: Final = 0x1
ON_WALKABLE: Final = 0x2
VIEWER: Final = 0x4
PATH_CLIPPED: Final = 0x8
FREE_ROTATE: Final = 0x10
PERFECT_CLIP: Final = 0x40
IMPENETRABLE: Final = 0x80
PLAYER: Final = 0x100
EDGE_SLIDE: Final = 0x200
IGNORE_CREATURES: Final = 0x400
PLAYER_KILLER: Final = 0x800
PLAYER_KILLER_LITE: Final = 0x1000

OWN_ID: Final = 0x50000001
"""Object id of a mover, as a rule."""
ALLOWANCES: Final = st.sampled_from((0.66417414, 0.0871557))
"""Limits of walkable slopes that retail uses: floor and landing, cosines of the slope."""
SCALES: Final = st.one_of(st.just(1.0), st.sampled_from((0.5, 2.0)), grid(0.5, 2.0))
"""Scales of movers and statics: mostly 1."""

_HUMAN: Final = ((0.0, 0.0, 0.475, 0.48), (0.0, 0.0, 1.35, 0.48))
"""The spheres of a human, metres."""
_RADII: Final = grid(0.125, 0.75)


def _two_spheres(low: float, high: float, gap: float, aside: float) -> tuple[tuple[float, ...], ...]:
    return ((0.0, 0.0, low, low), (aside, 0.0, low + gap + high, high))


_TWO_SPHERES: Final = st.builds(_two_spheres, _RADII, _RADII, grid(0.0, 1.0), grid(-0.25, 0.25))
_SPHERES: Final = st.one_of(
    st.just(((0.0, 0.0, 0.0, 0.48),)),
    st.just(((0.0, 0.0, 0.48, 0.48),)),
    st.just(_HUMAN),
    _RADII.map(lambda radius: ((0.0, 0.0, radius, radius),)),
    _TWO_SPHERES,
    _TWO_SPHERES.map(lambda spheres: spheres[::-1]),
)
"""One sphere or two, mostly the lower one first."""
_HEIGHTS: Final = st.sampled_from((0.6, 1.5, 0.04)) | grid(0.0, 2.0)
_MOSTLY: Final = st.sampled_from((1, 1, 1, 0))
_UPWARD: Final = st.builds(
    lambda x, y: unit((x, y, 1.0)), anywhere(-1.0, 1.0), anywhere(-1.0, 1.0)
) | st.just((0.0, 0.0, 1.0))
_SLIDING: Final = st.none() | st.tuples(anywhere(-1.0, 1.0), anywhere(-1.0, 1.0), st.just(0.0))
_STATIONARY: Final = st.sampled_from((0, 0, 0, 1, 2, 3))
_ETHEREAL: Final = st.sampled_from((0, 0, 0, 4))
_HARDLY: Final = st.sampled_from((False, False, False, False, False, True))
_REMEMBERED: Final = st.sampled_from((("contact", "last_known"), ("last_known",), ()))


def draw_mover(draw: st.DrawFn, state: int) -> dict[str, Any]:
    """Draw a MOVER block in a given state."""
    return {
        "spheres": draw(_SPHERES),
        "scale": draw(SCALES),
        "state": state,
        "step_up_height": draw(_HEIGHTS),
        "step_down_height": draw(_HEIGHTS),
        "ethereal": 0,
        "step_down": draw(_MOSTLY),
        "gravity": draw(_MOSTLY),
    }


def draw_identity(draw: st.DrawFn, others: Sequence[int]) -> dict[str, Any]:
    """Draw what objects ask of a mover: its id (seldom one of theirs), missile and target, ethereal."""
    identity: dict[str, Any] = {"id": OWN_ID, "ethereal": draw(_ETHEREAL)}
    if draw(_HARDLY) and others:
        identity["id"] = pick(draw, others)
    if draw(_HARDLY):
        identity["missile"] = 1
        identity["target_id"] = pick(draw, (0, *others))
    return identity


def draw_seed(draw: st.DrawFn, state: int, foot: Vec3, normal: Vec3, cell: int) -> dict[str, Any]:
    """Draw a SEED block: if in contact, a plane through the foot: level, aslant or along `normal`."""
    seed: dict[str, Any] = {}
    if state & CONTACT:
        facing = pick(draw, (0, 1))
        plane_normal = normal if facing else draw(_UPWARD)
        plane = [*plane_normal, -sum(n * p for n, p in zip(plane_normal, foot, strict=True))]
        seed = {key: {"plane": plane, "cell": cell, "is_water": 0} for key in draw(_REMEMBERED)}
    sliding = draw(_SLIDING)
    if sliding is not None:
        seed["sliding"] = sliding
    stationary = draw(_STATIONARY)
    return {**seed, "frames_stationary_fall": stationary} if stationary else seed


def foot_of(mover: dict[str, Any], origin: Vec3) -> Vec3:
    """Return the lowest point of a mover's first sphere (rotation ignored: movers stand upright)."""
    x, y, z, radius = (part * mover["scale"] for part in mover["spheres"][0])
    return (origin[0] + x, origin[1] + y, origin[2] + z - radius)
