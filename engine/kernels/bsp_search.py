"""Searches that move a sphere again and again: the touching time and the initial placement (03, 14, 17)."""

from __future__ import annotations

from typing import TYPE_CHECKING

from engine.constants import ADJUST_BRACKET, ADJUST_TRIES
from engine.kernels.bsp_poly import sphere_intersects_poly
from engine.kernels.compile import entry, inlined
from engine.kernels.polygon_adjust import polygon_adjust_sphere_to_poly
from engine.kernels.rounding import f32

if TYPE_CHECKING:
    from engine.kernels.types import Array, Ints, Vector


@inlined
def _place(t: float, mx: float, my: float, mz: float, cx: float, cy: float, cz: float) -> Vector:
    """Return the centre at a fraction of the movement; the z product is not rounded.

    retail: AT-8
    """
    px = f32(mx * t)
    py = f32(my * t)
    return f32(px + cx), f32(py + cy), f32(t * mz + cz)


@entry
def adjust_to_plane(
    wf: Array,
    wi: Ints,
    s: Array,
    root: int,
    x: float,
    y: float,
    z: float,
    r: float,
    cx: float,
    cy: float,
    cz: float,
    poly: int,
) -> tuple[bool, float, float, float]:
    """Find the last free point of a movement from c to x, y, z that strikes `poly`.

    Returns whether it was found and the centre (on failure the last one tried).

    retail: BSPTREE::adjust_to_plane 0x00539BF0, AT-1...AT-8
    """
    mx, my, mz = f32(x - cx), f32(y - cy), f32(z - cz)
    lo, hi = 0.0, 1.0
    n = 0
    while True:
        t = polygon_adjust_sphere_to_poly(wf, poly, r, cx, cy, cz, mx, my, mz)
        if t == 1.0:
            break
        x, y, z = _place(t, mx, my, mz, cx, cy, cz)
        struck, poly = sphere_intersects_poly(wf, wi, s, root, x, y, z, r, mx, my, mz, poly)
        if not struck:
            lo = t
            break
        n += 1
        hi = t
        if n >= ADJUST_TRIES:
            return False, x, y, z
    while n < ADJUST_TRIES:
        mid = (lo + hi) * 0.5
        x, y, z = _place(mid, mx, my, mz, cx, cy, cz)
        struck, poly = sphere_intersects_poly(wf, wi, s, root, x, y, z, r, mx, my, mz, poly)
        if struck:
            hi = mid
        else:
            lo = mid
        if hi - lo < ADJUST_BRACKET:
            break
        n += 1
    x, y, z = _place(lo, mx, my, mz, cx, cy, cz)
    return True, x, y, z
