"""Hypothesis strategies for shapes to build trees of."""

from __future__ import annotations

from typing import TYPE_CHECKING

from hypothesis import strategies as st

from conformance.scenes.polygons import flip, place
from conformance.scenes.primitives import Opening, box, doorway, floor, hatch, pillar, ramp, room, stairs
from conformance.scenes.validate import shape_errors

if TYPE_CHECKING:
    from conformance.scenes.polygons import Shape

YAWS = st.one_of(st.sampled_from([0.0, 90.0, 180.0, 270.0]), st.floats(0.0, 360.0))


def lengths(low: float, high: float) -> st.SearchStrategy[float]:
    """Draw a length in metres, often a round one."""
    return st.one_of(st.integers(int(low * 4) + 1, int(high * 4)).map(lambda n: n / 4), st.floats(low, high))


@st.composite
def furniture(draw: st.DrawFn) -> Shape:
    """Draw a closed solid object, within half a metre of its origin."""
    kind = draw(st.sampled_from(["box", "pillar", "ramp", "stairs"]))
    if kind == "box":
        return box(size=(draw(lengths(0.2, 0.7)), draw(lengths(0.2, 0.7)), draw(lengths(0.2, 1.5))))
    if kind == "pillar":
        return pillar(
            radius=draw(lengths(0.1, 0.5)), height=draw(lengths(0.2, 1.5)), sides=draw(st.integers(3, 9))
        )
    if kind == "ramp":
        return ramp(width=draw(lengths(0.2, 0.6)), run=0.45, degrees=draw(st.floats(10.0, 70.0)), solid=True)
    return stairs(
        width=0.5, rise=draw(lengths(0.1, 0.3)), run=0.15, count=draw(st.integers(1, 3)), solid=True
    )


@st.composite
def closed_rooms(draw: st.DrawFn) -> Shape:
    """Draw a closed room with objects in it that do not touch each other: matter is all around it."""
    shape = room(size=(6.0, 6.0, draw(lengths(2.0, 4.0))))
    places = [(-1.5, -1.5), (-1.5, 1.5), (1.5, -1.5), (1.5, 1.5)]
    for x, y in draw(st.lists(st.sampled_from(places), unique=True)):
        height = draw(st.sampled_from([0.0, 0.25]))
        shape += place(draw(furniture()), (x, y, height), draw(YAWS))
    return place(shape, (draw(st.floats(-50.0, 50.0)), draw(st.floats(-50.0, 50.0)), 0.0), draw(YAWS))


@st.composite
def open_scenes(draw: st.DrawFn) -> Shape:
    """Draw surfaces as cells have them: floors with holes, walls with doors, ramps, no closed matter."""
    tiles = (draw(st.integers(1, 4)), draw(st.integers(1, 4)))
    depth = draw(st.sampled_from([0.0, 0.4]))
    openings = [Opening("north", 1.0, 2.0), Opening("floor", 1.0, 1.0, 0.5)]
    door = doorway(length=6.0, height=3.0, door_width=1.0, door_height=2.0, thickness=0.2)
    slope = ramp(width=1.0, run=2.0, rise=draw(lengths(0.25, 2.0)))
    parts = {
        "floor": floor(size=(6.0, 6.0), tiles=tiles),
        "hatch": hatch(size=(6.0, 5.0), hole=(1.5, 1.0), middle=(0.5, -0.5), depth=depth),
        "doorway": place(door, (0.0, 1.0, 0.0), draw(YAWS)),
        "ramp": place(slope, (0.0, -1.0, 0.0), draw(YAWS)),
        "stairs": place(stairs(width=1.0, rise=0.25, run=0.3, count=4), (1.0, 0.0, 0.0), draw(YAWS)),
        "room": room(size=(6.0, 6.0, 3.0), openings=openings),
    }
    names = draw(st.lists(st.sampled_from(sorted(parts)), min_size=1, unique=True))
    return [corners for name in names for corners in parts[name]]


@st.composite
def layers(draw: st.DrawFn) -> Shape:
    """Draw floors and ceilings a hair apart: on either side of what counts as the same plane."""
    heights = st.sampled_from([0.0, 1e-5, 1e-4, 5e-4, 2e-3, 5e-3])
    shape: Shape = []
    for _ in range(draw(st.integers(2, 4))):
        tile = place(floor(size=(1.0, draw(lengths(0.5, 2.0)))), (0.0, 0.0, draw(heights)), draw(YAWS))
        shape += flip(tile) if draw(st.booleans()) else tile
    return place(shape, (draw(st.floats(-20.0, 20.0)), 0.0, 0.0), 0.0)


@st.composite
def soups(draw: st.DrawFn) -> Shape:
    """Draw random triangles that cross each other."""
    coordinate = st.floats(-5.0, 5.0, width=32)
    corner = st.tuples(coordinate, coordinate, coordinate)
    triangles = draw(st.lists(st.tuples(corner, corner, corner), min_size=1, max_size=12))
    return [triangle for triangle in triangles if not list(shape_errors([triangle], ""))]
