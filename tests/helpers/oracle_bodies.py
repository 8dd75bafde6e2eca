"""Objects that tick, for tests: one sphere, a cell, and something that listens."""

from __future__ import annotations

from typing import TYPE_CHECKING

from oracle_worlds import CELL, FLOOR, RADIUS, at, vec, world_of

from oracle.movement import MovementManager
from oracle.physics_object import PhysicsObj
from oracle.physics_part import PartArray, Setup
from oracle.physics_state import EDGE_SLIDE_PS, GRAVITY_PS
from oracle.plane import Plane
from oracle.sphere import Sphere
from oracle.transient_state import ACTIVE_TS, CONTACT_TS, ON_WALKABLE_TS

if TYPE_CHECKING:
    from oracle.weenie import Weenie
    from oracle.world import World

STANDING = ACTIVE_TS | CONTACT_TS | ON_WALKABLE_TS
ORDINARY = GRAVITY_PS | EDGE_SLIDE_PS


class Listener(MovementManager):
    """Steering that notes what it hears."""

    def __init__(self) -> None:
        self.heard: list[str] = []

    def leave_ground(self) -> None:
        """Note it."""
        self.heard.append("leave")

    def hit_ground(self) -> None:
        """Note it."""
        self.heard.append("hit")


class Ticking(PhysicsObj):
    """An object that notes its ticks and performs none."""

    def __init__(self, world: World) -> None:
        super().__init__(0, 0, at(0.0, 0.0, 0.0), scale=1.0, part_array=None, world=world)
        self.cell = world_of().cells[CELL]
        self.quanta: list[float] = []

    def update_object_internal(self, quantum: float) -> None:
        """Note the tick."""
        self.quanta.append(quantum)


def walker(
    *,
    world: World | None = None,
    state: int = ORDINARY,
    transient: int = STANDING,
    velocity: tuple[float, float, float] = (0.0, 0.0, 0.0),
    height: float = 0.0,
    spheres: int = 1,
    free_heading: bool = False,
    weenie: Weenie | None = None,
) -> PhysicsObj:
    """Return an object on a floor at z = 0 (or `height` metres above it) without friction."""
    given = world_of(FLOOR) if world is None else world
    setup = Setup(
        step_up_height=0.5,
        step_down_height=1.5,
        sphere=(Sphere(vec(0.0, 0.0, RADIUS), RADIUS),) * spheres,
        allow_free_heading=free_heading,
    )
    parts = PartArray([], setup, vec(1.0, 1.0, 1.0))
    pose = at(0.0, 0.0, height)
    made = PhysicsObj(0, state, pose, scale=1.0, part_array=parts, weenie=weenie, world=given)
    made.cell = given.cells.get(CELL)
    made.transient_state = transient
    made.m_velocity = vec(*velocity)
    made.friction = 0.0
    made.contact_plane = Plane(vec(0.0, 0.0, 1.0), 0.0)
    made.contact_plane_cell_id = CELL
    return made
