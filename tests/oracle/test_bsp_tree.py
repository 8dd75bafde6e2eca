"""BSPTREE: the six ways to collide, and what each leaves in the transition.

One triangle of floor, in a space of its own; the transitions have no cells, so whatever would nest
another transition is replaced by a note.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from oracle.bsp_leaf import BSPLeaf
from oracle.bsp_node import BSPNode
from oracle.bsp_tree import BSPTree
from oracle.constants import Z_LANDING
from oracle.enums import CONTACT_OI, PATH_CLIPPED_OI, PERFECT_CLIP_OI, InsertType, TransitionState
from oracle.frame import Frame
from oracle.plane import Plane
from oracle.polygon import Polygon
from oracle.position import Position
from oracle.ref import Ref
from oracle.sphere import Sphere
from oracle.transition import Transition
from oracle.vector import Vector3
from oracle.world import World

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    Bits = Callable[[float], int]
    Point = tuple[float, float, float]

CELL = 0xA9B40101
ROTATED_45 = (0.9238795042037964, 0.0, 0.0, 0.3826834261417389)
RADIUS = 0.47999998927116394
"""The usual mover's: 0.48 as float32, metres."""


def everything() -> Sphere:
    """Return a bounding sphere that prunes nothing."""
    return Sphere(Vector3(), 1000.0)


def floor(*, face_down: bool = False) -> Polygon:
    """Return a large triangle at z = 0."""
    corners = [Vector3(-10.0, -10.0, 0.0), Vector3(10.0, -10.0, 0.0), Vector3(0.0, 10.0, 0.0)]
    return Polygon(reversed(corners) if face_down else corners)


def tree_of(*polygons: Polygon, solid: int = 1) -> BSPTree:
    """Return a tree with everything in the leaf behind z = 0, which is solid."""
    up = Plane(Vector3(0.0, 0.0, 1.0), 0.0)
    empty = BSPLeaf(0, 0, everything(), ())
    return BSPTree(BSPNode(up, everything(), empty, BSPLeaf(1, solid, everything(), polygons)))


def at(x: float, y: float, z: float, *rotation: float) -> Position:
    """Return a position in the cell's block."""
    return Position(CELL, Frame.unpack(Vector3(x, y, z), *(rotation or (1.0, 0.0, 0.0, 0.0))))


def moving(
    start: Point,
    end: Point,
    *,
    heights: Sequence[float] = (0.0,),
    space: Position | None = None,
    scale: float = 1.0,
    state: int = 0,
) -> Transition:
    """Return a transition from `start` to `end` (world), with a sphere at each of `heights` above."""
    transition = Transition(World(), trace=[])
    transition.object_info.state = state
    path = transition.sphere_path
    path.init_sphere(len(heights), [Sphere(Vector3(0.0, 0.0, z), RADIUS) for z in heights], 1.0)
    path.init_path(None, at(*start), at(*end))
    path.set_check_pos(at(*end), None)
    path.cache_localspace_sphere(space or at(0.0, 0.0, 0.0), scale)
    path.walk_interp = 1.0
    return transition


def xyz(v: Vector3) -> Point:
    """Return x, y, z."""
    return v.x, v.y, v.z


class TestDispatch:
    """Which way is taken when several are asked for."""

    def test_the_first_that_applies_wins(self) -> None:
        """Each flag is overruled by the ones before it; the trace names the way."""
        transition = moving((0.0, 0.0, 9.0), (0.0, 0.0, 8.0))
        path = transition.sphere_path
        tree = tree_of(floor())
        letters = "A"
        tree.find_collisions(transition, 1.0)
        for letter, owner, name, value in (
            ("M", transition.object_info, "state", PATH_CLIPPED_OI),
            ("K", transition.object_info, "state", PATH_CLIPPED_OI | CONTACT_OI),
            ("L", path, "collide", 1),
            ("D", path, "step_down", 1),
            ("W", path, "check_walkable", 1),
            ("P", path, "obstruction_ethereal", 1),
        ):
            setattr(owner, name, value)
            assert tree.find_collisions(transition, 1.0) is TransitionState.OK
            letters += letter
        path.obstruction_ethereal = 0
        path.insert_type = InsertType.PLACEMENT
        tree.find_collisions(transition, 1.0)
        tree.placement_insert(transition)
        assert transition.trace == [*"1".join(letters + "PI"), "1"]

    def test_without_a_trace_nothing_is_noted(self) -> None:
        """The trace is off by default."""
        transition = moving((0.0, 0.0, 9.0), (0.0, 0.0, 8.0))
        transition.trace = None
        assert tree_of(floor()).find_collisions(transition, 1.0) is TransitionState.OK
        assert transition.trace is None


