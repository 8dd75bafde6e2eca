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
from conformance.bench.settings import LARGE, SMALL, THREADS
from conformance.bench.spots import Surfaces
from conformance.bench.timing import accept, comparison, demand_equal, quarter, sample_of, take_turns

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Mapping, Sequence

    from numpy.random import Generator

    from conformance.bench.native_jobs import Native
    from conformance.bench.report import Report
    from conformance.bench.scenes import BenchScene
    from conformance.bench.settings import Settings
    from conformance.bench.timing import Answer, Comparison, Job, Maker
    from conformance.bench.variants import Variant

KERNELS: Final = (ops.STRIKE, ops.STEP_DOWN)
"""The hot kernels, which the yardstick has too."""
IN_TURN: Final = (1, LARGE, 100)
"""Calls beside the oracle. Small ones ask the same queries, and so none comes right after another."""
FLIGHT_BATCHES: Final = (SMALL, LARGE)
"""Calls in which moves through the air meet moves along the ground."""


class Contest:
    """One scene, its random queries, and where results go.

    Parameters
    ----------
    scene : BenchScene
    settings : Settings
    report : Report
        Takes what is found.
    rng : Generator
        Draws the queries.
    say : callable
        Told of every round.
    """

    def __init__(
        self,
        scene: BenchScene,
        settings: Settings,
        report: Report,
        rng: Generator,
        say: Callable[[str], None],
    ) -> None:
        self.scene: Final = scene
        self.settings: Final = settings
        self.report: Final = report
        self._rng: Final = rng
        self._say: Final = say
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
        """Draw the work of a warm-up, and of each round, when it is asked for."""
        for number in range(rounds + 1):
            self._say(f"{self.scene.name}: {op}, round {number} of {rounds}")
            yield self.work(op, size)

    def beside_oracle(self, op: str) -> None:
        """Measure the engine, in calls of every size, beside the oracle."""
        oracle = sample_of(oracle_maker(op), self.settings.sizes[op], LARGE)
        makers = [*(in_calls(op, batch) for batch in IN_TURN), oracle]
        *ours, theirs = self._turns(op, makers, self.settings.rounds)
        for batch, times in sorted(zip(IN_TURN, ours, strict=True)):
            self._add(op, "oracle", times, theirs, batch=batch)

    def beside_native(self, op: str, native: Native) -> None:
        """Measure a hot kernel of the engine beside the yardstick, given queries as drawn, and sorted.

        The yardstick is measured on several threads as well, beside itself: for what the machine gives there.
        """
        makers = [
            engine_maker(op, LARGE),
            native.maker(op),
            native.sorted_maker(op),
            native.shared_maker(op, THREADS),
        ]
        ours, as_drawn, in_order, shared = self._turns(op, makers, self.settings.fast_rounds)
        self._add(op, "native", ours, as_drawn)
        self._add(op, "native, sorted", ours, in_order)
        self._add(op, "native, one thread", shared, in_order, threads=THREADS, note="the yardstick itself")

    def beside_itself(self, op: str, batch: int, variants: Sequence[Variant]) -> None:
        """Measure the engine, as it is without a word, beside itself otherwise."""
        makers = [engine_maker(op, batch), *(variant.maker(op) for variant in variants)]
        plain, *others = self._turns(op, makers, self.settings.fast_rounds, size=batch)
        for variant, times in zip(variants, others, strict=True):
            ours, theirs = (plain, times) if variant.threads == 1 else (times, plain)
            about = {"batch": batch, "threads": variant.threads}
            found = self._add(op, variant.reference, ours, theirs, **about, note=variant.note)
            if variant.threads > 1 and batch == LARGE:
                self._add_threads(op, variant.threads, found)

    def _add_threads(self, op: str, threads: int, found: Comparison) -> None:
        sizes, costs = (1, threads), (found.theirs, found.ours)
        exponent = growth_exponent(sizes, [cost.middle for cost in costs])
        self.report.curves.append(Curve(f"threads, {self.scene.name}", op, sizes, costs, exponent))

    def air_beside_ground(self) -> None:
        """Measure moves through the air beside moves along the ground, both by the engine."""
        rounds = self.settings.fast_rounds
        flights, walks = (self.works(op, rounds) for op in (ops.FREE_FLIGHT, ops.CONTACT_WALK))
        pairs = zip(flights, walks, strict=True)
        makers = [
            partial(_of_pair, side, engine_maker(op, batch))
            for batch in FLIGHT_BATCHES
            for side, op in enumerate((ops.FREE_FLIGHT, ops.CONTACT_WALK))
        ]
        times = take_turns(makers, pairs, warm_up=next(pairs), judge=accept)
        for batch, air, ground in zip(FLIGHT_BATCHES, times[::2], times[1::2], strict=True):
            self._add(ops.FREE_FLIGHT, "engine, contact_walk", air, ground, batch=batch)

    def beside_peers(self) -> None:
        """Measure the touching question beside the libraries that are installed; they may differ a little."""
        names, makers = [], []
        for name in MODULES:
            try:
                makers.append(sample_of(peer_maker(name), self.settings.sizes[ops.TOUCH], LARGE))
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
        moves = self.work(ops.CONTACT_WALK, self.settings.exact_moves)
        clocked = partial(self.works, ops.CONTACT_WALK, self.settings.rounds)
        measure_precision(self.scene, moves, clocked, self.report)

    def _turns(
        self,
        op: str,
        makers: Sequence[Maker],
        rounds: int,
        *,
        size: int = LARGE,
        judge: Callable[[Any, Sequence[Answer]], None] = demand_equal,
    ) -> list[list[float]]:
        works = self.works(op, rounds, size)
        return take_turns(makers, works, warm_up=next(works), judge=judge, lead_in=quarter)

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
