"""`conformance fmt`: case files in one layout, so that a change of a case shows nothing else."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Final

from conformance import exit_codes
from conformance.commands.options import UsageError

if TYPE_CHECKING:
    import argparse

HELP: Final = "put case files in one layout: order of keys, empty lines; comments are kept"
EXAMPLES: Final = ("conformance fmt my-cases", "conformance fmt --check my-cases conformance/cases")


def configure(parser: argparse.ArgumentParser) -> None:
    """Add the command's arguments."""
    parser.add_argument("paths", nargs="+", type=Path, metavar="PATH", help="files or folders")
    parser.add_argument(
        "--check", action="store_true", help="write nothing; exit code 1 if a file would change"
    )


def run(args: argparse.Namespace) -> int:
    """Write what is laid out anew; return 1 if a file cannot be, or with ``--check`` would change."""
    from conformance.console import Progress, make_console
    from conformance.loader import NoCasesError, case_files

    try:
        files = [file for path in args.paths for file in case_files(path)]
    except NoCasesError as error:
        raise UsageError(str(error)) from error
    console = make_console()
    changed = failed = 0
    with Progress() as progress:
        for number, file in enumerate(files, start=1):
            progress.say(f"{number} of {len(files)} files: {file}")
            line, is_bad = _lay_out(file, check=args.check)
            if line:
                console.print(line, style="red" if is_bad else None)
            changed += bool(line) and not is_bad
            failed += is_bad
    what = "would change" if args.check else "changed"
    count = f"{len(files)} file{'' if len(files) == 1 else 's'}"
    console.print(f"{count}, {changed} {what}" + (f", {failed} cannot be laid out" if failed else ""))
    return exit_codes.FAILURES if failed or (args.check and changed) else exit_codes.OK


def _lay_out(file: Path, *, check: bool) -> tuple[str, bool]:
    """Lay out a file; return what to print, if anything, and whether it is a complaint."""
    from conformance.files import write_text
    from conformance.life.layout import LayoutError, lay_out
    from conformance.yaml_source import YamlError

    raw = file.read_bytes()
    try:
        text = lay_out(raw, str(file))
    except (LayoutError, YamlError) as error:
        return str(error), True
    if text.encode("utf-8") == raw:
        return "", False
    if check:
        return f"{file}: would change", False
    write_text(file, text)
    return f"{file}: changed", False
