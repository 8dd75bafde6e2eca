"""The inputs of every operation, and reading their numbers exactly."""

from __future__ import annotations

import difflib
from typing import TYPE_CHECKING, Any, Final

from conformance.fields import FieldError, UnknownOperationError, read_number, single_precision
from conformance.input_shapes import MAX_DEPTH, check_atom, check_shape
from conformance.own_operations import OWN_OPTIONAL, OWN_REQUIRED

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

_POLYGON: Final = ("geometry", "poly")
_PATH_CALL: Final = ("mover", "from", "to", "seed", "path")
_DIRECT: Final = ("mover", "from", "to", "seed")
_CELL_POINT: Final = ("cell", "point")

REQUIRED: Final[Mapping[str, tuple[str, ...]]] = {
    "frame_cache": ("rotation",),
    "frame_set_rotate": ("rotation",),
    "frame_localtoglobal": ("pose", "point"),
    "frame_globaltolocal": ("pose", "point"),
    "frame_localtoglobalvec": ("pose", "point"),
    "frame_globaltolocalvec": ("pose", "point"),
    "position_localtoglobal": ("to", "from", "point"),
    "position_localtolocal": ("to", "from", "point"),
    "position_localtoglobalvec": ("pose", "point"),
    "position_globaltolocalvec": ("pose", "point"),
    "position_get_offset": ("from", "to"),
    "block_offset": ("from_cell", "to_cell"),
    "plane_localtoglobal": ("to", "from", "plane"),
    "normalize_check_small": ("v",),
    "interpolate_rotation": ("from", "to", "t"),
    "snap_to_plane": ("plane", "v"),
    "frame_is_equal": ("a", "b"),
    "cache_localspace_sphere": ("pose", "scale", "mover", "from", "to"),
    "slide_sphere": (*_DIRECT, "normal"),
    "adjust_offset": (*_DIRECT, "offset"),
    "cliff_slide": (*_DIRECT, "plane"),
    "polygon_make_plane": _POLYGON,
    "polygon_point_in_polygon": (*_POLYGON, "point"),
    "polygon_point_in_poly2D": (*_POLYGON, "point", "side"),
    "polygon_hits_sphere_fast": (*_POLYGON, "sphere"),
    "polygon_hits_sphere_slow": (*_POLYGON, "sphere"),
    "polygon_pos_hits_sphere": (*_POLYGON, "sphere", "movement"),
    "polygon_walkable_hits_sphere": (*_POLYGON, "sphere", "up", "walkable_allowance"),
    "polygon_check_walkable": (*_POLYGON, "sphere", "up"),
    "polygon_check_small_walkable": (*_POLYGON, "sphere", "up"),
    "polygon_find_crossed_edge": (*_POLYGON, "sphere", "up"),
    "polygon_adjust_sphere_to_plane": (*_POLYGON, "sphere", "movement", "walk_interp"),
    "polygon_adjust_sphere_to_poly": (*_POLYGON, "sphere", "curr", "movement"),
    "polygon_adjust_to_placement_poly": (
        *_POLYGON,
        "sphere",
        "other",
        "radius",
        "center_solid",
        "solid_check",
    ),
    "bsp_point_intersects_solid": ("geometry", "point"),
    "bsp_sphere_intersects_poly": ("geometry", "sphere", "movement"),
    "bsp_sphere_intersects_solid": ("geometry", "sphere", "center_check"),
    "bsp_hits_walkable": ("geometry", "sphere", "up", "walkable_allowance"),
    "bsp_find_walkable": ("geometry", "sphere", "movement", "up", "walkable_allowance", "walk_interp"),
    "bsp_sphere_intersects_solid_poly": ("geometry", "sphere", "radius", "center_check", "center_solid"),
    "bsp_adjust_to_plane": ("geometry", "sphere", "curr", "poly"),
    "bsp_point_inside_cell": ("geometry", "point"),
    "bsp_sphere_intersects_cell": ("geometry", "sphere"),
    "find_collisions": ("geometry", "pose", "scale", "as", *_PATH_CALL),
    "transition": ("cells", "mover", "from", "to", "begin_cell", "seed"),
    "object_call": ("cell", "objects", *_PATH_CALL, "function"),
    "object_transition": ("cell", "objects", *_DIRECT),
    "world_transition": ("world", *_DIRECT),
    "land_find_env_collisions": ("world", "cell", *_PATH_CALL),
    "land_validate_walkable": ("world", "cell", "sphere", "plane", "is_water", "water_depth", *_PATH_CALL),
    "find_time_of_collision": ("movement", "disp", "radsum"),
    "landdefs_gid_to_lcoord": ("cell",),
    "landdefs_blockid_to_lcoord": ("cell",),
    "landdefs_inbound_valid_cellid": ("cell",),
    "landdefs_lcoord_to_gid": ("x", "y"),
    "landdefs_get_outside_lcoord": _CELL_POINT,
    "landdefs_adjust_to_outside": _CELL_POINT,
    "landdefs_get_block_offset": ("from_cell", "to_cell"),
    "terrain_split": ("block",),
    "terrain_block": ("block", "heights"),
    "land_find_terrain_poly": ("world", "cell", "point"),
    "add_all_outside_cells": ("world", "position", "spheres"),
    "find_cell_list": ("world", "position", "spheres"),
    "find_transit_cells": ("world", "cell", "position", "spheres"),
    "check_building_transit": ("world", "cell", "portal_id", "position", "spheres"),
    "point_in_cell": ("world", "cell", "point"),
    "cross_cells": ("world", "object", "static"),
    "update_physics": ("body", "quantum"),
    "update_position": ("body", "quantum"),
    "calc_friction": ("body", "quantum", "v2"),
    "calc_acceleration": ("body",),
    "set_velocity": ("body", "v", "update_time", "cur_time"),
    "set_local_velocity": ("body", "v", "update_time", "cur_time"),
    "set_on_walkable": ("body", "flag"),
    "clear_transient_states": ("body",),
    "handle_all_collisions": ("body", "prev_contact", "prev_on_walkable", "collisions"),
    "set_position": ("body", "curr_pos", "curr_cell", "collisions"),
    "seed": ("body",),
    "update_object_gates": ("body", "update_time", "last_update", "times"),
    "walk": ("cells", "mover", "start", "ticks"),
    "world_walk": ("world", "mover", "start", "ticks"),
    "body_walk": ("body", "ticks"),
    **OWN_REQUIRED,
}
"""What each operation must be given."""
FORMAT_OPS: Final = tuple(op for op in REQUIRED if op not in OWN_REQUIRED)
"""The operations of the vector files; random queries draw no others, which a candidate need not offer."""

