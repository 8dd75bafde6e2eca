"""Help for tests of deviations: files of one entry, and the case that they are about."""

from __future__ import annotations

import json
from pathlib import Path

ORIGIN = Path(__file__).parents[2] / "conformance" / "cases" / "contact-plane" / "origin.yaml"
"""Two cases; `bug:cell-origin` fails one of them, in one field of one query."""
FAILING = "origin-step-down-touching"
RECORDED = {
    "case": FAILING,
    "field": "contact_plane.d",
    "observed": "-0.0 (0x80000000)",
    "reason": "The cell's origin is not passed.",
    "link": "https://example.org/1",
    "until": "2999-12-31",
}
"""How it fails."""


def deviation_file(folder: Path, **changes: object) -> Path:
    """Write the file of the bug's one deviation, with changes; None leaves a key out."""
    entry = {key: value for key, value in {**RECORDED, **changes}.items() if value is not None}
    lines = [f"{key}: {json.dumps(value)}" for key, value in entry.items()]
    path = folder / "bug.yaml"
    path.write_text(
        "engine: bug:cell-origin\ndeviations:\n  - " + "\n    ".join(lines) + "\n", encoding="utf-8"
    )
    return path
