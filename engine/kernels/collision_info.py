"""COLLISIONINFO (04, 5): contact plane, collision normal, sliding normal."""

from __future__ import annotations

from typing import TYPE_CHECKING

from engine.constants import OK
from engine.kernels.compile import inlined, kernel
from engine.kernels.vector import copy_four, normalize_check_small, store
from engine.layout import (
    COLLIDED_WITH_ENVIRONMENT,
    COLLISION_NORMAL,
    COLLISION_NORMAL_VALID,
    CONTACT_CELL_ID,
    CONTACT_IS_WATER,
    CONTACT_PLANE,
    CONTACT_VALID,
    FRAMES_STATIONARY_FALL,
    LAST_COLLIDED_OBJECT,
    LAST_KNOWN_PLANE,
    LAST_KNOWN_VALID,
    NO_OBJECT,
    NUM_COLLIDE_OBJECT,
    SLIDING_NORMAL,
    SLIDING_VALID,
    WORLD_TOUCHED,
)

if TYPE_CHECKING:
    from engine.kernels.types import Array, Ints, Vector


@kernel
def collision_info_init(s: Array) -> None:
    """Reset what retail resets; planes, normals and water flags stay.

    retail: COLLISIONINFO::init 0x00509D60, 04 5
    """
    s[LAST_KNOWN_VALID] = 0.0
    s[CONTACT_VALID] = 0.0
    s[SLIDING_VALID] = 0.0
    s[COLLISION_NORMAL_VALID] = 0.0
    s[NUM_COLLIDE_OBJECT] = 0.0
    s[LAST_COLLIDED_OBJECT] = NO_OBJECT
    s[COLLIDED_WITH_ENVIRONMENT] = 0.0
    s[CONTACT_CELL_ID] = 0.0
    s[FRAMES_STATIONARY_FALL] = 0.0


@inlined
def forget_contact(s: Array) -> None:
    """Invalidate the contact plane, and nothing else.

    retail: 05, "forget contact"
    """
    s[CONTACT_VALID] = 0.0
    s[CONTACT_IS_WATER] = 0.0


@inlined
def set_contact_plane(
    s: Array, nx: float, ny: float, nz: float, d: float, is_water: float, cell_id: float
) -> None:
    """Set the contact plane, and the cell id that every caller sets right after.

    retail: COLLISIONINFO::set_contact_plane 0x00509D80, 04 5
    """
    s[CONTACT_VALID] = 1.0
    store(s, CONTACT_PLANE, nx, ny, nz)
    s[CONTACT_PLANE + 3] = d
    s[CONTACT_IS_WATER] = is_water
    s[CONTACT_CELL_ID] = cell_id


@kernel
def set_collision_normal(s: Array, x: float, y: float, z: float) -> None:
    """Set the collision normal, normalised; zero if it is too short, but valid all the same.

    retail: COLLISIONINFO::set_collision_normal 0x0050A000, 04 5
    """
    small, nx, ny, nz = normalize_check_small(x, y, z)
    s[COLLISION_NORMAL_VALID] = 1.0
    if small:
        store(s, COLLISION_NORMAL, 0.0, 0.0, 0.0)
    else:
        store(s, COLLISION_NORMAL, nx, ny, nz)


@kernel
def set_sliding_normal(s: Array, x: float, y: float) -> None:
    """Set the sliding normal, flattened and normalised; zero if too short, but valid all the same.

    retail: COLLISIONINFO::set_sliding_normal 0x0050A060, 04 5
    """
    small, nx, ny, nz = normalize_check_small(x, y, 0.0)
    s[SLIDING_VALID] = 1.0
    if small:
        store(s, SLIDING_NORMAL, 0.0, 0.0, 0.0)
    else:
        store(s, SLIDING_NORMAL, nx, ny, nz)


@inlined
def sliding_reference(s: Array) -> Vector:
    """Return the normal of the plane to slide along: the contact plane's, or else the last known one's.

    The last known plane is used whether it is valid or not.

    retail: 07 6.B.4
    """
    at = CONTACT_PLANE if s[CONTACT_VALID] != 0.0 else LAST_KNOWN_PLANE
    return s[at], s[at + 1], s[at + 2]


@inlined
def copy_plane(s: Array, to: int, source: int) -> None:
    """Copy a plane bit by bit."""
    copy_four(s, to, s, source)


@kernel
def add_object(wi: Ints, s: Array, thing: int, ts: int) -> None:
    """Note a touched object once, and which one was struck last.

    retail: COLLISIONINFO::add_object 0x006B4E20, 04 5
    """
    count = int(s[NUM_COLLIDE_OBJECT])
    base = wi[WORLD_TOUCHED]
    for i in range(base, base + count):
        if s[i] == thing:
            return
    s[base + count] = thing
    s[NUM_COLLIDE_OBJECT] = count + 1
    if ts != OK:
        s[LAST_COLLIDED_OBJECT] = thing
