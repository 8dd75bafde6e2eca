"""How much a run asks."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

DEFAULT_SEED: Final = 20130131
"""Seed of a run that names none: budgets and documents are about its numbers."""


@dataclass(frozen=True, slots=True)
class Settings:
    """The size of a run.

    Attributes
    ----------
    seed : int
        Of all random moves.
    probes : int
        Queries at each severity of a sweep.
    grid : int
        Edge of a threshold's grid, float32 steps.
    ticks : int
        Length of a drifting walk.
    quick : bool
        Whether only every third severity is asked.
    """

    seed: int
    probes: int
    grid: int
    ticks: int
    quick: bool

    def thinned(self, severities: tuple[float, ...]) -> tuple[float, ...]:
        """Return the severities of a sweep that a run of this size asks: both ends are always among them."""
        if not self.quick:
            return severities
        return (*severities[:-1:3], severities[-1])


def full(seed: int = DEFAULT_SEED) -> Settings:
    """Return the size of a whole run."""
    return Settings(seed, probes=16, grid=64, ticks=100_000, quick=False)


def quick(seed: int = DEFAULT_SEED) -> Settings:
    """Return the size of a run for in between: under a minute."""
    return Settings(seed, probes=3, grid=16, ticks=1_000, quick=True)
