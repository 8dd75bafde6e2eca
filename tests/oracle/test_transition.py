"""CTransition: a fresh transition, its seeds, and which search it runs."""

from __future__ import annotations

from oracle_worlds import CELL, FLOOR, at, tree, vec, world_of, xyz
from oracle_worlds import transition as make

from oracle.enums import InsertType
from oracle.physics_object import PhysicsObj
from oracle.physics_part import GfxObj, PartArray, PhysicsPart
from oracle.physics_state import HAS_PHYSICS_BSP_PS
from oracle.plane import Plane
from oracle.ref import Ref
from oracle.transition import Transition
from oracle.world import World

PLANE = Plane(vec(0.0, 0.0, 1.0), -94.0)


def test_a_fresh_transition_holds_zeros() -> None:
    """What retail leaves stale starts at zero: an unset last known plane has no normal."""
    made = Transition(World())
    assert xyz(made.collision_info.last_known_contact_plane.N) == (0.0, 0.0, 0.0)
    assert (made.sphere_path.walk_interp, made.sphere_path.walkable_allowance) == (0.0, 0.0)
    assert (made.sphere_path.placement_allows_sliding, made.trace) == (1, None)


def test_the_contact_seed_sets_both_planes() -> None:
    """init_contact_plane writes contact and last known plane, each with its cell id."""
    made = Transition(World())
    made.init_contact_plane(CELL, PLANE, 1)
    ci = made.collision_info
    assert (ci.contact_plane_valid, ci.contact_plane.d, ci.contact_plane_cell_id) == (1, -94.0, CELL)
    assert (ci.last_known_contact_plane_valid, ci.last_known_contact_plane.d) == (1, -94.0)
    assert (ci.last_known_contact_plane_cell_id, ci.last_known_contact_plane_is_water) == (CELL, 1)


def test_the_last_known_seed_writes_the_other_planes_cell_id() -> None:
    """init_last_known_contact_plane stores its cell id in contact_plane_cell_id, as retail does."""
    made = Transition(World())
    made.init_last_known_contact_plane(CELL, PLANE, 0)
    ci = made.collision_info
    assert (ci.last_known_contact_plane_valid, ci.contact_plane_valid) == (1, 0)
    assert (ci.last_known_contact_plane.d, ci.contact_plane.d) == (-94.0, 0.0)
    assert (ci.contact_plane_cell_id, ci.last_known_contact_plane_cell_id) == (CELL, 0)


def test_the_sliding_seed_drops_z() -> None:
    """init_sliding_normal is set_sliding_normal."""
    made = Transition(World())
    made.init_sliding_normal(vec(0.0, -0.6, 0.8))
    assert xyz(made.collision_info.sliding_normal) == (0.0, -1.0, 0.0)


def test_the_cell_array_is_built_from_the_check_position() -> None:
    """build_cell_array finds the containing cell and notes that an interior cell was reached."""
    world = world_of(FLOOR)
    made = make(world, at(0.0, 0.0, 1.0), at(0.0, 0.0, 1.0))
    found: Ref[object] = Ref(None)
    made.build_cell_array(found)
    assert found.value is world.cells[CELL]
    assert [entry.cell_id for entry in made.cell_array.cells] == [CELL]
    assert (made.sphere_path.cell_array_valid, made.sphere_path.hits_interior_cell) == (1, 1)


def test_a_placement_does_not_move() -> None:
    """find_valid_position places where there is no beginning; on a floor it comes to rest on it."""
    made = make(world_of(FLOOR), None, at(0.0, 0.0, 0.6))
    assert made.find_valid_position() == 1
    assert made.sphere_path.insert_type == InsertType.TRANSITION
    assert made.collision_info.contact_plane_valid == 1


def test_a_transition_moves() -> None:
    """find_valid_position walks from the beginning to the end where nothing is in the way."""
    made = make(world_of(), at(0.0, 0.0, 1.0), at(1.0, 0.0, 1.0))
    assert made.find_valid_position() == 1
    assert xyz(made.sphere_path.curr_pos.frame.origin) == (1.0, 0.0, 1.0)


def test_check_collisions_asks_one_object_at_the_current_position() -> None:
    """An overlap with the object counts; it is asked as a placement."""
    pose = at(0.0, 0.0, 0.0)
    parts = PartArray([PhysicsPart(GfxObj(tree(FLOOR)), pose, vec(1.0, 1.0, 1.0))], None, vec(1.0, 1.0, 1.0))
    floor = PhysicsObj(1, HAS_PHYSICS_BSP_PS, pose, scale=1.0, part_array=parts)
    assert make(world_of(), at(0.0, 0.0, 0.4), at(9.0, 9.0, 9.0)).check_collisions(floor) == 1
    assert make(world_of(), at(20.0, 0.0, 0.4), at(9.0, 9.0, 9.0)).check_collisions(floor) == 0
