"""The benchmark's scenes: rooms in a row, or in a square, turned so that no face is along an axis.

Along the axes a coordinate of a normal is exactly 0 or 1 and most roundings do nothing: a scene that is
turned shows rounding, and costs what real data cost.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, Final, TypeAlias

import numpy as np
import numpy.typing as npt

from conformance.candidates.engine_ops.world_cache import engine_pose, engine_shape
from conformance.scenes.bsp_builder import TreeStyle, build
from conformance.scenes.importers.cell_dump import load_folder
from conformance.scenes.model import Pose
from conformance.scenes.polygons import place
from conformance.scenes.primitives import Opening, floor, room
from conformance.scenes.rotations import multiply, round_quaternion, rows_from_quaternion
from conformance.scenes.solids import box, pillar, ramp, stairs
from engine import Cell, Obstacle, World

if TYPE_CHECKING:
    from collections.abc import Mapping
    from pathlib import Path

    from conformance.scenes.model import Geometry, Quaternion, Vec3
    from conformance.scenes.polygons import Shape

Floats: TypeAlias = npt.NDArray[np.float64]
Indices: TypeAlias = npt.NDArray[np.int64]

CELL: Final = 0x01000100
"""Id of the cell that a made-up scene is."""
SIDE: Final = 8.0
"""Of a room, metres."""
HEIGHT: Final = 6.0
"""Of a room, metres: a mover can be in the air with nothing in its reach."""
HALL: Final = 80.0
"""Side of the hall, metres."""
YAW: Final = 0.3
PITCH: Final = 0.12
TILT: Final = 0.2
"""How the geometry is turned in its own frame, radians: by the tilt about x, the pitch about y, the yaw
about z."""
LEVELLING: Final = 0.15
"""How far the cell's pose turns it back about x, radians: floors slope by the rest, and up is oblique."""
POSED: Final = 0.7
"""How far the cell's pose turns it about z, radians."""
ORIGIN: Final = (42.5, 100.25, 12.125)
"""Of the cell in its block, metres."""

GRIDS: Final[Mapping[str, tuple[int, int]]] = {"room": (2, 1), "building": (4, 4), "dungeon": (12, 12)}
"""Rooms along x and y of each scene: about 60, 500 and 5,000 polygons."""
REAL: Final = "holtburg"
"""Name of the scene of real cells, which need the fixtures."""
SCENES: Final = (*GRIDS, REAL)


@dataclass(frozen=True, slots=True, eq=False, weakref_slot=True)
class BenchScene:
    """One cell, and the world that it is alone in.

    Attributes
    ----------
    name : str
        As in tables.
    geometry : Geometry
        The cell's, in its own frame.
    pose : Pose
        Of the cell in its block.
    grid : (int, int) or None
        Rooms along x and y; None for a scene that is not made of them.
    objects : tuple of Obstacle
        In the cell.
    others : tuple of Cell
        What else is in the world; the mover never gets there.
    world : engine.World
        The compiled scene, prepared as for many queries; the cell's index is 0.
    """

    name: str
    geometry: Geometry
    pose: Pose
    grid: tuple[int, int] | None = None
    objects: tuple[Obstacle, ...] = ()
    others: tuple[Cell, ...] = ()
    world: World = field(init=False)

    def __post_init__(self) -> None:
        pose = engine_pose(self.pose.to_record())
        own = Cell(self.pose.cell, pose, engine_shape(self.geometry), self.objects)
        world = World([own, *self.others])
        world.prepare()
        object.__setattr__(self, "world", world)

    @property
    def size(self) -> int:
        """Number of polygons."""
        return len(self.geometry.polygons)

    def cells(self) -> list[dict[str, Any]]:
        """Write the scene as a CELLS block of a record."""
        pose = self.pose.to_record()
        return [{"id": self.pose.cell, "pose": pose, "geometry": self.geometry.name}]

    def rows(self) -> Floats:
        """Return the rotation of the pose: a block direction is ``local @ rows``."""
        return np.array(rows_from_quaternion(self.pose.rotation))

    def to_block(self, points: Floats) -> Floats:
        """Take points, shape (n, 3), from the cell's frame to its block's, rounded to float32."""
        return single(points @ self.rows() + np.array(self.pose.origin))

    def to_cell(self, directions: Floats) -> Floats:
        """Take directions, shape (n, 3), from the block's frame to the cell's; not rounded."""
        turned: Floats = directions @ self.rows().T
        return turned


