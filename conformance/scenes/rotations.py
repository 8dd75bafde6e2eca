"""Rotations: from angles and matrices to the quaternions that frames hold."""

from __future__ import annotations

import math
from array import array
from typing import TYPE_CHECKING, Final, TypeAlias

from conformance.scenes.algebra import cos_sin, cross, dot, length, subtract
from conformance.scenes.errors import SceneError

if TYPE_CHECKING:
    from collections.abc import Sequence

    from conformance.scenes.model import Quaternion, Vec3

Rows: TypeAlias = "tuple[Vec3, Vec3, Vec3]"
"""A rotation matrix; row i is where the local axis i points (retail's m, row major)."""

RIGID: Final = 1e-5
"""How far lengths and products of a rotation's rows may be off, a pure number: numbers written with six
digits pass, a scale that moves a point by a tenth of a millimetre at 10 m does not."""


def yaw_quaternion(degrees: float) -> Quaternion:
    """Return the float32 quaternion of a turn about z, counter-clockwise seen from above."""
    c, s = cos_sin(degrees / 2.0)
    return round_quaternion((c, 0.0, 0.0, s))


def round_quaternion(rotation: Sequence[float]) -> Quaternion:
    """Normalise a quaternion in float64 and round it to float32, without negative zeros."""
    size = math.sqrt(sum(part * part for part in rotation))
    w, x, y, z = array("f", (part / size + 0.0 for part in rotation))
    return (w, x, y, z)


def multiply(a: Quaternion, b: Quaternion) -> Quaternion:
    """Return the quaternion of "first b, then a", float64, not normalised."""
    aw, ax, ay, az = a
    bw, bx, by, bz = b
    return (
        aw * bw - ax * bx - ay * by - az * bz,
        aw * bx + ax * bw + ay * bz - az * by,
        aw * by - ax * bz + ay * bw + az * bx,
        aw * bz + ax * by - ay * bx + az * bw,
    )


def rows_from_quaternion(rotation: Quaternion) -> Rows:
    """Return the matrix of a quaternion, float64; its length does not matter."""
    w, x, y, z = rotation
    n = 2.0 / (w * w + x * x + y * y + z * z)
    return (
        (1.0 - n * (y * y + z * z), n * (x * y + w * z), n * (x * z - w * y)),
        (n * (x * y - w * z), 1.0 - n * (x * x + z * z), n * (y * z + w * x)),
        (n * (x * z + w * y), n * (y * z - w * x), 1.0 - n * (x * x + y * y)),
    )


def rotate(rows: Rows, vector: Vec3) -> Vec3:
    """Return a local vector in the frame that the rows are given in, float64."""
    x, y, z = vector
    a, b, c = rows
    return (
        a[0] * x + b[0] * y + c[0] * z,
        a[1] * x + b[1] * y + c[1] * z,
        a[2] * x + b[2] * y + c[2] * z,
    )


def quaternion_from_rows(rows: Sequence[Sequence[float]], path: str, cell: int) -> Quaternion:
    """Return the float32 quaternion of a rotation matrix.

    Parameters
    ----------
    rows : sequence of 3 sequences of 3 floats
        Row i is where the local axis i points: ``world = local * rows`` with row vectors.
    path : str
        Of the matrix.
    cell : int
        Id of the cell that the pose is for, named in errors.

    Raises
    ------
    SceneError
        The matrix is scaled, sheared or mirrored, or not of finite numbers; with the number that is off.
    """
    if len(rows) != 3 or any(len(row) != 3 for row in rows):
        raise SceneError(path, f"rows of {[len(row) for row in rows]} numbers", "3 rows of 3 numbers")
    x, y, z = ((row[0], row[1], row[2]) for row in rows)
    _check_rigid((x, y, z), path, f"in cell {cell:#010x}")
    return round_quaternion(_largest_first((x, y, z)))


def _check_rigid(rows: Rows, path: str, where: str) -> None:
    for i, row in enumerate(rows):
        if not abs(length(row) - 1.0) <= RIGID:
            found = f"a row of length {length(row):.9g} {where}"
            raise SceneError(f"{path}[{i}]", found, f"length 1 within {RIGID:g} (no scale)")
    for i, k in ((0, 1), (0, 2), (1, 2)):
        product = dot(rows[i], rows[k])
        if abs(product) > RIGID:
            found = f"rows {i} and {k} with product {product:.9g} {where}"
            raise SceneError(path, found, f"right angles, 0 within {RIGID:g} (no shear)")
    if length(subtract(cross(rows[0], rows[1]), rows[2])) > 1.0:
        raise SceneError(path, f"a mirror image (determinant -1) {where}", "a rotation, determinant 1")


def _largest_first(rows: Rows) -> Quaternion:
    """Return the quaternion of a rotation, computed from its largest component."""
    (xx, xy, xz), (yx, yy, yz), (zx, zy, zz) = rows
    squares = (1.0 + xx + yy + zz, 1.0 + xx - yy - zz, 1.0 - xx + yy - zz, 1.0 - xx - yy + zz)
    columns: tuple[Quaternion, ...] = (
        (squares[0], yz - zy, zx - xz, xy - yx),
        (yz - zy, squares[1], xy + yx, zx + xz),
        (zx - xz, xy + yx, squares[2], yz + zy),
        (xy - yx, zx + xz, yz + zy, squares[3]),
    )
    return columns[squares.index(max(squares))]
