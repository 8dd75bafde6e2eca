"""The engine otherwise: no shortcuts, several threads, after other work; or not otherwise, for the noise."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import partial
from typing import TYPE_CHECKING, Any, Final

from conformance.bench import ops
from conformance.bench.engine_jobs import engine_maker
from conformance.bench.oracle_jobs import oracle_maker
from conformance.bench.settings import CROWD, LARGE, THREADS
from engine import Plan

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping, Sequence

    from conformance.bench.timing import Job, Maker

OTHER_WORK: Final = 100
"""Queries that the oracle answers in between: ten milliseconds and more of Python."""


@dataclass(frozen=True, slots=True)
class Variant:
    """One way in which the engine meets itself as it is without a word, on one thread.

    Attributes
    ----------
    section : str
        Of a run (`conformance.bench.settings.SECTIONS`).
    ops : tuple of str
        What is asked of both.
    reference : str
        What the table calls the other side.
    note : str
        What the table says of it besides.
    threads : int
        On how many this one runs.
    options : mapping
        What else the engine is told.
    batch : int
        Queries in a call.
    after_oracle : bool
        Whether the oracle works just before its clock starts, as other programs do.
    """

    section: str
    ops: tuple[str, ...]
    reference: str = "engine"
    note: str = ""
    threads: int = 1
    options: Mapping[str, Any] = field(default_factory=dict)
    batch: int = LARGE
    after_oracle: bool = False

    def maker(self, op: str) -> Maker:
        """Return it as an implementation of an operation."""
        maker = engine_maker(op, self.batch, self.threads, self.options)
        return partial(_after_oracle, op, maker) if self.after_oracle else maker


def _after_oracle(op: str, maker: Maker, work: Any) -> Job:
    """Make a job, and let the oracle answer some of its queries before it starts, which empties caches."""
    job = maker(work)
    oracle_maker(op)(work.part(0, OTHER_WORK)).run()
    return job


VARIANTS: Final = (
    Variant("noise", (ops.STRIKE, ops.CONTACT_WALK), note="noise check"),
    Variant(
        "noise",
        (ops.STRIKE, ops.FIND_COLLISIONS, ops.CONTACT_WALK),
        "engine, after other work",
        after_oracle=True,
    ),
    Variant(
        "plans",
        (ops.CONTACT_WALK, ops.FREE_FLIGHT, ops.TICK),
        "engine, no shortcuts",
        options={"plan": Plan.none()},
    ),
    Variant(
        "plans",
        (ops.STRIKE, ops.STEP_DOWN, ops.FIND_COLLISIONS, ops.CONTACT_WALK, ops.TICK),
        "engine, as drawn",
        options={"coherent": False},
    ),
    Variant(
        "threads",
        (ops.STRIKE, ops.STEP_DOWN, ops.FIND_COLLISIONS, ops.CONTACT_WALK, ops.TICK),
        note="beside one thread",
        threads=THREADS,
    ),
    Variant("threads", (ops.STRIKE,), note="beside one thread", threads=THREADS, batch=CROWD),
)


def variants_of(sections: Sequence[str]) -> Iterator[tuple[str, int, list[Variant]]]:
    """Yield operation, batch, and the variants that some sections compare at it: they take turns together."""
    for op in ops.ENGINE_OPS:
        for batch in (LARGE, CROWD):
            those = [v for v in VARIANTS if v.section in sections and op in v.ops and v.batch == batch]
            if those:
                yield op, batch, those
