"""Runs that end early: Ctrl-C, a full disk, a closed pipe. What is known by then is shown, and it is said."""

from __future__ import annotations

import errno
import io
import json
import os
import signal
import subprocess
import sys
from importlib.metadata import entry_points
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest

from conformance import bug_hunt, cli, exit_codes, verification
from conformance.bug_hunt import HuntBrokenOffError, hunt
from conformance.candidates.known_bugs import list_bugs
from conformance.console import Progress, print_document
from conformance.files import write_text

if TYPE_CHECKING:
    from collections.abc import Sequence

ROOT = Path(__file__).parents[2]
RECORD = {"op": "block_offset", "from_cell": 1, "to_cell": 2, "expect": {"v": [0, 0, 0]}}


@pytest.fixture
def vectors(tmp_path: Path) -> Path:
    """Write a vector file of three records."""
    path = tmp_path / "three.jsonl"
    lines = [json.dumps({"id": name, **RECORD}) for name in "abc"]
    path.write_text("\n".join(lines), encoding="utf-8")
    return path


def test_verify_keeps_what_was_compared(
    vectors: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """Ctrl-C at the third record leaves two that passed, and no green exit code."""
    original = verification._verify_record

    def breaking(record: verification.VectorRecord, *rest: object) -> None:
        if record.id == "c":
            raise KeyboardInterrupt
        original(record, *rest)

    monkeypatch.setattr(verification, "_verify_record", breaking)
    assert cli.main(["verify", str(vectors)]) == exit_codes.BROKEN_OFF
    said = capsys.readouterr()
    assert "total: 2 passed, 0 failed" in said.out
    assert "broken off" in said.err


def test_verify_goes_on_after_a_file_that_cannot_be_read(
    vectors: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """It is a failure with its name; the next file is compared."""
    closed = vectors.with_name("closed.jsonl")
    closed.write_text("", encoding="utf-8")
    original = Path.open

    def refusing(path: Path, *args: object, **options: object) -> object:
        if path == closed:
            raise OSError(errno.EACCES, "Permission denied")
        return original(path, *args, **options)

    monkeypatch.setattr(Path, "open", refusing)
    assert cli.main(["verify", str(closed), str(vectors)]) == exit_codes.FAILURES
    said = capsys.readouterr().out
    assert f"{closed}: Permission denied" in said
    assert "total: 3 passed, 1 failed" in said


def test_a_hunt_keeps_what_was_found(monkeypatch: pytest.MonkeyPatch) -> None:
    """The records of a hunt that Ctrl-C ends come with the interruption."""

    def breaking(*_: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr(bug_hunt, "_hunt_at_random", breaking)
    bugs = list(list_bugs())[:2]
    with Progress() as progress, pytest.raises(HuntBrokenOffError) as caught:
        hunt(bugs, [], draws=1, progress=progress)
    assert [record.bug for record in caught.value.records] == bugs


def test_any_command_says_that_it_was_broken_off(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """There is no traceback, and the exit code is the shell's."""

    def breaking(_: object) -> int:
        raise KeyboardInterrupt

    monkeypatch.setattr(cli._COMMANDS["lint"], "run", breaking)
    assert cli.main(["lint"]) == exit_codes.BROKEN_OFF
    assert capsys.readouterr().err == "conformance lint: broken off\n"


def test_any_command_says_that_it_could_not_write(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """A full disk is told in a line."""

    def full(_: object) -> int:
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC), "results.json")

    monkeypatch.setattr(cli._COMMANDS["lint"], "run", full)
    assert cli.main(["lint"]) == exit_codes.CANNOT_WRITE
    said = capsys.readouterr().err
    assert said.startswith("conformance lint: ")
    assert "results.json" in said


@pytest.mark.parametrize("options", [(), ("--json",)], ids=["text", "json"])
def test_a_reader_that_goes_away_is_no_failure(options: Sequence[str]) -> None:
    """`conformance list | head` has an exit code of its own, and says nothing."""
    command = [sys.executable, "-m", "conformance.cli", "list", *options]
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, cwd=ROOT) as process:
        assert process.stdout is not None
        assert process.stderr is not None
        process.stdout.close()
        said = process.stderr.read()
    assert (process.returncode, said) == (exit_codes.CANNOT_WRITE, b"")


def test_a_file_may_name_any_other(tmp_path: Path) -> None:
    """A name that is not UTF-8 is no reason to lose the rest."""
    write_text(tmp_path / "a.json", '"b\udcff.yaml"')
    assert (tmp_path / "a.json").read_bytes() == b'"b\\udcff.yaml"'


def test_a_file_is_written_whole(tmp_path: Path) -> None:
    """Its folder is made; lines end in line feeds; nothing else is left."""
    path = tmp_path / "new" / "file.json"
    write_text(path, "a\nb\n")
    write_text(path, "c\n")
    assert path.read_bytes() == b"c\n"
    assert list(path.parent.iterdir()) == [path]


def test_a_full_disk_leaves_the_old_file(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """What was there stays as it was, and no half of the new one is left."""
    path = tmp_path / "file.json"
    write_text(path, "old\n")

    def full(_: int) -> None:
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    monkeypatch.setattr(os, "fsync", full)
    with pytest.raises(OSError, match=os.strerror(errno.ENOSPC)):
        write_text(path, "new\n")
    assert path.read_text(encoding="utf-8") == "old\n"
    assert list(tmp_path.iterdir()) == [path]


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="skipped: no device that is always full")
def test_a_device_is_written_to_directly() -> None:
    """A disk that is really full raises what the system says."""
    with pytest.raises(OSError, match=os.strerror(errno.ENOSPC)):
        write_text(Path("/dev/full"), "text\n")


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="skipped: no device that is always full")
@pytest.mark.parametrize("words", [["list", "--json"], ["bugs", "--list"]])
@pytest.mark.parametrize("unbuffered", [(), ("-u",)])
def test_a_full_disk_behind_stdout(words: list[str], unbuffered: tuple[str, ...]) -> None:
    """What was printed is not there: never a green exit code, nor that of a crash."""
    command = [sys.executable, *unbuffered, "-m", "conformance.cli", *words]
    with Path("/dev/full").open("wb") as full:
        done = subprocess.run(command, cwd=ROOT, stdout=full, stderr=subprocess.PIPE, check=False)
    assert done.returncode == exit_codes.CANNOT_WRITE
    assert os.strerror(errno.ENOSPC).encode() in done.stderr


def test_a_document_reaches_a_stream_that_takes_little(monkeypatch: pytest.MonkeyPatch) -> None:
    """An unbuffered one may take a part, and says how much."""

    class Narrow(io.RawIOBase):
        taken = b""

        def writable(self) -> bool:
            return True

        def write(self, some: Any) -> int:
            self.taken += bytes(some[:7])
            return len(some[:7])

    narrow = Narrow()
    # What `python -u` gives a program as its stdout.
    monkeypatch.setattr(sys, "stdout", io.TextIOWrapper(narrow, write_through=True))  # type: ignore[type-var]
    print_document("half a million bytes of JSON, ä\n")
    assert narrow.taken == "half a million bytes of JSON, ä\n".encode()


@pytest.mark.parametrize(
    "words",
    [
        ["report", "--no-views", "no-such-case", "--output"],
        ["deviations", "--suggest", "--cases", "no-such-folder", "--output"],
    ],
)
def test_where_results_go_is_looked_at_first(
    words: list[str], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Before anything is read or asked, which takes minutes."""
    assert cli.main([*words, str(tmp_path)]) == exit_codes.CANNOT_WRITE
    assert f"cannot write {tmp_path}" in capsys.readouterr().err
    assert list(tmp_path.iterdir()) == []


IS_INSTALLED = any(point.value == "conformance.plugin" for point in entry_points(group="pytest11"))
PLUG = () if IS_INSTALLED else ("-p", "conformance.plugin")
PLUGGED = [sys.executable, "-m", "pytest", *PLUG, "-p", "no:cacheprovider", "-q"]
CASES = """\
import os
import signal

signal.signal(signal.SIGINT, signal.default_int_handler)  # ignored below a shell's background job


def test_first() -> None:
    pass


def test_second() -> None:
    os.kill(os.getpid(), signal.{})


def test_third() -> None:
    pass
"""


def run_pytest(folder: Path, signal_name: str, *options: str) -> subprocess.CompletedProcess[str]:
    """Run pytest on three tests of which the second sends a signal to its own process."""
    (folder / "test_signal.py").write_text(CASES.format(signal_name), encoding="utf-8")
    environment = {**os.environ, "PYTHONPATH": str(ROOT), "PYTEST_ADDOPTS": ""}
    command = [*PLUGGED, *options, str(folder)]
    return subprocess.run(
        command, cwd=folder, env=environment, capture_output=True, encoding="utf-8", check=False
    )


@pytest.mark.skipif(not hasattr(signal, "SIGKILL"), reason="skipped: Windows has no such signals")
def test_a_killed_worker_is_red(tmp_path: Path) -> None:
    """A test during which a worker of pytest-xdist dies has failed; the others are run all the same."""
    done = run_pytest(tmp_path, "SIGKILL", "-n", "1")
    assert done.returncode == pytest.ExitCode.TESTS_FAILED
    assert "test_second" in done.stdout
    assert "1 failed, 2 passed" in done.stdout


@pytest.mark.skipif(not hasattr(signal, "SIGKILL"), reason="skipped: Windows has no such signals")
def test_an_interrupted_run_is_red(tmp_path: Path) -> None:
    """Ctrl-C in a pytest run keeps what has passed, and says that it was interrupted."""
    done = run_pytest(tmp_path, "SIGINT")
    assert done.returncode == pytest.ExitCode.INTERRUPTED
    assert "1 passed" in done.stdout
    assert "KeyboardInterrupt" in done.stdout
