"""Interpreted kernels compute what compiled ones do, also where Python would raise an error."""

from __future__ import annotations

import math
from types import SimpleNamespace
from typing import TYPE_CHECKING, Any

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from engine.kernels import position, rounding, tick_velocity, vector
from engine.kernels.frame import frame_set_rotate
from engine.kernels.frame_motion import frame_grotate
from engine.layout import POSITION_SIZE, QUATERNION
from engine.tracing_interpreter import Interpreter

if TYPE_CHECKING:
    from collections.abc import Callable

HOSTILE = (0.0, -0.0, 1.0, -3.5, 1e-45, 1e-200, 1e30, 1e300, math.inf, -math.inf, math.nan)
INTERPRETER = Interpreter({})
COMPILING = settings(deadline=None)
"""The first example may compile a kernel."""
NUMBERS = st.sampled_from(HOSTILE) | st.floats(width=32)


def interpreted(kernel: Any) -> Callable[..., Any]:
    """Return what runs a kernel in Python on NumPy's numbers."""
    function = INTERPRETER.function(kernel)

    def run(*arguments: Any) -> Any:
        with np.errstate(all="ignore"):
            return function(*(np.float64(a) if type(a) is float else a for a in arguments))

    return run


def bits(answer: Any) -> list[str]:
    """Return numbers by their bits; a NaN is a NaN."""
    numbers = answer if isinstance(answer, tuple) else (answer,)
    return ["nan" if math.isnan(n) else float(n).hex() for n in numbers]


@COMPILING
@given(NUMBERS)
def test_a_store_rounds_alike(number: float) -> None:
    """Beyond float32 there is infinity, not a warning."""
    assert bits(interpreted(rounding.f32)(number)) == bits(rounding.f32(number))


@COMPILING
@given(NUMBERS, NUMBERS, NUMBERS)
def test_a_division_by_zero_is_no_error(x: float, y: float, z: float) -> None:
    """A vector of any numbers is normalised, or not, alike."""
    compiled = vector.normalize_check_small(x, y, z)
    assert bits(interpreted(vector.normalize_check_small)(x, y, z)) == bits(compiled)


@COMPILING
@given(st.tuples(NUMBERS, NUMBERS, NUMBERS))
def test_sines_are_the_c_librarys(turn: tuple[float, float, float]) -> None:
    """A rotation by any vector; that of an infinity is no number."""
    compiled, traced = np.zeros((2, POSITION_SIZE))
    compiled[QUATERNION] = traced[QUATERNION] = 1.0
    frame_grotate(compiled, 0, *turn)
    interpreted(frame_grotate)(traced, 0, *turn)
    assert bits(tuple(traced)) == bits(tuple(compiled))


@COMPILING
@given(st.integers(0, 0xFFFFFFFF), st.integers(0, 0xFFFFFFFF))
def test_cell_ids_are_integers(a: int, b: int) -> None:
    """They are kept as floats, and shifted as integers."""
    arguments = float(a), float(b)
    assert bits(interpreted(position.block_offset)(*arguments)) == bits(position.block_offset(*arguments))


@COMPILING
@given(st.lists(NUMBERS, min_size=int(POSITION_SIZE), max_size=int(POSITION_SIZE)), NUMBERS)
def test_arrays_are_written_alike(numbers: list[float], x: float) -> None:
    """A point taken through a position of any numbers."""
    row = np.array(numbers)
    arguments = float(0xA9B40111), row, 0, x, 1.0, -1.0
    row[0] = 0xA9B40111
    compiled = position.position_localtoglobal(*arguments)
    assert bits(interpreted(position.position_localtoglobal)(*arguments)) == bits(compiled)


def test_the_arguments_of_math_that_python_refuses() -> None:
    """Sines of infinity and roots of what is negative are no numbers; a NaN is the smallest integer."""
    namespace = INTERPRETER.function(tick_velocity.update_physics_internal).__globals__
    shim = namespace["math"]
    assert isinstance(shim, SimpleNamespace)
    with np.errstate(all="ignore"):
        assert math.isnan(shim.sin(math.inf))
        assert math.isnan(shim.sqrt(-1.0))
        assert math.isnan(shim.pow(-1.0, 0.5))
    assert shim.ceil(2.1) == 3
    assert [shim.ceil(math.nan), shim.floor(math.inf)] == [-(2**63)] * 2
    assert [namespace["int"](number) for number in (math.nan, math.inf, 1e300, 2.9)] == [*[-(2**63)] * 3, 2]


@COMPILING
@given(st.tuples(NUMBERS, NUMBERS, NUMBERS, NUMBERS))
def test_kernels_call_kernels(quaternion: tuple[float, float, float, float]) -> None:
    """A rotation is checked, normalised and made a matrix in the caller's own array."""
    compiled, traced = np.zeros((2, POSITION_SIZE))
    frame_set_rotate(compiled, 0, *quaternion)
    interpreted(frame_set_rotate)(traced, 0, *quaternion)
    assert bits(tuple(traced)) == bits(tuple(compiled))


def test_a_replacement_is_called_instead() -> None:
    """By every kernel that calls it; the kernel itself can still be had."""
    calls: list[float] = []

    def noted(x: float) -> float:
        calls.append(x)
        return x

    interpreter = Interpreter({rounding.f32: noted})
    interpreter.function(vector.normalize_check_small)(np.float64(3.0), np.float64(0.0), np.float64(4.0))
    assert calls == [0.6000000000000001, 0.0, 0.8]
    assert interpreter.unreplaced(rounding.f32)(0.1) == float(np.float32(0.1))


def test_floats_of_the_source_are_numpys() -> None:
    """So that none is divided as Python does."""
    code = INTERPRETER.function(frame_set_rotate).__code__
    assert not [constant for constant in code.co_consts if type(constant) is float]
