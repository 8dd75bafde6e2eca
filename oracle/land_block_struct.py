"""CLandBlockStruct: the terrain of a landblock, its triangles, its land cells and its water."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from oracle.arithmetic import f32
from oracle.constants import BLOCK_EDGE, CELL_EDGE, HALF_CELL_EDGE
from oracle.enums import WaterType
from oracle.frame import Frame
from oracle.land_cell import LandCell
from oracle.land_defs import SIDE_CELLS, lcoord_to_gid
from oracle.polygon import Polygon
from oracle.position import Position
from oracle.vector import Vector3

if TYPE_CHECKING:
    from collections.abc import Sequence

    from oracle.world import World

SIDE_VERTICES: Final = 9
"""Vertices along an edge of a landblock (10 1)."""
DRY_DEPTH: Final = 0.1
"""Water depth at a solid corner, a double; metres (10 6.5)."""
CORNER_DEPTH: Final = 0.44999998807907104
"""Water depth at a corner of water, float32 of 0.45; metres (10 6.5)."""
_WATER_SURFACES: Final = range(16, 21)
"""Terrain types whose surface is water: running, standing, shallow and deep (10 6.1)."""
_TWO_TO_MINUS_32: Final = 2.3283064365386963e-10
"""What turns an unsigned 32-bit number into a fraction (10 3.3)."""


def cuts_sw_to_ne(gx: int, gy: int) -> bool:
    """Tell how a land cell, by its coordinates on the land, is cut into triangles (10 3.3)."""
    h = (gy * (214614067 * gx + 1813693831) - 1109124029 * gx - 1369149221) & 0xFFFFFFFF
    return h * _TWO_TO_MINUS_32 >= 0.5


class LandBlockStruct:
    """The terrain of a landblock at full detail.

    Attributes
    ----------
    block_id : int
        Its id, low word `WHOLE_BLOCK`.
    height : tuple of int
        81 indices into the height table, at 9 * i + j: i from west to east, j from south to north.
    terrain : tuple of int
        81 terrain words in the same order.
    land_height_table : sequence of float
        Vertex heights, metres (Land_Height_Table).
    side_cell_count : int
        8; retail makes it less for a block far from the viewer, which then takes no part in collisions.
    vertices : list of Vector3
        81 corners, block coordinates, metres.
    polygons : list of Polygon
        Cell 8 * i + j has those at twice its index and at the next.
    cells : list of LandCell
        64, at 8 * i + j.
    water_type : WaterType
        Whether all of its cells are water, or some.
    """

    def __init__(
        self,
        world: World,
        block_id: int,
        height: Sequence[int],
        terrain: Sequence[int],
        land_height_table: Sequence[float],
    ) -> None:
        self.world = world
        self.block_id = block_id
        self.height = tuple(height)
        self.terrain = tuple(terrain)
        self.land_height_table = land_height_table
        self.side_cell_count = SIDE_CELLS
        self.vertices = [Vector3() for _ in range(SIDE_VERTICES * SIDE_VERTICES)]
        self.polygons: list[Polygon] = []
        self.cells: list[LandCell] = []
        self.water_type = WaterType.NOT_WATER

    def generate(self) -> None:
        """Make terrain and water; again after heights have changed, then the cells stay the same.

        Texture coordinates, which retail makes the first time, do not collide.

        retail: CLandBlockStruct::generate 0x00532BB0, 10 3.5.
        """
        self.construct_vertices()
        if self.polygons:
            for polygon in self.polygons:
                polygon.make_plane()
        else:
            self.construct_polygons()
        self.calc_water()

    def construct_vertices(self) -> None:
        """Place the corners of the cells.

        retail: CLandBlockStruct::ConstructVertices 0x005328D0, 10 3.2.
        """
        ps = f32(BLOCK_EDGE / SIDE_CELLS)
        for i in range(SIDE_VERTICES):
            for j in range(SIDE_VERTICES):
                index = SIDE_VERTICES * i + j
                z = self.land_height_table[self.height[index]]
                self.vertices[index].assign(Vector3(f32(i * ps), f32(j * ps), z))

    def construct_polygons(self) -> None:
        """Cut each cell into two triangles, and make the cells.

        retail: CLandBlockStruct::ConstructPolygons 0x00531D10, 10 3.3.
        """
        block_x = (self.block_id >> 21) & 0x7F8
        block_y = 8 * ((self.block_id >> 16) & 0xFF)
        for i in range(SIDE_CELLS):
            for j in range(SIDE_CELLS):
                gx, gy = i + block_x, j + block_y
                sw, se = SIDE_VERTICES * i + j, SIDE_VERTICES * (i + 1) + j
                nw, ne = sw + 1, se + 1
                cut = cuts_sw_to_ne(gx, gy)
                corners = ((sw, se, ne), (sw, ne, nw)) if cut else ((sw, se, nw), (ne, nw, se))
                pair = (self.add_polygon(*corners[0]), self.add_polygon(*corners[1]))
                frame = Frame()
                frame.origin.x = f32((2 * i + 1) * HALF_CELL_EDGE)
                frame.origin.y = f32((2 * j + 1) * HALF_CELL_EDGE)
                cell_id = lcoord_to_gid(gx, gy)
                cell = LandCell(cell_id, Position(cell_id, frame), self.world, self, pair)
                cell.sw_to_ne_cut = int(cut)
                self.cells.append(cell)

    def add_polygon(self, first: int, second: int, third: int) -> Polygon:
        """Make the next triangle, of three vertices; its surface number is the texture's.

        retail: CLandBlockStruct::AddPolygon 0x005310D0, 10 3.4.
        """
        corners = (self.vertices[first], self.vertices[second], self.vertices[third])
        polygon = Polygon(corners, len(self.polygons))
        self.polygons.append(polygon)
        return polygon

    def calc_water(self) -> None:
        """Tell every cell, and the block, how much of it is water.

        retail: CLandBlockStruct::CalcWater 0x005327E0, 10 6.3.
        """
        self.water_type = WaterType.NOT_WATER
        if self.side_cell_count != SIDE_CELLS:
            return
        some, all_ = 0, 1
        for i in range(SIDE_CELLS):
            for j in range(SIDE_CELLS):
                cell = self.cells[SIDE_CELLS * i + j]
                has_water, all_water = self.calc_cell_water(i, j)
                if not has_water:
                    cell.water_type = WaterType.NOT_WATER
                elif all_water:
                    cell.water_type = WaterType.ENTIRELY_WATER
                else:
                    cell.water_type = WaterType.PARTIALLY_WATER
                some |= has_water
                all_ &= all_water
        if some:
            self.water_type = WaterType.ENTIRELY_WATER if all_ else WaterType.PARTIALLY_WATER

    def calc_cell_water(self, i: int, j: int) -> tuple[int, int]:
        """Return whether any corner of a cell is water, and whether all are.

        retail: CLandBlockStruct::CalcCellWater 0x00531550, 10 6.2.
        """
        corners = [self._is_water(i + di, j + dj) for di in (0, 1) for dj in (0, 1)]
        return int(any(corners)), int(all(corners))

    def calc_water_depth(self, cell_id: int, point: Vector3) -> float:
        """Return the depth at the corner nearest to a point (block coordinates), metres, in a register.

        Exactly in the middle the western and southern corners count as nearer.

        retail: CLandBlockStruct::calc_water_depth 0x005315F0, 10 6.5.
        """
        # 10 6.5.1
        low = cell_id & 0xFFFF
        cx, cy = (low - 1) >> 3, (low - 1) & 7
        # 10 6.5.2
        di = int(point.x > cx * CELL_EDGE + HALF_CELL_EDGE)
        dj = int(point.y > cy * CELL_EDGE + HALF_CELL_EDGE)
        # 10 6.5.3, 10 6.5.4
        return CORNER_DEPTH if self._is_water(cx + di, cy + dj) else DRY_DEPTH

    def _is_water(self, i: int, j: int) -> bool:
        """Tell whether the surface at a vertex is water: TERRAIN_SURF_CHAR of its type (10 6.1, 10 3.1)."""
        return ((self.terrain[SIDE_VERTICES * i + j] & 0xFF) >> 2) & 0x1F in _WATER_SURFACES
