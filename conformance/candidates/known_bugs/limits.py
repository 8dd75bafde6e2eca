"""Mistakes about constants."""

from __future__ import annotations

from typing import Final

from conformance.candidates.bug_candidate import KnownBug
from conformance.candidates.replacements import Constant
from oracle.arithmetic import f32

_SHORT_FLOOR_Z: Final = f32(0.66417)
"""FLOOR_Z as a five-digit literal, float32."""
_SHORT_EPS: Final = f32(0.00015)
"""What a port has instead of F_EPSILON, float32; metres or a pure number."""

BUGS: Final = (
    KnownBug(
        "floor-z-0.66417",
        "the walkable limit is written with five digits, 0.66417",
        "the limit is the float32 0x3F2A0751, 0.66417414 (01 NM-8; 04 6)",
        (Constant("FLOOR_Z", _SHORT_FLOOR_Z),),
        case="bug-floor-z-five-digits",
        output="state",
    ),
    KnownBug(
        "eps-0.00015",
        "F_EPSILON is 0.00015",
        "it is the float32 of 0.0002 (01 NM-8)",
        (
            Constant("EPS", _SHORT_EPS),
            Constant("EPS2", _SHORT_EPS * _SHORT_EPS),
            Constant("EPS5", _SHORT_EPS * 5.0),
        ),
        case="bug-eps-too-small",
        output="result",
    ),
)
