"""CTransition: a move from one position to another, or a placement."""

from __future__ import annotations

from typing import TYPE_CHECKING

from oracle import (
    transition_insert,
    transition_path,
    transition_placement,
    transition_step,
    transition_validate,
)
from oracle.cell_array import CellArray
from oracle.cell_list import find_cell_list_for_path
from oracle.collision_info import CollisionInfo
from oracle.enums import InsertType, TransitionState
from oracle.object_info import ObjectInfo
from oracle.sphere_path import SpherePath

if TYPE_CHECKING:
    from collections.abc import Sequence

    from oracle.obj_cell import ObjCell
    from oracle.physics_object import PhysicsObj
    from oracle.plane import Plane
    from oracle.position import Position
    from oracle.ref import Ref
    from oracle.sphere import Sphere
    from oracle.vector import Vector3
    from oracle.world import World


class Transition:
    """One transition: the mover, its path, what it touched, and the cells it reaches.

    Retail draws transitions from a pool of ten and resets only some fields (05 1). Here every
    transition is new, and the fields that retail leaves stale start at zero.

    Attributes
    ----------
    world : World
        The loaded cells, which retail keeps in global tables.
    object_info, sphere_path, collision_info, cell_array
        As in 04 2.1.
    trace : list of str or None
        Takes one letter and one digit for every BSP tree call, if there is a list.
    """

    def __init__(self, world: World, trace: list[str] | None = None) -> None:
        """Make a transition as CTransition::init leaves it.

        retail: CTransition::init 0x00509DD0, 05 1.
        """
        self.world = world
        self.object_info = ObjectInfo()
        self.sphere_path = SpherePath()
        self.collision_info = CollisionInfo()
        self.cell_array = CellArray()
        self.trace = trace

    def init_object(self, mover: PhysicsObj, state: int) -> None:
        """Take the mover and its state bits; forwards to OBJECTINFO::init (05 1)."""
        self.object_info.init(mover, state)

    def init_sphere(self, count: int, spheres: Sequence[Sphere], scale: float) -> None:
        """Take the mover's spheres; forwards to SPHEREPATH::init_sphere (05 1)."""
        self.sphere_path.init_sphere(count, spheres, scale)

    def init_path(self, begin_cell: ObjCell | None, begin_pos: Position | None, end_pos: Position) -> None:
        """Take beginning and end; forwards to SPHEREPATH::init_path (05 1)."""
        self.sphere_path.init_path(begin_cell, begin_pos, end_pos)

    def init_contact_plane(self, cell_id: int, plane: Plane, is_water: int) -> None:
        """Seed both the contact plane and the last known one.

        retail: CTransition::init_contact_plane 0x0050E850, 04 5.
        """
        ci = self.collision_info
        ci.last_known_contact_plane_valid = 1
        ci.last_known_contact_plane.assign(plane)
        ci.last_known_contact_plane_is_water = is_water
        ci.last_known_contact_plane_cell_id = cell_id
        ci.contact_plane_valid = 1
        ci.contact_plane.assign(plane)
        ci.contact_plane_is_water = is_water
        ci.contact_plane_cell_id = cell_id

    def init_last_known_contact_plane(self, cell_id: int, plane: Plane, is_water: int) -> None:
        """Seed the last known contact plane; its cell id goes to the *contact* plane's field.

        retail: CTransition::init_last_known_contact_plane 0x0050E8E0, 04 5.
        """
        ci = self.collision_info
        ci.last_known_contact_plane_valid = 1
        ci.last_known_contact_plane.assign(plane)
        ci.last_known_contact_plane_is_water = is_water
        ci.contact_plane_cell_id = cell_id

    def init_sliding_normal(self, n: Vector3) -> None:
        """Seed the sliding normal, z dropped.

        retail: CTransition::init_sliding_normal 0x0050FF20, 04 5.
        """
        self.collision_info.set_sliding_normal(n)

    def build_cell_array(self, new_cell: Ref[ObjCell | None] | None) -> None:
        """List the cells that the check position's spheres reach.

        retail: CTransition::build_cell_array 0x00509EE0, 05 1.
        """
        self.sphere_path.cell_array_valid = 1
        self.sphere_path.hits_interior_cell = 0
        find_cell_list_for_path(self.world, self.cell_array, new_cell, self.sphere_path)

    def find_valid_position(self) -> int:
        """Run the transition; 1 if the current position of the path is to be used.

        retail: CTransition::find_valid_position 0x0050C310, 05 1.
        """
        if self.sphere_path.insert_type != InsertType.TRANSITION:
            return self.find_placement_position()
        return self.find_transitional_position()

    def check_collisions(self, other: PhysicsObj) -> int:
        """Tell whether the mover, where it is, overlaps an object.

        retail: CTransition::check_collisions 0x0050AA00, 05 1.
        """
        sp = self.sphere_path
        sp.insert_type = InsertType.PLACEMENT
        sp.set_check_pos(sp.curr_pos, sp.curr_cell)
        return int(other.find_obj_collisions(self) != TransitionState.OK)

    find_transitional_position = transition_path.find_transitional_position
    calc_num_steps = transition_path.calc_num_steps
    adjust_offset = transition_path.adjust_offset

    insert_into_cell = transition_insert.insert_into_cell
    check_other_cells = transition_insert.check_other_cells
    placement_insert = transition_insert.placement_insert
    transitional_insert = transition_insert.transitional_insert

    step_up = transition_step.step_up
    step_down = transition_step.step_down
    check_walkable = transition_step.check_walkable
    edge_slide = transition_step.edge_slide
    cliff_slide = transition_step.cliff_slide

    validate_transition = transition_validate.validate_transition
    validate_placement_transition = transition_validate.validate_placement_transition
    validate_placement = transition_validate.validate_placement

    find_placement_position = transition_placement.find_placement_position
    find_placement_pos = transition_placement.find_placement_pos
