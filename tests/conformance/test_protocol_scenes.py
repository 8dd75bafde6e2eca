"""Which scenes an engine holds, and under which ids."""

from __future__ import annotations

import json
from dataclasses import replace

from shipped_vectors import one_of_each

from conformance.protocol.scenes import KEPT_SCENES, HeldScene, SceneSlots, run_line, scene_line
from conformance.query import Query
from conformance.scenes.model import Geometry

QUERY = next(record.query for record in one_of_each() if record.query.op == "polygon_make_plane")
WORLD_QUERY = next(record.query for record in one_of_each() if record.query.op == "point_in_cell")


def other(query: Query) -> Query:
    """Return the same query in a scene of its own."""
    copies = {name: replace(geometry) for name, geometry in query.geometries.items()}
    return replace(query, geometries=copies)


def test_a_scene_is_sent_once() -> None:
    """The same objects are the same scene, whoever asks."""
    slots = SceneSlots()
    first, is_new = slots.find(QUERY)
    assert first is not None
    assert (first.id, is_new) == ("s0", True)
    assert slots.find(replace(QUERY, label="again")) == (first, False)
    second, is_new = slots.find(other(QUERY))
    assert second is not None
    assert (second.id, is_new) == ("s1", True)


def test_nothing_is_sent_where_nothing_is_needed() -> None:
    """An operation on numbers has no scene."""
    query = Query("block_offset", {"from_cell": 1, "to_cell": 1})
    assert SceneSlots().find(query) == (None, False)
    assert json.loads(run_line(query, None, 1, "decimal")) == {
        "cmd": "run",
        "seq": 1,
        "op": "block_offset",
        "inputs": {"from_cell": 1, "to_cell": 1},
    }


def test_the_scene_that_was_not_used_longest_is_replaced() -> None:
    """An engine holds so many and no more."""
    slots = SceneSlots()
    queries = [other(QUERY) for _ in range(KEPT_SCENES)]
    assert [slots.find(query)[1] for query in queries] == [True] * KEPT_SCENES
    slots.find(queries[0])
    scene, is_new = slots.find(QUERY)
    assert scene is not None
    assert (scene.id, is_new) == ("s1", True)
    assert slots.find(queries[0])[1] is False
    assert slots.find(queries[1])[1] is True


def test_a_new_engine_holds_nothing() -> None:
    """Everything is sent again."""
    slots = SceneSlots()
    slots.find(QUERY)
    slots.clear()
    assert slots.find(QUERY)[1] is True


def test_a_message_holds_the_records_of_vector_files() -> None:
    """Geometry under the name that inputs use; a world under its own, which inputs name."""
    slots = SceneSlots()
    scene, _ = slots.find(WORLD_QUERY)
    assert scene is not None
    message = json.loads(scene_line(scene, 1, "decimal"))
    assert [record["name"] for record in message["geometries"]] == list(WORLD_QUERY.geometries)
    geometry = Geometry.from_record(message["geometries"][0])
    assert geometry.vertices == WORLD_QUERY.geometries[geometry.name].vertices
    assert message["world"]["name"] == WORLD_QUERY.inputs["world"]["name"]
    assert (
        json.loads(run_line(WORLD_QUERY, scene, 2, "decimal"))["inputs"]["world"] == message["world"]["name"]
    )


def test_geometry_is_written_once_and_named_where_it_is_used() -> None:
    """Two scenes that call it by different names send the same record under each."""
    name, geometry = next(iter(QUERY.geometries.items()))
    lines = [
        scene_line(HeldScene("s0", {called: geometry}, None), 1, "hex") for called in (name, 'the "floor"')
    ]
    first, second = (json.loads(line)["geometries"][0] for line in lines)
    assert (first.pop("name"), second.pop("name")) == (name, 'the "floor"')
    assert first == second