class TestPlacementTest:
    """Path 1: solid or not."""

    @pytest.mark.parametrize(
        ("z", "heights", "result"),
        [
            (0.25, (0.0,), TransitionState.COLLIDED),
            (0.75, (0.0,), TransitionState.OK),
            (0.75, (0.0, -0.5), TransitionState.COLLIDED),
            (-5.0, (0.0,), TransitionState.COLLIDED),
        ],
    )
    def test_either_sphere_collides(
        self, z: float, heights: tuple[float, ...], result: TransitionState
    ) -> None:
        """Overlapping the floor or having the centre in a solid leaf."""
        transition = moving((0.0, 0.0, z), (0.0, 0.0, z), heights=heights)
        transition.sphere_path.insert_type = InsertType.PLACEMENT
        assert tree_of(floor()).find_collisions(transition, 1.0) is result

    @pytest.mark.parametrize(
        ("bldg_check", "hits_interior", "result"),
        [
            (0, 0, TransitionState.COLLIDED),
            (0, 1, TransitionState.COLLIDED),
            (1, 0, TransitionState.COLLIDED),
            (1, 1, TransitionState.OK),
        ],
    )
    def test_in_a_building_one_may_be_inside(
        self, bldg_check: int, hits_interior: int, result: TransitionState
    ) -> None:
        """A solid leaf does not count by its flag once an interior cell is reached."""
        transition = moving((0.0, 0.0, -5.0), (0.0, 0.0, -5.0))
        path = transition.sphere_path
        path.insert_type = InsertType.PLACEMENT
        path.bldg_check, path.hits_interior_cell = bldg_check, hits_interior
        assert tree_of(floor()).find_collisions(transition, 1.0) is result


def test_check_walkable_collides_with_ground() -> None:
    """Path 2: COLLIDED means that there is something to walk on."""
    for z, result in ((0.25, TransitionState.COLLIDED), (0.75, TransitionState.OK)):
        transition = moving((0.0, 0.0, z), (0.0, 0.0, z))
        transition.sphere_path.check_walkable = 1
        assert tree_of(floor()).find_collisions(transition, 1.0) is result


class TestStepDown:
    """Path 3: resting on the ground below."""

    def test_the_contact_plane_of_a_cell_elsewhere(self, bits: Bits) -> None:
        """In a cell rotated by 45 degrees and lifted to 94 m the plane's constant is -94, not 0."""
        space = at(100.0, 50.0, 94.0, *ROTATED_45)
        touching = (100.0, 50.0, 94.4000015258789)
        transition = moving(touching, touching, space=space)
        path, collisions = transition.sphere_path, transition.collision_info
        path.step_down, path.step_down_amt = 1, 0.5
        ground = floor()
        assert tree_of(ground).find_collisions(transition, 1.0) is TransitionState.ADJUSTED
        assert collisions.contact_plane_valid == 1
        assert [bits(c) for c in xyz(collisions.contact_plane.N)] == [0, 0, 0x3F800000]
        assert bits(collisions.contact_plane.d) == 0xC2BC0000
        assert (collisions.contact_plane_cell_id, collisions.contact_plane_is_water) == (CELL, 0)
        assert path.walkable is ground
        assert path.check_pos.frame.origin.z == pytest.approx(94.48, abs=1e-5)
        assert path.global_sphere[0].center.z == path.check_pos.frame.origin.z
        assert path.walkable_check_pos.center.z == pytest.approx(0.48, abs=1e-6)
        assert path.walk_interp == pytest.approx(1.0 - 0.08 / 0.5, abs=1e-5)

    def test_out_of_reach_nothing_happens(self) -> None:
        """A sphere of radius 0.48 whose centre is at 0.5 does not touch the floor."""
        transition = moving((0.0, 0.0, 0.5), (0.0, 0.0, 0.5))
        path = transition.sphere_path
        path.step_down, path.step_down_amt = 1, 0.5
        assert tree_of(floor()).find_collisions(transition, 1.0) is TransitionState.OK
        assert transition.collision_info.contact_plane_valid == 0
        assert (path.walkable, path.walk_interp) == (None, 1.0)

    def test_the_scale_multiplies_the_finished_constant(self) -> None:
        """At scale 2 the floor of a part at height 10 gets -20, though it lies at 10."""
        space = at(0.0, 0.0, 10.0)
        transition = moving((0.0, 0.0, 10.25), (0.0, 0.0, 10.25), space=space, scale=2.0)
        path = transition.sphere_path
        path.step_down, path.step_down_amt = 1, 0.5
        assert tree_of(floor()).find_collisions(transition, 2.0) is TransitionState.ADJUSTED
        assert transition.collision_info.contact_plane.d == -20.0
        assert path.walkable_scale == 2.0
        assert path.check_pos.frame.origin.z == pytest.approx(10.48, abs=1e-6)


