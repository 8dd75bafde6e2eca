"""The decorators of all kernels, and a compilation cache that notices every change.

Numba keys its cache by the file of the compiled function, but compiled code contains the callees:
after an edit of another kernel file it would run stale code. Here the key is a digest of everything
that kernels are made of. Where no cache can be written, kernels are compiled anew in each process.
"""

from __future__ import annotations

import functools
import hashlib
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final, TypeVar

from numba.core.caching import (
    CompileResultCacheImpl,
    FunctionCache,
    InTreeCacheLocator,
    UserProvidedCacheLocator,
    UserWideCacheLocator,
)
from numba.core.registry import CPUDispatcher

from engine.collector import without_collector
from engine.kernels.compiler import KernelCompiler

if TYPE_CHECKING:
    from collections.abc import Callable

F = TypeVar("F", bound="Callable[..., Any]")

OPTIONS: Final[dict[str, Any]] = {
    "error_model": "numpy",  # a division by zero gives infinity or NaN, as the masked x87 does (NM-9a)
    "_nrt": False,  # kernels allocate nothing: without reference counting calls cost little
    "no_cfunc_wrapper": True,
}
"""How every kernel is compiled; no fast-math, no fused multiply-add."""


KERNELS: Final = Path(__file__).parent
COMPILED_IN: Final = ("body_layout.py", "constants.py", "layout/*.py")
"""Files beside that folder whose constants kernels hold."""


@functools.cache
def source_digest(kernels: Path = KERNELS) -> str:
    """Return the digest of all files that compiled code depends on."""
    digest = hashlib.sha256()
    constants = [path for pattern in COMPILED_IN for path in kernels.parent.glob(pattern)]
    for path in sorted([*kernels.glob("*.py"), *constants]):
        digest.update(path.name.encode("utf-8"))
        digest.update(path.read_bytes())
    return digest.hexdigest()


class _Stamped:
    """Replaces a locator's idea of freshness by the digest."""

    def get_source_stamp(self) -> str:
        return source_digest()


class _UserProvided(_Stamped, UserProvidedCacheLocator):
    """The folder named by NUMBA_CACHE_DIR."""


class _InTree(_Stamped, InTreeCacheLocator):
    """``__pycache__`` beside the kernels."""


class _UserWide(_Stamped, UserWideCacheLocator):
    """The user's cache folder, for an installation that cannot be written."""


class _CacheImpl(CompileResultCacheImpl):
    """Finds the first of these folders that can be written."""


_CacheImpl._locator_classes = [_UserProvided, _InTree, _UserWide]  # noqa: SLF001 - where Numba looks


class KernelCache(FunctionCache):
    """Numba's file cache, keyed by `source_digest`."""

    _impl_class = _CacheImpl


class Kernel(CPUDispatcher):
    """A function that only other kernels call; they link it."""

    def __init__(self, function: Callable[..., Any], **options: Any) -> None:
        targets = {"nopython": True, "no_cpython_wrapper": True, **OPTIONS, **options}
        super().__init__(function, targetoptions=targets, pipeline_class=KernelCompiler)

    def compile(self, sig: Any) -> Any:
        """Compile for types, unless that is done: each call in another kernel asks for it.

        It is the entry's compilation that is timed and locked, and whose result goes to the cache.
        """
        done: Any = self.overloads.get(sig)
        if done is None:
            compiler: Any = self._compiler  # type: ignore[attr-defined] # Numba's, of the inherited part
            with self._compiling_counter:
                done = compiler.compile(sig, None)
                self.add_overload(done)
        return done.entry_point

    def __call__(self, *_args: Any, **_options: Any) -> Any:
        """Refuse: there is nothing to run by itself."""
        raise TypeError(f"{self.py_func.__name__} is called by kernels only; an `entry` is called by Python")


class Entry(CPUDispatcher):
    """A kernel that Python calls. Other kernels call its twin, which they link."""

    def __init__(self, function: Callable[..., Any], **options: Any) -> None:
        targets = {"nopython": True, "nogil": True, **OPTIONS, **options}
        super().__init__(function, targetoptions=targets, pipeline_class=KernelCompiler)
        self._twin: Final = Kernel(function, **options)

    def compile(self, sig: Any) -> Any:
        """Compile for types, with all that it calls.

        No garbage is looked for in what a compilation keeps anyway: it is a seventh of the time.
        """
        with without_collector():
            return super().compile(sig)

    def get_call_template(self, args: Any, kws: Any) -> Any:
        """Tell Numba about a call by a kernel."""
        return self._twin.get_call_template(args, kws)

    def get_overload(self, sig: Any) -> Any:
        """Return what a call by a kernel calls."""
        return self._twin.get_overload(sig)


def _callable(function: F, **options: Any) -> F:
    dispatcher: Any = Entry(function, **options)
    try:
        dispatcher._cache = KernelCache(function)  # noqa: SLF001 - Numba offers no other way to a cache of one's own
    except RuntimeError:  # no folder can be written: stay uncached
        return dispatcher
    return dispatcher


def kernel(function: F) -> F:
    """Compile a function that other kernels call; Python cannot call it."""
    compiled: Any = Kernel(function)
    return compiled


def entry(function: F) -> F:
    """Compile a function that Python, too, may call."""
    return _callable(function)


def inlined(function: F) -> F:
    """Compile a small function into each of its callers."""
    compiled: Any = Kernel(function, forceinline=True)
    return compiled


def inlined_entry(function: F) -> F:
    """Compile a function into each of its callers that Python, too, may call."""
    return _callable(function, forceinline=True)
