"""SPHEREPATH: what each helper stores, and what it leaves alone."""

from __future__ import annotations

import math

import pytest
from oracle_worlds import CELL, FLOOR, OTHER_CELL, RADIUS, ScriptedCell, at, polygon, vec, xyz

from oracle.arithmetic import f32
from oracle.collision_info import CollisionInfo
from oracle.constants import FLOOR_Z
from oracle.enums import InsertType, TransitionState
from oracle.frame import Frame
from oracle.object_info import ObjectInfo
from oracle.position import Position
from oracle.sphere import Sphere
from oracle.sphere_path import SpherePath

OUTDOOR_EAST = 0xAAB40001
"""A land cell of the block east of `CELL`'s."""


def path_at(x: float, y: float, z: float) -> SpherePath:
    """Return a one-sphere path whose current and check position are the same."""
    sp = SpherePath()
    sp.init_sphere(1, [Sphere(vec(0.0, 0.0, 0.0), RADIUS)], 1.0)
    sp.init_path(None, at(x, y, z), at(x, y, z))
    sp.set_check_pos(sp.curr_pos, None)
    return sp


def test_spheres_are_scaled_and_at_most_two() -> None:
    """SPI-1…3: each product is rounded, a third sphere is dropped, the low point is sphere 0's."""
    sp = SpherePath()
    scale = f32(1.1)
    sp.init_sphere(3, [Sphere(vec(0.1, 0.2, 0.3), f32(0.4)) for _ in range(3)], scale)
    assert sp.num_sphere == 2
    local = sp.local_sphere[1]
    assert (*xyz(local.center), local.radius) == tuple(f32(scale * f32(v)) for v in (0.1, 0.2, 0.3, 0.4))
    assert xyz(sp.local_low_point) == (local.center.x, local.center.y, f32(local.center.z - local.radius))


def test_a_path_without_beginning_is_a_placement() -> None:
    """SPP-2, SPP-4: the current position is the end; the check position is not set."""
    sp = SpherePath()
    sp.init_path(None, None, at(1.0, 2.0, 3.0))
    assert sp.insert_type == InsertType.PLACEMENT
    assert xyz(sp.curr_pos.frame.origin) == (1.0, 2.0, 3.0)
    assert xyz(sp.check_pos.frame.origin) == (0.0, 0.0, 0.0)


def test_moving_the_spheres_accumulates_rounding() -> None:
    """AO-3: three moves round three times; computing anew from the frame gives other bits."""
    sp = SpherePath()
    sp.init_sphere(1, [Sphere(vec(0.1, 0.0, 0.0), RADIUS)], 1.0)
    sp.init_path(None, at(7.3, 0.0, 0.0), at(7.3, 0.0, 0.0))
    sp.set_check_pos(sp.curr_pos, None)
    step, x = vec(0.3, 0.0, 0.0), f32(f32(0.1) + f32(7.3))
    for _ in range(3):
        sp.add_offset_to_check_pos(step)
        x = f32(x + step.x)
    moved = sp.global_sphere[0].center.x
    assert moved == x
    sp.cache_global_sphere(None)
    assert sp.global_sphere[0].center.x != moved


def test_the_backup_slot_is_single() -> None:
    """set_collide overwrites what save_check_pos has stored, and restoring takes the later one."""
    sp = path_at(1.0, 0.0, 0.0)
    sp.save_check_pos()
    sp.add_offset_to_check_pos(vec(2.0, 0.0, 0.0))
    sp.set_collide(vec(0.0, 0.0, 1.0))
    sp.add_offset_to_check_pos(vec(4.0, 0.0, 0.0))
    sp.restore_check_pos()
    assert xyz(sp.check_pos.frame.origin) == (3.0, 0.0, 0.0)
    assert (sp.collide, sp.walk_interp) == (1, 1.0)


