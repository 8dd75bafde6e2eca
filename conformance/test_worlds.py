"""Random worlds: houses, land, water and things; a candidate and retail agree on every bit.

With ``--hypothesis-profile soak`` each property asks 200 times as much: the transitions alone are then
20,000, the walks 300 of either kind.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

import pytest

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

if TYPE_CHECKING:
    from conformance.agreement import Agree

WALKS: Final = 0.015
"""Random walks of either kind, 60 ticks each, as a multiple of the profile's queries."""


def test_world_transition(agree: Agree) -> None:
    """A transition agrees on every output, outdoors, indoors and from one to the other."""
    agree(world_transitions(), multiple=1.0)


def test_world_walk(agree: Agree) -> None:
    """Recorded moves through doors, over borders and into things agree on every bit of every tick."""
    agree(world_walks(), multiple=WALKS)


def test_world_body_walk(agree: Agree) -> None:
    """A body that moves by itself in a world agrees on every bit of every tick."""
    agree(world_body_walks(), multiple=WALKS)


@pytest.mark.parametrize("function", FUNCTIONS)
def test_object_call(function: str, agree: Agree) -> None:
    """One call of a shape, an object or a cell's objects agrees, whichever path it takes."""
    agree(object_calls(function), multiple=0.5)


def test_object_transition(agree: Agree) -> None:
    """A transition in a cell with objects agrees on every output."""
    agree(object_transitions(), multiple=0.5)


def test_time_of_collision(agree: Agree) -> None:
    """The time at which a ball is met agrees to the last bit of a double."""
    agree(times_of_collision(), multiple=0.2)


@pytest.mark.parametrize("op", LAND_OPS)
def test_land(op: str, agree: Agree) -> None:
    """The ground of a land cell answers alike."""
    agree(land_queries(op), multiple=0.3)


@pytest.mark.parametrize("op", CELL_OPS)
def test_cells(op: str, agree: Agree) -> None:
    """Cell lists, their order and what is not loaded agree."""
    agree(cell_queries(op), multiple=0.3)


@pytest.mark.parametrize("op", LAND_DEFS_OPS)
def test_land_defs(op: str, agree: Agree) -> None:
    """Ids, coordinates, cuts, planes and waters agree."""
    agree(land_defs_queries(op), multiple=0.1)


@pytest.mark.parametrize("encounter", WORLD_ENCOUNTERS)
def test_encounter(encounter: str, agree: Agree) -> None:
    """What aimed queries seldom meet agrees on every output."""
    agree(WORLD_ENCOUNTERS[encounter], multiple=0.3)
