"""Landblocks: how they are cut, their triangles and planes, their water."""

from __future__ import annotations

import numpy as np
import pytest

from engine import LandBlock, World, WorldError
from engine import layout as at
from engine.compiling.terrain import split_cuts, triangles, water_of
from engine.constants import DEEP_WATER, ENTIRELY_WATER, NOT_WATER, PARTIALLY_WATER, SHALLOW_WATER, WET_LAND
from engine.kernels.land_cells import find_terrain_poly, water_depth

FLAT = [10.0] * 81
SEA = 16 << 2
"""A terrain word of running water."""
NOT_QUITE_SEA = 15 << 2
BEYOND_SEA = 21 << 2


def vertex(i: int, j: int) -> int:
    """Return the index of the i-th vertex from the west, j-th from the south."""
    return 9 * i + j


def test_the_cut_of_a_cell_depends_on_where_it_is() -> None:
    """H = y*(214614067*x + 1813693831) - 1109124029*x - 1369149221, modulo 2**32, of the first cells.

    (0, 0): 2925818075; (1, 0): 1816694046; (0, 1): 444544610; (1, 1): 3845001944. From 2**31 =
    2147483648 on, the cut runs from the south-west to the north-east.
    """
    cuts = split_cuts(0x0000)
    assert cuts[:2, :2].tolist() == [[True, False], [False, True]]


def test_blocks_are_cut_as_parts_of_one_land() -> None:
    """The block 0x0100 begins at x = 8: h(8, 0) = -(1109124029 * 8 + 1369149221) mod 2**32 = 2642760139."""
    assert split_cuts(0x0100)[0, 0] == (2642760139 >= 1 << 31)


def test_flat_ground_has_level_planes() -> None:
    """Normal up, d minus the height, for both triangles of all cells."""
    records = triangles(0x0000, FLAT)
    assert records.shape == (8, 8, 2, at.TERRAIN_POLYGON)
    assert (records[..., :4] == (0.0, 0.0, 1.0, -10.0)).all()


def test_triangles_name_their_corners_in_retails_order() -> None:
    """Cell (0, 0) is cut to the north-east, cell (1, 0) to the north-west."""
    corners = triangles(0x0000, FLAT)[..., at.POLYGON_CORNERS :][..., : 3 * at.CORNER_SIZE]
    records = corners.reshape(8, 8, 2, 3, at.CORNER_SIZE)[..., :2]
    sw, se, ne, nw = (0, 0), (24, 0), (24, 24), (0, 24)
    assert records[0, 0].tolist() == np.array([[sw, se, ne], [sw, ne, nw]], dtype=float).tolist()
    east = np.add([[sw, se, nw], [ne, nw, se]], (24.0, 0.0))
    assert records[1, 0].tolist() == east.tolist()


def test_a_slope_has_a_leaning_plane() -> None:
    """24 metres up in 24 metres east: the edges' product is (-576, 0, 576), of length 814.587.

    Its inverse is a register for x, and a stored float32 for z (MP-5); so z is 0.7071068286895752 where
    the mathematical normal has 0.7071067690849304, as x.
    """
    heights = [24.0 * i for i in range(9) for _ in range(9)]
    planes = triangles(0x0000, heights)[..., :4]
    assert (planes[..., :3] == (-0.7071067690849304, 0.0, 0.7071068286895752)).all()


@pytest.mark.parametrize(("word", "water"), [(NOT_QUITE_SEA, 0), (SEA, 2), (20 << 2 | 3, 2), (BEYOND_SEA, 0)])
def test_terrain_types_16_to_20_are_water(word: int, water: int) -> None:
    """Bits 2 to 6 of the word count; roads do not."""
    found = water_of([word] * 81)
    assert found.block == water
    assert (found.cells == water).all()


def test_one_wet_corner_makes_a_shore_of_four_cells() -> None:
    """Vertex (1, 1) is the north-east corner of cell (0, 0), and so on about it."""
    words = [0] * 81
    words[vertex(1, 1)] = SEA
    water = water_of(words)
    assert water.block == PARTIALLY_WATER
    assert (water.cells[:2, :2] == PARTIALLY_WATER).all()
    assert (water.cells == PARTIALLY_WATER).sum() == 4
    assert water.corners[:2, :2].tolist() == [[8, 4], [2, 1]]


