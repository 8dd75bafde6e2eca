"""OBJECT blocks of FORMAT.md as obstacles of the engine."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from conformance.candidates.engine_ops.world_cache import engine_pose, engine_shape
from engine.objects import Obstacle, Part, Weenie

if TYPE_CHECKING:
    from collections.abc import Mapping

    from conformance.scenes.model import Geometry


def obstacle(block: Mapping[str, Any], geometries: Mapping[str, Geometry]) -> Obstacle:
    """Return the engine's form of an OBJECT block.

    Parameters
    ----------
    block : Mapping
        Numbers exact; ``sorting_sphere`` is taken too, as ``cross_cells`` gives it.
    geometries : Mapping of str to Geometry
        Those that its parts name.
    """
    return Obstacle(
        engine_pose(block["pose"]),
        block["scale"],
        block["state"],
        [_part(part, geometries) for part in block.get("parts", ())],
        block.get("cylspheres", ()),
        block.get("spheres", ()),
        weenie(block["weenie"]) if "weenie" in block else None,
        block["id"],
        has_parent=bool(block.get("parent", 0)),
        has_part_array=not block.get("no_part_array", 0),
        sorting_sphere=block.get("sorting_sphere"),
    )


def weenie(block: Mapping[str, Any]) -> Weenie:
    """Return the engine's form of a `weenie` block; which cells an obstacle may enter plays no role."""
    return Weenie(**{flag: bool(value) for flag, value in block.items() if flag != "bypass"})


def _part(block: Mapping[str, Any], geometries: Mapping[str, Geometry]) -> Part:
    name = block["geometry"]
    return Part(
        None if name is None else engine_shape(geometries[name]),
        engine_pose(block["pose"]) if "pose" in block else None,
        block.get("scale"),
        always_flat=bool(block.get("flat", 0)),
        has_physics=not block.get("no_physics", 0),
        drawing_sphere=block.get("drawing_sphere"),
    )
