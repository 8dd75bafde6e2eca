"""The scenes that an engine holds: each is sent once, and known again by the objects it was made of."""

from __future__ import annotations

from collections import OrderedDict
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Final
from weakref import WeakKeyDictionary

from conformance.protocol.dialects import write_inputs

if TYPE_CHECKING:
    from collections.abc import Mapping

    from conformance.protocol.dialects import Dialect
    from conformance.query import Errored, Query, Skipped
    from conformance.scenes.model import Geometry

KEPT_SCENES: Final = 256
"""How many scenes an engine holds at most; the one that was used longest ago is replaced."""

_UNNAMED: Final = "world"
"""What a world that has no name is called in messages."""

_RECORDS: Final[WeakKeyDictionary[Geometry, dict[Dialect, dict[str, Any]]]] = WeakKeyDictionary()
"""The records of the geometry that was sent, as long as it is in use."""


@dataclass(slots=True)
class HeldScene:
    """A scene that an engine holds.

    Attributes
    ----------
    id : str
        What messages call it.
    geometries, world
        What it was made of; held, so that nothing else can have their identity.
    refused : Skipped, Errored or None
        What becomes of the runs in it, if the engine has not taken it.
    """

    id: str
    geometries: Mapping[str, Geometry]
    world: Mapping[str, Any] | None
    refused: Skipped | Errored | None = None


class SceneSlots:
    """Gives each scene an id, and the ids of scenes long unused to new ones."""

    def __init__(self) -> None:
        self._held: OrderedDict[tuple[object, ...], HeldScene] = OrderedDict()

    def find(self, query: Query) -> tuple[HeldScene | None, bool]:
        """Return the scene of a query, None if it needs none, and whether it must be sent first."""
        world = query.inputs.get("world")
        if not query.geometries and world is None:
            return None, False
        key = (*((name, id(geometry)) for name, geometry in query.geometries.items()), id(world))
        known = self._held.get(key)
        if known is not None:
            self._held.move_to_end(key)
            return known, False
        scene = HeldScene(self._free_id(), query.geometries, world)
        self._held[key] = scene
        return scene, True

    def clear(self) -> None:
        """Forget everything: the engine was started anew."""
        self._held.clear()

    def _free_id(self) -> str:
        if len(self._held) < KEPT_SCENES:
            return f"s{len(self._held)}"
        return self._held.popitem(last=False)[1].id


def scene_message(scene: HeldScene, seq: int, dialect: Dialect) -> dict[str, Any]:
    """Write the message that gives a scene to an engine."""
    records = [{**_written(geometry, dialect), "name": name} for name, geometry in scene.geometries.items()]
    message = {"cmd": "scene", "seq": seq, "id": scene.id, "geometries": records}
    if scene.world is not None:
        world = {"name": world_name(scene.world), **scene.world}
        message["world"] = write_inputs(world, dialect)
    return message


def _written(geometry: Geometry, dialect: Dialect) -> dict[str, Any]:
    """Return the record of a geometry, which many scenes may have, written once."""
    known = _RECORDS.setdefault(geometry, {})
    if dialect not in known:
        known[dialect] = write_inputs(geometry.to_record(), dialect)
    return known[dialect]


def run_message(query: Query, scene: HeldScene | None, seq: int, dialect: Dialect) -> dict[str, Any]:
    """Write the message that asks a query; its world is named."""
    inputs = dict(query.inputs)
    if "world" in inputs:
        inputs["world"] = world_name(inputs["world"])
    message = {"cmd": "run", "seq": seq, "op": query.op, "inputs": write_inputs(inputs, dialect)}
    if scene is not None:
        message["scene"] = scene.id
    if query.label:
        message["label"] = query.label
    return message


def world_name(world: Mapping[str, Any]) -> str:
    """Return what a world is called."""
    return str(world.get("name", _UNNAMED))
