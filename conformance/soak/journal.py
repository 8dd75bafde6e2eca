"""A campaign's journal: read to go on with it, added to while it runs."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final, TypeVar

from pydantic import BaseModel

from conformance.journal import JournalError, JournalWriter, read_journal
from conformance.soak.records import Identity, Kept, ShardResult
from conformance.soak.tally import Tally, UnlikeShardError
from conformance.validation import validate

if TYPE_CHECKING:
    from pathlib import Path
    from typing import Self

M = TypeVar("M", bound=BaseModel)

_CHANGED: Final = {
    "soak": "the version of the journal",
    "suite": "the suite (its sources, Python, a package, or the system)",
    "candidate": "the candidate",
    "candidate_digest": "the candidate's files",
    "seed": "the seed",
    "shard_size": "the size of a shard",
    "families": "the families",
}


class OtherCampaignError(JournalError):
    """A journal is of another campaign: what it holds cannot be added to what would be asked now."""


class SoakJournal:
    """Writes down what a campaign finds, one shard a line.

    Parameters
    ----------
    path : Path
        The file.
    identity : Identity
        The campaign's.
    resume : bool
        Whether to go on with what the file holds.

    Attributes
    ----------
    tally : Tally
        What the file holds, and what was noted since.

    Raises
    ------
    JournalError
        The file is not there, or is not a journal of a campaign.
    OtherCampaignError
        It is of another campaign.
    FileExistsError
        It is there and is not to be gone on with.
    OSError
        It cannot be read.
    """

    def __init__(self, path: Path, identity: Identity, *, resume: bool) -> None:
        self.path = path
        self.tally = Tally()
        self._identity = identity
        self._writer: JournalWriter | None = None
        if resume and not path.exists():
            raise JournalError(f"{path}: found no file, expected the journal to go on with")
        if not resume and path.exists():
            raise FileExistsError(f"{path} holds a campaign already")
        self._is_new = not (resume and self._read())

    def __enter__(self) -> Self:
        self._writer = JournalWriter(self.path, anew=self._is_new)
        if self._is_new:
            self._writer.write(self._identity.model_dump())
        return self

    def __exit__(self, *_ended_by: object) -> None:
        if self._writer is not None:
            self._writer.close()

    def note(self, result: ShardResult) -> bool:
        """Count a shard and write it down, unless it is there already; return whether it was not.

        Raises
        ------
        UnlikeShardError
            It is there, and has come out differently this time.
        OSError
            It cannot be written.
        """
        if result.shard not in self.tally:
            self._write(result.model_dump())  # first: what is counted is there after a full disk
        return self.tally.add(result)

    def keep(self, kept: Kept) -> None:
        """Write down the case that a failure was kept as."""
        self.tally.keep(kept)
        self._write({"kept": kept.model_dump()})

    def _write(self, record: dict[str, Any]) -> None:
        if self._writer is None:
            raise ValueError("the journal is not open: use it in a with block")
        self._writer.write(record)

    def _read(self) -> bool:
        """Take over what the file holds; return whether it holds a first line."""
        lines = read_journal(self.path)
        first = next(lines, None)
        if first is None:
            return False
        self._check_same(_line(self.path, *first, Identity))
        for number, record in lines:
            try:
                self._take(number, record)
            except UnlikeShardError as error:
                raise JournalError(f"{self.path}:{number}: {error}") from error
        return True

    def _take(self, number: int, record: dict[str, Any]) -> None:
        if "kept" not in record:
            self.tally.add(_line(self.path, number, record, ShardResult))
            return
        kept = _line(self.path, number, record["kept"], Kept)
        if kept.kind not in self.tally.failing:
            raise JournalError(f"{self.path}:{number}: found a kept case of a failure in no line before it")
        self.tally.keep(kept)

    def _check_same(self, theirs: Identity) -> None:
        ours = self._identity.model_dump()
        for name, value in theirs.model_dump().items():
            if ours[name] != value:
                raise OtherCampaignError(
                    f"{self.path}:1: {_CHANGED[name]} has changed: found {value!r}, expected "
                    f"{ours[name]!r}; begin another campaign in another folder"
                )


def _line(path: Path, number: int, record: Any, model: type[M]) -> M:
    line, faults = validate(model, record)
    if line is None:
        fault = faults[0]
        where = ".".join(map(str, fault.path))
        raise JournalError(
            f"{path}:{number}: {where or 'line'}: found {fault.found}, expected {fault.expected}"
        )
    return line
