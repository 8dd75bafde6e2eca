"""Kernels are compiled once, and into machine code only with what Python calls."""

from __future__ import annotations

import gc
from dis import get_instructions
from importlib import import_module
from inspect import iscode
from pkgutil import iter_modules
from typing import TYPE_CHECKING, Any, Final

import pytest
from numba.core.caching import NullCache
from numba.core.compiler import Flags
from numba.core.errors import TypingError

from engine import kernels
from engine.kernels.compile import Entry, Kernel, entry, inlined, kernel
from engine.kernels.compiler import KernelFlags
from engine.kernels.linking import EntryLibrary, KernelLibrary

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator
    from types import ModuleType


LOOKED_FOR: Final = {"isinstance", "hasattr", "literally", "literal_unroll", "ndim"}
"""Names that some of Numba's passes look for."""

NUMBA_FLAGS: Any = Flags
"""Numba has no types of its own for these."""


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


def engine_kernels() -> Iterator[ModuleType]:
    """Yield all modules of kernels."""
    for found in iter_modules(kernels.__path__):
        yield import_module(f"{kernels.__name__}.{found.name}")


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


def test_options_are_equal_if_what_is_set_is() -> None:
    """Numba finds what it has compiled by them; a copy is of the same kind."""
    make: Any = KernelFlags
    given: Any = NUMBA_FLAGS()
    given.forceinline = True
    ours = make(given)
    assert ours == make(given) == ours.copy()
    assert ours == given
    assert hash(ours) == hash(given)
    assert ours != make(NUMBA_FLAGS())
    assert isinstance(ours.copy(), KernelFlags)


def test_a_kernel_is_compiled_once_for_its_types() -> None:
    """Each call of it asks for that."""
    assert quarter(4.0) == 1.0
    (types,) = _halve.overloads  # type: ignore[attr-defined]
    compiled = _halve.overloads[types]  # type: ignore[attr-defined]
    assert _halve.compile(types) == compiled.entry_point  # type: ignore[attr-defined]
    assert only_library(_halve) is compiled.library


@pytest.mark.parametrize("was_on", [True, False])
def test_a_compilation_leaves_the_collector_as_it_was(was_on: bool) -> None:
    """Also one that fails."""

    @entry
    def wrong(x: float) -> float:
        return x + "1"  # type: ignore[operator]

    (gc.enable if was_on else gc.disable)()
    try:
        with pytest.raises(TypingError):
            wrong(1.0)
        assert gc.isenabled() == was_on
    finally:
        gc.enable()


def test_no_kernel_needs_a_pass_that_is_left_out() -> None:
    """None defines a function, catches or raises an exception, or calls what such a pass looks for."""
    kernels = [
        thing
        for module in engine_kernels()
        for thing in vars(module).values()
        if isinstance(thing, (Entry, Kernel))
    ]
    assert len(kernels) > 300
    for one in kernels:
        code = one.py_func.__code__
        assert not any(iscode(constant) for constant in code.co_consts), one
        assert not code.co_exceptiontable, one
        assert not any(step.opname == "RAISE_VARARGS" for step in get_instructions(code)), one
        assert not LOOKED_FOR.intersection(code.co_names), one
