"""CObjCell::find_cell_list: what is listed, in which order, and which cell contains sphere 0."""

from __future__ import annotations

import pytest
from oracle_land import BLOCK, ids, land, land_id, room
from oracle_worlds import CELL, OTHER_CELL, ScriptedCell, ScriptedWorld, at, transition, vec

from oracle.cell_array import CellArray
from oracle.cell_list import (
    MAX_CYLSPHERES,
    find_cell_list,
    find_cell_list_for_cylspheres,
    find_cell_list_for_path,
    find_cell_list_for_sphere,
)
from oracle.cyl_sphere import CylSphere
from oracle.env_cell import CellPortal, CellStruct
from oracle.frame import Frame
from oracle.obj_cell import ObjCell
from oracle.plane import Plane
from oracle.position import Position
from oracle.ref import Ref
from oracle.sphere import Sphere
from oracle.sphere_path import SpherePath
from oracle.world import World

HERE = land_id(3, 3)
EAST = BLOCK + 0x100
UNTOUCHED = 1


def listed(*cells: ScriptedCell, no_load: int = 0, spheres: int = 1) -> tuple[list[int], int | None]:
    """Return the ids that a search from `CELL` lists, and the id of the containing cell."""
    world = ScriptedWorld(*cells)
    made = transition(world, at(0.0, 0.0, 1.0), at(0.0, 0.0, 1.0))
    array, found = CellArray(), Ref[ObjCell | None](ScriptedCell([], cell_id=UNTOUCHED))
    array.do_not_load_cells = no_load
    path = made.sphere_path
    find_cell_list(world, path.check_pos, spheres, path.global_sphere, array, found, path)
    return ids(array), None if found.value is None else found.value.id


def found_in(world: World, p: int, *centers: tuple[float, float, float]) -> tuple[list[int], int | None, int]:
    """Return the list, the containing cell's id, and hits_interior_cell, for spheres of half a metre."""
    array, path, found = CellArray(), SpherePath(), Ref[ObjCell | None](ScriptedCell([], cell_id=UNTOUCHED))
    spheres = [Sphere(vec(*center), 0.5) for center in centers]
    find_cell_list(world, at(0.0, 0.0, 0.0, p), len(spheres), spheres, array, found, path)
    return ids(array), None if found.value is None else found.value.id, path.hits_interior_cell


class TestFromInside:
    """09 5.1: a search that starts in an interior cell."""

    def test_the_search_goes_on_through_neighbours(self) -> None:
        """09 5.1.5: cells that the loop appends are searched too; the first that contains wins."""
        first, second, third = (ScriptedCell([], cell_id=CELL + i) for i in range(3))
        first.neighbours, second.neighbours = [second], [first, third]
        assert listed(first, second, third) == ([CELL, CELL + 1, CELL + 2], CELL)

    def test_a_starting_cell_that_is_not_loaded_is_listed_alone(self) -> None:
        """09 5.1.4: the containing cell is left as it was; so it is without spheres."""
        assert listed() == ([CELL], UNTOUCHED)
        assert listed(ScriptedCell([]), spheres=0) == ([CELL], UNTOUCHED)

    def test_a_search_begins_anew(self) -> None:
        """09 5.1.1: the list is emptied, and land cells have not been added."""
        cell = ScriptedCell([])
        array = CellArray()
        array.added_outside = 1
        array.add_cell(1, None)
        find_cell_list(ScriptedWorld(cell), at(0.0, 0.0, 0.0), 0, [], array, None, None)
        assert (ids(array), array.added_outside) == ([CELL], 0)

    def test_pruning_keeps_what_is_visible_from_the_start(self) -> None:
        """09 5.1.7: only the start and its stab list stay; the last entry moves into each hole."""
        first = ScriptedCell([])
        others = [ScriptedCell([], cell_id=CELL + i) for i in range(1, 5)]
        first.neighbours = list(others)
        first.stab_list = (CELL + 3, CELL + 4)
        assert listed(first, *others, no_load=1) == ([CELL, CELL + 4, CELL + 3], CELL)

    def test_cells_that_are_not_loaded_are_listed_and_passed_over(self) -> None:
        """09 5.1.5, 09 5.1.6: a null entry is neither searched nor asked for the point."""
        world = World()
        room(world, CELL, CellPortal(OTHER_CELL, 1, Plane(vec(1.0, 0.0, 0.0), 0.0)))
        assert found_in(world, CELL, (0.25, 0.0, 0.0)) == ([CELL, OTHER_CELL], CELL, 1)
        assert found_in(world, CELL, (-0.25, 0.0, 0.0)) == ([CELL, OTHER_CELL], None, 1)

    def test_no_cell_contains_the_sphere(self) -> None:
        """09 5.1.6: the pointer becomes null."""
        world = World()
        room(world, CELL)
        assert found_in(world, CELL, (-0.25, 0.0, 0.0)) == ([CELL], None, 1)

    def test_out_of_a_door(self) -> None:
        """The land cells come last; outside of the room the land cell is the containing one."""
        world = land()
        door = CellPortal(None, 0, Plane(vec(1.0, 0.0, 0.0), 0.0))
        room(world, 0xA9B40140, door, origin=(84.0, 84.0, 0.0))
        assert found_in(world, 0xA9B40140, (84.25, 84.0, 0.0)) == ([0xA9B40140, HERE], 0xA9B40140, 1)
        assert found_in(world, 0xA9B40140, (83.75, 84.0, 0.0)) == ([0xA9B40140, HERE], HERE, 1)


