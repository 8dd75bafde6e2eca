"""Work: lists of different queries, in the form that all implementations start from, and parts of it."""

from __future__ import annotations

from dataclasses import dataclass, fields, replace
from typing import TYPE_CHECKING, Protocol, Self

if TYPE_CHECKING:
    from conformance.bench.scenes import BenchScene, Floats, Indices
    from engine.query import Rows


class Work(Protocol):
    """Queries that can be taken apart."""

    def __len__(self) -> int:
        """Return the number of queries."""
        ...

    def part(self, first: int, last: int) -> Self:
        """Return some of the queries."""
        ...


@dataclass(frozen=True, slots=True, eq=False)
class KernelWork:
    """Queries of a tree, in the frame of the cell; all numbers float32, kept as contiguous float64.

    Attributes
    ----------
    scene : BenchScene
    spheres : ndarray, shape (n, 4)
        Centre and radius, metres.
    movements : ndarray, shape (n, 3)
        Metres.
    ups : ndarray, shape (n, 3)
        Unit vectors; read by a step down only, as is what follows.
    allowances, interps : ndarray, shape (n,)
        Smallest z of a normal that can be walked on, and the part of the step that is left.
    """

    scene: BenchScene
    spheres: Floats
    movements: Floats
    ups: Floats
    allowances: Floats
    interps: Floats

    def __len__(self) -> int:
        return len(self.spheres)

    def part(self, first: int, last: int) -> KernelWork:
        """Return some of the queries: views of the same memory."""
        return self._of(slice(first, last))

    def sorted(self, order: Indices) -> KernelWork:
        """Return all queries in another order: copies, as contiguous as these."""
        return self._of(order)

    def _of(self, which: slice | Indices) -> KernelWork:
        arrays = {f.name: getattr(self, f.name)[which] for f in fields(self) if f.name != "scene"}
        return replace(self, **arrays)


@dataclass(frozen=True, slots=True, eq=False)
class RowWork:
    """Queries as the engine's own rows: calls of a tree, whole moves, or bodies that tick.

    Attributes
    ----------
    scene : BenchScene
    rows : records
        Of `engine.layout.QUERY_DTYPE`, or `engine.body_layout.BODY_DTYPE`. Not to be changed.
    """

    scene: BenchScene
    rows: Rows

    def __len__(self) -> int:
        return len(self.rows)

    def part(self, first: int, last: int) -> RowWork:
        """Return some of the queries: views of the same memory."""
        return replace(self, rows=self.rows[first:last])


def batches(count: int, batch: int) -> list[tuple[int, int]]:
    """Return first and last of the calls that ask `count` queries, `batch` at a time."""
    return [(first, min(first + batch, count)) for first in range(0, count, batch)]
