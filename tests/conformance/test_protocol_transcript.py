"""The session of one case, as an engine under a debugger is given it."""

from __future__ import annotations

import io
import json
from pathlib import Path
from typing import TYPE_CHECKING

import pytest

from conformance.candidates.oracle_candidate import OracleCandidate
from conformance.cli import main
from conformance.commands.one_case import find_case
from conformance.protocol.dialects import DIALECTS
from conformance.protocol.replies import outcome_of
from conformance.protocol.server import Server
from conformance.protocol.transcript import messages_of
from conformance.query import Query

if TYPE_CHECKING:
    from conformance.protocol.dialects import Dialect

FILE = Path(__file__).parents[2] / "conformance" / "cases" / "contact-plane" / "origin.yaml"
CASE = f"{FILE}::origin-step-down-touching"


@pytest.mark.parametrize("dialect", DIALECTS)
def test_it_asks_what_the_case_asks(dialect: Dialect) -> None:
    """Served by retail it has retail's answer."""
    query = find_case(CASE).queries[0]
    lines = list(messages_of(query, dialect))
    assert [json.loads(line)["cmd"] for line in lines] == ["start", "scene", "run", "stop"]
    replies = io.BytesIO()
    Server(OracleCandidate(), dialect).serve(lines, replies)
    answers = [json.loads(line) for line in replies.getvalue().splitlines()]
    assert [answer["seq"] for answer in answers] == [0, 1, 2, 3]
    assert answers[0]["result"]["floats"] == dialect
    assert outcome_of(answers[2], query.op, dialect) == OracleCandidate().answer(query)


def test_what_needs_no_scene_has_none() -> None:
    """Numbers are asked alone."""
    query = Query("block_offset", {"from_cell": 1, "to_cell": 2}, label="x")
    assert [json.loads(line)["cmd"] for line in messages_of(query, "hex")] == ["start", "run", "stop"]


def test_the_command_prints_it(capsys: pytest.CaptureFixture[str]) -> None:
    """And nothing else, so that it can be another program's stdin."""
    assert main(["show", CASE, "--messages", "decimal"]) == 0
    printed = capsys.readouterr().out
    assert printed.encode() == b"".join(messages_of(find_case(CASE).queries[0], "decimal"))
    assert main(["show", CASE, "--messages", "hex", "--work"]) == 2
    assert "nothing else is shown beside them" in capsys.readouterr().err