class TestFromOutside:
    """09 5.1: a search that starts on the land."""

    def test_the_land_cell(self) -> None:
        """09 5.1.3: hits_interior_cell is not set."""
        assert found_in(land(), HERE, (84.0, 84.0, 0.0)) == ([HERE], HERE, 0)

    def test_the_last_land_cell_wins(self) -> None:
        """On the border at x = 96 both contain the point: the one to the east is listed later."""
        east = land_id(4, 3)
        assert found_in(land(), HERE, (96.0, 84.0, 0.0)) == ([east, HERE], HERE, 0)
        assert found_in(land(), HERE, (95.75, 84.0, 0.0)) == ([HERE, east], HERE, 0)
        assert found_in(land(), HERE, (72.0, 84.0, 0.0)) == ([HERE, land_id(2, 3)], land_id(2, 3), 0)

    def test_across_the_block_border(self) -> None:
        """09 5.1.6: the point is taken into each cell's own block, 192 metres to the east."""
        world = land(BLOCK, EAST)
        border = [land_id(7, 3), land_id(0, 3, EAST)]
        assert found_in(world, HERE, (191.75, 84.0, 0.0)) == (border, border[0], 0)
        assert found_in(world, HERE, (192.25, 84.0, 0.0)) == (border[::-1], border[1], 0)

    def test_only_sphere_0_is_contained(self) -> None:
        """The others only add cells."""
        east = land_id(4, 3)
        assert found_in(land(), HERE, (84.0, 84.0, 0.0), (100.0, 84.0, 0.0)) == ([HERE, east], HERE, 0)

    @pytest.mark.parametrize("p", [0, 0xA9B40041, land_id(3, 3, EAST)])
    def test_a_start_that_is_not_loaded(self, p: int) -> None:
        """09 5.1.4: what was added stays, the pointer is not touched; an id of no cell adds nothing."""
        cells, new_cell, _ = found_in(land(), p, (84.0, 84.0, 0.0))
        assert new_cell == UNTOUCHED
        assert cells == ([p] if p == land_id(3, 3, EAST) else [])

    def test_an_interior_cell_goes_before_land(self) -> None:
        """09 5.1.6: the first interior cell that contains the point ends the search, and is told."""
        world = land()
        room(world, 0xA9B40140, origin=(84.0, 84.0, 0.0))
        world.landscape.blocks[BLOCK].cells[27].building = doors = Rooms(world, 0xA9B40140)
        assert found_in(world, HERE, (84.25, 84.0, 0.0)) == ([HERE, 0xA9B40140], 0xA9B40140, 1)
        assert doors.paths == 1

    def test_pruning_is_for_interior_starts(self) -> None:
        """09 5.1.7: do_not_load_cells changes nothing outdoors."""
        array = CellArray()
        array.do_not_load_cells = 1
        spheres = [Sphere(vec(95.75, 84.0, 0.0), 0.5)]
        find_cell_list(land(), at(0.0, 0.0, 0.0, HERE), 1, spheres, array, None, None)
        assert ids(array) == [HERE, land_id(4, 3)]

    def test_pruning_drops_the_land(self) -> None:
        """09 5.1.7: from indoors land cells go, which no stab list has; an early stop does not prevent it."""
        world, array, found = land(), CellArray(), Ref[ObjCell | None](None)
        door = CellPortal(None, 0, Plane(vec(1.0, 0.0, 0.0), 0.0))
        room(world, 0xA9B40140, door, origin=(84.0, 84.0, 0.0))
        array.do_not_load_cells = 1
        spheres = [Sphere(vec(84.25, 84.0, 0.0), 0.5)]
        find_cell_list(world, at(0.0, 0.0, 0.0, 0xA9B40140), 1, spheres, array, found, None)
        assert ids(array) == [0xA9B40140]
        assert found.value is world.cells[0xA9B40140]


