"""Shapes are placed, turned and merged without surprises."""

from __future__ import annotations

import struct

from conformance.scenes.polygons import flip, merge, place

SQUARE = [((0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (1.0, 1.0, 0.0), (0.0, 1.0, 0.0))]


def test_place_turns_then_moves() -> None:
    """A quarter turn counter-clockwise from above, then the move, both exact."""
    assert place(SQUARE, (10.0, 20.0, 30.0), 90.0) == [
        ((10.0, 20.0, 30.0), (10.0, 21.0, 30.0), (9.0, 21.0, 30.0), (9.0, 20.0, 30.0))
    ]


def test_place_leaves_no_negative_zero() -> None:
    """A turned corner at the origin is still +0, so it merges with its neighbours."""
    for yaw in (0.0, 90.0, 180.0, 270.0, -90.0):
        (corners,) = place(SQUARE, (0.0, 0.0, 0.0), yaw)
        assert struct.pack("<3d", *corners[0]) == bytes(24)


def test_flip_reverses_every_winding() -> None:
    """A flipped polygon has the same corners the other way round."""
    assert flip(SQUARE) == [tuple(reversed(SQUARE[0]))]
    assert flip(flip(SQUARE)) == SQUARE


def test_merge_shares_vertices_of_the_same_bits() -> None:
    """Two squares that share an edge have six vertices; ids follow first use."""
    vertices, polygons = merge([*SQUARE, *place(SQUARE, (1.0, 0.0, 0.0), 0.0)])
    assert len(vertices) == 6
    assert [polygon.vertices for polygon in polygons] == [(0, 1, 2, 3), (1, 4, 5, 2)]


def test_merge_rounds_to_float32_before_comparing() -> None:
    """Corners that differ below float32 become one vertex, the float32 one."""
    near = 0.1 + 1e-12
    vertices, polygons = merge(
        [((0.1, 0.0, 0.0), (1.0, 0.0, 0.0), (near, 1.0, 0.0)), ((near, 0.0, 0.0),) * 3]
    )
    assert vertices[0] == (0.10000000149011612, 0.0, 0.0)
    assert polygons[1].vertices == (0, 0, 0)


def test_merge_keeps_the_sign_of_zero() -> None:
    """-0 and 0 are different bits, so they are different vertices."""
    vertices, _ = merge([((0.0, 0.0, 0.0), (-0.0, 0.0, 0.0), (1.0, 0.0, 0.0))])
    assert [struct.pack("<f", v[0]).hex() for v in vertices] == ["00000000", "00000080", "0000803f"]
