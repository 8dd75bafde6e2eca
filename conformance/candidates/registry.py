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
        super().__init__(f"unknown candidate {spec!r}.{hint} There are: {', '.join(known)}")


class MissingExtraError(ImportError):
    """A candidate needs something that comes with an extra of this package, and is not installed."""

    def __init__(self, spec: str, module: str, remedy: str) -> None:
        super().__init__(f"candidate {spec!r} needs {module}: {remedy}", name=module)


def candidate_names() -> tuple[str, ...]:
    """Return every name that `make_candidate` accepts."""
    return (*BUILT_IN, *_bug_candidates())


def make_candidate(spec: str) -> Candidate:
    """Make a candidate.

    Parameters
    ----------
    spec : str
        ``engine``; ``oracle``, or the same with other numbers: ``single`` (every operation rounded to
        float32), ``double`` (no store rounded), ``exact`` (nothing rounded); ``bug:NAME`` for the oracle
        with one mistake.

    Raises
    ------
    UnknownCandidateError
        If there is no such candidate.
    MissingExtraError
        If it needs an extra that is not installed.
    """
    check_extra(spec)
    if spec in BUILT_IN:
        module, name = BUILT_IN[spec].split(":")
        make: Callable[[], Candidate] = getattr(import_module(module), name)
        return make()
    bugs = _bug_candidates()
    if spec in bugs:
        return bugs[spec]
    raise UnknownCandidateError(spec, candidate_names())


def check_extra(spec: str) -> None:
    """Raise `MissingExtraError` if a candidate needs an extra that is not installed."""
    if spec in EXTRAS and find_spec(EXTRAS[spec][0]) is None:
        raise MissingExtraError(spec, *EXTRAS[spec])


def _bug_candidates() -> dict[str, Candidate]:
    """Return a candidate for every known bug; they import the whole oracle, so only when asked."""
    made: dict[str, Candidate] = import_module("conformance.candidates.known_bugs").bug_candidates()
    return made
