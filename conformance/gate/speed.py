"""The stage of speed: candidate and oracle take turns at walks, and the ratio is held against a stored one.

A machine changes its speed; how much faster a candidate is than the oracle, measured side by side, changes
with the candidate, and with the Python that runs the oracle: a baseline is of one version of it.
"""

from __future__ import annotations

import json
import platform
from dataclasses import asdict, dataclass
from time import perf_counter
from typing import TYPE_CHECKING, Any, Final

from conformance.bench.figures import Summary, summarise
from conformance.bench.timing import no_collection
from conformance.candidates.base import ask_ahead
from conformance.gate.digests import digest_of
from conformance.gate.outcome import Check, Stage, Status
from conformance.json_reading import read_json
from conformance.query import Result

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence
    from pathlib import Path

    from conformance.candidates.base import Candidate
    from conformance.case import Case
    from conformance.gate.parties import Parties
    from conformance.query import Query

WALK_OPS: Final = ("walk", "world_walk", "body_walk")
"""Of many ticks each, so that handing a query over weighs little."""
MOST_QUERIES: Final = 24
"""Walks that are timed; `timed_queries` spreads them over all there are."""
ROUNDS: Final = 5
PYTHON: Final = ".".join(platform.python_version_tuple()[:2])
"""The version of Python that runs the oracle, without the last number: that one changes no speed."""


class BaselineError(Exception):
    """A baseline that cannot be used; says which file and why."""


@dataclass(frozen=True, slots=True)
class Baseline:
    """A stored measurement.

    Attributes
    ----------
    candidate : str
        Whose it is.
    ratio, low, high : float
        The oracle's time over the candidate's: above 1, the candidate is faster. The median of the rounds,
        and the quartiles about it: how far a measurement may be from the next.
    queries : str
        Digest of what was asked.
    python : str
        What the oracle was run by.
    """

    candidate: str
    ratio: float
    low: float
    high: float
    queries: str
    python: str

    def to_json(self) -> str:
        """Write it as it is stored."""
        return json.dumps(asdict(self), indent=1) + "\n"


def read_baseline(path: Path, asked: str) -> Baseline:
    """Read a stored baseline.

    Parameters
    ----------
    path : Path
    asked : str
        Digest of the queries that will be asked.

    Raises
    ------
    BaselineError
        It cannot be read, other queries were asked for it, or another Python has run the oracle.
    """
    try:
        baseline = _baseline_of(read_json(path.read_text(encoding="utf-8")))
    except OSError as error:
        raise BaselineError(f"cannot read {path}: {error.strerror}; --write-baseline makes one") from error
    except (ValueError, KeyError, TypeError) as error:
        raise BaselineError(
            f"{path}: found no baseline ({error}), expected what --write-baseline makes"
        ) from error
    if not 0.0 < baseline.ratio < float("inf"):
        raise BaselineError(f"{path}: found the ratio {baseline.ratio}, expected a number above 0")
    if baseline.queries != asked:
        raise BaselineError(f"{path}: measured with other cases than these: --write-baseline measures anew")
    if baseline.python != PYTHON:
        raise BaselineError(
            f"{path}: found Python {baseline.python}, expected {PYTHON}, which runs the oracle here, with a "
            "speed of its own: --write-baseline measures anew"
        )
    return baseline


def _baseline_of(data: dict[str, Any]) -> Baseline:
    numbers = {name: float(data[name]) for name in ("ratio", "low", "high")}
    return Baseline(
        str(data["candidate"]), queries=str(data["queries"]), python=str(data["python"]), **numbers
    )


def timed_queries(cases: Sequence[Case]) -> list[Query]:
    """Return the queries that are timed: walks as they are written, spread evenly over all of them."""
    walks = [case.queries[0] for case in cases if case.op in WALK_OPS]
    step = max(1, -(-len(walks) // MOST_QUERIES))
    return walks[::step]


def queries_digest(cases: Sequence[Case]) -> str:
    """Return the digest of what is timed: the sources of the cases."""
    timed = {query.label for query in timed_queries(cases)}
    return digest_of(*(case.source for case in cases if case.queries[0].label in timed))


def measure_ratio(
    queries: Sequence[Query], candidate: Candidate, oracle: Candidate, say: Callable[[str], None]
) -> tuple[Summary | None, int]:
    """Let both take turns; return the rounds' ratios, None without any, and how many queries both answer.

    A first round, which is not timed, finds out which those are, and lets caches fill.
    """
    both = [
        query
        for query in queries
        if all(isinstance(who.answer(query), Result) for who in (oracle, candidate))
    ]
    ratios = []
    with no_collection():
        for number in range(ROUNDS if both else 0):
            say(f"performance: round {number + 1} of {ROUNDS}")
            order = (oracle, candidate) if number % 2 else (candidate, oracle)
            seconds = {id(who): _seconds(who, both) for who in order}
            ratios.append(seconds[id(oracle)] / seconds[id(candidate)])
    return (summarise(ratios) if ratios else None), len(both)


def check_speed(
    parties: Parties,
    cases: Sequence[Case],
    baseline: Baseline | None,
    record: Callable[[Check], None],
    say: Callable[[str], None],
) -> Baseline | None:
    """Measure, and hold the ratio against the baseline; without one, return what can be stored as one."""
    begin = perf_counter()
    ratio, count = measure_ratio(timed_queries(cases), parties.candidate, parties.oracle, say)
    least = 0.0 if baseline is None else parties.gate.least_ratio * baseline.ratio
    status, message = Status.SKIPPED, "no walk that both answer"
    if ratio is not None:
        status = Status.PASSED if ratio.middle >= least else Status.FAILED
        message = _said(ratio, baseline, least)
    record(Check(Stage.PERFORMANCE, "walks", status, count, perf_counter() - begin, message))
    if ratio is None or baseline is not None:
        return None
    return Baseline(parties.spec, ratio.middle, ratio.low, ratio.high, queries_digest(cases), PYTHON)


def _said(ratio: Summary, baseline: Baseline | None, least: float) -> str:
    measured = f"the oracle takes {_spread(ratio.middle, ratio.low, ratio.high)} times as long"
    if baseline is None:
        return f"{measured}; stored"
    stored = _spread(baseline.ratio, baseline.low, baseline.high)
    return f"{measured}; stored {stored} of {baseline.candidate}, at least {least:.3g} demanded"


def _spread(middle: float, low: float, high: float) -> str:
    return f"{middle:.3g} ({low:.3g} - {high:.3g})"


def _seconds(who: Candidate, queries: Sequence[Query]) -> float:
    """Ask all, as in a run: an engine in a process of its own may work on one while it is sent the next."""
    begin = perf_counter()
    ask_ahead(who, queries)
    for query in queries:
        who.answer(query)
    return perf_counter() - begin
