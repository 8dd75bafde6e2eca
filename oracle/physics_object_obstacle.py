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
from oracle.errors import NotPortedError
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

    Raises
    ------
    NotPortedError
        The object would be tested as cylinders or spheres (07).

    Notes
    -----
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
    # 08 3.5, 08 3.7, 08 3.8
    r = TransitionState.OK
    if not _is_exempt(self, oi) and not oi.missile_ignore(self):
        r = _find_shape_collisions(self, transition)
    # 08 3.9
    if r != TransitionState.OK and not path.step_down:
        if self.state & STATIC_PS:
            if not oi.state & CONTACT_OI:
                coll.collided_with_environment = 1
        elif eth or (_counts_as_creature(self) and oi.state & IGNORE_CREATURES):
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


def _counts_as_creature(self: PhysicsObj) -> bool:
    """Tell whether the object is a creature or a missile (08 3.6)."""
    weenie = self.weenie_obj
    return bool(self.state & MISSILE_PS) or (weenie is not None and weenie.is_creature)


def _find_shape_collisions(self: PhysicsObj, transition: Transition) -> TransitionState:
    """Test the one family of shapes that counts: BSP parts, else cylinders, else spheres (08 3.8)."""
    parts = self.part_array
    if parts is None:
        return TransitionState.OK
    if self.state & HAS_PHYSICS_BSP_PS:
        return parts.find_obj_collisions(transition)
    if parts.setup is not None and parts.setup.num_cylsphere > 0:
        raise NotPortedError("objects shaped as cylinders (07 10)")
    if parts.setup is not None and parts.setup.num_sphere > 0:
        raise NotPortedError("objects shaped as spheres (07 9)")
    return TransitionState.OK
