"""The engine's trace of writes: what is told and by whom, and that it changes nothing."""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest
from engine_bodies import GRAVITY, grounded, walker
from engine_scenes import CELL, at, floor_and_wall, mover, triangle, world_of

from engine import (
    CollisionCall,
    ContactPlane,
    Move,
    PathState,
    Seed,
    body_rows,
    find_collisions,
    resolve,
    resolve_many,
    step_many,
    update_many,
)
from engine.coherence import AS_ASKED
from engine.constants import FLOOR_Z
from engine.kernels.program import RESOLVE
from engine.kernels.program import run as compiled
from engine.layout import RESULT_SIZE
from engine.memory import rows_as_numbers
from engine.plan import NO_PLAN
from engine.query import move_rows
from engine.threads import new_share
from engine.tracing import UnknownTopicError, recording, runnable
from engine.tracing_writes import (
    BSP,
    CELL_TRANSIT,
    CONTACT_PLANE,
    SLIDING,
    STATE,
    TOPICS,
    UNFINISHED,
    WALKABLE,
    BspCall,
    Write,
)

if TYPE_CHECKING:
    from engine.tracing_writes import WriteTrace

LANDING = Move(mover(), at(0.0, 0.0, 0.4), CELL, start=at(0.0, 0.0, 0.7))
GROUND = ContactPlane((0.0, 0.0, 1.0, 0.0), CELL)


def told(trace: WriteTrace) -> list[tuple[Any, ...]]:
    """Return the trace's entries in short."""
    return [(entry.label, entry.before, entry.after, entry.caller) for entry in trace.entries]


def test_a_landing_write_by_write() -> None:
    """A sphere falls on to a floor: the calls of its tree and every write, in order, with who made it."""
    with recording() as trace:
        resolve(world_of(triangle()), LANDING)
    assert told(trace) == [
        ("Call", "A", "ADJUSTED", "find_env_collisions"),
        ("Call", "L", "ADJUSTED", "find_env_collisions"),
        ("ContactPlaneValid", 0, 1, "find_collisions"),
        ("ContactPlane", (0.0, 0.0, 0.0, 0.0), (0.0, 0.0, 1.0, -0.0), "find_collisions"),
        ("ContactPlaneCellId", 0, CELL, "find_collisions"),
        ("Walkable", None, 0, "find_collisions"),
        ("Call", "L", "OK", "find_env_collisions"),
        ("Call", "P", "OK", "find_env_collisions"),
        ("Walkable", 0, None, "transitional_insert"),
        ("LastKnownContactPlaneValid", 0, 1, "validate_transition"),
        ("LastKnownContactPlane", (0.0, 0.0, 0.0, 0.0), (0.0, 0.0, 1.0, -0.0), "validate_transition"),
        ("LastKnownContactPlaneCellId", 0, CELL, "validate_transition"),
        ("State", 0, 1, "validate_transition"),
        ("State", 1, 3, "validate_transition"),
    ]


def test_a_write_knows_the_call_around_it_and_the_foot() -> None:
    """The plane of a landing is written in the call that returns ADJUSTED, when the mover is on the floor."""
    with recording((CONTACT_PLANE, BSP)) as trace:
        resolve(world_of(triangle()), LANDING)
    first, second, written, *_ = trace.entries
    assert isinstance(first, BspCall)
    assert (first.transition, first.topic, first.foot, first.call) == (1, BSP, None, first)
    assert isinstance(written, Write)
    assert written.call is second
    assert written.call is not None
    assert written.call.result == "ADJUSTED"
    assert written.foot == (0.0, 0.0, 0.0)


@pytest.mark.parametrize("topic", TOPICS)
def test_only_the_topics_that_are_asked_for(topic: str) -> None:
    """Each topic alone gives its share of the whole."""
    world = world_of(floor_and_wall())
    moves = [LANDING, Move(mover(3), at(0.7, 0.2, 0.48), CELL, start=at(0.4, 0.0, 0.48), seed=Seed(GROUND))]

    def record(topics: tuple[str, ...]) -> list[Any]:
        with recording(topics) as trace:
            resolve_many(world, moves)
        return [(entry.transition, *shown) for entry, shown in zip(trace.entries, told(trace), strict=True)]

    whole = record(TOPICS)
    with recording() as trace:
        resolve_many(world, moves)
    shares = [shown for entry, shown in zip(trace.entries, whole, strict=True) if entry.topic == topic]
    assert record((topic,)) == shares
    assert shares or topic == CELL_TRANSIT


def test_a_seed_is_written_from_outside_and_a_sliding_normal_once() -> None:
    """It is made horizontal and of unit length, which is one write."""
    seed = Seed(contact=GROUND, sliding_normal=(0.0, -0.6, 0.8))
    with recording((CONTACT_PLANE, SLIDING)) as trace:
        resolve(world_of(triangle()), Move(mover(), at(0.0, 0.0, 1.0), CELL, at(0.0, 0.0, 1.0), seed))
    assert told(trace)[:5] == [
        ("ContactPlaneValid", 0, 1, "outside"),
        ("ContactPlane", (0.0, 0.0, 0.0, 0.0), (0.0, 0.0, 1.0, 0.0), "outside"),
        ("ContactPlaneCellId", 0, CELL, "outside"),
        ("SlidingNormalValid", 0, 1, "outside"),
        ("SlidingNormal", (0.0, 0.0, 0.0), (0.0, -1.0, 0.0), "outside"),
    ]


def test_the_same_value_again_is_no_write() -> None:
    """A step over the same floor writes the plane that is there already, which is not told."""
    ground = ContactPlane((0.0, 0.0, 1.0, -0.0), CELL)
    seed = Seed(contact=ground, last_known=ground)
    with recording((CONTACT_PLANE,)) as trace:
        resolve(world_of(triangle()), Move(mover(3), at(0.1, 0.0, 0.48), CELL, at(0.0, 0.0, 0.48), seed))
    assert [entry.label for entry in trace.entries if entry.caller != "outside"] == ["ContactPlaneValid"] * 2


