"""YAML files and cases as pytest collects, runs and reports them."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any, Final

import pytest

from conformance.candidates.registry import make_candidate
from conformance.deviations.known import deviations_of, today
from conformance.deviations.reckoning import reckon
from conformance.loader import Vary, duplicate_id, load_file
from conformance.plugin import CANDIDATES, has_cases
from conformance.protocol.process import command_line
from conformance.summary import PROPERTY
from conformance.trace_excerpt import excerpt
from conformance.traced import parse_topics
from conformance.verdict import judge

if TYPE_CHECKING:
    import os
    from collections.abc import Iterator, Sequence
    from pathlib import Path

    from conformance.candidates.base import Candidate
    from conformance.deviations.reckoning import Reckoning
    from conformance.loader import Case
    from conformance.source import Location, Problem
    from conformance.verdict import Failure, Verdict

DEFAULT_TOPICS: Final = "cp-write"
"""What a failure shows of who wrote what, unless ``--trace-writes`` says otherwise."""
MOST_SOURCE_LINES: Final = 60
"""Lines of a case's source shown with its failure."""

_WHOLE_FILE: Final = "file-unreadable"
"""What fails where no case can be told from another."""
_ASKING: Final = ("--trace-writes", "--read-timeout")
"""Options of a run that change how it is asked and told, not what."""
_IDS: Final = pytest.StashKey["dict[str, Location]"]()


class CaseFailedError(Exception):
    """A candidate, or the oracle itself, did not answer a case as it should."""

    def __init__(self, verdict: Verdict) -> None:
        super().__init__(verdict.failures[0].summary)
        self.verdict = verdict


class DeviationFailedError(Exception):
    """What is recorded of a candidate does not show, or no longer holds."""

    def __init__(self, complaints: Sequence[str]) -> None:
        super().__init__("\n".join(complaints))
        self.complaints = complaints


class UnreadableCaseError(Exception):
    """A case, or a whole file, that cannot be run because of mistakes in it."""

    def __init__(self, problems: list[Problem]) -> None:
        super().__init__(problems[0].summary)
        self.problems = problems


class YamlFile(pytest.File):
    """A file of cases."""

    def collect(self) -> Iterator[pytest.Item]:
        """Yield an item for every case, and one for every case with mistakes."""
        vary = Vary(self.config.getoption("--poses", None), self.config.getoption("--pose-seed", None))
        loaded = load_file(self.path, vary)
        problems: dict[str, list[Problem]] = {}
        for problem in loaded.problems:
            problems.setdefault(problem.case_id, []).append(problem)
        for case_id, found in problems.items():
            yield ProblemItem.from_parent(self, name=case_id or _WHOLE_FILE, problems=found)
        for case in loaded.cases:
            yield self._item(case)

    def _item(self, case: Case) -> pytest.Item:
        ids = self.session.stash.setdefault(_IDS, {})
        first = ids.setdefault(case.id, case.location)
        if first == case.location:
            return CaseItem.from_parent(self, name=case.id, case=case)
        problems = [duplicate_id(case, first)]
        return ProblemItem.from_parent(self, name=case.id, problems=problems)