def single(values: Floats) -> Floats:
    """Round to float32, kept as float64."""
    return np.ascontiguousarray(values.astype(np.float32).astype(np.float64))


def make_scene(name: str) -> BenchScene:
    """Make the room, the building or the dungeon."""
    columns, rows = GRIDS[name]
    return grid_scene(columns, rows, name)


def grid_scene(columns: int, rows: int, name: str) -> BenchScene:
    """Make a scene of furnished rooms, about 35 polygons in each."""
    shape = [polygon for i in range(columns) for j in range(rows) for polygon in _room(i, j, columns, rows)]
    turned = [tuple(turn(corner) for corner in polygon) for polygon in shape]
    geometry = build(name, turned, style=TreeStyle.BOTH, kind="bench")
    return BenchScene(name, geometry, bench_pose(), (columns, rows))


def hall_geometry() -> Geometry:
    """Make a floor with nothing on it."""
    turned = [tuple(turn(corner) for corner in polygon) for polygon in floor(size=(HALL, HALL), tiles=(4, 4))]
    return build("hall", turned, style=TreeStyle.BOTH, kind="bench")


def hall_scene(
    geometry: Geometry, objects: tuple[Obstacle, ...] = (), others: tuple[Cell, ...] = ()
) -> BenchScene:
    """Make a scene of `hall_geometry`, with objects in it, and other cells in its world."""
    return BenchScene(geometry.name, geometry, bench_pose(), objects=objects, others=others)


def bench_pose() -> Pose:
    """Return the pose of every made-up scene."""
    return Pose(CELL, ORIGIN, _rotation())


def real_scenes(folder: Path) -> list[BenchScene]:
    """Make a scene of each real cell that has collision geometry.

    Parameters
    ----------
    folder : Path
        Of cell dumps (`conformance.scenes.importers.cell_dump`).

    Raises
    ------
    DumpError
        If they cannot be read.
    """
    cells = load_folder(folder).cells.values()
    return [BenchScene(REAL, cell.geometry, cell.pose) for cell in cells if cell.geometry is not None]


def _room(i: int, j: int, columns: int, rows: int) -> Shape:
    """Furnish one room; doors lead to its neighbours."""
    neighbours = {"west": i > 0, "east": i < columns - 1, "south": j > 0, "north": j < rows - 1}
    doors = [Opening(side, 2.0, 3.0) for side, there in neighbours.items() if there]
    turn = 17.0 * (i + 3 * j)
    # Bottoms are left out: nothing can reach them.
    crate = place(box(size=(1.0, 1.25, 0.5 + 0.125 * ((i + j) % 4)))[1:], (2.25, 2.0, 0.0), turn)
    column = place(pillar(radius=0.4, height=2.0, sides=6)[:-2], (2.25, -2.25, 0.0), turn)
    flight = place(stairs(width=1.5, rise=0.25, run=0.4, count=2, solid=True)[:-1], (-2.5, -2.75, 0.0), turn)
    slope = place(ramp(width=1.25, run=1.5, degrees=25.0, solid=True)[:-1], (-2.5, 1.75, 0.0), turn)
    shape = room(size=(SIDE, SIDE, HEIGHT), openings=doors) + crate + column + flight + slope
    return place(shape, (SIDE * i, SIDE * j, 0.0), 0.0)


def turn(point: Vec3) -> Vec3:
    """Take a point from where rooms are laid out to the frame of the geometry."""
    x, y, z = point
    c, s = math.cos(TILT), math.sin(TILT)
    y, z = c * y - s * z, s * y + c * z
    c, s = math.cos(PITCH), math.sin(PITCH)
    x, z = c * x + s * z, c * z - s * x
    c, s = math.cos(YAW), math.sin(YAW)
    return c * x - s * y, s * x + c * y, z


def _rotation() -> Quaternion:
    """Return the quaternion of the pose: yaw and pitch back, most of the tilt back, another yaw."""
    back = multiply(_about(1, -PITCH), _about(2, -YAW))
    return round_quaternion(multiply(_about(2, POSED), multiply(_about(0, -LEVELLING), back)))


def _about(axis: int, angle: float) -> Quaternion:
    turned = [0.0, 0.0, 0.0]
    turned[axis] = math.sin(angle / 2)
    x, y, z = turned
    return math.cos(angle / 2), x, y, z
