"""OBJECTINFO::validate_walkable: both sides of each limit of VW-1...VW-25."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import pytest

from engine import layout as at
from engine.constants import (
    ADJUSTED,
    COLLIDED,
    CONTACT,
    EPS,
    FLOOR_Z,
    IS_VIEWER,
    OK,
    ON_WALKABLE,
)
from engine.kernels.object_info import validate_walkable

if TYPE_CHECKING:
    from engine.kernels.types import Array

LAND = 0xA9B40001
LEVEL = (0.0, 0.0, 1.0, 0.0)
"""Ground at z = 0."""
BELOW_FLOOR_Z = float(np.nextafter(np.float32(FLOOR_Z), np.float32(0)))
"""The steepest slope that is too steep, as the normal's z."""


def row(**fields: float) -> Array:
    """Return a row of state; fields by their names, others 0."""
    state = np.zeros(at.STATE_SIZE)
    view = state.view(at.STATE_DTYPE)[0]
    view["num_sphere"] = 1
    view["begin_cell"] = view["check_cell"] = 0
    for name, value in fields.items():
        view[name] = value
    return state


def stand(
    state: Array, height: float, plane: tuple[float, ...] = LEVEL, *, depth: float = 0.0, water: float = 0.0
) -> int:
    """Test a sphere of 0.5 metres whose lowest point is at a height."""
    ground = np.array(plane)
    return validate_walkable(state, 0.0, 0.0, height + 0.5, 0.5, ground, 0, water, depth, float(LAND))


def named(state: Array) -> np.void:
    """Return a row by its fields' names."""
    view: np.void = state.view(at.STATE_DTYPE)[0]
    return view


ABOVE = 2.0**-11
"""More than EPS."""
WITHIN = 2.0**-13
"""Less than EPS; these heights are exact in the sums that the test forms."""


@pytest.mark.parametrize(("height", "contact"), [(ABOVE, 0), (WITHIN, 1), (0.0, 1), (-WITHIN, 1)])
def test_ground_is_touched_within_eps(height: float, contact: int) -> None:
    """Above nothing happens; within, the ground is the contact plane, and nothing moves."""
    state = row(state=CONTACT | ON_WALKABLE)
    assert stand(state, height) == OK
    assert named(state)["contact_plane_valid"] == contact
    assert named(state)["check_pos"][at.ORIGIN + 2] == 0.0
    if contact:
        assert named(state)["contact_plane"].tolist() == list(LEVEL)
        assert named(state)["contact_plane_cell_id"] == LAND


def test_a_sphere_below_the_ground_is_lifted() -> None:
    """By the distance over the normal's z, along z."""
    state = row(state=CONTACT | ON_WALKABLE)
    assert stand(state, -0.25) == ADJUSTED
    assert named(state)["check_pos"][at.ORIGIN + 2] == 0.25
    assert named(state)["contact_plane_valid"] == 1


def test_water_lets_a_sphere_sink_in() -> None:
    """By its depth; the plane is then one of water."""
    state = row(state=CONTACT | ON_WALKABLE)
    assert stand(state, -0.25, depth=0.25, water=1.0) == OK
    assert named(state)["contact_plane_is_water"] == 1
    assert stand(row(), -0.25, depth=0.5) == OK


@pytest.mark.parametrize(
    ("bits", "step_down", "nz", "accepted"),
    [
        (CONTACT | ON_WALKABLE, 0, FLOOR_Z, True),
        (CONTACT | ON_WALKABLE, 0, BELOW_FLOOR_Z, False),
        (CONTACT | ON_WALKABLE, 1, BELOW_FLOOR_Z, True),
        (CONTACT, 0, BELOW_FLOOR_Z, True),
    ],
)
def test_who_stands_ignores_what_is_too_steep(bits: int, step_down: int, nz: float, accepted: bool) -> None:
    """Below it, too: neither lifted nor in contact. Who does not stand, or steps down, takes any slope."""
    for height in (0.0, -0.25):
        state = row(state=bits, step_down=step_down, step_down_amt=8.0, walk_interp=1.0)
        lifted = accepted and height < 0.0
        assert stand(state, height, (0.0, 0.0, nz, 0.0)) == (ADJUSTED if lifted else OK)
        assert named(state)["contact_plane_valid"] == accepted


@pytest.mark.parametrize("height", [0.0, -0.25])
def test_what_was_in_the_air_notes_what_it_hit(height: float) -> None:
    """The normal and the environment; not while it steps down."""
    state = row()
    stand(state, height)
    assert named(state)["collision_normal"].tolist() == [0.0, 0.0, 1.0]
    assert named(state)["collided_with_environment"] == 1
    state = row(step_down=1, step_down_amt=1.0, walk_interp=1.0)
    stand(state, height)
    assert named(state)["collision_normal_valid"] == 0


def test_a_look_for_support_finds_it_below_the_ground_only() -> None:
    """COLLIDED says that something supports the mover."""
    assert stand(row(check_walkable=1), -0.25) == COLLIDED
    assert stand(row(check_walkable=1), 0.0) == OK


@pytest.mark.parametrize(
    ("depth", "amount", "result", "interp"),
    [
        (0.25, 1.0, ADJUSTED, 0.75),
        (1.0, 1.0, ADJUSTED, 0.0),
        (1.25, 1.0, COLLIDED, 1.0),
        (0.25, 0.5, ADJUSTED, 0.5),
    ],
)
def test_a_step_down_uses_up_what_it_is_lifted(
    depth: float, amount: float, result: int, interp: float
) -> None:
    """W = (1 - depth / amount): a quarter of a metre of one leaves 0.75; less than -0.1 is too much."""
    state = row(step_down=1, step_down_amt=amount, walk_interp=1.0)
    assert stand(state, -depth) == result
    assert named(state)["walk_interp"] == interp
    assert named(state)["contact_plane_valid"] == 1


def viewer(height: float, *, begin: int = LAND, current: float = 2.0) -> Array:
    """Return a camera that comes from straight above."""
    state = row(state=IS_VIEWER, has_begin_pos=1)
    state[at.BEGIN_POS] = begin
    state[at.GLOBAL_CURR_CENTER + 2] = current
    state[at.CHECK_POS + at.ORIGIN + 2] = height
    return state


@pytest.mark.parametrize(("height", "result"), [(0.5, OK), (0.5 - WITHIN, OK), (0.25, ADJUSTED)])
def test_a_camera_is_kept_above_the_ground(height: float, result: int) -> None:
    """Its whole sphere, whatever the water's depth; it is put back along its way.

    At 0.25 it is 0.25 too deep, on a way of -1.75: t = -0.25 / -1.75 = 1/7, and it goes back by 1/7 of it.
    """
    state = viewer(height)
    assert stand(state, height - 0.5, depth=9.0) == result
    back = float(np.float32(-1.75 * -(np.float32(-0.25) / -1.75))) if result == ADJUSTED else 0.0
    assert named(state)["check_pos"][at.ORIGIN + 2] == float(np.float32(height + back))
    assert named(state)["collision_normal_valid"] == (result == ADJUSTED)


@pytest.mark.parametrize(("begin", "result"), [(0xA9B400FF, ADJUSTED), (0xA9B40100, OK)])
def test_a_camera_that_began_indoors_may_be_under_the_ground(begin: int, result: int) -> None:
    """If the way does not cross it: from -1 it comes from below, t = -0.75 / 0.5 is negative."""
    state = viewer(-0.25, begin=begin, current=-0.75)
    assert stand(state, -0.75) == result


def test_the_limits_are_not_equal_to_eps() -> None:
    """What the heights above stand for."""
    assert WITHIN < EPS < ABOVE
