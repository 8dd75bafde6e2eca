"""Mistakes in worlds: each is told at its place, with what was found and what was expected."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from conformance.loader import load_file

if TYPE_CHECKING:
    from pathlib import Path

GOOD = """\
id: good-world
title: A world without a mistake
why: Everything below changes one thing in it.
retail: [CObjCell::find_cell_list]
scene:
  landblock: 0xA9B4
  terrain:
    - {blocks: [0xA9B4], formula: "94 + x / 24", areas: [{from: [0, 0], to: [8, 2], type: 16}]}
    - {blocks: [0xA9B5], flat: 94}
  cells:
    - id: 0xA9B40150
      pose: {origin: [100, 50, 94], yaw: 30}
      geometry: {tree: front, contains: {room: true}, shapes: [{room: {size: [6, 6, 3]}}]}
      stab: all
    - id: 0xA9B40151
      pose: {origin: [100, 50, 94], yaw: 30}
      geometry: {tree: front, contains: {room: true}, \
shapes: [{room: {size: [6, 6, 3], at: [0, 6, 0], yaw: 0}}]}
      stab: [0xA9B40150]
      portals:
        - {to: 0xA9B40152, polygon: [[3, 5, 0], [3, 7, 0], [3, 7, 2], [3, 5, 2]], loaded: false}
  doorways:
    - {between: [0xA9B40150, 0xA9B40151], side: north, width: 1.2, height: 2.2}
    - {between: [0xA9B40150, outdoors], side: south, width: 1.2, height: 2.2}
  buildings:
    - pose: {cell: 0xA9B40011, origin: [100, 50, 94], yaw: 30}
      geometry: {tree: front, shapes: [{wall: {length: 6, height: 3}}]}
      portals: [0xA9B40150]
  objects:
    - {id: 0x70000001, pose: {cell: 0xA9B40150, origin: [100, 50, 94], yaw: 0}, state: [static], \
weenie: [pk], cylspheres: [[0, 0, 0, 0.3, 1]]}
mover: {spheres: one-sphere, state: []}
query:
  op: transition
  from: {cell: 0xA9B40150, origin: [100, 50, 94.4], yaw: 0}
  to: {cell: 0xA9B40150, origin: [100, 50.1, 94.4], yaw: 0}
