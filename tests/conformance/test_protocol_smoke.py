"""What `conformance smoke` tells authors of bridges."""

from __future__ import annotations

import json
import math
import sys
from typing import TYPE_CHECKING

import pytest
from faux import ENGINE, SECONDS, command_of, faux_command, queries, right, serve_command
from shipped_vectors import VECTORS

from conformance.cli import main
from conformance.commands import smoke as command
from conformance.protocol import smoke
from conformance.protocol.process import command_line
from conformance.protocol.smoke import Finding, Mark, examine
from conformance.query import Result

if TYPE_CHECKING:
    from pathlib import Path


@pytest.fixture
def vectors(tmp_path: Path) -> Path:
    """Write the faux engine's queries as a folder of vector files."""
    lines = [
        json.dumps({"id": q.label, "op": q.op, **q.inputs, "expect": right(q).fields}) for q in queries()
    ]
    (tmp_path / "blocks.jsonl").write_text("\n".join(lines) + "\n", encoding="utf-8")
    return tmp_path


@pytest.fixture
def with_scenes(vectors: Path) -> Path:
    """Add records of an operation on geometry, each in a scene of its own."""
    records = (VECTORS / "polygon.jsonl").read_text(encoding="utf-8").splitlines()[:3]
    assert len({json.loads(record)["geometry"] for record in records}) == 3
    (vectors / "scenes.jsonl").write_text("\n".join(records) + "\n", encoding="utf-8")
    geometries = (VECTORS / "geometries.jsonl").read_text(encoding="utf-8")
    (vectors / "geometries.jsonl").write_text(geometries, encoding="utf-8")
    return vectors


def smoked(command_line: str, vectors: Path, seconds: float = SECONDS) -> list[Finding]:
    """Return what an examination finds."""
    return list(examine(command_line, seconds, lambda _said: None, vectors=vectors))


def wrong(findings: list[Finding]) -> list[tuple[str, str]]:
    """Return steps that went wrong and what was said."""
    return [(found.step, found.said) for found in findings if found.mark is Mark.WRONG]


def test_a_good_bridge(vectors: Path) -> None:
    """Every step is told; there is no scene where no operation needs one."""
    findings = smoked(faux_command("good"), vectors)
    assert [(found.mark.value, found.step) for found in findings] == [
        ("ok", "handshake"),
        ("ok", "operations"),
        ("ok", "fresh answers"),
        ("note", "scenes"),
        ("ok", "batch"),
        ("ok", "unknown operation"),
        ("ok", "stop"),
        ("ok", "end of stdin"),
    ]
    assert findings[0].said == "faux 1.0: 1 operations, 0 features, floats decimal"
    assert findings[1].said == "1 of 1 answer as retail does: block_offset"


def test_our_own_bridge_holds_scenes(with_scenes: Path) -> None:
    """A scene replaces another of the same id; what no record asks is a note."""
    findings = smoked(serve_command("--candidate", "oracle", "--floats", "hex"), with_scenes)
    assert wrong(findings) == []
    assert Finding(Mark.OK, "scenes", "a scene replaces the one that had its id") in findings
    assert findings[1].said.startswith(
        "no shipped record asks these within the declared features: frame_cache,"
    )


@pytest.mark.parametrize(
    ("mode", "step", "said"),
    [
        ("banner", "handshake", "bad reply: found 'Loading the world ...', which is not JSON"),
        ("no-ops", "handshake", "no operation is declared"),
        ("unknown-op", "handshake", "bad reply: found unknown operation 'block_ofset'"),
        ("previous", "fresh answers", "block_offset: q2 has the answer of q1, which was asked before"),
        ("trusting", "unknown operation", "the engine ended with exit status 1 before it replied"),
        ("eager", "unknown operation", "it has a result"),
        ("sour", "stop", "the engine ended with exit status 4 when it was stopped, expected 0"),
        ("chatty", "stop", "the engine writes on after its last reply: b'bye"),
    ],
)
def test_what_is_wrong_is_told(mode: str, step: str, said: str, vectors: Path) -> None:
    """One thing, at its step, with what was expected."""
    findings = smoked(faux_command(mode), vectors)
    ((where, what),) = wrong(findings)
    assert (where, what[: len(said)]) == (step, said)
    assert all(found.expected for found in findings if found.mark is Mark.WRONG)


def test_an_answer_with_nan_is_like_itself() -> None:
    """Not equal to itself, but who gives it twice has not lost a scene; signs of zero count."""
    nan, zero = Result({"plane": [math.nan, 1.0]}), Result({"plane": [0.0, 1.0]})
    assert smoke._alike(nan, Result({"plane": [float("nan"), 1.0]}))
    assert not smoke._alike(nan, zero)
    assert not smoke._alike(zero, Result({"plane": [-0.0, 1.0]}))


def test_an_engine_that_outlives_the_suite(vectors: Path) -> None:
    """Who breaks off a run must not leave engines behind."""
    findings = smoked(faux_command("outlives"), vectors, seconds=1.0)
    (found,) = wrong(findings)
    assert found[0] == "end of stdin"


