"""Random poses, movers, scenes and states: a candidate and retail agree on every bit.

Each test is one operation, or one path of the BSP call; its queries are aimed at contact (``strategies``).
"""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING, Final, Protocol

import pytest
from hypothesis import settings
from hypothesis import strategies as st

from conformance.found import found_cases_dir
from conformance.random_run import DisagreementError, RandomRun, ask_at_random, explain
from conformance.scenes.importers.cell_dump import load_folder
from conformance.strategies.collisions import DISPATCHES, find_collisions, transitions
from conformance.strategies.encounters import ENCOUNTERS
from conformance.strategies.geometry_queries import BSP_OPS, POLYGON_OPS, geometry_queries
from conformance.strategies.math_queries import FRAME_OPS, MOVER_OPS, frame_queries, mover_queries
from conformance.strategies.walks import body_walks, walks
from conformance.summary import PROPERTY

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

    from hypothesis.strategies import SearchStrategy

    from conformance.candidates.base import Candidate
    from conformance.query import Query


REAL_CELL_POSES: Final = 0.5
"""Random poses of each real cell, one query each, as a multiple of the profile's 100."""


class Agree(Protocol):
    """Assert that candidate and oracle agree on a strategy's queries."""

    def __call__(self, queries: SearchStrategy[Query], *, multiple: float) -> None:
        """Ask `multiple` times the profile's number of queries."""


@pytest.fixture
def agree(
    request: pytest.FixtureRequest,
    record_property: Callable[[str, object], None],
    candidate: Candidate,
    oracle: Candidate,
) -> Agree:
    """Return the assertion, bound to this run's candidate; it counts, and keeps what fails as a case."""

    def assertion(queries: SearchStrategy[Query], *, multiple: float) -> None:
        __tracebackhide__ = True
        run = RandomRun()
        name = request.node.name
        failure = ""
        try:
            ask_at_random(queries, candidate, oracle, name=name, multiple=multiple, run=run)
        except DisagreementError as error:
            directory = found_cases_dir(request.config.rootpath)
            profile = settings.get_current_profile_name()
            failure = f"{name}: {error}"
            explanation = explain(run, directory, candidate, name=name, profile=profile)
            request.node.add_report_section("call", "disagreement", explanation)
        record_property(PROPERTY, {**run.counts(), **({"failure": failure} if failure else {})})
        if failure:
            pytest.fail(failure, pytrace=False)
        if not run.compared:
            pytest.skip("; ".join(run.skipped))

    return assertion


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
