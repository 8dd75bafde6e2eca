"""Registration: in which cells an object is found, worked out by hand on small lands and houses."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import pytest

from engine import Cell, LandBlock, Leaf, Pose, Shape, World, WorldError
from engine.cells import Portal
from engine.constants import HAS_PHYSICS_BSP, STATIC
from engine.landscape import Building, BuildingPortal
from engine.objects import Obstacle, Part
from engine.registration import Registrar
from engine.shadows import register

if TYPE_CHECKING:
    from collections.abc import Sequence

BLOCK = 0xA9B4
LAND = BLOCK << 16
HALL, ROOM, ATTIC = LAND | 0x100, LAND | 0x101, LAND | 0x102
SOLID = int(STATIC | HAS_PHYSICS_BSP)
EMITTER = 0x1000


def land_id(i: int, j: int) -> int:
    """Return the id of the land cell in column i from the west, row j from the south."""
    return LAND | (8 * i + j + 1)


def cube(half: float, *, planes: Sequence[Sequence[float]] | None = None) -> Shape:
    """Return a cube about the origin; its sphere is the one that holds its corners."""
    corners = [(x, y, z) for x in (-half, half) for y in (-half, half) for z in (-half, half)]
    return Shape(corners, [(0, 1, 3)], Leaf((0.0, 0.0, 0.0, 2.0 * half), (0,)), planes, name="cube")


def walls(half: float) -> list[tuple[float, float, float, float]]:
    """Return the containment planes of a cube."""
    return [
        (sign * (axis == 0), sign * (axis == 1), sign * (axis == 2), half)
        for axis in range(3)
        for sign in (1.0, -1.0)
    ]


def door(x: float) -> list[tuple[float, float, float]]:
    """Return a polygon at x whose plane looks along -x."""
    return [(x, 0, 0), (x, 0, 1), (x, 1, 1), (x, 1, 0)]


def land() -> World:
    """Return a flat landblock."""
    return World(landblocks=[LandBlock(BLOCK, [0.0] * 81)])


def house(*, door_portal: Portal | None = None) -> World:
    """Return two rooms of 10 metres side by side, a door to the west of the first, and the land around.

    The hall is centred at (60, 60), the room at (70, 60). Between them is a plane at x = 65, their
    insides are on its positive side (the hall's) and on its negative side (the room's).
    """
    shape = cube(5.0, planes=walls(5.0))
    west = Portal(None, [(-5, 0, 0), (-5, 1, 0), (-5, 1, 1), (-5, 0, 1)], 0)
    hall = Cell(
        HALL,
        Pose(HALL, (60.0, 60.0, 5.0)),
        shape,
        portals=[Portal(ROOM, door(5.0), 0), door_portal or west],
        stab=[ROOM],
    )
    room = Cell(ROOM, Pose(ROOM, (70.0, 60.0, 5.0)), shape, portals=[Portal(HALL, door(-5.0), 1)], stab=[])
    entry = Building(Pose(land_id(2, 2), (60.0, 60.0, 0.0)), None, [BuildingPortal(HALL, 1)])
    return World([hall, room], [LandBlock(BLOCK, [0.0] * 81)], [entry])


def outdoors(x: float, y: float, **more: object) -> Obstacle:
    """Return a solid cube of half a metre on the land."""
    pose = Pose(land_id(int(x // 24), int(y // 24)), (x, y, 0.0))
    return replace(Obstacle.solid(cube(0.5), pose), **more)  # type: ignore[arg-type]


def indoors(x: float, cell: int = HALL, *, half: float = 0.5, state: int = SOLID) -> Obstacle:
    """Return a solid cube on the middle line of the house."""
    return Obstacle.solid(cube(half), Pose(cell, (x, 60.0, 5.0)), state=state)


def cells_of(world: World, thing: Obstacle) -> list[int]:
    """Return the ids of the cells in which one object is found."""
    return list(register(world, [thing]))


def test_a_box_within_a_land_cell_is_found_there() -> None:
    """Between two borders."""
    assert cells_of(land(), outdoors(36.0, 36.0)) == [land_id(1, 1)]


def test_a_box_across_a_corner_is_found_column_by_column() -> None:
    """Its own cell comes first, then the rectangle from the west, each column from the south."""
    expected = [land_id(1, 1), land_id(0, 0), land_id(0, 1), land_id(1, 0)]
    assert cells_of(land(), outdoors(24.25, 24.25)) == expected


@pytest.mark.parametrize(("x", "columns"), [(24.5, [1]), (24.499998, [1, 0]), (23.5, [0, 1])])
def test_a_box_that_ends_at_a_border(x: float, columns: list[int]) -> None:
    """The column of an edge is floor(edge / 24): an edge at 24 is in the eastern one."""
    assert cells_of(land(), outdoors(x, 36.0)) == [land_id(i, 1) for i in columns]


def test_a_wide_box_covers_more_cells_than_a_row_has_room_for() -> None:
    """150 metres are seven cells across from column 0 to 6, 49 with the rows; the row grows for them."""
    world = land()
    wide = Obstacle.solid(cube(75.0), Pose(land_id(3, 3), (84.0, 84.0, 0.0)))
    found = cells_of(world, wide)
    assert found[0] == land_id(3, 3)
    assert sorted(found) == sorted(land_id(i, j) for i in range(7) for j in range(7))
    huge = Obstacle.solid(cube(3000.0), Pose(land_id(3, 3), (84.0, 84.0, 0.0)))
    registrar = Registrar(world, [huge])
    reached = registrar.cells_reached(0, static=True)
    assert len(reached) == 251 * 251
    assert sum(cell >= 0 for cell in reached) == 64


def test_a_flat_part_covers_what_its_sphere_does() -> None:
    """The cube's sphere has twice its half edge: from 24.75 it reaches to 23.75, the box only to 24.25."""
    thing = outdoors(24.75, 36.0)
    assert cells_of(land(), thing) == [land_id(1, 1)]
    flat = replace(thing, parts=[replace(thing.parts[0], always_flat=True)])
    assert cells_of(land(), flat) == [land_id(1, 1), land_id(0, 1)]


