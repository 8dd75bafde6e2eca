"""`conformance list`: which cases there are, chosen by topic, retail function, operation or file."""

from __future__ import annotations

import json
from pathlib import Path
from typing import TYPE_CHECKING, Final

from conformance import exit_codes
from conformance.commands.options import UsageError

if TYPE_CHECKING:
    import argparse
    from collections.abc import Iterator, Sequence

    from conformance.case import Case
    from conformance.life.selection import Filters

HELP: Final = "list cases by tag, retail function, operation or file, or count them"
EXAMPLES: Final = (
    "conformance list --tag step-down --op find_collisions",
    "conformance list --function adjust_offset --path walks",
    "conformance list my-cases --json",
    "conformance list --count tag",
)
_KINDS: Final = ("tag", "function", "op", "file")


def configure(parser: argparse.ArgumentParser) -> None:
    """Add the command's arguments."""
    parser.add_argument(
        "paths", nargs="*", type=Path, metavar="PATH", help="files or folders (default: the built-in cases)"
    )
    parser.add_argument(
        "--tag", action="append", default=[], metavar="TAG", help="with this tag; repeated: with all of them"
    )
    parser.add_argument(
        "--function",
        action="append",
        default=[],
        metavar="NAME",
        help="that cites this function of retail, CLASS::name or only the name; repeated: all of them",
    )
    parser.add_argument(
        "--op",
        action="append",
        default=[],
        metavar="OP",
        help="that asks this operation; repeated: one of them",
    )
    parser.add_argument(
        "--path",
        action="append",
        default=[],
        metavar="GLOB",
        help="in this folder or file, or in files such as 'walks/*.yaml'; repeated: in one of them",
    )
    shown = parser.add_mutually_exclusive_group()
    shown.add_argument(
        "--json", action="store_true", help="a list of objects: id, title, file, line, op, tags, retail, pins"
    )
    shown.add_argument(
        "--count", choices=_KINDS, metavar="KIND", help=f"only how many there are by {', '.join(_KINDS)}"
    )


def run(args: argparse.Namespace) -> int:
    """Print the chosen cases and return the exit code: 4 if there is none, 1 if files have mistakes."""
    from conformance.case import Vary
    from conformance.console import make_console, print_document
    from conformance.life.selection import Filters, hints
    from conformance.loader import NoCasesError, load_paths

    try:
        loaded = load_paths(args.paths, Vary(poses=0))
    except NoCasesError as error:
        raise UsageError(str(error)) from error
    filters = Filters(args.tag, args.function, args.op, args.path)
    chosen = [case for case in loaded.cases if filters.accept(case)]
    console, errors = make_console(), make_console(stderr=True)
    if args.json:
        print_document(_records(chosen))
    else:
        for line in _shown(args, chosen, len(loaded.cases)):
            console.print(line)
    if loaded.problems:
        count = len(loaded.problems)
        mistakes = "1 mistake keeps" if count == 1 else f"{count} mistakes keep"
        errors.print(f"{mistakes} cases from being listed, see `conformance lint`")
        return exit_codes.FAILURES
    if chosen:
        return exit_codes.OK
    for line in hints(loaded.cases, filters) or [_nothing(filters)]:
        errors.print(line)
    return exit_codes.NOTHING_RAN


def _records(chosen: Sequence[Case]) -> str:
    from conformance.life.selection import as_record

    return json.dumps([as_record(case) for case in chosen], indent=1, ensure_ascii=False) + "\n"


def _shown(args: argparse.Namespace, chosen: Sequence[Case], total: int) -> Iterator[str]:
    from conformance.life.selection import count

    if args.count:
        yield from (f"{number:>6}  {word}" for word, number in count(chosen, args.count))
    else:
        width = max((len(case.id) for case in chosen), default=0)
        yield from (f"{case.id:<{width}}  {case.title}" for case in chosen)
    yield f"{len(chosen)} of {total} cases"


def _nothing(filters: Filters) -> str:
    where = f", in {' or '.join(filters.paths)}" if filters.paths else ""
    return f"no case meets all of this together{where}"
