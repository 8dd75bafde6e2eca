"""Comparisons of document 02 about directions and feet: movements and ups along a plane, feet at edges."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from conformance.stress.comparisons.base import RADIUS, TRIANGLE, Comparison, ask, says_yes, single, sphere
from conformance.stress.comparisons.polygons import DOWN, LEVEL, UP, along_triangle, height_over
from oracle.constants import EPS

if TYPE_CHECKING:
    from conformance.query import Fields, Query

INSIDE: Final = (0.2, -0.1)
OUTSIDE: Final = (2.2, -0.1)
"""x and y of a point over the triangle, and of one beside it, metres."""
TINY: Final = 1e-6
"""How far from level a direction is that decides with the other sign, metres."""
_UP: Final = ("up z", "up x")
_MOVEMENT: Final = ("movement z (m)", "movement x (m)")


def _on_plane(x: float, y: float, radius: float = RADIUS) -> list[float]:
    """Return a sphere whose centre is in the triangle's plane."""
    return [x, y, height_over(x, y), radius]


def _stands(z: float, x: float) -> Query:
    return ask("polygon_check_walkable", single(), poly=0, sphere=_on_plane(*INSIDE), up=[x, LEVEL[1], z])


def _crosses(z: float, x: float) -> Query:
    return ask("polygon_find_crossed_edge", single(), poly=0, sphere=_on_plane(*OUTSIDE), up=[x, LEVEL[1], z])


def _at_edge(x: float, y: float) -> Query:
    """Ask about a sphere without a radius: what is outside by anything is outside."""
    return ask("polygon_check_walkable", single(), poly=0, sphere=[x, y, 0.4, 0.0], up=UP)


def _reaches(z: float, x: float) -> Query:
    ball, curr = sphere(0.2, -0.1, 0.3), [0.2, -0.1, 3.0]
    return ask(
        "polygon_adjust_sphere_to_poly", single(), poly=0, sphere=ball, curr=curr, movement=[x, LEVEL[1], z]
    )


def _from_side(z: float, x: float) -> Query:
    """Begin in the plane, without a radius, so that the sphere does not touch at the start."""
    ball = [0.2, -0.1, 0.3, 0.0]
    return ask(
        "polygon_adjust_sphere_to_poly", single(), poly=0, sphere=ball, curr=[x, -0.1, z], movement=DOWN
    )


def _lowered(z: float, x: float) -> Query:
    """Touch the plane from below but for half of EPS, so that only the movement decides."""
    ball, movement = sphere(*INSIDE, height_over(*INSIDE, -RADIUS - 0.5 * EPS)), [x, LEVEL[1], z]
    return ask(
        "polygon_adjust_sphere_to_plane", single(), poly=0, sphere=ball, movement=movement, walk_interp=1.0
    )


def _placed(z: float, x: float) -> Query:
    return ask(
        "polygon_adjust_to_placement_poly",
        single(),
        poly=0,
        sphere=sphere(x, -0.1, z),
        other=sphere(x, -0.1, z + 1.0),
        radius=RADIUS,
        center_solid=0,
        solid_check=1,
    )


def _quickly(z: float, x: float) -> Query:
    return ask("polygon_hits_sphere_fast", single(), poly=0, sphere=sphere(x, -0.1, z))


def _inside_seen_from_below(x: float, y: float) -> Query:
    turned = single(TRIANGLE[::-1], "turned")
    return ask("polygon_point_in_poly2D", turned, poly=0, point=[x, y, 0.0], side=1)


def _never(fields: Fields) -> bool:
    return bool(fields["t"] == 0.0)


def _later(fields: Fields) -> bool:
    return bool(fields["t"] > 0.0)


def _is_above(fields: Fields) -> bool:
    return bool(fields["center"][2] > height_over(*INSIDE))


_LEVEL_Z: Final = along_triangle()

FOOTING: Final = (
    Comparison(
        "plane at the radius, quickly",
        "02 PH-1",
        ("centre z (m)", "centre x (m)"),
        _quickly,
        says_yes,
        (0.2, 1.5),
        0.2,
    ),
    Comparison(
        "point at an edge, in plan from below",
        "02 P2-3",
        ("x (m)", "y (m)"),
        _inside_seen_from_below,
        says_yes,
        (0.0, 2.5),
        0.1,
    ),
    Comparison(
        "foot without extent at an edge", "02 CW-6", ("x (m)", "y (m)"), _at_edge, says_yes, (0.5, 3.0), 0.1
    ),
    Comparison("up along the plane", "02 CW-1", _UP, _stands, says_yes, (_LEVEL_Z, _LEVEL_Z + 0.1), LEVEL[0]),
    Comparison(
        "up along the plane, beside it",
        "02 FE-1",
        _UP,
        _crosses,
        says_yes,
        (_LEVEL_Z, _LEVEL_Z + 0.1),
        LEVEL[0],
    ),
    Comparison(
        "movement that never arrives",
        "02 AP-3",
        _MOVEMENT,
        _reaches,
        _never,
        (_LEVEL_Z, _LEVEL_Z - 0.1),
        LEVEL[0],
    ),
    Comparison(
        "side of the start",
        "02 AP-4",
        ("start z (m)", "start x (m)"),
        _from_side,
        _later,
        (height_over(*INSIDE, -0.1), height_over(*INSIDE, 0.1)),
        0.2,
    ),
    Comparison(
        "movement level within EPS, upwards",
        "02 AS-2",
        _MOVEMENT,
        _lowered,
        says_yes,
        (_LEVEL_Z + 0.1, _LEVEL_Z),
        LEVEL[0],
    ),
    Comparison(
        "side of what is placed",
        "02 AQ-2",
        ("centre z (m)", "centre x (m)"),
        _placed,
        _is_above,
        (height_over(*INSIDE, -0.1), height_over(*INSIDE, 0.1)),
        0.2,
    ),
)
"""In the order of the document."""
