"""Running the parts of sweeps, in this process or in several; what is broken off keeps what it has."""

from __future__ import annotations

import multiprocessing
import time
from concurrent.futures import FIRST_COMPLETED, ProcessPoolExecutor, wait
from concurrent.futures.process import BrokenProcessPool
from dataclasses import dataclass
from functools import partial
from typing import TYPE_CHECKING, Final

from conformance.candidates.table import describe
from conformance.stress.families import FAMILIES
from conformance.stress.findings import Findings
from conformance.stress.models import make_models
from conformance.workers import serve_parent, without_interrupts

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence
    from concurrent.futures import Future
    from multiprocessing.queues import SimpleQueue
    from multiprocessing.synchronize import Event

    from conformance.stress.models import Models, Spec
    from conformance.stress.settings import Settings
    from conformance.stress.sweep import Say, Sweep

_POLL_SECONDS: Final = 0.5
"""How often a run of several processes looks what they say, and a process says something."""


@dataclass(frozen=True, slots=True)
class Part:
    """A part of a sweep, named so that any process can make it.

    Attributes
    ----------
    family : str
    sweep, part : int
        Their numbers within the family and the sweep.
    """

    family: str
    sweep: int
    part: int


@dataclass(frozen=True, slots=True)
class Plan:
    """What a run does.

    Attributes
    ----------
    settings : Settings
    families : tuple of str
        Which are run.
    candidate : Spec
        What must be retail.
    jobs : int
        Processes at once.
    """

    settings: Settings
    families: tuple[str, ...]
    candidate: Spec
    jobs: int

    def parts(self) -> list[Part]:
        """List all parts; those of one that takes long come first, so that nobody waits for it at the end."""
        sized: list[tuple[int, Part]] = []
        for family in self.families:
            for number, sweep in enumerate(FAMILIES[family](self.settings)):
                sized += [(sweep.cost, Part(family, number, part)) for part in range(sweep.parts)]
        return [part for _, part in sorted(sized, key=lambda item: -item[0])]


class StoppedError(Exception):
    """The run was broken off while this process worked for it."""


class Workshop:
    """What a process needs to run parts: the models, and the sweeps that it has made so far."""

    def __init__(self, settings: Settings, candidate: Spec) -> None:
        self._settings = settings
        self._models: Models = make_models(candidate)
        self._sweeps: dict[str, Sequence[Sweep]] = {}

    def run(self, part: Part, say: Say) -> Findings:
        """Run one part, and time it; what it ends with, if it is an error, is a failure of it alone."""
        try:
            return self._run(part, say)
        except StoppedError:
            raise
        except Exception as error:  # noqa: BLE001 - the other parts go on
            where = f"{part.family}, sweep {part.sweep}, part {part.part}"
            return Findings(failures=[f"{where}: {describe(error)}"])

    def _run(self, part: Part, say: Say) -> Findings:
        if part.family not in self._sweeps:
            self._sweeps[part.family] = FAMILIES[part.family](self._settings)
        begin = time.perf_counter()
        found = self._sweeps[part.family][part.sweep].run(part.part, self._models, say)
        found.costs[part.family] = time.perf_counter() - begin
        return found


def run_plan(plan: Plan, into: Findings, say: Callable[[str], None]) -> None:
    """Run everything, adding what is found as it comes.

    Parameters
    ----------
    plan : Plan
    into : Findings
        Holds what was found so far whenever this ends, also by `KeyboardInterrupt`.
    say : callable
        Told how far it is.
    """
    parts = plan.parts()
    if plan.jobs == 1:
        workshop = Workshop(plan.settings, plan.candidate)
        for done, part in enumerate(parts):
            into.add(workshop.run(part, partial(_say_beside, say, f"{done}/{len(parts)} parts")))
    else:
        _run_in_processes(plan, parts, into, say)


def _say_beside(say: Callable[[str], None], done: str, text: str) -> None:
    say(f"{done}; {text}")


def _run_in_processes(plan: Plan, parts: list[Part], into: Findings, say: Callable[[str], None]) -> None:
    context = multiprocessing.get_context("spawn")  # the same on every platform, and safe beside threads
    said, stopped = context.SimpleQueue(), context.Event()
    begin = (plan.settings, plan.candidate, said, stopped)
    _kept.append(begin)
    pool = ProcessPoolExecutor(plan.jobs, mp_context=context, initializer=_open, initargs=begin)
    try:
        with without_interrupts():
            waiting = {pool.submit(_run, part): part for part in parts}
        while waiting:
            _collect(waiting, into)
            text = _latest(said)
            say(f"{len(parts) - len(waiting)}/{len(parts)} parts" + (f"; {text}" if text else ""))
    except BrokenProcessPool:
        into.failures.append(f"a worker process died: {len(waiting)} of {len(parts)} parts were not finished")
    finally:
        stopped.set()
        pool.shutdown(wait=False, cancel_futures=True)


def _collect(waiting: dict[Future[Findings], Part], into: Findings) -> None:
    """Take over what is done; raises `BrokenProcessPool` if a worker has died."""
    done, _ = wait(waiting, timeout=_POLL_SECONDS, return_when=FIRST_COMPLETED)
    for future in done:
        into.add(future.result())
        del waiting[future]


def _latest(said: SimpleQueue[str]) -> str:
    """Return what was said last, if anything new was."""
    text = ""
    while not said.empty():
        text = said.get()
    return text


class Worker:
    """What a process of several is.

    Parameters
    ----------
    settings, candidate
        As of `Workshop`.
    said : SimpleQueue
        Where it tells how far it is.
    stopped : Event
        Set when nobody waits for its results any more.
    """

    def __init__(self, settings: Settings, candidate: Spec, said: SimpleQueue[str], stopped: Event) -> None:
        self._workshop = Workshop(settings, candidate)
        self._said = said
        self._stopped = stopped
        self._last = 0.0

    def run(self, part: Part) -> Findings:
        """Run one part."""
        return self._workshop.run(part, self._say)

    def _say(self, text: str) -> None:
        """Tell how far it is, seldom enough that nobody need listen; raises `StoppedError`."""
        if self._stopped.is_set():
            raise StoppedError
        if time.monotonic() - self._last > _POLL_SECONDS:
            self._last = time.monotonic()
            self._said.put(text)


_kept: list[object] = []
"""What worker processes are told by: one that has just been started may ask for it when the run is over."""
_workers: list[Worker] = []
"""In a worker process, itself."""


def _open(settings: Settings, candidate: Spec, said: SimpleQueue[str], stopped: Event) -> None:
    """Prepare a worker process; Ctrl-C is the parent's to act on."""
    serve_parent()
    _workers.append(Worker(settings, candidate, said, stopped))


def _run(part: Part) -> Findings:
    return _workers[0].run(part)
