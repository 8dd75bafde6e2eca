"""Candidates by name: what `--candidate` accepts."""

from __future__ import annotations

from difflib import get_close_matches
from importlib import import_module
from importlib.util import find_spec
from typing import TYPE_CHECKING, Final

if TYPE_CHECKING:
    from collections.abc import Callable

    from conformance.candidates.base import Candidate

BUILT_IN: Final = {
    "engine": "conformance.candidates.engine_candidate:EngineCandidate",
    "oracle": "conformance.candidates.oracle_candidate:OracleCandidate",
    "single": "conformance.candidates.model_candidate:single",
    "double": "conformance.candidates.model_candidate:double",
    "exact": "conformance.exact.candidate:ExactCandidate",
}
"""Name, and what makes it: imported when its candidate is asked for, because some are slow to load."""
COMMAND_PREFIX: Final = "cmd:"
"""What the name of an engine in a process of its own begins with."""
MODULE_PREFIX: Final = "mod:"
"""What the name of a Python object of another package begins with."""
_FOREIGN: Final = "conformance.candidates.foreign"
EXTRAS: Final = {"exact": ("flint", "pip install 'retail-conformance[exact]'")}
"""What a candidate needs that comes with an extra: the module, and how to get it."""


class UnknownCandidateError(LookupError):
    """No candidate has this name.

    Attributes
    ----------
    spec : str
        What was asked for.
    known : tuple of str
        What there is.
    nearest : str or None
        What was probably meant.
    """

    def __init__(self, spec: str, known: tuple[str, ...]) -> None:
        self.spec = spec
        self.known = known
        self.nearest: str | None = next(iter(get_close_matches(spec, known, n=1)), None)
        hint = f" Did you mean {self.nearest!r}?" if self.nearest else ""
        others = "cmd:COMMAND and mod:PACKAGE.MODULE:FACTORY for engines of your own"
        super().__init__(f"unknown candidate {spec!r}.{hint} There are: {', '.join(known)}; {others}")


class MissingExtraError(ImportError):
    """A candidate needs something that comes with an extra of this package, and is not installed."""

    def __init__(self, spec: str, module: str, remedy: str) -> None:
        super().__init__(f"candidate {spec!r} needs {module}: {remedy}", name=module)


class BadCandidateError(ValueError):
    """An engine's command cannot be read, its program is not there, or its factory cannot be called."""


CANDIDATE_ERRORS: Final = (BadCandidateError, MissingExtraError, UnknownCandidateError)
"""What is wrong with a candidate's name, and is for the user to read."""


def candidate_names() -> tuple[str, ...]:
    """Return every name that `make_candidate` accepts, engines of other packages and processes excepted."""
    return (*BUILT_IN, *_bug_candidates())


def make_candidate(spec: str, *, read_timeout: float | None = None) -> Candidate:
    """Make a candidate.

    Parameters
    ----------
    spec : str
        ``engine``; ``oracle``, or the same with other numbers: ``single`` (every operation rounded to
        float32), ``double`` (no store rounded), ``exact`` (nothing rounded); ``bug:NAME`` for the oracle
        with one mistake; ``cmd:COMMAND`` for an engine in a process of its own, which is started when it is
        asked; ``mod:PACKAGE.MODULE:FACTORY`` for a Python object.
    read_timeout : float or None
        Seconds within which an engine in a process must reply; None: as long as usual.

    Raises
    ------
    UnknownCandidateError
        If there is no such candidate.
    MissingExtraError
        If it needs an extra that is not installed.
    BadCandidateError
        If it is a command that cannot be read or whose program is not there, or a factory that cannot be
        imported or called.
    """
    check_extra(spec)
    if spec.startswith((COMMAND_PREFIX, MODULE_PREFIX)):
        foreign: Candidate = import_module(_FOREIGN).make_foreign(spec, read_timeout)
        return foreign
    if spec in BUILT_IN:
        module, name = BUILT_IN[spec].split(":")
        make: Callable[[], Candidate] = getattr(import_module(module), name)
        return make()
    bugs = _bug_candidates()
    if spec in bugs:
        return bugs[spec]
    raise UnknownCandidateError(spec, candidate_names())


def check_spec(spec: str) -> None:
    """Raise what `make_candidate` would raise, as far as can be told without making the candidate."""
    check_extra(spec)
    if spec.startswith((COMMAND_PREFIX, MODULE_PREFIX)):
        import_module(_FOREIGN).check_foreign(spec)
    elif spec not in candidate_names():
        raise UnknownCandidateError(spec, candidate_names())


def check_extra(spec: str) -> None:
    """Raise `MissingExtraError` if a candidate needs an extra that is not installed."""
    if spec in EXTRAS and find_spec(EXTRAS[spec][0]) is None:
        raise MissingExtraError(spec, *EXTRAS[spec])


def _bug_candidates() -> dict[str, Candidate]:
    """Return a candidate for every known bug; they import the whole oracle, so only when asked."""
    made: dict[str, Candidate] = import_module("conformance.candidates.known_bugs").bug_candidates()
    return made
