"""Random places where movers are: near surfaces, on floors, in mid-air; new ones for every seed."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

import numpy as np

from conformance.bench.scenes import single
from conformance.scenes.planes import unit_normal
from engine.constants import FLOOR_Z

if TYPE_CHECKING:
    from numpy.random import Generator

    from conformance.bench.scenes import BenchScene, Floats, Indices
    from conformance.scenes.model import Geometry

RADIUS: Final = 0.48
"""Of a human's spheres, metres."""
TOWARDS_EDGES: Final = 0.6
"""Concentration of the weights of a polygon's corners: below 1, points lie rather near the edges."""


UPRIGHT: Final = 0.5
"""Largest cosine between up and the normal of a wall."""


class Surfaces:
    """The polygons of a geometry, ready to be pointed at.

    Attributes
    ----------
    normals : ndarray, shape (p, 3)
        Unit normals.
    corners : ndarray, shape (p, most, 3)
        Corner points, metres; those of a polygon with fewer are padded with its first.
    """

    def __init__(self, geometry: Geometry) -> None:
        shape = [geometry.corners(i) for i in range(len(geometry.polygons))]
        most = max(len(corners) for corners in shape)
        self.normals: Final = np.array([unit_normal(corners) for corners in shape])
        self.corners: Final = np.array([[*c, *[c[0]] * (most - len(c))] for c in shape])

    def facing(self, up: Floats) -> Indices:
        """Return the indices of the polygons that can be walked on, `up` being a unit vector."""
        return np.flatnonzero(self.normals @ up > FLOOR_Z)

    def walls(self, up: Floats) -> Indices:
        """Return the indices of the polygons that stand more or less upright."""
        return np.flatnonzero(np.abs(self.normals @ up) < UPRIGHT)

    def feet(self, rng: Generator, polygons: Indices, up: Floats) -> Floats:
        """Return a random point of the line between the two lowest corners of each polygon."""
        corners = self.corners[polygons]
        lowest = np.argsort(corners @ up, axis=1)[:, :2]
        pairs = np.take_along_axis(corners, lowest[:, :, np.newaxis], axis=1)
        share = rng.uniform(size=(len(polygons), 1))
        points: Floats = (1.0 - share) * pairs[:, 0] + share * pairs[:, 1]
        return points

    def points(self, rng: Generator, polygons: Indices) -> Floats:
        """Return a random point of each polygon; shape (n, 3)."""
        corners = self.corners[polygons]
        weights = rng.dirichlet(np.full(corners.shape[1], TOWARDS_EDGES), len(polygons))
        points: Floats = np.einsum("nc,ncd->nd", weights, corners)
        return points


def up_in_cell(scene: BenchScene) -> Floats:
    """Return the block's up in the frame of the cell, float32."""
    up: Floats = single(scene.to_cell(np.array([[0.0, 0.0, 1.0]])))[0]
    return up


def near_surfaces(
    surfaces: Surfaces, rng: Generator, count: int, radius: float = RADIUS
) -> tuple[Floats, Floats]:
    """Return spheres near random polygons, and unit directions more or less against them.

    Returns
    -------
    spheres : ndarray, shape (count, 4)
        Centre and radius, metres, float32, in the frame of the geometry; from well inside the polygon's
        reach to half a radius beyond it.
    directions : ndarray, shape (count, 3)
        float64.
    """
    polygons = rng.integers(len(surfaces.normals), size=count)
    normals = surfaces.normals[polygons]
    distance = radius * rng.uniform(0.4, 1.5, size=(count, 1))
    centers = surfaces.points(rng, polygons) + distance * normals
    spheres = np.column_stack([centers, np.full(count, radius)])
    directions = rng.normal(size=(count, 3)) - rng.uniform(-0.25, 1.5, size=(count, 1)) * normals
    return single(spheres), directions / np.linalg.norm(directions, axis=1, keepdims=True)


def above_floors(
    surfaces: Surfaces, rng: Generator, count: int, up: Floats, heights: tuple[float, float]
) -> Floats:
    """Return points at a random height above random polygons that can be walked on; shape (count, 3)."""
    floors = surfaces.facing(up)
    polygons = floors[rng.integers(len(floors), size=count)]
    return surfaces.points(rng, polygons) + rng.uniform(*heights, size=(count, 1)) * up


def beside_walls(
    surfaces: Surfaces, rng: Generator, count: int, up: Floats, heights: tuple[float, float]
) -> tuple[Floats, Floats]:
    """Return points within a stride's reach of a wall's foot, and directions more or less towards it.

    Returns
    -------
    points : ndarray, shape (count, 3)
        `heights` above the wall's lower edge; where a mover of `RADIUS` nearly touches the wall.
    directions : ndarray, shape (count, 3)
        Level, about of unit length.
    """
    walls = surfaces.walls(up)
    polygons = walls[rng.integers(len(walls), size=count)]
    away = surfaces.normals[polygons]
    away = away - (away @ up)[:, np.newaxis] * up
    aside = np.cross(away, up)
    distance = RADIUS + rng.uniform(0.02, 0.25, size=(count, 1))
    height = rng.uniform(*heights, size=(count, 1))
    points = surfaces.feet(rng, polygons, up) + distance * away + height * up
    turned = rng.uniform(-1.2, 1.2, size=(count, 1))
    return points, -np.cos(turned) * away + np.sin(turned) * aside
