"""The command line: what it prints and how it ends."""

from __future__ import annotations

import json
from pathlib import Path
from typing import TYPE_CHECKING

import pytest
from shipped_vectors import VECTORS

from conformance import cli
from conformance.commands import verify
from conformance.loader import BUILT_IN_CASES
from conformance.query import Skipped

if TYPE_CHECKING:
    from collections.abc import Sequence

    from conformance.query import Outcome, Query

MATH = VECTORS / "math.jsonl"
SEED_BUG = ("--id", "fc_00001", "--id", "fc_00002", "--candidate", "bug:cell-origin")


def run(capsys: pytest.CaptureFixture[str], *arguments: object) -> tuple[int, list[str]]:
    """Run a command and return its exit code and the lines it printed."""
    code = cli.main([str(argument) for argument in arguments])
    return code, capsys.readouterr().out.splitlines()


def file_of(path: Path, *records: object) -> Path:
    """Write a vector file."""
    path.write_text("".join(f"{json.dumps(record)}\n" for record in records), encoding="utf-8")
    return path


def small(record_id: str, *, right: bool = True, uncertain: bool = False) -> dict[str, object]:
    """Return a record that the oracle answers, with the right or a wrong expectation."""
    expected = {"v": [0, 0, 0]} if right else {"v": [0, 0, 1]}
    record = {"id": record_id, "op": "block_offset", "from_cell": 1, "to_cell": 1, "expect": expected}
    return {**record, "uncertain": "a test"} if uncertain else record


def test_verify_says_what_passed(capsys: pytest.CaptureFixture[str]) -> None:
    """One line a file and one in total; 0 when all agree."""
    code, lines = run(capsys, "verify", MATH)
    assert code == 0
    assert lines == [
        f"{MATH}: 268 passed, 0 failed, 0 skipped, 0 advisory",
        "total: 268 passed, 0 failed, 0 skipped, 0 advisory",
    ]


def test_verify_explains_what_failed(capsys: pytest.CaptureFixture[str]) -> None:
    """The field, both values, and the command that reruns the record; 1 on any failure."""
    path = VECTORS / "find_collisions.jsonl"
    code, lines = run(capsys, "verify", path, *SEED_BUG)
    assert code == 1
    assert lines[0] == f"{path}: 0 passed, 2 failed, 0 skipped, 0 advisory"
    assert lines[1] == f"{path}:2 fc_00001"
    assert lines[4].split() == [
        *("contact_plane.d", "-94.0", "(0xC2BC0000)", "-0.0", "(0x80000000)", "1.1e9", "ULPs")
    ]
    rerun = f'  rerun: conformance verify "{path}" --id fc_00001 --candidate bug:cell-origin'
    assert lines[7] == rerun
    assert lines[-1] == "total: 0 passed, 2 failed, 0 skipped, 0 advisory"


def test_verify_explains_no_more_than_asked(capsys: pytest.CaptureFixture[str]) -> None:
    """After the first N failing records only their number is told."""
    path = VECTORS / "find_collisions.jsonl"
    code, lines = run(capsys, "verify", path, *SEED_BUG, "--max-differences", 1)
    assert code == 1
    assert "  ... and 1 more failing records" in lines
    assert not any("fc_00002" in line for line in lines)


