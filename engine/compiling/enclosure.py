"""Trees in which bounding spheres decide nothing: no polygon is outside of one (`engine.kernels.gate`)."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

import numpy as np

from engine import layout as at
from engine.compiling.balls import blocks, planes_of
from engine.compiling.leaf_planes import listed_polygons
from engine.constants import EPS, GATE_MOST

if TYPE_CHECKING:
    from engine.geometry import Shape
    from engine.kernels.types import Array, Ints

_HALF_ULP: Final = 2.0**-24
"""What a store to float32 is off by, as a part of the number."""
_MOST_DENT: Final = 0.01
"""How far the edges of a polygon may turn the wrong way in all, radians: corners on a line are rounded."""
_ONCE_AROUND: Final = 3.0 * np.pi
"""They turn by less than this, radians, if they go around once."""
_SHARE: Final = 0.5
"""Of EPS, what of it roundings may use up."""


def gate_radius(shape: Shape) -> float:
    """Return the radius up to which spheres need no bounding spheres in a shape's tree, metres, or `NO_GATE`.

    Parameters
    ----------
    shape : Shape

    Returns
    -------
    float
        `GATE_MOST` or `NO_GATE`.
    """
    counts = shape.polygon_floats[shape.polygon_offsets + at.POLYGON_COUNT].astype(np.int64)
    if (counts < at.VECTOR_SIZE).any():
        return at.NO_GATE
    with np.errstate(all="ignore"):
        off = max((_off(shape, counts, int(count)) for count in np.unique(counts)), default=0.0)
        enclosed = off + _outside(shape, counts) <= _SHARE * EPS
    return GATE_MOST if enclosed else at.NO_GATE


def _off(shape: Shape, counts: Ints, count: int) -> float:
    """Return how much farther than r - EPS a polygon may be that is HIT, of those with so many corners.

    Of a polygon with unit normal n, corners v and in-plane normals m, and a sphere at c, let q be c projected
    on the plane. Retail finds a HIT if |dist| <= r - EPS and either q is inside all edges, or a point of one
    is not farther from q than the root of (r - EPS)**2 - dist**2. What is not exact in this:

    - the corners are not in the plane, but off it by `height`;
    - n is not of unit length, which makes dist off by less than its squared length is, times 2 r;
    - q is rounded, which is not farther from the origin than the corners, a diameter and r together; so are
      ways from q to the corners, edges and their lengths, which are not longer than the latter two;
    - m does not point quite across its edge: a point that is inside by m is outside by the angle between
      them times its distance. Of a convex polygon, a point that is outside of the edges by no more than o
      is not farther from it than o over the sine of half of the sharpest corner.

    Infinite if one of them is not convex, or has no area: NaN compares with nothing.
    """
    first = shape.polygon_offsets[counts == count]
    records = shape.polygon_floats
    corners = first[:, None] + at.POLYGON_CORNERS
    points = blocks(records, corners, int(at.CORNER_SIZE), count)
    edge = blocks(records, corners + at.CORNER_SIZE * count, int(at.EDGE_SIZE), count)
    plane = planes_of(records, first)
    normals = plane[:, None, : at.VECTOR_SIZE]
    ways = _unit(np.roll(points, -1, axis=1) - points)
    turns = _turns(ways, normals)
    around = (turns.sum(axis=1) < _ONCE_AROUND) & (np.minimum(turns, 0.0).sum(axis=1) > -_MOST_DENT)
    across = np.cross(normals, ways)
    askew = [_length(_unit(m) - across) for m in (_side_normals(records, first, count), _normals(edge))]
    sharpest = np.cos(turns / 2.0).min(axis=1)
    diameter = _length(points.max(axis=1) - points.min(axis=1))
    height = np.abs((normals * points).sum(axis=-1) + plane[:, None, at.PLANE_SIZE - 1]).max(axis=1)
    length = np.abs((normals**2).sum(axis=-1) - 1.0)[:, 0]
    rounding = _HALF_ULP * (_length(points).max(axis=1) + 8.0 * (diameter + GATE_MOST))
    beside = np.maximum(*askew).max(axis=1) * diameter * (1.0 + 1.0 / sharpest)
    off = np.where(around, height + 2.0 * length * GATE_MOST + rounding + beside, np.inf)
    return float(np.nan_to_num(off, nan=np.inf).max())


def _side_normals(records: Array, first: Ints, count: int) -> Array:
    """Return the in-plane normals of PP-2, of polygons with `count` edges, shape (n, count, 3)."""
    k = np.arange(count)
    more = at.POLYGON_CORNERS + (at.CORNER_SIZE + at.EDGE_SIZE) * count
    block = np.where(k < at.SIDES, at.POLYGON_SIDES, more + at.SIDES_SIZE * (k // at.SIDES - 1))
    places = block + k % at.SIDES + at.SIDE_NORMAL
    normals: Array = records[
        first[:, None, None] + places[:, None] + at.SIDES * np.arange(int(at.VECTOR_SIZE))
    ]
    return normals


def _turns(ways: Array, normals: Array) -> Array:
    """Return by which angle the edges turn at each corner, seen from the front."""
    before = np.roll(ways, 1, axis=1)
    turns: Array = np.arctan2((np.cross(before, ways) * normals).sum(axis=-1), (before * ways).sum(axis=-1))
    return turns


def _outside(shape: Shape, counts: Ints) -> float:
    """Return how far corners of polygons are outside of bounding spheres above them; 0 if they are not."""
    nodes, corners = _listed(shape, counts)
    parents = _parents(shape.node_ints)
    x, y, z, radii = np.ascontiguousarray(shape.node_floats[:, at.NODE_SPHERE :].T)
    most = 0.0
    while len(nodes):
        px, py, pz = corners
        gaps = np.sqrt((px - x[nodes]) ** 2 + (py - y[nodes]) ** 2 + (pz - z[nodes]) ** 2) - radii[nodes]
        most = max(most, float(gaps.max()))
        nodes = parents[nodes]
        below = nodes >= 0
        nodes, corners = nodes[below], corners[:, below]
    return most


def _listed(shape: Shape, counts: Ints) -> tuple[Ints, Array]:
    """Return in which leaf each corner is of what leaves list, and the corners' x, y and z."""
    leaves = np.flatnonzero(shape.node_ints[:, at.NODE_KIND] != at.KIND_NODE)
    owners, _, polygons = listed_polygons(shape, leaves)
    sides = counts[polygons]
    begins = shape.polygon_offsets[polygons] + at.POLYGON_CORNERS
    before = np.cumsum(sides) - sides
    number = np.arange(sides.sum()) - np.repeat(before, sides)
    at_corner = np.repeat(begins, sides) + at.CORNER_SIZE * number
    corners: Array = shape.polygon_floats[at_corner + np.arange(int(at.VECTOR_SIZE))[:, None]]
    return np.repeat(leaves[owners], sides), corners


def _parents(nodes: Ints) -> Ints:
    """Return the node above each; -1 above the root."""
    parents = np.full(len(nodes), -1)
    inner = np.flatnonzero(nodes[:, at.NODE_KIND] == at.KIND_NODE)
    for child in (at.NODE_POSITIVE, at.NODE_NEGATIVE):
        parents[nodes[inner, child]] = inner
    return parents


def _normals(edges: Array) -> Array:
    """Return the in-plane normals that edges' records hold."""
    return edges[..., at.EDGE_NORMAL : at.EDGE_NORMAL_SQUARED]


def _length(vectors: Array) -> Array:
    lengths: Array = np.sqrt((vectors * vectors).sum(axis=-1))
    return lengths


def _unit(vectors: Array) -> Array:
    return vectors / _length(vectors)[..., None]
