"""BSPTREE, what its collision paths do: check for ground, step up or down, slide, stop at a point.

The functions here are methods of `oracle.bsp_tree.BSPTree`.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from oracle.arithmetic import f32
from oracle.constants import ADJUST_BRACKET, ADJUST_TRIES
from oracle.enums import PERFECT_CLIP_OI, TransitionState
from oracle.plane import Plane
from oracle.ref import Ref
from oracle.vector import Vector3

if TYPE_CHECKING:
    from oracle.bsp_tree import BSPTree
    from oracle.collision_info import CollisionInfo
    from oracle.object_info import ObjectInfo
    from oracle.polygon import Polygon
    from oracle.sphere import Sphere
    from oracle.sphere_path import SpherePath
    from oracle.transition import Transition


def check_walkable(self: BSPTree, path: SpherePath, check_pos: Sphere, scale: float) -> TransitionState:
    """Return COLLIDED if the sphere stands on something walkable, OK if not.

    retail: BSPTREE::check_walkable 0x00539ED0, 03 10.
    """
    # 03 10.1
    valid = check_pos.copy()
    # 03 10.2
    return TransitionState((self.root_node.hits_walkable(path, valid, path.localspace_z) != 0) + 1)


def step_sphere_up(self: BSPTree, transition: Transition, collision_normal: Vector3) -> TransitionState:
    """Try to step onto what was hit, or slide along it.

    retail: BSPTREE::step_sphere_up 0x00539F20, 03 11.
    """
    path = transition.sphere_path
    # 03 11.1: the arithmetic of Frame::localtoglobalvec
    n = path.localspace_pos.frame.localtoglobalvec(collision_normal)
    # 03 11.2
    if transition.step_up(n):
        return TransitionState.OK
    # 03 11.3
    return path.step_up_slide(transition.object_info, transition.collision_info)


def slide_sphere(
    self: BSPTree, path: SpherePath, collisions: CollisionInfo, collision_normal: Vector3
) -> TransitionState:
    """Slide along what sphere 1 hit, always with sphere 0.

    retail: BSPTREE::slide_sphere 0x00539E50, 03 12.
    """
    # the arithmetic of Frame::localtoglobalvec
    n = path.localspace_pos.frame.localtoglobalvec(collision_normal)
    return path.global_sphere[0].slide_sphere(path, collisions, n, path.global_curr_center[0])


def step_sphere_down(
    self: BSPTree, path: SpherePath, collisions: CollisionInfo, check_pos: Sphere, scale: float
) -> TransitionState:
    """Look for a walkable polygon below and rest sphere 0 on it.

    retail: BSPTREE::step_sphere_down 0x0053A210, 03 SD-1…12.
    """
    # SD-1
    amt = -(path.step_down_amt * path.walk_interp)
    # SD-2
    lz = path.localspace_z
    ax = f32(amt * lz.x)
    ay = f32(amt * lz.y)
    az = amt * lz.z
    # SD-3
    inv = 1.0 / scale
    inv32 = f32(inv)
    mv = Vector3(f32(inv * ax), f32(ay * inv32), f32(az * inv32))
    # SD-4
    valid = check_pos.copy()
    poly: Ref[Polygon | None] = Ref(None)
    changed = Ref(0)
    self.root_node.find_walkable(path, valid, poly, mv, lz, changed)
    # SD-5
    if changed.value == 0 or poly.value is None:
        return TransitionState.OK
    # SD-6
    dx = valid.center.x - check_pos.center.x
    dy = valid.center.y - check_pos.center.y
    dz = valid.center.z - check_pos.center.z
    f = path.localspace_pos.frame
    ox = f32((dz * f.m6 + dy * f.m3) + dx * f.m0)
    oy = f32((dz * f.m7 + dy * f.m4) + dx * f.m1)
    oz = f32((dz * f.m8 + dy * f.m5) + dx * f.m2)
    # SD-7
    off = Vector3(f32(ox * scale), f32(oy * scale), f32(oz * scale))
    # SD-8: inlined in retail
    path.add_offset_to_check_pos(off)
    # SD-9
    pl = Plane.localtoglobal(path.check_pos, path.localspace_pos, poly.value.plane)
    pl.d = f32(pl.d * scale)
    # SD-10: inlined in retail
    collisions.set_contact_plane(pl, 0)
    collisions.contact_plane_cell_id = path.check_pos.objcell_id
    # SD-11
    path.set_walkable(valid, poly.value, path.localspace_z, path.localspace_pos, scale)
    # SD-12
    return TransitionState.ADJUSTED


def adjust_to_plane(
    self: BSPTree, check_pos: Sphere, curr_pos: Vector3, hit_poly: Polygon, contact_pt: Ref[Vector3 | None]
) -> int:
    """Move a sphere to the last free point between its current centre and where it was hit.

    A 0 leaves the centre at the last point tried. The two searches share one counter.

    retail: BSPTREE::adjust_to_plane 0x00539BF0, 03 AT-1…8.
    """
    root = self.root_node
    # AT-1
    mv = Vector3(
        f32(check_pos.center.x - curr_pos.x),
        f32(check_pos.center.y - curr_pos.y),
        f32(check_pos.center.z - curr_pos.z),
    )
    lo = 0.0
    hi = 1.0
    n = 0
    struck: Ref[Polygon | None] = Ref(hit_poly)
    while True:
        # AT-2
        t = (struck.value or hit_poly).adjust_sphere_to_poly(check_pos, curr_pos, mv)
        if t == 1.0:
            break
        # AT-3
        _place(check_pos.center, curr_pos, mv, t)
        if not root.sphere_intersects_poly(check_pos, mv, struck, contact_pt):
            lo = t
            break
        # AT-4
        n += 1
        hi = t
        if n >= ADJUST_TRIES:
            return 0
    while True:
        # AT-5
        mid = (lo + hi) * 0.5
        _place(check_pos.center, curr_pos, mv, mid)
        if root.sphere_intersects_poly(check_pos, mv, struck, contact_pt):
            hi = mid
        else:
            lo = mid
        # AT-6
        if hi - lo < ADJUST_BRACKET:
            break
        n += 1
        if n >= ADJUST_TRIES:
            break
    # AT-7
    _place(check_pos.center, curr_pos, mv, lo)
    return 1


def collide_with_pt(
    self: BSPTree,
    object_: ObjectInfo,
    path: SpherePath,
    collisions: CollisionInfo,
    check_pos: Sphere,
    curr_pos: Vector3,
    hit_poly: Polygon,
    contact_pt: Ref[Vector3 | None],
    scale: float,
) -> TransitionState:
    """Stop a path-clipped mover at what it hit; a perfectly clipped one at the touching point.

    retail: BSPTREE::collide_with_pt 0x0053A090, 03 CP-1…4.
    """
    pos = path.localspace_pos
    # CP-1: the arithmetic of Position::localtoglobalvec
    if not object_.state & PERFECT_CLIP_OI:
        collisions.set_collision_normal(pos.localtoglobalvec(hit_poly.plane.N))
        return TransitionState.COLLIDED
    # CP-2
    valid = check_pos.copy()
    if not self.adjust_to_plane(valid, curr_pos, hit_poly, contact_pt):
        return TransitionState.COLLIDED
    # CP-3
    collisions.set_collision_normal(pos.localtoglobalvec(hit_poly.plane.N))
    # CP-4
    path.add_offset_to_check_pos(world_offset(path, valid, check_pos, scale))
    return TransitionState.ADJUSTED


def _place(center: Vector3, curr: Vector3, mv: Vector3, t: float) -> None:
    """Put a centre at the fraction `t` of a movement; the z product is not rounded (03 AT-8)."""
    px = f32(mv.x * t)
    py = f32(mv.y * t)
    center.x = f32(px + curr.x)
    center.y = f32(py + curr.y)
    center.z = f32(t * mv.z + curr.z)


def world_offset(path: SpherePath, valid: Sphere, check_pos: Sphere, scale: float) -> Vector3:
    """Return how far a local-space sphere was moved, in world axes and units (03 CP-4, FC-7)."""
    dv = Vector3(
        f32(valid.center.x - check_pos.center.x),
        f32(valid.center.y - check_pos.center.y),
        f32(valid.center.z - check_pos.center.z),
    )
    g = path.localspace_pos.localtoglobalvec(dv)
    return Vector3(f32(g.x * scale), f32(g.y * scale), f32(g.z * scale))
