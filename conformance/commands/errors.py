"""`conformance errors`: how far retail's numbers are from exact ones, and those of other models."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Final

from conformance import exit_codes
from conformance.commands.options import UsageError
from conformance.installed import installed
from conformance.option_types import whole_from

if TYPE_CHECKING:
    import argparse
    from collections.abc import Iterator

    from conformance.exact.survey import Survey
    from conformance.query import Query

HELP: Final = "measure the oracle, and the same with other roundings, against exact arithmetic"
EXAMPLES: Final = (
    "conformance errors",
    'conformance errors --family "worlds" --draws 500 --json errors.json',
    "conformance errors conformance/vectors/transition.jsonl --save worst",
)
_DRAWS: Final = 200
_FAMILY: Final = "transitions"
_SAVED_BY: Final = "position_metres"
"""The measure whose worst query is saved."""
_PIPED_WIDTH: Final = 200
"""Columns of the table where no terminal says how wide it is."""


def configure(parser: argparse.ArgumentParser) -> None:
    """Add the command's arguments."""
    parser.add_argument(
        "files", nargs="*", type=Path, metavar="FILE", help="vector files (default: random queries)"
    )
    parser.add_argument(
        "--draws",
        type=whole_from(1),
        default=_DRAWS,
        metavar="N",
        help="random queries (default: %(default)s)",
    )
    parser.add_argument(
        "--family",
        default=_FAMILY,
        help="what is asked at random, as `conformance bugs` does (default: %(default)s)",
    )
    parser.add_argument("--json", type=Path, metavar="FILE", help="also write the result as JSON")
    parser.add_argument("--save", type=Path, metavar="DIR", help="write each model's worst query as a case")


def run(args: argparse.Namespace) -> int:
    """Print the table and return the exit code: 4 if nothing was measured."""
    from conformance.console import make_console
    from conformance.report.errors import error_table, survey_lines

    survey, whole = _survey(), True
    try:
        _ask(survey, args)
    except KeyboardInterrupt:
        whole = False
        make_console(stderr=True).print("broken off: what follows is measured so far", style="yellow")
    console = make_console()
    if not console.is_terminal:
        console.width = _PIPED_WIDTH
    console.print(error_table(survey))
    for line in survey_lines(survey):
        console.print(line)
    _write(survey, args)
    if not whole:
        return exit_codes.BROKEN_OFF
    return exit_codes.OK if survey.asked else exit_codes.NOTHING_RAN


def _survey() -> Survey:
    """Make a survey of the models that need nothing but the oracle."""
    from conformance.candidates.model_candidate import double, single
    from conformance.candidates.oracle_candidate import OracleCandidate
    from conformance.candidates.registry import MissingExtraError, check_extra

    try:
        check_extra("exact")
    except MissingExtraError as error:
        raise UsageError(str(error)) from error
    from conformance.exact.candidate import ExactCandidate
    from conformance.exact.survey import Survey

    models = {
        "retail": OracleCandidate().answer,
        "single": single().unrounded,
        "double": double().unrounded,
    }
    return Survey(models, ExactCandidate())


def _ask(survey: Survey, args: argparse.Namespace) -> None:
    from conformance.bug_hunt import FAMILIES, draw_queries
    from conformance.console import Progress

    with Progress() as progress:

        def ask(query: Query, count: int) -> None:
            survey.ask(query)
            progress.say(f"{count} queries")

        if args.files:
            for count, query in enumerate(_recorded(args.files), start=1):
                ask(query, count)
        elif args.family in FAMILIES:
            draw_queries(FAMILIES[args.family], args.draws, ask)
        else:
            raise UsageError(f"unknown family {args.family!r}; there are: {', '.join(FAMILIES)}")


def _recorded(files: list[Path]) -> Iterator[Query]:
    """Yield the query of every record; a line that cannot be read is a wrong file."""
    from conformance.vector_errors import VectorError
    from conformance.vector_io import read_vectors
    from conformance.vector_library import Library

    for path in map(installed, files):
        if not path.is_file():
            raise UsageError(f"no such file: {path}")
        for record in read_vectors(path, Library(path.parent)):
            if isinstance(record, VectorError):
                raise UsageError(f"{path}: {record}")
            yield record.query


def _write(survey: Survey, args: argparse.Namespace) -> None:
    from conformance.compare import differences
    from conformance.files import write_text
    from conformance.found import write_found
    from conformance.json_writing import json_text
    from conformance.query import Result
    from conformance.report.errors import as_json

    if args.json is not None:
        text = json_text(as_json(survey), indent=2)
        write_text(args.json, text)
    if args.save is None:
        return
    for name, summary in survey.summaries.items():
        spread = summary.spread(_SAVED_BY)
        if spread is None:
            continue
        query = spread.worst
        told, exact = survey.models[name](query), survey.exact.answer(query)
        found = (
            differences(told.fields, exact.fields, op=query.op, zero_signs="equal")
            if isinstance(told, Result) and isinstance(exact, Result)
            else []
        )
        provenance = f"conformance errors, the worst of {name} ({spread.largest:.3g} m)"
        write_found(args.save, query, found, candidate=survey.exact.name, provenance=provenance)
