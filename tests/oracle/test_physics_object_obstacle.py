"""CPhysicsObj as an obstacle: who is exempt, which shapes count, what is recorded."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest
from oracle_worlds import FLOOR, at, mover, trace_of, transition, tree, vec, world_of

from oracle.cyl_sphere import CylSphere
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
from oracle.sphere import Sphere
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


def test_an_ethereal_mover_is_held_by_statics_only() -> None:
    """08 3.3: the same for an ethereal mover, of which a static takes no notice."""
    for state, traced in ((0, ""), (STATIC_PS, "D1")):
        made = overlapping(moving=ETHEREAL_PS)
        made.sphere_path.insert_type, made.sphere_path.step_down = InsertType.TRANSITION, 1
        obstacle(state).find_obj_collisions(made)
        assert trace_of(made) == traced


@pytest.mark.parametrize(
    ("state", "weenie", "target", "tested"),
    [
        (0, None, 0, True),
        (0, Weenie(is_creature=True), 0, True),
        (0, Weenie(is_creature=True), 5, False),
        (0, Weenie(is_creature=True), 1, True),
        (0, Weenie(), 5, True),
        (ETHEREAL_PS, Weenie(), 0, False),
        (ETHEREAL_PS, Weenie(), 1, True),
        (ETHEREAL_PS, None, 5, True),
    ],
)
def test_missiles_pass_through_what_they_are_not_meant_for(
    state: int, weenie: Weenie | None, target: int, tested: bool
) -> None:
    """08 2, 3.7: other creatures if it has a target, and ethereal game objects; the object's id is 1."""
    made = overlapping(moving=MISSILE_PS)
    made.object_info.targetID = target
    obstacle(state, weenie).find_obj_collisions(made)
    assert bool(trace_of(made)) is tested


def test_the_camera_passes_through_creatures() -> None:
    """08 3.2."""
    made = overlapping(IS_VIEWER_OI)
    assert obstacle(0, Weenie(is_creature=True)).find_obj_collisions(made) == OK
    assert trace_of(made) == ""
    assert obstacle(0, Weenie()).find_obj_collisions(overlapping(IS_VIEWER_OI)) == COLLIDED
    assert obstacle(0, None).find_obj_collisions(overlapping(IS_VIEWER_OI)) == COLLIDED
    assert obstacle(0, Weenie(is_creature=True)).find_obj_collisions(overlapping()) == COLLIDED


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
        (IS_PLAYER | IS_PKLITE, Weenie(is_player=True, is_pk=True), True),
        (IS_PLAYER | IS_PK, Weenie(is_player=True), True),
        (IS_PLAYER, Weenie(is_player=True, is_pk=True, is_pklite=True), True),
        (IS_PLAYER, None, False),
    ],
)
def test_players_pass_through_players(state: int, weenie: Weenie | None, passes: bool) -> None:
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


def test_an_object_without_shape_is_free() -> None:
    """08 3.8: neither BSP, cylinders nor spheres; and no part array at all."""
    one = vec(1.0, 1.0, 1.0)
    for parts in (None, PartArray([], None, one), PartArray([], Setup(), one)):
        other = PhysicsObj(1, 0, at(0.0, 0.0, 0.0), scale=1.0, part_array=parts)
        assert other.find_obj_collisions(overlapping()) == OK


CYLINDER = CylSphere(vec(0.0, 0.0, -1.0), 2.0, 1.5)
"""Overlaps the mover of `overlapping`, as the two others do."""
SPHERE = Sphere(vec(0.0, 0.0, 0.0), 1.5)
FAR_CYLINDER = CylSphere(vec(50.0, 0.0, 0.0), 2.0, 1.5)
FAR_SPHERE = Sphere(vec(50.0, 0.0, 0.0), 1.5)


def shaped(
    setup: Setup | None, *, state: int = 0, weenie: Weenie | None = None, scale: float = 1.0
) -> PhysicsObj:
    """Return an object at the origin that has a setup and, if its state says so, a part that is far away."""
    one = vec(1.0, 1.0, 1.0)
    parts = [PhysicsPart(GfxObj(tree(FLOOR)), at(0.0, 0.0, 500.0), one)]
    return PhysicsObj(
        1, state, at(0.0, 0.0, 0.0), scale=scale, part_array=PartArray(parts, setup, one), weenie=weenie
    )


@pytest.mark.parametrize(
    ("setup", "traced"),
    [
        (Setup(cylsphere=(FAR_CYLINDER, CYLINDER, FAR_CYLINDER), sphere=(SPHERE,)), "C1C2"),
        (Setup(cylsphere=(FAR_CYLINDER, FAR_CYLINDER), sphere=(SPHERE,)), "C1C1"),
        (Setup(sphere=(FAR_SPHERE, SPHERE, FAR_SPHERE)), "S1S2"),
        (Setup(sphere=(FAR_SPHERE,)), "S1"),
        (Setup(), ""),
        (None, ""),
    ],
)
def test_one_family_of_shapes_counts(setup: Setup | None, traced: str) -> None:
    """08 3.8: cylinders, or else spheres, in order until one is hit; what finds nothing is the end of it."""
    made = overlapping()
    assert shaped(setup).find_obj_collisions(made) == (COLLIDED if traced.endswith("2") else OK)
    assert trace_of(made) == traced


