"""`conformance soak`: how it ends, and what it leaves."""

from __future__ import annotations

import errno
import json
import os
from typing import TYPE_CHECKING, Any

import pytest
from faux import ENGINE, faux_command
from soak_runs import FAMILY, engine

from conformance import cli, exit_codes
from conformance.journal import JournalWriter
from conformance.soak import campaign as campaign_module
from conformance.soak import workshop
from conformance.soak.pace import Pace, duration
from conformance.soak.tally import Tally

if TYPE_CHECKING:
    from pathlib import Path

    from conformance.soak.records import ShardResult
    from conformance.soak.workshop import Shard, Work


pytest_plugins = ["pytester"]


@pytest.fixture(autouse=True)
def few_cases(monkeypatch: pytest.MonkeyPatch) -> None:
    """Shrink no more than one kind of failure in a campaign: it takes a while."""
    monkeypatch.setattr(campaign_module, "MOST_KEPT", 1)


def soak(folder: Path, candidate: str, *options: str, queries: str = "40") -> int:
    """Run a small campaign and return the exit code."""
    size = ("--queries", queries, "--shard-size", "20", "--seed", "7", "--family", FAMILY)
    return cli.main(["soak", *size, "--candidate", candidate, "-o", str(folder), *options])


def written(folder: Path) -> dict[str, Any]:
    """Return the summary of a campaign."""
    record: dict[str, Any] = json.loads((folder / "summary.json").read_text(encoding="utf-8"))
    return record


