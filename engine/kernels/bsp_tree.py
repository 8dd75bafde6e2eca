"""BSPTREE::find_collisions and its six paths (03, 10-16).

Retail's path 5 calls CTransition::step_up, which comes back here through whole cells. Compiled code
must not recurse, so `find_collisions` answers NEEDS_STEP_UP instead and leaves the normal in the
row; who called it runs the step and uses its answer in place of this one.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from engine.constants import (
    CONTACT,
    NEEDS_STEP_UP,
    PATH_CLIPPED,
    PLACEMENT_INSERT,
)
from engine.kernels.bsp_ground import find_landing, find_room, find_support, step_sphere_down
from engine.kernels.bsp_struck import collide_clipped, collide_in_air, collide_in_contact
from engine.kernels.compile import entry, kernel
from engine.kernels.path import enter_current_center
from engine.kernels.rounding import f32
from engine.kernels.trace import (
    AIRBORNE_CALL,
    CHECK_WALKABLE_CALL,
    CLIPPED_CALL,
    CONTACT_CALL,
    LANDING_CALL,
    PLACEMENT_CALL,
    STEP_DOWN_CALL,
    trace_close,
    trace_open,
)
from engine.kernels.vector import load
from engine.layout import (
    CHECK_WALKABLE,
    COLLIDE,
    INSERT_TYPE,
    LOCALSPACE_CURR_CENTER,
    LOCALSPACE_SPHERE,
    OBSTRUCTION_ETHEREAL,
    OI_STATE,
    STEP_DOWN,
)

if TYPE_CHECKING:
    from engine.kernels.types import Array, Ints


@entry
def dispatch(s: Array) -> int:
    """Say which path a collision call will take, by its trace letter; the first match wins.

    retail: BSPTREE::find_collisions 0x0053A440, 03 16
    """
    if s[INSERT_TYPE] == PLACEMENT_INSERT or s[OBSTRUCTION_ETHEREAL] != 0.0:
        return PLACEMENT_CALL
    if s[CHECK_WALKABLE] != 0.0:
        return CHECK_WALKABLE_CALL
    if s[STEP_DOWN] != 0.0:
        return STEP_DOWN_CALL
    if s[COLLIDE] != 0.0:
        return LANDING_CALL
    state = int(s[OI_STATE])
    if state & CONTACT:
        return CONTACT_CALL
    return CLIPPED_CALL if state & PATH_CLIPPED else AIRBORNE_CALL


@entry
def find_collisions(wf: Array, wi: Ints, s: Array, root: int, scale: float) -> int:
    """Test the row's local-space spheres against a tree; a TransitionState, or NEEDS_STEP_UP.

    retail: BSPTREE::find_collisions 0x0053A440, FC-1...FC-15
    """
    path = dispatch(s)
    trace_open(wi, s, path)
    ts = _take_path(wf, wi, s, root, scale, path)
    if ts != NEEDS_STEP_UP:
        trace_close(wi, s, ts)
    return ts


@kernel
def _take_path(wf: Array, wi: Ints, s: Array, root: int, scale: float, path: int) -> int:
    """Take one of the six paths.

    retail: FC-1...FC-15
    """
    if path == PLACEMENT_CALL:
        return find_room(wf, wi, s, root)
    if path == CHECK_WALKABLE_CALL:
        return find_support(wf, wi, s, root)
    if path == STEP_DOWN_CALL:
        return step_sphere_down(wf, wi, s, root, scale)
    enter_current_center(s)
    x, y, z = load(s, LOCALSPACE_SPHERE)
    cx, cy, cz = load(s, LOCALSPACE_CURR_CENTER)
    movement = f32(x - cx), f32(y - cy), f32(z - cz)
    if path == LANDING_CALL:
        return find_landing(wf, wi, s, root, scale, movement)
    if path == CONTACT_CALL:
        return collide_in_contact(wf, wi, s, root, movement)
    if path == CLIPPED_CALL:
        return collide_clipped(wf, wi, s, root, scale, movement)
    return collide_in_air(wf, wi, s, root, movement)
