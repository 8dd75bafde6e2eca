"""CPhysicsPart and CGfxObj: which parts are tested, and the sphere before the tree."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import pytest
from oracle_worlds import FLOOR, at, polygon, trace_of, transition, tree, vec, world_of

from oracle.arithmetic import f32
from oracle.bsp_leaf import BSPLeaf
from oracle.bsp_tree import BSPTree
from oracle.enums import InsertType, TransitionState
from oracle.physics_part import GfxObj, PartArray, PhysicsPart
from oracle.sphere import Sphere

if TYPE_CHECKING:
    from oracle.transition import Transition

OK, COLLIDED = TransitionState.OK, TransitionState.COLLIDED


def placed(z: float, *, spheres: tuple[tuple[float, float], ...] = ((0.0, 0.5),)) -> Transition:
    """Return a placement with its spheres at a height."""
    made = transition(world_of(), None, at(0.0, 0.0, z), spheres=spheres)
    made.sphere_path.insert_type = InsertType.PLACEMENT
    return made


def floor_part(*, radius: float = 100.0, scale: float = 1.0, other_scale: float = 1.0) -> PhysicsPart:
    """Return a floor at the origin whose root sphere has a radius."""
    leaf = BSPLeaf(0, 0, Sphere(vec(0.0, 0.0, 0.0), radius), [polygon(FLOOR)])
    return PhysicsPart(GfxObj(BSPTree(leaf)), at(0.0, 0.0, 0.0), vec(other_scale, other_scale, scale))


def test_a_part_without_geometry_is_free() -> None:
    """08 6.1, and the same of the graphic object."""
    made = placed(0.25)
    for part in (
        PhysicsPart(None, at(0.0, 0.0, 0.0), vec(1.0, 1.0, 1.0)),
        PhysicsPart(GfxObj(None), at(0.0, 0.0, 0.0), vec(1.0, 1.0, 1.0)),
    ):
        assert part.find_obj_collisions(made) == OK
    assert trace_of(made) == ""


def test_only_the_z_of_the_scale_counts() -> None:
    """08 6.2: with scale z = 2 the sphere at 0.75 is at 0.375, half as large: no overlap."""
    made = placed(0.75)
    assert floor_part(scale=2.0, other_scale=7.0).find_obj_collisions(made) == OK
    assert made.sphere_path.localspace_sphere[0].center.z == 0.375
    assert made.sphere_path.localspace_sphere[0].radius == 0.25


@pytest.mark.parametrize(("squared_gap", "entered"), [(0.00019, True), (0.00021, False)])
def test_the_root_sphere_is_entered_below_eps(squared_gap: float, entered: bool) -> None:
    """08 7.2: squared distance minus squared radii below EPS; a gap is measured in squares."""
    made = placed(f32(math.sqrt(1.5 * 1.5 + squared_gap)))
    floor_part(radius=1.0).find_obj_collisions(made)
    assert (trace_of(made) != "") is entered


def test_one_sphere_in_reach_sends_the_whole_path() -> None:
    """08 7.2, 7.4: the upper sphere's nearness enters the tree once."""
    made = placed(-9.0, spheres=((0.0, 0.5), (9.25, 0.5)))
    assert floor_part(radius=1.0).find_obj_collisions(made) == COLLIDED
    assert trace_of(made) == "P2"


def test_no_spheres_no_collision() -> None:
    """08 7.1."""
    made = placed(0.25)
    made.sphere_path.num_sphere = 0
    assert floor_part().find_obj_collisions(made) == OK


def test_an_initial_placement_inserts() -> None:
    """08 7.4: insert type 2 calls the tree's placement insert."""
    made = placed(5.0)
    made.sphere_path.insert_type = InsertType.INITIAL_PLACEMENT
    assert floor_part().find_obj_collisions(made) == OK
    assert trace_of(made) == "I1"


def test_parts_are_tested_until_one_blocks() -> None:
    """08 5.1, 5.2: missing parts are skipped, later ones are not reached."""
    one = vec(1.0, 1.0, 1.0)
    far = PhysicsPart(GfxObj(tree(FLOOR)), at(0.0, 0.0, 50.0), one)
    made = placed(0.25)
    assert PartArray([None, far, floor_part(), far], None, one).find_obj_collisions(made) == COLLIDED
    assert trace_of(made) == "P1P2"
    assert PartArray([], None, one).find_obj_collisions(made) == OK
