"""The port on another number type: every coordinate goes through the type's own arithmetic.

`Double` stores without rounding. What it computes differs from retail by roundings only; a place that
fell back to plain floats, or called a function of plain floats, would raise.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import pytest
from oracle_land import BLOCK, VERTICES, WATER, ids, land_block, land_id

from oracle.bbox import BBox
from oracle.bsp_leaf import BSPLeaf
from oracle.bsp_node import BSPNode
from oracle.bsp_tree import BSPTree
from oracle.cell_array import CellArray
from oracle.cell_list import find_cell_list
from oracle.collision_info import CollisionInfo
from oracle.cyl_sphere import CylSphere
from oracle.enums import CONTACT_OI, PATH_CLIPPED_OI, PERFECT_CLIP_OI, InsertType, TransitionState
from oracle.frame import Frame
from oracle.landscape import Landscape
from oracle.physics_object import PhysicsObj
from oracle.physics_state import GRAVITY_PS, SLEDDING_PS
from oracle.plane import Plane
from oracle.polygon import Polygon
from oracle.position import Position
from oracle.ray import Ray
from oracle.ref import Ref
from oracle.sphere import Sphere
from oracle.transient_state import ON_WALKABLE_TS
from oracle.transition import Transition
from oracle.vector import Vector3
from oracle.world import World

if TYPE_CHECKING:
    from collections.abc import Callable

CLOSE = 1e-4
"""Metres: what float32 stores cost at coordinates up to 256."""
UPRIGHT = (1.0, 0.0, 0.0, 0.0)


def raw(x: Any) -> float:
    """Return the float behind a number."""
    return x.value if isinstance(x, Double) else float(x)


class Double:
    """A number that is never rounded to float32."""

    __slots__ = ("value",)

    def __init__(self, value: float) -> None:
        self.value = value

    def stored(self) -> Double:
        """Store without rounding."""
        return self

    def sqrt(self) -> Double:
        """Return the square root."""
        return Double(math.sqrt(self.value))

    def divided_by(self, other: Any) -> Double:
        """Divide by something that may be zero."""
        return Double(self.value / raw(other))

    def dividing(self, other: float) -> Double:
        """Divide a float by this."""
        return Double(other / self.value)

    def is_nan(self) -> bool:
        """Tell whether this is NaN."""
        return math.isnan(self.value)

    def sin(self) -> Double:
        """Return the sine."""
        return Double(math.sin(self.value))

    def cos(self) -> Double:
        """Return the cosine."""
        return Double(math.cos(self.value))

    def asin(self) -> Double:
        """Return the arc sine."""
        return Double(math.asin(self.value))

    def acos(self) -> Double:
        """Return the arc cosine."""
        return Double(math.acos(self.value))

    def atan2(self, x: Any) -> Double:
        """Return the angle of (x, self)."""
        return Double(math.atan2(self.value, raw(x)))

    def power(self, y: Any) -> Double:
        """Return a power."""
        return Double(self.value ** raw(y))

    def fmod(self, b: float) -> Double:
        """Return the remainder."""
        return Double(math.fmod(self.value, b))

    def __add__(self, other: Any) -> Double:
        return Double(self.value + raw(other))

    __radd__ = __add__

    def __sub__(self, other: Any) -> Double:
        return Double(self.value - raw(other))

    def __rsub__(self, other: Any) -> Double:
        return Double(raw(other) - self.value)

    def __mul__(self, other: Any) -> Double:
        return Double(self.value * raw(other))

    __rmul__ = __mul__

    def __truediv__(self, other: Any) -> Double:
        return Double(self.value / raw(other))

    def __rtruediv__(self, other: Any) -> Double:
        return Double(raw(other) / self.value)

    def __neg__(self) -> Double:
        return Double(-self.value)

    def __abs__(self) -> Double:
        return Double(abs(self.value))

    def __floor__(self) -> int:
        return math.floor(self.value)

    def __lt__(self, other: Any) -> bool:
        return self.value < raw(other)

    def __le__(self, other: Any) -> bool:
        return self.value <= raw(other)

    def __gt__(self, other: Any) -> bool:
        return self.value > raw(other)

    def __ge__(self, other: Any) -> bool:
        return self.value >= raw(other)

    def __eq__(self, other: object) -> bool:
        return self.value == raw(other)

    def __hash__(self) -> int:
        return hash(self.value)


def vector(number: Callable[[float], Any], x: float, y: float, z: float) -> Vector3:
    """Return a vector of the model's numbers."""
    return Vector3(number(x), number(y), number(z))


