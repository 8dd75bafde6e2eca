"""World: cells and the static objects in them, compiled once into flat arrays."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Final

import numpy as np

from engine import layout as at
from engine.constants import FIRST_INDOOR, HAS_PHYSICS_BSP, STATIC
from engine.errors import WorldError
from engine.float32 import float32_array
from engine.pose import position_row

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from engine.geometry import Shape
    from engine.kernels.types import Array, Ints
    from engine.pose import Pose


@dataclass(frozen=True, slots=True, eq=False)
class StaticObject:
    """An object with one BSP-shaped part, that does not move by itself.

    Attributes
    ----------
    shape : Shape
        The part's geometry, unscaled.
    pose : Pose
        Of the part.
    scale : float
        Uniform, greater than 0.
    state : int
        PhysicsState bits: 1 static, 4 ethereal, 0x10 ignores collisions, 0x40 missile, 0x10000 has a
        physics BSP.
    """

    shape: Shape
    pose: Pose
    scale: float = 1.0
    state: int = STATIC | HAS_PHYSICS_BSP


@dataclass(frozen=True, slots=True, eq=False)
class Cell:
    """An environment cell.

    Attributes
    ----------
    id : int
        Cell id; the low 16 bits of an indoor cell are at least 0x100.
    pose : Pose
        Where the cell's frame is.
    shape : Shape or None
        Its collision geometry and containment planes; None collides with nothing and contains every
        point.
    objects : sequence of StaticObject
        In the order in which they are tested.
    portals : sequence of int
        Ids of the neighbouring cells, in the order in which they are looked at.
    """

    id: int
    pose: Pose
    shape: Shape | None
    objects: Sequence[StaticObject] = ()
    portals: Sequence[int] = ()


class World:
    """What movers collide with; built once, read by any number of queries.

    Parameters
    ----------
    cells : sequence of Cell
        At least one, with different ids.

    Attributes
    ----------
    cell_ids : tuple of int
        A cell's index here is its index in the engine.
    shapes : tuple of Shape
        Every geometry once, in order of first use.
    floats, ints : ndarray
        The compiled arrays (`engine.layout`). Not to be changed.

    Raises
    ------
    WorldError, PoseError
        Naming the cell or object, and what is wrong with it.
    """

    def __init__(self, cells: Sequence[Cell]) -> None:
        self.cell_ids: Final = tuple(cell.id for cell in cells)
        _check_ids(self.cell_ids)
        self.shapes: Final = tuple(_unique_shapes(cells))
        self.num_objects: Final = sum(len(cell.objects) for cell in cells)
        compiled = _Compiler(cells, self.shapes)
        self.floats: Final = compiled.floats
        self.ints: Final = compiled.ints
        self._polygons: Final = compiled.polygons
        self._index: Final = {cell_id: i for i, cell_id in enumerate(self.cell_ids)}

    def cell_index(self, cell_id: int) -> int:
        """Return a cell's index, or `NO_CELL` (-1) for the id of none."""
        return self._index.get(cell_id, at.NO_CELL)

    def tree_of(self, cell: int) -> int:
        """Return the root node of a cell's tree, by the cell's index; `NO_TREE` (0) if it has none."""
        return int(self.ints[self.ints[at.WORLD_CELL_INTS] + at.CELL_INTS * cell + at.CELL_TREE])

    def objects_of(self, cell: int) -> tuple[int, int]:
        """Return the index of a cell's first object, and how many it has."""
        ints = self.ints[self.ints[at.WORLD_CELL_INTS] + at.CELL_INTS * cell :]
        return int(ints[at.CELL_OBJECTS]), int(ints[at.CELL_OBJECT_COUNT])

    def polygon(self, shape: int, polygon: int) -> int:
        """Return where the record of a shape's polygon begins in `floats`."""
        return self._polygons[shape] + int(self.shapes[shape].polygon_offsets[polygon])

    def new_row(self, trace_capacity: int = 0) -> Array:
        """Return a row of state for queries in this world, with room for a trace."""
        row = np.zeros(int(self.ints[at.WORLD_ROW]) + trace_capacity, dtype=np.float64)
        row[at.TRACE_CAPACITY] = trace_capacity
        return row

    def __repr__(self) -> str:
        return f"<World: {len(self.cell_ids)} cells, {self.num_objects} objects, {len(self.shapes)} shapes>"


def _check_ids(ids: tuple[int, ...]) -> None:
    if not ids:
        raise WorldError("world", "has no cells")
    for index, cell_id in enumerate(ids):
        if not 0 <= cell_id <= 0xFFFF_FFFF or (cell_id & 0xFFFF) < FIRST_INDOOR:
            raise WorldError(f"cell {index}", f"{cell_id:#x} is not the id of an indoor cell")
        if cell_id in ids[:index]:
            raise WorldError(f"cell {index}", f"id {cell_id:#010x} is used twice")


def _unique_shapes(cells: Sequence[Cell]) -> Iterator[Shape]:
    seen: set[int] = set()
    for cell in cells:
        for shape in (cell.shape, *(thing.shape for thing in cell.objects)):
            if shape is not None and id(shape) not in seen:
                seen.add(id(shape))
                yield shape


