"""From files to cases: queries, random poses, unique ids, nothing lost in silence."""

from __future__ import annotations

import json
import sys
from pathlib import Path

import pytest
from shipped_cases import shipped_cases

from conformance.loader import (
    Loaded,
    NoCasesError,
    Vary,
    case_files,
    load_file,
    load_mentioning,
    load_paths,
)

STEP = """\
id: step
title: A case
why: To be loaded.
retail: [BSPTREE::find_collisions FC-5]
scene:
  cells:
    - id: 0xA9B40151
      pose: {origin: [1, 2, 3], yaw: 90}
      geometry:
        {tree: both, shapes: [{floor: {size: [2, 2], at: [5, 0, 0], yaw: 90}}, {box: {size: [1, 1, 1]}}]}
mover: {spheres: two-spheres, state: [contact]}
query:
  op: find_collisions
  at: {cell: 0xA9B40151, origin: [1, 2, 3.4], yaw: 0}
  path: {step_down: true, step_down_amt: 0.5}
"""
POINT = """\
id: point
title: A case
why: To be loaded.
retail: [CPolygon::make_plane MP-6]
scene: {geometry: {tree: front, shapes: [{floor: {size: [2, 2]}}]}}
query: {op: polygon_make_plane, poly: 0}
"""
VECTORS = Path(__file__).parents[2] / "conformance" / "vectors"


def write(folder: Path, name: str, text: str) -> Path:
    """Write a case file."""
    path = folder / name
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text, encoding="utf-8")
    return path


def test_a_scene_case_becomes_input_blocks(tmp_path: Path) -> None:
    """The query has the blocks of FORMAT.md, numbers float32, names resolved."""
    (case,) = load_file(write(tmp_path, "a.yaml", STEP)).cases
    inputs = case.queries[0].inputs
    assert case.op == "find_collisions"
    assert inputs["geometry"] == "step"
    assert inputs["as"] == "cell"
    assert inputs["scale"] == 1.0
    assert inputs["pose"]["origin"] == [1.0, 2.0, 3.0]
    assert inputs["pose"]["rotation"] == [0.7071067690849304, 0.0, 0.0, 0.7071067690849304]
    assert inputs["from"] == inputs["to"]
    assert inputs["to"]["origin"][2] == 3.4000000953674316
    assert inputs["mover"]["state"] == 1
    assert inputs["mover"]["spheres"][1] == [0.0, 0.0, 1.350000023841858, 0.47999998927116394]
    assert inputs["path"]["step_down"] == 1
    assert inputs["path"]["insert_type"] == 0
    assert inputs["seed"] == {}
    assert len(case.queries[0].geometries["step"].polygons) == 7
    assert case.queries[0].geometries["step"].vertices[0] == (6.0, -1.0, 0.0)


def test_a_static_is_called_with_its_own_pose_and_scale(tmp_path: Path) -> None:
    """A cell without geometry and with one static is a call on the static's tree."""
    static = (
        "geometry: null\n      statics:\n        - pose: {origin: [7, 8, 9], yaw: 0}\n          scale: 2\n"
    )
    text = STEP.replace("geometry:\n        {tree", f"{static}          geometry:\n            {{tree")
    (case,) = load_file(write(tmp_path, "a.yaml", text)).cases
    inputs = case.queries[0].inputs
    assert (inputs["as"], inputs["scale"], inputs["pose"]["origin"]) == ("static", 2.0, [7.0, 8.0, 9.0])


def test_scene_cases_are_also_run_in_random_poses(tmp_path: Path) -> None:
    """Eight poses by default, labelled; the first query is the case as written."""
    (case,) = load_file(write(tmp_path, "a.yaml", STEP)).cases
    assert [query.label for query in case.queries] == ["step", *(f"step[pose {n}]" for n in range(1, 9))]
    assert case.queries[3].inputs["pose"] != case.queries[0].inputs["pose"]
    assert case.queries[3].geometries is case.queries[0].geometries


def test_random_poses_are_the_same_in_every_run(tmp_path: Path) -> None:
    """They depend on the id only, or on the seed that the case or the user gives."""
    path = write(tmp_path, "a.yaml", STEP)
    inputs = [query.inputs for query in load_file(path).cases[0].queries]
    assert [query.inputs for query in load_file(path).cases[0].queries] == inputs
    seeded = [query.inputs for query in load_file(path, Vary(seed=5)).cases[0].queries]
    assert seeded[0] == inputs[0]
    assert seeded[1:] != inputs[1:]
    write(tmp_path, "b.yaml", STEP + "vary: {poses: 8, seed: 5}\n")
    assert [query.inputs for query in load_file(tmp_path / "b.yaml").cases[0].queries] == seeded


@pytest.mark.parametrize(
    ("vary", "asked", "count"),
    [
        ("", None, 9),
        ("", 50, 51),
        ("", 0, 1),
        ("vary: false\n", None, 1),
        ("vary: false\n", 50, 1),
        ("vary: {poses: 2}\n", None, 3),
        ("vary: {poses: 2}\n", 50, 51),
    ],
)
def test_how_many_poses(vary: str, asked: int | None, count: int, tmp_path: Path) -> None:
    """The user overrides the number, but not a case that says false."""
    (case,) = load_file(write(tmp_path, "a.yaml", STEP + vary), Vary(poses=asked)).cases
    assert len(case.queries) == count


def test_a_polygon_case_has_no_pose_to_vary(tmp_path: Path) -> None:
    """Its inputs are all in the geometry's own space."""
    (case,) = load_file(write(tmp_path, "a.yaml", POINT)).cases
    assert len(case.queries) == 1
    assert case.queries[0].inputs == {"geometry": "point", "poly": 0}


