"""What many error samples come to: median, 99th percentile and largest, and the query that was worst."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np

from conformance.exact.errors import MEASURES

if TYPE_CHECKING:
    from conformance.exact.errors import ErrorSample
    from conformance.query import Query


@dataclass(frozen=True, slots=True)
class Spread:
    """One measure over many samples.

    Attributes
    ----------
    count : int
        Samples that have it.
    median, p99, largest : float
        In the unit of the measure.
    worst : Query
        The query of the largest.
    """

    count: int
    median: float
    p99: float
    largest: float
    worst: Query


@dataclass(slots=True)
class ErrorSummary:
    """The errors of one candidate over many queries.

    Attributes
    ----------
    samples : int
        Queries that both the candidate and the exact model answered.
    flipped : int
        Those of them with another decision than exact.
    flips : Counter of str
        How often each decision differed.
    other_paths : int
        Those that decided alike, but came there another way.
    flipping : list of Query
        The queries with another decision, in the order in which they were asked.
    """

    samples: int = 0
    other_paths: int = 0
    flips: Counter[str] = field(default_factory=Counter)
    flipping: list[Query] = field(default_factory=list)
    _measured: dict[str, list[tuple[float, Query]]] = field(default_factory=dict)

    @property
    def flipped(self) -> int:
        """How many queries have another decision than exact."""
        return len(self.flipping)

    @property
    def flip_rate(self) -> float:
        """The share of queries with another decision than exact; NaN without any query."""
        return self.flipped / self.samples if self.samples else float("nan")

    def add(self, sample: ErrorSample, query: Query) -> None:
        """Take one sample."""
        self.samples += 1
        self.other_paths += sample.other_path
        if sample.flips:
            self.flipping.append(query)
            self.flips.update(name.rpartition(": ")[2] for name in sample.flips)
        for name in MEASURES:
            value = getattr(sample, name)
            if value is not None:
                self._measured.setdefault(name, []).append((value, query))

    def spread(self, measure: str) -> Spread | None:
        """Return a measure of `MEASURES` over all samples; None if none has it."""
        measured = self._measured.get(measure)
        if not measured:
            return None
        values = np.array([value for value, _ in measured])
        largest, worst = measured[int(values.argmax())]
        p99 = float(np.percentile(values, 99, method="higher"))
        return Spread(len(measured), float(np.median(values)), p99, largest, worst)
