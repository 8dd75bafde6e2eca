"""Comparisons of document 02: spheres and points against one polygon."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from conformance.scenes.algebra import dot
from conformance.stress.comparisons.base import (
    RADIUS,
    Comparison,
    ask,
    says_yes,
    single,
    sphere,
    triangle_plane,
)
from oracle.constants import EPS

if TYPE_CHECKING:
    from conformance.query import Fields, Query

UP: Final = [0.0, 0.0, 1.0]
DOWN: Final = [0.05, 0.02, -0.5]
"""A movement of a sphere that falls, metres."""
LEVEL: Final = (0.3, 0.1)
"""x and y of a movement nearly along the triangle, metres."""
_XZ: Final = ("centre z (m)", "centre x (m)")
_XY: Final = ("centre x (m)", "centre y (m)")


def _front(z: float, x: float) -> Query:
    return ask("polygon_pos_hits_sphere", single(), poly=0, sphere=sphere(x, -0.1, z), movement=DOWN)


def _back(z: float, x: float) -> Query:
    return ask("polygon_pos_hits_sphere", single(), poly=0, sphere=sphere(x, -0.1, z), movement=UP)


def _direction(z: float, x: float) -> Query:
    movement = [x, LEVEL[1], z]
    return ask("polygon_pos_hits_sphere", single(), poly=0, sphere=sphere(0.2, -0.1, 0.3), movement=movement)


def _inside(x: float, y: float) -> Query:
    return ask("polygon_point_in_polygon", single(), poly=0, point=[x, y, 0.02])


def _inside_seen_from_above(x: float, y: float) -> Query:
    return ask("polygon_point_in_poly2D", single(), poly=0, point=[x, y, 0.0], side=0)


def _edge(x: float, y: float) -> Query:
    return ask("polygon_hits_sphere_slow", single(), poly=0, sphere=sphere(x, y, 0.05))


def _corner(y: float, x: float) -> Query:
    return ask("polygon_hits_sphere_slow", single(), poly=0, sphere=sphere(x, y, 0.55))


def _slope(allowance: float, up: float) -> Query:
    return ask(
        "polygon_walkable_hits_sphere",
        single(),
        poly=0,
        sphere=sphere(0.2, -0.1, 0.2),
        up=[0.0, 0.0, up],
        walkable_allowance=allowance,
    )


def _walkable(x: float, y: float) -> Query:
    return ask("polygon_check_walkable", single(), poly=0, sphere=sphere(x, y, 0.4), up=UP)


def _small_walkable(x: float, y: float) -> Query:
    return ask("polygon_check_small_walkable", single(), poly=0, sphere=sphere(x, y, 0.4), up=UP)


def _crossed(x: float, y: float) -> Query:
    return ask("polygon_find_crossed_edge", single(), poly=0, sphere=sphere(x, y, 0.4), up=UP)


def _settled(z: float, x: float) -> Query:
    ball = sphere(x, -0.1, z)
    return ask(
        "polygon_adjust_sphere_to_plane", single(), poly=0, sphere=ball, movement=DOWN, walk_interp=1.0
    )


def _level(z: float, x: float) -> Query:
    """Rest on the plane but for half of EPS, so that only the movement decides."""
    ball, movement = sphere(0.2, -0.1, height_over(0.2, -0.1, RADIUS - 0.5 * EPS)), [x, LEVEL[1], z]
    return ask(
        "polygon_adjust_sphere_to_plane", single(), poly=0, sphere=ball, movement=movement, walk_interp=1.0
    )


def _touching(z: float, x: float) -> Query:
    ball = sphere(0.2, -0.1, 0.3)
    return ask(
        "polygon_adjust_sphere_to_poly", single(), poly=0, sphere=ball, curr=[x, -0.1, z], movement=DOWN
    )


def along_triangle() -> float:
    """Return the z that makes a movement over `LEVEL` one along the triangle, metres."""
    nx, ny, nz, _ = triangle_plane()
    return -dot((nx, ny, 0.0), (*LEVEL, 0.0)) / nz


def height_over(x: float, y: float, distance: float = 0.0) -> float:
    """Return the z of a point at a distance from the triangle's plane, metres."""
    nx, ny, nz, d = triangle_plane()
    return (distance - d - x * nx - y * ny) / nz


def _is_struck(fields: Fields) -> bool:
    return bool(fields["struck"])


def _touches_at_start(fields: Fields) -> bool:
    return bool(fields["t"] == 1.0)


POLYGONS: Final = (
    Comparison("plane in front at the radius", "02 SS-1", _XZ, _front, says_yes, (0.2, 1.5), 0.2),
    Comparison("plane behind at the radius", "02 SS-1", _XZ, _back, _is_struck, (-0.2, -1.5), 0.2),
    Comparison(
        "movement along the plane",
        "02 PS-3",
        ("movement z (m)", "movement x (m)"),
        _direction,
        says_yes,
        (-0.5, 0.5),
        LEVEL[0],
    ),
    Comparison("point at an edge", "02 PP-3", ("x (m)", "y (m)"), _inside, says_yes, (0.0, 2.5), 0.1),
    Comparison(
        "point at an edge, in plan",
        "02 P2-3",
        ("x (m)", "y (m)"),
        _inside_seen_from_above,
        says_yes,
        (0.0, 2.5),
        0.1,
    ),
    Comparison("edge at the radius", "02 SS-5 a", _XY, _edge, says_yes, (0.5, 3.0), 0.1),
    Comparison(
        "corner at the radius",
        "02 SS-5 b",
        ("centre y (m)", "centre x (m)"),
        _corner,
        says_yes,
        (1.0, 2.6),
        0.3,
    ),
    Comparison(
        "slope at the allowance",
        "02 WH-1",
        ("walkable_allowance", "up z"),
        _slope,
        says_yes,
        (0.5, 1.0),
        1.0,
    ),
    Comparison("footprint at an edge", "02 CW-6", _XY, _walkable, says_yes, (0.5, 3.0), 0.1),
    Comparison("small footprint at an edge", "02 CW-6", _XY, _small_walkable, says_yes, (0.5, 3.0), 0.1),
    Comparison("foot point at an edge", "02 FE-3", _XY, _crossed, says_yes, (0.5, 3.0), 0.1),
    Comparison("plane not yet reached", "02 AS-4", _XZ, _settled, says_yes, (0.2, 1.5), 0.2),
    Comparison("walk_interp at its limit", "02 AS-4", _XZ, _settled, says_yes, (0.2, -2.0), 0.2),
    Comparison(
        "movement level within EPS",
        "02 AS-2",
        ("movement z (m)", "movement x (m)"),
        _level,
        says_yes,
        (along_triangle() - 0.1, along_triangle()),
        LEVEL[0],
    ),
    Comparison(
        "touching at the start",
        "02 AP-2",
        ("start z (m)", "start x (m)"),
        _touching,
        _touches_at_start,
        (0.2, 1.5),
        0.2,
    ),
)
"""In the order of the document."""
