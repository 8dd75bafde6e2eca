"""The engine beside everybody else, in one scene: each contest becomes lines of the table."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING, Any, Final

from conformance.bench import ops, sampling
from conformance.bench.engine_jobs import engine_maker, in_calls
from conformance.bench.figures import growth_exponent
from conformance.bench.oracle_jobs import oracle_maker
from conformance.bench.peers import MODULES, Agreement, peer_maker
from conformance.bench.precision import measure_precision
from conformance.bench.report import Curve, Ratio
from conformance.bench.settings import BATCHES, CROWD, LARGE, SMALL, THREADS
from conformance.bench.spots import Surfaces
from conformance.bench.timing import accept, comparison, demand_equal, sample_of, take_turns
from engine import Plan

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Mapping, Sequence

    from numpy.random import Generator

    from conformance.bench.native_jobs import Native
    from conformance.bench.report import Report
    from conformance.bench.scenes import BenchScene
    from conformance.bench.settings import Settings
    from conformance.bench.timing import Answer, Comparison, Job, Maker

KERNELS: Final = (ops.STRIKE, ops.STEP_DOWN)
"""The hot kernels, which the yardstick has too."""
SHORTENED: Final = (ops.CONTACT_WALK, ops.FREE_FLIGHT, ops.TICK)
"""What takes shortcuts."""
THREADED: Final = (
    *((op, LARGE) for op in (*KERNELS, ops.FIND_COLLISIONS, ops.CONTACT_WALK, ops.TICK)),
    (ops.STRIKE, CROWD),
)
"""What threads share, in calls of how many: the fastest also in large ones, where their start weighs less."""
FLIGHT_BATCHES: Final = (SMALL, LARGE)
"""Calls in which moves through the air meet moves along the ground."""


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

    def works(self, op: str, rounds: int, size: int = LARGE) -> Iterator[Any]:
        """Draw the work of each round when it is asked for."""
        return (self.work(op, size) for _ in range(rounds))

    def beside_oracle(self, op: str) -> None:
        """Measure the engine, in calls of every size, beside the oracle."""
        oracle = sample_of(oracle_maker(op), self.settings.sizes[op])
        makers = [*(in_calls(op, batch) for batch in BATCHES), oracle]
        *ours, theirs = self._turns(op, makers, self.settings.rounds)
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

    def on_threads(self, op: str, batch: int) -> None:
        """Measure the engine on several threads beside itself on one."""
        makers = [engine_maker(op, batch, THREADS), engine_maker(op, batch)]
        found = self._beside(op, "engine", makers, batch=batch, threads=THREADS, note="beside one thread")
        costs, name = (found.theirs, found.ours), f"threads, {self.scene.name}, batch {batch}"
        exponent = growth_exponent((1, THREADS), [cost.middle for cost in costs])
        self.report.curves.append(Curve(name, op, (1, THREADS), costs, exponent))

    def air_beside_ground(self) -> None:
        """Measure moves through the air beside moves along the ground, both by the engine."""
        rounds = self.settings.fast_rounds
        flights, walks = (self.works(op, rounds + 1) for op in (ops.FREE_FLIGHT, ops.CONTACT_WALK))
        pairs = zip(flights, walks, strict=True)
        makers = [
            partial(_of_pair, side, engine_maker(op, batch))
            for batch in FLIGHT_BATCHES
            for side, op in enumerate((ops.FREE_FLIGHT, ops.CONTACT_WALK))
        ]
        times = take_turns(makers, pairs, warm_up=next(pairs), judge=accept)
        for batch, air, ground in zip(FLIGHT_BATCHES, times[::2], times[1::2], strict=True):
            self._add(ops.FREE_FLIGHT, "engine", air, ground, batch=batch, note="beside contact_walk")

    def beside_peers(self) -> None:
        """Measure the touching question beside the libraries that are installed; they may differ a little."""
        names, makers = [], []
        for name in MODULES:
            try:
                makers.append(sample_of(peer_maker(name), self.settings.sizes[ops.TOUCH]))
                names.append(name)
            except ImportError:
                self.report.omit(f"touch beside {name}", "it is not installed (extra `peers`)")
        judge = Agreement()
        everyone = [in_calls(ops.TOUCH, LARGE), in_calls(ops.TOUCH, 1), *makers]
        if names:
            large, one, *theirs = self._turns(ops.TOUCH, everyone, self.settings.rounds, judge=judge)
            for index, (name, times) in enumerate(zip(names, theirs, strict=True), start=2):
                note, agreement = judge.explain(index), judge.share(index)
                self._add(ops.TOUCH, name, large, times, note=note, agreement=agreement)
                self._add(ops.TOUCH, name, one, times, batch=1, note=note, agreement=agreement)

    def precision(self) -> None:
        """Measure cost and error of every implementation of a move along the ground."""
        moves = self.work(ops.CONTACT_WALK, self.settings.sizes[ops.CONTACT_WALK])
        clocked = partial(self.works, ops.CONTACT_WALK, self.settings.rounds + 1)
        measure_precision(self.scene, moves, clocked, self.report)

    def _beside(
        self,
        op: str,
        reference: str,
        makers: Sequence[Maker],
        *,
        batch: int = LARGE,
        threads: int = 1,
        note: str = "",
    ) -> Comparison:
        ours, theirs = self._turns(op, makers, self.settings.fast_rounds, size=batch)
        return self._add(op, reference, ours, theirs, batch=batch, threads=threads, note=note)

    def _turns(
        self,
        op: str,
        makers: Sequence[Maker],
        rounds: int,
        *,
        size: int = LARGE,
        judge: Callable[[Any, Sequence[Answer]], None] = demand_equal,
    ) -> list[list[float]]:
        works = self.works(op, rounds + 1, size)
        return take_turns(makers, works, warm_up=next(works), judge=judge)

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


def _of_pair(side: int, maker: Maker, pair: Sequence[Any]) -> Job:
    return maker(pair[side])
