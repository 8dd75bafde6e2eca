"""Operations of the suite's own: functions of retail that no vector file asks.

They are asked and compared like the others; ``vectors/FORMAT.md`` has them in its last section.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from conformance.output_shapes import (
    CELL,
    COUNT,
    DOUBLE,
    FLAG,
    FLOAT,
    MOVED,
    OPTIONAL_POINT,
    POINT,
    POINTS,
    POSE,
    QUATERNION,
    STATE,
    WRITTEN_BACK,
    only,
    state,
)
from conformance.shapes import Block, Listing, Nullable

if TYPE_CHECKING:
    from collections.abc import Mapping

_COMBINED: Final = only(origin=POINT, q=QUATERNION)
_TURNED: Final = only(q=QUATERNION)
_RAY: Final = only(r=FLAG, time=Nullable(DOUBLE))

OWN_REQUIRED: Final[Mapping[str, tuple[str, ...]]] = {
    "frame_combine": ("a", "b"),
    "frame_combine_aframe": ("a", "b"),
    "frame_combine_scaled": ("a", "b", "scales"),
    "frame_interpolate_origin": ("a", "b", "t"),
    "frame_get_heading": ("rotation",),
    "frame_set_heading": ("rotation", "degrees"),
    "frame_set_vector_heading": ("rotation", "v"),
    "position_localtoglobal_origin": ("to", "from"),
    "position_get_offset_point": ("from", "to", "point"),
    "position_distance": ("from", "to"),
    "position_get_outside_cell_id": ("position",),
    "plane_set_height": ("plane", "v"),
    "plane_ray": ("plane", "point", "direction"),
    "polygon_hits_ray": ("geometry", "poly", "point", "direction"),
    "landdefs_within_block": ("point", "radius"),
    "landdefs_set_height_table": ("values",),
    "calc_num_steps": ("mover", "from", "to"),
    "set_check_pos": ("mover", "from", "to"),
    "find_transitional_position": ("world", "mover", "from", "to", "seed", "insert_type"),
    "check_collisions": ("cell", "objects", "mover", "from"),
    "check_entry_restrictions": ("world", "cell", "mover", "position"),
    "find_visible_child_cell": ("world", "cell", "point", "search_stabs"),
    "registration": ("world", "calls"),
    "place_body": ("world", "body", "to", "flags", "cell"),
    "set_elasticity": ("body", "elasticity"),
}
"""What each must be given."""

OWN_OPTIONAL: Final[Mapping[str, tuple[str, ...]]] = {
    "find_transitional_position": ("placement_allows_sliding",),
}
"""What one may be given besides."""

OWN_OUTPUTS: Final[Mapping[str, Block]] = {
    "frame_combine": _COMBINED,
    "frame_combine_aframe": _COMBINED,
    "frame_combine_scaled": _COMBINED,
    "frame_interpolate_origin": MOVED,
    "frame_get_heading": only(heading=DOUBLE),
    "frame_set_heading": _TURNED,
    "frame_set_vector_heading": _TURNED,
    "position_localtoglobal_origin": MOVED,
    "position_get_offset_point": MOVED,
    "position_distance": only(distance=DOUBLE),
    "position_get_outside_cell_id": only(cell=CELL),
    "plane_set_height": only(r=FLAG, v=POINT),
    "plane_ray": _RAY,
    "polygon_hits_ray": _RAY,
    "landdefs_within_block": only(r=FLAG),
    "landdefs_set_height_table": only(r=FLAG, table=Listing(FLOAT)),
    "calc_num_steps": only(offset=POINT, step=POINT, num_steps=COUNT),
    "set_check_pos": only(global_spheres=POINTS, global_curr=POINTS, low_point=POINT),
    "find_transitional_position": state({"result": FLAG}, objects=True),
    "check_collisions": only(r=FLAG),
    "check_entry_restrictions": only(result=STATE, collision_normal=OPTIONAL_POINT),
    "find_visible_child_cell": only(cell=Nullable(CELL)),
    "registration": only(shadow=Listing(only(cell=CELL, objects=Listing(COUNT)))),
    "place_body": Block({"result": COUNT, "to": POSE, **WRITTEN_BACK}),
    "set_elasticity": only(elasticity=FLOAT),
}
"""What each answers."""