class TestLanding:
    """Path 4: only ground is looked for, with the real movement."""

    def landing(self, start: Point, end: Point) -> Transition:
        """Return a transition on its way down after a hit in the air."""
        transition = moving(start, end)
        path = transition.sphere_path
        path.collide, path.walkable_allowance = 1, Z_LANDING
        return transition

    def test_it_rests_on_the_floor(self) -> None:
        """Moved back along the movement until it touches; the plane is the contact plane."""
        transition = self.landing((0.0, 0.0, 1.0), (1.0, 0.0, 0.0))
        assert tree_of(floor()).find_collisions(transition, 1.0) is TransitionState.ADJUSTED
        path, collisions = transition.sphere_path, transition.collision_info
        assert path.check_pos.frame.origin.x == pytest.approx(0.52, abs=1e-6)
        assert path.check_pos.frame.origin.z == pytest.approx(0.48, abs=1e-6)
        assert (collisions.contact_plane_valid, collisions.contact_plane.d) == (1, 0.0)
        assert collisions.contact_plane_cell_id == CELL

    def test_a_ceiling_is_not_looked_for(self) -> None:
        """What one cannot walk on is passed through here."""
        transition = self.landing((0.0, 0.0, 1.0), (0.0, 0.0, 0.0))
        assert tree_of(floor(face_down=True)).find_collisions(transition, 1.0) is TransitionState.OK
        assert transition.collision_info.contact_plane_valid == 0


