"""An engine in a process of its own as a candidate: ``cmd:./my-engine --flag``."""

from __future__ import annotations

from collections import deque
from dataclasses import dataclass
from typing import TYPE_CHECKING, Final

from conformance.candidates.registry import COMMAND_PREFIX
from conformance.protocol.features import undeclared
from conformance.protocol.process import CommandError, ProcessStartError, split_command
from conformance.protocol.replies import BadReplyError, outcome_of
from conformance.protocol.scenes import SceneSlots, run_line, scene_line
from conformance.protocol.session import READ_SECONDS, EngineHungError, EngineTroubleError, Session
from conformance.query import Errored, Skipped

if TYPE_CHECKING:
    from collections.abc import Sequence
    from typing import Any

    from conformance.protocol.dialects import Dialect
    from conformance.protocol.scenes import HeldScene
    from conformance.query import Outcome, Query

WINDOW: Final = 64
"""How many messages may be on their way at once: enough to keep an engine busy while retail is computed."""
MOST_FAILED_STARTS: Final = 3
"""After as many failed starts in a row the engine is not started any more."""
MOST_HANGS: Final = 10
"""After as many hangs with no answer between them it is not, either: each takes as long as a reply may."""


@dataclass(frozen=True, slots=True)
class _Sent:
    """A message that waits for its reply: a scene, or a query that needs one or none."""

    seq: int
    scene: HeldScene | None
    query: Query | None = None


