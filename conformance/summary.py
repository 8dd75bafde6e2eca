"""The suite's counts: they travel in the reports of tests, so that workers and controller agree."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, Final

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

PROPERTY: Final = "conformance"
"""Name of the user property that carries a test's counts."""
MOST_REASONS: Final = 20
"""Failures told again at the end of a run, a line each."""
MOST_SKIPS: Final = 12
"""Reasons to skip that a summary names; an engine that begins with one operation has more than a hundred."""


@dataclass(slots=True)
class Counts:
    """What a run has compared.

    Attributes
    ----------
    cases, queries, random : int
        YAML cases run; their queries compared, random poses included; queries of the random tests.
    skipped : Counter
        Queries that were not compared, by reason.
    deviations : int
        Cases that fail as it is recorded of the candidate.
    reasons : list of str
        The first difference of each failed case, in a line.
    """

    cases: int = 0
    queries: int = 0
    random: int = 0
    skipped: Counter[str] = field(default_factory=Counter)
    deviations: int = 0
    reasons: list[str] = field(default_factory=list)

    def add(self, properties: Iterable[tuple[str, Any]]) -> None:
        """Add the counts of a test's report."""
        for name, value in properties:
            if name == PROPERTY:
                self._add(value)

    def _add(self, counts: Mapping[str, Any]) -> None:
        self.cases += counts.get("cases", 0)
        self.queries += counts.get("queries", 0)
        self.random += counts.get("random", 0)
        self.skipped.update(counts.get("skipped", {}))
        self.deviations += counts.get("deviations", 0)
        self.reasons += [counts["failure"]] if "failure" in counts else []

    def __bool__(self) -> bool:
        return bool(self.cases or self.random or self.skipped)

    def lines(self, candidate: str) -> list[str]:
        """Write the counts, and the reasons of the failures."""
        more = len(self.reasons) - MOST_REASONS
        tail = [f"... and {more} more failed cases"] if more > 0 else []
        return [*self.reasons[:MOST_REASONS], *tail, self._line(candidate)]

    def _line(self, candidate: str) -> str:
        parts = [
            f"{self.cases} cases",
            f"{self.queries} queries compared",
            skipped_text(self.skipped),
            f"{self.random} random queries",
            *([f"{self.deviations} failing as recorded"] if self.deviations else []),
            f"candidate {candidate}",
        ]
        return "conformance: " + ", ".join(parts)


def skipped_text(skipped: Counter[str]) -> str:
    """Write how many were skipped and why; of many reasons only the most frequent are named."""
    named = skipped.most_common(MOST_SKIPS)
    said = [f"{reason}: {count}" for reason, count in sorted(named)]
    others = len(skipped) - len(named)
    if others:
        rest = skipped.total() - sum(count for _, count in named)
        said.append(f"and {others} other reason{'' if others == 1 else 's'}: {rest}")
    return f"{skipped.total()} skipped" + (f" ({', '.join(said)})" if said else "")
