"""What has been found so far, on disk: a run that was ended goes on where it was."""

from __future__ import annotations

import hashlib
from typing import TYPE_CHECKING, Any, Final

from conformance.journal import JournalError, JournalWriter, read_journal
from conformance.mutation.trial import Finding, Verdict

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Mapping, Sequence
    from pathlib import Path
    from typing import Self

    from conformance.mutation.asking import Question
    from conformance.mutation.mutant import Key, Mutant

_SUITE: Final = "suite"
_DIGEST_DIGITS: Final = 16


class Journal:
    """Findings, one a line, under a digest of the oracle and of what was asked.

    Parameters
    ----------
    path : Path
        The file.
    digest : str
        Of the oracle's sources and the questions; see `digest_of`.
    resume : bool
        Whether to take the findings that the file holds. Those under the same digest are taken as they are;
        of those under another one, the question that noticed a mutant is asked first.

    Raises
    ------
    JournalError
        The file holds something else, or findings that are not to be gone on with.
    OSError
        It cannot be read.
    """

    def __init__(self, path: Path, digest: str, *, resume: bool) -> None:
        self.path = path
        self._digest = digest
        lines = list(_read(path)) if path.exists() else []
        if len(lines) > 1 and not resume:
            raise JournalError(
                f"{path} holds findings already: --resume goes on with it, another --journal begins anew"
            )
        self._is_current = bool(lines) and lines[0].get(_SUITE) == digest
        self._records = {_key(line): line for line in lines[1:]}
        self._writer: JournalWriter | None = None

    def __enter__(self) -> Self:
        self._writer = JournalWriter(self.path, anew=not self._is_current)
        if not self._is_current:
            self._write({_SUITE: self._digest})
            for record in self._records.values():
                self._write({**record, "verdict": None})
        return self

    def __exit__(self, *_ended_by: object) -> None:
        if self._writer is not None:
            self._writer.close()

    def finding(self, mutant: Mutant) -> Finding | None:
        """Return what is known of a mutant, if it was found out with the same oracle and questions."""
        record = self._records.get(mutant.key)
        if record is None or not self._is_current or not record["verdict"]:
            return None
        return Finding(mutant, Verdict[record["verdict"]], record["by"], record["output"], record["asked"])

    def hint(self, mutant: Mutant) -> str:
        """Return the name of the question that noticed a mutant before, empty if none did."""
        record = self._records.get(mutant.key)
        return record["by"] if record else ""

    def note(self, finding: Finding) -> None:
        """Write down a finding at once."""
        *key, nth = finding.mutant.key
        self._write(
            {
                "mutant": [*key, nth],
                "verdict": finding.verdict.name,
                "by": finding.by,
                "output": finding.output,
                "asked": finding.asked,
            }
        )

    def _write(self, record: Mapping[str, Any]) -> None:
        if self._writer is None:
            raise ValueError("the journal is not open: use it in a with block")
        self._writer.write(record)


def digest_of(sources: Mapping[str, str], questions: Sequence[Question]) -> str:
    """Return what stands for the oracle's sources and for all that is asked."""
    content = hashlib.sha256()
    for text in _texts(sources, questions):
        content.update(text.encode("utf-8"))
        content.update(b"\0")
    return content.hexdigest()[:_DIGEST_DIGITS]


def _texts(sources: Mapping[str, str], questions: Sequence[Question]) -> Iterable[str]:
    for file, source in sources.items():
        yield from (file, source)
    for question in questions:
        query = question.query
        geometries = {name: geometry.to_record() for name, geometry in query.geometries.items()}
        yield from (question.name, query.op, repr(query.inputs), repr(geometries))


def _read(path: Path) -> Iterator[dict[str, Any]]:
    for number, record in read_journal(path):
        if not (_SUITE in record or _is_finding(record)):
            raise JournalError(
                f"{path}:{number}: found neither a digest nor a finding, expected a journal of mutants"
            )
        yield record


def _is_finding(record: dict[str, Any]) -> bool:
    fields = {"verdict": str | None, "by": str, "output": str, "asked": int}
    key = record["mutant"] if isinstance(record.get("mutant"), list) else []
    kinds = (str, str, str, str, int)
    fits = len(key) == len(kinds) and all(map(isinstance, key, kinds))
    known = record.get("verdict") is None or record["verdict"] in Verdict.__members__
    return fits and known and all(isinstance(record.get(name), kind) for name, kind in fields.items())


def _key(record: dict[str, Any]) -> Key:
    function, operator, before, after, nth = record["mutant"]
    return function, operator, before, after, nth
