"""CPhysicsObj, the write-back: what is copied, and which bits follow."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import pytest
from oracle_bodies import STANDING, Listener, walker
from oracle_worlds import CELL, OTHER_CELL, ScriptedCell, at, vec, xyz

from oracle.constants import FLOOR_Z, GRAVITY
from oracle.frame import Frame
from oracle.plane import Plane
from oracle.transient_state import ACTIVE_TS, CONTACT_TS, ON_WALKABLE_TS, SLIDING_TS, WATER_CONTACT_TS
from oracle.transition import Transition
from oracle.world import World

if TYPE_CHECKING:
    from collections.abc import Callable

    from oracle.obj_cell import ObjCell
    from oracle.physics_object import PhysicsObj
    from oracle.position import Position

    Step = Callable[[float, int], float]


def finished(cell: ObjCell | None, position: Position) -> Transition:
    """Return a transition that ended somewhere, in the air."""
    made = Transition(World())
    made.sphere_path.curr_cell = cell
    made.sphere_path.curr_pos.assign(position)
    return made


def landed(body: PhysicsObj, z: float, *, valid: int = 1, water: int = 0) -> Transition:
    """Return one that ended on a plane whose normal has this height."""
    made = finished(body.cell, at(1.0, 2.0, 3.0))
    ci = made.collision_info
    ci.contact_plane, ci.contact_plane_valid = Plane(vec(0.5, 0.25, z), 7.0), valid
    ci.contact_plane_cell_id, ci.contact_plane_is_water = OTHER_CELL, water
    return made


def test_position_and_plane_are_copied() -> None:
    """WB-3…5: and nothing is shared with the transition."""
    body = walker()
    made = landed(body, 1.0)
    assert body.set_position_internal(made) == 1
    made.sphere_path.curr_pos.frame.origin.x = made.collision_info.contact_plane.N.x = 9.0
    assert (xyz(body.m_position.frame.origin), body.m_position.objcell_id) == ((1.0, 2.0, 3.0), CELL)
    assert (xyz(body.contact_plane.N), body.contact_plane.d) == ((0.5, 0.25, 1.0), 7.0)
    assert body.contact_plane_cell_id == OTHER_CELL


@pytest.mark.parametrize(("steps", "on_walkable"), [(0, ON_WALKABLE_TS), (-1, 0)])
def test_the_steepest_walkable_plane(steps: int, on_walkable: int, next32: Step) -> None:
    """WB-9: FLOOR_Z itself can be stood on; only the height of the normal counts."""
    body, listener = walker(transient=ACTIVE_TS), Listener()
    body.movement_manager = listener
    body.set_position_internal(landed(body, next32(FLOOR_Z, steps)))
    assert body.transient_state == ACTIVE_TS | CONTACT_TS | on_walkable
    assert listener.heard == (["hit"] if on_walkable else [])
    assert body.m_acceleration.z == (0.0 if on_walkable else GRAVITY)


def test_an_invalid_plane_is_copied_too() -> None:
    """WB-5, WB-6, WB-9: the bit says that it means nothing, and the object falls."""
    body, listener = walker(), Listener()
    body.movement_manager = listener
    body.set_position_internal(landed(body, 1.0, valid=0))
    assert (body.transient_state, body.contact_plane.d) == (ACTIVE_TS, 7.0)
    assert (listener.heard, body.m_acceleration.z) == (["leave"], GRAVITY)


@pytest.mark.parametrize(("water", "bit"), [(0, 0), (1, WATER_CONTACT_TS), (8, WATER_CONTACT_TS)])
def test_water(water: int, bit: int) -> None:
    """WB-8: whatever is not zero."""
    body = walker(transient=STANDING | WATER_CONTACT_TS)
    body.set_position_internal(landed(body, 1.0, water=water))
    assert body.transient_state == STANDING | bit


@pytest.mark.parametrize("valid", [0, 1])
def test_the_sliding_normal(valid: int) -> None:
    """WB-10: copied valid or not."""
    body = walker(transient=STANDING | SLIDING_TS)
    made = landed(body, 1.0)
    made.collision_info.sliding_normal = vec(0.0, 1.0, 0.0)
    made.collision_info.sliding_normal_valid = valid
    body.set_position_internal(made)
    assert xyz(body.sliding_normal) == (0.0, 1.0, 0.0)
    assert body.transient_state == STANDING | (SLIDING_TS if valid else 0)


def test_the_collisions_are_handled_with_the_old_bits() -> None:
    """WB-1, WB-11: an object that lands bounces, one that stays on the ground does not."""
    for transient, x in ((ACTIVE_TS, -4.0), (STANDING, 4.0)):
        body = walker(transient=transient, velocity=(4.0, 0.0, 0.0))
        body.elasticity = 1.0
        made = landed(body, 1.0)
        made.collision_info.collision_normal_valid = 1
        made.collision_info.collision_normal = vec(-1.0, 0.0, 0.0)
        body.set_position_internal(made)
        assert body.m_velocity.x == x


def test_another_cell() -> None:
    """WB-3: the id is that cell's; in the same cell it is the position's."""
    body, cell = walker(), ScriptedCell((), cell_id=OTHER_CELL)
    body.set_position_internal(finished(cell, at(1.0, 0.0, 0.0)))
    assert body.cell is cell
    assert body.m_position.objcell_id == OTHER_CELL
    body.set_position_internal(finished(cell, at(1.0, 0.0, 0.0)))
    assert body.m_position.objcell_id == CELL


def test_no_cell() -> None:
    """WB-2: the position is stored and the object rests; contact and velocity stay."""
    body = walker(velocity=(4.0, 0.0, 0.0))
    made = landed(body, 0.0, valid=0)
    made.sphere_path.curr_cell = None
    made.collision_info.frames_stationary_fall = 2
    assert body.set_position_internal(made) == 1
    assert (body.cell, body.transient_state) == (None, STANDING & ~ACTIVE_TS)
    assert (xyz(body.m_position.frame.origin), body.m_velocity.x) == ((1.0, 2.0, 3.0), 4.0)
    assert body.contact_plane.d == 0.0


@pytest.mark.parametrize(
    ("cell", "x", "stored", "at_x"),
    [
        (0xA9B40001, 193.0, 0xAAB40001, 1.0),
        (0xA9B40001, 25.0, 0xA9B40009, 25.0),
        (0x00010001, -1.0, 0, -1.0),
        (0xA9B40100, 193.0, 0xA9B40100, 193.0),
    ],
)
def test_a_stored_position_lies_in_its_land_cell(cell: int, x: float, stored: int, at_x: float) -> None:
    """WB-2: beyond the land the id is 0; interior positions stay."""
    body, given = walker(), at(x, 0.5, 0.0, cell)
    body.store_position(given)
    assert (body.m_position.objcell_id, body.m_position.frame.origin.x) == (stored, at_x)
    assert (given.objcell_id, given.frame.origin.x) == (cell, x)


def test_a_frame_is_copied_as_it_is() -> None:
    """WB-4: also one whose quaternion has another length."""
    body, frame = walker(), Frame()
    frame.qw = 2.0
    body.set_frame(frame)
    assert (body.m_position.frame.qw, body.m_position.frame.m0) == (2.0, 1.0)


@pytest.mark.parametrize(("x", "qw"), [(0.0, 0.0), (math.nan, 1.0)])
def test_a_rotation_that_is_not_a_number(x: float, qw: float) -> None:
    """WB-4: becomes four zeros and keeps its matrix, if the origin is one."""
    body, frame = walker(), Frame()
    frame.qx, frame.origin.x = math.nan, x
    body.set_frame(frame)
    f = body.m_position.frame
    assert (f.qw, math.isnan(f.qx), f.m0) == (qw, math.isnan(x), 1.0)
