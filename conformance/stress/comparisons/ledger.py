"""Every comparison of documents 02 to 05, and the square that asks on both of its sides, or why none does.

Sites are found in the oracle's source (`conformance.stress.comparisons.sites`); a test compares.
"""

from __future__ import annotations

from collections.abc import Mapping
from enum import Enum
from typing import TYPE_CHECKING, Final, NamedTuple, TypeAlias

from conformance.stress.comparisons.sites import Site

if TYPE_CHECKING:
    from collections.abc import Iterator


class Kind(Enum):
    """Why no square is drawn; `conformance.stress.comparisons.page` tells it in full."""

    WHOLE = "whole numbers"
    BITS = "a bit pattern"
    ALIKE = "the same on both sides"
    BEFORE = "decided before"
    ELSEWHERE = "not asked by moves"


class Reason(NamedTuple):
    """Why a comparison has no square.

    Attributes
    ----------
    kind : Kind
        In a word.
    text : str
        In full.
    """

    kind: Kind
    text: str


Entry: TypeAlias = str | Reason
"""The name of a square, or a reason."""
Entries: TypeAlias = Mapping[str, Mapping[str, Entry]]
"""Entries by function (module and qualified name) and comparison."""


def _whole(text: str) -> Reason:
    return Reason(Kind.WHOLE, text)


def _before(text: str) -> Reason:
    return Reason(Kind.BEFORE, text)


def _alike(text: str) -> Reason:
    return Reason(Kind.ALIKE, text)


_ZERO: Final = Reason(
    Kind.BITS, "a move of nothing is one of exactly nothing: the difference of two float32s"
)

POLYGONS: Final[Entries] = {
    "polygon.Polygon.point_in_poly2D": {
        "s > 0.0": "point at an edge, in plan",
        "s < 0.0": "point at an edge, in plan from below",
    },
    "polygon.Polygon.point_in_polygon": {"s < 0.0": "point at an edge"},
    "polygon.Polygon.adjust_sphere_to_poly": {
        "abs(dist0) < check_pos.radius": "touching at the start",
        "abs(v) < EPS": "movement that never arrives",
        "dist0 <= 0.0": "side of the start",
    },
    "polygon.Polygon.adjust_sphere_to_plane": {
        "v > EPS": "movement level within EPS, upwards",
        "v >= -EPS": "movement level within EPS",
        "w >= path.walk_interp": "plane not yet reached",
        "w32 < LEAST_WALK_INTERP": "walk_interp at its limit",
    },
    "polygon.Polygon.polygon_hits_sphere": {"rad < abs(dist)": "plane at the radius, quickly"},
    "polygon.Polygon.polygon_hits_sphere_slow_but_sure": {"rad < abs(dist)": "plane in front at the radius"},
    "polygon.Polygon.pos_hits_sphere": {"dot_x(movement, self.plane.N) >= 0.0": "movement along the plane"},
    "polygon.Polygon.walkable_hits_sphere": {
        "dot_x(self.plane.N, up) > path.walkable_allowance": "slope at the allowance"
    },
    "polygon.Polygon.find_crossed_edge": {
        "abs(v) < EPS": "up along the plane, beside it",
        "side < 0.0": "foot point at an edge",
    },
    "polygon.Polygon.adjust_to_placement_poly": {"dist <= 0.0": "side of what is placed"},
    "polygon.Polygon.polygon_hits_ray": {
        "dot_x(ray.dir, self.plane.N) > 0.0": Reason(
            Kind.ELSEWHERE,
            "picking alone; rays within EPS of the plane's direction miss it either way (HR-2)",
        )
    },
    "polygon.Polygon._stands_on": {"abs(v) < EPS": "up along the plane"},
    "polygon_edges.reached_edge_by_edge": {
        "side < 0.0": "foot without extent at an edge",
        "cross2 * rsq < side * side": "edge at the radius",
        "0.0 <= along <= ez32 * ez32 + ey * ey + ex * ex": _alike(
            "at an end of an edge a point is as far from the edge as from the corner, which is asked next"
        ),
        "qz32 * qz32 + qy * qy + qx * qx <= rsq": "corner at the radius",
    },
}
"""Document 02."""

TREES: Final[Entries] = {
    "bsp_node.BSPNode.only_child_in_reach": {
        "dist >= reach": "in front of a node only",
        "dist <= -reach": "behind a node only",
    },
    "bsp_node.BSPNode.sphere_intersects_solid": {"dist < 0.0": "side of a centre"},
    "bsp_node.BSPNode.sphere_intersects_solid_poly": {"dist < 0.0": "side of a placed centre"},
    "bsp_node.BSPNode.point_intersects_solid": {
        "dot_x(self.splitting_plane.N, point) + self.splitting_plane.d < 0.0": "side of a node"
    },
    "bsp_node.BSPNode.point_inside_cell_bsp": {"dist >= -EPS": "point in a cell"},
    "bsp_node.BSPNode.sphere_intersects_cell_bsp": {
        "dist <= -rad": "sphere reaching a cell",
        "dist < rad": "sphere inside a cell",
    },
    "bsp_tree_placement.placement_insert": {"i >= PLACEMENT_TRIES": _whole("tries are counted")},
    "bsp_tree_steps.adjust_to_plane": {
        "t == 1.0": Reason(
            Kind.BITS, "1.0 is what adjust_sphere_to_poly answers if the sphere touches at once (AP-2)"
        ),
        "n >= ADJUST_TRIES": _whole("tries are counted"),
        "hi - lo < ADJUST_BRACKET": "bracket of a search",
        "n >= ADJUST_TRIES #2": _whole("tries are counted"),
    },
}
"""Document 03."""

