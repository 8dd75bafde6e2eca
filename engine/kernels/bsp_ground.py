"""Paths 1 to 4 of BSPTREE::find_collisions (03, 10, 13, 16): room, support, ground below, landing."""

from __future__ import annotations

from typing import TYPE_CHECKING

from engine.constants import (
    ADJUSTED,
    COLLIDED,
    OK,
)
from engine.kernels.bsp_poly import sphere_intersects_solid
from engine.kernels.bsp_walkable import find_walkable, hits_walkable
from engine.kernels.collision_info import set_contact_plane
from engine.kernels.compile import inlined, kernel
from engine.kernels.frame import rotate_x_last
from engine.kernels.lattice import no_ground_near, nothing_near
from engine.kernels.path import add_offset_to_check_pos, entered_sphere, set_walkable
from engine.kernels.plane import plane_localtoglobal
from engine.kernels.position import position_localtoglobalvec
from engine.kernels.rounding import f32
from engine.kernels.vector import centre, load, load_four
from engine.layout import (
    BLDG_CHECK,
    CHECK_POS,
    HITS_INTERIOR_CELL,
    LOCALSPACE_POS,
    LOCALSPACE_SPHERE,
    LOCALSPACE_Z,
    NO_POLYGON,
    NUM_SPHERE,
    RADIUS,
    STEP_DOWN_AMT,
    WALK_INTERP,
)

if TYPE_CHECKING:
    from engine.kernels.types import Array, Ints, Sphere, Vector


@inlined
def center_check_flag(s: Array) -> int:
    """Say whether a solid leaf counts by its flag: not in a building whose interior is reached.

    retail: FC-2
    """
    return 0 if s[BLDG_CHECK] != 0.0 and s[HITS_INTERIOR_CELL] != 0.0 else 1


@kernel
def find_room(wf: Array, wi: Ints, s: Array, root: int) -> int:
    """Path 1: no sphere may touch solid matter.

    retail: FC-2, FC-3
    """
    flag = center_check_flag(s)
    for i in range(max(int(s[NUM_SPHERE]), 1)):
        sphere = entered_sphere(s, i)
        if nothing_near(wf, wi, s, root, sphere, flag):
            continue
        if sphere_intersects_solid(wf, wi, s, root, sphere, flag):
            return COLLIDED
    return OK


@kernel
def find_support(wf: Array, wi: Ints, s: Array, root: int) -> int:
    """Path 2: COLLIDED says that something supports sphere 0.

    retail: BSPTREE::check_walkable 0x00539ED0, FC-4, 03 10
    """
    supported = hits_walkable(wf, wi, s, root, load_four(s, LOCALSPACE_SPHERE), load(s, LOCALSPACE_Z))
    return COLLIDED if supported else OK


@kernel
def _set_found_plane(wf: Array, s: Array, poly: int, scale: float) -> None:
    """Make the plane of a polygon that was found the contact plane.

    retail: SD-9, SD-10, FC-7
    """
    nx, ny, nz, d = plane_localtoglobal(s[CHECK_POS], s, LOCALSPACE_POS, wf, poly)
    set_contact_plane(s, nx, ny, nz, f32(d * scale), 0.0, s[CHECK_POS])


@inlined
def _step_movement(s: Array, scale: float) -> Vector:
    """Return the way down of a step, in the space of the tree.

    retail: SD-1...SD-3
    """
    amt = -(s[STEP_DOWN_AMT] * s[WALK_INTERP])
    ax = f32(amt * s[LOCALSPACE_Z])
    ay = f32(amt * s[LOCALSPACE_Z + 1])
    az = amt * s[LOCALSPACE_Z + 2]
    inv = 1.0 / scale
    inv32 = f32(inv)
    return f32(inv * ax), f32(ay * inv32), f32(az * inv32)


@inlined
def _find_ground(
    wf: Array, wi: Ints, s: Array, root: int, sphere: Sphere, movement: Vector
) -> tuple[int, Vector]:
    """Search for ground along a movement; return the polygon, or `NO_POLYGON`, and where it puts the sphere.

    retail: SD-4, FC-6
    """
    up = load(s, LOCALSPACE_Z)
    if no_ground_near(wf, wi, s, root, sphere, up):
        return NO_POLYGON, centre(sphere)
    return find_walkable(wf, wi, s, root, sphere, movement, up)


@kernel
def step_sphere_down(wf: Array, wi: Ints, s: Array, root: int, scale: float) -> int:
    """Path 3: put sphere 0 on what is walkable within the step.

    retail: BSPTREE::step_sphere_down 0x0053A210, SD-1...SD-12
    """
    sphere = load_four(s, LOCALSPACE_SPHERE)
    poly, (vx, vy, vz) = _find_ground(wf, wi, s, root, sphere, _step_movement(s, scale))
    if poly == NO_POLYGON:
        return OK
    x, y, z, r = sphere
    ox, oy, oz = rotate_x_last(s, LOCALSPACE_POS, vx - x, vy - y, vz - z)
    add_offset_to_check_pos(s, f32(ox * scale), f32(oy * scale), f32(oz * scale))
    _set_found_plane(wf, s, poly, scale)
    set_walkable(s, vx, vy, vz, r, poly, scale)
    return ADJUSTED


@kernel
def move_scaled(s: Array, vx: float, vy: float, vz: float, scale: float) -> None:
    """Move the check position as sphere 0 was moved in the space of the tree.

    retail: FC-7, CP-4
    """
    x, y, z = load(s, LOCALSPACE_SPHERE)
    gx, gy, gz = position_localtoglobalvec(s, LOCALSPACE_POS, f32(vx - x), f32(vy - y), f32(vz - z))
    add_offset_to_check_pos(s, f32(gx * scale), f32(gy * scale), f32(gz * scale))


@kernel
def find_landing(wf: Array, wi: Ints, s: Array, root: int, scale: float, movement: Vector) -> int:
    """Path 4: search for a landing along the real movement.

    retail: FC-6, FC-7
    """
    poly, (vx, vy, vz) = _find_ground(wf, wi, s, root, load_four(s, LOCALSPACE_SPHERE), movement)
    if poly == NO_POLYGON:
        return OK
    move_scaled(s, vx, vy, vz, scale)
    _set_found_plane(wf, s, poly, scale)
    set_walkable(s, vx, vy, vz, s[LOCALSPACE_SPHERE + RADIUS], poly, scale)
    return ADJUSTED
