"""Asking one shard."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest
from soak_engines import FAILING, MISSING, WRONG, Faulty, Right, Silent

from conformance.candidates.oracle_candidate import OracleCandidate
from conformance.query import Errored, Outcome, Query, Result, Skipped
from conformance.soak import shard as shard_module
from conformance.soak.asking import Ending, judge
from conformance.soak.drawing import Drawer
from conformance.soak.families import mix_of
from conformance.soak.shard import SilentCandidateError, StoppedError, ask_shard

if TYPE_CHECKING:
    from conformance.soak.records import ShardResult

DRAWER = Drawer(7, mix_of(["single calls"]))
QUERY = Query("block_offset", {"from_cell": 0x01010001, "to_cell": 0x02010001})
RIGHT = Result({"v": [192.0, 0.0, 0.0]})


class Engine:
    """A candidate in this process, which complains when it is stopped."""

    name = "mine"

    def __init__(self, engine: Right, complaints: tuple[str, ...] = ()) -> None:
        self._engine = engine
        self._complaints = complaints
        self.ahead: list[int] = []

    def answer(self, query: Query) -> Outcome:
        """Answer a query."""
        outcome = self._engine.answer(query)
        assert isinstance(outcome, Result | Skipped | Errored)
        return outcome

    def ask_ahead(self, queries: list[Query]) -> None:
        """Note how many come next."""
        self.ahead.append(len(queries))

    def close(self) -> tuple[str, ...]:
        """Complain."""
        return self._complaints


class Says:
    """A candidate that answers everything alike."""

    def __init__(self, name: str, outcome: Outcome) -> None:
        self.name = name
        self._outcome = outcome

    def answer(self, _query: Query) -> Outcome:
        """Answer a query."""
        return self._outcome


def ask(engine: Engine, shard: int = 0, size: int = 20) -> ShardResult:
    """Ask a shard to its end."""
    return ask_shard(shard, size, DRAWER, OracleCandidate(), engine, lambda: False)


@pytest.mark.parametrize(
    ("truth", "given", "ending", "said"),
    [
        (RIGHT, RIGHT, Ending.AGREED, ""),
        (
            RIGHT,
            Result({"v": [192.0, 0.0, -0.0]}),
            Ending.DIFFERED,
            "v.z: retail 0.0 (0x00000000), mine -0.0 (0x80000000), 0 ULPs, the sign of zero",
        ),
        (RIGHT, Errored("stuck\nlog"), Ending.ERRORED, "mine failed: stuck"),
        (RIGHT, Skipped("no"), Ending.SKIPPED, "mine: no"),
        (Skipped("unknown"), Errored("stuck"), Ending.SKIPPED, "oracle: unknown"),
        (Errored("bug"), RIGHT, Ending.ERRORED, "oracle failed: bug"),
    ],
)
def test_how_a_query_ends(truth: Outcome, given: Outcome, ending: Ending, said: str) -> None:
    """Both answers count, and what is not answered is nobody's mistake in silence."""
    verdict = judge(QUERY, Says("oracle", truth), Says("mine", given))
    assert (verdict.ending, verdict.said, verdict.truth) == (ending, said, truth)
    assert (verdict.kind is not None) == (ending in {Ending.DIFFERED, Ending.ERRORED})


def test_a_right_engine_agrees() -> None:
    """On every query, each of which is counted once."""
    result = ask(Engine(Right()))
    assert (result.agreed, result.queries, result.asked) == (20, 20, {"single calls": 20})
    assert (result.failures, result.complaints) == ([], [])


def test_what_fails_is_counted_by_kind() -> None:
    """With the first query of each kind; reasons for skipping are counted as well."""
    engine = Engine(Faulty(), ("did not stop",))
    result = ask(engine, size=100)
    assert result.queries == 100
    assert result.complaints == ["did not stop"]
    ops = [DRAWER.draw(0, number).query.op for number in range(100)]
    missing, wrong, failing = (sum(op.startswith(kind) for op in ops) for kind in (MISSING, WRONG, FAILING))
    assert missing * wrong * failing > 0
    assert (result.differed, result.errored, result.skipped) == (wrong, failing, {"mine: no trees": missing})
    found = {failures.op: (failures.count, failures.query) for failures in result.failures}
    assert found == {op: (ops.count(op), ops.index(op)) for op in ops if op.startswith((WRONG, FAILING))}
    assert engine.ahead == [64, 36]


def test_a_shard_asked_again_comes_out_the_same() -> None:
    """Another one does not."""
    again = [ask(Engine(Faulty())).model_dump(exclude={"seconds"}) for _ in range(2)]
    assert again[0] == again[1]
    assert again[0]["answers"] != ask(Engine(Faulty()), shard=1).answers


def test_a_shard_that_nobody_waits_for_is_left() -> None:
    """And the candidate is closed."""
    with pytest.raises(StoppedError, match="shard 3"):
        ask_shard(3, 20, DRAWER, OracleCandidate(), Engine(Right()), lambda: True)


def test_a_silent_engine_is_not_waited_for_all_day(monkeypatch: pytest.MonkeyPatch) -> None:
    """After so much time in a row without an answer the shard is given up."""
    monkeypatch.setattr(shard_module, "PATIENCE", 0.0)
    with pytest.raises(SilentCandidateError, match=r"^shard 0: no answer for 0 s; mine failed: out of order"):
        ask(Engine(Silent()))
