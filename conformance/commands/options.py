"""Options that several commands share."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import argparse

    from conformance.candidates.base import Candidate


class UsageError(Exception):
    """A command that was asked for something that is not there; its message is for the user."""


def add_candidate_option(parser: argparse.ArgumentParser, *, default: str) -> None:
    """Add ``--candidate``."""
    parser.add_argument(
        "--candidate",
        default=default,
        metavar="SPEC",
        help="oracle, engine, single, double, exact or bug:NAME "
        "(default: %(default)s; `conformance bugs` lists the bugs)",
    )


def candidate_from(args: argparse.Namespace) -> Candidate:
    """Make the candidate that ``--candidate`` names; raises `UsageError` if it cannot be made."""
    from conformance.candidates.registry import MissingExtraError, UnknownCandidateError, make_candidate

    try:
        return make_candidate(args.candidate)
    except (UnknownCandidateError, MissingExtraError) as error:
        raise UsageError(str(error)) from error