STATES: Final[Entries] = {
    "cell_array.CellArray.add_cell": {"entry.cell_id == cell_id": _whole("cell ids")},
    "cell_array.CellArray.remove_cell": {"index < len(self.cells)": _whole("an index")},
    "frame.Frame.is_equal": {
        f"abs(self.q{axis} - other.q{axis}) < EPS": f"rotations equal within EPS, {axis}" for axis in "wxyz"
    },
    "object_info.ObjectInfo.is_valid_walkable": {"n.z >= FLOOR_Z": "ground at floor_z"},
    "object_info.ObjectInfo.missile_ignore": {"other.id == self.targetID": _whole("object ids")},
    "object_info.ObjectInfo.validate_walkable": {
        "distance >= -EPS": "ground entered",
        "distance > EPS": "ground out of touch",
        "w >= path.walk_interp": _before(
            "the sphere is in the ground by EPS and more (VW-11): w grows only where the ground faces down, "
            "and is endless where that turns"
        ),
        "w < WALK_INTERP_LOWEST": "step that ends in the ground",
    },
    "object_info.ObjectInfo._validate_viewer": {
        "distance > -EPS": "camera at the ground",
        "t <= 0.0": _before("the distance is EPS and more (VW-2): t changes its sign where it is endless"),
        "t > 1.0": "camera that began in the ground",
        "begin.objcell_id & 65535 >= FIRST_INTERIOR_CELL": _whole("a cell id"),
    },
    "sphere_path.SpherePath.adjust_check_pos": {"cell_id & 65535 < FIRST_INTERIOR_CELL": _whole("a cell id")},
    "sphere_path.SpherePath.is_walkable_allowable": {
        "z > self.walkable_allowance": "slope of a sphere that is landed on"
    },
    "sphere_path.SpherePath.precipice_slide": {
        "t > 0.0": _before(
            "the way has led out over the edge (FE-3), against its inner normal: it turns for a way along an"
            " edge alone that the foot was already beyond"
        )
    },
    "vector.Vector3.differs": {
        f"abs(self.{axis} - other.{axis}) > EPS": f"velocities equal within EPS, {axis}" for axis in "xyz"
    },
}
"""Document 04."""

TRANSITIONS: Final[Entries] = {
    "transition_insert.check_other_cells": {
        "index < self.cell_array.num_cells": _whole("an index"),
        "p.objcell_id & 65535 < FIRST_INTERIOR_CELL": _whole("a cell id"),
    },
    "transition_insert.transitional_insert": {
        "radius + radius < height": "step down of one sphere",
        "radius + radius >= height": "step down in halves",
    },
    "transition_path.find_transitional_position": {
        "i == num_steps - 1": _whole("sub-steps are counted"),
        "length > EPS": _before(
            "of a camera's shorter way there are no sub-steps (NS-4): the same sum, in another order"
        ),
        "squared_length(sp.global_offset) < EPS2": "move too short",
    },
    "transition_path.calc_num_steps": {
        "length <= EPS": "camera that does not move",
        "q > 1.0": "one sub-step",
        "x != 0.0": _ZERO,
        "y != 0.0": _ZERO,
        "z != 0.0": _ZERO,
    },
    "transition_path.adjust_offset": {
        "o.z * s.z + o.y * s.y + o.x * s.x < 0.0": "against the sliding normal",
        "p <= 0.0": _alike(
            "a way along the plane stays as it is, whichever way it is put there, but for its last bit"
        ),
        "distance < radius - EPS": "deep enough to be lifted",
        "radius > abs(h)": "plane too steep to be lifted",
    },
    "transition_placement._put_on_ground": {
        "radius + radius < height": "way down of one sphere",
        "radius + radius >= height": "way down in halves",
    },
    "transition_placement.find_placement_pos": {
        "radius < SMALL_RADIUS": "rings of the thin",
        "radius < RING_RADIUS": _alike("a smaller radius becomes the limit itself"),
        "q <= 1.0": "rings of a giant",
        "squared_length(sp.global_offset) >= EPS2": "rings of a mote",
    },
    "transition_step.step_down": {"ci.contact_plane.N.z >= z": "ground too steep to step down to"},
    "transition_step.check_walkable": {
        "h > radius + radius": "probe of one sphere",
        "h > radius + radius #2": "probe of two spheres",
    },
    "transition_step.edge_slide": {
        "ci.contact_plane.N.z < z": _before(
            "SD-4 has compared the same normal with the same limit,"
            " near which it refuses no ground but for other reasons"
        )
    },
    "transition_step.cliff_slide": {"k <= 0.0": "way along a crease"},
    "transition_validate.validate_transition": {
        "sp.check_pos.objcell_id == sp.curr_pos.objcell_id": _whole("cell ids")
    },
    "transition_validate._adopt_last_known_plane": {
        "sp.global_sphere[0].radius + EPS > abs(distance)": "last known plane near enough"
    },
}
"""Document 05."""


def entries() -> Iterator[tuple[Site, Entry]]:
    """Yield every comparison that is listed, with its square or reason, in the order of the documents."""
    for listed in (POLYGONS, TREES, STATES, TRANSITIONS):
        for where, texts in listed.items():
            module, function = where.split(".", 1)
            yield from ((Site(module, function, text), entry) for text, entry in texts.items())
