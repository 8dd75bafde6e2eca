"""Collision geometry: a tree of polygons, checked and flattened once (02, 03)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Final, TypeAlias

import numpy as np

from engine.checks import LARGEST_INDEX, flag, record, sequence, several, told, whole
from engine.compiling.balls import bounding_balls
from engine.errors import GeometryError
from engine.float32 import float32_array
from engine.kernels.polygon import polygon_make_plane
from engine.kernels.polygon_record import polygon_make_edges
from engine.layout import (
    CORNER_SIZE,
    EDGE_SIZE,
    KIND_LEAF,
    KIND_NODE,
    KIND_SOLID_LEAF,
    NODE_FLOATS,
    NODE_NEGATIVE,
    NODE_POSITIVE,
    NODE_SPHERE,
    POLYGON_ALIGNMENT,
    POLYGON_CONVEX,
    POLYGON_CORNERS,
    POLYGON_COUNT,
    POLYGON_ID,
    RADIUS,
    SHAPE_NODE_INTS,
    SIDES,
    SIDES_SIZE,
    VECTOR_SIZE,
)

if TYPE_CHECKING:
    from collections.abc import Sequence

    import numpy.typing as npt

    from engine.kernels.types import Array, Ints


@dataclass(frozen=True, slots=True, eq=False)
class Leaf:
    """A leaf of a BSP tree.

    Attributes
    ----------
    sphere : sequence of float
        Bounding sphere: centre x, y, z and radius, metres.
    polygons : sequence of int
        Indices of the polygons tested here, in this order.
    solid : bool
        Whether the leaf is inside solid matter; counts only if it has polygons.
    """

    sphere: Sequence[float]
    polygons: Sequence[int] = ()
    solid: bool = False


@dataclass(frozen=True, slots=True, eq=False)
class Node:
    """An interior node of a BSP tree.

    Attributes
    ----------
    plane : sequence of float
        Splitting plane: normal x, y, z and d, with n . p + d = 0.
    sphere : sequence of float
        Bounding sphere: centre x, y, z and radius, metres.
    positive, negative : Node or Leaf
        The children in front of and behind the plane; a portal node of the data files is a Node too.
    """

    plane: Sequence[float]
    sphere: Sequence[float]
    positive: Tree
    negative: Tree


Tree: TypeAlias = Node | Leaf

_WHOLE: Final = whole(-LARGEST_INDEX, LARGEST_INDEX)
_CHECK_LEAF: Final = record(Leaf, polygons=several(_WHOLE), solid=flag)

_NO_PLANE: Final = (0.0, 0.0, 0.0, 0.0)


class Shape:
    """The collision geometry of a cell or of an object's part, in its own frame; shared by identity.

    Polygons are one-sided, convex, counter-clockwise from their front. Degenerate ones (no area, or
    fewer than three vertices) are kept, as retail keeps them: their plane is NaN. Numbers are rounded
    to float32.

    Parameters
    ----------
    vertices : array_like of shape (n, 3)
        Metres.
    polygons : sequence of sequences of int
        Vertex indices of each polygon.
    tree : Node or Leaf
        The physics BSP. Every polygon has to be in a leaf.
    cell_planes : array_like of shape (m, 4), optional
        The cell BSP as a chain of containment planes, outermost first. Without it a cell contains
        every point.
    name : str, optional
        What errors and results call it.

    Attributes
    ----------
    bounds : ndarray of float, shape (6,)
        Least and greatest x, y, z of all vertices, metres; zeros without vertices.

    Raises
    ------
    GeometryError
        Naming the vertex, polygon or node, and what is wrong with it.
    """

    def __init__(
        self,
        vertices: npt.ArrayLike,
        polygons: Sequence[Sequence[int]],
        tree: Tree,
        cell_planes: npt.ArrayLike | None = None,
        *,
        name: str = "shape",
    ) -> None:
        self.name: Final = name
        points = float32_array(vertices, (-1, 3), f"{name}, vertices", GeometryError)
        self.bounds: Final[Array] = (
            np.concatenate((points.min(axis=0), points.max(axis=0))) if len(points) else np.zeros(6)
        )
        self.polygon_offsets, self.polygon_floats = _flatten_polygons(points, polygons, name)
        flat = _FlatTree(tree, len(polygons), name)
        self.node_floats: Final[Array] = flat.floats
        self.node_ints: Final[Ints] = flat.ints
        self.leaf_polygons: Final[Ints] = flat.polygons
        self.depth: Final = flat.depth
        self.cell_planes: Final = (
            None
            if cell_planes is None
            else float32_array(cell_planes, (-1, 4), f"{name}, cell planes", GeometryError)
        )

    @property
    def num_polygons(self) -> int:
        """Number of polygons."""
        return len(self.polygon_offsets)

    def __repr__(self) -> str:
        return f"<Shape {self.name!r}: {self.num_polygons} polygons, {len(self.node_ints)} nodes>"


def _flatten_polygons(points: Array, polygons: Sequence[Sequence[int]], name: str) -> tuple[Ints, Array]:
    """Lay polygon records behind each other, with their planes; return their offsets and the floats."""
    several(sequence)(polygons, f"{name}, polygons", GeometryError)
    sizes = [_record_size(len(polygon)) for polygon in polygons]
    offsets = np.concatenate(([0], np.cumsum(sizes, dtype=np.int64)))
    floats = np.zeros(offsets[-1], dtype=np.float64)
    for index, polygon in enumerate(polygons):
        at = int(offsets[index])
        for vertex in polygon:
            _WHOLE(vertex, f"{name}, polygon {index}", GeometryError)
            if not 0 <= vertex < len(points):
                raise GeometryError(
                    f"{name}, polygon {index}", f"vertex {vertex} does not exist ({len(points)} vertices)"
                )
        floats[at + POLYGON_COUNT] = len(polygon)
        floats[at + POLYGON_ID] = index
        corners = floats[at + POLYGON_CORNERS :][: CORNER_SIZE * len(polygon)].reshape(-1, CORNER_SIZE)
        corners[:, :VECTOR_SIZE] = points[list(polygon)]
        polygon_make_plane(floats, at)
        polygon_make_edges(floats, at)
    begins = offsets[:-1].astype(np.int64)
    floats[begins + POLYGON_CONVEX] = np.isfinite(bounding_balls(floats, begins)[:, RADIUS])
    return begins, floats


def _record_size(num_vertices: int) -> int:
    """Return the length of a polygon's record."""
    more_sides = SIDES_SIZE * (max(num_vertices - 1, 0) // SIDES)
    size = POLYGON_CORNERS + (CORNER_SIZE + EDGE_SIZE) * num_vertices + more_sides
    return int(size + -size % POLYGON_ALIGNMENT)


class _FlatTree:
    """A tree in traversal order: node, positive subtree, negative subtree.

    Children are node numbers within the tree; a leaf's list begins at an index into `polygons`.
    """

    def __init__(self, root: Tree, num_polygons: int, name: str) -> None:
        self.depth = 0
        self._name = name
        self._num_polygons = num_polygons
        self._floats: list[Array] = []
        self._ints: list[list[int]] = []
        self._lists: list[int] = []
        self._collect(root)
        self._check_all_used()
        self.floats: Final = np.array(self._floats, dtype=np.float64).reshape(-1, NODE_FLOATS)
        self.ints: Final = np.array(self._ints, dtype=np.int64).reshape(-1, SHAPE_NODE_INTS)
        self.polygons: Final = np.array(self._lists, dtype=np.int64)

    def _collect(self, root: Tree) -> None:
        """Walk the tree without recursion, so that it may be of any depth."""
        seen: set[int] = set()
        stack: list[tuple[Tree, int, int, int]] = [(root, 1, -1, NODE_POSITIVE)]
        while stack:
            node, depth, parent, side = stack.pop()
            number = len(self._ints)
            where = f"{self._name}, node {number}"
            if parent >= 0:
                where += f" ({'positive' if side == NODE_POSITIVE else 'negative'} child of node {parent})"
                self._ints[parent][side] = number
            self.depth = max(self.depth, depth)
            if isinstance(node, Leaf):
                self._add_leaf(node, where)
                continue
            if not isinstance(node, Node):
                raise GeometryError(
                    where, f"not a Node or Leaf but {told(node)}: every node has both children"
                )
            if id(node) in seen:
                raise GeometryError(where, "the node is its own ancestor, or used twice")
            seen.add(id(node))
            self._add_record(node.plane, node.sphere, where)
            self._ints.append([KIND_NODE, 0, 0, 0])
            stack.append((node.negative, depth + 1, number, NODE_NEGATIVE))
            stack.append((node.positive, depth + 1, number, NODE_POSITIVE))

    def _add_record(self, plane: Sequence[float], sphere: Sequence[float], where: str) -> None:
        record = np.empty(NODE_FLOATS, dtype=np.float64)
        record[:NODE_SPHERE] = float32_array(plane, (4,), f"{where}, plane", GeometryError)
        record[NODE_SPHERE:] = float32_array(sphere, (4,), f"{where}, sphere", GeometryError)
        self._floats.append(record)

    def _add_leaf(self, leaf: Leaf, where: str) -> None:
        _CHECK_LEAF(leaf, where, GeometryError)
        self._add_record(_NO_PLANE, leaf.sphere, where)
        for polygon in leaf.polygons:
            if not 0 <= polygon < self._num_polygons:
                raise GeometryError(
                    where, f"polygon {polygon} does not exist ({self._num_polygons} polygons)"
                )
        kind = KIND_SOLID_LEAF if leaf.solid else KIND_LEAF
        self._ints.append([kind, len(self._lists), len(leaf.polygons), 0])
        self._lists.extend(leaf.polygons)

    def _check_all_used(self) -> None:
        unused = sorted(set(range(self._num_polygons)) - set(self._lists))
        if unused:
            raise GeometryError(f"{self._name}, polygon {unused[0]}", "in no leaf, so nothing can touch it")
