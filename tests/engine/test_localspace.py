"""The space of what is tested: what is put into it one by one is what retail puts there at once."""

from __future__ import annotations

import numpy as np
import pytest

from engine import layout as at
from engine.kernels.frame import frame_cache
from engine.kernels.path import (
    cache_localspace_sphere,
    enter_current_center,
    enter_localspace,
    enter_second_sphere,
)
from engine.tracing_interpreter import Interpreter

INTERPRETER = Interpreter({})
WHOLE = INTERPRETER.function(cache_localspace_sphere)
ENTER = INTERPRETER.function(enter_localspace)
SECOND = INTERPRETER.function(enter_second_sphere)
CURRENT = INTERPRETER.function(enter_current_center)
SPACE = 64
"""Where the tested thing's position lies in a world's floats."""
BLOCK = 0xA9B4_0000


def position(a: np.ndarray, p: int, rng: np.random.Generator, block: int) -> None:
    """Write a random position in a block of land."""
    turn = rng.normal(size=4)
    a[p] = block + 0x100
    a[p + at.QUATERNION : p + at.QUATERNION + 4] = np.float32(turn / np.linalg.norm(turn))
    a[p + at.ORIGIN : p + at.ORIGIN + 3] = np.float32(rng.uniform(0.0, 192.0, 3))
    frame_cache(a, p)


def mover(rng: np.random.Generator, spheres: int) -> np.ndarray:
    """Return a row of state in which a mover of so many spheres is somewhere, and wants to be elsewhere."""
    s = np.zeros(int(at.STATE_SIZE))
    s[at.NUM_SPHERE] = spheres
    size = spheres * at.SPHERE_SIZE
    s[at.LOCAL_SPHERE : at.LOCAL_SPHERE + size] = np.float32(rng.uniform(0.1, 1.5, size))
    for p in (at.CHECK_POS, at.CURR_POS):
        position(s, int(p), rng, BLOCK)
    return s


def spaces(rng: np.random.Generator, *blocks: int) -> np.ndarray:
    """Return a world's floats in which a position lies in each of these blocks: at SPACE, at 2 * SPACE."""
    world = np.zeros(SPACE * (len(blocks) + 1))
    for number, block in enumerate(blocks, 1):
        position(world, SPACE * number, rng, block)
    return world


def same(one: np.ndarray, other: np.ndarray, first: int, count: int) -> bool:
    """Say whether so many numbers of two rows have the same bits."""
    return one[first : first + count].tobytes() == other[first : first + count].tobytes()


@pytest.mark.parametrize("block", [BLOCK, BLOCK + 0x1_0000])
@pytest.mark.parametrize("scale", [1.0, 0.3])
@pytest.mark.parametrize("seed", range(10))
def test_piece_by_piece_is_the_whole(seed: int, scale: float, block: int) -> None:
    """Both spheres, the current centre and the up that paths ask for are those of LS-1...LS-4, to the bit."""
    rng = np.random.default_rng(seed)
    world = spaces(rng, block)
    whole = mover(rng, 2)
    pieces = whole.copy()
    WHOLE(whole, world, SPACE, scale)
    ENTER(pieces, world, SPACE, scale)
    SECOND(pieces)
    CURRENT(pieces)
    assert same(whole, pieces, at.LOCALSPACE_SPHERE, 2 * at.SPHERE_SIZE)
    assert same(whole, pieces, at.LOCALSPACE_CURR_CENTER, 3)
    assert same(whole, pieces, at.LOCALSPACE_Z, 3)
    assert same(whole, pieces, at.LOCALSPACE_POS, at.POSITION_SIZE)


def test_entering_the_same_space_again_moves_what_has_moved() -> None:
    """After a step of the check position, the sphere is where it is now; the current centre has stayed."""
    rng = np.random.default_rng(7)
    world = spaces(rng, BLOCK)
    s = mover(rng, 1)
    ENTER(s, world, SPACE, 1.0)
    CURRENT(s)
    s[at.CHECK_POS + at.ORIGIN] += 1.0
    whole = s.copy()
    ENTER(s, world, SPACE, 1.0)
    CURRENT(s)
    WHOLE(whole, world, SPACE, 1.0)
    assert same(whole, s, at.LOCALSPACE_SPHERE, at.SPHERE_SIZE)
    assert same(whole, s, at.LOCALSPACE_CURR_CENTER, 3)


def test_another_space_has_another_current_centre() -> None:
    """The centre that one space holds is not taken for that of the next."""
    rng = np.random.default_rng(8)
    world = spaces(rng, BLOCK, BLOCK)
    s = mover(rng, 1)
    ENTER(s, world, SPACE, 1.0)
    CURRENT(s)
    first = s.copy()
    ENTER(s, world, 2 * SPACE, 1.0)
    CURRENT(s)
    WHOLE(first, world, 2 * SPACE, 1.0)
    assert same(first, s, at.LOCALSPACE_CURR_CENTER, 3)


def test_who_has_no_sphere_has_none_in_any_space() -> None:
    """Without spheres nothing is put into a space but the space itself, as LS-2 says."""
    rng = np.random.default_rng(9)
    world = spaces(rng, BLOCK)
    s = mover(rng, 0)
    ENTER(s, world, SPACE, 1.0)
    CURRENT(s)
    assert not s[at.LOCALSPACE_SPHERE : at.LOCALSPACE_SPHERE + 2 * at.SPHERE_SIZE].any()
    assert not s[at.LOCALSPACE_CURR_CENTER : at.LOCALSPACE_CURR_CENTER + 3].any()