def test_a_flat_part_without_a_sphere_is_a_point() -> None:
    """Where its origin is, whatever its box."""
    thing = outdoors(24.25, 36.0)
    assert cells_of(land(), thing) == [land_id(1, 1), land_id(0, 1)]
    picture = replace(thing.parts[0], always_flat=True, has_physics=False)
    assert cells_of(land(), replace(thing, parts=[picture])) == [land_id(1, 1)]


@pytest.mark.parametrize(
    ("sphere", "found"),
    [((0, 0, 0, 1.0), [HALL, ROOM]), ((-6.0, 0, 0, 1.0), [HALL]), (None, [HALL])],
)
def test_a_part_without_physics_is_found_by_what_is_drawn(
    sphere: tuple[float, ...] | None, found: list[int]
) -> None:
    """09 4.3.1: its drawing sphere has to reach the portal, and then its box; without one it reaches none."""
    thing = indoors(64.75)
    drawn = replace(thing.parts[0], has_physics=False, drawing_sphere=sphere)
    assert cells_of(house(), replace(thing, parts=[drawn])) == found


def test_a_drawing_sphere_is_checked() -> None:
    """It is said whose it is."""
    drawn = Part(cube(0.5), has_physics=False, drawing_sphere=(0, 0, 0))
    with pytest.raises(WorldError, match="object 0, part, drawing sphere: "):
        register(house(), [replace(indoors(60.0), parts=[drawn])])


def test_scale_plays_no_role() -> None:
    """Boxes and cylspheres are taken unscaled (08, 9.2)."""
    assert cells_of(land(), outdoors(25.0, 36.0, scale=10.0)) == [land_id(1, 1)]
    column = outdoors(25.0, 36.0, scale=10.0, state=int(STATIC), cylspheres=[(0, 0, 0, 0.5, 2)])
    assert cells_of(land(), column) == [land_id(1, 1)]


def test_a_cylsphere_is_a_ball_about_its_low_point() -> None:
    """Of its radius: at 24.4 one of half a metre reaches over the border at 24."""
    thing = outdoors(24.4, 36.0, state=int(STATIC), cylspheres=[(0, 0, 0, 0.5, 2)])
    assert cells_of(land(), thing) == [land_id(1, 1), land_id(0, 1)]


