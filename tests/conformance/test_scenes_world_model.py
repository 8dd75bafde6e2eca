"""Worlds as plain data, their records, and what may not be in them."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any

import pytest

from conformance.scenes.bsp_builder import TreeStyle, build
from conformance.scenes.cell_planes import box_planes
from conformance.scenes.errors import SceneError
from conformance.scenes.model import Pose
from conformance.scenes.object_model import Part, WorldObject
from conformance.scenes.primitives import room
from conformance.scenes.validate_world import check_world, world_errors
from conformance.scenes.world_model import (
    Building,
    InteriorCell,
    LandBlock,
    Portal,
    Restriction,
    World,
    is_interior,
)

if TYPE_CHECKING:
    from conformance.scenes.model import Geometry

CELL = 0xA9B40100
DOOR = ((1.0, -2.0, 0.0), (-1.0, -2.0, 0.0), (-1.0, -2.0, 2.0), (1.0, -2.0, 2.0))
POSE = Pose(CELL, (100.0, 50.0, 94.0))


def geometry(name: str) -> Geometry:
    """Return a room."""
    planes = box_planes((-3.0, -2.0, 0.0), (3.0, 2.0, 3.0))
    return build(name, room(size=(6, 4, 3)), style=TreeStyle.FRONT, kind="room", cell_planes=planes)


ROOM = geometry("room")
SHELL = geometry("shell")
OBJECT = WorldObject(0x70000001, POSE, parts=(Part(SHELL), Part(None)), spheres=((0.0, 0.0, 0.0, 1.0),))
GOOD = World(
    "good",
    landblocks=(LandBlock(0xA9B4, (94.0,) * 81),),
    cells=(InteriorCell(CELL, POSE, ROOM, (Portal(None, 0, DOOR, 0),), (CELL + 1,)),),
    buildings=(Building(Pose(0xA9B40001, (100.0, 50.0, 94.0)), SHELL, ((CELL, 0),)),),
    objects=(OBJECT,),
    shadow={CELL: (0x70000001,)},
)


def test_the_record_of_a_world() -> None:
    """The keys and shapes of FORMAT.md; what is not given is left out of objects and parts."""
    record = GOOD.to_record()
    assert list(record) == ["kind", "name", "landblocks", "cells", "buildings", "objects", "shadow"]
    assert record["landblocks"] == [{"block": 0xA9B4, "heights": [94.0] * 81}]
    assert record["cells"][0]["portals"] == [
        {"other": None, "side": 0, "polygon": [list(corner) for corner in DOOR], "other_portal": 0}
    ]
    assert record["buildings"][0]["portals"] == [{"other": CELL, "other_portal": 0}]
    pose = POSE.to_record()
    assert record["objects"] == [
        {
            "id": 0x70000001,
            "pose": pose,
            "scale": 1.0,
            "state": 0,
            "parts": [{"geometry": "shell"}, {"geometry": None}],
            "spheres": [[0.0, 0.0, 0.0, 1.0]],
        }
    ]
    assert record["shadow"] == {str(CELL): [0x70000001]}


def test_what_an_object_may_have() -> None:
    """A weenie by its flags, even without any; a parent; no part array; parts with pose and scale."""
    part = Part(SHELL, POSE, 2.0)
    thing = replace(OBJECT, weenie=("creature", "pk"), parent=True, part_array=False, parts=(part,))
    record = thing.to_record()
    assert record["weenie"] == {"creature": 1, "pk": 1}
    assert replace(thing, weenie=()).to_record()["weenie"] == {}
    assert (record["parent"], record["no_part_array"]) == (1, 1)
    assert record["parts"] == [{"geometry": "shell", "pose": POSE.to_record(), "scale": 2.0}]


def test_two_buildings_in_a_land_cell_are_no_mistake() -> None:
    """Retail takes the first (09 3.6), and drops one that another landblock's file lists (09 3.7)."""
    other = building(block=0xA9B4, pose=Pose(0xA9B50001, (1.0, 1.0, 1.0))).buildings
    assert list(world_errors(replace(GOOD, buildings=GOOD.buildings * 2 + other))) == []