def test_a_hit_in_the_air_saves_the_cell_too() -> None:
    """set_collide stores the check cell with the check position."""
    sp, cell = path_at(1.0, 0.0, 0.0), ScriptedCell([])
    sp.check_cell = cell
    sp.set_collide(vec(0.0, 0.0, 1.0))
    sp.check_cell = None
    sp.restore_check_pos()
    assert sp.check_cell is cell


def test_the_low_point_turns_and_moves_with_the_check_position() -> None:
    """Forms A and B of cache_global_sphere: y term last, then the origin; moved by each offset."""
    sp = SpherePath()
    sp.init_sphere(1, [Sphere(vec(0.1, 0.2, 0.3), RADIUS)], 1.0)
    turned = Position(CELL, Frame.unpack(vec(7.3, 3.1, 9.2), f32(0.8), f32(0.36), f32(0.48), 0.0))
    sp.init_path(None, turned, turned)
    sp.set_check_pos(turned, None)
    low = turned.frame.localtoglobal(sp.local_low_point)
    assert xyz(sp.global_low_point) == xyz(low)
    sp.add_offset_to_check_pos(vec(0.25, 0.5, -0.75))
    assert xyz(sp.global_low_point) == (f32(low.x + 0.25), f32(low.y + 0.5), f32(low.z - 0.75))


def test_check_walkables_halves_the_stored_radius_each_time() -> None:
    """CW-2: the half radius stays in the field; a second call tests a quarter."""
    sp = path_at(0.0, 0.0, 0.4)
    sphere = Sphere(vec(0.0, 0.0, 0.4), RADIUS)
    sp.set_walkable(sphere, polygon(FLOOR), vec(0.0, 0.0, 1.0), Position(CELL), 1.0)
    assert sp.check_walkables() == 1
    assert sp.check_walkables() == 1
    assert sp.walkable_check_pos.radius == RADIUS * 0.25
    assert sphere.radius == RADIUS


def test_check_walkables_without_a_polygon_agrees() -> None:
    """CW-1: nothing known counts as supported, and no radius is touched."""
    sp = path_at(0.0, 0.0, 0.0)
    sp.walkable_check_pos.radius = 1.0
    assert sp.check_walkables() == 1
    assert sp.walkable_check_pos.radius == 1.0


def test_the_walkable_limit_is_strict() -> None:
    """A normal z equal to the allowance is refused."""
    sp = SpherePath()
    sp.walkable_allowance = FLOOR_Z
    assert not sp.is_walkable_allowable(FLOOR_Z)
    assert sp.is_walkable_allowable(math.nextafter(FLOOR_Z, 1.0))


def test_set_walkable_leaves_the_allowance() -> None:
    """The polygon, its space and sphere are copied; the allowance is not touched."""
    sp = path_at(0.0, 0.0, 0.0)
    sp.walkable_allowance = 0.25
    space = at(1.0, 2.0, 3.0)
    sp.set_walkable(Sphere(vec(1.0, 0.0, 0.0), 0.5), polygon(FLOOR), vec(0.0, 0.0, 1.0), space, 2.0)
    space.frame.origin.x = 9.0
    assert sp.walkable_allowance == 0.25
    assert xyz(sp.get_walkable_pos().frame.origin) == (1.0, 2.0, 3.0)
    assert sp.walkable_scale == 2.0


def test_a_negative_hit_stores_the_negated_normal() -> None:
    """set_neg_poly_hit negates each component."""
    sp = SpherePath()
    sp.set_neg_poly_hit(1, vec(0.5, -0.25, 1.0))
    assert (sp.neg_step_up, sp.neg_poly_hit) == (1, 1)
    assert xyz(sp.neg_collision_normal) == (-0.5, 0.25, -1.0)


def test_an_interior_cell_changes_only_the_id() -> None:
    """AC-2: coordinates stay for an interior id."""
    sp = path_at(1.0, 2.0, 3.0)
    sp.adjust_check_pos(OTHER_CELL)
    assert sp.check_pos.objcell_id == OTHER_CELL
    assert xyz(sp.check_pos.frame.origin) == (1.0, 2.0, 3.0)


