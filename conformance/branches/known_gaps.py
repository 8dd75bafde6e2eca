"""The branches of the oracle that no case reaches, each with its reason.

By function (module and qualified name), then by branch: the condition's text and the way it goes, or
`NEVER_CALLED`. A branch that is reached leaves this table, and so does one that is gone.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from conformance.branches.reasons import NEVER_CALLED, Kind, Reason

if TYPE_CHECKING:
    from conformance.branches.reasons import Reasons

ANIMATION: Final = Reason(Kind.NOT_ASKED, "animations place parts; scenes give the parts' global poses")
RAYS: Final = Reason(Kind.NOT_ASKED, "rays are for picking with the mouse")
HEADINGS: Final = Reason(Kind.NOT_ASKED, "steering reads headings; bodies here are driven by velocities")
PLACING: Final = Reason(
    Kind.NOT_ASKED, "SetPosition is asked as a placement transition, without an object around it"
)
UNUSED: Final = Reason(Kind.NOT_ASKED, "retail's movement does without it")
CAMERA: Final = Reason(Kind.NOT_ASKED, "it finds the camera's cell")
VALUE: Final = Reason(Kind.NOT_ASKED, "a convenience of the port for values that tests look at")
ETHEREAL: Final = Reason(Kind.NOT_ASKED, "it needs CObjCell::check_collisions, which no document specifies")
MANAGERS: Final = Reason(Kind.NOT_ASKED, "no document specifies the position manager")
REGENERATION: Final = Reason(Kind.NOT_ASKED, "the heights of a loaded block do not change")
HOUSING: Final = Reason(Kind.NOT_ASKED, "no scene has a house with restricted entry (FORMAT.md)")
ATTACHED: Final = Reason(Kind.NOT_ASKED, "no body of an operation has others attached to it")
TRACED: Final = Reason(Kind.NOT_ASKED, "the bodies of the operations make a transition with a trace")

CHECKED: Final = Reason(Kind.GUARD, "the checks of scenes refuse such data")
NO_OBJECT: Final = Reason(Kind.GUARD, "every operation gives its transition an object")
HAS_WALKABLE: Final = Reason(Kind.GUARD, "its caller has a walkable polygon (04 PS-1)")
UNKNOWN: Final = Reason(
    Kind.GUARD, "retail's answer to a NaN is not known there (07 11): the query is refused"
)

POLYGONS: Final = Reason(Kind.NO_INPUT, "polygons have three corners or more")
SHELL: Final = Reason(Kind.NO_INPUT, "a building has a shell")
ONE_BUILDING: Final = Reason(Kind.NO_INPUT, "a second building in a land cell is refused")
ON_LAND: Final = Reason(Kind.NO_INPUT, "a building that is on no loaded land is refused")
FULL_DETAIL: Final = Reason(Kind.NO_INPUT, "blocks are loaded with full detail")
PORTALS: Final = Reason(Kind.NO_INPUT, "a cell has a list of portals, if an empty one")
TREES: Final = Reason(
    Kind.NO_INPUT, "a part has a tree with a bounding sphere and box, or is missing as a whole"
)
FLAT_PARTS: Final = Reason(Kind.NO_INPUT, "no part is drawn as a flat picture")
BODIES: Final = Reason(Kind.NO_INPUT, "a body has a part array")
LISTED: Final = Reason(Kind.NO_INPUT, "what is pruned is in the list")
WITH_PATH: Final = Reason(Kind.NO_INPUT, "whoever wants to know the containing cell gives a path")
ON_THE_MAP: Final = Reason(Kind.NO_INPUT, "adjust_to_outside has just made the id of a land cell (10 2.8)")
ROOT: Final = Reason(
    Kind.NO_INPUT,
    "the sphere that has hit is nearer to the axis than the radius sum, so its way has a root; and the sum of"
    " two squares of float32 is EPS to the last bit only by accident",
)
OWN_SHADOW: Final = Reason(Kind.NO_INPUT, "a body's shadow is in the cells that it was put in")
LAST_SHADOW: Final = Reason(Kind.NO_INPUT, "one body moves, and registers itself behind all others")
UNIT_VECTOR: Final = Reason(Kind.NO_INPUT, "what is handed to it is of unit length")
NOT_A_NUMBER: Final = Reason(
    Kind.NO_INPUT, "set_rotate puts the old quaternion back before it is not a number"
)
ENTERED: Final = Reason(Kind.NO_INPUT, "the cell has just been entered, and no response leaves it")
THREE: Final = Reason(Kind.NO_INPUT, "standstills are counted to 3")
IN_A_CELL: Final = Reason(Kind.NO_INPUT, "a placement in no cell has been refused before")
BEGUN: Final = Reason(Kind.NO_INPUT, "a transition that is not a placement has both positions")
VIEWER_STEPS: Final = Reason(
    Kind.NO_INPUT, "a camera that moves by EPS or less makes no sub-step at all (05 NS-4)"
)
PLACEMENTS: Final = Reason(
    Kind.NO_INPUT, "find_valid_position sends placements to find_placement_position (05 1)"
)
DECIDED: Final = Reason(Kind.NO_INPUT, "an insert has at least one attempt, which decides")
LOADED: Final = Reason(Kind.NO_INPUT, "a transition begins in a loaded cell")

_MAY_ENTER: Final = "weenie is None or weenie.can_bypass_move_restrictions or self.restriction is None"

REASONS: Final[Reasons] = {
    "bsp_node.BSPNode.children": {"if self.pos_node is None or self.neg_node is None: true": CHECKED},
    "building.BuildingObj.find_building_collisions": {"if self.part_array is None: true": SHELL},
    "cell_array.CellArray.remove_cell": {"if not self.cells: true": LISTED},
    "cell_list._containing_cell": {"if path is not None: false": WITH_PATH},
    "cyl_sphere_clip._touch_corner": {"if disc >= 0.0 and a > EPS: false": ROOT},
    "env_cell.CellPortal.required_plane": {"if self.plane is None: true": CHECKED},
    "env_cell.EnvCell.find_env_collisions": {"if r != TransitionState.OK: true": HOUSING},
    "env_cell.EnvCell.point_in_cell": {"if self.portals is None: true": PORTALS},
    "env_cell.EnvCell.find_visible_child_cell": {NEVER_CALLED: CAMERA},
    "env_cell_transit._part_leaves": {"if reach is None: true": TREES},
    "env_cell_transit._reach_of": {"if sphere is None: true": TREES},
    "env_cell_transit._part_enters": {"if reach is None: true": TREES},
    "frame.Frame.combine_aframe": {NEVER_CALLED: ANIMATION},
    "frame.Frame.combine_scaled": {NEVER_CALLED: ANIMATION},
    "frame.Frame.interpolate_origin": {NEVER_CALLED: UNUSED},
    "frame.Frame.set_vector_heading": {"if n.normalize_check_small(): true": UNIT_VECTOR},
    "frame.Frame.get_heading": {NEVER_CALLED: HEADINGS},
    "land_block.LandBlock.init_buildings": {"if cell is not None: false": ON_LAND},
    "land_block_struct.LandBlockStruct.generate": {
        "if self.polygons: true": REGENERATION,
        "for polygon in self.polygons: an item": REGENERATION,
        "for polygon in self.polygons: no item left": REGENERATION,
    },
    "land_block_struct.LandBlockStruct.calc_water": {
        "if self.side_cell_count != SIDE_CELLS: true": FULL_DETAIL
    },
    "land_cell.LandCell.find_env_collisions": {"if r != TransitionState.OK: true": HOUSING},
    "land_cell.LandCell.handle_move_restriction": {NEVER_CALLED: HOUSING},
    "land_defs.within_block": {NEVER_CALLED: UNUSED},
    "land_defs.set_height_table": {NEVER_CALLED: Reason(Kind.NOT_ASKED, "scenes give heights, not indices")},
    "obj_cell.ObjCell.check_entry_restrictions": {
        "if mover is None: true": NO_OBJECT,
        f"if {_MAY_ENTER}: false": HOUSING,
        "if transition.object_info.state & IS_PLAYER: true": HOUSING,
        "if transition.object_info.state & IS_PLAYER: false": HOUSING,
        "if not admitted: true": HOUSING,
        "if not admitted: false": HOUSING,
        "if admitted is not None: true": HOUSING,
        "if admitted is not None: false": HOUSING,
    },
    "obj_cell.ObjCell.handle_move_restriction": {NEVER_CALLED: HOUSING},
    "obj_cell.ObjCell.remove_shadow_object": {
        "if found is not None: false": OWN_SHADOW,
        "if last is not physobj: true": LAST_SHADOW,
    },
    "object_info.ObjectInfo.mover": {"if self.object is None: true": NO_OBJECT},
    "outside_cells.add_all_outside_cells": {"if found: false": ON_THE_MAP},
    "outside_cells._cells_under": {"if part.always_2d(): true": FLAT_PARTS},
    "physics_object.PhysicsObj.get_step_up_height": {"if parts is None: true": BODIES},
    "physics_object.PhysicsObj.get_step_down_height": {"if parts is None: true": BODIES},
    "physics_object_cells.add_shadows_to_cells": {"for child in self.children: an item": ATTACHED},
    "physics_object_cells.remove_shadows_from_cells": {"for child in self.children: an item": ATTACHED},
    "physics_object_collisions.handle_all_collisions": {"if frames == 2: false": THREE},
    "physics_object_placement.set_position": {NEVER_CALLED: PLACING},
    "physics_object_placement.place": {NEVER_CALLED: PLACING},
    "physics_object_placement._check_position": {NEVER_CALLED: PLACING},
    "physics_object_position.set_position_internal": {"if self.cell is not None: false": ENTERED},
    "physics_object_position.set_frame": {
        "if turned and (not any((is_nan(c) for c in (o.x, o.y, o.z)))): true": NOT_A_NUMBER
    },
    "physics_object_seed.make_transition": {NEVER_CALLED: TRACED},
    "physics_object_tick.update_object_internal": {
        "if self.transient_state & CHECK_ETHEREAL_TS: true": ETHEREAL
    },
    "physics_object_tick._leave_ethereal": {NEVER_CALLED: ETHEREAL},
    "physics_object_tick.update_position_internal": {
        "if self.part_array is not None: false": BODIES,
        "if self.position_manager is not None: true": MANAGERS,
    },
    "physics_object_velocity.set_elasticity": {NEVER_CALLED: UNUSED},
    "physics_part.GfxObj.find_obj_collisions": {"if bsp is None or ps is None: true": TREES},
    "physics_part.PhysicsPart.bounding_box": {
        "if self.gfxobj is None or self.gfxobj.bounding_box is None: true": TREES
    },
    "physics_part.PhysicsPart.find_obj_collisions": {"if g is None or g.physics_bsp is None: true": TREES},
    "physics_part.Setup.num_cylsphere": {NEVER_CALLED: VALUE},
    "plane.Plane.copy": {NEVER_CALLED: VALUE},
    "plane.Plane.set_height": {NEVER_CALLED: UNUSED},
    "plane.Plane.compute_time_of_intersection": {NEVER_CALLED: RAYS},
    "polygon.Polygon.make_plane": {"if self.num_pts - 1 > 1: false": POLYGONS},
    "polygon.Polygon.point_in_poly2D": {"if not self.vertices: true": POLYGONS},
    "polygon.Polygon.polygon_hits_ray": {NEVER_CALLED: RAYS},
    "position.Position.localtoglobal_origin": {NEVER_CALLED: UNUSED},
    "position.Position.get_offset_point": {NEVER_CALLED: UNUSED},
    "position.Position.distance": {NEVER_CALLED: UNUSED},
    "position.Position.get_outside_cell_id": {NEVER_CALLED: UNUSED},
    "ray.Ray.__init__": {NEVER_CALLED: RAYS},
    "sort_cell.SortCell.add_building": {"if self.building is None: false": ONE_BUILDING},
    "sphere_path.SpherePath.precipice_slide": {"if walkable is None: true": HAS_WALKABLE},
    "sphere_responses.step_sphere_down": {"if is_nan(root): true": UNKNOWN},
    "transition.Transition.check_collisions": {NEVER_CALLED: ETHEREAL},
    "transition_insert.placement_insert": {"if cell is None: true": IN_A_CELL},
    "transition_path.find_transitional_position": {
        "if length > EPS: false": VIEWER_STEPS,
        "if sp.insert_type == InsertType.TRANSITION: false": PLACEMENTS,
        "if ts == TransitionState.OK: true": PLACEMENTS,
        "if ts == TransitionState.OK: false": PLACEMENTS,
        "if not sp.placement_allows_sliding: true": PLACEMENTS,
        "if not sp.placement_allows_sliding: false": PLACEMENTS,
    },
    "transition_path.calc_num_steps": {"if sp.begin_pos is None or sp.end_pos is None: true": BEGUN},
    "transition_placement.find_placement_position": {"if cell is not None: false": LOADED},
    "transition_validate.validate_transition": {"if ts in FAILED: false": DECIDED},
    "vector.dot_y": {NEVER_CALLED: UNUSED},
    "world.World.add_cell": {"if not cell.is_interior: true": CHECKED},
}
