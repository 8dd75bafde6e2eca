"""Bounds that tell what is out of a mover's reach: of objects, of houses, of what is behind portals.

They are computed in float64 from the compiled numbers, and enlarged by what rounding may add
(`engine.kernels.broad` derives how much): a bound that is too large costs time, never bits.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

import numpy as np

from engine import layout as at
from engine.constants import BLOCK_EDGE, BOUND_MOST, BOUND_ROUNDING, BOUND_TILT, EPS, UNBOUNDED

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from engine.cells import Cell
    from engine.compiling.storage import Storage
    from engine.geometry import Shape
    from engine.kernels.types import Array, Ints

_NOTHING: Final = -1.0
"""Radius of the ball about nothing."""
_NEAR: Final = float(np.sqrt(EPS))
"""How far apart spheres may be that retail calls overlapping, metres in their own space (01, 3.1)."""
_UNIT: Final = 1e-4
"""How far a plane's squared normal may be from 1, in a cell that is flown through unseen."""
_STEEP: Final = 1.01
"""Greatest squared normal of a fence: a longer one makes more of what a point is rounded by."""
_LARGEST: Final = 1e18
"""Metres of which retail's float32 holds the square; of more, it gets infinities and NaN."""


class Bounds:
    """Computes the bounds of a world of which everything else is compiled.

    Parameters
    ----------
    floats, ints : ndarray
        The world's arrays.
    """

    def __init__(self, floats: Array, ints: Ints) -> None:
        self._floats: Final = floats
        self._ints: Final = ints

    def objects(self, count: int) -> Array:
        """Return a ball about each object, shape (count, `engine.layout.BALL_SIZE`)."""
        return _stack([self._object(thing) for thing in range(count)], int(at.BALL_SIZE))

    def buildings(self, count: int) -> Array:
        """Return a ball about the outside of each building."""
        first = int(self._ints[at.WORLD_BUILDINGS] + at.BUILDING_PART)
        parts = self._ints[first : first + int(at.BUILDING_INTS) * count : int(at.BUILDING_INTS)]
        nothing = np.array([0.0, 0.0, 0.0, _NOTHING, 0.0])
        balls = [nothing if part == at.NO_PART else self._part(int(part)) for part in parts]
        return _stack(balls, int(at.BALL_SIZE))

    def cells(self, ids: Sequence[int], lists: Ints, objects: Array) -> Array:
        """Return of each cell the ball about its objects; the rest of its bounds is left empty.

        `lists`: of each cell where its list of objects begins, and how long it is.
        """
        bounds = np.zeros((len(ids), int(at.BOUNDS_SIZE)), dtype=np.float64)
        bounds[:, at.RADIUS] = _NOTHING
        bounds[:, at.BALL_CELL] = ids
        bounds[:, at.BOUNDS_FENCE_COUNT] = at.NOT_FENCED
        for index in np.flatnonzero(lists[:, 1]):
            first, count = lists[index]
            balls = objects[self._ints[first : first + count]]
            bounds[index, : at.BALL_SIZE] = _ball_about(balls, float(ids[int(index)]))
        return bounds

    def fences(self, cell: int, inside: Array) -> Array | None:
        """Return the fences of an environment cell, one plane for each portal, in its block.

        Parameters
        ----------
        cell : int
        inside : ndarray, shape (3,)
            A point well inside the cell, in its own frame.

        Returns
        -------
        ndarray, shape (n, 4), or None
            None if something is behind a portal that is reached from everywhere, or a plane is not unit.
        """
        record = self._record(cell)
        position = self._position(cell)
        point = position.out(inside)
        fences = []
        for k in range(max(int(record[at.CELL_PORTAL_COUNT]), 0)):
            first = int(record[at.CELL_PORTALS] + at.PORTAL_INTS * k)
            other, side, plane = self._ints[first : first + int(at.PORTAL_INTS)]
            if other >= 0:
                fence = self._containment(int(other), point)
            else:
                own = self._floats[plane : plane + at.PLANE_SIZE]
                fence = position.plane_out(own if side == 1 else -own)
            if fence is None:
                return None
            fences.append(fence)
        planes = _stack(fences, int(at.PLANE_SIZE))
        steep = (planes[:, : at.VECTOR_SIZE] ** 2).sum(axis=1) > _STEEP
        return None if steep.any() else planes

    def is_passable(self, cell: int, cell_id: int, shape: Shape | None, fences: Array) -> bool:
        """Say whether a cell may be flown through unseen.

        Nobody is kept out of it, its pose is in its own block, the normals of the planes that a ball is
        compared with are unit: of its `fences`, and those that split its tree and that contain it; and so
        are the spheres of its tree spheres.
        """
        block = int(self._position(cell).numbers[0]) >> 16
        if block != cell_id >> 16 or self._record(cell)[at.CELL_RESTRICTION] != at.NO_RESTRICTION:
            return False
        planes = [fences[:, : at.VECTOR_SIZE]]
        if shape is not None:
            if not _are_plain(shape.node_floats[:, at.NODE_SPHERE :]):
                return False
            nodes = shape.node_ints[:, at.NODE_KIND] == at.KIND_NODE
            planes.append(shape.node_floats[nodes, : at.VECTOR_SIZE])
            if shape.cell_planes is not None:
                planes.append(shape.cell_planes[:, : at.VECTOR_SIZE])
        squares = (np.concatenate(planes) ** 2).sum(axis=1)
        return bool((np.abs(squares - 1.0) < _UNIT).all())

    def _record(self, cell: int) -> Ints:
        return self._ints[self._ints[at.WORLD_CELL_INTS] + at.CELL_INTS * cell :][: int(at.CELL_INTS)]

    def _position(self, cell: int) -> _Position:
        return _Position(self._floats, int(self._ints[at.WORLD_CELL_FLOATS] + at.CELL_FLOATS * cell))

    def _containment(self, cell: int, point: Array) -> Array | None:
        """Return the plane of a cell's containment that a point is farthest behind; None without planes."""
        record = self._record(cell)
        first, count = int(record[at.CELL_PLANES]), int(record[at.CELL_PLANE_COUNT])
        if count <= 0:
            return None
        planes = self._floats[first : first + int(at.PLANE_SIZE) * count].reshape(-1, int(at.PLANE_SIZE))
        position = self._position(cell)
        out = [position.plane_out(plane) for plane in planes]
        return min(out, key=lambda plane: float(plane[:3] @ point + plane[3]))

    def _object(self, thing: int) -> Array:
        ints = self._ints[self._ints[at.WORLD_OBJECT_INTS] + at.OBJECT_INTS * thing :]
        family, first, count = (int(ints[k]) for k in (at.OBJECT_FAMILY, at.OBJECT_FIRST, at.OBJECT_COUNT))
        position = _Position(self._floats, int(self._ints[at.WORLD_OBJECT_FLOATS] + at.OBJECT_FLOATS * thing))
        if family == at.FAMILY_PARTS:
            balls = [self._part(first + k) for k in range(count)]
        elif family == at.FAMILY_NONE:
            balls = []
        else:
            size = int(at.CYLSPHERE_SIZE if family == at.FAMILY_CYLSPHERES else at.SPHERE_SIZE)
            shapes = self._floats[first : first + size * count].reshape(-1, size)
            balls = [position.shape_ball(shape) for shape in shapes]
        return _ball_about(_stack(balls, int(at.BALL_SIZE)), float(position.numbers[0]))

    def _part(self, part: int) -> Array:
        """Return a ball outside which nothing is near the part's physics sphere.

        Retail squares the sum of both radii: a negative one reaches as far as a positive one (01, 3.1).
        """
        position = _Position(self._floats, int(self._ints[at.WORLD_PART_FLOATS] + at.PART_FLOATS * part))
        root = int(self._ints[self._ints[at.WORLD_PART_INTS] + at.PART_INTS * part + at.PART_TREE])
        sphere = self._floats[int(at.NODE_FLOATS) * root + int(at.NODE_SPHERE) :][: int(at.SPHERE_SIZE)]
        return position.sphere_ball(sphere[: at.RADIUS], abs(float(sphere[at.RADIUS])) + _NEAR)


