"""Failures found at random, kept as cases: the next run replays them first."""

from __future__ import annotations

import hashlib
import json
from typing import TYPE_CHECKING, Any, Final

import yaml

from conformance.files import write_text
from conformance.report.scene import scene_line
from conformance.report.text import summary_line
from conformance.vector_export import short_geometry, short_inputs

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence
    from pathlib import Path

    from conformance.compare import Difference
    from conformance.query import Query

_DIGEST_DIGITS: Final = 10
_WIDTH: Final = 110

_CLASSES: Final = {
    "frame_": "Frame",
    "position_": "Position",
    "plane_": "Plane",
    "polygon_": "CPolygon",
    "bsp_": "BSPNODE",
    "landdefs_": "LandDefs",
}
"""Families of operations that are named after their retail functions."""

_FUNCTIONS: Final[Mapping[str, str]] = {
    "block_offset": "LandDefs::get_block_offset",
    "normalize_check_small": "Vector3::normalize_check_small",
    "interpolate_rotation": "Frame::interpolate_rotation",
    "snap_to_plane": "Plane::snap_to_plane",
    "cache_localspace_sphere": "SPHEREPATH::cache_localspace_sphere",
    "slide_sphere": "CSphere::slide_sphere",
    "adjust_offset": "CTransition::adjust_offset",
    "cliff_slide": "CTransition::cliff_slide",
    "polygon_hits_sphere_fast": "CPolygon::polygon_hits_sphere",
    "polygon_hits_sphere_slow": "CPolygon::polygon_hits_sphere_slow_but_sure",
    "bsp_adjust_to_plane": "BSPTREE::adjust_to_plane",
    "bsp_point_inside_cell": "BSPNODE::point_inside_cell_bsp",
    "bsp_sphere_intersects_cell": "BSPNODE::sphere_intersects_cell_bsp",
    "find_collisions": "BSPTREE::find_collisions",
    "transition": "CTransition::find_valid_position",
    "object_call": "CPhysicsObj::FindObjCollisions",
    "object_transition": "CTransition::find_valid_position",
    "world_transition": "CTransition::find_valid_position",
    "find_time_of_collision": "CSphere::find_time_of_collision",
    "land_find_env_collisions": "CLandCell::find_env_collisions",
    "land_validate_walkable": "OBJECTINFO::validate_walkable",
    "land_find_terrain_poly": "CLandCell::find_terrain_poly",
    "terrain_split": "CLandBlockStruct::ConstructPolygons",
    "terrain_block": "CLandBlockStruct::generate",
    "add_all_outside_cells": "CLandCell::add_all_outside_cells",
    "find_cell_list": "CObjCell::find_cell_list",
    "find_transit_cells": "CEnvCell::find_transit_cells",
    "check_building_transit": "CEnvCell::check_building_transit",
    "point_in_cell": "CEnvCell::point_in_cell",
    "cross_cells": "CPhysicsObj::calc_cross_cells",
    "walk": "CTransition::find_valid_position",
    "world_walk": "CTransition::find_valid_position",
    "body_walk": "CPhysicsObj::UpdateObjectInternal",
}
"""The other operations' retail functions."""


def found_cases_dir(rootpath: Path) -> Path:
    """Return the folder, below a project's root, where found failures are kept; it need not exist."""
    return rootpath / ".conformance" / "found"


def write_found(
    directory: Path,
    query: Query,
    differences: Sequence[Difference],
    *,
    candidate: str,
    provenance: str,
    said: str = "",
) -> Path:
    """Write a failing query as a case file and return its path.

    The file is named by what is asked, so the same failure found again is the same file.

    Parameters
    ----------
    directory : Path
        Where to write; made if it is not there.
    query : Query
        What was asked.
    differences : sequence of Difference
        What differed; empty if the candidate failed to answer.
    candidate : str
        Who answered wrongly.
    provenance : str
        What found it: test and profile.
    said : str
        What went wrong, in one line; empty: the first difference.
    """
    document = found_document(query, differences, candidate=candidate, provenance=provenance, said=said)
    path = directory / f"{document['id']}.yaml"
    write_text(path, found_yaml(document))
    return path


def found_yaml(document: Mapping[str, Any]) -> str:
    """Return a found case as the text of its file."""
    text: str = yaml.safe_dump(
        document, sort_keys=False, default_flow_style=None, width=_WIDTH, allow_unicode=True
    )
    return text


def found_document(
    query: Query, differences: Sequence[Difference], *, candidate: str, provenance: str, said: str = ""
) -> dict[str, Any]:
    """Return the case as plain data; its expected answer is left to the oracle.

    Parameters
    ----------
    query, differences, candidate, provenance, said
        As of `write_found`.
    """
    inputs = short_inputs(query.inputs)
    geometries = [{**short_geometry(geometry), "name": name} for name, geometry in query.geometries.items()]
    content = json.dumps([query.op, inputs, geometries], sort_keys=True).encode("utf-8")
    digest = hashlib.sha256(content).hexdigest()[:_DIGEST_DIGITS]
    first = summary_line(differences[0], candidate) if differences else f"{candidate} failed to answer"
    return {
        "id": f"found-{digest}",
        "title": f"{query.op.replace('_', ' ')}: found at random",
        "why": f"Found by {provenance}, candidate {candidate}. First difference: {said or first}. "
        f"Scene: {scene_line(query)}.",
        "retail": [retail_function(query.op)],
        "tags": ["found"],
        "vary": False,
        "query": {"op": query.op, "inputs": inputs},
        **({"geometries": geometries} if geometries else {}),
    }


def retail_function(op: str) -> str:
    """Return the retail function that an operation of FORMAT.md asks; not for single calls of part 3."""
    if op in _FUNCTIONS:
        return _FUNCTIONS[op]
    prefix = next(prefix for prefix in _CLASSES if op.startswith(prefix))
    return f"{_CLASSES[prefix]}::{op.removeprefix(prefix)}"
