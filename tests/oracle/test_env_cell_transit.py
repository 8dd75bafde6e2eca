"""CEnvCell, transit of spheres: which neighbours a mover reaches, and how it enters a building."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest
from oracle_land import BLOCK, ids, land, land_id, room
from oracle_worlds import CELL, OTHER_CELL, at, vec

from oracle.arithmetic import f32
from oracle.cell_array import CellArray
from oracle.constants import CELL_SLACK, EPS
from oracle.env_cell import CellPortal, CellStruct
from oracle.frame import Frame
from oracle.plane import Plane
from oracle.sphere import Sphere
from oracle.sphere_path import SpherePath
from oracle.world import World

if TYPE_CHECKING:
    from collections.abc import Callable

    from oracle.env_cell import EnvCell

    Step = Callable[[float, int], float]

RADIUS = 0.5
REACH = f32(RADIUS + EPS)
"""A radius with its tolerance, as stored."""
OUTDOORS = land_id(0, 0)
"""The land cell that a sphere at (5, 5) is in."""


def wall(x: float = 0.0) -> Plane:
    """Return the plane at `x`, facing east."""
    return Plane(vec(1.0, 0.0, 0.0), -x)


def reached(one: EnvCell, *xs: float) -> list[tuple[int, bool]]:
    """Return the ids that spheres of half a metre at `xs` add, and whether they are loaded."""
    array = CellArray()
    spheres = [Sphere(vec(x, 5.0, 0.0), RADIUS) for x in xs]
    one.find_transit_cells(at(0.0, 0.0, 0.0), len(spheres), spheres, array, None)
    return [(entry.cell_id, entry.cell is not None) for entry in array.cells]


class TestSpheres:
    """09 4.2: find_transit_cells of spheres."""

    @pytest.mark.parametrize(("x", "inside"), [(-0.5, True), (-0.5 - CELL_SLACK * 1.01, False)])
    def test_a_loaded_neighbour_is_reached_through_its_own_cell_tree(self, x: float, inside: bool) -> None:
        """09 4.2 B: the sphere, enlarged by the slack, must reach into the other cell; no plane counts."""
        world = World()
        one = room(world, CELL, CellPortal(OTHER_CELL, 0, None))
        room(world, OTHER_CELL)
        assert reached(one, f32(x)) == ([(OTHER_CELL, True)] if inside else [])

    def test_a_neighbour_without_a_cell_tree(self) -> None:
        """It holds every sphere."""
        world = World()
        one = room(world, CELL, CellPortal(OTHER_CELL, 0, None))
        room(world, OTHER_CELL, structure=CellStruct(None, None))
        assert reached(one, -99.0) == [(OTHER_CELL, True)]

    def test_any_sphere_will_do(self) -> None:
        """09 4.2 B: the second one reaches; none does not."""
        world = World()
        one = room(world, CELL, CellPortal(OTHER_CELL, 0, None))
        room(world, OTHER_CELL)
        assert reached(one, -9.0, 1.0) == [(OTHER_CELL, True)]
        assert reached(one) == []

    @pytest.mark.parametrize(
        ("side", "x", "inside"),
        [
            (1, -0.6, False),
            (1, -0.4, True),
            (1, 9.0, True),
            (0, 0.6, False),
            (0, 0.4, True),
            (0, -9.0, True),
        ],
    )
    def test_an_unloaded_neighbour_is_reached_through_the_portal_plane(
        self, side: int, x: float, inside: bool
    ) -> None:
        """09 4.2 C: by the side of the portal, enlarged by EPS; it is listed without a cell."""
        one = room(World(), CELL, CellPortal(OTHER_CELL, side, wall()))
        assert reached(one, x) == ([(OTHER_CELL, False)] if inside else [])

    @pytest.mark.parametrize(("side", "x"), [(0, REACH), (1, -REACH)])
    def test_the_reach_to_an_unloaded_cell_is_not_rounded(self, side: int, x: float, next32: Step) -> None:
        """09 4.2 C: 0.5 + EPS is more than its float32, at which the sphere still reaches; then no more."""
        assert REACH < RADIUS + EPS < next32(REACH, 1)
        one = room(World(), CELL, CellPortal(OTHER_CELL, side, wall()))
        assert reached(one, x) == [(OTHER_CELL, False)]
        assert reached(one, next32(REACH, 1) * (1.0 if x > 0.0 else -1.0)) == []

    def test_both_spheres_of_an_unloaded_neighbour(self) -> None:
        """09 4.2 C: the first sphere that reaches ends it; with none, nothing is added."""
        one = room(World(), CELL, CellPortal(OTHER_CELL, 0, wall()))
        assert reached(one, 9.0, -9.0) == [(OTHER_CELL, False)]
        assert reached(one) == []

    @pytest.mark.parametrize("sign", [1.0, -1.0])
    def test_an_exterior_portal_is_touched_up_to_radius_and_eps(self, sign: float, next32: Step) -> None:
        """09 4.2 A: strictly, with the sum rounded to float32, on both sides of the infinite plane."""
        one = room(land(), CELL, CellPortal(None, 0, wall(5.0)), origin=(0.0, 0.0, 0.0))
        assert reached(one, 5.0) == [(OUTDOORS, True)]
        room_at_0 = room(land(), CELL, CellPortal(None, 1, wall()))
        assert reached(room_at_0, sign * REACH) == []
        assert reached(room_at_0, sign * next32(REACH, -1)) != []

    @pytest.mark.parametrize("side", [1.0, -1.0])
    @pytest.mark.parametrize(("gap", "touched"), [(0.499, True), (0.501, False)])
    def test_an_exterior_portal_is_asked_in_the_space_of_its_cell(
        self, side: float, gap: float, touched: bool
    ) -> None:
        """09 4.2 A: the point is taken through the cell's rotation; both sides of the plane are touched."""
        one = room(land(), CELL, CellPortal(None, 0, Plane(vec(0.48, 0.6, 0.64), 0.0)))
        one.pos.frame.assign(Frame.unpack(vec(7.0, 3.0, 9.0), f32(0.8), f32(0.36), f32(0.48), 0.0))
        center = one.pos.frame.localtoglobal(vec(side * gap * 0.48, side * gap * 0.6, side * gap * 0.64))
        array = CellArray()
        one.find_transit_cells(at(0.0, 0.0, 0.0), 1, [Sphere(center, RADIUS)], array, None)
        assert array.added_outside == int(touched)

    def test_land_comes_after_all_neighbours(self) -> None:
        """09 4.2: the exterior portal is the first, its land cells are listed last."""
        world = land()
        one = room(
            world,
            CELL,
            CellPortal(None, 0, wall()),
            CellPortal(OTHER_CELL, 0, wall()),
            CellPortal(CELL + 5, 0, wall()),
        )
        room(world, OTHER_CELL)
        assert reached(one, 0.25) == [
            (OTHER_CELL, True),
            (CELL + 5, False),
            (OUTDOORS, True),
            (land_id(7, 0, BLOCK - 0x100), False),
        ]

    def test_a_portal_whose_plane_is_needed_must_have_one(self) -> None:
        """A portal that only names a cell is enough as long as that cell is loaded."""
        one = room(World(), CELL, CellPortal(OTHER_CELL, 0, None))
        with pytest.raises(ValueError, match="portal to 0xa9b40112 needs its plane"):
            reached(one, 0.0)
        one = room(World(), CELL, CellPortal(None, 0, None))
        with pytest.raises(ValueError, match="portal to the exterior needs its plane"):
            reached(one, 0.0)

    def test_a_cell_without_portals(self) -> None:
        """A missing array has no portals."""
        one = room(World(), CELL)
        one.portals = None
        assert reached(one, 0.0) == []


