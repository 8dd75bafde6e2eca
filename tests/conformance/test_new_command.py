"""`conformance new`: what a new case is made from, that it stands alone, and what is refused."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from conformance import cli, exit_codes, loader
from conformance.case import Vary
from conformance.life.anchors import anchored, write_out
from conformance.life.new_case import NewCaseError, check_id, text_like
from conformance.lint import lint
from conformance.loader import BUILT_IN_CASES, load_document, load_file
from conformance.yaml_source import parse

if TYPE_CHECKING:
    from pathlib import Path

ORIGIN = "origin-step-down-touching"


@pytest.fixture(autouse=True)
def few_cases(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Work in a folder of its own, with one folder of the built-in cases."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(loader, "BUILT_IN_CASES", BUILT_IN_CASES / "contact-plane")


def new(*arguments: str) -> int:
    """Run the command."""
    return cli.main(["new", *arguments])


def test_a_new_case_is_another_under_a_new_id(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """It asks the same, lint has nothing against it, and what to do next is said."""
    assert new("my-ramp", "--like", ORIGIN, "-o", "my-cases/ramp.yaml") == exit_codes.OK
    assert capsys.readouterr().out.replace("\\", "/").splitlines() == [
        f"my-cases/ramp.yaml: my-ramp, like {ORIGIN}",
        "Give it a title, a `why` and a scene of its own, then check and run it:",
        "  conformance lint my-cases/ramp.yaml",
        "  pytest my-cases/ramp.yaml",
    ]
    file = tmp_path / "my-cases" / "ramp.yaml"
    assert file.read_text(encoding="utf-8").startswith(
        f"# Begun as a copy of {ORIGIN}.\nid: my-ramp\ntitle: "
    )
    assert lint([file]) == []
    (made,) = load_file(file, Vary(poses=0)).cases
    cases = load_file(BUILT_IN_CASES / "contact-plane" / "origin.yaml", Vary(poses=0)).cases
    (other,) = [case for case in cases if case.id == ORIGIN]
    assert (made.id, made.op, made.retail, made.why) == ("my-ramp", other.op, other.retail, other.why)
    assert len(made.expect) == len(other.expect) > 0


def test_a_title_may_hold_anything(tmp_path: Path) -> None:
    """Quotes and colons, too; it takes the place of a title of several lines."""
    assert new("my-ramp", "--tag", "step-down", "--title", "It's a: 'test'") == exit_codes.OK
    (made,) = load_file(tmp_path / "my-ramp.yaml", Vary(poses=0)).cases
    assert made.title == "It's a: 'test'"


@pytest.mark.parametrize("quote", ["'", '"'])
def test_keys_may_be_quoted(quote: str, tmp_path: Path) -> None:
    """As JSON has them: the new id and the new title still take the place of the old ones."""
    found = tmp_path / "found.yaml"
    assert new("found-1", "--like", ORIGIN, "-o", str(found)) == exit_codes.OK
    text = found.read_text(encoding="utf-8")
    for key in ("id", "title"):
        text = text.replace(f"\n{key}:", f"\n{quote}{key}{quote}:")
    found.write_text(text, encoding="utf-8")
    assert new("mine", "--like", str(found), "--title", "Mine") == exit_codes.OK
    (made,) = load_file(tmp_path / "mine.yaml", Vary(poses=0)).cases
    assert (made.id, made.title) == ("mine", "Mine")


@pytest.mark.parametrize(("option", "word"), [("--op", "find_collisions"), ("--tag", "step-down")])
def test_the_smallest_case_of_a_kind_is_taken(option: str, word: str, tmp_path: Path) -> None:
    """It has the operation, or the tag."""
    assert new("mine", option, word) == exit_codes.OK
    (made,) = load_file(tmp_path / "mine.yaml", Vary(poses=0)).cases
    assert word in {made.op, *made.tags}


def test_a_found_failure_becomes_a_case(tmp_path: Path) -> None:
    """A file with one case is named without its id; comments in it are kept."""
    found = tmp_path / "found.yaml"
    assert new("found-1", "--like", ORIGIN, "-o", str(found)) == exit_codes.OK
    found.write_text(found.read_text(encoding="utf-8").replace("scene:", "scene:  # kept"), encoding="utf-8")
    assert new("my-failure", "--like", str(found), "-o", "mine/failure.yaml") == exit_codes.OK
    text = (tmp_path / "mine" / "failure.yaml").read_text(encoding="utf-8")
    assert text.startswith("# Begun as a copy of found-1.\n")
    assert "\nid: my-failure\n" in text
    assert "scene:  # kept" in text


def test_a_line_of_a_trace_finds_a_case_with_that_write(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Retail makes the same write there, and the line stands in the new file."""
    line = "[cp-write] ContactPlane: none -> n=(0,0,1) D=0 caller=step_sphere_down"
    assert new("my-plane", "--trace-line", line) == exit_codes.OK
    assert f"# From a trace: {line}\n" in (tmp_path / "my-plane.yaml").read_text(encoding="utf-8")
    capsys.readouterr()
    assert cli.main(["trace", "my-plane.yaml::my-plane", "--trace", "cp-write"]) == exit_codes.OK
    written = capsys.readouterr().out.splitlines()
    assert any("] ContactPlane: " in one and one.endswith("caller=step_sphere_down") for one in written)


