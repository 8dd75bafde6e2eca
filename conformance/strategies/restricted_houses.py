"""Houses and lots that not everybody may enter (09 3.1): who comes to their doors and borders."""

from __future__ import annotations

from functools import cache
from itertools import cycle
from typing import TYPE_CHECKING, Any, Final

from hypothesis import strategies as st

from conformance.strategies.meetings import draw_meeting, draw_probe
from conformance.strategies.movers import CONTACT, EDGE_SLIDE, ON_WALKABLE, OWN_ID, PLAYER
from conformance.strategies.numbers import FLAGS, anywhere, pick
from conformance.strategies.walks import QUANTA, draw_body, draw_input, draw_segments
from conformance.strategies.world_queries import world_query
from conformance.strategies.worlds.sites import site
from conformance.strategies.worlds.spots import at_outer_door, draw_spot

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from conformance.query import Query
    from conformance.strategies.meetings import Meeting

_SITES: Final = ("farm", "hamlet", "border-house", "half-loaded")
_GUEST: Final = OWN_ID + 1
_RULES: Final[tuple[Mapping[str, Any] | None, ...]] = (
    {"admits": [OWN_ID]},
    {"admits": [_GUEST, OWN_ID]},
    {"admits": []},
    None,
    {"object": 0, "admits": [OWN_ID]},
)
"""What restricts a cell, cell after cell; None: nothing."""
_STATES: Final = st.sampled_from(
    (
        CONTACT | ON_WALKABLE | EDGE_SLIDE | PLAYER,
        CONTACT | ON_WALKABLE | EDGE_SLIDE | PLAYER,
        EDGE_SLIDE | PLAYER,
        CONTACT | ON_WALKABLE | EDGE_SLIDE,
    )
)
_IDS: Final = st.sampled_from((OWN_ID, _GUEST, _GUEST + 1, 0))
_BYPASSES: Final = st.sampled_from((0, 0, 0, 1))
_SPEEDS: Final = st.tuples(anywhere(-6.0, 6.0), anywhere(-6.0, 6.0), st.just(0.0))
_WALKED: Final = st.sampled_from((False, False, False, True))
_TICKS: Final = 10
"""Ticks of a walk in this encounter."""


@st.composite
def movers_at_restricted_cells(draw: st.DrawFn) -> Query:
    """Generate transitions, and few short walks, of players where some cells are restricted."""
    place = site(pick(draw, _SITES))
    probe = draw_probe(draw, draw(_STATES))
    spot = (at_outer_door if draw(FLAGS) else draw_spot)(draw, place, probe.radius)
    met = draw_meeting(draw, probe, spot.target, spot.cell())
    record = _draw_walk(draw, met) if draw(_WALKED) else _draw_transition(draw, met)
    return world_query(record | {"world": place.name}, _restricted(place.name), place)


def _draw_transition(draw: st.DrawFn, met: Meeting) -> dict[str, Any]:
    mover = met.mover | {"id": draw(_IDS)}
    if draw(FLAGS):
        mover["weenie"] = {"bypass": draw(_BYPASSES)}
    record = {"op": "world_transition", "mover": mover, "to": met.end, "seed": met.seed}
    return record | {"from": met.start, "placement_allows_sliding": draw(FLAGS)}


def _draw_walk(draw: st.DrawFn, met: Meeting) -> dict[str, Any]:
    body = draw_body(draw, met.mover, met.start) | {"id": draw(_IDS)}
    body["weenie"] = {"player": 1, "bypass": draw(_BYPASSES)}
    ticks = [{"q": draw(QUANTA), "set_velocity": draw(_SPEEDS)}, *draw_segments(draw, draw_input)]
    return {"op": "body_walk", "body": body, "ticks": ticks[:_TICKS]}


@cache
def _restricted(name: str) -> Mapping[str, Any]:
    """Return a site's world with rules that keep players out: the same object each time."""
    place = site(name)
    rules = zip(_cells_of(place.world), cycle(_RULES), strict=False)
    return {**place.world, "restrictions": {str(cell): rule for cell, rule in rules if rule is not None}}


def _cells_of(world: Mapping[str, Any]) -> Iterator[int]:
    """Yield the ids of all cells of a world: its rooms, and the 64 land cells of each block."""
    yield from (cell["id"] for cell in world["cells"])
    yield from (land["block"] << 16 | number for land in world["landblocks"] for number in range(1, 65))
