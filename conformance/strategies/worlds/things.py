"""Things that stand about in a world: OBJECT blocks of every shape family, weenie and exemption."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from typing import TYPE_CHECKING, Any, Final

from conformance.scenes.bsp_builder import TreeStyle, build
from conformance.scenes.primitives import make
from conformance.strategies.poses import to_world

if TYPE_CHECKING:
    from collections.abc import Mapping

    from conformance.scenes.model import Geometry, Vec3

STATIC: Final = 0x1
ETHEREAL: Final = 0x4
REPORTS: Final = 0x8
IGNORED: Final = 0x10
MISSILE: Final = 0x40
GRAVITY: Final = 0x400
HAS_BSP: Final = 0x10000

_CRATE: Final = ("box", {"size": (1.0, 1.0, 0.75)})
_KERB: Final = ("box", {"size": (2.0, 2.0, 0.25)})
_STILE: Final = ("stairs", {"width": 1.5, "rise": 0.25, "run": 0.375, "count": 4, "solid": True})
_RAMP: Final = ("ramp", {"width": 2.0, "run": 2.0, "degrees": 35.0, "solid": True})
_POST: Final = ("pillar", {"radius": 0.25, "height": 2.5, "sides": 6})
_GEOMETRIES: Final[Mapping[str, tuple[str, Mapping[str, Any]]]] = {
    "crate": _CRATE,
    "kerb": _KERB,
    "stile": _STILE,
    "wedge": _RAMP,
    "post": _POST,
}
_ASIDE: Final = (1.25, 0.0, 0.0)
"""Where the second part of a thing is, metres."""


@dataclass(frozen=True, slots=True)
class Part:
    """A part of a thing.

    Attributes
    ----------
    geometry : str or None
        What it is; None for a part without.
    at : Vec3 or None
        Where it is in the object's frame, metres; None for a part that has the object's pose.
    scale : float or None
        Its own scale; None for the object's.
    """

    geometry: str | None
    at: Vec3 | None = None
    scale: float | None = None


@dataclass(frozen=True, slots=True)
class Kind:
    """What a thing is like: `state` bits, weenie flags (None: no weenie), shapes in its own frame."""

    state: int
    weenie: tuple[str, ...] | None = None
    parts: tuple[Part, ...] = ()
    cylspheres: tuple[tuple[float, ...], ...] = ()
    spheres: tuple[tuple[float, ...], ...] = ()
    other: tuple[str, ...] = ()


_MAN: Final = (0.0, 0.0, 0.0, 0.4, 1.8)
KINDS: Final[Mapping[str, Kind]] = {
    "tree": Kind(STATIC, cylspheres=((0.0, 0.0, -0.25, 0.5, 4.0),)),
    "boulder": Kind(STATIC, spheres=((0.0, 0.0, 0.25, 0.875),)),
    "crate": Kind(STATIC | HAS_BSP, parts=(Part("crate"),)),
    "guard": Kind(GRAVITY | REPORTS, ("creature",), cylspheres=(_MAN,)),
    "drum": Kind(GRAVITY, cylspheres=((0.0, 0.0, 0.0, 0.75, 0.5),)),
    "stile": Kind(STATIC | HAS_BSP, parts=(Part("stile"),)),
    "player": Kind(GRAVITY | REPORTS, ("player", "creature"), cylspheres=(_MAN,)),
    "killer": Kind(GRAVITY | REPORTS, ("player", "creature", "pk"), cylspheres=(_MAN,)),
    "lite": Kind(GRAVITY | REPORTS, ("player", "creature", "pklite"), cylspheres=(_MAN,)),
    "wall-player": Kind(GRAVITY | REPORTS, ("player", "creature", "impenetrable"), cylspheres=(_MAN,)),
    "slime": Kind(GRAVITY | REPORTS, ("creature",), spheres=((0.0, 0.0, 0.5, 0.5), (0.5, 0.0, 0.25, 0.25))),
    "arrow": Kind(MISSILE | REPORTS, (), spheres=((0.0, 0.0, 0.0, 0.25),)),
    "ghost": Kind(ETHEREAL | REPORTS, ("creature",), cylspheres=(_MAN,)),
    "portal": Kind(ETHEREAL | STATIC, spheres=((0.0, 0.0, 1.0, 1.0),)),
    "mist": Kind(ETHEREAL | IGNORED, cylspheres=((0.0, 0.0, 0.0, 1.0, 1.0),)),
    "gate": Kind(
        STATIC | HAS_BSP,
        parts=(Part("post"), Part(None), Part("post", _ASIDE, 1.25)),
        cylspheres=((0.625, 0.0, 0.0, 0.5, 2.0),),
        spheres=((0.625, 0.0, 0.5, 0.5),),
    ),
    "wedge": Kind(HAS_BSP, parts=(Part("wedge", None, 1.5), Part("kerb", (0.0, 2.5, 0.0)))),
    "empty": Kind(HAS_BSP, parts=(Part(None),), cylspheres=((0.0, 0.0, 0.0, 0.5, 1.0),)),
    "banner": Kind(STATIC, cylspheres=((0.0, 0.0, 0.0, 0.5, 2.0),), other=("parent",)),
    "idea": Kind(STATIC, other=("no_part_array",)),
    "heap": Kind(
        0,
        cylspheres=((0.0, 0.0, 0.0, 0.75, 0.25), (0.0, 0.0, 0.25, 0.5, 0.25)),
        spheres=((0.0, 0.0, 0.75, 0.5),),
    ),
    "kerb": Kind(STATIC | HAS_BSP, parts=(Part("kerb"),), spheres=((0.0, 0.0, 0.25, 0.5),)),
}
"""Every kind of thing by its name; several have shapes of more than one family."""


def write_object(kind: Kind, ident: int, pose: Mapping[str, Any], scale: float) -> dict[str, Any]:
    """Write the OBJECT block of a thing at a pose."""
    block: dict[str, Any] = {"id": ident, "pose": pose, "scale": scale, "state": kind.state}
    if kind.weenie is not None:
        block["weenie"] = dict.fromkeys(kind.weenie, 1)
    if kind.parts:
        block["parts"] = [_write_part(part, pose, scale) for part in kind.parts]
    if kind.cylspheres:
        block["cylspheres"] = [list(shape) for shape in kind.cylspheres]
    if kind.spheres:
        block["spheres"] = [list(shape) for shape in kind.spheres]
    return block | dict.fromkeys(kind.other, 1)


def thing_geometries() -> Mapping[str, Geometry]:
    """Return the geometry of every part, by the name that OBJECT blocks have for it."""
    return _built()


def _write_part(part: Part, pose: Mapping[str, Any], scale: float) -> dict[str, Any]:
    written: dict[str, Any] = {"geometry": None if part.geometry is None else f"thing-{part.geometry}"}
    if part.at is not None:
        written["pose"] = {**pose, "origin": to_world(pose, part.at, scale)}
    if part.scale is not None:
        written["scale"] = part.scale
    return written


@cache
def _built() -> dict[str, Geometry]:
    return {
        f"thing-{name}": build(f"thing-{name}", make(*shape), style=TreeStyle.BOTH, kind="thing")
        for name, shape in _GEOMETRIES.items()
    }
