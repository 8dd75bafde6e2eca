"""What it costs to ask an engine by messages: a run of the suite over the protocol, with the asking clocked.

The engine has its answers ready, in a process of its own, so that what is measured is the suite's own work
for messages: what they add to a run for an engine that takes no time itself. Each case is judged as in a run
of the suite: once, in a scene that nobody has seen before, and retail is computed while the engine is asked.
"""

from __future__ import annotations

import copy
import sys
import tempfile
import time
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
from itertools import chain
from pathlib import Path
from typing import TYPE_CHECKING, Final

from conformance.bench.message_costs import NOTHING, Cost, Seconds, costs_by_operation, message_ratios
from conformance.bench.timing import DisagreementError, no_collection
from conformance.candidates.base import ask_ahead, close
from conformance.candidates.command_candidate import CommandCandidate
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


def measure_messages(rounds: Sequence[Sequence[Case]], report: Report, say: Callable[[str], None]) -> None:
    """Judge cases over the protocol, in both dialects of floats, in turn.

    Parameters
    ----------
    rounds : sequence of sequence of Case
        The cases of each round: parts of the suite (`conformance.bench.parts`).
    report : Report
        Is given a line for each dialect and clock, and one for each dialect and operation.
    say : callable
        Told how far it is.

    Raises
    ------
    DisagreementError
        If a case fails: an answer is another after its way as a message.
    """
    costs: dict[Dialect, list[dict[str, Cost]]] = {dialect: [] for dialect in DIALECTS}
    for number, cases in enumerate(rounds, 1):
        say(f"messages: round {number} of {len(rounds)}, {len(cases)} cases: retail's answers to them")
        outcomes = [[OracleCandidate().answer(query) for query in case.queries] for case in cases]
        say(f"messages: round {number} of {len(rounds)}, {len(cases)} cases: {' and '.join(DIALECTS)}")
        for dialect, of_operations in _judged(cases, outcomes).items():
            costs[dialect].append(of_operations)
    for dialect, of_rounds in costs.items():
        report.ratios += message_ratios(_NAME, dialect, of_rounds)
        report.messages += costs_by_operation(dialect, of_rounds)


def _judged(cases: Sequence[Case], outcomes: Sequence[Sequence[Outcome]]) -> dict[Dialect, dict[str, Cost]]:
    """Judge cases in each dialect; return what it took, by operation."""
    oracle = OracleCandidate()
    costs: dict[Dialect, dict[str, Cost]] = {dialect: {} for dialect in DIALECTS}
    with ExitStack() as stack:
        sides = []
        for dialect in DIALECTS:
            mine, at_hand = _own_cases(cases, outcomes)
            engine = stack.enter_context(_engine(mine, at_hand, dialect))
            ask_ahead(engine, ())  # it is started before the clock is
            sides.append((costs[dialect], mine, engine))
        stack.enter_context(no_collection())
        for turn in range(len(cases)):
            for place in range(len(sides)):
                of_ops, mine, engine = sides[(turn + place) % len(sides)]
                op = mine[turn].op
                of_ops[op] = of_ops.get(op, NOTHING) + _judge(mine[turn], engine, oracle)
    return costs


def _judge(case: Case, engine: Candidate, oracle: Candidate) -> Cost:
    asked = _Clocked(engine)
    wall, processor, thread = time.perf_counter(), time.process_time(), time.thread_time()
    verdict = judge(case, asked, oracle)
    thread, processor = time.thread_time() - thread, time.process_time() - processor
    wall = time.perf_counter() - wall
    for failure in verdict.failures:
        raise DisagreementError(f"{failure.query.label}: {failure.summary}")
    others = processor - thread  # other threads only send and receive
    return Cost(
        len(case.queries),
        Seconds(thread - asked.processor, asked.processor + others),
        Seconds(wall - asked.wall, asked.wall),
    )


@dataclass(slots=True)
class _Clocked:
    """A candidate, and what asking it takes: processor time of the thread that asks, and all its time."""

    candidate: Candidate
    processor: float = 0.0
    wall: float = 0.0

    @property
    def name(self) -> str:
        return self.candidate.name

    def ask_ahead(self, queries: Sequence[Query]) -> None:
        with self._clock():
            ask_ahead(self.candidate, queries)

    def answer(self, query: Query) -> Outcome:
        with self._clock():
            return self.candidate.answer(query)

    def close(self) -> tuple[str, ...]:
        return close(self.candidate)

    @contextmanager
    def _clock(self) -> Iterator[None]:
        processor, wall = time.thread_time(), time.perf_counter()
        yield
        self.processor += time.thread_time() - processor
        self.wall += time.perf_counter() - wall


def _own_cases(
    cases: Sequence[Case], outcomes: Sequence[Sequence[Outcome]]
) -> tuple[Sequence[Case], dict[Query, Outcome]]:
    """Copy cases; what is kept of a scene is kept for its objects, so that a copy's is new to everybody."""
    mine = copy.deepcopy(cases)
    answered = (zip(case.queries, given, strict=True) for case, given in zip(mine, outcomes, strict=True))
    return mine, dict(chain.from_iterable(answered))


@contextmanager
def _engine(cases: Sequence[Case], at_hand: Mapping[Query, Outcome], dialect: Dialect) -> Iterator[Candidate]:
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


def _replies(queries: Sequence[Query], at_hand: Mapping[Query, Outcome], dialect: Dialect) -> Iterator[bytes]:
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
        yield line_of({"seq": seq, **outcome_body(query.op, at_hand[query], dialect)})
    yield line_of({"seq": seq + 1, "result": {}})