def test_only_ten_cylspheres_are_looked_at() -> None:
    """The eleventh, in the next cell, is not."""
    beyond = (24.0, 0.0, 0.0, 0.1, 1.0)
    many = [(0.0, 0.0, 0.0, 0.1, 1.0)] * 10
    for cylspheres, count in (([*many[1:], beyond], 2), ([*many, beyond], 1)):
        thing = outdoors(36.0, 36.0, state=int(STATIC), cylspheres=cylspheres)
        assert len(cells_of(land(), thing)) == count


@pytest.mark.parametrize(
    ("state", "sphere", "columns"),
    [
        (0, (0, 0, 0, 2.0), [1, 0]),
        (0, None, [1]),
        (int(STATIC), (0, 0, 0, 2.0), [1]),
    ],
)
def test_a_sorting_sphere_is_for_what_moves(
    state: int, sphere: tuple[float, ...] | None, columns: list[int]
) -> None:
    """Without one there is a dummy of 0.1 metres; what is static is found by its parts, if there are any."""
    thing = Obstacle(Pose(land_id(1, 1), (25.0, 36.0, 0.0)), state=state, sorting_sphere=sphere)
    assert cells_of(land(), thing) == [land_id(i, 1) for i in columns]


def test_an_object_between_two_rooms_is_found_in_both() -> None:
    """The plane is at x = 65: a cube of half a metre crosses it from 64.5 to 65.5, beyond EPS."""
    world = house()
    assert cells_of(world, indoors(62.0)) == [HALL]
    assert cells_of(world, indoors(64.75)) == [HALL, ROOM]
    assert cells_of(world, indoors(65.25, ROOM)) == [ROOM, HALL]


def test_an_object_in_a_door_is_found_outside_too() -> None:
    """Through the door at x = 55: the land cell (2, 2) holds it, the cube's box lies between 54 and 55.5."""
    assert cells_of(house(), indoors(55.2)) == [HALL, land_id(2, 2)]


def test_an_object_on_the_land_is_found_in_the_house_that_it_reaches_into() -> None:
    """Through the building's portal into the hall, and on into the room if it is that large.

    From 42.5 to 65.5 it lies in the columns 1 and 2, and beyond the hall, which ends at 65.
    """
    world = house()
    assert cells_of(world, outdoors(54.0, 60.0)) == [land_id(2, 2)]
    within = replace(outdoors(54.75, 60.0), pose=Pose(land_id(2, 2), (54.75, 60.0, 5.0)))
    assert cells_of(world, within) == [land_id(2, 2), HALL]
    large = Obstacle.solid(cube(11.5), Pose(land_id(2, 2), (54.0, 60.0, 5.0)))
    assert cells_of(world, large) == [land_id(2, 2), land_id(1, 2), HALL, ROOM]


def test_what_is_behind_a_portal_and_not_in_the_world_is_reached_but_not_found() -> None:
    """The list has minus its id."""
    world = house(door_portal=Portal(ATTIC, [(-5, 0, 0), (-5, 1, 0), (-5, 1, 1), (-5, 0, 1)], 0))
    thing = indoors(55.2)
    assert Registrar(world, [thing]).cells_reached(0, static=True) == [0, -ATTIC]
    assert cells_of(world, thing) == [HALL]


def test_what_is_static_is_found_only_in_what_is_visible() -> None:
    """The room sees nothing: a static ball in its door stays in it, one that moves is found in the hall."""
    world = house()
    ball = Obstacle(Pose(ROOM, (65.2, 60.0, 5.0)), state=int(STATIC), cylspheres=[(0, 0, 0, 0.5, 1)])
    assert cells_of(world, ball) == [ROOM]
    assert cells_of(world, replace(ball, state=0)) == [ROOM, HALL]


