"""From a scene with land, doorways and objects to the WORLD block of FORMAT.md."""

from __future__ import annotations

from itertools import pairwise
from typing import TYPE_CHECKING, Any

import pytest

from conformance.candidates.registry import make_candidate
from conformance.case_query import WORLD_OPS
from conformance.case_references import is_loaded, known_cells
from conformance.case_registration import sorting_sphere
from conformance.cli import main
from conformance.floats import to_float32
from conformance.loader import load_file
from conformance.query import Result
from conformance.scenes.algebra import length, subtract
from conformance.schema.scene import SceneModel

if TYPE_CHECKING:
    from pathlib import Path

    from conformance.case import Case
    from conformance.query import Query

HEAD = "id: a-world\ntitle: t\nwhy: w\nretail: [CObjCell::find_cell_list]\nvary: {poses: 3}\n"
CELLS = """\
  cells:
    - {id: 0xA9B40100, pose: {origin: [100, 60, 94], yaw: 90}, stab: all,
       geometry: {tree: front, contains: {room: true}, shapes: [{room: {size: [6, 4, 3]}}]}}
    - {id: 0xA9B40101, pose: {origin: [96, 60, 94], yaw: 0}, stab: [0xA9B40100],
       geometry: {tree: front, contains: {room: true}, shapes: [{room: {size: [4, 6, 3]}}]}}
"""
DOORS = """\
  doorways:
    - {between: [0xA9B40100, 0xA9B40101], side: north, width: 1, height: 2, offset: -1}
    - {between: [0xA9B40100, outdoors], side: south, width: 1, height: 2}
    - {between: [0xA9B40101, 0xA9B40100], side: east, width: 1, height: 2, offset: 1}
"""
LAND = "  landblock: 0xA9B4\n  terrain: [{blocks: [0xA9B4], flat: 94}]\n"
BUILDING = """\
  buildings:
    - pose: {cell: 0xA9B40001, origin: [100, 60, 94], yaw: 0}
      geometry: {tree: front, shapes: [{wall: {length: 6, height: 3}}]}
      portals: [0xA9B40100, {cell: 0xA9B40101, portal: 0}, {cell: 0xA9B40177, portal: 4}]
"""
OBJECTS = """\
  objects:
    - {id: 7, pose: {cell: 0xA9B40100, origin: [98, 60, 94], yaw: 0}, state: [static],
       cylspheres: [[0, 0, 0, 0.5, 1]]}
    - {id: 5, pose: {cell: 0xA9B40100, origin: [100, 60, 94], yaw: 0}, state: [], spheres: [[0, 0, 1, 0.5]]}
    - {id: 6, pose: {cell: 0xA9B40100, origin: [100, 60, 94], yaw: 0}, state: [], registered: [0xA9B40101]}
    - {id: 8, pose: {cell: 0xA9B40100, origin: [100, 60, 94], yaw: 0}, state: [ethereal],
       weenie: [], registered: []}
"""
MOVER = "mover: {spheres: one-sphere, state: []}\n"
POSE = "{cell: 0xA9B40100, origin: [100, 60, 95], yaw: 0}"
PLACE = "position: {cell: 0xA9B40100, origin: [100, 60, 95]}"
LIST = f"query: {{op: find_cell_list, {PLACE}, spheres: [[100, 60, 95, 1]]}}\n"
LAND_CALL = f"cell: 0xA9B40001, at: {POSE}, path: {{}}"
WALKABLE = "sphere: [1, 1, 95, 1], plane: [0, 0, 1, -94], is_water: false, water_depth: 0"
BODY = "{spheres: one-sphere, state: [], transient_state: []}"
MOVED = {
    *("transition", "walk", "land_find_env_collisions", "land_validate_walkable"),
    *("find_transitional_position", "check_entry_restrictions"),
}
QUERIES = {
    "transition": f"from: {POSE}, to: {POSE}",
    "transition that places": f"from: null, to: {POSE}",
    "walk": f"start: {POSE}, ticks: [{{still: 1}}]",
    "body_walk": f"body: {BODY}, start: {POSE}, quantum: 0.1, ticks: [{{still: 1}}]",
    "find_cell_list": f"{PLACE}, spheres: [[100, 60, 95, 1]], do_not_load: true",
    "find_transit_cells": f"{PLACE}, cell: 0xA9B40100, spheres: [], array: [0xA9B40100]",
    "check_building_transit": f"{PLACE}, cell: 0xA9B40100, portal_id: -1, spheres: []",
    "add_all_outside_cells": "position: {cell: 0xA9B40001, origin: [1, 1, 1]}, spheres: []",
    "cross_cells": f"static: true, object: {{id: 1, pose: {POSE}, state: []}}",
    "point_in_cell": "cell: 0xA9B40001, point: [1, 1, 1]",
    "land_find_terrain_poly": "cell: 0xA9B40001, point: [1, 1, 1]",
    "land_find_env_collisions": LAND_CALL,
    "land_validate_walkable": f"{LAND_CALL}, {WALKABLE}",
    "terrain_block": "block: 0xA9B4",
    "find_transitional_position": f"from: {POSE}, to: {POSE}, insert_type: placement",
    "check_entry_restrictions": f"cell: 0xA9B40001, {PLACE}",
    "find_visible_child_cell": "cell: 0xA9B40100, point: [1, 1, 1], search_stabs: true",
    "registration": "calls: [{object: 7, call: enter}, {object: 7, call: leave}]",
    "place_body": f"body: {BODY}, start: {POSE}, to: {POSE}, flags: [slide], cell: null",
}
"""Keys of queries by operation, and what is particular about them."""


