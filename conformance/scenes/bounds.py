"""Bounding spheres of sets of polygons."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Sequence

    from conformance.scenes.model import SphereData
    from conformance.scenes.polygons import Corners

EMPTY_SPHERE: Final[SphereData] = (0.0, 0.0, 0.0, 0.0)
"""The sphere of a leaf without polygons; retail never gets to it (a leaf with none answers first)."""


class Bounds:
    """The corners of every polygon of a shape, ready to be bounded."""

    def __init__(self, shape: Sequence[Corners]) -> None:
        most = max((len(corners) for corners in shape), default=0)
        padded = [[*corners, *[corners[0]] * (most - len(corners))] for corners in shape]
        self._corners = np.array(padded, dtype=np.float64).reshape(len(shape), most, 3)

    def sphere(self, polygons: Sequence[int]) -> SphereData:
        """Return a float32 sphere that holds the whole of the polygons.

        Parameters
        ----------
        polygons : sequence of int
            Polygon ids.

        Returns
        -------
        SphereData
            About the middle of their bounding box, metres; the radius is rounded up, so that no corner
            is outside. `EMPTY_SPHERE` for no polygons.
        """
        if not polygons:
            return EMPTY_SPHERE
        points = self._corners[list(polygons)].reshape(-1, 3)
        middle = ((points.min(axis=0) + points.max(axis=0)) / 2.0).astype(np.float32)
        offsets = points - middle.astype(np.float64)
        squared = offsets[:, 0] ** 2 + offsets[:, 1] ** 2 + offsets[:, 2] ** 2
        radius = np.nextafter(np.float32(np.sqrt(squared.max())), np.float32(np.inf))
        x, y, z = (float(value) + 0.0 for value in middle)
        return (x, y, z, float(radius))
