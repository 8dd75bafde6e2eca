"""Position and landblock offsets: which coordinates, and how many roundings."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from oracle.frame import Frame
from oracle.land_defs import get_block_offset
from oracle.position import Position
from oracle.vector import Vector3

HERE = 0xA9B40101
EAST = 0xAAB40101
NORTH = 0xA9B50101
HALF_TURN_ABOUT_Z = (0.0, 0.0, 0.0, 1.0)
cell_ids = st.integers(0x00010001, 0xFFFFFFFF)


def pose(cell: int, x: float, y: float, z: float, *rotation: float) -> Position:
    """Return a position; the rotation defaults to none."""
    return Position(cell, Frame.unpack(Vector3(x, y, z), *(rotation or (1.0, 0.0, 0.0, 0.0))))


def xyz(v: Vector3) -> tuple[float, float, float]:
    """Return x, y, z."""
    return v.x, v.y, v.z


@pytest.mark.parametrize(
    ("cell_from", "cell_to", "offset"),
    [
        (HERE, 0xA9B4FFFF, (0.0, 0.0, 0.0)),
        (HERE, EAST, (192.0, 0.0, 0.0)),
        (HERE, NORTH, (0.0, 192.0, 0.0)),
        (NORTH, EAST, (192.0, -192.0, 0.0)),
        (0, 0x01020001, (192.0, 384.0, 0.0)),
        (0xFFFF0001, 0x00000001, (-48960.0, -48960.0, 0.0)),
    ],
)
def test_blocks_are_192_metres_apart(
    cell_from: int, cell_to: int, offset: tuple[float, float, float]
) -> None:
    """The high byte of the id counts eastwards, the next one northwards."""
    assert xyz(get_block_offset(cell_from, cell_to)) == offset


@given(cell_ids, cell_ids, cell_ids)
def test_block_offsets_add_up(a: int, b: int, c: int) -> None:
    """Going from a to b and on to c is going from a to c, exactly."""
    ab, bc, ac = get_block_offset(a, b), get_block_offset(b, c), get_block_offset(a, c)
    assert (ab.x + bc.x, ab.y + bc.y) == (ac.x, ac.y)


def test_a_new_position_is_nowhere_and_unrotated() -> None:
    """Cell 0, the identity."""
    position = Position()
    assert position.objcell_id == 0
    assert position.frame.is_equal(Frame())
    assert repr(position).startswith("Position(0x00000000, Frame(")


def test_assigning_copies() -> None:
    """Cell id and frame are copied, not shared."""
    source, target = pose(HERE, 1.0, 2.0, 3.0), Position()
    target.assign(source)
    copy = source.copy()
    source.frame.origin.x = 9.0
    assert (target.objcell_id, xyz(target.frame.origin)) == (HERE, (1.0, 2.0, 3.0))
    assert xyz(copy.frame.origin) == (1.0, 2.0, 3.0)


def test_a_local_point_goes_to_the_asking_block() -> None:
    """Only the asker's cell id counts, not its frame."""
    asker = pose(HERE, 50.0, 60.0, 70.0, 0.6, 0.8, 0.0, 0.0)
    there = pose(EAST, 1.0, 2.0, 3.0, *HALF_TURN_ABOUT_Z)
    assert xyz(asker.localtoglobal(there, Vector3(10.0, 20.0, 30.0))) == (183.0, -18.0, 33.0)
    assert xyz(asker.localtoglobal_origin(there)) == (193.0, 2.0, 3.0)


def test_a_local_point_is_rounded_before_and_after_the_block_offset() -> None:
    """2^-20 + 2^-44 survives the first store as 2^-20 and is lost beside 192 in the second."""
    there = pose(EAST, 2.0**-20, 0.0, 0.0)
    point = Vector3(2.0**-44 * 1.5, 0.0, 0.0)
    assert Position(EAST).localtoglobal(there, point).x == 2.0**-20 + 2.0**-43
    assert Position(HERE).localtoglobal(there, point).x == 192.0


def test_the_z_term_is_added_last() -> None:
    """The x and y terms cancel exactly before z is added (Frame adds y last)."""
    position = Position()
    f = position.frame
    f.m0, f.m3, f.m6 = 1.0, -1.0, 1.0
    v = Vector3(2.0**60, 2.0**60, 1.0)
    assert position.localtoglobalvec(v).x == 1.0
    assert Position().localtoglobal(position, v).x == 1.0
    assert f.localtoglobalvec(v).x == 0.0
    f.m0, f.m1, f.m2 = 1.0, -1.0, 1.0
    assert position.globaltolocalvec(v).x == 1.0
    assert f.globaltolocalvec(v).x == 0.0


def test_local_to_local_crosses_blocks() -> None:
    """A point of the eastern block in the local space of a turned frame of this one."""
    here = pose(HERE, 190.0, 0.0, 5.0, *HALF_TURN_ABOUT_Z)
    there = pose(EAST, 1.0, 2.0, 3.0)
    assert xyz(here.localtolocal(there, Vector3(0.5, 0.0, 0.0))) == (-3.5, -2.0, -2.0)


def test_offsets_run_from_this_origin_to_the_other() -> None:
    """Across the border between two blocks."""
    here, there = pose(HERE, 190.0, 10.0, 5.0), pose(EAST, 1.0, 14.0, 5.0)
    assert xyz(here.get_offset(there)) == (3.0, 4.0, 0.0)
    assert here.distance(there) == 5.0
    assert xyz(here.get_offset_point(there, Vector3(1.0, 0.0, 2.0))) == (4.0, 4.0, 2.0)


def test_an_offset_rounds_y_and_z_sums_but_not_x() -> None:
    """192 + 2^-17 keeps its small part in the x register only."""
    small = 2.0**-17
    diagonal = 0xAAB50101
    here, there = pose(HERE, 192.0, 192.0, 0.0), pose(diagonal, small, small, 0.0)
    assert xyz(here.get_offset(there)) == (small, 0.0, 0.0)


def test_a_point_s_offset_rounds_x_and_z_sums_but_not_y() -> None:
    """The other overload keeps y in the register instead."""
    small = 2.0**-17
    diagonal = 0xAAB50101
    here, there = pose(HERE, 192.0, 192.0, 0.0), pose(diagonal, 0.0, 0.0, 0.0)
    point = Vector3(small, small, 0.0)
    assert xyz(here.get_offset_point(there, point)) == (0.0, small, 0.0)
