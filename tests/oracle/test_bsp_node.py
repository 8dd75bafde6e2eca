"""BSPNODE and BSPLEAF: pruning, order of the children, and the quirks of what they report."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from oracle.bbox import BBox
from oracle.bsp_leaf import BSPLeaf
from oracle.bsp_node import BSPNode
from oracle.bsp_tree import BSPTree
from oracle.constants import CELL_SLACK, EPS
from oracle.enums import BoundingType
from oracle.errors import MissingChildError
from oracle.plane import Plane
from oracle.polygon import Polygon
from oracle.ref import Ref
from oracle.sphere import Sphere
from oracle.sphere_path import SpherePath
from oracle.vector import Vector3

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

    Step = Callable[[float, int], float]

DOWN = Vector3(0.0, 0.0, -1.0)
UP = Vector3(0.0, 0.0, 1.0)


def ball(x: float, y: float, z: float, radius: float) -> Sphere:
    """Return a sphere."""
    return Sphere(Vector3(x, y, z), radius)


def everything() -> Sphere:
    """Return a bounding sphere that prunes nothing."""
    return ball(0.0, 0.0, 0.0, 1000.0)


def floor(height: float = 0.0, poly_id: int = 0, *, face_down: bool = False) -> Polygon:
    """Return the square [-10, 10] x [-10, 10] at a height."""
    corners = [
        Vector3(-10.0, -10.0, height),
        Vector3(10.0, -10.0, height),
        Vector3(10.0, 10.0, height),
        Vector3(-10.0, 10.0, height),
    ]
    return Polygon(reversed(corners) if face_down else corners, poly_id)


def leaf(*polygons: Polygon, solid: int = 0, sphere: Sphere | None = None) -> BSPLeaf:
    """Return a leaf that is bounded by everything, unless told otherwise."""
    return BSPLeaf(0, solid, sphere or everything(), polygons)


def split(positive: BSPNode, negative: BSPNode, *, sphere: Sphere | None = None) -> BSPNode:
    """Return a node that splits at z = 0."""
    return BSPNode(Plane(Vector3(0.0, 0.0, 1.0), 0.0), sphere or everything(), positive, negative)


class Visited(BSPLeaf):
    """A leaf that notes that it was asked, and with what centre flag."""

    __slots__ = ("log", "name")

    def __init__(self, name: str, log: list[str]) -> None:
        super().__init__(0, 0, everything(), ())
        self.name = name
        self.log = log

    def sphere_intersects_poly(self, *_: object) -> int:
        """Note and find nothing."""
        self.log.append(self.name)
        return 0

    def sphere_intersects_solid(self, _check_pos: Sphere, center_check: int) -> int:
        """Note with the flag and find nothing."""
        self.log.append(f"{self.name}{center_check}")
        return 0

    def sphere_intersects_solid_poly(self, *arguments: object) -> int:
        """Note with the flag and find nothing."""
        self.log.append(f"{self.name}{arguments[-1]}")
        return 0

    def find_walkable(self, *_: object) -> None:
        """Note and move nothing."""
        self.log.append(self.name)

    def hits_walkable(self, *_: object) -> int:
        """Note and find nothing."""
        self.log.append(self.name)
        return 0


def visits(ask: Callable[[BSPNode], object], *, sphere: Sphere | None = None) -> list[str]:
    """Return the leaves, ``+`` and ``-``, that a query on a split at z = 0 reaches."""
    log: list[str] = []
    ask(split(Visited("+", log), Visited("-", log), sphere=sphere))
    return log


def every_query(sphere: Sphere) -> Iterable[Callable[[BSPNode], object]]:
    """Yield each of the sphere queries as a function of a node."""
    yield lambda node: node.sphere_intersects_poly(sphere, DOWN, Ref(None), Ref(None))
    yield lambda node: node.sphere_intersects_solid(sphere, 1)
    yield lambda node: node.sphere_intersects_solid_poly(sphere, sphere.radius, Ref(0), Ref(None), 1)
    yield lambda node: node.find_walkable(SpherePath(), sphere, Ref(None), DOWN, UP, Ref(0))
    yield lambda node: node.hits_walkable(SpherePath(), sphere, UP)


class TestPruning:
    """Bounding spheres and the three-way split at a plane."""

    def test_a_reach_away_only_one_side_is_visited(self, next32: Step) -> None:
        """At a distance of exactly radius - EPS one child is enough, nearer both are asked."""
        radius = 2.0 * EPS
        for z, reached in (
            (EPS, ["+"]),
            (next32(EPS, -1), ["+", "-"]),
            (-EPS, ["-"]),
            (-next32(EPS, -1), ["+", "-"]),
        ):
            for ask in every_query(ball(0.0, 0.0, z, radius)):
                assert sorted(name[0] for name in visits(ask)) == reached

    def test_a_missed_bounding_sphere_ends_the_search(self, next32: Step) -> None:
        """The node's sphere is tested with the loose comparison of CSphere::intersects."""
        touching, beyond = 2.0000498294830322, next32(2.0000498294830322, 1)
        unit = ball(0.0, 0.0, 0.0, 1.0)
        for ask in every_query(ball(touching, 0.0, 0.0, 1.0)):
            assert len(visits(ask, sphere=unit)) == 2
        for ask in every_query(ball(beyond, 0.0, 0.0, 1.0)):
            assert visits(ask, sphere=unit) == []

    def test_solid_poly_reaches_with_its_own_radius(self) -> None:
        """The separate radius decides the split, the sphere's own the bounding test."""
        sphere = ball(0.0, 0.0, 1.0, 0.5)
        narrow = visits(lambda node: node.sphere_intersects_solid_poly(sphere, 0.5, Ref(0), Ref(None), 1))
        wide = visits(lambda node: node.sphere_intersects_solid_poly(sphere, 2.0, Ref(0), Ref(None), 1))
        assert (narrow, wide) == (["+1"], ["+1", "-0"])

    def test_a_node_without_a_child_is_refused(self) -> None:
        """Retail would dereference null; the error names the node."""
        node = BSPNode(Plane(Vector3(0.0, 0.0, 1.0), 0.0), everything(), leaf(), None)
        with pytest.raises(MissingChildError, match="without both children: BSPNode") as caught:
            node.sphere_intersects_solid(ball(0.0, 0.0, 0.0, 1.0), 1)
        assert caught.value.node is node


