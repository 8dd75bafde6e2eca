"""Work and precision: what each implementation costs, and how far its answers are from the exact ones.

The exact answer is that of the oracle's own functions on certified ball arithmetic (`conformance.exact`).
The engine is bit for bit the oracle, so its errors are the oracle's; that, too, is measured here.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, Final

import yaml

from conformance.bench import ops
from conformance.bench.engine_jobs import engine_maker, in_calls
from conformance.bench.figures import summarise
from conformance.bench.report import Point
from conformance.bench.settings import BATCHES, LARGE, THREADS
from conformance.bench.timing import demand_equal, take_turns
from conformance.candidates.engine_candidate import EngineCandidate
from conformance.candidates.model_candidate import double, single
from conformance.candidates.oracle_candidate import OracleCandidate
from conformance.files import write_text
from conformance.found import found_document
from conformance.query import Query

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Mapping
    from pathlib import Path

    from conformance.bench.report import Report, Worst
    from conformance.bench.scenes import BenchScene
    from conformance.bench.work import RowWork
    from conformance.exact.candidate import ExactCandidate
    from conformance.exact.survey import Survey

MEASURES: Final[Mapping[str, str]] = {
    "contact D (m)": "contact_metres",
    "contact D (ulps)": "contact_ulps",
    "normal (rad)": "normal_radians",
    "position (m)": "position_metres",
}
"""What a point says, a median over all queries whose decisions are exact's; the measures of `ErrorSample`."""
FLIPS: Final = "decision flips"
"""Share of queries with another state, polygon or cell than exact."""
WORST_BY: Final = "position_metres"
"""The measure whose largest value makes a query the worst."""
ORACLE: Final = "oracle retail"
ENGINE: Final = "engine retail"
_WIDTH: Final = 110
_NANOSECONDS: Final = 1e9


class NoExactError(Exception):
    """The exact model cannot be used here."""


def measure_precision(
    scene: BenchScene, work: RowWork, clocked: Callable[[], Iterator[RowWork]], report: Report
) -> None:
    """Add a point for each implementation, and the worst query of retail, to a report.

    Parameters
    ----------
    scene : BenchScene
    work : RowWork
        Moves in it, whose errors are measured.
    clocked : callable
        Draws more moves like these, of a warm-up and of each round that the engine is clocked in.
    report : Report

    Raises
    ------
    NoExactError
        If the library of balls is not installed.
    """
    survey = _survey(scene, work)
    seconds = survey.seconds
    for name in survey.models:
        if name != ENGINE:
            _add_point(report, scene, name, seconds[name] / len(work) * _NANOSECONDS, survey, name)
    for label, cost in _engine_costs(clocked()).items():
        _add_point(report, scene, f"{ENGINE}, {label}", cost, survey, ENGINE)
    facts = report.facts.setdefault("exact", {})
    facts[scene.name] = {
        "queries": len(work),
        "undecided": len(survey.undecided),
        "with_ties": survey.tied,
        "working_precisions": {str(bits): count for bits, count in sorted(survey.precisions.items())},
        "exact_ns": seconds[survey.exact.name] / len(work) * _NANOSECONDS,
    }
    spread = survey.summaries[ORACLE].spread(WORST_BY)
    if spread is not None:
        report.keep_worst(scene.name, WORST_BY, spread.largest, spread.worst)


def import_exact() -> tuple[type[Survey], type[ExactCandidate]]:
    """Import what the exact model needs; raises `ImportError` if it is not installed."""
    from conformance.exact.candidate import ExactCandidate
    from conformance.exact.survey import Survey

    return Survey, ExactCandidate


def _survey(scene: BenchScene, work: RowWork) -> Survey:
    try:
        make_survey, make_exact = import_exact()
    except ImportError as error:
        raise NoExactError(f"{error} (extra `exact`)") from error
    models = {
        ORACLE: OracleCandidate().answer,
        "oracle single": single().unrounded,
        "oracle double": double().unrounded,
        ENGINE: EngineCandidate().answer,
    }
    survey = make_survey(models, make_exact())
    for row in work.rows:
        survey.ask(transition_query(scene, row))
    return survey


def _engine_costs(works: Iterator[RowWork]) -> dict[str, float]:
    """Return the median nanoseconds of a move, in calls of so many on so many threads."""
    makers = {f"batch {batch}, 1 thread": in_calls(ops.CONTACT_WALK, batch) for batch in BATCHES}
    makers[f"batch {LARGE}, {THREADS} threads"] = engine_maker(ops.CONTACT_WALK, LARGE, THREADS)
    times = take_turns(list(makers.values()), works, warm_up=next(works), judge=demand_equal)
    return {label: summarise(each).middle for label, each in zip(makers, times, strict=True)}


def _add_point(
    report: Report, scene: BenchScene, label: str, cost: float, survey: Survey, model: str
) -> None:
    summary = survey.summaries[model]
    found = {shown: summary.spread(measure) for shown, measure in MEASURES.items()}
    errors = {shown: math.nan if spread is None else spread.median for shown, spread in found.items()}
    report.points.append(Point(scene.name, label, cost, {**errors, FLIPS: summary.flip_rate}))


def transition_query(scene: BenchScene, row: Any) -> Query:
    """Return a move as the query that any candidate can be asked.

    Parameters
    ----------
    scene : BenchScene
    row : record of `engine.layout.QUERY_DTYPE`
    """
    inputs = {
        "cells": scene.cells(),
        "mover": _mover(row),
        "from": _pose(row["start"]),
        "to": _pose(row["end"]),
        "begin_cell": scene.pose.cell,
        "seed": {key: _contact(row, name) for key, name in _SEEDS.items() if row[f"{name}_valid"]},
        "placement_allows_sliding": int(row["placement_allows_sliding"]),
    }
    return Query("transition", inputs, {scene.geometry.name: scene.geometry}, f"bench {scene.name}")


_SEEDS: Final = {"contact": "contact_plane", "last_known": "last_known_contact_plane"}
"""Keys of a SEED block, and what a row calls them."""


def _mover(row: Any) -> dict[str, Any]:
    numbers = ("scale", "step_up_height", "step_down_height")
    return {
        "spheres": row["spheres"][: int(row["num_sphere"])].tolist(),
        **{name: float(row[name]) for name in numbers},
        **{name: int(row[name]) for name in ("state", "ethereal", "gravity")},
        "step_down": int(row["may_step_down"]),
    }


def _pose(numbers: Any) -> dict[str, Any]:
    cell, *others = numbers.tolist()
    return {"cell": int(cell), "rotation": others[:4], "origin": others[4:]}


def _contact(row: Any, name: str) -> dict[str, Any]:
    return {
        "plane": row[name].tolist(),
        "cell": int(row[f"{name}_cell_id"]),
        "is_water": int(row[f"{name}_is_water"]),
    }


def write_worst(folder: Path, worst: Worst, seed: int) -> Path:
    """Write the worst query as a case file, and return its path."""
    document = found_document(worst.query, [], candidate="oracle", provenance="conformance bench")
    document |= {
        "title": f"{worst.query.op}: the largest error of retail that a run has seen",
        "why": f"Of the moves of `conformance bench --seed {seed}` in {worst.scene} this one is farthest "
        f"from the exact answer: {worst.measure} {worst.value:.3g}.",
        "tags": ["found", "worst"],
    }
    path = folder / f"{document['id']}.yaml"
    text = yaml.safe_dump(document, sort_keys=False, default_flow_style=None, width=_WIDTH)
    write_text(path, text)
    return path
