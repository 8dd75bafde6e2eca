"""Processors: a helper leaves its caller's, and goes nowhere that it may not."""

from __future__ import annotations

import os
import sys
from threading import Thread

import pytest

from engine import processors
from engine.processors import UNKNOWN, Whereabouts

TRIES = 1_000
"""More often than the system moves a thread between two lines."""


class Machine:
    """A thread on a machine: on which processor it is, and on which it may be."""

    def __init__(self, patch: pytest.MonkeyPatch, allowed: set[int], on: int = 0) -> None:
        self.allowed = frozenset(allowed)
        self.on = on
        self.moves = 0
        patch.setattr(processors, "processor", lambda: self.on)
        patch.setattr(processors, "_allowed", lambda: self.allowed)
        patch.setattr(processors, "_allow", self._allow)

    def _allow(self, allowed: frozenset[int]) -> None:
        self.moves += 1
        self.allowed = allowed
        self.on = self.on if self.on in allowed else min(allowed)


def _refuse() -> None:
    raise PermissionError(1, "not permitted")


def test_a_helper_leaves_its_callers_processor(monkeypatch: pytest.MonkeyPatch) -> None:
    """It may be on all others."""
    machine = Machine(monkeypatch, {0, 1, 2})
    Whereabouts().leave(0)
    assert machine.allowed == {1, 2}


def test_it_comes_back_when_it_meets_its_caller_elsewhere(monkeypatch: pytest.MonkeyPatch) -> None:
    """Then the processor that it had left is as good as any."""
    machine = Machine(monkeypatch, {0, 1, 2})
    whereabouts = Whereabouts()
    whereabouts.leave(0)
    whereabouts.leave(1)
    assert (machine.on, machine.allowed) == (0, {0, 2})


@pytest.mark.parametrize("occupied", [1, UNKNOWN])
def test_who_is_elsewhere_stays(monkeypatch: pytest.MonkeyPatch, occupied: int) -> None:
    """As one does if nobody knows where the caller is."""
    machine = Machine(monkeypatch, {0, 1})
    Whereabouts().leave(occupied)
    assert (machine.moves, machine.allowed) == (0, {0, 1})


def test_on_an_unknown_processor_nobody_moves(monkeypatch: pytest.MonkeyPatch) -> None:
    """A system that does not tell is asked for nothing else."""
    machine = Machine(monkeypatch, set(), on=UNKNOWN)
    Whereabouts().leave(UNKNOWN)
    assert machine.moves == 0


def test_who_has_one_processor_shares_it(monkeypatch: pytest.MonkeyPatch) -> None:
    """There is nowhere else to go."""
    machine = Machine(monkeypatch, {0})
    Whereabouts().leave(0)
    assert (machine.moves, machine.allowed) == (0, {0})


def test_what_somebody_else_allows_counts(monkeypatch: pytest.MonkeyPatch) -> None:
    """Also where it takes back a processor that the helper had before."""
    machine = Machine(monkeypatch, {0, 1, 2, 3})
    whereabouts = Whereabouts()
    whereabouts.leave(0)
    machine.allowed, machine.on = frozenset({2, 3}), 2
    whereabouts.leave(2)
    assert machine.allowed == {3}


@pytest.mark.parametrize("call", ["_allowed", "_allow"])
def test_who_is_refused_stays_for_good(monkeypatch: pytest.MonkeyPatch, call: str) -> None:
    """A sandbox may forbid either call; the helper helps where it is."""
    machine = Machine(monkeypatch, {0, 1})
    refused: list[object] = []

    def refuse(*arguments: object) -> None:
        refused.append(arguments)
        _refuse()

    monkeypatch.setattr(processors, call, refuse)
    whereabouts = Whereabouts()
    whereabouts.leave(0)
    whereabouts.leave(0)
    assert (machine.on, len(refused)) == (0, 1)


@pytest.mark.skipif(sys.platform != "linux", reason="only Linux tells processors")
def test_a_real_thread_leaves_its_processor() -> None:
    """On a machine with more than one; the system may have moved it just before, so that it asks again."""
    everywhere = os.sched_getaffinity(0)
    if len(everywhere) < 2:
        pytest.skip("one processor")
    if processors.processor() == UNKNOWN:
        pytest.skip("the C library does not tell the processor")
    seen: list[tuple[int, set[int], int]] = []

    def go() -> None:
        whereabouts = Whereabouts()
        for _ in range(TRIES):
            left = processors.processor()
            whereabouts.leave(left)
            if os.sched_getaffinity(0) != everywhere:
                break
        seen.append((left, os.sched_getaffinity(0), processors.processor()))

    thread = Thread(target=go)
    thread.start()
    thread.join()
    [(left, allowed, now)] = seen
    assert allowed == everywhere - {left}
    assert now in allowed


def test_each_thread_has_whereabouts_of_its_own(monkeypatch: pytest.MonkeyPatch) -> None:
    """What one has been refused the other may still do."""
    machine = Machine(monkeypatch, {0, 1})
    whereabouts = Whereabouts()
    with monkeypatch.context() as patch:
        patch.setattr(processors, "_allowed", _refuse)
        whereabouts.leave(0)
    thread = Thread(target=whereabouts.leave, args=(0,))
    thread.start()
    thread.join()
    assert machine.allowed == {1}
