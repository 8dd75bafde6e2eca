"""The two walks that nearly every query consists of, asked by themselves, many at a time."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from engine.constants import frozen
from engine.kernels.ahead import bring_near, bring_to_write
from engine.kernels.bsp_poly import sphere_intersects_poly
from engine.kernels.bsp_walkable import find_walkable
from engine.kernels.compile import entry, inlined, kernel
from engine.kernels.order import SPHERES, put_in_order, turn
from engine.kernels.rounding import f32
from engine.kernels.sharing import SHARE_LANES, join, lane_after, put_back, take
from engine.layout import (
    NO_POLYGON,
    POLYGON_ID,
    RADIUS,
    SPHERE_SIZE,
    VECTOR_SIZE,
    WALK_INTERP,
    WALKABLE_ALLOWANCE,
)

if TYPE_CHECKING:
    from engine.kernels.types import Array, Ints, Order, Sphere, Vector

AHEAD: Final = frozen(4)
"""How many spheres before its turn one is brought near: read out of turn, none lies beside the last."""


@inlined
def _vector(a: Array, i: int) -> Vector:
    """Read one of many vectors as float32."""
    return f32(a[i, 0]), f32(a[i, 1]), f32(a[i, 2])


@inlined
def _sphere(a: Array, i: int) -> Sphere:
    """Read one of many spheres as float32."""
    return f32(a[i, 0]), f32(a[i, 1]), f32(a[i, 2]), f32(a[i, RADIUS])


@inlined
def _id(wf: Array, poly: int) -> int:
    """Return a polygon's id in its shape, or -1."""
    return int(wf[poly + POLYGON_ID]) if poly != NO_POLYGON else -1


@kernel
def _strike_some(
    wf: Array,
    wi: Ints,
    s: Array,
    root: int,
    spheres: Array,
    movements: Array,
    struck: Ints,
    polygons: Ints,
    order: Order,
    first: int,
    last: int,
) -> None:
    """Find for each of some spheres the polygon that it strikes.

    retail: what calls BSPNODE::sphere_intersects_poly 0x0053CA30, 03 2
    """
    for k in range(first, last):
        i, later = turn(order, k), turn(order, min(k + AHEAD, last - 1))
        bring_near(spheres, SPHERE_SIZE * later, SPHERE_SIZE)
        bring_near(movements, VECTOR_SIZE * later, VECTOR_SIZE)
        bring_to_write(struck, later, 1)
        bring_to_write(polygons, later, 1)
        sphere, movement = _sphere(spheres, i), _vector(movements, i)
        struck[i], poly = sphere_intersects_poly(wf, wi, s, root, sphere, movement, NO_POLYGON)
        polygons[i] = _id(wf, poly)


@kernel
def _step_some_down(
    wf: Array,
    wi: Ints,
    s: Array,
    root: int,
    spheres: Array,
    movements: Array,
    ups: Array,
    allowances: Array,
    interps: Array,
    centers: Array,
    polygons: Ints,
    order: Order,
    first: int,
    last: int,
) -> None:
    """Put each of some spheres on the polygons that it can walk on; `interps` is ratcheted down in place.

    retail: what calls BSPNODE::find_walkable 0x0053CC80, 03 5
    """
    for k in range(first, last):
        i, later = turn(order, k), turn(order, min(k + AHEAD, last - 1))
        bring_near(spheres, SPHERE_SIZE * later, SPHERE_SIZE)
        bring_near(movements, VECTOR_SIZE * later, VECTOR_SIZE)
        bring_near(ups, VECTOR_SIZE * later, VECTOR_SIZE)
        bring_to_write(centers, VECTOR_SIZE * later, VECTOR_SIZE)
        bring_near(allowances, later, 1)
        bring_to_write(interps, later, 1)
        bring_to_write(polygons, later, 1)
        s[WALKABLE_ALLOWANCE] = f32(allowances[i])
        s[WALK_INTERP] = f32(interps[i])
        sphere, movement, up = _sphere(spheres, i), _vector(movements, i), _vector(ups, i)
        poly, center = find_walkable(wf, wi, s, root, sphere, movement, up)
        centers[i, 0], centers[i, 1], centers[i, 2] = center
        interps[i] = s[WALK_INTERP]
        polygons[i] = _id(wf, poly)


@entry
def strike_many(
    wf: Array,
    wi: Ints,
    s: Array,
    root: int,
    spheres: Array,
    movements: Array,
    struck: Ints,
    polygons: Ints,
    order: Order,
    share: Ints,
) -> None:
    """Strike with spheres that are taken from a share."""
    own = join(share)
    put_in_order(SPHERES, spheres, order, share)
    for k in range(share[SHARE_LANES]):
        lane = lane_after(share, own, k)
        first, last = take(share, lane)
        while first < last:
            _strike_some(wf, wi, s, root, spheres, movements, struck, polygons, order, first, last)
            put_back(share, last - first, 0)
            first, last = take(share, lane)


@entry
def step_down_many(
    wf: Array,
    wi: Ints,
    s: Array,
    root: int,
    spheres: Array,
    movements: Array,
    ups: Array,
    allowances: Array,
    interps: Array,
    centers: Array,
    polygons: Ints,
    order: Order,
    share: Ints,
) -> None:
    """Step down with spheres that are taken from a share."""
    own = join(share)
    put_in_order(SPHERES, spheres, order, share)
    for k in range(share[SHARE_LANES]):
        lane = lane_after(share, own, k)
        first, last = take(share, lane)
        while first < last:
            _step_some_down(
                wf,
                wi,
                s,
                root,
                spheres,
                movements,
                ups,
                allowances,
                interps,
                centers,
                polygons,
                order,
                first,
                last,
            )
            put_back(share, last - first, 0)
            first, last = take(share, lane)