def test_a_land_cell_of_the_next_block_moves_the_coordinates() -> None:
    """AC-1: check position and spheres go to the new block; the current position stays."""
    sp = path_at(193.0, 2.0, 3.0)
    sp.adjust_check_pos(OUTDOOR_EAST)
    assert xyz(sp.check_pos.frame.origin) == (1.0, 2.0, 3.0)
    assert xyz(sp.global_sphere[0].center) == (1.0, 2.0, 3.0)
    assert xyz(sp.curr_pos.frame.origin) == (193.0, 2.0, 3.0)
    assert xyz(sp.get_curr_pos_check_pos_block_offset()) == (192.0, 0.0, 0.0)


def test_local_space_is_divided_by_a_stored_inverse() -> None:
    """LS-1: the inverse of the scale is rounded to float32 before it multiplies."""
    sp = path_at(1.0, 0.0, 0.0)
    sp.cache_localspace_sphere(at(0.0, 0.0, 0.0), 3.0)
    inv = f32(1.0 / 3.0)
    assert sp.localspace_sphere[0].radius == f32(inv * RADIUS)
    assert sp.localspace_sphere[0].center.x == inv


@pytest.mark.parametrize(("yaw", "x_sign", "y_sign"), [(0.5, 1.0, 1.0), (1.0, 1.0, -1.0), (-1.0, -1.0, 1.0)])
def test_a_negative_zero_of_local_up_depends_on_the_product(yaw: float, x_sign: float, y_sign: float) -> None:
    """LS-4: a zero product of positive sign turns -0 into +0, one of negative sign does not."""
    sp = path_at(0.0, 0.0, 0.0)
    frame = Frame.unpack(vec(0.0, 0.0, 0.0), f32(math.cos(yaw / 2.0)), 0.0, 0.0, f32(math.sin(yaw / 2.0)))
    frame.m2 = frame.m5 = -0.0
    sp.cache_localspace_sphere(Position(CELL, frame), 1.0)
    up = sp.localspace_z
    assert xyz(up) == (0.0, 0.0, frame.m8)
    assert (math.copysign(1.0, up.x), math.copysign(1.0, up.y)) == (x_sign, y_sign)


def test_the_low_point_lies_against_local_up() -> None:
    """LS-5: a radius below the centre, along the world's z axis in that space."""
    sp = path_at(0.0, 0.0, 2.0)
    sp.cache_localspace_sphere(at(0.0, 0.0, 0.0), 1.0)
    assert xyz(sp.localspace_low_point) == (0.0, 0.0, f32(2.0 - RADIUS))


def test_step_up_slide_ends_the_step_and_forgets_the_contact() -> None:
    """SS-1: the step flag and the contact plane are cleared before the slide."""
    sp, ci = path_at(0.0, 0.0, 0.0), CollisionInfo()
    ci.contact_plane_valid = ci.contact_plane_is_water = sp.step_up = 1
    sp.step_up_normal.assign(vec(-1.0, 0.0, 0.0))
    sp.add_offset_to_check_pos(vec(0.5, 0.25, 0.0))
    assert sp.step_up_slide(ObjectInfo(), ci) == TransitionState.SLID
    assert (sp.step_up, ci.contact_plane_valid, ci.contact_plane_is_water) == (0, 0, 0)
    assert xyz(sp.check_pos.frame.origin) == (0.0, 0.25, 0.0)


def test_step_up_slide_lends_out_its_own_normal() -> None:
    """SS-2: the slide's last branch overwrites the path's step_up_normal."""
    sp, ci = path_at(0.0, 0.0, 0.0), CollisionInfo()
    ci.last_known_contact_plane.N.assign(vec(1.0, 0.0, 0.0))
    sp.step_up_normal.assign(vec(-1.0, 0.0, 0.0))
    sp.add_offset_to_check_pos(vec(0.5, 0.0, 0.0))
    assert sp.step_up_slide(ObjectInfo(), ci) == TransitionState.COLLIDED
    assert xyz(sp.step_up_normal) == (-1.0, 0.0, 0.0)
    assert xyz(ci.collision_normal) == (-1.0, 0.0, 0.0)


