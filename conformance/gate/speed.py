"""The stage of speed: candidate and oracle take turns at walks, and the ratio is held against a stored one.

A machine changes its speed; how much faster a candidate is than the oracle, measured side by side, changes
with the candidate.
"""

from __future__ import annotations

import json
import statistics
import time
from dataclasses import asdict, dataclass
from typing import TYPE_CHECKING, Final

from conformance.gate.digests import digest_of
from conformance.gate.outcome import Check, Stage, Status
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
ROUNDS: Final = 5


class BaselineError(Exception):
    """A baseline that cannot be used; says which file and why."""


@dataclass(frozen=True, slots=True)
class Baseline:
    """A stored measurement.

    Attributes
    ----------
    candidate : str
        Whose it is.
    ratio : float
        The oracle's time over the candidate's: above 1, the candidate is faster.
    queries : str
        Digest of what was asked.
    """

    candidate: str
    ratio: float
    queries: str

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
        It cannot be read, or other queries were asked for it.
    """
    try:
        data = json.loads(path.read_text(encoding="utf-8"))
        baseline = Baseline(str(data["candidate"]), float(data["ratio"]), str(data["queries"]))
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
    return baseline


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
) -> tuple[float, int]:
    """Let both take turns; return the median of the rounds' ratios, and how many queries both have answered.

    A first round, which is not timed, finds out which those are, and lets caches fill.
    """
    both = [
        query
        for query in queries
        if all(isinstance(who.answer(query), Result) for who in (oracle, candidate))
    ]
    ratios = []
    for number in range(ROUNDS if both else 0):
        say(f"performance: round {number + 1} of {ROUNDS}")
        order = (oracle, candidate) if number % 2 else (candidate, oracle)
        seconds = {id(who): _seconds(who, both) for who in order}
        ratios.append(seconds[id(oracle)] / seconds[id(candidate)])
    return (statistics.median(ratios) if ratios else 0.0), len(both)


def check_speed(
    parties: Parties,
    cases: Sequence[Case],
    baseline: Baseline | None,
    record: Callable[[Check], None],
    say: Callable[[str], None],
) -> Baseline | None:
    """Measure, and hold the ratio against the baseline; without one, return what can be stored as one."""
    begin = time.perf_counter()
    ratio, count = measure_ratio(timed_queries(cases), parties.candidate, parties.oracle, say)
    least = 0.0 if baseline is None else parties.gate.least_ratio * baseline.ratio
    status = Status.SKIPPED if not count else Status.PASSED if ratio >= least else Status.FAILED
    message = _said(ratio, baseline, least) if count else "no walk that both answer"
    record(Check(Stage.PERFORMANCE, "walks", status, count, time.perf_counter() - begin, message))
    return Baseline(parties.spec, ratio, queries_digest(cases)) if count and baseline is None else None


def _said(ratio: float, baseline: Baseline | None, least: float) -> str:
    measured = f"the oracle takes {ratio:.3g} times as long"
    if baseline is None:
        return f"{measured}; stored"
    return f"{measured}; stored {baseline.ratio:.3g}, at least {least:.3g} demanded"


def _seconds(who: Candidate, queries: Sequence[Query]) -> float:
    begin = time.perf_counter()
    for query in queries:
        who.answer(query)
    return time.perf_counter() - begin
