"""CEnvCell: an interior cell with its structure and its portals."""

from __future__ import annotations

from typing import TYPE_CHECKING

from oracle import env_cell_transit
from oracle.enums import CONTACT_OI, BoundingType, InsertType, TransitionState
from oracle.obj_cell import ObjCell

if TYPE_CHECKING:
    from collections.abc import Sequence

    from oracle.bbox import BBox
    from oracle.bsp_tree import BSPTree
    from oracle.plane import Plane
    from oracle.position import Position
    from oracle.sphere import Sphere
    from oracle.sphere_path import SpherePath
    from oracle.transition import Transition
    from oracle.vector import Vector3
    from oracle.world import World

CELL_SCALE = 1.0
"""Environment cells are never scaled (09 3.4)."""


class CellStruct:
    """The geometry of a cell: the physics BSP and the cell BSP, or none.

    A structure without a cell BSP contains every point and touches every sphere. Retail's files always
    have one; worlds of a single cell need none.
    """

    __slots__ = ("cell_bsp", "physics_bsp")

    def __init__(self, physics_bsp: BSPTree | None, cell_bsp: BSPTree | None) -> None:
        self.physics_bsp = physics_bsp
        self.cell_bsp = cell_bsp

    def point_in_cell(self, point: Vector3) -> int:
        """Tell whether the cell contains a point of its own space (CCellStruct::point_in_cell, 09 4.1)."""
        return 1 if self.cell_bsp is None else self.cell_bsp.point_inside_cell_bsp(point)

    def sphere_intersects_cell(self, sphere: Sphere) -> BoundingType:
        """Tell how much of a sphere (cell space) is in the cell (CCellStruct, 09 4.2)."""
        if self.cell_bsp is None:
            return BoundingType.ENTIRELY_INSIDE
        return self.cell_bsp.sphere_intersects_cell_bsp(sphere)

    def box_intersects_cell(self, box: BBox) -> int:
        """Tell whether a box (cell space) reaches into the cell (CCellStruct, 09 4.3.8)."""
        return 1 if self.cell_bsp is None else self.cell_bsp.box_intersects_cell_bsp(box)


class CellPortal:
    """A portal of a cell (CCellPortal, 09 2.1).

    Attributes
    ----------
    other_cell_id : int or None
        The cell behind it; None is the exterior.
    portal_side : int
        On which side of the plane the cell's interior is: 0 the positive, 1 the negative.
    plane : Plane or None
        The portal polygon's plane in cell space. Spheres only look at that of an exterior portal or of a
        cell that is not loaded; it may be None where nothing else is registered.
    """

    __slots__ = ("other_cell_id", "plane", "portal_side")

    def __init__(self, other_cell_id: int | None, portal_side: int, plane: Plane | None) -> None:
        self.other_cell_id = other_cell_id
        self.portal_side = portal_side
        self.plane = plane

    def get_other_cell(self, world: World) -> EnvCell | None:
        """Return the interior cell behind the portal, if it is loaded.

        retail: CCellPortal::GetOtherCell 0x0053BA30, 09 2.
        """
        return None if self.other_cell_id is None else world.cells.get(self.other_cell_id)

    def required_plane(self) -> Plane:
        """Return the plane, where retail looks at it."""
        if self.plane is None:
            behind = "the exterior" if self.other_cell_id is None else f"{self.other_cell_id:#010x}"
            message = f"the portal to {behind} needs its plane"
            raise ValueError(message)
        return self.plane


class EnvCell(ObjCell):
    """An interior cell.

    Attributes
    ----------
    world : World
        Where neighbours are looked up.
    structure : CellStruct
        Its geometry.
    portals : list of CellPortal or None
        None is retail's missing array: then no point is in the cell.
    """

    def __init__(
        self,
        cell_id: int,
        pos: Position,
        structure: CellStruct,
        world: World,
        *,
        portals: Sequence[CellPortal] | None,
    ) -> None:
        super().__init__(cell_id, pos)
        self.structure = structure
        self.world = world
        self.portals = None if portals is None else list(portals)

    def find_collisions(self, transition: Transition) -> TransitionState:
        """Test the path against the cell's geometry, then against its objects.

        retail: CEnvCell::find_collisions 0x0052C100, 09 3.3.
        """
        # 09 3.3.1
        r = self.find_env_collisions(transition)
        # 09 3.3.2
        if r == TransitionState.OK:
            r = self.find_obj_collisions(transition)
        # 09 3.3.3
        return r

    def find_env_collisions(self, transition: Transition) -> TransitionState:
        """Test the path against the cell's physics BSP.

        retail: CEnvCell::find_env_collisions 0x0052C130, 09 3.4.
        """
        path = transition.sphere_path
        # 09 3.4.1
        r = self.check_entry_restrictions(transition)
        if r != TransitionState.OK:
            return r
        # 09 3.4.2
        path.obstruction_ethereal = 0
        # 09 3.4.3
        bsp = self.structure.physics_bsp
        if bsp is not None:
            self.cache_local_space(path)
            if path.insert_type == InsertType.INITIAL_PLACEMENT:
                r = bsp.placement_insert(transition)
            else:
                r = bsp.find_collisions(transition, CELL_SCALE)
            if r != TransitionState.OK and not transition.object_info.state & CONTACT_OI:
                transition.collision_info.collided_with_environment = 1
        # 09 3.4.4
        return r

    def cache_local_space(self, path: SpherePath) -> None:
        """Take the path's spheres into the cell's space (09 3.4.3, of find_env_collisions)."""
        path.cache_localspace_sphere(self.pos, CELL_SCALE)

    def point_in_cell(self, point: Vector3) -> int:
        """Tell whether the cell contains a point of its block's coordinates, metres.

        retail: CEnvCell::point_in_cell 0x0052C300, 09 4.1.
        """
        # 09 4.1.1
        if self.portals is None:
            return 0
        # 09 4.1.2
        p = self.pos.frame.globaltolocal(point)
        # 09 4.1.3
        return self.structure.point_in_cell(p)

    find_transit_cells = env_cell_transit.find_transit_cells
    find_transit_cells_of_parts = env_cell_transit.find_transit_cells_of_parts
    check_building_transit = env_cell_transit.check_building_transit
    check_building_transit_of_parts = env_cell_transit.check_building_transit_of_parts

    def find_visible_child_cell(self, origin: Vector3, *, search_stabs: bool) -> EnvCell | None:
        """Return the cell that contains a point (block coordinates, metres): this one or one near it.

        `search_stabs` asks the cells visible from this one, otherwise the cells behind its portals.

        retail: CEnvCell::find_visible_child_cell 0x0052DC50, 09 7.
        """
        # 09 7.1
        if self.point_in_cell(origin):
            return self
        # 09 7.2
        if search_stabs:
            others = (self.world.cells.get(cell_id) for cell_id in self.stab_list)
        # 09 7.3
        else:
            others = (portal.get_other_cell(self.world) for portal in self.portals or ())
        for other in others:
            if other is not None and other.point_in_cell(origin):
                return other
        # 09 7.4
        return None
