"""`conformance verify`: hold a candidate against vector files."""

from __future__ import annotations

import json
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

from conformance import exit_codes
from conformance.commands.options import UsageError, add_candidate_option, candidate_from
from conformance.installed import meant
from conformance.option_types import whole_from

if TYPE_CHECKING:
    import argparse

    from rich.console import Console

    from conformance.candidates.base import Candidate
    from conformance.compare import Difference
    from conformance.console import Progress
    from conformance.vector_library import Library
    from conformance.verification import Failure, Tally

HELP: Final = "compare a candidate with what retail answered, as recorded in vector files"
EXAMPLES: Final = (
    "conformance verify conformance/vectors/bsp.jsonl",
    "conformance verify conformance/vectors/*.jsonl --candidate engine",
    "conformance verify conformance/vectors/find_collisions.jsonl --id fc_00000 --candidate bug:cell-origin",
    "conformance verify vectors.jsonl --json > result.json",
)
_SHOWN: Final = 5
"""Failing records explained by default."""


def configure(parser: argparse.ArgumentParser) -> None:
    """Add the command's arguments."""
    parser.add_argument(
        "files", nargs="+", type=Path, metavar="FILE", help="JSON-lines files, or folders of them"
    )
    add_candidate_option(parser, default="oracle")
    parser.add_argument(
        "--id", action="append", default=[], metavar="ID", help="only this record (repeatable)"
    )
    parser.add_argument(
        "--max-differences",
        type=whole_from(0),
        default=_SHOWN,
        metavar="N",
        help="explain the first N failing records of each file (default: %(default)s)",
    )
    parser.add_argument("--json", action="store_true", help="print the result as one JSON object")


def run(args: argparse.Namespace) -> int:
    """Verify every file and return the exit code: 1 on any failure, 4 if what was asked for is not there."""
    from conformance.console import make_console

    paths = _vector_files(args.files)
    results, total, whole = _verify(paths, args)
    if args.json:
        _print_json(results, total, args.candidate)
    else:
        console = make_console()
        for path, tally in results:
            _print_file(console, path, tally, args)
        style = "red" if total.failed else "green" if total.compared else "yellow"
        console.print(f"total: {total.summary()}", style=style)
        if not total.compared:
            console.print("nothing was compared", style="yellow")
    missing = [name for name in args.id if name not in total.chosen] if whole else []
    for name in missing:
        sys.stderr.write(f"conformance verify: no record {name!r} in these files\n")
    if not whole:
        sys.stderr.write("conformance verify: broken off; this is what was compared so far\n")
    if total.failed:
        return exit_codes.FAILURES
    if not whole:
        return exit_codes.BROKEN_OFF
    return exit_codes.OK if total.compared and not missing else exit_codes.NOTHING_RAN


def _vector_files(given: list[Path]) -> list[Path]:
    from conformance.vector_library import GEOMETRY_FILES, WORLD_FILE

    shared = {*GEOMETRY_FILES, WORLD_FILE}
    paths: list[Path] = []
    for path in (path for one in given for path in meant(one)):
        if path.is_dir():
            paths += (found := sorted(p for p in path.glob("*.jsonl") if p.name not in shared))
            if not found:
                raise UsageError(f"no vector file (*.jsonl) in {path}")
        elif path.is_file():
            paths += [path] if path.name not in shared else []
        else:
            raise UsageError(f"no such file: {path}")
    return paths


def _verify(paths: list[Path], args: argparse.Namespace) -> tuple[list[tuple[Path, Tally]], Tally, bool]:
    """Return what came of each file and of all of them, and whether all were read to their end."""
    from conformance.candidates.base import close
    from conformance.console import Progress
    from conformance.vector_library import Library
    from conformance.verification import Failure, Tally

    candidate = candidate_from(args)
    libraries: dict[Path, Library] = {}
    results: list[tuple[Path, Tally]] = []
    whole = True
    try:
        with Progress() as progress:
            for path in paths:
                library = libraries.setdefault(path.parent, Library(path.parent))
                results.append((path, Tally()))
                _verify_file(*results[-1], candidate, library, args, progress)
    except KeyboardInterrupt:
        whole = False
    wrong = [
        (folder, [Failure(error.line, None, error=str(error)) for error in library.errors])
        for folder, library in libraries.items()
    ]
    stopping = [Failure(None, None, error=complaint) for complaint in close(candidate)]
    for where, failures in [*wrong, (Path(args.candidate), stopping)]:
        if failures:
            results.append((where, Tally(failed=len(failures), failures=failures)))
    total = Tally()
    for _, tally in results:
        total.add(tally)
    return results, total, whole


def _verify_file(
    path: Path,
    tally: Tally,
    candidate: Candidate,
    library: Library,
    args: argparse.Namespace,
    progress: Progress,
) -> None:
    """Verify one file; that it cannot be read is a failure of its own, and the others go on."""
    from conformance.verification import Failure, verify_file

    try:
        verify_file(path, candidate, library, only=args.id, progress=progress, tally=tally)
    except OSError as error:
        tally.fail(Failure(None, None, error=f"{path}: {error.strerror or error}"))


def _print_file(console: Console, path: Path, tally: Tally, args: argparse.Namespace) -> None:
    console.print(f"{path}: {tally.summary()}")
    shown = tally.failures[: args.max_differences]
    for failure in shown:
        console.print(_explain(path, failure, args.candidate), style="red")
        console.print()
    if len(tally.failures) > len(shown):
        console.print(f"  ... and {len(tally.failures) - len(shown)} more failing records")


def _explain(path: Path, failure: Failure, candidate: str) -> str:
    from conformance.report.text import quoted_spec, render_failure

    if failure.record is None:
        return f"  {failure.error}"
    if failure.error:
        return f"  {path}:{failure.line} {failure.record.id}: {candidate} failed: {failure.error}"
    return render_failure(
        case=f"{path}:{failure.line} {failure.record.id}",
        title="",
        differences=failure.differences,
        candidate=candidate,
        query=failure.record.query,
        rerun=f"conformance verify {quoted(path)} --id {failure.record.id} --candidate "
        + quoted_spec(candidate),
    )


def quoted(path: Path) -> str:
    """Return a path as one argument of a command, in the shells of every platform."""
    return f'"{path}"'


def _print_json(results: list[tuple[Path, Tally]], total: Tally, candidate: str) -> None:
    from conformance.console import print_document

    files = [
        {
            "file": str(path),
            **tally.counts(),
            "failures": [_failure_record(failure) for failure in tally.failures],
        }
        for path, tally in results
    ]
    print_document(json.dumps({"candidate": candidate, "total": total.counts(), "files": files}) + "\n")


def _failure_record(failure: Failure) -> dict[str, Any]:
    record: dict[str, Any] = {"line": failure.line}
    if failure.record is not None:
        record["id"] = failure.record.id
    if failure.error:
        record["error"] = failure.error
    record["differences"] = [_difference_record(difference) for difference in failure.differences]
    return record


def _difference_record(difference: Difference) -> dict[str, Any]:
    from conformance.report.values import format_value

    return {
        "field": difference.path,
        "name": difference.name,
        "retail": format_value(difference.kind, difference.retail),
        "candidate": format_value(difference.kind, difference.candidate),
        "ulps": difference.ulps,
    }
