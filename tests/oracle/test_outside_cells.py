"""CLandCell, the static functions: the land cells that spheres and parts reach, in their order."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest
from hypothesis import given
from hypothesis import strategies as st
from oracle_land import BLOCK, FIRST_X, FIRST_Y, box_part, ids, land, land_id
from oracle_worlds import at, vec

from oracle.arithmetic import f32
from oracle.cell_array import CellArray
from oracle.land_defs import lcoord_to_gid
from oracle.outside_cells import (
    add_all_outside_cells,
    add_all_outside_cells_of_parts,
    add_cell_block,
    add_outside_cell,
    check_add_cell_boundary,
)
from oracle.sphere import Sphere
from oracle.world import World

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from oracle.physics_part import PhysicsPart

    Step = Callable[[float, int], float]

HERE = land_id(3, 3)
"""From (72, 72) to (96, 96)."""
NOWHERE = World()
EAST = BLOCK + 0x100


def cell(i: int, j: int) -> int:
    """Return the id of the cell `i` to the east and `j` to the north of `HERE`, in whatever block."""
    return lcoord_to_gid(FIRST_X + 3 + i, FIRST_Y + 3 + j)


def reached(*spheres: tuple[float, float, float], p: int = HERE, origin: float = 84.0) -> list[int]:
    """Return the cells that spheres (x, y, radius) reach."""
    array = CellArray()
    balls = [Sphere(vec(x, y, 7.0), f32(r)) for x, y, r in spheres]
    add_all_outside_cells(NOWHERE, at(origin, origin, 0.0, p), len(balls), balls, array)
    assert array.added_outside == 1
    return ids(array)


class TestOneCell:
    """09 6.1: add_outside_cell."""

    def test_a_cell_that_is_not_loaded_is_listed(self) -> None:
        """With a cell if its block is loaded, with none otherwise."""
        world, array = land(), CellArray()
        add_outside_cell(world, array, FIRST_X, FIRST_Y)
        add_outside_cell(world, array, FIRST_X - 1, FIRST_Y)
        assert [(e.cell_id, e.cell is not None) for e in array.cells] == [
            (0xA9B40001, True),
            (0xA8B40039, False),
        ]

    @pytest.mark.parametrize(("x", "y"), [(-1, 0), (0, -1), (2040, 0), (0, 2040)])
    def test_beyond_the_land_is_nothing(self, x: int, y: int) -> None:
        """0 to 2039 are on the land."""
        array = CellArray()
        add_outside_cell(NOWHERE, array, x, y)
        assert ids(array) == []
        add_outside_cell(NOWHERE, array, min(max(x, 0), 2039), min(max(y, 0), 2039))
        assert len(ids(array)) == 1


class TestNeighbours:
    """09 6.2: check_add_cell_boundary, with a radius of 0.5: lo 0.5 and hi 23.5."""

    LOW, HIGH = 0.5, 23.5

    def around(self, px: float, py: float) -> list[tuple[int, int]]:
        """Return the neighbours added for a point of the cell, as steps to the east and north."""
        array = CellArray()
        x, y = FIRST_X + 3, FIRST_Y + 3
        check_add_cell_boundary(NOWHERE, array, vec(px, py, 0.0), x, y, self.HIGH, self.LOW)
        steps = {cell(i, j): (i, j) for i in (-1, 0, 1) for j in (-1, 0, 1)}
        return [steps[cell_id] for cell_id in ids(array)]

    def test_all_comparisons_are_strict(self, next32: Step) -> None:
        """At 0.5 and 23.5 nothing is added, one step beyond the neighbour is."""
        low, high = self.LOW, self.HIGH
        assert self.around(low, low) == self.around(high, high) == []
        assert self.around(next32(high, 1), 12.0) == [(1, 0)]
        assert self.around(next32(low, -1), 12.0) == [(-1, 0)]
        assert self.around(12.0, next32(high, 1)) == [(0, 1)]
        assert self.around(12.0, next32(low, -1)) == [(0, -1)]

    @pytest.mark.parametrize(
        ("px", "py", "added"),
        [
            (23.9, 23.9, [(1, 0), (1, 1), (0, 1)]),
            (23.9, 0.1, [(1, 0), (1, -1), (0, -1)]),
            (0.1, 23.9, [(-1, 0), (-1, 1), (0, 1)]),
            (0.1, 0.1, [(-1, 0), (-1, -1), (0, -1)]),
        ],
    )
    def test_corners(self, px: float, py: float, added: list[tuple[int, int]]) -> None:
        """East or west first, then the corner, then north or south; it is the square that counts."""
        assert self.around(px, py) == added


class TestSpheres:
    """09 6.4: add_all_outside_cells of spheres."""

    def test_well_inside(self) -> None:
        """Only the cell itself."""
        assert reached((84.0, 84.0, 0.5)) == [HERE]

    def test_near_the_north_eastern_corner(self) -> None:
        """09 9: (x, y), (x+1, y), (x+1, y+1), (x, y+1)."""
        assert reached((95.8, 95.8, 0.5)) == [HERE, cell(1, 0), cell(1, 1), cell(0, 1)]

    def test_a_sphere_wider_than_the_cell(self) -> None:
        """With a radius of 13 both sides are reached: lo 13, hi 11; never more than one ring."""
        east = [cell(1, 0), cell(1, 1), cell(1, -1)]
        west = [cell(-1, 0), cell(-1, 1), cell(-1, -1)]
        assert reached((84.0, 84.0, 13.0)) == [HERE, *east, *west, cell(0, 1), cell(0, -1)]
        assert set(reached((84.0, 84.0, 50.0))) == set(reached((84.0, 84.0, 13.0)))

    def test_the_edge_of_the_radius_is_float32(self, next32: Step) -> None:
        """In column 0 a radius of 0.1 ends at hi = f32(24 - f32(0.1)), and there it is not reached yet."""
        hi = f32(24.0 - f32(0.1))
        assert reached((hi, 84.0, 0.1)) == [land_id(0, 3)]
        assert reached((next32(hi, 1), 84.0, 0.1)) == [land_id(0, 3), land_id(1, 3)]

    def test_across_a_block_border(self) -> None:
        """At (191.9, 12): the neighbour is the first column of the block to the east."""
        assert reached((191.9, 12.0, 0.5)) == [land_id(7, 0), land_id(0, 0, EAST)]

    def test_a_point_beyond_the_block(self) -> None:
        """A centre at x = 200 is 8 metres into the block to the east, whose cells follow."""
        assert reached((200.0, 12.0, 0.5)) == [land_id(0, 0, EAST)]

    def test_a_point_next_to_the_block_s_edge_snaps(self) -> None:
        """10 2.8: -0.0001 is 0, in this block; from there half a metre reaches the west."""
        assert reached((-0.0001, 12.0, 0.5)) == [land_id(0, 0), land_id(7, 0, BLOCK - 0x100)]

    def test_several_spheres(self) -> None:
        """Each in turn; what is listed is not listed again."""
        assert reached((84.0, 84.0, 0.5), (100.0, 84.0, 0.5), (84.0, 84.0, 0.5)) == [HERE, cell(1, 0)]

    def test_a_sphere_beyond_the_land_ends_it(self) -> None:
        """The third sphere is not looked at any more."""
        first = 0x00000001
        assert reached((5.0, 5.0, 0.5), (-5.0, 5.0, 0.5), (30.0, 5.0, 0.5), p=first) == [first]

    def test_the_edge_of_the_land(self) -> None:
        """Neighbours beyond it do not exist."""
        assert reached((0.1, 0.1, 0.5), p=0x00000001) == [0x00000001]

    def test_without_spheres(self) -> None:
        """09 6.4.3: the cell under the position's origin, unless that is beyond the land."""
        assert reached(p=HERE, origin=130.0) == [land_id(5, 5)]
        assert reached(p=0x00000001, origin=-5.0) == []
        assert reached(p=0xA9B40041) == []

    def test_from_an_interior_cell(self) -> None:
        """The id's block counts, not what kind of cell it is."""
        assert reached((84.0, 84.0, 0.5), p=0xA9B40111) == [HERE]

    def test_only_once(self) -> None:
        """09 6.4.1: added_outside stops both versions."""
        array = CellArray()
        array.added_outside = 1
        add_all_outside_cells(NOWHERE, at(84.0, 84.0, 0.0, HERE), 0, [], array)
        add_all_outside_cells_of_parts(land(), [box_part((84.0, 84.0, 0.0), 1.0)], array)
        assert ids(array) == []

    @given(st.floats(0.0, 191.5, width=32), st.floats(0.0, 191.5, width=32), st.floats(0.0, 12.0, width=32))
    def test_the_first_is_under_the_centre(self, x: float, y: float, radius: float) -> None:
        """And all others border on it."""
        listed = reached((x, y, radius))
        i, j = int(x // 24.0), int(y // 24.0)
        snapped = land_id(i, j)
        assert listed[0] == snapped
        ring = {lcoord_to_gid(FIRST_X + i + k, FIRST_Y + j + m) for k in (-1, 0, 1) for m in (-1, 0, 1)}
        assert set(listed) <= ring


class TestParts:
    """09 6.5: add_all_outside_cells of parts."""

    def listed(self, parts: Sequence[PhysicsPart | None], world: World | None = None) -> list[int]:
        """Return the cells that parts reach in a world with the two blocks of these tests."""
        array = CellArray()
        add_all_outside_cells_of_parts(world or land(BLOCK, EAST), parts, array)
        assert array.added_outside == 1
        return ids(array)

    def test_the_box_of_a_part(self) -> None:
        """A cube from (95, 71) to (97, 73): columns 3 and 4, rows 2 and 3; columns outer, rows inner."""
        assert self.listed([box_part((96.0, 72.0, 0.0), 1.0)]) == [
            cell(0, -1),
            cell(0, 0),
            cell(1, -1),
            cell(1, 0),
        ]

    def test_borders(self, next32: Step) -> None:
        """floor: a box that ends exactly at 96 reaches column 4 (96 / 24 = 4); one step less does not."""
        assert self.listed([box_part((95.0, 84.0, 0.0), 1.0)]) == [cell(0, 0), cell(1, 0)]
        below = next32(95.0, -1)
        assert self.listed([box_part((below, 84.0, 0.0), 1.0)]) == [cell(0, 0)]

    def test_the_own_cell_is_always_inside(self) -> None:
        """The extremes begin at 0: a part that lies to the east of the first one's origin keeps column 3."""
        far = box_part((130.0, 84.0, 0.0), 1.0)
        here = box_part((84.0, 84.0, 0.0), 1.0)
        columns = [cell(0, 0), cell(1, 0), cell(2, 0)]
        assert self.listed([None, here, far]) == columns

    def test_the_first_part_says_which_block(self) -> None:
        """The boxes are taken into its cell's block: x = 200 of the western block is 8 of the eastern."""
        first = box_part((4.0, 84.0, 0.0), 1.0, cell_id=land_id(0, 3, EAST))
        second = box_part((191.0, 84.0, 0.0), 0.5, cell_id=HERE)
        assert self.listed([first, second]) == [land_id(7, 3), land_id(0, 3, EAST)]

    def test_the_origin_is_adjusted(self) -> None:
        """A part of the western block whose origin is beyond it: the reference is the eastern cell."""
        assert self.listed([box_part((196.0, 84.0, 0.0), 1.0)]) == [land_id(0, 3, EAST)]

    def test_flat_parts(self) -> None:
        """Always2D: the sphere around the stored origin, 95.5 + 0.6 reaches column 4, the cube would not."""
        part = box_part((95.5, 84.0, 0.0), 0.25, radius=f32(0.6))
        assert self.listed([part]) == [cell(0, 0)]
        part.degrade_modes = (2,)
        assert self.listed([part]) == [cell(0, 0), cell(1, 0)]
        part.degrade_modes = (1, 2)
        assert self.listed([part]) == [cell(0, 0)]

    def test_a_flat_part_without_a_sphere(self) -> None:
        """It is where its origin is."""
        part = box_part((95.5, 84.0, 0.0), 5.0)
        part.degrade_modes = (3,)
        assert part.gfxobj is not None
        part.gfxobj.drawing_sphere = None
        assert self.listed([part]) == [cell(0, 0)]

    def test_nothing_to_go_by(self) -> None:
        """09 6.5.1, 09 6.5.2: no parts, only missing ones, no loaded cell, or none on the land."""
        assert self.listed([]) == self.listed([None]) == []
        assert self.listed([box_part((84.0, 84.0, 0.0), 1.0)], NOWHERE) == []
        assert self.listed([box_part((-5.0, 84.0, 0.0), 1.0, cell_id=0x00000001)]) == []

    def test_a_part_without_a_box(self) -> None:
        """It cannot be registered: the error says so."""
        part = box_part((84.0, 84.0, 0.0), 1.0)
        part.gfxobj = None
        with pytest.raises(ValueError, match="bounding box"):
            self.listed([part])

    def test_the_rectangle(self) -> None:
        """09 6.5.5: both ends included, what is beyond the land left out."""
        array = CellArray()
        add_cell_block(NOWHERE, array, -1, 2038, 1, 2040)
        wanted = [(0, 2038), (0, 2039), (1, 2038), (1, 2039)]
        assert ids(array) == [lcoord_to_gid(x, y) for x, y in wanted]
