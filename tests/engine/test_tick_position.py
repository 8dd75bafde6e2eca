"""What a tick tells its transition, and what it takes over from it."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from engine_bodies import ACTIVE, GRAVITY, GROUNDED, f32, grounded, row_of, walker
from engine_scenes import CELL, R

from engine import layout as at
from engine.constants import DUMMY_RADIUS, FLOOR_Z
from engine.kernels.tick_position import become_lost, take_over
from engine.kernels.tick_seed import seed_transition

HERE, THERE = 0, 1
OUTDOORS = 0xA9B40001


def fresh_state() -> tuple[Any, Any]:
    """Return a row of state by name and as numbers."""
    state = np.zeros(at.STATE_SIZE, dtype=np.float64)
    return state.view(at.STATE_DTYPE)[0], state


@pytest.mark.parametrize(
    ("normal_z", "bits"), [(FLOOR_Z, 0x83), (np.nextafter(np.float32(FLOOR_Z), np.float32(0)), 0x81)]
)
def test_the_floor_limit_itself_can_be_stood_on(normal_z: float, bits: int) -> None:
    """Only the normal's z counts; on a steeper plane gravity goes on pulling."""
    made, state = fresh_state()
    made["contact_plane_valid"] = 1
    made["contact_plane"] = 0.0, 0.0, normal_z, 0.0
    record, row = row_of(walker())
    take_over(state, row, float(CELL))
    assert record["transient_state"] == bits
    assert record["acceleration"][2] == (0.0 if bits & 2 else GRAVITY)


def test_an_invalid_plane_is_copied_all_the_same() -> None:
    """Validity is in the bit only; so is that of the sliding normal."""
    made, state = fresh_state()
    made["contact_plane"] = 0.0, 1.0, 0.0, 7.0
    made["contact_plane_cell_id"] = 5
    made["sliding_normal"] = 1.0, 0.0, 0.0
    record, row = row_of(grounded())
    take_over(state, row, float(CELL))
    assert record["contact_plane"].tolist() == [0.0, 1.0, 0.0, 7.0]
    assert record["contact_plane_cell_id"] == 5
    assert record["sliding_normal"].tolist() == [1.0, 0.0, 0.0]
    assert record["transient_state"] == ACTIVE


def test_a_new_cell_gives_its_own_id() -> None:
    """In the same cell the position's id is taken; in another one the cell's, whatever the position's."""
    for cell, cell_id in ((HERE, CELL + 2), (THERE, CELL + 1)):
        made, state = fresh_state()
        made["curr_cell"] = cell
        made["curr_pos"][0] = CELL + 2
        record, row = row_of(walker())
        take_over(state, row, float(CELL + 1))
        assert (record["cell_id"], record["cell"]) == (cell_id, cell)


@pytest.mark.parametrize(
    ("cell_id", "origin", "stored", "point"),
    [
        (CELL, (-500, 0, 1), CELL, (-500, 0, 1)),
        (OUTDOORS, (193, -1, 5), 0xAAB30008, (1, 191, 5)),
        (OUTDOORS, (0.0001, 25, 5), 0xA9B40002, (0, 25, 5)),
        (0xA9B40041, (1, 1, 1), 0, (1, 1, 1)),
        (0x00000001, (-1, 1, 1), 0, (-1, 1, 1)),
    ],
)
def test_a_lost_body_is_brought_to_its_land_cell(
    cell_id: int, origin: tuple[float, ...], stored: int, point: tuple[float, ...]
) -> None:
    """Indoors it stays where it was lost; beyond the land, or from no cell, its id is 0. It sleeps."""
    made, state = fresh_state()
    made["curr_pos"][0] = cell_id
    made["curr_pos"][at.ORIGIN :] = origin
    record, row = row_of(grounded(velocity=(1, 2, 3)))
    become_lost(state, row)
    assert (record["cell_id"], record["origin"].tolist()) == (stored, list(point))
    assert (record["cell"], record["transient_state"]) == (at.NO_CELL, GROUNDED & ~ACTIVE)
    assert record["velocity"].tolist() == [1.0, 2.0, 3.0]


def test_a_standing_body_seeds_both_planes() -> None:
    """Contact and last-known plane are those of the last tick; water is the body's bit itself."""
    record, row = row_of(grounded(transient_state=GROUNDED | 0x8))
    made, state = fresh_state()
    assert seed_transition(state, row, False) == 0x203
    for name in ("contact_plane", "last_known_contact_plane"):
        assert made[f"{name}_valid"] == 1
        assert made[name].tolist() == record["contact_plane"].tolist()
        assert (made[f"{name}_cell_id"], made[f"{name}_is_water"]) == (CELL, 0x8)
    assert made["local_sphere"][:, 3].tolist() == [R, R]
    assert made["may_step_down"] == 1


def test_a_leaving_body_seeds_the_last_known_plane_only() -> None:
    """Its cell id goes to the contact plane's field; faster than EPS along the normal is leaving."""
    for speed, flags in ((0.0002, 0x203), (0.00021, 0x200)):
        _, row = row_of(grounded(velocity=(0, 0, speed)))
        made, state = fresh_state()
        assert seed_transition(state, row, False) == flags
        assert made["last_known_contact_plane_valid"] == 1
        assert made["contact_plane_valid"] == (flags & 1)
        assert made["contact_plane_cell_id"] == CELL
        assert made["last_known_contact_plane_cell_id"] == (CELL if flags & 1 else 0)


def test_a_move_by_an_administrator_is_not_seeded() -> None:
    """Neither contact nor sliding normal; other flags are."""
    body = grounded(state=0x44, free_heading=True, weenie_bits=0x100, sliding_normal=(1, 0, 0))
    _, row = row_of(replace(body, transient_state=GROUNDED | 0x4))
    made, state = fresh_state()
    assert seed_transition(state, row, True) == 0x18
    assert made["state"] == 0x118
    assert (made["contact_plane_valid"], made["last_known_contact_plane_valid"]) == (0, 0)
    assert made["sliding_normal_valid"] == 0
    assert (made["ethereal"], made["may_step_down"], made["gravity"]) == (4, 0, 0)


def test_the_sliding_normal_is_made_horizontal() -> None:
    """And of unit length; the highest bit of the stationary ticks is the counter."""
    body = grounded(sliding_normal=(0.5, 0, 3), transient_state=0x34)
    _, row = row_of(body)
    made, state = fresh_state()
    seed_transition(state, row, False)
    assert made["sliding_normal"].tolist() == [1.0, 0.0, 0.0]
    assert made["frames_stationary_fall"] == 2


def test_without_spheres_there_is_a_small_one() -> None:
    """A tenth of a metre, around a point as high, unscaled."""
    _, row = row_of(replace(walker(), spheres=(), scale=3.0))
    made, state = fresh_state()
    seed_transition(state, row, False)
    assert made["num_sphere"] == 1
    assert made["local_sphere"][0].tolist() == [0.0, 0.0, DUMMY_RADIUS, DUMMY_RADIUS]
    assert made["local_low_point"].tolist() == [0.0, 0.0, 0.0]
    assert f32(0.1) == DUMMY_RADIUS
