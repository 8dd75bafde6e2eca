"""Reading what an engine writes: exactly one of a result, a reason to skip, and an error, or a bad reply."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any, Final

from conformance.fields import FieldError
from conformance.json_reading import LooseJsonError, read_json
from conformance.protocol.messages import MOST_BYTES
from conformance.protocol.readers import read_outputs
from conformance.query import Errored, Outcome, Result, Skipped

if TYPE_CHECKING:
    from conformance.protocol.dialects import Dialect

_BODIES: Final = ("result", "skipped", "errored")
_USUAL: Final = frozenset({"seq", "result"})
_MOST_SHOWN: Final = 120
"""Characters of a bad reply that are shown."""


class BadReplyError(Exception):
    """A line of an engine that is not the reply that was awaited.

    Attributes
    ----------
    found, expected : str
        What the line is, and what it should have been.
    """

    def __init__(self, found: str, expected: str) -> None:
        self.found = found
        self.expected = expected
        super().__init__(f"bad reply: found {found}, expected {expected}")


def read_reply(line: bytes, seq: int) -> dict[str, Any]:
    """Read the envelope of a reply.

    Parameters
    ----------
    line : bytes
        What the engine wrote, line end included.
    seq : int
        The number of the message that it must answer.

    Returns
    -------
    dict
        The reply; it has exactly one of ``result``, ``skipped`` and ``errored``.

    Raises
    ------
    BadReplyError
        If it is too long, not JSON, not a reply, or the reply to another message.
    """
    reply = _parsed(line)
    if not isinstance(reply, dict):
        raise BadReplyError(f"{shown(line)}, which is not an object", _example(seq))
    if not _is_usual(reply, seq):
        _check_envelope(reply, seq, line)
    return reply


def _is_usual(reply: dict[str, Any], seq: int) -> bool:
    """Tell whether a reply is a result without anything wrong, as nearly all are."""
    return (
        reply.keys() == _USUAL
        and type(reply["seq"]) is int
        and reply["seq"] == seq
        and isinstance(reply["result"], dict)
    )


def _check_envelope(reply: dict[str, Any], seq: int, line: bytes) -> None:
    bodies = [key for key in _BODIES if key in reply]
    others = [key for key in reply if key != "seq" and key not in _BODIES]
    if others:
        raise BadReplyError(f"the extra field {others[0]!r}", _example(seq))
    _check_sequence(reply, seq, line)
    if len(bodies) != 1:
        found = " and ".join(bodies) if bodies else f"neither of the three in {shown(line)}"
        raise BadReplyError(found, "exactly one of result, skipped, errored")
    _check_body(bodies[0], reply[bodies[0]])


def outcome_of(reply: dict[str, Any], op: str, dialect: Dialect) -> Outcome:
    """Read what a reply to `run` says.

    Raises
    ------
    BadReplyError
        If the result is not of the operation's shape.
    """
    if "skipped" in reply:
        return Skipped(reply["skipped"]["reason"])
    if "errored" in reply:
        return Errored(reply["errored"]["context"])
    try:
        return Result(read_outputs(op, reply["result"], dialect))
    except FieldError as error:
        where = f"result.{error.path}" if error.path else "result"
        raise BadReplyError(f"{error.found} at {where}", error.expected) from None


def _parsed(line: bytes) -> Any:
    if len(line) > MOST_BYTES:
        raise BadReplyError(
            f"a line of more than {MOST_BYTES} bytes, beginning {shown(line)}", "a shorter line"
        )
    if not line.endswith(b"\n"):
        raise BadReplyError(f"{shown(line)} without a line end", "whole lines")
    try:
        return read_json(line.decode("utf-8"))
    except UnicodeDecodeError as error:
        raise BadReplyError(f"bytes that are not UTF-8 at column {error.start + 1}", "UTF-8") from None
    except json.JSONDecodeError as error:
        found = f"{shown(line)}, which is not JSON ({error.msg}, column {error.colno})"
        raise BadReplyError(found, "one JSON object a line on stdout, and nothing else there") from None
    except LooseJsonError as error:
        raise BadReplyError(f"{error.found}: {shown(line)}", error.expected) from None
    except (ValueError, RecursionError) as error:
        raise BadReplyError(str(error), "JSON") from None


def _check_sequence(reply: dict[str, Any], seq: int, line: bytes) -> None:
    if "seq" not in reply:
        raise BadReplyError(f"no seq in {shown(line)}", f"seq {seq}")
    found = reply["seq"]
    if type(found) is not int:
        raise BadReplyError(f"seq {found!r}", f"seq {seq}, a whole number")
    if found < seq:
        raise BadReplyError(f"seq {found}, which has been answered before", f"seq {seq}")
    if found > seq:
        raise BadReplyError(f"seq {found}, which is not its turn", f"seq {seq}; replies come in order")


def _check_body(name: str, body: Any) -> None:
    key = "reason" if name == "skipped" else "context"
    if name == "result":
        right, expected = isinstance(body, dict), "result: an object"
    else:
        right = isinstance(body, dict) and set(body) == {key} and isinstance(body[key], str)
        expected = f'{name}: {{"{key}": a text}}'
    if not right:
        raise BadReplyError(f"{name}: {_cut(repr(body))}", expected)


def _example(seq: int) -> str:
    return f'{{"seq": {seq}, and one of "result", "skipped", "errored"}}'


def shown(line: bytes) -> str:
    """Return the beginning of what an engine wrote, as it may stand in a message."""
    text = line[: 4 * _MOST_SHOWN].decode("utf-8", errors="replace").rstrip("\r\n")
    return repr(_cut(text))


def _cut(text: str) -> str:
    return text if len(text) <= _MOST_SHOWN else text[: _MOST_SHOWN - 3] + "..."
