"""Mistakes about what a sphere overlaps: bounding spheres, polygons, the sphere that is tested."""

from __future__ import annotations

from inspect import unwrap
from typing import TYPE_CHECKING, Any, Final

from conformance.candidates.bug_candidate import KnownBug
from conformance.candidates.replacements import Edit, Method, edited, with_globals
from oracle.bsp_tree import BSPTree
from oracle.enums import TransitionState
from oracle.polygon import Polygon
from oracle.polygon_edges import reached_edge_by_edge
from oracle.ref import Ref
from oracle.sphere import Sphere
from oracle.trace import initial_placement, traced

if TYPE_CHECKING:
    from collections.abc import Callable
    from types import FunctionType

    from oracle.transition import Transition
    from oracle.vector import Vector3


def _end_at_first_missed_edge(retail: FunctionType) -> FunctionType:
    """Make the walkable checks return at once where the loop over the edges would go on."""
    at_once = edited(reached_edge_by_edge, ("result = 0\n", "return 0\n"))
    return with_globals(retail, reached_edge_by_edge=at_once)


def _test_second_sphere(retail: Callable[..., TransitionState]) -> Callable[..., TransitionState]:
    def find_path_clipped(
        self: BSPTree, transition: Transition, movement: Vector3, scale: float
    ) -> TransitionState:
        path = transition.sphere_path
        result = retail(self, transition, movement, scale)
        if result != TransitionState.OK or path.num_sphere <= 1:
            return result
        struck = Ref[Any](None)
        self.root_node.sphere_intersects_poly(path.localspace_sphere[1], movement, struck, Ref(None))
        if struck.value is None:
            return result
        normal = path.localspace_pos.localtoglobalvec(struck.value.plane.N)
        transition.collision_info.set_collision_normal(normal)
        return TransitionState.COLLIDED

    return find_path_clipped


def _keep_polygon(retail: Any) -> Any:
    kept = edited(
        unwrap(retail),
        ("            hit_poly.value = None\n            r = sA.radius\n", ""),
    )
    return traced(initial_placement)(kept)


BUGS: Final = (
    KnownBug(
        "strict-sphere",
        "a bounding sphere is met only if the squared gap is below zero",
        "a gap below F_EPSILON counts (01 3.1)",
        (Edit(Sphere, "intersects", (("gap < EPS", "gap < 0.0"),)),),
        case="bounding-sphere-last-hit",
        output="r",
    ),
    KnownBug(
        "signed-walkable",
        "check_walkable refuses polygons that face down: it compares N.up with F_EPSILON, not its size",
        "only a polygon along the up direction is refused: the size of N.up is compared (02 CW-1)",
        (Edit(Polygon, "_stands_on", (("abs(v) < EPS", "v < EPS"),)),),
        case="check-walkable-underside",
        output="r",
    ),
    KnownBug(
        "edge-test-early-return",
        "check_walkable answers no at the first edge whose end was missed",
        "the corner and the other edges are still looked at (02 CW-6)",
        (Method(Polygon, "_stands_on", _end_at_first_missed_edge),),
        case="check-walkable-goes-on-past-a-segment",
        output="r",
    ),
    KnownBug(
        "path6b-second-sphere",
        "a path-clipped mover is also stopped by what its second sphere overlaps",
        "sphere 1 is never tested on this path (03 FC-15)",
        (Method(BSPTree, "_find_path_clipped", _test_second_sphere),),
        case="clipped-second-sphere-is-never-tested",
        output="result",
    ),
    KnownBug(
        "placement-keeps-polygon",
        "an initial placement keeps the old hit polygon and the doubled radius after a push",
        "both are reset after every push (03 PI-3, PI-6)",
        (Method(BSPTree, "placement_insert", _keep_polygon),),
        case="bug-placement-keeps-polygon",
        output="check.origin.x",
    ),
)
