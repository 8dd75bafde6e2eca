"""BSPTREE::placement_insert: pushing spheres out of solid matter."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from oracle.bsp_leaf import BSPLeaf
from oracle.bsp_node import BSPNode
from oracle.bsp_tree import BSPTree
from oracle.enums import InsertType, TransitionState
from oracle.frame import Frame
from oracle.plane import Plane
from oracle.polygon import Polygon
from oracle.position import Position
from oracle.sphere import Sphere
from oracle.transition import Transition
from oracle.vector import Vector3
from oracle.world import World

if TYPE_CHECKING:
    from oracle.ref import Ref

TRIES = 20


def everything() -> Sphere:
    """Return a bounding sphere that prunes nothing."""
    return Sphere(Vector3(), 1000.0)


def floor() -> Polygon:
    """Return a large square at z = 0."""
    corners = ((-10.0, -10.0), (10.0, -10.0), (10.0, 10.0), (-10.0, 10.0))
    return Polygon(Vector3(x, y, 0.0) for x, y in corners)


def one_leaf(*polygons: Polygon, solid: int = 0) -> BSPTree:
    """Return a tree of a single leaf."""
    return BSPTree(BSPLeaf(0, solid, everything(), polygons))


def placing(
    *centers: tuple[float, float, float], space: Position | None = None, scale: float = 1.0
) -> Transition:
    """Return an initial placement at the world's origin of spheres of radius 1/2."""
    transition = Transition(World(), trace=[])
    path = transition.sphere_path
    path.init_sphere(len(centers), [Sphere(Vector3(*c), 0.5) for c in centers], 1.0)
    path.init_path(None, None, Position())
    path.insert_type = InsertType.INITIAL_PLACEMENT
    path.set_check_pos(Position(), None)
    path.cache_localspace_sphere(space or Position(), scale)
    return transition


def origin(transition: Transition) -> tuple[float, float, float]:
    """Return the check position's origin."""
    o = transition.sphere_path.check_pos.frame.origin
    return o.x, o.y, o.z


def test_a_free_sphere_stays() -> None:
    """Nothing near: OK, not ADJUSTED, for one sphere and for two."""
    for centers in (((0.0, 0.0, 2.0),), ((0.0, 0.0, 2.0), (0.0, 0.0, 3.0))):
        transition = placing(*centers)
        assert one_leaf(floor()).placement_insert(transition) is TransitionState.OK
        assert origin(transition) == (0.0, 0.0, 0.0)
        assert transition.trace == ["I", "1"]


def test_a_sphere_is_pushed_to_its_side_of_the_plane() -> None:
    """In front to the front, behind to the back; both spheres move along."""
    for z, moved in ((0.25, 0.25), (-0.25, -0.25)):
        transition = placing((0.0, 0.0, z))
        assert one_leaf(floor()).placement_insert(transition) is TransitionState.ADJUSTED
        assert origin(transition) == (0.0, 0.0, moved)
        assert transition.sphere_path.global_sphere[0].center.z == z + moved
        assert transition.trace == ["I", "3"]


def test_the_second_sphere_moves_both() -> None:
    """The head in a ceiling pushes the feet down by the same amount."""
    transition = placing((0.0, 0.0, -2.0), (0.0, 0.0, -0.25))
    assert one_leaf(floor()).placement_insert(transition) is TransitionState.ADJUSTED
    assert origin(transition) == (0.0, 0.0, -0.25)


def test_a_straddled_node_hides_the_polygon() -> None:
    """The near child's polygon makes the node say 0: one sphere counts as placed, in the floor."""
    node = BSPNode(
        Plane(Vector3(0.0, 0.0, 1.0), 0.0),
        everything(),
        BSPLeaf(0, 0, everything(), [floor()]),
        BSPLeaf(1, 0, everything(), [floor()]),
    )
    transition = placing((0.0, 0.0, 0.25))
    assert BSPTree(node).placement_insert(transition) is TransitionState.OK


