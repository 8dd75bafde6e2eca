"""BSPTREE: the collision of a sphere path with the geometry of a cell or a part.

Everything here is in the local space that ``SPHEREPATH::cache_localspace_sphere`` prepared: spheres and
current centres divided by the scale, ``localspace_pos`` the unscaled position of cell or part,
``localspace_z`` the world's z axis. Results go back by rotating and multiplying by the scale.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from oracle import bsp_tree_placement, bsp_tree_steps
from oracle.arithmetic import f32
from oracle.bsp_tree_placement import center_counts
from oracle.bsp_tree_steps import world_offset
from oracle.constants import Z_LANDING
from oracle.enums import CONTACT_OI, PATH_CLIPPED_OI, BoundingType, InsertType, TransitionState
from oracle.plane import Plane
from oracle.ref import Ref
from oracle.trace import dispatch, traced
from oracle.vector import Vector3

if TYPE_CHECKING:
    from oracle.bbox import BBox
    from oracle.bsp_node import BSPNode
    from oracle.collision_info import CollisionInfo
    from oracle.polygon import Polygon
    from oracle.sphere import Sphere
    from oracle.sphere_path import SpherePath
    from oracle.transition import Transition


class BSPTree:
    """A physics tree or a cell tree, by its root."""

    __slots__ = ("root_node",)

    def __init__(self, root_node: BSPNode) -> None:
        self.root_node = root_node

    def __repr__(self) -> str:
        return f"BSPTree({self.root_node!r})"

    def point_inside_cell_bsp(self, origin: Vector3) -> int:
        """Tell whether a point is in the cell.

        retail: BSPTREE::point_inside_cell_bsp 0x005398C0, 03 8.4.
        """
        return self.root_node.point_inside_cell_bsp(origin)

    def sphere_intersects_cell_bsp(self, sphere: Sphere) -> BoundingType:
        """Tell how much of a sphere is in the cell.

        retail: BSPTREE::sphere_intersects_cell_bsp 0x005398D0, 03 8.4.
        """
        return self.root_node.sphere_intersects_cell_bsp(sphere)

    def box_intersects_cell_bsp(self, box: BBox) -> int:
        """Tell whether a box reaches into the cell.

        retail: BSPTREE::box_intersects_cell_bsp 0x005398B0, 03 8.4.
        """
        return self.root_node.box_intersects_cell_bsp(box)

    check_walkable = bsp_tree_steps.check_walkable
    step_sphere_up = bsp_tree_steps.step_sphere_up
    slide_sphere = bsp_tree_steps.slide_sphere
    step_sphere_down = bsp_tree_steps.step_sphere_down
    adjust_to_plane = bsp_tree_steps.adjust_to_plane
    collide_with_pt = bsp_tree_steps.collide_with_pt
    placement_insert = bsp_tree_placement.placement_insert

    @traced(dispatch)
    def find_collisions(self, transition: Transition, scale: float) -> TransitionState:
        """Collide the path's spheres with the tree, in the one way of six that its state asks for.

        Parameters
        ----------
        transition : Transition
            All state, in and out; its local-space spheres are cached.
        scale : float
            Of the part (1 for a cell).

        Notes
        -----
        retail: BSPTREE::find_collisions 0x0053A440, 03 FC-1…15.
        """
        path = transition.sphere_path
        collisions = transition.collision_info
        state = transition.object_info.state
        # FC-1
        s0 = path.localspace_sphere[0]
        cc = path.localspace_curr_center[0]
        movement = Vector3(f32(s0.center.x - cc.x), f32(s0.center.y - cc.y), f32(s0.center.z - cc.z))
        if path.insert_type == InsertType.PLACEMENT or path.obstruction_ethereal:
            return self._find_solid(path)
        # FC-4
        if path.check_walkable:
            return self.check_walkable(path, s0, scale)
        # FC-5
        if path.step_down:
            return self.step_sphere_down(path, collisions, s0, scale)
        if path.collide:
            return self._find_landing(path, collisions, movement, scale)
        if state & CONTACT_OI:
            return self._find_in_contact(transition, movement)
        # FC-12
        if state & PATH_CLIPPED_OI:
            return self._find_path_clipped(transition, movement, scale)
        return self._find_airborne(path, collisions, movement)

    def _find_solid(self, path: SpherePath) -> TransitionState:
        """Path 1, placement or ethereal: is either sphere in solid matter? (03 FC-2…3)."""
        # FC-2
        cc_flag = center_counts(path)
        for sphere in path.localspace_sphere[: max(path.num_sphere, 1)]:
            if self.root_node.sphere_intersects_solid(sphere, cc_flag):
                return TransitionState.COLLIDED
        # FC-3
        return TransitionState.OK

    def _find_landing(
        self, path: SpherePath, collisions: CollisionInfo, movement: Vector3, scale: float
    ) -> TransitionState:
        """Path 4, collide: does sphere 0 land on something? Nothing else is looked for (03 FC-6…7)."""
        s0 = path.localspace_sphere[0]
        # FC-6
        valid = s0.copy()
        poly: Ref[Polygon | None] = Ref(None)
        changed = Ref(0)
        self.root_node.find_walkable(path, valid, poly, movement, path.localspace_z, changed)
        if changed.value == 0 or poly.value is None:
            return TransitionState.OK
        # FC-7: unlike in SD-6 the difference is rounded before it is rotated.
        path.add_offset_to_check_pos(world_offset(path, valid, s0, scale))
        pl = Plane.localtoglobal(path.check_pos, path.localspace_pos, poly.value.plane)
        pl.d = f32(pl.d * scale)
        collisions.set_contact_plane(pl, 0)
        collisions.contact_plane_cell_id = path.check_pos.objcell_id
        path.set_walkable(valid, poly.value, path.localspace_z, path.localspace_pos, scale)
        return TransitionState.ADJUSTED

    def _find_in_contact(self, transition: Transition, movement: Vector3) -> TransitionState:
        """Path 5, on the ground: step up, slide, or note what only overlaps (03 FC-8…11)."""
        path = transition.sphere_path
        pos = path.localspace_pos
        hit_poly: Ref[Polygon | None] = Ref(None)
        contact_pt: Ref[Vector3 | None] = Ref(None)
        # FC-8
        hit = self.root_node.sphere_intersects_poly(path.localspace_sphere[0], movement, hit_poly, contact_pt)
        if hit and hit_poly.value is not None:
            return self.step_sphere_up(transition, hit_poly.value.plane.N)
        # FC-9: with one sphere an overlap that faces away is ignored.
        if path.num_sphere <= 1:
            return TransitionState.OK
        # FC-10
        hit2: Ref[Polygon | None] = Ref(None)
        hit = self.root_node.sphere_intersects_poly(path.localspace_sphere[1], movement, hit2, contact_pt)
        if hit and hit2.value is not None:
            return self.slide_sphere(path, transition.collision_info, hit2.value.plane.N)
        # FC-11
        if hit2.value is not None:
            path.set_neg_poly_hit(0, pos.localtoglobalvec(hit2.value.plane.N))
        elif hit_poly.value is not None:
            path.set_neg_poly_hit(1, pos.localtoglobalvec(hit_poly.value.plane.N))
        return TransitionState.OK

    def _find_airborne(
        self, path: SpherePath, collisions: CollisionInfo, movement: Vector3
    ) -> TransitionState:
        """Path 6a, in the air: sphere 0 begins a landing, sphere 1 just collides (03 FC-13…14).

        Any overlap counts, also one that faces away. A hit always leaves its polygon, so the polygon
        alone is retail's "hit or polygon".
        """
        pos = path.localspace_pos
        hit_poly: Ref[Polygon | None] = Ref(None)
        contact_pt: Ref[Vector3 | None] = Ref(None)
        # FC-13
        self.root_node.sphere_intersects_poly(path.localspace_sphere[0], movement, hit_poly, contact_pt)
        struck = hit_poly.value
        if struck is not None:
            path.set_collide(pos.localtoglobalvec(struck.plane.N))
            path.walkable_allowance = Z_LANDING
            return TransitionState.ADJUSTED
        # FC-14
        if path.num_sphere > 1:
            self.root_node.sphere_intersects_poly(path.localspace_sphere[1], movement, hit_poly, contact_pt)
            struck = hit_poly.value
            if struck is not None:
                collisions.set_collision_normal(pos.localtoglobalvec(struck.plane.N))
                return TransitionState.COLLIDED
        return TransitionState.OK

    def _find_path_clipped(self, transition: Transition, movement: Vector3, scale: float) -> TransitionState:
        """Path 6b, path clipped: any overlap of sphere 0 stops it; sphere 1 is never tested (03 FC-15)."""
        path = transition.sphere_path
        s0 = path.localspace_sphere[0]
        hit_poly: Ref[Polygon | None] = Ref(None)
        contact_pt: Ref[Vector3 | None] = Ref(None)
        # FC-15
        self.root_node.sphere_intersects_poly(s0, movement, hit_poly, contact_pt)
        if hit_poly.value is None:
            return TransitionState.OK
        return self.collide_with_pt(
            transition.object_info,
            path,
            transition.collision_info,
            s0,
            path.localspace_curr_center[0],
            hit_poly.value,
            contact_pt,
            scale,
        )
