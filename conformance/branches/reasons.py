"""Why some branches of the oracle are reached by no case; an entry that is no longer true is a mistake."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum
from typing import TYPE_CHECKING, Final, NamedTuple, TypeAlias

from conformance.source import nearest

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from conformance.branches.measure import Reach, Site
    from conformance.branches.sites import Branch, Function

NEVER_CALLED: Final = "never called"
"""Key of a reason that speaks of a whole function."""


class Kind(Enum):
    """What keeps cases from a branch."""

    NOT_ASKED = "no operation calls it"
    """A function of retail that nothing of movement calls; the oracle's own tests call it."""
    NO_INPUT = "no valid input leads there"
    """A branch of retail that its callers, or the checks of scenes, have decided before."""
    GUARD = "a guard of the port"
    """It raises an error for a caller's mistake, where retail would read what is not there."""


class Reason(NamedTuple):
    """Why no case takes a branch.

    Attributes
    ----------
    kind : Kind
        What keeps cases away.
    text : str
        The reason, in words.
    """

    kind: Kind
    text: str


Reasons: TypeAlias = "Mapping[str, Mapping[str, Reason]]"
"""Reason by function (module and qualified name) and branch."""


@dataclass(frozen=True, slots=True)
class Gap:
    """A branch that no case reaches, or a function that no case calls.

    Attributes
    ----------
    site : Site
        The function.
    branch : Branch or None
        The branch; None for a function that is never called.
    branches : int
        How many branches that is.
    reason : Reason or None
        Why; None if nothing is recorded.
    """

    site: Site
    branch: Branch | None
    branches: int
    reason: Reason | None


def gaps(reached: Mapping[Site, Reach], reasons: Reasons) -> list[Gap]:
    """List what a run did not reach, with what is recorded about it.

    A function that was never called is one gap, whatever branches it has.
    """
    found: list[Gap] = []
    for site, reach in reached.items():
        recorded = reasons.get(site.key, {})
        if reach.called:
            found += [Gap(site, branch, 1, recorded.get(branch.key)) for branch in reach.missed]
        else:
            found.append(Gap(site, None, reach.total, recorded.get(NEVER_CALLED)))
    return found


def unknown_reasons(functions: Mapping[str, Function], reasons: Reasons) -> Iterator[str]:
    """Say of each entry that speaks of no branch of the oracle which it is.

    Parameters
    ----------
    functions : Mapping of str to Function
        Every measured function, by the key of its site.
    reasons : Reasons
        What is recorded.
    """
    for name, entries in reasons.items():
        function = functions.get(name)
        if function is None:
            yield f"{name}: the oracle has no such function.{_hint(name, functions)}"
            continue
        known = {NEVER_CALLED, *(branch.key for branch in function.branches)}
        for key in entries:
            if key not in known:
                yield f"{name}: it has no branch {key!r}.{_hint(key, known)}"


def stale_reasons(reached: Mapping[Site, Reach], reasons: Reasons) -> Iterator[str]:
    """Say of each entry about something that a run did reach which it is."""
    for site, reach in reached.items():
        entries = reasons.get(site.key, {})
        if reach.called and NEVER_CALLED in entries:
            yield f"{site.key}: it is called"
        yield from (f"{site.key}: {b.key} is taken" for b in reach.taken if b.key in entries)


def _hint(name: str, known: Mapping[str, Function] | set[str]) -> str:
    near = nearest(name, sorted(known))
    return f" {near[0].upper()}{near[1:]}" if near else ""
