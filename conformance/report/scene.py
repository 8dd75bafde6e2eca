"""A query's scene in one line: cells, polygons, poses, mover, movement."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

from conformance.floats import decimal32
from conformance.report.values import format_block, format_cell, format_mover_state, format_point

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

    from conformance.query import Query

_SHOWN_APART: Final = frozenset(
    {
        *("geometry", "poly", "pose", "cells", "world", "mover", "from", "to", "path", "start", "body"),
        *("objects", "object"),
    }
)
_UNSAID: Final = frozenset({"as", "begin_cell", "placement_allows_sliding", "ticks", "seed"})
_IDENTITY: Final = (1.0, 0.0, 0.0, 0.0)


def scene_line(query: Query) -> str:
    """Describe a query in one line: where it happens, who moves, from where to where."""
    inputs = query.inputs
    parts = [query.op, *_places(query), *_mover(inputs), *_movement(inputs), *_path(inputs)]
    parts += [
        f"{key} {format_block(value)}"
        for key, value in inputs.items()
        if key not in _SHOWN_APART | _UNSAID and not _is_shown(key, value)
    ]
    return "; ".join(parts)


def _places(query: Query) -> Iterable[str]:
    inputs = query.inputs
    if "cells" in inputs:
        for cell in inputs["cells"]:
            statics = cell.get("statics", ())
            objects = f" with {len(statics)} static objects" if statics else ""
            yield f"cell {_geometry(query, cell['geometry'])}{objects} {_pose(cell['pose'])}"
    elif "geometry" in inputs:
        polygon = f" polygon {inputs['poly']}" if "poly" in inputs else ""
        what = f"{inputs.get('as', '')} {_geometry(query, inputs['geometry'])}{polygon}".strip()
        yield f"{what} {_pose(inputs['pose'])}" if "pose" in inputs else what
    elif "world" in inputs:
        yield f"world {inputs['world']['name']} {_contents(inputs['world'])}"
    if isinstance(cell := inputs.get("cell"), dict):
        yield f"cell {_geometry(query, cell['geometry'])} {_pose(cell['pose'])}"
    for thing in (*inputs.get("objects", ()), *filter(None, [inputs.get("object")])):
        yield f"object 0x{thing['id']:08X} {_pose(thing['pose'])}"


def _contents(world: Mapping[str, Any]) -> str:
    counts = [(len(world[key]), key) for key in ("landblocks", "cells", "buildings", "objects")]
    held = [f"{count} {key if count > 1 else key[:-1]}" for count, key in counts if count]
    return f"with {', '.join(held)}" if held else "with nothing in it"


def _geometry(query: Query, name: str | None) -> str:
    if name is None:
        return "without geometry"
    count = len(query.geometries[name].polygons)
    return f"{name} ({count} polygon{'' if count == 1 else 's'})"


def _pose(pose: Mapping[str, Any]) -> str:
    rotation = tuple(pose["rotation"])
    turned = "" if rotation == _IDENTITY else f" rotated {format_point(rotation)}"
    return f"in {format_cell(pose['cell'])} at {format_point(pose['origin'])}{turned}"


def _mover(inputs: Mapping[str, Any]) -> Iterable[str]:
    mover = inputs.get("mover")
    if mover is None:
        return
    radii = ", ".join(decimal32(sphere[3]) for sphere in mover["spheres"])
    count = len(mover["spheres"])
    state = f", state {format_mover_state(mover['state'])}" if mover.get("state") else ""
    yield f"{count} sphere{'' if count == 1 else 's'} of radius {radii}{state}"


def _movement(inputs: Mapping[str, Any]) -> Iterable[str]:
    for key in ("from", "to"):
        value = inputs.get(key)
        if isinstance(value, dict):
            yield f"{key} {format_point(value['origin'])}"
        elif value is not None:
            yield f"{key} {format_block(value)}"
    if "ticks" in inputs:
        start = inputs.get("start") or inputs["body"].get("position")
        yield f"{len(inputs['ticks'])} ticks" + (f" from {format_point(start['origin'])}" if start else "")


def _path(inputs: Mapping[str, Any]) -> Iterable[str]:
    path = inputs.get("path", {})
    said = [f"{key} {format_block(value)}" for key, value in path.items() if value]
    if said:
        yield "path " + ", ".join(said)


def _is_shown(key: str, value: Any) -> bool:
    """Tell whether an input needs no words, or has them already."""
    return (key == "scale" and value == 1.0) or (key == "cell" and isinstance(value, dict))
