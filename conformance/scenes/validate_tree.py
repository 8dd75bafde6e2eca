"""Checks of the structure of BSP trees: retail follows child pointers without looking."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, TypeAlias

from conformance.scenes.errors import SceneError
from conformance.scenes.model import Leaf, Node
from conformance.scenes.validate_numbers import plane_errors, sphere_errors

if TYPE_CHECKING:
    from collections.abc import Iterator

    from conformance.scenes.model import Tree

_Trail: TypeAlias = "tuple[_Trail, str] | None"
"""The way from the root to a node, last turn first: paths of deep trees are only written out in errors."""


def tree_errors(tree: Tree, polygon_count: int, path: str) -> Iterator[SceneError]:
    """Yield what is wrong with the structure of a BSP tree, however deep it is.

    Parameters
    ----------
    tree : Tree
        The root.
    polygon_count : int
        How many polygons there are to refer to.
    path : str
        Of the root; children are ``.pos`` and ``.neg``.

    Yields
    ------
    SceneError
        A missing child, a node reached twice, a polygon index or leaf index that cannot be, a plane
        that is not one, a polygon that no leaf lists.
    """
    nodes: set[int] = set()
    leaves: set[int] = set()
    listed: set[int] = set()
    waiting: list[tuple[Any, _Trail]] = [(tree, None)]
    while waiting:
        node, trail = waiting.pop()
        if not isinstance(node, Node | Leaf):
            yield SceneError(_follow(path, trail), repr(node), "a node or a leaf")
            continue
        if id(node) in nodes:
            yield SceneError(_follow(path, trail), "a node that the tree already has", "each node once")
            continue
        nodes.add(id(node))
        for error in _node_errors(node, polygon_count):
            yield error.under(_follow(path, trail))
        if isinstance(node, Node):
            waiting += [(node.negative, (trail, "neg")), (node.positive, (trail, "pos"))]
            continue
        if node.index in leaves:
            yield SceneError(_follow(path, trail), f"leaf index {node.index} twice", "an index of its own")
        leaves.add(node.index)
        listed.update(node.polygons)
    for i in sorted(set(range(polygon_count)) - listed):
        yield SceneError(path, f"polygon {i} in no leaf", "every polygon in at least one leaf")


def _node_errors(node: Tree, polygon_count: int) -> Iterator[SceneError]:
    """Yield what is wrong with one node, its path relative to the node."""
    yield from sphere_errors(node.sphere, "sphere")
    for k, polygon in enumerate(node.polygons):
        if polygon not in range(polygon_count):
            yield SceneError(f"polys[{k}]", repr(polygon), f"a polygon index below {polygon_count}")
    if isinstance(node, Node):
        yield from plane_errors(node.plane, "plane")
    elif node.index < 0:
        yield SceneError("leaf", repr(node.index), "an index of at least 0")


def _follow(path: str, trail: _Trail) -> str:
    turns = []
    while trail is not None:
        trail, turn = trail
        turns.append(turn)
    return ".".join(part for part in (path, *reversed(turns)) if part)
