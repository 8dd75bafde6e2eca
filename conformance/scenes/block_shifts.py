"""Queries on land, moved by whole landblocks: the only motion that keeps heights over their points.

The same hills stand in another part of the map. Their cells are cut there as that place has it, so a shifted
query, too, asks something else; what must stay is that two engines agree.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from conformance.scenes.random_poses import Room, Shift

LAST_BLOCK: Final = 254
"""Greatest index of a landblock in x and in y (10 1.)."""
_BYTE: Final = 0xFF
_POSES: Final = ("from", "to", "start", "position", "pose")
_IDS: Final = ("begin_cell", "contact_plane_cell", "other")


def has_land(inputs: Mapping[str, Any]) -> bool:
    """Tell whether inputs have a world that is tied to the land."""
    world = inputs.get("world") or {}
    return bool(world.get("landblocks") or world.get("buildings"))


def room_to_shift(inputs: Mapping[str, Any]) -> Room:
    """Return how far the landblocks of a world may be shifted."""
    world = inputs["world"]
    blocks = [block["block"] for block in world["landblocks"]] or [0]
    east, north = [block >> 8 for block in blocks], [block & _BYTE for block in blocks]
    return ((-min(east), LAST_BLOCK - max(east)), (-min(north), LAST_BLOCK - max(north)))


def shift_inputs(inputs: Mapping[str, Any], shift: Shift) -> dict[str, Any]:
    """Return inputs with every landblock and cell id shifted, as a new mapping.

    Parameters
    ----------
    inputs : mapping
        The input blocks of an operation in a world; not changed.
    shift : (int, int)
        Landblocks to the east and to the north.

    Returns
    -------
    dict
        Points, planes and heights stay: they are in their landblock's frame. Ids of objects stay.
    """
    return {key: _shifted(key, value, shift) for key, value in inputs.items()}


def shifted_id(cell: int, shift: Shift) -> int:
    """Return a cell id in another landblock; 0, which names no cell, stays."""
    return shifted_block(cell >> 16, shift) << 16 | cell & 0xFFFF if cell else 0


def shifted_block(block: int, shift: Shift) -> int:
    """Return another landblock's id; each byte wraps, as ids that are none are also asked about."""
    x, y = shift
    return ((block >> 8) + x & _BYTE) << 8 | (block & _BYTE) + y & _BYTE


def _shifted(key: str, value: Any, shift: Shift) -> Any:
    if value is None:
        return None
    if key in _POSES:
        return {**value, "cell": shifted_id(value["cell"], shift)}
    if key == "cell" or key in _IDS:
        return shifted_id(value, shift)
    if key in {"stab", "array"}:
        return [shifted_id(cell, shift) for cell in value]
    if key == "block":
        return shifted_block(value, shift)
    if key in {"shadow", "restrictions"}:
        return {str(shifted_id(int(cell), shift)): held for cell, held in value.items()}
    if key == "cells":
        return [dict(_shifted_cell(cell, shift)) for cell in value]
    if key in {"contact", "last_known", "seed", "world", "body", "object"}:
        return shift_inputs(value, shift)
    if key in {"landblocks", "portals", "buildings", "objects", "parts"}:
        return [shift_inputs(item, shift) for item in value]
    return value


def _shifted_cell(cell: Mapping[str, Any], shift: Shift) -> Iterator[tuple[str, Any]]:
    """Yield the parts of a cell, whose `id` is a cell's, not an object's."""
    for key, value in cell.items():
        yield key, shifted_id(value, shift) if key == "id" else _shifted(key, value, shift)