@pytest.mark.parametrize("mode", ["trusting", "eager"])
def test_how_to_refuse_is_shown(mode: str, vectors: Path) -> None:
    """Who takes the operations that are asked for those that were declared is told the reply."""
    findings = smoked(faux_command(mode), vectors)
    (found,) = (found for found in findings if found.mark is Mark.WRONG)
    reason = '{"skipped":{"reason":"no operation no_such_operation"}}'
    assert found.expected == f"to no_such_operation, beside its seq: {reason}"


def test_a_claim_that_does_not_hold(vectors: Path) -> None:
    """It is declared, and skipped; retail's reply is shown."""
    record = json.dumps(
        {
            "id": "cf",
            "op": "calc_friction",
            "body": {},
            "quantum": 0.1,
            "v2": 1,
            "expect": {"velocity": [0, 0, 0]},
        }
    )
    with (vectors / "blocks.jsonl").open("a", encoding="utf-8") as file:
        file.write(record + "\n")
    findings = smoked(faux_command("claims"), vectors)
    assert wrong(findings) == [("calc_friction", "it is declared, but skipped: no calc_friction")]
    (found,) = (found for found in findings if found.mark is Mark.WRONG)
    assert found.expected == 'to cf, beside its seq: {"result":{"velocity":[0.0,0.0,0.0]}}'


@pytest.mark.parametrize(
    ("mode", "said"),
    [
        ("crash", "the engine ended with exit status 3 before it replied\n    stderr: about to fail"),
        ("missing", "bad reply: found nothing at result.v, expected a value"),
        ("errored", "it is declared, but fails: out of cells"),
    ],
)
def test_a_bad_reply_is_told_with_its_operation(mode: str, said: str, vectors: Path) -> None:
    """And with the reply that retail would give."""
    findings = smoked(f"{faux_command(mode)} 3", vectors)
    first = next(found for found in findings if found.mark is Mark.WRONG)
    assert (first.step, first.said[: len(said)]) == ("block_offset", said)
    assert first.expected == 'to q3, beside its seq: {"result":{"v":[576.0,0.0,0.0]}}'


def test_a_fault_is_told_once(vectors: Path) -> None:
    """The steps after it say that they have seen nothing else."""
    findings = smoked(f"{faux_command('crash')} 3", vectors)
    said = [what for _, what in wrong(findings)]
    assert len(said) == len(set(said))
    assert Finding(Mark.NOTE, "batch", "not seen: the engine fails as above") in findings


def test_an_engine_that_starts_only_once(vectors: Path, tmp_path: Path) -> None:
    """As one that leaves a lock behind: why it was started anew is told, and the examination ends."""
    once = "import pathlib, runpy, sys; pathlib.Path(sys.argv.pop(1)).touch(exist_ok=False); "
    once += "runpy.run_path(sys.argv.pop(1))"
    words = (sys.executable, "-I", "-S", "-c", once, tmp_path / "lock", ENGINE, "crash", 1)
    findings = smoked(command_of(*words), vectors)
    assert (findings[-1].mark, findings[-1].step) == (Mark.WRONG, "handshake")
    assert findings[-1].said.startswith(
        "the engine ended with exit status 3 before it replied; "
        "started anew: the engine ended with exit status 1 before it replied"
    )


def test_a_difference_is_a_note(vectors: Path) -> None:
    """The bridge works; the values are the suite's business."""
    findings = smoked(faux_command("ulp"), vectors)
    assert wrong(findings) == []
    assert findings[1].mark is Mark.NOTE
    assert findings[1].said.startswith(
        "q1: v.x: retail 192.0 (0x43400000), engine 192.00002 (0x43400001), 1 ULP"
    )


def test_the_command_prints_and_ends(
    vectors: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    """0 and the next command, or 1 and where the contract is."""
    monkeypatch.setattr("conformance.protocol.smoke.examine.__kwdefaults__", {"vectors": vectors})
    line = faux_command("good")
    assert main(["smoke", f"cmd:{line}"]) == 0
    out = capsys.readouterr().out.splitlines()
    assert out[0] == "ok     handshake: faux 1.0: 1 operations, 0 features, floats decimal"
    candidate = command_line([f"cmd:{line}"])
    assert out[-1] == f"the bridge works: pytest conformance --candidate {candidate}"
    assert main(["smoke", "./no-such-engine"]) == 1
    out = capsys.readouterr().out.splitlines()
    assert out[0].startswith("WRONG  start: cannot run './no-such-engine': ")
    assert out[1].strip() == "expected: a program that can be run from this folder"
    assert out[-1] == "1 wrong; the contract is in docs/plugging-in-an-engine.md"


def test_no_command_is_a_usage_error(capsys: pytest.CaptureFixture[str]) -> None:
    """An example is shown."""
    assert main(["smoke"]) == 2
    assert "as in `conformance smoke ./my-engine`" in capsys.readouterr().err


def test_several_words_are_one_command() -> None:
    """Everything after the options is the engine's, quoted where it must be."""
    assert command._command(["./my engine", "--flag"]) == command_of("./my engine", "--flag")
    assert command._command(["cmd:./my-engine --flag"]) == "./my-engine --flag"
