"""Comparisons of document 04: the spheres of a walker, and of the camera, at the ground of a land cell."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

from conformance.scenes.world_model import SIDE_VERTICES, VERTEX_COUNT, LandBlock, World
from conformance.strategies.human import MOVER
from conformance.stress.comparisons.base import RADIUS, Comparison, ask, sphere, triangle_plane
from conformance.stress.comparisons.polygons import height_over
from conformance.stress.moves import IDENTITY
from oracle.constants import EPS, FLOOR_Z

if TYPE_CHECKING:
    from conformance.query import Fields, Query

BLOCK: Final = 0xA9B4
CELL: Final = (BLOCK << 16) + 1
WALKER: Final = 0x3
"""State bits of a mover that is in contact with something walkable."""
VIEWER: Final = 0x4
BALL: Final = ((0.0, 0.0, 0.0, RADIUS),)
FOOT: Final = ((0.0, 0.0, RADIUS, RADIUS),)
SLOPE: Final = 1.125
"""Rise of a metre of the steepest ground that is walked on, nearly."""
LOW: Final = 1.0
"""Height of the ground where it begins to rise, metres."""
SHARE: Final = 4
"""What the edge of the squares is divided by: a landblock is made for each question."""
STEP: Final = 1.0
"""Metres that a step down goes."""
ROOM: Final = (BLOCK << 16) + 0x100
_ZX: Final = ("centre z (m)", "centre x (m)")


def _world(heights: tuple[float, ...] = (0.0,) * VERTEX_COUNT) -> dict[str, Any]:
    """Make a landblock; some questions bring the ground with them that they are about."""
    return World("ground", landblocks=(LandBlock(BLOCK, heights),)).to_record()


def _asked(
    center: tuple[float, float, float],
    *,
    state: int = WALKER,
    plane: tuple[float, ...] | None = None,
    start: tuple[float, float, float] | None = None,
    begin: int = CELL,
    **path: float,
) -> Query:
    x, y, z = center
    way = {"from": _pose(start or center, begin), "to": _pose(center)}
    return ask(
        "land_validate_walkable",
        world=_world(),
        cell=CELL,
        sphere=sphere(x, y, z),
        plane=list(plane or triangle_plane()),
        is_water=0,
        water_depth=0.0,
        mover={**MOVER, "spheres": BALL, "state": state},
        seed={},
        path={"walk_interp": 1.0, **path},
        **way,
    )


def _pose(origin: tuple[float, float, float], cell: int = CELL) -> Any:
    return {"cell": cell, "origin": list(origin), "rotation": list(IDENTITY)}


def _touching(z: float, x: float) -> Query:
    return _asked((x, -0.1, z))


def _sloping(nz: float, x: float) -> Query:
    """Touch a plane whose normal, which need not be unit, has this z: its D follows the sphere."""
    nx = 0.7
    return _asked((x, -0.1, 0.3), plane=(nx, 0.0, nz, -(nx * x + nz * (0.3 - RADIUS))))


def _stepping(z: float, x: float) -> Query:
    return _asked((x, -0.1, z), step_down=1, step_down_amt=STEP)


def _seen(z: float, x: float) -> Query:
    return _asked((x, -0.1, z), state=VIEWER, start=(x, -0.1, 3.0))


def _coming(z: float, x: float) -> Query:
    """Come out of a room to a place whose sphere is half a metre in the ground."""
    return _asked((x, -0.1, height_over(x, -0.1)), state=VIEWER, start=(x, -0.1, z), begin=ROOM)


def _upon_a_sphere(allowance: float, x: float) -> Query:
    """Land on the top of a sphere, whose slope there is compared with the allowance."""
    here = _pose((0.0, 0.0, 0.0), ROOM)
    way = {"from": _pose((x, 0.1, 1.5), ROOM), "to": _pose((x, 0.1, 1.2), ROOM)}
    return ask(
        "object_call",
        function="sphere",
        cell={"id": ROOM, "pose": here, "geometry": None},
        objects=[{"id": 1, "pose": here, "scale": 1.0, "state": 1, "spheres": [[0.0, 0.0, 0.0, 1.0]]}],
        mover={**MOVER, "spheres": BALL, "state": WALKER},
        seed={},
        path={"walk_interp": 1.0, "collide": 1, "walkable_allowance": allowance},
        **way,
    )


def _uphill(height: float, foot: float) -> Query:
    """Step down onto ground that rises eastwards from a foot to a height, 24 m on."""
    heights = (foot,) * SIDE_VERTICES + (height,) * (VERTEX_COUNT - SIDE_VERTICES)
    z = LOW + 3.0 * SLOPE + 0.1
    way = {"from": _pose((3.0, 5.0, z)), "to": _pose((2.9, 5.0, z))}
    return ask(
        "world_transition",
        world=_world(heights),
        mover={**MOVER, "spheres": FOOT, "state": WALKER},
        seed={"contact": {"plane": [0.0, 0.0, 1.0, 0.0], "cell": CELL, "is_water": 0}},
        **way,
    )


def _is_touched(fields: Fields) -> bool:
    return bool(fields["contact_plane"]["valid"])


def _is_lifted(fields: Fields) -> bool:
    return bool(fields["result"] == "ADJUSTED")


def _is_refused(fields: Fields) -> bool:
    return bool(fields["result"] == "COLLIDED")


def _low(share: float) -> float:
    """Return the z of a sphere whose lowest point is a share of EPS above the triangle's plane."""
    return height_over(0.2, -0.1, share * EPS) + RADIUS


GROUND: Final = (
    Comparison(
        "ground out of touch", "04 VW-12", _ZX, _touching, _is_touched, (_low(0.5), _low(3.0)), 0.2, SHARE
    ),
    Comparison("ground entered", "04 VW-11", _ZX, _touching, _is_lifted, (_low(0.5), _low(-3.0)), 0.2, SHARE),
    Comparison(
        "ground at floor_z",
        "04 VW-13",
        ("normal z", "x (m)"),
        _sloping,
        _is_touched,
        (FLOOR_Z - 0.01, FLOOR_Z + 0.01),
        0.2,
        SHARE,
    ),
    Comparison(
        "step that ends in the ground",
        "04 VW-23",
        _ZX,
        _stepping,
        _is_refused,
        (_low(-1.0), _low(-1e4)),
        0.2,
        SHARE,
    ),
    Comparison(
        "camera at the ground",
        "04 VW-2",
        _ZX,
        _seen,
        _is_lifted,
        (height_over(0.2, -0.1, 0.6), height_over(0.2, -0.1, 0.3)),
        0.2,
        SHARE,
    ),
    Comparison(
        "camera that began in the ground",
        "04 VW-4",
        ("start z (m)", "x (m)"),
        _coming,
        _is_lifted,
        (height_over(0.2, -0.1, 0.3), height_over(0.2, -0.1, 0.6)),
        0.2,
        SHARE,
    ),
    Comparison(
        "slope of a sphere that is landed on",
        "04 4",
        ("walkable_allowance", "x (m)"),
        _upon_a_sphere,
        _is_touched,
        (0.98, 1.0),
        0.2,
    ),
    Comparison(
        "ground too steep to step down to",
        "05 SD-4",
        ("height (m)", "height 24 m west of it (m)"),
        _uphill,
        _is_touched,
        (LOW + 27.0, LOW + 27.05),
        LOW,
        SHARE,
    ),
)
"""In the order of the document."""