class _Position:
    """A position with a scale behind it, as the world's floats hold both."""

    def __init__(self, floats: Array, first: int) -> None:
        self.numbers: Final = floats[first : first + int(at.POSITION_SIZE)]
        self._scale: Final = float(floats[first + int(at.POSITION_SIZE)])
        matrix = self.numbers[at.MATRIX : at.ORIGIN]
        self._rows: Final = matrix.reshape(3, 3)
        self._origin: Final = self.numbers[at.ORIGIN :]
        self._rounding: Final = BOUND_ROUNDING * float(np.abs(self._origin).sum())

    def out(self, point: Array) -> Array:
        """Take a point out of the frame; its scale does not count."""
        taken: Array = point @ self._rows + self._origin
        return taken

    def plane_out(self, plane: Array) -> Array:
        """Take a plane out of the frame, and push it back by what rounding may add."""
        normal = plane[:3] @ self._rows
        return np.append(normal, plane[3] - normal @ self._origin + self._rounding)

    def sphere_ball(self, center: Array, radius: float) -> Array:
        """Return the ball about a sphere of the frame, scaled, with all that may be added to it."""
        size = float(np.linalg.norm(center)) + radius
        if not self._scale * size + float(np.abs(self._origin).sum()) < _LARGEST:
            return self._unbounded()
        tilt = BOUND_TILT * size
        reach = self._scale * (radius + 2.0 * tilt) + self._rounding
        return np.array([*self.out(self._scale * center), reach, self.numbers[0]])

    def shape_ball(self, shape: Array) -> Array:
        """Return the ball about a sphere or cylsphere; a cylinder stands upright, however it is turned."""
        ball = self.sphere_ball(shape[:3], float(shape[at.RADIUS]))
        if len(shape) > at.CYLSPHERE_HEIGHT:
            half = 0.5 * self._scale * float(shape[at.CYLSPHERE_HEIGHT])
            if not half < _LARGEST:
                return self._unbounded()
            ball[2] += half
            ball[at.RADIUS] += half
        return ball

    def _unbounded(self) -> Array:
        return np.array([0.0, 0.0, 0.0, UNBOUNDED, self.numbers[0]])


