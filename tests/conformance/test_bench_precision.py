"""Work and precision: the same moves as queries, their errors against exact, and the worst kept as a case."""

from __future__ import annotations

from functools import cache
from typing import TYPE_CHECKING

import numpy as np
import pytest

from conformance.bench import precision, sampling
from conformance.bench.precision import NoExactError, measure_precision, transition_query, write_worst
from conformance.bench.report import Report
from conformance.bench.scenes import BenchScene, make_scene
from conformance.bench.spots import Surfaces
from conformance.candidates.oracle_candidate import OracleCandidate
from conformance.loader import load_file
from conformance.query import Result
from engine import resolve_many

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

    from conformance.bench.work import RowWork

COUNT = 4


@cache
def scene() -> BenchScene:
    """Return the room."""
    return make_scene("room")


@cache
def work() -> RowWork:
    """Return moves in it."""
    return sampling.contact_walk(scene(), Surfaces(scene().geometry), np.random.default_rng(2), COUNT)


def clocked() -> Iterator[RowWork]:
    """Yield the moves of a warm-up and of one round."""
    yield from (work(), work())


@cache
def measured() -> Report:
    """Return what is found of them."""
    pytest.importorskip("flint", reason="skipped: python-flint is not installed")
    report = Report(2)
    measure_precision(scene(), work(), clocked, report)
    return report


def test_a_row_and_its_query_are_the_same_move() -> None:
    """The oracle, asked the query, gets where the engine gets from the row, bit for bit."""
    results = resolve_many(scene().world, work().rows)
    for row, result in zip(work().rows, results, strict=True):
        outcome = OracleCandidate().answer(transition_query(scene(), row))
        assert isinstance(outcome, Result)
        assert outcome.fields["curr"]["origin"] == result["curr"][-3:].tolist()
        assert outcome.fields["contact_plane"]["plane"] == result["contact_plane"].tolist()


def test_the_engine_has_the_errors_of_retail() -> None:
    """Bits that are equal are equally far from exact; double precision is nearer."""
    errors = {point.label: point.errors for point in measured().points}
    retail = errors["oracle retail"]
    engine = [found for label, found in errors.items() if label.startswith("engine retail")]
    assert len(engine) >= 3
    assert all(found == retail for found in engine)
    assert 0.0 < retail["contact D (ulps)"] < 100.0
    assert errors["oracle double"]["contact D (m)"] < retail["contact D (m)"]


def test_what_exact_did_is_told() -> None:
    """How many moves, and how many of them it could not decide."""
    facts = measured().facts["exact"]["room"]
    assert facts["queries"] == COUNT
    assert facts["undecided"] == 0
    assert sum(facts["working_precisions"].values()) == COUNT


def test_the_worst_move_is_a_case(tmp_path: Path) -> None:
    """It is written as a case file that loads without a complaint."""
    (worst,) = measured().worst
    assert worst.value > 0.0
    path = write_worst(tmp_path, worst, 2)
    loaded = load_file(path)
    assert not loaded.problems
    (case,) = loaded.cases
    assert case.op == "transition"


def test_without_the_library_it_is_said(monkeypatch: pytest.MonkeyPatch) -> None:
    """What is missing, and which extra brings it."""

    def missing(*_: object) -> None:
        raise ImportError("No module named 'flint'")

    monkeypatch.setattr(precision, "import_exact", missing)
    with pytest.raises(NoExactError, match=r"flint.*extra `exact`"):
        measure_precision(scene(), work(), clocked, Report(2))