@pytest.fixture
def load(tmp_path: Path) -> Any:
    """Return what loads a case of a scene and a query."""

    def loading(scene: str, query: str = LIST) -> Case:
        file = tmp_path / "world.yaml"
        file.write_text(f"{HEAD}scene:\n{scene}{query}", encoding="utf-8")
        loaded = load_file(file)
        assert [str(problem) for problem in loaded.problems] == []
        (case,) = loaded.cases
        return case

    return loading


def world_of(case: Case) -> dict[str, Any]:
    """Return the world of a case's first query."""
    world: dict[str, Any] = case.queries[0].inputs["world"]
    return world


def test_land_alone(load: Any) -> None:
    """A scene may be land without a cell; words are of areas, absent without any."""
    terrain = (
        "  terrain:\n"
        "    - {blocks: [0xA9B4], flat: 94, areas: [{from: [0, 0], to: [0, 1], type: 16}]}\n"
        f"    - {{blocks: [0xA9B5], map: {[[float(row)] * 9 for row in range(9)]}}}\n"
    )
    world = world_of(load(terrain))
    south, north = world["landblocks"]
    assert south["terrain"] == [64, 64] + [0] * 79
    assert north["heights"] == [8.0, 7.0, 6.0, 5.0, 4.0, 3.0, 2.0, 1.0, 0.0] * 9
    assert "terrain" not in north
    assert (world["cells"], world["buildings"], world["objects"], world["shadow"]) == ([], [], [], {})


def test_doorways_make_portals_on_both_sides(load: Any) -> None:
    """In the order of the file, facing into the first cell, and each knows the one that leads back."""
    first, second = world_of(load(LAND + CELLS + DOORS))["cells"]
    assert [(p["other"], p["side"], p["other_portal"]) for p in first["portals"]] == [
        (0xA9B40101, 0, 0),
        (None, 0, 0),
        (0xA9B40101, 1, 1),
    ]
    assert [(p["other"], p["side"], p["other_portal"]) for p in second["portals"]] == [
        (0xA9B40100, 1, 0),
        (0xA9B40100, 0, 2),
    ]
    assert first["portals"][0]["polygon"] == [[-1.5, 2, 0], [-0.5, 2, 0], [-0.5, 2, 2], [-1.5, 2, 2]]
    # Turned by 90 degrees and 4 m further west: local (x, 2) of the first is (2, x) of the second.
    assert second["portals"][0]["polygon"] == [[2, -1.5, 0], [2, -0.5, 0], [2, -0.5, 2], [2, -1.5, 2]]


