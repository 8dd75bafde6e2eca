"""How cost grows: with polygons, with the length of a move, with objects near and far."""

from __future__ import annotations

import math
from functools import partial
from typing import TYPE_CHECKING, Any, Final

import numpy as np

from conformance.bench import ops, sampling
from conformance.bench.engine_jobs import engine_maker
from conformance.bench.figures import growth_exponent, summarise
from conformance.bench.report import Curve
from conformance.bench.scenes import CELL, bench_pose, grid_scene, hall_geometry, hall_scene, turn
from conformance.bench.settings import LARGE, SMALL
from conformance.bench.spots import RADIUS, Surfaces
from conformance.bench.timing import accept, take_turns
from conformance.candidates.engine_ops.world_cache import engine_pose, engine_shape
from conformance.scenes.bsp_builder import TreeStyle, build
from conformance.scenes.solids import box
from engine import Cell, Obstacle, Pose

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Sequence

    from numpy.random import Generator

    from conformance.bench.report import Report
    from conformance.bench.scenes import BenchScene
    from conformance.bench.settings import Settings
    from conformance.bench.timing import Job
    from conformance.bench.work import RowWork
    from conformance.scenes.model import Geometry
    from engine import Shape

LENGTHS: Final = (1, 2, 4, 8, 16, 32)
"""Lengths of a move, in radii of the mover: about as many sub-steps."""
NEAR: Final = (1, 2, 4, 8, 16, 32)
"""Numbers of objects in the reach of the mover."""
FAR: Final = (10, 100, 1000, 10_000)
"""Numbers of objects in the world."""
PER_CELL: Final = 10
"""Objects in each of the other cells."""
RING: Final = 0.9
"""Distance of near objects from the middle of the hall, metres: in reach, and never touched."""
CRATE: Final = 0.25
"""Side of an object, metres."""
STROLL: Final = 0.1
"""Length of a move among objects, metres."""
STRAY: Final = 0.05
"""How far from the middle such a move begins, metres."""
APART: Final = 500.0
"""How far below the hall the other cells are, metres."""


class Scaling:
    """The curves of one run; parameters as those of `conformance.bench.contests.Contest`."""

    def __init__(
        self, settings: Settings, report: Report, rng: Generator, say: Callable[[str], None]
    ) -> None:
        self._rounds: Final = settings.fast_rounds
        self._grids: Final = settings.grids
        self._report: Final = report
        self._rng: Final = rng
        self._say: Final = say

    def polygons(self) -> None:
        """Measure single queries and whole moves in scenes of more and more rooms."""
        scenes = [grid_scene(columns, rows, f"{columns}x{rows}") for columns, rows in self._grids]
        make: dict[str, Callable[..., Any]] = {
            ops.STRIKE: sampling.strikes,
            ops.STEP_DOWN: sampling.steps_down,
            ops.CONTACT_WALK: sampling.contact_walk,
        }
        surfaces = [Surfaces(scene.geometry) for scene in scenes]
        for op, sample in make.items():
            draws = [
                partial(sample, scene, near, self._rng, LARGE)
                for scene, near in zip(scenes, surfaces, strict=True)
            ]
            self._measure("polygons", op, [scene.size for scene in scenes], draws, LARGE)

    def lengths(self) -> None:
        """Measure moves that take more and more sub-steps."""
        scene = hall_scene(hall_geometry())
        draws = [self._walk(scene, RADIUS * length, 1.0) for length in LENGTHS]
        self._measure("sub-steps", ops.CONTACT_WALK, LENGTHS, draws)

    def near_objects(self) -> None:
        """Measure moves among more and more objects."""
        hall, crate = hall_geometry(), engine_shape(_crate())
        scenes = [hall_scene(hall, _ring(hall_scene(hall), crate, count)) for count in NEAR]
        draws = [self._walk(scene, STROLL, STRAY) for scene in scenes]
        self._measure("objects in reach", ops.CONTACT_WALK, NEAR, draws)

    def far_objects(self) -> None:
        """Measure the same move in worlds of more and more objects."""
        hall, crate = hall_geometry(), engine_shape(_crate())
        scenes = [hall_scene(hall, others=_elsewhere(hall, crate, count // PER_CELL)) for count in FAR]
        draws = [self._walk(scene, STROLL, STRAY) for scene in scenes]
        self._measure("objects in the world", ops.CONTACT_WALK, FAR, draws)

    def curves(self) -> list[tuple[str, Callable[[], None]]]:
        """Return every curve, with what it is called."""
        return [
            ("cost against polygons", self.polygons),
            ("cost against sub-steps", self.lengths),
            ("cost against objects in reach", self.near_objects),
            ("cost against objects in the world", self.far_objects),
        ]

    def _walk(self, scene: BenchScene, length: float, stray: float) -> Callable[[], RowWork]:
        return partial(sampling.open_walk, scene, self._rng, SMALL, length, stray)

    def _measure(
        self, name: str, op: str, sizes: Sequence[int], draws: Sequence[Callable[[], Any]], batch: int = SMALL
    ) -> None:
        """Let the sizes take turns, each round at new queries, and fit a power law to their medians."""
        rounds = self._works(f"{op} against {name}", draws)
        makers = [partial(_nth, index, engine_maker(op, batch)) for index in range(len(draws))]
        times = take_turns(makers, rounds, warm_up=next(rounds), judge=accept)
        costs = tuple(summarise(each) for each in times)
        exponent = growth_exponent(sizes, [cost.middle for cost in costs])
        self._report.curves.append(Curve(name, op, tuple(sizes), costs, exponent))

    def _works(self, about: str, draws: Sequence[Callable[[], Any]]) -> Iterator[list[Any]]:
        for number in range(self._rounds + 1):
            self._say(f"{about}, round {number} of {self._rounds}")
            yield [draw() for draw in draws]


def _nth(index: int, maker: Callable[[Any], Job], works: Sequence[Any]) -> Job:
    return maker(works[index])


def _crate() -> Geometry:
    return build("crate", box(size=(CRATE, CRATE, CRATE)), style=TreeStyle.BOTH, kind="bench")


def _ring(scene: BenchScene, crate: Shape, count: int) -> tuple[Obstacle, ...]:
    """Return objects about the middle of the hall."""
    angles = [2.0 * math.pi * i / count for i in range(count)]
    places = np.array([turn((RING * math.cos(angle), RING * math.sin(angle), 0.0)) for angle in angles])
    return tuple(_obstacle(crate, CELL, place) for place in scene.to_block(places).tolist())


def _elsewhere(hall: Geometry, crate: Shape, count: int) -> tuple[Cell, ...]:
    """Return other cells, with objects in each."""
    shape, rotation = engine_shape(hall), engine_pose(bench_pose().to_record()).rotation
    cells = []
    for index in range(1, count + 1):
        origin = (0.0, 0.0, -APART * index)
        objects = [_obstacle(crate, CELL + index, (float(k), 0.0, origin[2])) for k in range(PER_CELL)]
        cells.append(Cell(CELL + index, Pose(CELL + index, origin, rotation), shape, objects))
    return tuple(cells)


def _obstacle(crate: Shape, cell: int, origin: Sequence[float]) -> Obstacle:
    return Obstacle.solid(crate, Pose(cell, tuple(origin)))
