"""Places, paths, and how a mistake is shown."""

from __future__ import annotations

import pytest

from conformance.source import Location, Problem, describe, format_path, nearest, parse_path


def test_a_problem_shows_its_line_with_a_caret() -> None:
    """The caret stands under the column, also after a tab."""
    problem = Problem(Location("f.yaml", 3, 5), "a.b", "the text 'x'", "a number", "try 1", "\tb: x")
    assert str(problem).splitlines() == [
        "f.yaml:3:5: a.b",
        "  found     the text 'x'",
        "  expected  a number",
        "  hint      try 1",
        "     3 | \tb: x",
        "       | \t   ^",
    ]
    assert problem.summary == "f.yaml:3:5: a.b: found the text 'x', expected a number (try 1)"


def test_a_long_line_is_shown_about_its_column() -> None:
    """Only the part of a long line around the mistake is shown."""
    problem = Problem(Location("f.yaml", 1, 501), "", "x", "y", source_line="." * 500 + "!" + "." * 500)
    shown, caret = str(problem).splitlines()[-2:]
    assert len(shown) < 120
    assert shown[caret.index("^")] == "!"


@pytest.mark.parametrize("text", ["scene.cells[0].pose", "a", "[2][3].b", "x[1]"])
def test_paths_are_read_as_they_are_written(text: str) -> None:
    """Writing and reading a path are inverse."""
    assert format_path(parse_path(text)) == text


@pytest.mark.parametrize(
    ("value", "said"),
    [
        (None, "nothing (null)"),
        (True, "the truth value true"),
        (1.5, "the number 1.5"),
        ("a", "the text 'a'"),
        ([1, 2], "a list of 2"),
        ({"a": 1}, "a mapping with the keys 'a'"),
    ],
)
def test_values_are_described_in_the_authors_words(value: object, said: str) -> None:
    """No Python type names."""
    assert describe(value) == said


def test_the_nearest_name() -> None:
    """A typing mistake gets a hint, something else none."""
    assert nearest("orign", ["origin", "yaw"]) == "did you mean 'origin'?"
    assert nearest("qqq", ["origin", "yaw"]) == ""
