"""Kernels are compiled once, and into machine code only with what Python calls."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import pytest
from numba.core.caching import NullCache

from engine.kernels.compile import Entry, entry, inlined, kernel
from engine.kernels.linking import EntryLibrary, KernelLibrary

if TYPE_CHECKING:
    from collections.abc import Callable


@kernel
def _halve(x: float) -> float:
    return x * 0.5


@inlined
def _twice_halved(x: float) -> float:
    return _halve(_halve(x))


@entry
def quarter(x: float) -> float:
    """Divide by four."""
    return _twice_halved(x)


@entry
def sixteenth(x: float) -> float:
    """Divide by sixteen."""
    return quarter(quarter(x))


def only_library(dispatcher: Any) -> Any:
    """Return the library of the only thing that a dispatcher has compiled."""
    (compiled,) = dispatcher.overloads.values()
    return compiled.library


@pytest.fixture(autouse=True)
def uncached(monkeypatch: pytest.MonkeyPatch) -> None:
    """Compile anew: what comes from the cache has another history."""
    for dispatcher in (quarter, sixteenth):
        monkeypatch.setattr(dispatcher, "_cache", NullCache())


def test_an_entry_called_by_an_entry_is_a_kernel_there() -> None:
    """It gets no machine code of its own until Python calls it."""
    assert sixteenth(32.0) == 2.0
    assert isinstance(only_library(sixteenth), EntryLibrary)
    assert isinstance(only_library(quarter._twin), KernelLibrary)  # type: ignore[attr-defined]
    assert quarter(32.0) == 8.0
    assert isinstance(only_library(quarter), EntryLibrary)


def test_what_an_entry_calls_is_internal_to_it() -> None:
    """So that the optimiser may drop arguments and results; nothing is left to be found elsewhere."""
    sixteenth(1.0)
    for function in only_library(sixteenth)._final_module.functions:
        if "_halve" in function.name and not function.is_declaration:
            assert function.linkage.name == "internal"


@pytest.mark.parametrize("internal", [_halve, _twice_halved])
def test_a_kernel_is_not_cached(internal: Callable[..., float]) -> None:
    """It is only part of entries, which are."""
    assert not isinstance(internal, Entry)
    assert isinstance(internal._cache, NullCache)  # type: ignore[attr-defined]


def test_python_cannot_call_a_kernel() -> None:
    """There is no machine code to run, and it says so."""
    sixteenth(1.0)
    with pytest.raises(TypeError, match="_halve is called by kernels only"):
        _halve(1.0)
