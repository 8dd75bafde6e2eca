"""Python objects as candidates: held to the same contract."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from conformance.candidates.module_candidate import ModuleCandidate
from conformance.candidates.registry import BadCandidateError, check_spec, make_candidate
from conformance.query import Errored, Query, Result, Skipped

if TYPE_CHECKING:
    from pathlib import Path

MODULE = "modules_under_test"


def ask(label: str, op: str = "block_offset", **inputs: object) -> object:
    """Return what the engine of this test's helper answers."""
    query = Query(op, {"from_cell": 1, "to_cell": 1, **inputs}, label=label)
    return make_candidate(f"mod:{MODULE}:Blocks").answer(query)


def test_a_result_is_read_as_one_from_a_process() -> None:
    """Tuples are lists, whole numbers floats, and floats are float32."""
    assert repr(ask("")) == repr(Result({"v": [0.10000000149011612, 0.0, -0.0]}))


def test_what_is_not_declared_is_not_asked() -> None:
    """Operations and features."""
    assert ask("", op="calc_acceleration") == Skipped("operation calc_acceleration is not declared")
    outcome = ask("", scale=2.0)
    assert isinstance(outcome, Skipped)
    assert outcome.reason.startswith("feature scale is not declared")


@pytest.mark.parametrize(
    ("label", "context"),
    [
        ("raise", "LookupError: no cell 7 ("),
        ("none", "found None as an answer, expected a Result, Skipped or Errored"),
        ("field", "bad reply: found an unknown field at result.speed, expected one of v"),
        ("short", "bad reply: found [0.0] (list) at result.v, expected 3 numbers"),
    ],
)
def test_what_goes_wrong_is_recorded(label: str, context: str) -> None:
    """The run goes on."""
    outcome = ask(label)
    assert isinstance(outcome, Errored)
    assert outcome.context.startswith(context)


def test_a_skip_is_passed_on() -> None:
    """With its reason."""
    assert ask("skip") == Skipped("not today")


def test_our_own_engines_can_be_named_so() -> None:
    """The oracle through this door answers as it does."""
    candidate = make_candidate("mod:conformance.candidates.oracle_candidate:OracleCandidate")
    query = Query("block_offset", {"from_cell": 0x01010001, "to_cell": 0x02010001})
    assert candidate.name == "mod:conformance.candidates.oracle_candidate:OracleCandidate"
    assert candidate.answer(query) == Result({"v": [192.0, 0.0, 0.0]})


@pytest.mark.parametrize(
    ("target", "message"),
    [
        ("", "found mod:, expected mod:package.module:factory"),
        (MODULE, f"found mod:{MODULE}, expected mod:package.module:factory"),
        ("no_such_module:Engine", "ModuleNotFoundError: No module named 'no_such_module'"),
        (f"{MODULE}:Engine", "AttributeError: module 'modules_under_test' has no attribute 'Engine'"),
        (f"{MODULE}:NOT_CALLABLE", "found 3, expected something to call"),
    ],
)
def test_a_bad_factory_is_told_at_once(target: str, message: str) -> None:
    """Before anything is asked."""
    with pytest.raises(BadCandidateError) as caught:
        check_spec(f"mod:{target}")
    assert message in str(caught.value)


@pytest.mark.parametrize(
    ("target", "message"),
    [("failing", "OSError: no licence"), ("Mute", "expected an object with answer(query)")],
)
def test_a_factory_that_makes_no_engine(target: str, message: str) -> None:
    """What it raises, or what it made."""
    with pytest.raises(BadCandidateError) as caught:
        make_candidate(f"mod:{MODULE}:{target}")
    assert message in str(caught.value)


def test_a_module_of_the_current_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """As if Python had been started there."""
    text = "class Own:\n    def answer(self, query):\n        return None\n"
    (tmp_path / "own_engine.py").write_text(text, encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr("sys.path", ["elsewhere"])
    assert repr(ModuleCandidate("own_engine:Own")) == "ModuleCandidate('own_engine:Own')"
