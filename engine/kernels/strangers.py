"""Rows made for another world, or changed since: the numbers in them that kernels look things up by.

Ids of cells are among them: in a list of cells, one that is not loaded is the negative of its id. All else
in a row may be any number: it makes wrong answers at most.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from engine.body_layout import B_CELL, B_NUM_RECORDS, B_NUM_SPHERE, B_POSITION, MAX_RECORDS
from engine.checks import LARGEST_ID
from engine.constants import TARGET_CELL, TARGET_ENTRY, TARGET_OBJECT, TARGET_OBJECTS
from engine.kernels.cell_array import ints_of
from engine.kernels.compile import inlined, kernel
from engine.layout import (
    CELL_TREE,
    FAMILY_PARTS,
    MAX_SPHERES,
    NO_CELL,
    NO_OBJECT,
    NO_TREE,
    OBJECT_COUNT,
    OBJECT_FAMILY,
    OBJECT_FIRST,
    OBJECT_INTS,
    PART_INTS,
    PART_TREE,
    Q_BEGIN_CELL,
    Q_END,
    Q_NUM_SPHERE,
    Q_START,
    Q_TARGET_CELL,
    Q_TARGET_KIND,
    Q_TARGET_OBJECT,
    WORLD_ALL_CELLS,
    WORLD_CELLS,
    WORLD_OBJECT_INTS,
    WORLD_OBJECTS,
    WORLD_PART_INTS,
)

if TYPE_CHECKING:
    from engine.kernels.types import Array, Ints

_LARGEST_ID = float(LARGEST_ID)


@inlined
def _is_one_of(number: float, count: int) -> bool:
    """Say whether a number is an index of so many things; NaN is none."""
    return 0.0 <= number < count


@inlined
def _is_cell(wi: Ints, number: float) -> bool:
    """Say whether a number is that of a cell, or of none: who has left the world is nowhere."""
    return number == NO_CELL or _is_one_of(number, wi[WORLD_ALL_CELLS])


@inlined
def _is_id(number: float) -> bool:
    """Say whether a number is the id of some cell: of none in the world it says where it would be."""
    return 0.0 <= number <= _LARGEST_ID


@inlined
def _object(wi: Ints, q: Array) -> int:
    """Return where the record of the object lies that a query names."""
    return wi[WORLD_OBJECT_INTS] + OBJECT_INTS * int(q[Q_TARGET_OBJECT])


@inlined
def is_strange_move(wi: Ints, q: Array) -> bool:
    """Say whether a query is nowhere, begins where its world has no cell, or has too many spheres."""
    return not (
        _is_cell(wi, q[Q_BEGIN_CELL])
        and _is_id(q[Q_START])
        and _is_id(q[Q_END])
        and 0.0 <= q[Q_NUM_SPHERE] <= MAX_SPHERES
    )


@kernel
def is_strange_collision(wi: Ints, q: Array) -> bool:
    """Say whether a single call of a tree is of one that its world doesn't have."""
    if is_strange_move(wi, q):
        return True
    if q[Q_TARGET_OBJECT] != NO_OBJECT:
        if not _is_one_of(q[Q_TARGET_OBJECT], wi[WORLD_OBJECTS]):
            return True
        thing = _object(wi, q)
        if wi[thing + OBJECT_FAMILY] != FAMILY_PARTS or wi[thing + OBJECT_COUNT] == 0:
            return True
        return wi[wi[WORLD_PART_INTS] + PART_INTS * wi[thing + OBJECT_FIRST] + PART_TREE] == NO_TREE
    if not _is_one_of(q[Q_TARGET_CELL], wi[WORLD_CELLS]):
        return True
    return wi[ints_of(wi, int(q[Q_TARGET_CELL])) + CELL_TREE] == NO_TREE


@kernel
def is_strange_meeting(wi: Ints, q: Array) -> bool:
    """Say whether a single call of an obstacle, or of a cell, is of one that its world doesn't have."""
    if is_strange_move(wi, q):
        return True
    kind = q[Q_TARGET_KIND]
    if kind in (TARGET_CELL, TARGET_ENTRY, TARGET_OBJECTS):
        return not _is_one_of(q[Q_TARGET_CELL], wi[WORLD_ALL_CELLS])
    if not _is_one_of(q[Q_TARGET_OBJECT], wi[WORLD_OBJECTS]):
        return True
    return kind != TARGET_OBJECT and wi[_object(wi, q) + OBJECT_COUNT] == 0


@kernel
def is_strange_body(wi: Ints, b: Array) -> bool:
    """Say whether a body is nowhere, or where its world has no cell, or has too many spheres or records."""
    return not (
        _is_cell(wi, b[B_CELL])
        and _is_id(b[B_POSITION])
        and 0.0 <= b[B_NUM_SPHERE] <= MAX_SPHERES
        and 0.0 <= b[B_NUM_RECORDS] <= MAX_RECORDS
    )