class TestContact:
    """Path 5: on the ground."""

    def test_a_hit_of_the_first_sphere_steps_up(self, monkeypatch: pytest.MonkeyPatch) -> None:
        """With the world's normal; success is OK."""
        space = at(0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0)
        transition = moving((0.0, 0.0, -1.0), (0.0, 0.0, -0.25), space=space, state=CONTACT_OI)
        normals: list[Point] = []

        def step_up(normal: Vector3) -> int:
            normals.append(xyz(normal))
            return 1

        monkeypatch.setattr(transition, "step_up", step_up, raising=False)
        assert tree_of(floor()).find_collisions(transition, 1.0) is TransitionState.OK
        assert normals == [(0.0, 0.0, -1.0)]

    def test_a_failed_step_up_slides(self, monkeypatch: pytest.MonkeyPatch) -> None:
        """The result is that of step_up_slide."""
        transition = moving((0.0, 0.0, 1.0), (0.0, 0.0, 0.25), state=CONTACT_OI)
        path = transition.sphere_path
        monkeypatch.setattr(transition, "step_up", lambda _: 0, raising=False)
        monkeypatch.setattr(type(path), "step_up_slide", lambda *_: TransitionState.SLID)
        assert tree_of(floor()).find_collisions(transition, 1.0) is TransitionState.SLID

    def test_a_hit_of_the_second_sphere_slides_the_first(self, monkeypatch: pytest.MonkeyPatch) -> None:
        """The head hits, yet it is sphere 0 with its current centre that slides."""
        transition = moving((0.0, 0.0, -2.0), (0.0, 0.0, -1.25), heights=(0.0, 1.0), state=CONTACT_OI)
        path = transition.sphere_path
        slid: list[tuple[Sphere, Vector3, Point]] = []

        def slide(
            sphere: Sphere, _path: object, _collisions: object, n: Vector3, curr: Vector3
        ) -> TransitionState:
            slid.append((sphere, curr, xyz(n)))
            return TransitionState.SLID

        monkeypatch.setattr(Sphere, "slide_sphere", slide)
        tree = tree_of(floor(face_down=True))
        assert tree.find_collisions(transition, 1.0) is TransitionState.SLID
        assert slid == [(path.global_sphere[0], path.global_curr_center[0], (0.0, 0.0, -1.0))]

    def test_with_one_sphere_a_facing_away_overlap_is_ignored(self) -> None:
        """Moving up out of the floor with a single sphere leaves no trace."""
        transition = moving((0.0, 0.0, 0.125), (0.0, 0.0, 0.25), state=CONTACT_OI)
        assert tree_of(floor()).find_collisions(transition, 1.0) is TransitionState.OK
        assert transition.sphere_path.neg_poly_hit == 0

    @pytest.mark.parametrize(("heights", "step_up"), [((0.0, 5.0), 1), ((5.0, 0.0), 0), ((0.0, 0.125), 0)])
    def test_with_two_spheres_it_is_a_negative_hit(self, heights: tuple[float, float], step_up: int) -> None:
        """Stored with the negated normal; the second sphere's takes precedence and says slide."""
        transition = moving((0.0, 0.0, 0.125), (0.0, 0.0, 0.25), heights=heights, state=CONTACT_OI)
        path = transition.sphere_path
        assert tree_of(floor()).find_collisions(transition, 1.0) is TransitionState.OK
        assert (path.neg_poly_hit, path.neg_step_up) == (1, step_up)
        assert xyz(path.neg_collision_normal) == (-0.0, -0.0, -1.0)

    def test_nothing_near_is_ok(self) -> None:
        """Two spheres in the air over the ground."""
        transition = moving((0.0, 0.0, 5.0), (0.0, 0.0, 4.0), heights=(0.0, 1.0), state=CONTACT_OI)
        assert tree_of(floor()).find_collisions(transition, 1.0) is TransitionState.OK
        assert transition.sphere_path.neg_poly_hit == 0


class TestAirborne:
    """Path 6a: any overlap counts, whichever way it faces."""

    @pytest.mark.parametrize("start", [1.0, 0.25, 0.125])
    def test_the_first_sphere_begins_a_landing(self, start: float) -> None:
        """Towards the floor, at rest, and away from it."""
        transition = moving((0.0, 0.0, start), (0.0, 0.0, 0.25))
        path = transition.sphere_path
        path.walk_interp = 0.25
        assert tree_of(floor()).find_collisions(transition, 1.0) is TransitionState.ADJUSTED
        assert (path.collide, path.walkable_allowance, path.walk_interp) == (1, Z_LANDING, 1.0)
        assert xyz(path.step_up_normal) == (0.0, 0.0, 1.0)
        assert path.check_pos.frame.origin.z == 0.25

    @pytest.mark.parametrize("start", [2.0, 1.25, 1.0])
    def test_the_second_sphere_collides(self, start: float) -> None:
        """With a collision normal and no landing."""
        transition = moving((0.0, 0.0, start), (0.0, 0.0, 1.25), heights=(0.0, -1.0))
        assert tree_of(floor()).find_collisions(transition, 1.0) is TransitionState.COLLIDED
        assert transition.sphere_path.collide == 0
        assert transition.collision_info.collision_normal_valid == 1
        assert xyz(transition.collision_info.collision_normal) == (0.0, 0.0, 1.0)

    def test_a_second_sphere_that_is_not_there_is_not_tested(self) -> None:
        """Stale data beyond the number of spheres does not count."""
        transition = moving((0.0, 0.0, 2.0), (0.0, 0.0, 1.25), heights=(0.0, -1.0))
        transition.sphere_path.num_sphere = 1
        assert tree_of(floor()).find_collisions(transition, 1.0) is TransitionState.OK


