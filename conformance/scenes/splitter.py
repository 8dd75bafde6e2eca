"""The choice of the plane that splits a region."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final, NamedTuple

import numpy as np

from conformance.floats import to_float32
from conformance.scenes.pieces import ON_PLANE, UNUSED, extent

if TYPE_CHECKING:
    from collections.abc import Sequence

    from conformance.scenes.model import PlaneData
    from conformance.scenes.pieces import Floats, Piece

CANDIDATES: Final = 16
"""Polygons whose planes are tried in a region; more cost more than they gain."""
MANY: Final = 32
"""From this many unused polygons on, axis-parallel planes are tried too: only they keep the tree of a
convex hull, or of scattered triangles, from becoming as deep as it has polygons."""
CUT_COST: Final = 8
"""What a cut polygon weighs against one polygon of imbalance."""
LARGEST_SHARE: Final = 0.75
"""The share of the polygons that an axis-parallel plane may leave on one side; else it gains nothing."""


class Splitter(NamedTuple):
    """A splitting plane, and the polygon it comes from (None for an axis-parallel one)."""

    plane: PlaneData
    owner: int | None


def choose(pieces: Sequence[Piece], planes: Sequence[PlaneData]) -> Splitter | None:
    """Choose the plane that cuts least and balances best; the first of equals.

    Parameters
    ----------
    pieces : sequence of Piece
        What is in the region.
    planes : sequence of PlaneData
        The plane of every polygon.

    Returns
    -------
    Splitter or None
        None when every polygon has been on a splitting plane: the region is a leaf.
    """
    unused = [piece for piece in pieces if piece.side == UNUSED]
    if not unused:
        return None
    step = max(1, len(unused) // CANDIDATES)
    candidates = [Splitter(planes[piece.polygon], piece.polygon) for piece in unused[::step]]
    if len(unused) >= MANY:
        candidates += [Splitter(plane, None) for plane in _halving_planes(unused)]
    costs = _costs(unused, candidates)
    return candidates[int(np.argmin(costs))]


def _halving_planes(pieces: Sequence[Piece]) -> list[PlaneData]:
    """Return the planes at right angles to x, y and z with half of the pieces' first corners on each side.

    Corners rather than middles: a plane through corners of a mesh runs between its polygons.
    """
    middles = np.median(np.array([piece.points[0] for piece in pieces]), axis=0)
    x, y, z = (to_float32(-value) + 0.0 for value in middles)
    return [(1.0, 0.0, 0.0, x), (0.0, 1.0, 0.0, y), (0.0, 0.0, 1.0, z)]


def _costs(pieces: Sequence[Piece], candidates: Sequence[Splitter]) -> Floats:
    lowest, highest = extent(pieces, np.array([candidate.plane for candidate in candidates]))
    ahead = (highest > ON_PLANE).sum(axis=0)
    behind = (lowest < -ON_PLANE).sum(axis=0)
    cuts = ((highest > ON_PLANE) & (lowest < -ON_PLANE)).sum(axis=0)
    costs: Floats = (CUT_COST * cuts + np.abs(ahead - behind)).astype(np.float64)
    # An axis-parallel plane has no polygon of its own to use up: it must at least part the others.
    idle = (np.minimum(ahead, behind) == 0) | (np.maximum(ahead, behind) > LARGEST_SHARE * len(pieces))
    costs[idle & np.array([candidate.owner is None for candidate in candidates])] = np.inf
    return costs
