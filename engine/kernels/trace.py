"""The optional trace of BSP-tree calls: a letter opens a call, a digit closes it with its result.

Characters are kept as their code points behind the row. A trace longer than its capacity is cut, but
its length goes on counting, so that the caller knows how much room it needs.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from engine.constants import frozen
from engine.kernels.compile import inlined
from engine.layout import TRACE_CAPACITY, TRACE_LENGTH, WORLD_ROW

if TYPE_CHECKING:
    from engine.kernels.types import Array, Ints

INITIAL_PLACEMENT_CALL: Final = frozen(ord("I"))
PLACEMENT_CALL: Final = frozen(ord("P"))
CHECK_WALKABLE_CALL: Final = frozen(ord("W"))
STEP_DOWN_CALL: Final = frozen(ord("D"))
LANDING_CALL: Final = frozen(ord("L"))
CONTACT_CALL: Final = frozen(ord("K"))
CLIPPED_CALL: Final = frozen(ord("M"))
AIRBORNE_CALL: Final = frozen(ord("A"))
TERRAIN_CALL: Final = frozen(ord("T"))
BUILDING_CALL: Final = frozen(ord("B"))
SPHERE_CALL: Final = frozen(ord("S"))
CYLSPHERE_CALL: Final = frozen(ord("C"))
_ZERO: Final = frozen(ord("0"))


@inlined
def trace_open(wi: Ints, s: Array, letter: int) -> None:
    """Note that a call begins."""
    capacity = int(s[TRACE_CAPACITY])
    if capacity > 0:
        length = int(s[TRACE_LENGTH])
        if length < capacity:
            s[wi[WORLD_ROW] + length] = letter
        s[TRACE_LENGTH] = length + 1


@inlined
def trace_close(wi: Ints, s: Array, result: int) -> None:
    """Note with which TransitionState the innermost open call ends."""
    trace_open(wi, s, _ZERO + result)