def test_a_right_engine_ends_well(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Its counts are printed, and are in the summary."""
    assert soak(tmp_path, engine("Right")) == exit_codes.OK
    said = capsys.readouterr().out
    assert "40 of 40 queries: 40 agreed, 0 differed, 0 without an answer, 0 skipped" in said
    record = written(tmp_path)
    assert (record["exit_code"], record["agreed"], record["families"]) == (0, 40, {FAMILY: 40})
    assert record["campaign"]["seed"] == 7


def test_a_wrong_engine_is_red(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """The first case is kept and can be run; of other kinds it is said that they are not."""
    assert soak(tmp_path, engine("Faulty"), queries="60") == exit_codes.FAILURES
    said = capsys.readouterr().out
    (case,) = (tmp_path / "found").iterdir()
    assert f'  rerun: pytest "{case}" --candidate mod:soak_engines:Faulty' in said
    assert "  not kept as a case" in said
    kinds = said.count("  first in shard ")
    assert f"only counted, because enough others came before: {kinds - 1}; mend those first" in said
    assert "  skipped: mod:soak_engines:Faulty: no trees: " in said
    kept = [failure["case"] for failure in written(tmp_path)["failures"] if failure["case"]]
    assert kept == [case.name]


@pytest.mark.parametrize(("name", "outcome"), [("Faulty", "failed"), ("Right", "passed")])
def test_what_was_found_can_be_run_again(pytester: pytest.Pytester, name: str, outcome: str) -> None:
    """As the output says: the candidate fails, retail and who is right do not."""
    assert soak(pytester.path / "soak", engine("Faulty"), queries="60") == exit_codes.FAILURES
    (case,) = (pytester.path / "soak" / "found").iterdir()
    pytester.makeconftest("from conformance.conftest import pytest_addoption\n")
    options = (str(case), "--candidate", engine(name))
    pytester.runpytest_inprocess(*options).assert_outcomes(**{outcome: 1})


def test_of_an_engine_that_names_no_file_nothing_is_known(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """That a change would not be noticed is said; its author can say what it is."""
    said = "a change of the candidate would not be noticed: --candidate-digest says what it is"
    command = f"cmd:{faux_command('right')}".replace(str(ENGINE), "-c pass")
    assert soak(tmp_path / "a", command, queries="1") == exit_codes.BROKEN
    assert said in capsys.readouterr().out
    assert soak(tmp_path / "b", command, "--candidate-digest", "build 7", queries="1") == exit_codes.BROKEN
    assert said not in capsys.readouterr().out


def test_an_engine_that_does_not_stop_properly_is_broken(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Also one that has done nothing wrong before."""
    command = f"cmd:{faux_command('sour')}"
    assert soak(tmp_path, command, queries="1") == exit_codes.BROKEN
    assert f"  {command} does not stop properly: " in capsys.readouterr().out


def test_an_engine_that_cannot_be_made_is_told(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Its factory is there, so it is found out when the first shard is begun."""
    assert soak(tmp_path, "mod:modules_under_test:failing") == exit_codes.USAGE
    assert "OSError: no licence" in capsys.readouterr().out


def test_a_silent_engine_is_broken(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """It is not asked on."""
    assert soak(tmp_path, engine("Silent")) == exit_codes.BROKEN
    said = capsys.readouterr().out
    assert "20 of 40 queries: 0 agreed, 0 differed, 20 without an answer" in said
    assert "given up: no answer to anything in shard 0" in said


def test_an_idle_engine_shows_nothing(tmp_path: Path) -> None:
    """A campaign that compares nothing is not green."""
    assert soak(tmp_path, engine("Idle")) == exit_codes.NOTHING_RAN


def test_ctrl_c_keeps_what_there_is(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """It is said how to go on, and going on asks only what is left."""
    original = workshop.ask

    def breaking(work: Work, shard: Shard) -> ShardResult:
        if shard.number == 1:
            raise KeyboardInterrupt
        return original(work, shard)

    monkeypatch.setattr(workshop, "ask", breaking)
    assert soak(tmp_path, engine("Right")) == exit_codes.BROKEN_OFF
    said = capsys.readouterr().out
    assert "20 of 40 queries: 20 agreed" in said
    assert "broken off\n" in said
    assert f"journal: {tmp_path / 'journal.jsonl'}; the same command with --resume goes on\n" in said
    asked: list[int] = []
    monkeypatch.setattr(
        workshop, "ask", lambda work, shard: asked.append(shard.number) or original(work, shard)
    )
    assert soak(tmp_path, engine("Right"), "--resume") == exit_codes.OK
    assert asked == [1]


def test_a_full_disk_is_told(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """The counts that are in the journal are shown."""
    original = JournalWriter.write

    def full(writer: JournalWriter, record: dict[str, Any]) -> None:
        if record.get("shard") == 1:
            raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))
        original(writer, record)

    monkeypatch.setattr(JournalWriter, "write", full)
    assert soak(tmp_path, engine("Right")) == exit_codes.CANNOT_WRITE
    said = capsys.readouterr().out
    assert "20 of 40 queries: 20 agreed" in said
    assert f"could not be written: [Errno {errno.ENOSPC}]" in said


@pytest.mark.parametrize(
    ("options", "wrong"),
    [
        (("--candidate", "enginge"), "unknown candidate 'enginge'"),
        (("--candidate", "mod:soak_engines:Nobody"), "mod:soak_engines:Nobody"),
        (("--family", "houses"), "no family 'houses'; there are collision calls, "),
        (("--resume",), "found no file, expected the journal to go on with"),
    ],
)
def test_a_wrong_command_line_asks_nothing(
    tmp_path: Path, options: tuple[str, ...], wrong: str, capsys: pytest.CaptureFixture[str]
) -> None:
    """Each mistake is named."""
    assert soak(tmp_path, engine("Right"), *options) == exit_codes.USAGE
    assert wrong in capsys.readouterr().err
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize(
    "options", [("--queries", "1.5"), ("--queries", "0"), ("--queries", "inf"), ("--minutes", "0")]
)
def test_numbers_that_are_none_are_refused(
    tmp_path: Path, options: tuple[str, ...], capsys: pytest.CaptureFixture[str]
) -> None:
    """Before anything is made."""
    with pytest.raises(SystemExit):
        soak(tmp_path, engine("Right"), *options)
    assert f"found {options[1]}, expected" in capsys.readouterr().err


def test_an_old_campaign_is_not_written_over(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """It is said how to go on with it, and that another seed is another campaign."""
    assert soak(tmp_path, engine("Right"), queries="20") == exit_codes.OK
    assert soak(tmp_path, engine("Right")) == exit_codes.USAGE
    assert "--resume goes on with it, another -o begins another" in capsys.readouterr().err
    assert soak(tmp_path, engine("Right"), "--resume", "--seed", "8") == exit_codes.USAGE
    assert "the seed has changed: found 7, expected 8" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("seconds", "text"),
    [
        (0.4, "0 s"),
        (59.0, "59 s"),
        (61.0, "1 min 1 s"),
        (3600.0, "1 h 0 min"),
        (90000.0, "1 d 1 h"),
    ],
)
def test_a_time_is_written_with_two_units(seconds: float, text: str) -> None:
    """Nobody needs the seconds of a day."""
    assert duration(seconds) == text


def test_the_pace_is_that_of_this_run() -> None:
    """What was asked before does not make it faster."""
    times = iter([100.0, *[110.0] * 4])
    pace = Pace(1000, 400, lambda: next(times))
    tally = Tally(agreed=500)
    assert pace.line(tally).startswith("500 of 1,000 queries (10 a second, 50 s left): 500 agreed, ")
