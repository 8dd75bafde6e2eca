"""Worlds of the oracle's candidate: built lazily, kept by identity, and never changed by a question."""

from __future__ import annotations

from itertools import pairwise
from typing import TYPE_CHECKING, Any

import pytest
from shipped_vectors import VECTORS, library, records

from conformance.candidates.bug_candidate import BugCandidate, KnownBug
from conformance.candidates.kept_worlds import KEPT_WORLDS, KeptWorlds
from conformance.candidates.oracle_candidate import OracleCandidate
from conformance.candidates.oracle_ops import world as worlds
from conformance.candidates.oracle_ops.world import build_world, oracle_world
from conformance.candidates.replacements import Method
from conformance.query import Errored, Query, Result
from oracle.land_block import LandBlock
from oracle.physics_state import ETHEREAL_PS, STATIC_PS

if TYPE_CHECKING:
    from collections.abc import Mapping

    from conformance.query import Fields
    from conformance.scenes.model import Geometry
    from oracle.world import World

ROLLING = "w_roll0"
"""A world with a house, six interior cells and objects indoors and outdoors."""
SPAN = 192.0


@pytest.fixture
def generated(monkeypatch: pytest.MonkeyPatch) -> list[int]:
    """Return the list of the blocks that are generated during a test."""
    made: list[int] = []
    generate = LandBlock.generate

    def noted(self: LandBlock) -> None:
        made.append(self.block_id >> 16)
        generate(self)

    monkeypatch.setattr(LandBlock, "generate", noted)
    return made


def record() -> dict[str, Any]:
    """Return the shipped record of the rolling world."""
    return library().worlds[ROLLING]


def geometries() -> Mapping[str, Geometry]:
    """Return every shipped geometry."""
    return library().geometries


def first(op: str) -> Query:
    """Return the first shipped query of an operation."""
    files = ("terrain", "cells", "world_transition", "world_walk")
    return next(r.query for name in files for r in records(VECTORS / f"{name}.jsonl") if r.query.op == op)


def answer(query: Query, **inputs: Any) -> Fields:
    """Return the oracle's answer to a query with other inputs."""
    outcome = OracleCandidate().answer(Query(query.op, {**query.inputs, **inputs}, query.geometries))
    assert isinstance(outcome, Result), outcome
    return outcome.fields


def held(world: World) -> dict[int, list[int]]:
    """Return the ids of the objects in every cell that holds any."""
    cells = [*world.cells.values(), *(c for b in world.landscape.blocks.values() for c in b.cells)]
    return {c.id: [o.id for o in c.shadow_object_list] for c in cells if c.shadow_object_list}


def test_a_world_has_what_its_record_says() -> None:
    """Cells with their visible cells, objects in the given order, the building under its origin."""
    given, world = record(), build_world(record(), geometries())
    assert sorted(world.cells) == sorted(cell["id"] for cell in given["cells"])
    assert all(world.cells[cell["id"]].stab_list == tuple(cell["stab"]) for cell in given["cells"])
    loaded = {int(cell_id): ids for cell_id, ids in given["shadow"].items()}
    assert held(world) == loaded
    holders = [c for b in world.landscape.blocks.values() for c in b.cells if c.building is not None]
    assert len(holders) == len(given["buildings"]) == 1
    portals = [(p.other_cell_id, p.other_portal_id) for p in holders[0].building.portals]  # type: ignore[union-attr]
    assert portals == [(p["other"], p["other_portal"]) for p in given["buildings"][0]["portals"]]


def test_an_object_in_several_cells_is_one() -> None:
    """Touching it from two cells records it once."""
    world = build_world(record(), geometries())
    seen: dict[int, int] = {}
    for block in world.landscape.blocks.values():
        for cell in block.cells:
            for thing in cell.shadow_object_list:
                assert seen.setdefault(thing.id, id(thing)) == id(thing)
    assert seen


def test_blocks_are_generated_when_they_are_looked_at(generated: list[int]) -> None:
    """One cell asked for is one block; the others cost nothing."""
    world = build_world(record(), geometries())
    assert (generated, len(world.landscape.blocks)) == ([], 4)
    block = record()["landblocks"][1]["block"]
    for _ in range(2):
        assert world.get_visible(block << 16 | 1) is not None
    assert generated == [block]
    assert world.get_visible(0x00000001) is None
    assert list(world.landscape.blocks) == [item["block"] for item in record()["landblocks"]]


def test_a_building_beyond_its_block_is_in_the_one_under_it() -> None:
    """The land cell that contains the origin holds it, whatever block the pose names."""
    given = record()
    building = given["buildings"][0]
    pose = building["pose"]
    x, y, z = pose["origin"]
    west = {**pose, "cell": pose["cell"] - (1 << 24), "origin": [x + SPAN, y, z]}
    moved = {**given, "buildings": [{**building, "pose": west}]}
    cells = []
    for source in (given, moved):
        world = build_world(source, geometries())
        cells += [c.id for b in world.landscape.blocks.values() for c in b.cells if c.building is not None]
    assert len(set(cells)) == 1


def test_a_building_beyond_the_land_is_dropped() -> None:
    """There is nothing under its origin."""
    given = record()
    pose = {"cell": 0x0000FFFF, "origin": [-5.0, 5.0, 0.0], "rotation": [1.0, 0.0, 0.0, 0.0]}
    world = build_world({**given, "buildings": [{**given["buildings"][0], "pose": pose}]}, geometries())
    assert {c.building for b in world.landscape.blocks.values() for c in b.cells} == {None}


