"""Registration: which cells objects reach (08, 9)."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

import numpy as np

from engine import layout as at
from engine.constants import DUMMY_RADIUS, HAS_PHYSICS_BSP
from engine.errors import WorldError
from engine.float32 import float32_array
from engine.kernels.reach import REACH_BOX, REACH_FLAT, REACH_SIZE, REACH_SPHERE
from engine.kernels.registration import find_ball_cell_list, find_bbox_cell_list
from engine.pose import position_rows

if TYPE_CHECKING:
    from collections.abc import Sequence

    from engine.geometry import Shape
    from engine.kernels.types import Array
    from engine.objects import Obstacle, Part
    from engine.pose import Pose
    from engine.world import World

MAX_CYLSPHERES: Final = 10
"""How many of an object's cylspheres are looked at (09, 5.4)."""
_DUMMY_SPHERE: Final = (0.0, 0.0, DUMMY_RADIUS, DUMMY_RADIUS)
"""Stands for a sorting sphere that an object does not have (08, 9.2)."""
_NO_SPHERE: Final = np.array((0.0, 0.0, 0.0, -1.0))
"""Stands for the bounding sphere of a part that has none (`engine.kernels.registration.REACH_SPHERE`)."""


class Registrar:
    """Finds the cells of objects in a world.

    Parameters
    ----------
    world : World
        Its cells, landblocks and buildings; its own objects do not matter.
    objects : sequence of Obstacle

    Raises
    ------
    WorldError, PoseError
        Naming the object, or the portal, that keeps it from being registered.
    """

    def __init__(self, world: World, objects: Sequence[Obstacle]) -> None:
        self._world: Final = world
        self._objects: Final = objects
        self._row: Array = world.new_row()
        _check_cells(objects)
        self._positions: Final = position_rows(
            [thing.pose for thing in objects], [f"object {i}, pose" for i in range(len(objects))]
        ).ravel()
        self._balls: Final = _Balls(objects)
        self._parts: Final = _Parts(objects)
        if any(thing.parts for thing in objects):
            _check_portals(world)

    @property
    def added_outside(self) -> bool:
        """Whether land cells were looked for, for the last object."""
        return bool(self._row[at.ADDED_OUTSIDE])

    def cells_reached(self, index: int, *, static: bool) -> list[int]:
        """Return the cells that an object reaches: their indices, or minus their ids if not in the world.

        Parameters
        ----------
        index : int
            Which of the objects.
        static : bool
            It never moves: an environment cell's object is then found only in what is visible from there.

        Notes
        -----
        retail: CPhysicsObj::calc_cross_cells_static 0x00515160, calc_cross_cells 0x00515230, 08 9.1-2
        """
        thing = self._objects[index]
        self._row[at.DO_NOT_LOAD_CELLS] = static
        by_parts = thing.state & HAS_PHYSICS_BSP or (static and not _cylspheres(thing))
        if by_parts:
            self._list_by_parts(index)
        else:
            world, position = self._world, index * int(at.POSITION_SIZE)
            balls = self._balls.of(index)
            find_ball_cell_list(
                world.floats, world.ints, self._row, self._positions, position, *balls, self._balls.scratch
            )
        first = int(self._world.ints[at.WORLD_CELL_LIST])
        listed: list[float] = self._row[first : first + int(self._row[at.NUM_CELLS])].tolist()
        return [int(cell) for cell in listed]

    def _list_by_parts(self, index: int) -> None:
        """List the cells that an object's parts reach; the row grows with the land that they cover."""
        world, thing = self._world, self._objects[index]
        home = float(thing.pose.cell)
        while lacking := find_bbox_cell_list(
            world.floats, world.ints, self._row, home, bool(thing.has_part_array), *self._parts.of(index)
        ):
            self._row = np.concatenate((self._row, np.zeros(lacking)))


def _cylspheres(thing: Obstacle) -> Sequence[Sequence[float]]:
    return thing.cylspheres[:MAX_CYLSPHERES] if thing.has_part_array else ()


