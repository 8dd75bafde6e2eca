"""Landblocks from levels, formulas and tables."""

from __future__ import annotations

import pytest

from conformance.floats import to_float32
from conformance.scenes.errors import SceneError
from conformance.scenes.terrain import Area, flat_heights, formula_heights, table_heights, terrain_words

ROWS = [[float(10 * i + j) for j in range(9)] for i in range(9)]


def test_level_ground() -> None:
    """Eighty-one times the float32 of one height."""
    assert flat_heights(93.85) == (to_float32(93.85),) * 81


def test_index_of_a_formula() -> None:
    """The index i counts eastwards and is the slower index; x and y are 24 m a point."""
    heights = formula_heights("10 * i + j", 0xA9B4, 0xA9B4)
    assert heights == tuple(z for row in ROWS for z in row)
    assert formula_heights("x + y / 100", 0xA9B4, 0xA9B4)[9 * 2 + 3] == to_float32(48.72)


def test_neighbours_meet() -> None:
    """In the frame of one landblock the hills of its neighbours go on."""
    text = "100 + x / 10 - y / 20"
    here, east = (formula_heights(text, block, 0xA9B4) for block in (0xA9B4, 0xAAB4))
    north = formula_heights(text, 0xA9B5, 0xA9B4)
    assert here[72:] == east[:9]
    assert here[8::9] == north[0::9]
    assert formula_heights("x", 0xA8B3, 0xA9B4)[0] == -192.0


def test_tables() -> None:
    """heights[i][j] is the record's own order; a map has the north on top."""
    record = tuple(z for row in ROWS for z in row)
    assert table_heights(ROWS, as_map=False) == record
    as_map = [[ROWS[i][j] for i in range(9)] for j in reversed(range(9))]
    assert as_map[0][0] == 8.0
    assert table_heights(as_map, as_map=True) == record


@pytest.mark.parametrize(
    ("rows", "path"), [(ROWS[:8], ""), ([*ROWS, ROWS[0]], ""), ([*ROWS[:8], ROWS[0][:8]], "[8]")]
)
def test_tables_of_another_size(rows: list[list[float]], path: str) -> None:
    """Nine by nine, or an error that says where."""
    with pytest.raises(SceneError) as caught:
        table_heights(rows, as_map=False)
    assert caught.value.path == path


def test_areas() -> None:
    """Both ends are included, later areas win, and without any there are no words."""
    words = terrain_words([Area((0, 0), (8, 8), 1), Area((2, 3), (2, 4), 16)])
    assert words[9 * 2 + 3] == words[9 * 2 + 4] == 16 << 2
    assert words.count(1 << 2) == 79
    assert terrain_words([]) == ()
