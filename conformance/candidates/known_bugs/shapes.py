"""Mistakes about objects: which of their shapes is tested, and what touching one leaves behind."""

from __future__ import annotations

from typing import Final

from conformance.candidates.bug_candidate import KnownBug
from conformance.candidates.replacements import Edit
from oracle import physics_object_obstacle, sphere_obstacle
from oracle.cyl_sphere import CylSphere

_PARTS_ONLY: Final = """\
        return parts.find_obj_collisions(transition)
    r = TransitionState.OK
"""
_PARTS_FIRST: Final = """\
        r = parts.find_obj_collisions(transition)
        if r != TransitionState.OK:
            return r
    r = TransitionState.OK
"""

_HALF: Final = "    half = self.height * 0.5\n"
_IN_BOUNDS: Final = """\
    aside = disp.x * disp.x + disp.y * disp.y + (half - disp.z) ** 2
    if aside > ((self.radius * self.radius + half * half) ** 0.5 + check_pos.radius) ** 2:
        return False
"""

BUGS: Final = (
    KnownBug(
        "cylinder-step-up-unrotated",
        "the normal of a step up onto a cylinder is used as it is, on the world's axes",
        "it is turned by the object's rotation, although it is a world normal already (07 10.6 step 3)",
        (Edit(CylSphere, "step_sphere_up", (("path.localspace_pos.localtoglobalvec(cn)", "cn"),)),),
        case="bug-cylinder-step-up-unrotated",
        output="step_up_normal.x",
    ),
    KnownBug(
        "cylinder-by-bounds",
        "a cylinder is passed over where the ball about it and the sphere are apart",
        "level and upright distance are compared one by one, so that at the edge a sphere reaches farther"
        " than its radius (07 10.1)",
        (Edit(CylSphere, "collides_with_sphere", ((_HALF, _HALF + _IN_BOUNDS),)),),
        case="world-low-cylinder-beside-its-edge",
        output="contact_plane.d",
    ),
    KnownBug(
        "sphere-landing-dry",
        "what lands on a sphere stands on dry ground",
        "the plane on top of a sphere is marked as water (07 8.8 step 14)",
        (
            Edit(
                sphere_obstacle,
                "_rest_upon",
                (("set_contact_plane(plane, 1)", "set_contact_plane(plane, 0)"),),
            ),
        ),
        case="bug-sphere-landing-dry",
        output="contact_plane.is_water",
    ),
    KnownBug(
        "shape-fall-through",
        "where an object's BSP parts or cylinders find nothing its next family of shapes is tested",
        "exactly one family counts, also if it finds nothing: parts, else cylinders, else spheres (08 3.8)",
        (
            Edit(
                physics_object_obstacle,
                "_find_shape_collisions",
                (
                    (_PARTS_ONLY, _PARTS_FIRST),
                    ("    if parts.get_cylsphere():\n        return r\n", ""),
                ),
            ),
        ),
        case="bug-shape-fall-through",
        output="result",
    ),
)