class TestPathClipped:
    """Path 6b: a missile stops; a perfectly clipped one at the touching point."""

    def test_it_collides_with_what_it_overlaps(self) -> None:
        """The position stays, the normal is noted."""
        transition = moving((0.0, 0.0, 1.0), (0.0, 0.0, 0.25), state=PATH_CLIPPED_OI)
        assert tree_of(floor()).find_collisions(transition, 1.0) is TransitionState.COLLIDED
        assert transition.sphere_path.check_pos.frame.origin.z == 0.25
        assert xyz(transition.collision_info.collision_normal) == (0.0, 0.0, 1.0)

    def test_the_second_sphere_is_never_tested(self) -> None:
        """It may be in the floor."""
        transition = moving((0.0, 0.0, 2.0), (0.0, 0.0, 1.25), heights=(0.0, -1.0), state=PATH_CLIPPED_OI)
        assert tree_of(floor()).find_collisions(transition, 1.0) is TransitionState.OK

    def test_a_perfect_clip_goes_to_the_touching_point(self) -> None:
        """Moved back along the movement to the last free point, with the normal of what was hit."""
        state = PATH_CLIPPED_OI | PERFECT_CLIP_OI
        transition = moving((0.0, 0.0, 1.48), (4.0, 0.0, -0.25), state=state)
        assert tree_of(floor()).find_collisions(transition, 1.0) is TransitionState.ADJUSTED
        path = transition.sphere_path
        assert path.check_pos.frame.origin.z >= 0.48 - 1e-6
        assert path.check_pos.frame.origin.z < 0.48 + 1.73 * 0.02
        assert xyz(transition.collision_info.collision_normal) == (0.0, 0.0, 1.0)

    def test_no_free_point_collides_without_a_normal(self) -> None:
        """If every plane touched so far still overlaps something, fifteen tries end it."""
        state = PATH_CLIPPED_OI | PERFECT_CLIP_OI
        transition = moving((0.0, 0.0, 1.0), (0.0, 0.0, 0.25), state=state)

        class Stuck(BSPLeaf):
            """A leaf that is always hit, by the floor."""

            asked = 0

            def sphere_intersects_poly(self, *arguments: object) -> int:
                """Count and hit."""
                Stuck.asked += 1
                arguments[2].value = self.in_polys[0]  # type: ignore[attr-defined]
                return 1

        tree = BSPTree(Stuck(0, 0, everything(), [floor()]))
        assert tree.find_collisions(transition, 1.0) is TransitionState.COLLIDED
        assert transition.collision_info.collision_normal_valid == 0
        assert Stuck.asked == 1 + 15


class TestAdjustToPlane:
    """The search for the last free point."""

    def search(self, curr: Point, check: Point, *polygons: Polygon) -> tuple[int, Point]:
        """Return the answer and the centre."""
        sphere = Sphere(Vector3(*check), 0.5)
        leaf = BSPLeaf(0, 0, everything(), polygons)
        r = BSPTree(leaf).adjust_to_plane(sphere, Vector3(*curr), polygons[0], Ref(None))
        return r, xyz(sphere.center)

    def test_the_touching_point_is_bisected_towards_the_hit(self) -> None:
        """Touching at 1/2 is free; the bisection then stays within 0.02 of the movement."""
        r, (_, _, z) = self.search((0.0, 0.0, 1.5), (0.0, 0.0, -0.5), floor())
        assert r == 1
        assert 0.5 - 2.0 * 0.02 < z <= 0.5

    def test_touching_at_the_start_bisects_the_whole_movement(self) -> None:
        """From inside the radius no time is computed; all six halvings say hit."""
        r, (_, _, z) = self.search((0.0, 0.0, 0.4375), (0.0, 0.0, 0.0), floor())
        assert (r, z) == (1, 0.4375)

    def test_a_movement_along_the_plane_ends_near_its_end(self) -> None:
        """From beyond the radius the start is tried, found free, and the bisection goes all the way."""
        r, center = self.search((3.0, 0.0, 0.75), (4.0, 0.0, 0.75), floor())
        assert r == 1
        assert center[0] > 3.98
