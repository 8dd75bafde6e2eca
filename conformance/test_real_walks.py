"""Walks across real cells, each on its own: a candidate and retail agree on every bit of every tick."""

from __future__ import annotations

import dataclasses
from typing import TYPE_CHECKING, Any, Final

import pytest

from conformance.compare import differences
from conformance.query import Result, Skipped
from conformance.report.text import render_differences
from conformance.report.ticks import ticks_around
from conformance.scenes.algebra import length, subtract
from conformance.scenes.importers.cell_dump import load_folder
from conformance.scenes.planes import unit_normal
from conformance.scenes.poses import seeded_poses, transform_query
from conformance.scenes.rigid import Transform, move_point
from conformance.step_outputs import start_of, steps
from conformance.summary import PROPERTY
from conformance.vector_io import query_from_record
from oracle.constants import FLOOR_Z

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator
    from pathlib import Path

    from conformance.candidates.base import Candidate
    from conformance.query import Fields, Query
    from conformance.scenes.model import Cell, Vec3

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
SPHERES: Final = [[0.0, 0.0, 0.475, 0.48], [0.0, 0.0, 1.35, 0.48]]
"""Those of a human, metres."""
ABOVE: Final = 0.05
"""Metres above the floor at which a walk begins."""


@pytest.mark.parametrize("op", ["walk", "body_walk"])
@pytest.mark.parametrize("cell_id", CELLS, ids="{:08X}".format)
def test_walk_across_a_real_cell(
    op: str,
    cell_id: int,
    fixtures_dir: Path,
    candidate: Candidate,
    oracle: Candidate,
    record_property: Callable[[str, object], None],
) -> None:
    """From floor to floor, as it stands and in random poses; it has ground in most ticks as it stands."""
    query = _walk(op, load_folder(fixtures_dir).cells[cell_id])
    answers = _agreed(query, candidate, oracle)
    grounded = [step["on_walkable"] for step in steps(op, start_of(query), answers["ticks"])]
    assert sum(grounded) > len(grounded) / 2
    for pose in seeded_poses(POSES, cell_id):
        _agreed(transform_query(query, pose), candidate, oracle)
    record_property(PROPERTY, {"random": 1 + POSES})


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
        landing: list[dict[str, Any]] = [{"q": QUANTUM}] * 6
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