def _stack(rows: Sequence[Array], width: int) -> Array:
    return np.array(rows, dtype=np.float64).reshape(-1, width)


def _are_plain(spheres: Array) -> bool:
    """Say whether what overlaps one of a tree's spheres overlaps it with a larger radius, too.

    Not so with a negative radius, which a larger one brings nearer to 0 (BN-1); nor, for all its roundings,
    of a sphere beyond all measure.
    """
    radii = spheres[:, at.RADIUS]
    return bool((radii >= 0.0).all() and (np.abs(spheres) <= BOUND_MOST).all())


def _ball_about(balls: Array, cell: float) -> Array:
    """Return one ball, in the block of a cell, about others, which are each in the block of theirs."""
    balls = balls[balls[:, at.RADIUS] >= 0.0]
    if not len(balls):
        return np.array([0.0, 0.0, 0.0, _NOTHING, cell])
    centers = balls[:, :3].copy()
    centers[:, :2] += BLOCK_EDGE * (_block(balls[:, at.BALL_CELL]) - _block(np.array([cell])))
    middle = 0.5 * (centers.min(axis=0) + centers.max(axis=0))
    radius = (np.linalg.norm(centers - middle, axis=1) + balls[:, at.RADIUS]).max()
    return np.array([*middle, radius, cell])


def _block(cells: Array) -> Array:
    """Return the block coordinates of cell ids, shape (n, 2)."""
    blocks = cells.astype(np.int64) >> 16
    return np.column_stack((blocks >> 8, blocks & 0xFF)).astype(np.float64)


def write_bounds(
    storage: Storage,
    header: Mapping[int, int],
    cells: Sequence[Cell],
    ids: Sequence[int],
    lists: Ints,
    counts: tuple[int, int],
) -> dict[int, int]:
    """Write the bounds of a world of which all else is written; return what the header says of them.

    Parameters
    ----------
    header : mapping
        What the header says of the rest.
    cells : sequence of Cell
        The environment cells.
    ids : sequence of int
        Of all cells.
    lists : ndarray
        Of each cell where its list of objects begins, and how long it is.
    counts : (int, int)
        How many objects and buildings there are.
    """
    bounds = Bounds(*storage.finish(header))
    objects, buildings = bounds.objects(counts[0]), bounds.buildings(counts[1])
    rows = bounds.cells(ids, lists, objects)
    for index, cell in enumerate(cells):
        inside = np.zeros(3) if cell.shape is None else cell.shape.bounds.reshape(2, 3).mean(axis=0)
        fences = bounds.fences(index, inside)
        if fences is not None:
            rows[index, at.BOUNDS_FENCES] = storage.add_floats(fences.ravel())
            rows[index, at.BOUNDS_FENCE_COUNT] = len(fences)
            rows[index, at.BOUNDS_PASSABLE] = bounds.is_passable(index, cell.id, cell.shape, fences)
    return {
        int(at.WORLD_CELL_BOUNDS): storage.add_floats(rows.ravel()),
        int(at.WORLD_OBJECT_BOUNDS): storage.add_floats(objects.ravel()),
        int(at.WORLD_BUILDING_BOUNDS): storage.add_floats(buildings.ravel()),
    }
