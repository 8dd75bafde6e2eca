"""CSphere::intersects: the bounding test compares squared quantities with EPS."""

from __future__ import annotations

from typing import TYPE_CHECKING

from hypothesis import given
from hypothesis import strategies as st

from oracle.sphere import Sphere
from oracle.vector import Vector3

if TYPE_CHECKING:
    from collections.abc import Callable

    Step = Callable[[float, int], float]

LAST_TOUCHING = 2.0000498294830322
"""The largest float32 whose square is less than 4 + EPS."""
number = st.floats(-100.0, 100.0, width=32)


def ball(x: float, y: float, z: float, radius: float) -> Sphere:
    """Return a sphere."""
    return Sphere(Vector3(x, y, z), radius)


def test_spheres_a_little_apart_intersect(next32: Step) -> None:
    """Two unit spheres intersect up to a gap of about EPS/4, both sides of the limit."""
    unit = ball(0.0, 0.0, 0.0, 1.0)
    assert unit.intersects(ball(LAST_TOUCHING, 0.0, 0.0, 1.0))
    assert not unit.intersects(ball(next32(LAST_TOUCHING, 1), 0.0, 0.0, 1.0))
    assert unit.intersects(ball(0.0, -2.0, 0.0, 1.0))


@given(st.tuples(number, number, number, number), st.tuples(number, number, number, number))
def test_intersection_is_mutual(a: tuple[float, ...], b: tuple[float, ...]) -> None:
    """Either sphere gives the same answer: negation and the commuted sum are exact."""
    assert ball(*a).intersects(ball(*b)) == ball(*b).intersects(ball(*a))


def test_a_sphere_owns_its_centre() -> None:
    """Copy and assign do not share."""
    sphere, other = ball(1.0, 2.0, 3.0, 4.0), ball(0.0, 0.0, 0.0, 0.0)
    copy = sphere.copy()
    other.assign(sphere)
    sphere.center.x = 9.0
    assert (copy.center.x, other.center.x, other.radius) == (1.0, 1.0, 4.0)
    assert repr(copy) == "Sphere(Vector3(1.0, 2.0, 3.0), 4.0)"
