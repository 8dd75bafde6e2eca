"""CEnvCell, transit of parts: which neighbours an object that is registered reaches."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest
from oracle_land import BLOCK, box_part, ids, land, land_id, room
from oracle_worlds import CELL, OTHER_CELL, at, vec

from oracle.arithmetic import f32
from oracle.cell_array import CellArray
from oracle.constants import EPS
from oracle.env_cell import CellPortal, CellStruct
from oracle.physics_part import PhysicsPart
from oracle.plane import Plane
from oracle.sphere import Sphere
from oracle.world import World

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    Step = Callable[[float, int], float]

RADIUS = 0.5
REACH = f32(RADIUS + EPS)
"""A radius with its tolerance, as stored."""
OUTDOORS = land_id(0, 0)
"""The land cell that a part at (5, 5) is in."""


def wall(x: float = 0.0) -> Plane:
    """Return the plane at `x`, facing east."""
    return Plane(vec(1.0, 0.0, 0.0), -x)


def leaving(
    world: World, portal: CellPortal, *parts: PhysicsPart | None, structure: CellStruct | None = None
) -> list[tuple[int, bool]]:
    """Return what a cell with one portal adds for parts, and whether it is loaded."""
    one, array = room(world, CELL, portal, structure=structure), CellArray()
    one.find_transit_cells_of_parts(parts, array)
    return [(entry.cell_id, entry.cell is not None) for entry in array.cells]


def cube(x: float, half: float = RADIUS, *, radius: float | None = None) -> PhysicsPart:
    """Return a cube in the cell's block, at (x, 5, 0)."""
    return box_part((x, 5.0, 0.0), half, radius=radius, cell_id=CELL)


class TestParts:
    """09 4.3: find_transit_cells of parts; the inside is x > 0 for side 0, x < 0 for side 1."""

    @pytest.mark.parametrize(("side", "inward"), [(0, 1.0), (1, -1.0)])
    def test_up_to_radius_and_eps_the_sphere_may_reach_out(
        self, side: int, inward: float, next32: Step
    ) -> None:
        """09 4.3.4: the sum is rounded; at it the part is looked at, one step further in it is not.

        The box is larger than the sphere and crosses the plane, so the sphere alone decides.
        """
        portal = CellPortal(OTHER_CELL, side, wall())
        looked_at, passed_over = inward * REACH, inward * next32(REACH, 1)
        assert leaving(World(), portal, cube(looked_at, 2.0, radius=RADIUS)) == [(OTHER_CELL, False)]
        assert leaving(World(), portal, cube(passed_over, 2.0, radius=RADIUS)) == []

    @pytest.mark.parametrize(("side", "inward"), [(0, 1.0), (1, -1.0)])
    def test_a_box_all_on_the_inside_stays(self, side: int, inward: float) -> None:
        """09 4.3.5: the sphere reaches out, the box ends 0.1 before the plane; all outside it leaves."""
        portal = CellPortal(OTHER_CELL, side, wall())
        assert leaving(World(), portal, cube(inward * 0.6, radius=1.0)) == []
        assert leaving(World(), portal, cube(inward * 0.4, radius=1.0)) == [(OTHER_CELL, False)]
        assert leaving(World(), portal, cube(inward * -0.6, radius=1.0)) == [(OTHER_CELL, False)]

    def test_the_exterior(self) -> None:
        """09 4.3.6: land cells by the parts' boxes, once, after the neighbours."""
        world = land()
        one = room(
            world,
            CELL,
            CellPortal(None, 0, wall()),
            CellPortal(OTHER_CELL, 0, wall()),
            CellPortal(None, 0, wall()),
        )
        array = CellArray()
        one.find_transit_cells_of_parts([cube(0.25)], array)
        assert ids(array) == [OTHER_CELL, land_id(7, 0, BLOCK - 0x100), OUTDOORS]
        assert array.added_outside == 1

    @pytest.mark.parametrize(("x", "entered"), [(-0.4, True), (-0.6, False)])
    def test_a_loaded_neighbour_by_its_cell_tree(self, x: float, entered: bool) -> None:
        """09 4.3.8: the box, taken into the neighbour's space, must reach into it: x >= 0 there."""
        world = World()
        room(world, OTHER_CELL)
        portal = CellPortal(OTHER_CELL, 0, wall())
        assert leaving(world, portal, cube(x)) == ([(OTHER_CELL, True)] if entered else [])

    def test_a_neighbour_without_a_cell_tree(self) -> None:
        """It holds everything."""
        world = World()
        room(world, OTHER_CELL, structure=CellStruct(None, None))
        assert leaving(world, CellPortal(OTHER_CELL, 0, wall()), cube(-9.0)) == [(OTHER_CELL, True)]

    def test_the_next_part_is_tried(self) -> None:
        """Missing, without spheres, inside, outside but not in the other cell; then one that enters."""
        world = World()
        room(world, OTHER_CELL)
        bare = cube(0.0)
        assert bare.gfxobj is not None
        bare.gfxobj.drawing_sphere = None
        empty = PhysicsPart(None, at(0.0, 0.0, 0.0), vec(1.0, 1.0, 1.0))
        parts: Sequence[PhysicsPart | None] = [None, empty, bare, cube(9.0), cube(-9.0), cube(0.25)]
        portal = CellPortal(OTHER_CELL, 0, wall())
        assert leaving(world, portal, *parts[:-1]) == []
        assert leaving(world, portal, *parts) == [(OTHER_CELL, True)]

    def test_the_physics_sphere_goes_before_the_drawing_sphere(self) -> None:
        """09 4.3.1: a small physics sphere keeps the part inside."""
        part = cube(0.6, 2.0, radius=RADIUS * 2.0)
        portal = CellPortal(OTHER_CELL, 0, wall())
        assert leaving(World(), portal, part) == [(OTHER_CELL, False)]
        assert part.gfxobj is not None
        part.gfxobj.physics_sphere = Sphere(vec(0.0, 0.0, 0.0), RADIUS)
        assert leaving(World(), portal, part) == []

    def test_a_part_in_another_block(self) -> None:
        """09 4.3.2: positions are made good across blocks, unlike spheres of 09 4.4."""
        part = box_part((0.25 - 192.0, 5.0, 0.0), RADIUS, cell_id=land_id(0, 0, BLOCK + 0x100))
        assert leaving(World(), CellPortal(OTHER_CELL, 0, wall()), part) == [(OTHER_CELL, False)]

    def test_a_cell_without_portals(self) -> None:
        """Nothing to leave through."""
        one, array = room(World(), CELL), CellArray()
        one.portals = None
        one.find_transit_cells_of_parts([cube(0.0)], array)
        assert ids(array) == []


