"""All implementations answer alike: oracle, engine in calls of every size, yardstick, peers."""

from __future__ import annotations

from functools import cache
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

from conformance.bench import ops
from conformance.bench.contests import Contest
from conformance.bench.engine_jobs import engine_maker
from conformance.bench.native.compiler import (
    Compiler,
    NoCompilerError,
    compile_yardstick,
    find_compiler,
)
from conformance.bench.native.library import NativeTree
from conformance.bench.native_jobs import Native
from conformance.bench.oracle_jobs import MAKERS, oracle_maker
from conformance.bench.peers import EXPLAINED, MODULES, distance_to, peer_maker, triangles, unexplained
from conformance.bench.report import Report
from conformance.bench.scenes import make_scene
from conformance.bench.settings import quick
from conformance.bench.timing import Answer, Maker, demand_equal, equal_rows
from conformance.bench.work import RowWork
from engine.coherence import order_of
from engine.kernels.order import SPHERES

if TYPE_CHECKING:
    from pathlib import Path

COUNT = 24


@cache
def contest() -> Contest:
    """Return the room with its queries."""
    return Contest(
        make_scene("room"), quick(5, (), None), Report(5), np.random.default_rng(5), lambda _: None
    )


def answer(maker: Maker, work: Any) -> Answer:
    """Do work once."""
    job = maker(work)
    return job.answer(job.run())


@cache
def yardstick() -> Native:
    """Return the compiled yardstick."""
    try:
        return Native()
    except NoCompilerError as error:
        pytest.skip(f"skipped: {error}")


@pytest.mark.parametrize("op", list(MAKERS))
@pytest.mark.parametrize("batch", [1, 7, 100])
def test_engine_answers_as_the_oracle(op: str, batch: int) -> None:
    """Whatever the size of a call, every answer has the oracle's bits."""
    work = contest().work(op, COUNT)
    demand_equal(work, [answer(engine_maker(op, batch), work), answer(oracle_maker(op), work)])


@pytest.mark.parametrize("op", [*MAKERS, ops.TOUCH])
def test_results_of_another_round_are_written_over(op: str) -> None:
    """An implementation keeps the memory of its results; what is told of a round is that round's."""
    kept, works = engine_maker(op, 7), list(contest().works(op, 1, COUNT))
    for work in works:
        demand_equal(work, [answer(kept, work), answer(engine_maker(op, COUNT), work)])


@pytest.mark.parametrize("op", [*MAKERS, ops.TOUCH])
def test_no_query_is_asked_twice(op: str) -> None:
    """Neither within a round nor in the next: what comes again is learnt by heart, and faster then."""
    works = contest().works(op, 1, COUNT)
    asked = [work.rows if isinstance(work, RowWork) else work.spheres for work in works]
    assert len({query.tobytes() for queries in asked for query in queries}) == 2 * COUNT


@pytest.mark.parametrize("op", [ops.STRIKE, ops.STEP_DOWN])
def test_yardstick_answers_as_the_oracle(op: str) -> None:
    """The C++ version, written from the specification by itself, has the same bits."""
    work = contest().work(op, 20 * COUNT)
    found = answer(yardstick().maker(op), work)
    demand_equal(work, [found, answer(oracle_maker(op), work)])
    assert 0.1 < (found[:, -1] >= 0.0).mean() < 1.0


@pytest.mark.parametrize("op", [ops.STRIKE, ops.STEP_DOWN])
def test_sorted_queries_have_the_same_answers(op: str) -> None:
    """They are told in the order in which queries were drawn, although they were not asked in it."""
    work = contest().work(op, 2000)
    order = order_of(SPHERES, work.spheres)
    assert sorted(order.tolist()) == list(range(2000))
    assert (np.diff(order) != 1).any()
    demand_equal(work, [answer(yardstick().maker(op), work), answer(yardstick().sorted_maker(op), work)])


@pytest.mark.parametrize("op", [ops.STRIKE, ops.STEP_DOWN])
@pytest.mark.parametrize(("count", "threads"), [(2001, 2), (20, 3)])
def test_threads_of_the_yardstick_share_its_queries(op: str, count: int, threads: int) -> None:
    """Each answers a part, also where the parts are not equal, and none is left out."""
    work = contest().work(op, count)
    shared = yardstick().shared_maker(op, threads)
    demand_equal(work, [answer(yardstick().maker(op), work), answer(shared, work), answer(shared, work)])


