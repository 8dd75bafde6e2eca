"""Neutral geometry as the oracle's polygons and trees, built once per geometry."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING
from weakref import WeakKeyDictionary

from conformance.candidates.oracle_ops.values import plane, sphere, vector
from conformance.scenes.model import Leaf
from oracle.bbox import BBox
from oracle.bsp_leaf import BSPLeaf
from oracle.bsp_node import BSPNode
from oracle.bsp_tree import BSPTree
from oracle.physics_part import GfxObj
from oracle.polygon import Polygon
from oracle.sphere import Sphere
from oracle.vector import Vector3

if TYPE_CHECKING:
    from collections.abc import MutableMapping, Sequence

    from conformance.scenes.model import Geometry, PlaneData, Tree


@dataclass(frozen=True, slots=True, eq=False)
class OracleGeometry:
    """What the oracle makes of a geometry; nothing in it changes during a query.

    Attributes
    ----------
    polygons : tuple of Polygon
        By polygon id, geometry space, metres.
    tree : BSPTree
        The physics BSP.
    cell_tree : BSPTree or None
        The cell BSP; None contains everything.
    gfx_obj : GfxObj
        The same tree, and the box of all vertices, for parts of objects.
    """

    polygons: tuple[Polygon, ...]
    tree: BSPTree
    cell_tree: BSPTree | None
    gfx_obj: GfxObj


CACHE: MutableMapping[Geometry, OracleGeometry] = WeakKeyDictionary()
"""What has been built; a candidate whose polygons or trees differ from retail's swaps in its own."""


def oracle_geometry(geometry: Geometry) -> OracleGeometry:
    """Return the oracle's form of a geometry, the same one for the same geometry object."""
    built = CACHE.get(geometry)
    if built is None:
        built = CACHE[geometry] = _build(geometry)
    return built


def _build(geometry: Geometry) -> OracleGeometry:
    corners = [vector(v) for v in geometry.vertices]
    polygons = tuple(
        Polygon([corners[i] for i in polygon.vertices], index, polygon.sides)
        for index, polygon in enumerate(geometry.polygons)
    )
    tree = BSPTree(_build_tree(geometry.tree, polygons))
    return OracleGeometry(
        polygons, tree, _cell_tree(geometry), GfxObj(tree, bounding_box=BBox.around(corners))
    )


def _build_tree(tree: Tree, polygons: Sequence[Polygon]) -> BSPNode:
    """Build nodes and leaves, children before parents, without recursion: trees can be deep."""
    done: list[BSPNode] = []
    stack: list[tuple[Tree, bool]] = [(tree, False)]
    while stack:
        item, children_done = stack.pop()
        if isinstance(item, Leaf):
            leaf_polygons = [polygons[i] for i in item.polygons]
            done.append(BSPLeaf(item.index, int(item.solid), sphere(item.sphere), leaf_polygons))
        elif children_done:
            negative, positive = done.pop(), done.pop()
            done.append(BSPNode(plane(item.plane), sphere(item.sphere), positive, negative))
        else:
            stack += [(item, True), (item.negative, False), (item.positive, False)]
    return done.pop()


def _cell_tree(geometry: Geometry) -> BSPTree | None:
    if not geometry.cell_planes:
        return None
    return BSPTree(_cell_chain(geometry.cell_planes))


def _cell_chain(planes: Sequence[PlaneData]) -> BSPNode:
    """Chain containment planes through the positive child, the first outermost."""
    chain: BSPNode | None = None
    for values in reversed(planes):
        chain = BSPNode(plane(values), Sphere(Vector3(), 0.0), chain, None)
    if chain is None:
        raise ValueError("a cell BSP needs at least one plane")
    return chain
