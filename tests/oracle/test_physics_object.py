"""CPhysicsObj as an obstacle: who is exempt, what is recorded, what has no port yet."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest
from oracle_worlds import FLOOR, at, mover, trace_of, transition, tree, vec, world_of, xyz

from oracle.enums import (
    CONTACT_OI,
    IGNORE_CREATURES,
    IS_IMPENETRABLE,
    IS_PK,
    IS_PKLITE,
    IS_PLAYER,
    IS_VIEWER_OI,
    InsertType,
    TransitionState,
)
from oracle.errors import NotPortedError
from oracle.physics_object import PhysicsObj
from oracle.physics_part import GfxObj, PartArray, PhysicsPart, Setup
from oracle.physics_state import (
    ETHEREAL_PS,
    GRAVITY_PS,
    HAS_PHYSICS_BSP_PS,
    IGNORE_COLLISIONS_PS,
    MISSILE_PS,
    STATIC_PS,
)
from oracle.weenie import Weenie

if TYPE_CHECKING:
    from oracle.transition import Transition

OK, COLLIDED = TransitionState.OK, TransitionState.COLLIDED
PLAYER = Weenie(is_creature=True, is_player=True)


def obstacle(state: int, weenie: Weenie | None = None) -> PhysicsObj:
    """Return an object shaped as a floor through the origin."""
    pose, one = at(0.0, 0.0, 0.0), vec(1.0, 1.0, 1.0)
    parts = PartArray([None, PhysicsPart(GfxObj(tree(FLOOR)), pose, one)], None, one)
    return PhysicsObj(1, state | HAS_PHYSICS_BSP_PS, pose, scale=1.0, part_array=parts, weenie=weenie)


def overlapping(state: int = 0, *, moving: int = GRAVITY_PS) -> Transition:
    """Return a placement whose sphere overlaps the floor."""
    made = transition(world_of(), None, at(0.0, 0.0, 0.25), state=state, moving=mover(moving))
    made.sphere_path.insert_type = InsertType.PLACEMENT
    return made


def test_a_static_obstacle_blocks_as_environment() -> None:
    """08 3.9: static objects are not recorded; without contact the environment was hit."""
    made = overlapping()
    assert obstacle(STATIC_PS).find_obj_collisions(made) == COLLIDED
    assert (made.collision_info.collided_with_environment, made.collision_info.collide_object) == (1, [])
    grounded = overlapping(CONTACT_OI)
    assert obstacle(STATIC_PS).find_obj_collisions(grounded) == COLLIDED
    assert grounded.collision_info.collided_with_environment == 0


def test_a_dynamic_obstacle_is_recorded() -> None:
    """08 3.9: it blocks and is the last collided object."""
    made, other = overlapping(), obstacle(0)
    assert other.find_obj_collisions(made) == COLLIDED
    assert made.collision_info.last_collided_object is other


def test_an_ethereal_obstacle_is_touched_but_does_not_block() -> None:
    """08 3.4, 3.9: an overlap becomes OK, the collision normal invalid, the flag ends at 0."""
    made, other = overlapping(), obstacle(ETHEREAL_PS)
    made.collision_info.collision_normal_valid = 1
    assert other.find_obj_collisions(made) == OK
    ci = made.collision_info
    assert (ci.collide_object, ci.last_collided_object, ci.collision_normal_valid) == ([other], None, 0)
    assert made.sphere_path.obstruction_ethereal == 0
    assert trace_of(made) == "P2"


def test_an_ethereal_static_obstacle_blocks() -> None:
    """08 3.9: static comes first, so an ethereal static is solid when it is overlapped."""
    assert obstacle(ETHEREAL_PS | STATIC_PS).find_obj_collisions(overlapping()) == COLLIDED


@pytest.mark.parametrize(("state", "traced"), [(0, "P2"), (STATIC_PS, "P2")])
def test_an_ethereal_mover_passes_through_all_but_statics(state: int, traced: str) -> None:
    """08 3.3: the mover's bit counts for objects that are not static."""
    made = overlapping(moving=ETHEREAL_PS)
    assert obstacle(state).find_obj_collisions(made) == (COLLIDED if state else OK)
    assert trace_of(made) == traced


