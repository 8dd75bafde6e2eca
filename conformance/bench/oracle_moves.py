"""The oracle at work: whole moves, single calls of a cell's tree, and ticks.

In the clock is what the engine does of a row of numbers, too: a transition is made, takes mover, seed
and path, and is run. Worlds, trees, poses, spheres and planes are made before.
"""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING, Any, Final
from weakref import WeakKeyDictionary

import numpy as np

from conformance.bench.engine_jobs import TICKS
from conformance.bench.sampling import QUANTUM
from conformance.bench.timing import Job
from conformance.candidates.oracle_ops.blocks import moving_object
from conformance.candidates.oracle_ops.body_walk import UntrackedBody
from conformance.candidates.oracle_ops.scene import build_world
from conformance.candidates.oracle_ops.values import nxyzd, plane, position, quaternion, sphere, xyz
from oracle.arithmetic import f32
from oracle.env_cell import EnvCell
from oracle.transition import Transition

if TYPE_CHECKING:
    from collections.abc import Callable, MutableMapping

    from conformance.bench.scenes import BenchScene
    from conformance.bench.work import RowWork
    from oracle.position import Position
    from oracle.world import World

NONE: Final = -1.0
"""Stands for no polygon."""
_worlds: MutableMapping[BenchScene, World] = WeakKeyDictionary()


def oracle_world(scene: BenchScene) -> World:
    """Return the oracle's world of a scene, the same one for the same scene."""
    world = _worlds.get(scene)
    if world is None:
        world = _worlds[scene] = _world_of(scene)
    return world


def _world_of(scene: BenchScene) -> World:
    return build_world(scene.cells(), {scene.geometry.name: scene.geometry})


def job_of(tasks: list[Callable[[], Any]], answer: Callable[[Any], list[float]]) -> Job:
    """Make a job of one call for each query."""

    def run() -> list[Any]:
        return [task() for task in tasks]

    return Job(run, lambda done: np.array([answer(each) for each in done]), len(tasks))


def move_job(work: RowWork) -> Job:
    """Make a job of whole transitions."""
    return _row_job(_Asked.move, work)


def collide_job(work: RowWork) -> Job:
    """Make a job of single calls of the cell's tree."""
    return _row_job(_Asked.collide, work)


def tick_job(work: RowWork) -> Job:
    """Make a job of ticks; their time is that of one tick.

    Every body is alone in a world of its own, as the engine's are: a body registers itself in the cells
    that it reaches, where others would collide with it.
    """
    walkers = [_body(row, _world_of(work.scene)) for row in work.rows]

    def run() -> list[UntrackedBody]:
        for walker in walkers:
            for _ in range(TICKS):
                walker.world.clock.curr_time += _QUANTUM
                walker.update_object_internal(_QUANTUM)
        return walkers

    return Job(run, lambda done: np.array([_stand(body) for body in done]), len(walkers), TICKS)


_QUANTUM: Final = f32(QUANTUM)


def _body(row: Any, world: World) -> UntrackedBody:
    """Make the body of a row."""
    cell = int(row["cell_id"])
    pose = {"cell": cell, "rotation": row["rotation"].tolist(), "origin": row["origin"].tolist()}
    block = {
        "position": pose,
        "spheres": row["spheres"][: int(row["num_sphere"])].tolist(),
        "movement_manager": int(row["has_movement_manager"]),
        "contact_plane_cell": int(row["contact_plane_cell_id"]),
    }
    for name in ("scale", "step_up_height", "step_down_height", "friction", "elasticity"):
        block[name] = float(row[name])
    for name in ("velocity", "acceleration", "omega", "contact_plane", "sliding_normal"):
        block[name] = row[name].tolist()
    for name in ("state", "transient_state"):
        block[name] = int(row[name])
    body = UntrackedBody(block, world)
    body.cell = world.cells[cell]
    return body


def _stand(body: UntrackedBody) -> list[float]:
    frame = body.m_position.frame
    return [*xyz(frame.origin), *quaternion(frame), *xyz(body.m_velocity), float(body.transient_state)]


