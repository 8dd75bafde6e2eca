"""Upright movers: what is left out of the arithmetic is in none of its bits."""

from __future__ import annotations

import math
import struct
from typing import Any

import numpy as np
import pytest
from hypothesis import assume, example, given
from hypothesis import strategies as st

from engine.constants import EPS
from engine.kernels.frame import interpolated, is_unit, matrix_of, normalised
from engine.kernels.path import placed
from engine.kernels.upright import held_upright, is_off_zero, is_upright, placed_upright
from engine.layout import Q_END, Q_NUM_SPHERE, Q_SPHERES, Q_START, QUATERNION, QUERY_SIZE, SPHERE_SIZE
from engine.tracing_interpreter import Interpreter

INTERPRETER = Interpreter({})
ZEROS = st.sampled_from((0.0, -0.0))
HEADINGS = st.floats(0.0, 7.0).flatmap(
    lambda angle: st.tuples(
        st.just(float(np.float32(math.cos(angle)))), ZEROS, ZEROS, st.just(float(np.float32(math.sin(angle))))
    )
)
"""Rotations about z, w x y z."""
TURNS = st.floats(-(2.0**-7), 2.0**-7, width=32)
"""What is added to a part of one to come to another near it."""
COORDINATES = st.floats(-300.0, 300.0, width=32)


def asked(kernel: Any, *arguments: Any) -> Any:
    """Ask a kernel that Python cannot call."""
    with np.errstate(all="ignore"):
        return INTERPRETER.function(kernel)(*arguments)


def numbers(values: tuple[float, ...]) -> tuple[Any, ...]:
    """Return numbers as interpreted kernels calculate with them."""
    return tuple(map(np.float64, values))


def bits(values: tuple[float, ...]) -> bytes:
    """Return all bits of numbers, the signs of zeros too."""
    return struct.pack(f"{len(values)}d", *values)


@given(HEADINGS, st.tuples(TURNS, ZEROS, ZEROS, TURNS))
@example((1.0, -0.0, 0.0, 0.0), (0.0, -0.0, 0.0, -0.0))
@example((1.0, 0.0, -0.0, 0.0), (0.0, 0.0, -0.0, 0.0))
def test_an_upright_mover_turns_as_any(begin: tuple[float, ...], turn: tuple[float, ...]) -> None:
    """The last rotation of its way has the bits of the one that is interpolated in full."""
    end = tuple(float(np.float32(a + b)) for a, b in zip(begin, turn, strict=True))
    assume(1.0 - (begin[0] * end[0] + begin[3] * end[3]) <= EPS)
    held = asked(held_upright, numbers(begin), numbers(end))
    in_full = asked(normalised, asked(interpolated, numbers(begin), numbers(end), np.float64(1.0)))
    assert asked(is_unit, held) == asked(is_unit, in_full)
    assert bits(held) == bits(in_full)


@given(HEADINGS, st.tuples(COORDINATES, COORDINATES, COORDINATES), COORDINATES, st.tuples(ZEROS, ZEROS))
@example((1.0, 0.0, 0.0, 0.0), (5.0, 5.0, -1.0), 1.0, (0.0, -0.0))
@example((1.0, 0.0, 0.0, 0.0), (5.0, 5.0, 1.0), -0.0, (0.0, -0.0))
def test_a_sphere_on_the_axis_is_placed_as_any(
    heading: tuple[float, ...], place: tuple[float, ...], height: float, aside: tuple[float, float]
) -> None:
    """Its centre has the bits of the one that is rotated in full, wherever no coordinate is 0."""
    turn = asked(normalised, numbers(heading))
    assume(asked(is_unit, turn) and asked(is_off_zero, place))
    in_full = asked(placed, asked(matrix_of, turn), numbers(place), *numbers((*aside, height)))
    assert bits(asked(placed_upright, numbers(place), np.float64(height))) == bits(in_full)


@pytest.mark.parametrize("place", [(0.0, 1.0, 1.0), (1.0, -0.0, 1.0), (1.0, 1.0, 0.0)])
def test_a_place_on_an_axis_is_not_off_zero(place: tuple[float, float, float]) -> None:
    """There a product with 0 decides the sign of what is added to it."""
    assert not asked(is_off_zero, place)


@pytest.mark.parametrize(
    ("field", "spheres", "upright"),
    [
        (Q_START + QUATERNION + 1, 1, False),
        (Q_START + QUATERNION + 2, 1, False),
        (Q_START + QUATERNION + 3, 1, True),
        (Q_END + QUATERNION + 1, 1, False),
        (Q_END + QUATERNION + 2, 1, False),
        (Q_END + QUATERNION + 3, 1, True),
        (Q_SPHERES, 1, False),
        (Q_SPHERES + 1, 1, False),
        (Q_SPHERES + 2, 1, True),
        (Q_SPHERES + SPHERE_SIZE, 1, True),
        (Q_SPHERES + SPHERE_SIZE, 2, False),
        (Q_SPHERES + SPHERE_SIZE + 1, 2, False),
        (Q_SPHERES + SPHERE_SIZE + 2, 2, True),
    ],
)
def test_who_is_upright(field: int, spheres: int, upright: bool) -> None:
    """No x or y of either rotation, nor of a sphere that the mover has."""
    row = np.zeros(QUERY_SIZE)
    row[Q_NUM_SPHERE] = spheres
    row[[Q_START + QUATERNION, Q_END + QUATERNION]] = 1.0
    row[field] = 1e-30
    assert asked(is_upright, row) == upright


@pytest.mark.parametrize(("half", "upright"), [(0.019, True), (0.021, False), (3.1, False), (3.15, False)])
def test_who_turns_much_is_not_upright(half: float, upright: bool) -> None:
    """As Frame::interpolate_rotation says it: by an angle whose half has a cosine of 1 less EPS."""
    row = np.zeros(QUERY_SIZE)
    row[Q_START + QUATERNION] = 1.0
    row[[Q_END + QUATERNION, Q_END + QUATERNION + 3]] = math.cos(half), math.sin(half)
    assert asked(is_upright, row) == upright
