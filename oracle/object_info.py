"""OBJECTINFO: what the transition needs to know about the object that moves."""

from __future__ import annotations

from typing import TYPE_CHECKING

from oracle.arithmetic import divide, f32
from oracle.constants import EPS, FLOOR_Z, WALK_INTERP_LOWEST
from oracle.enums import (
    CONTACT_OI,
    IS_IMPENETRABLE,
    IS_PK,
    IS_PKLITE,
    IS_PLAYER,
    IS_VIEWER_OI,
    ON_WALKABLE_OI,
    TransitionState,
)
from oracle.land_defs import FIRST_INTERIOR_CELL
from oracle.physics_state import ETHEREAL_PS, MISSILE_PS
from oracle.vector import Vector3

if TYPE_CHECKING:
    from oracle.collision_info import CollisionInfo
    from oracle.physics_object import PhysicsObj
    from oracle.plane import Plane
    from oracle.sphere import Sphere
    from oracle.sphere_path import SpherePath


class ObjectInfo:
    """The mover of one transition; fields are those of 04 2.2, with retail's names.

    Attributes
    ----------
    object : PhysicsObj or None
        The live moving object.
    state : int
        Bits of 04 1.3; contact and on-walkable are rewritten after every sub-step.
    scale : float
        The object's scale, copied and not used.
    step_up_height, step_down_height : float
        Metres.
    ethereal : int
        0, or 4 for an ethereal mover.
    step_down : int
        1 if the mover may be pulled down to the ground, 0 for a missile.
    targetID : int
        A missile's target; 0 is none.
    """

    __slots__ = (
        "ethereal",
        "object",
        "scale",
        "state",
        "step_down",
        "step_down_height",
        "step_up_height",
        "targetID",
    )

    def __init__(self) -> None:
        self.object: PhysicsObj | None = None
        self.state = 0
        self.scale = 0.0
        self.step_up_height = 0.0
        self.step_down_height = 0.0
        self.ethereal = 0
        self.step_down = 0
        self.targetID = 0

    def init(self, mover: PhysicsObj, state: int) -> None:
        """Take the mover and its state bits. The target id is not written.

        retail: OBJECTINFO::init 0x0050CF30, 04 OI-1…4.
        """
        # OI-1
        self.object = mover
        self.state = state
        self.scale = mover.m_scale
        # OI-2
        self.step_up_height = f32(mover.get_step_up_height())
        self.step_down_height = f32(mover.get_step_down_height())
        # OI-3
        self.ethereal = mover.state & ETHEREAL_PS
        self.step_down = 0 if mover.state & MISSILE_PS else 1
        # OI-4
        weenie = mover.weenie_obj
        if weenie is not None:
            if weenie.is_impenetrable:
                self.state |= IS_IMPENETRABLE
            if weenie.is_player:
                self.state |= IS_PLAYER
            if weenie.is_pk:
                self.state |= IS_PK
            if weenie.is_pklite:
                self.state |= IS_PKLITE

    def get_walkable_z(self) -> float:
        """Return the walkable limit, whatever the mover's state.

        retail: OBJECTINFO::get_walkable_z 0x0050CF20, 04 6.
        """
        return FLOOR_Z

    def is_valid_walkable(self, n: Vector3) -> bool:
        """Tell whether one can stand on a plane with this normal; the limit itself counts.

        retail: OBJECTINFO::is_valid_walkable 0x0050CF10, 04 6.
        """
        return n.z >= FLOOR_Z

    def kill_velocity(self) -> None:
        """Stop the live object, at once.

        retail: OBJECTINFO::kill_velocity 0x0050CFE0, 04 6.
        """
        self.mover().kill_velocity_calls += 1
        self.mover().set_velocity(Vector3(), 0)

    def missile_ignore(self, other: PhysicsObj) -> int:
        """Tell whether the mover passes through `other` because one of them is a missile.

        retail: OBJECTINFO::missile_ignore 0x0050CEB0, 04 MI-1…4.
        """
        # MI-1
        if other.state & MISSILE_PS:
            return 1
        # MI-2
        if not self.mover().state & MISSILE_PS:
            return 0
        # MI-3
        if other.id == self.targetID:
            return 0
        # MI-4
        weenie = other.weenie_obj
        if weenie is None:
            return 0
        if other.state & ETHEREAL_PS:
            return 1
        return 1 if self.targetID != 0 and weenie.is_creature else 0

    def validate_walkable(
        self,
        sphere: Sphere,
        plane: Plane,
        is_water: int,
        water_depth: float,
        path: SpherePath,
        collisions: CollisionInfo,
        land_cell_id: int,
    ) -> TransitionState:
        """Test the lowest point of `sphere` against a terrain plane, both in the land cell's block.

        `water_depth` is in metres. Terrain never becomes the path's walkable polygon.

        retail: OBJECTINFO::validate_walkable 0x0050D010, 04 VW-1…25.
        """
        if self.state & IS_VIEWER_OI:
            return self._validate_viewer(sphere, plane, path, collisions)
        n, c = plane.N, sphere.center
        # VW-10
        distance = (((c.y * n.y + (c.z - sphere.radius) * n.z) + c.x * n.x) + plane.d) + water_depth
        # VW-11
        if distance >= -EPS:
            # VW-12
            if distance > EPS:
                return TransitionState.OK
            # VW-13
            if path.step_down or not self.state & ON_WALKABLE_OI or self.is_valid_walkable(n):
                collisions.set_contact_plane(plane, is_water)
                collisions.contact_plane_cell_id = land_cell_id
            # VW-14
            if not self.state & CONTACT_OI and not path.step_down:
                collisions.set_collision_normal(n)
                collisions.collided_with_environment = 1
            # VW-15
            return TransitionState.OK
        # VW-20, VW-21
        if path.check_walkable:
            return TransitionState.COLLIDED
        # VW-22
        p = f32(divide(distance, n.z))
        ts = TransitionState.OK
        # VW-23
        if path.step_down or not self.state & ON_WALKABLE_OI or self.is_valid_walkable(n):
            collisions.set_contact_plane(plane, is_water)
            collisions.contact_plane_cell_id = land_cell_id
            if path.step_down:
                w = (1.0 - divide(-1.0, path.step_down_amt * path.walk_interp) * p) * path.walk_interp
                if w >= path.walk_interp or w < WALK_INTERP_LOWEST:
                    return TransitionState.COLLIDED
                path.walk_interp = f32(w)
            path.add_offset_to_check_pos(Vector3(0.0, 0.0, f32(-p)))
            ts = TransitionState.ADJUSTED
        # VW-24
        if not self.state & CONTACT_OI and not path.step_down:
            collisions.set_collision_normal(n)
            collisions.collided_with_environment = 1
        # VW-25
        return ts

    def _validate_viewer(
        self, sphere: Sphere, plane: Plane, path: SpherePath, collisions: CollisionInfo
    ) -> TransitionState:
        """Keep the camera above the terrain: the viewer branch of validate_walkable (04 VW-1…5)."""
        n, c = plane.N, sphere.center
        # VW-1
        distance = (((n.x * c.x + n.y * c.y) + c.z * n.z) + plane.d) - sphere.radius
        stored = f32(distance)
        # VW-2
        if distance > -EPS:
            return TransitionState.OK
        # VW-3
        center = path.global_curr_center[0]
        ox = f32(c.x - center.x)
        oy = f32(c.y - center.y)
        oz = c.z - center.z
        t = divide(stored, (oz * n.z + ox * n.x) + oy * n.y)
        # VW-4
        begin = path.begin_pos
        outside_step = t <= 0.0 or t > 1.0
        if outside_step and begin is not None and (begin.objcell_id & 0xFFFF) >= FIRST_INTERIOR_CELL:
            return TransitionState.OK
        # VW-5
        k = -t
        path.add_offset_to_check_pos(Vector3(f32(ox * k), f32(oy * k), f32(oz * k)))
        collisions.set_collision_normal(n)
        collisions.collided_with_environment = 1
        return TransitionState.ADJUSTED

    def mover(self) -> PhysicsObj:
        """Return the moving object, which every query but a bare port call has."""
        if self.object is None:
            message = "the transition has no moving object: call init_object first (04 OI-1)"
            raise ValueError(message)
        return self.object
