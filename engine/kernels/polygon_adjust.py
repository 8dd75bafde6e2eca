"""How far has a sphere to move so that it touches a CPolygon's plane (02, 4, 5 and 14)."""

from __future__ import annotations

from typing import TYPE_CHECKING

from engine.constants import EPS, WALK_INTERP_FLOOR
from engine.kernels.compile import entry, inlined_entry
from engine.kernels.polygon import along_normal, plane_distance
from engine.kernels.rounding import f32

if TYPE_CHECKING:
    from engine.kernels.types import Array, Sphere, Vector


@entry
def polygon_adjust_sphere_to_poly(wf: Array, p: int, radius: float, begin: Vector, movement: Vector) -> float:
    """Return the fraction of a movement from `begin` at which the sphere touches the plane.

    retail: CPolygon::adjust_sphere_to_poly 0x00538170, AP-1...AP-5
    """
    cx, cy, cz = begin
    mx, my, mz = movement
    dist0 = f32(plane_distance(wf, p, cx, cy, cz))
    if abs(dist0) < radius:
        return 1.0
    v = along_normal(wf, p, mx, my, mz)
    if abs(v) < EPS:
        return 0.0
    r = -radius if dist0 <= 0.0 else radius
    return (r - dist0) / v


@inlined_entry
def polygon_adjust_sphere_to_plane(
    wf: Array, p: int, sphere: Sphere, movement: Vector, interp: float
) -> tuple[bool, Sphere, float]:
    """Move a sphere back along its movement until it rests on the plane.

    Returns whether it did, the sphere, and walk_interp.

    retail: CPolygon::adjust_sphere_to_plane 0x00538210, AS-1...AS-6
    """
    x, y, z, radius = sphere
    mx, my, mz = movement
    dist = plane_distance(wf, p, x, y, z)
    v = along_normal(wf, p, mx, my, mz)
    if v > EPS:
        num = (-radius) - dist
    elif v >= -EPS:
        return False, sphere, interp
    else:
        num = dist - radius
    t = num / v
    w = (1.0 - t) * interp
    w32 = f32(w)
    if w >= interp or w32 < WALK_INTERP_FLOOR:
        return False, sphere, interp
    oy = f32(t * my)
    oz = f32(t * mz)
    return True, (f32(x - t * mx), f32(y - oy), f32(z - oz), radius), w32


@entry
def polygon_placement_push(
    wf: Array, p: int, x: float, y: float, z: float, radius: float, center_solid: int, solid_check: int
) -> Vector:
    """Return the push that puts the struck sphere at its radius from the plane.

    x is an unrounded register, y and z are stored; the caller adds the push to both spheres.

    retail: CPolygon::adjust_to_placement_poly 0x00538CE0, AQ-1...AQ-3
    """
    dist = plane_distance(wf, p, x, y, z)
    if solid_check == 0:
        k = radius - dist
    else:
        r = radius
        if center_solid != 0:
            r = r * -1.0
        if dist <= 0.0:
            r = -r
        k = r - dist
    return k * wf[p], f32(k * wf[p + 1]), f32(k * wf[p + 2])