def test_an_emitter_is_found_in_its_own_cell() -> None:
    """Whatever it reaches; and nowhere if that cell is not in the world."""
    world = house()
    thing = indoors(64.75, state=SOLID | EMITTER)
    assert cells_of(world, thing) == [HALL]
    assert cells_of(world, replace(thing, pose=Pose(ATTIC, (60.0, 60.0, 5.0)))) == []


def test_a_cell_that_is_not_in_the_world_holds_nothing() -> None:
    """Nor is anything looked for from there."""
    thing = indoors(64.75, ATTIC)
    assert Registrar(house(), [thing]).cells_reached(0, static=True) == [-ATTIC]


@pytest.mark.parametrize("change", [{"has_part_array": False}, {"parts": ()}, {"parts": (Part(None),)}])
def test_without_parts_only_its_own_cell(change: dict[str, object]) -> None:
    """There is nothing that could reach farther."""
    thing = replace(indoors(64.75), **change)  # type: ignore[arg-type]
    assert cells_of(house(), thing) == [HALL]


def test_parts_have_poses_of_their_own() -> None:
    """The second part is in the room, which it is found in from the hall."""
    parts = (Part(cube(0.5)), Part(cube(0.5), Pose(ROOM, (66.0, 60.0, 5.0))))
    assert cells_of(house(), replace(indoors(60.0), parts=parts)) == [HALL, ROOM]


def test_a_world_registers_its_objects() -> None:
    """Behind what is listed, in the order in which they are given."""
    plain = house()
    first, second = indoors(64.75), indoors(65.25, ROOM)
    shadows = register(plain, [first, second])
    assert shadows == {HALL: [first, second], ROOM: [first, second]}
    listed = Obstacle(Pose(HALL, (60.0, 60.0, 5.0)))
    shape = cube(5.0, planes=walls(5.0))
    cells = [
        Cell(HALL, Pose(HALL, (60.0, 60.0, 5.0)), shape, portals=[Portal(ROOM, door(5.0))], objects=[listed]),
        Cell(ROOM, Pose(ROOM, (70.0, 60.0, 5.0)), shape, portals=[Portal(HALL, door(-5.0), 1)]),
    ]
    world = World(cells, objects=[first, second])
    assert [[world.objects[k] for k in world.objects_of(cell)] for cell in (0, 1)] == [
        [listed, first, second],
        [first, second],
    ]


def test_a_portal_without_a_plane_keeps_parts_from_being_registered() -> None:
    """It is said which; objects without parts do not look at it."""
    shape = cube(5.0, planes=walls(5.0))
    cells = [
        Cell(HALL, Pose(HALL, (60.0, 60.0, 5.0)), shape, portals=[Portal(ROOM, door(5.0)), ROOM]),
        Cell(ROOM, Pose(ROOM, (70.0, 60.0, 5.0)), shape, portals=None),
    ]
    with pytest.raises(WorldError, match="cell 0xa9b40100, portal 1: its polygon is needed to register"):
        World(cells, objects=[indoors(60.0)])
    ball = Obstacle(Pose(HALL, (60.0, 60.0, 5.0)), cylspheres=[(0, 0, 0, 0.5, 1)])
    assert World(cells, objects=[ball]).objects == (ball,)


@pytest.mark.parametrize(
    ("change", "complaint"),
    [
        ({"cylspheres": [(0, 0, 0, 1, 1), (0, 0)], "state": 1}, "object 1, spheres: not an array of numbers"),
        ({"pose": Pose(HALL, (0.0, 0.0, float("nan")))}, "object 1, pose, origin: nan at "),
    ],
)
def test_an_object_that_is_wrong_is_named(change: dict[str, object], complaint: str) -> None:
    """With what is wrong with it."""
    wrong = replace(indoors(60.0), **change)  # type: ignore[arg-type]
    with pytest.raises(ValueError, match=complaint):
        register(house(), [indoors(60.0), wrong])


def test_an_object_in_no_cell_is_refused() -> None:
    """Cell id 0 is that of nowhere; minus it would be the index of a cell."""
    with pytest.raises(WorldError, match="object 0, pose: cell id 0 is not the id of a cell"):
        World(landblocks=[LandBlock(BLOCK, [0.0] * 81)], objects=[Obstacle(Pose(0), state=STATIC)])
