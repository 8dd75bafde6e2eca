"""Translation: the same room farther and farther out.

Retail keeps coordinates within a landblock, so little of this happens to it; ports that drop landblocks for
one global frame are at the far end.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Final

from conformance.floats import to_float32
from conformance.scenes.algebra import add, dot, round_point, scale, subtract
from conformance.scenes.model import Leaf, Node
from conformance.scenes.rotations import round_quaternion
from conformance.stress.asking import ErrorSweep
from conformance.stress.effect import Effect
from conformance.stress.moves import furnished_room, room_moves, room_query
from conformance.stress.sweep import Probe

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from conformance.scenes.model import Geometry, SphereData, Tree, Vec3
    from conformance.stress.settings import Settings

FAMILY: Final = "translation"
AXIS: Final = "distance from the origin (m)"
DISTANCES: Final = (0.0, *(digit * 10.0**power for power in range(6) for digit in (1, 2, 5)), 1e6)
"""Metres."""
DIRECTION: Final[Vec3] = (0.6875, 0.5625, 0.4609375)
"""Where to: oblique, about of unit length; sums of few powers of two, so that 0 m is exact."""
YAW: Final = round_quaternion((0.9375, 0.0, 0.0, 0.348))
"""How the cell is turned, about z: no wall is along an axis."""


def sweeps(settings: Settings) -> Sequence[ErrorSweep]:
    """Return the family."""
    geometry = furnished_room()
    severities = settings.thinned(DISTANCES)

    def posed(distance: float) -> Iterator[Probe]:
        """Put the cell's pose far out; its geometry is about its own origin, as in the game's files."""
        origin = round_point(scale(distance, DIRECTION))
        for move in room_moves(geometry, settings.seed, settings.probes):
            at_home = room_query(move, geometry, rotation=YAW)
            query = room_query(move, geometry, rotation=YAW, origin=origin)
            yield Probe(query, Effect(at_home, origin))

    def modelled(distance: float) -> Iterator[Probe]:
        """Put the vertices far out, in a cell at the origin: a whole dungeon as one mesh."""
        far = round_point(scale(distance, DIRECTION))
        moved = shifted(geometry, far)
        for move in room_moves(geometry, settings.seed, settings.probes):
            at_home = room_query(move, geometry)
            yield Probe(room_query(move, moved, within=far), Effect(at_home, far))

    return (
        ErrorSweep(FAMILY, "pose", AXIS, severities, posed),
        ErrorSweep(FAMILY, "vertices", AXIS, severities, modelled),
    )


def shifted(geometry: Geometry, by: Vec3) -> Geometry:
    """Return a geometry moved within its own frame, tree included, every number rounded to float32."""
    vertices = tuple(round_point(add(vertex, by)) for vertex in geometry.vertices)
    return replace(geometry, name="shifted", vertices=vertices, tree=_shifted_tree(geometry.tree, by))


def _shifted_tree(tree: Tree, by: Vec3) -> Tree:
    if isinstance(tree, Leaf):
        return replace(tree, sphere=_shifted_sphere(tree.sphere, by))
    normal = tree.plane[:3]
    return Node(
        (*normal, to_float32(tree.plane[3] - dot(normal, by))),
        _shifted_sphere(tree.sphere, by),
        tree.polygons,
        _shifted_tree(tree.positive, by),
        _shifted_tree(tree.negative, by),
    )


def _shifted_sphere(sphere: SphereData, by: Vec3) -> SphereData:
    """Move a bounding sphere; it grows by what rounding may have moved it, or it would no longer bound."""
    there = add(sphere[:3], by)
    rounded = round_point(there)
    slack = 2.0 * max(abs(part) for part in subtract(rounded, there))
    x, y, z = rounded
    return (x, y, z, to_float32(sphere[3] + slack))
