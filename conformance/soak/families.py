"""What a campaign draws from: the families of random queries, and how often each comes."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Final

from conformance.bug_hunt import FAMILIES
from conformance.gate.at_random import WALKS

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

    from hypothesis.strategies import SearchStrategy

    from conformance.query import Query

STRATEGIES: Final[Mapping[str, SearchStrategy[Query]]] = {**FAMILIES, **WALKS}
"""Every family of random queries, by name."""
_OFTEN: Final = {
    "collision calls": 20,
    "transitions": 20,
    "worlds": 20,
    "rare encounters": 14,
    "objects": 10,
    "single calls": 8,
    "cells": 6,
}
_SELDOM: Final = 0.5
"""Of a hundred queries, of each family of walks: one is sixty moves, and takes as long as ten calls."""


@dataclass(frozen=True, slots=True)
class Mix:
    """Families, and how often each is drawn.

    Attributes
    ----------
    names : tuple of str
    weights : tuple of float
        Of each, a pure number.
    """

    names: tuple[str, ...]
    weights: tuple[float, ...]


def mix_of(names: Iterable[str] = ()) -> Mix:
    """Return the mix of some families, or of all; the order in which they are named does not count.

    Raises
    ------
    KeyError
        There is no family of a name.
    """
    wanted = set(names) or set(STRATEGIES)
    unknown = wanted - set(STRATEGIES)
    if unknown:
        raise KeyError(min(unknown))
    chosen = tuple(name for name in STRATEGIES if name in wanted)
    return Mix(chosen, tuple(float(_OFTEN.get(name, _SELDOM)) for name in chosen))