class _Asked:
    """A row of a query, read."""

    def __init__(self, row: Any, world: World, cell_id: int) -> None:
        self.world = world
        self.cell = _env_cell(world, cell_id)
        self.begin, self.end = position(_pose(row["start"])), position(_pose(row["end"]))
        self.mover = moving_object(_mover(row), self.begin)
        self.state = int(row["state"])
        self.may_step_down = int(row["may_step_down"])
        self.spheres = [sphere(values) for values in row["spheres"][: int(row["num_sphere"])].tolist()]
        self.scale = f32(float(row["scale"]))
        self.contact = plane(row["contact_plane"].tolist()) if row["contact_plane_valid"] else None
        self.contact_cell = int(row["contact_plane_cell_id"])
        self.is_water = int(row["contact_plane_is_water"])
        self.step_down = int(row["step_down"])
        self.step_down_amt = float(row["step_down_amt"])
        self.allowance, self.interp = float(row["walkable_allowance"]), float(row["walk_interp"])

    def transition(self) -> Transition:
        """Make the transition, up to its path."""
        made = Transition(self.world)
        made.init_object(self.mover, self.state)
        made.object_info.step_down = self.may_step_down
        made.init_sphere(len(self.spheres), self.spheres, self.scale)
        if self.contact is not None:
            made.init_contact_plane(self.contact_cell, self.contact, self.is_water)
        made.init_path(self.cell, self.begin, self.end)
        return made

    def move(self) -> tuple[int, Transition]:
        """Perform the whole transition."""
        made = self.transition()
        return made.find_valid_position(), made

    def collide(self) -> tuple[int, Transition]:
        """Perform one call of the cell's tree, at the end of the path."""
        made = self.transition()
        path, tree = made.sphere_path, self.cell.structure.physics_bsp
        if tree is None:
            raise ValueError(f"cell {self.cell.id:#010x} has no tree")
        path.set_check_pos(self.end, self.cell)
        path.step_down, path.step_down_amt = self.step_down, self.step_down_amt
        path.walkable_allowance, path.walk_interp = self.allowance, self.interp
        self.cell.cache_local_space(path)
        return int(tree.find_collisions(made, 1.0)), made


def _row_job(perform: Callable[[_Asked], tuple[int, Transition]], work: RowWork) -> Job:
    world, cell_id = oracle_world(work.scene), work.scene.pose.cell
    asked = [_Asked(row, world, cell_id) for row in work.rows]
    return job_of([partial(perform, one) for one in asked], _moved)


def _moved(done: tuple[int, Transition]) -> list[float]:
    result, made = done
    path, info = made.sphere_path, made.collision_info
    contact, normal = float(info.contact_plane_valid), float(info.collision_normal_valid)
    return [
        float(result),
        *_where(path.check_pos),
        *_where(path.curr_pos),
        contact,
        *(value * contact + 0.0 for value in nxyzd(info.contact_plane)),
        normal,
        *(value * normal + 0.0 for value in xyz(info.collision_normal)),
        NONE if path.walkable is None else float(path.walkable.poly_id),
    ]


def _where(at: Position) -> list[float]:
    return [float(at.objcell_id), *quaternion(at.frame), *xyz(at.frame.origin)]


def _env_cell(world: World, cell_id: int) -> EnvCell:
    cell = world.cells[cell_id]
    if not isinstance(cell, EnvCell):
        raise TypeError(f"cell {cell_id:#010x} is not an environment cell")
    return cell


def _pose(row: Any) -> dict[str, Any]:
    cell, *numbers = row.tolist()
    return {"cell": int(cell), "rotation": numbers[:4], "origin": numbers[4:]}


def _mover(row: Any) -> dict[str, Any]:
    numbers = ("scale", "step_up_height", "step_down_height")
    return {
        **{name: float(row[name]) for name in numbers},
        "ethereal": int(row["ethereal"]),
        "gravity": int(row["gravity"]),
    }