"""
FLOOR = "{tree: both, shapes: [{floor: {size: [1, 1]}}]}"
STATIC = f"{{pose: {{origin: [0, 0, 0], yaw: 0}}, scale: 1, geometry: {FLOOR}}}"
POINT = "[[0, 0, 0, 0]]"
ROOM = "{id: 0xA9B40150, pose: {origin: [0, 0, 0], yaw: 0}, geometry: null}"
POSE = "{cell: 0xA9B40150, origin: [0, 0, 0], yaw: 0}"
PORTAL = "[[3, 5, 0], [3, 7, 0], [3, 7, 2], [3, 5, 2]]"

BAD = {
    "formula of a name": ("94 + x / 24", "94 + depth", 8, 35, "'depth' in the formula", "x, y, i, j"),
    "formula that runs code": ("94 + x / 24", "exit()", 8, 35, "'exit()' in the formula", "x, y, i, j"),
    "formula that is none": ("94 + x / 24", "94 +", 8, 35, "the formula '94 +'", "numbers"),
    "formula over zero": ("94 + x / 24", "94 / x", 8, 35, "at x = 0", "a finite number everywhere"),
    "formula without a frame": ("  landblock: 0xA9B4\n", "", 7, 35, "a formula", "'landblock' in the scene"),
    "height above the table": ("94 + x / 24", "x * 5", 8, 35, "a height of 840 m", "0 to 800 m"),
    "height below the table": ("flat: 94", "flat: -1", 9, 32, "a height of -1 m", "0 to 800 m"),
    "two forms of heights": ("flat: 94", "flat: 94, map: []", 9, 7, "'flat', 'map'", "exactly one of"),
    "rows missing": ("flat: 94", "map: [[94]]", 9, 31, "1 rows", "9 rows"),
    "row too short": (
        "flat: 94",
        f"heights: [{', '.join(['[94]'] * 9)}]",
        9,
        36,
        "1 heights",
        "9 heights",
    ),
    "height in a table": (
        "flat: 94",
        f"heights: [{', '.join(['[1, 1, 1, 1, 1, 1, 1, 1, 1]'] * 8)}, [1, 1, 1, 1, 1, 1, 1, 1, 801]]",
        9,
        293,
        "a height of 801 m",
        "0 to 800 m",
    ),
    "height on a map": (
        "flat: 94",
        f"map: [[900, 1, 1, 1, 1, 1, 1, 1, 1], {', '.join(['[1, 1, 1, 1, 1, 1, 1, 1, 1]'] * 8)}]",
        9,
        33,
        "a height of 900 m",
        "0 to 800 m",
    ),
    "statics in a world": (
        "      stab: all\n",
        f"      stab: all\n      statics: [{STATIC}]\n",
        15,
        16,
        "'statics' in a world",
        "'objects' of the scene",
    ),
    "the same cell twice": (
        "- id: 0xA9B40151",
        "- id: 0xA9B40150",
        15,
        11,
        "0xA9B40150 again",
        "each cell once",
    ),
    "landblock twice": ("[0xA9B5]", "[0xA9B4]", 9, 16, "0xA9B4 twice", "each landblock once"),
    "landblock off the map": ("[0xA9B5]", "[0xFFB5]", 9, 16, "0xFFB5", "0x0000 to 0xFEFE"),
    "landblock of 32 bits": ("[0xA9B5]", "[0xA9B50001]", 9, 17, "the number 2847211521", "16 bits"),
    "area backwards": ("to: [8, 2]", "to: [8, -1]", 8, 81, "the number -1", "greater than or equal to 0"),
    "area that ends before": ("from: [0, 0]", "from: [0, 3]", 8, 58, "from [0, 3] to [8, 2]", "south-west"),
    "terrain type": ("type: 16", "type: 32", 8, 91, "the number 32", "less than or equal to 31"),
    "no volume": (
        "contains: {room: true}, shapes: [{room: {size: [6, 6, 3]}}]",
        "shapes: [{room: {size: [6, 6, 3]}}]",
        13,
        17,
        "no 'contains' in a world",
        "the volume of the cell",
    ),
    "volume of no room": (
        "shapes: [{room: {size: [6, 6, 3]}}]",
        "shapes: [{floor: {size: [6, 6]}}]",
        13,
        41,
        "no room among the shapes",
        "'low' and 'high'",
    ),
    "no geometry": (
        "{tree: front, contains: {room: true}, shapes: [{room: {size: [6, 6, 3]}}]}",
        "null",
        13,
        17,
        "nothing (null)",
        "a geometry in a world",
    ),
    "land cell as a cell": ("- id: 0xA9B40151", "- id: 0xA9B40011", 15, 11, "0xA9B40011", "an interior cell"),
    "stab list of a word": ("stab: all", "stab: none", 14, 13, "the text 'none'", "'all', or a list"),
    "portal to a cell that is loaded after all": (
        "0xA9B40152",
        "0xA9B40151",
        20,
        16,
        "with 'loaded: false'",
        "not in this scene",
    ),
    "portal of a cell to itself": (
        f"0xA9B40152, polygon: {PORTAL}, loaded: false",
        f"0xA9B40151, polygon: {PORTAL}",
        20,
        11,
        "a portal from 0xA9B40151 to itself",
        "another cell",
    ),
    "portal to an unknown cell": (", loaded: false", "", 20, 16, "a portal to 0xA9B40152", "`loaded: false`"),
    "portal into another landblock": (
        "0xA9B40152",
        "0xA9B50152",
        20,
        11,
        "into landblock 0xA9B5",
        "same landblock",
    ),
    "portal to a land cell": (
        "0xA9B40152",
        "0xA9B40001",
        20,
        11,
        "0xA9B40001",
        "an interior cell, or outdoors",
    ),
    "portal to nowhere": (
        "to: 0xA9B40152",
        "to: outside",
        20,
        16,
        "the text 'outside'",
        "did you mean 'outdoors'?",
    ),
    "portal not flat": (
        PORTAL,
        PORTAL.replace("[3, 7, 2]", "[3.5, 7, 2]"),
        20,
        11,
        "off the polygon's plane",
        "flat",
    ),
    "portal of two corners": (PORTAL, "[[3, 5, 0], [3, 7, 0]]", 20, 37, "2 items", "at least 3"),
    "portal inside the cell": (
        PORTAL,
        PORTAL.replace("[3,", "[2,"),
        20,
        11,
        "inside the volume",
        "'side', 0 or 1",
    ),
    "portal with a third side": ("loaded: false", "side: 2, loaded: false", 20, 89, "the number 2", "0 or 1"),
    "portal without polygon": (
        "- {to: 0xA9B40152, polygon: " + PORTAL + ", loaded: false}",
        "- 0xA9B40150",
        20,
        11,
        "without a polygon",
        "or a doorway",
    ),
    "doorway of an unknown cell": (
        "[0xA9B40150, 0xA9B40151]",
        "[0xA9B40150, 0xA9B40155]",
        22,
        30,
        "the cell 0xA9B40155",
        "a cell of this scene",
    ),
    "doorway in no wall": ("side: north", "side: east", 22, 7, "no wall of the other room", "touches it"),
    "doorway too wide": ("width: 1.2", "width: 6.2", 22, 7, "to 6.1 m", "a hole within 0 to 6 m"),
    "doorway of no side": ("side: north", "side: top", 22, 49, "the text 'top'", "'north'"),
    "building on no land": (
        "origin: [100, 50, 94], yaw: 30}\n      geometry: {tree: front, shapes: [{wall",
        "origin: [-1, 50, 94], yaw: 30}\n      geometry: {tree: front, shapes: [{wall",
        25,
        40,
        "in no loaded landblock",
        "on loaded land",
    ),
    "building of a room without a door": (
        "portals: [0xA9B40150]",
        "portals: [0xA9B40151]",
        27,
        17,
        "which has no portal to outdoors",
        "{cell, portal}",
    ),
    "building with a portal too many": (
        "portals: [0xA9B40150]",
        "portals: [{cell: 0xA9B40150, portal: 2}]",
        27,
        17,
        "portal 2 of 0xA9B40150",
        "one of its 2 portals",
    ),
    "object of no id": ("0x70000001", "0", 29, 12, "the number 0", "greater than or equal to 1"),
    "object with an unknown state": (
        "state: [static]",
        "state: [statik]",
        29,
        89,
        "the text 'statik'",
        "'static'",
    ),
    "weenie with an unknown flag": ("weenie: [pk]", "weenie: [npc]", 29, 107, "the text 'npc'", "'creature'"),
    "object of no height": ("0.3, 1]", "0.3, 0]", 29, 125, "(0.300000012, 0)", "sizes greater than 0"),
    "object registered in an unknown cell": (
        "weenie: [pk]",
        "registered: [0xA9B40150, 0xA9B40159]",
        29,
        123,
        "the cell 0xA9B40159",
        "0xA9B40150, 0xA9B40151",
    ),
    "object nowhere": (
        "pose: {cell: 0xA9B40150, origin: [100, 50, 94], yaw: 0}",
        "pose: {cell: 0xA9B40159, origin: [1, 1, 1], yaw: 0}",
        29,
        30,
        "registers in no cell",
        "or 'registered'",
    ),
    "begin cell": (
        "op: transition",
        "op: transition\n  begin_cell: 0xA9B40150",
        33,
        15,
        "'begin_cell' in a world",
        "only 'from'",
    ),
    "transition from an unknown cell": (
        "from: {cell: 0xA9B40150",
        "from: {cell: 0xA9B40158",
        33,
        16,
        "the cell 0xA9B40158",
        "0xA9B40150, 0xA9B40151, 0xA9B40001 to 0040",
    ),
    "geometry beside the world": (
        "  landblock: 0xA9B4\n",
        "  landblock: 0xA9B4\n  geometry: {tree: both, shapes: [{floor: {size: [1, 1]}}]}\n",
        6,
        3,
        "the keys 'cells', 'geometry'",
        "either 'geometry' or the others",
    ),
}

OTHER_QUERIES = {
    "point in an unloaded cell": (
        "op: point_in_cell\n  cell: 0xA9B60001\n  point: [0, 0, 0]\n",
        "the cell 0xA9B60001",
    ),
    "land of an interior cell": (
        "op: land_find_terrain_poly\n  cell: 0xA9B40155\n  point: [0, 0, 0]\n",
        "the cell 0xA9B40155",
    ),
    "terrain of an unloaded block": ("op: terrain_block\n  block: 0xA9B6\n", "the landblock 0xA9B6"),
    "three spheres": (
        "op: find_cell_list\n  position: {cell: 1, origin: [0, 0, 0]}\n  spheres: " + str([[0, 0, 0, 1]] * 3),
        "3 items",
    ),
    "an object without a size": (
        f"op: cross_cells\n  static: 1\n  object: {{id: 1, pose: {POSE}, state: [], spheres: {POINT}}}\n",
        "(0)",
    ),
    "an object that is registered already": (
        f"op: cross_cells\n  static: 1\n  object: {{id: 1, pose: {POSE}, state: [], registered: []}}\n",
        "the cells",
    ),
}


@pytest.fixture
def file(tmp_path: Path) -> Path:
    """Return where a case is written."""
    return tmp_path / "world.yaml"


def test_the_good_world_is_good(file: Path) -> None:
    """The mistakes below are the only ones."""
    file.write_text(GOOD, encoding="utf-8")
    loaded = load_file(file)
    assert [str(problem) for problem in loaded.problems] == []
    (case,) = loaded.cases
    assert case.op == "world_transition"


@pytest.mark.parametrize("name", BAD)
def test_a_mistake_in_a_world_is_located(name: str, file: Path) -> None:
    """There is a problem at the place of the mistake, and it names it."""
    old, new, line, column, found, expected = BAD[name]
    assert old in GOOD
    file.write_text(GOOD.replace(old, new, 1), encoding="utf-8")
    loaded = load_file(file)
    assert loaded.cases == ()
    told = [(problem.location.line, problem.location.column, problem.found) for problem in loaded.problems]
    matching = [
        problem
        for problem in loaded.problems
        if found in problem.found and expected in f"{problem.expected} {problem.hint}"
    ]
    assert matching, told
    assert (line, column) in {(problem.location.line, problem.location.column) for problem in matching}


@pytest.mark.parametrize("name", OTHER_QUERIES)
def test_a_mistake_in_a_query_of_a_world_is_found(name: str, file: Path) -> None:
    """What a query names must be there, and what it is given must fit."""
    query, found = OTHER_QUERIES[name]
    head = GOOD[: GOOD.index("mover:")]
    file.write_text(head + "query:\n  " + query, encoding="utf-8")
    loaded = load_file(file)
    assert any(found in problem.found for problem in loaded.problems), loaded.problems


def test_the_same_object_and_building_twice(file: Path) -> None:
    """An id is an object's own; of two buildings in a land cell retail takes the first."""
    text = GOOD.replace(
        "  objects:\n", "  objects:\n" + GOOD[GOOD.index("    - {id: 0x7") : GOOD.index("mover:")]
    )
    building = GOOD[GOOD.index("    - pose: {cell: 0xA9B40011") : GOOD.index("  objects:")]
    file.write_text(text.replace("  buildings:\n", f"  buildings:\n{building}"), encoding="utf-8")
    found = [problem.found for problem in load_file(file).problems]
    assert found == ["the object id 0x70000001 twice"]


