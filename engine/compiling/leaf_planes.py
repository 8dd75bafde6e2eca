"""The planes of what leaves list, in trees with a wide one, as `engine.kernels.abreast` computes them."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from engine import layout as at

if TYPE_CHECKING:
    from engine.geometry import Shape
    from engine.kernels.types import Array, Ints


def leaf_planes(shape: Shape) -> tuple[Array, Ints, Ints]:
    """Return the planes of what a shape's leaves list, in blocks, and where those of each begin.

    There are none if no leaf is wide. A leaf's planes fill blocks of their own; what is left of the last one
    is zeros.

    Returns
    -------
    blocks : ndarray of float, shape (blocks * PLANE_SIZE * ABREAST,)
        Of each block, the x components of its normals, then y, z and d.
    leaves : ndarray of int
        The nodes that are leaves, if there is a wide one.
    begins : ndarray of int
        Of each of these.
    """
    abreast, plane = int(at.ABREAST), int(at.PLANE_SIZE)
    nodes = shape.node_ints
    leaves = np.flatnonzero(nodes[:, at.NODE_KIND] != at.KIND_NODE)
    if not (nodes[leaves, at.LEAF_COUNT] >= at.WIDE_LEAF).any():
        leaves = leaves[:0]
    sizes = abreast * -(-nodes[leaves, at.LEAF_COUNT] // abreast)
    begins = np.cumsum(sizes) - sizes
    owners, within, listed = listed_polygons(shape, leaves)
    planes = np.zeros((int(sizes.sum()), plane), dtype=np.float64)
    planes[begins[owners] + within] = shape.polygon_floats[
        shape.polygon_offsets[listed, None] + np.arange(plane)
    ]
    blocks: Array = planes.reshape(-1, abreast, plane).transpose(0, 2, 1).ravel()
    return blocks, leaves, plane * begins


def listed_polygons(shape: Shape, leaves: Ints) -> tuple[Ints, Ints, Ints]:
    """Return what leaves list, one leaf after the other.

    Returns
    -------
    owners : ndarray of int
        Of each entry, which of the leaves it is of.
    within : ndarray of int
        Its place in that leaf's list.
    polygons : ndarray of int
        The polygon there.
    """
    counts, firsts = shape.node_ints[leaves, at.LEAF_COUNT], shape.node_ints[leaves, at.LEAF_FIRST]
    owners = np.repeat(np.arange(len(leaves)), counts)
    within = np.arange(counts.sum()) - (np.cumsum(counts) - counts)[owners]
    return owners, within, shape.leaf_polygons[firsts[owners] + within]