def test_an_error_in_a_thread_of_the_yardstick_is_raised(monkeypatch: pytest.MonkeyPatch) -> None:
    """A job that is broken off has no time."""
    work = contest().work(ops.STRIKE, 20)
    job = yardstick().shared_maker(ops.STRIKE, 2)(work)

    def fail(*_arguments: Any) -> None:
        raise OSError("broken off")

    monkeypatch.setattr(NativeTree, "strike", fail)
    with pytest.raises(OSError, match="broken off"):
        job.run()


def test_compiler_is_described() -> None:
    """A report says what compiled the yardstick, and that nothing was vectorised or fused."""
    described = Compiler(("/usr/bin/g++", "-m64")).describe()
    assert described.startswith("g++ -m64 -std=c++17 -O2")
    assert "-fno-tree-slp-vectorize" in described
    assert "-ffp-contract=off" in described


def test_microsoft_compiler_has_its_own_flags(tmp_path: Path) -> None:
    """It is known by its name, and told /fp:precise."""
    arguments = Compiler(("C:/tools/cl.exe",)).arguments(tmp_path / "y.cpp", tmp_path / "y.dll")
    assert "/fp:precise" in arguments
    assert f"/Fe{tmp_path / 'y.dll'}" in arguments


def test_no_compiler_is_said_clearly(monkeypatch: pytest.MonkeyPatch) -> None:
    """A CXX that is not there is named."""
    monkeypatch.setenv("CXX", "no-such-compiler-xyz")
    with pytest.raises(NoCompilerError, match="no-such-compiler-xyz"):
        find_compiler()


def test_a_failing_compiler_is_quoted(tmp_path: Path) -> None:
    """What it said is part of the error, and nothing is left behind."""
    try:
        program = find_compiler().command[0]
    except NoCompilerError as error:
        pytest.skip(f"skipped: {error}")
    with pytest.raises(NoCompilerError, match="failed"):
        compile_yardstick(Compiler((program, "--no-such-flag-xyz")), tmp_path)
    assert list(tmp_path.iterdir()) == []


def test_fans_cover_every_polygon() -> None:
    """A polygon of n corners is n - 2 triangles."""
    geometry = contest().scene.geometry
    assert len(triangles(geometry)) == sum(len(polygon.vertices) - 2 for polygon in geometry.polygons)


def test_distance_is_that_of_the_nearest_polygon() -> None:
    """A point a hand's breadth in front of a polygon's middle is that far away."""
    geometry = contest().scene.geometry
    corners = np.array(geometry.corners(0))
    normal = np.cross(corners[1] - corners[0], corners[2] - corners[0])
    point = corners[:3].mean(axis=0) + 0.1 * normal / np.linalg.norm(normal)
    assert distance_to(geometry, point) == pytest.approx(0.1, abs=1e-5)


@pytest.mark.parametrize("name", list(MODULES))
def test_peers_agree_with_the_true_distance(name: str) -> None:
    """A peer says that a sphere touches iff it reaches the nearest polygon."""
    pytest.importorskip(MODULES[name], reason=f"skipped: {name} is not installed")
    work = contest().work(ops.STRIKE, 10 * COUNT)
    found = answer(peer_maker(name), work)[:, 0] > 0.0
    distances = np.array([distance_to(work.scene.geometry, ball[:3]) for ball in work.spheres])
    clear = np.abs(distances - work.spheres[:, 3]) > EXPLAINED
    assert (found[clear] == (distances < work.spheres[:, 3])[clear]).all()


def test_oracle_touches_what_the_distance_says() -> None:
    """Retail's strike finds a polygon iff the sphere reaches one: the question that peers are asked."""
    work = contest().work(ops.STRIKE, 10 * COUNT)
    found = answer(oracle_maker(ops.STRIKE), work)[:, 1:] >= 0.0
    distances = np.array([distance_to(work.scene.geometry, ball[:3]) for ball in work.spheres])
    truth = (distances < work.spheres[:, 3]).astype(np.float64).reshape(-1, 1)
    differ = ~equal_rows(found.astype(np.float64), truth)
    assert unexplained(work, differ) == 0
