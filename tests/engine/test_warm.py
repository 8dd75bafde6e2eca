"""Compilation ahead of the first query."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import pytest

import engine
from engine.kernels import tick, tick_gates, tree_calls
from engine.kernels.collisions import collide_many
from engine.kernels.object_calls import meet_many
from engine.kernels.resolving import resolve_many

if TYPE_CHECKING:
    from collections.abc import Callable

ENTRIES: list[Callable[..., Any]] = [
    collide_many,
    meet_many,
    resolve_many,
    tick.step_many,
    tick_gates.update_many,
    tree_calls.step_down_many,
    tree_calls.strike_many,
]


@pytest.mark.parametrize("kernel", ENTRIES)
def test_everything_that_queries_run_is_compiled(kernel: Any) -> None:
    """A second call compiles nothing more."""
    engine.warmup()
    compiled = len(kernel.overloads)
    assert compiled > 0
    engine.warmup()
    assert len(kernel.overloads) == compiled
