"""What the documents show is what happens."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from conformance.candidates.oracle_candidate import OracleCandidate
from conformance.cli import main
from conformance.loader import load_file
from conformance.own_operations import OWN_OUTPUTS
from conformance.schema.query import MODEL_OF_OP
from conformance.schema.scene import SceneModel
from conformance.verdict import judge

DOCS = Path(__file__).parents[2] / "docs"


def blocks(language: str) -> list[str]:
    """Return the fenced blocks of a language in the page about writing cases."""
    page = (DOCS / "writing-cases.md").read_text(encoding="utf-8")
    return re.findall(rf"^```{language}\n(.*?)^```", page, re.DOTALL | re.MULTILINE)


@pytest.fixture
def tutorial(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Write the tutorial's first case, pins included, where it says."""
    case, pins = blocks("yaml")[:2]
    folder = tmp_path / "my-cases"
    folder.mkdir()
    file = folder / "ramp.yaml"
    file.write_text(case + pins, encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    return file


def test_the_first_case_holds(tutorial: Path) -> None:
    """It is read without a complaint, and retail meets its pins in every pose."""
    loaded = load_file(tutorial)
    assert not loaded.problems
    (case,) = loaded.cases
    assert len(case.expect) == 3
    oracle = OracleCandidate()
    verdict = judge(case, oracle, oracle)
    assert (verdict.compared, verdict.failures) == (9, [])


def test_the_walk_holds(tmp_path: Path) -> None:
    """The walk of the page is read without a complaint, and retail meets its pins."""
    (walk,) = [block for block in blocks("yaml") if "id: my-first-walk" in block]
    file = tmp_path / "walk.yaml"
    file.write_text(walk, encoding="utf-8")
    loaded = load_file(file)
    assert not loaded.problems
    (case,) = loaded.cases
    oracle = OracleCandidate()
    verdict = judge(case, oracle, oracle)
    assert (verdict.compared, verdict.failures) == (5, [])


def test_the_world_holds(tmp_path: Path) -> None:
    """The house of the page is read without a complaint, and retail meets its pins, there and shifted."""
    (world,) = [block for block in blocks("yaml") if "doorways:" in block]
    file = tmp_path / "world.yaml"
    file.write_text(world, encoding="utf-8")
    loaded = load_file(file)
    assert not loaded.problems
    (case,) = loaded.cases
    oracle = OracleCandidate()
    verdict = judge(case, oracle, oracle)
    assert (case.op, verdict.compared, verdict.failures) == ("world_walk", 5, [])


def test_the_page_names_every_key_of_a_world() -> None:
    """Keys of a scene, and the operations that a world can be asked."""
    page = (DOCS / "writing-cases.md").read_text(encoding="utf-8")
    for key in SceneModel.model_fields:
        assert f"`{key}`" in page
    for op in MODEL_OF_OP:
        if MODEL_OF_OP[op].__module__.endswith("world_queries") and not op.startswith("landdefs_"):
            assert f"`{op}`" in page
    for op in OWN_OUTPUTS:
        assert f"`{op}`" in page


def test_the_mistake_is_told_as_shown(tutorial: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """The text of the error, to the letter."""
    (shown,) = [block for block in blocks("text") if "yaww" in block]
    text = tutorial.read_text(encoding="utf-8")
    tutorial.write_text(text.replace("yaw: 30", "yaww: 30"), encoding="utf-8")
    assert main(["lint", "my-cases"]) == 1
    assert capsys.readouterr().out.replace("\\", "/") == shown
