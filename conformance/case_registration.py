"""Shadow lists of a case's world: as written, or where retail registers each object."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

from conformance.candidates.registry import make_candidate
from conformance.case_references import is_loaded, known_cells
from conformance.floats import to_float32
from conformance.query import Errored, Query, Result
from conformance.scenes.algebra import length, subtract

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from conformance.case_scene import SceneMaker
    from conformance.query import Outcome
    from conformance.scenes.model import Geometry, SphereData
    from conformance.scenes.object_model import WorldObject
    from conformance.scenes.world_model import World
    from conformance.schema.scene import SceneModel
    from conformance.source import DocPath

PARTICLE_EMITTER: Final = 0x1000
"""PhysicsState of what registers in its own cell and in no other (08 9.4)."""
STATIC: Final = 0x1
"""PhysicsState of what never moves; it is registered by other rules (08 9.1)."""


def shadow_lists(world: World, scene: SceneModel, maker: SceneMaker) -> dict[int, tuple[int, ...]]:
    """Return the objects of each cell, in the order in which they are written.

    Parameters
    ----------
    world : World
        Without shadow lists.
    scene : SceneModel
        What it was made of; objects with `registered` are taken at their word.
    maker : SceneMaker
        Made its geometries; takes a fault for an object that cannot be registered.
    """
    record, oracle = world.to_record(), make_candidate("oracle")
    lists: dict[int, list[int]] = {}
    for index, (model, thing) in enumerate(zip(scene.objects, world.objects, strict=True)):
        place: DocPath = ("scene", "objects", index)
        if model.registered is not None:
            _check_loaded(model.registered, scene, (*place, "registered"), maker)
            cells = model.registered
        else:
            answer = oracle.answer(_registration(record, thing, maker.geometries))
            cells = _loaded_cells(answer, thing)
            if not cells:
                why = f": {answer.context}" if isinstance(answer, Errored) else ""
                found = f"the object 0x{thing.id:08X}, which retail registers in no cell{why}"
                maker.fault((*place, "pose"), found, "a place in a loaded cell, or 'registered'")
        for cell in dict.fromkeys(cells):
            lists.setdefault(cell, []).append(thing.id)
    return {cell: tuple(ids) for cell, ids in lists.items()}


def _check_loaded(cells: Sequence[int], scene: SceneModel, place: DocPath, maker: SceneMaker) -> None:
    for number, cell in enumerate(cells):
        if not is_loaded(cell, scene):
            expected = f"a cell of the scene: {known_cells(scene)}"
            maker.fault((*place, number), f"the cell 0x{cell:08X}", expected)


def _registration(record: dict[str, Any], thing: WorldObject, geometries: Mapping[str, Geometry]) -> Query:
    """Ask which cells retail lists for an object."""
    inputs: dict[str, Any] = {
        "world": record,
        "object": thing.to_record(),
        "static": int(bool(thing.state & STATIC)),
    }
    if thing.spheres:
        inputs["sorting_sphere"] = list(sorting_sphere(thing.spheres))
    return Query("cross_cells", inputs, geometries)


def _loaded_cells(answer: Outcome, thing: WorldObject) -> list[int]:
    """Return the loaded cells of retail's list; of a particle emitter's its own alone."""
    listed = answer.fields["cells"] if isinstance(answer, Result) else []
    only = {thing.pose.cell} if thing.state & PARTICLE_EMITTER else None
    return [cell for cell, loaded in listed if loaded and (only is None or cell in only)]


def sorting_sphere(spheres: Sequence[SphereData]) -> SphereData:
    """Return a sphere that holds all of an object's, as a setup's sorting sphere does; object space."""
    low = [min(sphere[axis] - sphere[3] for sphere in spheres) for axis in range(3)]
    high = [max(sphere[axis] + sphere[3] for sphere in spheres) for axis in range(3)]
    x, y, z = (to_float32((a + b) / 2.0) for a, b in zip(low, high, strict=True))
    reach = max(length(subtract(sphere[:3], (x, y, z))) + sphere[3] for sphere in spheres)
    return (x, y, z, to_float32(reach))
