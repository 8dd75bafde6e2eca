"""BSPLEAF: a leaf of a BSP tree, with the polygons tested in it."""

from __future__ import annotations

from typing import TYPE_CHECKING

from oracle.bsp_node import BSPNode
from oracle.plane import Plane
from oracle.vector import Vector3

if TYPE_CHECKING:
    from collections.abc import Iterable

    from oracle.polygon import Polygon
    from oracle.ref import Ref
    from oracle.sphere import Sphere
    from oracle.sphere_path import SpherePath


class BSPLeaf(BSPNode):
    """A bounding sphere and an ordered list of polygons, in the tree owner's space, metres.

    The files give a leaf no splitting plane, and retail leaves it uninitialised. A cell function that
    reaches a leaf reads it all the same; the zero plane is an assumption (03 0.3, 01 U6).
    """

    __slots__ = ("in_polys", "leaf_index", "solid")

    def __init__(self, leaf_index: int, solid: int, sphere: Sphere, in_polys: Iterable[Polygon]) -> None:
        super().__init__(Plane(Vector3(), 0.0), sphere, None, None)
        self.leaf_index = leaf_index
        self.solid = solid
        self.in_polys = tuple(in_polys)

    def sphere_intersects_poly(
        self,
        check_pos: Sphere,
        movement: Vector3,
        polygon: Ref[Polygon | None],
        contact_pt: Ref[Vector3 | None],
    ) -> int:
        """Find the first polygon that a sphere overlaps and that faces its movement.

        retail: BSPLEAF::sphere_intersects_poly 0x0053D580, 03 SP-4…6.
        """
        # SP-4
        if not self.in_polys or not self.sphere.intersects(check_pos):
            return 0
        # SP-5
        for poly in self.in_polys:
            if poly.pos_hits_sphere(check_pos, movement, contact_pt, polygon):
                return 1
        # SP-6
        return 0

    def sphere_intersects_solid(self, check_pos: Sphere, center_check: int) -> int:
        """Tell whether a sphere overlaps solid matter; an empty leaf is never solid.

        retail: BSPLEAF::sphere_intersects_solid 0x0053D5F0, 03 SO-5…8.
        """
        # SO-5
        if not self.in_polys:
            return 0
        # SO-6
        if center_check and self.solid:
            return 1
        # SO-7
        if not self.sphere.intersects(check_pos):
            return 0
        # SO-8
        for poly in self.in_polys:
            if poly.hits_sphere(check_pos):
                return 1
        return 0

    def sphere_intersects_solid_poly(
        self,
        check_pos: Sphere,
        radius: float,
        center_solid: Ref[int],
        hit_poly: Ref[Polygon | None],
        center_check: int,
    ) -> int:
        """Find a polygon to push a sphere out of; `radius` is not read here.

        retail: BSPLEAF::sphere_intersects_solid_poly 0x0053D780, 03 SQ-6…9.
        """
        # SQ-6
        if not self.in_polys:
            return 0
        # SQ-7
        if center_check and self.solid:
            center_solid.value = 1
        # SQ-8
        if self.sphere.intersects(check_pos):
            for poly in self.in_polys:
                if poly.hits_sphere(check_pos):
                    hit_poly.value = poly
                    return 1
        # SQ-9
        return center_solid.value

    def find_walkable(
        self,
        path: SpherePath,
        valid_pos: Sphere,
        polygon: Ref[Polygon | None],
        movement: Vector3,
        up: Vector3,
        changed: Ref[int],
    ) -> None:
        """Put a sphere back onto every walkable polygon of the leaf; each sees it as moved so far.

        retail: BSPLEAF::find_walkable 0x0053D6F0, 03 FW-4…5.
        """
        # FW-4
        if not self.in_polys or not self.sphere.intersects(valid_pos):
            return
        # FW-5
        for poly in self.in_polys:
            if poly.walkable_hits_sphere(path, valid_pos, up) and poly.adjust_sphere_to_plane(
                path, valid_pos, movement
            ):
                changed.value = 1
                polygon.value = poly

    def hits_walkable(self, path: SpherePath, valid_pos: Sphere, up: Vector3) -> int:
        """Tell whether a sphere stands on a walkable polygon with half its radius.

        retail: BSPLEAF::hits_walkable 0x0053D670, 03 6.
        """
        if not self.in_polys or not self.sphere.intersects(valid_pos):
            return 0
        for poly in self.in_polys:
            if poly.walkable_hits_sphere(path, valid_pos, up) and poly.check_small_walkable(valid_pos, up):
                return 1
        return 0

    def point_intersects_solid(self, point: Vector3) -> int:
        """Tell whether the leaf has polygons; its flag is not consulted.

        retail: BSPLEAF::point_intersects_solid 0x0053D3F0, 03 7.
        """
        return 1 if self.in_polys else 0