def test_doorways_are_cut(load: Any) -> None:
    """Two openings in a wall leave three columns of it and what is over each: five polygons more."""
    case = load(LAND + CELLS + DOORS)
    names = [cell["geometry"] for cell in world_of(case)["cells"]]
    plain = load(LAND + CELLS)
    for name in names:
        geometry, closed = case.queries[0].geometries[name], plain.queries[0].geometries[name]
        assert len(closed.polygons) == 6
        assert len(geometry.polygons) == 6 - 1 + 5 + (2 if name == names[0] else 0)


def test_listed_portals_come_first(load: Any) -> None:
    """Those of a cell before those of the doorways; the side is told by the volume unless it is given."""
    corners = "[[3, -1, 0], [3, 1, 0], [3, 1, 2], [3, -1, 2]]"
    portals = (
        f"       portals: [{{to: 0xA9B40102, polygon: {corners}, loaded: false}},\n"
        f"                 {{to: outdoors, polygon: {corners}, side: 0, other_portal: 3}}],\n"
    )
    scene = LAND + CELLS.replace("       geometry", portals + "       geometry", 1) + DOORS
    first = world_of(load(scene))["cells"][0]
    assert [(p["other"], p["side"], p["other_portal"]) for p in first["portals"][:3]] == [
        (0xA9B40102, 1, 0),
        (None, 0, 3),
        (0xA9B40101, 0, 0),
    ]


def test_stab_lists(load: Any) -> None:
    """`all` is every other cell of the scene, in its order."""
    first, second = world_of(load(LAND + CELLS))["cells"]
    assert (first["stab"], second["stab"]) == ([0xA9B40101], [0xA9B40100])


def test_buildings(load: Any) -> None:
    """A cell stands for all its portals that lead outdoors; a single portal may be of an unloaded cell."""
    (building,) = world_of(load(LAND + CELLS + DOORS + BUILDING))["buildings"]
    assert building["portals"] == [
        {"other": 0xA9B40100, "other_portal": 1},
        {"other": 0xA9B40101, "other_portal": 0},
        {"other": 0xA9B40177, "other_portal": 4},
    ]


def test_objects_are_registered_as_retail_does(load: Any) -> None:
    """Where they reach, or where the file says; in each cell in the order of the file."""
    world = world_of(load(LAND + CELLS + DOORS + OBJECTS))
    assert world["shadow"] == {str(0xA9B40100): [7, 5], str(0xA9B40101): [7, 6]}
    assert [thing["id"] for thing in world["objects"]] == [7, 5, 6, 8]
    assert world["objects"][3]["weenie"] == {}


def test_a_particle_emitter_is_in_its_own_cell_alone(load: Any) -> None:
    """However far it reaches."""
    emitter = OBJECTS.replace("state: [static]", "state: [static, particle_emitter]").replace(
        "[98, 60", "[98.2, 60"
    )
    both = world_of(load(LAND + CELLS + DOORS + OBJECTS))["shadow"]
    own = world_of(load(LAND + CELLS + DOORS + emitter))["shadow"]
    assert [len(shadow[str(0xA9B40101)]) for shadow in (both, own)] == [2, 1]
    assert own[str(0xA9B40100)] == both[str(0xA9B40100)]


RESTRICTIONS = """\
  restrictions:
    - {cells: [0xA9B40100, 0xA9B40001], admits: [5, 7]}
    - {cells: [0xA9B40101], known: false}
"""


def test_restrictions_are_of_single_cells(load: Any) -> None:
    """Whoever is admitted to several is written with each; a shift moves the cells, not the ids."""
    case = load(LAND + CELLS + DOORS + RESTRICTIONS)
    house = {"object": 1, "admits": [5, 7]}
    closed = {"object": 0, "admits": []}
    assert world_of(case)["restrictions"] == {
        str(0xA9B40100): house,
        str(0xA9B40001): house,
        str(0xA9B40101): closed,
    }
    shifted = case.queries[1].inputs["world"]
    cells = [cell["id"] for cell in shifted["cells"]]
    assert shifted["restrictions"][str(cells[0])] == house
    assert shifted["restrictions"][str(cells[1])] == closed


