"""The BODY block of FORMAT.md as an object of the oracle that remembers what its ticks did."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from conformance.candidates.oracle_ops.objects import holder, weenie
from conformance.candidates.oracle_ops.values import plane, position, sphere, vector
from oracle.arithmetic import f32
from oracle.constants import DEFAULT_ELASTICITY, DEFAULT_FRICTION
from oracle.errors import NotPortedError
from oracle.movement import MovementManager
from oracle.obj_cell import ObjCell
from oracle.physics_object import PhysicsObj
from oracle.physics_part import PartArray, Setup
from oracle.position import Position
from oracle.transition import Transition
from oracle.vector import Vector3
from oracle.world import World

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence
    from typing import NoReturn

DEFAULT_STATE = 0x400C08
"""PhysicsState of a body that does not say (04 1.5)."""


class Body(PhysicsObj):
    """An object whose last transition can be looked at.

    Attributes
    ----------
    begun : Transition or None
        The last transition that was made, traced.
    accepted : Transition or None
        The last transition if it succeeded.
    """

    def __init__(self, block: Mapping[str, Any], world: World) -> None:
        object_id = block.get("id", 0)
        super().__init__(
            object_id,
            block.get("state", DEFAULT_STATE),
            position(block["position"]) if "position" in block else Position(),
            scale=f32(block.get("scale", 1.0)),
            part_array=None if block.get("no_part_array", 0) else _part_array(block),
            weenie=weenie(block["weenie"], object_id) if "weenie" in block else None,
            parent=holder() if block.get("parent", 0) else None,
            world=world,
        )
        self.begun: Transition | None = None
        self.accepted: Transition | None = None
        self.transient_state = block.get("transient_state", 0)
        self.movement_manager = MovementManager() if block.get("movement_manager", 0) else None
        self.m_velocity = _vector(block, "velocity")
        self.m_acceleration = _vector(block, "acceleration")
        self.m_omega = _vector(block, "omega")
        self.friction = f32(block.get("friction", DEFAULT_FRICTION))
        self.elasticity = f32(block.get("elasticity", DEFAULT_ELASTICITY))
        if "contact_plane" in block:
            self.contact_plane = plane(block["contact_plane"])
        self.contact_plane_cell_id = block.get("contact_plane_cell", 0)
        self.sliding_normal = _vector(block, "sliding_normal")
        self.colliding_with_environment = block.get("colliding_with_environment", 0)

    def forget(self) -> None:
        """Remember no transition."""
        self.begun = self.accepted = None

    def make_transition(self) -> Transition:
        """Make a traced transition and keep it."""
        self.begun = Transition(self.world, trace=[])
        return self.begun

    def transition(self, old_pos: Position, new_pos: Position, admin_move: int) -> Transition | None:
        """Run a transition and keep it if it succeeds."""
        self.accepted = super().transition(old_pos, new_pos, admin_move)
        return self.accepted


class NamedCell(ObjCell):
    """A cell that has an id, for calls that ask nothing else of it."""

    def __init__(self, cell_id: int) -> None:
        super().__init__(cell_id, Position(cell_id))

    def find_collisions(self, *_args: object) -> NoReturn:
        """Say that there is nothing to collide with."""
        raise self._nothing()

    def point_in_cell(self, *_args: object) -> NoReturn:
        """Say that the cell has no extent."""
        raise self._nothing()

    def find_transit_cells(self, *_args: object) -> NoReturn:
        """Say that the cell has no neighbours."""
        raise self._nothing()

    def find_transit_cells_of_parts(self, *_args: object) -> NoReturn:
        """Say that the cell has no neighbours."""
        raise self._nothing()

    def _nothing(self) -> NotPortedError:
        return NotPortedError(f"cell {self.id:#010x} without geometry")


def make_body(block: Mapping[str, Any]) -> Body:
    """Make a body in an empty world."""
    return Body(block, World())


def _vector(block: Mapping[str, Any], key: str) -> Vector3:
    values: Sequence[float] | None = block.get(key)
    return Vector3() if values is None else vector(values)


def _part_array(block: Mapping[str, Any]) -> PartArray:
    """Make a part array that does not scale: the step heights of a BODY are final."""
    spheres = tuple(sphere(values) for values in block.get("spheres", ()))
    setup = Setup(
        step_up_height=f32(block.get("step_up_height", 0.0)),
        step_down_height=f32(block.get("step_down_height", 0.0)),
        sphere=spheres,
        allow_free_heading=bool(block.get("free_heading", 0)),
    )
    return PartArray([], setup, Vector3(1.0, 1.0, 1.0))
