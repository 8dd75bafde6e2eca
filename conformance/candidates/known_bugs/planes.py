"""Mistakes about the space of contact planes: which pose, which point, which contact."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

from conformance.candidates.bug_candidate import KnownBug
from conformance.candidates.replacements import Edit, Method
from oracle.arithmetic import f32
from oracle.bsp_tree import BSPTree
from oracle.constants import FLOOR_Z
from oracle.enums import TransitionState
from oracle.env_cell import EnvCell
from oracle.frame import Frame
from oracle.plane import Plane
from oracle.ref import Ref
from oracle.sphere_path import SpherePath
from oracle.transition import Transition
from oracle.vector import Vector3, dot_x

if TYPE_CHECKING:
    from collections.abc import Callable

    from oracle.bsp_tree import BSPTree as Tree
    from oracle.collision_info import CollisionInfo
    from oracle.polygon import Polygon


def _forget_cell_pose(retail: Callable[[EnvCell, SpherePath], None]) -> Callable[[EnvCell, SpherePath], None]:
    def cache_local_space(self: EnvCell, path: SpherePath) -> None:
        retail(self, path)
        path.localspace_pos.frame.assign(Frame())

    return cache_local_space


def _forget_cell_rotation(
    retail: Callable[[EnvCell, SpherePath], None],
) -> Callable[[EnvCell, SpherePath], None]:
    def cache_local_space(self: EnvCell, path: SpherePath) -> None:
        retail(self, path)
        unturned = Frame()
        unturned.origin.assign(self.pos.frame.origin)
        path.localspace_pos.frame.assign(unturned)

    return cache_local_space


def _constant_from_vertex(retail: Callable[..., TransitionState]) -> Callable[..., TransitionState]:
    """Compute the constant of the plane just found again, from the first corner of its polygon."""

    def find(self: Tree, path: SpherePath, collisions: CollisionInfo, *rest: Any) -> TransitionState:
        result = retail(self, path, collisions, *rest)
        if result == TransitionState.ADJUSTED and path.walkable is not None:
            corner, scale = path.walkable.vertices[0], path.walkable_scale
            scaled = Vector3(f32(corner.x * scale), f32(corner.y * scale), f32(corner.z * scale))
            plane = collisions.contact_plane
            plane.d = f32(-dot_x(plane.N, path.check_pos.localtoglobal(path.walkable_pos, scaled)))
        return result

    return find


def _synthesise_plane(
    retail: Callable[[EnvCell, Transition], TransitionState],
) -> Callable[[EnvCell, Transition], TransitionState]:
    """Write a plane after every OK: of the walkable that the sphere overlaps, else of level land at 0 m."""

    def find_env_collisions(self: EnvCell, transition: Transition) -> TransitionState:
        result = retail(self, transition)
        tree, path = self.structure.physics_bsp, transition.sphere_path
        if result == TransitionState.OK and tree is not None:
            found = _walkable_under_foot(tree, path)
            plane = Plane(Vector3(0.0, 0.0, 1.0), 0.0)
            if found is not None:
                plane = Plane.localtoglobal(path.check_pos, self.pos, found.plane)
            transition.collision_info.set_contact_plane(plane, 0)
            transition.collision_info.contact_plane_cell_id = path.check_pos.objcell_id
        return result

    return find_env_collisions


def _walkable_under_foot(tree: Tree, path: SpherePath) -> Polygon | None:
    """Return the walkable polygon that sphere 0 overlaps (one that it only rests on is missed)."""
    probe = SpherePath()
    probe.walkable_allowance, probe.walk_interp = FLOOR_Z, 1.0
    up, found = path.localspace_z, Ref[Any](None)
    sphere, down = path.localspace_sphere[0].copy(), Vector3(-up.x, -up.y, -up.z)
    tree.root_node.find_walkable(probe, sphere, found, down, up, Ref(0))
    polygon: Polygon | None = found.value
    return polygon


BUGS: Final = (
    KnownBug(
        "cell-origin",
        "the cell call passes no rotation and no origin: what comes from the hit polygon stays in cell space",
        "planes and normals go through the cell's own position (04 LS-3; 03 SD-6, SD-9, FC-7)",
        (Method(EnvCell, "cache_local_space", _forget_cell_pose),),
        case="origin-step-down-touching",
        output="contact_plane.d",
    ),
    KnownBug(
        "cell-rotation",
        "the cell call passes its origin but no rotation: normals and offsets keep the cell's own axes",
        "planes and normals are turned by the cell's cached matrix (04 LS-3; 03 SD-6, SD-9, FC-7)",
        (Method(EnvCell, "cache_local_space", _forget_cell_rotation),),
        case="bug-cell-rotation",
        output="contact_plane.n.x",
    ),
    KnownBug(
        "walkable-synthesis",
        "after every OK of the cell's tree a plane is made up: from a search under the foot, and where that"
        " misses from the outdoor terrain",
        "an OK of the tree writes no plane; ground is looked for by stepping down (09 3.4; 05 TI-14…19)",
        (Method(EnvCell, "find_env_collisions", _synthesise_plane),),
        case="bug-walkable-synthesis",
        output="contact_plane.d",
    ),
    KnownBug(
        "vertex-plane",
        "the plane's constant comes from the polygon's first corner, scaled by itself and taken to the world",
        "it comes from the foot of the perpendicular, and the finished constant is multiplied by the scale"
        " (01 PL-1…4; 03 SD-9, FC-7)",
        (
            Method(BSPTree, "step_sphere_down", _constant_from_vertex),
            Method(BSPTree, "_find_landing", _constant_from_vertex),
        ),
        case="step-down-scaled-static",
        output="contact_plane.d",
    ),
    KnownBug(
        "renormalised-plane",
        "the plane's normal is normalised again after it was turned to the world",
        "the turned normal is used as it is, a last bit off unit length (01 PL-2, PL-4)",
        (Edit(Plane, "localtoglobal", (("g = to.", "n.normalize()\n    g = to."),)),),
        case="bug-renormalised-plane",
        output="contact_plane.n.y",
    ),
    KnownBug(
        "last-known-cell",
        "seeding only the last known plane writes the cell's id beside that plane",
        "the id goes to the contact plane's field; the last known plane's own stays stale"
        " (04 5, init_last_known_contact_plane; 06 GO-5)",
        (
            Edit(
                Transition,
                "init_last_known_contact_plane",
                (("ci.contact_plane_cell_id", "ci.last_known_contact_plane_cell_id"),),
            ),
        ),
        case="bug-last-known-cell",
        output="tick 1: contact_plane_cell",
    ),
)
