"""Paths 5 and 6 of BSPTREE::find_collisions (03, 11, 12, 15, 16): what a moving sphere strikes."""

from __future__ import annotations

from typing import TYPE_CHECKING

from engine.constants import (
    ADJUSTED,
    COLLIDED,
    NEEDS_STEP_UP,
    OK,
    PERFECT_CLIP,
    Z_LANDING,
)
from engine.kernels.bsp_ground import move_scaled
from engine.kernels.bsp_poly import sphere_intersects_poly
from engine.kernels.bsp_search import adjust_to_plane
from engine.kernels.collision_info import set_collision_normal
from engine.kernels.compile import inlined, kernel
from engine.kernels.frame import frame_localtoglobalvec
from engine.kernels.lattice import nothing_near
from engine.kernels.path import entered_sphere, set_collide, set_neg_poly_hit
from engine.kernels.position import position_localtoglobalvec
from engine.kernels.sphere import slide_sphere
from engine.kernels.vector import load, load_four, store
from engine.layout import (
    LOCALSPACE_CURR_CENTER,
    LOCALSPACE_POS,
    LOCALSPACE_SPHERE,
    NO_POLYGON,
    NUM_SPHERE,
    OI_STATE,
    REQUESTED_NORMAL,
    WALKABLE_ALLOWANCE,
)

if TYPE_CHECKING:
    from engine.kernels.types import Array, Ints, Vector


@inlined
def _strikes(wf: Array, wi: Ints, s: Array, root: int, i: int, movement: Vector) -> tuple[bool, int]:
    """Search for the polygon that the i-th of the row's spheres strikes."""
    sphere = entered_sphere(s, i)
    if nothing_near(wf, wi, s, root, sphere, 0):
        return False, NO_POLYGON
    return sphere_intersects_poly(wf, wi, s, root, sphere, movement, NO_POLYGON)


@inlined
def _global_normal(wf: Array, s: Array, poly: int) -> Vector:
    """Return a polygon's normal in the block, z term last; never renormalised.

    retail: FC-11, FC-13, CP-3
    """
    return position_localtoglobalvec(s, LOCALSPACE_POS, wf[poly], wf[poly + 1], wf[poly + 2])


@inlined
def _response_normal(wf: Array, s: Array, poly: int) -> Vector:
    """Return a polygon's normal in the block, y term last; never renormalised.

    retail: 03 11.1
    """
    return frame_localtoglobalvec(s, LOCALSPACE_POS, wf[poly], wf[poly + 1], wf[poly + 2])


@kernel
def collide_in_contact(wf: Array, wi: Ints, s: Array, root: int, movement: Vector) -> int:
    """Path 5: step up on what sphere 0 strikes, slide along what sphere 1 strikes.

    retail: FC-8...FC-11, BSPTREE::step_sphere_up 0x00539F20, BSPTREE::slide_sphere 0x00539E50
    """
    spheres = max(int(s[NUM_SPHERE]), 1)
    first = poly = NO_POLYGON
    for i in range(spheres):
        first = poly
        struck, poly = _strikes(wf, wi, s, root, i, movement)
        if struck:
            x, y, z = _response_normal(wf, s, poly)
            store(s, REQUESTED_NORMAL, x, y, z)
            return NEEDS_STEP_UP if i == 0 else slide_sphere(s, REQUESTED_NORMAL)
    if spheres == 1:
        return OK
    if poly != NO_POLYGON:
        x, y, z = _global_normal(wf, s, poly)
        set_neg_poly_hit(s, 0.0, x, y, z)
    elif first != NO_POLYGON:
        x, y, z = _global_normal(wf, s, first)
        set_neg_poly_hit(s, 1.0, x, y, z)
    return OK


@kernel
def collide_in_air(wf: Array, wi: Ints, s: Array, root: int, movement: Vector) -> int:
    """Path 6a: try to land on what sphere 0 touches, stop at what sphere 1 touches.

    retail: FC-13, FC-14
    """
    for i in range(max(int(s[NUM_SPHERE]), 1)):
        _, poly = _strikes(wf, wi, s, root, i, movement)
        if poly == NO_POLYGON:
            continue
        x, y, z = _global_normal(wf, s, poly)
        if i != 0:
            set_collision_normal(s, x, y, z)
            return COLLIDED
        set_collide(s, x, y, z)
        s[WALKABLE_ALLOWANCE] = Z_LANDING
        return ADJUSTED
    return OK


@kernel
def collide_clipped(wf: Array, wi: Ints, s: Array, root: int, scale: float, movement: Vector) -> int:
    """Path 6b: a missile stops at what sphere 0 touches; sphere 1 is never tested.

    retail: FC-15, BSPTREE::collide_with_pt 0x0053A090, CP-1...CP-4
    """
    _, poly = _strikes(wf, wi, s, root, 0, movement)
    if poly == NO_POLYGON:
        return OK
    if not int(s[OI_STATE]) & PERFECT_CLIP:
        nx, ny, nz = _global_normal(wf, s, poly)
        set_collision_normal(s, nx, ny, nz)
        return COLLIDED
    sphere, begin = load_four(s, LOCALSPACE_SPHERE), load(s, LOCALSPACE_CURR_CENTER)
    found, (vx, vy, vz) = adjust_to_plane(wf, wi, s, root, sphere, begin, poly)
    if not found:
        return COLLIDED
    nx, ny, nz = _global_normal(wf, s, poly)
    set_collision_normal(s, nx, ny, nz)
    move_scaled(s, vx, vy, vz, scale)
    return ADJUSTED
