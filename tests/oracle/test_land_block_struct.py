"""CLandBlockStruct: vertices, the split of cells, water types and water depths."""

from __future__ import annotations

from math import sqrt
from typing import TYPE_CHECKING

import pytest
from hypothesis import given
from hypothesis import strategies as st
from oracle_land import DRY, FIRST_X, FIRST_Y, VERTICES, WATER, land_block, land_id
from oracle_worlds import vec, xyz

from oracle.arithmetic import f32
from oracle.enums import WaterType
from oracle.land_block_struct import CORNER_DEPTH, DRY_DEPTH, cuts_sw_to_ne
from oracle.polygon import Polygon
from oracle.world import World

if TYPE_CHECKING:
    from collections.abc import Callable

    from oracle.land_block import LandBlock

    Step = Callable[[float, int], float]

NOT, PARTLY, ENTIRELY = WaterType.NOT_WATER, WaterType.PARTIALLY_WATER, WaterType.ENTIRELY_WATER
SIGN_BIT = 1 << 31
WORD = 1 << 32


def hash_of(gx: int, gy: int) -> int:
    """Return the number whose top bit decides the cut (10 3.3)."""
    return (gy * (214614067 * gx + 1813693831) - 1109124029 * gx - 1369149221) % WORD


def row_with(h: int) -> int:
    """Return the row in column 0 whose number is `h`: gy = (h + 1369149221) / 1813693831 (mod 2^32)."""
    return (h + 1369149221) * pow(1813693831, -1, WORD) % WORD


def wet(*vertices: tuple[int, int]) -> list[int]:
    """Return terrain that is water at these vertices only."""
    words = [DRY] * VERTICES
    for i, j in vertices:
        words[9 * i + j] = WATER
    return words


def water_types(block: LandBlock) -> set[WaterType]:
    """Return the types that occur among the cells."""
    return {cell.water_type for cell in block.cells}


class TestSplit:
    """10 3.3: the direction of a cell's diagonal."""

    @pytest.mark.parametrize(
        ("gx", "gy", "cut"),
        [
            (0, 0, True),  # -1369149221 = 2925818075, not less than 2147483648
            (1, 0, False),  # -1109124029 - 1369149221 = 1816694046
            (0, 1, False),  # 1813693831 - 1369149221 = 444544610
            (1, 1, True),  # 214614067 + 1813693831 - 1109124029 - 1369149221 = 3845001944
        ],
    )
    def test_by_hand(self, gx: int, gy: int, cut: bool) -> None:
        """The first cells of the land."""
        assert cuts_sw_to_ne(gx, gy) is cut

    @pytest.mark.parametrize(
        ("h", "cut"),
        [(SIGN_BIT - 1, False), (SIGN_BIT, True), (SIGN_BIT + 0x21, True), (0, False), (WORD - 1, True)],
    )
    def test_the_top_bit_alone_decides(self, h: int, cut: bool) -> None:
        """Half is cut from south-west; the numbers up to 0x80000021 are where a decimal constant errs."""
        assert hash_of(0, row_with(h)) == h
        assert cuts_sw_to_ne(0, row_with(h)) is cut

    def test_the_cell_nearest_to_half(self) -> None:
        """No cell of the land is nearer than (657, 1857), whose number is 440 away."""
        assert abs(hash_of(657, 1857) - SIGN_BIT) == 440

    @given(st.integers(0, 2039), st.integers(0, 2039))
    def test_products_wrap_around(self, gx: int, gy: int) -> None:
        """Python's unbounded product and a 32-bit one have the same top bit."""
        factor = (214614067 * gx + 1813693831) % WORD
        wrapped = (gy * factor % WORD - 1109124029 * gx % WORD - 1369149221) % WORD
        assert cuts_sw_to_ne(gx, gy) == (wrapped >= SIGN_BIT)


