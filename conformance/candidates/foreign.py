"""Candidates that are not part of this package, by name: engines in processes, and Python objects."""

from __future__ import annotations

from contextlib import contextmanager
from typing import TYPE_CHECKING

from conformance.candidates.command_candidate import CommandCandidate
from conformance.candidates.module_candidate import FactoryError, ModuleCandidate, find_factory
from conformance.candidates.registry import COMMAND_PREFIX, MODULE_PREFIX, BadCandidateError
from conformance.protocol.process import CommandError, check_program
from conformance.protocol.session import READ_SECONDS

if TYPE_CHECKING:
    from collections.abc import Iterator

    from conformance.candidates.base import Candidate


def make_foreign(spec: str, read_timeout: float | None) -> Candidate:
    """Make the candidate of a name that begins with ``cmd:`` or ``mod:``; see `make_candidate`."""
    with _bad_candidates():
        if spec.startswith(MODULE_PREFIX):
            return ModuleCandidate(spec.removeprefix(MODULE_PREFIX))
        command = spec.removeprefix(COMMAND_PREFIX)
        check_program(command)
        seconds = READ_SECONDS if read_timeout is None else read_timeout
        return CommandCandidate(command, read_timeout=seconds)


def check_foreign(spec: str) -> None:
    """Raise `BadCandidateError` for a command without a program, or a factory, that is there."""
    with _bad_candidates():
        if spec.startswith(MODULE_PREFIX):
            find_factory(spec.removeprefix(MODULE_PREFIX))
        else:
            check_program(spec.removeprefix(COMMAND_PREFIX))


@contextmanager
def _bad_candidates() -> Iterator[None]:
    try:
        yield
    except (CommandError, FactoryError) as error:
        raise BadCandidateError(str(error)) from error
