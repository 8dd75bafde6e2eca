"""The yardstick at work: all queries in one call, or in one call on each of several threads."""

from __future__ import annotations

import shutil
import tempfile
import weakref
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any
from weakref import WeakKeyDictionary

import numpy as np

from conformance.bench import ops
from conformance.bench.kept import Kept
from conformance.bench.native.compiler import compile_yardstick, find_compiler
from conformance.bench.native.library import Yardstick
from conformance.bench.timing import Answer, Job
from conformance.bench.work import batches
from engine.coherence import order_of
from engine.kernels.order import SPHERES
from engine.processors import WHEREABOUTS, processor

if TYPE_CHECKING:
    from collections.abc import MutableMapping, Sequence

    from conformance.bench.native.library import NativeTree
    from conformance.bench.scenes import BenchScene
    from conformance.bench.timing import Maker
    from conformance.bench.work import KernelWork


class Native:
    """The yardstick as an implementation, compiled into a folder that goes with it.

    Attributes
    ----------
    compiler : str
        What compiled it, and how.

    Raises
    ------
    NoCompilerError
        If it cannot be compiled here.
    """

    def __init__(self) -> None:
        found = find_compiler()
        self.compiler = found.describe()
        folder = Path(tempfile.mkdtemp(prefix="yardstick-"))
        weakref.finalize(self, shutil.rmtree, folder, ignore_errors=True)
        self._yardstick = Yardstick(compile_yardstick(found, folder))
        self._trees: MutableMapping[BenchScene, NativeTree] = WeakKeyDictionary()

    def maker(self, op: str) -> Maker:
        """Return it as an implementation of a sphere that strikes, or steps down."""
        prepare = {ops.STRIKE: self._strike_job, ops.STEP_DOWN: self._step_down_job}[op]
        return partial(prepare, Kept())

    def sorted_maker(self, op: str) -> Maker:
        """Return it as `maker` does, but given its queries in the engine's order, for nothing.

        What it then gains on the engine, or loses, is not a matter of the order.
        """
        return partial(_sorted_job, self.maker(op))

    def shared_maker(self, op: str, threads: int) -> Maker:
        """Return it as `sorted_maker` does, on several threads, each of which has an equal part of the work.

        What it then gains is what the machine gives to who shares nothing but the tree.
        """
        makers = [self.sorted_maker(op) for _ in range(threads)]
        return partial(_shared_job, makers, ThreadPoolExecutor(threads - 1))

    def _tree(self, scene: BenchScene) -> NativeTree:
        tree = self._trees.get(scene)
        if tree is None:
            tree = self._trees[scene] = self._yardstick.tree(scene)
        return tree

    def _strike_job(self, kept: Kept, work: KernelWork) -> Job:
        tree, spheres, movements = self._tree(work.scene), _singles(work.spheres), _singles(work.movements)
        answers = [kept.array(name, (len(work),), np.int32) for name in ("struck", "polygons")]
        return Job(lambda: tree.strike(spheres, movements, *answers), lambda _: _columns(answers), len(work))

    def _step_down_job(self, kept: Kept, work: KernelWork) -> Job:
        tree = self._tree(work.scene)
        spheres, movements, ups = (_singles(a) for a in (work.spheres, work.movements, work.ups))
        limits = _singles(np.column_stack([work.allowances, work.interps]))
        moved = kept.array("moved", (len(work), 4), np.float32)
        polygons = kept.array("polygons", (len(work),), np.int32)

        def run() -> None:
            tree.step_down(spheres, movements, ups, limits, moved, polygons)

        return Job(run, lambda _: _columns([moved, polygons]), len(work))


def _sorted_job(maker: Maker, work: KernelWork) -> Job:
    """Make a job of work that was sorted before; its answers are in the order in which queries were drawn."""
    found = order_of(SPHERES, work.spheres)
    order = found.astype(np.int64) if len(found) else np.arange(len(work))
    job = maker(work.sorted(order))

    def answer(done: Any) -> Answer:
        answers = job.answer(done)
        answers[order] = answers.copy()
        return answers

    return replace(job, answer=answer)


def _shared_job(makers: Sequence[Maker], others: ThreadPoolExecutor, work: KernelWork) -> Job:
    """Make a job of equal parts of some work, of which the calling thread does the first."""
    parts = batches(len(work), -(-len(work) // len(makers)))
    jobs = [maker(work.part(*part)) for maker, part in zip(makers, parts, strict=True)]

    def help_with(job: Job, asked_on: int) -> None:
        WHEREABOUTS.leave(asked_on)
        job.run()

    def run() -> None:
        asked_on = processor()
        at_work = [others.submit(help_with, job, asked_on) for job in jobs[1:]]
        jobs[0].run()
        for one in at_work:
            one.result()

    return Job(run, lambda done: np.concatenate([job.answer(done) for job in jobs]), len(work))


def _columns(arrays: Sequence[Any]) -> Answer:
    return np.column_stack(arrays).astype(np.float64)


def _singles(values: Any) -> Any:
    return np.ascontiguousarray(values, dtype=np.float32)