class TestBuildingTransit:
    """09 4.4: check_building_transit of spheres."""

    def entered(self, portal_id: int, *xs: float, p: int = OUTDOORS) -> tuple[list[int], int]:
        """Return what is listed for spheres at `xs`, and hits_interior_cell."""
        array, path = CellArray(), SpherePath()
        spheres = [Sphere(vec(x, 5.0, 0.0), RADIUS) for x in xs]
        one = room(World(), CELL)
        one.check_building_transit(portal_id, at(0.0, 0.0, 0.0, p), len(spheres), spheres, array, path)
        return ids(array), path.hits_interior_cell

    def test_the_cell_s_own_extent_counts(self) -> None:
        """09 4.4.2: any sphere that reaches into the cell; the portal itself plays no role."""
        assert self.entered(0, 0.0) == ([CELL], 1)
        assert self.entered(99, -9.0, 0.0) == ([CELL], 1)
        assert self.entered(0, f32(-0.5 - CELL_SLACK * 1.01)) == ([], 0)
        assert self.entered(0) == ([], 0)

    def test_no_way_in(self) -> None:
        """09 4.4.1: a negative portal id."""
        assert self.entered(-1, 0.0) == ([], 0)

    def test_no_block_offset(self) -> None:
        """09 4.4: from another block the centre is 192 metres off, which is not made good."""
        assert self.entered(0, -1.0, p=land_id(0, 0, BLOCK + 0x100)) == ([], 0)

    def test_without_a_path(self) -> None:
        """Registration has none to tell."""
        array = CellArray()
        room(World(), CELL).check_building_transit(
            0, at(0.0, 0.0, 0.0), 1, [Sphere(vec(0.0, 0.0, 0.0), RADIUS)], array, None
        )
        assert ids(array) == [CELL]
