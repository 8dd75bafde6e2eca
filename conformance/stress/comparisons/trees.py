"""Comparisons of document 03: the ways through a tree, and containment in a cell."""

from __future__ import annotations

from functools import cache
from typing import TYPE_CHECKING, Final

from conformance.scenes.model import Geometry, Leaf
from conformance.scenes.polygons import merge
from conformance.stress.comparisons.base import (
    TRIANGLE,
    Comparison,
    ask,
    behind_plane,
    contained_by,
    says_yes,
    sphere,
    triangle_plane,
)

if TYPE_CHECKING:
    from conformance.query import Fields, Query
    from conformance.scenes.polygons import Corners

ABOVE: Final[Corners] = ((-2.0, -2.0, 0.5), (2.0, -2.0, 0.5), (0.0, 3.0, 0.5))
BELOW: Final[Corners] = ((-2.0, -2.0, -0.5), (2.0, -2.0, -0.5), (0.0, 3.0, -0.5))
"""Polygons that a sphere touches which only just reaches, or leaves, the other side of the node's plane."""
BALL: Final = (0.31, -0.17, 0.29, 0.7)
"""Bounding sphere of a leaf, metres."""
ENTIRELY_INSIDE: Final = 2
_ZX: Final = ("centre z (m)", "centre x (m)")


@cache
def _split(*, positive: bool) -> Geometry:
    """File a polygon on the side of the node that it is not on: what is visited shows in the answer."""
    return behind_plane(triangle_plane(), BELOW if positive else ABOVE, positive=positive)


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


def _bound(x: float, y: float) -> Query:
    return ask("bsp_sphere_intersects_solid", _bounded(), sphere=sphere(x, y, 0.05), center_check=0)


def _contained(z: float, x: float) -> Query:
    return ask("bsp_point_inside_cell", _cell(), point=[x, -0.1, z])


def _reaches_cell(z: float, x: float) -> Query:
    return ask("bsp_sphere_intersects_cell", _cell(), sphere=sphere(x, -0.1, z))


def _reaches_second(z: float, x: float) -> Query:
    return ask("bsp_sphere_intersects_cell", _second_plane(), sphere=sphere(x, -0.1, z))


def _is_inside(fields: Fields) -> bool:
    return bool(fields["r"] == ENTIRELY_INSIDE)


TREES: Final = (
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
