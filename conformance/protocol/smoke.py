"""What is wrong with an engine's bridge: one step of the protocol after the other, the simplest first."""

from __future__ import annotations

import json
from dataclasses import dataclass
from enum import Enum
from typing import TYPE_CHECKING, Final, Self

from conformance.compare import differences
from conformance.protocol.dialects import write_outputs
from conformance.protocol.incoming import ReadTimeoutError
from conformance.protocol.messages import line_of
from conformance.protocol.probes import VECTORS, find_probes
from conformance.protocol.process import CommandError, EngineProcess, ProcessStartError
from conformance.protocol.replies import BadReplyError, outcome_of
from conformance.protocol.scenes import HeldScene, SceneSlots, run_line, scene_line
from conformance.protocol.session import EngineTroubleError, Session
from conformance.query import Errored, Result, Skipped
from conformance.report.text import summary_line

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Mapping
    from pathlib import Path

    from conformance.query import Outcome
    from conformance.vector_io import VectorRecord

BATCH: Final = 64
"""Messages that are sent before a reply is read, as the suite does."""
EXAMPLE_START: Final = (
    '{"seq":0,"result":{"version":1,"name":"my-engine 1.0","floats":"decimal",'
    '"ops":["polygon_make_plane"],"features":[]}}'
)
_UNKNOWN_OP: Final = "no_such_operation"
_REFUSAL: Final = f'to {_UNKNOWN_OP}, beside its seq: {{"skipped":{{"reason":"no operation {_UNKNOWN_OP}"}}}}'
_EACH_REPLY: Final = "one whole line for each message, in order"
_MOST_EXAMPLE: Final = 400
"""Characters of an expected reply that are shown."""


class Mark(Enum):
    """How a step ended."""

    OK = "ok"
    WRONG = "WRONG"
    NOTE = "note"
    """The bridge does what it must; something else deserves a look."""


@dataclass(frozen=True, slots=True)
class Finding:
    """What a step has shown.

    Attributes
    ----------
    mark : Mark
        Whether it is as it should be.
    step, said : str
        What was tried, and what came of it.
    expected : str
        A reply as it should have been, if it was not.
    """

    mark: Mark
    step: str
    said: str
    expected: str = ""


def examine(
    command: str, read_timeout: float, say: Callable[[str], None], *, vectors: Path = VECTORS
) -> Iterator[Finding]:
    """Try an engine's bridge, step by step; ends early where the next steps would mean nothing.

    Parameters
    ----------
    command : str
        Program and arguments.
    read_timeout : float
        Seconds within which a reply must come.
    say : callable
        Is told what is done, while it is done.
    vectors : Path
        The folder of vector files whose records are asked.
    """
    try:
        examination = _Examination(command, read_timeout)
    except (CommandError, ProcessStartError) as error:
        yield Finding(Mark.WRONG, "start", str(error), "a program that can be run from this folder")
        return
    except EngineTroubleError as error:
        yield Finding(Mark.WRONG, "handshake", str(error).removeprefix("handshake: "), EXAMPLE_START)
        return
    with examination:
        yield from examination.findings(say, vectors)


class _SecondStartError(Exception):
    """An engine that could be started, and cannot be started again."""


