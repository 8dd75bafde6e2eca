"""Linting case files."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from conformance.lint import lint
from conformance.loader import NoCasesError

if TYPE_CHECKING:
    from pathlib import Path

CASE = """\
id: tidy
title: {title}
why: {why}
retail: [Frame::cache §4.2]
{tags}
query: {{op: frame_cache, rotation: [1, 0, 0, 0]}}
"""
TIDY = {"title": "A title", "why": "A reason.", "tags": "tags: [frame]"}


@pytest.mark.parametrize(
    ("change", "path", "found"),
    [
        ({"title": "x" * 111}, "title", "a title of 111 characters"),
        ({"title": "A sentence."}, "title", "a full stop at the end"),
        ({"tags": ""}, "tags", "no tags"),
        ({"why": "A title"}, "why", "the title again"),
    ],
)
def test_blemishes(change: dict[str, str], path: str, found: str, tmp_path: Path) -> None:
    """What a reader would stumble over is told with the place of the case."""
    (tmp_path / "a.yaml").write_text(CASE.format(**{**TIDY, **change}), encoding="utf-8")
    (problem,) = lint([tmp_path])
    assert (problem.path, problem.found, problem.case_id) == (path, found, "tidy")
    assert (problem.location.line, problem.source_line) == (1, "id: tidy")


def test_mistakes_and_blemishes_together(tmp_path: Path) -> None:
    """All files are looked at, whatever one of them holds."""
    (tmp_path / "a.yaml").write_text("a: [", encoding="utf-8")
    (tmp_path / "b.yaml").write_text(CASE.format(**{**TIDY, "tags": ""}), encoding="utf-8")
    assert ["YAML syntax" in problem.found for problem in lint([tmp_path])] == [True, False]


def test_nothing_to_lint(tmp_path: Path) -> None:
    """An empty folder is not clean, it is a mistake."""
    with pytest.raises(NoCasesError):
        lint([tmp_path])
