"""`conformance fmt`: one layout, reached in one step, that says the same; comments are kept."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from conformance import cli, exit_codes
from conformance.life.layout import ORDER, LayoutError, lay_out
from conformance.loader import BUILT_IN_CASES, case_files
from conformance.yaml_source import YamlError, parse

if TYPE_CHECKING:
    from pathlib import Path

FILES = case_files(BUILT_IN_CASES)
assert FILES

UNTIDY = """\

# About the file.
cases:
  - tags: [a, b]   # beside
    id: one

    # above the reason
    why: >
      First line,

      third, # not a comment


    title: One
  # About two.
  - id: two
    title: |
      kept \x20
      as it is
    # at the end
"""
TIDY = """\
# About the file.
cases:
  - id: one

    title: One
    # above the reason
    why: >
      First line,

      third, # not a comment


    tags: [a, b]   # beside

  # About two.
  - id: two
    title: |
      kept \x20
      as it is
    # at the end
"""
BLOCKS = (
    "id: one\n",
    "# before the title\ntitle: One\n",
    "why: >\n  Because\n  of this.\n",
    "retail:\n  - A::b  # beside\n",
    "tags: [x]\n",
    "# two\n# lines\nscene: {a: 1}\n",
    "query:\n  op: walk\n",
    "vary: false\n",
)
"""The keys of a case in their order, each with its comments."""


def laid_out(text: str) -> str:
    """Lay a text out."""
    return lay_out(text.encode("utf-8"), "a.yaml")


def test_keys_are_put_in_order_with_their_comments() -> None:
    """Texts of several lines stay to the blank, and what is above a case stays there."""
    assert laid_out(UNTIDY) == TIDY
    assert laid_out(TIDY) == TIDY


@pytest.mark.parametrize(
    "text", ["cases: []\n", "cases: [1, {}]\n", "cases:\n  - &a {id: one, title: x}\n  - *a\n"]
)
def test_a_file_without_lines_to_move_stays(text: str) -> None:
    """No case at all, or one that is said to be another: what is wrong with it is for `lint` to say."""
    assert (
        parse(lay_out(text.encode("utf-8"), "a.yaml").encode("utf-8"), "a.yaml").data
        == parse(text.encode("utf-8"), "a.yaml").data
    )


@given(st.permutations(BLOCKS), st.sampled_from(["\n", "\r\n"]), st.sampled_from(["", "\ufeff"]))
def test_any_order_is_laid_out_alike(blocks: list[str], end: str, mark: str) -> None:
    """Whatever the order of the keys, the ends of lines and the mark at the beginning are.

    Comments at the beginning speak of the file, and stay there.
    """
    assume(not blocks[0].startswith("#"))
    text = mark + "".join(blocks).replace("\n", end)
    assert laid_out(text) == "".join(BLOCKS)


@given(st.permutations(BLOCKS), st.permutations(BLOCKS))
def test_cases_of_a_list_are_laid_out_alike(first: list[str], second: list[str]) -> None:
    """In a list too, where the first key stands beside the dash."""

    def item(blocks: list[str]) -> str:
        lines = "".join(blocks).splitlines()
        begin = next(index for index, line in enumerate(lines) if not line.startswith("#"))
        return "".join(f"  {'- ' if index == begin else '  '}{line}\n" for index, line in enumerate(lines))

    once = laid_out(f"cases:\n{item(first)}{item(second)}")
    assert laid_out(once) == once
    said = parse(once.encode("utf-8"), "a.yaml").data
    assert [list(case) for case in said["cases"]] == [[key for key in ORDER if key in said["cases"][0]]] * 2
    assert sorted(line.strip() for line in once.splitlines() if "#" in line) == sorted(
        line.strip() for line in "".join(BLOCKS).splitlines() * 2 if "#" in line
    )


@pytest.mark.parametrize("file", FILES, ids=lambda file: file.relative_to(BUILT_IN_CASES).as_posix())
def test_the_built_in_cases_are_laid_out(file: Path) -> None:
    """As `conformance fmt` would write them."""
    raw = file.read_bytes()
    assert lay_out(raw, file.name) == raw.decode("utf-8").replace("\r\n", "\n")


def test_what_would_say_something_else_is_refused() -> None:
    """A mapping in braces, whose commas are in the lines."""
    with pytest.raises(LayoutError, match=r"a\.yaml: laid out anew"):
        laid_out("{query: {op: walk},\n id: one}\n")


def test_an_alias_never_comes_before_its_anchor() -> None:
    """Where the order of keys asks for that, the file is refused."""
    with pytest.raises(LayoutError):
        laid_out("query: &q {op: walk}\nid: one\nscene: *q\n")


def test_files_are_changed_once(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Then there is nothing to change, and --check agrees before and after."""
    file = tmp_path / "a.yaml"
    file.write_text(UNTIDY, encoding="utf-8")
    assert cli.main(["fmt", "--check", str(tmp_path)]) == exit_codes.FAILURES
    assert capsys.readouterr().out.splitlines() == [f"{file}: would change", "1 file, 1 would change"]
    assert file.read_text(encoding="utf-8") == UNTIDY
    assert cli.main(["fmt", str(tmp_path)]) == exit_codes.OK
    assert capsys.readouterr().out.splitlines() == [f"{file}: changed", "1 file, 1 changed"]
    assert file.read_bytes() == TIDY.encode("utf-8")
    assert cli.main(["fmt", "--check", str(tmp_path)]) == exit_codes.OK
    assert capsys.readouterr().out == "1 file, 0 would change\n"


def test_a_file_that_cannot_be_read_is_told(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """With its place; the other files are laid out all the same."""
    (tmp_path / "a.yaml").write_text("id: [\n", encoding="utf-8")
    (tmp_path / "b.yaml").write_text(UNTIDY, encoding="utf-8")
    assert cli.main(["fmt", str(tmp_path)]) == exit_codes.FAILURES
    out = capsys.readouterr().out
    assert "a YAML syntax error" in out
    assert out.splitlines()[-1] == "2 files, 1 changed, 1 cannot be laid out"
    assert (tmp_path / "b.yaml").read_text(encoding="utf-8") == TIDY


def test_a_folder_without_cases_is_a_usage_error(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Exit code 2."""
    assert cli.main(["fmt", str(tmp_path)]) == exit_codes.USAGE
    assert "no *.yaml file" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("raw", "said"),
    [
        (b"id: a\nid: b\n", "f:2:1 the key 'id' a second time"),
        (b"id: !!python/name:os.system x\n", "f:1:5 the tag"),
        (b"id: &a [*a]\n", "f:1:9 the alias *a inside its own value"),
    ],
    ids=("twice", "tag", "cyclic"),
)
def test_what_was_refused_is_not_laid_out(raw: bytes, said: str) -> None:
    """The file does not say what is meant, so there is nothing to keep; the place is told."""
    with pytest.raises(YamlError) as caught:
        lay_out(raw, "f")
    problem = caught.value.problem
    assert f"{problem.location} {problem.found}".startswith(said)


def test_what_only_one_parser_reads_is_left_as_it_is() -> None:
    """Libyaml passes over a tab behind a word, PyYAML's own parser does not."""
    with pytest.raises((LayoutError, YamlError)):
        lay_out(b"id: a\t\nwhy: b\n", "f")


def test_an_empty_mapping_has_no_case() -> None:
    """There are no keys to be put in order."""
    assert lay_out(b"{}\n", "f") == "{}\n"
