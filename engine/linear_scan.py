"""Brute force, counted: how many polygons would be tested if trees were lists.

Kernels are run by Python (`engine.tracing_interpreter`), with the walks through trees counted: each stands
for a linear scan, which tests every polygon of the tree once.
"""

from __future__ import annotations

from contextlib import contextmanager
from typing import TYPE_CHECKING, Any, Final

import numpy as np

from engine.kernels.bsp_node import is_leaf, leaf_polygons, negative, positive
from engine.kernels.bsp_poly import (
    sphere_intersects_poly,
    sphere_intersects_solid,
    sphere_intersects_solid_poly,
)
from engine.kernels.bsp_walkable import find_walkable, hits_walkable
from engine.tracing import run_by
from engine.tracing_interpreter import Interpreter

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from engine.kernels.types import Ints

_WALKS: Final = (
    sphere_intersects_poly,
    sphere_intersects_solid,
    sphere_intersects_solid_poly,
    find_walkable,
    hits_walkable,
)
"""The kernels that walk through a tree; each has the same first four arguments."""


class LinearScan:
    """Runs kernels interpreted, and counts.

    Attributes
    ----------
    walks : int
        Walks through trees.
    polygons : int
        What as many linear scans would test.
    """

    def __init__(self) -> None:
        self.walks = 0
        self.polygons = 0
        self._interpreter: Final = Interpreter({walk: self._counted(walk) for walk in _WALKS})

    def run(self, kernel: Any, *arguments: Any) -> Any:
        """Run a kernel interpreted, with the results that it has compiled."""
        given = [np.float64(value) if isinstance(value, float) else value for value in arguments]
        with np.errstate(all="ignore"):
            return self._interpreter.function(kernel)(*given)

    def _counted(self, walk: Any) -> Callable[..., Any]:
        def counted(wf: Any, wi: Ints, s: Any, root: int, *rest: Any) -> Any:
            self.walks += 1
            self.polygons += self._size(wi, int(root))
            return self._interpreter.unreplaced(walk)(wf, wi, s, root, *rest)

        return counted

    def _size(self, wi: Ints, root: int) -> int:
        """Return how many polygons a tree holds."""
        ask = self._interpreter.function
        found: set[int] = set()
        waiting = [root]
        while waiting:
            node = waiting.pop()
            if ask(is_leaf)(wi, node):
                first, count = (int(n) for n in ask(leaf_polygons)(wi, node))
                found.update(wi[first : first + count].tolist())
            else:
                waiting += [int(ask(positive)(node)), int(ask(negative)(wi, node))]
        return len(found)


@contextmanager
def scanning() -> Iterator[LinearScan]:
    """Count what linear scans would test in queries that are run inside the block, in this thread."""
    scan = LinearScan()
    with run_by(scan):
        yield scan