def test_worlds_as_real_ones(load: Any) -> None:
    """What real worlds have and FORMAT.md lacks; it is absent from a record unless it is written."""
    scene = (
        "  terrain: [{blocks: [0xA9B4], flat: 94}, {blocks: [0xA9B5], flat: 94, side_cell_count: 4}]\n"
        "  cells:\n"
        "    - {id: 0xA9B40100, pose: {origin: [1, 2, 3], yaw: 0}, stab: [], portal_array: false,\n"
        "       geometry: {tree: front, contains: {room: true}, shapes: [{room: {size: [6, 4, 3]}}]}}\n"
        "  buildings:\n"
        "    - {pose: {cell: 0xA9B40001, origin: [1, 2, 3], yaw: 0}, geometry: null, landblock: 0xA9B5}\n"
        "  objects:\n"
        "    - {id: 7, pose: {cell: 0xA9B40001, origin: [1, 2, 94], yaw: 0}, state: [], registered: [],\n"
        "       attached: [5], parts: [{geometry: {tree: front, shapes: [{box: {size: [1, 1, 1]}}]},\n"
        "       physics: false, drawing_sphere: [0, 0, 0.5, 1], flat: true}]}\n"
        "    - {id: 5, pose: {cell: 0xA9B40001, origin: [1, 2, 94], yaw: 0}, state: [], registered: []}\n"
    )
    world = world_of(load(scene))
    assert [block.get("side_cell_count") for block in world["landblocks"]] == [None, 4]
    assert world["cells"][0]["portals"] is None
    (building,) = world["buildings"]
    assert (building["geometry"], building["block"]) == (None, 0xA9B5)
    holder, held = world["objects"]
    assert (holder["attached"], "attached" in held) == ([5], False)
    (part,) = holder["parts"]
    assert (part["no_physics"], part["drawing_sphere"], part["flat"]) == (1, [0.0, 0.0, 0.5, 1.0], 1)


def test_who_moves_at_a_house(load: Any) -> None:
    """The game object of a mover, and that of a body, by their flags."""
    mover = MOVER.replace("state: []", "state: [], id: 7, weenie: [bypass]")
    case = load(LAND + CELLS, f"{mover}query: {{op: transition, from: null, to: {POSE}}}\n")
    assert case.queries[0].inputs["mover"]["weenie"] == {"bypass": 1}
    body = "{spheres: one-sphere, state: [], transient_state: [], id: 7, weenie: [player]}"
    query = f"query: {{op: body_walk, body: {body}, start: {POSE}, quantum: 0.1, ticks: [{{still: 1}}]}}\n"
    block = load(LAND + CELLS, query).queries[0].inputs["body"]
    assert (block["id"], block["weenie"]) == (7, {"player": 1})


def test_a_sorting_sphere_holds_its_spheres() -> None:
    """About the middle of their box, rounded to float32."""
    spheres = [(0.0, 0.0, 0.5, 0.5), (0.0, 0.0, 2.0, 0.3)]
    x, y, z, radius = sorting_sphere(spheres)
    assert (x, y, z) == (0.0, 0.0, to_float32(1.15))
    for sphere in spheres:
        assert length(subtract(sphere[:3], (x, y, z))) + sphere[3] <= radius + 1e-6


@pytest.mark.parametrize("name", QUERIES)
def test_every_operation_of_a_world_has_an_answer(load: Any, name: str) -> None:
    """Asked in one scene, and shifted by landblocks; retail answers each."""
    keys = QUERIES[name]
    op = name.split(maxsplit=1)[0]
    mover = "" if op not in MOVED else MOVER
    case = load(LAND + CELLS + DOORS + BUILDING + OBJECTS, f"{mover}query: {{op: {op}, {keys}}}\n")
    assert case.op == WORLD_OPS.get(op, op)
    oracle = make_candidate("oracle")
    assert len(case.queries) == (1 if op == "terrain_block" else 4)
    asked: Query
    for asked in case.queries:
        assert isinstance(oracle.answer(asked), Result), oracle.answer(asked)


