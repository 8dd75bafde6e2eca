"""What it costs to ask an engine by messages: cases judged over the protocol, and with the answers at hand.

The engine has its answers ready, so that all that differs is the suite's own work for messages: what they add
to a run for an engine that takes no time itself. Clocked is the suite's processor time, its threads included.
"""

from __future__ import annotations

import sys
import tempfile
import time
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Final

from conformance.bench.report import Ratio
from conformance.bench.timing import DisagreementError, comparison, no_collection
from conformance.candidates.base import close
from conformance.candidates.command_candidate import WINDOW, CommandCandidate
from conformance.candidates.oracle_candidate import OracleCandidate
from conformance.outputs import OUTPUTS
from conformance.protocol.dialects import DIALECTS
from conformance.protocol.features import FEATURES
from conformance.protocol.messages import VERSION, line_of
from conformance.protocol.process import command_line
from conformance.protocol.scenes import SceneSlots
from conformance.protocol.server import outcome_body
from conformance.verdict import judge

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Mapping, Sequence

    from conformance.bench.report import Report
    from conformance.candidates.base import Candidate
    from conformance.case import Case
    from conformance.protocol.dialects import Dialect
    from conformance.query import Outcome, Query

_REPLAYING: Final = Path(__file__).with_name("replaying.py")
_NAME: Final = "answers at hand"


@dataclass(frozen=True, slots=True, eq=False)
class _AtHand:
    """Answers that were given before."""

    outcomes: Mapping[Query, Outcome]
    name: str = _NAME

    def answer(self, query: Query) -> Outcome:
        return self.outcomes[query]


def measure_messages(cases: Sequence[Case], rounds: int, report: Report, say: Callable[[str], None]) -> None:
    """Judge cases over the protocol and in process in turn, in both dialects of floats.

    Parameters
    ----------
    cases : sequence of Case
    rounds : int
        How often; a new engine is started for each, as it is sent every scene once.
    report : Report
        Is given a line for each dialect.
    say : callable
        Told how far it is.

    Raises
    ------
    DisagreementError
        If a case fails: an answer is another after its way as a message.
    """
    oracle = OracleCandidate()
    at_hand = _AtHand({query: oracle.answer(query) for case in cases for query in case.queries})
    for dialect in DIALECTS:
        ours, theirs = [], []
        for number in range(1, rounds + 1):
            say(f"messages, floats {dialect}: round {number} of {rounds}")
            with _engine(cases, at_hand, dialect) as engine, no_collection():
                times = _in_turn(cases, engine, at_hand, oracle)
            ours.append(times[engine])
            theirs.append(times[at_hand])
        note = f"messages, floats {dialect}; processor time"
        report.ratios.append(Ratio("cases", "judge", _NAME, WINDOW, 1, comparison(ours, theirs), note))


def _in_turn(
    cases: Sequence[Case], engine: Candidate, at_hand: Candidate, oracle: Candidate
) -> dict[Candidate, float]:
    """Return the nanoseconds of processor time that judging takes for each query, with either."""
    spent = {engine: 0.0, at_hand: 0.0}
    for number, case in enumerate(cases):
        judge(case, at_hand, oracle)  # what the oracle keeps of a scene, it has then
        for who in (engine, at_hand) if number % 2 else (at_hand, engine):
            begin = time.process_time()
            verdict = judge(case, who, oracle)
            spent[who] += time.process_time() - begin
            for failure in verdict.failures:
                raise DisagreementError(f"{failure.query.label}: {failure.summary}")
    queries = sum(len(case.queries) for case in cases)
    return {who: seconds * 1e9 / queries for who, seconds in spent.items()}


@contextmanager
def _engine(cases: Sequence[Case], at_hand: _AtHand, dialect: Dialect) -> Iterator[Candidate]:
    """Start the engine that has the answers ready, in the order in which it will be asked."""
    queries = [query for case in cases for query in case.queries]
    with tempfile.TemporaryDirectory(prefix="replies-") as folder:
        path = Path(folder) / "replies.jsonl"
        path.write_bytes(b"".join(_replies(queries, at_hand, dialect)))
        engine = CommandCandidate(command_line([sys.executable, "-I", "-S", str(_REPLAYING), str(path)]))
        try:
            yield engine
        finally:
            close(engine)


def _replies(queries: Sequence[Query], at_hand: _AtHand, dialect: Dialect) -> Iterator[bytes]:
    """Yield the replies to everything that will be sent, from the handshake to the stop."""
    introduction = {"version": VERSION, "name": _NAME, "floats": dialect}
    yield line_of({"seq": 0, "result": {**introduction, "ops": list(OUTPUTS), "features": list(FEATURES)}})
    slots, seq = SceneSlots(), 0
    for query in queries:
        _, is_new = slots.find(query)
        if is_new:
            seq += 1
            yield line_of({"seq": seq, "result": {}})
        seq += 1
        yield line_of({"seq": seq, **outcome_body(query.op, at_hand.answer(query), dialect)})
    yield line_of({"seq": seq + 1, "result": {}})
