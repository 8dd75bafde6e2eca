"""Journals of long runs: what a killed run leaves behind is gone on with."""

from __future__ import annotations

import errno
import os
from pathlib import Path

import pytest

from conformance.journal import JournalError, JournalWriter, read_journal

RECORDS = [{"a": 1}, {"name": "Düne"}]


@pytest.fixture
def path(tmp_path: Path) -> Path:
    """Write a journal of two lines."""
    file = tmp_path / "below" / "journal.jsonl"
    with JournalWriter(file, anew=True) as journal:
        for record in RECORDS:
            journal.write(record)
    return file


def test_what_was_written_is_read(path: Path) -> None:
    """Each record is a line with a number, in UTF-8 and with a line feed on every system."""
    assert list(read_journal(path)) == [(1, RECORDS[0]), (2, RECORDS[1])]
    assert path.read_bytes() == '{"a": 1}\n{"name": "Düne"}\n'.encode()


@pytest.mark.parametrize("torn", [b"{", b'{"b": 2}', b'{"name": "D\xc3', b"\x00\x00"])
def test_a_line_without_its_end_is_left_out(path: Path, torn: bytes) -> None:
    """The next line takes its place, wherever the run was killed."""
    with path.open("ab") as file:
        file.write(torn)
    assert [number for number, _ in read_journal(path)] == [1, 2]
    with JournalWriter(path, anew=False) as journal:
        journal.write({"b": 3})
    assert list(read_journal(path)) == [(1, RECORDS[0]), (2, RECORDS[1]), (3, {"b": 3})]


def test_half_a_character_is_written_as_a_question_mark(path: Path) -> None:
    """What an engine says need not be text; the line can be read all the same."""
    with JournalWriter(path, anew=True) as journal:
        journal.write({"said": "bad \udc80 name"})
    assert list(read_journal(path)) == [(1, {"said": "bad ? name"})]


def test_a_journal_begun_anew_holds_nothing(path: Path) -> None:
    """What was there is gone."""
    with JournalWriter(path, anew=True):
        pass
    assert path.read_bytes() == b""


def test_a_journal_that_is_not_there_is_begun(tmp_path: Path) -> None:
    """Its folder is made, too."""
    path = tmp_path / "a" / "b" / "journal.jsonl"
    with JournalWriter(path, anew=False) as journal:
        journal.write({"a": 1})
    assert list(read_journal(path)) == [(1, {"a": 1})]


@pytest.mark.parametrize("line", [b"no json", b"[1]", b'{"a": 1, "a": 2}', b"\xff"])
def test_another_file_is_refused(path: Path, line: bytes) -> None:
    """The error says which line it is."""
    path.write_bytes(path.read_bytes() + line + b"\n")
    with pytest.raises(JournalError, match=r"^not a journal: .*journal\.jsonl:3:\d+: "):
        list(read_journal(path))


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="skipped: no device that is always full")
def test_a_full_disk_is_told_once() -> None:
    """The line that could not be written is an error; ending the journal is none."""
    full = os.strerror(errno.ENOSPC)
    with JournalWriter(Path("/dev/full"), anew=True) as journal, pytest.raises(OSError, match=full):
        journal.write({"a": 1})
