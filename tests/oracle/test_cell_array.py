"""CELLARRAY: insertion order, no duplicates, removal from the middle."""

from __future__ import annotations

from hypothesis import given
from hypothesis import strategies as st
from oracle_worlds import ScriptedCell

from oracle.cell_array import CellArray

IDS = st.lists(st.integers(1, 6), max_size=20)


def test_a_listed_id_is_not_upgraded() -> None:
    """An id without cell stays without, even if the cell is added later."""
    array = CellArray()
    array.add_cell(1, None)
    array.add_cell(1, ScriptedCell([]))
    assert [entry.cell for entry in array.cells] == [None]


def test_the_last_entry_fills_the_hole() -> None:
    """Removal changes the order: the last entry moves into the place."""
    array = CellArray()
    for cell_id in (1, 2, 3, 4):
        array.add_cell(cell_id, None)
    array.remove_cell(1)
    assert [entry.cell_id for entry in array.cells] == [1, 4, 3]


def test_removing_the_last_entry_only_shortens() -> None:
    """There is no hole to fill at the end, and none in an empty array."""
    array = CellArray()
    array.remove_cell(0)
    array.add_cell(1, None)
    array.remove_cell(0)
    assert array.num_cells == 0


@given(ids=IDS)
def test_order_is_that_of_first_insertion(ids: list[int]) -> None:
    """Adding any ids leaves each once, in the order of its first appearance."""
    array = CellArray()
    for cell_id in ids:
        array.add_cell(cell_id, None)
    assert [entry.cell_id for entry in array.cells] == list(dict.fromkeys(ids))
