"""CPhysicsObj: an object in the world, as mover and as obstacle."""

from __future__ import annotations

from typing import TYPE_CHECKING

from oracle import (
    physics_object_cells,
    physics_object_collisions,
    physics_object_contact,
    physics_object_obstacle,
    physics_object_placement,
    physics_object_position,
    physics_object_seed,
    physics_object_tick,
    physics_object_velocity,
)
from oracle.constants import DEFAULT_ELASTICITY, DEFAULT_FRICTION, DEFAULT_STEP
from oracle.plane import Plane
from oracle.vector import Vector3
from oracle.world import World

if TYPE_CHECKING:
    from oracle.movement import MovementManager, PositionManager
    from oracle.obj_cell import ObjCell
    from oracle.physics_object_collisions import CollisionRecord
    from oracle.physics_part import PartArray
    from oracle.position import Position
    from oracle.weenie import Weenie


class PhysicsObj:
    """A physics object; fields as far as ticks and transitions read or write them (06 1).

    Velocities are in metres per second, global axes.

    Attributes
    ----------
    id : int
        Object id; 0 for a mover without one.
    state : int
        PhysicsState bits (04 1.5).
    transient_state : int
        Bits of 04 1.4.
    world : World
        Where it lives; an object that is not given one is alone in an empty world.
    cell : ObjCell or None
        The cell it is in.
    m_position : Position
        Where it is.
    m_scale : float
        Scale of its spheres and cylinders.
    part_array : PartArray or None
        Its parts.
    weenie_obj : Weenie or None
        The game object behind it.
    parent : PhysicsObj or None
        What it is attached to.
    children : list of PhysicsObj
        What is attached to it.
    shadow_objects : list of (int, ObjCell or None)
        The cells it is registered in, by id; None is one that is not loaded.
    movement_manager : MovementManager or None
        Its steering; an object without one rests once it stands still.
    position_manager : PositionManager or None
        What changes its movement besides velocity.
    m_velocity, m_acceleration : Vector3
        Velocity, and its change per second.
    m_omega : Vector3
        Angular velocity about global axes, radians per second.
    friction, elasticity : float
        Fractions of the speed: lost in a second of sliding, and given back by a bounce.
    contact_plane : Plane
        In the block coordinates of `contact_plane_cell_id`; means something only with CONTACT_TS.
    sliding_normal : Vector3
        Means something only with SLIDING_TS.
    cached_velocity : Vector3
        Velocity as measured by the last tick.
    update_time : float
        Up to when it is simulated; seconds, a double. Zero until it is activated, where retail has
        whatever was in the memory.
    jumped_this_frame : int
        1 once the velocity was set to another one in this tick.
    colliding_with_environment : int
        1 while it is known to touch the environment; then that is not reported again.
    collision_table : dict of int to CollisionRecord
        The objects touched lately, by id.
    player_vector, player_distance : Vector3, float or None
        From the player, metres; None before the first tick that has a player.
    kill_velocity_calls : int
        How often a transition stopped this object.
    """

    __slots__ = (
        "cached_velocity",
        "cell",
        "children",
        "colliding_with_environment",
        "collision_table",
        "contact_plane",
        "contact_plane_cell_id",
        "elasticity",
        "friction",
        "id",
        "jumped_this_frame",
        "kill_velocity_calls",
        "m_acceleration",
        "m_omega",
        "m_position",
        "m_scale",
        "m_velocity",
        "movement_manager",
        "parent",
        "part_array",
        "player_distance",
        "player_vector",
        "position_manager",
        "shadow_objects",
        "sliding_normal",
        "state",
        "transient_state",
        "update_time",
        "weenie_obj",
        "world",
    )

    def __init__(
        self,
        object_id: int,
        state: int,
        position: Position,
        *,
        scale: float,
        part_array: PartArray | None,
        weenie: Weenie | None = None,
        parent: PhysicsObj | None = None,
        world: World | None = None,
    ) -> None:
        self.id = object_id
        self.state = state
        self.transient_state = 0
        self.world = World() if world is None else world
        self.cell: ObjCell | None = None
        self.m_position = position
        self.m_scale = scale
        self.part_array = part_array
        self.weenie_obj = weenie
        self.parent = parent
        self.children: list[PhysicsObj] = []
        self.shadow_objects: list[tuple[int, ObjCell | None]] = []
        self.movement_manager: MovementManager | None = None
        self.position_manager: PositionManager | None = None
        self.m_velocity = Vector3()
        self.m_acceleration = Vector3()
        self.m_omega = Vector3()
        self.friction = DEFAULT_FRICTION
        self.elasticity = DEFAULT_ELASTICITY
        self.contact_plane = Plane(Vector3(), 0.0)
        self.contact_plane_cell_id = 0
        self.sliding_normal = Vector3()
        self.cached_velocity = Vector3()
        self.update_time = 0.0
        self.jumped_this_frame = 0
        self.colliding_with_environment = 0
        self.collision_table: dict[int, CollisionRecord] = {}
        self.player_vector = Vector3()
        self.player_distance: float | None = None
        self.kill_velocity_calls = 0

    def __repr__(self) -> str:
        return f"PhysicsObj({self.id}, state={self.state:#x})"

    def get_step_up_height(self) -> float:
        """Return the step-up height in metres, as a register (04 OI-2)."""
        parts = self.part_array
        if parts is None:
            return 0.0
        return DEFAULT_STEP if parts.setup is None else parts.setup.step_up_height * parts.scale.z

    def get_step_down_height(self) -> float:
        """Return the step-down height in metres, as a register (04 OI-2)."""
        parts = self.part_array
        if parts is None:
            return 0.0
        return DEFAULT_STEP if parts.setup is None else parts.setup.step_down_height * parts.scale.z

    update_object = physics_object_tick.update_object
    activate = physics_object_tick.activate
    update_object_internal = physics_object_tick.update_object_internal
    update_position_internal = physics_object_tick.update_position_internal

    update_physics_internal = physics_object_velocity.update_physics_internal
    calc_friction = physics_object_velocity.calc_friction
    calc_acceleration = physics_object_velocity.calc_acceleration
    set_velocity = physics_object_velocity.set_velocity
    set_local_velocity = physics_object_velocity.set_local_velocity
    set_elasticity = physics_object_velocity.set_elasticity

    check_contact = physics_object_contact.check_contact
    set_on_walkable = physics_object_contact.set_on_walkable
    leave_walkable = physics_object_contact.leave_walkable
    clear_transient_states = physics_object_contact.clear_transient_states

    make_transition = physics_object_seed.make_transition
    seed_transition = physics_object_seed.seed_transition
    transition = physics_object_seed.transition
    give_spheres = physics_object_seed.give_spheres
    get_object_info = physics_object_seed.get_object_info

    handle_all_collisions = physics_object_collisions.handle_all_collisions
    track_object_collision = physics_object_collisions.track_object_collision
    report_collision_end = physics_object_collisions.report_collision_end
    report_environment_collision = physics_object_collisions.report_environment_collision
    report_object_collision = physics_object_collisions.report_object_collision

    set_position_internal = physics_object_position.set_position_internal
    become_lost = physics_object_position.become_lost
    store_position = physics_object_position.store_position
    change_cell = physics_object_position.change_cell
    set_frame = physics_object_position.set_frame

    find_obj_collisions = physics_object_obstacle.find_obj_collisions

    calc_cross_cells = physics_object_cells.calc_cross_cells
    calc_cross_cells_static = physics_object_cells.calc_cross_cells_static
    find_bbox_cell_list = physics_object_cells.find_bbox_cell_list
    add_shadows_to_cells = physics_object_cells.add_shadows_to_cells
    remove_shadows_from_cells = physics_object_cells.remove_shadows_from_cells

    set_position = physics_object_placement.set_position
    place = physics_object_placement.place
