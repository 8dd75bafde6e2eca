"""Cell dumps as worlds: portals with their sides, what belongs together, what each cell contains."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

import pytest

from conformance.scenes.importers.cell_world import hull_planes, load_worlds
from conformance.scenes.importers.dump_json import DumpError
from conformance.scenes.planes import signed_distance
from conformance.scenes.primitives import room
from conformance.scenes.validate_world import check_world

if TYPE_CHECKING:
    from pathlib import Path

    from conformance.scenes.world_model import World

ROWS = [[1, 0, 0], [0, 1, 0], [0, 0, 1]]


def polygon(number: int, plane: list[float], corners: list[list[float]]) -> dict[str, Any]:
    """Return a polygon of a dump."""
    return {"id": number, "sides": 0, "plane": plane, "v": corners}


def box_cell(cell: str, west: float, portals: list[dict[str, int]]) -> dict[str, Any]:
    """Return a cell of 2 m x 2 m x 2 m from x = `west` on, open in the east and the west."""
    east = west + 2
    floor = polygon(0, [0, 0, 1, 0], [[west, 0, 0], [east, 0, 0], [east, 2, 0], [west, 2, 0]])
    top = polygon(1, [0, 0, -1, 2], [[west, 2, 2], [east, 2, 2], [east, 0, 2], [west, 0, 2]])
    # Both doors are wound to face east, as the cells of a pair hold the same polygon.
    doors = [
        polygon(2, [1, 0, 0, -x], [[x, 0, 0], [x, 2, 0], [x, 2, 2], [x, 0, 2]]) | {"id": number}
        for number, x in ((2, west), (3, east))
    ]
    return {
        "cell": cell,
        "rotation_rows": ROWS,
        "origin": [10, 20, 94],
        "polygons": [floor, top],
        "portal_polygons": [floor, top, *doors],
        "portals": portals,
        "visible_cells": [0xA9B40100, 0xA9B40101],
    }


WEST = box_cell(
    "0xA9B40100",
    0,
    [{"other_cell": 0xFFFF, "polygon": 2, "flags": 7}, {"other_cell": 0x101, "polygon": 3, "flags": 1}],
)
EAST = box_cell(
    "0xA9B40101",
    2,
    [{"other_cell": 0x100, "polygon": 2, "flags": 3}, {"other_cell": 0x102, "polygon": 3, "flags": 1}],
)
FAR = box_cell("0xA9B40103", 6, [{"other_cell": 0x102, "polygon": 2, "flags": 3}])
ALONE = box_cell("0xA9B40110", 20, [])


def worlds(folder: Path, *records: dict[str, Any]) -> list[World]:
    """Write dumps and read them as worlds."""
    for record in records:
        file = folder / f"{record['cell']}.json"
        file.write_text(json.dumps(record), encoding="utf-8", newline="\n")
    return load_worlds(folder)


def test_portals(tmp_path: Path) -> None:
    """Flag 2 says that the polygon faces in, flag 4 that it leads outdoors; each knows the way back."""
    (world,) = worlds(tmp_path, WEST, EAST)
    west, east = world.cells
    assert [(p.other, p.side, p.other_portal) for p in west.portals] == [(None, 0, 0), (0xA9B40101, 1, 0)]
    assert [(p.other, p.side, p.other_portal) for p in east.portals] == [
        (0xA9B40100, 0, 1),
        (0xA9B40102, 1, 0),
    ]
    assert west.portals[1].polygon == east.portals[0].polygon
    assert west.stab == (0xA9B40100, 0xA9B40101)
    assert west.pose.origin == (10.0, 20.0, 94.0)


def test_what_belongs_together(tmp_path: Path) -> None:
    """Cells that share a neighbour, dumped or not, are one world; a cell alone is another."""
    first, second = worlds(tmp_path, ALONE, FAR, EAST, WEST)
    assert [cell.id for cell in first.cells] == [0xA9B40100, 0xA9B40101, 0xA9B40103]
    assert [cell.id for cell in second.cells] == [0xA9B40110]
    assert first.name == "cells A9B40100 to A9B40103"
    check_world(first)
    assert (first.landblocks, first.objects, first.buildings) == ((), (), ())


def test_the_volume_of_a_cell(tmp_path: Path) -> None:
    """The doors bound it where there is no wall: the cells touch and do not overlap."""
    (world,) = worlds(tmp_path, WEST, EAST)
    for cell, inside, outside in zip(world.cells, (1.0, 3.0), (3.0, 1.0), strict=True):
        planes = cell.geometry.cell_planes
        assert planes is not None
        assert min(signed_distance(plane, (inside, 1.0, 1.0)) for plane in planes) == 1.0
        assert min(signed_distance(plane, (outside, 1.0, 1.0)) for plane in planes) == -1.0


def test_a_hull_takes_slopes_and_leaves_dents() -> None:
    """A plane that has a corner behind it does not bound the hull; the box always does."""
    slope = ((2.0, -1.0, 0.0), (2.0, 1.0, 0.0), (1.0, 1.0, 3.0), (1.0, -1.0, 3.0))[::-1]
    dent = ((0.0, -1.0, 0.0), (0.0, 1.0, 0.0), (0.0, 1.0, 1.0), (0.0, -1.0, 1.0))
    planes = hull_planes([*room(size=(2, 2, 3)), slope, dent])
    assert len(planes) == 7
    slanted = [plane for plane in planes if abs(plane[0]) < 0.999 and abs(plane[0]) > 0.1]
    assert len(slanted) == 1


def changed(key: str, value: Any) -> dict[str, Any]:
    """Return a cell with something else under a key."""
    return {**WEST, key: value}


@pytest.mark.parametrize(
    ("record", "found"),
    [
        ({key: value for key, value in WEST.items() if key != "portal_polygons"}, "no 'portal_polygons'"),
        ({key: value for key, value in WEST.items() if key != "visible_cells"}, "no 'visible_cells'"),
        (
            changed("portals", [{"other_cell": 0x101, "polygon": 9, "flags": 1}]),
            "portals[0].polygon: found 9",
        ),
        (
            changed("portals", [{"other_cell": 0xFFFF, "polygon": 3, "flags": 1}]),
            "flags 1 with other_cell 0xFFFF",
        ),
        (
            changed("portals", [{"other_cell": 0x101, "polygon": 3, "flags": 5}]),
            "flags 5 with other_cell 0x0101",
        ),
        (changed("portals", [{"other_cell": 0x100, "polygon": 3, "flags": 1}]), "to itself"),
        (changed("visible_cells", ["all"]), "visible_cells[0]"),
    ],
)
def test_bad_dumps(record: dict[str, Any], found: str, tmp_path: Path) -> None:
    """What is missing or does not fit is named, with the file or the folder."""
    with pytest.raises(DumpError) as caught:
        worlds(tmp_path, record)
    assert found in str(caught.value)
    assert str(tmp_path) in str(caught.value)


def test_no_dump(tmp_path: Path) -> None:
    """An empty folder is an error, not an empty answer."""
    with pytest.raises(DumpError, match="no dump"):
        load_worlds(tmp_path)
