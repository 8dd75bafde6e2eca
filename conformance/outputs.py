"""The output fields of every operation of ``vectors/FORMAT.md``, in its order."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from conformance.shapes import Block, Kind, Listing, Nullable, Scalar, Vector
from conformance.tick_names import TICK_NAMES

if TYPE_CHECKING:
    from collections.abc import Mapping

    from conformance.shapes import Shape

FLOAT: Final = Scalar(Kind.FLOAT32)
DOUBLE: Final = Scalar(Kind.FLOAT64)
FLAG: Final = Scalar(Kind.FLAG)
COUNT: Final = Scalar(Kind.COUNT)
STATE: Final = Scalar(Kind.STATE)
BITS: Final = Scalar(Kind.BITS)
MOVER_BITS: Final = Scalar(Kind.MOVER_BITS)
CELL: Final = Scalar(Kind.CELL)
POLYGON: Final = Nullable(Scalar(Kind.POLYGON))
TEXT: Final = Scalar(Kind.TEXT)
ANSWER: Final = Scalar(Kind.ANSWER)
POINT: Final = Vector(("x", "y", "z"))
OPTIONAL_POINT: Final = Nullable(POINT)
QUATERNION: Final = Vector(("w", "x", "y", "z"))
PLANE: Final = Vector(("n.x", "n.y", "n.z", "d"))
MATRIX: Final = Vector(tuple(f"m{i}" for i in range(9)))
POINTS: Final = Listing(POINT)
SPHERES: Final = Listing(Vector(("x", "y", "z", "r")))

POSE: Final = Block({"cell": CELL, "origin": POINT, "rotation": QUATERNION})
SEEDED_PLANE: Final = Block(
    {"valid": FLAG, "plane": PLANE, "cell_id": CELL, "is_water": FLAG},
    optional=frozenset({"plane", "cell_id", "is_water"}),
    silent=frozenset({"plane"}),
)

_STATE_FIELDS: Final[dict[str, Shape]] = {
    "trace": TEXT,
    "check": POSE,
    "curr": POSE,
    "check_cell": CELL,
    "curr_cell": CELL,
    "global_spheres": POINTS,
    "contact_plane": SEEDED_PLANE,
    "last_known_contact_plane": SEEDED_PLANE,
    "collision_normal": OPTIONAL_POINT,
    "sliding_normal": OPTIONAL_POINT,
    "walkable": POLYGON,
    "walkable_geometry": TEXT,
    "walk_interp": FLOAT,
    "walkable_allowance": FLOAT,
    "collide": FLAG,
    "step_up": FLAG,
    "step_up_normal": POINT,
    "neg_poly_hit": FLAG,
    "neg_step_up": FLAG,
    "neg_normal": POINT,
    "frames_stationary_fall": COUNT,
    "collided_with_environment": FLAG,
    "state": MOVER_BITS,
    "kill_velocity": COUNT,
}
_OBJECT_FIELDS: Final[dict[str, Shape]] = {
    "collide_objects": Listing(COUNT),
    "last_collided": COUNT,
    "obstruction_ethereal": FLAG,
    "hits_interior_cell": FLAG,
}
_WHEN_SET: Final = frozenset({"walkable_geometry", "neg_step_up", "neg_normal"})


def _only(**fields: Shape) -> Block:
    return Block(fields)


def _state(first: dict[str, Shape], *, objects: bool = False) -> Block:
    more = _OBJECT_FIELDS if objects else {}
    return Block({**first, **_STATE_FIELDS, **more}, optional=_WHEN_SET)


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


_MOVED: Final = _only(v=POINT)
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
_ACCELERATED: Final[dict[str, Shape]] = {"acceleration": POINT, "omega": POINT}
_VELOCITY_SET: Final = _only(velocity=POINT, jumped=FLAG, transient_state=BITS, update_time=DOUBLE)
_CELL_LIST: Final[dict[str, Shape]] = {"cells": Listing(Listing(CELL)), "added_outside": FLAG}
_TRANSIT: Final = Block({**_CELL_LIST, "hits_interior_cell": FLAG})
_LCOORD: Final = Block({"r": FLAG, "x": COUNT, "y": COUNT}, optional=frozenset({"x", "y"}))

OUTPUTS: Final[Mapping[str, Block]] = {
    # math
    "frame_cache": _only(m=MATRIX),
    "frame_set_rotate": _only(q=QUATERNION, m=MATRIX),
    "frame_localtoglobal": _MOVED,
    "frame_globaltolocal": _MOVED,
    "frame_localtoglobalvec": _MOVED,
    "frame_globaltolocalvec": _MOVED,
    "position_localtoglobal": _MOVED,
    "position_localtolocal": _MOVED,
    "position_localtoglobalvec": _MOVED,
    "position_globaltolocalvec": _MOVED,
    "position_get_offset": _MOVED,
    "block_offset": _MOVED,
    "plane_localtoglobal": _only(plane=PLANE),
    "normalize_check_small": _only(small=FLAG, v=POINT),
    "interpolate_rotation": _only(q=QUATERNION),
    "snap_to_plane": _MOVED,
    "frame_is_equal": _only(r=FLAG),
    "cache_localspace_sphere": _only(
        spheres=SPHERES, curr=POINTS, z=POINT, low_point=POINT, global_spheres=POINTS, global_curr=POINTS
    ),
    "slide_sphere": Block({"result": STATE, "normal": POINT, **_SLID}),
    "adjust_offset": Block({"offset": POINT, **_SLID}),
    "cliff_slide": Block({"result": STATE, **_SLID}),
    # polygon
    "polygon_make_plane": _only(plane=PLANE),
    "polygon_point_in_polygon": _only(r=FLAG),
    "polygon_point_in_poly2D": _only(r=FLAG),
    "polygon_hits_sphere_fast": _only(r=FLAG, contact=OPTIONAL_POINT),
    "polygon_hits_sphere_slow": _only(r=FLAG, contact=OPTIONAL_POINT),
    "polygon_pos_hits_sphere": _only(r=FLAG, struck=FLAG, contact=OPTIONAL_POINT),
    "polygon_walkable_hits_sphere": _only(r=FLAG),
    "polygon_check_walkable": _only(r=FLAG),
    "polygon_check_small_walkable": _only(r=FLAG),
    "polygon_find_crossed_edge": _only(r=FLAG, normal=OPTIONAL_POINT),
    "polygon_adjust_sphere_to_plane": _only(r=FLAG, center=POINT, walk_interp=FLOAT),
    "polygon_adjust_sphere_to_poly": _only(t=DOUBLE),
    "polygon_adjust_to_placement_poly": _only(center=POINT, other_center=POINT),
    # bsp
    "bsp_point_intersects_solid": _only(r=FLAG),
    "bsp_sphere_intersects_poly": _only(r=FLAG, poly=POLYGON, contact=OPTIONAL_POINT),
    "bsp_sphere_intersects_solid": _only(r=FLAG),
    "bsp_hits_walkable": _only(r=FLAG),
    "bsp_find_walkable": _only(changed=FLAG, poly=POLYGON, center=POINT, walk_interp=FLOAT),
    "bsp_sphere_intersects_solid_poly": _only(r=FLAG, center_solid=FLAG, poly=POLYGON),
    "bsp_adjust_to_plane": _only(r=FLAG, center=POINT),
    "bsp_point_inside_cell": _only(r=FLAG),
    "bsp_sphere_intersects_cell": _only(r=COUNT),
    # calls and transitions
    "find_collisions": _state({"dispatch": TEXT, "result": STATE}),
    "transition": _state({"result": FLAG}),
    "object_call": _state({"result": STATE}, objects=True),
    "object_transition": _state({"result": FLAG}, objects=True),
    "world_transition": _state({"result": FLAG}, objects=True),
    "land_find_env_collisions": _state({"result": STATE}),
    "land_validate_walkable": _state({"result": STATE}),
    "find_time_of_collision": _only(t=DOUBLE),
    # terrain
    "landdefs_gid_to_lcoord": _LCOORD,
    "landdefs_blockid_to_lcoord": _LCOORD,
    "landdefs_inbound_valid_cellid": _only(r=FLAG),
    "landdefs_lcoord_to_gid": _only(id=CELL),
    "landdefs_get_outside_lcoord": _LCOORD,
    "landdefs_adjust_to_outside": _only(r=FLAG, cell=CELL, point=POINT),
    "landdefs_get_block_offset": _MOVED,
    "terrain_split": _only(cuts=TEXT),
    "terrain_block": _only(
        water_type=COUNT,
        cells=Listing(
            _only(id=CELL, sw_ne=FLAG, water=COUNT, origin=POINT, planes=Listing(PLANE)),
        ),
    ),
    "land_find_terrain_poly": _only(r=FLAG, poly=POLYGON, water_depth=FLOAT),
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
    "point_in_cell": _only(r=FLAG),
    "cross_cells": Block(_CELL_LIST),
    # the tick
    "update_physics": Block(_BODY_MOVED),
    "update_position": Block(_BODY_MOVED),
    "calc_friction": _only(velocity=POINT),
    "calc_acceleration": Block(_ACCELERATED),
    "set_velocity": _VELOCITY_SET,
    "set_local_velocity": _VELOCITY_SET,
    "set_on_walkable": Block({"transient_state": BITS, **_ACCELERATED}),
    "clear_transient_states": Block({"transient_state": BITS, **_ACCELERATED}),
    "handle_all_collisions": _only(
        r=FLAG, velocity=POINT, transient_state=BITS, state=BITS, colliding_with_environment=FLAG
    ),
    "set_position": Block(
        {
            "lost": FLAG,
            "position": POSE,
            "contact_plane": PLANE,
            "contact_plane_cell": CELL,
            "sliding_normal": POINT,
            "transient_state": BITS,
            "velocity": POINT,
            **_ACCELERATED,
            "state": BITS,
            "colliding_with_environment": FLAG,
        }
    ),
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
}
"""What each operation answers, by its name."""
