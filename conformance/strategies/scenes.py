"""Geometry: built from primitives, random triangles, and what the vector files share."""

from __future__ import annotations

import hashlib
import math
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

from hypothesis import strategies as st

from conformance.scenes.bsp_builder import TreeStyle, build
from conformance.scenes.primitives import make
from conformance.strategies.numbers import grid
from conformance.vector_library import Library

if TYPE_CHECKING:
    from collections.abc import Mapping

    from conformance.scenes.model import Geometry, Vec3
    from conformance.scenes.polygons import Shape

_VECTORS: Final = Path(__file__).parent.parent / "vectors"
_LEAST_AREA: Final = 0.05
"""Smallest random triangle, square metres: slivers have their own cases."""

_SHAPES: Final[Mapping[str, tuple[str, Mapping[str, Any]]]] = {
    "floor": ("floor", {"size": (20.0, 20.0)}),
    "tiled-floor": ("floor", {"size": (6.0, 6.0), "tiles": (3, 3)}),
    "room": ("room", {"size": (6.0, 5.0, 3.0)}),
    "low-room": ("room", {"size": (4.0, 4.0, 1.5)}),
    "box": ("box", {"size": (2.0, 1.5, 0.5)}),
    "gentle-ramp": ("ramp", {"width": 4.0, "run": 6.0, "degrees": 30.0}),
    "limit-ramp": ("ramp", {"width": 4.0, "run": 6.0, "degrees": 48.38}),
    "steep-ramp": ("ramp", {"width": 4.0, "run": 6.0, "degrees": 60.0}),
    "stairs": ("stairs", {"width": 3.0, "rise": 0.25, "run": 0.3, "count": 6}),
    "high-stairs": ("stairs", {"width": 3.0, "rise": 0.7, "run": 0.6, "count": 3}),
    "hatch": ("hatch", {"size": (6.0, 6.0), "hole": (1.5, 1.0), "depth": 1.0}),
    "doorway": (
        "doorway",
        {"length": 5.0, "height": 3.0, "door_width": 1.2, "door_height": 2.2, "thickness": 0.3},
    ),
    "pillar": ("pillar", {"radius": 0.4, "height": 3.0, "sides": 8}),
}
"""Name of the geometry, primitive, parameters (metres, degrees)."""


def face(geometry: Geometry, polygon: int) -> tuple[Vec3, list[Vec3]]:
    """Return a polygon's unit normal (float64) and its corners."""
    corners = list(geometry.corners(polygon))
    return _normal(corners), corners


@cache
def _primitive(name: str, style: TreeStyle) -> Geometry:
    primitive, parameters = _SHAPES[name]
    return build(f"{name}-{style}", make(primitive, parameters), style=style, kind=name)


@cache
def _shared() -> tuple[Geometry, ...]:
    found = tuple(Library(_VECTORS).geometries.values())
    if not found:
        raise FileNotFoundError(f"no geometry in {_VECTORS}")
    return found


def _normal(corners: list[Vec3]) -> Vec3:
    """Newell's normal: half its length is the area, so zero for a degenerate polygon."""
    x = y = z = 0.0
    for (ax, ay, az), (bx, by, bz) in zip(corners, corners[1:] + corners[:1], strict=True):
        x += (ay - by) * (az + bz)
        y += (az - bz) * (ax + bx)
        z += (ax - bx) * (ay + by)
    size = math.hypot(x, y, z)
    return (x / size, y / size, z / size) if size > 0.0 else (0.0, 0.0, 0.0)


def _area(a: Vec3, b: Vec3, c: Vec3) -> float:
    u = [q - p for p, q in zip(a, b, strict=True)]
    v = [q - p for p, q in zip(a, c, strict=True)]
    return 0.5 * math.hypot(u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0])


def _soups() -> st.SearchStrategy[Geometry]:
    """Make the strategy of a few random triangles about the origin, not a solid."""
    corner = st.tuples(grid(-3.0, 3.0), grid(-3.0, 3.0), grid(-1.0, 2.0))
    triangle = st.tuples(corner, corner, corner).filter(lambda corners: _area(*corners) > _LEAST_AREA)
    return st.builds(_soup, st.lists(triangle, min_size=1, max_size=6), st.sampled_from(list(TreeStyle)))


def _soup(triangles: Shape, style: TreeStyle) -> Geometry:
    content = repr((triangles, style)).encode("utf-8")
    name = f"soup-{hashlib.sha256(content).hexdigest()[:8]}"
    return build(name, triangles, style=style, kind="soup")


PRIMITIVES: Final = st.builds(_primitive, st.sampled_from(sorted(_SHAPES)), st.sampled_from(list(TreeStyle)))
"""Shapes from primitives, in each style of tree."""

SHARED: Final = st.deferred(lambda: st.sampled_from(_shared()))
"""The geometry that the shipped vector files share."""

WITH_CELL_PLANES: Final = st.deferred(
    lambda: st.sampled_from([geometry for geometry in _shared() if geometry.cell_planes is not None])
)
"""The shared geometry that says which points are inside the cell."""

GEOMETRIES: Final = st.one_of(PRIMITIVES, SHARED, _soups())
"""Geometry of every kind, the simplest first."""