class TestTerrain:
    """10 3.2 to 10 3.5: vertices, triangles, cells."""

    def test_vertices(self) -> None:
        """Every 24 metres; the height is looked up in the table by the height's index."""
        block = land_block(World(), heights=[float(k) for k in range(VERTICES)])
        assert xyz(block.vertices[0]) == (0.0, 0.0, 0.0)
        assert xyz(block.vertices[9 * 2 + 5]) == (48.0, 120.0, 23.0)
        assert xyz(block.vertices[80]) == (192.0, 192.0, 80.0)

    def test_triangles_of_each_cut(self) -> None:
        """SW-NE: SW SE NE and SW NE NW; NW-SE: SW SE NW and NE NW SE; the ids are 2 * (8 * i + j) + k."""
        block = land_block(World())
        seen = set()
        for k, cell in enumerate(block.cells):
            i, j = divmod(k, 8)
            sw, se, ne, nw = (
                (24.0 * x, 24.0 * y) for x, y in ((i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1))
            )
            cut = cuts_sw_to_ne(FIRST_X + i, FIRST_Y + j)
            wanted = [[sw, se, ne], [sw, ne, nw]] if cut else [[sw, se, nw], [ne, nw, se]]
            assert [[(v.x, v.y) for v in p.vertices] for p in cell.polygons] == wanted
            assert [p.poly_id for p in cell.polygons] == [2 * k, 2 * k + 1]
            assert cell.sw_to_ne_cut == int(cut)
            seen.add(cut)
        assert seen == {True, False}

    def test_planes_face_up(self) -> None:
        """A slope of 1 in 24 to the east through the origin: the normal is (-1, 0, 24) / sqrt(577)."""
        block = land_block(World(), heights=[float(k // 9) for k in range(VERTICES)])
        for polygon in block.polygons:
            n = polygon.plane.N
            assert n.x == pytest.approx(-1.0 / sqrt(577.0), abs=1e-7)
            assert n.y == 0.0
            assert n.z == pytest.approx(24.0 / sqrt(577.0), abs=1e-7)
            assert polygon.plane.d == pytest.approx(0.0, abs=1e-5)

    def test_cells(self) -> None:
        """Each has its id, and an identity pose at its centre, at height 0: ((2i+1)*12, (2j+1)*12)."""
        block = land_block(World())
        assert len(block.cells) == 64
        cell = block.cells[8 * 3 + 5]
        assert cell.id == cell.pos.objcell_id == land_id(3, 5)
        assert xyz(cell.pos.frame.origin) == (84.0, 132.0, 0.0)
        assert (cell.pos.frame.m0, cell.pos.frame.m4, cell.pos.frame.m8) == (1.0, 1.0, 1.0)

    def test_a_block_beyond_the_land_has_cells_without_id(self) -> None:
        """10 3.3: lcoord_to_gid of what is out of bounds."""
        assert {cell.id for cell in land_block(World(), 0xFF00).cells} == {0}

    def test_new_heights_keep_the_cells(self) -> None:
        """10 3.5: the second time planes and water are made anew, polygons and cells stay."""
        block = land_block(World())
        cells, polygons = list(block.cells), list(block.polygons)
        block.land_height_table = [0.0] * VERTICES
        block.terrain = (WATER,) * VERTICES
        block.generate()
        assert block.cells == cells
        assert block.polygons == polygons
        assert {polygon.plane.d for polygon in block.polygons} == {0.0}
        assert block.water_type == ENTIRELY

    def test_a_plane_is_the_polygon_s_own(self) -> None:
        """10 3.4: make_plane of the three vertices, bit for bit."""
        heights = [f32(37.0 + (k * 37 % 11) * 0.37) for k in range(VERTICES)]
        for polygon in land_block(World(), heights=heights).polygons[:32]:
            again = Polygon([v.copy() for v in polygon.vertices]).plane
            assert (xyz(again.N), again.d) == (xyz(polygon.plane.N), polygon.plane.d)


class TestWaterTypes:
    """10 6.1 to 10 6.3."""

    @pytest.mark.parametrize(
        ("terrain_type", "water"), [(0, NOT), (15, NOT), (16, PARTLY), (20, PARTLY), (21, NOT), (31, NOT)]
    )
    @pytest.mark.parametrize("around", [0x0000, 0x0003, 0xFF80])
    def test_types_16_to_20_are_water(self, terrain_type: int, water: WaterType, around: int) -> None:
        """Bits 2 to 6 of the word; road and scene bits do not matter."""
        words = [DRY] * VERTICES
        words[0] = terrain_type << 2 | around
        assert land_block(World(), terrain=words).cells[0].water_type == water

    def test_all_corners_or_some(self) -> None:
        """Three corners of water make a cell partly water, four entirely, and its neighbours partly."""
        three = land_block(World(), terrain=wet((2, 2), (3, 2), (2, 3)))
        four = land_block(World(), terrain=wet((2, 2), (3, 2), (2, 3), (3, 3)))
        assert (three.cells[18].water_type, four.cells[18].water_type) == (PARTLY, ENTIRELY)
        assert four.cells[18 + 1].water_type == four.cells[18 + 8].water_type == PARTLY
        assert (four.cells[18 + 2].water_type, four.water_type) == (NOT, PARTLY)

    def test_of_a_block(self) -> None:
        """None of its cells has water, every cell is all water, or anything else."""
        assert land_block(World()).water_type == NOT
        assert land_block(World(), terrain=[WATER] * VERTICES).water_type == ENTIRELY
        almost = [WATER] * (VERTICES - 1) + [DRY]
        block = land_block(World(), terrain=almost)
        assert (block.water_type, water_types(block)) == (PARTLY, {PARTLY, ENTIRELY})

    def test_a_block_far_away(self) -> None:
        """10 6.3: without full detail the block has no water, and its cells keep what they had."""
        block = land_block(World(), terrain=[WATER] * VERTICES)
        block.side_cell_count = 4
        block.calc_water()
        assert (block.water_type, water_types(block)) == (NOT, {ENTIRELY})


class TestWaterDepth:
    """10 6.5: cell (3, 3), from (72, 72) to (96, 96), its middle at (84, 84)."""

    @pytest.mark.parametrize("corner", [(3, 3), (4, 3), (3, 4), (4, 4)])
    def test_the_nearest_corner_counts(self, corner: tuple[int, int], next32: Step) -> None:
        """Exactly in the middle it is the western and southern one; one step further the other."""
        block = land_block(World(), terrain=wet(corner))
        beyond = next32(84.0, 1)
        for di, x in ((0, 72.0), (0, 84.0), (1, beyond), (1, 96.0)):
            for dj, y in ((0, 72.0), (0, 84.0), (1, beyond), (1, 96.0)):
                depth = block.calc_water_depth(land_id(3, 3), vec(x, y, 0.0))
                assert depth == (CORNER_DEPTH if corner == (3 + di, 3 + dj) else DRY_DEPTH)

    def test_the_depths(self) -> None:
        """0.1 is a double until the caller stores it; 0.45 is a float32."""
        assert DRY_DEPTH == 0.1 != f32(DRY_DEPTH)
        assert f32(0.45) == CORNER_DEPTH
