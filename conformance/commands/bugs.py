"""`conformance bugs`: whether the suite catches the candidates that are wrong on purpose."""

from __future__ import annotations

import json
from difflib import get_close_matches
from pathlib import Path
from typing import TYPE_CHECKING, Final

from conformance import exit_codes
from conformance.commands.options import UsageError
from conformance.option_types import whole_from

if TYPE_CHECKING:
    import argparse

    from conformance.bug_hunt import Record
    from conformance.candidates.bug_candidate import KnownBug

HELP: Final = "run the known bugs against every pinned case and random queries, and show what catches them"
EXAMPLES: Final = (
    "conformance bugs",
    "conformance bugs --list",
    "conformance bugs cell-origin vertex-plane --draws 500",
    "pytest conformance --candidate bug:cell-origin",
)
_DRAWS: Final = 2000
_PIPED_WIDTH: Final = 160
"""Columns of the table where no terminal says how wide it is."""


def configure(parser: argparse.ArgumentParser) -> None:
    """Add the command's arguments."""
    parser.add_argument("names", nargs="*", metavar="NAME", help="only these bugs (default: all)")
    parser.add_argument("--list", action="store_true", help="only list them")
    parser.add_argument(
        "--draws",
        type=whole_from(1),
        default=_DRAWS,
        metavar="N",
        help="random queries of each family (default: %(default)s)",
    )
    parser.add_argument("--json", type=Path, metavar="FILE", help="also write the result as JSON")
    parser.add_argument("--markdown", action="store_true", help="print the table as Markdown")


def run(args: argparse.Namespace) -> int:
    """Print the table and return the exit code: 1 if a bug is not caught and no reason is recorded."""
    from conformance.console import make_console

    bugs = _chosen(args.names)
    if args.list:
        console = make_console()
        for bug in bugs:
            console.print(f"bug:{bug.id}", style="bold")
            console.print(f"  {bug.mistake}")
            console.print(f"  retail: {bug.retail}")
        return exit_codes.OK
    records, whole = _hunt(bugs, args.draws)
    _print(records, markdown=args.markdown)
    if args.json is not None:
        _write_json(args.json, records)
    if not whole:
        return exit_codes.BROKEN_OFF
    return exit_codes.FAILURES if any(record.unexplained for record in records) else exit_codes.OK


def _chosen(names: list[str]) -> list[KnownBug]:
    from conformance.candidates.bug_candidate import BUG_PREFIX
    from conformance.candidates.known_bugs import list_bugs

    known = {bug.id: bug for bug in list_bugs()}
    wanted = [name.removeprefix(BUG_PREFIX) for name in names]
    for name in wanted:
        if name not in known:
            nearest = get_close_matches(name, known, n=1)
            hint = f" Did you mean {nearest[0]!r}?" if nearest else ""
            raise UsageError(f"unknown bug {name!r}.{hint} `conformance bugs --list` names them")
    return [known[name] for name in wanted] if wanted else list(known.values())


def _hunt(bugs: list[KnownBug], draws: int) -> tuple[list[Record], bool]:
    """Return what is known of each bug, and whether all was asked."""
    from conformance.bug_hunt import HuntBrokenOffError, hunt
    from conformance.console import Progress, make_console
    from conformance.loader import Vary, load_paths

    loaded = load_paths(vary=Vary(poses=0))
    if loaded.problems:
        raise UsageError(f"{len(loaded.problems)} built-in cases are wrong: see `conformance lint`")
    try:
        with Progress() as progress:
            return hunt(bugs, loaded.cases, draws=draws, progress=progress), True
    except HuntBrokenOffError as error:
        make_console(stderr=True).print("broken off: what follows was found so far", style="yellow")
        return error.records, False


def _write_json(path: Path, records: list[Record]) -> None:
    from conformance.files import write_text
    from conformance.report.kills import as_json

    write_text(path, json.dumps(as_json(records), indent=2) + "\n")


def _print(records: list[Record], *, markdown: bool) -> None:
    from conformance.console import make_console, print_document
    from conformance.report.kills import kill_table, markdown_table, verdict

    if markdown:
        print_document(markdown_table(records))
        return
    console = make_console()
    if not console.is_terminal:
        console.width = _PIPED_WIDTH
    console.print(kill_table(records), soft_wrap=False)
    missed = any(record.unexplained for record in records)
    console.print(verdict(records), style="red" if missed else "green")
