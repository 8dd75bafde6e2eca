"""What compiled code shares between threads, and what stands for it where kernels are interpreted."""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor

import numpy as np
from engine_scenes import CELL, R, at, floor_and_wall, mover, world_of

from engine import Move
from engine import layout as of
from engine.coherence import AS_ASKED
from engine.kernels import program
from engine.kernels.ahead import bring_near
from engine.kernels.sharing import SHARE_DONE, SHARE_FAILED, SHARE_NEXT, SHARE_SIZE, take
from engine.query import move_rows
from engine.threads import new_share
from engine.tracing_interpreter import Interpreter

WORLD = world_of(floor_and_wall())
COUNT = 1000
MOVES = [Move(mover(), at(0.001 * i, 0.0, R), CELL, start=at(0.001 * i - 0.2, 0.0, R)) for i in range(COUNT)]


def test_rows_are_taken_a_few_at_a_time() -> None:
    """Each time as many as the share says; the last are as many as there are."""
    rows = move_rows(WORLD, MOVES).view(np.float64).reshape(COUNT, -1)
    out = np.full((COUNT, int(of.RESULT_SIZE)), np.nan)
    share = new_share(COUNT, 2)
    share[SHARE_SIZE] = 7
    program.run(WORLD.floats, WORLD.ints, WORLD.new_row(), program.RESOLVE, rows, out, AS_ASKED, share)
    assert share[SHARE_NEXT] == 7 * (COUNT // 7 + 2)
    assert (share[SHARE_DONE], share[SHARE_FAILED]) == (COUNT, 0)
    assert not np.isnan(out).any()


def test_who_begins_in_the_middle_answers_the_rest() -> None:
    """What others have taken is left alone."""
    rows = move_rows(WORLD, MOVES).view(np.float64).reshape(COUNT, -1)
    out = np.full((COUNT, int(of.RESULT_SIZE)), np.nan)
    share = new_share(COUNT)
    share[SHARE_NEXT] = COUNT - 10
    program.run(WORLD.floats, WORLD.ints, WORLD.new_row(), program.RESOLVE, rows, out, AS_ASKED, share)
    assert np.isnan(out).all(axis=1).sum() == COUNT - 10
    assert share[SHARE_DONE] == 10


def test_no_addition_is_lost() -> None:
    """Of many threads that take single rows at the same time; each row is answered once."""
    rows = move_rows(WORLD, MOVES).view(np.float64).reshape(COUNT, -1)
    out = np.empty((COUNT, int(of.RESULT_SIZE)))
    shares = [new_share(COUNT) for _ in range(20)]

    def work(share: np.ndarray) -> None:
        share[SHARE_SIZE] = 1
        program.run(WORLD.floats, WORLD.ints, WORLD.new_row(), program.RESOLVE, rows, out, AS_ASKED, share)

    for share in shares:
        with ThreadPoolExecutor(4) as threads:
            list(threads.map(work, [share] * 4))
        assert (share[SHARE_DONE], share[SHARE_NEXT]) == (COUNT, COUNT + 4)


def test_interpreted_kernels_take_rows_too() -> None:
    """Without the machine's instruction; a hint to the machine is none for Python."""
    interpreter, share = Interpreter({}), new_share(10, 2)
    share[SHARE_SIZE] = 3
    assert [interpreter.function(take)(share) for _ in range(4)] == [0, 3, 6, 9]
    assert interpreter.function(bring_near)(np.zeros((1, 1)), 5, 1) is None
