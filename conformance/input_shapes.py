"""What stands under each key of a record's inputs: how long its vectors are, which keys its blocks need.

FORMAT.md uses a key for one thing in every operation, but for a few that are named here; so a value is
judged by its key alone, wherever it stands. What is not named here is not judged.
"""

from __future__ import annotations

from types import MappingProxyType
from typing import TYPE_CHECKING, Any, Final

from conformance.fields import FieldError
from conformance.source import describe

if TYPE_CHECKING:
    from collections.abc import Mapping

MAX_DEPTH: Final = 32
"""Deepest nesting of input blocks; FORMAT.md's own are at most nine levels deep."""

VECTOR_LENGTHS: Final[Mapping[str, int]] = MappingProxyType(
    {
        **dict.fromkeys(("origin", "point", "movement", "up", "normal", "offset", "v", "sliding", "curr"), 3),
        **dict.fromkeys(("disp", "velocity", "acceleration", "omega", "move", "set_velocity"), 3),
        **dict.fromkeys(("set_local_velocity", "sliding_normal", "collision_normal"), 3),
        **dict.fromkeys(("direction", "scales"), 3),
        **dict.fromkeys(("rotation", "plane", "sphere", "contact_plane", "sorting_sphere"), 4),
        "drawing_sphere": 4,
    }
)
"""Keys of a single vector."""
ROW_LENGTHS: Final[Mapping[str, int]] = MappingProxyType({"spheres": 4, "cylspheres": 5, "polygon": 3})
"""Keys of a list of vectors."""
LISTS: Final = frozenset({"portals", "stab", "times"})
BLOCK_LISTS: Final = frozenset({"cells", "objects", "statics", "parts", "landblocks", "buildings", "ticks"})
"""Keys of a list of blocks."""
NULLABLE: Final = frozenset({"sliding_normal", "collision_normal", "sorting_sphere"})
"""Keys of a vector that may be null."""
NUMBERS: Final = frozenset(
    {
        *("scale", "t", "radsum", "radius", "walk_interp", "walkable_allowance", "water_depth"),
        *("step_down_amt", "step_up_height", "step_down_height", "quantum", "q", "v2"),
        *("friction", "elasticity", "update_time", "cur_time", "last_update"),
    }
)
TEXTS: Final = frozenset({"as", "call", "function", "geometry", "kind", "name", "world"})
"""Keys of names; under every other key a text is a mistake."""
_POSE: Final = ("cell", "origin", "rotation")
_KNOWN_PLANE: Final = ("plane", "cell", "is_water")
BLOCKS: Final[Mapping[str, tuple[str, ...]]] = MappingProxyType(
    {
        **dict.fromkeys(("pose", "position", "start", "curr_pos"), _POSE),
        "mover": ("spheres", "scale", "state", "step_up_height", "step_down_height"),
        "body": (),
        "contact": _KNOWN_PLANE,
        "last_known": _KNOWN_PLANE,
        "path": (),
        "seed": (),
        "collisions": (),
    }
)
"""Keys of a block, with the keys that it cannot do without."""
_WORLD: Final = ("landblocks", "cells", "buildings", "objects", "shadow")
"""What a world that is spelled out cannot do without; elsewhere a world is a name."""
ENDS: Final = frozenset({"from", "to"})
"""Keys of a pose in most operations, and of a rotation in one."""
INTEGERS: Final = range(-(1 << 31), 1 << 32)
"""Whole numbers are ids, bits and flags of 32 bits, signed or not."""


def check_shape(key: str, value: Any, path: str) -> None:
    """Check the shape of what stands under a key.

    Raises
    ------
    FieldError
        For a vector of another length, a list or block that is none, or a block without what it needs.
    """
    if value is None:
        if key in NUMBERS or key in ROW_LENGTHS or (key in VECTOR_LENGTHS and key not in NULLABLE):
            raise FieldError(path, "nothing (null)", "a value")
    elif key in VECTOR_LENGTHS:
        _check_vector(value, VECTOR_LENGTHS[key], path)
    elif key in ROW_LENGTHS:
        for index, row in enumerate(_list(value, path)):
            _check_vector(row, ROW_LENGTHS[key], f"{path}[{index}]")
    elif key in LISTS:
        _list(value, path)
    elif key in BLOCK_LISTS:
        for index, item in enumerate(_list(value, path)):
            _check_block(item, (), f"{path}[{index}]")
    elif key in BLOCKS:
        _check_block(value, BLOCKS[key], path)
    elif key in NUMBERS and isinstance(value, list | tuple | dict):
        raise FieldError(path, describe(value), "a number")
    elif key in ENDS and isinstance(value, dict):
        _check_block(value, _POSE, path)
    elif key == "world" and isinstance(value, dict):
        _check_block(value, _WORLD, path)
    elif key == "shadow":
        _check_shadow(value, path)


def check_atom(key: str, value: Any, path: str) -> None:
    """Check what is neither a float nor made of parts: a name, or a whole number of 32 bits.

    Raises
    ------
    FieldError
    """
    if isinstance(value, str) != (key in TEXTS):
        raise FieldError(path, describe(value), "a name" if key in TEXTS else "a whole number")
    if isinstance(value, int) and value not in INTEGERS:
        raise FieldError(path, f"a number of {value.bit_length()} bits", "a whole number of 32 bits")


def _check_vector(value: Any, length: int, path: str) -> None:
    if len(_list(value, path)) != length:
        raise FieldError(path, describe(value), f"{length} numbers")
    for index, number in enumerate(value):
        if isinstance(number, list | tuple | dict) or number is None:
            raise FieldError(f"{path}[{index}]", describe(number), "a number")


def _check_block(value: Any, needed: tuple[str, ...], path: str) -> None:
    if not isinstance(value, dict):
        raise FieldError(path, describe(value), "a block")
    for key in needed:
        if key not in value:
            raise FieldError(f"{path}.{key}", "nothing", "a value")
    if needed == _POSE and not isinstance(value["cell"], int):
        raise FieldError(f"{path}.cell", describe(value["cell"]), "a cell id")


def _check_shadow(value: Any, path: str) -> None:
    _check_block(value, (), path)
    for cell, ids in value.items():
        if not (cell.isascii() and cell.isdecimal() and int(cell) in INTEGERS):
            raise FieldError(path, f"the key {cell!r}", "the id of a cell, in decimal")
        _list(ids, f"{path}.{cell}")


def _list(value: Any, path: str) -> list[Any] | tuple[Any, ...]:
    if not isinstance(value, list | tuple):
        raise FieldError(path, describe(value), "a list")
    return value