@pytest.mark.parametrize(
    ("arguments", "complaint"),
    [
        (("My_Ramp", "--like", ORIGIN), "found the id 'My_Ramp', expected lower-case words"),
        ((ORIGIN, "--like", ORIGIN), "is taken; ids are unique, and for life"),
        (("mine", "--like", f"{ORIGIN}x"), f"Did you mean '{ORIGIN}'?"),
        (("mine", "--op", "find_colisions"), "did you mean 'find_collisions'?"),
        (("mine", "--tag", "stepdown"), "did you mean 'step-down'?"),
        (("mine", "--trace-line", "[cp-write] ContactPlan: "), "not a trace line: column"),
        (("mine", "--trace-line", "frame 7"), "it does not begin with a topic"),
        (
            ("mine", "--trace-line", "[state] State: 0x0 -> 0x1 caller=step_sphere_down"),
            "in no built-in case",
        ),
    ],
)
def test_what_will_not_do_is_a_usage_error(
    arguments: tuple[str, ...], complaint: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Exit code 2, and nothing is written."""
    assert new(*arguments) == exit_codes.USAGE
    assert complaint in capsys.readouterr().err
    assert list(tmp_path.iterdir()) == []


def test_nothing_is_overwritten(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """What is there stays, whatever it is."""
    (tmp_path / "mine.yaml").write_text("precious", encoding="utf-8")
    assert new("mine", "--like", ORIGIN) == exit_codes.USAGE
    assert "is not overwritten" in capsys.readouterr().err
    assert (tmp_path / "mine.yaml").read_text(encoding="utf-8") == "precious"


def test_an_id_of_a_neighbour_is_taken(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """The cases of a folder run together."""
    assert new("mine", "--like", ORIGIN, "-o", "my-cases/a.yaml") == exit_codes.OK
    assert new("mine", "--like", ORIGIN, "-o", "my-cases/b.yaml") == exit_codes.USAGE
    assert "'mine' is taken" in capsys.readouterr().err
    assert not (tmp_path / "my-cases" / "b.yaml").exists()


def test_a_file_of_several_cases_must_be_told_which(capsys: pytest.CaptureFixture[str]) -> None:
    """The message has them, ready to be copied."""
    file = BUILT_IN_CASES / "contact-plane" / "origin.yaml"
    assert new("mine", "--like", str(file)) == exit_codes.USAGE
    *_, first, second = capsys.readouterr().err.splitlines()
    assert (first, second) == (f"  {file}::{ORIGIN}", f"  {file}::origin-step-down-short")


@pytest.mark.parametrize("name", ["walks/standstill.yaml", "objects/shapes.yaml", "worlds/rooms.yaml"])
def test_a_copy_stands_alone(name: str) -> None:
    """What a case uses of others by aliases is written out: the copy asks the same on every bit."""
    cases = load_file(BUILT_IN_CASES / name, Vary(poses=0)).cases
    aliased = [case for case in cases if "*" in case.source]
    assert aliased
    for case in aliased:
        text = text_like(case, "my-copy")
        (copy,) = load_document(parse(text.encode("utf-8"), "x.yaml"), Vary(poses=0)).cases
        assert repr(copy.queries[0].inputs).replace("my-copy", case.id) == repr(case.queries[0].inputs)


def test_blocks_values_and_lists_are_written_out() -> None:
    """A block goes below its key, and into one line where it must; of an anchor set twice the last counts."""
    source = "a: &one {x: 0x10}\nb: &two\n    y: 1e-3  # kept\n    z: [on]\n# not kept\nc: &one 7\n"
    values = anchored(source)
    assert values == {"one": "7", "two": "\ny: 1e-3  # kept\nz: [on]"}
    text = "p:\n  - q: *two\n  - [*one, {r: *two}]\n  - &own 1\n  - *own\n  - *none\n"
    assert write_out(text, values) == (
        "p:\n  - q:\n      y: 1e-3  # kept\n      z: [on]\n"
        "  - [7, {r: {y: 1e-3, z: [on]}}]\n  - &own 1\n  - *own\n  - *none\n"
    )


def test_ids_are_checked() -> None:
    """Well formed, and free."""
    check_id("a-1", {"a-2"})
    with pytest.raises(NewCaseError, match="taken"):
        check_id("a-1", {"a-1"})
