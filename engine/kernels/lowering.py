"""From typed instructions to LLVM's, without what only objects and debuggers have a use for.

Kernels hold numbers and arrays whose references aren't counted: where a variable's life ends is nothing to
note, and what it held before is nothing to release. To find that out, to write it down, and to have LLVM
read and drop it, takes a good part of a compilation.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from numba.core import ir
from numba.core.cgutils import alloca_once
from numba.core.compiler_machinery import AnalysisPass, register_pass
from numba.core.ir_utils import enforce_no_dels, enforce_no_phis
from numba.core.lowering import Lower
from numba.core.transforms import canonicalize_cfg
from numba.core.typed_passes import BaseNativeLowering

from engine.kernels.linking import EntryLibrary, KernelLibrary

if TYPE_CHECKING:
    from numba.core.types import Type


class _KernelLower(Lower):
    """Numba's, for variables that are numbers and places in memory."""

    def pre_block(self, block: Any) -> None:
        """Begin a block: in kernels none is left by an exception that they catch."""
        self._cur_ir_block = block

    def lower_inst(self, inst: Any) -> None:
        """Write one instruction; an assignment, as most are, without a thought of debuggers."""
        if isinstance(inst, ir.Assign):
            name = inst.target.name
            self.storevar(self.lower_assign(self.typeof(name), inst), name)
        else:
            super().lower_inst(inst)

    def storevar(self, value: Any, name: str, argidx: int | None = None) -> None:  # noqa: ARG002 - for debuggers
        """Store a variable; there is nothing to release of what it held."""
        if name in self._singly_assigned_vars:
            self._blk_local_varmap[name] = value
        else:
            self.builder.store(value, self.getvar(name))

    def alloca_lltype(self, name: str, lltype: Any, datamodel: Type | None = None) -> Any:  # noqa: ARG002
        """Make room for a variable, of which no debugger is told."""
        return alloca_once(self.builder, lltype, name=name)


@register_pass(mutates_CFG=True, analysis_only=False)
class KernelLowering(BaseNativeLowering):
    """Writes a kernel as LLVM's instructions, into a library of its kind."""

    _name: str = "kernel lowering"  # type: ignore[assignment] # None in the base, which Numba never runs

    @property
    def lowering_class(self) -> type[_KernelLower]:
        """What writes them."""
        return _KernelLower

    def run_pass(self, state: Any) -> bool:
        """Choose the library, then write."""
        kind = KernelLibrary if state.flags.no_cpython_wrapper else EntryLibrary
        state.library = kind(state.targetctx.codegen(), state.func_id.func_qualname)
        state.library.enable_object_caching()
        return bool(super().run_pass(state))


@register_pass(mutates_CFG=True, analysis_only=False)
class KernelLegalization(AnalysisPass):
    """Sees to it that a kernel can be lowered; where variables end isn't looked for."""

    _name = "kernel legalization"

    def __init__(self) -> None:
        AnalysisPass.__init__(self)

    def run_pass(self, state: Any) -> bool:
        """Refuse what only earlier passes understand; leave out blocks that nothing leads to."""
        enforce_no_phis(state.func_ir)
        enforce_no_dels(state.func_ir)
        state.func_ir.blocks = canonicalize_cfg(state.func_ir.blocks)
        return True
