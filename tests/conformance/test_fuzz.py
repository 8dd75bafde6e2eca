"""Fuzz targets: the kept inputs hold, what the targets look for is found, and the fuzzer itself runs."""

from __future__ import annotations

import re
import sys
from importlib import import_module
from typing import TYPE_CHECKING, Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from conformance.cli import main
from conformance.fuzz.byte_source import ByteSource
from conformance.fuzz.finding import FindingError, check_place
from conformance.fuzz.session import FuzzerMissingError, check_fuzzer, fuzz
from conformance.fuzz.targets import TARGETS
from conformance.fuzz.text_mutations import mutate
from conformance.source import Location, Problem
from engine.plan import FULL_PLAN

if TYPE_CHECKING:
    from pathlib import Path

RUNS = {"yaml": 500, "vectors": 2000, "world": 300}
"""Executions of each target: a second or two, enough to see that it runs."""
ACCEPTED_WORLD = "0a9df6dbff7f568b91f84d778176a5e920f447ef"
"""A kept input that is a world through which a move is made."""
KEPT = [(name, file) for name, target in TARGETS.items() for file in sorted(target.corpus.iterdir())]


def test_every_target_keeps_inputs() -> None:
    """There is a folder for each target, and none is empty."""
    assert {name for name, _ in KEPT} == set(TARGETS)


@pytest.mark.filterwarnings("ignore:overflow encountered:RuntimeWarning")
@pytest.mark.parametrize("name", TARGETS)
def test_kept_inputs_hold(name: str) -> None:
    """Each input that fuzzing kept is refused or accepted; some of either."""
    run = TARGETS[name].load()
    outcomes = {run(file.read_bytes()) for target, file in KEPT if target == name}
    assert outcomes == {True, False}


def test_a_silent_acceptance_is_a_finding(monkeypatch: pytest.MonkeyPatch) -> None:
    """A loader that reads other numbers than the file has is caught by the comparison with PyYAML."""
    from conformance import yaml_source
    from conformance.fuzz import yaml_target

    assert yaml_target.run(b"a: 1.5\n") is False
    monkeypatch.setattr(yaml_source._Composer, "_float", lambda *_: 1.25)
    with pytest.raises(FindingError, match=r"'1\.5' read as 1\.25"):
        yaml_target.run(b"a: 1.5\n")


def test_a_number_that_is_lost_is_a_finding(monkeypatch: pytest.MonkeyPatch) -> None:
    """A writer that drops a number is caught when its record is read again."""
    from conformance.fuzz import vector_target

    record = b'{"id": "a", "op": "block_offset", "from_cell": 1, "to_cell": 2, "expect": {"v": [0, 0, 1]}}'
    assert vector_target.run(record) is True
    monkeypatch.setattr(vector_target, "short_fields", lambda *_: {"v": [0.0, 0.0, 0.0]})
    with pytest.raises(FindingError, match="expect read again"):
        vector_target.run(record)


def test_an_error_outside_the_file_is_a_finding() -> None:
    """A mistake has a place in the text, or just behind it."""
    check_place(Problem(Location("f", 2, 1), "", "a", "b"), b"a: 1\n")
    with pytest.raises(FindingError, match="line 4 of 2"):
        check_place(Problem(Location("f", 4, 1), "", "a", "b"), b"a: 1\n")
    with pytest.raises(FindingError, match="column 6 of 4"):
        check_place(Problem(Location("f", 1, 6), "", "a", "b"), b"a: 1\n")
    with pytest.raises(FindingError, match="without words"):
        check_place(Problem(Location("f", 1, 1), "", "", "b"), b"a: 1\n")


@given(text=st.text(min_size=1), seed=st.integers(0, 1 << 32), limit=st.integers(1, 64))
def test_changed_text_is_text_within_its_limit(text: str, seed: int, limit: int) -> None:
    """The same seed makes the same change, and none is longer than allowed."""
    first, again = (mutate(text.encode(), limit, seed, lambda data, most: data[:most]) for _ in range(2))
    assert first == again
    assert len(first) <= limit


