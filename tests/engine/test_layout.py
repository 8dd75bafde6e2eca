"""Offsets and structured types say the same, and the arrays that share a block agree on it."""

from __future__ import annotations

import numpy as np
import pytest

from engine import layout


def offset_of(dtype: np.dtype[np.void], name: str) -> int:
    """Return a field's offset in numbers."""
    assert dtype.fields is not None
    return int(dtype.fields[name][1]) // 8


@pytest.mark.parametrize("kind", ["STATE", "QUERY", "RESULT"])
def test_types_have_the_size_of_rows(kind: str) -> None:
    """A row viewed by name covers every number of it."""
    assert getattr(layout, f"{kind}_DTYPE").itemsize == 8 * getattr(layout, f"{kind}_SIZE")


@pytest.mark.parametrize(
    ("offset", "name"),
    [
        (layout.OI_STATE, "state"),
        (layout.CHECK_POS, "check_pos"),
        (layout.WALKABLE, "walkable"),
        (layout.CONTACT_PLANE, "contact_plane"),
        (layout.TRACE_CAPACITY, "trace_capacity"),
    ],
)
def test_constants_are_the_offsets_of_fields(offset: int, name: str) -> None:
    """What kernels write through a constant, Python reads by name."""
    assert offset_of(layout.STATE_DTYPE, name) == offset


def test_a_position_is_seventeen_numbers() -> None:
    """Cell id, quaternion, matrix, origin, behind each other."""
    assert (layout.QUATERNION, layout.MATRIX, layout.ORIGIN) == (1, 5, 14)
    assert layout.POSITION_SIZE == layout.ORIGIN + layout.VECTOR_SIZE


@pytest.mark.parametrize(
    ("dtype", "begin"),
    [
        (layout.QUERY_DTYPE, layout.Q_COLLISION_INFO),
        (layout.RESULT_DTYPE, layout.R_COLLISION_INFO),
    ],
)
def test_collision_info_is_one_block_everywhere(dtype: np.dtype[np.void], begin: int) -> None:
    """A query and a result hold COLLISIONINFO in the state's order, so that it is copied as it is."""
    names = [
        name
        for name in layout.STATE_DTYPE.names or ()
        if 0 <= offset_of(layout.STATE_DTYPE, name) - layout.COLLISION_INFO < layout.COLLISION_INFO_SIZE
    ]
    assert len(names) == 16
    for name in names:
        inside = offset_of(layout.STATE_DTYPE, name) - layout.COLLISION_INFO
        assert offset_of(dtype, name) - begin == inside
        assert dtype[name] == layout.STATE_DTYPE[name]


def test_offsets_are_numpy_integers() -> None:
    """Numba would compile each helper anew for every Python integer that it is given by name."""
    assert isinstance(layout.CHECK_POS, np.int64)
    assert isinstance(layout.NO_POLYGON, np.int64)