class TestOrder:
    """Which child goes first, and which one inherits the centre flag."""

    @pytest.mark.parametrize(
        ("z", "flags"), [(0.25, ["+1", "-0"]), (0.0, ["+1", "-0"]), (-0.25, ["+0", "-1"])]
    )
    def test_solid_asks_the_front_first(self, z: float, flags: list[str]) -> None:
        """The flag follows the side of the centre; exactly on the plane that is the front."""
        sphere = ball(0.0, 0.0, z, 1.0)
        assert visits(lambda node: node.sphere_intersects_solid(sphere, 1)) == flags

    @pytest.mark.parametrize(
        ("z", "flags"), [(0.25, ["+1", "-0"]), (0.0, ["+1", "-0"]), (-0.25, ["-1", "+0"])]
    )
    def test_solid_poly_asks_the_nearer_side_first(self, z: float, flags: list[str]) -> None:
        """Exactly on the plane the front is nearer."""
        sphere = ball(0.0, 0.0, z, 1.0)
        log = visits(lambda node: node.sphere_intersects_solid_poly(sphere, 1.0, Ref(0), Ref(None), 1))
        assert log == flags

    @pytest.mark.parametrize(("z", "solid"), [(1e-30, 0), (0.0, 0), (-1e-30, 1)])
    def test_a_point_on_the_plane_goes_to_the_front(self, z: float, solid: int) -> None:
        """Only strictly behind is behind."""
        node = split(leaf(), leaf(floor()))
        assert node.point_intersects_solid(Vector3(0.0, 0.0, z)) == solid


