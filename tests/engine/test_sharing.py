"""What compiled code shares between threads, and what stands for it where kernels are interpreted."""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor

import numpy as np
from engine_scenes import CELL, R, at, floor_and_wall, mover, world_of

from engine import Move
from engine import layout as of
from engine.coherence import AS_ASKED
from engine.kernels import program
from engine.kernels.ahead import bring_near, bring_to_write
from engine.kernels.sharing import (
    FEWEST,
    LANE_INTS,
    LANE_NEXT,
    MOST,
    PARTS,
    SHARE_DONE,
    SHARE_FAILED,
    SHARE_JOINED,
    join,
    lane_after,
    take,
)
from engine.memory import rows_as_numbers
from engine.query import move_rows
from engine.threads import new_share
from engine.tracing_interpreter import Interpreter

WORLD = world_of(floor_and_wall())
COUNT = 1000
INTERPRETER = Interpreter({})
TAKE = INTERPRETER.function(take)
LANE = int(LANE_INTS)
"""Where the first lane lies in a share."""
MOVES = [Move(mover(), at(0.001 * i, 0.0, R), CELL, start=at(0.001 * i - 0.2, 0.0, R)) for i in range(COUNT)]


def test_turns_become_shorter_towards_the_end() -> None:
    """A quarter of what is left in the lane, within bounds, so that nobody is waited for with much to do."""
    share = new_share(4000)
    turns = []
    while (turn := TAKE(share, LANE))[0] < turn[1]:
        turns.append(turn)
    sizes = [last - first for first, last in turns]
    assert [first for first, _ in turns] == [0, *(last for _, last in turns[:-1])]
    assert sizes[: 4000 // MOST - PARTS] == [MOST] * (4000 // MOST - PARTS)
    assert sizes == sorted(sizes, reverse=True)
    assert sizes[-2] == FEWEST
    assert turns[-1][1] == 4000


def test_who_is_done_with_its_lane_helps_the_others() -> None:
    """In turn; what others have taken is left alone."""
    rows = rows_as_numbers(move_rows(WORLD, MOVES))
    out = np.full((COUNT, int(of.RESULT_SIZE)), np.nan)
    share = new_share(COUNT, 2)
    other = LANE_INTS * 2
    taken = 10
    share[other + LANE_NEXT] += taken
    program.run(WORLD.floats, WORLD.ints, WORLD.new_row(), program.RESOLVE, rows, out, AS_ASKED, share)
    unanswered = np.flatnonzero(np.isnan(out).all(axis=1))
    assert unanswered.tolist() == list(range(COUNT // 2, COUNT // 2 + taken))
    assert (share[SHARE_JOINED], share[SHARE_DONE], share[SHARE_FAILED]) == (1, COUNT - taken, 0)


def test_each_begins_with_a_lane_of_its_own() -> None:
    """Who comes after as many as there are lanes begins with the first again."""
    share = new_share(10, 2)
    assert [INTERPRETER.function(join)(share) for _ in range(3)] == [0, 1, 0]
    assert [INTERPRETER.function(lane_after)(share, 1, k) for k in range(2)] == [LANE_INTS * 2, LANE_INTS]


def test_no_addition_is_lost() -> None:
    """Of many threads that take rows at the same time; each row is answered once."""
    rows = rows_as_numbers(move_rows(WORLD, MOVES))
    out = np.empty((COUNT, int(of.RESULT_SIZE)))
    shares = [new_share(COUNT, 4) for _ in range(20)]

    def work(share: np.ndarray) -> None:
        program.run(WORLD.floats, WORLD.ints, WORLD.new_row(), program.RESOLVE, rows, out, AS_ASKED, share)

    for share in shares:
        with ThreadPoolExecutor(4) as threads:
            list(threads.map(work, [share] * 4))
        assert (share[SHARE_DONE], share[SHARE_JOINED]) == (COUNT, 4)


def test_interpreted_kernels_take_rows_too() -> None:
    """Without the machine's instruction; a hint to the machine is none for Python."""
    share = new_share(9)
    assert [TAKE(share, LANE) for _ in range(4)] == [(0, 4), (4, 8), (8, 9), (12, 9)]
    for bring in (bring_near, bring_to_write):
        assert INTERPRETER.function(bring)(np.zeros((1, 1)), 5, 1) is None