def test_a_vector_record_can_be_a_case(tmp_path: Path) -> None:
    """The raw form takes a record's inputs and its geometry as they are."""
    lines = (VECTORS / "find_collisions.jsonl").read_text(encoding="utf-8").splitlines()
    record = json.loads(lines[0])
    shapes = (VECTORS / "geometries.jsonl").read_text(encoding="utf-8").splitlines()
    geometry = next(shape for shape in map(json.loads, shapes) if shape["name"] == record["geometry"])
    inputs = {key: value for key, value in record.items() if key not in {"id", "op", "tag", "expect"}}
    raw = {"id": "raw", "title": "t", "why": "w", "retail": ["BSPTREE::find_collisions"], "vary": False}
    raw |= {"query": {"op": record["op"], "inputs": inputs}, "geometries": [geometry]}
    (case,) = load_file(write(tmp_path, "a.yaml", json.dumps(raw))).cases
    assert case.queries[0].inputs["mover"]["spheres"] == [[0.0, 0.0, 0.0, 0.47999998927116394]]
    assert set(case.queries[0].geometries) == {record["geometry"]}


def test_a_raw_query_without_its_geometry(tmp_path: Path) -> None:
    """The missing name is told at the inputs."""
    text = POINT.replace("scene: {geometry: {tree: front, shapes: [{floor: {size: [2, 2]}}]}}\n", "")
    text = text.replace("poly: 0}", "inputs: {geometry: nowhere, poly: 0}}")
    (problem,) = load_file(write(tmp_path, "a.yaml", text)).problems
    assert problem.found == "the geometry 'nowhere'"
    assert (problem.location.line, problem.path) == (5, "query.inputs")


def test_the_same_id_in_two_files(tmp_path: Path) -> None:
    """Both places are named; the case of the first file stays."""
    write(tmp_path, "a/one.yaml", POINT)
    write(tmp_path, "b/two.yaml", POINT)
    loaded = load_paths([tmp_path])
    assert len(loaded.cases) == 1
    (problem,) = loaded.problems
    assert "two.yaml" in problem.location.file
    assert "one.yaml:1:1)" in problem.found


def test_files_are_sorted(tmp_path: Path) -> None:
    """The order does not depend on the file system."""
    for name in ("b.yaml", "a/z.yml", "a.yaml", "c.txt"):
        write(tmp_path, name, POINT)
    names = [file.relative_to(tmp_path).as_posix() for file in case_files(tmp_path)]
    assert names == ["a.yaml", "a/z.yml", "b.yaml"]


def test_folders_that_pytest_does_not_enter_are_left_out(tmp_path: Path) -> None:
    """Copies that a build has made, and what is installed beside the cases; unless they are asked for."""
    (tmp_path / "env").mkdir()
    (tmp_path / "env" / "pyvenv.cfg").touch()
    for name in (
        "build/a.yaml",
        "dist/sub/a.yaml",
        ".git/a.yaml",
        "env/lib/a.yaml",
        "mine/a.yaml",
        ".hidden.yaml",
    ):
        write(tmp_path, name, POINT)
    assert [file.name for file in case_files(tmp_path)] == [".hidden.yaml", "a.yaml"]
    assert case_files(tmp_path / "build") == [tmp_path / "build" / "a.yaml"]


@pytest.mark.skipif(sys.platform == "win32", reason="Windows asks for a right to make links")
def test_a_file_and_a_link_to_it_are_one(tmp_path: Path) -> None:
    """Its cases are not there twice, and it stands where its first name does."""
    write(tmp_path, "b.yaml", POINT)
    (tmp_path / "a.yaml").symlink_to(tmp_path / "b.yaml")
    (tmp_path / "c.yaml").symlink_to(tmp_path / "b.yaml")
    assert case_files(tmp_path) == [tmp_path / "a.yaml"]
    assert load_paths([tmp_path]).problems == ()
    write(tmp_path, "aa.yaml", "")
    assert case_files(tmp_path) == [tmp_path / "a.yaml", tmp_path / "aa.yaml"]


def test_paths_may_overlap(tmp_path: Path) -> None:
    """A file of a folder that is named as well is read once."""
    write(tmp_path, "a.yaml", POINT)
    loaded = load_paths([tmp_path, tmp_path / "a.yaml"])
    assert (len(loaded.cases), loaded.problems) == (1, ())


def test_nothing_is_green_on_nothing(tmp_path: Path) -> None:
    """A mistyped path and an empty folder are errors."""
    with pytest.raises(NoCasesError, match="does not exist"):
        load_paths([tmp_path / "mistyped"])
    with pytest.raises(NoCasesError, match=r"no \*\.yaml file"):
        load_paths([tmp_path])


def test_the_built_in_cases() -> None:
    """They have pins, over every way through find_collisions and every kind of walk."""
    cases = shipped_cases().values()
    assert all(case.expect for case in cases)
    pins = {str(pin.value) for case in cases for pin in case.expect if pin.path == "dispatch"}
    assert pins == {
        "placement",
        "check_walkable",
        "step_down",
        "collide",
        "contact",
        "airborne",
        "path_clipped",
        "initial_placement",
    }
    walks = {case.op for case in cases if "walk" in case.tags}
    assert walks == {"walk", "world_walk", "body_walk"}


def test_a_case_stands_in_a_file_that_mentions_it() -> None:
    """No other is read; a word that stands nowhere is no mistake."""
    loaded = load_mentioning("origin-step-down-short", Vary(poses=0))
    assert loaded.problems == ()
    by_id = {case.id: case for case in loaded.cases}
    assert by_id["origin-step-down-short"].source == shipped_cases()["origin-step-down-short"].source
    assert len(by_id) < len(shipped_cases()) / 20
    assert load_mentioning("no-such-case") == Loaded()