def test_restrictions_are_of_cells_of_the_scene(file: Path) -> None:
    """Each cell is told at its own place."""
    restrictions = "  restrictions:\n    - {cells: [0xA9B40150, 0xA9B40159, 0xA9B60001]}\n"
    file.write_text(GOOD.replace("mover:", f"{restrictions}mover:", 1), encoding="utf-8")
    problems = load_file(file).problems
    assert [problem.path for problem in problems] == [
        "scene.restrictions[0].cells[1]",
        "scene.restrictions[0].cells[2]",
    ]
    assert [problem.found for problem in problems] == ["the cell 0xA9B40159", "the cell 0xA9B60001"]


def test_a_cell_of_less_detail_is_not_there(file: Path) -> None:
    """A query that needs a land cell is told that the scene has it not, as of a block that is not loaded."""
    head = GOOD[: GOOD.index("mover:")].replace('formula: "94 + x / 24"', "flat: 94, side_cell_count: 4")
    assert "side_cell_count" in head
    query = "query: {op: land_find_terrain_poly, cell: 0xA9B40001, point: [1, 1, 94]}\n"
    file.write_text(head + query, encoding="utf-8")
    assert "the cell 0xA9B40001" in [problem.found for problem in load_file(file).problems]


def test_a_formula_is_told_once(file: Path) -> None:
    """However many of its heights are wrong, the first is told, with its height."""
    file.write_text(GOOD.replace("94 + x / 24", "801 + x"), encoding="utf-8")
    (problem,) = load_file(file).problems
    assert problem.found == "a height of 801 m"