def test_the_offset_is_rotated_but_not_scaled() -> None:
    """In a part at scale 2, upside down, half of the needed push goes the right way."""
    upside_down = Position(0, Frame.unpack(Vector3(), 0.0, 1.0, 0.0, 0.0))
    transition = placing((0.0, 0.0, -0.125), space=upside_down, scale=2.0)
    assert one_leaf(floor()).placement_insert(transition) is TransitionState.ADJUSTED
    # local centre 0.0625, local radius 0.25: pushed by 0.1875 along local z, world -z.
    assert origin(transition) == (0.0, 0.0, -0.1875)


class Scripted(BSPLeaf):
    """A leaf whose answers are written down: return value, center_solid, polygon."""

    def __init__(self, *answers: tuple[int, int, Polygon | None]) -> None:
        super().__init__(0, 0, everything(), ())
        self.answers = list(answers)
        self.asked: list[tuple[float, float, int, bool]] = []

    def sphere_intersects_solid_poly(
        self,
        check_pos: Sphere,
        radius: float,
        center_solid: Ref[int],
        hit_poly: Ref[Polygon | None],
        center_check: int,
    ) -> int:
        """Note height, radius and what was left behind; give the next answer."""
        self.asked.append((check_pos.center.z, radius, center_solid.value, hit_poly.value is not None))
        answer, center_solid.value, polygon = self.answers.pop(0)
        if polygon is not None:
            hit_poly.value = polygon
        return answer


def test_solid_without_a_polygon_doubles_the_reach() -> None:
    """Twenty times, then it is given up; the sphere never moved."""
    root = Scripted(*[(1, 1, None)] * TRIES)
    transition = placing((0.0, 0.0, 2.0))
    assert BSPTree(root).placement_insert(transition) is TransitionState.COLLIDED
    assert [radius for _, radius, _, _ in root.asked] == [0.5 * 2.0**i for i in range(TRIES)]
    assert origin(transition) == (0.0, 0.0, 0.0)


def test_a_push_uses_the_doubled_radius_and_then_forgets_it() -> None:
    """Pushed to radius 1, asked again with radius 1/2 and without a leftover polygon."""
    root = Scripted((1, 1, None), (1, 1, floor()), (0, 0, None))
    transition = placing((0.0, 0.0, -0.25))
    assert BSPTree(root).placement_insert(transition) is TransitionState.ADJUSTED
    # A solid centre behind the plane flips twice: to +1, from -0.25.
    assert root.asked == [(-0.25, 0.5, 0, False), (-0.25, 1.0, 0, False), (1.0, 0.5, 0, False)]
    assert origin(transition) == (0.0, 0.0, 1.25)


def test_the_second_sphere_inherits_flag_and_polygon() -> None:
    """What sphere 0 left behind, though it counted as free, is what sphere 1 is pushed from."""
    root = Scripted((0, 1, floor()), (1, 1, None), (0, 0, None), (0, 0, None))
    transition = placing((0.0, 0.0, 3.0), (0.0, 0.0, -0.25))
    assert BSPTree(root).placement_insert(transition) is TransitionState.ADJUSTED
    assert root.asked[1] == (-0.25, 0.5, 1, True)
    # The second sphere's centre is solid and behind: pushed to +1/2; the first moves along.
    assert root.asked[2] == (3.75, 0.5, 0, False)
    assert root.asked[3] == (0.5, 0.5, 0, False)
    assert origin(transition) == (0.0, 0.0, 0.75)


@pytest.mark.parametrize(("hits_interior", "pushed"), [(1, 0.5), (0, -0.5)])
def test_in_a_building_one_is_pushed_to_the_front(hits_interior: int, pushed: float) -> None:
    """Once an interior cell is reached solid is not checked, and even from behind it is the front."""
    transition = placing((0.0, 0.0, -0.25))
    path = transition.sphere_path
    path.bldg_check, path.hits_interior_cell = 1, hits_interior
    root = Scripted((1, 0, floor()), (0, 0, None))
    assert BSPTree(root).placement_insert(transition) is TransitionState.ADJUSTED
    assert path.global_sphere[0].center.z == pushed