def test_geometries_are_listed_once() -> None:
    """In order of first use: cells, buildings, objects."""
    assert list(GOOD.geometries()) == [ROOM, SHELL]


@pytest.mark.parametrize(("cell", "interior"), [(0xA9B400FF, False), (0xA9B40100, True), (0, False)])
def test_interior_cells(cell: int, interior: bool) -> None:
    """The low word decides."""
    assert is_interior(cell) is interior


def test_a_good_world_passes() -> None:
    """Nothing is wrong with it."""
    check_world(GOOD)
    assert list(world_errors(GOOD)) == []


def cell(**change: Any) -> World:
    """Return the good world with a changed cell."""
    return replace(GOOD, cells=(replace(GOOD.cells[0], **change),))


def portal(**change: Any) -> World:
    """Return the good world with a changed portal."""
    return cell(portals=(replace(GOOD.cells[0].portals[0], **change),))


def block(**change: Any) -> World:
    """Return the good world with a changed landblock."""
    return replace(GOOD, landblocks=(replace(GOOD.landblocks[0], **change),))


def thing(**change: Any) -> World:
    """Return the good world with a changed object."""
    return replace(GOOD, objects=(replace(OBJECT, **change),))


def building(**change: Any) -> World:
    """Return the good world with a changed building."""
    return replace(GOOD, buildings=(replace(GOOD.buildings[0], **change),))


def drawn(radius: float) -> Part:
    """Return a part without physics."""
    return Part(SHELL, physics=False, drawing_sphere=(0.0, 0.0, 0.0, radius))


HIGH = (94.0,) * 80 + (800.5,)
FAR = replace(ROOM, vertices=((1e9, 0.0, 0.0), *ROOM.vertices[1:]))
FLAT = build("open", room(size=(1, 1, 1)), style=TreeStyle.FRONT, kind="room")


