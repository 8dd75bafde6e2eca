"""Compilation ahead of the first query."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import pytest

import engine
from engine.kernels import program, tree_calls

if TYPE_CHECKING:
    from collections.abc import Callable

ENTRIES: list[Callable[..., Any]] = [program.run, tree_calls.step_down_many, tree_calls.strike_many]


@pytest.mark.parametrize("kernel", ENTRIES)
def test_everything_that_queries_run_is_compiled(kernel: Any) -> None:
    """A second call compiles nothing more."""
    engine.warmup()
    compiled = len(kernel.overloads)
    assert compiled > 0
    engine.warmup()
    assert len(kernel.overloads) == compiled
