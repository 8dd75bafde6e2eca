"""What is drawn in worlds meets doors, land, walls and things, and every candidate can be asked it."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from conformance.candidates.registry import make_candidate
from conformance.query import Result
from conformance.scenes.planes import plane_of, signed_distance
from conformance.strategies.cell_queries import CELL_OPS, cell_queries
from conformance.strategies.land_queries import LAND_DEFS_OPS, land_defs_queries
from conformance.strategies.object_calls import (
    FUNCTIONS,
    object_calls,
    object_transitions,
    times_of_collision,
)
from conformance.strategies.world_encounters import WORLD_ENCOUNTERS
from conformance.strategies.world_queries import LAND_OPS, land_queries, world_transitions
from conformance.strategies.world_walks import world_body_walks, world_walks
from conformance.strategies.worlds.land import surface
from conformance.strategies.worlds.sites import SITES, site
from conformance.strategies.worlds.spots import draw_at_door, draw_on_land, draw_spot

if TYPE_CHECKING:
    from conformance.query import Fields, Query

ORACLE = make_candidate("oracle")
SAME_EVERY_TIME = settings(
    derandomize=True, database=None, deadline=None, suppress_health_check=[HealthCheck.too_slow]
)


def answers(queries: st.SearchStrategy[Query], count: int) -> list[tuple[Query, Fields]]:
    """Ask the oracle `count` queries, the same ones every time."""
    asked: list[tuple[Query, Fields]] = []

    @settings(SAME_EVERY_TIME, max_examples=count)
    @given(queries)
    def ask(query: Query) -> None:
        outcome = ORACLE.answer(query)
        assert isinstance(outcome, Result), outcome
        asked.append((query, outcome.fields))

    ask()
    assert len(asked) >= count / 2
    return asked


@settings(SAME_EVERY_TIME, max_examples=60)
@given(st.data(), st.sampled_from(SITES), st.floats(0.1, 1.0))
def test_spots_are_in_loaded_cells(data: st.DataObject, name: str, radius: float) -> None:
    """A query may begin wherever a spot is."""
    place = site(name)
    cell = draw_spot(data.draw, place, radius).cell()
    assert cell in place.rooms or cell >> 16 in place.blocks


@settings(SAME_EVERY_TIME, max_examples=60)
@given(st.data(), st.floats(0.1, 1.0))
def test_places_on_land_are_near_the_ground(data: st.DataObject, radius: float) -> None:
    """A sphere is put at most three radii, and as deep as water gets, off the ground."""
    place = site("hills")
    spot = draw_on_land(data.draw, place, radius)
    record = next(land for land in place.world["landblocks"] if land["block"] == spot.block)
    x, y, z = spot.target.center
    assert -radius - 1.5 <= z - surface(record, x, y)[0] <= 3.0 * radius + 1.5


@settings(SAME_EVERY_TIME, max_examples=60)
@given(st.data(), st.floats(0.1, 1.0))
def test_places_at_doors_are_near_them(data: st.DataObject, radius: float) -> None:
    """A sphere is put within two radii of the plane of one of the house's doors."""
    place = site("farm")
    target = draw_at_door(data.draw, place, radius).target
    distances = []
    for cell in place.world["cells"]:
        origin = cell["pose"]["origin"]
        local = tuple(c - o for c, o in zip(target.center, origin, strict=True))
        distances += [
            abs(signed_distance(plane_of(p["polygon"]), (local[0], local[1], local[2])))
            for p in cell["portals"]
        ]
    assert min(distances) <= 2.0 * radius + 1e-2


def test_transitions_go_everywhere() -> None:
    """They end outdoors and indoors, change cells, touch things, collide, and fail."""
    asked = answers(world_transitions(), 150)
    indoors = {fields["check_cell"] & 0xFFFF >= 0x100 for _, fields in asked}
    assert indoors == {False, True}
    moved = [fields["curr_cell"] != query.inputs["to"]["cell"] for query, fields in asked]
    assert 0.02 < sum(moved) / len(moved) < 0.9
    assert any(fields["collide_objects"] for _, fields in asked)
    assert any(fields["contact_plane"]["valid"] for _, fields in asked)
    letters = {letter for _, fields in asked for letter in fields["trace"]}
    assert set("TBKDPASC") <= letters
    assert {fields["result"] for _, fields in asked} == {0, 1}


def test_walks_change_cells() -> None:
    """Several walks leave the cell that they begin in, and things are touched."""
    ticks = [tick for _, fields in answers(world_walks(), 12) for tick in fields["ticks"]]
    assert sum("cell" in tick for tick in ticks) >= 3
    assert any("cn" in tick for tick in ticks)
    assert any(tick.get("onw") for tick in ticks)


def test_bodies_walk_in_worlds() -> None:
    """Bodies move on the ground and in the air."""
    ticks = [tick for _, fields in answers(world_body_walks(), 6) for tick in fields["ticks"]]
    assert {bool(tick["ts"] & 1) for tick in ticks} == {False, True}


@pytest.mark.parametrize("function", FUNCTIONS)
def test_object_calls_are_mixed(function: str) -> None:
    """Each function lets pass, stops, and moves or turns aside."""
    results = {fields["result"] for _, fields in answers(object_calls(function), 80)}
    assert results >= {"OK", "COLLIDED"}
    assert results & {"ADJUSTED", "SLID"}


def test_object_transitions_touch() -> None:
    """Some transitions touch what is there, some do not."""
    touched = [bool(fields["collide_objects"]) for _, fields in answers(object_transitions(), 60)]
    assert 0.02 < sum(touched) / len(touched) < 0.98


def test_times_of_collision_hit_and_miss() -> None:
    """A ball is met, missed, and begun inside of."""
    times = [fields["t"] for _, fields in answers(times_of_collision(), 100)]
    assert -1.0 in times
    assert any(time > 0.0 for time in times)


@pytest.mark.parametrize("op", LAND_OPS)
def test_land_queries_are_mixed(op: str) -> None:
    """The ground lets pass, and pushes or stops."""
    results = {fields["result"] for _, fields in answers(land_queries(op), 60)}
    assert "OK" in results
    assert results & {"ADJUSTED", "COLLIDED"}


@pytest.mark.parametrize("op", CELL_OPS)
def test_cell_queries_can_be_answered(op: str) -> None:
    """The oracle answers all of them, and not always alike."""
    given_answers = {repr(fields) for _, fields in answers(cell_queries(op), 40)}
    assert len(given_answers) >= 2


@pytest.mark.parametrize("op", LAND_DEFS_OPS)
def test_land_defs_queries_can_be_answered(op: str) -> None:
    """The oracle answers all of them, and not always alike."""
    given_answers = {repr(fields) for _, fields in answers(land_defs_queries(op), 40)}
    assert len(given_answers) >= 2


@pytest.mark.parametrize("encounter", WORLD_ENCOUNTERS)
def test_encounters_can_be_answered(encounter: str) -> None:
    """The oracle answers all of them."""
    assert answers(WORLD_ENCOUNTERS[encounter], 20)