def test_all_mistakes_of_a_world_at_once(file: Path) -> None:
    """Terrain, cells, portals, doorways, buildings and objects are all looked at, in one go."""
    text = GOOD
    for old, new in [
        ("flat: 94", "flat: 900"),
        ("side: south", "side: floor"),
        ("side: north, width: 1.2", "side: north, width: 7"),
        ("[0, 0, 0, 0.3, 1]", "[0, 0, 0, 0.3, -1]"),
        ("portals: [0xA9B40150]", "portals: [0xA9B40151]"),
    ]:
        assert old in text
        text = text.replace(old, new, 1)
    file.write_text(text, encoding="utf-8")
    lines = [problem.location.line for problem in load_file(file).problems]
    assert {9, 22, 27, 29} <= set(lines)
    assert lines == sorted(lines)


@pytest.mark.parametrize(
    ("scene", "found"),
    [
        ("{cells: [{id: 0xA9B40150, pose: {origin: [0, 0, 0], yaw: 0}, geometry: null}]}", "no object"),
        (
            f"{{cells: [{ROOM}], objects: [{{id: 1, pose: {POSE}, state: [], spheres: {POINT}}}]}}",
            "(0)",
        ),
        (
            f"{{cells: [{ROOM}], terrain: [{{blocks: [1], flat: 1}}], objects: []}}",
            "more than a cell and objects",
        ),
        ("{landblock: 0xA9B4}", "the keys 'landblock'"),
        ("{cells: [], objects: []}", "0 items"),
    ],
)
def test_scenes_that_do_not_do_for_an_object_call(scene: str, found: str, file: Path) -> None:
    """It needs one cell and objects."""
    pose = "{cell: 0xA9B40150, origin: [0, 0, 0], yaw: 0}"
    head = "id: a\ntitle: t\nwhy: w\nretail: [CPhysicsObj::FindObjCollisions]\n"
    query = f"query: {{op: object_call, function: object, at: {pose}, path: {{}}}}\n"
    file.write_text(
        f"{head}scene: {scene}\nmover: {{spheres: one-sphere, state: []}}\n{query}", encoding="utf-8"
    )
    assert any(found in problem.found for problem in load_file(file).problems)