@pytest.mark.parametrize("dx", [1.0, -1.0])
def test_a_precipice_is_slid_along_from_either_direction(dx: float) -> None:
    """PS-4…7: the crossed edge's normal is turned against the movement; what remains goes along it."""
    sp, ci = path_at(5.0, 0.0, 0.48), CollisionInfo()
    sp.init_path(None, at(5.0, 0.0, 0.48), at(5.0, 0.0, 0.48))
    ci.last_known_contact_plane.N.assign(vec(0.0, 0.0, 1.0))
    outside = Sphere(vec(6.0, 0.0, 0.48), RADIUS)
    sp.set_walkable(outside, polygon(FLOOR), vec(0.0, 0.0, 1.0), Position(CELL), 1.0)
    sp.step_up = 1
    sp.add_offset_to_check_pos(vec(dx, 0.5, 0.0))
    assert sp.precipice_slide(ci) == TransitionState.SLID
    assert xyz(ci.collision_normal) == (-dx, 0.0, 0.0)
    assert xyz(sp.check_pos.frame.origin) == (5.0, 0.5, f32(0.48))
    assert (sp.walkable, sp.step_up) == (None, 0)


@pytest.mark.parametrize("dz", [0.25, -0.25])
def test_a_precipice_is_turned_out_of_its_polygons_space(dz: float) -> None:
    """PS-4…6: in a space turned by 90 degrees about y the edge's normal is upright, and z decides."""
    sp, ci = path_at(0.0, 0.0, 1.0), CollisionInfo()
    quarter = f32(math.sqrt(0.5))
    space = Position(CELL, Frame.unpack(vec(0.0, 0.0, 0.0), quarter, 0.0, quarter, 0.0))
    outside = Sphere(vec(6.0, 0.0, 0.4), RADIUS)
    sp.set_walkable(outside, polygon(FLOOR), vec(0.0, 0.0, 1.0), space, 1.0)
    sp.add_offset_to_check_pos(vec(0.0, 0.5, dz))
    sp.precipice_slide(ci)
    assert xyz(ci.collision_normal) == pytest.approx((0.0, 0.0, -math.copysign(1.0, dz)), abs=1e-6)


def test_a_precipice_without_a_crossed_edge_collides() -> None:
    """PS-2: above the polygon there is no edge; the polygon is forgotten, the step flag stays."""
    sp = path_at(0.0, 0.0, 0.4)
    sp.set_walkable(sp.global_sphere[0], polygon(FLOOR), vec(0.0, 0.0, 1.0), Position(CELL), 1.0)
    sp.step_up = 1
    assert sp.precipice_slide(CollisionInfo()) == TransitionState.COLLIDED
    assert (sp.walkable, sp.step_up) == (None, 1)


def test_a_precipice_needs_a_polygon() -> None:
    """PS-1: retail's callers guarantee it; here its absence is an error, not a crash."""
    with pytest.raises(ValueError, match="PS-1"):
        path_at(0.0, 0.0, 0.0).precipice_slide(CollisionInfo())


def test_init_keeps_what_retail_keeps() -> None:
    """The end position and the local spheres are not reset, the walkable polygon and flags are."""
    sp = path_at(1.0, 0.0, 0.0)
    sp.walkable, sp.placement_allows_sliding, sp.check_cell = polygon(FLOOR), 0, ScriptedCell([])
    sp.init()
    assert (sp.num_sphere, sp.walkable, sp.check_cell, sp.placement_allows_sliding) == (0, None, None, 1)
    assert sp.end_pos is not None
    assert sp.local_sphere[0].radius == RADIUS