class TestSphereIntersectsPoly:
    """The first polygon that faces the movement, and the last one that overlaps."""

    def test_the_last_overlapping_polygon_is_left_behind(self) -> None:
        """Nothing faces the movement, so the answer is 0, yet a polygon is reported."""
        first, second = floor(0.0, 1, face_down=True), floor(0.125, 2, face_down=True)
        found: Ref[Polygon | None] = Ref(None)
        node = split(leaf(first), leaf(second))
        assert node.sphere_intersects_poly(ball(0.0, 0.0, 0.0, 0.5), DOWN, found, Ref(None)) == 0
        assert found.value is second

    def test_a_hit_in_front_ends_the_search(self) -> None:
        """Behind the plane nothing is asked any more."""
        front, behind = floor(0.125, 1), floor(0.0, 2)
        found: Ref[Polygon | None] = Ref(None)
        node = split(leaf(front), leaf(behind))
        assert node.sphere_intersects_poly(ball(0.0, 0.0, 0.0, 0.5), DOWN, found, Ref(None)) == 1
        assert found.value is front

    def test_the_first_facing_polygon_of_a_leaf_wins(self) -> None:
        """One that faces away is passed over, a later one is not looked at."""
        away, facing, later = floor(0.0, 1, face_down=True), floor(0.0, 2), floor(0.0, 3)
        found: Ref[Polygon | None] = Ref(None)
        sphere = ball(0.0, 0.0, 0.25, 0.5)
        assert leaf(away, facing, later).sphere_intersects_poly(sphere, DOWN, found, Ref(None)) == 1
        assert found.value is facing

    def test_what_was_there_stays_if_nothing_overlaps(self) -> None:
        """The search never clears its output."""
        old = floor()
        found: Ref[Polygon | None] = Ref(old)
        far = ball(0.0, 0.0, 50.0, 0.5)
        assert split(leaf(floor()), leaf()).sphere_intersects_poly(far, DOWN, found, Ref(None)) == 0
        assert found.value is old

    def test_a_leaf_s_own_sphere_prunes(self) -> None:
        """A leaf whose bounding sphere is missed is not searched."""
        pruned = leaf(floor(), sphere=ball(50.0, 0.0, 0.0, 1.0))
        assert pruned.sphere_intersects_poly(ball(0.0, 0.0, 0.25, 0.5), DOWN, Ref(None), Ref(None)) == 0


class TestSolid:
    """Solid leaves and the centre flag."""

    def test_a_solid_leaf_counts_by_its_flag_before_its_sphere(self) -> None:
        """With the centre in it no polygon need be near."""
        solid = leaf(floor(), solid=1, sphere=ball(0.0, 0.0, 0.0, 0.0))
        deep = ball(0.0, 0.0, -50.0, 0.5)
        assert solid.sphere_intersects_solid(deep, 1) == 1
        assert solid.sphere_intersects_solid(deep, 0) == 0

    def test_an_empty_leaf_is_never_solid(self) -> None:
        """Whatever its flag says."""
        assert leaf(solid=1).sphere_intersects_solid(ball(0.0, 0.0, 0.0, 0.5), 1) == 0
        assert leaf(solid=1).point_intersects_solid(Vector3()) == 0
        assert leaf(floor(), solid=0).point_intersects_solid(Vector3()) == 1

    def test_polygons_count_from_either_side(self) -> None:
        """Overlap alone makes a leaf solid for the sphere."""
        for face_down in (False, True):
            walls = leaf(floor(face_down=face_down))
            assert walls.sphere_intersects_solid(ball(0.0, 0.0, 0.25, 0.5), 0) == 1
        assert leaf(floor()).sphere_intersects_solid(ball(0.0, 0.0, 0.75, 0.5), 0) == 0

    def test_a_hit_in_front_spares_the_back(self) -> None:
        """Both orders of the flag end at the first solid child."""
        for z in (0.25, -0.25):
            log: list[str] = []
            node = split(leaf(floor()), Visited("-", log))
            assert node.sphere_intersects_solid(ball(0.0, 0.0, z, 0.5), 1) == 1
            assert log == []