def position(number: Callable[[float], Any], x: float, y: float, z: float) -> Position:
    """Return a position, turned by 60 degrees about z."""
    rotation = [number(q) for q in (0.8660253882408142, 0.0, 0.0, 0.5)]
    return Position(0xA9B40101, Frame.unpack(vector(number, x, y, z), *rotation))


def room(number: Callable[[float], Any]) -> BSPTree:
    """Return a floor and a low ceiling, in a tree that splits between them."""
    ring = ((-9.0, -9.0), (9.0, -9.0), (9.0, 9.0), (-9.0, 9.0))
    floor = Polygon([vector(number, x, y, 0.0) for x, y in ring], 0)
    ceiling = Polygon([vector(number, x, y, 2.0) for x, y in reversed(ring)], 1)
    split = Plane(vector(number, 0.0, 0.0, 1.0), number(-1.0))

    def bound() -> Sphere:
        return Sphere(vector(number, 0.0, 0.0, 1.0), number(50.0))

    return BSPTree(
        BSPNode(split, bound(), BSPLeaf(0, 0, bound(), [ceiling]), BSPLeaf(1, 0, bound(), [floor]))
    )


def collide(number: Callable[[float], Any], start: float, end: float, **fields: Any) -> list[Any]:
    """Return everything that one collision call leaves behind, from heights above the floor."""
    transition = Transition(World())
    path, collisions = transition.sphere_path, transition.collision_info
    transition.object_info.state = fields.pop("state", 0)
    spheres = [Sphere(vector(number, 0.0, 0.0, z), number(0.48)) for z in (0.0, 0.87)]
    path.init_sphere(2, spheres, number(1.0))
    path.init_path(
        None, position(number, 100.0, 50.0, 94.0 + start), position(number, 100.0, 50.0, 94.0 + end)
    )
    path.set_check_pos(position(number, 100.0, 50.0, 94.0 + end), None)
    path.cache_localspace_sphere(position(number, 99.0, 49.0, 94.0), number(1.0))
    path.walk_interp, path.step_down_amt = number(1.0), number(0.5)
    for name, value in fields.items():
        setattr(path, name, value)
    tree = room(number)
    initial = path.insert_type == InsertType.INITIAL_PLACEMENT
    result = tree.placement_insert(transition) if initial else tree.find_collisions(transition, number(1.0))
    o = path.check_pos.frame.origin
    vectors = (o, collisions.contact_plane.N, collisions.collision_normal, path.neg_collision_normal)
    numbers = [c for v in vectors for c in (v.x, v.y, v.z)]
    return [result, *numbers, collisions.contact_plane.d, path.walk_interp, path.walkable_allowance]


@pytest.mark.parametrize(
    ("start", "end", "fields", "result"),
    [
        (0.6, 0.4, {"step_down": 1}, TransitionState.ADJUSTED),
        (0.6, 0.4, {"collide": 1}, TransitionState.ADJUSTED),
        (0.6, 0.4, {"check_walkable": 1}, TransitionState.COLLIDED),
        (0.6, 0.4, {"insert_type": InsertType.PLACEMENT}, TransitionState.COLLIDED),
        (0.6, 0.4, {"insert_type": InsertType.INITIAL_PLACEMENT}, TransitionState.ADJUSTED),
        (0.6, 0.4, {}, TransitionState.ADJUSTED),
        (0.6, 0.8, {}, TransitionState.COLLIDED),
        (0.3, 0.4, {"state": CONTACT_OI}, TransitionState.OK),
        (0.6, 0.4, {"state": PATH_CLIPPED_OI}, TransitionState.COLLIDED),
        (0.6, 0.4, {"state": PATH_CLIPPED_OI | PERFECT_CLIP_OI}, TransitionState.ADJUSTED),
    ],
)
def test_collisions_run_on_other_numbers(
    start: float, end: float, fields: dict[str, Any], result: TransitionState
) -> None:
    """The same decisions, and numbers that differ by float32 roundings only."""
    retail = collide(float, start, end, **fields)
    double = collide(Double, start, end, **fields)
    assert retail[0] is double[0] is result
    assert [raw(x) for x in double[1:]] == pytest.approx(retail[1:], abs=CLOSE)