class _Examination:
    def __init__(self, command: str, read_timeout: float) -> None:
        self._command = command
        self._timeout = read_timeout
        self._session = Session(command, read_timeout)
        self._slots = SceneSlots()
        self._told: set[str] = set()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self._session.kill()

    def findings(self, say: Callable[[str], None], vectors: Path) -> Iterator[Finding]:
        said = self._session.capabilities
        counts = f"{len(said.ops)} operations, {len(said.features)} features, floats {said.floats}"
        yield Finding(Mark.OK, "handshake", f"{said.name}: {counts}")
        if not said.ops:
            yield Finding(Mark.WRONG, "handshake", "no operation is declared", EXAMPLE_START)
            return
        probes = find_probes(said, say, vectors)
        steps: tuple[tuple[str, Callable[[], Iterator[Finding]], str], ...] = (
            ("operations", lambda: self._operations(probes), _EACH_REPLY),
            ("fresh answers", lambda: self._stale(probes), _EACH_REPLY),
            ("scenes", lambda: self._replaced_scene(probes), _EACH_REPLY),
            ("batch", lambda: self._batch(probes), _EACH_REPLY),
            ("unknown operation", self._unknown_operation, _REFUSAL),
            ("stop", self._stop, "one reply, nothing after it, and exit status 0"),
            ("end of stdin", self._end_of_input, "silence, and the end of the process"),
        )
        try:
            for step_name, step, expected in steps:
                yield from self._taken(step_name, step, expected)
        except _SecondStartError as error:
            yield Finding(Mark.WRONG, "handshake", str(error), EXAMPLE_START)

    def _taken(self, name: str, step: Callable[[], Iterator[Finding]], expected: str) -> Iterator[Finding]:
        """Take a step; a fault that was told before is not told again."""
        try:
            yield from step()
        except EngineTroubleError as error:
            if str(error) in self._told:
                yield Finding(Mark.NOTE, name, "not seen: the engine fails as above")
            else:
                self._told.add(str(error))
                yield Finding(Mark.WRONG, name, str(error), expected)
            self._restart(error)

    def _restart(self, after: EngineTroubleError) -> None:
        self._session.kill()
        self._slots.clear()
        try:
            self._session = Session(self._command, self._timeout)
        except EngineTroubleError as error:
            again = str(error).removeprefix("handshake: ")
            raise _SecondStartError(f"{after.what}; started anew: {again}") from error

    def _operations(self, probes: Mapping[str, list[VectorRecord]]) -> Iterator[Finding]:
        """Ask each operation alone."""
        right = []
        declared = self._session.capabilities.ops
        unasked = [op for op in declared if not probes.get(op)]
        if unasked:
            said = f"no shipped record asks these within the declared features: {', '.join(unasked)}"
            yield Finding(Mark.NOTE, "operations", said)
        for op in declared:
            if op in unasked:
                continue
            findings = [self._operation(record) for record in probes[op]]
            worst = next((found for found in findings if found and found.mark is Mark.WRONG), None)
            found = worst or next((found for found in findings if found), None)
            if found is None:
                right.append(op)
            else:
                yield found
        mark = Mark.OK if right else Mark.NOTE
        count = f"{len(right)} of {len(declared) - len(unasked)}"
        yield Finding(mark, "operations", f"{count} answer as retail does: {', '.join(right) or 'none'}")

    def _operation(self, record: VectorRecord) -> Finding | None:
        op = record.query.op
        example = self._example(record)
        try:
            outcome = self._ask(record)
        except BadReplyError as error:
            return Finding(Mark.WRONG, op, str(error), example)
        except EngineTroubleError as error:
            self._told.add(str(error))
            self._restart(error)
            return Finding(Mark.WRONG, op, str(error), example)
        match outcome:
            case Skipped(reason):
                return Finding(Mark.WRONG, op, f"it is declared, but skipped: {reason}", example)
            case Errored(context):
                return Finding(Mark.WRONG, op, f"it is declared, but fails: {context}", example)
            case Result(fields):
                found = differences(record.expected, fields, op=op, zero_signs="equal")
                said = f"{record.id}: {summary_line(found[0], 'engine')}" if found else ""
                return Finding(Mark.NOTE, op, said) if found else None

    def _stale(self, probes: Mapping[str, list[VectorRecord]]) -> Iterator[Finding]:
        """Ask two queries whose answers differ, each twice: an engine that lags differs from itself."""
        for records in probes.values():
            if len(records) < 2:
                continue
            first, second = records[:2]
            asked = (first, first, second, second)
            _, before, after, later = (self._ask_quietly(record) for record in asked)
            if isinstance(before, Result) and _alike(before, after) and not _alike(after, later):
                said = f"{second.query.op}: {second.id} has the answer of {first.id}, which was asked before"
                yield Finding(Mark.WRONG, "fresh answers", said, self._example(second))
                return
        yield Finding(Mark.OK, "fresh answers", "no answer is that of the query before")

    def _replaced_scene(self, probes: Mapping[str, list[VectorRecord]]) -> Iterator[Finding]:
        """Send a scene under the id of another, and ask in it."""
        pair = next(filter(None, map(_two_scenes, probes.values())), None)
        if pair is None:
            yield Finding(Mark.NOTE, "scenes", "no operation that is declared has a scene")
            return
        first, second = pair
        alone = self._ask_quietly(second)
        self._ask_quietly(first, scene_id="again")
        replaced = self._ask_quietly(second, scene_id="again")
        if _alike(replaced, alone):
            yield Finding(Mark.OK, "scenes", "a scene replaces the one that had its id")
        else:
            said = f"{second.query.op}: {second.id} has another answer in a scene whose id was used before"
            yield Finding(
                Mark.WRONG, "scenes", said, "a scene under an id that is in use replaces the old one"
            )

    def _batch(self, probes: Mapping[str, list[VectorRecord]]) -> Iterator[Finding]:
        """Send many queries before a reply is read."""
        records = [record for several in probes.values() for record in several][:BATCH]
        records = (records * BATCH)[:BATCH]
        sent = [seq for record in records for seq in self._send(record)]
        for seq in sent:
            self._session.receive(seq)
        yield Finding(Mark.OK, "batch", f"{len(sent)} messages at once are answered in order")

    def _unknown_operation(self) -> Iterator[Finding]:
        seq = self._session.number()
        self._session.send(line_of({"cmd": "run", "seq": seq, "op": _UNKNOWN_OP, "inputs": {}}))
        reply = self._session.receive(seq)
        if "result" in reply:
            yield Finding(Mark.WRONG, "unknown operation", "it has a result", _REFUSAL)
        else:
            yield Finding(Mark.OK, "unknown operation", "it is refused, and the engine goes on")

    def _stop(self) -> Iterator[Finding]:
        self._session.stop()
        yield Finding(Mark.OK, "stop", "it replies, says nothing more and ends with exit status 0")

    def _end_of_input(self) -> Iterator[Finding]:
        """See that an engine does not outlive a suite that was broken off."""
        process = EngineProcess(self._command)
        process.close_input()
        try:
            ended = process.receive(self._timeout) == b"" and process.wait(self._timeout) is not None
        except ReadTimeoutError:
            ended = False
        finally:
            process.kill()
        if ended:
            yield Finding(Mark.OK, "end of stdin", "the engine ends")
        else:
            said = "the engine does not end when its stdin does, or writes without being asked"
            yield Finding(Mark.WRONG, "end of stdin", said, "silence, and the end of the process")

    def _ask(self, record: VectorRecord, scene_id: str = "") -> Outcome:
        """Ask a query; raises `BadReplyError` for a result that is not of its shape."""
        *scenes, run = self._send(record, scene_id)
        for seq in scenes:
            self._session.receive(seq)
        reply = self._session.receive(run)
        return outcome_of(reply, record.query.op, self._session.capabilities.floats)

    def _ask_quietly(self, record: VectorRecord, scene_id: str = "") -> Outcome:
        try:
            return self._ask(record, scene_id)
        except BadReplyError as error:
            return Errored(str(error))  # told once, with its operation

    def _send(self, record: VectorRecord, scene_id: str = "") -> list[int]:
        """Send a query, its scene first if it needs one, and return the numbers of the messages."""
        query, dialect = record.query, self._session.capabilities.floats
        scene, is_new = self._slots.find(query)
        if scene is not None and scene_id:
            scene, is_new = HeldScene(scene_id, scene.geometries, scene.world), True
        sent = []
        if scene is not None and is_new:
            sent.append(self._session.number())
            self._session.send(scene_line(scene, sent[-1], dialect))
        sent.append(self._session.number())
        self._session.send(run_line(query, scene, sent[-1], dialect))
        return sent

    def _example(self, record: VectorRecord) -> str:
        """Write the reply that retail would give."""
        result = write_outputs(record.query.op, record.expected, self._session.capabilities.floats)
        text = json.dumps({"result": result}, separators=(",", ":"))
        shown = text if len(text) <= _MOST_EXAMPLE else f"{text[:_MOST_EXAMPLE]}..."
        return f"to {record.id}, beside its seq: {shown}"


def _alike(one: Outcome, other: Outcome) -> bool:
    """Tell whether two answers are the same on every bit; by `==` no NaN would be."""
    return repr(one) == repr(other)


def _two_scenes(records: list[VectorRecord]) -> tuple[VectorRecord, VectorRecord] | None:
    """Return two queries of one operation with different geometry, if there are two."""
    for record in records[1:]:
        first = records[0].query.geometries
        if first and record.query.geometries.keys() != first.keys():
            return records[0], record
    return None
