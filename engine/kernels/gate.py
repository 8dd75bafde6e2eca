"""The gate of a tree: what is known of it, and spares a walk the bounding spheres of its nodes.

Most nodes that a walk comes to are near enough: of a hundred bounding spheres that are tested in a room or a
dungeon, hardly one is out of reach. Where none of those tests can decide what is found, they are left out.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from engine.constants import GATE_LEAST
from engine.kernels.bsp_node import in_bounds
from engine.kernels.compile import inlined
from engine.kernels.indexing import unsigned
from engine.kernels.plan import allows
from engine.layout import GATE, GATE_RADIUS, NODE_FLOATS, PLAN_BOUNDS, SKIPPED_BOUNDS

if TYPE_CHECKING:
    from engine.kernels.types import Array, Sphere


@inlined
def unbounded(wf: Array, s: Array, root: int, sphere: Sphere) -> bool:
    """Say whether a walk passes the root's bounding sphere, and finds the same without all others.

    It does if no polygon is HIT that the bounding sphere of a node above it would have kept from being
    looked at. That is so in a tree of which `engine.compiling.enclosure` has found that

    - every polygon is inside the bounding spheres of all nodes above it but for m metres;
    - every polygon that is HIT by a sphere with a radius r from `GATE_LEAST` to the gate's has a point that
      is not farther from the centre than r - EPS + a, in exact arithmetic;
    - and a + m is not more than half of EPS.

    Then the centre c of a sphere that HITs has from the centre b of a node above, of radius R, not more than
    R + m + r - EPS + a <= R + r - EPS / 2; so that |c - b|**2 - (R + r)**2 is negative, and less than EPS for
    all that its doubles are rounded by: BN-1 passes. Where it would fail, nothing is HIT.

    What is not a HIT leaves nothing: no polygon, no movement. But it may leave a point of contact, which a
    transition never reads (03, 16), and counters of work. A centre that is not finite may be anywhere: it is
    stopped by the root's sphere, and `find_walkable` moves a sphere that HITs, back along its movement by
    2 r / EPS of it at most: where that is less than `GATE_WAY`, it stays finite. Whether a leaf is solid
    counts before its bounding sphere (SO-6): walks that ask for solid matter need all of them.

    retail: BN-1, SP-1, SP-4, FW-1, FW-4
    """
    _, _, _, r = sphere
    most = wf[unsigned(NODE_FLOATS * (root + GATE) + GATE_RADIUS)]
    if not GATE_LEAST <= r <= most or not allows(s, PLAN_BOUNDS) or not in_bounds(wf, root, sphere):
        return False
    s[SKIPPED_BOUNDS] += 1.0
    return True
