"""Primitives have the corners, the facing and the surface that they promise."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import pytest
from brute_force import minus, normal_of

from conformance.scenes.algebra import dot, length
from conformance.scenes.errors import SceneError
from conformance.scenes.planes import area_vector
from conformance.scenes.polygons import merge, place
from conformance.scenes.primitives import (
    PRIMITIVES,
    Opening,
    box,
    ceiling,
    doorway,
    explicit,
    floor,
    hatch,
    make,
    pillar,
    ramp,
    room,
    stairs,
    wall,
)
from conformance.scenes.validate import shape_errors

if TYPE_CHECKING:
    from conformance.scenes.polygons import Shape

EXAMPLES: dict[str, dict[str, Any]] = {
    "floor": {"size": (4, 2), "tiles": (2, 3)},
    "ceiling": {"size": (4, 2), "height": 2.5, "tiles": (3, 1)},
    "wall": {"length": 4, "height": 2},
    "doorway": {"length": 4, "height": 3, "door_width": 1, "door_height": 2, "sill": 0.5, "thickness": 0.25},
    "room": {"size": (4, 5, 3), "openings": [{"side": "north", "width": 1, "height": 2}]},
    "box": {"size": (1, 2, 3)},
    "pillar": {"radius": 0.5, "height": 3, "sides": 5},
    "ramp": {"width": 1, "run": 2, "degrees": 30, "solid": True},
    "stairs": {"width": 1, "rise": 0.25, "run": 0.5, "count": 3, "solid": True},
    "hatch": {"size": (4, 4), "hole": (1, 2), "depth": 0.5},
    "polygons": {"polygons": [[[0, 0, 0], [1, 0, 0], [0, 1, 0]]]},
}


def total_area(shape: Shape) -> float:
    """Return the area of all polygons."""
    return sum(length(area_vector(corners)) for corners in shape)


def volume(shape: Shape) -> float:
    """Return the volume that closed polygons enclose, positive if they face outwards."""
    return sum(dot(corners[0], area_vector(corners)) for corners in shape) / 3.0


def assert_closed(shape: Shape) -> None:
    """Check that the area vectors of a surface add up to nothing."""
    total = [sum(part) for part in zip(*map(area_vector, shape), strict=True)]
    assert all(abs(part) < 1e-12 for part in total)


def normals(shape: Shape) -> list[tuple[float, ...]]:
    """Return the normals of a shape, rounded, without negative zeros."""
    return [tuple(round(part, 6) + 0.0 for part in normal_of(corners)) for corners in shape]


def test_every_primitive_has_an_example() -> None:
    """The table below leaves none out."""
    assert EXAMPLES.keys() == PRIMITIVES.keys()


@pytest.mark.parametrize("name", sorted(EXAMPLES))
def test_primitives_are_valid_wherever_they_are(name: str) -> None:
    """Every polygon is flat, convex and has an area, also turned, moved and rounded."""
    shape = make(name, EXAMPLES[name])
    assert shape
    for yaw in (0.0, 90.0, 37.5):
        vertices, polygons = merge(place(shape, (12.3, -45.6, 78.9), yaw))
        assert not list(shape_errors([[vertices[i] for i in polygon.vertices] for polygon in polygons], ""))


def test_floor_faces_up_in_tiles() -> None:
    """Tiles go row by row and cover the floor."""
    shape = floor(size=(4.0, 2.0), tiles=(2, 1))
    assert shape[0] == ((-2.0, -1.0, 0.0), (0.0, -1.0, 0.0), (0.0, 1.0, 0.0), (-2.0, 1.0, 0.0))
    assert normals(shape) == [(0.0, 0.0, 1.0)] * 2
    assert total_area(shape) == 8.0


def test_ceiling_faces_down() -> None:
    """A ceiling hangs at its height."""
    shape = ceiling(size=(4.0, 2.0), height=2.5)
    assert normals(shape) == [(0.0, 0.0, -1.0)]
    assert {corner[2] for corner in shape[0]} == {2.5}


def test_wall_faces_north() -> None:
    """A wall faces +y."""
    shape = wall(length=4.0, height=2.0)
    assert normals(shape) == [(0.0, 1.0, 0.0)]
    assert total_area(shape) == 8.0


def test_room_faces_inwards_and_is_closed() -> None:
    """The six faces of a room enclose its volume from the outside in."""
    shape = room(size=(4.0, 5.0, 3.0))
    assert normals(shape) == [(0, 0, 1), (0, 0, -1), (0, -1, 0), (0, 1, 0), (-1, 0, 0), (1, 0, 0)]
    assert volume(shape) == pytest.approx(-60.0)
    assert_closed(shape)


@pytest.mark.parametrize("side", ["north", "south", "east", "west", "floor", "ceiling"])
def test_openings_are_where_they_are_asked_for(side: str) -> None:
    """Nothing covers the middle of an opening, everything else of the side is still there."""
    opening = Opening(side, 1.0, 0.5, 0.5, 0.75)
    shape = room(size=(4.0, 5.0, 3.0), openings=[opening])
    assert total_area(room(size=(4.0, 5.0, 3.0))) - total_area(shape) == pytest.approx(0.5)
    middle = {
        "north": (0.5, 2.5, 1.0),
        "south": (0.5, -2.5, 1.0),
        "east": (2.0, 0.5, 1.0),
        "west": (-2.0, 0.5, 1.0),
        "floor": (0.5, 0.75, 0.0),
        "ceiling": (0.5, 0.75, 3.0),
    }[side]
    for corners in shape:
        on_it = abs(dot(normal_of(corners), minus(middle, corners[0]))) < 1e-9
        spans = [(min(c[k] for c in corners), max(c[k] for c in corners)) for k in range(3)]
        inside = all(low <= part <= high for part, (low, high) in zip(middle, spans, strict=True))
        assert not (on_it and inside)


def test_opening_may_take_the_whole_side() -> None:
    """A side that is all opening has no polygons."""
    assert len(room(size=(4.0, 5.0, 3.0), openings=[Opening("north", 4.0, 3.0)])) == 5


def test_two_openings_in_one_wall() -> None:
    """Openings side by side, and one over the other."""
    openings = [
        Opening("north", 1, 2, -1),
        Opening("north", 0.5, 0.5, 1, 0.25),
        Opening("north", 0.5, 0.5, 1, 1),
    ]
    shape = room(size=(4.0, 5.0, 3.0), openings=openings)
    assert total_area(room(size=(4.0, 5.0, 3.0))) - total_area(shape) == pytest.approx(2.5)


def test_opening_flush_with_a_corner() -> None:
    """An edge that misses the corner by float64 rounding is on it: no sliver is left."""
    shape = room(size=(4.2, 5.0, 3.0), openings=[Opening("north", 0.7, 3.0, 1.75)])
    assert len(shape) == 6


def test_doorway_sheet() -> None:
    """Without thickness a doorway is left, above and right of the opening, facing +y."""
    shape = doorway(length=4.0, height=3.0, door_width=1.0, door_height=2.0)
    assert normals(shape) == [(0.0, 1.0, 0.0)] * 3
    assert total_area(shape) == 10.0


def test_thick_doorway_has_a_reveal() -> None:
    """With thickness it has a second face, two jambs and a lintel; a window also a sill."""
    door = doorway(length=4.0, height=3.0, door_width=1.0, door_height=2.0, thickness=0.5)
    assert len(door) == 3 + 3 + 3
    assert total_area(door) == pytest.approx(20.0 + 0.5 * (2.0 + 2.0 + 1.0))
    window = doorway(length=4.0, height=3.0, door_width=1.0, door_height=1.0, sill=1.0, thickness=0.5)
    assert normals(window)[-1] == (0.0, 0.0, 1.0)


def test_thick_doorway_closes_with_ends_and_top() -> None:
    """Jambs and lintel face into the opening: with its outer faces the wall is a closed solid."""
    shape = doorway(length=4.0, height=3.0, door_width=1.0, door_height=2.0, thickness=0.5)
    block = place(box(size=(4.0, 0.5, 3.0)), (0.0, -0.25, 0.0), 0.0)
    bottom = [((x, -0.5, 0.0), (x, 0.0, 0.0), (x + 1.5, 0.0, 0.0), (x + 1.5, -0.5, 0.0)) for x in (-2.0, 0.5)]
    closing = [block[1], block[4], block[5], *bottom]
    assert_closed(shape + closing)
    assert volume(shape + closing) == pytest.approx(4.0 * 0.5 * 3.0 - 1.0 * 0.5 * 2.0)


@pytest.mark.parametrize(
    ("shape", "expected"),
    [
        (box(size=(1.0, 2.0, 3.0)), 6.0),
        (pillar(radius=math.sqrt(0.5), height=3.0, sides=4), 3.0),
        (ramp(width=2.0, run=3.0, rise=1.0, solid=True), 3.0),
        (stairs(width=2.0, rise=0.5, run=1.0, count=3, solid=True), 6.0),
    ],
)
def test_solids_face_outwards_and_are_closed(shape: Shape, expected: float) -> None:
    """Closed solids enclose their volume from the inside out."""
    assert volume(shape) == pytest.approx(expected)
    assert_closed(shape)


def test_square_pillar_is_parallel_to_the_axes() -> None:
    """Four sides face along x and y."""
    shape = pillar(radius=math.sqrt(0.5), height=1.0, sides=4, capped=False)
    assert sorted(normals(shape)) == [(-1, 0, 0), (0, -1, 0), (0, 1, 0), (1, 0, 0)]


@pytest.mark.parametrize("steepness", [{"degrees": 45.0}, {"rise": 2.0}, {"normal_z": math.sqrt(0.5)}])
def test_ramp_by_any_steepness(steepness: dict[str, float]) -> None:
    """Angle, rise and normal say the same; the slope climbs along +y and faces up and back."""
    (corners,) = ramp(width=1.0, run=2.0, **steepness)
    assert corners[2] == pytest.approx((0.5, 2.0, 2.0))
    assert normal_of(corners) == pytest.approx((0.0, -math.sqrt(0.5), math.sqrt(0.5)))


def test_stairs_alternate_risers_and_treads() -> None:
    """Each step is a riser that faces back and a tread that faces up, at its own height."""
    shape = stairs(width=1.0, rise=0.25, run=0.5, count=3)
    assert normals(shape) == [(0.0, -1.0, 0.0), (0.0, 0.0, 1.0)] * 3
    assert [shape[i][0][2] for i in (1, 3, 5)] == [0.25, 0.5, 0.75]
    assert shape[5][2] == (0.5, 1.5, 0.75)


def test_hatch_has_a_hole_and_a_shaft() -> None:
    """The floor around the hole faces up, the shaft's walls face into the hole."""
    shape = hatch(size=(4.0, 4.0), hole=(1.0, 2.0), middle=(0.5, 0.0), depth=0.5)
    around, shaft = shape[:-4], shape[-4:]
    assert set(normals(around)) == {(0.0, 0.0, 1.0)}
    assert total_area(around) == 14.0
    assert total_area(shaft) == pytest.approx(2 * (1.0 + 2.0) * 0.5)
    for corners in shaft:
        assert dot(normal_of(corners), minus((0.5, 0.0, -0.25), corners[0])) > 0.0