class _Balls:
    """The spheres by which objects are registered, each in its object's frame, unscaled.

    Attributes
    ----------
    scratch : ndarray
        Room for those of one object.
    """

    def __init__(self, objects: Sequence[Obstacle]) -> None:
        self.scratch: Final = np.zeros(MAX_CYLSPHERES * int(at.SPHERE_SIZE))
        lists = [_balls_of(thing) for thing in objects]
        self._counts: Final = [len(balls) for balls in lists]
        self._firsts: Final = (np.cumsum([0, *self._counts]) * at.SPHERE_SIZE).tolist()
        try:
            self._numbers: Final = float32_array(
                [ball for balls in lists for ball in balls], (-1, int(at.SPHERE_SIZE)), "", WorldError
            ).ravel()
        except WorldError:
            for index, balls in enumerate(lists):
                float32_array(balls, (-1, int(at.SPHERE_SIZE)), f"object {index}, spheres", WorldError)
            raise

    def of(self, index: int) -> tuple[Array, int, int]:
        """Return where an object's spheres are: array, offset of the first, number."""
        return self._numbers, self._firsts[index], self._counts[index]


def _balls_of(thing: Obstacle) -> Sequence[Sequence[float]]:
    """Return the spheres about an object's cylspheres, or its sorting sphere (08, 9.2)."""
    cylspheres = _cylspheres(thing)
    if cylspheres:
        return [values[: int(at.SPHERE_SIZE)] for values in cylspheres]
    if thing.sorting_sphere is None or not thing.has_part_array:
        return (_DUMMY_SPHERE,)
    return (thing.sorting_sphere,)


class _Parts:
    """The parts of objects that have geometry, as `engine.kernels.reach` reads them."""

    def __init__(self, objects: Sequence[Obstacle]) -> None:
        lists = [_parts_of(thing) for thing in objects]
        self._counts: Final = [len(parts) for parts in lists]
        self._firsts: Final = (np.cumsum([0, *self._counts]) * REACH_SIZE).tolist()
        placed = [
            (thing.pose if part.pose is None else part.pose, part, index)
            for index, (thing, parts) in enumerate(zip(objects, lists, strict=True))
            for part in parts
        ]
        poses: list[Pose] = [pose for pose, _, _ in placed]
        records = np.zeros((len(placed), int(REACH_SIZE)), dtype=np.float64)
        records[:, : at.POSITION_SIZE] = position_rows(poses, [f"object {i}, part" for _, _, i in placed])
        for record, (_, part, index) in zip(records, placed, strict=True):
            if part.shape is not None:
                record[REACH_SPHERE:REACH_BOX] = _bounding_sphere(part, part.shape, f"object {index}, part")
                record[REACH_BOX:REACH_FLAT] = part.shape.bounds
                record[REACH_FLAT] = part.always_flat
        self._numbers: Final = records.ravel()

    def of(self, index: int) -> tuple[Array, int, int]:
        """Return where an object's parts are: array, offset of the first, number."""
        return self._numbers, self._firsts[index], self._counts[index]


def _bounding_sphere(part: Part, shape: Shape, where: str) -> Array:
    """Return what bounds a part: its tree's sphere, its drawing sphere, or a negative radius (09, 4.3.1)."""
    if part.has_physics:
        sphere: Array = shape.node_floats[0, at.NODE_SPHERE :]
        return sphere
    if part.drawing_sphere is None:
        return _NO_SPHERE
    return float32_array(part.drawing_sphere, (int(at.SPHERE_SIZE),), f"{where}, drawing sphere", WorldError)


def _parts_of(thing: Obstacle) -> list[Part]:
    return [part for part in thing.parts if part.shape is not None] if thing.has_part_array else []


def _check_cells(objects: Sequence[Obstacle]) -> None:
    """See that minus the id of an object's cell, which stands for one that is not loaded, is no index."""
    for index, thing in enumerate(objects):
        if thing.pose.cell == 0:
            raise WorldError(f"object {index}, pose", "cell id 0 is not the id of a cell")


def _check_portals(world: World) -> None:
    """See that every portal has a plane: parts look at all of them, spheres only at some (09, 4)."""
    ints = world.ints
    for cell in range(int(ints[at.WORLD_CELLS])):
        record = int(ints[at.WORLD_CELL_INTS] + at.CELL_INTS * cell)
        portals, count = ints[record + at.CELL_PORTALS], max(int(ints[record + at.CELL_PORTAL_COUNT]), 0)
        planes = ints[portals + at.PORTAL_PLANE : portals + at.PORTAL_INTS * count : at.PORTAL_INTS]
        for portal in np.flatnonzero(planes == 0):
            where = f"cell {world.cell_ids[cell]:#010x}, portal {portal}"
            raise WorldError(where, "its polygon is needed to register objects by their parts")
