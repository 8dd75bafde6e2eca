"""Numba's compiler, with what kernels have no use for left out, and nothing worked out twice.

Most of a compilation is Python code, not LLVM's: some thirty passes over each of five hundred functions,
which find the types of every operation anew. Kernels are made of few types and few operations, define no
functions, catch no exceptions and count no references.
"""

from __future__ import annotations

from functools import cache
from typing import Any, Final

from numba.core import types
from numba.core.compiler import Compiler, Flags
from numba.core.compiler_machinery import PassManager
from numba.core.typed_passes import (
    DumpParforDiagnostics,
    InlineOverloads,
    IRLegalization,
    NativeLowering,
    NopythonRewrites,
)
from numba.core.typing.context import Context
from numba.core.untyped_passes import (
    DeadBranchPrune,
    FindLiterallyCalls,
    InlineClosureLikes,
    InlineInlinables,
    LiteralPropagationSubPipelinePass,
    LiteralUnroll,
    MakeFunctionToJitFunction,
    RewriteDynamicRaises,
    RewriteSemanticConstants,
    WithLifting,
)

from engine.kernels.lowering import KernelLegalization, KernelLowering

_UNNEEDED: Final = {
    DeadBranchPrune: "no branch depends on whether an argument is None, or on a number of dimensions",
    DumpParforDiagnostics: "no loop is made parallel by Numba",
    FindLiterallyCalls: "nobody calls `literally`",
    InlineClosureLikes: "no function is defined within a kernel",
    InlineInlinables: "LLVM does what `inlined` asks for",
    InlineOverloads: "the same",
    LiteralPropagationSubPipelinePass: "nobody calls `isinstance`",
    LiteralUnroll: "nobody calls `literal_unroll`",
    MakeFunctionToJitFunction: "no function is defined within a kernel",
    NopythonRewrites: "kernels compute with numbers, not with arrays",
    RewriteDynamicRaises: "nothing is raised",
    RewriteSemanticConstants: "nobody asks for a number of dimensions",
    WithLifting: "there are no `with` statements",
}
"""Passes that find nothing to do, and why."""

_REPLACED: Final = {IRLegalization: KernelLegalization, NativeLowering: KernelLowering}
"""Passes that do more than is needed, and what stands in for them."""


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


class KernelTyping(Context):
    """Numba's rules of types, which remembers what an operation gives.

    For each ``+`` Numba tries all that it knows, arrays and dates among them. What kernels call isn't
    remembered here: each of them knows for itself, and may be in the middle of being compiled.
    """

    def __init__(self, typing: Context) -> None:
        # Nothing is copied but references: whatever is declared to these rules is known here.
        vars(self).update(vars(typing))
        self._remembered: dict[Any, Any] = {}

    def resolve_function_type(self, func: Any, args: Any, kws: Any) -> Any:
        """Return the types of a call's arguments and of its result; None if it has no meaning."""
        if kws or isinstance(func, (types.Dispatcher, types.RecursiveCall)):
            return super().resolve_function_type(func, args, kws)
        asked = func, args
        found = self._remembered.get(asked)
        if found is None:
            found = super().resolve_function_type(func, args, kws)
            if found is not None:
                self._remembered[asked] = found
        return found


class KernelPasses(PassManager):
    """Passes in turn, none of them timed, watched or reported."""

    def _runPass(self, index: int, step: Any, state: Any) -> None:  # noqa: N802, ARG002 - as Numba calls it
        step.analysis = self._analysis
        step.run_pass(state)


_typing_of: Final = cache(KernelTyping)


class KernelCompiler(Compiler):
    """Compiles one kernel."""

    def __init__(
        self, typing: Any, target: Any, library: Any, args: Any, result: Any, flags: Any, local: Any
    ) -> None:
        super().__init__(typing, target, library, args, result, KernelFlags(flags), local)
        self.state.typingctx = _typing_of(typing)

    def define_pipelines(self) -> list[Any]:
        """Return Numba's passes without those that aren't needed."""
        (pipeline,) = super().define_pipelines()
        kernel_passes = KernelPasses(pipeline.pipeline_name)
        kernel_passes.passes = [
            (_REPLACED.get(step, step), told) for step, told in pipeline.passes if step not in _UNNEEDED
        ]
        kernel_passes.finalize()
        return [kernel_passes]
