"""Comparisons of document 03: the ways through a tree, and containment in a cell."""

from __future__ import annotations

from functools import cache
from typing import TYPE_CHECKING, Final

from conformance.scenes.model import Geometry, Leaf
from conformance.scenes.polygons import merge
from conformance.stress.comparisons.base import (
    RADIUS,
    TRIANGLE,
    Comparison,
    ask,
    behind_plane,
    contained_by,
    says_yes,
    single,
    sphere,
    triangle_plane,
)
from conformance.stress.comparisons.polygons import height_over

if TYPE_CHECKING:
    from conformance.query import Fields, Query
    from conformance.scenes.polygons import Corners

ABOVE: Final[Corners] = ((-2.0, -2.0, 0.5), (2.0, -2.0, 0.5), (0.0, 3.0, 0.5))
BELOW: Final[Corners] = ((-2.0, -2.0, -0.5), (2.0, -2.0, -0.5), (0.0, 3.0, -0.5))
"""Polygons that a sphere touches which only just reaches, or leaves, the other side of the node's plane."""
FAR: Final[Corners] = ((-2.0, -2.0, 5.0), (2.0, -2.0, 5.0), (0.0, 3.0, 5.0))
"""A polygon that no sphere touches: what its leaf is, solid or not, decides by itself."""
BALL: Final = (0.31, -0.17, 0.29, 0.7)
"""Bounding sphere of a leaf, metres."""
ENTIRELY_INSIDE: Final = 2
ABOVE_PLANE: Final = 2.0
"""Distance from the triangle's plane at which a fall through it begins, metres."""
START: Final = height_over(0.2, -0.1, ABOVE_PLANE)
FALL: Final = (ABOVE_PLANE - RADIUS) / 0.36 / triangle_plane()[2]
"""Way down, free for 0.36 of it: five halves of the rest are 0.02, which is retail's bracket; metres."""
_ZX: Final = ("centre z (m)", "centre x (m)")


@cache
def _split(*, positive: bool) -> Geometry:
    """File a polygon on the side of the node that it is not on: what is visited shows in the answer."""
    return behind_plane(triangle_plane(), BELOW if positive else ABOVE, positive=positive)


@cache
def _solid_above() -> Geometry:
    """Make what is in front of the node solid."""
    return behind_plane(triangle_plane(), FAR, positive=True)


@cache
def _bounded() -> Geometry:
    """Bound a large polygon by a small sphere."""
    vertices, polygons = merge([TRIANGLE])
    return Geometry("bounded", vertices, polygons, Leaf(0, solid=True, sphere=BALL, polygons=(0,)))


@cache
def _cell() -> Geometry:
    return contained_by(triangle_plane())


@cache
def _second_plane() -> Geometry:
    """Put a plane before the one that decides: retail compares the second with a rounded sum."""
    return contained_by((0.0, 0.0, 1.0, 4.0), triangle_plane())


def _side(z: float, x: float) -> Query:
    return ask("bsp_point_intersects_solid", _split(positive=False), point=[x, -0.1, z])


def _front_only(z: float, x: float) -> Query:
    ball = sphere(x, -0.1, z)
    return ask("bsp_sphere_intersects_solid", _split(positive=False), sphere=ball, center_check=0)


def _back_only(z: float, x: float) -> Query:
    ball = sphere(x, -0.1, z)
    return ask("bsp_sphere_intersects_solid", _split(positive=True), sphere=ball, center_check=0)


def _center_side(z: float, x: float) -> Query:
    ball = sphere(x, -0.1, z)
    return ask("bsp_sphere_intersects_solid", _solid_above(), sphere=ball, center_check=1)


def _placed_center_side(z: float, x: float) -> Query:
    return ask(
        "bsp_sphere_intersects_solid_poly",
        _solid_above(),
        sphere=sphere(x, -0.1, z),
        radius=RADIUS,
        center_solid=0,
        center_check=1,
    )


def _halved(z: float, x: float) -> Query:
    """Fall right through a polygon: the last free point is looked for behind it, half by half."""
    return ask(
        "bsp_adjust_to_plane",
        single(),
        sphere=sphere(x, -0.1, z),
        curr=[x, -0.1, START],
        poly=0,
    )


def _bound(x: float, y: float) -> Query:
    return ask("bsp_sphere_intersects_solid", _bounded(), sphere=sphere(x, y, 0.05), center_check=0)


def _contained(z: float, x: float) -> Query:
    return ask("bsp_point_inside_cell", _cell(), point=[x, -0.1, z])


def _reaches_cell(z: float, x: float) -> Query:
    return ask("bsp_sphere_intersects_cell", _cell(), sphere=sphere(x, -0.1, z))


def _reaches_second(z: float, x: float) -> Query:
    return ask("bsp_sphere_intersects_cell", _second_plane(), sphere=sphere(x, -0.1, z))


def _holds_center(fields: Fields) -> bool:
    return bool(fields["center_solid"])


def _is_halved_again(fields: Fields) -> bool:
    """Tell 0.99 of the way, after six halves, from 0.98, after five."""
    return bool(fields["center"][2] < START - 0.985 * FALL)


def _is_inside(fields: Fields) -> bool:
    return bool(fields["r"] == ENTIRELY_INSIDE)


TREES: Final = (
    Comparison(
        "side of a centre",
        "03 SO-3",
        ("centre z (m)", "centre x (m)"),
        _center_side,
        says_yes,
        (-0.3, 0.3),
        0.2,
    ),
    Comparison(
        "side of a placed centre", "03 SQ-3", _ZX, _placed_center_side, _holds_center, (-0.3, 0.3), 0.2
    ),
    Comparison(
        "bracket of a search",
        "03 AT-6",
        ("end z (m)", "end x (m)"),
        _halved,
        _is_halved_again,
        (START - 0.97 * FALL, START - 1.03 * FALL),
        0.2,
    ),
    Comparison("side of a node", "03 BSPNODE 7", ("z (m)", "x (m)"), _side, says_yes, (-0.8, 0.8), 0.2),
    Comparison("in front of a node only", "03 BN-4", _ZX, _front_only, says_yes, (0.3, 0.9), 0.2),
    Comparison("behind a node only", "03 BN-4", _ZX, _back_only, says_yes, (-0.35, -0.9), 0.2),
    Comparison(
        "bounding spheres apart",
        "03 BN-1",
        ("centre x (m)", "centre y (m)"),
        _bound,
        says_yes,
        (0.5, 1.9),
        -0.1,
    ),
    Comparison("point in a cell", "03 8.1", ("z (m)", "x (m)"), _contained, says_yes, (-0.8, 0.8), 0.2),
    Comparison("sphere reaching a cell", "03 SC-2", _ZX, _reaches_cell, says_yes, (-1.5, 0.0), 0.2),
    Comparison("sphere inside a cell", "03 SC-3", _ZX, _reaches_cell, _is_inside, (0.0, 1.5), 0.2),
    Comparison("sphere inside a second plane", "03 SC-4", _ZX, _reaches_second, _is_inside, (0.0, 1.5), 0.2),
)
"""In the order of the document."""
