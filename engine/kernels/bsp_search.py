"""Searches that move a sphere again and again: the touching time and the initial placement (03, 14, 17)."""

from __future__ import annotations

from typing import TYPE_CHECKING

from engine.constants import ADJUST_BRACKET, ADJUST_TRIES
from engine.kernels.bsp_poly import sphere_intersects_poly
from engine.kernels.compile import entry, inlined
from engine.kernels.polygon_adjust import polygon_adjust_sphere_to_poly
from engine.kernels.rounding import f32
from engine.kernels.vector import centre

if TYPE_CHECKING:
    from engine.kernels.types import Array, Ints, Sphere, Vector


@inlined
def _place(t: float, movement: Vector, begin: Vector, r: float) -> Sphere:
    """Return the sphere at a fraction of the movement; the z product is not rounded.

    retail: AT-8
    """
    mx, my, mz = movement
    cx, cy, cz = begin
    px = f32(mx * t)
    py = f32(my * t)
    return f32(px + cx), f32(py + cy), f32(t * mz + cz), r


@entry
def adjust_to_plane(
    wf: Array, wi: Ints, s: Array, root: int, sphere: Sphere, begin: Vector, poly: int
) -> tuple[bool, Vector]:
    """Find the last free point of a movement from `begin` to where the sphere is, that strikes `poly`.

    Returns whether it was found and the centre (on failure the last one tried).

    retail: BSPTREE::adjust_to_plane 0x00539BF0, AT-1...AT-8
    """
    x, y, z, r = sphere
    cx, cy, cz = begin
    movement = f32(x - cx), f32(y - cy), f32(z - cz)
    lo, hi = 0.0, 1.0
    n = 0
    while True:
        t = polygon_adjust_sphere_to_poly(wf, poly, r, begin, movement)
        if t == 1.0:
            break
        sphere = _place(t, movement, begin, r)
        struck, poly = sphere_intersects_poly(wf, wi, s, root, sphere, movement, poly)
        if not struck:
            lo = t
            break
        n += 1
        hi = t
        if n >= ADJUST_TRIES:
            return False, centre(sphere)
    while n < ADJUST_TRIES:
        mid = (lo + hi) * 0.5
        sphere = _place(mid, movement, begin, r)
        struck, poly = sphere_intersects_poly(wf, wi, s, root, sphere, movement, poly)
        if struck:
            hi = mid
        else:
            lo = mid
        if hi - lo < ADJUST_BRACKET:
            break
        n += 1
    return True, centre(_place(lo, movement, begin, r))