class Rooms:
    """A building that leads into one room, and counts the paths it is given."""

    def __init__(self, world: World, cell_id: int) -> None:
        self.world, self.cell_id, self.paths = world, cell_id, 0

    def find_building_transit_cells(
        self, p: object, num_sphere: int, spheres: object, array: CellArray, path: SpherePath | None
    ) -> None:
        """Add the room."""
        self.paths += path is not None
        array.add_cell(self.cell_id, self.world.cells[self.cell_id])


class TestOverloads:
    """09 5.2 to 09 5.4: the path's spheres, one sphere, cylinders."""

    def test_of_a_path(self) -> None:
        """The check position and its spheres."""
        world = land()
        end = at(95.75, 84.0, 0.0, HERE)
        made = transition(world, end, end, spheres=((0.0, 0.5),))
        array, found = CellArray(), Ref[ObjCell | None](None)
        find_cell_list_for_path(world, array, found, made.sphere_path)
        assert (ids(array), found.value) == ([HERE, land_id(4, 3)], world.get_visible(HERE))

    def test_of_one_sphere(self) -> None:
        """In the space of the position: turned by 180 degrees, one metre ahead is one metre behind."""
        turned = Position(HERE, Frame.unpack(vec(95.0, 84.0, 0.0), 0.0, 0.0, 0.0, 1.0))
        for x, cells in ((-1.0, [land_id(4, 3), HERE]), (1.0, [HERE])):
            array = CellArray()
            find_cell_list_for_sphere(land(), turned, Sphere(vec(x, 0.0, 0.0), 0.5), array, None)
            assert ids(array) == cells

    def test_of_cylinders(self) -> None:
        """A ball around each low point; the height plays no role."""
        array, path = CellArray(), SpherePath()
        cylinders = [CylSphere(vec(0.0, 0.0, 0.0), 50.0, 0.5), CylSphere(vec(12.0, 0.0, 0.0), 0.1, 0.5)]
        find_cell_list_for_cylspheres(land(), at(84.0, 84.0, 0.0, HERE), cylinders, array, path)
        assert ids(array) == [HERE, land_id(4, 3)]

    def test_ten_cylinders_at_most(self) -> None:
        """The eleventh is not looked at."""
        near, far = CylSphere(vec(0.0, 0.0, 0.0), 1.0, 0.5), CylSphere(vec(24.0, 0.0, 0.0), 1.0, 0.5)
        for before, cells in ((MAX_CYLSPHERES, [HERE]), (MAX_CYLSPHERES - 1, [HERE, land_id(4, 3)])):
            array = CellArray()
            find_cell_list_for_cylspheres(
                land(), at(84.0, 84.0, 0.0, HERE), [near] * before + [far], array, None
            )
            assert ids(array) == cells

    def test_no_cylinders(self) -> None:
        """09 5.4: an outdoor object still gets the cell under its origin."""
        array = CellArray()
        find_cell_list_for_cylspheres(land(), at(84.0, 84.0, 0.0, HERE), [], array, None)
        assert ids(array) == [HERE]


def test_a_cell_without_a_cell_tree_reaches_everything() -> None:
    """Worlds of a single cell need none: it contains every point."""
    world = World()
    room(world, CELL, structure=CellStruct(None, None))
    assert found_in(world, CELL, (-999.0, 0.0, 0.0)) == ([CELL], CELL, 1)
