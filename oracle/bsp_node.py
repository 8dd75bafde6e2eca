"""BSPNODE: an interior node of a BSP tree (a portal node behaves as one)."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from oracle.arithmetic import f32
from oracle.constants import CELL_SLACK, EPS
from oracle.enums import BoundingType, Sidedness
from oracle.errors import MissingChildError
from oracle.vector import dot_x

if TYPE_CHECKING:
    from oracle.bbox import BBox
    from oracle.plane import Plane
    from oracle.polygon import Polygon
    from oracle.ref import Ref
    from oracle.sphere import Sphere
    from oracle.sphere_path import SpherePath
    from oracle.vector import Vector3

_BOX_CORNERS: Final = ("hhh", "llh", "lhl", "hll", "hlh", "lhh", "hhl")
"""The order in which box_intersects_cell_bsp looks at the corners after the lowest (03 8.3)."""


class BSPNode:
    """A splitting plane, a bounding sphere and two children, in the tree owner's space, metres.

    Every node of a physics tree has both children. A cell tree is a chain of positive children; there
    a missing child is ``None``, and spheres are not read. The cell functions are not virtual in
    retail: they treat a leaf as an interior node, with the zero plane of the constructor (03 0.3).
    """

    __slots__ = ("neg_node", "pos_node", "sphere", "splitting_plane")

    def __init__(
        self,
        splitting_plane: Plane,
        sphere: Sphere,
        pos_node: BSPNode | None,
        neg_node: BSPNode | None,
    ) -> None:
        self.splitting_plane = splitting_plane
        self.sphere = sphere
        self.pos_node = pos_node
        self.neg_node = neg_node

    def __repr__(self) -> str:
        return f"{type(self).__name__}({self.splitting_plane!r}, {self.sphere!r})"

    def children(self) -> tuple[BSPNode, BSPNode]:
        """Return both children; retail dereferences them without a test.

        Raises
        ------
        MissingChildError
            If one is missing: this is not a node of a physics tree.
        """
        if self.pos_node is None or self.neg_node is None:
            raise MissingChildError(self)
        return self.pos_node, self.neg_node

    def only_child_in_reach(self, center: Vector3, radius: float) -> tuple[BSPNode | None, float]:
        """Return the child that alone is in reach of a sphere (None: both are) and the plane distance.

        The three-way split of 03 BN-2…4.
        """
        # BN-2
        dist = dot_x(self.splitting_plane.N, center) + self.splitting_plane.d
        # BN-3
        reach = radius - EPS
        # BN-4
        if dist >= reach:
            return self.children()[0], dist
        if dist <= -reach:
            return self.children()[1], dist
        return None, dist

    def sphere_intersects_poly(
        self,
        check_pos: Sphere,
        movement: Vector3,
        polygon: Ref[Polygon | None],
        contact_pt: Ref[Vector3 | None],
    ) -> int:
        """Find the first polygon that a sphere overlaps and that faces its movement.

        `polygon` becomes every polygon that overlaps in turn, also those that face away: after a 0 it
        is the last one that overlaps, if any does.

        retail: BSPNODE::sphere_intersects_poly 0x0053CA30, 03 SP-1…3.
        """
        # SP-1
        if not self.sphere.intersects(check_pos):
            return 0
        # SP-2
        child, _ = self.only_child_in_reach(check_pos.center, check_pos.radius)
        if child is not None:
            return child.sphere_intersects_poly(check_pos, movement, polygon, contact_pt)
        # SP-3
        positive, negative = self.children()
        if positive.sphere_intersects_poly(check_pos, movement, polygon, contact_pt):
            return 1
        return negative.sphere_intersects_poly(check_pos, movement, polygon, contact_pt)

    def sphere_intersects_solid(self, check_pos: Sphere, center_check: int) -> int:
        """Tell whether a sphere overlaps solid matter.

        `center_check` says whether a solid leaf counts by its flag alone; it follows the side that
        holds the centre, while the positive child always goes first.

        retail: BSPNODE::sphere_intersects_solid 0x0053CAF0, 03 SO-1…4.
        """
        # SO-1
        if not self.sphere.intersects(check_pos):
            return 0
        # SO-2
        child, dist = self.only_child_in_reach(check_pos.center, check_pos.radius)
        if child is not None:
            return child.sphere_intersects_solid(check_pos, center_check)
        positive, negative = self.children()
        # SO-3
        if dist < 0.0:
            if positive.sphere_intersects_solid(check_pos, 0):
                return 1
            return negative.sphere_intersects_solid(check_pos, center_check)
        # SO-4
        if positive.sphere_intersects_solid(check_pos, center_check):
            return 1
        return negative.sphere_intersects_solid(check_pos, 0)

    def sphere_intersects_solid_poly(
        self,
        check_pos: Sphere,
        radius: float,
        center_solid: Ref[int],
        hit_poly: Ref[Polygon | None],
        center_check: int,
    ) -> int:
        """Find a polygon to push a sphere out of; the nearer child first.

        `radius` is the reach for the planes, apart from the sphere's own. A polygon found in the
        nearer child of a straddled node makes the answer ``center_solid``, not 1.

        retail: BSPNODE::sphere_intersects_solid_poly 0x0053CD50, 03 SQ-1…5.
        """
        # SQ-1
        if not self.sphere.intersects(check_pos):
            return 0
        # SQ-2
        child, dist = self.only_child_in_reach(check_pos.center, radius)
        if child is not None:
            return child.sphere_intersects_solid_poly(check_pos, radius, center_solid, hit_poly, center_check)
        # SQ-3
        positive, negative = self.children()
        near, far = (negative, positive) if dist < 0.0 else (positive, negative)
        near.sphere_intersects_solid_poly(check_pos, radius, center_solid, hit_poly, center_check)
        # SQ-4
        if hit_poly.value is not None:
            return center_solid.value
        # SQ-5
        return far.sphere_intersects_solid_poly(check_pos, radius, center_solid, hit_poly, 0)

    def find_walkable(
        self,
        path: SpherePath,
        valid_pos: Sphere,
        polygon: Ref[Polygon | None],
        movement: Vector3,
        up: Vector3,
        changed: Ref[int],
    ) -> None:
        """Put a sphere back onto every walkable polygon it overlaps, one after the other.

        Moves `valid_pos` and lowers ``path.walk_interp``; `polygon` becomes the last one it rests on.

        retail: BSPNODE::find_walkable 0x0053CC80, 03 FW-1…3.
        """
        # FW-1
        if not self.sphere.intersects(valid_pos):
            return
        # FW-2
        child, _ = self.only_child_in_reach(valid_pos.center, valid_pos.radius)
        if child is not None:
            child.find_walkable(path, valid_pos, polygon, movement, up, changed)
            return
        # FW-3: always both; the split is not reconsidered after the first one moved the sphere.
        positive, negative = self.children()
        positive.find_walkable(path, valid_pos, polygon, movement, up, changed)
        negative.find_walkable(path, valid_pos, polygon, movement, up, changed)

    def hits_walkable(self, path: SpherePath, valid_pos: Sphere, up: Vector3) -> int:
        """Tell whether a sphere stands on a walkable polygon with half its radius.

        retail: BSPNODE::hits_walkable 0x0053CBD0, 03 6.
        """
        if not self.sphere.intersects(valid_pos):
            return 0
        child, _ = self.only_child_in_reach(valid_pos.center, valid_pos.radius)
        if child is not None:
            return child.hits_walkable(path, valid_pos, up)
        positive, negative = self.children()
        if positive.hits_walkable(path, valid_pos, up):
            return 1
        return negative.hits_walkable(path, valid_pos, up)

    def point_intersects_solid(self, point: Vector3) -> int:
        """Tell whether a point is in solid matter; one exactly on a plane goes to its front.

        retail: BSPNODE::point_intersects_solid 0x0053C310, 03 7.
        """
        positive, negative = self.children()
        if dot_x(self.splitting_plane.N, point) + self.splitting_plane.d < 0.0:
            return negative.point_intersects_solid(point)
        return positive.point_intersects_solid(point)

    def point_inside_cell_bsp(self, origin: Vector3) -> int:
        """Tell whether a point is in a cell, down to EPS behind its planes.

        retail: BSPNODE::point_inside_cell_bsp 0x0053C1F0, 03 8.1.
        """
        node: BSPNode | None = self
        while node is not None:
            dist = dot_x(node.splitting_plane.N, origin) + node.splitting_plane.d
            if not dist >= -EPS:
                return 0
            node = node.pos_node
        return 1

    def sphere_intersects_cell_bsp(self, sphere: Sphere) -> BoundingType:
        """Tell how much of a sphere is in a cell.

        The first plane, and the first after each one that the sphere straddles, is compared with the
        unrounded radius, later ones with the rounded one.

        retail: BSPNODE::sphere_intersects_cell_bsp 0x0053C260, 03 SC-1…4.
        """
        node = self
        # SC-1
        rad = sphere.radius + CELL_SLACK
        rad32 = f32(rad)
        while True:
            dist = dot_x(node.splitting_plane.N, sphere.center) + node.splitting_plane.d
            # SC-2
            if dist <= -rad:
                return BoundingType.OUTSIDE
            # SC-3
            if dist < rad:
                if node.pos_node is None or node.pos_node.sphere_intersects_cell_bsp(sphere):
                    return BoundingType.PARTIALLY_INSIDE
                return BoundingType.OUTSIDE
            # SC-4
            if node.pos_node is None:
                return BoundingType.ENTIRELY_INSIDE
            node = node.pos_node
            rad = rad32

    def box_intersects_cell_bsp(self, box: BBox) -> int:
        """Tell whether a box reaches into a cell: no plane has all its corners behind.

        retail: BSPNODE::box_intersects_cell_bsp 0x0053C880, 03 8.3.
        """
        node: BSPNode | None = self
        while node is not None:
            plane = node.splitting_plane
            if plane.which_side(box.min, EPS) == Sidedness.NEGATIVE and all(
                plane.which_side(box.corner(corner), EPS) == Sidedness.NEGATIVE for corner in _BOX_CORNERS
            ):
                return 0
            node = node.pos_node
        return 1
