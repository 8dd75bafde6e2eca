"""Geometry records from outside: looked at key by key before they become a geometry."""

from __future__ import annotations

from typing import Any

from conformance.scenes.errors import SceneError, join_path
from conformance.scenes.model import Geometry
from conformance.scenes.readers import each, floats_of, mapping, member, text, whole
from conformance.scenes.validate import check_geometry


def geometry_from_record(record: Any, path: str) -> Geometry:
    """Read and check a geometry record of FORMAT.md, tree included.

    Parameters
    ----------
    record : Any
        What was parsed; a mapping if it is right.
    path : str
        Of the record.

    Returns
    -------
    Geometry
        Valid, its numbers rounded to float32.

    Raises
    ------
    SceneError
        A key is missing or of a wrong type, or the geometry is not valid; ``bsp.pos.neg`` leads to a node.
    """
    checked = {
        "name": text(member(record, "name", path), join_path(path, "name")),
        "kind": text(mapping(record, path).get("kind", ""), join_path(path, "kind")),
        "vertices": each(record, "vertices", path, floats_of(3)),
        "polygons": each(record, "polygons", path, _polygon),
        "bsp": _tree(member(record, "bsp", path), join_path(path, "bsp")),
    }
    if record.get("cell_bsp") is not None:
        checked["cell_bsp"] = each(record, "cell_bsp", path, floats_of(4))
    geometry = Geometry.from_record(checked)
    check_geometry(geometry, path)
    return geometry


def _tree(record: Any, path: str) -> dict[str, Any]:
    """Read a tree of nodes without recursion, children after their parent."""
    root: dict[str, Any] = {}
    waiting = [(record, path, root)]
    seen: set[int] = set()
    while waiting:
        item, here, out = waiting.pop()
        if id(item) in seen:
            raise SceneError(here, "a node that the tree already has", "each node once")
        seen.add(id(item))
        out["polys"] = each(item, "polys", here, whole)
        out["sphere"] = floats_of(4)(member(item, "sphere", here), f"{here}.sphere")
        if "leaf" in item:
            out["leaf"] = whole(item["leaf"], f"{here}.leaf")
            out["solid"] = whole(member(item, "solid", here), f"{here}.solid")
            continue
        out["plane"] = floats_of(4)(member(item, "plane", here), f"{here}.plane")
        for child in ("neg", "pos"):
            out[child] = {}
            waiting.append((member(item, child, here), f"{here}.{child}", out[child]))
    return root


def _polygon(value: Any, path: str) -> dict[str, Any]:
    sides = mapping(value, path).get("sides", 0)
    return {"v": each(value, "v", path, whole), "sides": whole(sides, join_path(path, "sides"))}
