"""CPhysicsObj, the seed: what a tick tells its transition, and running it.

The functions here are methods of `oracle.physics_object.PhysicsObj`.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from oracle.constants import DUMMY_RADIUS
from oracle.enums import CONTACT_OI, EDGE_SLIDE, FREE_ROTATE_OI, ON_WALKABLE_OI, PATH_CLIPPED_OI
from oracle.physics_state import EDGE_SLIDE_PS, MISSILE_PS
from oracle.sphere import Sphere
from oracle.transient_state import (
    CONTACT_TS,
    ON_WALKABLE_TS,
    SLIDING_TS,
    STATIONARY_FALL_TS,
    STATIONARY_STOP_TS,
    STATIONARY_STUCK_TS,
    WATER_CONTACT_TS,
)
from oracle.transition import Transition
from oracle.vector import Vector3

if TYPE_CHECKING:
    from oracle.physics_object import PhysicsObj
    from oracle.position import Position

UNSCALED: Final = 1.0
"""Scale of the dummy sphere (06 SEED-4)."""


def make_transition(self: PhysicsObj) -> Transition:
    """Return a new transition in the object's world (06 SEED-1); there is always one."""
    return Transition(self.world)


def transition(self: PhysicsObj, old_pos: Position, new_pos: Position, admin_move: int) -> Transition | None:
    """Try to move the object; None if the transition failed.

    retail: CPhysicsObj::transition 0x00512DC0, 06 SEED-1…8.
    """
    made = self.seed_transition(old_pos, new_pos, admin_move)
    # SEED-7
    ok = made.find_valid_position()
    # SEED-8
    return made if ok else None


def seed_transition(self: PhysicsObj, old_pos: Position, new_pos: Position, admin_move: int) -> Transition:
    """Return a transition that is ready to run (06 SEED-1…6)."""
    # SEED-1
    made = self.make_transition()
    # SEED-2
    flags = self.get_object_info(made, admin_move)
    # SEED-3
    made.init_object(self, flags)
    # SEED-4
    self.give_spheres(made)
    # SEED-5
    made.init_path(self.cell, old_pos, new_pos)
    # SEED-6
    ci = made.collision_info
    if self.transient_state & STATIONARY_STUCK_TS:
        ci.frames_stationary_fall = 3
    elif self.transient_state & STATIONARY_STOP_TS:
        ci.frames_stationary_fall = 2
    elif self.transient_state & STATIONARY_FALL_TS:
        ci.frames_stationary_fall = 1
    return made


def give_spheres(self: PhysicsObj, made: Transition) -> None:
    """Give a transition the object's spheres, or a small one if it has none (06 SEED-4)."""
    parts = self.part_array
    count = 0 if parts is None else parts.get_num_sphere()
    if parts is not None and count > 0:
        made.init_sphere(count, parts.get_sphere(), self.m_scale)
    else:
        made.init_sphere(1, [Sphere(Vector3(0.0, 0.0, DUMMY_RADIUS), DUMMY_RADIUS)], UNSCALED)


def get_object_info(self: PhysicsObj, made: Transition, admin_move: int) -> int:
    """Return the mover's state bits; seeds the transition with contact plane and sliding normal.

    retail: CPhysicsObj::get_object_info 0x00511CC0, 06 GO-1…8.
    """
    # GO-1
    flags = EDGE_SLIDE if self.state & EDGE_SLIDE_PS else 0
    # GO-2
    if not admin_move:
        # GO-3
        if self.transient_state & CONTACT_TS:
            water = self.transient_state & WATER_CONTACT_TS
            # GO-4
            if self.check_contact(1):
                made.init_contact_plane(self.contact_plane_cell_id, self.contact_plane, water)
                flags |= CONTACT_OI
                if self.transient_state & ON_WALKABLE_TS:
                    flags |= ON_WALKABLE_OI
            # GO-5
            else:
                made.init_last_known_contact_plane(self.contact_plane_cell_id, self.contact_plane, water)
        # GO-6
        if self.transient_state & SLIDING_TS:
            made.init_sliding_normal(self.sliding_normal)
    # GO-7
    parts = self.part_array
    if parts is not None and parts.setup is not None and parts.setup.allow_free_heading:
        flags |= FREE_ROTATE_OI
    # GO-8
    if self.state & MISSILE_PS:
        flags |= PATH_CLIPPED_OI
    return flags