class ProblemItem(pytest.Item):
    """A case that cannot be read: it fails with all of its mistakes."""

    def __init__(self, *, problems: list[Problem], **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.problems = problems
        self.add_marker("conformance")

    def runtest(self) -> None:
        """Fail."""
        raise UnreadableCaseError(self.problems)

    def reportinfo(self) -> tuple[os.PathLike[str] | str, int | None, str]:
        """Return the place of the first mistake."""
        return self.path, self.problems[0].location.line - 1, self.name

    def repr_failure(self, excinfo: pytest.ExceptionInfo[BaseException], style: Any = None) -> Any:
        """Show every mistake with its source line."""
        if not isinstance(excinfo.value, UnreadableCaseError):
            return super().repr_failure(excinfo, style)
        text = "\n\n".join(str(problem) for problem in self.problems)
        more = f" (and {len(self.problems) - 1} more)" if len(self.problems) > 1 else ""
        return _told(excinfo, self.problems[0].location, self.problems[0].summary + more, text)


class CaseItem(pytest.Item):
    """One case: its query as written, and the same in random poses of the world."""

    def __init__(self, *, case: Case, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.case = case
        self.add_marker("conformance")
        self.extra_keyword_matches.update((*case.tags, case.op))

    def runtest(self) -> None:
        """Ask retail and the candidate, and compare."""
        __tracebackhide__ = True
        candidate, known = self._candidate(), deviations_of(self.config)
        verdict = judge(self.case, candidate, candidate_of(self.config, "oracle"))
        reckoning = reckon(known, self.case.id, verdict, candidate=candidate.name, today=today())
        self.user_properties.append((PROPERTY, self._counts(verdict, reckoning)))
        if reckoning.unexplained:
            raise CaseFailedError(replace(verdict, failures=list(reckoning.unexplained)))
        if reckoning.complaints:
            raise DeviationFailedError(reckoning.complaints)
        if reckoning.held:
            reasons = dict.fromkeys(entry.deviation.reason for entry in reckoning.held)
            raise pytest.xfail.Exception(f"deviation: {'; '.join(reasons)}")
        if not verdict.compared:
            reason = "; ".join(verdict.skipped)
            raise pytest.skip.Exception(reason, _use_item_location=True)

    def _candidate(self) -> Candidate:
        return candidate_of(self.config, self.config.getoption("--candidate", "engine"))

    def _counts(self, verdict: Verdict, reckoning: Reckoning) -> dict[str, Any]:
        counts = {"cases": 1, "queries": verdict.compared, "skipped": dict(verdict.skipped)}
        if reckoning.unexplained:
            first = reckoning.unexplained[0]
            counts["failure"] = f"{first.query.label}: {first.summary}"
        elif reckoning.complaints:
            counts["failure"] = f"{self.case.id}: {reckoning.complaints[0]}"
        elif reckoning.held:
            counts["deviations"] = 1
        return counts

    def reportinfo(self) -> tuple[os.PathLike[str] | str, int | None, str]:
        """Return the line of the case."""
        return self.path, self.case.location.line - 1, f"{self.case.id}: {self.case.title}"

    def repr_failure(self, excinfo: pytest.ExceptionInfo[BaseException], style: Any = None) -> Any:
        """Explain the first failure, show the case's source, and name the other variants that failed."""
        if isinstance(excinfo.value, DeviationFailedError):
            return self._told_deviations(excinfo, excinfo.value)
        if not isinstance(excinfo.value, CaseFailedError):
            return super().repr_failure(excinfo, style)
        failures = excinfo.value.verdict.failures
        first = self._with_writes(failures[0])
        text = [first.render(self.case, self.rerun_command())]
        if len(failures) > 1:
            labels = ", ".join(failure.query.label for failure in failures[1:])
            text.append(f"  also: {labels}")
        text += ["", f"  retail: {'; '.join(self.case.retail)}", "", f"{self.case.location}", *self._source()]
        return _told(excinfo, self.case.location, first.summary, "\n".join(text))

    def _told_deviations(
        self, excinfo: pytest.ExceptionInfo[BaseException], error: DeviationFailedError
    ) -> Any:
        return _told(excinfo, self.case.location, error.complaints[0], "\n".join(error.complaints))

    def _with_writes(self, failure: Failure) -> Failure:
        """Add who wrote what, by asking once more."""
        topics = parse_topics(self.config.getoption("--trace-writes", None) or DEFAULT_TOPICS)
        oracle = candidate_of(self.config, "oracle")
        who = oracle if failure.who == oracle.name else self._candidate()
        writes = excerpt(failure.query, failure.found, oracle, who, topics) if failure.found else ()
        gap = ("",) * bool(writes and failure.around)
        return replace(failure, around=(*failure.around, *gap, *writes))

    def _source(self) -> list[str]:
        first = self.case.first_line
        lines = self.case.source.splitlines()
        shown = [f"{n:>6} | {line}" for n, line in enumerate(lines[:MOST_SOURCE_LINES], start=first)]
        more = len(lines) - MOST_SOURCE_LINES
        return [*shown, f"  ... and {more} more lines"] if more > 0 else shown

    def rerun_command(self) -> str:
        """Return the command that runs this case; what no name tells to be a file of cases is run whole."""
        parts = ["pytest", f"{_relative(self.path, self.config.invocation_params.dir)}::{self.name}"]
        for option in ("--candidate", "--deviations", "--poses", "--pose-seed", *_ASKING):
            value = self.config.getoption(option, None)
            if value is not None and value != "engine":
                parts += [option, str(value)]
        if not has_cases(self.path):
            parts += ["--cases", str(self.path)]
        return command_line(parts)


def candidate_of(config: pytest.Config, spec: str) -> Candidate:
    """Return a candidate, made once in a run."""
    made = config.stash.setdefault(CANDIDATES, {})
    if spec not in made:
        made[spec] = make_candidate(spec, read_timeout=config.getoption("--read-timeout", None))
    return made[spec]


def _told(excinfo: pytest.ExceptionInfo[BaseException], where: Location, reason: str, text: str) -> Any:
    """Return a failure's text with the line that the short summary shows.

    It is made from the exception's own representation, because that is what survives the way from a
    worker of pytest-xdist.
    """
    told: Any = excinfo.getrepr(style="native")
    told.reprtraceback.reprentries[:] = told.reprtraceback.reprentries[-1:]
    told.reprtraceback.reprentries[-1].lines = [f"{text}\n"]
    told.reprtraceback.extraline = None
    if told.reprcrash is not None:
        told.reprcrash.path = where.file
        told.reprcrash.lineno = where.line
        told.reprcrash.message = reason
    return told


def _relative(path: Path, folder: Path) -> str:
    return path.relative_to(folder).as_posix() if path.is_relative_to(folder) else str(path)
