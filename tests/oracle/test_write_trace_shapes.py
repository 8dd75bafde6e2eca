"""Recording writes of spheres and cylinders: the contact plane, and who writes it."""

from __future__ import annotations

import pytest
from oracle_obstacles import approaching
from oracle_worlds import at, vec

from conformance.trace_text import line_of
from oracle.cyl_sphere import CylSphere
from oracle.physics_object import PhysicsObj
from oracle.physics_part import PartArray, Setup
from oracle.sphere import Sphere
from oracle.write_trace import recording
from oracle.writes import BSP, CONTACT_PLANE, BspCall, Write

SPHERE = Setup(sphere=(Sphere(vec(0.0, 0.0, 0.0), 1.5),))
CYLINDER = Setup(cylsphere=(CylSphere(vec(0.0, 0.0, -0.5), 2.0, 1.5),))


def obstacle(setup: Setup) -> PhysicsObj:
    """Return an object whose top is 1.5 metres above the origin."""
    parts = PartArray([], setup, vec(1.0, 1.0, 1.0))
    return PhysicsObj(1, 0, at(0.0, 0.0, 0.0), scale=1.0, part_array=parts)


@pytest.mark.parametrize("setup", [SPHERE, CYLINDER])
@pytest.mark.parametrize(
    ("mode", "caller", "d"),
    [("step_down", "step_sphere_down", "-1.500"), ("collide", "intersects_sphere", None)],
)
def test_who_writes_the_contact_plane(setup: Setup, mode: str, caller: str, d: str | None) -> None:
    """07 4.14, 8.8.14, 10.2.6, 10.8.6.5: valid, plane, water and cell, each by the same function."""
    made = approaching((0.0, 0.0, 2.25), (0.0, 0.0, 1.75), **{mode: 1})
    with recording(made, (CONTACT_PLANE,)) as trace:
        obstacle(setup).find_obj_collisions(made)
    lines = [line_of(entry) for entry in trace.entries]
    if d is None:
        d = "-1.250" if setup is SPHERE else "-1.500"
    assert lines == [
        f"[cp-write] ContactPlaneValid: 0 -> 1 caller={caller}",
        f"[cp-write] ContactPlane: n=(0,0,0) D=0.000 -> n=(0,0,1) D={d} caller={caller}",
        f"[cp-write] ContactPlaneIsWater: 0 -> 1 caller={caller}",
        f"[cp-write] ContactPlaneCellId: 0x00000000 -> 0xA9B40111 caller={caller}",
    ]


@pytest.mark.parametrize(("setup", "letter"), [(SPHERE, "S"), (CYLINDER, "C")])
def test_a_shape_s_test_is_a_call(setup: Setup, letter: str) -> None:
    """The test is told like that of a tree, and what is written during it knows how it ended."""
    made = approaching((0.0, 0.0, 1.75), (0.0, 0.0, 1.75), step_down=1)
    with recording(made, (BSP, CONTACT_PLANE)) as trace:
        obstacle(setup).find_obj_collisions(made)
    call, *writes = trace.entries
    assert isinstance(call, BspCall)
    assert (call.letter, call.result) == (letter, "ADJUSTED")
    assert [write.call is call for write in writes if isinstance(write, Write)] == [True] * 4
