"""The engine beside everybody else, in one scene: each contest becomes lines of the table."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

import numpy as np

from conformance.bench import engine_jobs as ops
from conformance.bench import sampling
from conformance.bench.engine_jobs import engine_maker, has_entry, has_threads
from conformance.bench.figures import growth_exponent
from conformance.bench.oracle_jobs import MAKERS, oracle_maker
from conformance.bench.peers import MODULES, peer_maker, unexplained
from conformance.bench.precision import measure_precision
from conformance.bench.report import Curve, Ratio
from conformance.bench.settings import BATCHES, LARGE, THREADS
from conformance.bench.spots import Surfaces
from conformance.bench.timing import comparison, demand_equal, equal_rows, take_turns
from conformance.bench.work import rounds_of
from engine import Plan

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence

    from numpy.random import Generator

    from conformance.bench.native_jobs import Native
    from conformance.bench.report import Report
    from conformance.bench.scenes import BenchScene
    from conformance.bench.settings import Settings
    from conformance.bench.timing import Answer, Comparison, Maker

KERNELS: Final = (ops.STRIKE, ops.STEP_DOWN)
"""The hot kernels, which the yardstick has too."""
SHORTENED: Final = (ops.CONTACT_WALK, ops.FREE_FLIGHT, ops.TICK)
"""What takes shortcuts."""
THREADED: Final = (ops.STRIKE, ops.STEP_DOWN, ops.FIND_COLLISIONS, ops.CONTACT_WALK, ops.TICK)


class Contest:
    """One scene, its random queries, and where results go."""

    def __init__(self, scene: BenchScene, settings: Settings, report: Report, rng: Generator) -> None:
        self.scene: Final = scene
        self.settings: Final = settings
        self.report: Final = report
        self._rng: Final = rng
        self._surfaces: Final = Surfaces(scene.geometry)

    def work(self, op: str, count: int) -> Any:
        """Return new random queries of an operation."""
        scene, surfaces, rng = self.scene, self._surfaces, self._rng
        if op == ops.FREE_FLIGHT:
            return sampling.free_flight(scene, rng, count)
        make: Mapping[str, Callable[..., Any]] = {
            ops.STRIKE: sampling.strikes,
            ops.TOUCH: sampling.strikes,
            ops.STEP_DOWN: sampling.steps_down,
            ops.FIND_COLLISIONS: sampling.tree_calls,
            ops.CONTACT_WALK: sampling.contact_walk,
            ops.TICK: sampling.bodies,
        }
        return make[op](scene, surfaces, rng, count)

    def rounds(self, op: str, size: int, number: int) -> tuple[Any, list[Any]]:
        """Return the work of a warm-up, and of each round."""
        first, *others = rounds_of(self.work(op, size * (number + 1)), size, number + 1)
        return first, others

    def beside_oracle(self, op: str) -> None:
        """Measure the engine, in calls of every size, beside the oracle."""
        if not self._answers(op):
            return
        warm_up, rounds = self.rounds(op, self.settings.sizes[op], self.settings.rounds)
        makers = [*(engine_maker(op, batch) for batch in BATCHES), oracle_maker(op)]
        *ours, theirs = take_turns(makers, rounds, warm_up=warm_up, judge=demand_equal)
        for batch, times in zip(BATCHES, ours, strict=True):
            self._add(op, "oracle", times, theirs, batch=batch)

    def beside_native(self, op: str, native: Native) -> None:
        """Measure a hot kernel of the engine beside the yardstick."""
        self._beside(op, "native", [engine_maker(op, LARGE), native.maker(op)])

    def beside_itself(self, op: str) -> None:
        """Measure the engine beside itself: what differs from 1 is noise."""
        self._beside(op, "engine", [engine_maker(op, LARGE), engine_maker(op, LARGE)], note="noise check")

    def with_shortcuts(self, op: str) -> None:
        """Measure the engine with its shortcuts beside itself without: the answers are the same."""
        makers = [engine_maker(op, LARGE), engine_maker(op, LARGE, plan=Plan.none())]
        self._beside(op, "engine", makers, note="shortcuts, beside none")

    def on_threads(self, op: str) -> None:
        """Measure the engine on several threads beside itself on one."""
        if self._answers(op) and not has_threads(op):
            self.report.omit(f"{op} on threads", "the engine's function takes no number of threads")
            return
        makers = [engine_maker(op, LARGE, THREADS), engine_maker(op, LARGE)]
        found = self._beside(op, "engine", makers, threads=THREADS, note="beside one thread")
        if found is not None:
            costs, name = (found.theirs, found.ours), f"threads, {self.scene.name}"
            exponent = growth_exponent((1, THREADS), [cost.middle for cost in costs])
            self.report.curves.append(Curve(name, op, (1, THREADS), costs, exponent))

    def air_beside_ground(self) -> None:
        """Measure moves through the air beside moves along the ground, both by the engine."""
        number = self.settings.fast_rounds
        (_, *flights), (_, *walks) = (
            (warm_up, *rounds)
            for warm_up, rounds in (
                self.rounds(op, LARGE // 10, number) for op in (ops.FREE_FLIGHT, ops.CONTACT_WALK)
            )
        )
        pairs = list(zip(flights, walks, strict=True))
        fly, walk = engine_maker(ops.FREE_FLIGHT, LARGE // 10), engine_maker(ops.CONTACT_WALK, LARGE // 10)
        makers = [lambda pair: fly(pair[0]), lambda pair: walk(pair[1])]
        times = take_turns(makers, pairs, warm_up=pairs[0], judge=lambda _work, _answers: None)
        self._add(ops.FREE_FLIGHT, "engine", *times, batch=LARGE // 10, note="beside contact_walk")

    def beside_peers(self) -> None:
        """Measure the touching question beside the libraries that are installed; they may differ a little."""
        if not self._answers(ops.TOUCH):
            return
        names, makers = [], []
        for name in MODULES:
            try:
                makers.append(peer_maker(name))
                names.append(name)
            except ImportError:
                self.report.omit(f"touch beside {name}", "it is not installed (extra `peers`)")
        judge = _Agreement()
        warm_up, rounds = self.rounds(ops.TOUCH, self.settings.sizes[ops.TOUCH], self.settings.rounds)
        everyone = [engine_maker(ops.TOUCH, LARGE), engine_maker(ops.TOUCH, 1), *makers]
        if names:
            large, one, *theirs = take_turns(everyone, rounds, warm_up=warm_up, judge=judge)
            for index, (name, times) in enumerate(zip(names, theirs, strict=True), start=2):
                note, agreement = judge.explain(index), judge.share(index)
                self._add(ops.TOUCH, name, large, times, note=note, agreement=agreement)
                self._add(ops.TOUCH, name, one, times, batch=1, note=note, agreement=agreement)

    def precision(self) -> None:
        """Measure cost and error of every implementation of a move along the ground."""
        work = self.work(ops.CONTACT_WALK, self.settings.sizes[ops.CONTACT_WALK])
        measure_precision(self.scene, work, self.report)

    def _beside(
        self, op: str, reference: str, makers: Sequence[Maker], *, threads: int = 1, note: str = ""
    ) -> Comparison | None:
        if not self._answers(op):
            return None
        size = LARGE if op in KERNELS else LARGE // 10
        warm_up, rounds = self.rounds(op, size, self.settings.fast_rounds)
        ours, theirs = take_turns(makers, rounds, warm_up=warm_up, judge=demand_equal)
        return self._add(op, reference, ours, theirs, threads=threads, note=note)

    def _answers(self, op: str) -> bool:
        if has_entry(op):
            return True
        self.report.omit(op, f"this engine has no {ops.ENTRY_POINTS[op]}")
        return False

    def _add(
        self,
        op: str,
        reference: str,
        ours: Sequence[float],
        theirs: Sequence[float],
        *,
        batch: int = LARGE,
        threads: int = 1,
        note: str = "",
        agreement: float = 1.0,
    ) -> Comparison:
        found = comparison(ours, theirs, agreement)
        self.report.ratios.append(Ratio(self.scene.name, op, reference, batch, threads, found, note))
        return found


class _Agreement:
    """Counts on how many queries others agree with the first, and how many differences are not explained."""

    def __init__(self) -> None:
        self.asked = 0
        self.different: dict[int, int] = {}
        self.open: dict[int, int] = {}

    def __call__(self, work: Any, answers: Sequence[Answer]) -> None:
        self.asked += len(work)
        for side, answer in enumerate(answers):
            differs = ~equal_rows(answers[0], answer)
            self.different[side] = self.different.get(side, 0) + int(np.count_nonzero(differs))
            self.open[side] = self.open.get(side, 0) + unexplained(work, differs)

    def share(self, side: int) -> float:
        """Return the share of queries that are answered as the first does."""
        return 1.0 - self.different[side] / self.asked

    def explain(self, side: int) -> str:
        """Say what the differences are."""
        if not self.different[side]:
            return "all answers agree"
        return (
            f"{self.different[side]} of {self.asked} differ, {self.open[side]} of them beyond retail's slack"
        )


def contests_of(
    sections: Sequence[str], native: Native | None
) -> list[tuple[str, Callable[[Contest], None]]]:
    """Return the contests of the sections that were asked for, each with what it is called."""
    found: list[tuple[str, Callable[[Contest], None]]] = []
    if "noise" in sections:
        found += [(f"noise of {op}", _bound("beside_itself", op)) for op in (ops.STRIKE, ops.CONTACT_WALK)]
    if "native" in sections and native is not None:
        found += [(f"{op} beside native", _bound("beside_native", op, native)) for op in KERNELS]
    if "oracle" in sections:
        found += [(f"{op} beside the oracle", _bound("beside_oracle", op)) for op in MAKERS]
        found.append(("free flight beside contact walk", Contest.air_beside_ground))
    if "plans" in sections:
        found += [(f"shortcuts of {op}", _bound("with_shortcuts", op)) for op in SHORTENED]
    if "threads" in sections:
        found += [(f"{op} on {THREADS} threads", _bound("on_threads", op)) for op in THREADED]
    if "peers" in sections:
        found.append(("touch beside peers", Contest.beside_peers))
    if "precision" in sections:
        found.append(("work and precision", Contest.precision))
    return found


def _bound(method: str, *arguments: Any) -> Callable[[Contest], None]:
    def perform(contest: Contest) -> None:
        getattr(contest, method)(*arguments)

    return perform