class TestBuildingTransitOfParts:
    """09 4.5: check_building_transit of parts; the signs are opposite to 09 4.3."""

    def entered(
        self, side: int, *parts: PhysicsPart | None, portal_id: int = 0, structure: CellStruct | None = None
    ) -> list[int]:
        """Return what is listed for parts outside of a cell with one portal to a cell not loaded."""
        portal = CellPortal(OTHER_CELL, side, wall())
        one = room(World(), CELL, portal, structure=structure or CellStruct(None, None))
        array = CellArray()
        one.check_building_transit_of_parts(portal_id, parts, array)
        return ids(array)

    @pytest.mark.parametrize(("side", "inward"), [(0, 1.0), (1, -1.0)])
    def test_the_sphere_must_reach_in(self, side: int, inward: float, next32: Step) -> None:
        """09 4.5.1: at radius and EPS outside it is looked at, one step further out it is not."""
        near, far = -inward * REACH, -inward * next32(REACH, 1)
        assert self.entered(side, cube(near, 2.0, radius=RADIUS)) == [CELL, OTHER_CELL]
        assert self.entered(side, cube(far, 2.0, radius=RADIUS)) == []

    @pytest.mark.parametrize(("side", "inward"), [(0, 1.0), (1, -1.0)])
    def test_the_box_must_cross_or_be_inside(self, side: int, inward: float) -> None:
        """09 4.5.2: all outside by 0.1 it is passed over; crossing or all inside it enters."""
        assert self.entered(side, cube(inward * -0.6, radius=1.0)) == []
        assert self.entered(side, cube(inward * -0.4, radius=1.0)) == [CELL, OTHER_CELL]
        assert self.entered(side, cube(inward * 0.6, radius=0.7)) == [CELL]

    def test_the_box_must_reach_the_cell(self) -> None:
        """09 4.5.3: with the portal 5 metres before the cell, a cube in it crosses the plane only."""
        world, array = World(), CellArray()
        one = room(world, CELL, CellPortal(OTHER_CELL, 0, wall(-5.0)))
        one.check_building_transit_of_parts(0, [cube(-4.9)], array)
        assert ids(array) == []
        one.check_building_transit_of_parts(0, [cube(-4.9), cube(0.25)], array)
        assert ids(array) == [CELL, OTHER_CELL]

    def test_it_goes_on_through_the_cell_s_own_portals(self) -> None:
        """09 4.5.3: the neighbours of the cell that was entered are listed at once."""
        assert self.entered(0, cube(0.25)) == [CELL, OTHER_CELL]

    def test_parts_that_cannot_enter(self) -> None:
        """A missing one, and one without spheres; then none is left."""
        bare = cube(0.0)
        bare.gfxobj = None
        assert self.entered(0, None, bare) == []
        assert self.entered(0, None, bare, cube(0.25)) == [CELL, OTHER_CELL]

    def test_no_way_in(self) -> None:
        """09 4.5: a negative portal id; and a cell without a portal array has no portal to ask."""
        assert self.entered(0, cube(0.25), portal_id=-1) == []
        one, array = room(World(), CELL), CellArray()
        one.portals = None
        one.check_building_transit_of_parts(0, [cube(0.25)], array)
        assert ids(array) == []
