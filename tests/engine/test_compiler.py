"""What Numba's compiler does for kernels, and what it is spared."""

from __future__ import annotations

import operator
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest
from numba import int64, types, uint64
from numba.core.caching import NullCache
from numba.core.errors import TypingError
from numba.core.registry import cpu_target
from numba.core.typing.context import Context

from engine.kernels.compile import entry, kernel
from engine.kernels.compiler import KernelTyping

if TYPE_CHECKING:
    from engine.kernels.types import Array


@kernel
def _larger(x: float, y: float) -> tuple[float, int]:
    which = 0
    if y > x:
        x = y
        which = 1
    return x, which


@entry
def largest(numbers: Array, default: float) -> tuple[float, int]:
    """Return the largest number, and how often it was replaced."""
    found, replaced = default, 0
    for k in range(len(numbers)):
        found, which = _larger(found, numbers[k])
        replaced += which
    return found, replaced


@pytest.fixture(autouse=True)
def uncached(monkeypatch: pytest.MonkeyPatch) -> None:
    """Compile anew: what comes from the cache has another history."""
    monkeypatch.setattr(largest, "_cache", NullCache())


@pytest.fixture
def typing() -> KernelTyping:
    """Return rules of types that remember nothing yet."""
    context: Any = cpu_target.typing_context
    context.refresh()
    return KernelTyping(context)


def test_variables_that_loops_and_branches_change_hold_what_was_stored_last() -> None:
    """Variables are never released, also those that are set in one of two branches, again and again."""
    assert largest(np.array([1.0, 3.0, 2.0, 5.0]), 0.5) == (5.0, 3)
    assert largest(np.array([1.0]), 7.0) == (7.0, 0)


@pytest.mark.parametrize("operation", [operator.add, operator.sub, operator.mul, operator.lt, operator.eq])
@pytest.mark.parametrize(
    "other", [int64, uint64, types.float64, types.float32, types.literal(3), types.boolean]
)
def test_remembered_types_are_those_that_numba_finds(
    typing: KernelTyping, operation: Any, other: Any
) -> None:
    """The first time and later."""
    for arguments in ((int64, other), (types.float64, other)):
        found = Context.resolve_function_type(typing, operation, arguments, {})
        assert typing.resolve_function_type(operation, arguments, {}) == found
        assert typing.resolve_function_type(operation, arguments, {}) == found


def test_an_operation_without_a_meaning_is_refused_each_time(typing: KernelTyping) -> None:
    """What fails is not remembered."""
    for _ in range(2):
        with pytest.raises(TypingError):
            typing.resolve_function_type(operator.add, (types.float64, types.unicode_type), {})


def test_what_kernels_call_is_asked_each_time(typing: KernelTyping) -> None:
    """Each of them knows for itself what it has been compiled for."""
    called = types.Dispatcher(_larger)
    found = typing.resolve_function_type(called, (types.float64, types.float64), {})
    assert found.args == (types.float64, types.float64)
    with pytest.raises(TypingError, match="missing a required argument: 'y'"):
        typing.resolve_function_type(called, (types.float64,), {})
    assert not vars(typing)["_remembered"]
