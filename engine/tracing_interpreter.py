"""Running the kernels' own sources in Python, with the arithmetic that compiled code has.

Compiled code cannot be watched, and a switch in it would cost every query something. So a kernel that is
to be watched is run by Python instead: the same code object, with globals in which every kernel is such
an interpreted one, every float a NumPy number (a division by zero is infinity or NaN, not an error), and
some functions may be replaced by those of the watcher.
"""

from __future__ import annotations

import math
from threading import RLock
from types import FunctionType, SimpleNamespace
from typing import TYPE_CHECKING, Any, Final

import numpy as np
from numba.core.dispatcher import Dispatcher

from engine.kernels.abreast import flat_planes, lowest, near_planes
from engine.kernels.ahead import bring_near, bring_to_write
from engine.kernels.fours import move_four, put_four
from engine.kernels.octets import octet
from engine.kernels.sharing import add_to
from engine.kernels.sides import sides_outside
from engine.layout import ABREAST, PLANE_SIZE, SIDES, SIDES_SIZE

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

_MATH_FUNCTIONS: Final = ("acos", "asin", "atan2", "cos", "pow", "sin", "sqrt")
"""What kernels use of `math` and gives a float; their results are those of the C library."""
_WHOLE_FUNCTIONS: Final = ("ceil", "floor")
"""What gives an integer."""
_NOT_AN_INTEGER: Final = -(2**63)
"""What a conversion of a NaN, or of a number beyond 64 bits, gives in compiled code."""


class Interpreter:
    """Makes interpreted functions of compiled kernels.

    Parameters
    ----------
    replacements : mapping of kernel to callable
        What is called in place of some kernels.
    """

    def __init__(self, replacements: Mapping[Any, Callable[..., Any]]) -> None:
        self._functions: dict[Any, Callable[..., Any]] = {**_MACHINE, **replacements}
        self._unreplaced: dict[Any, Callable[..., Any]] = {}
        self._lock = RLock()
        self._namespaces: dict[str, dict[str, Any]] = {}

    def function(self, kernel: Any) -> Callable[..., Any]:
        """Return the interpreted function of a kernel, or what replaces it."""
        with self._lock:
            if kernel not in self._functions:
                self._functions[kernel] = self.unreplaced(kernel)
            return self._functions[kernel]

    def unreplaced(self, kernel: Any) -> Callable[..., Any]:
        """Return the interpreted function of a kernel, also of one that is replaced."""
        with self._lock:
            if kernel not in self._unreplaced:
                self._unreplaced[kernel] = self._interpreted(kernel)
            return self._unreplaced[kernel]

    def _interpreted(self, kernel: Any) -> Callable[..., Any]:
        source = kernel.py_func
        code = source.__code__
        code = code.replace(co_consts=_number(code.co_consts))
        return FunctionType(code, self._namespace(source.__module__, source.__globals__), source.__name__)

    def _namespace(self, module: str, names: Mapping[str, Any]) -> dict[str, Any]:
        """Return a module's globals as interpreted code sees them."""
        if module not in self._namespaces:
            namespace = self._namespaces[module] = {"int": _integer, "float": np.float64}
            # A copy: another thread may be importing into the module.
            namespace |= {name: self._value(value) for name, value in dict(names).items()}
        return self._namespaces[module]

    def _value(self, value: Any) -> Any:
        if isinstance(value, Dispatcher):
            return self.function(value)
        if value is math:
            return _MATH
        return _number(value)


def _add_to(numbers: Any, place: int, amount: int) -> int:
    """Add to a number that no other thread adds to: while kernels are watched there is one."""
    before = int(numbers[place])
    numbers[place] += amount
    return before


def _ignore(*_arguments: Any) -> None:
    """Do what a hint to the machine does: nothing that could be noticed."""


def _along(wf: Any, at: int, x: float, y: float, z: float) -> tuple[Any, Any]:
    """Return a vector's components along the normals of a block of planes, and the planes' d."""
    nx, ny, nz, d = wf[at : at + PLANE_SIZE * ABREAST].reshape(PLANE_SIZE, ABREAST)
    return (ny * y + nz * z) + nx * x, d


def _mask(flags: Any) -> int:
    return sum(1 << k for k, flag in enumerate(flags) if flag)


def _near_planes(wf: Any, at: int, count: int, x: float, y: float, z: float, reach: float) -> int:
    """Do what `engine.kernels.abreast.near_planes` does."""
    along, d = _along(wf, at, x, y, z)
    return _mask(~(reach < abs(along + d))[:count])


def _flat_planes(wf: Any, at: int, ux: float, uy: float, uz: float, least: float) -> int:
    """Do what `engine.kernels.abreast.flat_planes` does."""
    along, _ = _along(wf, at, ux, uy, uz)
    return _mask(along > least)


def _sides_outside(wf: Any, at: int, x: float, y: float, z: float, far: float) -> int:
    """Do what `engine.kernels.sides.sides_outside` does."""
    vx, vy, vz, nx, ny, nz, squared = wf[at : at + SIDES_SIZE].reshape(-1, SIDES)
    side = ((z - vz) * nz + (y - vy) * ny) + (x - vx) * nx
    outside = side < 0.0
    return _mask(outside) | _mask(outside & (side * side > squared * far)) << int(SIDES)


def _octet(numbers: Any, place: int) -> int:
    """Do what `engine.kernels.octets.octet` does."""
    return int(numbers[place >> 3]) >> 8 * (place & 7) & 0xFF


def _lowest(mask: int) -> int:
    """Do what `engine.kernels.abreast.lowest` does."""
    return int(mask & -mask).bit_length() - 1


def _put_four(numbers: Any, at: int, *four: float) -> None:
    """Do what `engine.kernels.fours.put_four` does."""
    for k, number in enumerate(four):
        numbers[at + k] = number


def _move_four(numbers: Any, at: int, source: Any, first: int) -> None:
    """Do what `engine.kernels.fours.move_four` does."""
    for k in range(4):
        numbers[at + k] = source[first + k]


def _number(value: Any) -> Any:
    """Return a number of Python as NumPy's, within tuples too."""
    if type(value) is float:
        return np.float64(value)
    return tuple(map(_number, value)) if type(value) is tuple else value


def _integer(value: Any) -> int:
    return int(value) if abs(value) < -_NOT_AN_INTEGER else _NOT_AN_INTEGER


def _real(function: Callable[..., float]) -> Callable[..., Any]:
    """Make a function of `math` give NaN where Python would raise an error."""

    def computed(*numbers: Any) -> Any:
        try:
            return np.float64(function(*numbers))
        except ValueError:
            return np.float64(math.nan)

    return computed


def _whole(function: Callable[[Any], Any]) -> Callable[[Any], int]:
    """Make a rounding give what a conversion gives that has no result."""
    return lambda number: function(number) if math.isfinite(number) else _NOT_AN_INTEGER


_MACHINE: Final[dict[Any, Callable[..., Any]]] = {
    add_to: _add_to,
    bring_near: _ignore,
    bring_to_write: _ignore,
    near_planes: _near_planes,
    sides_outside: _sides_outside,
    flat_planes: _flat_planes,
    lowest: _lowest,
    octet: _octet,
    put_four: _put_four,
    move_four: _move_four,
}
"""Kernels that are made of instructions of the machine, and what stands for them."""
_MATH: Final = SimpleNamespace(
    nan=np.float64(math.nan),
    isnan=math.isnan,
    **{name: _real(getattr(math, name)) for name in _MATH_FUNCTIONS},
    **{name: _whole(getattr(math, name)) for name in _WHOLE_FUNCTIONS},
)
"""`math` as compiled code knows it."""
