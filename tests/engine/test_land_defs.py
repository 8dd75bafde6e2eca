"""LandDefs: ids, land coordinates and points, both sides of every limit of document 10."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from engine import layout as at
from engine.constants import EPS
from engine.kernels.land_defs import (
    adjust_to_outside,
    block_coordinates,
    get_outside_lcoord,
    gid_to_lcoord,
    in_bounds,
    inbound_valid_cellid,
    lcoord_to_gid,
    outside_cell,
)

HOLTBURG = 0xA9B4
"""A block: x is 0xA9 = 169, y is 0xB4 = 180, so that its land coordinates begin at 1352, 1440."""
BELOW_EPS = float(np.nextafter(np.float32(EPS), np.float32(0.0)))
"""The float32 next to EPS, towards 0."""


def test_a_block_begins_at_eight_times_its_bytes() -> None:
    """Also where that is beyond the land, as for the block 255."""
    assert block_coordinates(HOLTBURG << 16) == (1352, 1440)
    assert block_coordinates(0xFFFF_0001) == (2040, 2040)


@pytest.mark.parametrize(("x", "y", "inside"), [(0, 0, 1), (2039, 2039, 1), (2040, 0, 0), (0, -1, 0)])
def test_the_land_is_2040_cells_wide(x: int, y: int, inside: int) -> None:
    """Coordinates count from 0."""
    assert in_bounds(x, y) == bool(inside)


@pytest.mark.parametrize(
    ("low", "valid"),
    [(0, 0), (1, 1), (0x40, 1), (0x41, 0), (0xFF, 0), (0x100, 1), (0xFFFD, 1), (0xFFFE, 0), (0xFFFF, 1)],
)
def test_which_low_words_name_something(low: int, valid: int) -> None:
    """Land cells, environment cells and the block itself; not the block's info."""
    assert inbound_valid_cellid(HOLTBURG << 16 | low) == bool(valid)


@pytest.mark.parametrize(("block", "valid"), [(0xFE00, 1), (0xFF00, 0), (0x00FE, 1), (0x00FF, 0)])
def test_block_255_is_not_on_the_land(block: int, valid: int) -> None:
    """Neither in x nor in y."""
    assert inbound_valid_cellid(block << 16 | 1) == bool(valid)


def test_cells_are_counted_column_by_column() -> None:
    """0x12 is the eighteenth cell: two columns of eight, and one more to the north."""
    assert gid_to_lcoord(HOLTBURG << 16 | 0x12) == (True, 1354, 1441)
    assert lcoord_to_gid(1354, 1441) == HOLTBURG << 16 | 0x12
    assert lcoord_to_gid(2040, 0) == 0


@pytest.mark.parametrize("low", [0, 0x41, 0x100, 0xFFFF])
def test_only_land_cells_have_land_coordinates(low: int) -> None:
    """An environment cell has none, and neither has a block."""
    assert not gid_to_lcoord(HOLTBURG << 16 | low)[0]


@settings(deadline=None)  # the first call compiles
@given(st.integers(0, 2039), st.integers(0, 2039))
def test_ids_and_land_coordinates_are_inverse(x: int, y: int) -> None:
    """Every cell of the land has one id."""
    assert gid_to_lcoord(lcoord_to_gid(x, y)) == (True, x, y)


def test_a_point_lies_in_the_cell_of_its_24_metres() -> None:
    """23.999 is in the first cell, 24 in the second, -0.5 in the block to the west."""
    cell = HOLTBURG << 16 | 1
    assert get_outside_lcoord(cell, 23.999, 24.0) == (True, 1352, 1441)
    assert get_outside_lcoord(cell, -0.5, 0.0) == (True, 1351, 1440)
    assert get_outside_lcoord(0x0001, -0.5, 0.0) == (False, -1, 0)
    assert get_outside_lcoord(HOLTBURG << 16, 0.0, 0.0)[0] is False


def test_a_point_beyond_the_block_comes_to_its_neighbour() -> None:
    """200 = 192 + 8 is 8 metres into the block to the east, its cell 0: 0xAAB4, low word 1."""
    assert outside_cell(HOLTBURG << 16 | 0x39, 200.0, 5.0) == (0xAAB4_0001, 8.0, 5.0)
    assert outside_cell(HOLTBURG << 16 | 0x100, -1.0, 191.0) == (0xA8B4_0040, 191.0, 191.0)


@pytest.mark.parametrize(("x", "snapped"), [(BELOW_EPS, 0.0), (EPS, EPS), (-BELOW_EPS, 0.0)])
def test_next_to_the_origin_a_point_snaps_to_it(x: float, snapped: float) -> None:
    """Closer than EPS, not at EPS; and so it does not slip into the block to the west."""
    assert outside_cell(HOLTBURG << 16 | 1, x, 100.0) == (HOLTBURG << 16 | 5, snapped, 100.0)


def test_just_beyond_that_it_is_in_the_next_block() -> None:
    """-EPS is 192 - EPS of the block to the west, which float32 rounds to 191.9998."""
    cell, x, _ = outside_cell(HOLTBURG << 16 | 1, -EPS, 100.0)
    assert (cell, x) == (0xA8B4_003D, float(np.float32(192.0 - EPS)))


def test_off_the_land_there_is_no_cell() -> None:
    """The point is snapped all the same, unless the id names nothing."""
    assert outside_cell(0x0001, -1.0, BELOW_EPS) == (0, -1.0, 0.0)
    assert outside_cell(HOLTBURG << 16 | 0x50, BELOW_EPS, 1.0) == (0, BELOW_EPS, 1.0)


def test_a_position_is_adjusted_in_place() -> None:
    """Cell id, x and y; z is not looked at."""
    position = np.zeros(at.POSITION_SIZE)
    position[0] = 0xA9B4_0001
    position[at.ORIGIN :] = (10.0, 193.0, 77.0)
    adjust_to_outside(position, 0)
    assert position[0] == 0xA9B5_0001
    assert position[at.ORIGIN :].tolist() == [10.0, 1.0, 77.0]
