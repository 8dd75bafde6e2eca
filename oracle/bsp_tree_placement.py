"""BSPTREE, initial placement: push the spheres out of solid matter.

`placement_insert` is a method of `oracle.bsp_tree.BSPTree`.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from oracle.arithmetic import f32
from oracle.constants import PLACEMENT_TRIES
from oracle.enums import TransitionState
from oracle.ref import Ref
from oracle.trace import initial_placement, traced
from oracle.vector import Vector3

if TYPE_CHECKING:
    from oracle.bsp_tree import BSPTree
    from oracle.polygon import Polygon
    from oracle.sphere import Sphere
    from oracle.sphere_path import SpherePath
    from oracle.transition import Transition


@traced(initial_placement)
def placement_insert(self: BSPTree, transition: Transition) -> TransitionState:
    """Push the path's spheres out of solid matter, for an initial placement.

    The offset is not multiplied by any scale.

    Returns
    -------
    TransitionState
        OK if nothing had to move, ADJUSTED if the spheres moved, COLLIDED after the last try.

    Notes
    -----
    retail: BSPTREE::placement_insert 0x00539960, 03 PI-1…9.
    """
    root = self.root_node
    path = transition.sphere_path
    # PI-1
    sA = path.localspace_sphere[0].copy()
    sB = path.localspace_sphere[1].copy()
    r = sA.radius
    hit_poly: Ref[Polygon | None] = Ref(None)
    cc_flag = center_counts(path)
    i = 0
    while True:
        # PI-2
        center_solid = Ref(0)
        struck, other = sA, sB
        hit = root.sphere_intersects_solid_poly(sA, r, center_solid, hit_poly, cc_flag)
        if hit == 0:
            # PI-5
            if path.num_sphere <= 1:
                return _placed(path, sA, i)
            # PI-6: neither center_solid nor hit_poly is reset for the second sphere.
            struck, other = sB, sA
            hit = root.sphere_intersects_solid_poly(sB, r, center_solid, hit_poly, cc_flag)
            if hit == 0:
                return _placed(path, sA, i)
        if hit_poly.value is not None:
            # PI-3, PI-6
            hit_poly.value.adjust_to_placement_poly(struck, other, r, center_solid.value, cc_flag)
            hit_poly.value = None
            r = sA.radius
        else:
            # PI-4, PI-6
            r = f32(r + r)
        # PI-7
        i += 1
        if i >= PLACEMENT_TRIES:
            return TransitionState.COLLIDED


def center_counts(path: SpherePath) -> int:
    """Return whether a solid leaf counts by its flag alone (03 FC-2, PI-1)."""
    if path.bldg_check:
        return 1 if path.hits_interior_cell == 0 else 0
    return 1


def _placed(path: SpherePath, sA: Sphere, i: int) -> TransitionState:
    """Finish a successful placement after `i` pushes; the roundings depend on the number of spheres."""
    if i == 0:
        return TransitionState.OK
    s0 = path.localspace_sphere[0]
    dx = sA.center.x - s0.center.x
    dy = sA.center.y - s0.center.y
    dz = sA.center.z - s0.center.z
    if path.num_sphere <= 1:
        # PI-8
        f = path.localspace_pos.frame
        off = Vector3(
            f32((dx * f.m0 + dy * f.m3) + dz * f.m6),
            f32((dx * f.m1 + dy * f.m4) + dz * f.m7),
            f32((dx * f.m2 + dy * f.m5) + dz * f.m8),
        )
    else:
        # PI-9
        off = path.localspace_pos.localtoglobalvec(Vector3(f32(dx), f32(dy), f32(dz)))
    path.add_offset_to_check_pos(off)
    return TransitionState.ADJUSTED
