"""`conformance new`: begin a case from one that there is, from a found failure or from a line of a trace."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Final

from conformance import exit_codes
from conformance.commands.one_case import find_case
from conformance.commands.options import UsageError

if TYPE_CHECKING:
    import argparse
    from collections.abc import Sequence

    from conformance.case import Case
    from conformance.trace_lines import LoggedWrite

HELP: Final = "begin a case: a copy under a new id of one that is nearest to what you want to ask"
EXAMPLES: Final = (
    "conformance new my-ramp --like origin-step-down-touching",
    "conformance new my-ramp --op find_collisions -o my-cases/ramp.yaml",
    "conformance new my-slide --tag slide --title 'A sphere slides along a wall'",
    "conformance new my-failure --like .conformance/found/found-0123456789.yaml",
    "conformance new my-wall --trace-line '[sliding] SlidingNormalValid: 0 -> 1 caller=validate_transition'",
)


def configure(parser: argparse.ArgumentParser) -> None:
    """Add the command's arguments."""
    parser.add_argument("id", metavar="ID", help="of the new case: lower-case words joined by '-', for life")
    source = parser.add_mutually_exclusive_group(required=True)
    source.add_argument(
        "--like",
        metavar="CASE-ID|FILE|FILE::ID",
        help="copy this case (`conformance list` finds one), or the case of a file, such as a found failure",
    )
    source.add_argument("--op", metavar="OP", help="copy the smallest case that asks this operation")
    source.add_argument("--tag", metavar="TAG", help="copy the smallest case with this tag")
    source.add_argument(
        "--trace-line",
        metavar="LINE",
        help="copy the smallest case in which retail's function writes the field of this line of a trace",
    )
    parser.add_argument("--title", default="", metavar="TEXT", help="of the new case (default: the other's)")
    parser.add_argument(
        "-o", "--output", type=Path, metavar="FILE", help="a file that is not there yet (default: ID.yaml)"
    )


def run(args: argparse.Namespace) -> int:
    """Write the case, say what to do with it, and return the exit code."""
    from conformance.console import make_console
    from conformance.files import write_text
    from conformance.life.new_case import NewCaseError, check_id, text_like

    path: Path = args.output or Path(f"{args.id}.yaml")
    if path.exists():
        raise UsageError(f"{path} is there already and is not overwritten")
    built_in = _cases(())
    try:
        check_id(args.id, {case.id for case in (*built_in, *_neighbours(path))})
        case = _source(args, built_in)
        text = text_like(case, args.id, title=args.title, remarks=_remarks(args, case))
    except NewCaseError as error:
        raise UsageError(str(error)) from error
    write_text(path, text)
    console = make_console()
    console.print(f"{path}: {args.id}, like {case.id}")
    console.print("Give it a title, a `why` and a scene of its own, then check and run it:")
    console.print(f"  conformance lint {path}")
    console.print(f"  pytest {path}")
    return exit_codes.OK


def _cases(paths: Sequence[Path]) -> tuple[Case, ...]:
    from conformance.case import Vary
    from conformance.loader import load_paths

    return load_paths(paths, Vary(poses=0)).cases


def _neighbours(path: Path) -> tuple[Case, ...]:
    """Return the cases in the new file's folder, which are run together with it.

    A working directory is no folder of cases.
    """
    from conformance.loader import NoCasesError

    folder = path.parent
    if folder == Path() or not folder.is_dir():
        return ()
    try:
        return _cases([folder])
    except NoCasesError:
        return ()


def _source(args: argparse.Namespace, built_in: Sequence[Case]) -> Case:
    from conformance.console import Progress
    from conformance.life.new_case import smallest, with_write
    from conformance.life.selection import Filters, hints

    if args.like:
        return _named(args.like, built_in)
    if args.trace_line:
        write = _write(args.trace_line)
        with Progress() as progress:
            found = with_write(built_in, write, progress.say)
        if found is None:
            raise UsageError(
                f"in no built-in case that cites {write.caller} does retail write {write.label} there"
            )
        return found
    filters = Filters(tags=(args.tag,)) if args.tag else Filters(ops=(args.op,))
    found = smallest(case for case in built_in if filters.accept(case))
    if found is None:
        raise UsageError("; ".join(hints(built_in, filters)))
    return found


def _named(text: str, built_in: Sequence[Case]) -> Case:
    """Return the case that ``--like`` names."""
    ours = next((case for case in built_in if case.id == text), None)
    return ours or find_case(text)


def _write(line: str) -> LoggedWrite:
    from conformance.trace_lines import TraceLineError, parse_line

    try:
        write = parse_line(line.strip())
    except TraceLineError as error:
        raise UsageError(f"not a trace line: {error}") from error
    if write is None:
        raise UsageError(
            "not a trace line: it does not begin with a topic, such as '[cp-write] ContactPlane: '"
        )
    return write


def _remarks(args: argparse.Namespace, case: Case) -> list[str]:
    began = [f"Begun as a copy of {case.id}."]
    return [*began, f"From a trace: {args.trace_line.strip()}"] if args.trace_line else began
