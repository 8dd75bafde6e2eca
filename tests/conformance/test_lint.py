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
    ("change", "path", "found", "line"),
    [
        ({"title": "x" * 111}, "title", "a title of 111 characters", 2),
        ({"title": "A sentence."}, "title", "a full stop at the end", 2),
        ({"tags": ""}, "tags", "no tags", 1),
        ({"why": "A title"}, "why", "the title again", 3),
    ],
)
def test_blemishes(change: dict[str, str], path: str, found: str, line: int, tmp_path: Path) -> None:
    """What a reader would stumble over is told with its place, or that of the case."""
    (tmp_path / "a.yaml").write_text(CASE.format(**{**TIDY, **change}), encoding="utf-8")
    (problem,) = lint([tmp_path])
    assert (problem.path, problem.found, problem.case_id) == (path, found, "tidy")
    text = CASE.format(**{**TIDY, **change}).splitlines()
    assert (problem.location.line, problem.source_line) == (line, text[line - 1])


@pytest.mark.parametrize(
    ("text", "line", "column"),
    [
        ("cases:\n  - title: A sentence.\n    id: a\n    {rest}", 2, 5),
        ("cases:\n  - id: a\n    title: A sentence.\n    {rest}", 3, 5),
        ("cases:\n  - {{id: a, title: A sentence., {rest}}}", 2, 6),
    ],
)
def test_a_blemish_of_a_case_in_a_list(text: str, line: int, column: int, tmp_path: Path) -> None:
    """Where its key begins; of a case in one line, where that says its id."""
    keys = ("why: A reason.", "retail: [Frame::cache §4.2]", "tags: [frame]")
    keys += ("query: {op: frame_cache, rotation: [1, 0, 0, 0]}",)
    between = ", " if "{{" in text else "\n    "
    (tmp_path / "a.yaml").write_text(text.format(rest=between.join(keys)), encoding="utf-8")
    (problem,) = lint([tmp_path])
    assert (problem.location.line, problem.location.column) == (line, column)


def test_mistakes_and_blemishes_together(tmp_path: Path) -> None:
    """All files are looked at, whatever one of them holds."""
    (tmp_path / "a.yaml").write_text("a: [", encoding="utf-8")
    (tmp_path / "b.yaml").write_text(CASE.format(**{**TIDY, "tags": ""}), encoding="utf-8")
    assert ["YAML syntax" in problem.found for problem in lint([tmp_path])] == [True, False]


def test_nothing_to_lint(tmp_path: Path) -> None:
    """An empty folder is not clean, it is a mistake."""
    with pytest.raises(NoCasesError):
        lint([tmp_path])
