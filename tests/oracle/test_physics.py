"""CPhysics: when a rendered frame is simulated."""

from __future__ import annotations

import math

import pytest
from oracle_bodies import Ticking

from oracle.constants import MIN_QUANTUM
from oracle.physics import Physics
from oracle.world import World


def frame(last_update: float, now: float) -> tuple[Physics, Ticking]:
    """Render one frame; the object was simulated up to 0."""
    world = World()
    world.clock.cur_time = now
    physics, body = Physics(world, last_update), Ticking(world)
    physics.objects.append(body)
    physics.use_time()
    return physics, body


def test_a_frame_is_simulated_after_a_thirtieth_of_a_second() -> None:
    """UT-3…5: exactly MIN_QUANTUM runs, and the excess is not carried over."""
    physics, body = frame(0.0, MIN_QUANTUM)
    assert (physics.last_update, body.quanta) == (MIN_QUANTUM, [0.03333333507180214])
    physics, body = frame(0.0, 0.05)
    assert physics.last_update == 0.05


def test_a_frame_too_early_does_nothing() -> None:
    """UT-3: one bit less than MIN_QUANTUM waits."""
    physics, body = frame(0.0, math.nextafter(MIN_QUANTUM, 0.0))
    assert (physics.last_update, body.quanta) == (0.0, [])


@pytest.mark.parametrize("now", [-0.5, math.nextafter(1.0, 0.0)])
def test_a_clock_that_goes_back_resets_the_gate(now: float) -> None:
    """UT-2: nothing is simulated."""
    physics, body = frame(1.0, now)
    assert (physics.last_update, body.quanta) == (now, [])


def test_every_object_is_simulated() -> None:
    """UT-4: in the order of the table."""
    world = World()
    world.clock.cur_time = 0.125
    physics = Physics(world, 0.0)
    physics.objects += [Ticking(world), Ticking(world)]
    physics.use_time()
    assert [body.quanta for body in physics.objects if isinstance(body, Ticking)] == [[0.125], [0.125]]


def test_a_clock_shows_both_times() -> None:
    """The wall clock first."""
    clock = World().clock
    clock.cur_time, clock.curr_time = 2.0, 1.5
    assert repr(clock) == "Clock(2.0, 1.5)"
