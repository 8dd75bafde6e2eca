"""Balls about polygons, by which the broad phase passes them over."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

import numpy as np
import numpy.typing as npt

from engine import layout as at
from engine.constants import UNBOUNDED

if TYPE_CHECKING:
    from collections.abc import Mapping

    from engine.compiling.storage import Storage
    from engine.kernels.types import Array, Ints

Flags = npt.NDArray[np.bool_]

_OUTSIDE: Final = 1e-3
"""How far a vertex may be outside an edge of a polygon that counts as convex, metres."""
_FLATNESS: Final = 0.5
"""Least squared length of an edge's in-plane normal, as a part of the edge's own."""


def write_plates(storage: Storage, header: Mapping[int, int]) -> dict[int, int]:
    """Write of every polygon, in the order in which leaves list them, its plane and a ball about it.

    Returns what the header says of them.
    """
    floats, ints = storage.finish(header)
    begin = min((first for first, _ in storage.leaf_lists), default=0)
    end = max((first + count for first, count in storage.leaf_lists), default=0)
    plates = np.zeros((end - begin, int(at.PLATE_SIZE)), dtype=np.float64)
    listed = np.concatenate([np.arange(f, f + n) for f, n in storage.leaf_lists] or [np.zeros(0, int)])
    records, index = np.unique(ints[listed], return_inverse=True)
    planes = floats[records[:, None] + np.arange(int(at.PLANE_SIZE))]
    plates[listed - begin] = np.hstack((planes, bounding_balls(floats, records)))[index]
    storage.align()
    return {int(at.WORLD_LEAF_BOUNDS): storage.add_floats(plates.ravel()) - int(at.PLATE_SIZE) * begin}


def bounding_balls(floats: Array, records: Ints) -> Array:
    """Return a ball about each polygon: centre and radius.

    The radius is infinite for a polygon that is degenerate, or not convex within a millimetre: what is
    inside all edges of such a one (PP-2) need not be near its vertices.

    Parameters
    ----------
    floats : ndarray
        What holds the polygons' records, with planes and edges.
    records : ndarray of int
        Where each begins.

    Returns
    -------
    ndarray of float, shape (n, 4)
    """
    balls = np.zeros((len(records), int(at.SPHERE_SIZE)), dtype=np.float64)
    balls[:, at.RADIUS] = UNBOUNDED
    counts = floats[records + at.POLYGON_COUNT].astype(np.int64)
    for count in np.unique(counts[counts > 2]):
        chosen = np.flatnonzero(counts == count)
        first = records[chosen, None] + at.POLYGON_CORNERS
        corners = _blocks(floats, first, int(at.CORNER_SIZE), int(count))[..., : at.VECTOR_SIZE]
        edges = _blocks(floats, first + at.CORNER_SIZE * count, int(at.EDGE_SIZE), int(count))
        middles = corners.mean(axis=1)
        radii = np.linalg.norm(corners - middles[:, None], axis=-1).max(axis=1)
        balls[chosen, : at.VECTOR_SIZE] = middles
        balls[chosen, at.RADIUS] = np.where(_are_convex(corners, edges), radii, UNBOUNDED)
    return balls


def _blocks(floats: Array, first: Ints, size: int, count: int) -> Array:
    """Return `count` consecutive blocks of numbers of each polygon: shape (n, count, size)."""
    blocks: Array = floats[first + np.arange(size * count)].reshape(len(first), count, size)
    return blocks


def _are_convex(corners: Array, edges: Array) -> Flags:
    """Say of polygons whether no vertex is outside an edge; NaN says no."""
    normals, squares = edges[..., at.EDGE_NORMAL : at.EDGE_NORMAL_SQUARED], edges[..., at.EDGE_NORMAL_SQUARED]
    ways = corners[:, None] - corners[:, :, None]
    inside = np.einsum("pik,pijk->pij", normals, ways) >= -_OUTSIDE * np.sqrt(squares)[..., None]
    flat = squares >= _FLATNESS * edges[..., at.EDGE_SQUARED]
    convex: Flags = inside.all(axis=(1, 2)) & flat.all(axis=1)
    return convex