class TestCache:
    """Worlds that many queries share are built once."""

    def test_by_the_identity_of_the_record(self) -> None:
        """An equal record has a world of its own."""
        assert oracle_world(record(), geometries()) is oracle_world(record(), geometries())
        assert oracle_world(dict(record()), geometries()) is not oracle_world(record(), geometries())

    def test_by_the_identity_of_its_geometries(self) -> None:
        """Others of the same name make another world; those that it does not use do not."""
        cache, given = KeptWorlds(build_world), record()
        world = cache.world_of(given, geometries())
        assert cache.world_of(given, {**geometries(), "unused": geometries()["seed_tri"]}) is world
        shell = given["buildings"][0]["geometry"]
        assert cache.world_of(given, {**geometries(), shell: geometries()["seed_tri"]}) is not world

    def test_it_is_bounded(self) -> None:
        """The oldest of the worlds is forgotten."""
        cache, copies = KeptWorlds(build_world), [dict(record()) for _ in range(KEPT_WORLDS)]
        world = cache.world_of(record(), geometries())
        for copy in copies[:-1]:
            cache.world_of(copy, geometries())
        assert cache.world_of(record(), geometries()) is world
        cache.world_of(copies[-1], geometries())
        assert cache.world_of(record(), geometries()) is not world

    def test_a_bug_has_its_own(self) -> None:
        """What a wrong oracle has built is not what the right one uses."""
        made: list[int] = []

        def counting(retail: Any) -> Any:
            def build(*args: Any) -> Any:
                made.append(1)
                return retail(*args)

            return build

        query = first("point_in_cell")
        candidate = BugCandidate(
            KnownBug("x", "builds", "builds", (Method(worlds, "build_world", counting),))
        )
        OracleCandidate().answer(query)
        candidate.answer(query)
        candidate.answer(query)
        assert made == [1]


def test_questions_leave_a_world_as_it_is() -> None:
    """Registering an object and letting a body walk happen in worlds of their own."""
    cross = first("cross_cells")
    walk = next(r.query for r in records(VECTORS / "tick.jsonl") if "world" in r.query.inputs)
    for query in (cross, walk):
        shared = oracle_world(query.inputs["world"], query.geometries)
        before = held(shared)
        twice = [answer(query) for _ in range(2)]
        assert twice[0] == twice[1]
        assert (held(shared), shared.clock.curr_time) == (before, 0.0)


def test_every_record_may_be_asked_again() -> None:
    """Answers do not depend on what was asked of the same world before."""
    asked = [r.query for r in records(VECTORS / "world_transition.jsonl")[:12]]
    forwards = [answer(query) for query in asked]
    assert [answer(query) for query in reversed(asked)][::-1] == forwards


@pytest.mark.parametrize(
    ("op", "message"),
    [("land_find_terrain_poly", "no land cell 0x00000041"), ("point_in_cell", "no cell 0x00000041")],
)
def test_a_cell_that_is_not_there_is_an_error(op: str, message: str) -> None:
    """A question about it cannot be answered."""
    query = first(op)
    outcome = OracleCandidate().answer(Query(op, {**query.inputs, "cell": 0x41}, query.geometries))
    assert isinstance(outcome, Errored)
    assert message in outcome.context


def test_a_placement_begins_in_the_cell_of_its_target() -> None:
    """`from` null: the begin cell is the loaded one of `to`; without one there is no position."""
    query = next(
        r.query for r in records(VECTORS / "world_transition.jsonl") if r.query.inputs["from"] is None
    )
    assert answer(query)["curr_cell"] != 0
    nowhere = {**query.inputs["to"], "cell": 0x00000001}
    assert answer(query, to=nowhere)["result"] == 0


def test_a_walk_tells_of_a_cell_when_it_changes() -> None:
    """Never the same cell twice in a row; FORMAT.md."""
    query = first("world_walk")
    told = [query.inputs["start"]["cell"]]
    told += [tick["cell"] for tick in answer(query)["ticks"] if "cell" in tick]
    assert len(told) > 2
    assert all(cell != before for before, cell in pairwise(told))


def test_a_walk_tells_of_water() -> None:
    """A shipped walk through water tells of it; on the same land without water it does not."""
    walks = records(VECTORS / "world_walk.jsonl")
    query = next(r.query for r in walks if any("water" in tick for tick in r.expected["ticks"]))
    given = query.inputs["world"]
    dry = {**given, "landblocks": [{**block, "terrain": None} for block in given["landblocks"]]}
    assert {tick["water"] for tick in answer(query)["ticks"] if "water" in tick} == {1}
    assert all("water" not in tick for tick in answer(query, world=dry)["ticks"])


def test_a_walk_tells_of_objects() -> None:
    """Objects that are ethereal and not static are touched on the way, and then told by their ids."""
    query = next(r.query for r in records(VECTORS / "world_walk.jsonl") if r.id == "ww_0153")
    given = query.inputs["world"]
    airy = [{**thing, "state": thing["state"] & ~STATIC_PS | ETHEREAL_PS} for thing in given["objects"]]
    ticks = answer(query, world={**given, "objects": airy})["ticks"]
    touched = {object_id for tick in ticks for object_id in tick.get("objs", ())}
    assert touched
    assert touched <= {thing["id"] for thing in airy}
    assert all("objs" not in tick for tick in answer(query)["ticks"])
