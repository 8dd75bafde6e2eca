"""`conformance explain`: what retail does in a case, step by step of the specification."""

from __future__ import annotations

import textwrap
from typing import TYPE_CHECKING, Final

from conformance.commands.one_case import add_case, add_pose, ending, find_case, query_of
from conformance.commands.options import UsageError
from conformance.option_types import whole_from

if TYPE_CHECKING:
    import argparse
    from collections.abc import Iterator

    from conformance.case import Case
    from conformance.life.explanation import Explanation
    from conformance.query import Query

HELP: Final = "tell what retail does in a case: every step of the specification, what it decides and writes"
EXAMPLES: Final = (
    "conformance explain origin-step-down-touching",
    "conformance explain origin-step-down-touching --pose 3 --depth 2",
    "conformance explain walk-cellar-descent --tick 17",
    "conformance explain my-cases/ramp.yaml::my-first-ramp",
)
_WIDTH: Final = 100


def configure(parser: argparse.ArgumentParser) -> None:
    """Add the command's arguments."""
    add_case(parser)
    add_pose(parser)
    parser.add_argument(
        "--tick",
        type=whole_from(0),
        metavar="N",
        help="the tick of a walk, from 0; a walk of several is told tick by tick",
    )
    parser.add_argument(
        "--depth", type=whole_from(1), metavar="N", help="levels of calls to show (default: all)"
    )


def run(args: argparse.Namespace) -> int:
    """Print the explanation and return the exit code: 1 if the case fails to run."""
    from conformance.console import Progress, make_console
    from conformance.life.explanation import NoTickError, explain

    case = find_case(args.case)
    query = query_of(case, args.pose)
    try:
        with Progress() as progress:
            explanation = explain(query, args.tick, progress.say)
    except NoTickError as error:
        raise UsageError(str(error)) from error
    console = make_console()
    for line in (*_introduction(case, query), *_body(case, explanation, args.depth)):
        console.print(line)
    text, code = ending(explanation.outcome)
    console.print(text)
    return code


def _introduction(case: Case, query: Query) -> Iterator[str]:
    from conformance.report.scene import scene_line

    yield f"{query.label}: {case.title}"
    yield ""
    yield from textwrap.wrap(case.why, _WIDTH)
    yield ""
    yield f"scene: {scene_line(query)}"


def _body(case: Case, explanation: Explanation, depth: int | None) -> Iterator[str]:
    from conformance.life.explanation import Citations
    from conformance.report.steps import step_lines
    from conformance.report.traces import trace_lines

    cited = Citations(case.retail)
    yield "steps (* what the case cites):"
    yield from list(step_lines(explanation.items, cited, depth)) or ["  none"]
    for function in cited.missing(explanation.functions):
        yield f"  cited, but not called under this name: {function}"
    yield "writes:"
    yield from [f"  {line}" for line in trace_lines(explanation.entries, with_foot=False)] or ["  no writes"]
