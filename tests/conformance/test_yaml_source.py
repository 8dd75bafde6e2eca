"""YAML with its traps closed: every value as written, every refusal with its place."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest
import yaml

from conformance import yaml_source
from conformance.yaml_source import MAX_DEPTH, YamlError, parse, read_document

if TYPE_CHECKING:
    from pathlib import Path

LOADERS = [yaml.SafeLoader, getattr(yaml, "CSafeLoader", yaml.SafeLoader)]


@pytest.fixture(params=LOADERS, ids=["python", "libyaml"], autouse=True)
def loader(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch) -> None:
    """Run every test with both parsers: what is read, and every error, is the same."""
    monkeypatch.setattr(yaml_source, "_FAST_LOADER", request.param)


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("1e-3", 0.001),
        ("-2E+3", -2000.0),
        ("1.", 1.0),
        (".5", 0.5),
        ("+7", 7),
        ("010", 10),
        ("0xA9B40151", 0xA9B40151),
        ("on", "on"),
        ("off", "off"),
        ("yes", "yes"),
        ("no", "no"),
        ("true", True),
        ("False", False),
        ("null", None),
        ("~", None),
        ("", None),
        ("1_000", "1_000"),
        ("12:30:45", "12:30:45"),
        ("2024-01-01", "2024-01-01"),
        ("'1'", "1"),
        ('"true"', "true"),
    ],
)
def test_scalars_mean_what_yaml_1_2_says(text: str, value: object) -> None:
    """Numbers with exponents are numbers; on and off, dates and sexagesimals are text."""
    read = parse(f"a: {text}\n".encode(), "f.yaml").data["a"]
    assert read == value
    assert type(read) is type(value)


def test_places_of_keys_and_values() -> None:
    """Every key and value knows its line and column, counted from 1."""
    document = parse(b"a: 1\nb:\n  - {c: 2}\n", "f.yaml")
    assert document.data == {"a": 1, "b": [{"c": 2}]}
    assert document.keys[("b", 0, "c")] == (3, 6)
    assert document.values[("b", 0, "c")] == (3, 9)
    assert str(document.locate(("b", 0, "c"))) == "f.yaml:3:9"
    assert str(document.locate(("b", 0, "missing", 3))) == "f.yaml:3:5"


@pytest.mark.parametrize(
    ("text", "line", "column", "found"),
    [
        (b"a: 1\nb: 2\na: 3\n", 3, 1, "the key 'a' a second time (first at 1:1)"),
        (b"a: .nan\n", 1, 4, "the number .nan"),
        (b"a: [1, -.inf]\n", 1, 8, "the number -.inf"),
        (b"a: 1e999\n", 1, 4, "the number 1e999"),
        (b"1: a\n", 1, 1, "the number 1 as a key"),
        (b"true: a\n", 1, 1, "the truth value true as a key"),
        (b"? [a]\n: b\n", 1, 3, "a list, mapping or alias as a key"),
        (b"<<: {a: 1}\n", 1, 1, "the merge key '<<'"),
        (b"a: !!float 1\n", 1, 4, "the tag 'tag:yaml.org,2002:float'"),
        (b"a: &x [*x]\n", 1, 8, "the alias *x inside its own value"),
        (b"a: *y\n", 1, 4, "the alias *y"),
        (b"a: &x 1\nb: &x 2\n", 2, 4, "the anchor &x a second time"),
        (b"a: &x [&x 1]\n", 1, 8, "the anchor &x a second time"),
        (b"&x a: 1\n", 1, 1, "the anchor &x of a key"),
        (b"---\na: 1\n---\nb: 2\n", 3, 1, "a second document"),
    ],
)
def test_refusals_are_collected(text: bytes, line: int, column: int, found: str) -> None:
    """What can be passed over is refused with its place, and the reading goes on."""
    ((_, problem),) = parse(text, "f.yaml").refusals
    assert (problem.location.line, problem.location.column) == (line, column)
    assert problem.found == found


def test_several_refusals_are_told_at_once() -> None:
    """One refusal does not hide the next, nor the good values."""
    document = parse(b"a: .nan\nb: 2\nb: 3\nc: .inf\n", "f.yaml")
    assert [problem.location.line for _, problem in document.refusals] == [1, 3, 4]
    assert document.data["b"] == 2
    assert document.is_refused(("a",))
    assert not document.is_refused(("b2",))


@pytest.mark.parametrize(
    ("text", "line", "column", "found"),
    [
        (b"a: \xff\n", 1, 4, "the byte 0xFF"),
        ("a: 1\n".encode("utf-16"), 1, 1, "text in UTF-16"),
        (b"a:\n\t- 1\n", 2, 1, "a YAML syntax error: found character '\\t' that cannot start any token"),
        (b"a: [1\n", 2, 1, "a YAML syntax error: expected ',' or ']', but got '<stream end>'"),
        (b"a: b: c\n", 1, 5, "a YAML syntax error: mapping values are not allowed here"),
        (b"a: 'x\n", 2, 1, "a YAML syntax error: found unexpected end of stream"),
        (b"a: \x07\n", 1, 4, "the control character U+0007"),
        (b"a: " + b"[" * 300, 1, 4 + MAX_DEPTH - 1, "more than 256 nested levels"),
    ],
)
def test_what_ends_the_reading(text: bytes, line: int, column: int, found: str) -> None:
    """What makes the rest unreadable is an error with its place."""
    with pytest.raises(YamlError) as caught:
        parse(text, "f.yaml")
    problem = caught.value.problem
    assert (problem.location.line, problem.location.column) == (line, column)
    assert problem.found.startswith(found)


def test_an_unclosed_bracket_names_its_opening() -> None:
    """The end of the file is a poor place to look; the message says where the list began."""
    with pytest.raises(YamlError, match="that starts at 1:4"):
        parse(b"a: [1\n", "f.yaml")


def test_alias_bombs_are_refused() -> None:
    """Aliases are shared, but they may not stand for more than a bound."""
    lines = ["a0: &a0 [1, 1, 1, 1, 1, 1, 1, 1, 1, 1]"]
    lines += [f"a{i}: &a{i} [{', '.join([f'*a{i - 1}'] * 10)}]" for i in range(1, 9)]
    with pytest.raises(YamlError) as caught:
        parse("\n".join(lines).encode(), "f.yaml")
    assert str(caught.value.problem.location) == "f.yaml:4:45"
    assert "stand for more than 10000 values" in caught.value.problem.found


def test_aliases_are_allowed_in_measure() -> None:
    """An alias is its anchor's value; a mistake in it is told at the alias."""
    document = parse(b"a: &x {k: 1}\nb: *x\n", "f.yaml")
    assert document.data == {"a": {"k": 1}, "b": {"k": 1}}
    assert str(document.locate(("b", "k"))) == "f.yaml:2:4"


def test_a_byte_order_mark_is_no_mistake(tmp_path: Path) -> None:
    """Editors on Windows write one; it shifts no column."""
    file = tmp_path / "f.yaml"
    file.write_bytes(b"\xef\xbb\xbfa: 1\r\nb: 2\r\n")
    document = read_document(file, "f.yaml")
    assert document.data == {"a": 1, "b": 2}
    assert document.keys[("a",)] == (1, 1)


def test_an_empty_file_holds_nothing() -> None:
    """It is no error here; the loader asks for a case."""
    assert parse(b"", "f.yaml").data is None
    assert parse(b"# only a comment\n", "f.yaml").data is None


def test_an_excerpt_is_one_item() -> None:
    """The lines of a case end where the next one begins."""
    document = parse(b"cases:\n  - id: a\n    x: 1\n\n  - id: b\n", "f.yaml")
    assert document.excerpt(("cases", 0)) == "  - id: a\n    x: 1"
    assert document.first_line(("cases", 1)) == 5
    assert document.excerpt(()).startswith("cases:")
