"""CLandCell: a square of terrain, two triangles."""

from __future__ import annotations

from typing import TYPE_CHECKING

from oracle import outside_cells
from oracle.arithmetic import f32
from oracle.constants import HALF_CELL_EDGE
from oracle.enums import IS_VIEWER_OI, Sidedness, TransitionState, WaterType
from oracle.land_defs import get_block_offset
from oracle.physics_state import MISSILE_PS
from oracle.sort_cell import SortCell
from oracle.trace import terrain, traced
from oracle.vector import Vector3

if TYPE_CHECKING:
    from collections.abc import Sequence

    from oracle.cell_array import CellArray
    from oracle.land_block_struct import LandBlockStruct
    from oracle.physics_part import PhysicsPart
    from oracle.polygon import Polygon
    from oracle.position import Position
    from oracle.sphere import Sphere
    from oracle.sphere_path import SpherePath
    from oracle.transition import Transition
    from oracle.world import World


class LandCell(SortCell):
    """A land cell; points and terrain are in its landblock's coordinates, metres.

    Attributes
    ----------
    world : World
        Where neighbours are looked up.
    polygons : tuple of Polygon
        The two triangles; the first has the diagonal they share.
    sw_to_ne_cut : int
        1 if that diagonal goes from south-west to north-east.
    """

    def __init__(
        self,
        cell_id: int,
        pos: Position,
        world: World,
        block: LandBlockStruct,
        polygons: tuple[Polygon, Polygon],
    ) -> None:
        super().__init__(cell_id, pos)
        self.world = world
        self.block = block
        self.polygons = polygons
        self.sw_to_ne_cut = 0

    def find_collisions(self, transition: Transition) -> TransitionState:
        """Test the path against the terrain, then the building, then the objects.

        retail: CLandCell::find_collisions 0x00532D60, 09 3.5.
        """
        # 09 3.5.1
        r = self.find_env_collisions(transition)
        # 09 3.5.2
        if r == TransitionState.OK:
            r = super().find_collisions(transition)
        # 09 3.5.3
        if r == TransitionState.OK:
            r = self.find_obj_collisions(transition)
        # 09 3.5.4
        return r

    def find_env_collisions(self, transition: Transition) -> TransitionState:
        """Test sphere 0 of the path against the triangle under or above its lowest point.

        retail: CLandCell::find_env_collisions 0x00532F20, 10 7.
        """
        path = transition.sphere_path
        # 10 7.1
        r = self.check_entry_restrictions(transition)
        if r != TransitionState.OK:
            return r
        # 10 7.2
        off = get_block_offset(path.check_pos.objcell_id, self.id)
        low = path.global_low_point
        lp = Vector3(f32(low.x - off.x), f32(low.y - off.y), f32(low.z - off.z))
        # 10 7.3
        poly = self.find_terrain_poly(lp)
        return TransitionState.OK if poly is None else self._collide_with(transition, poly, lp)

    @traced(terrain)
    def _collide_with(self, transition: Transition, poly: Polygon, lp: Vector3) -> TransitionState:
        """Collide with the sea, or with a triangle under the lowest point (10 7.4 to 10 7.7)."""
        path, oi = transition.sphere_path, transition.object_info
        # 10 7.4
        if (
            self.get_block_water_type() == WaterType.ENTIRELY_WATER
            and not oi.state & IS_VIEWER_OI
            and not oi.mover().state & MISSILE_PS
        ):
            return TransitionState.COLLIDED
        # 10 7.5
        depth = f32(self.get_water_depth(lp))
        # 10 7.6
        sphere = path.global_sphere[0].copy()
        off2, centre = get_block_offset(path.check_pos.objcell_id, self.id), sphere.center
        centre.assign(Vector3(f32(centre.x - off2.x), f32(centre.y - off2.y), f32(centre.z - off2.z)))
        # 10 7.7
        is_water = int(self.water_type != WaterType.NOT_WATER)
        return oi.validate_walkable(
            sphere, poly.plane, is_water, depth, path, transition.collision_info, self.id
        )

    def find_terrain_poly(self, origin: Vector3) -> Polygon | None:
        """Return the triangle under or above a point; the first one if both share it.

        retail: CLandCell::find_terrain_poly 0x00532CF0, 10 5.
        """
        # 10 5.1
        for polygon in self.polygons:
            if polygon.point_in_poly2D(origin, Sidedness.POSITIVE):
                return polygon
        # 10 5.2
        return None

    def point_in_cell(self, point: Vector3) -> int:
        """Tell whether a point is above or below the cell, its edges included.

        retail: CLandCell::point_in_cell 0x00532D40, 10 5.1.
        """
        return int(self.find_terrain_poly(point) is not None)

    def find_transit_cells(
        self,
        p: Position,
        num_sphere: int,
        spheres: Sequence[Sphere],
        array: CellArray,
        path: SpherePath | None,
    ) -> None:
        """Add the land cells that the spheres reach, and the cells of the building.

        retail: CLandCell::find_transit_cells 0x00533800, 09 6.3.
        """
        # 09 6.3.1
        outside_cells.add_all_outside_cells(self.world, p, num_sphere, spheres, array)
        # 09 6.3.2
        super().find_transit_cells(p, num_sphere, spheres, array, path)

    def find_transit_cells_of_parts(self, parts: Sequence[PhysicsPart | None], array: CellArray) -> None:
        """Add the land cells that the parts reach, and the cells of the building.

        retail: CLandCell::find_transit_cells 0x00533840, 09 6.3.
        """
        # 09 6.3.1
        outside_cells.add_all_outside_cells_of_parts(self.world, parts, array)
        # 09 6.3.2
        super().find_transit_cells_of_parts(parts, array)

    def handle_move_restriction(self, transition: Transition) -> int:
        """Take the side on which the refused mover is as the collision normal; always 1.

        retail: CLandCell::handle_move_restriction 0x00533070, 09 3.1.
        """
        d = self.pos.get_offset(transition.sphere_path.curr_pos)
        if d.y < -HALF_CELL_EDGE:
            n = Vector3(0.0, -1.0, 0.0)
        elif d.y > HALF_CELL_EDGE:
            n = Vector3(0.0, 1.0, 0.0)
        elif d.x < -HALF_CELL_EDGE:
            n = Vector3(-1.0, 0.0, 0.0)
        else:
            n = Vector3(1.0, 0.0, 0.0)
        transition.collision_info.set_collision_normal(n)
        return 1