def meet(number: Callable[[float], Any], shape: str, start: float, end: float, **fields: Any) -> list[Any]:
    """Return everything that the test of a shape of 1.5 metres leaves behind, from heights above it."""
    transition = Transition(World())
    path, collisions = transition.sphere_path, transition.collision_info
    transition.object_info.state = fields.pop("state", 0)
    transition.object_info.step_up_height = number(fields.pop("step_up_height", 0.0))
    along = number(fields.pop("along", 0.25))
    path.init_sphere(1, [Sphere(vector(number, 0.0, 0.0, 0.0), number(0.5))], number(1.0))
    begin, finish = (position(number, 100.0, 50.0, 94.0 + z) for z in (start, end))
    begin.frame.origin.x = begin.frame.origin.x + along
    path.init_path(None, begin, finish)
    path.set_check_pos(finish, None)
    path.walk_interp, path.step_down_amt = number(1.0), number(1.0)
    for name, value in fields.items():
        setattr(path, name, value)
    where = position(number, 100.0, 50.0, 94.0)
    if shape == "sphere":
        ball = Sphere(vector(number, 0.0, 0.0, 0.0), number(0.75))
        result = ball.intersects_sphere_at(where, number(2.0), transition, is_creature=False)
    else:
        cylinder = CylSphere(vector(number, 0.0, 0.0, -0.25), number(1.0), number(0.75))
        result = cylinder.intersects_sphere_at(where, number(2.0), transition)
    o = path.check_pos.frame.origin
    vectors = (o, collisions.contact_plane.N, collisions.collision_normal, path.step_up_normal)
    numbers = [c for v in vectors for c in (v.x, v.y, v.z)]
    return [result, *numbers, collisions.contact_plane.d, path.walk_interp, path.walkable_allowance]


@pytest.mark.parametrize("shape", ["sphere", "cylinder"])
@pytest.mark.parametrize(
    ("start", "end", "fields", "result"),
    [
        (2.0, 1.5, {"insert_type": InsertType.PLACEMENT}, TransitionState.COLLIDED),
        (2.0, 1.5, {"step_down": 1}, TransitionState.ADJUSTED),
        (2.0, 1.75, {"collide": 1}, TransitionState.ADJUSTED),
        (2.5, 1.5, {}, TransitionState.ADJUSTED),
        (2.5, 1.5, {"state": PATH_CLIPPED_OI}, TransitionState.COLLIDED),
        (2.5, 1.5, {"state": PATH_CLIPPED_OI | PERFECT_CLIP_OI}, TransitionState.ADJUSTED),
        (0.5, 0.5, {"state": PATH_CLIPPED_OI | PERFECT_CLIP_OI, "along": 4.0}, TransitionState.ADJUSTED),
        (2.5, 0.5, {"state": PATH_CLIPPED_OI | PERFECT_CLIP_OI, "along": 8.0}, TransitionState.ADJUSTED),
        (0.5, 0.5, {"state": CONTACT_OI, "along": 4.0}, TransitionState.SLID),
    ],
)
def test_shapes_run_on_other_numbers(
    shape: str, start: float, end: float, fields: dict[str, Any], result: TransitionState
) -> None:
    """The same decisions for spheres and cylinders, and numbers that differ by float32 roundings only."""
    retail = meet(float, shape, start, end, **fields)
    double = meet(Double, shape, start, end, **fields)
    assert retail[0] is double[0] is result
    assert [raw(x) for x in double[1:]] == pytest.approx(retail[1:], abs=CLOSE)


def test_rotations_run_on_other_numbers() -> None:
    """Headings, angles and interpolation use the type's own functions."""

    def turned(number: Callable[[float], Any]) -> list[Any]:
        start, end, frame = Frame(), Frame(), Frame()
        start.set_heading(number(30.0))
        end.set_vector_heading(vector(number, 0.5, -0.25, 0.125))
        frame.interpolate_rotation(start, end, number(0.25))
        frame.interpolate_origin(position(number, 1.0, 2.0, 3.0).frame, start, number(0.25))
        combined = Frame()
        combined.combine(frame, position(number, 4.0, 5.0, 6.0).frame)
        o = combined.origin
        heading = vector(number, 1.0, 2.0, 0.0).get_heading()
        return [
            o.x,
            o.y,
            o.z,
            combined.qw,
            combined.qx,
            combined.qy,
            combined.qz,
            frame.get_heading(),
            heading,
        ]

    assert [raw(x) for x in turned(Double)] == pytest.approx(turned(float), abs=CLOSE)


