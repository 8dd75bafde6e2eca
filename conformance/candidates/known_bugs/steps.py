"""Mistakes about steps and attempts: what an insert, a step up or a step down leaves behind."""

from __future__ import annotations

from copy import deepcopy
from typing import TYPE_CHECKING, Final

from conformance.candidates.bug_candidate import KnownBug
from conformance.candidates.replacements import Edit, Method
from oracle.bsp_tree import BSPTree
from oracle.transition import Transition

if TYPE_CHECKING:
    from collections.abc import Callable

    from oracle.vector import Vector3

_TWO_HALVES: Final = "self.step_down(height, z) or self.step_down(height, z)"


def _put_plane_back(retail: Callable[[Transition, Vector3], int]) -> Callable[[Transition, Vector3], int]:
    def step_up(self: Transition, normal: Vector3) -> int:
        collisions = self.collision_info
        valid, plane = collisions.contact_plane_valid, deepcopy(collisions.contact_plane)
        water, cell_id = collisions.contact_plane_is_water, collisions.contact_plane_cell_id
        result = retail(self, normal)
        collisions.set_contact_plane(plane, water)
        collisions.contact_plane_valid = valid
        collisions.contact_plane_cell_id = cell_id
        return result

    return step_up


BUGS: Final = (
    KnownBug(
        "scaled-offset",
        "the lift of a step down onto a scaled part is not multiplied by the scale",
        "the local offset is multiplied by it (03 SD-7)",
        (
            Edit(
                BSPTree,
                "step_sphere_down",
                (("Vector3(f32(ox * scale), f32(oy * scale), f32(oz * scale))", "Vector3(ox, oy, oz)"),),
            ),
        ),
        case="step-down-scaled-static",
        output="global_spheres[0].z",
    ),
    KnownBug(
        "step-up-restores-plane",
        "after a step up the contact plane from before it is put back",
        "the plane stays what the step has found (05 SU-6)",
        (Method(Transition, "step_up", _put_plane_back),),
        case="bug-step-up-restores-plane",
        output="contact_plane.d",
    ),
    KnownBug(
        "no-substep-reset",
        "sliding normal and contact plane of one sub-step are still valid in the next",
        "both are invalid at the start of every insert (05 FT-11)",
        (
            Edit(
                Transition,
                "find_transitional_position",
                (("ci.sliding_normal_valid = 0", "pass"), ("ci.forget_contact()", "pass")),
            ),
        ),
        case="bug-no-substep-reset",
        output="curr.origin.z",
    ),
    KnownBug(
        "third-step-down",
        "where two half steps down found no ground a third is made",
        "there are two (05 TI-19)",
        (
            Edit(
                Transition,
                "transitional_insert",
                ((_TWO_HALVES, f"{_TWO_HALVES} or self.step_down(height, z)"),),
            ),
        ),
        case="bug-third-step-down",
        output="curr.origin.z",
    ),
    KnownBug(
        "neg-poly-kept",
        "a collision leaves the polygon overlapped from behind noted",
        "everything but OK clears the note, COLLIDED too (05 TI-5)",
        (
            Edit(
                Transition,
                "transitional_insert",
                (
                    (
                        "if ts != TransitionState.OK:\n                sp.neg_poly_hit = 0",
                        "if ts.name in {'ADJUSTED', 'SLID'}:\n                sp.neg_poly_hit = 0",
                    ),
                    (
                        "        else:\n            sp.neg_poly_hit = 0",
                        "        elif ts != TransitionState.COLLIDED:\n            sp.neg_poly_hit = 0",
                    ),
                ),
            ),
        ),
        case="bug-neg-poly-kept",
        output="neg_poly_hit",
    ),
)
