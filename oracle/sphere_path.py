"""SPHEREPATH: where the mover was, where it wants to be, and what the current step has found."""

from __future__ import annotations

from typing import TYPE_CHECKING

from oracle.arithmetic import f32
from oracle.enums import InsertType, TransitionState
from oracle.land_defs import FIRST_INTERIOR_CELL, get_block_offset
from oracle.position import Position
from oracle.sphere import Sphere
from oracle.vector import Vector3

if TYPE_CHECKING:
    from collections.abc import Sequence

    from oracle.collision_info import CollisionInfo
    from oracle.obj_cell import ObjCell
    from oracle.object_info import ObjectInfo
    from oracle.polygon import Polygon

MAX_SPHERES = 2
"""A path carries at most this many spheres (04 2.3)."""


class SpherePath:
    """The path of one transition; fields are those of 04 2.3, with retail's names.

    Retail does not clear the fields that its table marks *stale*: they keep the value of the previous
    transition of the same pool level. Here every path is new and those fields start at zero.

    `begin_pos`, `end_pos` and the cells are references, as in retail; every other assignment copies.
    """

    __slots__ = (
        "backup",
        "backup_cell",
        "backup_check_pos",
        "begin_cell",
        "begin_pos",
        "bldg_check",
        "cell_array_valid",
        "check_cell",
        "check_pos",
        "check_walkable",
        "collide",
        "curr_cell",
        "curr_pos",
        "end_pos",
        "global_curr_center",
        "global_low_point",
        "global_offset",
        "global_sphere",
        "hits_interior_cell",
        "insert_type",
        "local_low_point",
        "local_sphere",
        "localspace_curr_center",
        "localspace_low_point",
        "localspace_pos",
        "localspace_sphere",
        "localspace_z",
        "neg_collision_normal",
        "neg_poly_hit",
        "neg_step_up",
        "num_sphere",
        "obstruction_ethereal",
        "placement_allows_sliding",
        "step_down",
        "step_down_amt",
        "step_up",
        "step_up_normal",
        "walk_interp",
        "walkable",
        "walkable_allowance",
        "walkable_check_pos",
        "walkable_pos",
        "walkable_scale",
        "walkable_up",
    )

    def __init__(self) -> None:
        self.local_sphere = _two_spheres()
        self.local_low_point = Vector3()
        self.global_sphere = _two_spheres()
        self.global_low_point = Vector3()
        self.localspace_sphere = _two_spheres()
        self.localspace_low_point = Vector3()
        self.localspace_curr_center = [Vector3() for _ in range(MAX_SPHERES)]
        self.global_curr_center = [Vector3() for _ in range(MAX_SPHERES)]
        self.localspace_pos = Position()
        self.localspace_z = Vector3()
        self.end_pos: Position | None = None
        self.curr_pos = Position()
        self.global_offset = Vector3()
        self.step_up_normal = Vector3()
        self.check_pos = Position()
        self.backup = InsertType.TRANSITION
        self.backup_check_pos = Position()
        self.walk_interp = 0.0
        self.step_down_amt = 0.0
        self.walkable_check_pos = Sphere(Vector3(), 0.0)
        self.walkable_up = Vector3()
        self.walkable_pos = Position()
        self.walkable_scale = 0.0
        self.neg_collision_normal = Vector3()
        self.init()

    def init(self) -> None:
        """Reset the fields that retail resets, and no others.

        retail: SPHEREPATH::init 0x0050C330, 04 2.3.
        """
        self.num_sphere = 0
        self.begin_cell: ObjCell | None = None
        self.begin_pos: Position | None = None
        self.curr_cell: ObjCell | None = None
        self.step_up = 0
        self.collide = 0
        self.check_cell: ObjCell | None = None
        self.insert_type = InsertType.TRANSITION
        self.step_down = 0
        self.backup_cell: ObjCell | None = None
        self.obstruction_ethereal = 0
        self.hits_interior_cell = 0
        self.bldg_check = 0
        self.walkable_allowance = 0.0
        self.walkable: Polygon | None = None
        self.check_walkable = 0
        self.cell_array_valid = 0
        self.neg_step_up = 0
        self.neg_poly_hit = 0
        self.placement_allows_sliding = 1

    def init_sphere(self, count: int, spheres: Sequence[Sphere], scale: float) -> None:
        """Take the mover's spheres (object space, metres), scaled.

        retail: SPHEREPATH::init_sphere 0x0050C670, 04 SPI-1…3.
        """
        # SPI-1
        self.num_sphere = min(count, MAX_SPHERES)
        # SPI-2
        for i in range(self.num_sphere):
            local, given = self.local_sphere[i], spheres[i]
            local.center.x = f32(scale * given.center.x)
            local.center.y = f32(scale * given.center.y)
            local.center.z = f32(scale * given.center.z)
            local.radius = f32(scale * given.radius)
        # SPI-3: even without spheres
        first = self.local_sphere[0]
        self.local_low_point.x = first.center.x
        self.local_low_point.y = first.center.y
        self.local_low_point.z = f32(first.center.z - first.radius)

    def init_path(self, begin_cell: ObjCell | None, begin_pos: Position | None, end_pos: Position) -> None:
        """Set where the path begins and ends; no beginning means a placement.

        The check position is not set here.

        retail: SPHEREPATH::init_path 0x0050CE20, 04 SPP-1…4.
        """
        # SPP-1
        self.begin_cell = begin_cell
        self.begin_pos = begin_pos
        self.end_pos = end_pos
        # SPP-2
        self.curr_pos.assign(end_pos if begin_pos is None else begin_pos)
        # SPP-3
        self.curr_cell = begin_cell
        self.cache_global_curr_center()
        # SPP-4
        self.insert_type = InsertType.PLACEMENT if begin_pos is None else InsertType.TRANSITION

    def cache_global_curr_center(self) -> None:
        """Compute the sphere centres at the current position (block coordinates of its cell).

        retail: SPHEREPATH::cache_global_curr_center 0x0050C740, 04 4.
        """
        m = self.curr_pos.frame
        o = m.origin
        for i in range(self.num_sphere):
            c, out = self.local_sphere[i].center, self.global_curr_center[i]
            out.x = f32(((c.x * m.m0 + c.y * m.m3) + c.z * m.m6) + o.x)
            out.y = f32(((m.m7 * c.z + c.x * m.m1) + m.m4 * c.y) + o.y)
            out.z = f32(((m.m8 * c.z + m.m5 * c.y) + m.m2 * c.x) + o.z)

    def cache_global_sphere(self, offset: Vector3 | None) -> None:
        """Move the check position's spheres by `offset`, or compute them from the check position.

        Moving rounds each time, so over a sub-step the result differs from computing anew.

        retail: SPHEREPATH::cache_global_sphere 0x0050C810, 04 4.
        """
        if offset is not None:
            for i in range(self.num_sphere):
                _move(self.global_sphere[i].center, offset)
            _move(self.global_low_point, offset)
            return
        m = self.check_pos.frame
        o = m.origin
        for i in range(self.num_sphere):
            c, out = self.local_sphere[i].center, self.global_sphere[i]
            out.radius = self.local_sphere[i].radius
            out.center.x = f32(((c.x * m.m0 + c.y * m.m3) + c.z * m.m6) + o.x)
            out.center.y = f32(((m.m7 * c.z + c.x * m.m1) + m.m4 * c.y) + o.y)
            out.center.z = f32(((m.m8 * c.z + m.m2 * c.x) + m.m5 * c.y) + o.z)
        low, l = self.global_low_point, self.local_low_point
        low.x = f32(((m.m6 * l.z + m.m0 * l.x) + m.m3 * l.y) + o.x)
        low.y = f32(((m.m7 * l.z + m.m1 * l.x) + m.m4 * l.y) + o.y)
        low.z = f32(((m.m8 * l.z + m.m2 * l.x) + m.m5 * l.y) + o.z)

    def cache_localspace_sphere(self, p: Position, scale: float) -> None:
        """Take the spheres at check and current position into the space of `p`, divided by `scale`.

        retail: SPHEREPATH::cache_localspace_sphere 0x0050C9D0, 04 LS-1…5.
        """
        # LS-1
        inv = f32(1.0 / scale)
        # LS-2
        for i in range(self.num_sphere):
            given, out = self.local_sphere[i], self.localspace_sphere[i]
            out.radius = f32(inv * given.radius)
            _scaled_into(out.center, inv, p.localtolocal(self.check_pos, given.center))
            _scaled_into(self.localspace_curr_center[i], inv, p.localtolocal(self.curr_pos, given.center))
        # LS-3
        self.localspace_pos.assign(p)
        # LS-4
        m, up = p.frame, self.localspace_z
        up.x = f32((m.m1 + m.m0) * 0.0 + m.m2)
        up.y = f32((m.m4 + m.m3) * 0.0 + m.m5)
        up.z = f32((m.m7 + m.m6) * 0.0 + m.m8)
        # LS-5
        s, low = self.localspace_sphere[0], self.localspace_low_point
        a = f32(s.radius * up.y)
        b = f32(s.radius * up.z)
        low.x = f32(s.center.x - s.radius * up.x)
        low.y = f32(s.center.y - a)
        low.z = f32(s.center.z - b)

    def add_offset_to_check_pos(self, offset: Vector3) -> None:
        """Move the check position and its spheres (metres, block coordinates).

        Retail has two overloads that do the same; the second's extra argument, a radius, is never used.

        retail: SPHEREPATH::add_offset_to_check_pos 0x00509D10 and 0x00536A60, 04 AO-1…3.
        """
        # AO-1
        self.cell_array_valid = 0
        # AO-2
        _move(self.check_pos.frame.origin, offset)
        # AO-3
        self.cache_global_sphere(offset)

    def set_check_pos(self, p: Position, cell: ObjCell | None) -> None:
        """Make `p` in `cell` the check position and compute its spheres.

        retail: SPHEREPATH::set_check_pos 0x0050A8B0, 04 4.
        """
        self.check_pos.assign(p)
        self.check_cell = cell
        self.cell_array_valid = 0
        self.cache_global_sphere(None)

    def save_check_pos(self) -> None:
        """Remember the check position in the only backup slot.

        retail: SPHEREPATH::save_check_pos 0x0050A880, 04 4.
        """
        self.backup_cell = self.check_cell
        self.backup_check_pos.assign(self.check_pos)

    def restore_check_pos(self) -> None:
        """Go back to whatever the backup slot holds now.

        retail: SPHEREPATH::restore_check_pos 0x0050B100, 04 4.
        """
        self.set_check_pos(self.backup_check_pos, self.backup_cell)

    def adjust_check_pos(self, cell_id: int) -> None:
        """Re-express the check position in `cell_id`; its spheres move to that block's coordinates.

        retail: SPHEREPATH::adjust_check_pos 0x0050CC00, 04 AC-1…2.
        """
        # AC-1
        if (cell_id & 0xFFFF) < FIRST_INTERIOR_CELL:
            offset = get_block_offset(cell_id, self.check_pos.objcell_id)
            self.cache_global_sphere(offset)
            _move(self.check_pos.frame.origin, offset)
        # AC-2
        self.check_pos.objcell_id = cell_id

    def set_collide(self, normal: Vector3) -> None:
        """Note an airborne hit: the next attempt tries to land. Overwrites the backup slot.

        retail: SPHEREPATH::set_collide 0x005378A0, 04 4.
        """
        self.collide = 1
        self.backup_cell = self.check_cell
        self.backup_check_pos.assign(self.check_pos)
        self.step_up_normal.assign(normal)
        self.walk_interp = 1.0

    def set_neg_poly_hit(self, step_up: int, normal: Vector3) -> None:
        """Note that a polygon was overlapped from behind; its normal is stored negated.

        retail: SPHEREPATH::set_neg_poly_hit 0x005398E0, 04 4.
        """
        self.neg_step_up = step_up
        self.neg_poly_hit = 1
        self.neg_collision_normal.x = -normal.x
        self.neg_collision_normal.y = -normal.y
        self.neg_collision_normal.z = -normal.z

    def set_walkable(
        self, sphere: Sphere, poly: Polygon, zaxis: Vector3, local_pos: Position, scale: float
    ) -> None:
        """Remember the polygon that supports, in its own space. The allowance is not touched.

        retail: SPHEREPATH::set_walkable 0x00539FC0, 04 4.
        """
        self.walkable_check_pos.assign(sphere)
        self.walkable = poly
        self.walkable_up.assign(zaxis)
        self.walkable_pos.assign(local_pos)
        self.walkable_scale = scale

    def set_walkable_check_pos(self, sphere: Sphere) -> None:
        """Replace the sphere that is tested against the remembered polygon (in its space).

        retail: SPHEREPATH::set_walkable_check_pos 0x00509CE0, 04 4.
        """
        self.walkable_check_pos.assign(sphere)

    def is_walkable_allowable(self, z: float) -> bool:
        """Tell whether a polygon normal's z is steep enough to stand on: strictly more than allowed.

        retail: SPHEREPATH::is_walkable_allowable 0x005368D0, 04 4.
        """
        return z > self.walkable_allowance

    def get_walkable_pos(self) -> Position:
        """Return a copy of the space of the remembered polygon.

        retail: SPHEREPATH::get_walkable_pos 0x0050A8F0, 04 4.
        """
        return self.walkable_pos.copy()

    def get_curr_pos_check_pos_block_offset(self) -> Vector3:
        """Return the origin of the check position's block, seen from the current position's block.

        retail: SPHEREPATH::get_curr_pos_check_pos_block_offset 0x00509FD0, 04 4.
        """
        return get_block_offset(self.curr_pos.objcell_id, self.check_pos.objcell_id)

    def check_walkables(self) -> int:
        """Tell whether half the sphere is still above the remembered polygon.

        The half radius stays in the field: a second call tests a quarter.

        retail: SPHEREPATH::check_walkables 0x0050C3E0, 04 CW-1…3.
        """
        # CW-1
        if self.walkable is None:
            return 1
        # CW-2
        self.walkable_check_pos.radius = f32(self.walkable_check_pos.radius * 0.5)
        # CW-3
        return self.walkable.check_walkable(self.walkable_check_pos, self.walkable_up)

    def step_up_slide(self, _object_info: ObjectInfo, collisions: CollisionInfo) -> TransitionState:
        """Slide along what could not be stepped upon; ends the stepping up.

        retail: SPHEREPATH::step_up_slide 0x0050C3B0, 04 SS-1…2.
        """
        # SS-1
        collisions.contact_plane_valid = 0
        collisions.contact_plane_is_water = 0
        self.step_up = 0
        # SS-2
        return self.global_sphere[0].slide_sphere(
            self, collisions, self.step_up_normal, self.global_curr_center[0]
        )

    def precipice_slide(self, collisions: CollisionInfo) -> TransitionState:
        """Slide along the edge of the walkable polygon that the sphere is about to leave.

        retail: SPHEREPATH::precipice_slide 0x0050CC80, 04 PS-1…7.
        """
        # PS-1
        walkable = self.walkable
        if walkable is None:
            message = "precipice_slide without a walkable polygon: the caller must have one (04 PS-1)"
            raise ValueError(message)
        n = Vector3()
        found = walkable.find_crossed_edge(self.walkable_check_pos, self.walkable_up, n)
        # PS-2
        if not found:
            self.walkable = None
            return TransitionState.COLLIDED
        # PS-3
        self.walkable = None
        self.step_up = 0
        # PS-4
        m = self.walkable_pos.frame
        g = Vector3(
            f32((n.z * m.m6 + n.x * m.m0) + n.y * m.m3),
            f32((n.z * m.m7 + n.x * m.m1) + n.y * m.m4),
            f32((n.z * m.m8 + n.x * m.m2) + n.y * m.m5),
        )
        # PS-5
        b = self.get_curr_pos_check_pos_block_offset()
        s, c = self.global_sphere[0].center, self.global_curr_center[0]
        dx = s.x - c.x
        dy = s.y - c.y
        dz = f32(s.z - c.z)
        x = f32(b.x + dx)
        t = (g.z * (b.z + dz) + (b.y + dy) * g.y) + x * g.x
        # PS-6
        if t > 0.0:
            g = Vector3(f32(g.x * -1.0), f32(g.y * -1.0), f32(g.z * -1.0))
        # PS-7
        return self.global_sphere[0].slide_sphere(self, collisions, g, c)


def _two_spheres() -> list[Sphere]:
    return [Sphere(Vector3(), 0.0) for _ in range(MAX_SPHERES)]


def _move(point: Vector3, offset: Vector3) -> None:
    point.x = f32(point.x + offset.x)
    point.y = f32(point.y + offset.y)
    point.z = f32(point.z + offset.z)


def _scaled_into(out: Vector3, factor: float, v: Vector3) -> None:
    out.x = f32(factor * v.x)
    out.y = f32(factor * v.y)
    out.z = f32(factor * v.z)
