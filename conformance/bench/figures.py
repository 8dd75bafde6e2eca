"""The little statistics of the benchmark: medians, spread, growth, and what is not dominated."""

from __future__ import annotations

import math
from dataclasses import dataclass
from statistics import median, quantiles
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Sequence


@dataclass(frozen=True, slots=True)
class Summary:
    """A median and its spread.

    Attributes
    ----------
    middle, low, high : float
        The median and the quartiles about it; all equal for a single value.
    """

    middle: float
    low: float
    high: float

    @property
    def spread(self) -> float:
        """Distance of the quartiles."""
        return self.high - self.low

    def to_record(self) -> dict[str, Any]:
        """Write it for JSON."""
        return {"median": self.middle, "quartiles": [self.low, self.high]}


def summarise(values: Sequence[float]) -> Summary:
    """Return median and quartiles of at least one value."""
    if len(values) == 1:
        return Summary(values[0], values[0], values[0])
    low, _, high = quantiles(values, n=4, method="inclusive")
    return Summary(median(values), low, high)


def growth_exponent(sizes: Sequence[float], costs: Sequence[float]) -> float:
    """Return the k of the power law ``cost = c * size ** k`` that fits best.

    Parameters
    ----------
    sizes, costs : sequences of float
        Positive, equally long; least squares of their logarithms.

    Raises
    ------
    ValueError
        If there are not two different sizes, or one number is not positive.
    """
    if len(set(sizes)) < 2:
        raise ValueError("one size does not grow")
    if min(*sizes, *costs) <= 0.0:
        raise ValueError("a power law is about positive numbers")
    x, y = [math.log(size) for size in sizes], [math.log(cost) for cost in costs]
    mean_x, mean_y = math.fsum(x) / len(x), math.fsum(y) / len(y)
    width = math.fsum((a - mean_x) ** 2 for a in x)
    return math.fsum((a - mean_x) * (b - mean_y) for a, b in zip(x, y, strict=True)) / width


def pareto(points: Sequence[tuple[float, float]]) -> list[int]:
    """Return the indices of the points that no other beats, by rising x.

    A point is beaten by one that is smaller in one coordinate and not larger in the other; of equal
    points the first counts.
    """
    order = sorted(range(len(points)), key=lambda i: (*points[i], i))
    best = math.inf
    kept = []
    for i in order:
        if points[i][1] < best:
            best = points[i][1]
            kept.append(i)
    return kept