class CommandCandidate:
    """Asks an engine over its stdin and stdout, and starts it again when it has failed.

    An engine that ends, hangs or replies badly has failed at the query whose reply was awaited; the queries
    that were sent after that are sent again to the next one. One that cannot be started, or hangs whatever
    it is asked, is given up.

    Parameters
    ----------
    command : str
        Program and arguments.
    read_timeout : float
        Seconds within which a reply must come.

    Raises
    ------
    CommandError
        If the command is empty or its quotation marks do not match.
    """

    def __init__(self, command: str, *, read_timeout: float = READ_SECONDS) -> None:
        split_command(command)
        self.name = COMMAND_PREFIX + command
        self._command = command
        self._read_timeout = read_timeout
        self._session: Session | None = None
        self._failed_starts = 0
        self._start_error: Exception | None = None
        self._hangs = 0
        self._slots = SceneSlots()
        self._wanted: set[Query] = set()
        self._waiting: deque[Query] = deque()
        self._sent: deque[_Sent] = deque()
        self._outcomes: dict[Query, Outcome] = {}

    def __repr__(self) -> str:
        return f"CommandCandidate({self._command!r})"

    def answer(self, query: Query) -> Outcome:
        """Return the engine's answer, which may have been asked for ahead."""
        if query not in self._wanted:
            self.ask_ahead((query,))
        while query not in self._outcomes:
            self._advance()
        self._wanted.discard(query)
        return self._outcomes.pop(query)

    def ask_ahead(self, queries: Sequence[Query]) -> None:
        """Send queries that will be asked next; answers to earlier ones that nobody has asked are dropped."""
        self._waiting.clear()
        self._outcomes.clear()
        self._waiting.extend(queries)
        self._wanted = set(self._waiting)
        try:
            self._fill(self._started())
        except EngineTroubleError as trouble:
            self._fail(trouble)

    def close(self) -> tuple[str, ...]:
        """Stop the engine, and return what was wrong with how it stopped; who asks again, starts it again."""
        session, self._session = self._session, None
        self._wanted.clear()
        self._waiting.clear()
        if session is None:
            return ()
        try:
            for sent in self._sent:
                session.receive(sent.seq)
            session.stop()
        except EngineTroubleError as trouble:
            return (str(trouble),)
        finally:
            session.kill()
            self._sent.clear()
            self._slots.clear()
        return ()

    def _started(self) -> Session:
        if self._session is None:
            self._session = self._start()
        return self._session

    def _start(self) -> Session:
        if self._start_error is not None and self._failed_starts >= MOST_FAILED_STARTS:
            why = f"given up after {self._failed_starts} failed starts in a row: {self._start_error}"
            raise EngineTroubleError(why)
        if self._hangs >= MOST_HANGS:
            why = f"given up after {self._hangs} hangs with no answer between them; try `conformance smoke`"
            raise EngineTroubleError(why)
        try:
            session = Session(self._command, self._read_timeout)
        except (CommandError, ProcessStartError, EngineTroubleError) as error:
            self._failed_starts += 1
            self._start_error = error
            raise EngineTroubleError(str(error)) from error
        self._failed_starts = 0
        return session

    def _advance(self) -> None:
        """Receive one reply, or find out why there is none."""
        try:
            session = self._started()
            self._fill(session)
            if self._sent:
                self._receive(session)
        except EngineTroubleError as trouble:
            self._fail(trouble)

    def _fill(self, session: Session) -> None:
        """Send what waits, as far as the window allows."""
        while self._waiting and len(self._sent) < WINDOW:
            query = self._waiting.popleft()
            refusal = undeclared(query, session.ops, session.features)
            if refusal is None:
                self._send(session, query)
            else:
                self._conclude(query, refusal)
        session.flush()

    def _send(self, session: Session, query: Query) -> None:
        scene, is_new = self._slots.find(query)
        if scene is not None and is_new:
            self._send_scene(session, scene)
        if scene is not None and scene.refused is not None:
            self._conclude(query, scene.refused)
            return
        seq = session.number()
        session.send(run_line(query, scene, seq, session.capabilities.floats))
        self._sent.append(_Sent(seq, scene, query))

    def _send_scene(self, session: Session, scene: HeldScene) -> None:
        seq = session.number()
        try:
            session.send(scene_line(scene, seq, session.capabilities.floats))
        except RecursionError:
            scene.refused = Errored("its scene: a tree that is nested too deeply for a JSON message")
        else:
            self._sent.append(_Sent(seq, scene))

    def _receive(self, session: Session) -> None:
        sent = self._sent[0]
        reply = session.receive(sent.seq)
        self._sent.popleft()
        if sent.query is not None:
            self._hangs = 0
            self._conclude(sent.query, _outcome(sent.query, sent.scene, reply, session.capabilities.floats))
        elif sent.scene is not None:
            sent.scene.refused = _refusal_of_scene(reply)

    def _conclude(self, query: Query, outcome: Outcome) -> None:
        if query in self._wanted:
            self._outcomes[query] = outcome

    def _fail(self, trouble: EngineTroubleError) -> None:
        """Record the trouble for the query whose reply was awaited; the others wait for a new engine."""
        self._hangs += isinstance(trouble, EngineHungError)
        self._waiting.extendleft([sent.query for sent in reversed(self._sent) if sent.query is not None])
        self._sent.clear()
        self._slots.clear()
        if self._session is not None:
            self._session.kill()
            self._session = None
        if self._waiting:
            self._conclude(self._waiting.popleft(), Errored(str(trouble)))
        self._waiting = deque(query for query in self._waiting if query in self._wanted)


def _outcome(query: Query, scene: HeldScene | None, reply: dict[str, Any], dialect: Dialect) -> Outcome:
    """Read the reply to a run; without its scene it means nothing."""
    if scene is not None and scene.refused is not None:
        return scene.refused
    try:
        outcome = outcome_of(reply, query.op, dialect)
    except BadReplyError as error:
        return Errored(str(error))
    if isinstance(outcome, Skipped):
        return Skipped(f"operation {query.op} is declared, but skipped: {outcome.reason}")
    return outcome


def _refusal_of_scene(reply: dict[str, Any]) -> Skipped | Errored | None:
    """Return what becomes of the runs in a scene that the engine has not taken."""
    if "skipped" in reply:
        return Skipped(f"its scene: {reply['skipped']['reason']}")
    if "errored" in reply:
        return Errored(f"its scene: {reply['errored']['context']}")
    return None