def test_a_block_is_sea_only_if_every_cell_is() -> None:
    """One dry corner is enough for a shore."""
    words = [SEA] * 81
    words[vertex(8, 8)] = 0
    water = water_of(words)
    assert water.block == PARTIALLY_WATER
    assert (water.cells == ENTIRELY_WATER).sum() == 63
    assert water_of([0] * 81).block == NOT_WATER


def world_with(terrain: list[int] | None = None) -> World:
    """Return a world of the land's first block, flat."""
    return World(landblocks=[LandBlock(0x0000, FLAT, terrain)])


@pytest.mark.parametrize(
    ("cell", "x", "y", "triangle"),
    [
        (0, 6.0, 3.0, 0),
        (0, 3.0, 6.0, 1),
        (0, 5.0, 5.0, 0),
        (0, 24.0, 6.0, 0),
        (8, 24.0, 6.0, 0),
        (0, 24.001, 6.0, None),
        (0, -0.001, 0.0, None),
    ],
)
def test_the_ground_under_a_point(cell: int, x: float, y: float, triangle: int | None) -> None:
    """South of the cut polygon 0, north of it 1; on the cut 0; a border belongs to both cells."""
    world = world_with()
    found = find_terrain_poly(world.floats, world.ints, cell, x, y)
    if triangle is None:
        assert found == at.NO_POLYGON
    else:
        assert world.floats[found + at.POLYGON_ID] == triangle


@pytest.mark.parametrize(
    ("x", "y", "depth"),
    [
        (12.0, 12.0, WET_LAND),
        (12.001, 12.0, WET_LAND),
        (12.0, 12.001, SHALLOW_WATER),
        (12.001, 12.001, WET_LAND),
        (24.0, 24.0, WET_LAND),
        (0.0, 24.0, SHALLOW_WATER),
    ],
)
def test_a_shore_is_as_deep_as_its_nearest_corner(x: float, y: float, depth: float) -> None:
    """The north-west corner of cell 0 is wet; the middle itself belongs to the west and south."""
    words = [0] * 81
    words[vertex(0, 1)] = SEA
    world = world_with(words)
    assert water_depth(world.floats, world.ints, 0, x, y) == depth


def test_the_middle_is_counted_from_the_blocks_origin() -> None:
    """In cell (1, 2) the middle is at 36, 60; its wet south-east corner is the vertex (2, 2)."""
    words = [0] * 81
    words[vertex(2, 2)] = SEA
    world = world_with(words)
    cell = 8 * 1 + 2
    assert water_depth(world.floats, world.ints, cell, 36.001, 60.0) == SHALLOW_WATER
    assert water_depth(world.floats, world.ints, cell, 36.0, 60.0) == WET_LAND


def test_dry_cells_and_deep_ones() -> None:
    """Neither depends on the point."""
    sea, land = world_with([SEA] * 81), world_with()
    assert water_depth(sea.floats, sea.ints, 63, 180.0, 180.0) == DEEP_WATER
    assert water_depth(land.floats, land.ints, 63, 180.0, 180.0) == 0.0


WRONG: list[tuple[list[LandBlock], str]] = [
    ([LandBlock(0x10000, FLAT)], "landblock 0: 0x10000 is not the id of a landblock"),
    ([LandBlock(0xFF00, FLAT)], "landblock 0: 0xff00 is not the id of a landblock"),
    ([LandBlock(0x00FF, FLAT)], "landblock 0: 0xff is not the id of a landblock"),
    ([LandBlock(0, FLAT)] * 2, "landblock 1: id 0x0000 is used twice"),
    ([LandBlock(0, FLAT[1:])], "landblock 0x0000, heights: shape (80,) where (81,) is needed"),
    ([LandBlock(0, FLAT, [0] * 80)], "landblock 0x0000, terrain: not 81 whole numbers"),
]


@pytest.mark.parametrize(("blocks", "message"), WRONG)
def test_wrong_landblocks_are_refused(blocks: list[LandBlock], message: str) -> None:
    """The error names the block."""
    with pytest.raises(WorldError) as caught:
        World(landblocks=blocks)
    assert str(caught.value) == message