@pytest.mark.parametrize("setup", [Setup(cylsphere=(CYLINDER,), sphere=(SPHERE,)), None])
def test_a_bsp_excludes_the_other_shapes(setup: Setup | None) -> None:
    """08 3.8: the part is out of reach, and the cylinder that is not stays untested."""
    made = overlapping()
    assert shaped(setup, state=HAS_PHYSICS_BSP_PS).find_obj_collisions(made) == OK
    assert trace_of(made) == ""


@pytest.mark.parametrize("setup", [Setup(cylsphere=(CYLINDER,)), Setup(sphere=(SPHERE,))])
@pytest.mark.parametrize("state", [0, HAS_PHYSICS_BSP_PS])
def test_what_is_exempt_or_ignored_has_no_shape(setup: Setup, state: int) -> None:
    """08 3.8: a player for a player, and every missile; nothing is tested, nothing recorded."""
    for made, other in (
        (overlapping(IS_PLAYER), shaped(setup, state=state, weenie=PLAYER)),
        (overlapping(), shaped(setup, state=state | MISSILE_PS)),
    ):
        assert other.find_obj_collisions(made) == OK
        assert (trace_of(made), made.collision_info.collide_object) == ("", [])


def test_shapes_have_the_object_s_scale_and_parts_their_own() -> None:
    """08 1: a sphere of 0.5 metres at (0, 0, 1) reaches the mover at 0.25 if it is doubled, up to z = 2.

    Its radius is 1 then, and the mover's 0.48: from 2 down to 0.52 it is out of reach, at half it is not.
    """
    setup = Setup(sphere=(Sphere(vec(0.0, 0.0, 1.0), 0.5),))
    assert shaped(setup, scale=1.0).find_obj_collisions(overlapping()) == COLLIDED
    assert shaped(setup, scale=2.0).find_obj_collisions(overlapping()) == OK


def stepping_down(weenie: Weenie | None, setup: Setup) -> TransitionState:
    """Step down onto an object from 1.75 metres above its middle."""
    made = transition(world_of(), None, at(0.0, 0.0, 1.75))
    sp = made.sphere_path
    sp.insert_type = InsertType.TRANSITION
    sp.step_down, sp.step_down_amt, sp.walk_interp = 1, 1.5, 1.0
    return shaped(setup, weenie=weenie).find_obj_collisions(made)


def test_one_stands_on_creatures_that_are_cylinders() -> None:
    """08 3.6, 3.8: only spheres are told what the object is (07 8.5, 10.2)."""
    creature, low = Weenie(is_creature=True), CylSphere(vec(0.0, 0.0, -0.5), 2.0, 1.5)
    assert stepping_down(None, Setup(sphere=(SPHERE,))) == TransitionState.ADJUSTED
    assert stepping_down(creature, Setup(sphere=(SPHERE,))) == OK
    assert stepping_down(creature, Setup(cylsphere=(low,))) == TransitionState.ADJUSTED


def test_what_is_hit_while_stepping_down_is_not_recorded() -> None:
    """08 3.9: the answer stays, and neither object nor environment is noted."""
    for state in (0, STATIC_PS):
        made = overlapping()
        sp = made.sphere_path
        sp.insert_type, sp.step_down, sp.step_down_amt = InsertType.TRANSITION, 1, 0.0
        other = shaped(Setup(sphere=(SPHERE,)), state=state)
        assert other.find_obj_collisions(made) == COLLIDED
        ci = made.collision_info
        assert (ci.collide_object, ci.last_collided_object, ci.collided_with_environment) == ([], None, 0)


def test_a_second_touch_is_recorded_once() -> None:
    """08 3.9, add_object: touched as an ethereal one first, it never becomes the last collided object."""
    made, other = overlapping(), shaped(Setup(sphere=(SPHERE,)), state=ETHEREAL_PS)
    assert other.find_obj_collisions(made) == OK
    other.state = 0
    assert other.find_obj_collisions(made) == COLLIDED
    ci = made.collision_info
    assert (ci.collide_object, ci.last_collided_object) == ([other], None)


def test_side_effects_of_a_touch_that_does_not_block_stay() -> None:
    """08 3.9: an ignored creature that the mover begins to land upon leaves `collide` set."""
    made = transition(world_of(), at(0.0, 0.0, 3.0), at(0.0, 0.0, 1.0), state=IGNORE_CREATURES)
    made.sphere_path.set_check_pos(at(0.0, 0.0, 1.0), made.sphere_path.curr_cell)
    other = shaped(Setup(sphere=(SPHERE,)), weenie=Weenie(is_creature=True))
    assert other.find_obj_collisions(made) == OK
    assert made.sphere_path.collide == 1
    assert made.collision_info.collide_object == [other]


@pytest.mark.parametrize("setup", [Setup(cylsphere=(CYLINDER,)), Setup(sphere=(SPHERE,))])
def test_an_ethereal_obstacle_of_any_shape_is_only_looked_at(setup: Setup) -> None:
    """08 4: in the air it would begin a landing; ethereal it is an overlap, which is recorded."""
    made = transition(world_of(), at(0.0, 0.0, 3.0), at(0.0, 0.0, 1.0))
    made.sphere_path.set_check_pos(at(0.0, 0.0, 1.0), made.sphere_path.curr_cell)
    other = shaped(setup, state=ETHEREAL_PS)
    assert other.find_obj_collisions(made) == OK
    assert (made.sphere_path.collide, made.sphere_path.obstruction_ethereal) == (0, 0)
    assert made.collision_info.collide_object == [other]
