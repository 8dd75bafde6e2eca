"""CEnvCell, transit: which neighbours spheres or parts reach.

The functions here are methods of `oracle.env_cell.EnvCell`.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from oracle.arithmetic import f32
from oracle.constants import EPS
from oracle.enums import Sidedness
from oracle.outside_cells import add_all_outside_cells, add_all_outside_cells_of_parts
from oracle.sphere import Sphere

if TYPE_CHECKING:
    from collections.abc import Sequence

    from oracle.cell_array import CellArray
    from oracle.env_cell import CellPortal, EnvCell
    from oracle.physics_part import PhysicsPart
    from oracle.plane import Plane
    from oracle.position import Position
    from oracle.sphere_path import SpherePath

NEGATIVE_SIDE = 1
"""Portal side of a cell that is behind the portal's plane; 0 is in front of it (09 2.1)."""


def find_transit_cells(
    self: EnvCell,
    p: Position,
    num_sphere: int,
    spheres: Sequence[Sphere],
    array: CellArray,
    path: SpherePath | None,
) -> None:
    """Add the cells behind the portals that the spheres reach (landblock coordinates of `p`).

    The land cells behind exterior portals come last; `path` is not used.

    retail: CEnvCell::find_transit_cells 0x0052C820, 09 4.2.
    """
    outside = False
    for portal in self.portals or ():
        # 09 4.2 A
        if portal.other_cell_id is None:
            outside |= _touches_exterior(self, portal, num_sphere, spheres)
            continue
        other = portal.get_other_cell(self.world)
        # 09 4.2 B
        if other is not None:
            if _is_reached(other, num_sphere, spheres):
                array.add_cell(other.id, other)
        # 09 4.2 C
        elif _reaches_unloaded(self, portal, num_sphere, spheres):
            array.add_cell(portal.other_cell_id, None)
    if outside:
        add_all_outside_cells(self.world, p, num_sphere, spheres, array)


def _touches_exterior(self: EnvCell, portal: CellPortal, num_sphere: int, spheres: Sequence[Sphere]) -> bool:
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


def _is_reached(other: EnvCell, num_sphere: int, spheres: Sequence[Sphere]) -> bool:
    """Tell whether a sphere (block coordinates) touches a cell (09 4.2 B, 09 4.4.2)."""
    for sphere in spheres[:num_sphere]:
        local = Sphere(other.pos.frame.globaltolocal(sphere.center), sphere.radius)
        if other.structure.sphere_intersects_cell(local):
            return True
    return False


def _reaches_unloaded(self: EnvCell, portal: CellPortal, num_sphere: int, spheres: Sequence[Sphere]) -> bool:
    """Tell whether a sphere reaches through the portal of a cell that is not loaded (09 4.2 C)."""
    plane = portal.required_plane()
    n = plane.N
    for sphere in spheres[:num_sphere]:
        l = self.pos.frame.globaltolocal(sphere.center)
        rad = sphere.radius + EPS
        d = ((l.y * n.y + l.z * n.z) + l.x * n.x) + plane.d
        if (d > -rad and portal.portal_side == NEGATIVE_SIDE) or (
            d < rad and portal.portal_side != NEGATIVE_SIDE
        ):
            return True
    return False


def check_building_transit(
    self: EnvCell,
    portal_id: int,
    p: Position,
    num_sphere: int,
    spheres: Sequence[Sphere],
    array: CellArray,
    path: SpherePath | None,
) -> None:
    """Add this cell if the spheres of someone outside of its building reach it.

    The spheres are taken as if they were in this cell's block, whatever block `p` is in.

    retail: CEnvCell::check_building_transit 0x0052C5D0, 09 4.4.
    """
    # 09 4.4.1
    if portal_id < 0:
        return
    # 09 4.4.2
    if _is_reached(self, num_sphere, spheres):
        if path is not None:
            path.hits_interior_cell = 1
        array.add_cell(self.id, self)


class _Reach(NamedTuple):
    """How far a part is from a portal's plane, and how far it reaches to either side; metres."""

    d: float
    rad: float
    nrad: float


def find_transit_cells_of_parts(self: EnvCell, parts: Sequence[PhysicsPart | None], array: CellArray) -> None:
    """Add the cells behind the portals that an object's parts reach.

    retail: CEnvCell::find_transit_cells 0x0052CAE0, 09 4.3.
    """
    outside = False
    for portal in self.portals or ():
        for part in parts:
            if part is None or not _part_leaves(self, portal, part):
                continue
            # 09 4.3.6
            if portal.other_cell_id is None:
                outside = True
                break
            # 09 4.3.7
            other = portal.get_other_cell(self.world)
            if other is None:
                array.add_cell(portal.other_cell_id, None)
                break
            # 09 4.3.8
            box2 = part.bounding_box().local_to_local(part.pos, other.pos)
            if other.structure.box_intersects_cell(box2):
                array.add_cell(other.id, other)
                break
    if outside:
        add_all_outside_cells_of_parts(self.world, parts, array)


def _part_leaves(self: EnvCell, portal: CellPortal, part: PhysicsPart) -> bool:
    """Tell whether a part is not all on the inner side of a portal (09 4.3.1 to 09 4.3.5)."""
    plane = portal.required_plane()
    reach = _reach_of(self, plane, part)
    if reach is None:
        return False
    # 09 4.3.4
    if portal.portal_side == NEGATIVE_SIDE:
        if reach.d < reach.nrad:
            return False
    elif reach.d > reach.rad:
        return False
    # 09 4.3.5
    box = part.bounding_box().local_to_local(part.pos, self.pos)
    return plane.intersect_box(box) != portal.portal_side


def _reach_of(self: EnvCell, plane: Plane, part: PhysicsPart) -> _Reach | None:
    """Return how a part's sphere lies to a portal's plane; None for a part without one (09 4.3.1)."""
    # 09 4.3.1
    sphere = part.bounding_sphere()
    if sphere is None:
        return None
    # 09 4.3.2
    c = self.pos.localtolocal(part.pos, sphere.center)
    r = sphere.radius + EPS
    # 09 4.3.3
    n = plane.N
    d = ((c.y * n.y + c.z * n.z) + c.x * n.x) + plane.d
    return _Reach(d, f32(r), f32(-r))


def check_building_transit_of_parts(
    self: EnvCell, portal_id: int, parts: Sequence[PhysicsPart | None], array: CellArray
) -> None:
    """Add this cell, and those behind its portals, if parts outside of its building reach it.

    retail: CEnvCell::check_building_transit 0x0052C680, 09 4.5.
    """
    if portal_id < 0 or self.portals is None:
        return
    portal = self.portals[portal_id]
    for part in parts:
        if part is None or not _part_enters(self, portal, part):
            continue
        # 09 4.5.3
        box = part.bounding_box().local_to_local(part.pos, self.pos)
        if self.structure.box_intersects_cell(box):
            array.add_cell(self.id, self)
            self.find_transit_cells_of_parts(parts, array)
            return


def _part_enters(self: EnvCell, portal: CellPortal, part: PhysicsPart) -> bool:
    """Tell whether a part reaches to the inner side of a portal (09 4.5.1 to 09 4.5.2)."""
    plane = portal.required_plane()
    reach = _reach_of(self, plane, part)
    if reach is None:
        return False
    # 09 4.5.1
    if portal.portal_side == NEGATIVE_SIDE:
        if reach.d > reach.rad:
            return False
    elif reach.d < reach.nrad:
        return False
    # 09 4.5.2
    box = part.bounding_box().local_to_local(part.pos, self.pos)
    return plane.intersect_box(box) in (Sidedness.CROSSING, portal.portal_side)
