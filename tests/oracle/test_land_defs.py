"""LandDefs: ids and coordinates of land cells, the height table, and what is within a block."""

from __future__ import annotations

import json
import math
from typing import TYPE_CHECKING, Any

import pytest
from hypothesis import given
from hypothesis import strategies as st
from oracle_land import BLOCK, FIRST_X, FIRST_Y, land_id
from oracle_worlds import at, vec, xyz
from shipped_vectors import VECTORS

from oracle import land_defs
from oracle.land_defs import HEIGHT_TABLE_SIZE, LAND_WIDTH, MAX_HEIGHT

if TYPE_CHECKING:
    from collections.abc import Callable

    Step = Callable[[float, int], float]


def shipped(op: str) -> list[dict[str, Any]]:
    """Return the shipped records of an operation."""
    lines = (VECTORS / "terrain.jsonl").read_text(encoding="utf-8").splitlines()
    found = [record for record in map(json.loads, lines) if record["op"] == op]
    assert found
    return found


@pytest.mark.parametrize(
    ("low", "valid"),
    [
        (0x0000, False),
        (0x0001, True),
        (0x0040, True),
        (0x0041, False),
        (0x00FF, False),
        (0x0100, True),
        (0xFFFD, True),
        (0xFFFE, False),
        (0xFFFF, True),
    ],
)
def test_low_words_of_cells(low: int, valid: bool) -> None:
    """10 1 and 10 2.3: land cells, interior cells and whole blocks; not the landblock's info."""
    assert land_defs.inbound_valid_cellid(BLOCK << 16 | low) == valid


@pytest.mark.parametrize(
    ("block", "valid"), [(0x0000, True), (0xFEFE, True), (0xFFFE, False), (0xFEFF, False), (0xFF00, False)]
)
def test_blocks_of_the_land(block: int, valid: bool) -> None:
    """10 2.3: block 255 is beyond the land in x, and in y too."""
    assert land_defs.inbound_valid_cellid(block << 16 | 1) == valid


@pytest.mark.parametrize(
    ("low", "column", "row"), [(0x01, 0, 0), (0x08, 0, 7), (0x09, 1, 0), (0x1C, 3, 3), (0x40, 7, 7)]
)
def test_cells_are_numbered_column_by_column(low: int, column: int, row: int) -> None:
    """10 2.4 and 10 2.5: (low - 1) >> 3 columns to the east, (low - 1) & 7 rows to the north."""
    x, y = FIRST_X + column, FIRST_Y + row
    assert land_defs.gid_to_lcoord(BLOCK << 16 | low) == (1, x, y)
    assert land_defs.lcoord_to_gid(x, y) == BLOCK << 16 | low


@pytest.mark.parametrize("low", [0x0000, 0x0041, 0x0100, 0xFFFD, 0xFFFF])
def test_what_is_not_a_land_cell_has_no_coordinates(low: int) -> None:
    """10 2.4.1: interior cells and whole blocks neither, although they are valid ids."""
    assert land_defs.gid_to_lcoord(BLOCK << 16 | low) == (0, 0, 0)


def test_the_corners_of_the_land() -> None:
    """10 2.2 to 10 2.5: 0 to 2039 both ways."""
    assert land_defs.gid_to_lcoord(0x00000001) == (1, 0, 0)
    assert land_defs.gid_to_lcoord(0xFEFE0040) == (1, 2039, 2039)
    assert land_defs.gid_to_lcoord(0xFFFE0001)[0] == 0
    assert land_defs.lcoord_to_gid(2039, 2039) == 0xFEFE0040
    for beyond in ((-1, 0), (0, -1), (2040, 0), (0, 2040)):
        assert not land_defs.in_bounds(*beyond)
        assert land_defs.lcoord_to_gid(*beyond) == 0


@given(st.integers(0, LAND_WIDTH - 1), st.integers(0, LAND_WIDTH - 1))
def test_an_id_and_its_coordinates_are_one_and_the_same(x: int, y: int) -> None:
    """10 2.4 undoes 10 2.5."""
    cell_id = land_defs.lcoord_to_gid(x, y)
    assert land_defs.inbound_valid_cellid(cell_id)
    assert land_defs.gid_to_lcoord(cell_id) == (1, x, y)


