"""Help for tests of the gate: the command on two cases, and what it writes."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

from deviation_files import ORIGIN

from conformance.cli import main

if TYPE_CHECKING:
    from pathlib import Path

TWO_CASES = "cases: [{}]\nposes: {{count: 0}}\nwalks: {{count: 0}}\n"
"""A configuration that asks the cases of a file, and nothing at random."""


class Gate:
    """The command with a configuration of two cases, and the evidence that it writes."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.config = folder / "gate.yaml"
        self.config.write_text(TWO_CASES.format(json.dumps(str(ORIGIN))), encoding="utf-8")

    def __call__(self, *words: object, candidate: str = "oracle", stage: str = "cases") -> int:
        """Run it."""
        options = ("--config", self.config, "-o", self.evidence, "--candidate", candidate, "--stage", stage)
        return main(["gate", *map(str, options), *map(str, words)])

    @property
    def evidence(self) -> Path:
        """Where it writes."""
        return self.folder / "evidence"

    def summary(self) -> dict[str, Any]:
        """Return what it has written."""
        found: dict[str, Any] = json.loads((self.evidence / "summary.json").read_text(encoding="utf-8"))
        return found
