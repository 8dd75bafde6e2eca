"""OBJECTINFO: the mover's properties, who ignores whom, and the terrain test."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import pytest
from oracle_worlds import CELL, RADIUS, ScriptedCell, at, mover, transition, vec, world_of, xyz
from shipped_vectors import VECTORS, records

from conformance.candidates.oracle_ops.blocks import take_mover, take_seed
from conformance.candidates.oracle_ops.state_block import state_block
from conformance.candidates.oracle_ops.values import plane, position, sphere
from conformance.compare import differences
from oracle.arithmetic import f32
from oracle.constants import DEFAULT_STEP, FLOOR_Z
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
from oracle.object_info import ObjectInfo
from oracle.physics_object import PhysicsObj
from oracle.physics_part import PartArray, Setup
from oracle.physics_state import ETHEREAL_PS, MISSILE_PS
from oracle.plane import Plane
from oracle.sphere import Sphere
from oracle.transition import Transition
from oracle.weenie import Weenie

if TYPE_CHECKING:
    from conformance.vector_io import VectorRecord

UP = (0.0, 0.0, 1.0)
STEEP = (0.8, 0.0, 0.6)


def test_step_heights_are_scaled_by_the_part_array() -> None:
    """OI-2: setup height times the z of the part array's scale, stored as float32."""
    parts = PartArray([], Setup(step_up_height=f32(0.6), step_down_height=f32(1.5)), vec(9.0, 9.0, 1.1))
    oi = ObjectInfo()
    oi.init(PhysicsObj(1, 0, at(0.0, 0.0, 0.0), scale=2.0, part_array=parts), 0)
    assert oi.step_up_height == f32(f32(0.6) * f32(1.1))
    assert oi.step_down_height == f32(f32(1.5) * f32(1.1))
    assert oi.scale == 2.0


@pytest.mark.parametrize(
    ("parts", "height"), [(PartArray([], None, vec(1, 1, 1)), DEFAULT_STEP), (None, 0.0)]
)
def test_without_setup_or_parts_there_are_defaults(parts: PartArray | None, height: float) -> None:
    """OI-2: a part array without setup steps 0.01, an object without parts not at all."""
    oi = ObjectInfo()
    oi.init(PhysicsObj(1, 0, at(0.0, 0.0, 0.0), scale=1.0, part_array=parts), 0)
    assert (oi.step_up_height, oi.step_down_height) == (height, height)


def test_a_missile_is_not_pulled_down() -> None:
    """OI-3: step_down is 0 for missiles; ethereal keeps the bit's value 4."""
    oi = ObjectInfo()
    oi.init(mover(MISSILE_PS | ETHEREAL_PS), 0)
    assert (oi.step_down, oi.ethereal) == (0, 4)


def test_the_game_object_adds_bits_and_no_target() -> None:
    """OI-4: four questions add four bits; the target id is not written."""
    moving = mover()
    moving.weenie_obj = Weenie(is_player=True, is_pk=True, is_pklite=True, is_impenetrable=True)
    oi = ObjectInfo()
    oi.targetID = 3
    oi.init(moving, CONTACT_OI)
    assert oi.state == CONTACT_OI | IS_IMPENETRABLE | IS_PLAYER | IS_PK | IS_PKLITE
    assert oi.targetID == 3


def test_the_walkable_limit_includes_itself() -> None:
    """is_valid_walkable accepts FLOOR_Z, whatever the state; get_walkable_z is FLOOR_Z always."""
    oi = ObjectInfo()
    assert oi.is_valid_walkable(vec(0.0, 0.0, FLOOR_Z))
    assert not oi.is_valid_walkable(vec(0.0, 0.0, f32(math.nextafter(FLOOR_Z, 0.0) - 1e-7)))
    assert oi.get_walkable_z() == FLOOR_Z


