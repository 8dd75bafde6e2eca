"""Slow and simple geometry, written apart from the builder, to hold the builder against."""

from __future__ import annotations

import itertools
import math
from typing import TYPE_CHECKING

from conformance.scenes.model import Leaf

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from conformance.scenes.model import Geometry, Tree, Vec3

EPS = 0.00019999999494757503
"""Retail's epsilon (01, NM-8)."""


def dot(a: Sequence[float], b: Sequence[float]) -> float:
    """Return a . b."""
    return math.fsum(x * y for x, y in zip(a, b, strict=True))


def minus(a: Sequence[float], b: Sequence[float]) -> Vec3:
    """Return a - b."""
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


def cross(a: Sequence[float], b: Sequence[float]) -> Vec3:
    """Return a x b."""
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def normal_of(corners: Sequence[Vec3]) -> Vec3:
    """Return the unit normal of a polygon, from the fan about its first corner."""
    fans = [cross(minus(b, corners[0]), minus(c, corners[0])) for b, c in itertools.pairwise(corners[1:])]
    total = [math.fsum(axis) for axis in zip(*fans, strict=True)]
    size = math.sqrt(dot(total, total))
    return (total[0] / size, total[1] / size, total[2] / size)


def distance_to_segment(point: Vec3, a: Vec3, b: Vec3) -> float:
    """Return the distance from a point to a segment."""
    along, offset = minus(b, a), minus(point, a)
    t = min(1.0, max(0.0, dot(offset, along) / dot(along, along)))
    rest = [o - t * e for o, e in zip(offset, along, strict=True)]
    return math.sqrt(dot(rest, rest))


def edge_sides(point: Vec3, corners: Sequence[Vec3], normal: Vec3) -> list[float]:
    """Return on which side of each edge a point is: not negative is inside."""
    return [
        dot(cross(normal, minus(corner, corners[k - 1])), minus(point, corners[k - 1]))
        for k, corner in enumerate(corners)
    ]


def distance_to_polygon(point: Vec3, corners: Sequence[Vec3]) -> float:
    """Return the distance from a point to a convex polygon."""
    normal = normal_of(corners)
    if min(edge_sides(point, corners, normal)) >= 0.0:
        return abs(dot(normal, minus(point, corners[0])))
    return min(distance_to_segment(point, corners[k - 1], corner) for k, corner in enumerate(corners))


def visited_leaves(tree: Tree, center: Vec3, radius: float) -> Iterator[Leaf]:
    """Yield the leaves in which retail looks for polygons that a sphere overlaps (03, BN-1 to BN-4)."""
    waiting = [tree]
    while waiting:
        node = waiting.pop()
        if isinstance(node, Leaf) and not node.polygons:
            continue
        offset = minus(node.sphere[:3], center)
        if not dot(offset, offset) - (node.sphere[3] + radius) ** 2 < EPS:
            continue
        if isinstance(node, Leaf):
            yield node
            continue
        distance, reach = dot(node.plane[:3], center) + node.plane[3], radius - EPS
        if distance >= reach:
            waiting.append(node.positive)
        elif distance <= -reach:
            waiting.append(node.negative)
        else:
            waiting += [node.negative, node.positive]


def listed_near(geometry: Geometry, center: Vec3, radius: float) -> set[int]:
    """Return the polygons that retail tests against a sphere."""
    return {i for leaf in visited_leaves(geometry.tree, center, radius) for i in leaf.polygons}


def leaf_at(tree: Tree, point: Vec3) -> Leaf:
    """Return the leaf that holds a point; a point on a plane goes to the front (03, 7)."""
    while not isinstance(tree, Leaf):
        ahead = dot(tree.plane[:3], point) + tree.plane[3] >= 0.0
        tree = tree.positive if ahead else tree.negative
    return tree


def is_solid(geometry: Geometry, point: Vec3, direction: Vec3, far_is_solid: bool) -> bool:
    """Tell by the parity of crossings along a ray whether a point is in solid matter."""
    solid = far_is_solid
    for i in range(len(geometry.polygons)):
        corners = geometry.corners(i)
        normal = normal_of(corners)
        slope = dot(normal, direction)
        if slope == 0.0:
            continue
        t = dot(normal, minus(corners[0], point)) / slope
        hit = (point[0] + t * direction[0], point[1] + t * direction[1], point[2] + t * direction[2])
        if t > 0.0 and min(edge_sides(hit, corners, normal)) >= 0.0:
            solid = not solid
    return solid
