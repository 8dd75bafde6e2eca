"""Options that several commands share."""

from __future__ import annotations

from contextlib import contextmanager
from typing import TYPE_CHECKING

from conformance.option_types import positive

if TYPE_CHECKING:
    import argparse
    from collections.abc import Iterator

    from conformance.candidates.base import Candidate


class UsageError(Exception):
    """A command that was asked for something that is not there; its message is for the user."""


def add_candidate_option(parser: argparse.ArgumentParser, *, default: str) -> None:
    """Add ``--candidate``."""
    parser.add_argument(
        "--candidate",
        default=default,
        metavar="SPEC",
        help="oracle, engine, single, double, exact, bug:NAME (`conformance bugs` lists them), "
        '"cmd:./my-engine --flag" for an engine that speaks protocol v1, mod:package.module:factory for a '
        "Python object (default: %(default)s)",
    )
    parser.add_argument(
        "--read-timeout",
        type=positive("seconds"),
        metavar="SECONDS",
        help="within which a cmd: engine must reply, or be started anew (default: 30)",
    )


def check_jobs(jobs: int) -> None:
    """Raise `UsageError` if there cannot be so many processes."""
    from conformance.workers import MOST_WORKERS

    if not 1 <= jobs <= MOST_WORKERS:
        raise UsageError(f"--jobs {jobs}: from 1 to {MOST_WORKERS} processes are possible")


def candidate_from(args: argparse.Namespace) -> Candidate:
    """Make the candidate that ``--candidate`` names; raises `UsageError` if it cannot be made."""
    from conformance.candidates.registry import make_candidate

    with _usage_errors():
        return make_candidate(args.candidate, read_timeout=args.read_timeout)


def check_candidate(args: argparse.Namespace) -> None:
    """Raise `UsageError` if there is no candidate of the name that ``--candidate`` gives; make none."""
    from conformance.candidates.registry import check_spec

    with _usage_errors():
        check_spec(args.candidate)


@contextmanager
def _usage_errors() -> Iterator[None]:
    """Turn what is wrong with a candidate's name into a `UsageError`."""
    from conformance.candidates.registry import CANDIDATE_ERRORS

    try:
        yield
    except CANDIDATE_ERRORS as error:
        raise UsageError(str(error)) from error
