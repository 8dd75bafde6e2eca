"""Noticing what interpreted kernels write into a row of state, and making a trace of it."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from inspect import currentframe
from typing import TYPE_CHECKING, Any, Final, NamedTuple, TypeAlias

import numpy as np
import numpy.typing as npt

from engine import layout as at
from engine.constants import STATE_NAMES
from engine.kernels.query import clear
from engine.kernels.trace import trace_close, trace_open
from engine.tracing_frames import OUTSIDE, running, statement_of
from engine.tracing_interpreter import Interpreter
from engine.tracing_writes import (
    BSP,
    CELL_TRANSIT,
    CONTACT_PLANE,
    LAST_KNOWN_PLANE,
    SLIDING,
    STATE,
    WALKABLE,
    BspCall,
    Write,
    WriteTrace,
)

if TYPE_CHECKING:
    from collections.abc import Collection
    from types import FrameType

    from engine.kernels.types import Array, Ints
    from engine.tracing_writes import Value

NUMBERS: Final = "numbers"
INTEGER: Final = "integer"
POLYGON: Final = "polygon"
CELL: Final = "cell"


class _Field(NamedTuple):
    """A watched field: where it lies in the row, how long it is, what it is called and what it holds."""

    offset: int
    size: int
    topic: str
    label: str
    kind: str


_FIELDS: Final = tuple(
    _Field(int(offset), int(size), topic, label, kind)
    for offset, size, topic, label, kind in (
        (at.CONTACT_VALID, 1, CONTACT_PLANE, "ContactPlaneValid", INTEGER),
        (at.CONTACT_PLANE, at.PLANE_SIZE, CONTACT_PLANE, "ContactPlane", NUMBERS),
        (at.CONTACT_CELL_ID, 1, CONTACT_PLANE, "ContactPlaneCellId", INTEGER),
        (at.CONTACT_IS_WATER, 1, CONTACT_PLANE, "ContactPlaneIsWater", INTEGER),
        (at.LAST_KNOWN_VALID, 1, LAST_KNOWN_PLANE, "LastKnownContactPlaneValid", INTEGER),
        (at.LAST_KNOWN_PLANE, at.PLANE_SIZE, LAST_KNOWN_PLANE, "LastKnownContactPlane", NUMBERS),
        (at.LAST_KNOWN_CELL_ID, 1, LAST_KNOWN_PLANE, "LastKnownContactPlaneCellId", INTEGER),
        (at.LAST_KNOWN_IS_WATER, 1, LAST_KNOWN_PLANE, "LastKnownContactPlaneIsWater", INTEGER),
        (at.WALKABLE, 1, WALKABLE, "Walkable", POLYGON),
        (at.SLIDING_VALID, 1, SLIDING, "SlidingNormalValid", INTEGER),
        (at.SLIDING_NORMAL, at.VECTOR_SIZE, SLIDING, "SlidingNormal", NUMBERS),
        (at.OI_STATE, 1, STATE, "State", INTEGER),
        (at.CURR_CELL, 1, CELL_TRANSIT, "CurrCell", CELL),
    )
)

Numbers: TypeAlias = npt.NDArray[np.float64]


class WatchedRow(np.ndarray[Any, np.dtype[np.float64]]):
    """A row of state that tells its recorder where it is about to be written.

    Attributes
    ----------
    recorder : Recorder
        Set by who makes the row.
    """

    recorder: Recorder

    def __setitem__(self, index: Any, value: Any) -> None:
        """Write one number."""
        self.recorder.before_write(index, currentframe())
        super().__setitem__(index, value)


def _clear(row: WatchedRow) -> None:
    """Begin a transition; that the fields of the last one are cleared is no write."""
    row.recorder.begin_transition()
    _interpreter().unreplaced(clear)(np.asarray(row))


def _open(wi: Ints, row: WatchedRow, letter: int) -> None:
    """Take the opening of a call, which is told by the kernel that is called."""
    _interpreter().unreplaced(trace_open)(wi, np.asarray(row), letter)
    frame = currentframe()
    called = frame and frame.f_back
    row.recorder.open_call(chr(letter), OUTSIDE if called is None else running(called))


def _close(wi: Ints, row: WatchedRow, result: int) -> None:
    """Take the result of the innermost call."""
    _interpreter().unreplaced(trace_open)(wi, np.asarray(row), ord(str(result)))
    row.recorder.close_call(STATE_NAMES[result])


@cache
def _interpreter() -> Interpreter:
    """Return the one interpreter of all recorders: which of them is meant is told by the row."""
    return Interpreter({clear: _clear, trace_open: _open, trace_close: _close})


@dataclass(frozen=True, slots=True)
class _Pending:
    """A write that is going on."""

    field: _Field
    before: Numbers
    caller: str
    call: BspCall | None
    foot: tuple[float, ...] | None


class Recorder:
    """Runs kernels interpreted, and makes a trace of what they write.

    Attributes
    ----------
    trace : WriteTrace
        Complete between two runs.
    """

    def __init__(self, topics: Collection[str]) -> None:
        self.trace = WriteTrace()
        self._calls_asked = BSP in topics
        self._at: Final = {
            field.offset + i: field for field in _FIELDS if field.topic in topics for i in range(field.size)
        }
        self._transition = 0
        self._calls: list[BspCall] = []
        self._pending: dict[_Field, _Pending] = {}
        self._statement: FrameType | None = None
        self._row: Array = np.zeros(0)
        self._world: tuple[Array, Ints] | None = None

    def run(self, kernel: Any, *arguments: Any) -> Any:
        """Run a kernel interpreted; what it writes into its row ``s`` is recorded.

        The kernel changes its arguments and returns what it returns when it is compiled.
        """
        names = kernel.py_func.__code__.co_varnames
        given: dict[str, Any] = {
            name: np.float64(value) if isinstance(value, float) else value
            for name, value in zip(names, arguments, strict=False)
        }
        self._world = (given["wf"], given["wi"]) if "wf" in given else None
        self._row = np.asarray(given["s"])
        self._row[at.PLAN] = 0.0
        watched = self._row.view(WatchedRow)
        watched.recorder = self
        try:
            with np.errstate(all="ignore"):
                return _interpreter().function(kernel)(*{**given, "s": watched}.values())
        finally:
            self._settle()
            self._calls.clear()

    def before_write(self, index: Any, frame: FrameType | None) -> None:
        """Note what a watched field is before it changes."""
        field = self._at.get(int(index))
        if field is None or frame is None:
            return
        statement = statement_of(frame)
        if statement is not self._statement:
            self._settle()
            self._statement = statement
        if field not in self._pending:
            self._pending[field] = _Pending(
                field, self._numbers(field), running(frame), self._call(), self._foot()
            )

    def begin_transition(self) -> None:
        """Count the next transition."""
        self._settle()
        self._transition += 1

    def open_call(self, letter: str, caller: str) -> None:
        """Take the opening of a call."""
        self._settle()
        call = BspCall(letter, caller, self._transition)
        self._calls.append(call)
        if self._calls_asked:
            self.trace.entries.append(call)

    def close_call(self, result: str) -> None:
        """Take the result of the innermost call."""
        self._settle()
        self._calls.pop().result = result

    def _settle(self) -> None:
        """Make writes of what is pending, of that which has changed."""
        for pending in self._pending.values():
            after = self._numbers(pending.field)
            if pending.before.tobytes() != after.tobytes():
                self._tell(pending, after)
        self._pending.clear()
        self._statement = None

    def _tell(self, pending: _Pending, after: Numbers) -> None:
        """Make an entry; that a mover comes to be in its first cell is no transit."""
        field = pending.field
        before = self._value(field, pending.before)
        if field.kind == CELL and before is None:
            return
        self.trace.entries.append(
            Write(
                field.topic,
                field.label,
                before,
                self._value(field, after),
                pending.caller,
                self._transition,
                pending.call,
                pending.foot,
            )
        )

    def _numbers(self, field: _Field) -> Numbers:
        return self._row[field.offset : field.offset + field.size].copy()

    def _value(self, field: _Field, numbers: Numbers) -> Value:
        if field.kind == NUMBERS:
            return tuple(numbers.tolist())
        number = int(numbers[0])
        if field.kind == INTEGER:
            return number
        if self._world is None or number == (at.NO_POLYGON if field.kind == POLYGON else at.NO_CELL):
            return None
        floats, ints = self._world
        if field.kind == POLYGON:
            return int(floats[number + at.POLYGON_ID])
        return int(floats[ints[at.WORLD_CELL_FLOATS] + at.CELL_FLOATS * number + at.CELL_ID])

    def _call(self) -> BspCall | None:
        return self._calls[-1] if self._calls else None

    def _foot(self) -> tuple[float, ...] | None:
        if self._row[at.CHECK_POS] == 0.0:
            return None
        low = at.GLOBAL_LOW_POINT
        return tuple(self._row[low : low + at.VECTOR_SIZE].tolist())
