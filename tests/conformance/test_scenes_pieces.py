"""Planes part pieces of polygons without losing or doubling any of their area."""

from __future__ import annotations

import numpy as np
import pytest

from conformance.scenes.bounds import EMPTY_SPHERE, Bounds
from conformance.scenes.pieces import BACK_SIDE, FRONT_SIDE, ON_PLANE, UNUSED, Piece, cut, part
from conformance.scenes.planes import area_vector, plane_of
from conformance.scenes.splitter import Splitter, choose

SQUARE = np.array([[-1.0, -1.0, 0.0], [1.0, -1.0, 0.0], [1.0, 1.0, 0.0], [-1.0, 1.0, 0.0]])
UP = (0.0, 0.0, 1.0, 0.0)
EAST = (1.0, 0.0, 0.0, 0.0)


def moved(points: np.ndarray, x: float = 0.0, z: float = 0.0) -> np.ndarray:
    """Return points moved along x and z."""
    return points + np.array([x, 0.0, z])


def test_cut_keeps_the_area() -> None:
    """The two parts share the cut and have the whole area together."""
    ahead, behind = cut(SQUARE, (1.0, 0.0, 0.0, -0.5))
    assert sorted(map(tuple, ahead.tolist())) == [(0.5, -1, 0), (0.5, 1, 0), (1, -1, 0), (1, 1, 0)]
    assert area_vector(ahead.tolist()) == (0.0, 0.0, 1.0)
    assert area_vector(behind.tolist()) == (0.0, 0.0, 3.0)


def test_cut_through_corners() -> None:
    """Corners on the plane belong to both parts, and nothing is added."""
    half = 0.7071067811865476
    ahead, behind = cut(SQUARE, (half, -half, 0.0, 0.0))
    assert (len(ahead), len(behind)) == (3, 3)


def test_part_by_side() -> None:
    """Pieces in front, behind, across and on a plane go where they are."""
    planes = [UP, UP, UP, EAST]
    upright = SQUARE[:, [2, 0, 1]]
    pieces = [Piece(moved(SQUARE, x=offset), i, UNUSED) for i, offset in enumerate((3.0, -3.0, 0.0))]
    front, back, on_plane = part([*pieces, Piece(upright, 3, UNUSED)], EAST, 3, planes)
    assert [(piece.polygon, piece.side) for piece in front] == [(0, UNUSED), (2, UNUSED), (3, FRONT_SIDE)]
    assert [(piece.polygon, piece.side) for piece in back] == [(1, UNUSED), (2, UNUSED), (3, BACK_SIDE)]
    assert on_plane == (3,)
    assert sum(piece.area() for piece in (*front, *back) if piece.polygon == 2) == 4.0


def test_part_of_a_polygon_that_faces_back() -> None:
    """The front of a polygon that faces against the plane is on the plane's negative side."""
    front, back, _ = part([Piece(SQUARE[::-1], 0, UNUSED)], UP, None, [(0.0, 0.0, -1.0, 0.0)])
    assert [piece.side for piece in front] == [BACK_SIDE]
    assert [piece.side for piece in back] == [FRONT_SIDE]


def test_used_pieces_keep_their_side() -> None:
    """A piece that stands for a polygon's front stays on that side of a second plane in its place."""
    front, back, on_plane = part([Piece(SQUARE, 0, FRONT_SIDE)], UP, None, [UP])
    assert (len(front), len(back), on_plane) == (1, 0, ())


@pytest.mark.parametrize(("height", "on"), [(0.99 * ON_PLANE, True), (1.01 * ON_PLANE, False)])
def test_both_sides_of_the_on_plane_limit(height: float, on: bool) -> None:
    """A piece within 2e-5 m of a plane is on it."""
    _, _, on_plane = part([Piece(moved(SQUARE, z=height), 0, UNUSED)], UP, None, [UP])
    assert on_plane == ((0,) if on else ())


def test_uneven_owner_is_on_its_own_plane() -> None:
    """A polygon whose corners are off its own plane is used up by it all the same."""
    bent = SQUARE + np.array([[0.0, 0.0, 1e-4], [0.0, 0.0, -1e-4], [0.0, 0.0, 1e-4], [0.0, 0.0, -1e-4]])
    _, _, on_plane = part([Piece(bent, 0, UNUSED)], UP, 0, [UP])
    assert on_plane == (0,)


def test_choice_avoids_cuts() -> None:
    """Of two squares, the one whose plane does not cut the other is chosen."""
    upright = moved(SQUARE[:, [2, 0, 1]], z=1.0)
    pieces = [Piece(upright, 0, UNUSED), Piece(SQUARE, 1, UNUSED)]
    planes = [plane_of([tuple(point) for point in piece.points.tolist()]) for piece in pieces]
    assert choose(pieces, planes) == Splitter(planes[1], 1)
    assert choose([piece._replace(side=FRONT_SIDE) for piece in pieces], planes) is None


def test_spheres_are_tight_and_rounded_up() -> None:
    """The sphere of polygons is about their box, and no float32 smaller would hold them."""
    bounds = Bounds([((0.0, 0.0, 0.0), (3.0, 0.0, 0.0), (0.0, 4.0, 0.0)), ((9.0, 0.0, 0.0),) * 4])
    assert bounds.sphere([0]) == (1.5, 2.0, 0.0, float(np.nextafter(np.float32(2.5), np.float32(3.0))))
    assert bounds.sphere([]) == EMPTY_SPHERE
