"""Rotations come out of angles and matrices as the quaternions that retail would turn back into them."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import pytest
from hypothesis import given
from hypothesis import strategies as st

from conformance.floats import is_float32
from conformance.scenes.errors import SceneError
from conformance.scenes.rotations import (
    multiply,
    quaternion_from_rows,
    rotate,
    round_quaternion,
    rows_from_quaternion,
    yaw_quaternion,
)
from oracle.frame import Frame

if TYPE_CHECKING:
    from conformance.scenes.model import Quaternion

CELL = 0xA9B40151
CLOSE = 1e-6
"""Two roundings of a quaternion to float32, through a matrix of nine products."""

PARTS = st.floats(-1.0, 1.0)
QUATERNIONS = (
    st.tuples(PARTS, PARTS, PARTS, PARTS).filter(lambda q: sum(x * x for x in q) > 0.01).map(round_quaternion)
)


def flat(rows: tuple[tuple[float, ...], ...]) -> list[float]:
    """Return the nine numbers of a matrix."""
    return [part for row in rows for part in row]


@pytest.mark.parametrize(
    ("degrees", "expected"),
    [
        (0.0, (1.0, 0.0, 0.0, 0.0)),
        (90.0, (0.7071067690849304, 0.0, 0.0, 0.7071067690849304)),
        (180.0, (0.0, 0.0, 0.0, 1.0)),
        (45.0, (0.9238795042037964, 0.0, 0.0, 0.3826834261417389)),
        (-90.0, (-0.7071067690849304, 0.0, 0.0, 0.7071067690849304)),
    ],
)
def test_yaw(degrees: float, expected: Quaternion) -> None:
    """A yaw is a float32 quaternion about z, exact where float32 is; q and -q are the same turn."""
    turned = yaw_quaternion(degrees)
    assert turned in (expected, tuple(0.0 - part for part in expected))


def test_rows_point_where_the_axes_go() -> None:
    """Turned by 90 degrees, local x points along y, and row 0 says so."""
    rows = rows_from_quaternion((math.sqrt(0.5), 0.0, 0.0, math.sqrt(0.5)))
    assert flat(rows) == pytest.approx([0, 1, 0, -1, 0, 0, 0, 0, 1], abs=1e-15)
    assert rotate(rows, (1.0, 0.0, 0.0)) == pytest.approx((0.0, 1.0, 0.0), abs=1e-15)


@given(QUATERNIONS)
def test_rows_and_back(rotation: Quaternion) -> None:
    """A quaternion survives the way through its matrix, up to its sign."""
    again = quaternion_from_rows(rows_from_quaternion(rotation), "rows", CELL)
    assert all(is_float32(part) for part in again)
    same = sum(a * b for a, b in zip(rotation, again, strict=True))
    assert abs(same) == pytest.approx(1.0, abs=CLOSE)


@given(QUATERNIONS)
def test_rows_are_retails_matrix(rotation: Quaternion) -> None:
    """The matrix that retail caches for the quaternion is the one that was given, row by row."""
    frame = Frame()
    frame.qw, frame.qx, frame.qy, frame.qz = rotation
    frame.cache()
    assert flat(rows_from_quaternion(rotation)) == pytest.approx(
        [getattr(frame, f"m{i}") for i in range(9)], abs=CLOSE
    )


@given(QUATERNIONS, QUATERNIONS, st.tuples(PARTS, PARTS, PARTS))
def test_products_turn_one_after_the_other(
    a: Quaternion, b: Quaternion, vector: tuple[float, float, float]
) -> None:
    """The product of two rotations turns by the second, then by the first."""
    one_by_one = rotate(rows_from_quaternion(a), rotate(rows_from_quaternion(b), vector))
    assert rotate(rows_from_quaternion(multiply(a, b)), vector) == pytest.approx(one_by_one, abs=CLOSE)


@pytest.mark.parametrize(
    ("rows", "path", "found"),
    [
        ([[1.001, 0, 0], [0, 1, 0], [0, 0, 1]], "m[0]", "a row of length 1.001 in cell 0xa9b40151"),
        ([[1, 0, 0], [0, 1, 0], [0, 0, 2]], "m[2]", "a row of length 2 in cell 0xa9b40151"),
        ([[1, 0, 0], [0.6, 0.8, 0], [0, 0, 1]], "m", "rows 0 and 1 with product 0.6 in cell 0xa9b40151"),
        ([[1, 0, 0], [0, 1, 0], [0, 0, -1]], "m", "a mirror image (determinant -1) in cell 0xa9b40151"),
        ([[math.nan, 0, 0], [0, 1, 0], [0, 0, 1]], "m[0]", "a row of length nan in cell 0xa9b40151"),
        ([[1, 0, 0], [0, 1, 0]], "m", "rows of [3, 3] numbers"),
        ([[1, 0, 0], [0, 1, 0], [0, 0]], "m", "rows of [3, 3, 2] numbers"),
    ],
)
def test_matrices_that_are_not_rotations(rows: list[list[float]], path: str, found: str) -> None:
    """Scaled, sheared and mirrored matrices are refused with the cell and the number that is off."""
    with pytest.raises(SceneError) as raised:
        quaternion_from_rows(rows, "m", CELL)
    assert (raised.value.path, raised.value.found) == (path, found)


@pytest.mark.parametrize(("length", "good"), [(1.000009, True), (1.000011, False), (0.999989, False)])
def test_both_sides_of_the_rigid_limit(length: float, good: bool) -> None:
    """A row's length may be off 1 by 1e-5."""
    rows = [[length, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]
    if good:
        assert quaternion_from_rows(rows, "m", CELL) == (1.0, 0.0, 0.0, 0.0)
        return
    with pytest.raises(SceneError, match="no scale"):
        quaternion_from_rows(rows, "m", CELL)