def test_numbers_words_and_lines_are_changed() -> None:
    """Every kind of change is met, and what is no text is left to the fuzzer."""
    made = {mutate(b"a: 17\nbc: x", 99, seed, lambda *_: b"bytes") for seed in range(3000)}
    assert b"bytes" in made
    assert {b"a: 1e39\nbc: x", b"a: 17\na: 17\nbc: x", b"bc: x\na: 17", b"a: 17\nbc: bc"} <= made
    assert any(re.fullmatch(rb"a: [2-9]7\nbc: x", text) for text in made)
    assert mutate(b"\xff", 99, 1, lambda *_: b"bytes") == b"bytes"


def test_bytes_end_in_zeros() -> None:
    """Behind the last byte there are as many zeros as are asked for."""
    source = ByteSource(b"\x61")
    assert (source.number(), source.byte(), source.whole(), source.flag()) == (0.25, 0, 0, False)


@pytest.mark.parametrize("name", TARGETS)
def test_the_fuzzer_runs(name: str, tmp_path: Path) -> None:
    """A short run executes as often as it was told, and finds nothing."""
    try:
        check_fuzzer()
    except FuzzerMissingError as error:
        pytest.skip(str(error))
    new = tmp_path / "new"
    said: list[str] = []
    new.mkdir()
    folders = [new, TARGETS[name].corpus]
    report = fuzz(TARGETS[name], folders, runs=RUNS[name], seed=1, findings=tmp_path, say=said.append)
    assert (report.finding, report.ended) == ("", ""), "\n".join(report.output)
    assert report.executed >= RUNS[name]
    assert 0 < report.accepted < report.executed


def test_without_the_fuzzer_the_extra_is_named(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    """The command says what to install."""
    monkeypatch.setattr("conformance.fuzz.session.find_spec", lambda _: None)
    assert main(["fuzz", "yaml", "--findings", str(tmp_path)]) == 2
    assert "retail-conformance[fuzz]" in capsys.readouterr().err


def test_replay(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Inputs are run as they are, and what came of each is said; one that is not there is told."""
    file = tmp_path / "input"
    file.write_bytes(b"a: 1\n")
    assert main(["fuzz", "yaml", "--replay", str(file)]) == 0
    assert f"{file}: refused" in capsys.readouterr().out
    assert main(["fuzz", "yaml", "--replay", str(tmp_path / "none")]) == 2


def test_a_killed_worker_is_told(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    """A worker that ends without a word is no run without findings."""
    monkeypatch.setattr("conformance.fuzz.session.find_spec", lambda _: True)
    monkeypatch.setattr(sys, "executable", _script(tmp_path))
    report = fuzz(TARGETS["yaml"], [tmp_path], runs=1, seed=1, findings=tmp_path, say=lambda _: None)
    assert (report.executed, report.accepted) == (7, 2)
    assert report.ended == "the worker ended with code 3"


def _script(folder: Path) -> str:
    """Write a program that counts seven executions in its tally, and then ends."""
    if sys.platform == "win32":
        pytest.skip("skipped: a script is no program on Windows, and there is no fuzzer")
    script = folder / "worker"
    tally = r"\007\000\000\000\000\000\000\000\002\000\000\000\000\000\000\000"
    script.write_text(
        f"#!/bin/sh\nprintf '{tally}' > \"$4\"\necho '#7 pulse exec/s: 5' >&2\nexit 3\n", encoding="utf-8"
    )
    script.chmod(0o755)
    return str(script)


def test_a_shortcut_that_changes_an_answer_is_a_finding(monkeypatch: pytest.MonkeyPatch) -> None:
    """A move is made with and without shortcuts, which may differ in the work that they take alone."""
    target: Any = import_module(TARGETS["world"].module)
    original = target.resolve
    accepted = TARGETS["world"].corpus.joinpath(ACCEPTED_WORLD).read_bytes()
    assert target.run(accepted) is True

    def shifted(world: Any, move: Any, *, plan: Any) -> Any:
        result = original(world, move, plan=plan)
        result["walk_interp"] += plan is FULL_PLAN
        return result

    monkeypatch.setattr(target, "resolve", shifted)
    with pytest.raises(FindingError, match="with shortcuts"):
        target.run(accepted)
