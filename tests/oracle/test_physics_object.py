"""CPhysicsObj: what every object has."""

from __future__ import annotations

from oracle_worlds import mover, vec, xyz


def test_velocity_is_stored() -> None:
    """set_velocity copies; the caller's vector stays its own."""
    moving, velocity = mover(), vec(1.0, 2.0, 3.0)
    moving.set_velocity(velocity, 0)
    velocity.x = 9.0
    assert xyz(moving.m_velocity) == (1.0, 2.0, 3.0)
