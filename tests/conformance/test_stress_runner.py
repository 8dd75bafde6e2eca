"""Running parts, here and in other processes; what is broken off or dies is told."""

from __future__ import annotations

from concurrent.futures.process import BrokenProcessPool
from typing import TYPE_CHECKING, Any, NoReturn

import pytest

pytest.importorskip("flint", reason="the extra `exact` is not installed")

from conformance.stress import runner
from conformance.stress.findings import Findings, Reading
from conformance.stress.models import Models, Spec
from conformance.stress.runner import Plan, StoppedError, Worker, run_plan
from conformance.stress.settings import Settings
from conformance.stress.sweep import Sweep

if TYPE_CHECKING:
    from conformance.stress.sweep import Say

TINY = Settings(seed=5, probes=1, grid=4, ticks=150, quick=True)


class Counting(Sweep):
    """A sweep whose parts are numbers; one of them can be broken off."""

    family = "counting"
    name = "up"
    axis = "number"

    def __init__(self, parts: int, cost: int, broken_at: int | None = None) -> None:
        self.cost = cost
        self._parts = parts
        self._broken_at = broken_at

    @property
    def parts(self) -> int:
        """As many as were given."""
        return self._parts

    def run(self, part: int, _models: Models, say: Say) -> Findings:
        """Find the number of the part."""
        say(f"at {part}")
        if part == self._broken_at:
            raise KeyboardInterrupt
        return Findings([Reading(self.family, self.name, float(self.cost + part), "retail", {})])


def plan_of(monkeypatch: pytest.MonkeyPatch, *sweeps: Sweep) -> Plan:
    """Return the plan of a family of sweeps."""
    monkeypatch.setattr(runner, "FAMILIES", {"counting": lambda _settings: sweeps})
    return Plan(TINY, ("counting",), Spec("oracle"), 1)


def test_parts_that_take_long_come_first(monkeypatch: pytest.MonkeyPatch) -> None:
    """And every part is run once, with progress."""
    plan = plan_of(monkeypatch, Counting(2, 1), Counting(1, 50))
    found, said = Findings(), []
    run_plan(plan, found, said.append)
    assert [reading.severity for reading in found.readings] == [50.0, 1.0, 2.0]
    assert said == ["0/3 parts; at 0", "1/3 parts; at 0", "2/3 parts; at 1"]
    assert found.costs["counting"] > 0.0


def test_what_was_found_before_ctrl_c_is_there(monkeypatch: pytest.MonkeyPatch) -> None:
    """The interruption itself is the caller's to tell."""
    found = Findings()
    with pytest.raises(KeyboardInterrupt):
        run_plan(plan_of(monkeypatch, Counting(5, 0, broken_at=3)), found, lambda _: None)
    assert [reading.severity for reading in found.readings] == [0.0, 1.0, 2.0]


def test_several_processes_find_what_one_finds() -> None:
    """In whatever order."""
    found = Findings()
    run_plan(Plan(TINY, ("scale",), Spec("oracle"), 2), found, lambda _: None)
    alone = Findings()
    run_plan(Plan(TINY, ("scale",), Spec("oracle"), 1), alone, lambda _: None)
    assert found.failures == found.differences == []

    def key(reading: Reading) -> tuple[str, float, str]:
        return reading.sweep, reading.severity, reading.model

    assert sorted(found.readings, key=key) == sorted(alone.readings, key=key)


def test_a_worker_that_died_is_a_failure(monkeypatch: pytest.MonkeyPatch) -> None:
    """What the others had to do is counted."""

    def die(*_: Any) -> NoReturn:
        raise BrokenProcessPool

    monkeypatch.setattr(runner, "_collect", die)
    monkeypatch.setattr(runner, "ProcessPoolExecutor", _NoPool)
    found = Findings()
    plan = plan_of(monkeypatch, Counting(3, 0))
    run_plan(Plan(plan.settings, plan.families, plan.candidate, 2), found, lambda _: None)
    assert found.failures == ["a worker process died: 3 of 3 parts were not finished"]


class _NoPool:
    """A pool that does nothing, of no processes."""

    def __init__(self, *_: Any, **__: Any) -> None:
        self._submitted = 0

    def submit(self, *_: Any) -> int:
        self._submitted += 1
        return self._submitted

    def shutdown(self, *, wait: bool, cancel_futures: bool) -> None:
        assert (wait, cancel_futures) == (False, True)


def test_a_worker_stops_when_nobody_waits_for_it(monkeypatch: pytest.MonkeyPatch) -> None:
    """At the next word that it says; until then it says how far it is."""
    monkeypatch.setattr(runner, "FAMILIES", {"counting": lambda _settings: [Counting(1, 0)]})
    said, stopped = _Queue(), _Event()
    worker = Worker(TINY, Spec("oracle"), said, stopped)
    worker.run(runner.Part("counting", 0, 0))
    assert said.texts == ["at 0"]
    stopped.happened = True
    with pytest.raises(StoppedError):
        worker.run(runner.Part("counting", 0, 0))


class _Queue:
    def __init__(self) -> None:
        self.texts: list[str] = []

    def put(self, text: str) -> None:
        self.texts.append(text)


class _Event:
    happened = False

    def is_set(self) -> bool:
        return self.happened