@pytest.mark.parametrize(
    "record",
    shipped("landdefs_gid_to_lcoord") + shipped("landdefs_inbound_valid_cellid"),
    ids=lambda r: r["id"],
)
def test_shipped_ids(record: dict[str, Any]) -> None:
    """10 2.3 and 10 2.4, as retail answered."""
    expect = record["expect"]
    if record["op"] == "landdefs_inbound_valid_cellid":
        assert land_defs.inbound_valid_cellid(record["cell"]) == bool(expect["r"])
    else:
        ok, x, y = land_defs.gid_to_lcoord(record["cell"])
        assert ok == expect["r"]
        assert not ok or (x, y) == (expect["x"], expect["y"])


def test_blocks_of_coordinates() -> None:
    """10 2.1: the first cell of the block, whatever the low word; 0 is no block, 255 not on the land."""
    assert land_defs.blockid_to_lcoord(0xA9B4FFFF) == (1, FIRST_X, FIRST_Y)
    assert land_defs.blockid_to_lcoord(0) == (0, 0, 0)
    assert land_defs.blockid_to_lcoord(0x00FF0001) == (0, 0, 2040)


@pytest.mark.parametrize(
    ("cell_from", "cell_to", "offset"),
    [
        (0xA9B40001, 0xA9B40112, (0.0, 0.0, 0.0)),
        (0xA9B40001, 0xAAB40001, (192.0, 0.0, 0.0)),
        (0xAAB40112, 0xA9B30112, (-192.0, -192.0, 0.0)),
        (0x00000000, 0x0001FFFF, (0.0, 192.0, 0.0)),
        (0x00010000, 0xFFFF0000, (255 * 192.0, 254 * 192.0, 0.0)),
    ],
)
def test_the_way_from_block_to_block(cell_from: int, cell_to: int, offset: tuple[float, ...]) -> None:
    """10 2.6: 192 metres a block, also to blocks beyond the land; interior ids count like any other."""
    assert xyz(land_defs.get_block_offset(cell_from, cell_to)) == offset


def test_within_a_block(next32: Step) -> None:
    """10 2.9: the southern and western limits are inside, 192 less the radius is not."""
    radius, limit = 0.5, 191.5
    inside = next32(limit, -1)
    assert land_defs.within_block(vec(radius, radius, 0.0), radius)
    assert land_defs.within_block(vec(inside, inside, 999.0), radius)
    below = next32(radius, -1)
    for x, y in ((below, 1.0), (1.0, below), (limit, 1.0), (1.0, limit)):
        assert not land_defs.within_block(vec(x, y, 0.0), radius)


class TestHeightTable:
    """10 1: 256 heights from 0 to 800 metres."""

    def test_the_limits_are_heights(self) -> None:
        """0 (of either sign) and 800 are accepted."""
        table = [-1.0] * HEIGHT_TABLE_SIZE
        values = [0.0, -0.0, MAX_HEIGHT] + [1.0] * (HEIGHT_TABLE_SIZE - 3)
        assert land_defs.set_height_table(table, values) == 1
        assert table == values

    @pytest.mark.parametrize("bad", ["below", "above", "nan"])
    def test_the_first_bad_value_ends_it(self, bad: str, next32: Step) -> None:
        """What follows is not looked at; what came before is in the table."""
        value = {"below": next32(0.0, -1), "above": next32(MAX_HEIGHT, 1), "nan": math.nan}[bad]
        table = [-1.0] * HEIGHT_TABLE_SIZE
        values = [5.0, 6.0, value] + [7.0] * (HEIGHT_TABLE_SIZE - 3)
        assert land_defs.set_height_table(table, values) == 0
        assert table == [5.0, 6.0] + [-1.0] * (HEIGHT_TABLE_SIZE - 2)


def test_the_land_cell_of_a_position() -> None:
    """10 2.10: the cell under the origin, whatever the id says of the block; nothing changes."""
    position = at(200.0, -1.0, 5.0, 0xA9B40112)
    assert position.get_outside_cell_id() == land_id(0, 7, 0xAAB3)
    assert (position.objcell_id, xyz(position.frame.origin)) == (0xA9B40112, (200.0, -1.0, 5.0))
    assert at(-1.0, 0.0, 0.0, 0x00000001).get_outside_cell_id() == 0
    assert at(1.0, 0.0, 0.0, 0xA9B40041).get_outside_cell_id() == 0
