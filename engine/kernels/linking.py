"""Kernels are linked, optimised and made into machine code once: with the entry that calls them.

Numba finishes every function by itself: what it calls is linked in, and all of it optimised and made
into machine code once more. In a program of some two hundred functions that call each other, ten and
more levels deep, nearly all of the time goes into code that is thrown away. Here a kernel keeps its own
code only, as the first passes leave it; an entry links everything below it, whose functions become
internal to it, so that what a call passes and doesn't need is dropped.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

from numba.core.codegen import JITCodeLibrary
from numba.core.compiler import Compiler, Flags
from numba.core.compiler_machinery import LoweringPass, register_pass
from numba.core.typed_passes import AnnotateTypes, NopythonRewrites
from numba.core.untyped_passes import InlineClosureLikes

if TYPE_CHECKING:
    from collections.abc import Iterator

_UNNEEDED: Final = (InlineClosureLikes, NopythonRewrites)
"""Passes that find nothing to do: kernels define no functions, and compute with numbers, not with arrays."""


class _NoEnvironment:
    """Stands for the code generator where a kernel's Python environment would be stored."""

    def set_env(self, name: str, environment: Any) -> None:
        """Do nothing: there is no address to store it at, and nothing that reads it."""


class KernelLibrary(JITCodeLibrary):
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


class EntryLibrary(JITCodeLibrary):
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


@register_pass(mutates_CFG=True, analysis_only=False)
class _OwnLibrary(LoweringPass):
    """Chooses the library that the following pass puts the code into."""

    _name = "kernel library"

    def __init__(self) -> None:
        LoweringPass.__init__(self)

    def run_pass(self, state: Any) -> bool:
        """Give the kernel a library of its own kind."""
        kind = KernelLibrary if state.flags.no_cpython_wrapper else EntryLibrary
        state.library = kind(state.targetctx.codegen(), state.func_id.func_qualname)
        state.library.enable_object_caching()
        return True


class KernelFlags(Flags):
    """Numba's options of a compilation, of which only those that are set are compared.

    Types are looked up by them some hundred thousand times; to compare the defaults of all others as well
    takes a tenth of the compilation.
    """

    __slots__ = ()
    _HASH: Final = hash(Flags())

    def __eq__(self, other: object) -> bool:
        return self._values == other._values if isinstance(other, KernelFlags) else super().__eq__(other)

    def __hash__(self) -> int:
        return self._HASH


class KernelCompiler(Compiler):
    """Numba's compiler, with these libraries."""

    def __init__(
        self, typing: Any, target: Any, library: Any, args: Any, result: Any, flags: Any, local: Any
    ) -> None:
        super().__init__(typing, target, library, args, result, KernelFlags(flags), local)

    def define_pipelines(self) -> list[Any]:
        """Choose the library before code is generated; leave out what kernels have no need of."""
        (pipeline,) = super().define_pipelines()
        pipeline.passes = [step for step in pipeline.passes if step[0] not in _UNNEEDED]
        pipeline.add_pass_after(_OwnLibrary, AnnotateTypes)
        pipeline.finalize()
        return [pipeline]
