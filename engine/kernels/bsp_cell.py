"""Containment in a cell (03, 8): a chain of planes, the inside in front of each.

``at`` is the offset of the outermost plane in the world's floats, `count` the length of the chain.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from engine.constants import CELL_SLACK, ENTIRELY_INSIDE, EPS, OUTSIDE, PARTIALLY_INSIDE
from engine.kernels.compile import entry
from engine.kernels.polygon import plane_distance
from engine.kernels.rounding import f32
from engine.layout import PLANE_SIZE

if TYPE_CHECKING:
    from engine.kernels.types import Array


@entry
def point_inside_cell_bsp(wf: Array, at: int, count: int, x: float, y: float, z: float) -> bool:
    """Say whether a point is not farther than EPS behind any plane.

    retail: BSPNODE::point_inside_cell_bsp 0x0053C1F0, 03 8.1
    """
    for i in range(count):
        if not plane_distance(wf, at + PLANE_SIZE * i, x, y, z) >= -EPS:
            return False
    return True


@entry
def sphere_intersects_cell_bsp(wf: Array, at: int, count: int, x: float, y: float, z: float, r: float) -> int:
    """Say whether a sphere, enlarged by CELL_SLACK, is outside, partly or entirely inside.

    The first plane after entry, or after a straddled one, is compared with the unrounded sum of the
    radius, the others with the stored one.

    retail: BSPNODE::sphere_intersects_cell_bsp 0x0053C260, SC-1...SC-4
    """
    stored = f32(r + CELL_SLACK)
    reach = r + CELL_SLACK
    answer = ENTIRELY_INSIDE
    for i in range(count):
        dist = plane_distance(wf, at + PLANE_SIZE * i, x, y, z)
        if dist <= -reach:
            return OUTSIDE
        if dist < reach:
            answer = PARTIALLY_INSIDE
            reach = r + CELL_SLACK
        else:
            reach = stored
    return answer
