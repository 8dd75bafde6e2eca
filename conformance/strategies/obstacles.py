"""Obstacles: OBJECT blocks drawn at random, and where a sphere is put to touch one."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, Final

from hypothesis import strategies as st

from conformance.strategies.contact import draw_aim
from conformance.strategies.meetings import SELDOM, Target
from conformance.strategies.movers import SCALES
from conformance.strategies.numbers import DIRECTIONS, NEARLY, along, anywhere, grid, pick, unit, vectors
from conformance.strategies.poses import ROTATIONS, UPRIGHT, to_world, turned
from conformance.strategies.worlds.things import HAS_BSP, KINDS, write_object

if TYPE_CHECKING:
    from collections.abc import Mapping

    from conformance.scenes.model import Geometry, Vec3

UP: Final[Vec3] = (0.0, 0.0, 1.0)
DOWN: Final[Vec3] = (0.0, 0.0, -1.0)

_KINDS: Final = st.sampled_from(tuple(KINDS))
_STATES: Final = st.sampled_from((0x1, 0x0, 0x408, 0x4, 0x5, 0x14, 0x40, 0x10001, 0x10000, 0x10004))
"""PhysicsStates (08 1): static, plain, creature, ethereal, static ethereal, ignored, missile, with a BSP."""
_WEENIES: Final = st.sets(st.sampled_from(("creature", "player", "pk", "pklite", "impenetrable")))
_TURNS: Final = UPRIGHT | ROTATIONS
_MULTIPLES: Final = st.sampled_from((1.0, 1.0, 0.75, 0.5, 0.25)) | anywhere(0.0, 1.5)
"""Distances of two centres, as a multiple of where the surfaces touch."""
_ASIDES: Final = st.sampled_from((0.0, 0.5, 0.9375, 1.0)) | grid(0.0, 1.25)
"""Distance from a cylinder's axis over its cap, as a multiple of its radius."""
_RADII: Final = grid(0.125, 2.0)
_HEIGHTS: Final = st.sampled_from((1.8, 0.25, 0.5)) | grid(0.0625, 4.0)
_OFFSETS: Final = st.just((0.0, 0.0, 0.0)) | vectors(0.5)
LEVEL: Final = st.integers(0, 359).map(
    lambda degrees: (math.cos(math.radians(degrees)), math.sin(math.radians(degrees)), 0.0)
)
"""Level unit vectors."""
_SPHERES: Final = st.tuples(_OFFSETS, _RADII).map(lambda s: (*s[0], s[1]))
_CYLSPHERES: Final = st.tuples(_OFFSETS, _RADII, _HEIGHTS).map(lambda c: (*c[0], c[1], c[2]))
_UPWARD: Final = st.tuples(anywhere(-1.0, 1.0), anywhere(-1.0, 1.0)).map(lambda d: unit((*d, 1.0)))
_FACES: Final = st.sampled_from(("side", "top", "rim", "bottom"))
"""Over the rim one comes aslant, from outside of both the side and the cap."""


def draw_obstacle(draw: st.DrawFn, ident: int, cell: int, near: Vec3) -> dict[str, Any]:
    """Draw an object of a known kind within a metre of a point; seldom with another state or weenie."""
    pose = {"cell": cell, "origin": along(near, draw(vectors(1.0)), 1.0), "rotation": draw(_TURNS)}
    thing = write_object(KINDS[draw(_KINDS)], ident, pose, draw(SCALES))
    if draw(SELDOM):
        thing["state"] = draw(_STATES)
    if draw(SELDOM):
        thing["weenie"] = dict.fromkeys(sorted(draw(_WEENIES)), 1)
    return thing


def draw_shaped(draw: st.DrawFn, family: str, ident: int, cell: int, origin: Vec3) -> dict[str, Any]:
    """Draw an object with one or two shapes of a family (``spheres`` or ``cylspheres``) of any size."""
    shape = _SPHERES if family == "spheres" else _CYLSPHERES
    count = 1 + draw(SELDOM)
    thing: dict[str, Any] = {
        "id": ident,
        "pose": {"cell": cell, "origin": origin, "rotation": draw(_TURNS)},
        "scale": draw(SCALES),
        "state": draw(_STATES) & ~HAS_BSP,
        family: [list(draw(shape)) for _ in range(count)],
    }
    if draw(SELDOM):
        thing["weenie"] = dict.fromkeys(sorted(draw(_WEENIES)), 1)
    return thing


def draw_target(
    draw: st.DrawFn,
    thing: Mapping[str, Any],
    geometries: Mapping[str, Geometry],
    radius: float,
    *,
    above: bool = False,
) -> Target:
    """Draw where a sphere of `radius` is put to touch one of an object's shapes, whichever is tested.

    With `above`, to stand or land on it.
    """
    shapes = [
        (family, shape) for family in ("spheres", "cylspheres", "parts") for shape in thing.get(family, ())
    ]
    solid = [
        (family, shape) for family, shape in shapes if family != "parts" or shape["geometry"] is not None
    ]
    if not solid:
        return Target(UP, thing["pose"]["origin"], 0.0)
    family, shape = pick(draw, solid)
    if family == "parts":
        pose, scale = shape.get("pose", thing["pose"]), shape.get("scale", thing["scale"])
        aim = draw_aim(draw, geometries[shape["geometry"]], radius / scale, floors=above)
        overlap = max(radius - aim.distance * scale, 0.0)
        return Target(turned(pose["rotation"], aim.normal), to_world(pose, aim.center, scale), overlap)
    low = to_world(thing["pose"], tuple(shape[:3]), thing["scale"])
    size = shape[3] * thing["scale"]
    if family == "spheres":
        return _draw_at_sphere(draw, low, size, radius, draw(_UPWARD if above else DIRECTIONS))
    face = "top" if above else draw(_FACES)
    return _draw_at_cylinder(draw, low, (size, shape[4] * thing["scale"]), radius, face)


def _draw_at_sphere(draw: st.DrawFn, center: Vec3, size: float, radius: float, direction: Vec3) -> Target:
    distance = (size + radius) * draw(_MULTIPLES) + draw(NEARLY)
    return Target(direction, along(center, direction, distance), max(size + radius - distance, 0.0))


def _draw_at_cylinder(
    draw: st.DrawFn, low: Vec3, extent: tuple[float, float], radius: float, face: str
) -> Target:
    """Draw beside a cylinder (`extent`: radius and height), over or under its caps, or past their rim."""
    size, height = extent
    away = draw(LEVEL)
    if face == "side":
        distance = (size + radius) * draw(_MULTIPLES) + draw(NEARLY)
        middle = along(low, UP, height * draw(_ASIDES))
        return Target(away, along(middle, away, distance), max(size + radius - distance, 0.0))
    normal, cap = (DOWN, low) if face == "bottom" else (UP, along(low, UP, height))
    lift = radius * draw(_MULTIPLES) + draw(NEARLY)
    if face == "rim":
        aslant = unit((away[0], away[1], 1.0))
        return Target(aslant, along(along(cap, away, size), aslant, lift), 2.0 * radius - lift)
    aside = size * draw(_ASIDES)
    return Target(normal, along(along(cap, away, aside), normal, lift), max(radius - lift, 0.0))
