"""COLLISIONINFO: planes, normals and objects that a transition has touched."""

from __future__ import annotations

from typing import TYPE_CHECKING

from oracle.enums import TransitionState
from oracle.plane import Plane
from oracle.vector import Vector3

if TYPE_CHECKING:
    from oracle.physics_object import PhysicsObj


class CollisionInfo:
    """What the mover stands on and has run into; fields are those of 04 2.4, with retail's names.

    Planes are in the block coordinates of the cell whose id stands beside them. Fields that retail
    leaves stale start at zero. The three seeds of CTransition (`init_contact_plane` and so on) are
    here too: they touch nothing else.
    """

    __slots__ = (
        "collide_object",
        "collided_with_environment",
        "collision_normal",
        "collision_normal_valid",
        "contact_plane",
        "contact_plane_cell_id",
        "contact_plane_is_water",
        "contact_plane_valid",
        "frames_stationary_fall",
        "last_collided_object",
        "last_known_contact_plane",
        "last_known_contact_plane_cell_id",
        "last_known_contact_plane_is_water",
        "last_known_contact_plane_valid",
        "sliding_normal",
        "sliding_normal_valid",
    )

    def __init__(self) -> None:
        self.last_known_contact_plane = Plane(Vector3(), 0.0)
        self.last_known_contact_plane_is_water = 0
        self.contact_plane = Plane(Vector3(), 0.0)
        self.last_known_contact_plane_cell_id = 0
        self.contact_plane_is_water = 0
        self.sliding_normal = Vector3()
        self.collision_normal = Vector3()
        self.collide_object: list[PhysicsObj] = []
        self.init()

    def init(self) -> None:
        """Make every plane and normal invalid; their values, water flags and one cell id stay.

        retail: COLLISIONINFO::init 0x00509D60, 04 5.
        """
        self.last_known_contact_plane_valid = 0
        self.contact_plane_valid = 0
        self.sliding_normal_valid = 0
        self.collision_normal_valid = 0
        self.collide_object.clear()
        self.last_collided_object: PhysicsObj | None = None
        self.collided_with_environment = 0
        self.contact_plane_cell_id = 0
        self.frames_stationary_fall = 0

    def set_contact_plane(self, plane: Plane, is_water: int) -> None:
        """Take a contact plane. Its cell id is not set: every caller stores it right after.

        retail: COLLISIONINFO::set_contact_plane 0x00509D80, 04 5.
        """
        self.contact_plane_valid = 1
        self.contact_plane.assign(plane)
        self.contact_plane_is_water = is_water

    def set_collision_normal(self, n: Vector3) -> None:
        """Take a collision normal, normalised; a tiny one becomes zero and is valid nevertheless.

        retail: COLLISIONINFO::set_collision_normal 0x0050A000, 04 5.
        """
        self.collision_normal_valid = 1
        self.collision_normal.assign(n)
        if self.collision_normal.normalize_check_small():
            self.collision_normal.assign(Vector3())

    def set_sliding_normal(self, n: Vector3) -> None:
        """Take a sliding normal: z dropped, then normalised; a tiny one becomes zero, still valid.

        retail: COLLISIONINFO::set_sliding_normal 0x0050A060, 04 5.
        """
        self.sliding_normal_valid = 1
        self.sliding_normal.assign(Vector3(n.x, n.y, 0.0))
        if self.sliding_normal.normalize_check_small():
            self.sliding_normal.assign(Vector3())

    def add_object(self, touched: PhysicsObj, ts: TransitionState) -> None:
        """Record a touched object once; what was recorded before is not recorded as collided either.

        retail: COLLISIONINFO::add_object 0x006B4E20, 04 5.
        """
        if any(known is touched for known in self.collide_object):
            return
        self.collide_object.append(touched)
        if ts != TransitionState.OK:
            self.last_collided_object = touched

    def forget_contact(self) -> None:
        """Make the contact plane invalid and not water; the plane and its cell id stay (05, introduction)."""
        self.contact_plane_valid = 0
        self.contact_plane_is_water = 0