class _Compiler:
    """Lays out a world: all nodes, then polygons, planes, cells and objects."""

    def __init__(self, cells: Sequence[Cell], shapes: tuple[Shape, ...]) -> None:
        nodes = at.FIRST_NODE + sum(len(shape.node_ints) for shape in shapes)
        self._floats: list[Array] = [np.zeros(at.NODE_FLOATS * at.FIRST_NODE, dtype=np.float64)]
        self._ints: list[Ints] = [np.zeros(at.NODE_INTS * at.FIRST_NODE, dtype=np.int64)]
        self._num_floats = at.NODE_FLOATS * nodes
        self._num_ints = at.NODE_INTS * nodes
        self._tail_floats: list[Array] = []
        self._tail_ints: list[Ints] = []
        self.polygons: Final[list[int]] = []
        self._roots: dict[int, int] = {}
        self._planes: dict[int, tuple[int, int]] = {}
        first = at.FIRST_NODE
        for index, shape in enumerate(shapes):
            self._add_shape(index, shape, first)
            first += len(shape.node_ints)
        header = self._add_cells(cells)
        self.floats: Final = np.concatenate([*self._floats, *self._tail_floats])
        self.ints: Final = np.concatenate([*self._ints, *self._tail_ints])
        depth = max((shape.depth for shape in shapes), default=0)
        self.ints[: len(header)] = header
        self._size_rows(len(cells), sum(len(cell.objects) for cell in cells), depth)

    def _append_floats(self, values: Array) -> int:
        offset = self._num_floats
        self._tail_floats.append(values)
        self._num_floats += len(values)
        return offset

    def _append_ints(self, values: Sequence[int] | Ints) -> int:
        offset = self._num_ints
        self._tail_ints.append(np.asarray(values, dtype=np.int64))
        self._num_ints += len(values)
        return offset

    def _add_shape(self, index: int, shape: Shape, first: int) -> None:
        """Append a shape; its tree gets node numbers from `first` on."""
        polygons = shape.polygon_floats.copy()
        polygons[shape.polygon_offsets + at.POLYGON_SHAPE] = index
        base = self._append_floats(polygons)
        self.polygons.append(base)
        leaf_lists = self._append_ints(base + shape.polygon_offsets[shape.leaf_polygons])
        nodes = shape.node_ints.copy()
        interior = nodes[:, at.NODE_KIND] == at.KIND_NODE
        nodes[interior, at.NODE_POSITIVE] += first
        nodes[interior, at.NODE_NEGATIVE] += first
        nodes[~interior, at.LEAF_FIRST] += leaf_lists
        self._floats.append(shape.node_floats.ravel())
        self._ints.append(nodes.ravel())
        self._roots[id(shape)] = first
        if shape.cell_planes is None:
            self._planes[id(shape)] = (0, at.NO_PLANES)
        else:
            self._planes[id(shape)] = (self._append_floats(shape.cell_planes.ravel()), len(shape.cell_planes))

    def _add_cells(self, cells: Sequence[Cell]) -> list[int]:
        """Append all cells and objects; return the header's first five numbers."""
        index_of = {cell.id: i for i, cell in enumerate(cells)}
        cell_floats: list[Array] = []
        cell_ints: list[list[int]] = []
        object_floats: list[Array] = []
        object_ints: list[list[int]] = []
        for cell in cells:
            where = f"cell {cell.id:#010x}"
            cell_floats.append(np.append(position_row(cell.pose, f"{where}, pose"), float(cell.id)))
            cell_ints.append(self._cell_ints(cell, index_of, len(object_ints), where))
            for i, thing in enumerate(cell.objects):
                object_floats.append(_object_floats(thing, f"{where}, object {i}"))
                object_ints.append([self._roots[id(thing.shape)], thing.state])
        return [
            len(cells),
            self._append_floats(np.concatenate(cell_floats)),
            self._append_ints(np.concatenate(cell_ints)),
            self._append_floats(np.concatenate([*object_floats, np.empty(0)])),
            self._append_ints(np.array(object_ints, dtype=np.int64).ravel()),
        ]

    def _cell_ints(self, cell: Cell, index_of: dict[int, int], first_object: int, where: str) -> list[int]:
        unknown = [portal for portal in cell.portals if portal not in index_of]
        if unknown:
            raise WorldError(where, f"a portal leads to {unknown[0]:#010x}, which is not in the world")
        portals = self._append_ints([index_of[portal] for portal in cell.portals])
        root, planes = at.NO_TREE, (0, at.NO_PLANES)
        if cell.shape is not None:
            root, planes = self._roots[id(cell.shape)], self._planes[id(cell.shape)]
        return [root, *planes, portals, len(cell.portals), first_object, len(cell.objects)]

    def _size_rows(self, num_cells: int, num_objects: int, depth: int) -> None:
        """Say where in a row the stack and the lists lie.

        Every cell and every object is listed at most once; a traversal leaves at most one node on
        the stack for each level of the tree.
        """
        self.ints[at.WORLD_STACK] = at.STATE_SIZE
        self.ints[at.WORLD_CELL_LIST] = at.STATE_SIZE + depth
        self.ints[at.WORLD_ROW] = at.STATE_SIZE + depth + num_cells + num_objects


def _object_floats(thing: StaticObject, where: str) -> Array:
    scale = float32_array([thing.scale], (1,), f"{where}, scale", WorldError)
    if not scale[0] > 0.0:
        raise WorldError(f"{where}, scale", f"{thing.scale} is not greater than 0")
    if not 0 <= thing.state < 1 << 31:
        raise WorldError(f"{where}, state", f"{thing.state} is not a set of PhysicsState bits")
    return np.concatenate((position_row(thing.pose, f"{where}, pose"), scale))