def test_killing_velocity_stops_the_live_object() -> None:
    """It acts at once, and is counted."""
    moving, oi = mover(), ObjectInfo()
    moving.m_velocity.assign(vec(1.0, 2.0, 3.0))
    oi.init(moving, 0)
    oi.kill_velocity()
    assert (xyz(moving.m_velocity), moving.kill_velocity_calls) == ((0.0, 0.0, 0.0), 1)


def test_a_mover_is_required() -> None:
    """Without init_object the questions that need the mover say so."""
    with pytest.raises(ValueError, match="OI-1"):
        ObjectInfo().kill_velocity()


@pytest.mark.parametrize(
    ("mover_state", "target", "other_state", "weenie", "ignored"),
    [
        (0, 0, MISSILE_PS, None, 1),
        (0, 0, ETHEREAL_PS, Weenie(), 0),
        (MISSILE_PS, 7, ETHEREAL_PS, Weenie(), 0),
        (MISSILE_PS, 0, ETHEREAL_PS, Weenie(), 1),
        (MISSILE_PS, 0, ETHEREAL_PS, None, 0),
        (MISSILE_PS, 5, 0, Weenie(is_creature=True), 1),
        (MISSILE_PS, 0, 0, Weenie(is_creature=True), 0),
        (MISSILE_PS, 5, 0, Weenie(), 0),
    ],
)
def test_missiles_ignore_and_are_ignored(
    mover_state: int, target: int, other_state: int, weenie: Weenie | None, ignored: int
) -> None:
    """MI-1…4: every row is one way through the function; the other object has id 7."""
    other, oi = mover(other_state), ObjectInfo()
    other.weenie_obj = weenie
    oi.init(mover(mover_state), 0)
    oi.targetID = target
    assert oi.missile_ignore(other) == ignored


def terrain(
    normal: tuple[float, float, float], gap: float, *, state: int = 0, step_down: float = 0.0, probe: int = 0
) -> tuple[TransitionState, Transition]:
    """Test a sphere whose lowest point is `gap` above a terrain plane through the origin."""
    made = transition(world_of(), at(0.0, 0.0, 2.0), at(0.0, 0.0, 2.0), state=state)
    sp = made.sphere_path
    sp.step_down, sp.step_down_amt, sp.walk_interp = int(step_down > 0.0), step_down, 1.0
    sp.check_walkable = probe
    sphere = Sphere(vec(0.0, 0.0, f32(gap) + RADIUS), RADIUS)
    plane = Plane(vec(*normal), 0.0)
    result = made.object_info.validate_walkable(sphere, plane, 0, 0.0, sp, made.collision_info, CELL)
    return result, made


def test_above_the_terrain_nothing_happens() -> None:
    """VW-12: more than EPS above is free."""
    ts, made = terrain(UP, 0.01)
    assert (ts, made.collision_info.contact_plane_valid) == (TransitionState.OK, 0)


def test_touching_terrain_gives_contact() -> None:
    """VW-13, VW-14: within EPS the plane is taken; a mover without contact also collides."""
    ts, made = terrain(UP, 0.0)
    ci = made.collision_info
    assert (ts, ci.contact_plane_valid, ci.contact_plane_cell_id) == (TransitionState.OK, 1, CELL)
    assert (ci.collision_normal_valid, ci.collided_with_environment) == (1, 1)


def test_penetrated_terrain_lifts_the_sphere() -> None:
    """VW-23: the lift is along z; terrain never becomes the walkable polygon."""
    ts, made = terrain(UP, -0.25, state=CONTACT_OI)
    assert ts == TransitionState.ADJUSTED
    assert made.sphere_path.check_pos.frame.origin.z == 2.25
    assert (made.sphere_path.walkable, made.collision_info.collision_normal_valid) == (None, 0)


def test_steep_terrain_is_ignored_by_a_grounded_mover() -> None:
    """VW-23, VW-25: on a walkable and not stepping down, a steep triangle gives OK and no plane."""
    ts, made = terrain(STEEP, -0.25, state=CONTACT_OI | ON_WALKABLE_OI)
    assert (ts, made.collision_info.contact_plane_valid) == (TransitionState.OK, 0)
    assert made.sphere_path.check_pos.frame.origin.z == 2.0


