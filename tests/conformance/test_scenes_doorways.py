"""Doorways: the polygon of an opening, the same opening next door, and which side a cell is on."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from conformance.scenes.cell_planes import box_planes, convex_planes
from conformance.scenes.doorways import carried, matching_opening, opening_polygon, side_of
from conformance.scenes.errors import SceneError
from conformance.scenes.model import Pose
from conformance.scenes.planes import plane_of
from conformance.scenes.primitives import SIDES, Opening, room
from conformance.scenes.rotations import yaw_quaternion

SIZE = (6.0, 4.0, 3.0)
OPPOSITE = {
    "north": "south",
    "south": "north",
    "east": "west",
    "west": "east",
    "floor": "ceiling",
    "ceiling": "floor",
}
BESIDE = {
    "north": (0.0, 4.0, 0.0),
    "south": (0.0, -4.0, 0.0),
    "east": (6.0, 0.0, 0.0),
    "west": (-6.0, 0.0, 0.0),
    "floor": (0.0, 0.0, -3.0),
    "ceiling": (0.0, 0.0, 3.0),
}
NOWHERE = (0.0, 0.0, 0.0)


def test_an_opening_as_a_polygon() -> None:
    """By hand: a door in the north wall, then in a room that is turned and moved."""
    door = Opening("north", 1.0, 2.0, offset=0.5)
    polygon = opening_polygon(SIZE, door, NOWHERE, 0.0)
    assert polygon == ((0.0, 2.0, 0.0), (1.0, 2.0, 0.0), (1.0, 2.0, 2.0), (0.0, 2.0, 2.0))
    turned = opening_polygon(SIZE, door, (10.0, 0.0, 1.0), 90.0)
    assert turned == ((8.0, 0.0, 1.0), (8.0, 1.0, 1.0), (8.0, 1.0, 3.0), (8.0, 0.0, 3.0))


@pytest.mark.parametrize("side", SIDES)
def test_an_opening_faces_into_its_room(side: str) -> None:
    """So the portal's side is 0 here, and 1 for the room next door."""
    polygon = opening_polygon(SIZE, Opening(side, 1.0, 1.0, sill=0.5), NOWHERE, 0.0)
    here = convex_planes(room(size=SIZE))
    assert side_of(polygon, here) == 0
    assert side_of(polygon[::-1], here) == 1
    x, y, z = BESIDE[side]
    there = box_planes((x - 3.0, y - 2.0, z), (x + 3.0, y + 2.0, z + 3.0))
    assert side_of(polygon, there) == 1


def test_a_side_needs_a_plane() -> None:
    """A polygon across a cell is on neither side."""
    polygon = opening_polygon(SIZE, Opening("north", 1.0, 1.0), (0.0, -1.0, 0.0), 0.0)
    with pytest.raises(SceneError, match="inside the volume"):
        side_of(polygon, convex_planes(room(size=SIZE)))


@pytest.mark.parametrize("side", SIDES)
def test_the_room_next_door_has_the_same_opening(side: str) -> None:
    """It is found in the opposite side, as large and at the same place."""
    opening = Opening(side, 1.0, 1.5, offset=0.25, sill=0.75)
    polygon = opening_polygon(SIZE, opening, NOWHERE, 0.0)
    found = matching_opening(polygon, SIZE, BESIDE[side], 0.0)
    assert found.side == OPPOSITE[side]
    assert (found.width, found.height, found.offset, found.sill) == pytest.approx(
        (opening.width, opening.height, opening.offset, opening.sill)
    )


@given(
    st.floats(-180.0, 180.0),
    st.floats(-180.0, 180.0),
    st.floats(0.2, 5.0),
    st.floats(0.2, 2.5),
    st.floats(-0.5, 0.5),
)
def test_a_doorway_between_turned_rooms(
    first_yaw: float, second_yaw: float, width: float, height: float, offset: float
) -> None:
    """However two cells and the room in the second are turned, both openings are one polygon."""
    first = Pose(1, (100.0, 50.0, 94.0), yaw_quaternion(first_yaw))
    second = Pose(1, (90.0, 55.0, 93.0), yaw_quaternion(second_yaw))
    polygon = opening_polygon(SIZE, Opening("north", width, height, offset), NOWHERE, 0.0)
    # The second room, in the first cell's space, stands north of the first one and is turned half around.
    (middle,) = carried(((0.0, 4.0, 0.0),), first, second)
    yaw = first_yaw - second_yaw + 180.0
    there = carried(polygon, first, second)
    found = matching_opening(there, SIZE, middle, yaw)
    assert found.side == "north"
    back = opening_polygon(SIZE, found, middle, yaw)
    plane, other = plane_of(polygon), plane_of(carried(back, second, first))
    assert other == pytest.approx(tuple(-part for part in plane), abs=1e-4)
    for corner in carried(back, second, first):
        assert min(max(abs(a - b) for a, b in zip(corner, mine, strict=True)) for mine in polygon) < 1e-3


@pytest.mark.parametrize(
    "polygon",
    [
        ((0.0, 2.5, 0.0), (1.0, 2.5, 0.0), (1.0, 2.5, 2.0), (0.0, 2.5, 2.0)),
        ((2.5, 2.0, 0.0), (3.5, 2.0, 0.0), (3.5, 2.0, 2.0), (2.5, 2.0, 2.0)),
        ((0.0, 2.0, 0.5), (0.5, 2.0, 0.0), (1.0, 2.0, 0.5), (0.5, 2.0, 1.0)),
    ],
)
def test_a_doorway_that_does_not_fit(polygon: tuple[tuple[float, float, float], ...]) -> None:
    """Off the wall, beyond its end, askew in it."""
    with pytest.raises(SceneError, match="no wall of the other room"):
        matching_opening(polygon, SIZE, NOWHERE, 0.0)