OPTIONAL: Final[Mapping[str, tuple[str, ...]]] = {
    "transition": ("placement_allows_sliding",),
    "object_call": ("is_creature",),
    "object_transition": ("placement_allows_sliding",),
    "world_transition": ("placement_allows_sliding",),
    "terrain_block": ("terrain", "side_cell_count", "heights_again"),
    "find_cell_list": ("do_not_load", "without_path"),
    "find_transit_cells": ("array",),
    "cross_cells": ("sorting_sphere",),
    "seed": ("admin_move",),
    "update_object_gates": ("player", "maintainer_active", "parent"),
    "body_walk": ("cells", "world"),
    **OWN_OPTIONAL,
}
"""What an operation may be given besides."""

_UNNAMED: Final = "world"
"""What a world is called that a case spells out without a name."""
_BOOKKEEPING: Final = frozenset({"id", "op", "tag", "uncertain", "expect"})

_FLOAT32_KEYS: Final = frozenset(
    {
        *("origin", "rotation", "point", "plane", "movement", "up", "normal", "offset", "v", "sliding"),
        *("sphere", "spheres", "curr", "cylspheres", "sorting_sphere", "polygon", "heights", "move"),
        *("disp", "radsum", "radius", "scale", "t", "walk_interp", "walkable_allowance", "water_depth"),
        *("step_down_amt", "step_up_height", "step_down_height", "quantum", "q", "v2"),
        *("velocity", "acceleration", "omega", "friction", "elasticity", "contact_plane"),
        *("sliding_normal", "collision_normal", "set_velocity", "set_local_velocity"),
        *("direction", "degrees", "scales", "values", "heights_again", "drawing_sphere"),
    }
)
_FLOAT64_KEYS: Final = frozenset({"update_time", "cur_time", "last_update", "times"})
_LISTS_ARE_FLOAT32: Final = frozenset({"from", "to", "other"})
"""Keys that are vectors in one operation and poses or cell ids in another."""
_MOST_ROWS_DEEP: Final = 2
"""Numbers stand in lists, and in lists of lists."""


