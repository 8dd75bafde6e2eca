"""Kernels are linked, optimised and made into machine code once: with the entry that calls them.

Numba finishes every function by itself: what it calls is linked in, and all of it optimised and made
into machine code once more. In a program of some two hundred functions that call each other, ten and
more levels deep, nearly all of the time goes into code that is thrown away. Here a kernel keeps its own
code only, as the first passes leave it; an entry links everything below it, whose functions become
internal to it, so that what a call passes and doesn't need is dropped.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from numba.core.codegen import JITCodeLibrary

if TYPE_CHECKING:
    from collections.abc import Iterator


class _NoEnvironment:
    """Stands for the code generator where a kernel's Python environment would be stored."""

    def set_env(self, name: str, environment: Any) -> None:
        """Do nothing: there is no address to store it at, and nothing that reads it."""


class _Library(JITCodeLibrary):
    """Numba's, which spends no pass on a function that is only declared."""

    def _optimize_functions(self, ll_module: Any) -> None:
        """Run LLVM's passes over each function with a body by itself."""
        ll_module.data_layout = self._codegen._data_layout  # noqa: SLF001
        passes, builder = self._codegen._function_pass_manager()  # noqa: SLF001
        for function in ll_module.functions:
            if not function.is_declaration:
                passes.run(function, builder)


class KernelLibrary(_Library):
    """The code of one kernel, without what it calls; only ever linked into others."""

    codegen = _NoEnvironment()

    def finalize(self) -> None:
        """Be ready for linking, which is all that is asked of it."""
        self._raise_if_finalized()
        self._finalized = True

    def get_pointer_to_function(self, name: str) -> int:  # noqa: ARG002 - as Numba calls it
        """Return 0: there is no machine code, so Python can't call it."""
        return 0

    def own_module(self) -> Any:
        """Return the code that was generated, to be linked."""
        return self._final_module


class EntryLibrary(_Library):
    """The code of a kernel that Python calls, and of all that it calls."""

    def finalize(self) -> None:
        """Link all kernels below, and optimise them as one program."""
        self._raise_if_finalized()
        exported = {function.name for function in self._final_module.functions if not function.is_declaration}
        for module in _modules_below(self):
            self._final_module.link_in(module, preserve=True)
        for function in self._final_module.functions:
            if not function.is_declaration and function.name not in exported:
                function.linkage = "internal"
        self._optimize_final_module()
        self._final_module.verify()
        self._finalize_final_module()


def _modules_below(library: Any) -> Iterator[Any]:
    """Yield the module of each library that one needs, directly or not, once."""
    seen = {library}
    waiting = list(library._linking_libraries)  # noqa: SLF001 - kept by Numba for its own linking
    while waiting:
        needed = waiting.pop()
        if needed in seen:
            continue
        seen.add(needed)
        if isinstance(needed, KernelLibrary):
            waiting.extend(needed._linking_libraries)  # noqa: SLF001
            yield needed.own_module()
        else:
            yield needed._get_module_for_linking()  # noqa: SLF001
