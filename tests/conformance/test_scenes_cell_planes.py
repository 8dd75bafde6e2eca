"""Containment planes of cells face inwards."""

from __future__ import annotations

import pytest

from conformance.scenes.cell_planes import box_planes, convex_planes
from conformance.scenes.errors import SceneError
from conformance.scenes.planes import signed_distance
from conformance.scenes.primitives import Opening, box, room


def test_box_planes() -> None:
    """Two planes an axis, low side first, without negative zeros."""
    planes = box_planes((-1.0, 0.0, 2.0), (1.0, 4.0, 5.0))
    assert planes == (
        (1.0, 0.0, 0.0, 1.0),
        (-1.0, 0.0, 0.0, 1.0),
        (0.0, 1.0, 0.0, 0.0),
        (0.0, -1.0, 0.0, 4.0),
        (0.0, 0.0, 1.0, -2.0),
        (0.0, 0.0, -1.0, 5.0),
    )
    assert "-0.0" not in repr(planes)


def test_empty_box() -> None:
    """A box has an extent along every axis."""
    with pytest.raises(SceneError) as raised:
        box_planes((0.0, 1.0, 0.0), (1.0, 1.0, 1.0))
    assert raised.value.path == "y"


def test_a_rooms_planes_are_its_boxs() -> None:
    """Each plane of a room once, also where openings cut a wall to pieces."""
    shape = room(size=(4.0, 5.0, 3.0), openings=[Opening("north", 1.0, 2.0)])
    planes = convex_planes(shape)
    assert set(planes) == set(box_planes((-2.0, -2.5, 0.0), (2.0, 2.5, 3.0)))
    assert len(planes) == 6
    assert all(signed_distance(plane, (0.0, 0.0, 1.0)) > 0.0 for plane in planes)


def test_outward_faces_contain_nothing() -> None:
    """A solid box is not a room."""
    with pytest.raises(SceneError, match="faces inwards"):
        convex_planes(box(size=(1.0, 1.0, 1.0)))
