"""LScape and CLandBlock: finding land cells by their ids, and giving buildings to them."""

from __future__ import annotations

import pytest
from oracle_land import BLOCK, land, land_cell, land_id
from oracle_worlds import at

from oracle.building import BuildingObj
from oracle.world import World

NORTH = BLOCK + 1


def house(world: World, x: float, y: float, block: int = BLOCK) -> BuildingObj:
    """Return a building whose pose names the whole block."""
    return BuildingObj(at(x, y, 10.0, block << 16 | 0xFFFF), None, (), world)


@pytest.mark.parametrize(
    ("low", "column", "row"), [(0x01, 0, 0), (0x02, 0, 1), (0x09, 1, 0), (0x1C, 3, 3), (0x40, 7, 7)]
)
def test_a_land_cell_by_its_id(low: int, column: int, row: int) -> None:
    """10 4.2: at 8 * column + row of its block."""
    world = land()
    block = world.landscape.blocks[BLOCK]
    assert world.get_visible(BLOCK << 16 | low) is block.cells[8 * column + row]


@pytest.mark.parametrize("low", [0x0000, 0x0041, 0x00FF, 0x0100, 0xFFFE, 0xFFFF])
def test_other_ids_have_no_land_cell(low: int) -> None:
    """10 4.1: what is not a land cell's id, the block itself included."""
    world = land()
    assert world.landscape.get_landblock(BLOCK << 16 | low) is None
    assert world.landscape.get_landcell(BLOCK << 16 | low) is None


def test_a_block_must_be_loaded_with_full_detail() -> None:
    """10 4.1: neither an unknown block nor one with fewer cells is returned."""
    world = land()
    assert world.get_visible(land_id(0, 0, NORTH)) is None
    world.landscape.blocks[BLOCK].side_cell_count = 4
    assert world.get_visible(land_id(0, 0)) is None


def test_cell_0_is_nothing() -> None:
    """09 2: an empty world has no cells, and id 0 never has."""
    assert World().get_visible(0) is None
    assert land().get_visible(0) is None


def test_a_block_knows_only_its_own_cells() -> None:
    """10 4.3: the same place in another block has another id."""
    block = land(BLOCK, NORTH).landscape.blocks[BLOCK]
    assert block.get_landcell(land_id(2, 5)) is block.cells[21]
    assert block.get_landcell(land_id(2, 5, NORTH)) is None
    assert block.cell_at(land_id(2, 5, NORTH)) is block.cells[21]
    assert block.get_landcell(0) is None
    assert repr(block) == "LandBlock(0xa9b4ffff)"


class TestBuildings:
    """09 3.7: the land cell that contains a building's origin holds it."""

    def test_the_cell_under_the_origin(self) -> None:
        """84 / 24 = 3.5 and 30 / 24 = 1.25: column 3, row 1."""
        world = land()
        building = house(world, 84.0, 30.0)
        world.landscape.blocks[BLOCK].init_buildings([building])
        assert land_cell(world, 3, 1).building is building
        assert [c.building for c in world.landscape.blocks[BLOCK].cells].count(None) == 63

    def test_the_first_of_two_wins(self) -> None:
        """09 3.6: a land cell has one building at most."""
        world = land()
        first, second = house(world, 73.0, 73.0), house(world, 95.0, 95.0)
        world.landscape.blocks[BLOCK].init_buildings([first, second])
        assert land_cell(world).building is first

    @pytest.mark.parametrize(("x", "y"), [(84.0, 192.0), (-0.5, 84.0)])
    def test_without_a_cell_of_the_block_it_is_dropped(self, x: float, y: float) -> None:
        """An origin in another block, though that is loaded too."""
        world = land(BLOCK, NORTH)
        world.landscape.blocks[BLOCK].init_buildings([house(world, x, y)])
        cells = [*world.landscape.blocks[BLOCK].cells, *world.landscape.blocks[NORTH].cells]
        assert {cell.building for cell in cells} == {None}

    def test_beyond_the_land_it_is_dropped(self) -> None:
        """There is no land cell west of block 0."""
        world = land(0)
        world.landscape.blocks[0].init_buildings([house(world, -1.0, 5.0, 0)])
        assert {cell.building for cell in world.landscape.blocks[0].cells} == {None}
