"""Our own side of the protocol."""

from __future__ import annotations

import io
import json
from typing import TYPE_CHECKING, Any

import pytest
from faux import serve_command
from shipped_cases import shipped_cases
from shipped_vectors import one_of_each

from conformance.candidates.command_candidate import CommandCandidate
from conformance.candidates.engine_candidate import EngineCandidate
from conformance.candidates.oracle_candidate import OracleCandidate
from conformance.outputs import OUTPUTS
from conformance.protocol.dialects import DIALECTS
from conformance.protocol.messages import line_of
from conformance.protocol.replies import outcome_of, read_reply
from conformance.protocol.scenes import SceneSlots, run_line, scene_line
from conformance.protocol.server import Server
from conformance.protocol.session import read_capabilities
from conformance.query import Errored, Result, Skipped

if TYPE_CHECKING:
    from conformance.protocol.dialects import Dialect
    from conformance.query import Outcome, Query

START = {"cmd": "start", "seq": 0, "version": 1, "floats": ["decimal", "hex"]}
SECONDS = 600.0
"""An engine may have to compile its kernels first."""


def served(*messages: dict[str, Any] | bytes, dialect: Dialect = "decimal") -> list[dict[str, Any]]:
    """Return the replies to messages, or to lines that are none."""
    lines = [message if isinstance(message, bytes) else line_of(message) for message in messages]
    replies = io.BytesIO()
    Server(OracleCandidate(), dialect).serve(lines, replies)
    return [json.loads(line) for line in replies.getvalue().splitlines()]


def context(reply: dict[str, Any]) -> str:
    """Return what went wrong."""
    assert set(reply) == {"seq", "errored"}
    text: str = reply["errored"]["context"]
    return text


@pytest.mark.parametrize("dialect", DIALECTS)
def test_every_operation_is_answered_as_in_process(dialect: Dialect) -> None:
    """Of each operation and outcome one record, on every bit."""
    slots, asked = SceneSlots(), []
    messages: list[dict[str, object] | bytes] = [START]
    for record in one_of_each():
        scene, is_new = slots.find(record.query)
        if scene is not None and is_new:
            messages.append(scene_line(scene, len(messages), dialect))
        messages.append(run_line(record.query, scene, len(messages), dialect))
        asked.append((len(messages) - 1, record.query))
    replies = served(*messages, dialect=dialect)
    assert [reply["seq"] for reply in replies] == list(range(len(messages)))
    assert read_capabilities(replies[0]["result"]).ops == list(OUTPUTS)
    oracle = OracleCandidate()
    for seq, query in asked:
        reply = read_reply(line_of(replies[seq]), seq)
        assert repr(outcome_of(reply, query.op, dialect)) == repr(tidy(oracle.answer(query)))


def tidy(outcome: Outcome) -> Outcome:
    """Return an outcome in lists, as JSON has them."""
    return Result(json.loads(json.dumps(outcome.fields))) if isinstance(outcome, Result) else outcome


def test_our_engine_through_its_own_door() -> None:
    """What runs in another process answers as what runs in this one, skips the same, and says the same."""
    queries = [case.queries[0] for case in list(shipped_cases().values())[::7]]
    assert len(queries) > 150
    remote = CommandCandidate(serve_command("--candidate", "engine"), read_timeout=SECONDS)
    remote.ask_ahead(queries)
    engine = EngineCandidate()
    for query in queries:
        given, own = remote.answer(query), tidy(engine.answer(query))
        if isinstance(own, Skipped):
            own = Skipped(f"operation {query.op} is declared, but skipped: {own.reason}")
        assert repr(given) == repr(own), query.label
    session = remote._session
    assert session is not None
    assert session.capabilities.name.startswith("engine of retail-conformance ")
    assert remote.close() == ()


def test_what_cannot_be_read_is_told_and_the_next_line_answered() -> None:
    """Each line has a reply; the number is that of the message, if it has one."""
    replies = served(
        b"{\n",
        b"\xff\n",
        {"cmd": "go", "seq": 3},
        {"cmd": "run", "seq": 4, "op": "block_offset", "inputs": {}, "speed": 1},
        {"cmd": "run", "seq": 5, "op": "block_offset", "inputs": {"from_cell": 1}},
        {"cmd": "run", "seq": 6, "op": "polygon_make_plane", "inputs": {}, "scene": "s9"},
        {"cmd": "scene", "seq": 7, "id": "s0", "geometries": [{"name": "floor"}]},
        {"cmd": "run", "seq": 8, "op": "block_offset", "inputs": {"from_cell": 1, "to_cell": 1}},
    )
    assert [reply["seq"] for reply in replies] == [None, None, 3, 4, 5, 6, 7, 8]
    assert context(replies[0]).startswith("JSONDecodeError: ")
    assert context(replies[1]).startswith("UnicodeDecodeError: ")
    assert "does not match any of the expected tags" in context(replies[2])
    assert context(replies[3]).startswith("run.speed: found 1, expected: Extra inputs are not permitted")
    assert context(replies[4]).startswith(
        "FieldError: to_cell: found nothing, expected an input of block_offset"
    )
    assert context(replies[5]) == "found the scene 's9', expected one that was sent: none yet"
    assert context(replies[6]).startswith("KeyError: ")
    assert replies[7] == {"seq": 8, "result": {"v": [0.0, 0.0, 0.0]}}


def test_a_message_says_everything_once() -> None:
    """A key twice, at any depth: which of the two counts is not guessed."""
    twice = b'{"cmd":"run","seq":1,"op":"block_offset","inputs":{"from_cell":1,"to_cell":1,"to_cell":2}}\n'
    (reply,) = served(twice)
    assert "found the key 'to_cell' twice in an object, expected each key once" in context(reply)


def test_an_input_written_as_minus_zero_is_negative() -> None:
    """`-0`, as .NET and Go write it, keeps its sign on the way in."""
    (reply,) = served(b'{"cmd":"run","seq":1,"op":"normalize_check_small","inputs":{"v":[2,-0,0]}}\n')
    assert repr(reply["result"]["v"]) == "[1.0, -0.0, 0.0]"


def test_another_version_is_refused() -> None:
    """And floats that the suite does not read."""
    (version,) = served({**START, "version": 2})
    assert context(version) == "found protocol version 2, expected 1"
    (floats,) = served({**START, "floats": ["decimal"]}, dialect="hex")
    assert context(floats) == "found the floats decimal, expected hex"


def test_nothing_follows_the_stop() -> None:
    """The loop ends with the reply."""
    stop = {"cmd": "stop", "seq": 1}
    assert served(START, stop, stop)[1:] == [{"seq": 1, "result": {}}]


class Moody:
    """Does not do what it is asked, in two ways."""

    name = "moody"

    def answer(self, query: Query) -> Skipped | Errored:
        """Skip, or fail."""
        return Skipped("not today") if query.label == "skip" else Errored("no cells")


def test_the_other_outcomes_are_told() -> None:
    """A reason and a context."""
    run = {"cmd": "run", "op": "block_offset", "inputs": {"from_cell": 1, "to_cell": 1}}
    replies = io.BytesIO()
    lines = [line_of({**run, "seq": 0, "label": "skip"}), line_of({**run, "seq": 1})]
    Server(Moody()).serve(lines, replies)
    assert [json.loads(line) for line in replies.getvalue().splitlines()] == [
        {"seq": 0, "skipped": {"reason": "not today"}},
        {"seq": 1, "errored": {"context": "no cells"}},
    ]
