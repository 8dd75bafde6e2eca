"""Checks of scenes at the boundary: what is behind it is valid.

Each ``*_errors`` function yields everything that is wrong, so that an author sees it all at once; each
``check_*`` function raises the first of it. `path` names the thing that is checked.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Final

from conformance.scenes.errors import SceneError, join_path
from conformance.scenes.validate_numbers import number_errors, plane_errors, show
from conformance.scenes.validate_polygons import polygon_errors, shape_errors
from conformance.scenes.validate_tree import tree_errors
from oracle.constants import EPS5

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Sequence

    from conformance.scenes.model import Cell, Geometry, Pose, Quaternion, Scene, Tree, Vec3

__all__ = [
    "check",
    "check_geometry",
    "check_pose",
    "check_rotation",
    "check_scene",
    "check_shape",
    "check_tree",
    "geometry_errors",
    "polygon_errors",
    "pose_errors",
    "rotation_errors",
    "scene_errors",
    "shape_errors",
    "tree_errors",
]

SIDES_TYPES: Final = range(3)
"""Values of a polygon's sides (02, 0.1)."""
CELL_IDS: Final = range(1, 1 << 32)


def check(errors: Iterable[SceneError]) -> None:
    """Raise the first of some errors, if there is one."""
    for error in errors:
        raise error


def check_shape(shape: Sequence[Sequence[Vec3]], path: str) -> None:
    """Raise the first error of a shape."""
    check(shape_errors(shape, path))


def check_rotation(rotation: Quaternion, path: str) -> None:
    """Raise the first error of a rotation."""
    check(rotation_errors(rotation, path))


def check_pose(pose: Pose, path: str) -> None:
    """Raise the first error of a pose."""
    check(pose_errors(pose, path))


def check_tree(tree: Tree, polygon_count: int, path: str) -> None:
    """Raise the first error of a tree."""
    check(tree_errors(tree, polygon_count, path))


def check_geometry(geometry: Geometry, path: str) -> None:
    """Raise the first error of a geometry."""
    check(geometry_errors(geometry, path))


def check_scene(scene: Scene) -> None:
    """Raise the first error of a scene."""
    check(scene_errors(scene))


def rotation_errors(rotation: Quaternion, path: str) -> Iterator[SceneError]:
    """Yield what retail would refuse in a rotation (retail: Frame::IsValid, 01 4.3).

    Parameters
    ----------
    rotation : Quaternion
        ``w, x, y, z``; its squared length may be off 1 by EPS * 5.
    path : str
        Of the rotation.
    """
    w, x, y, z = rotation
    squared = ((z * z + y * y) + x * x) + w * w
    if not abs(squared - 1.0) <= EPS5:
        yield SceneError(path, f"{show(rotation)} of squared length {squared:.9g}", f"1 within {EPS5:g}")


def pose_errors(pose: Pose, path: str) -> Iterator[SceneError]:
    """Yield what is wrong with a pose."""
    if pose.cell not in CELL_IDS:
        yield SceneError(join_path(path, "cell"), repr(pose.cell), "a cell id, 1 to 0xFFFFFFFF")
    yield from number_errors(pose.origin, join_path(path, "origin"))
    yield from rotation_errors(pose.rotation, join_path(path, "rotation"))


def geometry_errors(geometry: Geometry, path: str) -> Iterator[SceneError]:
    """Yield what is wrong with a geometry: vertices, polygons, tree, cell planes."""
    vertices = geometry.vertices
    for i, vertex in enumerate(vertices):
        yield from number_errors(vertex, join_path(path, f"vertices[{i}]"))
    for i, polygon in enumerate(geometry.polygons):
        here = join_path(path, f"polygons[{i}]")
        wrong = [index for index in polygon.vertices if index not in range(len(vertices))]
        if wrong:
            yield SceneError(here, f"vertex {wrong[0]}", f"a vertex index below {len(vertices)}")
        else:
            yield from polygon_errors([vertices[index] for index in polygon.vertices], here)
        if polygon.sides not in SIDES_TYPES:
            yield SceneError(join_path(here, "sides"), repr(polygon.sides), "0, 1 or 2")
    yield from tree_errors(geometry.tree, len(geometry.polygons), join_path(path, "bsp"))
    for i, plane in enumerate(geometry.cell_planes or ()):
        yield from plane_errors(plane, join_path(path, f"cell_bsp[{i}]"))


def scene_errors(scene: Scene) -> Iterator[SceneError]:
    """Yield what is wrong with a scene; a geometry is reported where it is used first."""
    if not scene.cells:
        yield SceneError("cells", "no cell", "at least one cell")
    ids: set[int] = set()
    seen: set[int] = set()
    for i, cell in enumerate(scene.cells):
        if cell.id in ids:
            yield SceneError(f"cells[{i}].id", f"{cell.id:#010x} twice", "a cell id of its own")
        ids.add(cell.id)
        yield from _placing_errors(cell, f"cells[{i}]")
        for geometry, path in _geometries(cell, f"cells[{i}]"):
            if id(geometry) not in seen:
                seen.add(id(geometry))
                yield from geometry_errors(geometry, path)


def _placing_errors(cell: Cell, path: str) -> Iterator[SceneError]:
    """Yield what is wrong with the poses and scales in a cell."""
    yield from pose_errors(cell.pose, f"{path}.pose")
    for k, static in enumerate(cell.statics):
        yield from pose_errors(static.pose, f"{path}.statics[{k}].pose")
        if not 0.0 < static.scale < math.inf:
            found = f"{static.scale!r} in cell {cell.id:#010x}"
            yield SceneError(f"{path}.statics[{k}].scale", found, "a finite scale greater than 0")


def _geometries(cell: Cell, path: str) -> Iterator[tuple[Geometry, str]]:
    """Yield the geometries of a cell and where they are."""
    if cell.geometry is not None:
        yield cell.geometry, f"{path}.geometry"
    for k, static in enumerate(cell.statics):
        yield static.geometry, f"{path}.statics[{k}].geometry"
