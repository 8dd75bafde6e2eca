"""Walks in real cells, each on its own and through their portals: every bit of every tick agrees."""

from __future__ import annotations

import dataclasses
import itertools
import zlib
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Final

import pytest

from conformance.compare import differences
from conformance.query import Result, Skipped
from conformance.report.text import render_differences
from conformance.report.ticks import ticks_around
from conformance.scenes.algebra import length, subtract
from conformance.scenes.importers.cell_dump import load_folder
from conformance.scenes.importers.cell_world import load_worlds
from conformance.scenes.planes import unit_normal
from conformance.scenes.poses import moved_queries, seeded_poses, transform_query
from conformance.scenes.rigid import Transform, move_point
from conformance.step_outputs import start_of, steps
from conformance.vector_io import query_from_record
from oracle.constants import FLOOR_Z

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Mapping
    from pathlib import Path

    from conformance.candidates.base import Candidate
    from conformance.query import Fields, Query
    from conformance.scenes.model import Cell, Vec3
    from conformance.scenes.world_model import World

CELLS: Final = (0xA9B4014B, 0xA9B4014D, 0xA9B40141, 0xA9B40147, 0xA9B40148)
"""Two attics, a room, both parts of a cellar."""
POSES: Final = 3
"""Random poses of each walk besides its own."""
MOST_TARGETS: Final = 6
"""Floors that a walk heads for, the largest first."""
STRIDE: Final = 0.1
"""Metres a tick; 3 m/s at thirty ticks a second."""
MOST_TICKS: Final = 40
"""Toward one target; a wall may be in the way."""
QUANTUM: Final = 1.0 / 30.0
LANDING: Final = 6
"""Ticks without input at the beginning of a body's walk."""
SPHERES: Final = [[0.0, 0.0, 0.475, 0.48], [0.0, 0.0, 1.35, 0.48]]
"""Those of a human, metres."""
ABOVE: Final = 0.05
"""Metres above the floor at which a walk begins."""
AT_REST: Final = 45
"""Ticks after which friction has stopped a body at the end of its route, and a fall is over."""
SPEED: Final = 3.0
"""Of a body on a route, m/s; friction leaves it 2.715 m/s."""
TICKS_A_METRE: Final = 11.05
"""At that speed and thirty ticks a second."""
GRAVITY_ONLY: Final = 0x408
"""State of a body without edge slide: it walks over the edge of a hatch."""


@dataclass(frozen=True, slots=True)
class Route:
    """A way through portals.

    Attributes
    ----------
    start : Vec3
        In the landblock's frame, metres.
    way : tuple of (float, float)
        Points to head for, one after the other.
    cells : tuple of int
        Low words of the cells that it leads through, the first one's included, in order.
    outcome : str
        Of the last tick: ``lost`` where the way leads into a cell that is not loaded.
    fall : int or None
        Index of the point at which the body falls down a hatch and comes to rest before it goes on.
    """

    start: Vec3
    way: tuple[tuple[float, float], ...]
    cells: tuple[int, ...]
    outcome: str = "still"
    fall: int | None = None


ROUTES: Final[Mapping[str, Route]] = {
    "room, doorway, hall, front door": Route(
        (161.4, 8.4, 94.02), ((155.4, 8.4), (155.4, 15.6)), (0x172, 0x173, 0x171, 0x170), "lost"
    ),
    "over the edge of a hatch": Route((156.5, 8.4, 94.02), ((153.9, 8.4),), (0x171, 0x175, 0x174)),
    "down to the cellar and its alcove": Route(
        (138.5, 6.3, 94.02),
        ((141.3, 6.3), (135.0, 6.3), (129.5, 5.5), (127.7, 5.5)),
        (0x143, 0x146, 0x147, 0x148, 0x149),
        fall=0,
    ),
    "attics": Route((134.0, 12.0, 97.02), ((139.5, 12.0), (131.0, 12.0)), (0x14B, 0x14D, 0x14B)),
    "into a room that is not loaded": Route((139.0, 10.5, 94.02), ((134.0, 10.5),), (0x143, 0x144), "lost"),
    "out of the side door": Route((139.0, 5.15, 94.02), ((134.0, 5.15),), (0x143, 0x145), "lost"),
}
"""Through the doorways and hatches of two buildings."""


@pytest.mark.parametrize("op", ["walk", "body_walk"])
@pytest.mark.parametrize("cell_id", CELLS, ids="{:08X}".format)
def test_walk_across_a_real_cell(
    op: str,
    cell_id: int,
    fixtures_dir: Path,
    candidate: Candidate,
    oracle: Candidate,
    record_counts: Callable[[Mapping[str, object]], None],
) -> None:
    """From floor to floor, as it stands and in random poses; it has ground in most ticks as it stands."""
    query = _walk(op, load_folder(fixtures_dir).cells[cell_id])
    answers = _agreed(query, candidate, oracle)
    grounded = [step["on_walkable"] for step in steps(op, start_of(query), answers["ticks"])]
    assert sum(grounded) > len(grounded) / 2
    for pose in seeded_poses(POSES, cell_id):
        _agreed(transform_query(query, pose), candidate, oracle)
    record_counts({"random": 1 + POSES})


@pytest.mark.parametrize("name", ROUTES)
def test_walk_through_the_portals_of_real_cells(
    name: str,
    fixtures_dir: Path,
    candidate: Candidate,
    oracle: Candidate,
    record_counts: Callable[[Mapping[str, object]], None],
) -> None:
    """From cell to cell, in random poses too; as they stand the cells are those of the route."""
    route = ROUTES[name]
    query = _routed(name, route, load_worlds(fixtures_dir))
    answers = _agreed(query, candidate, oracle)
    ticks = list(steps(query.op, start_of(query), answers["ticks"]))
    visited = [cell & 0xFFFF for cell, _ in itertools.groupby(tick["cell"] for tick in ticks)]
    assert tuple(visited) == route.cells
    assert ticks[-1]["outcome"] == route.outcome
    for moved in moved_queries(query, POSES, zlib.crc32(name.encode())):
        _agreed(moved, candidate, oracle)
    record_counts({"random": 1 + POSES})


