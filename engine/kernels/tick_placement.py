"""CPhysicsObj, placement (06, 10): putting a body into a cell, without a path that leads there."""

from __future__ import annotations

from typing import TYPE_CHECKING

from engine.body_layout import (
    B_STATUS,
    NO_VALID_POSITION,
    P_CELL,
    P_POSE,
    P_RESULT,
    P_SLIDE,
    PLACED,
    PLACED_IN_NO_CELL,
    PLACEMENT_COLLIDED,
)
from engine.constants import PLACEMENT_SLACK
from engine.kernels.cell_array import cell_id
from engine.kernels.compile import inlined, kernel
from engine.kernels.query import load_pose
from engine.kernels.tick_collisions import respond, track_touched_objects
from engine.kernels.tick_position import become_lost, set_position_internal
from engine.kernels.tick_seed import seed_placement
from engine.kernels.tick_velocity import set_velocity
from engine.kernels.transition import find_valid_position
from engine.kernels.vector import copy_vector
from engine.layout import (
    CURR_CELL,
    CURR_POS,
    KILL_VELOCITY,
    NO_CELL,
    ORIGIN,
    POSE_ORIGIN,
    STATUS,
    STATUS_OK,
)

if TYPE_CHECKING:
    from engine.kernels.types import Array, Ints


@kernel
def place(wf: Array, wi: Ints, s: Array, b: Array, p: Array) -> None:
    """Put a body down as a placement says, which takes the result. `s` is a row for its transition."""
    b[B_STATUS] = STATUS_OK
    p[P_RESULT] = _place(wf, wi, s, b, p)


@kernel
def _place(wf: Array, wi: Ints, s: Array, b: Array, p: Array) -> int:
    """Put a body down, and take over where it ended; in no cell it is lost.

    retail: CPhysicsObj::SetPositionInternal 0x00515BD0, SP-3...SP-7
    """
    if p[P_CELL] == NO_CELL:
        load_pose(s, CURR_POS, p, P_POSE)
        become_lost(s, b)
        return PLACED
    seed_placement(s, b, p)
    found = find_valid_position(wf, wi, s)
    b[B_STATUS] = s[STATUS]
    if s[STATUS] != STATUS_OK:
        return NO_VALID_POSITION
    if s[KILL_VELOCITY] > 0.0:
        set_velocity(b, 0.0, 0.0, 0.0)
    if found and p[P_SLIDE] == 0.0:
        found = _is_near(wf, wi, s, p)
    if not found:
        reported = track_touched_objects(wi, s, b)
        reported |= respond(s, b, False)
        return PLACEMENT_COLLIDED if reported else NO_VALID_POSITION
    if s[CURR_CELL] == NO_CELL:
        return PLACED_IN_NO_CELL
    set_position_internal(wf, wi, s, b)
    return PLACED


@inlined
def _is_near(wf: Array, wi: Ints, s: Array, p: Array) -> bool:
    """Say whether the body ended about where it was wanted: neither far east or north of it, nor elsewhere.

    If so the placement takes the origin where it is.

    retail: SP-5
    """
    o = CURR_POS + ORIGIN
    east, north = s[o] - p[P_POSE + POSE_ORIGIN], s[o + 1] - p[P_POSE + POSE_ORIGIN + 1]
    if not (east < PLACEMENT_SLACK and north < PLACEMENT_SLACK):
        return False
    if s[CURR_POS] != cell_id(wf, wi, int(p[P_CELL])):
        return False
    copy_vector(p, P_POSE + POSE_ORIGIN, s, o)
    return True
