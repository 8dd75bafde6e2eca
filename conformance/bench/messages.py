"""What it costs to ask an engine by messages: cases judged over the protocol, and with the answers at hand.

The engine has its answers ready, so that all that differs is the suite's own work for messages: what they add
to a run for an engine that takes no time itself. Each case is judged as in a run of the suite: once, in a
scene that nobody has seen before.
"""

from __future__ import annotations

import copy
import sys
import tempfile
import time
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Final

from conformance.bench.report import Ratio
from conformance.bench.timing import DisagreementError, comparison, no_collection
from conformance.candidates.base import ask_ahead, close
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


def measure_messages(rounds: Sequence[Sequence[Case]], report: Report, say: Callable[[str], None]) -> None:
    """Judge cases in process, and over the protocol in both dialects of floats, in turn.

    Parameters
    ----------
    rounds : sequence of sequence of Case
        The cases of each round.
    report : Report
        Is given a line for each dialect and clock.
    say : callable
        Told how far it is.

    Raises
    ------
    DisagreementError
        If a case fails: an answer is another after its way as a message.
    """
    times = []
    for number, cases in enumerate(rounds, 1):
        say(f"messages: round {number} of {len(rounds)}, {len(cases)} cases")
        times.append(_judged(cases))
    for dialect in DIALECTS:
        for clock in _Times.__slots__:
            ours, theirs = ([getattr(one[who], clock) for one in times] for who in (dialect, _NAME))
            note = f"messages, floats {dialect}; {clock} time"
            report.ratios.append(Ratio("cases", "judge", _NAME, WINDOW, 1, comparison(ours, theirs), note))


@dataclass(frozen=True, slots=True)
class _Times:
    """What a query takes with one who is asked, in nanoseconds.

    Attributes
    ----------
    processor : float
        The suite's work, its threads included: all that a run takes in process but the asking, and the asking
        of this one. Retail is most of a run, and from time to time it differs by more than all messages.
    wall : float
        The whole, as somebody waits for it.
    """

    processor: float
    wall: float


def _judged(cases: Sequence[Case]) -> dict[str, _Times]:
    """Return what a query takes, by who was asked."""
    oracle = OracleCandidate()
    outcomes = [[oracle.answer(query) for query in case.queries] for case in cases]
    with ExitStack() as stack:
        mine, at_hand = _own_cases(cases, outcomes)
        sides = [_Side(_NAME, at_hand, mine)]
        for dialect in DIALECTS:
            mine, at_hand = _own_cases(cases, outcomes)
            engine = stack.enter_context(_engine(mine, at_hand, dialect))
            ask_ahead(engine, ())  # it is started before the clock is
            sides.append(_Side(dialect, engine, mine))
        with no_collection():
            for turn in range(len(cases)):
                for place in range(len(sides)):
                    sides[(turn + place) % len(sides)].judge(turn, oracle)
    nanoseconds = 1e9 / sum(len(case.queries) for case in cases)
    others = sides[0].processor - sides[0].asking
    return {
        side.name: _Times(nanoseconds * (others + side.asking), nanoseconds * side.wall) for side in sides
    }


@dataclass(slots=True)
class _Side:
    """Who answers, the cases that are asked, and the seconds that it took: all of it, and the asking."""

    name: str
    candidate: Candidate
    cases: Sequence[Case]
    processor: float = 0.0
    asking: float = 0.0
    wall: float = 0.0

    def judge(self, number: int, oracle: Candidate) -> None:
        asked = _Clocked(self.candidate)
        wall, processor, thread = time.perf_counter(), time.process_time(), time.thread_time()
        verdict = judge(self.cases[number], asked, oracle)
        thread, processor = time.thread_time() - thread, time.process_time() - processor
        self.wall += time.perf_counter() - wall
        self.processor += processor
        self.asking += asked.seconds + (processor - thread)  # other threads only send and receive
        for failure in verdict.failures:
            raise DisagreementError(f"{failure.query.label}: {failure.summary}")


@dataclass(slots=True)
class _Clocked:
    """A candidate, and the processor time of the thread that asks it."""

    candidate: Candidate
    seconds: float = 0.0

    @property
    def name(self) -> str:
        return self.candidate.name

    def ask_ahead(self, queries: Sequence[Query]) -> None:
        begin = time.thread_time()
        ask_ahead(self.candidate, queries)
        self.seconds += time.thread_time() - begin

    def answer(self, query: Query) -> Outcome:
        begin = time.thread_time()
        outcome = self.candidate.answer(query)
        self.seconds += time.thread_time() - begin
        return outcome

    def close(self) -> tuple[str, ...]:
        return close(self.candidate)


def _own_cases(
    cases: Sequence[Case], outcomes: Sequence[Sequence[Outcome]]
) -> tuple[Sequence[Case], _AtHand]:
    """Copy cases; what is kept of a scene is kept for its objects, so that a copy's is new to everybody."""
    mine = copy.deepcopy(cases)
    answered = (zip(case.queries, given, strict=True) for case, given in zip(mine, outcomes, strict=True))
    return mine, _AtHand(dict(pair for pairs in answered for pair in pairs))


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
