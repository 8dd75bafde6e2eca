"""How much a run measures."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Final

from conformance.bench import ops

if TYPE_CHECKING:
    from collections.abc import Mapping
    from pathlib import Path

BATCHES: Final = (1, 100, 10_000)
"""Queries in a call of the engine."""
LARGE: Final = 10_000
"""The batch in which the engine meets everybody else: a round's queries, all different."""
SMALL: Final = 1000
"""Queries of a round that are asked in smaller calls, too."""
CROWD: Final = 100_000
"""A batch so large that to start threads weighs nothing."""
THREADS: Final = 2
SECTIONS: Final = (
    *("oracle", "native", "noise", "plans", "threads", "peers", "precision", "scaling", "messages"),
)
"""What can be asked for alone."""


@dataclass(frozen=True, slots=True)
class Settings:
    """What to measure, and how often.

    Attributes
    ----------
    seed : int
        Of all random points.
    sections : tuple of str
        Of `SECTIONS`.
    scenes : tuple of str
        Of `conformance.bench.scenes.GRIDS`.
    rounds : int
        Rounds beside implementations in Python.
    fast_rounds : int
        Rounds beside compiled ones.
    sizes : mapping of str to int
        Operation to the queries of a round that one is asked who answers them one by one in Python: a sample.
    exact_moves : int
        Moves whose errors are measured.
    grids : tuple of (int, int)
        Rooms along x and y of the scenes of the scaling curves.
    case_parts, case_rounds : int
        The equal parts of the suite, and how many of them are judged over the protocol, each in a round.
    fixtures : Path or None
        Folder of real cells.
    """

    seed: int
    sections: tuple[str, ...]
    scenes: tuple[str, ...]
    rounds: int
    fast_rounds: int
    sizes: Mapping[str, int]
    exact_moves: int
    grids: tuple[tuple[int, int], ...]
    case_parts: int
    case_rounds: int
    fixtures: Path | None = field(default=None)


QUICK_SIZES: Final[Mapping[str, int]] = {
    ops.STRIKE: 800,
    ops.STEP_DOWN: 500,
    ops.FIND_COLLISIONS: 300,
    ops.CONTACT_WALK: 120,
    ops.FREE_FLIGHT: 120,
    ops.TICK: 40,
    ops.TOUCH: 500,
}
"""Chosen so that the mean cost of a sample is within 4 percent of that of all, most of the time."""
FULL_SIZES: Final[Mapping[str, int]] = {op: 2 * size for op, size in QUICK_SIZES.items()}


def quick(seed: int, sections: tuple[str, ...], fixtures: Path | None) -> Settings:
    """Return the settings of a run of about a minute."""
    return Settings(
        seed=seed,
        sections=sections,
        scenes=("room", "building"),
        rounds=5,
        fast_rounds=5,
        sizes=QUICK_SIZES,
        exact_moves=60,
        grids=((2, 1), (3, 3), (6, 6)),
        case_parts=12,
        case_rounds=3,
        fixtures=fixtures,
    )


def full(seed: int, sections: tuple[str, ...], fixtures: Path | None) -> Settings:
    """Return the settings of a whole run: a quarter of an hour or so."""
    return Settings(
        seed=seed,
        sections=sections,
        scenes=("room", "building", "dungeon"),
        rounds=11,
        fast_rounds=15,
        sizes=FULL_SIZES,
        exact_moves=120,
        grids=((2, 1), (4, 4), (7, 7), (12, 12), (22, 22), (38, 38)),
        case_parts=3,
        case_rounds=3,
        fixtures=fixtures,
    )
