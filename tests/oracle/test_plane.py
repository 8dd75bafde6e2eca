"""Plane: sides and their thresholds, heights, boxes, rays, and the way to world space."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import pytest
from hypothesis import given
from hypothesis import strategies as st

from oracle.bbox import BBox
from oracle.constants import EPS
from oracle.enums import Sidedness
from oracle.frame import Frame
from oracle.plane import Plane
from oracle.position import Position
from oracle.ray import Ray
from oracle.ref import Ref
from oracle.vector import Vector3, dot_x

if TYPE_CHECKING:
    from collections.abc import Callable

    Step = Callable[[float, int], float]
    Bits = Callable[[float], int]

WORLD_PLANE_BOUND = 1e-3
"""Metres: a normal rounded to 2^-24 per component, times coordinates up to 500, and float32 stores."""


def floor_plane(height: float = 0.0) -> Plane:
    """Return the horizontal plane at a height, front up."""
    return Plane(Vector3(0.0, 0.0, 1.0), -height)


def test_a_plane_goes_through_its_point() -> None:
    """The constant is minus the dot product, x term last."""
    plane = Plane.from_point(Vector3(0.0, 0.6000000238418579, 0.800000011920929), Vector3(1.0, 2.0, 3.0))
    assert plane.d == -3.6000001430511475
    assert Plane.from_point(Vector3(1.0, 1.0, 1.0), Vector3(1.0, 2.0**60, -(2.0**60))).d == -1.0


def test_the_plane_owns_its_normal() -> None:
    """Neither from_point nor assign shares a vector."""
    normal = Vector3(0.0, 0.0, 1.0)
    plane = Plane.from_point(normal, Vector3())
    other = floor_plane(3.0)
    other.assign(plane)
    normal.z = plane.N.x = 5.0
    assert plane.N.z == 1.0
    assert (other.N.x, other.d) == (0.0, 0.0)
    assert repr(other) == "Plane(Vector3(0.0, 0.0, 1.0), -0.0)"


def test_a_point_within_eps_is_in_the_plane(next32: Step) -> None:
    """Exactly plus or minus EPS still is; the next float is not."""
    plane = floor_plane()
    above, below = next32(EPS, 1), -next32(EPS, 1)
    assert plane.which_side(Vector3(0.0, 0.0, EPS), EPS) is Sidedness.IN_PLANE
    assert plane.which_side(Vector3(0.0, 0.0, -EPS), EPS) is Sidedness.IN_PLANE
    assert plane.which_side(Vector3(0.0, 0.0, above), EPS) is Sidedness.POSITIVE
    assert plane.which_side(Vector3(0.0, 0.0, below), EPS) is Sidedness.NEGATIVE


def test_set_height_needs_a_plane_that_is_not_vertical(next32: Step) -> None:
    """A normal with z of exactly EPS counts as vertical."""
    point = Vector3(1.0, 2.0, 7.0)
    assert Plane(Vector3(1.0, 0.0, -EPS), 0.0).set_height(point) == 0
    assert point.z == 7.0
    assert Plane(Vector3(0.0, 0.0, next32(EPS, 1)), 0.0).set_height(point) == 1
    assert point.z == 0.0
    assert Plane(Vector3(0.5, 0.25, 0.5), -4.0).set_height(point) == 1
    assert point.z == 6.0


def test_snapping_keeps_a_movement_parallel(next32: Step) -> None:
    """The movement's own z does not matter; a vertical plane leaves it alone."""
    offset = Vector3(2.0, 0.0, 55.0)
    Plane(Vector3(0.6000000238418579, 0.0, 0.800000011920929), 0.0).snap_to_plane(offset)
    assert offset.z == -1.5
    offset.z = 55.0
    Plane(Vector3(1.0, 0.0, EPS), 0.0).snap_to_plane(offset)
    assert offset.z == 55.0
    Plane(Vector3(1.0, 0.0, next32(EPS, 1)), 0.0).snap_to_plane(offset)
    assert offset.z < -9999.0


def test_snapping_does_not_cancel_the_plane_constant() -> None:
    """A huge constant swallows the movement, though it cancels on paper."""
    normal = Vector3(0.6000000238418579, 0.0, 0.800000011920929)
    offset = Vector3(2.0**-30, 0.0, 0.0)
    Plane(normal, 2.0**30).snap_to_plane(offset)
    assert offset.z == 0.0


