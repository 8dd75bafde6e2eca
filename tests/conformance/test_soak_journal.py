"""A campaign's journal: gone on with, or refused."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

import pytest
from soak_runs import KIND, engine, identity, shard_result

from conformance.journal import JournalError
from conformance.soak.journal import OtherCampaignError, SoakJournal
from conformance.soak.records import Kept
from conformance.soak.tally import UnlikeShardError

if TYPE_CHECKING:
    from pathlib import Path


KEPT = Kept(**KIND._asdict(), shard=1, query=2, file="found-0123456789.yaml", alone=True)


@pytest.fixture
def path(tmp_path: Path) -> Path:
    """Write the journal of three shards and a case."""
    file = tmp_path / "journal.jsonl"
    with SoakJournal(file, identity(engine("Faulty")), resume=False) as journal:
        assert journal.note(shard_result(1))
        journal.keep(KEPT)
        assert journal.note(shard_result(0))
        assert journal.note(shard_result(2))
        assert not journal.note(shard_result(1))
    return file


@pytest.fixture
def lines(path: Path) -> list[str]:
    """Return its lines."""
    return path.read_text(encoding="utf-8").splitlines()


def read(path: Path, **changes: Any) -> SoakJournal:
    """Read a journal to go on with it, as a campaign of the same or another identity."""
    return SoakJournal(path, identity(engine("Faulty")).model_copy(update=changes), resume=True)


def test_what_was_found_is_known(path: Path, lines: list[str]) -> None:
    """Counts, kinds of failure and the cases they were kept as; reading changes nothing."""
    with read(path) as journal:
        tally = journal.tally
    assert (tally.shards, tally.queries) == (3, 30)
    assert {kind: (failing.count, failing.kept) for kind, failing in tally.failing.items()} == {
        KIND: (6, KEPT)
    }
    assert len(lines) == 5
    assert path.read_text(encoding="utf-8").splitlines() == lines


@pytest.mark.parametrize(
    ("changes", "what"),
    [
        ({"seed": 8}, "the seed has changed: found 7, expected 8"),
        ({"suite": "new"}, "the suite (its sources, Python, a package, or the system) has changed"),
        ({"candidate": "engine"}, "the candidate has changed: found 'mod:soak_engines:Faulty'"),
        ({"candidate_digest": "new"}, "the candidate's files has changed"),
        ({"shard_size": 10}, "the size of a shard has changed: found 20, expected 10"),
        ({"families": ["cells"]}, "the families has changed"),
        ({"soak": 2}, "the version of the journal has changed"),
    ],
)
def test_another_campaign_is_refused(path: Path, changes: dict[str, Any], what: str) -> None:
    """Its results cannot be added to those of this one; the error says what differs."""
    with pytest.raises(OtherCampaignError) as caught:
        read(path, **changes)
    assert str(caught.value).startswith(f"{path}:1: {what}")


def test_a_journal_is_not_written_over(path: Path) -> None:
    """Hours of work are not lost by a forgotten option."""
    with pytest.raises(FileExistsError, match="holds a campaign already"):
        SoakJournal(path, identity(engine("Faulty")), resume=False)


def test_a_journal_that_is_not_there_cannot_be_gone_on_with(tmp_path: Path) -> None:
    """A mistyped folder is not a new campaign."""
    with pytest.raises(JournalError, match="found no file"):
        read(tmp_path / "journal.jsonl")


def test_a_journal_without_its_first_line_is_begun(path: Path) -> None:
    """A run that was killed at once has asked nothing."""
    path.write_bytes(b'{"soak": 1, "su')
    with read(path) as journal:
        assert journal.tally.shards == 0
    assert json.loads(path.read_text(encoding="utf-8"))["seed"] == 7


def test_a_shard_twice_counts_once(path: Path, lines: list[str]) -> None:
    """Two runs may have written the same one."""
    path.write_text("\n".join([*lines, lines[1], ""]), encoding="utf-8")
    assert read(path).tally.queries == 30


def test_a_shard_that_came_out_differently_is_an_error(path: Path, lines: list[str]) -> None:
    """Which of the two is right cannot be known."""
    other = {**json.loads(lines[1]), "answers": "other"}
    path.write_text("\n".join([*lines, json.dumps(other), ""]), encoding="utf-8")
    with pytest.raises(JournalError, match=r"journal\.jsonl:\d+: shard 1 was asked twice") as caught:
        read(path)
    assert isinstance(caught.value.__cause__, UnlikeShardError)


@pytest.mark.parametrize(
    ("line", "wrong"),
    [
        ({"shard": 1}, "line: found no 'agreed'"),
        ({**shard_result(1).model_dump(), "shard": -1}, "shard: found"),
        ({"kept": {"op": "walk"}}, "line: found no 'field'"),
        ({"kept": 3}, "line: found the number 3, expected a mapping"),
        (
            {"kept": {**KEPT.model_dump(), "op": "transition"}},
            "found a kept case of a failure in no line before it",
        ),
    ],
)
def test_a_line_of_something_else_is_refused(path: Path, lines: list[str], line: object, wrong: str) -> None:
    """The error says which line, and what is wrong with it."""
    path.write_text("\n".join([*lines[:2], json.dumps(line), ""]), encoding="utf-8")
    with pytest.raises(JournalError, match=rf"journal\.jsonl:3: ({wrong})"):
        read(path)


def test_a_journal_is_written_in_a_with_block(tmp_path: Path) -> None:
    """Otherwise nobody would close it."""
    journal = SoakJournal(tmp_path / "journal.jsonl", identity(engine("Right")), resume=False)
    with pytest.raises(ValueError, match="with block"):
        journal._write({})
