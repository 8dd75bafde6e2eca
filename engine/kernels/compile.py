"""The one decorator of all kernels, and a compilation cache that notices every change.

Numba keys its cache by the file of the compiled function, but compiled code contains the callees:
after an edit of another kernel file it would run stale code. Here the key is a digest of everything
that kernels are made of. Where no cache can be written, kernels are compiled anew in each process.
"""

from __future__ import annotations

import functools
import hashlib
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final, TypeVar

from numba import njit
from numba.core.caching import (
    CompileResultCacheImpl,
    FunctionCache,
    InTreeCacheLocator,
    UserProvidedCacheLocator,
    UserWideCacheLocator,
)

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
COMPILED_IN: Final = ("body_layout.py", "constants.py", "layout.py")
"""Files beside that folder whose constants kernels hold."""


@functools.cache
def source_digest(kernels: Path = KERNELS) -> str:
    """Return the digest of all files that compiled code depends on."""
    digest = hashlib.sha256()
    for path in sorted([*kernels.glob("*.py"), *(kernels.parent / name for name in COMPILED_IN)]):
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


def _compiled(function: F, **options: Any) -> F:
    dispatcher = njit(**OPTIONS, **options)(function)
    try:
        dispatcher._cache = KernelCache(function)  # noqa: SLF001 - Numba offers no other way to a cache of one's own
    except RuntimeError:  # no folder can be written: stay uncached
        return dispatcher
    return dispatcher


def kernel(function: F) -> F:
    """Compile a function that other kernels call; Python cannot call it."""
    return _compiled(function, no_cpython_wrapper=True)


def entry(function: F) -> F:
    """Compile a function that Python, too, may call."""
    return _compiled(function)


def inlined(function: F) -> F:
    """Compile a small function into each of its callers."""
    return _compiled(function, forceinline=True, no_cpython_wrapper=True)


def pasted(function: F) -> F:
    """Paste a function into its caller before types are inferred.

    For a function that stands for itself in the source, but is called from one place, or is short and
    calls much: compiled by itself, all that it calls would be linked and optimised once more.
    """
    return _compiled(function, inline="always")
