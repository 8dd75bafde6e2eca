"""Answering the protocol for a candidate of this package: what `conformance serve` does."""

from __future__ import annotations

from dataclasses import dataclass
from importlib import metadata
from typing import TYPE_CHECKING, Any, Final

from pydantic import ValidationError

from conformance.candidates.table import describe
from conformance.inputs import read_block
from conformance.json_reading import read_json
from conformance.outputs import OUTPUTS
from conformance.protocol.dialects import read_bits, write_outputs
from conformance.protocol.features import FEATURES
from conformance.protocol.messages import MESSAGE, VERSION, Run, Scene, Start, Stop, line_of
from conformance.query import Result, Skipped
from conformance.scenes.model import Geometry
from conformance.vector_io import query_from_record

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping
    from typing import BinaryIO

    from conformance.candidates.base import Candidate
    from conformance.protocol.dialects import Dialect
    from conformance.query import Outcome

_DISTRIBUTION: Final = "retail-conformance"


@dataclass(frozen=True, slots=True)
class _Held:
    """A scene that the suite has sent."""

    geometries: Mapping[str, Geometry]
    worlds: Mapping[str, Any]


_NOTHING: Final = _Held({}, {})


class Server:
    """Answers messages with a candidate.

    Parameters
    ----------
    candidate : Candidate
        Who performs the operations.
    dialect : {"decimal", "hex"}
        How floats are written.
    """

    def __init__(self, candidate: Candidate, dialect: Dialect = "decimal") -> None:
        self._candidate = candidate
        self._dialect: Dialect = dialect
        self._scenes: dict[str, _Held] = {}

    def serve(self, lines: Iterable[bytes], replies: BinaryIO) -> None:
        """Reply to every line until one says stop, or there are no more."""
        for line in lines:
            seq, body, stops = self._reply(line)
            replies.write(line_of({"seq": seq, **body}))
            replies.flush()
            if stops:
                return

    def _reply(self, line: bytes) -> tuple[int | None, dict[str, Any], bool]:
        """Return the number and the body of the reply to a line, and whether it is the last."""
        seq: int | None = None
        try:
            record = read_json(line.decode("utf-8"))
            seq = record["seq"] if isinstance(record, dict) and isinstance(record.get("seq"), int) else None
            message = MESSAGE.validate_python(record)
            return seq, self._body(message), isinstance(message, Stop)
        except ValidationError as error:
            return seq, _errored(_first_mistake(error)), False
        except Exception as error:  # noqa: BLE001 - whatever a message does, the next one is answered
            return seq, _errored(describe(error)), False

    def _body(self, message: Start | Scene | Run | Stop) -> dict[str, Any]:
        match message:
            case Start():
                return self._start(message)
            case Scene():
                self._scenes[message.id] = self._read_scene(message)
                return {"result": {}}
            case Run():
                return self._run(message)
            case Stop():
                return {"result": {}}

    def _start(self, message: Start) -> dict[str, Any]:
        if message.version != VERSION:
            return _errored(f"found protocol version {message.version}, expected {VERSION}")
        if self._dialect not in message.floats:
            return _errored(f"found the floats {', '.join(message.floats)}, expected {self._dialect}")
        return {
            "result": {
                "version": VERSION,
                "name": f"{self._candidate.name} of {_DISTRIBUTION} {_own_version()}",
                "floats": self._dialect,
                "ops": list(OUTPUTS),
                "features": list(FEATURES),
            }
        }

    def _read_scene(self, message: Scene) -> _Held:
        # What the suite sends has been checked where it was read; some of it is wrong on purpose.
        geometries = [Geometry.from_record(self._read(record)) for record in message.geometries]
        world = None if message.world is None else read_block(self._read(message.world))
        return _Held(
            {geometry.name: geometry for geometry in geometries},
            {} if world is None else {world["name"]: world},
        )

    def _run(self, message: Run) -> dict[str, Any]:
        held = _NOTHING if message.scene is None else self._scenes.get(message.scene)
        if held is None:
            sent = ", ".join(self._scenes) or "none yet"
            return _errored(f"found the scene {message.scene!r}, expected one that was sent: {sent}")
        record = {"op": message.op, **self._read(message.inputs)}
        query = query_from_record(record, held.geometries, worlds=held.worlds, label=message.label)
        return outcome_body(message.op, self._candidate.answer(query), self._dialect)

    def _read(self, record: dict[str, Any]) -> dict[str, Any]:
        read: dict[str, Any] = read_bits(record) if self._dialect == "hex" else record
        return read


def outcome_body(op: str, outcome: Outcome, dialect: Dialect) -> dict[str, Any]:
    """Return the body of the reply that tells an outcome."""
    if isinstance(outcome, Result):
        return {"result": write_outputs(op, outcome.fields, dialect)}
    if isinstance(outcome, Skipped):
        return {"skipped": {"reason": outcome.reason}}
    return _errored(outcome.context)


def _errored(context: str) -> dict[str, Any]:
    return {"errored": {"context": context}}


def _first_mistake(error: ValidationError) -> str:
    first = error.errors()[0]
    where = ".".join(str(part) for part in first["loc"])
    return f"{where}: found {first['input']!r:.80}, expected: {first['msg']}"


def _own_version() -> str:
    try:
        return metadata.version(_DISTRIBUTION)
    except metadata.PackageNotFoundError:
        return "(not installed)"
