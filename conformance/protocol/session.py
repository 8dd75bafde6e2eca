"""One run of an engine, from the handshake to the stop: messages out, the replies to them in."""

from __future__ import annotations

from difflib import get_close_matches
from typing import TYPE_CHECKING, Any, Final

from pydantic import ValidationError

from conformance.fields import UnknownOperationError
from conformance.outputs import OUTPUTS
from conformance.protocol.dialects import DIALECTS
from conformance.protocol.features import FEATURES
from conformance.protocol.incoming import ReadTimeoutError
from conformance.protocol.messages import VERSION, Capabilities, line_of
from conformance.protocol.process import EngineProcess, describe_exit
from conformance.protocol.replies import BadReplyError, read_reply, shown

if TYPE_CHECKING:
    from collections.abc import Collection

    from pydantic_core import ErrorDetails

READ_SECONDS: Final = 30.0
"""How long an engine may take for a reply, unless it is told otherwise."""
START_READS: Final = 4
"""How many times as long it may take for the first: it may have to compile or load something."""
_LOG_LINES: Final = 10
"""Lines of an engine's log that are shown with its failure."""


class EngineTroubleError(Exception):
    """An engine has ended, hung or replied badly, and must be started anew; its log's end is told."""

    def __init__(self, what: str, log: str = "") -> None:
        self.what = what
        tail = "".join(f"\n    stderr: {line}" for line in log.splitlines()[-_LOG_LINES:])
        super().__init__(what + tail)


class EngineHungError(EngineTroubleError):
    """An engine has not replied in time, and nobody knows whether it ever would have."""


class Session:
    """An engine that was started and has introduced itself.

    Attributes
    ----------
    capabilities : Capabilities
        What it says about itself.
    ops, features : frozenset of str
        What it has declared, to be looked up for each query.

    Raises
    ------
    CommandError, ProcessStartError
        If its program cannot be run.
    EngineTroubleError
        If the handshake fails.
    """

    def __init__(self, command: str, read_timeout: float) -> None:
        self._timeout = read_timeout
        self._process = EngineProcess(command)
        self._next = 0
        try:
            self.capabilities = self._introduced()
        except BaseException:
            self._process.kill()
            raise
        self.ops = frozenset(self.capabilities.ops)
        self.features = frozenset(self.capabilities.features)

    def number(self) -> int:
        """Return the number of the next message."""
        self._next += 1
        return self._next - 1

    def send(self, line: bytes) -> None:
        """Send a message, at the latest when a reply is awaited."""
        self._process.send(line)

    def flush(self) -> None:
        """Let the engine begin with what was sent."""
        self._process.flush()

    def receive(self, seq: int, *, reads: int = 1) -> dict[str, Any]:
        """Return the reply to a message; raises `EngineTroubleError`."""
        seconds = self._timeout * reads
        try:
            line = self._process.receive(seconds)
        except ReadTimeoutError as error:
            self._process.kill()
            why = f"no reply within {seconds:g} s (--read-timeout)"
            if error.begun:
                why += f", but {shown(error.begun)} without a line end"
            raise EngineHungError(why, self._process.log()) from None
        if not line:
            status = self._process.wait(self._timeout)
            raise self.trouble(f"the engine {describe_exit(status)} before it replied")
        try:
            return read_reply(line, seq)
        except BadReplyError as error:
            raise self.trouble(str(error)) from None

    def trouble(self, what: str) -> EngineTroubleError:
        """End the engine, and return what is wrong with it and what it has logged."""
        self._process.kill()
        return EngineTroubleError(what, self._process.log())

    def stop(self) -> None:
        """Ask the engine to stop, and see that it does; raises `EngineTroubleError`."""
        seq = self.number()
        self.send(line_of({"cmd": "stop", "seq": seq}))
        try:
            if "result" not in self.receive(seq):
                raise self.trouble("the engine does not stop when it is asked to")
            self._end()
        finally:
            self._process.kill()

    def kill(self) -> None:
        """End the engine without asking."""
        self._process.kill()

    def _end(self) -> None:
        """See that nothing follows the last reply, and that the exit status says so."""
        self._process.close_input()
        try:
            line = self._process.receive(self._timeout)
        except ReadTimeoutError:
            raise self.trouble(self._running_on()) from None
        if line:
            raise self.trouble(f"the engine writes on after its last reply: {line[:120]!r}")
        status = self._process.wait(self._timeout)
        if status != 0:
            raise self.trouble(f"the engine {describe_exit(status)} when it was stopped, expected 0")

    def _running_on(self) -> str:
        """Say what goes on though the engine was stopped: it, or what it has started and left behind."""
        late = f"{self._timeout:g} s after it was stopped"
        if self._process.wait(0.0) is None:
            return f"the engine still runs {late}"
        return f"the engine has ended, but a program that it started holds its stdout open {late}"

    def _introduced(self) -> Capabilities:
        seq = self.number()
        self.send(line_of({"cmd": "start", "seq": seq, "version": VERSION, "floats": list(DIALECTS)}))
        try:
            reply = self.receive(seq, reads=START_READS)
        except EngineTroubleError as error:
            raise EngineTroubleError(f"handshake: {error}") from None
        if "result" not in reply:
            said = reply.get("errored", reply.get("skipped"))
            raise self.trouble(f"handshake: the engine refuses to start: {said}")
        try:
            return read_capabilities(reply["result"])
        except BadReplyError as error:
            raise self.trouble(f"handshake: {error}") from None


def read_capabilities(result: dict[str, Any]) -> Capabilities:
    """Read the result of `start`.

    Raises
    ------
    BadReplyError
        If a field is missing, unknown or of another kind, or names what there is not.
    """
    try:
        capabilities = Capabilities.model_validate(result)
    except ValidationError as error:
        first = error.errors()[0]
        where = ".".join(str(part) for part in ("result", *first["loc"]))
        found = "nothing" if first["type"] == "missing" else repr(first["input"])[:80]
        raise BadReplyError(f"{found} at {where}", _expected_field(first)) from None
    if capabilities.version != VERSION:
        raise BadReplyError(f"version {capabilities.version}", f"version {VERSION}")
    for op in capabilities.ops:
        if op not in OUTPUTS:
            raise BadReplyError(str(UnknownOperationError(op)), "operations of FORMAT.md at result.ops")
    for feature in capabilities.features:
        if feature not in FEATURES:
            raise BadReplyError(f"the feature {feature!r}", _expected_feature(feature, FEATURES))
    return capabilities


def _expected_field(error: ErrorDetails) -> str:
    """Say what a field of the capabilities must be, in the words of the other messages."""
    match error["type"]:
        case "missing":
            return "a value"
        case "extra_forbidden":
            return f"one of {', '.join(Capabilities.model_fields)}"
        case _:
            return error["msg"].removeprefix("Input should be ")


def _expected_feature(feature: str, known: Collection[str]) -> str:
    nearest = get_close_matches(feature, known, n=1)
    meant = f"perhaps {nearest[0]!r}; " if nearest else ""
    return f"{meant}features are {', '.join(known)}"
