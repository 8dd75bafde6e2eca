"""CLandCell: which triangle counts, the ground under the mover, and the sea."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest
from oracle_land import (
    BLOCK,
    DRY,
    GROUND,
    VERTICES,
    WATER,
    land,
    land_cell,
    land_id,
    standing,
)
from oracle_worlds import at, mover, trace_of, transition, vec, xyz

from oracle.arithmetic import f32
from oracle.constants import EPS
from oracle.enums import IS_VIEWER_OI, ON_WALKABLE_OI, TransitionState, WaterType
from oracle.land_block_struct import cuts_sw_to_ne
from oracle.obj_cell import DEEP_WATER
from oracle.physics_state import GRAVITY_PS, MISSILE_PS

if TYPE_CHECKING:
    from collections.abc import Callable

    from oracle.land_cell import LandCell

    Step = Callable[[float, int], float]

OK, COLLIDED, ADJUSTED = TransitionState.OK, TransitionState.COLLIDED, TransitionState.ADJUSTED
HERE = land_id(3, 3)
EAST = BLOCK + 0x100
RADIUS = 0.5


def corners(cell: LandCell, k: int) -> list[tuple[float, float]]:
    """Return the corners of a triangle on the map."""
    return [(v.x, v.y) for v in cell.polygons[k].vertices]


class TestTriangles:
    """10 5: find_terrain_poly."""

    def test_the_first_has_the_diagonal(self) -> None:
        """Its middle, inside of both triangles, and the corners that they share."""
        cell = land_cell(land())
        assert cell.find_terrain_poly(vec(84.0, 84.0, -500.0)) is cell.polygons[0]
        shared = set(corners(cell, 0)) & set(corners(cell, 1))
        assert len(shared) == 2
        for x, y in shared:
            assert cell.find_terrain_poly(vec(x, y, 0.0)) is cell.polygons[0]

    def test_each_side_of_the_diagonal(self, next32: Step) -> None:
        """One step of float32 off the middle of the diagonal is enough."""
        cell = land_cell(land())
        north, south = vec(84.0, next32(84.0, 1), 0.0), vec(84.0, next32(84.0, -1), 0.0)
        north_of_it, south_of_it = (1, 0)
        assert cuts_sw_to_ne(1355, 1443) == bool(cell.sw_to_ne_cut)
        assert cell.find_terrain_poly(north) is cell.polygons[north_of_it]
        assert cell.find_terrain_poly(south) is cell.polygons[south_of_it]

    @pytest.mark.parametrize(
        ("x", "y"), [(72.0, 80.0), (96.0, 80.0), (80.0, 72.0), (80.0, 96.0), (96.0, 96.0)]
    )
    def test_edges_are_inside(self, x: float, y: float) -> None:
        """A border belongs to the cells on both sides of it, whatever the height."""
        assert land_cell(land()).point_in_cell(vec(x, y, 1e6)) == 1

    @pytest.mark.parametrize(
        ("x", "y", "steps"), [("x", 72.0, -1), ("x", 96.0, 1), ("y", 72.0, -1), ("y", 96.0, 1)]
    )
    def test_one_step_beyond_is_outside(self, x: str, y: float, steps: int, next32: Step) -> None:
        """The next float32 across the border is not in the cell."""
        beyond = next32(y, steps)
        point = vec(beyond, 80.0, 0.0) if x == "x" else vec(80.0, beyond, 0.0)
        assert land_cell(land()).point_in_cell(point) == 0
        assert land_cell(land()).find_terrain_poly(point) is None


class TestTerrain:
    """10 7: find_env_collisions."""

    @pytest.mark.parametrize(("z", "contact"), [(0.0, 1), (EPS / 2.0, 1), (-EPS / 2.0, 1), (0.01, 0)])
    def test_the_lowest_point_touches_the_plane(self, z: float, contact: int) -> None:
        """Within EPS it is a contact with this cell's id; above it nothing happens."""
        made = standing(land(), f32(z), state=ON_WALKABLE_OI)
        assert land_cell(made.world).find_env_collisions(made) == OK
        ci = made.collision_info
        assert (ci.contact_plane_valid, ci.contact_plane_is_water) == (contact, 0)
        assert ci.contact_plane_cell_id == (HERE if contact else 0)
        assert trace_of(made) == "T1"

    def test_below_it_is_lifted(self) -> None:
        """0.25 under flat ground: moved up by 0.25, along z only."""
        made = standing(land(), -0.25)
        assert land_cell(made.world).find_env_collisions(made) == ADJUSTED
        assert xyz(made.sphere_path.check_pos.frame.origin) == (84.0, 80.0, GROUND)
        assert trace_of(made) == "T3"

    def test_another_cell_s_ground_is_not_tested(self) -> None:
        """10 7.3: the lowest point is not above this cell; there is no letter."""
        made = standing(land(), -5.0, x=100.0)
        assert land_cell(made.world).find_env_collisions(made) == OK
        assert trace_of(made) == ""

    def test_the_lowest_point_selects_and_the_sphere_is_tested(self) -> None:
        """10 7.2 and 10 7.6: both are moved by the offset of the blocks, 192 metres."""
        world = land(BLOCK, EAST)
        made = standing(world, -0.25, x=192.0 + 84.0)
        assert land_cell(world).find_env_collisions(made) == OK
        assert land_cell(world, block=EAST).find_env_collisions(made) == ADJUSTED
        assert made.collision_info.contact_plane_cell_id == land_id(3, 3, EAST)
        assert xyz(made.sphere_path.check_pos.frame.origin) == (276.0, 80.0, GROUND)

    def test_only_sphere_0_is_tested(self) -> None:
        """10 7.6: a second sphere under the ground is free."""
        end = at(84.0, 80.0, GROUND, HERE)
        made = transition(land(), end, end, spheres=((5.0, RADIUS), (-3.0, RADIUS)))
        assert land_cell(made.world).find_env_collisions(made) == OK
        assert trace_of(made) == "T1"

    def test_ethereal_is_left_as_it_is(self) -> None:
        """10 7: unlike an interior cell, a land cell does not reset it."""
        made = standing(land())
        made.sphere_path.obstruction_ethereal = 1
        land_cell(made.world).find_env_collisions(made)
        assert made.sphere_path.obstruction_ethereal == 1


