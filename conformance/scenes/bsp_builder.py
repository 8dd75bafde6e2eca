"""The BSP builder: from polygons to the tree that a game file would hold.

The tree is an auto-partition: interior planes are the planes of polygons, or, where many polygons
remain, an axis-parallel plane that halves them. Polygons are cut for the search only; leaves refer to
whole polygons, so a polygon that spans planes is listed in several leaves.

Why retail finds every polygon in such a tree (document 03, BN-1 to BN-4): let q be the point of a
polygon nearest to a sphere's centre, at most ``radius - EPS`` away. The piece that holds q went to the
side of each plane that q is on, so the centre is at most that far behind the plane and the side is
visited; and q is inside every bounding sphere on the way.
"""

from __future__ import annotations

import enum
import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Final

import numpy as np

from conformance.scenes.bounds import EMPTY_SPHERE, Bounds
from conformance.scenes.model import Geometry, Leaf, Node
from conformance.scenes.pieces import BACK_SIDE, FRONT_SIDE, UNUSED, Piece, part
from conformance.scenes.planes import plane_of
from conformance.scenes.polygons import merge, round_shape
from conformance.scenes.splitter import choose
from conformance.scenes.validate import check_shape

if TYPE_CHECKING:
    from collections.abc import Sequence

    from conformance.scenes.model import PlaneData, Polygon, SphereData, Tree, Vec3
    from conformance.scenes.polygons import Shape
    from conformance.scenes.splitter import Splitter


class TreeStyle(enum.StrEnum):
    """Which leaf lists a polygon that bounds solid matter."""

    FRONT = "front"
    """The empty leaf in front of it."""
    BEHIND = "behind"
    """The solid leaf behind it; retail's ``point_intersects_solid`` is right in these trees only."""
    BOTH = "both"
    """Both."""


CANCELLED: Final = 1e-6
"""Share of the surface around a leaf below which it counts as none: above what cutting loses."""

SIDES: Final = {
    TreeStyle.FRONT: (FRONT_SIDE,),
    TreeStyle.BEHIND: (BACK_SIDE,),
    TreeStyle.BOTH: (FRONT_SIDE, BACK_SIDE),
}


@dataclass(slots=True)
class _Region:
    """One node or leaf in the making; a leaf has no plane.

    ``solid`` is only a first guess: the side of the nearest polygon plane above.
    """

    pieces: list[Piece]
    solid: bool
    sphere: SphereData = EMPTY_SPHERE
    polygons: tuple[int, ...] = ()
    plane: PlaneData | None = None
    positive: int = 0
    negative: int = 0


def build(
    name: str,
    shape: Shape,
    *,
    style: TreeStyle,
    kind: str,
    cell_planes: tuple[PlaneData, ...] | None = None,
) -> Geometry:
    """Check polygons and make a geometry of them, tree included.

    Parameters
    ----------
    name : str
        What records call it.
    shape : Shape
        Metres, in the geometry's own frame; rounded to float32 here.
    style : TreeStyle
        Which leaves list a polygon.
    kind : str
        What made it, for reports.
    cell_planes : tuple of PlaneData, optional
        The cell BSP as a chain of planes; without it the cell contains every point.

    Returns
    -------
    Geometry
        The same input gives the same tree, on every platform.

    Raises
    ------
    SceneError
        A polygon is not finite, flat, convex, or has no area; its path is ``polygons[i]``.
    """
    rounded = round_shape(shape)
    check_shape(rounded, "")
    vertices, polygons = merge(rounded)
    return Geometry(name, vertices, polygons, build_tree(vertices, polygons, style), cell_planes, kind)


def build_tree(vertices: Sequence[Vec3], polygons: Sequence[Polygon], style: TreeStyle) -> Tree:
    """Build the tree of valid polygons.

    Parameters
    ----------
    vertices : sequence of Vec3
        Metres, float32.
    polygons : sequence of Polygon
        Valid by `conformance.scenes.validate.shape_errors`.
    style : TreeStyle
        Which leaves list a polygon.

    Returns
    -------
    Tree
        Leaves are numbered in positive-first order and list polygons by rising id. A leaf is solid when
        more of the surface around it faces away than towards it: in a closed scene, all of it. Without
        any polygon the tree is one empty leaf.
    """
    shape = [tuple(vertices[i] for i in polygon.vertices) for polygon in polygons]
    planes = [plane_of(corners) for corners in shape]
    bounds = Bounds(shape)
    listed = {UNUSED, *SIDES[style]}
    whole = [Piece(np.array(corners), i, UNUSED) for i, corners in enumerate(shape)]
    regions = [_Region(whole, solid=False)]
    waiting = [0]
    while waiting:
        region = regions[waiting.pop()]
        present = tuple(sorted({piece.polygon for piece in region.pieces if piece.side in listed}))
        region.sphere = bounds.sphere(present)
        splitter = choose(region.pieces, planes)
        if splitter is None:
            region.polygons, region.solid = present, _is_solid(region)
        else:
            region.positive, region.negative = len(regions), len(regions) + 1
            regions += _split(region, splitter, planes)
            waiting += [region.negative, region.positive]
    return _assemble(regions)


def _split(region: _Region, splitter: Splitter, planes: Sequence[PlaneData]) -> tuple[_Region, _Region]:
    """Make an interior node of a region, and return its two children."""
    front, back, on_plane = part(region.pieces, splitter.plane, splitter.owner, planes)
    region.plane, region.polygons, region.pieces = splitter.plane, on_plane, []
    if splitter.owner is None:
        return _Region(front, region.solid), _Region(back, region.solid)
    return _Region(front, solid=False), _Region(back, solid=True)


def _is_solid(region: _Region) -> bool:
    """Tell whether a leaf is solid, by the area of the surfaces around it.

    Faces that lie back to back on each other cancel; where nothing is left, the first guess stands.
    """
    areas = [piece.side * piece.area() for piece in region.pieces]
    outwards = math.fsum(areas)
    if abs(outwards) <= CANCELLED * math.fsum(abs(area) for area in areas):
        return region.solid
    return outwards < 0.0


def _assemble(regions: Sequence[_Region]) -> Tree:
    """Turn regions, parents before children, into a tree."""
    leaf_index = _number_leaves(regions)
    built: dict[int, Tree] = {}
    for i in reversed(range(len(regions))):
        region = regions[i]
        if region.plane is None:
            built[i] = Leaf(leaf_index[i], region.solid, region.sphere, region.polygons)
        else:
            positive, negative = built.pop(region.positive), built.pop(region.negative)
            built[i] = Node(region.plane, region.sphere, region.polygons, positive, negative)
    return built[0]


def _number_leaves(regions: Sequence[_Region]) -> dict[int, int]:
    numbers: dict[int, int] = {}
    waiting = [0]
    while waiting:
        i = waiting.pop()
        if regions[i].plane is None:
            numbers[i] = len(numbers)
        else:
            waiting += [regions[i].negative, regions[i].positive]
    return numbers
