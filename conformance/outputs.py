"""The output fields of every operation: those of ``vectors/FORMAT.md`` in its order, then our own."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from conformance.output_shapes import (
    ACCELERATED,
    ANSWER,
    BITS,
    CELL,
    COUNT,
    DOUBLE,
    FLAG,
    FLOAT,
    MATRIX,
    MOVED,
    OPTIONAL_POINT,
    PLANE,
    POINT,
    POINTS,
    POLYGON,
    QUATERNION,
    SEEDED_PLANE,
    SPHERES,
    STATE,
    TEXT,
    WRITTEN_BACK,
    only,
    state,
)
from conformance.own_operations import OWN_OUTPUTS
from conformance.shapes import Block, Listing, Nullable
from conformance.tick_names import TICK_NAMES

if TYPE_CHECKING:
    from collections.abc import Mapping

    from conformance.shapes import Shape

_TICK_FIELDS: Final[dict[str, Shape]] = {
    "r": ANSWER,
    "t": TEXT,
    "pos": POINT,
    "rot": QUATERNION,
    "cell": CELL,
    "cp": PLANE,
    "cp_cell": CELL,
    "onw": FLAG,
    "water": FLAG,
    "sn": POINT,
    "cn": POINT,
    "fsf": COUNT,
    "env": FLAG,
    "objs": Listing(COUNT),
    "kill": COUNT,
}
_BODY_TICK_FIELDS: Final[dict[str, Shape]] = {
    **_TICK_FIELDS,
    "r": TEXT,
    "v": POINT,
    "ts": BITS,
    "state": BITS,
    "cell_object": CELL,
    "om": POINT,
    "cv": POINT,
    "cwe": FLAG,
}
_GATE_STEP: Final = Block(
    {
        "gate": TEXT,
        "last_update": DOUBLE,
        "quanta": Listing(FLOAT),
        "curr": Listing(DOUBLE),
        "update_time": DOUBLE,
        "transient_state": BITS,
    },
    optional=frozenset({"quanta", "curr", "update_time", "transient_state"}),
)


def _ticks(fields: dict[str, Shape], required: set[str]) -> Block:
    tick = Block(fields, optional=frozenset(fields.keys() - required), names=TICK_NAMES)
    return Block({"ticks": Listing(tick, step="tick")})


_BODY_MOVED: Final[dict[str, Shape]] = {
    "origin": POINT,
    "rotation": QUATERNION,
    "velocity": POINT,
    "transient_state": BITS,
}
_SLID: Final[dict[str, Shape]] = {
    "check_origin": POINT,
    "global_spheres": POINTS,
    "collision_normal": OPTIONAL_POINT,
    "sliding_valid": FLAG,
}
_VELOCITY_SET: Final = only(velocity=POINT, jumped=FLAG, transient_state=BITS, update_time=DOUBLE)
_CELL_LIST: Final[dict[str, Shape]] = {"cells": Listing(Listing(CELL)), "added_outside": FLAG}
_TRANSIT: Final = Block({**_CELL_LIST, "hits_interior_cell": FLAG})
_LCOORD: Final = Block({"r": FLAG, "x": COUNT, "y": COUNT}, optional=frozenset({"x", "y"}))

OUTPUTS: Final[Mapping[str, Block]] = {
    # math
    "frame_cache": only(m=MATRIX),
    "frame_set_rotate": only(q=QUATERNION, m=MATRIX),
    "frame_localtoglobal": MOVED,
    "frame_globaltolocal": MOVED,
    "frame_localtoglobalvec": MOVED,
    "frame_globaltolocalvec": MOVED,
    "position_localtoglobal": MOVED,
    "position_localtolocal": MOVED,
    "position_localtoglobalvec": MOVED,
    "position_globaltolocalvec": MOVED,
    "position_get_offset": MOVED,
    "block_offset": MOVED,
    "plane_localtoglobal": only(plane=PLANE),
    "normalize_check_small": only(small=FLAG, v=POINT),
    "interpolate_rotation": only(q=QUATERNION),
    "snap_to_plane": MOVED,
    "frame_is_equal": only(r=FLAG),
    "cache_localspace_sphere": only(
        spheres=SPHERES, curr=POINTS, z=POINT, low_point=POINT, global_spheres=POINTS, global_curr=POINTS
    ),
    "slide_sphere": Block({"result": STATE, "normal": POINT, **_SLID}),
    "adjust_offset": Block({"offset": POINT, **_SLID}),
    "cliff_slide": Block({"result": STATE, **_SLID}),
    # polygon
    "polygon_make_plane": only(plane=PLANE),
    "polygon_point_in_polygon": only(r=FLAG),
    "polygon_point_in_poly2D": only(r=FLAG),
    "polygon_hits_sphere_fast": only(r=FLAG, contact=OPTIONAL_POINT),
    "polygon_hits_sphere_slow": only(r=FLAG, contact=OPTIONAL_POINT),
    "polygon_pos_hits_sphere": only(r=FLAG, struck=FLAG, contact=OPTIONAL_POINT),
    "polygon_walkable_hits_sphere": only(r=FLAG),
    "polygon_check_walkable": only(r=FLAG),
    "polygon_check_small_walkable": only(r=FLAG),
    "polygon_find_crossed_edge": only(r=FLAG, normal=OPTIONAL_POINT),
    "polygon_adjust_sphere_to_plane": only(r=FLAG, center=POINT, walk_interp=FLOAT),
    "polygon_adjust_sphere_to_poly": only(t=DOUBLE),
    "polygon_adjust_to_placement_poly": only(center=POINT, other_center=POINT),
    # bsp
    "bsp_point_intersects_solid": only(r=FLAG),
    "bsp_sphere_intersects_poly": only(r=FLAG, poly=POLYGON, contact=OPTIONAL_POINT),
    "bsp_sphere_intersects_solid": only(r=FLAG),
    "bsp_hits_walkable": only(r=FLAG),
    "bsp_find_walkable": only(changed=FLAG, poly=POLYGON, center=POINT, walk_interp=FLOAT),
    "bsp_sphere_intersects_solid_poly": only(r=FLAG, center_solid=FLAG, poly=POLYGON),
    "bsp_adjust_to_plane": only(r=FLAG, center=POINT),
    "bsp_point_inside_cell": only(r=FLAG),
    "bsp_sphere_intersects_cell": only(r=COUNT),
    # calls and transitions
    "find_collisions": state({"dispatch": TEXT, "result": STATE}),
    "transition": state({"result": FLAG}),
    "object_call": state({"result": STATE}, objects=True),
    "object_transition": state({"result": FLAG}, objects=True),
    "world_transition": state({"result": FLAG}, objects=True),
    "land_find_env_collisions": state({"result": STATE}),
    "land_validate_walkable": state({"result": STATE}),
    "find_time_of_collision": only(t=DOUBLE),
    # terrain
    "landdefs_gid_to_lcoord": _LCOORD,
    "landdefs_blockid_to_lcoord": _LCOORD,
    "landdefs_inbound_valid_cellid": only(r=FLAG),
    "landdefs_lcoord_to_gid": only(id=CELL),
    "landdefs_get_outside_lcoord": _LCOORD,
    "landdefs_adjust_to_outside": only(r=FLAG, cell=CELL, point=POINT),
    "landdefs_get_block_offset": MOVED,
    "terrain_split": only(cuts=TEXT),
    "terrain_block": only(
        water_type=COUNT,
        cells=Listing(
            only(id=CELL, sw_ne=FLAG, water=COUNT, origin=POINT, planes=Listing(PLANE)),
        ),
    ),
    "land_find_terrain_poly": only(r=FLAG, poly=POLYGON, water_depth=FLOAT),
    # cells
    "add_all_outside_cells": Block(_CELL_LIST),
    "find_cell_list": Block(
        {
            "cells": Listing(Listing(CELL)),
            "new_cell": Nullable(ANSWER),
            "hits_interior_cell": FLAG,
            "added_outside": FLAG,
        }
    ),
    "find_transit_cells": _TRANSIT,
    "check_building_transit": _TRANSIT,
    "point_in_cell": only(r=FLAG),
    "cross_cells": Block(_CELL_LIST),
    # the tick
    "update_physics": Block(_BODY_MOVED),
    "update_position": Block(_BODY_MOVED),
    "calc_friction": only(velocity=POINT),
    "calc_acceleration": Block(ACCELERATED),
    "set_velocity": _VELOCITY_SET,
    "set_local_velocity": _VELOCITY_SET,
    "set_on_walkable": Block({"transient_state": BITS, **ACCELERATED}),
    "clear_transient_states": Block({"transient_state": BITS, **ACCELERATED}),
    "handle_all_collisions": only(
        r=FLAG, velocity=POINT, transient_state=BITS, state=BITS, colliding_with_environment=FLAG
    ),
    "set_position": Block(WRITTEN_BACK),
    "seed": Block(
        {
            "flags": BITS,
            "state": BITS,
            "scale": FLOAT,
            "step_up_height": FLOAT,
            "step_down_height": FLOAT,
            "ethereal": BITS,
            "step_down": FLAG,
            "contact_plane": SEEDED_PLANE,
            "last_known_contact_plane": SEEDED_PLANE,
            "sliding_normal": OPTIONAL_POINT,
            "frames_stationary_fall": COUNT,
        }
    ),
    "update_object_gates": Block(
        {"steps": Listing(_GATE_STEP, step="step"), "player_distance": FLOAT},
        optional=frozenset({"player_distance"}),
    ),
    # walks
    "walk": _ticks(_TICK_FIELDS, {"r"}),
    "world_walk": _ticks(_TICK_FIELDS, {"r"}),
    "body_walk": _ticks(_BODY_TICK_FIELDS, {"r", "pos", "v", "ts"}),
    # ours
    **OWN_OUTPUTS,
}
"""What each operation answers, by its name."""
