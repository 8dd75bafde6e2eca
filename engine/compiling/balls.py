"""Balls about polygons, by which the broad phase passes them over."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

import numpy as np
import numpy.typing as npt

from engine import layout as at
from engine.constants import BOUND_MOST, UNBOUNDED

if TYPE_CHECKING:
    from collections.abc import Mapping

    from engine.compiling.storage import Storage
    from engine.kernels.types import Array, Ints

Flags = npt.NDArray[np.bool_]

_OFF: Final = 1e-3
"""How far a vertex may be outside an edge, or off the plane, of a polygon that has a ball, metres."""
_FLATNESS: Final = 0.5
"""Least squared length of an edge's in-plane normal, as a part of the edge's own."""
_FATNESS: Final = 1e-5
"""Least area for each edge, as a part of the ball's squared radius."""


def write_plates(storage: Storage, header: Mapping[int, int]) -> dict[int, int]:
    """Write of every polygon, in the order in which leaves list them, its plane and a ball about it.

    Returns what the header says of them.
    """
    floats, ints = storage.finish(header)
    lists = storage.leaf_lists.values()
    begin = min((first for first, _ in lists), default=0)
    end = max((first + count for first, count in lists), default=0)
    plates = np.zeros((end - begin, int(at.PLATE_SIZE)), dtype=np.float64)
    listed = np.concatenate([np.arange(f, f + n) for f, n in lists] or [np.zeros(0, int)])
    records, index = np.unique(ints[listed], return_inverse=True)
    plates[listed - begin] = np.hstack((planes_of(floats, records), bounding_balls(floats, records)))[index]
    storage.align()
    return {int(at.WORLD_LEAF_BOUNDS): storage.add_floats(plates.ravel()) - int(at.PLATE_SIZE) * begin}


def bounding_balls(floats: Array, records: Ints) -> Array:
    """Return a ball about each polygon: centre and radius.

    Outside the ball, enlarged by a sphere's radius, retail finds no touch (02, PP-2 and the table of PH-4).
    Where that is not certain the radius is infinite:

    - without a plane, which is NaN or infinite, every point may be found inside all edges;
    - of a polygon that is not convex, what is outside one edge may be near another;
    - the point that edges are compared with is in the plane: of a vertex at a height h off it the distance is
      wrong by h, and on a slanting edge a point passes that is up to 3 h beyond its end;
    - a point in line with a needle is inside all edges, but for what their in-plane normals are rounded by:
      2**-24 of its distance. Seen from a point outside of it, any other polygon is wider than all its edges
      are wrong by; since they go to and fro there, the point is outside one that goes fro;
    - far from the origin float32 is coarser than the slack that all this has.

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
    planes = planes_of(floats, records)
    counts = floats[records + at.POLYGON_COUNT].astype(np.int64)
    for count in np.unique(counts[counts > 2]):
        chosen = np.flatnonzero(counts == count)
        first = records[chosen, None] + at.POLYGON_CORNERS
        corners = blocks(floats, first, int(at.CORNER_SIZE), int(count))
        edges = blocks(floats, first + at.CORNER_SIZE * count, int(at.EDGE_SIZE), int(count))
        middles = corners.mean(axis=1)
        radii = np.linalg.norm(corners - middles[:, None], axis=-1).max(axis=1)
        balls[chosen, : at.VECTOR_SIZE] = middles
        with np.errstate(invalid="ignore"):
            bounded = (
                _are_convex(corners, edges)
                & _are_flat(corners, planes[chosen])
                & _are_fat(corners - middles[:, None], radii)
                & (np.abs(corners).max(axis=(1, 2)) <= BOUND_MOST)
            )
        balls[chosen, at.RADIUS] = np.where(bounded, radii, UNBOUNDED)
    return balls


def planes_of(floats: Array, records: Ints) -> Array:
    """Return the plane of each polygon; NaN, which is beyond nothing, for one that is not finite.

    Next to no area makes a normal that is infinite in part. Its distance from a point is infinite or
    NaN, and says nothing about that from another point beside it.
    """
    planes: Array = floats[records[:, None] + np.arange(int(at.PLANE_SIZE))]
    planes[~np.isfinite(planes).all(axis=1)] = np.nan
    return planes


def blocks(floats: Array, first: Ints, size: int, count: int) -> Array:
    """Return `count` consecutive blocks of numbers of each polygon: shape (n, count, size)."""
    found: Array = floats[first + np.arange(size * count)].reshape(len(first), count, size)
    return found


def _are_convex(corners: Array, edges: Array) -> Flags:
    """Say of polygons whether no vertex is outside an edge; NaN says no."""
    normals, squares = edges[..., at.EDGE_NORMAL : at.EDGE_NORMAL_SQUARED], edges[..., at.EDGE_NORMAL_SQUARED]
    ways = corners[:, None] - corners[:, :, None]
    inside = np.einsum("pik,pijk->pij", normals, ways) >= -_OFF * np.sqrt(squares)[..., None]
    flat = squares >= _FLATNESS * edges[..., at.EDGE_SQUARED]
    convex: Flags = inside.all(axis=(1, 2)) & flat.all(axis=1)
    return convex


def _are_flat(corners: Array, planes: Array) -> Flags:
    """Say of polygons whether all vertices are near the plane."""
    heights = np.einsum("pkc,pc->pk", corners, planes[:, : at.VECTOR_SIZE]) + planes[:, at.VECTOR_SIZE :]
    flat: Flags = (np.abs(heights) <= _OFF).all(axis=1)
    return flat


def _are_fat(ways: Array, radii: Array) -> Flags:
    """Say of polygons, by the ways from their middles to their corners, whether they are no needles."""
    areas = 0.5 * np.linalg.norm(np.cross(ways, np.roll(ways, -1, axis=1)).sum(axis=1), axis=-1)
    fat: Flags = areas >= _FATNESS * ways.shape[1] * radii**2
    return fat
