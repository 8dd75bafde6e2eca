"""The engine registers objects as retail does: those of the shipped worlds, and the same anywhere else."""

from __future__ import annotations

import random
from typing import TYPE_CHECKING, Any

import pytest
from shipped_vectors import library

from conformance.candidates.engine_candidate import EngineCandidate
from conformance.candidates.engine_ops.obstacles import obstacle
from conformance.candidates.engine_ops.worlds import engine_world
from conformance.candidates.oracle_candidate import OracleCandidate
from conformance.compare import differences
from conformance.floats import to_float32
from conformance.query import Query, Result
from engine.shadows import register

if TYPE_CHECKING:
    from collections.abc import Mapping

WORLDS = library().worlds
DRAWS = 15
"""Random places for objects of each world."""


def by_spheres_alone(block: Mapping[str, Any]) -> bool:
    """Tell whether only a sorting sphere, which world records do not have, says where an object is."""
    return not block.get("parts") and not block.get("cylspheres")


@pytest.mark.parametrize("name", WORLDS)
def test_the_shadow_lists_of_the_shipped_worlds(name: str) -> None:
    """Each list, in order, but for the objects that have neither parts nor cylspheres."""
    record = WORLDS[name]
    blocks = [block for block in record["objects"] if not by_spheres_alone(block)]
    assert blocks
    known = {block["id"] for block in blocks}
    world = engine_world(record, library().geometries)
    found = register(world, [obstacle(block, library().geometries) for block in blocks])
    listed = {int(cell): [thing for thing in ids if thing in known] for cell, ids in record["shadow"].items()}
    assert {cell: [thing.id for thing in things] for cell, things in found.items()} == {
        cell: things for cell, things in listed.items() if things
    }


def moved(rng: random.Random, record: Mapping[str, Any]) -> dict[str, Any]:
    """Return the inputs of a registration of one of a world's objects, near a room or where it was."""
    thing = {**rng.choice(record["objects"])}
    near = rng.choice([*record["cells"], thing])["pose"]
    reach = rng.choice([1.0, 6.0, 40.0])
    origin = [to_float32(c + rng.uniform(-reach, reach)) for c in near["origin"]]
    thing["pose"] = {**near, "origin": origin, "rotation": thing["pose"]["rotation"]}
    if rng.random() < 0.3:
        thing["state"] ^= 0x10000
    inputs = {"world": record, "object": thing, "static": rng.randint(0, 1)}
    if rng.random() < 0.5:
        inputs["sorting_sphere"] = [0.0, 0.0, 0.5, to_float32(rng.uniform(0.1, 8.0))]
    return inputs


@pytest.mark.parametrize("name", WORLDS)
def test_objects_anywhere_are_registered_as_by_the_oracle(name: str) -> None:
    """In rooms, in doors, on borders; static or not; by parts, cylspheres or a sorting sphere."""
    rng = random.Random(f"registration {name}")
    for _ in range(DRAWS):
        query = Query("cross_cells", moved(rng, WORLDS[name]), library().geometries)
        retail, answer = OracleCandidate().answer(query), EngineCandidate().answer(query)
        assert isinstance(retail, Result)
        assert isinstance(answer, Result)
        assert differences(retail.fields, answer.fields, op="cross_cells", zero_signs="distinct") == []