@pytest.mark.parametrize(
    ("world", "path", "found"),
    [
        (World("empty"), "cells", "neither a landblock nor a cell"),
        (block(block=0xFF00), "landblocks[0].block", "0xFF00"),
        (block(block=0x00FF), "landblocks[0].block", "0x00FF"),
        (replace(GOOD, landblocks=GOOD.landblocks * 2), "landblocks[1].block", "0xA9B4 twice"),
        (block(heights=(94.0,)), "landblocks[0].heights", "1 numbers"),
        (block(heights=()), "landblocks[0].heights", "0 numbers"),
        (block(terrain=(0,)), "landblocks[0].terrain", "1 numbers"),
        (block(heights=HIGH), "landblocks[0].heights[80]", "800.5 m"),
        (block(heights=(float("nan"),) * 81), "landblocks[0].heights[0]", "nan"),
        (block(terrain=(1 << 16,) * 81), "landblocks[0].terrain[0]", "65536"),
        (cell(id=0xA9B40011), "cells[0].id", "0xA9B40011"),
        (replace(GOOD, cells=GOOD.cells * 2), "cells[1].id", "twice"),
        (cell(pose=replace(POSE, cell=0xA9B50100)), "cells[0].pose.cell", "landblock 0xA9B5"),
        (cell(pose=replace(POSE, rotation=(2.0, 0.0, 0.0, 0.0))), "cells[0].pose.rotation", "squared length"),
        (cell(geometry=FLAT), "cells[0].geometry", "no containment planes"),
        (cell(stab=(0xA9B40001,)), "cells[0].stab[0]", "0xA9B40001"),
        (portal(other=CELL), "cells[0].portals[0].other", "to itself"),
        (portal(other=0xA9B40001), "cells[0].portals[0].other", "0xA9B40001"),
        (portal(other=0xA9B50100), "cells[0].portals[0].other", "landblock 0xA9B5"),
        (portal(side=2), "cells[0].portals[0].side", "2"),
        (portal(other_portal=1 << 15), "cells[0].portals[0].other_portal", "32768"),
        (
            portal(polygon=(*DOOR[:3], (1.0, -2.5, 2.0))),
            "cells[0].portals[0].polygon",
            "off the polygon's plane",
        ),
        (portal(polygon=((1e9, 0.0, 0.0), *DOOR[1:])), "cells[0].portals[0].polygon", "1e+09"),
        (building(pose=Pose(0xA9B50001, (1.0, 1.0, 1.0))), "buildings[0].pose.origin", "no loaded landblock"),
        (building(pose=Pose(0, (1.0, 1.0, 1.0))), "buildings[0].pose.cell", "0"),
        (building(portals=((CELL, 1),)), "buildings[0].portals[0]", "portal 1"),
        (building(block=0xA9B5), "buildings[0].block", "0xA9B5"),
        (block(side_cell_count=3), "landblocks[0].side_cell_count", "3"),
        (thing(attached=(0x70000001,)), "objects[0].attached[0]", "0x70000001"),
        (thing(attached=(5,)), "objects[0].attached[0]", "0x00000005"),
        (thing(parts=(drawn(0.0),)), "objects[0].parts[0].drawing_sphere", "(0)"),
        (
            thing(parts=(replace(drawn(1.0), physics=True),)),
            "objects[0].parts[0].drawing_sphere",
            "beside a physics tree",
        ),
        (replace(GOOD, restrictions={CELL + 9: Restriction()}), f"restrictions[{CELL + 9}]", "0xA9B40109"),
        (replace(GOOD, restrictions={0xA9B40041: Restriction()}), "restrictions[2847146049]", "0xA9B40041"),
        (thing(id=0), "objects[0].id", "the object id 0"),
        (replace(GOOD, objects=GOOD.objects * 2), "objects[1].id", "twice"),
        (thing(scale=0.0), "objects[0].scale", "0.0"),
        (thing(weenie=("npc",)), "objects[0].weenie", "npc"),
        (thing(parts=(Part(SHELL, None, -1.0),)), "objects[0].parts[0].scale", "-1.0"),
        (thing(parts=(Part(SHELL, Pose(0, (0.0, 0.0, 0.0))),)), "objects[0].parts[0].pose.cell", "0"),
        (thing(spheres=((0.0, 0.0, 0.0, 0.0),)), "objects[0].spheres[0]", "(0)"),
        (thing(cylspheres=((0.0, 0.0, 0.0, 1.0, -1.0),)), "objects[0].cylspheres[0]", "(1, -1)"),
        (replace(GOOD, shadow={CELL: (5,)}), f"shadow.{CELL}", "0x00000005"),
        (replace(GOOD, shadow={CELL: (0x70000001, 0x70000001)}), f"shadow.{CELL}", "an object twice"),
        (
            cell(geometry=replace(ROOM, vertices=((1e9, 0.0, 0.0), *ROOM.vertices[1:]))),
            "cells[0].geometry.vertices[0]",
            "1e+09",
        ),
    ],
)
def test_what_may_not_be_in_a_world(world: World, path: str, found: str) -> None:
    """Each mistake has its path and names the offending number."""
    errors = list(world_errors(world))
    assert (path, True) in {(error.path, found in error.found) for error in errors}, errors
    with pytest.raises(SceneError):
        check_world(world)


@pytest.mark.parametrize(
    ("origin", "place"),
    [((-0.0001, 24.0, 0.0), None), ((-1.0, 24.0, 0.0), "no loaded landblock"), ((191.9, 191.9, 0.0), None)],
)
def test_the_land_cell_of_a_building(origin: tuple[float, float, float], place: str | None) -> None:
    """As retail takes it: a hair west of the landblock is still in it, a metre is not."""
    world = building(pose=Pose(0xA9B40001, origin))
    found = [error.found for error in world_errors(world)]
    assert found == [] if place is None else place in found[0]
