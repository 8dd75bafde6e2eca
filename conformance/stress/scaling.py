"""Scale: retail multiplies the finished plane constant by the part's scale, its translation included.

The plane of a scaled part at O should have the constant ``s*d - n.O``; retail stores ``s*(d - n.O)``
(01 PL-4, 03 SD-9), which is off by ``(1 - s)*(n.O)``. It is wrong and it is retail: what conforms writes the
same.
"""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING, Any, Final

from conformance.scenes.algebra import add, dot, round_point, scale, subtract
from conformance.scenes.bsp_builder import TreeStyle, build
from conformance.scenes.planes import unit_normal
from conformance.scenes.polygons import place
from conformance.scenes.rotations import rotate, rows_from_quaternion
from conformance.scenes.solids import ramp
from conformance.strategies.human import HUMAN, MOVER, RADIUS
from conformance.stress.asking import ErrorSweep
from conformance.stress.moves import CENTER, IDENTITY, ON_GROUND, pose
from conformance.stress.sweep import Probe
from conformance.stress.translation import DIRECTION, DISTANCES, YAW
from conformance.vector_io import query_from_record
from oracle.constants import FLOOR_Z

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from conformance.query import Fields, Query
    from conformance.scenes.model import Geometry, Vec3
    from conformance.stress.settings import Settings

FAMILY: Final = "scale"
AXIS: Final = "distance of the part from the origin (m)"
SCALES: Final = (0.25, 0.5, 0.75, 1.0, 1.5, 2.0, 4.0)
"""Of the part; numbers of few bits, so that what is off is retail's formula and not a rounding."""
DEPTH: Final = 0.05
"""How deep the lower sphere is in the plane when the call is made, metres."""
DOWN: Final = 0.5
"""How far down the step goes that finds the plane, metres."""
DEGREES: Final = (10.0, 20.0, 30.0, 40.0)
"""How steep the ramps are."""
SPREAD: Final = 0.6
"""How far along the ramp the spots of the probes lie apart, of its run."""


def sweeps(settings: Settings) -> Sequence[ErrorSweep]:
    """Return the family: for each scale, the part farther and farther out."""
    ramps = [_ramp(degrees) for degrees in DEGREES]

    def probes(size: float, distance: float) -> Iterator[Probe]:
        origin = round_point(scale(distance, DIRECTION))
        for number in range(settings.probes):
            geometry = ramps[number % len(ramps)]
            share = 0.5 + SPREAD * (number / settings.probes - 0.5)
            yield Probe(step_down(geometry, size, origin, share), TruePlane(geometry, size, origin))

    severities = settings.thinned(DISTANCES)
    sizes = (0.5, 1.0, 2.0) if settings.quick else SCALES
    return [ErrorSweep(FAMILY, f"scale {size:g}", AXIS, severities, partial(probes, size)) for size in sizes]


def _ramp(degrees: float) -> Geometry:
    shape = place(ramp(width=3.0, run=3.0, degrees=degrees), (0.0, -1.5, 0.25), 23.0)
    return build(f"ramp-{degrees:g}", shape, style=TreeStyle.FRONT, kind="stress")


def step_down(geometry: Geometry, size: float, origin: Vec3, share: float) -> Query:
    """Return a step down onto a scaled part: one call of its tree, that ends in a contact plane.

    Parameters
    ----------
    geometry : Geometry
        One polygon that can be walked on.
    size : float
        Scale of the part.
    origin : Vec3
        Of the part, metres.
    share : float
        Where on the polygon, from its lower to its upper edge.
    """
    rows = rows_from_quaternion(YAW)
    low, _, _, high = geometry.corners(0)
    right, _ = geometry.corners(0)[1:3]
    middle = scale(0.5, add(low, right))
    local = add(middle, scale(share, subtract(high, low)))
    normal = rotate(rows, unit_normal(geometry.corners(0)))
    touched = add(rotate(rows, scale(size, local)), origin)
    feet = subtract(add(touched, scale(RADIUS - DEPTH, normal)), CENTER)
    record: dict[str, Any] = {
        "op": "find_collisions",
        "geometry": geometry.name,
        "pose": pose(YAW, origin),
        "scale": size,
        "as": "static",
        "mover": {**MOVER, "spheres": HUMAN, "state": ON_GROUND},
        "from": pose(IDENTITY, add(feet, (0.0, 0.0, DOWN))),
        "to": pose(IDENTITY, feet),
        "seed": {},
        "path": {"step_down": 1, "step_down_amt": DOWN, "walk_interp": 1.0, "walkable_allowance": FLOOR_Z},
    }
    return query_from_record(record, {geometry.name: geometry})


class TruePlane:
    """Measures how far a contact plane's constant is from that of the polygon where it really is.

    Parameters
    ----------
    geometry : Geometry
        One polygon.
    size : float
        Scale of the part.
    origin : Vec3
        Of the part, metres.
    """

    def __init__(self, geometry: Geometry, size: float, origin: Vec3) -> None:
        corners = geometry.corners(0)
        rows = rows_from_quaternion(YAW)
        normal = rotate(rows, unit_normal(corners))
        self._constant = -dot(normal, add(rotate(rows, scale(size, corners[0])), origin))
        self._formula = (1.0 - size) * dot(normal, origin)

    def __call__(self, fields: Fields) -> dict[str, float]:
        """Return how far it is off, and what of that the formula does not explain."""
        if not fields["contact_plane"]["valid"]:
            return {}
        off = fields["contact_plane"]["plane"][3] - self._constant
        return {"plane_off_metres": abs(off), "formula_metres": abs(off - self._formula)}
