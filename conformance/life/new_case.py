"""Beginning a case from one that there is: its text under a new id, checked before it is written."""

from __future__ import annotations

import re
import textwrap
from pathlib import Path
from typing import TYPE_CHECKING, Final

from conformance.candidates.oracle_candidate import OracleCandidate
from conformance.case import Vary
from conformance.life.anchors import anchored, write_out
from conformance.life.layout import LayoutError, lay_out
from conformance.lint import style_problems
from conformance.loader import load_document
from conformance.schema.case import SLUG
from conformance.traced import answer_traced
from conformance.yaml_source import YamlError, parse, split_lines

if TYPE_CHECKING:
    from collections.abc import Callable, Collection, Iterable, Sequence

    from conformance.case import Case
    from conformance.source import Problem
    from conformance.trace_lines import LoggedWrite

_ITEM: Final = re.compile(r"^( *)-( +)")
_ID: Final = re.compile(r"^([\"']?)id\1[ \t]*:.*$", re.MULTILINE)
_TITLE: Final = re.compile(r"^([\"']?)title\1[ \t]*:.*(?:\n[ \t]+\S.*)*$", re.MULTILINE)
_COMMENT: Final = "#"
_WIDTH: Final = 100


class NewCaseError(ValueError):
    """A case cannot be begun: its id, or what it was to be made from, will not do."""


def check_id(case_id: str, taken: Collection[str]) -> None:
    """Check that an id is well formed and that no case has it; raises `NewCaseError`."""
    if not re.fullmatch(SLUG, case_id):
        raise NewCaseError(f"found the id {case_id!r}, expected lower-case words joined by '-'")
    if case_id in taken:
        raise NewCaseError(f"the id {case_id!r} is taken; ids are unique, and for life")


def text_like(case: Case, case_id: str, *, title: str = "", remarks: Sequence[str] = ()) -> str:
    """Return the text of a file with one case: another's, under a new id, in this project's layout.

    Parameters
    ----------
    case : Case
        The other one; comments in it are kept.
    case_id : str
        The new id.
    title : str
        The new title; empty for the other's.
    remarks : sequence of str
        Comments to put in front.

    Raises
    ------
    NewCaseError
        The text does not hold by itself, or `lint` would complain.
    """
    text = _ID.sub(f"id: {case_id}", _written_out(case), count=1)
    if title:
        quoted = "'" + title.replace("'", "''") + "'"
        text = _TITLE.sub(lambda _: f"title: {quoted}", text, count=1)
    text = "".join(f"{line}\n" for line in (*_comments(remarks), text))
    problem = _first_problem(text, case_id)
    if problem is not None:
        raise NewCaseError(f"a copy of {case.id} does not hold by itself:\n{problem}")
    try:
        return lay_out(text.encode("utf-8"), case_id)
    except LayoutError as error:
        raise NewCaseError(str(error)) from error


def smallest(cases: Iterable[Case]) -> Case | None:
    """Return the case with the shortest text, the first of several; None if there is no case."""
    return min(cases, key=lambda case: len(case.source), default=None)


def with_write(cases: Iterable[Case], write: LoggedWrite, say: Callable[[str], None]) -> Case | None:
    """Find the smallest case that cites a write's function and in which retail makes such a write.

    Parameters
    ----------
    cases : iterable of Case
        Where to look.
    write : LoggedWrite
        A line of a trace; its field and its caller count, not its values.
    say : callable
        Is told which case is being looked at.
    """
    name = write.caller.rpartition("::")[2]
    citing = [case for case in cases if any(_name(citation) == name for citation in case.retail)]
    for case in sorted(citing, key=lambda case: len(case.source)):
        say(f"looking for the write in {case.id}")
        _, entries = answer_traced(OracleCandidate(), case.queries[0], (write.topic,))
        if any((entry.label, entry.caller) == (write.label, name) for entry in entries):
            return case
    return None


def _name(citation: str) -> str:
    return citation.partition(" ")[0].rpartition("::")[2]


def _written_out(case: Case) -> str:
    """Return a case's text, with what it uses of the cases before it in its file put in."""
    text = _alone(case.source)
    lines = split_lines(Path(case.location.file).read_text(encoding="utf-8"))
    before = "\n".join(lines[: case.first_line - 1])
    named = anchored(before)
    return write_out(text, {name: write_out(value, named) for name, value in named.items()})


def _alone(source: str) -> str:
    """Return the text of an item of a list as a document: without its dash, from the first column.

    Comments behind its last line speak of the next item.
    """
    match = _ITEM.match(source)
    if match is not None:
        source = " " * len(match[0]) + source[match.end() :]
    lines = textwrap.dedent(source).splitlines()
    while lines and (not lines[-1].strip() or lines[-1].lstrip().startswith(_COMMENT)):
        lines.pop()
    return "\n".join(lines)


def _comments(remarks: Sequence[str]) -> list[str]:
    return [f"# {line}" for remark in remarks for line in textwrap.wrap(remark, _WIDTH)]


def _first_problem(text: str, name: str) -> Problem | None:
    try:
        loaded = load_document(parse(text.encode("utf-8"), f"{name}.yaml"), Vary(poses=0))
    except YamlError as error:
        return error.problem
    style = (problem for case in loaded.cases for problem in style_problems(case))
    return next(iter((*loaded.problems, *style)), None)