def test_ethereal_and_ignoring_is_skipped_completely() -> None:
    """08 3.1: not even the flag is written."""
    made = overlapping()
    made.sphere_path.obstruction_ethereal = 1
    assert obstacle(ETHEREAL_PS | IGNORE_COLLISIONS_PS).find_obj_collisions(made) == OK
    assert (trace_of(made), made.sphere_path.obstruction_ethereal) == ("", 1)


def test_ethereal_obstacles_hold_no_ground() -> None:
    """08 3.3: while stepping down they are skipped, before the flag is written."""
    made = overlapping()
    made.sphere_path.step_down = made.sphere_path.obstruction_ethereal = 1
    assert obstacle(ETHEREAL_PS).find_obj_collisions(made) == OK
    assert (trace_of(made), made.sphere_path.obstruction_ethereal) == ("", 1)


def test_the_camera_passes_through_creatures() -> None:
    """08 3.2."""
    made = overlapping(IS_VIEWER_OI)
    assert obstacle(0, Weenie(is_creature=True)).find_obj_collisions(made) == OK
    assert trace_of(made) == ""
    assert obstacle(0, Weenie()).find_obj_collisions(overlapping(IS_VIEWER_OI)) == COLLIDED


@pytest.mark.parametrize(
    ("state", "weenie", "passes"),
    [
        (IS_PLAYER, PLAYER, True),
        (0, PLAYER, False),
        (IS_PLAYER, Weenie(is_creature=True), False),
        (IS_PLAYER | IS_IMPENETRABLE, PLAYER, False),
        (IS_PLAYER, Weenie(is_player=True, is_impenetrable=True), False),
        (IS_PLAYER | IS_PK, Weenie(is_player=True, is_pk=True), False),
        (IS_PLAYER | IS_PK, Weenie(is_player=True, is_pklite=True), True),
        (IS_PLAYER | IS_PKLITE, Weenie(is_player=True, is_pklite=True), False),
    ],
)
def test_players_pass_through_players(state: int, weenie: Weenie, passes: bool) -> None:
    """08 3.5: unless both are player killers of the same kind, or one is impenetrable."""
    made = overlapping(state)
    assert (obstacle(0, weenie).find_obj_collisions(made) == OK) is passes
    assert trace_of(made) == ("" if passes else "P2")


def test_missiles_are_never_obstacles() -> None:
    """08 3.7: nothing is tested, nothing recorded."""
    made = overlapping()
    assert obstacle(MISSILE_PS).find_obj_collisions(made) == OK
    assert (trace_of(made), made.collision_info.collide_object) == ("", [])


def test_ignored_creatures_are_touched() -> None:
    """08 3.6, 3.9: IGNORE_CREATURES records creatures and lets the mover pass."""
    made, other = overlapping(IGNORE_CREATURES), obstacle(0, Weenie(is_creature=True))
    assert other.find_obj_collisions(made) == OK
    assert made.collision_info.collide_object == [other]


@pytest.mark.parametrize("setup", [Setup(num_cylsphere=1), Setup(num_sphere=1)])
def test_other_shapes_are_not_ported(setup: Setup) -> None:
    """08 3.8: an object shaped as cylinders or spheres is an error with a name, not a free passage."""
    one = vec(1.0, 1.0, 1.0)
    other = PhysicsObj(1, 0, at(0.0, 0.0, 0.0), scale=1.0, part_array=PartArray([], setup, one))
    with pytest.raises(NotPortedError, match="07"):
        other.find_obj_collisions(overlapping())


def test_an_object_without_shape_is_free() -> None:
    """08 3.8: neither BSP, cylinders nor spheres; and no part array at all."""
    one = vec(1.0, 1.0, 1.0)
    for parts in (None, PartArray([], None, one), PartArray([], Setup(), one)):
        other = PhysicsObj(1, 0, at(0.0, 0.0, 0.0), scale=1.0, part_array=parts)
        assert other.find_obj_collisions(overlapping()) == OK


def test_velocity_is_stored() -> None:
    """set_velocity copies; the caller's vector stays its own."""
    moving, velocity = mover(), vec(1.0, 2.0, 3.0)
    moving.set_velocity(velocity, 0)
    velocity.x = 9.0
    assert xyz(moving.m_velocity) == (1.0, 2.0, 3.0)