def read_inputs(op: str, record: Mapping[str, Any]) -> dict[str, Any]:
    """Take an operation's inputs from a record, floats rounded to float32 (times stay float64).

    Parameters
    ----------
    op : str
        The operation.
    record : Mapping
        The whole record as parsed from JSON or YAML; its bookkeeping keys (``id``, ``tag`` ...) are left out.

    Returns
    -------
    dict
        Every required and given optional input; each number where a float belongs is a float. A world that
        is spelled out has a name.

    Raises
    ------
    UnknownOperationError
        For an operation that does not exist.
    FieldError
        For an input that is missing, unknown, of another shape or not a number where one belongs.
    """
    required = REQUIRED.get(op)
    if required is None:
        raise UnknownOperationError(op)
    known = {*required, *OPTIONAL.get(op, ())}
    for key in record:  # before what is missing: a name that is mistyped is both
        if key not in known and key not in _BOOKKEEPING:
            near = difflib.get_close_matches(key, known, n=1)
            expected = f"one of {', '.join(sorted(known))}" if not near else f"perhaps {near[0]!r}"
            raise FieldError(key, "an unknown input", expected)
    for key in required:
        if key not in record:
            raise FieldError(key, "nothing", f"an input of {op}")
    inputs = {key: _read(key, record[key], key) for key in record if key in known}
    if isinstance(inputs.get("world"), dict):
        inputs["world"] = {"name": _UNNAMED, **inputs["world"]}
    return inputs


def read_block(record: Mapping[str, Any]) -> dict[str, Any]:
    """Read every number of a shared record (a world) exactly, as `read_inputs` does."""
    return {key: _read(key, value, key) for key, value in record.items()}


def geometry_names(inputs: Any) -> Iterator[str]:
    """Yield the name of every geometry that inputs refer to, in order, repeated as used."""
    if isinstance(inputs, dict):
        for key, value in inputs.items():
            if key == "geometry" and isinstance(value, str):
                yield value
            else:
                yield from geometry_names(value)
    elif isinstance(inputs, list | tuple):
        for value in inputs:
            yield from geometry_names(value)


def is_float64_input(key: str) -> bool:
    """Tell whether the numbers under a key are float64 (clock times); all others are float32."""
    return key in _FLOAT64_KEYS


def _read(key: str, value: Any, path: str, depth: int = 0) -> Any:
    check_shape(key, value, path)
    if depth > MAX_DEPTH:
        raise FieldError(path.partition(".")[0], f"more than {MAX_DEPTH} nested levels", "a shallower record")
    if isinstance(value, dict):
        return {inner: _read(inner, item, f"{path}.{inner}", depth + 1) for inner, item in value.items()}
    if value is None:
        return None
    if key in _FLOAT32_KEYS:
        return _floats(value, path, single=True)
    if key in _FLOAT64_KEYS:
        return _floats(value, path, single=False)
    if isinstance(value, list | tuple):
        if key in _LISTS_ARE_FLOAT32:
            return _floats(value, path, single=True)
        return [_read("", item, f"{path}[{i}]", depth + 1) for i, item in enumerate(value)]
    if isinstance(value, float):
        raise FieldError(path, f"{value!r} (float)", "a whole number or a name")
    check_atom(key, value, path)
    return value


def _floats(value: Any, path: str, *, single: bool, depth: int = 0) -> Any:
    if isinstance(value, list | tuple):
        if depth == _MOST_ROWS_DEEP:
            raise FieldError(path, "a list", "a number")
        return [_floats(item, f"{path}[{i}]", single=single, depth=depth + 1) for i, item in enumerate(value)]
    number = value if value.__class__ is float else read_number(value, path)
    return single_precision(number, path) if single else number
