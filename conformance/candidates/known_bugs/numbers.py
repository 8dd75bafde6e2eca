"""Mistakes about numbers: where they are rounded, and how rotations are computed."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

from conformance.candidates import table
from conformance.candidates.bug_candidate import KnownBug
from conformance.candidates.number_models import Single, plain
from conformance.candidates.oracle_ops import math_ops
from conformance.candidates.replacements import Everywhere, Method, with_globals
from conformance.query import Result
from oracle.arithmetic import f32
from oracle.frame import Frame

if TYPE_CHECKING:
    from collections.abc import Callable
    from types import FunctionType

    from conformance.query import Fields


def _unrounded(retail: FunctionType) -> FunctionType:
    """Make a function whose stores keep what is in the register."""
    return with_globals(retail, f32=lambda x: x)


def _rounded(retail: Callable[[Frame], list[float]]) -> Callable[[Frame], list[float]]:
    """Round what is told of a matrix: only how rotations are computed is wrong."""
    return lambda frame: [f32(m) for m in retail(frame)]


def _plain_result(_retail: Any) -> Callable[[Fields], Result]:
    return lambda fields: Result(plain(fields))


BUGS: Final = (
    KnownBug(
        "quaternion-rotation",
        "vectors are turned by the quaternion: its nine products are never rounded to a matrix",
        "a rotation goes through the cached matrix of float32s (01 4.1, 4.2)",
        (Method(Frame, "cache", _unrounded), Method(math_ops, "matrix", _rounded)),
        case="bug-quaternion-rotation",
        output="contact_plane.n.x",
    ),
    KnownBug(
        "float32-registers",
        "every operation is rounded to float32, as in a port that computes with floats throughout",
        "registers hold 53 bits, and only stores round (01 NM-1…3)",
        (
            Everywhere("conformance.candidates.oracle_ops", "f32", Single),
            Method(table, "Result", _plain_result),
        ),
        case="bug-float32-registers",
        output="result",
        rated=True,
    ),
)