def test_verify_counts_advisory_records(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Uncertain records are compared, and never fail."""
    records = (small("a", uncertain=True), small("b", right=False, uncertain=True), small("c"))
    code, lines = run(capsys, "verify", file_of(tmp_path / "v.jsonl", *records))
    assert code == 0
    assert lines[-1] == "total: 1 passed, 0 failed, 0 skipped, 2 advisory (1 agree)"


class Idle:
    """A candidate that does nothing."""

    name = "idle"

    def answer(self, query: Query) -> Outcome:
        """Skip."""
        return Skipped(f"no {query.op}")


def test_verify_counts_skips_by_reason(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """What a candidate does not do is counted and told; nothing compared at all is 4."""
    monkeypatch.setattr(verify, "candidate_from", lambda _: Idle())
    code, lines = run(capsys, "verify", VECTORS / "world_walk.jsonl")
    assert code == 4
    assert "0 passed, 0 failed, 17 skipped (no world_walk: 17), 0 advisory" in lines[0]
    assert lines[-1] == "nothing was compared"


@pytest.mark.parametrize("content", ["", "\n\n"])
def test_verify_of_nothing_is_not_green(
    content: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """An empty file and an id that no record has compare nothing: 4. So does an empty folder: a slip, 2."""
    path = tmp_path / "empty.jsonl"
    path.write_text(content, encoding="utf-8")
    assert run(capsys, "verify", path)[0] == 4
    path.unlink()
    assert cli.main(["verify", str(tmp_path)]) == 2
    assert capsys.readouterr().err == f"conformance verify: no vector file (*.jsonl) in {tmp_path}\n"
    assert run(capsys, "verify", MATH, "--id", "nobody")[0] == 4


def test_verify_misses_no_record_that_was_asked_for(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Each id is to be found in one of the files; which are not is said, and the run is not green."""
    one, two = file_of(tmp_path / "a.jsonl", small("a")), file_of(tmp_path / "b.jsonl", small("b"))
    chosen = ["verify", str(one), str(two), "--id", "a", "--id", "b"]
    assert cli.main(chosen) == 0
    assert cli.main([*chosen, "--id", "c"]) == 4
    told = capsys.readouterr()
    assert told.err == "conformance verify: no record 'c' in these files\n"
    assert told.out.endswith("total: 2 passed, 0 failed, 0 skipped, 0 advisory\n")


def test_verify_fails_on_bad_lines(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """A line that cannot be read is a failure with its place; the others are still compared."""
    path = file_of(tmp_path / "v.jsonl", small("a"), {**small("b"), "op": "blok_offset"}, small("c"))
    code, lines = run(capsys, "verify", path)
    assert code == 1
    assert lines[0] == f"{path}: 2 passed, 1 failed, 0 skipped, 0 advisory"
    assert lines[1] == f"  {path}:2:1: unknown operation 'blok_offset' (did you mean 'block_offset'?)"


def test_verify_fails_on_a_broken_geometry_file(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """A geometry file beside the vectors that cannot be read is a failure of its own."""
    path = file_of(tmp_path / "v.jsonl", small("a"))
    (tmp_path / "geometries.jsonl").write_text("{\n", encoding="utf-8")
    code, lines = run(capsys, "verify", path)
    assert code == 1
    assert f"{tmp_path / 'geometries.jsonl'}:1:2: not JSON" in lines[2]


def test_verify_takes_folders(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """A folder stands for the vector files in it, not for the shared ones."""
    file_of(tmp_path / "a.jsonl", small("a"))
    file_of(tmp_path / "b.jsonl", small("a", right=False))
    file_of(tmp_path / "geometries.jsonl")
    code, lines = run(capsys, "verify", tmp_path)
    assert code == 1
    assert lines[0].startswith(str(tmp_path / "a.jsonl"))
    assert lines[-1] == "total: 1 passed, 1 failed, 0 skipped, 0 advisory"


def test_verify_for_machines(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """The same as one JSON object."""
    path = file_of(tmp_path / "v.jsonl", small("a", right=False), {"id": "b"})
    code, lines = run(capsys, "verify", path, "--json")
    assert code == 1
    (result,) = map(json.loads, lines)
    assert result["candidate"] == "oracle"
    assert result["total"] == {
        "passed": 0,
        "failed": 2,
        "skipped": {},
        "advisory": {"compared": 0, "agreeing": 0},
    }
    wrong, unread = result["files"][0]["failures"]
    assert wrong == {
        "line": 1,
        "id": "a",
        "differences": [
            {
                "field": "v[2]",
                "name": "v.z",
                "retail": "1.0 (0x3F800000)",
                "candidate": "0.0 (0x00000000)",
                "ulps": 0x3F800000,
            }
        ],
    }
    assert unread["line"] == 2
    assert "op: found None" in unread["error"]


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (("verify", "no-such-file.jsonl"), "no such file: no-such-file.jsonl"),
        (("verify", MATH, "--candidate", "oracel"), "Did you mean 'oracle'"),
        (("export", "no-such-folder", "-o", "never.jsonl"), "no-such-folder"),
        (("lint", "no-such-folder"), "no-such-folder"),
    ],
)
def test_wrong_usage(arguments: Sequence[object], said: str, capsys: pytest.CaptureFixture[str]) -> None:
    """What is not there is told on stderr; 2."""
    assert cli.main([str(argument) for argument in arguments]) == 2
    assert said in capsys.readouterr().err


@pytest.mark.parametrize("arguments", [(), ("verfy",), ("verify",), ("export",)])
def test_argparse_ends_with_2(arguments: Sequence[str]) -> None:
    """Argparse's own errors have the same code."""
    with pytest.raises(SystemExit) as caught:
        cli.main(arguments)
    assert caught.value.code == 2


@pytest.mark.parametrize("command", ["verify", "export", "lint", "bugs"])
def test_help_teaches_with_examples(command: str, capsys: pytest.CaptureFixture[str]) -> None:
    """Every command's help has lines to copy."""
    with pytest.raises(SystemExit) as caught:
        cli.main([command, "--help"])
    assert caught.value.code == 0
    text = capsys.readouterr().out
    assert f"examples:\n  conformance {command}" in text


def test_version(capsys: pytest.CaptureFixture[str]) -> None:
    """The version is that of the installed package."""
    with pytest.raises(SystemExit) as caught:
        cli.main(["--version"])
    assert caught.value.code == 0
    assert capsys.readouterr().out.startswith("conformance ")


def test_bugs_are_listed(capsys: pytest.CaptureFixture[str]) -> None:
    """Every known bug is told by the name that --candidate takes."""
    code, lines = run(capsys, "bugs", "--list")
    assert code == 0
    assert "bug:cell-origin" in lines


def test_lint_of_the_built_in_cases(capsys: pytest.CaptureFixture[str]) -> None:
    """The shipped cases have no mistakes and no blemishes, in any of their poses."""
    code, lines = run(capsys, "lint")
    assert (code, lines) == (0, ["0 problems"])


def test_lint_points_at_mistakes(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """A mistake in a case is told with its place; 1."""
    path = tmp_path / "bad.yaml"
    path.write_text("id: bad\ntitel: no\n", encoding="utf-8")
    code, lines = run(capsys, "lint", path)
    assert code == 1
    assert any(f"{path.name}:2:1" in line for line in lines)


def test_export_writes_what_verify_reads(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Cases become vectors with retail's answers, which the oracle then meets and a bug does not.

    Of one file of each folder, but that of the long walks; that every operation is read back as it was
    written is seen in `test_vector_io`.
    """
    path = tmp_path / "cases.jsonl"
    files = [min(folder.glob("*.yaml")) for folder in BUILT_IN_CASES.iterdir() if folder.name != "walks"]
    code, lines = run(capsys, "export", *files, "--poses", 1, "-o", path)
    assert code == 0
    written = int(lines[-1].split()[0])
    assert written > 60
    code, lines = run(capsys, "verify", path)
    assert code == 0
    assert lines[-1] == f"total: {written} passed, 0 failed, 0 skipped, 0 advisory"
    assert run(capsys, "verify", path, "--candidate", "bug:cell-origin")[0] == 1


def test_rerun_commands_quote_paths_with_spaces() -> None:
    """A path is one argument in every shell."""
    assert verify.quoted(Path("a b.jsonl")) == '"a b.jsonl"'


@pytest.mark.parametrize("arguments", [["list", "--bogus"], ["list", "here", "--bogus"]])
def test_an_unknown_option_is_told_with_those_of_its_command(
    arguments: list[str], capsys: pytest.CaptureFixture[str]
) -> None:
    """Not with those of all commands, among which the right one is not to be found."""
    with pytest.raises(SystemExit) as stop:
        cli.main(arguments)
    said = capsys.readouterr().err
    assert stop.value.code == 2
    assert said.startswith("usage: conformance list [-h] [--tag TAG]")
    assert said.endswith("conformance list: error: unrecognized arguments: --bogus\n")