def _routed(name: str, route: Route, worlds: list[World]) -> Query:
    """Make the walk of a body along a route."""
    (world,) = [one for one in worlds if any(cell.id & 0xFFFF == route.cells[0] for cell in one.cells)]
    (first,) = [cell.id for cell in world.cells if cell.id & 0xFFFF == route.cells[0]]
    ticks: list[dict[str, Any]] = [{"q": QUANTUM}] * LANDING
    x, y, _ = route.start
    for index, (to_x, to_y) in enumerate(route.way):
        distance = length((to_x - x, to_y - y, 0.0))
        velocity = [(to_x - x) / distance * SPEED, (to_y - y) / distance * SPEED, 0.0]
        ticks += [{"q": QUANTUM, "set_velocity": velocity}] * round(distance * TICKS_A_METRE)
        if index in {route.fall, len(route.way) - 1}:
            ticks += [{"q": QUANTUM}] * AT_REST
        x, y = to_x, to_y
    body = _body({"cell": first, "origin": list(route.start), "rotation": [1.0, 0.0, 0.0, 0.0]})
    record = {"op": "body_walk", "world": world.to_record(), "body": body, "ticks": ticks}
    geometries = {geometry.name: geometry for geometry in world.geometries()}
    return query_from_record(record, geometries, label=name)


def _body(start: dict[str, Any]) -> dict[str, Any]:
    body = {"spheres": SPHERES, "step_up_height": 0.6, "step_down_height": 1.5, "position": start}
    return body | {
        "state": GRAVITY_ONLY,
        "transient_state": 0x80,
        "acceleration": [0.0, 0.0, -9.8],
        "movement_manager": 1,
    }


def _agreed(query: Query, candidate: Candidate, oracle: Candidate) -> Fields:
    """Return the answer that both give."""
    __tracebackhide__ = True
    truth, given = oracle.answer(query), candidate.answer(query)
    if isinstance(given, Skipped):
        pytest.skip(f"{candidate.name}: {given.reason}")
    assert isinstance(truth, Result), truth
    assert isinstance(given, Result), given
    found = differences(truth.fields, given.fields, op=query.op, zero_signs="distinct")
    if found:
        lines = render_differences(found, candidate.name)
        lines += ticks_around(found, ("retail", truth.fields), (candidate.name, given.fields))
        pytest.fail("\n".join([query.label, *lines]), pytrace=False)
    return truth.fields


def _walk(op: str, cell: Cell) -> Query:
    """Make a walk from the cell's largest floor to the others, back and forth."""
    first, *others = _floors(cell)
    x, y, z = first
    start = {"cell": cell.id, "origin": [x, y, z + ABOVE], "rotation": [1.0, 0.0, 0.0, 0.0]}
    moves = [move for target in others for move in (*_way(first, target), *_way(target, first))]
    moves = moves or [(STRIDE, 0.0, 0.0)] * MOST_TICKS
    alone = dataclasses.replace(cell, portals=())
    record: dict[str, Any] = {"op": op, "cells": [alone.to_record()]}
    if op == "walk":
        mover = {"spheres": SPHERES, "scale": 1.0, "state": 0x200, "step_up_height": 0.6}
        mover |= {"step_down_height": 1.5, "ethereal": 0, "step_down": 1, "gravity": 1}
        ticks = [{"move": move} for move in ((0.0, 0.0, -2 * ABOVE), *moves)]
        record |= {"mover": mover, "start": start, "ticks": ticks}
    else:
        body = {"spheres": SPHERES, "step_up_height": 0.6, "step_down_height": 1.5, "position": start}
        body |= {"transient_state": 0x80, "acceleration": [0.0, 0.0, -9.8], "movement_manager": 1}
        landing: list[dict[str, Any]] = [{"q": QUANTUM}] * LANDING
        driven = [{"q": QUANTUM, "set_velocity": [part / QUANTUM for part in move]} for move in moves]
        record |= {"body": body, "ticks": landing + driven}
    assert cell.geometry is not None
    return query_from_record(record, {cell.geometry.name: cell.geometry}, label=f"{op} {cell.id:08X}")


def _floors(cell: Cell) -> list[Vec3]:
    """Return the middles of the walkable polygons, the most extended first, in the landblock's frame."""
    assert cell.geometry is not None
    found = []
    for polygon in range(len(cell.geometry.polygons)):
        corners = cell.geometry.corners(polygon)
        if unit_normal(corners)[2] > FLOOR_Z:
            x, y, z = (sum(parts) / len(corners) for parts in zip(*corners, strict=True))
            found.append((max(length(subtract(corner, (x, y, z))) for corner in corners), (x, y, z)))
    assert found
    placed = Transform(cell.pose.rotation, cell.pose.origin)
    return [move_point(placed, middle) for _, middle in sorted(found, reverse=True)[: MOST_TARGETS + 1]]


def _way(start: Vec3, end: Vec3) -> Iterator[Vec3]:
    """Yield level moves from one point toward another."""
    dx, dy = end[0] - start[0], end[1] - start[1]
    distance = length((dx, dy, 0.0))
    for _ in range(min(MOST_TICKS, int(distance / STRIDE))):
        yield (dx / distance * STRIDE, dy / distance * STRIDE, 0.0)
