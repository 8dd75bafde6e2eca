"""A mover before an obstacle: paths by where the sphere was and is, and radii whose sums come out even."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from oracle_worlds import CELL, at, mover, vec, world_of

from oracle.arithmetic import f32
from oracle.constants import EPS
from oracle.sphere import Sphere
from oracle.transition import Transition

if TYPE_CHECKING:
    from collections.abc import Sequence

    from oracle.physics_object import PhysicsObj
    from oracle.vector import Vector3

Point = tuple[float, float, float]

EAST_CELL = 0xAAB40111
"""An interior cell of the landblock east of `CELL`'s: its origin lies 192 metres further east."""
TWO = 2.0 - EPS
"""A sum of radii that is exactly 2 with EPS added: a double, so that what is worked out by hand is exact."""
RADSUM = f32(TWO)
"""The sum of two radii that make 2, as `intersects_sphere` stores it; with EPS it is stored as 2."""
ATOM = 2.0**-22
"""Below every tolerance, and still seen beside 2."""


def approaching(
    curr: Point,
    check: Point,
    *,
    head: Point | None = None,
    radius: float = 0.5,
    head_radius: float = 0.5,
    state: int = 0,
    from_cell: int = CELL,
    to_cell: int = CELL,
    moving: PhysicsObj | None = None,
    **path: Any,
) -> Transition:
    """Return a transition whose sphere 0 was at `curr` and is at `check`, metres.

    `head` is where sphere 1 is, above or below; it moves as sphere 0 does. `path` are fields of the
    sphere path; `walk_interp` and `step_down_amt` are 1 unless they say otherwise.
    """
    made = Transition(world_of(), trace=[])
    made.init_object(mover() if moving is None else moving, state)
    spheres = [Sphere(vec(0.0, 0.0, 0.0), radius)]
    if head is not None:
        way = [h - c for h, c in zip(head, check, strict=True)]
        spheres.append(Sphere(vec(*way), head_radius))
    made.init_sphere(len(spheres), spheres, 1.0)
    made.init_path(made.world.get_visible(to_cell), at(*curr, from_cell), at(*check, to_cell))
    sp = made.sphere_path
    sp.set_check_pos(at(*check, to_cell), made.world.get_visible(to_cell))
    for name, value in {"walk_interp": 1.0, "step_down_amt": 1.0, **path}.items():
        setattr(sp, name, value)
    return made


def moved_by(made: Transition, check: Point) -> Point:
    """Return how far the check position has moved from `check`, and check that the spheres have too."""
    sp = made.sphere_path
    origin = sp.check_pos.frame.origin
    center = sp.global_sphere[0].center
    assert (origin.x, origin.y, origin.z) == (center.x, center.y, center.z)
    return origin.x - check[0], origin.y - check[1], origin.z - check[2]


def contact(made: Transition) -> tuple[int, Sequence[float], int, int]:
    """Return the contact plane: valid, nx ny nz d, is water, cell id."""
    ci = made.collision_info
    n = ci.contact_plane.N
    numbers = (n.x, n.y, n.z, ci.contact_plane.d)
    return ci.contact_plane_valid, numbers, ci.contact_plane_is_water, ci.contact_plane_cell_id


class Stepping(Transition):
    """A transition whose stepping up is decided beforehand; the normal it is asked with is kept."""

    step_up_answer = 0
    step_up_normals: list[tuple[float, float, float]]

    def step_up(self, collision_normal: Vector3) -> int:
        """Answer as told."""
        n = collision_normal
        self.step_up_normals = [*getattr(self, "step_up_normals", []), (n.x, n.y, n.z)]
        return self.step_up_answer


def stepping(made: Transition, *, succeeds: int) -> Stepping:
    """Make a transition one whose stepping up succeeds or fails."""
    made.__class__ = Stepping
    assert isinstance(made, Stepping)
    made.step_up_answer = succeeds
    made.step_up_normals = []
    return made