def test_a_collision_call_is_made_from_outside() -> None:
    """What asks for one call of a tree is no function of retail."""
    pose = at(0.0, 0.0, 0.4)
    path = PathState(step_down=1, step_down_amt=0.5, walk_interp=1.0, walkable_allowance=FLOOR_Z)
    with recording((BSP, WALKABLE)) as trace:
        find_collisions(world_of(triangle()), CollisionCall(Move(mover(), pose, CELL, start=pose), path=path))
    assert told(trace) == [
        ("Call", "D", "ADJUSTED", "outside"),
        ("Walkable", None, 0, "step_sphere_down"),
    ]


def test_transitions_are_numbered_as_they_begin() -> None:
    """Over the queries of a batch and of those that follow."""
    world = world_of(triangle())
    with recording((STATE,)) as trace:
        resolve_many(world, [LANDING, LANDING])
        resolve(world, LANDING)
    assert [entry.transition for entry in trace.entries] == [1, 1, 2, 2, 3, 3]


def test_the_ticks_of_bodies_are_recorded() -> None:
    """A body that walks: in each tick get_object_info seeds its plane anew."""
    world = world_of(triangle())
    rows = body_rows(world, [grounded(0, velocity=(1, 0, 0))])
    with recording((CONTACT_PLANE,)) as trace:
        step_many(world, rows, 1 / 30, 2)
    seeded = [(e.transition, e.label) for e in trace.entries if e.caller == "get_object_info"]
    labels = ("ContactPlaneValid", "ContactPlane", "ContactPlaneCellId")
    assert seeded == [(tick, label) for tick in (1, 2) for label in labels]


@pytest.mark.parametrize("tick", [step_many, update_many])
def test_traced_ticks_end_in_the_same_bits(tick: Any) -> None:
    """Several ticks of a body that falls, lands and slides along a wall; a trace takes no shortcuts."""
    world = world_of(floor_and_wall())
    bodies = [walker(z=0.6, velocity=(2.0, 0.3, -1.0), acceleration=(0, 0, GRAVITY))]
    plain, traced = body_rows(world, bodies), body_rows(world, bodies)
    arguments = (1 / 30, 12) if tick is step_many else (0.9,)
    tick(world, plain, *arguments, plan=NO_PLAN)
    with recording() as trace:
        tick(world, traced, *arguments)
    assert trace.entries
    assert plain.tobytes() == traced.tobytes()


def test_traced_queries_end_in_the_same_bits() -> None:
    """Moves from everywhere to everywhere about a wall, and a placement in it; a trace takes no shortcuts."""
    world = world_of(floor_and_wall())
    rng = np.random.default_rng(7)
    moves = [
        Move(mover(state, spheres=spheres), at(*end), CELL, start=at(*start), seed=Seed(GROUND))
        for state in (0, 3, 0x8, 0x203)
        for spheres in (1, 2)
        for start, end in rng.uniform((-0.5, -1.0, 0.3), (1.5, 1.0, 1.2), size=(4, 2, 3))
    ]
    moves.append(Move(mover(), at(0.9, 0.0, 0.2), CELL))
    rows = move_rows(world, moves)
    plain = resolve_many(world, rows, plan=NO_PLAN)
    with recording():
        traced = resolve_many(world, rows)
    assert plain.tobytes() == traced.tobytes()


def test_nothing_is_recorded_outside_the_block() -> None:
    """Then the kernel itself is run."""
    with recording() as trace:
        assert runnable(compiled) is not compiled
    assert runnable(compiled) is compiled
    resolve(world_of(triangle()), LANDING)
    assert not trace.entries


def test_another_thread_is_not_recorded() -> None:
    """A recording belongs to the thread that has begun it."""
    world = world_of(triangle())
    with recording() as trace, ThreadPoolExecutor(1) as others:
        others.submit(resolve, world, LANDING).result()
    assert not trace.entries


def test_recordings_nest() -> None:
    """The inner one records alone; its end leaves the outer one running."""
    world = world_of(triangle())
    with recording((STATE,)) as outer:
        with recording((STATE,)) as inner:
            resolve(world, LANDING)
        assert not outer.entries
        resolve(world, LANDING)
    assert told(inner) == told(outer)


class FatalError(Exception):
    """Stands for a mistake in the engine."""


def test_an_error_leaves_a_call_unfinished() -> None:
    """What was written before is told, and the call whose polygon could not be read has no result."""
    world = world_of(triangle())
    polygon = world.polygon(0, 0)

    class Unreadable(np.ndarray[Any, Any]):
        """A world's numbers without those of the polygon."""

        def __getitem__(self, index: Any) -> Any:
            if index == polygon:
                raise FatalError
            return super().__getitem__(index)

    queries = rows_as_numbers(move_rows(world, [LANDING]))
    out = np.zeros((1, int(RESULT_SIZE)))
    floats, row = world.floats.view(Unreadable), world.new_row()
    with recording((STATE, BSP)) as trace, pytest.raises(FatalError):
        runnable(compiled)(floats, world.ints, row, RESOLVE, queries, out, AS_ASKED, new_share(1))
    assert told(trace) == [("Call", "A", UNFINISHED, "find_env_collisions")]


def test_an_unknown_topic_is_refused() -> None:
    """Its name is told, and those that there are."""
    complaint = r"topics: unknown topic 'cp'; there are: cp-write, "
    with pytest.raises(UnknownTopicError, match=complaint), recording(("cp",)):
        pass
    assert runnable(compiled) is compiled
