"""The pieces of polygons inside one region of space, and how a plane parts them."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final, NamedTuple, TypeAlias

import numpy as np
import numpy.typing as npt

from conformance.scenes.algebra import dot, length
from conformance.scenes.planes import area_vector

if TYPE_CHECKING:
    from collections.abc import Sequence

    from conformance.scenes.model import PlaneData

Floats: TypeAlias = npt.NDArray[np.float64]

ON_PLANE: Final = 2e-5
"""A piece is on a plane when it leaves it by at most this, metres: above the rounding of float32
coordinates and normals in a landblock (192 m: 1.5e-5), far below what a mover can notice (EPS, 2e-4)."""

FRONT_SIDE: Final = 1
BACK_SIDE: Final = -1
UNUSED: Final = 0
"""Side of a piece whose polygon has not been on a splitting plane yet."""


class Piece(NamedTuple):
    """A piece of a polygon.

    Attributes
    ----------
    points : ndarray of float64, shape (n, 3)
        Corners, metres.
    polygon : int
        The polygon it is a piece of. A polygon has two pieces at most in one region: one for each side.
    side : int
        `UNUSED`; or, once its polygon was on a splitting plane, the side of the polygon that the piece
        stands for.
    """

    points: Floats
    polygon: int
    side: int

    def area(self) -> float:
        """Return its area, square metres."""
        return length(area_vector([(x, y, z) for x, y, z in self.points.tolist()]))


class Parting(NamedTuple):
    """What a plane leaves in front, behind, and (polygon ids, rising) newly on itself."""

    front: list[Piece]
    back: list[Piece]
    on_plane: tuple[int, ...]


def extent(pieces: Sequence[Piece], planes: Floats) -> tuple[Floats, Floats]:
    """Return how far each piece reaches behind and in front of each plane.

    Parameters
    ----------
    pieces : sequence of Piece
        At least one.
    planes : ndarray of float64, shape (p, 4)
        Unit normal and offset of each plane.

    Returns
    -------
    lowest, highest : ndarray of float64, shape (len(pieces), p)
        Smallest and largest signed distance of a piece's corners, metres.
    """
    points = np.concatenate([piece.points for piece in pieces])
    ends = np.cumsum([len(piece.points) for piece in pieces])
    starts = np.concatenate(([0], ends[:-1]))
    x, y, z = (points[:, axis, np.newaxis] for axis in range(3))
    # Written out: a matrix product may round differently from one machine to another.
    distances = x * planes[:, 0] + y * planes[:, 1] + z * planes[:, 2] + planes[:, 3]
    return np.minimum.reduceat(distances, starts), np.maximum.reduceat(distances, starts)


def part(
    pieces: Sequence[Piece],
    plane: PlaneData,
    owner: int | None,
    normals: Sequence[PlaneData],
) -> Parting:
    """Part pieces by a plane.

    Parameters
    ----------
    pieces : sequence of Piece
        At least one.
    plane : PlaneData
        The splitting plane.
    owner : int or None
        The polygon whose plane it is; it is on the plane however uneven it is.
    normals : sequence of PlaneData
        The plane of every polygon.

    Returns
    -------
    Parting
        A polygon that is used up has a piece on both sides: its front on one, its back on the other.
    """
    lowest, highest = extent(pieces, np.array([plane]))
    parting = Parting([], [], ())
    used = []
    for piece, low, high in zip(pieces, lowest[:, 0], highest[:, 0], strict=True):
        own = piece.side == UNUSED and piece.polygon == owner
        if own or max(-low, high) <= ON_PLANE:
            if piece.side == UNUSED:
                used.append(piece.polygon)
            facing = dot(normals[piece.polygon][:3], plane[:3])
            for side in (FRONT_SIDE, BACK_SIDE) if piece.side == UNUSED else (piece.side,):
                target = parting.front if side * facing >= 0.0 else parting.back
                target.append(piece._replace(side=side))
        elif low >= -ON_PLANE:
            parting.front.append(piece)
        elif high <= ON_PLANE:
            parting.back.append(piece)
        else:
            ahead, behind = cut(piece.points, plane)
            parting.front.append(piece._replace(points=ahead))
            parting.back.append(piece._replace(points=behind))
    return parting._replace(on_plane=tuple(sorted(used)))


def cut(points: Floats, plane: PlaneData) -> tuple[Floats, Floats]:
    """Cut a convex piece that reaches more than `ON_PLANE` to both sides of a plane.

    Returns
    -------
    ahead, behind : ndarray of float64, shape (n, 3)
        The two parts; they share the two points on the plane.
    """
    distances = points[:, 0] * plane[0] + points[:, 1] * plane[1] + points[:, 2] * plane[2] + plane[3]
    ahead: list[Floats] = []
    behind: list[Floats] = []
    last, last_distance = points[-1], distances[-1]
    for point, distance in zip(points, distances, strict=True):
        if min(last_distance, distance) < -ON_PLANE and max(last_distance, distance) > ON_PLANE:
            crossing = last + (last_distance / (last_distance - distance)) * (point - last)
            ahead.append(crossing)
            behind.append(crossing)
        if distance >= -ON_PLANE:
            ahead.append(point)
        if distance <= ON_PLANE:
            behind.append(point)
        last, last_distance = point, distance
    return np.array(ahead), np.array(behind)
