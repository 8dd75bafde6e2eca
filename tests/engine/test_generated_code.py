"""The code that LLVM made of the kernels: no fused multiply-add, every store there, no reference counts."""

from __future__ import annotations

import json
import os
import re
import subprocess
import sys
from typing import TYPE_CHECKING, Any

import pytest
from numba import types

from engine.kernels.compile import Entry
from engine.kernels.cylsphere_responses import _meet_corner
from engine.kernels.frame import frame_cache, frame_globaltolocal
from engine.kernels.obstacle import stand_upon
from engine.kernels.polygon import polygon_make_plane
from engine.kernels.position import position_localtoglobalvec
from engine.kernels.program import run
from engine.kernels.vector import normalize_check_small

if TYPE_CHECKING:
    from collections.abc import Mapping

FLOATS = types.Array(types.float64, 1, "C")
INTS = types.Array(types.int64, 1, "C")
ROWS = types.Array(types.float64, 2, "C")
ORDER = types.Array(types.int32, 1, "C")
F = types.float64
N = types.int64

STORES = [
    (frame_cache, (FLOATS, N), 9),
    (frame_globaltolocal, (FLOATS, N, F, F, F), 6),
    (position_localtoglobalvec, (FLOATS, N, F, F, F), 3),
    (normalize_check_small, (F, F, F), 3),
    (polygon_make_plane, (FLOATS, N), 10),
    (stand_upon, (FLOATS, F, F, F, F, F, F, F), 2),
    (_meet_corner, (FLOATS, F, F, F, F, F, F, F, F, F), 17),
]
"""Kernel, types of its arguments, and how many of its values the specification stores as float32."""


def compiled(kernel: Any, signature: tuple[Any, ...]) -> Any:
    """Compile a kernel anew, past the cache, which keeps no intermediate code."""
    fresh = Entry(kernel.py_func)
    fresh.compile(signature)
    return fresh


def own_code(kernel: Any, signature: tuple[Any, ...]) -> str:
    """Return the intermediate code of a kernel, without what Python calls it by."""
    (code,) = compiled(kernel, signature).inspect_llvm().values()
    functions = code.split("\ndefine ")[1:]
    return "".join(text for text in functions if "@_ZN7cpython" not in text.partition("\n")[0])


@pytest.fixture(scope="module")
def roundings() -> Mapping[str, int]:
    """Return how many conversions to float32 each kernel has, compiled for no processor in particular.

    For some, LLVM makes several copies of a loop's body, each with its conversions.
    """
    environment = {**os.environ, "NUMBA_CPU_NAME": "generic", "NUMBA_CPU_FEATURES": ""}
    done = subprocess.run(
        [sys.executable, __file__], env=environment, capture_output=True, encoding="utf-8", check=True
    )
    found: Mapping[str, int] = json.loads(done.stdout)
    return found


@pytest.mark.parametrize(("kernel", "stores"), [(kernel, stores) for kernel, _, stores in STORES])
def test_one_rounding_for_each_store(kernel: Any, stores: int, roundings: Mapping[str, int]) -> None:
    """Each store of the specification is one conversion to float32; none is merged away or doubled."""
    assert roundings[kernel.__name__] == stores


@pytest.mark.parametrize(("kernel", "signature"), [(kernel, signature) for kernel, signature, _ in STORES])
def test_nothing_is_reordered(kernel: Any, signature: tuple[Any, ...]) -> None:
    """No operation may be taken for another that is equal in exact arithmetic."""
    code = own_code(kernel, signature)
    assert "fptrunc" in code
    assert not re.search(r"\bfast\b|\bcontract\b|\breassoc\b", code)


def test_no_fused_multiply_add_and_no_reference_counts() -> None:
    """Whole queries and ticks, with all that they call, neither fuse operations nor count references."""
    fresh = compiled(run, (FLOATS, INTS, FLOATS, N, ROWS, ROWS, ORDER, INTS))
    (code,) = fresh.inspect_llvm().values()
    (assembly,) = fresh.inspect_asm().values()
    assert "NRT_incref" not in code
    assert "llvm.fma" not in code
    assert "llvm.fmuladd" not in code
    assert not re.search(r"\b(v?fn?m(add|sub)\d*[sp]?[sd]?|fml[as])\b", assembly)  # of x86 and of ARM
    assert assembly.count("\n") > 10_000


if __name__ == "__main__":
    json.dump({k.__name__: own_code(k, s).count("= fptrunc double") for k, s, _ in STORES}, sys.stdout)
