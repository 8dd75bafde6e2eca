"""The pages about the gate and deviations: what they show is what is read, and what there is."""

from __future__ import annotations

import re
import shlex
from pathlib import Path

import yaml
from deviation_files import FAILING

from conformance.cli import _make_parser
from conformance.deviations.files import read_deviations
from conformance.gate import config
from conformance.gate.outcome import VERDICTS

DOCS = Path(__file__).parents[2] / "docs"


def test_the_page_shows_a_configuration_that_is_read(tmp_path: Path) -> None:
    """Every key of it, and every key there is."""
    page = (DOCS / "gate.md").read_text(encoding="utf-8")
    (text,) = re.findall(r"^```yaml\n(.*?)^```", page, re.DOTALL | re.MULTILINE)
    path = tmp_path / "gate.yaml"
    path.write_text(text, encoding="utf-8")
    changed = config.read_config(path, config.QUICK)
    assert (changed.walks, changed.least_ratio) == (config.Draws(count=4, seed=7), 0.8)
    assert set(re.findall(r"^(\w+):", text, re.MULTILINE)) == set(config.GateFile.model_fields)


def test_the_page_tells_the_presets() -> None:
    """Their numbers, as they are."""
    page = (DOCS / "gate.md").read_text(encoding="utf-8")
    for stage, presets in (("poses", "poses"), ("walks", "walks")):
        counts = [getattr(one, presets).count for one in (config.QUICK, config.STANDARD, config.FULL)]
        (row,) = re.findall(rf"^\| `{stage}` \|.*$", page, re.MULTILINE)
        assert row.endswith(f"| {counts[0]} | {counts[1]} | {counts[2]} |")
    for code in VERDICTS:
        assert f"\n| {code} | " in page


def test_the_workflow_runs_commands_that_there_are() -> None:
    """It is YAML, and each of its gates is one that the command line understands."""
    text = (DOCS / "examples" / "gate.yml").read_text(encoding="utf-8")
    steps = yaml.safe_load(text)["jobs"]["gate"]["steps"]
    lines = "\n".join(step["run"] for step in steps if "run" in step).replace("\\\n", " ").splitlines()
    asked = [shlex.split(line.replace("${skip:-}", "")) for line in lines if "conformance gate" in line]
    assert len(asked) == 2
    for words in asked:
        assert words[0] == "conformance"
        assert _make_parser().parse_args(words[1:]).command == "gate"


def test_the_page_of_deviations_shows_a_file_that_is_read(tmp_path: Path) -> None:
    """It is the deviation of the bug that the tests use."""
    page = (DOCS / "deviations.md").read_text(encoding="utf-8")
    (text,) = re.findall(r"^```yaml\n(.*?)^```", page, re.DOTALL | re.MULTILINE)
    path = tmp_path / "mine.yaml"
    path.write_text(text, encoding="utf-8")
    (entry,) = read_deviations(path).entries
    assert entry.deviation.case == FAILING
    for key in type(entry.deviation).model_fields:
        assert f"| `{key}` |" in page
