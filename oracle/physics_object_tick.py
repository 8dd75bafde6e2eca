"""CPhysicsObj, the tick: from elapsed time to a wanted position, and what comes of it.

The functions here are methods of `oracle.physics_object.PhysicsObj`.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from oracle.arithmetic import f32
from oracle.constants import ACTIVE_DISTANCE, EPS, HUGE_QUANTUM, MAX_QUANTUM, MIN_QUANTUM
from oracle.errors import NotPortedError
from oracle.frame import Frame
from oracle.physics_state import ALIGNPATH_PS, ETHEREAL_PS, FROZEN_PS, HIDDEN_PS, SLEDDING_PS, STATIC_PS
from oracle.position import Position
from oracle.transient_state import ACTIVE_TS, CHECK_ETHEREAL_TS, ON_WALKABLE_TS
from oracle.vector import Vector3

if TYPE_CHECKING:
    from oracle.physics_object import PhysicsObj


def update_object(self: PhysicsObj) -> None:
    """Simulate the time since the object's last tick, in ticks of at most `MAX_QUANTUM`.

    retail: CPhysicsObj::update_object 0x00515D10, 06 QT-1…9.
    """
    world, clock = self.world, self.world.clock
    # QT-1
    if self.parent is not None or self.cell is None or self.state & FROZEN_PS:
        self.transient_state &= ~ACTIVE_TS
        return
    # QT-2
    player = world.player
    if player is not None:
        self.player_vector.assign(player.m_position.get_offset(self.m_position))
        distance = self.player_vector.magnitude()
        self.player_distance = f32(distance)
        if distance > ACTIVE_DISTANCE and world.maintainer_active:
            self.transient_state &= ~ACTIVE_TS
        else:
            self.activate()
    # QT-3
    q = clock.cur_time - self.update_time
    clock.curr_time = self.update_time
    # QT-4, QT-5
    if q <= EPS or q > HUGE_QUANTUM:
        self.update_time = clock.cur_time
        return
    # QT-7
    split = q > MAX_QUANTUM
    while q > MAX_QUANTUM:
        clock.curr_time += MAX_QUANTUM
        self.update_object_internal(f32(MAX_QUANTUM))
        q = q - MAX_QUANTUM
    # QT-6, QT-8: only a remainder must be long enough
    if not split or q > MIN_QUANTUM:
        clock.curr_time += q
        self.update_object_internal(f32(q))
    # QT-9
    self.update_time = clock.curr_time


def activate(self: PhysicsObj) -> None:
    """Let the object be simulated from now on, unless it is static: set_active(1) (06 QT-2, SV-2)."""
    if self.state & STATIC_PS:
        return
    if not self.transient_state & ACTIVE_TS:
        self.update_time = self.world.clock.cur_time
    self.transient_state |= ACTIVE_TS


def update_object_internal(self: PhysicsObj, quantum: float) -> None:
    """Perform one tick of `quantum` seconds (float32).

    The managers of UO-12, and the particles and scripts of UO-13, do not move anything by themselves.

    retail: CPhysicsObj::UpdateObjectInternal 0x005156B0, 06 UO-1…11.
    """
    # UO-1
    if not self.transient_state & ACTIVE_TS or self.cell is None:
        return
    # UO-2
    if self.transient_state & CHECK_ETHEREAL_TS:
        _leave_ethereal(self)
    self.jumped_this_frame = 0
    # UO-3
    old = self.m_position
    new_pos = Position(old.objcell_id)
    new, origin = new_pos.frame, old.frame.origin
    self.update_position_internal(quantum, new)
    # UO-4
    if self.part_array is None or self.part_array.get_num_sphere() == 0:
        if self.movement_manager is None and self.transient_state & ON_WALKABLE_TS:
            self.transient_state &= ~ACTIVE_TS
        _only_turn(self, new)
        return
    # UO-5
    if new.origin.equals(origin):
        _only_turn(self, new)
        return
    # UO-6
    if self.state & ALIGNPATH_PS:
        v = Vector3(f32(new.origin.x - origin.x), f32(new.origin.y - origin.y), f32(new.origin.z - origin.z))
        v.normalize()
        new.set_vector_heading(v)
    elif self.state & SLEDDING_PS and not self.m_velocity.is_zero():
        new.set_heading(f32(self.m_velocity.get_heading()))
    # UO-7
    made = self.transition(old, new_pos, 0)
    # UO-8
    if made is None:
        _only_turn(self, new)
        return
    # UO-9
    diff = old.get_offset(made.sphere_path.curr_pos)
    # UO-10
    r = 1.0 / quantum
    rf = f32(r)
    self.cached_velocity.assign(Vector3(f32(r * diff.x), f32(rf * diff.y), f32(rf * diff.z)))
    # UO-11
    self.set_position_internal(made)


def _leave_ethereal(self: PhysicsObj) -> None:
    """Become solid again, if nothing is in the way (06 UO-2)."""
    if self.parent is None:
        raise NotPortedError("CObjCell::check_collisions, which no document specifies (06 UO-2)")
    self.state &= ~ETHEREAL_PS
    self.transient_state &= ~CHECK_ETHEREAL_TS


def _only_turn(self: PhysicsObj, frame: Frame) -> None:
    """Take the rotation of `frame`, stay where the object is, and touch nothing else (06 UO-4, 5, 8)."""
    frame.origin.assign(self.m_position.frame.origin)
    self.set_frame(frame)
    self.cached_velocity.assign(Vector3())


def update_position_internal(self: PhysicsObj, quantum: float, frame: Frame) -> None:
    """Write where the object wants to be after `quantum` seconds into `frame`.

    The object's hooks, UPI-6, are not movement.

    retail: CPhysicsObj::UpdatePositionInternal 0x00512C30, 06 UPI-1…5.
    """
    # UPI-1
    offset = Frame()
    # UPI-2
    hidden = self.state & HIDDEN_PS
    if not hidden:
        if self.part_array is not None:
            self.part_array.update(quantum, offset)
        scale = self.m_scale if self.transient_state & ON_WALKABLE_TS else 0.0
        o = offset.origin
        o.assign(Vector3(f32(o.x * scale), f32(o.y * scale), f32(o.z * scale)))
    # UPI-3
    if self.position_manager is not None:
        self.position_manager.adjust_offset(offset, quantum)
    # UPI-4
    frame.combine(self.m_position.frame, offset)
    # UPI-5
    if not hidden:
        self.update_physics_internal(quantum, frame)
