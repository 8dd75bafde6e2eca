"""The page about engines shows what happens."""

from __future__ import annotations

import io
import json
import re
from pathlib import Path
from typing import TYPE_CHECKING

from conformance.candidates.module_candidate import ModuleCandidate
from conformance.candidates.oracle_candidate import OracleCandidate
from conformance.protocol.features import FEATURES
from conformance.protocol.scenes import KEPT_SCENES
from conformance.protocol.server import Server
from conformance.protocol.session import read_capabilities
from conformance.query import Query, Result, Skipped

if TYPE_CHECKING:
    import pytest

PAGE = (Path(__file__).parents[2] / "docs" / "plugging-in-an-engine.md").read_text(encoding="utf-8")


def blocks(language: str) -> list[str]:
    """Return the fenced blocks of a language."""
    return re.findall(rf"^```{language}\n(.*?)^```", PAGE, re.DOTALL | re.MULTILINE)


def test_the_session_is_one() -> None:
    """Word for word; only who the engine is, is another's."""
    lines = blocks("")[0].splitlines()
    sent = [line[2:] for line in lines if line.startswith("→")]
    told = [json.loads(line[2:]) for line in lines if line.startswith("←")]
    assert len(sent) == len(told) == 5
    replies = io.BytesIO()
    Server(OracleCandidate()).serve([f"{line}\n".encode() for line in sent], replies)
    answered = [json.loads(line) for line in replies.getvalue().splitlines()]
    assert answered[1:] == told[1:]
    assert read_capabilities(told[0]["result"]).ops == ["polygon_hits_sphere_slow"]


def test_every_feature_is_explained() -> None:
    """In the words of the code."""
    rows = dict(re.findall(r"^\| `([a-z-]+)` \| (.*) \|$", PAGE, re.MULTILINE))
    assert {name: rows.get(name) for name in FEATURES} == FEATURES
    assert f"There are at most {KEPT_SCENES} ids" in PAGE


def test_the_python_engine_answers(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """As the page has it, in a file of the current folder."""
    (engine,) = blocks("python")
    (tmp_path / "my_engine.py").write_text(engine, encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    candidate = ModuleCandidate("my_engine:MyEngine")
    query = Query("block_offset", {"from_cell": 0xA9B40151, "to_cell": 0xAAB20001})
    assert candidate.answer(query) == OracleCandidate().answer(query) == Result({"v": [192.0, -384.0, 0.0]})
    assert candidate.answer(Query("block_offset", {"from_cell": 0, "to_cell": 1})) == Skipped("no cell")


def test_the_c_sharp_skeleton_speaks_the_protocol() -> None:
    """It knows every message and every key of the handshake."""
    (skeleton,) = blocks("csharp")
    for word in ("start", "scene", "run", "stop", "seq", "cmd", "op", "inputs"):
        assert f'"{word}"' in skeleton
    for word in (
        "version",
        "name",
        "floats",
        "ops",
        "features",
        "result",
        "skipped",
        "errored",
        "reason",
        "context",
    ):
        assert f'["{word}"]' in skeleton
