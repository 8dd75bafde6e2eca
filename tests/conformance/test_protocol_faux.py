"""Engines that are wrong on purpose: each is reported for what it is, and the run goes on."""

from __future__ import annotations

import re
import sys
import time
from typing import TYPE_CHECKING

import pytest
from faux import faux, queries, right

from conformance.candidates import command_candidate
from conformance.compare import differences
from conformance.query import Errored, Query, Result, Skipped

if TYPE_CHECKING:
    from conformance.candidates.command_candidate import CommandCandidate
    from conformance.query import Outcome

AT = 4
"""The message at which a faux engine goes wrong, and the query that it is: the handshake is message 0."""
BAD_REPLIES = {
    "crash": r"the engine ended with exit status 3 before it replied\n    stderr: about to fail\n"
    r"    stderr: assertion in cell 7",
    "garbage": r"'segment 0x12 loaded', which is not JSON \(Expecting value, column 1\)",
    "list": r"'\[1, 2\]', which is not an object",
    "nan": r'found NaN, which is not JSON: .*, expected the string "nan"',
    "twin-keys": r"found the key 'v' twice in an object: '\{.*, expected each key once",
    "latin": r"bytes that are not UTF-8 at column 10",
    "late-seq": r"seq 5, which is not its turn, expected seq 4; replies come in order",
    "previous-seq": r"seq 3, which has been answered before, expected seq 4",
    "text-seq": r"seq '4', expected seq 4, a whole number",
    "no-seq": r"no seq in '.*', expected seq 4",
    "extra": r"the extra field 'elapsed', expected \{\"seq\": 4, and one of",
    "two-bodies": r"result and skipped, expected exactly one of result, skipped, errored",
    "no-body": r"neither of the three in ",
    "text-skip": r"skipped: 'no', expected skipped: \{\"reason\": a text\}",
    "long": r"a line of more than 16777216 bytes, beginning 'xxxx",
    "half": r"without a line end, expected whole lines",
    "field": r"an unknown field at result.speed, expected one of v",
    "missing": r"nothing at result.v, expected a value",
    "short": r"\[0, 0\] \(list\) at result.v, expected 3 numbers",
    "errored": r"out of cells",
    "surrogate": r"found half a character, U\+D83D: '\{.*, expected text",
}
"""What is recorded for the query at which an engine goes wrong."""
BAD_STARTS = {
    "banner": r"handshake: bad reply: found 'Loading the world \.\.\.', which is not JSON",
    "version": r"handshake: bad reply: found version 2, expected version 1",
    "unknown-op": r"found unknown operation 'block_ofset' \(did you mean 'block_offset'\?\)",
    "unknown-feature": r"found the feature 'two-sphere', expected perhaps 'two-spheres'; features are ",
    "extra-claim": r"found 'fast' at result.speed, expected one of version, name, floats, ops, features",
    "bad-claim": r"found 'all' at result.ops, expected a valid list",
    "refuses": r"handshake: the engine refuses to start: \{'context': 'no licence'\}",
}
"""What is recorded for every query of an engine that introduces itself badly."""
BAD_STOPS = {
    "chatty": r"the engine writes on after its last reply: b'bye\\n'",
    "sour": r"the engine ended with exit status 4 when it was stopped, expected 0",
    "stays": r"the engine still runs 0.5 s after it was stopped",
}


def ask_all(candidate: CommandCandidate, *, ahead: bool) -> list[Outcome]:
    """Ask every query, all at once or one after the other, and stop the engine."""
    asked = queries()
    if ahead:
        candidate.ask_ahead(asked)
    outcomes = [candidate.answer(query) for query in asked]
    assert candidate.close() == ()
    return outcomes


@pytest.mark.parametrize(
    ("mode", "ahead"), [*((mode, True) for mode in BAD_REPLIES), ("crash", False), ("late-seq", False)]
)
def test_a_bad_reply_is_that_query_s(mode: str, ahead: bool) -> None:
    """The query at which the engine goes wrong has its error, and the others have their answers."""
    outcomes = ask_all(faux(mode, AT), ahead=ahead)
    failed = outcomes.pop(AT - 1)
    assert isinstance(failed, Errored)
    assert re.search(BAD_REPLIES[mode], failed.context)
    assert outcomes == [right(query) for query in queries() if query.label != f"q{AT}"]


def test_a_hang_is_that_query_s() -> None:
    """No reply in time; the engine is started anew."""
    candidate = faux("hang", AT, read_timeout=0.5)
    *before, failed = [candidate.answer(query) for query in queries()[:AT]]
    assert before == [right(query) for query in queries()[: AT - 1]]
    assert failed == Errored("no reply within 0.5 s (--read-timeout)")
    assert candidate.answer(queries()[AT]) == right(queries()[AT])
    assert candidate.close() == ()


