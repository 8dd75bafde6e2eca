"""Which lines of the oracle an answer needs, and how long it takes."""

from __future__ import annotations

import sys
import time
from collections import Counter
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final, NamedTuple, TypeAlias

import oracle
from conformance.candidates.oracle_candidate import OracleCandidate
from conformance.candidates.own_caches import own_caches
from conformance.candidates.replacements import replaced
from conformance.query import Result

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence
    from types import CodeType, FrameType

    from conformance.mutation.asking import Question
    from conformance.query import Outcome, Query

Lines: TypeAlias = frozenset[tuple[str, int]]
"""Names of files of the oracle, and lines in them."""

_ORACLE: Final = Path(oracle.__file__).parent
_WATCHED_CALLS: Final = 40
"""A function that one answer calls more often counts as run whole: watching costs ten times the run."""


class Reach(NamedTuple):
    """What retail's answer to a question needs.

    Attributes
    ----------
    seconds : float
        Processor time.
    lines : Lines
        What runs; at least all of it.
    """

    seconds: float
    lines: Lines


def ask(candidate: OracleCandidate, query: Query) -> Outcome:
    """Ask the oracle as it is now: polygons, trees and worlds are built anew."""
    with replaced(own_caches()):
        return candidate.answer(query)


def reaches(questions: Sequence[Question], say: Callable[[str], None]) -> Mapping[str, Reach]:
    """Ask the oracle everything once, and see what runs; what it does not answer is left out.

    Parameters
    ----------
    questions : sequence of Question
        What is asked.
    say : callable
        Is told how far it is.
    """
    candidate = OracleCandidate()
    found: dict[str, Reach] = {}
    for number, question in enumerate(questions, start=1):
        say(f"what each answer needs: {number} of {len(questions)}")
        reach = _reach(candidate, question.query)
        if reach is not None:
            found[question.name] = reach
    return found


def _reach(candidate: OracleCandidate, query: Query) -> Reach | None:
    started = time.process_time()
    outcome = ask(candidate, query)
    seconds = time.process_time() - started
    if not isinstance(outcome, Result):
        return None
    watcher = _Watcher()
    before = sys.gettrace()
    sys.settrace(watcher.enter)
    try:
        ask(candidate, query)
    finally:
        sys.settrace(before)
    return Reach(seconds, frozenset(watcher.lines))


class _Watcher:
    """Notes the lines of the oracle that run."""

    def __init__(self) -> None:
        self.lines: set[tuple[str, int]] = set()
        self._calls: Counter[CodeType] = Counter()

    def enter(self, frame: FrameType, _event: str, _argument: Any) -> Any:
        """Decide whether the lines of a call are watched one by one."""
        code = frame.f_code
        self._calls[code] += 1
        calls, name = self._calls[code], _module(code.co_filename)
        if not name or calls > _WATCHED_CALLS:
            return None
        if calls == _WATCHED_CALLS:
            self.lines.update((name, line) for _, _, line in code.co_lines() if line is not None)
            return None
        return self._line

    def _line(self, frame: FrameType, event: str, _argument: Any) -> Any:
        if event == "line":
            self.lines.add((_module(frame.f_code.co_filename), frame.f_lineno))
        return self._line


@cache
def _module(file: str) -> str:
    """Return the name of a file of the oracle, empty for any other."""
    path = Path(file)
    return path.name if path.parent == _ORACLE else ""
