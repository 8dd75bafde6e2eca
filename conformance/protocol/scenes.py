"""The scenes that an engine holds: each is sent once, and known again by the objects it was made of."""

from __future__ import annotations

from collections import OrderedDict
from dataclasses import dataclass
from json.encoder import encode_basestring
from typing import TYPE_CHECKING, Any, Final
from weakref import WeakKeyDictionary

from conformance.protocol.writing import inputs_text

if TYPE_CHECKING:
    from collections.abc import Mapping

    from conformance.protocol.dialects import Dialect
    from conformance.query import Errored, Query, Skipped
    from conformance.scenes.model import Geometry

KEPT_SCENES: Final = 256
"""How many scenes an engine holds at most; the one that was used longest ago is replaced."""

_UNNAMED: Final = "world"
"""What a world that has no name is called in messages."""

_RECORDS: Final[WeakKeyDictionary[Geometry, dict[Dialect, str]]] = WeakKeyDictionary()
"""The records of the geometry that was sent, as JSON without the opening brace, as long as it is in use."""


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


def scene_line(scene: HeldScene, seq: int, dialect: Dialect) -> bytes:
    """Write the message that gives a scene to an engine.

    Geometry is most of it, and the same in many scenes (a case's poses): it is put in as text.

    Raises
    ------
    RecursionError
        If its trees are nested too deeply for JSON.
    """
    geometries = ",".join(_named(name, geometry, dialect) for name, geometry in scene.geometries.items())
    world = ""
    if scene.world is not None:
        named = {"name": world_name(scene.world), **scene.world}
        world = f',"world":{inputs_text(named, dialect)}'
    head = f'"cmd":"scene","seq":{seq},"id":"{scene.id}"'
    return f'{{{head},"geometries":[{geometries}]{world}}}\n'.encode()


def _named(name: str, geometry: Geometry, dialect: Dialect) -> str:
    """Write the record of a geometry, which scenes may call by different names."""
    known = _RECORDS.setdefault(geometry, {})
    if dialect not in known:
        record = geometry.to_record()
        del record["name"]
        known[dialect] = inputs_text(record, dialect)[1:]
    return f'{{"name":{encode_basestring(name)},{known[dialect]}'


def run_line(query: Query, scene: HeldScene | None, seq: int, dialect: Dialect) -> bytes:
    """Write the message that asks a query; its world is named."""
    inputs = dict(query.inputs)
    if "world" in inputs:
        inputs["world"] = world_name(inputs["world"])
    where = "" if scene is None else f',"scene":"{scene.id}"'
    label = f',"label":{encode_basestring(query.label)}' if query.label else ""
    head = f'"cmd":"run","seq":{seq},"op":"{query.op}"{where}{label}'
    return f'{{{head},"inputs":{inputs_text(inputs, dialect)}}}\n'.encode()


def world_name(world: Mapping[str, Any]) -> str:
    """Return what a world is called."""
    return str(world.get("name", _UNNAMED))
