"""Containment planes of convex cells: the cell BSP as a chain (document 03, 8)."""

from __future__ import annotations

from typing import TYPE_CHECKING

from conformance.floats import to_float32
from conformance.scenes.errors import SceneError
from conformance.scenes.planes import plane_of, signed_distance
from conformance.scenes.polygons import round_shape
from conformance.scenes.validate_polygons import PLANARITY

if TYPE_CHECKING:
    from conformance.scenes.model import PlaneData, Vec3
    from conformance.scenes.polygons import Shape


def box_planes(low: Vec3, high: Vec3) -> tuple[PlaneData, ...]:
    """Return the planes of an axis-parallel box, their fronts inside.

    Parameters
    ----------
    low, high : Vec3
        Smallest and largest corner, metres, in the cell's frame.

    Returns
    -------
    tuple of PlaneData
        For x, y and z: the low side, then the high side; float32.

    Raises
    ------
    SceneError
        The box is empty along an axis.
    """
    planes: list[PlaneData] = []
    for axis, (a, b) in enumerate(zip(low, high, strict=True)):
        if not a < b:
            raise SceneError("xyz"[axis], f"{a:g} to {b:g} m", "the low side below the high side")
        x, y, z = (1.0 if k == axis else 0.0 for k in range(3))
        planes.append((x, y, z, to_float32(-a) + 0.0))
        planes.append((0.0 - x, 0.0 - y, 0.0 - z, to_float32(b) + 0.0))
    return tuple(planes)


def convex_planes(shape: Shape) -> tuple[PlaneData, ...]:
    """Return the planes of a convex room's polygons, each once, their fronts inside.

    Parameters
    ----------
    shape : Shape
        Polygons that face inwards, metres, in the cell's frame; openings are allowed.

    Raises
    ------
    SceneError
        A corner is behind one of the planes: the shape is not convex, or faces outwards.
    """
    rounded = round_shape(shape)
    planes = tuple(dict.fromkeys(plane_of(corners) for corners in rounded))
    for plane in planes:
        for i, corners in enumerate(rounded):
            behind = -min(signed_distance(plane, corner) for corner in corners)
            if behind > PLANARITY:
                found = f"a corner {behind:.6g} m behind another polygon's plane"
                raise SceneError(f"polygons[{i}]", found, "a convex room that faces inwards")
    return planes
