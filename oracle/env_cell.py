"""CEnvCell: an interior cell with its structure and its portals."""

from __future__ import annotations

from typing import TYPE_CHECKING

from oracle.arithmetic import f32
from oracle.constants import EPS
from oracle.enums import CONTACT_OI, BoundingType, InsertType, TransitionState
from oracle.errors import NotPortedError
from oracle.obj_cell import ObjCell
from oracle.sphere import Sphere

if TYPE_CHECKING:
    from collections.abc import Sequence

    from oracle.bsp_tree import BSPTree
    from oracle.cell_array import CellArray
    from oracle.plane import Plane
    from oracle.position import Position
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


class CellPortal:
    """A portal of a cell (CCellPortal, 09 2.1).

    Attributes
    ----------
    other_cell_id : int or None
        The cell behind it; None is the exterior.
    portal_side : int
        On which side of the plane the cell's interior is: 0 the positive, 1 the negative.
    plane : Plane or None
        The portal polygon's plane in cell space; only looked at for an exterior portal or a cell that
        is not loaded, and may be None for the others.
    """

    __slots__ = ("other_cell_id", "plane", "portal_side")

    def __init__(self, other_cell_id: int | None, portal_side: int, plane: Plane | None) -> None:
        self.other_cell_id = other_cell_id
        self.portal_side = portal_side
        self.plane = plane

    def required_plane(self) -> Plane:
        """Return the plane, where retail looks at it."""
        if self.plane is None:
            message = f"the portal to {self.other_cell_id} needs its plane: that cell is not loaded"
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

    def find_transit_cells(
        self, p: Position, num_sphere: int, spheres: Sequence[Sphere], array: CellArray
    ) -> None:
        """Add the cells behind the portals that the spheres reach (landblock coordinates of `p`).

        Raises
        ------
        NotPortedError
            A sphere touches an exterior portal.

        Notes
        -----
        retail: CEnvCell::find_transit_cells 0x0052C820, 09 4.2.
        """
        outside = False
        for portal in self.portals or ():
            # 09 4.2 A
            if portal.other_cell_id is None:
                outside = outside or self._touches_exterior(portal, num_sphere, spheres)
                continue
            other = self.world.cells.get(portal.other_cell_id)
            # 09 4.2 B
            if other is not None:
                if other.is_reached_by(num_sphere, spheres):
                    array.add_cell(other.id, other)
            # 09 4.2 C
            elif self._reaches_unloaded(portal, num_sphere, spheres):
                array.add_cell(portal.other_cell_id, None)
        if outside:
            raise NotPortedError("the land cells behind an exterior portal (09 6.4)")

    def is_reached_by(self, num_sphere: int, spheres: Sequence[Sphere]) -> bool:
        """Tell whether a sphere (block coordinates) touches this cell (09 4.2 B)."""
        for sphere in spheres[:num_sphere]:
            local = Sphere(self.pos.frame.globaltolocal(sphere.center), sphere.radius)
            if self.structure.sphere_intersects_cell(local):
                return True
        return False

    def _touches_exterior(self, portal: CellPortal, num_sphere: int, spheres: Sequence[Sphere]) -> bool:
        """Tell whether a sphere touches the infinite plane of an exterior portal (09 4.2 A)."""
        m, plane = self.pos.frame, portal.required_plane()
        o, n = m.origin, plane.N
        for sphere in spheres[:num_sphere]:
            dx = sphere.center.x - o.x
            dy = sphere.center.y - o.y
            dz = sphere.center.z - o.z
            lx = f32((dx * m.m0 + dz * m.m2) + dy * m.m1)
            ly = f32((dx * m.m3 + dz * m.m5) + dy * m.m4)
            lz = (dz * m.m8 + dy * m.m7) + dx * m.m6
            rad = f32(sphere.radius + EPS)
            d = ((lz * n.z + ly * n.y) + lx * n.x) + plane.d
            if d > -rad and d < rad:
                return True
        return False

    def _reaches_unloaded(self, portal: CellPortal, num_sphere: int, spheres: Sequence[Sphere]) -> bool:
        """Tell whether a sphere reaches through the portal of a cell that is not loaded (09 4.2 C)."""
        plane = portal.required_plane()
        n = plane.N
        for sphere in spheres[:num_sphere]:
            l = self.pos.frame.globaltolocal(sphere.center)
            rad = sphere.radius + EPS
            d = ((l.y * n.y + l.z * n.z) + l.x * n.x) + plane.d
            if (d > -rad and portal.portal_side == 1) or (d < rad and portal.portal_side == 0):
                return True
        return False
