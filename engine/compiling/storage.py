"""A world's two arrays while they grow, and the shapes, which come first in them."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

import numpy as np

from engine import layout as at
from engine.compiling.enclosure import gate_radius
from engine.compiling.growing import Growing
from engine.compiling.leaf_planes import leaf_planes

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from engine.geometry import Shape
    from engine.kernels.types import Array, Ints


class Storage(Growing):
    """Nodes in front, and behind them whatever is appended.

    Parameters
    ----------
    shapes : sequence of Shape
        Every geometry once; its index here is its index in the world.

    Attributes
    ----------
    polygons : list of int
        Where the polygon records of each shape begin.
    leaf_lists : dict of int to (int, int)
        Where the leaves' lists of each shape, by its `id`, begin in the integers, and how long they are.
    """

    def __init__(self, shapes: Sequence[Shape]) -> None:
        nodes = int(at.FIRST_NODE) + sum(len(shape.node_ints) + int(at.GATE_NODES) for shape in shapes)
        header_nodes = int(at.FIRST_NODE)
        self._node_floats: list[Array] = [np.zeros(at.NODE_FLOATS * header_nodes, dtype=np.float64)]
        self._node_ints: list[Ints] = [np.zeros(at.NODE_INTS * header_nodes, dtype=np.int64)]
        super().__init__(int(at.NODE_FLOATS) * nodes, int(at.NODE_INTS) * nodes)
        self.polygons: Final[list[int]] = []
        self.leaf_lists: Final[dict[int, tuple[int, int]]] = {}
        self._roots: dict[int, int] = {}
        self._planes: dict[int, tuple[int, int]] = {}
        first = header_nodes
        for index, shape in enumerate(shapes):
            self._add_gate(shape)
            self._add_shape(index, shape, first + int(at.GATE_NODES))
            first += int(at.GATE_NODES) + len(shape.node_ints)

    def root_of(self, shape: Shape | None) -> int:
        """Return the root node of a shape's tree."""
        return int(at.NO_TREE) if shape is None else self._roots[id(shape)]

    def planes_of(self, shape: Shape | None) -> tuple[int, int]:
        """Return where a shape's containment planes begin, and how many they are."""
        return (0, int(at.NO_PLANES)) if shape is None else self._planes[id(shape)]

    def finish(self, header: Mapping[int, int]) -> tuple[Array, Ints]:
        """Return the arrays, with the header written."""
        floats, ints = self.behind(self._node_floats, self._node_ints)
        for place, value in header.items():
            ints[place] = value
        return floats, ints

    def _with_planes(self, shape: Shape) -> Array:
        """Append the planes of leaves; return the nodes' floats, in which leaves say where theirs are."""
        blocks, leaves, begins = leaf_planes(shape)
        self.align()
        begin = self.add_floats(blocks)
        nodes: Array = shape.node_floats.copy()
        nodes[leaves, at.LEAF_PLANES] = begin + begins
        return nodes

    def _add_gate(self, shape: Shape) -> None:
        """Append what stands before a root, in the room of two nodes."""
        floats: Array = np.zeros((at.GATE_NODES, at.NODE_FLOATS), dtype=np.float64)
        floats[at.GATE, at.GATE_RADIUS] = gate_radius(shape)
        self._node_floats.append(floats.ravel())
        self._node_ints.append(np.zeros(at.GATE_NODES * at.NODE_INTS, dtype=np.int64))

    def _add_shape(self, index: int, shape: Shape, first: int) -> None:
        """Append a shape; its tree gets node numbers from `first` on."""
        polygons = shape.polygon_floats.copy()
        polygons[shape.polygon_offsets + at.POLYGON_SHAPE] = index
        self.align()
        base = self.add_floats(polygons)
        self.polygons.append(base)
        leaf_lists = self.add_ints(base + shape.polygon_offsets[shape.leaf_polygons])
        self.leaf_lists[id(shape)] = leaf_lists, len(shape.leaf_polygons)
        self._node_floats.append(self._with_planes(shape).ravel())
        self._node_ints.append(_packed(shape.node_ints, first, leaf_lists))
        self._roots[id(shape)] = first
        if shape.cell_planes is None:
            self._planes[id(shape)] = (0, int(at.NO_PLANES))
        else:
            self._planes[id(shape)] = (self.add_floats(shape.cell_planes.ravel()), len(shape.cell_planes))


def _packed(nodes: Ints, first: int, lists: int) -> Ints:
    """Return a world's integers for the nodes of a shape.

    first : number of the shape's root; lists : where the shape's lists of polygons begin.
    """
    kind = nodes[:, at.NODE_KIND]
    solid = np.where(kind == at.KIND_SOLID_LEAF, at.SOLID_BIT, 0)
    leaf = at.LEAF_BIT | solid | nodes[:, at.LEAF_COUNT] << at.LEAF_COUNT_SHIFT
    packed = np.empty((len(nodes), int(at.NODE_INTS)), dtype=np.int64)
    packed[:, at.NODE_NEXT] = np.where(
        kind == at.KIND_NODE, nodes[:, at.NODE_NEGATIVE] + first, nodes[:, at.LEAF_FIRST] + lists
    )
    packed[:, at.NODE_LEAF] = np.where(kind == at.KIND_NODE, 0, leaf)
    return packed.ravel()
