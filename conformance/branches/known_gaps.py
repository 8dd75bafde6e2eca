"""The branches of the oracle that no case reaches, each with its reason.

By function (module and qualified name), then by branch: the condition's text and the way it goes, or
`NEVER_CALLED`. A branch that is reached leaves this table, and so does one that is gone.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from conformance.branches.reasons import NEVER_CALLED, Kind, Reason

if TYPE_CHECKING:
    from conformance.branches.reasons import Reasons

ETHEREAL: Final = Reason(Kind.NOT_ASKED, "it needs CObjCell::check_collisions, which no document specifies")
MANAGERS: Final = Reason(Kind.NOT_ASKED, "no document specifies the position manager")
TRACED: Final = Reason(Kind.NOT_ASKED, "the bodies of the operations make a transition with a trace")
SCATTERED: Final = Reason(Kind.NOT_ASKED, "placements at random positions are not specified to the last bit")

CHECKED: Final = Reason(Kind.GUARD, "the checks of scenes refuse such data")
NO_OBJECT: Final = Reason(Kind.GUARD, "every operation gives a transition that moves an object")
HAS_WALKABLE: Final = Reason(Kind.GUARD, "its caller has a walkable polygon (04 PS-1)")
BOUNDED: Final = Reason(Kind.GUARD, "a part of a geometry has the box of its vertices")
UNKNOWN: Final = Reason(
    Kind.GUARD, "retail's answer to a NaN is not known there (07 11): the query is refused"
)

POLYGONS: Final = Reason(Kind.NO_INPUT, "polygons have three corners or more")
LISTED: Final = Reason(Kind.NO_INPUT, "what is pruned is in the list")
ON_THE_MAP: Final = Reason(Kind.NO_INPUT, "adjust_to_outside has just made the id of a land cell (10 2.8)")
OWN_SHADOW: Final = Reason(Kind.NO_INPUT, "an object's shadow is in the cells that it was put in")
NOT_A_NUMBER: Final = Reason(
    Kind.NO_INPUT, "set_rotate puts the old quaternion back before it is not a number"
)
ENTERED: Final = Reason(Kind.NO_INPUT, "the cell has just been entered, and no response leaves it")
THREE: Final = Reason(Kind.NO_INPUT, "standstills are counted to 3")
IN_A_CELL: Final = Reason(Kind.NO_INPUT, "a placement in no cell has been refused before")
DECIDED: Final = Reason(Kind.NO_INPUT, "an insert has at least one attempt, which decides")

REASONS: Final[Reasons] = {
    "bsp_node.BSPNode.children": {"if self.pos_node is None or self.neg_node is None: true": CHECKED},
    "cell_array.CellArray.remove_cell": {"if not self.cells: true": LISTED},
    "env_cell.CellPortal.required_plane": {"if self.plane is None: true": CHECKED},
    "obj_cell.ObjCell.remove_shadow_object": {"if found is not None: false": OWN_SHADOW},
    "object_info.ObjectInfo.mover": {"if self.object is None: true": NO_OBJECT},
    "outside_cells.add_all_outside_cells": {"if found: false": ON_THE_MAP},
    "physics_object_collisions.handle_all_collisions": {"if frames == 2: false": THREE},
    "physics_object_placement.set_position": {"if flags & SCATTERED: true": SCATTERED},
    "physics_object_placement.place": {"if made.sphere_path.curr_cell is None: true": IN_A_CELL},
    "physics_object_position.set_position_internal": {"if self.cell is not None: false": ENTERED},
    "physics_object_position.set_frame": {
        "if turned and (not any((is_nan(c) for c in (o.x, o.y, o.z)))): true": NOT_A_NUMBER
    },
    "physics_object_seed.make_transition": {NEVER_CALLED: TRACED},
    "physics_object_tick._leave_ethereal": {"if self.parent is None: true": ETHEREAL},
    "physics_object_tick.update_position_internal": {"if self.position_manager is not None: true": MANAGERS},
    "physics_part.PhysicsPart.bounding_box": {
        "if self.gfxobj is None or self.gfxobj.bounding_box is None: true": BOUNDED
    },
    "polygon.Polygon.make_plane": {"if self.num_pts - 1 > 1: false": POLYGONS},
    "polygon.Polygon.point_in_poly2D": {"if not self.vertices: true": POLYGONS},
    "sphere_path.SpherePath.precipice_slide": {"if walkable is None: true": HAS_WALKABLE},
    "sphere_responses.step_sphere_down": {"if is_nan(root): true": UNKNOWN},
    "transition_insert.placement_insert": {"if cell is None: true": IN_A_CELL},
    "transition_validate.validate_transition": {"if ts in FAILED: false": DECIDED},
}