def test_explicit_polygons_are_taken_as_they_are() -> None:
    """Listed corners become tuples of floats."""
    assert explicit(polygons=[[[0, 0, 0], [1, 0, 0], [0, 1, 0]]]) == [
        ((0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (0.0, 1.0, 0.0))
    ]


@pytest.mark.parametrize(
    ("name", "parameters", "path"),
    [
        ("rom", {}, "rom"),
        ("room", {"size": (4, 5, 0)}, "room.size[2]"),
        ("room", {"size": (4, 5)}, "room.size"),
        ("room", {"size": 4}, "room.size"),
        ("room", {}, "room"),
        ("room", {"size": (4, 5, 3), "tiles": 2}, "room.tiles"),
        (
            "room",
            {"size": (4, 5, 3), "openings": [{"side": "up", "width": 1, "height": 1}]},
            "room.openings[0].side",
        ),
        (
            "room",
            {"size": (4, 5, 3), "openings": [{"side": "north", "width": 1, "height": 4}]},
            "room.openings[0]",
        ),
        ("room", {"size": (4, 5, 3), "openings": [{"side": "north", "width": 1}]}, "room.openings[0]"),
        ("wall", {"length": math.nan, "height": 1}, "wall.length"),
        ("wall", {"length": "4", "height": 1}, "wall.length"),
        ("wall", {"length": True, "height": 1}, "wall.length"),
        ("ramp", {"width": 1, "run": 1}, "ramp"),
        ("ramp", {"width": 1, "run": 1, "degrees": 30, "rise": 1}, "ramp"),
        ("ramp", {"width": 1, "run": 1, "degrees": 90}, "ramp.degrees"),
        ("ramp", {"width": 1, "run": 1, "normal_z": 1}, "ramp.normal_z"),
        ("ramp", {"width": 1, "run": 1, "rise": 0}, "ramp.rise"),
        ("stairs", {"width": 1, "rise": 0.2, "run": 0.3, "count": 0}, "stairs.count"),
        ("stairs", {"width": 1, "rise": 0.2, "run": 0.3, "count": 2.5}, "stairs.count"),
        ("pillar", {"radius": 1, "height": 1, "sides": 2}, "pillar.sides"),
        ("floor", {"size": (1, 1), "tiles": (0, 1)}, "floor.tiles[0]"),
        ("floor", {"size": (1, 1), "tiles": (1,)}, "floor.tiles"),
        ("doorway", {"length": 2, "height": 2, "door_width": 3, "door_height": 1}, "doorway"),
        (
            "doorway",
            {"length": 2, "height": 2, "door_width": 1, "door_height": 1, "sill": -1},
            "doorway.sill",
        ),
        ("hatch", {"size": (2, 2), "hole": (1, 1), "middle": (1, 0)}, "hatch.hole"),
        ("polygons", {"polygons": [[[0, 0, 0], [1, 0]]]}, "polygons[0][1]"),
    ],
)
def test_bad_parameters_are_located(name: str, parameters: dict[str, Any], path: str) -> None:
    """A parameter that cannot be is an error with its path."""
    with pytest.raises(SceneError) as raised:
        make(name, parameters)
    assert raised.value.path == path
