"""Bodies that are put down (06, 10)."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest
from engine_bodies import f32
from engine_scenes import CELL, R, triangle

from engine import (
    Body,
    Cell,
    LandBlock,
    Obstacle,
    Placement,
    PlacementResult,
    Pose,
    QueryError,
    Weenie,
    World,
    place,
    step,
)
from engine.constants import (
    ACTIVE_TS,
    CONTACT_TS,
    DEFAULT_STATE,
    IGNORE_COLLISIONS,
    ON_WALKABLE_TS,
    REPORT_COLLISIONS_PS,
)
from engine.layout import NO_CELL

if TYPE_CHECKING:
    from collections.abc import Sequence

PILLAR = Obstacle(Pose(CELL), state=0, id=7, cylspheres=[(0, 0, 0, 1.0, 3.0)])
BODY = Body(Pose(CELL, (3, 0, 2)), [(0, 0, 0, R)], step_up_height=0.6, step_down_height=1.5)


def room(*things: Obstacle) -> World:
    """Return a level floor of 40 metres, and land."""
    return World([Cell(CELL, Pose(CELL), triangle(20.0), things)], [LandBlock(0xA9B4, [0.0] * 81)])


def put(world: World, where: Sequence[float], body: Any = BODY, **flags: bool) -> Placement:
    """Put a body down in the room."""
    return place(world, body, Pose(CELL, where), CELL, **flags)


def test_a_body_settles_on_the_ground() -> None:
    """FP-5: one sphere steps down by half its radius, 0.24, and stands; the wanted origin becomes that."""
    placed = put(room(), (1, 2, 0.7))
    assert placed.result == PlacementResult.PLACED
    assert placed.origin == tuple(placed.body["origin"]) == (1.0, 2.0, R)
    assert int(placed.body["transient_state"]) & 3 == CONTACT_TS | ON_WALKABLE_TS
    assert placed.body["contact_plane"].tolist() == [0, 0, 1, 0]


def test_the_body_given_stays_as_it_is() -> None:
    """Another one is returned, and may be put down again, or tick."""
    placed = put(room(), (1, 2, 0.7))
    before = placed.body.tobytes()
    again = put(room(), (4, 2, 0.7), placed.body)
    assert placed.body.tobytes() == before
    assert again.body["origin"].tolist() == [4.0, 2.0, R]
    assert step(room(), again.body, 0.1)["origin"].tolist() == [4.0, 2.0, R]


def test_a_body_in_the_air_stays_there() -> None:
    """The ground is 0.25 below it, and so beyond its reach."""
    placed = put(room(), (1, 2, R + 0.25))
    assert placed.origin == (1.0, 2.0, f32(R + 0.25))
    assert not int(placed.body["transient_state"]) & 3


def test_without_sliding_there_is_no_other_place() -> None:
    """SP-5, SP-6: where something stands is no room; the body stays where it was."""
    placed = put(room(PILLAR), (0.5, 0, 1))
    assert placed.result == PlacementResult.NO_VALID_POSITION
    assert placed.origin == (0.5, 0.0, 1.0)
    assert placed.body["origin"].tolist() == [3, 0, 2]


def test_with_sliding_a_ring_is_searched() -> None:
    """PP-4: n = ceil(4 / 0.48) = 9 rings, the third at 3 * 4 / 9 is the first to clear 1 + 0.48."""
    placed = put(room(PILLAR), (0, 0, 1), slide=True)
    assert placed.result == PlacementResult.PLACED
    x, y, _ = placed.body["origin"]
    assert np.hypot(x, y) == pytest.approx(4 * 4.0 / 9.0, abs=1e-4)
    assert placed.origin == (0.0, 0.0, 1.0)


REPORTS: list[tuple[str, dict[str, Any], dict[str, Any], PlacementResult]] = [
    ("the body's game object is told", {"weenie_bits": 0}, {}, PlacementResult.COLLIDED),
    ("it does not want to be", {"weenie_bits": 0, "state": 0x400}, {}, PlacementResult.NO_VALID_POSITION),
    ("there is none", {}, {}, PlacementResult.NO_VALID_POSITION),
    (
        "the pillar's is told",
        {},
        {"state": int(REPORT_COLLISIONS_PS), "weenie": Weenie()},
        PlacementResult.COLLIDED,
    ),
    (
        "but not of who ignores collisions",
        {"state": DEFAULT_STATE | int(IGNORE_COLLISIONS)},
        {"state": int(REPORT_COLLISIONS_PS), "weenie": Weenie()},
        PlacementResult.NO_VALID_POSITION,
    ),
]


@pytest.mark.parametrize(("_why", "body", "pillar", "expected"), REPORTS, ids=[why for why, *_ in REPORTS])
def test_who_is_told_of_what_is_in_the_way(
    _why: str, body: dict[str, Any], pillar: dict[str, Any], expected: PlacementResult
) -> None:
    """SP-6: a collision that is reported is another answer."""
    world = room(replace(PILLAR, **pillar))
    assert put(world, (0.5, 0, 1), replace(BODY, **body)).result == expected


@pytest.mark.parametrize(("cell", "expected"), [(0xA9B40001, 0xA9B40009), (CELL, CELL)])
def test_in_no_cell_a_body_is_lost(cell: int, expected: int) -> None:
    """SP-3: outdoors at the id of the land under it, whether that is in the world or not."""
    placed = place(room(), BODY, Pose(cell, (30, 0, 2)), None)
    assert placed.result == PlacementResult.PLACED
    assert placed.body["cell"] == NO_CELL
    assert placed.body["cell_id"] == expected
    assert placed.body["origin"].tolist() == [30, 0, 2]
    assert not int(placed.body["transient_state"]) & ACTIVE_TS


@pytest.mark.parametrize("slide", [False, True])
def test_a_body_is_not_placed_outside_of_all_cells(slide: bool) -> None:
    """FP-3: the pose is on land that is not in the world, whatever the cell that was named."""
    placed = place(room(), BODY, Pose(0x00010001, (0, 0, 9)), 0xA9B40001, slide=slide)
    assert placed.result == PlacementResult.NO_VALID_POSITION
    assert placed.body["origin"].tolist() == [3, 0, 2]


def test_it_ends_in_the_cell_that_was_named() -> None:
    """SP-5: in another one it is somewhere else, unless it may slide; the pose's own id is not asked."""
    here = Pose(0xA9B40001, (30, 6, 0.5))
    assert place(room(), BODY, here, 0xA9B40001).result == PlacementResult.NO_VALID_POSITION
    for cell, slide in ((0xA9B40009, False), (0xA9B40001, True)):
        placed = place(room(), BODY, here, cell, slide=slide)
        assert placed.result == PlacementResult.PLACED
        assert placed.body["cell_id"] == 0xA9B40009


def test_a_cell_that_is_named_is_in_the_world() -> None:
    """Also the body must be one."""
    with pytest.raises(QueryError, match="cell: 0x00010100 is not in the world"):
        place(room(), BODY, Pose(CELL), 0x00010100)
    with pytest.raises(QueryError, match=r"body: .* where a Body, or a record"):
        place(room(), np.zeros(1)[0], Pose(CELL), CELL)
