"""CELLS blocks of FORMAT.md, as an oracle world."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from conformance.candidates.oracle_ops.geometry import oracle_geometry
from conformance.candidates.oracle_ops.values import position
from oracle.arithmetic import f32
from oracle.env_cell import CellPortal, CellStruct, EnvCell
from oracle.physics_object import PhysicsObj
from oracle.physics_part import PartArray, PhysicsPart
from oracle.vector import Vector3
from oracle.world import World

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from conformance.scenes.model import Geometry

INTERIOR_POSITIVE = 0
"""Portal side of portals that only name the other cell; never looked at while that cell is loaded."""


def static_object(static: Mapping[str, Any], geometries: Mapping[str, Geometry]) -> PhysicsObj:
    """Make the object of a STATIC block: one part with its own pose and scale."""
    pose = position(static["pose"])
    scale = f32(static["scale"])
    gfxobj = oracle_geometry(geometries[static["geometry"]]).gfx_obj
    part = PhysicsPart(gfxobj, pose, Vector3(scale, scale, scale))
    parts = PartArray([part], None, Vector3(scale, scale, scale))
    return PhysicsObj(0, static["state"], pose, scale=scale, part_array=parts)


def env_cell(cell: Mapping[str, Any], geometries: Mapping[str, Geometry], world: World) -> EnvCell:
    """Make one environment cell of a CELLS block and load it into the world."""
    structure = CellStruct(None, None)
    if cell["geometry"] is not None:
        built = oracle_geometry(geometries[cell["geometry"]])
        structure = CellStruct(built.tree, built.cell_tree)
    portals = [CellPortal(other, INTERIOR_POSITIVE, None) for other in cell.get("portals", ())]
    made = EnvCell(cell["id"], position(cell["pose"]), structure, world, portals=portals)
    made.shadow_object_list = [static_object(s, geometries) for s in cell.get("statics", ())]
    world.add_cell(made)
    return made


def build_world(cells: Sequence[Mapping[str, Any]], geometries: Mapping[str, Geometry]) -> World:
    """Make the world of a CELLS block."""
    world = World()
    for cell in cells:
        env_cell(cell, geometries, world)
    return world