def test_a_reply_without_its_line_end_is_told() -> None:
    """It has come, and is not whole: what a line lacks is seen in what there is of it."""
    candidate = faux("endless", AT, read_timeout=0.5)
    *_, failed = [candidate.answer(query) for query in queries()[:AT]]
    assert isinstance(failed, Errored)
    assert re.fullmatch(
        rf"no reply within 0\.5 s \(--read-timeout\), but '\{{\"seq\": {AT}, .*\}}' without a line end",
        failed.context,
    )
    assert candidate.close() == ()


@pytest.mark.skipif(sys.platform == "win32", reason="Windows ends all that an engine has started")
def test_what_an_engine_leaves_behind_is_not_waited_for() -> None:
    """A program in a session of its own that holds the engine's stdout: nobody hears from it any more."""
    candidate = faux("leaves", AT, read_timeout=0.5)
    started = time.monotonic()
    assert candidate.answer(queries()[0]) == right(queries()[0])
    (complaint,) = candidate.close()
    left = "the engine has ended, but a program that it started holds its stdout open"
    assert complaint == f"{left} 0.5 s after it was stopped"
    assert time.monotonic() - started < 15.0, "the program sleeps for 20 seconds"


def test_who_hangs_at_everything_is_given_up(monkeypatch: pytest.MonkeyPatch) -> None:
    """Otherwise a bridge that never flushes its stdout would keep the suite for hours."""
    monkeypatch.setattr(command_candidate, "MOST_HANGS", 2)
    candidate = faux("hang", 1, read_timeout=0.5)
    outcomes = [candidate.answer(query) for query in queries()[:4]]
    assert outcomes[:2] == [Errored("no reply within 0.5 s (--read-timeout)")] * 2
    given_up = "given up after 2 hangs with no answer between them; try `conformance smoke`"
    assert outcomes[2:] == [Errored(given_up)] * 2
    assert candidate.close() == ()


def test_who_replies_between_hangs_is_not_given_up(monkeypatch: pytest.MonkeyPatch) -> None:
    """Every second query hangs, and every other one has its answer."""
    monkeypatch.setattr(command_candidate, "MOST_HANGS", 2)
    candidate = faux("hang", 2, read_timeout=0.5)
    outcomes = [candidate.answer(query) for query in queries()[:6]]
    assert outcomes[::2] == [right(query) for query in queries()[:6:2]]
    assert outcomes[1::2] == [Errored("no reply within 0.5 s (--read-timeout)")] * 3
    assert candidate.close() == ()


def test_what_an_engine_has_started_ends_with_it() -> None:
    """A child that holds the engine's stdout does not keep the suite waiting."""
    candidate = faux("child", AT, read_timeout=0.5)
    started = time.monotonic()
    outcomes = [candidate.answer(query) for query in queries()[:AT]]
    assert outcomes[-1] == Errored("no reply within 0.5 s (--read-timeout)")
    candidate.close()
    assert time.monotonic() - started < 30.0, "the child sleeps for a minute"


def test_an_answer_given_twice_is_noticed_at_the_next_query() -> None:
    """Where the second copy is read."""
    outcomes = ask_all(faux("twice", AT), ahead=False)
    assert outcomes[:AT] == [right(query) for query in queries()[:AT]]
    assert isinstance(outcomes[AT], Errored)
    assert "seq 4, which has been answered before, expected seq 5" in outcomes[AT].context
    assert outcomes[AT + 1 :] == [right(query) for query in queries()[AT + 1 :]]


def test_one_ulp_off_is_a_difference() -> None:
    """Of one ULP, in the field that has it."""
    query = queries()[0]
    outcome = ask_all(faux("ulp"), ahead=True)[0]
    assert isinstance(outcome, Result)
    (found,) = differences(right(query).fields, outcome.fields, op=query.op, zero_signs="distinct")
    assert (found.path, found.ulps) == ("v[0]", 1)


def test_the_previous_answer_is_a_wrong_answer() -> None:
    """Under the right number it can only be told by its values."""
    outcomes = ask_all(faux("previous"), ahead=True)
    assert outcomes == [right(query) for query in (queries()[0], *queries()[:-1])]


