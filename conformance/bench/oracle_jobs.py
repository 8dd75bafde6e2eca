"""The oracle at work: one query after the other, every number read before the clock starts."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING, Any, Final

from conformance.bench import ops
from conformance.bench.oracle_moves import NONE, collide_job, job_of, move_job, tick_job
from conformance.candidates.oracle_ops.geometry import oracle_geometry
from conformance.candidates.oracle_ops.values import sphere, vector, xyz
from oracle.ref import Ref
from oracle.sphere_path import SpherePath

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from conformance.bench.timing import Job, Maker
    from conformance.bench.work import KernelWork
    from oracle.bsp_node import BSPNode
    from oracle.polygon import Polygon


def oracle_maker(op: str) -> Maker:
    """Return the oracle as an implementation of an operation (a key of `MAKERS`)."""
    return MAKERS[op]


def _strike_job(work: KernelWork) -> Job:
    root = oracle_geometry(work.scene.geometry).tree.root_node
    tasks: list[Callable[[], Any]] = [
        partial(_strike, root, sphere(ball), vector(movement))
        for ball, movement in zip(work.spheres.tolist(), work.movements.tolist(), strict=True)
    ]
    return job_of(tasks, lambda done: [float(done[0]), _polygon_id(done[1])])


def _strike(root: BSPNode, ball: Any, movement: Any) -> tuple[int, Ref[Polygon | None]]:
    polygon: Ref[Polygon | None] = Ref(None)
    return root.sphere_intersects_poly(ball, movement, polygon, Ref(None)), polygon


def _step_down_job(work: KernelWork) -> Job:
    root = oracle_geometry(work.scene.geometry).tree.root_node
    arrays = (work.spheres, work.movements, work.ups, work.allowances, work.interps)
    tasks: list[Callable[[], Any]] = [
        partial(_step_down, root, sphere(ball), vector(movement), vector(up), allowance, interp)
        for ball, movement, up, allowance, interp in zip(*(array.tolist() for array in arrays), strict=True)
    ]

    def answer(done: Any) -> list[float]:
        ball, path, polygon = done
        return [*xyz(ball.center), path.walk_interp, _polygon_id(polygon)]

    return job_of(tasks, answer)


def _step_down(root: BSPNode, ball: Any, movement: Any, up: Any, allowance: float, interp: float) -> Any:
    path = SpherePath()
    path.walkable_allowance, path.walk_interp = allowance, interp
    polygon: Ref[Polygon | None] = Ref(None)
    root.find_walkable(path, ball, polygon, movement, up, Ref(0))
    return ball, path, polygon


def _polygon_id(polygon: Ref[Polygon | None]) -> float:
    return NONE if polygon.value is None else float(polygon.value.poly_id)


MAKERS: Final[Mapping[str, Maker]] = {
    ops.STRIKE: _strike_job,
    ops.STEP_DOWN: _step_down_job,
    ops.FIND_COLLISIONS: collide_job,
    ops.CONTACT_WALK: move_job,
    ops.FREE_FLIGHT: move_job,
    ops.TICK: tick_job,
}
"""Operations that the oracle is clocked at."""