def test_a_ray_meets_a_plane_in_front(next32: Step) -> None:
    """1 at time >= 0, 0 behind; a parallel ray leaves the time alone."""
    plane = floor_plane()
    down, up = Vector3(0.0, 0.0, -2.0), Vector3(0.0, 0.0, 2.0)
    time = Ref(99.0)
    assert plane.compute_time_of_intersection(Ray(Vector3(0.0, 0.0, 4.0), down), time) == 1
    assert time.value == 2.0
    assert plane.compute_time_of_intersection(Ray(Vector3(0.0, 0.0, 4.0), up), time) == 0
    assert time.value == -2.0
    assert plane.compute_time_of_intersection(Ray(Vector3(), up), time) == 1
    slow = Vector3(1.0, 0.0, next32(EPS, -1))
    time.value = 99.0
    assert plane.compute_time_of_intersection(Ray(Vector3(), slow), time) == 0
    assert time.value == 99.0
    assert plane.compute_time_of_intersection(Ray(Vector3(), Vector3(1.0, 0.0, EPS)), time) == 1


@pytest.mark.parametrize(
    ("low", "high", "side"),
    [
        (1.0, 2.0, Sidedness.POSITIVE),
        (-2.0, -1.0, Sidedness.NEGATIVE),
        (-1.0, 1.0, Sidedness.CROSSING),
        (EPS, 1.0, Sidedness.CROSSING),
        (-1.0, -EPS, Sidedness.CROSSING),
    ],
)
def test_a_box_is_on_a_side_or_crosses(low: float, high: float, side: Sidedness) -> None:
    """A corner within EPS of the plane makes the box cross it."""
    box = BBox(Vector3(-5.0, -5.0, low), Vector3(5.0, 5.0, high))
    assert floor_plane().intersect_box(box) is side


def test_each_corner_of_a_box_is_looked_at() -> None:
    """A plane that cuts off any single corner crosses the box."""
    box = BBox(Vector3(-1.0, -1.0, -1.0), Vector3(1.0, 1.0, 1.0))
    for x in (-1.0, 1.0):
        for y in (-1.0, 1.0):
            for z in (-1.0, 1.0):
                assert Plane(Vector3(x, y, z), -2.0).intersect_box(box) is Sidedness.CROSSING
                assert Plane(Vector3(x, y, z), -4.0).intersect_box(box) is Sidedness.NEGATIVE


def test_the_world_plane_of_a_translated_cell(bits: Bits) -> None:
    """A cell floor at local z = 0 in a cell lifted to 94 m lies at 94 m."""
    cell = Position(0xA9B40101, Frame.unpack(Vector3(100.0, 50.0, 94.0), 1.0, 0.0, 0.0, 0.0))
    world = Plane.localtoglobal(cell, cell, floor_plane())
    assert (world.N.x, world.N.y, world.N.z) == (0.0, 0.0, 1.0)
    assert bits(world.d) == 0xC2BC0000


def test_the_world_plane_is_asked_in_the_other_block() -> None:
    """Only the asker's cell id matters; the block offset enters the constant."""
    wall = Plane(Vector3(1.0, 0.0, 0.0), -3.0)
    cell = Position(0xAAB40101, Frame.unpack(Vector3(10.0, 0.0, 0.0), 0.0, 0.0, 0.0, 1.0))
    asker = Position(0xA9B40101, Frame.unpack(Vector3(5.0, 6.0, 7.0), 0.6, 0.8, 0.0, 0.0))
    world = Plane.localtoglobal(asker, cell, wall)
    assert (world.N.x, world.d) == (-1.0, 199.0)


def test_the_normal_is_not_renormalised_and_the_foot_not_divided() -> None:
    """A local normal of length 2 gives d off by its squared length: the foot is -d * N."""
    plane = Plane(Vector3(0.0, 0.0, 2.0), -4.0)
    world = Plane.localtoglobal(Position(), Position(), plane)
    assert (world.N.z, world.d) == (2.0, -16.0)


unit = st.floats(-1.0, 1.0, width=32)
origin = st.floats(-200.0, 200.0, width=32)


@given(st.tuples(unit, unit, unit, unit), st.tuples(origin, origin, origin), st.tuples(unit, unit, unit))
def test_points_of_the_plane_stay_on_it(
    q: tuple[float, ...], at: tuple[float, ...], direction: tuple[float, ...]
) -> None:
    """A point of the local plane, taken to the world, is on the world plane."""
    normal = Vector3(*direction)
    if normal.normalize_check_small():
        return
    cell = Position(0xA9B40101)
    cell.frame.set_rotate(*q)
    cell.frame.origin.assign(Vector3(*at))
    point = Vector3(7.0, -4.0, 2.0)
    world = Plane.localtoglobal(cell, cell, Plane.from_point(normal, point))
    assert abs(dot_x(world.N, cell.localtoglobal(cell, point)) + world.d) <= WORLD_PLANE_BOUND
    assert math.isclose(world.N.magnitude(), 1.0, abs_tol=1e-6)
