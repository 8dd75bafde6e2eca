"""Asking the oracle while watching which functions of retail run, and which of their steps."""

from __future__ import annotations

import functools
import re
import sys
from contextlib import contextmanager
from dataclasses import dataclass, field
from enum import Enum
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final, TypeAlias

from conformance.candidates.oracle_candidate import OracleCandidate
from conformance.life.step_source import ORACLE, statements_of

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator
    from types import CodeType, FrameType

    from conformance.life.step_source import Statement
    from conformance.query import Outcome, Query

_SOURCE: Final = re.compile(
    r"\bretail: ((?:\w+::)+[^\s(]+)[^\n]*?\b0x[0-9A-F]{8}(?:, ([^\n]*?))?\.?\s*$", re.MULTILINE
)
"""The function of retail that a docstring names, with address, and where it is specified."""


@dataclass(slots=True, eq=False)
class Step:
    """One step of the specification that was begun.

    Attributes
    ----------
    statement : Statement
        What the oracle has there.
    holds : bool or None
        Of a condition, whether it held.
    """

    statement: Statement
    holds: bool | None = None


@dataclass(slots=True, eq=False)
class RetailCall:
    """One call of a function of retail.

    Attributes
    ----------
    function : str
        ``CLASS::name``.
    specified : str
        Document and steps, ``03 SD-1…12``; may be empty.
    items : list of Step or RetailCall
        What was done, in order.
    returned : str
        A state, number or truth value that it returned; empty for anything else.
    """

    function: str
    specified: str
    items: list[Item] = field(default_factory=list)
    returned: str = ""

    @property
    def has_steps(self) -> bool:
        """Tell whether a step was begun here, or in a call below."""
        return any(isinstance(item, Step) or item.has_steps for item in self.items)


Item: TypeAlias = Step | RetailCall
Say: TypeAlias = "Callable[[str], None]"
Tracer: TypeAlias = "Callable[[FrameType, str, Any], Any]"


def watch(query: Query, say: Say | None = None) -> tuple[Outcome, list[Item]]:
    """Ask the oracle.

    Parameters
    ----------
    query : Query
        What is asked.
    say : callable, optional
        Is told how far it has come; a long walk takes seconds.

    Returns
    -------
    Outcome
        The oracle's answer.
    list of Step or RetailCall
        The outermost calls, in order, with all that happened in them.
    """
    candidate = OracleCandidate()
    watcher = _Watcher(say)
    with _tracing(watcher.call):
        outcome = candidate.answer(query)
    return outcome, watcher.root.items


@contextmanager
def _tracing(tracer: Tracer) -> Iterator[None]:
    """Have the interpreter report to a tracer; a debugger that was there before comes back."""
    before = sys.gettrace()
    sys.settrace(tracer)
    try:
        yield
    finally:
        sys.settrace(before)


class _Watcher:
    """Builds the tree of calls from what the interpreter reports."""

    def __init__(self, say: Say | None) -> None:
        self.root = RetailCall("", "")
        self._stack = [self.root]
        self._say = say

    def call(self, frame: FrameType, _event: str, _value: object) -> Tracer | None:
        """Take the beginning of a call; only those of the oracle are followed."""
        code = frame.f_code
        if not _is_oracle(code.co_filename):
            return None
        source = _retail_source(code)
        if source is None:
            return _Lines(self._stack[-1], statements_of(code.co_filename)).event
        if len(self._stack) == 1 and self._say is not None:
            self._say(f"{len(self.root.items)} calls and steps watched")
        made = RetailCall(*source)
        self._stack[-1].items.append(made)
        self._stack.append(made)
        return _Lines(made, statements_of(code.co_filename), self._end).event

    def _end(self, value: object) -> None:
        self._stack.pop().returned = _shown(value)


class _Lines:
    """Follows the lines of one frame; parts of a function of retail add to the call that they belong to."""

    def __init__(
        self, call: RetailCall, statements: dict[int, Statement], end: Callable[[object], None] | None = None
    ) -> None:
        self._call = call
        self._statements = statements
        self._end = end
        self._last: Statement | None = None
        self._open: Step | None = None

    def event(self, frame: FrameType, event: str, value: object) -> Tracer:
        """Take a line, or the end of the frame."""
        if event == "line":
            self._line(frame.f_lineno)
        elif event == "return":
            self._decide(0)
            if self._end is not None:
                self._end(value)
        return self.event

    def _line(self, number: int) -> None:
        statement = self._statements.get(number)
        if statement is self._last:
            return
        self._decide(number)
        self._last = statement
        if statement is not None and statement.label:
            step = Step(statement)
            self._call.items.append(step)
            self._open = step if statement.body else None

    def _decide(self, number: int) -> None:
        """Tell from where it goes on whether the open condition held; 0 is out of the function."""
        if self._open is not None and self._open.statement.body is not None:
            first, last = self._open.statement.body
            self._open.holds = first <= number <= last
            if self._open.statement.is_loop and not self._open.holds:
                self._forget_end(self._open)
        self._open = None

    def _forget_end(self, step: Step) -> None:
        """Drop the look for another item that ended a loop, unless the loop had none at all."""
        if any(item is not step and _is_of(item, step.statement) for item in self._call.items):
            self._call.items.remove(step)


def _is_of(item: Item, statement: Statement) -> bool:
    return isinstance(item, Step) and item.statement is statement


@functools.cache
def _is_oracle(file: str) -> bool:
    return Path(file).parent == ORACLE


@functools.cache
def _retail_source(code: CodeType) -> tuple[str, str] | None:
    """Read the docstring, which the compiler puts first among the constants."""
    docstring = code.co_consts[0] if code.co_consts else None
    found = _SOURCE.search(docstring) if isinstance(docstring, str) else None
    return (found[1], found[2] or "") if found else None


def _shown(value: object) -> str:
    if isinstance(value, Enum):
        return value.name
    return repr(value) if isinstance(value, bool | int | float) else ""
