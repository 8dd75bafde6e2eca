"""The specified functions that have no port, each with its reason.

A function that gets its port leaves this table: a test fails for a line that is no longer true, and
for a function of the specification that is neither ported nor here.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

if TYPE_CHECKING:
    from collections.abc import Mapping

FILES: Final = "file layout, not behaviour: scenes come as plain data"
POOL: Final = "a pool of ten is not needed: every transition is new, and stale fields start at zero"
UNSPECIFIED: Final = "needs Frame::subtract2, which no document specifies; nothing in movement calls it"
SPHERES: Final = "document 07, spheres as obstacles: not yet"
CYLINDERS: Final = "document 07, cylinders as obstacles: not yet"
REGISTRATION: Final = "documents 08 and 09, registration of objects in cells: not yet, shadow lists are given"
OUTDOORS: Final = "document 09, outdoor cells and buildings: not yet"
TERRAIN: Final = "document 10, terrain, water and land cells: not yet"

NOT_PORTED: Final[Mapping[str, str]] = {
    "0x00555A90": UNSPECIFIED,  # Position::subtract2
    "0x00538650": FILES,  # CPolygon::UnPack
    "0x0053C030": FILES,  # CVertexArray::UnPack
    "0x00539830": FILES,  # BSPTREE::UnPack
    "0x0050B150": POOL,  # CTransition::makeTransition
    "0x00509DC0": POOL,  # CTransition::cleanupTransition
    "0x005369E0": SPHERES,  # CSphere::collides_with_sphere
    "0x005368F0": SPHERES,  # CSphere::find_time_of_collision
    "0x00536D20": SPHERES,  # CSphere::step_sphere_down
    "0x00537900": SPHERES,  # CSphere::step_sphere_up
    "0x00536F40": SPHERES,  # CSphere::slide_sphere
    "0x00537A10": SPHERES,  # CSphere::slide_sphere
    "0x005379A0": SPHERES,  # CSphere::land_on_sphere
    "0x00537230": SPHERES,  # CSphere::collide_with_point
    "0x00537A80": SPHERES,  # CSphere::intersects_sphere (global form)
    "0x00537FD0": SPHERES,  # CSphere::intersects_sphere (local form)
    "0x0053A880": CYLINDERS,  # CCylSphere::collides_with_sphere
    "0x0053A9B0": CYLINDERS,  # CCylSphere::step_sphere_down
    "0x0053AB50": CYLINDERS,  # CCylSphere::normal_of_collision
    "0x0053ACB0": CYLINDERS,  # CCylSphere::collide_with_point
    "0x0053B2A0": CYLINDERS,  # CCylSphere::slide_sphere
    "0x0053B310": CYLINDERS,  # CCylSphere::step_sphere_up
    "0x0053B3D0": CYLINDERS,  # CCylSphere::land_on_cylinder
    "0x0053B440": CYLINDERS,  # CCylSphere::intersects_sphere (global form)
    "0x0053B8F0": CYLINDERS,  # CCylSphere::intersects_sphere (local form)
    "0x00515160": REGISTRATION,  # CPhysicsObj::calc_cross_cells_static
    "0x00515230": REGISTRATION,  # CPhysicsObj::calc_cross_cells
    "0x00510FC0": REGISTRATION,  # CPhysicsObj::find_bbox_cell_list
    "0x00514AE0": REGISTRATION,  # CPhysicsObj::add_shadows_to_cells
    "0x0052B280": REGISTRATION,  # CObjCell::add_shadow_object, remove_shadow_object
    "0x00532D60": OUTDOORS,  # CLandCell::find_collisions
    "0x005340A0": OUTDOORS,  # CSortCell::find_collisions
    "0x006B5300": OUTDOORS,  # CBuildingObj::find_building_collisions
    "0x0052CAE0": REGISTRATION,  # CEnvCell::find_transit_cells
    "0x0052C5D0": OUTDOORS,  # CEnvCell::check_building_transit
    "0x0052C680": REGISTRATION,  # CEnvCell::check_building_transit
    "0x0052B990": REGISTRATION,  # CObjCell::find_cell_list
    "0x0052B9F0": REGISTRATION,  # CObjCell::find_cell_list
    "0x00532EC0": OUTDOORS,  # CLandCell::add_outside_cell
    "0x00533260": OUTDOORS,  # CLandCell::check_add_cell_boundary
    "0x00533630": OUTDOORS,  # CLandCell::add_all_outside_cells
    "0x00533360": REGISTRATION,  # CLandCell::add_all_outside_cells
    "0x004979A0": TERRAIN,  # LandDefs::inbound_valid_cellid
    "0x00497A90": TERRAIN,  # LandDefs::gid_to_lcoord
    "0x0050E800": TERRAIN,  # LandDefs::within_block
    "0x004527B0": TERRAIN,  # Position::get_outside_cell_id
    "0x00531FD0": FILES,  # CLandBlockStruct::UnPack
    "0x005328D0": TERRAIN,  # CLandBlockStruct::ConstructVertices
    "0x00531D10": TERRAIN,  # CLandBlockStruct::ConstructPolygons
    "0x005310D0": TERRAIN,  # CLandBlockStruct::AddPolygon
    "0x00532BB0": TERRAIN,  # CLandBlockStruct::generate
    "0x00505E40": TERRAIN,  # LScape::get_landblock
    "0x00505F10": TERRAIN,  # LScape::get_landcell
    "0x0052FD20": TERRAIN,  # CLandBlock::get_landcell
    "0x00532CF0": TERRAIN,  # CLandCell::find_terrain_poly
    "0x00532D40": TERRAIN,  # CLandCell::point_in_cell
    "0x00531550": TERRAIN,  # CLandBlockStruct::CalcCellWater
    "0x005327E0": TERRAIN,  # CLandBlockStruct::CalcWater
    "0x0052B8A0": TERRAIN,  # CObjCell::get_water_depth
    "0x005315F0": TERRAIN,  # CLandBlockStruct::calc_water_depth
    "0x00532F20": TERRAIN,  # CLandCell::find_env_collisions
}
"""Reason by address, in the order of the documents."""