def test_a_probe_only_asks() -> None:
    """VW-21: check_walkable answers COLLIDED for support and changes nothing."""
    ts, made = terrain(UP, -0.25, probe=1)
    assert (ts, made.collision_info.contact_plane_valid) == (TransitionState.COLLIDED, 0)


def test_stepping_down_shortens_the_step() -> None:
    """VW-23: lifting by half the step leaves half of the interpolation."""
    ts, made = terrain(UP, -0.25, step_down=0.5)
    assert (ts, made.sphere_path.walk_interp) == (TransitionState.ADJUSTED, 0.5)


def test_terrain_too_far_above_a_step_down_collides_but_stays_contact() -> None:
    """VW-23: beyond -0.1 of the step the answer is COLLIDED, and the plane stays set."""
    ts, made = terrain(UP, -0.6, step_down=0.5)
    assert (ts, made.collision_info.contact_plane_valid) == (TransitionState.COLLIDED, 1)
    assert made.sphere_path.check_pos.frame.origin.z == 2.0


def test_the_camera_is_taken_back_along_its_way() -> None:
    """VW-3…5: the viewer is moved back to the time of touching and collides with the environment."""
    made = transition(world_of(), at(0.0, 0.0, 1.48), at(0.0, 0.0, 0.0), state=IS_VIEWER_OI)
    sp = made.sphere_path
    sp.set_check_pos(at(0.0, 0.0, 0.0), sp.curr_cell)
    plane, sphere = Plane(vec(*UP), 0.0), sp.global_sphere[0].copy()
    ts = made.object_info.validate_walkable(sphere, plane, 0, 0.0, sp, made.collision_info, CELL)
    assert ts == TransitionState.ADJUSTED
    assert sp.check_pos.frame.origin.z == RADIUS
    assert made.collision_info.collided_with_environment == 1


def test_a_camera_that_began_indoors_ignores_terrain_behind_it() -> None:
    """VW-4: a time outside (0, 1] counts only if the path began outdoors."""
    made = transition(world_of(), at(0.0, 0.0, -2.0), at(0.0, 0.0, -1.0), state=IS_VIEWER_OI)
    sp = made.sphere_path
    sp.set_check_pos(at(0.0, 0.0, -1.0), sp.curr_cell)
    plane, sphere = Plane(vec(*UP), 0.0), sp.global_sphere[0].copy()
    ts = made.object_info.validate_walkable(sphere, plane, 0, 0.0, sp, made.collision_info, CELL)
    assert (ts, sp.check_pos.frame.origin.z) == (TransitionState.OK, -1.0)


def shipped_walkables() -> list[VectorRecord]:
    """Return the shipped direct calls of validate_walkable."""
    found = [r for r in records(VECTORS / "terrain.jsonl") if r.query.op == "land_validate_walkable"]
    assert len(found) == 43
    return found


@pytest.mark.parametrize("record", shipped_walkables(), ids=lambda record: record.id)
def test_the_terrain_test_agrees_with_the_shipped_vectors(record: VectorRecord) -> None:
    """VW-1…25, bit for bit, for cameras and walkers, land and water."""
    given, cell = record.query.inputs, ScriptedCell([], cell_id=record.query.inputs["cell"])
    made = Transition(world_of(), trace=None)
    begin, end = position(given["from"]), position(given["to"])
    take_mover(made, given["mover"], begin)
    made.init_path(cell, begin, end)
    sp = made.sphere_path
    sp.set_check_pos(end, cell)
    take_seed(made, given.get("seed", {}))
    for name, value in given["path"].items():
        setattr(sp, name, value)
    result = made.object_info.validate_walkable(
        sphere(given["sphere"]),
        plane(given["plane"]),
        given["is_water"],
        given["water_depth"],
        sp,
        made.collision_info,
        given["cell"],
    )
    answer = {"result": result.name, "trace": record.expected["trace"]} | state_block(made)
    assert differences(record.expected, answer, op=record.query.op, zero_signs="equal") == []
