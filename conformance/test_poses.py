"""Random poses, movers, scenes and states: a candidate and retail agree on every bit.

Each test is one operation, or one path of the BSP call; its queries are aimed at contact (``strategies``).
"""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING, Final

import pytest
from hypothesis import strategies as st

from conformance.scenes.importers.cell_dump import load_folder
from conformance.strategies.collisions import DISPATCHES, find_collisions, transitions
from conformance.strategies.encounters import ENCOUNTERS
from conformance.strategies.geometry_queries import BSP_OPS, POLYGON_OPS, geometry_queries
from conformance.strategies.math_queries import FRAME_OPS, MOVER_OPS, frame_queries, mover_queries
from conformance.strategies.walks import body_walks, walks

if TYPE_CHECKING:
    from pathlib import Path

    from conformance.agreement import Agree


REAL_CELL_POSES: Final = 0.5
"""Random poses of each real cell, one query each, as a multiple of the profile's 100."""


@pytest.mark.parametrize("dispatch", DISPATCHES)
def test_find_collisions(dispatch: str, agree: Agree) -> None:
    """One BSP call agrees on every output, whichever path it takes."""
    agree(find_collisions(dispatch), multiple=1.0)


def test_transition(agree: Agree) -> None:
    """A whole transition agrees on every output."""
    agree(transitions(), multiple=1.0)


def test_walk(agree: Agree) -> None:
    """Recorded moves agree on every bit of every tick."""
    agree(walks(), multiple=0.15)


def test_body_walk(agree: Agree) -> None:
    """A body that moves by itself agrees on every bit of every tick."""
    agree(body_walks(), multiple=0.15)


@pytest.mark.parametrize("op", POLYGON_OPS)
def test_polygon(op: str, agree: Agree) -> None:
    """A polygon's predicate agrees."""
    agree(geometry_queries(op), multiple=0.15)


@pytest.mark.parametrize("op", BSP_OPS)
def test_bsp(op: str, agree: Agree) -> None:
    """A query of the tree agrees."""
    agree(geometry_queries(op), multiple=0.15)


@pytest.mark.parametrize("op", FRAME_OPS)
def test_frame(op: str, agree: Agree) -> None:
    """A frame, position or plane agrees."""
    agree(frame_queries(op), multiple=0.1)


@pytest.mark.parametrize("op", MOVER_OPS)
def test_mover(op: str, agree: Agree) -> None:
    """A mover's spheres and its slides agree."""
    agree(mover_queries(op), multiple=0.2)


@pytest.mark.parametrize("encounter", ENCOUNTERS)
def test_encounter(encounter: str, agree: Agree) -> None:
    """What aimed queries almost never meet agrees on every output."""
    agree(ENCOUNTERS[encounter], multiple=0.3)


def test_real_cells(agree: Agree, fixtures_dir: Path) -> None:
    """In each real cell, at 50 random poses, one BSP call agrees on every output, whichever path it takes."""
    folder = load_folder(fixtures_dir)
    shapes = [cell.geometry for cell in folder.cells.values() if cell.geometry is not None]
    assert shapes
    for shape in shapes:
        collisions = partial(find_collisions, geometries=st.just(shape))
        agree(st.sampled_from(list(DISPATCHES)).flatmap(collisions), multiple=REAL_CELL_POSES)
