"""Doorways between cells: the polygon of an opening, the matching opening next door, and the sides.

A doorway is written once and cut into the rooms on both sides of it.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from conformance.scenes.algebra import add, dot, scale, subtract
from conformance.scenes.errors import SceneError
from conformance.scenes.planes import plane_of, signed_distance
from conformance.scenes.polygons import place
from conformance.scenes.primitives import Opening, opening_corners, room_faces
from conformance.scenes.rotations import rotate, rows_from_quaternion

if TYPE_CHECKING:
    from collections.abc import Sequence

    from conformance.scenes.model import PlaneData, Pose, Vec3
    from conformance.scenes.polygons import Corners
    from conformance.scenes.rectangles import Rectangle, Span

TOUCH: Final = 1e-3
"""How far apart the walls of two rooms may be for a doorway to go through both, metres."""
NORTH_SOUTH: Final = frozenset({"north", "south"})
"""Sides that run along x."""


def opening_polygon(size: Sequence[float], opening: Opening, at: Vec3, yaw: float) -> Corners:
    """Return an opening of a room as a polygon that faces into the room.

    Parameters
    ----------
    size : (float, float, float)
        Of the room, metres.
    opening : Opening
        In one of its sides.
    at : Vec3
    yaw : float
        How the room is placed in its cell: metres and degrees.

    Raises
    ------
    SceneError
        The opening reaches beyond its side.
    """
    face = room_faces(size)[opening.side]
    across, up = face.hole_between(*opening_corners(opening, ""), "")
    (polygon,) = place([face.part(across, up)], at, yaw)
    return polygon


def carried(polygon: Corners, first: Pose, second: Pose) -> Corners:
    """Return a polygon of one cell's space in that of another, whose pose is in the same landblock."""
    rows = rows_from_quaternion(first.rotation)
    columns = rows_from_quaternion(second.rotation)
    placed = [add(rotate(rows, corner), first.origin) for corner in polygon]
    offsets = [subtract(point, second.origin) for point in placed]
    return tuple((dot(columns[0], o), dot(columns[1], o), dot(columns[2], o)) for o in offsets)


def matching_opening(polygon: Corners, size: Sequence[float], at: Vec3, yaw: float) -> Opening:
    """Return the opening of a room that a polygon fills.

    Parameters
    ----------
    polygon : Corners
        A rectangle in the space of the room's cell.
    size, at, yaw
        The room and how it is placed; see `opening_polygon`.

    Raises
    ------
    SceneError
        It lies in none of the room's sides, or askew.
    """
    (corners,) = place(place([polygon], scale(-1.0, at), 0.0), (0.0, 0.0, 0.0), -yaw)
    for side, face in room_faces(size).items():
        opening = _in_face(corners, side, face)
        if opening is not None:
            return opening
    raise SceneError("", "no wall of the other room where the doorway is", "a room that touches it there")


def side_of(polygon: Corners, planes: Sequence[PlaneData]) -> int:
    """Return which side of a portal's polygon a cell is on.

    Parameters
    ----------
    polygon : Corners
        In cell space.
    planes : sequence of PlaneData
        The cell's containment planes, their fronts inside.

    Returns
    -------
    int
        Portal side: 0 if the polygon faces into the cell, else 1.

    Raises
    ------
    SceneError
        None of the planes is the polygon's own.
    """
    plane = plane_of(polygon)
    for inside in planes:
        if all(abs(signed_distance(inside, corner)) <= TOUCH for corner in polygon):
            return 0 if dot(plane[:3], inside[:3]) > 0.0 else 1
    raise SceneError("", "a polygon inside the volume that the cell contains", "'side', 0 or 1")


def _in_face(corners: Corners, side: str, face: Rectangle) -> Opening | None:
    """Return the opening in one face, if the rectangle lies in it."""
    normal = plane_of(face.whole()[0])
    if any(abs(signed_distance(normal, corner)) > TOUCH for corner in corners):
        return None
    offsets = [subtract(corner, face.corner) for corner in corners]
    us, vs = [dot(face.u, o) for o in offsets], [dot(face.v, o) for o in offsets]
    # Askew, the rectangle's corners are not those of its extent.
    askew = any(min(abs(u - min(us)), abs(u - max(us))) > TOUCH for u in us)
    across, up = _snapped((min(us), max(us)), face.width), _snapped((min(vs), max(vs)), face.height)
    if askew or across is None or up is None:
        return None
    return _opening(side, face.point(across[0], up[0]), face.point(across[1], up[1]))


def _snapped(span: Span, limit: float) -> Span | None:
    """Return a span with its ends on the wall's edges where they touch them; None if it reaches beyond."""
    low, high = span
    if low < -TOUCH or high > limit + TOUCH:
        return None
    return (0.0 if low < TOUCH else low, limit if high > limit - TOUCH else high)


def _opening(side: str, low: Vec3, high: Vec3) -> Opening:
    x, y, _ = scale(0.5, add(low, high))
    width, depth, height = (abs(a - b) for a, b in zip(low, high, strict=True))
    if side in {"floor", "ceiling"}:
        return Opening(side, width, depth, x, y)
    sill = min(low[2], high[2])
    return (
        Opening(side, width, height, x, sill)
        if side in NORTH_SOUTH
        else Opening(side, depth, height, y, sill)
    )
