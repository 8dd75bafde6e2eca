"""CPhysicsObj as an obstacle: who is exempt, which shape counts, and what is recorded.

The functions here are methods of `oracle.physics_object.PhysicsObj`.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from oracle.enums import (
    CONTACT_OI,
    IGNORE_CREATURES,
    IS_IMPENETRABLE,
    IS_PK,
    IS_PKLITE,
    IS_PLAYER,
    IS_VIEWER_OI,
    TransitionState,
)
from oracle.physics_state import (
    ETHEREAL_PS,
    HAS_PHYSICS_BSP_PS,
    IGNORE_COLLISIONS_PS,
    MISSILE_PS,
    STATIC_PS,
)

if TYPE_CHECKING:
    from oracle.object_info import ObjectInfo
    from oracle.physics_object import PhysicsObj
    from oracle.transition import Transition


def find_obj_collisions(self: PhysicsObj, transition: Transition) -> TransitionState:
    """Test the path against this object.

    retail: CPhysicsObj::FindObjCollisions 0x0050F050, 08 3.
    """
    oi, path, coll = transition.object_info, transition.sphere_path, transition.collision_info
    weenie = self.weenie_obj
    # 08 3.1
    if self.state & ETHEREAL_PS and self.state & IGNORE_COLLISIONS_PS:
        return TransitionState.OK
    # 08 3.2
    if weenie is not None and oi.state & IS_VIEWER_OI and weenie.is_creature:
        return TransitionState.OK
    # 08 3.3
    eth = int(bool(self.state & ETHEREAL_PS or (oi.ethereal and not self.state & STATIC_PS)))
    if eth and path.step_down:
        return TransitionState.OK
    # 08 3.4
    path.obstruction_ethereal = eth
    # 08 3.6
    is_creature = bool(self.state & MISSILE_PS) or (weenie is not None and weenie.is_creature)
    # 08 3.5, 08 3.7, 08 3.8
    r = TransitionState.OK
    if not _is_exempt(self, oi) and not oi.missile_ignore(self):
        r = _find_shape_collisions(self, transition, is_creature=is_creature)
    # 08 3.9
    if r != TransitionState.OK and not path.step_down:
        if self.state & STATIC_PS:
            if not oi.state & CONTACT_OI:
                coll.collided_with_environment = 1
        elif eth or (is_creature and oi.state & IGNORE_CREATURES):
            r = TransitionState.OK
            coll.collision_normal_valid = 0
            coll.add_object(self, TransitionState.OK)
        else:
            coll.add_object(self, r)
    # 08 3.10
    path.obstruction_ethereal = 0
    return r


def _is_exempt(self: PhysicsObj, oi: ObjectInfo) -> bool:
    """Tell whether one player passes through another (08 3.5)."""
    weenie = self.weenie_obj
    return (
        weenie is not None
        and weenie.is_player
        and bool(oi.state & IS_PLAYER)
        and not oi.state & IS_IMPENETRABLE
        and not weenie.is_impenetrable
        and not (oi.state & IS_PK and weenie.is_pk)
        and not (oi.state & IS_PKLITE and weenie.is_pklite)
    )


def _find_shape_collisions(self: PhysicsObj, transition: Transition, *, is_creature: bool) -> TransitionState:
    """Test the one family of shapes that counts: BSP parts, else cylinders, else spheres (08 3.8).

    The next family is not tried if one finds nothing.
    """
    parts = self.part_array
    if parts is None:
        return TransitionState.OK
    if self.state & HAS_PHYSICS_BSP_PS:
        return parts.find_obj_collisions(transition)
    r = TransitionState.OK
    for cylinder in parts.get_cylsphere():
        r = cylinder.intersects_sphere_at(self.m_position, self.m_scale, transition)
        if r != TransitionState.OK:
            return r
    if parts.get_cylsphere():
        return r
    for sphere in parts.get_sphere():
        r = sphere.intersects_sphere_at(self.m_position, self.m_scale, transition, is_creature=is_creature)
        if r != TransitionState.OK:
            return r
    return r