class TestSolidPoly:
    """The polygon to be pushed out of, and an answer that hides it."""

    def test_a_straddled_node_answers_center_solid(self) -> None:
        """The near child finds a polygon, yet the node says 0 because the centre is not in solid."""
        found: Ref[Polygon | None] = Ref(None)
        wanted = floor()
        node = split(leaf(wanted), leaf(floor(0.0, 2)))
        assert node.sphere_intersects_solid_poly(ball(0.0, 0.0, 0.25, 0.5), 0.5, Ref(0), found, 1) == 0
        assert found.value is wanted

    def test_one_side_answers_one(self) -> None:
        """Without straddling the leaf's own answer comes through."""
        found: Ref[Polygon | None] = Ref(None)
        node = split(leaf(floor(2.0)), leaf())
        assert node.sphere_intersects_solid_poly(ball(0.0, 0.0, 1.75, 0.5), 0.5, Ref(0), found, 1) == 1
        assert found.value is not None

    def test_a_leftover_polygon_spares_the_far_child(self) -> None:
        """Something left in hit_poly by an earlier call counts as found in the near child."""
        log: list[str] = []
        node = split(Visited("+", log), Visited("-", log))
        leftover: Ref[Polygon | None] = Ref(floor())
        assert node.sphere_intersects_solid_poly(ball(0.0, 0.0, 0.25, 0.5), 0.5, Ref(1), leftover, 1) == 1
        assert log == ["+1"]

    def test_an_empty_far_leaf_hides_a_solid_centre(self) -> None:
        """The near leaf sets center_solid, the empty far leaf answers 0 all the same."""
        center_solid = Ref(0)
        near = leaf(floor(-50.0), solid=1)
        node = split(leaf(), near)
        sphere = ball(0.0, 0.0, -0.25, 0.5)
        assert node.sphere_intersects_solid_poly(sphere, 0.5, center_solid, Ref(None), 1) == 0
        assert center_solid.value == 1

    def test_a_pruned_solid_leaf_still_answers_center_solid(self) -> None:
        """Unlike a node, a leaf whose sphere is missed answers what it has set."""
        solid = leaf(floor(), solid=1, sphere=ball(50.0, 0.0, 0.0, 1.0))
        found: Ref[Polygon | None] = Ref(None)
        assert solid.sphere_intersects_solid_poly(ball(0.0, 0.0, 0.25, 0.5), 0.5, Ref(0), found, 1) == 1
        assert found.value is None
        bounded = split(solid, leaf(), sphere=ball(50.0, 0.0, 0.0, 1.0))
        assert bounded.sphere_intersects_solid_poly(ball(0.0, 0.0, 2.0, 0.5), 0.5, Ref(1), found, 1) == 0