def test_a_reason_to_skip_is_counted_as_said() -> None:
    """An operation that is declared, and skipped all the same, is named so."""
    outcomes = ask_all(faux("skipped", AT), ahead=True)
    assert outcomes[AT - 1] == Skipped("operation block_offset is declared, but skipped: too far")
    claimed = Query("calc_friction", {"body": {}, "quantum": 0.1, "v2": 1.0})
    candidate = faux("claims")
    reason = "operation calc_friction is declared, but skipped: no calc_friction"
    assert candidate.answer(claimed) == Skipped(reason)
    assert candidate.close() == ()


def test_what_is_not_declared_is_not_asked() -> None:
    """By operation and by feature, each by its name."""
    candidate = faux("good")
    other = Query("calc_friction", {"body": {}, "quantum": 0.1, "v2": 1.0})
    assert candidate.answer(other) == Skipped("operation calc_friction is not declared")
    endless = Query("block_offset", {"from_cell": 1, "to_cell": 1, "scale": 2.0})
    reason = "feature scale is not declared (movers, cells' trees and objects of another scale than 1)"
    assert candidate.answer(endless) == Skipped(reason)
    assert candidate.close() == ()


@pytest.mark.parametrize("mode", BAD_STARTS)
def test_a_bad_start_is_every_query_s(mode: str) -> None:
    """The engine is not tried for ever; what is wrong is told each time."""
    candidate = faux(mode)
    outcomes = [candidate.answer(query) for query in queries()]
    for outcome in outcomes:
        assert isinstance(outcome, Errored)
        assert re.search(BAD_STARTS[mode], outcome.context)
    assert "given up after 3 failed starts in a row" in str(outcomes[-1])
    assert candidate.close() == ()


def test_a_mute_engine_is_given_up() -> None:
    """The handshake has a time of its own, four times that of a reply."""
    candidate = faux("mute", read_timeout=0.1)
    assert candidate.answer(queries()[0]) == Errored("handshake: no reply within 0.4 s (--read-timeout)")
    assert candidate.close() == ()


def test_a_program_that_is_not_there() -> None:
    """It is named, with the system's reason."""
    outcome = command_candidate.CommandCandidate("./no-such-engine --flag").answer(queries()[0])
    assert isinstance(outcome, Errored)
    assert outcome.context.startswith("cannot run './no-such-engine --flag': ")


@pytest.mark.parametrize("mode", BAD_STOPS)
def test_a_bad_stop_is_told(mode: str) -> None:
    """Where no query can have it, `close` has it."""
    candidate = faux(mode, read_timeout=0.5)
    assert candidate.answer(queries()[0]) == right(queries()[0])
    (complaint,) = candidate.close()
    assert re.search(BAD_STOPS[mode], complaint)


def test_only_the_end_of_the_log_is_kept() -> None:
    """An engine may log as much as it likes."""
    candidate = faux("noise")
    assert candidate.answer(queries()[0]) == right(queries()[0])
    session = candidate._session
    assert session is not None
    trouble = session.trouble("a test")
    assert str(trouble).endswith("    stderr: last words")
    assert len(str(trouble)) < 1 << 15


def test_answers_that_nobody_fetches_are_dropped() -> None:
    """What was asked ahead and then skipped does not come as the answer to something else."""
    candidate = faux("good")
    first, second = queries(), queries()
    candidate.ask_ahead(first)
    candidate.ask_ahead(second[2:4])
    assert candidate.answer(second[3]) == right(second[3])
    assert candidate.answer(second[2]) == right(second[2])
    candidate.ask_ahead(first)
    assert candidate.close() == ()


def test_a_candidate_that_was_closed_starts_again() -> None:
    """What was asked ahead before is asked anew."""
    candidate = faux("good")
    asked = queries()
    for _ in range(2):
        candidate.ask_ahead(asked)
        assert candidate.close() == ()
        assert candidate.answer(asked[1]) == right(asked[1])
    assert candidate.close() == ()


def test_bits_are_read_as_floats() -> None:
    """An engine that writes bits answers the same."""
    assert ask_all(faux("hex"), ahead=True) == [right(query) for query in queries()]


def test_the_same_query_can_be_asked_again() -> None:
    """Each time of the engine."""
    candidate = faux("previous")
    first, second = queries()[:2]
    assert candidate.answer(first) == right(first)
    assert candidate.answer(second) == right(first)
    assert candidate.answer(second) == right(second)
    assert candidate.close() == ()


def test_an_engine_ends_with_the_candidate() -> None:
    """Also if nobody stops it."""
    candidate = faux("good")
    assert candidate.answer(queries()[0]) == right(queries()[0])
    session = candidate._session
    assert session is not None
    process = session._process._process
    del candidate, session
    assert process.wait(10.0) is not None