class TestWater:
    """10 7.4, 10 7.5: the sea is a wall, shallow water lets the mover sink in."""

    def test_the_sea(self) -> None:
        """A block that is all water stops a mover above any of its cells, however high it is."""
        made = standing(land(terrain=[WATER] * VERTICES), 50.0)
        assert land_cell(made.world).find_env_collisions(made) == COLLIDED
        assert trace_of(made) == "T2"
        assert made.collision_info.contact_plane_valid == 0

    @pytest.mark.parametrize(("state", "mover_state"), [(IS_VIEWER_OI, GRAVITY_PS), (0, MISSILE_PS)])
    def test_cameras_and_missiles_cross_the_sea(self, state: int, mover_state: int) -> None:
        """They collide with the terrain below it."""
        made = standing(land(terrain=[WATER] * VERTICES), 50.0, state=state, moving=mover(mover_state))
        assert land_cell(made.world).find_env_collisions(made) == OK
        assert trace_of(made) == "T1"

    @pytest.mark.parametrize(
        ("wet", "depth"),
        [((3, 3), f32(0.1)), ((4, 3), f32(0.45)), ("cell", DEEP_WATER)],
        ids=["dry corner", "wet corner", "all"],
    )
    def test_a_mover_sinks_by_the_depth(self, wet: tuple[int, int] | str, depth: float) -> None:
        """At (88, 76) the corner (4, 3) is nearest: the lowest point rests `depth` under the ground."""
        words = [DRY] * VERTICES
        for i, j in [(3, 3), (4, 3), (3, 4), (4, 4)] if wet == "cell" else [wet]:
            words[9 * int(i) + int(j)] = WATER
        world = land(terrain=words)
        end = at(88.0, 76.0, f32(GROUND - depth), HERE)
        made = transition(world, end, end, state=ON_WALKABLE_OI, spheres=((RADIUS, RADIUS),))
        assert land_cell(world).find_env_collisions(made) == OK
        assert (made.collision_info.contact_plane_valid, made.collision_info.contact_plane_is_water) == (1, 1)
        made = standing(world, f32(0.01 - depth), x=88.0, y=76.0)
        assert land_cell(world).find_env_collisions(made) == OK
        assert made.collision_info.contact_plane_valid == 0


class TestWaterDepth:
    """10 6.4: CObjCell::get_water_depth."""

    def test_by_the_type_of_the_cell(self) -> None:
        """None, all (0.9 as float32), some (by the nearest corner), and what cannot be."""
        words = [DRY] * VERTICES
        words[9 * 3 + 3] = WATER
        cell, middle = land_cell(land(terrain=words)), vec(84.0, 84.0, 0.0)
        assert cell.water_type == WaterType.PARTIALLY_WATER
        assert cell.get_water_depth(middle) == f32(0.45)
        cell.water_type = WaterType.ENTIRELY_WATER
        assert cell.get_water_depth(middle) == f32(0.9)
        cell.water_type = WaterType.NOT_WATER
        assert cell.get_water_depth(middle) == 0.0

    def test_without_a_block(self) -> None:
        """Partly water is 0.1 deep then, and the block is not the sea."""
        cell = land_cell(land(terrain=[WATER] * VERTICES))
        cell.block, cell.water_type = None, WaterType.PARTIALLY_WATER
        assert cell.get_water_depth(vec(84.0, 84.0, 0.0)) == 0.1
        assert cell.get_block_water_type() == WaterType.NOT_WATER