def test_single_questions_run_on_other_numbers() -> None:
    """What the collision call above does not reach."""
    tree = room(Double)
    floor = tree.root_node.children()[1].in_polys[0]  # type: ignore[attr-defined]
    normal = Vector3()
    beside = Sphere(vector(Double, 20.0, 0.0, 1.0), Double(0.5))
    assert floor.find_crossed_edge(beside, vector(Double, 0.0, 0.0, 1.0), normal) == 1
    assert [raw(c) for c in (normal.x, normal.y, normal.z)] == [-1.0, 0.0, 0.0]
    point = vector(Double, 0.0, 0.0, 7.0)
    assert floor.plane.set_height(point) == 1
    assert raw(point.z) == 0.0
    assert tree.root_node.point_intersects_solid(point) == 1
    time: Ref[Any] = Ref(None)
    down = Ray(vector(Double, 0.0, 0.0, 3.0), vector(Double, 0.0, 0.0, -2.0))
    assert floor.polygon_hits_ray(down, time) == 1
    assert raw(time.value) == 1.5
    assert raw(position(Double, 1.0, 2.0, 3.0).distance(position(Double, 4.0, 6.0, 3.0))) == 5.0


def test_velocities_run_on_other_numbers() -> None:
    """Friction, gravity, spin and bounce of the tick."""

    def thrown(number: Callable[[float], Any]) -> list[Any]:
        where: Any = position(number, 1.0, 2.0, 3.0)
        body = PhysicsObj(0, SLEDDING_PS | GRAVITY_PS, where, scale=number(1.0), part_array=None)
        body.transient_state = ON_WALKABLE_TS
        body.m_omega = vector(number, 0.0, 1.0, 3.0)
        body.contact_plane = Plane(vector(number, 0.0, 0.6, 0.8), number(0.0))
        body.friction, body.elasticity = number(0.5), number(0.0625)
        body.set_local_velocity(vector(number, 40.0, 60.0, -20.0), 0)
        body.calc_acceleration()
        body.update_position_internal(number(0.125), where.frame)
        collisions = CollisionInfo()
        collisions.set_collision_normal(vector(number, -1.0, -2.0, 1.0))
        body.handle_all_collisions(collisions, 0, 0)
        f, v = where.frame, body.m_velocity
        return [f.origin.x, f.origin.y, f.origin.z, f.qw, f.qx, f.qy, f.qz, v.x, v.y, v.z]

    assert [raw(x) for x in thrown(Double)] == pytest.approx(thrown(float), abs=CLOSE)


def test_land_runs_on_other_numbers() -> None:
    """Terrain, its water, the lists of cells, and the boxes of registration."""

    def walked(number: Callable[[float], Any]) -> list[Any]:
        world = World()
        heights = [number(0.37 * (k % 7) + 10.0) for k in range(VERTICES)]
        world.landscape = Landscape({BLOCK: land_block(world, heights=heights, terrain=[WATER] + [0] * 80)})
        array = CellArray()
        spheres = [Sphere(vector(number, 23.9, 12.3, 11.0), number(0.48))]
        pose: Any = Position(
            land_id(0, 0), Frame.unpack(vector(number, 12.1, 12.2, 11.0), *map(number, UPRIGHT))
        )
        found: Ref[Any] = Ref(None)
        find_cell_list(world, pose, 1, spheres, array, found, None)
        cell = found.value
        transition = Transition(world)
        transition.object_info.object = PhysicsObj(0, 0, pose, scale=number(1.0), part_array=None)
        transition.init_sphere(1, [Sphere(vector(number, 0.0, 0.0, -0.9), number(0.48))], number(1.0))
        transition.init_path(cell, pose, pose)
        transition.sphere_path.set_check_pos(pose, cell)
        transition.sphere_path.step_down_amt = transition.sphere_path.walk_interp = number(1.0)
        result = cell.find_env_collisions(transition)
        low = (
            BBox(vector(number, -1.0, -2.0, 0.0), vector(number, 1.0, 2.0, 3.0))
            .local_to_global(pose, pose)
            .min
        )
        o, n = transition.sphere_path.check_pos.frame.origin, transition.collision_info.contact_plane.N
        return [result, *ids(array), cell.id, cell.get_water_depth(o), o.z, n.x, n.y, n.z, low.x, low.y]

    assert [raw(x) for x in walked(Double)] == pytest.approx(walked(float), abs=CLOSE)