class TestWalkable:
    """Resting on polygons, one after the other."""

    def test_every_walkable_polygon_adjusts_and_the_last_wins(self) -> None:
        """Two floors lift the sphere in turn; walk_interp is the product of both."""
        low, high = floor(0.0, 1), floor(0.25, 2)
        path, found, changed = SpherePath(), Ref[Polygon | None](None), Ref(0)
        path.walk_interp = 1.0
        sphere = ball(0.0, 0.0, 0.375, 0.5)
        movement = Vector3(0.0, 0.0, -1.0)
        leaf(low, high).find_walkable(path, sphere, found, movement, UP, changed)
        assert (changed.value, found.value) == (1, high)
        assert sphere.center.z == 0.75
        assert path.walk_interp == 0.875 * 0.75

    def test_a_later_polygon_sees_the_moved_sphere(self) -> None:
        """Lifted by the higher floor first, the sphere no longer reaches the lower one."""
        low, high = floor(0.0, 1), floor(0.25, 2)
        path, found = SpherePath(), Ref[Polygon | None](None)
        path.walk_interp = 1.0
        sphere = ball(0.0, 0.0, 0.375, 0.5)
        leaf(high, low).find_walkable(path, sphere, found, Vector3(0.0, 0.0, -1.0), UP, Ref(0))
        assert found.value is high
        assert path.walk_interp == 0.625

    def test_both_children_are_searched(self) -> None:
        """A success in front does not spare the back."""
        log: list[str] = []
        path = SpherePath()
        path.walk_interp = 1.0
        node = split(leaf(floor()), Visited("-", log))
        node.find_walkable(path, ball(0.0, 0.0, 0.25, 0.5), Ref(None), DOWN, UP, Ref(0))
        assert log == ["-"]

    def test_standing_needs_half_the_radius(self) -> None:
        """Beyond the edge by more than half the radius the floor is hit but not stood on."""
        path = SpherePath()
        on_edge, off_edge = ball(10.125, 0.0, 0.25, 0.5), ball(10.375, 0.0, 0.25, 0.5)
        for node in (leaf(floor()), split(leaf(floor()), leaf()), split(leaf(), leaf(floor()))):
            assert node.hits_walkable(path, on_edge, UP) == 1
            assert node.hits_walkable(path, off_edge, UP) == 0
        assert floor().walkable_hits_sphere(path, off_edge, UP) == 1

    def test_an_empty_leaf_holds_nothing(self) -> None:
        """No polygons, nothing found, nothing changed."""
        changed = Ref(0)
        sphere = ball(0.0, 0.0, 0.25, 0.5)
        leaf().find_walkable(SpherePath(), sphere, Ref(None), DOWN, UP, changed)
        assert changed.value == 0
        assert leaf().hits_walkable(SpherePath(), sphere, UP) == 0


def cell(*planes: tuple[float, float, float, float]) -> BSPTree:
    """Return a cell tree: containment planes chained through the positive child."""
    chain: BSPNode | None = None
    for x, y, z, d in reversed(planes):
        chain = BSPNode(Plane(Vector3(x, y, z), d), everything(), chain, None)
    assert chain is not None
    return BSPTree(chain)


