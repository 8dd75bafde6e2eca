"""CPhysicsObj, contact: bits, and who hears that they change."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest
from oracle_bodies import Listener, walker
from oracle_worlds import vec, xyz

from oracle.constants import EPS, GRAVITY
from oracle.transient_state import CONTACT_TS, ON_WALKABLE_TS, WATER_CONTACT_TS

if TYPE_CHECKING:
    from collections.abc import Callable

    Step = Callable[[float, int], float]

ALL_BITS = 0x1FF


@pytest.mark.parametrize(
    ("was", "flag", "heard", "after", "acceleration"),
    [
        (0, 1, ["hit"], ON_WALKABLE_TS, 0.0),
        (ON_WALKABLE_TS, 1, [], ON_WALKABLE_TS, 0.0),
        (ON_WALKABLE_TS, 0, ["leave"], 0, GRAVITY),
        (0, 0, [], 0, GRAVITY),
    ],
)
def test_on_walkable(was: int, flag: int, heard: list[str], after: int, acceleration: float) -> None:
    """OW-1…3: only changes are heard; the acceleration is always computed anew."""
    body, listener = walker(transient=CONTACT_TS | was), Listener()
    body.movement_manager = listener
    body.m_acceleration = vec(1.0, 1.0, 1.0)
    body.set_on_walkable(flag)
    assert (listener.heard, body.transient_state) == (heard, CONTACT_TS | after)
    assert xyz(body.m_acceleration) == (0.0, 0.0, acceleration)


def test_an_object_without_steering_hears_nothing() -> None:
    """OW-2: the bit changes all the same."""
    body = walker(transient=CONTACT_TS)
    body.set_on_walkable(1)
    assert body.transient_state == CONTACT_TS | ON_WALKABLE_TS


@pytest.mark.parametrize(("was", "heard"), [(ALL_BITS, ["leave"]), (WATER_CONTACT_TS, [])])
def test_clearing_everything(was: int, heard: list[str]) -> None:
    """06 1: all bits go, the plane stays, gravity acts again, and leaving the ground is heard."""
    body, listener = walker(transient=was), Listener()
    body.movement_manager = listener
    body.clear_transient_states()
    assert (body.transient_state, listener.heard) == (0, heard)
    assert (body.m_acceleration.z, body.contact_plane.N.z) == (GRAVITY, 1.0)


@pytest.mark.parametrize(("steps", "kept"), [(0, 1), (1, 0)])
def test_leaving_the_contact_plane(steps: int, kept: int, next32: Step) -> None:
    """06 6: EPS metres per second away from the plane is contact, one bit more is not."""
    body = walker(velocity=(9.0, 9.0, next32(EPS, steps)))
    assert body.check_contact(1) == kept
    assert body.check_contact(0) == 0


def test_without_contact_nothing_is_left() -> None:
    """06 6: then the argument is the answer, whatever the velocity."""
    assert walker(transient=0, velocity=(0.0, 0.0, 9.0)).check_contact(1) == 1
