"""What a family is made of: sweeps, in parts that can be run anywhere in any order."""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import TYPE_CHECKING, TypeAlias

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from conformance.query import Fields, Query
    from conformance.stress.findings import Findings
    from conformance.stress.models import Models

    Say: TypeAlias = Callable[[str], None]
    """How a long part tells how far it is."""


class Sweep(ABC):
    """One thing that is made worse and worse.

    Attributes
    ----------
    family, name : str
        What it is called; a family's names differ.
    axis : str
        What the severity is, with its unit.
    cost : int
        About how long a part takes, compared with others: parts that take long are begun first.
    """

    family: str
    name: str
    axis: str
    cost: int = 1

    @property
    @abstractmethod
    def parts(self) -> int:
        """Number of parts that are run independently of each other."""

    @abstractmethod
    def run(self, part: int, models: Models, say: Say) -> Findings:
        """Run one part."""


@dataclass(frozen=True, slots=True, eq=False)
class Probe:
    """One query of a sweep.

    Attributes
    ----------
    query : Query
        What everyone is asked.
    watch : callable, optional
        Measures an answer's fields in another way than against the exact answer.
    """

    query: Query
    watch: Callable[[Fields], Mapping[str, float]] | None = None
