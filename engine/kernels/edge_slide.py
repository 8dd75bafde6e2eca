"""CTransition::edge_slide (05, 5 and 6): stay on the ground, or deal with the edge that it ends at."""

from __future__ import annotations

from typing import TYPE_CHECKING

from engine.constants import COLLIDED, EDGE_SLIDE, OK, ON_WALKABLE
from engine.kernels.adjust import cliff_slide
from engine.kernels.collision_info import forget_contact
from engine.kernels.compile import inlined, kernel
from engine.kernels.path import (
    add_offset_to_check_pos,
    cache_localspace_sphere,
    restore_check_pos,
    save_check_pos,
)
from engine.kernels.rounding import f32
from engine.kernels.stepping import precipice_slide, step_down, step_limits
from engine.kernels.vector import copy_four, load
from engine.layout import (
    CELL_ARRAY_VALID,
    CONTACT_PLANE,
    CONTACT_VALID,
    GLOBAL_CURR_CENTER,
    GLOBAL_SPHERE,
    LOCALSPACE_SPHERE,
    NO_POLYGON,
    NUM_SPHERE,
    OI_STATE,
    RADIUS,
    STEP_DOWN_HEIGHT,
    WALKABLE,
    WALKABLE_ALLOWANCE,
    WALKABLE_CHECK_POS,
    WALKABLE_POS,
    WALKABLE_SCALE,
)

if TYPE_CHECKING:
    from engine.kernels.types import Array, Ints


@kernel
def step_down_in_halves(wf: Array, wi: Ints, s: Array, height: float, z: float) -> tuple[bool, float]:
    """Step down at once, or in two halves where the step is higher than the sphere.

    Returns whether ground was found, and the height of a single step.

    retail: TI-18, TI-19, FP-5
    """
    r = s[GLOBAL_SPHERE + RADIUS]
    if s[NUM_SPHERE] < 2.0 and r + r < height:
        height = f32(r * 0.5)
    if r + r >= height:
        return step_down(wf, wi, s, height, z), height
    height = f32(height * 0.5)
    found = step_down(wf, wi, s, height, z) or step_down(wf, wi, s, height, z)
    return found, height


@kernel
def keep_contact(wf: Array, wi: Ints, s: Array) -> tuple[bool, int]:
    """Step down to stay on the ground, or deal with the edge that the mover is beyond.

    Returns whether the insert ends here, and its answer.

    retail: TI-16...TI-22
    """
    height, z = step_limits(s, STEP_DOWN_HEIGHT)
    s[WALKABLE_ALLOWANCE] = z
    save_check_pos(s)
    found, height = step_down_in_halves(wf, wi, s, height, z)
    if found:
        s[WALKABLE] = NO_POLYGON
        return True, OK
    return _edge_slide(wf, wi, s, height, z)


@inlined
def _leave_ground(s: Array) -> None:
    """Go back to before the step, without a ground.

    retail: ES-1, ES-4
    """
    s[WALKABLE] = NO_POLYGON
    restore_check_pos(s)
    forget_contact(s)
    s[CELL_ARRAY_VALID] = 1.0


@kernel
def _edge_slide(wf: Array, wi: Ints, s: Array, height: float, z: float) -> tuple[bool, int]:
    """Slide along a cliff or an edge, or step off it.

    Returns whether the insert ends here, and its answer.

    retail: CTransition::edge_slide 0x0050B3D0, ES-1...ES-4
    """
    state = int(s[OI_STATE])
    if not (state & ON_WALKABLE and state & EDGE_SLIDE):
        _leave_ground(s)
        return True, OK
    if s[CONTACT_VALID] != 0.0 and s[CONTACT_PLANE + 2] < z:
        s[WALKABLE] = NO_POLYGON
        restore_check_pos(s)
        ts = cliff_slide(s, CONTACT_PLANE)
        forget_contact(s)
        return False, ts
    if s[WALKABLE] != NO_POLYGON:
        restore_check_pos(s)
        forget_contact(s)
        ts = precipice_slide(wf, s)
        return ts == COLLIDED, ts
    if s[CONTACT_VALID] != 0.0:
        _leave_ground(s)
        return True, OK
    return _edge_behind(wf, wi, s, height, z)


@kernel
def _edge_behind(wf: Array, wi: Ints, s: Array, height: float, z: float) -> tuple[bool, int]:
    """Look for the edge where the mover came from.

    Returns whether the insert ends here, and its answer.

    retail: CTransition::edge_slide 0x0050B3D0, ES-5...ES-7
    """
    cx, cy, cz = load(s, GLOBAL_CURR_CENTER)
    gx, gy, gz = load(s, GLOBAL_SPHERE)
    add_offset_to_check_pos(s, f32(cx - gx), f32(cy - gy), f32(cz - gz))
    step_down(wf, wi, s, height, z)
    forget_contact(s)
    restore_check_pos(s)
    if s[WALKABLE] == NO_POLYGON:
        s[CELL_ARRAY_VALID] = 1.0
        return True, COLLIDED
    cache_localspace_sphere(s, s, WALKABLE_POS, s[WALKABLE_SCALE])
    copy_four(s, WALKABLE_CHECK_POS, s, LOCALSPACE_SPHERE)
    ts = precipice_slide(wf, s)
    return ts == COLLIDED, ts