class TestCellFunctions:
    """Containment: a chain of positive children."""

    def test_a_point_is_inside_down_to_minus_eps(self, next32: Step) -> None:
        """Exactly EPS behind a plane still is inside, the next float is not."""
        tree = cell((0.0, 0.0, 1.0, 0.0), (1.0, 0.0, 0.0, 0.0))
        assert tree.point_inside_cell_bsp(Vector3(0.0, 0.0, -EPS)) == 1
        assert tree.point_inside_cell_bsp(Vector3(5.0, 0.0, next32(-EPS, -1))) == 0
        assert tree.point_inside_cell_bsp(Vector3(next32(-EPS, -1), 0.0, 5.0)) == 0

    @pytest.mark.parametrize(
        ("z", "answer"),
        [
            (5.0, BoundingType.ENTIRELY_INSIDE),
            (0.0, BoundingType.PARTIALLY_INSIDE),
            (-5.0, BoundingType.OUTSIDE),
        ],
    )
    def test_a_sphere_is_inside_outside_or_between(self, z: float, answer: BoundingType) -> None:
        """One plane, three answers."""
        assert cell((0.0, 0.0, 1.0, 0.0)).sphere_intersects_cell_bsp(ball(0.0, 0.0, z, 1.0)) is answer

    def test_straddling_one_plane_the_rest_decides_whether_at_all(self) -> None:
        """Behind the second plane the sphere is outside, whatever the first said."""
        tree = cell((0.0, 0.0, 1.0, 0.0), (1.0, 0.0, 0.0, 0.0))
        assert tree.sphere_intersects_cell_bsp(ball(-5.0, 0.0, 0.0, 1.0)) is BoundingType.OUTSIDE
        assert tree.sphere_intersects_cell_bsp(ball(5.0, 0.0, 0.0, 1.0)) is BoundingType.PARTIALLY_INSIDE

    def test_the_first_plane_is_compared_unrounded_later_ones_rounded(self) -> None:
        """For radius 1/2 the float32 of the enlarged radius is smaller than the register."""
        enlarged = 0.5099999904632568
        assert enlarged < 0.5 + CELL_SLACK
        sphere = ball(0.0, 0.0, enlarged, 0.5)
        floor_plane = (0.0, 0.0, 1.0, 0.0)
        far_wall = (1.0, 0.0, 0.0, 100.0)
        assert cell(floor_plane).sphere_intersects_cell_bsp(sphere) is BoundingType.PARTIALLY_INSIDE
        assert cell(far_wall, floor_plane).sphere_intersects_cell_bsp(sphere) is BoundingType.ENTIRELY_INSIDE
        straddled = (1.0, 0.0, 0.0, 0.0)
        both = cell(straddled, floor_plane)
        assert both.sphere_intersects_cell_bsp(sphere) is BoundingType.PARTIALLY_INSIDE

    def test_outside_is_inclusive(self) -> None:
        """Behind a second plane by exactly the rounded radius is outside, by the first not yet."""
        enlarged = 0.5099999904632568
        sphere = ball(0.0, 0.0, -enlarged, 0.5)
        floor_plane = (0.0, 0.0, 1.0, 0.0)
        far_wall = (1.0, 0.0, 0.0, 100.0)
        assert cell(floor_plane).sphere_intersects_cell_bsp(sphere) is BoundingType.PARTIALLY_INSIDE
        assert cell(far_wall, floor_plane).sphere_intersects_cell_bsp(sphere) is BoundingType.OUTSIDE

    def test_a_leaf_in_a_cell_tree_is_read_as_a_zero_plane(self) -> None:
        """A chain that ends in a leaf says partly inside instead of entirely."""
        tree = cell((0.0, 0.0, 1.0, 0.0))
        tree.root_node.pos_node = leaf()
        inside = ball(0.0, 0.0, 5.0, 1.0)
        assert tree.sphere_intersects_cell_bsp(inside) is BoundingType.PARTIALLY_INSIDE
        assert tree.point_inside_cell_bsp(Vector3(0.0, 0.0, 5.0)) == 1

    def test_a_box_is_outside_if_all_corners_are(self, next32: Step) -> None:
        """One corner at -EPS is enough to reach the cell."""
        tree = cell((1.0, 0.0, 0.0, 100.0), (0.0, 0.0, 1.0, 0.0))
        low = Vector3(-1.0, -1.0, -2.0)
        assert tree.box_intersects_cell_bsp(BBox(low, Vector3(1.0, 1.0, -EPS))) == 1
        assert tree.box_intersects_cell_bsp(BBox(low, Vector3(1.0, 1.0, next32(-EPS, -1)))) == 0
        assert tree.box_intersects_cell_bsp(BBox(Vector3(-1.0, -1.0, -EPS), Vector3(1.0, 1.0, 1.0))) == 1

    def test_every_corner_of_a_box_can_reach_the_cell(self) -> None:
        """For each diagonal direction the plane leaves just one corner in front."""
        box = BBox(Vector3(-1.0, -1.0, -1.0), Vector3(1.0, 1.0, 1.0))
        for x in (-1.0, 1.0):
            for y in (-1.0, 1.0):
                for z in (-1.0, 1.0):
                    assert cell((x, y, z, -2.0)).box_intersects_cell_bsp(box) == 1
                    assert cell((x, y, z, -4.0)).box_intersects_cell_bsp(box) == 0


def test_trees_and_nodes_show_their_plane() -> None:
    """A node in an error message can be recognised."""
    assert repr(cell((0.0, 0.0, 1.0, 2.0))) == (
        "BSPTree(BSPNode(Plane(Vector3(0.0, 0.0, 1.0), 2.0), Sphere(Vector3(0.0, 0.0, 0.0), 1000.0)))"
    )