@pytest.mark.parametrize(
    "query",
    [
        "op: terrain_split, block: 0xFFFF",
        "op: find_time_of_collision, movement: [1, 0, 0], disp: [2, 0, 0], radsum: 1",
        "op: landdefs_gid_to_lcoord, cell: 0",
        "op: landdefs_lcoord_to_gid, x: -1, y: 2040",
        "op: landdefs_adjust_to_outside, cell: 0xA9B40001, point: [-1, 1, 1]",
        "op: landdefs_get_block_offset, from_cell: 0xA9B40001, to_cell: 0xAAB40001",
    ],
)
def test_operations_without_a_scene(query: str, tmp_path: Path) -> None:
    """They take ids and numbers as they are, and have no other pose."""
    file = tmp_path / "alone.yaml"
    file.write_text(f"{HEAD}query: {{{query}}}\n", encoding="utf-8")
    (case,) = load_file(file).cases
    assert len(case.queries) == 1
    assert isinstance(make_candidate("oracle").answer(case.queries[0]), Result)


def test_an_object_call(load: Any) -> None:
    """The only cell and the objects, in the order of the file; the cell may be without geometry."""
    cell = "  cells: [{id: 0xA9B40100, pose: {origin: [0, 0, 0], yaw: 0}, geometry: null}]\n"
    query = (
        f"{MOVER}query: {{op: object_call, function: cell_objects, at: {POSE}, path: {{walk_interp: 1}}}}\n"
    )
    case = load(cell + OBJECTS, query)
    inputs = case.queries[0].inputs
    assert inputs["cell"]["geometry"] is None
    assert [thing["id"] for thing in inputs["objects"]] == [7, 5, 6, 8]
    assert "world" not in inputs
    assert len(case.queries) == 4
    transition = f"{MOVER}query: {{op: object_transition, from: null, to: {POSE}}}\n"
    assert load(cell + OBJECTS, transition).queries[0].inputs["from"] is None


def test_a_mover_of_part_2(load: Any) -> None:
    """Ids are given when they are written; an ethereal mover has the bit of its state, as in records."""
    plain = f"{MOVER}query: {{op: transition, from: null, to: {POSE}}}\n"
    assert {"id", "missile", "target_id"}.isdisjoint(load(LAND + CELLS, plain).queries[0].inputs["mover"])
    more = "id: 7, missile: true, target_id: 5, ethereal: true"
    mover = load(LAND + CELLS, plain.replace("state: []", f"state: [pk, ignore_creatures], {more}", 1))
    inputs = mover.queries[0].inputs["mover"]
    assert (inputs["id"], inputs["missile"], inputs["target_id"], inputs["ethereal"]) == (7, 1, 5, 4)
    assert inputs["state"] == 0xC00


def test_worlds_without_land_turn(load: Any) -> None:
    """Any rigid pose; with land whole landblocks."""
    free, bound = load(CELLS + DOORS), load(LAND + CELLS + DOORS)
    ids = [world["cells"][0]["id"] for world in (query.inputs["world"] for query in free.queries)]
    assert set(ids) == {0xA9B40100}
    origins = [query.inputs["world"]["cells"][0]["pose"]["origin"] for query in bound.queries]
    assert origins == [[100.0, 60.0, 94.0]] * 4
    assert len({query.inputs["world"]["cells"][0]["id"] for query in bound.queries}) == 4


def test_the_trace_tells_each_change_of_cell(capsys: pytest.CaptureFixture[str]) -> None:
    """In through the door and out again: four lines, from cell to cell."""
    case = "walk-from-the-grass-into-the-room"
    assert main(["trace", case, "--trace", "cell-transit"]) == 0
    lines = [line for line in capsys.readouterr().out.splitlines() if line.startswith("[cell-transit]")]
    way = ["0xA9B40029", "0xA9B40150", "0xA9B4013F", "0xA9B40150", "0xA9B40029"]
    for line, (old, new) in zip(lines, pairwise(way), strict=True):
        assert f"{old} -> {new}" in line


def test_a_message_names_only_cells_that_are_there() -> None:
    """Land of less detail has none of its own."""
    terrain = [{"blocks": [0xA9B4], "flat": 94.0}, {"blocks": [0xA9B5], "flat": 94.0, "side_cell_count": 4}]
    scene = SceneModel.model_validate({"terrain": terrain})
    assert known_cells(scene) == "0xA9B40001 to 0040"
    assert [is_loaded(cell, scene) for cell in (0xA9B40001, 0xA9B50001)] == [True, False]
