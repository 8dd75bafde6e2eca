"""Mistakes that authors make: each is told with line and column, what was found, what was expected."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from conformance.loader import load_file

if TYPE_CHECKING:
    from pathlib import Path

GOOD = """\
id: good-case
title: A case without a mistake
why: Everything below changes one thing in it.
retail: [BSPTREE::step_sphere_down SD-9]
tags: [step-down]
scene:
  cells:
    - id: 0xA9B40151
      pose: {origin: [100, 50, 94], yaw: 45}
      geometry:
        tree: both
        shapes:
          - floor: {size: [10, 10]}
          - polygons: [[[0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]]]
      statics:
        - {pose: {origin: [0, 0, 0], quaternion: [1, 0, 0, 0]}, scale: 2, \
geometry: {tree: front, shapes: [{box: {size: [1, 1, 1]}}]}}
      portals: [0xA9B40151]
mover: {spheres: one-sphere, state: [contact, on_walkable]}
query:
  op: transition
  from: {cell: 0xA9B40151, origin: [100, 50, 94.4], yaw: 0}
  to: {cell: 0xA9B40151, origin: [100, 50, 94.4], yaw: 0}
  begin_cell: 0xA9B40151
  seed: {contact: {plane: [0, 0, 1, -94], cell: 0xA9B40151, is_water: false}}
expect:
  result: true
  contact_plane:
    d: {value: -94, tolerance: 1e-4, unit: m, inclusive: true, reason: as an example}
  walk_interp: 1
  state: [contact]
vary: {poses: 3}
"""

BAD = {
    "unknown key": ("title:", "titel:", 2, 1, "the unknown key 'titel'", "did you mean 'title'?"),
    "missing id": ("id: good-case\n", "", 1, 1, "no 'id'", "the key 'id'"),
    "id with capitals": ("good-case", "Good_Case", 1, 5, "the text 'Good_Case'", "lower-case words"),
    "empty title": ("A case without a mistake", "''", 2, 8, "the text ''", "some text"),
    "wrong type": ("[100, 50, 94], yaw", "[100, fifty, 94], yaw", 9, 28, "the text 'fifty'", "a number"),
    "number as text": ("[10, 10]", "['10', 10]", 13, 28, "the text '10'", "a number"),
    "truth value as number": ("[10, 10]", "[true, 10]", 13, 28, "the truth value true", "a number"),
    "not a number": ("yaw: 45", "yaw: .nan", 9, 42, "the number .nan", "a finite number"),
    "infinite number": ("yaw: 45", "yaw: -.inf", 9, 42, "the number -.inf", "a finite number"),
    "number beyond float32": ("[10, 10]", "[1e39, 10]", 13, 28, "the number 1e+39", "fits in a float32"),
    "scaled pose": (
        "yaw: 45",
        "matrix: [[2, 0, 0], [0, 2, 0], [0, 0, 2]]",
        9,
        46,
        "length 2 in cell 0xa9b40151",
        "no scale",
    ),
    "sheared pose": (
        "yaw: 45",
        "matrix: [[1, 0, 0], [0.6, 0.8, 0], [0, 0, 1]]",
        9,
        45,
        "product 0.6",
        "no shear",
    ),
    "mirrored pose": (
        "yaw: 45",
        "matrix: [[1, 0, 0], [0, 1, 0], [0, 0, -1]]",
        9,
        45,
        "a mirror image",
        "a rotation",
    ),
    "quaternion not of unit length": (
        "quaternion: [1, 0, 0, 0]",
        "quaternion: [2, 0, 0, 0]",
        16,
        50,
        "squared length 4 in cell 0xA9B40151",
        "1 within",
    ),
    "quaternion too short": (
        "quaternion: [1, 0, 0, 0]",
        "quaternion: [1, 0, 0]",
        16,
        50,
        "a list of 3",
        "a longer list",
    ),
    "no rotation": (", yaw: 45", "", 9, 13, "no rotation", "exactly one of"),
    "two rotations": (
        "yaw: 45",
        "yaw: 45, quaternion: [1, 0, 0, 0]",
        9,
        13,
        "the rotations 'yaw', 'quaternion'",
        "exactly one of",
    ),
    "open polygon": (
        "[[0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]]",
        "[[0, 0, 1], [1, 0, 1]]",
        14,
        24,
        "2 corners",
        "3 to 255 corners",
    ),
    "polygon not flat": (
        "[1, 1, 1], [0",
        "[1, 1, 1.5], [0",
        14,
        24,
        "off the polygon's plane",
        "a flat polygon",
    ),
    "polygon not convex": ("[1, 1, 1], [0, 1, 1]", "[0.2, 0.2, 1], [0, 1, 1]", 14, 24, "outside", "convex"),
    "polygon without area": ("[1, 1, 1], [0, 1, 1]", "[2, 0, 1]", 14, 24, "an area of 0", "at least"),
    "corner twice": (
        "[1, 1, 1], [0, 1, 1]",
        "[1, 0, 1], [0, 1, 1]",
        14,
        24,
        "corners 1 and 2 both at",
        "each corner once",
    ),
    "corner with two numbers": ("[1, 1, 1], [0", "[1, 1], [0", 14, 47, "a list of 2", "a longer list"),
    "unknown primitive": ("floor:", "flor:", 13, 13, "the unknown key 'flor'", "did you mean 'floor'?"),
    "unknown parameter of a primitive": (
        "{size: [10, 10]}",
        "{siz: [10, 10]}",
        13,
        20,
        "no 'size'",
        "the key 'size'",
    ),
    "negative size": ("[10, 10]", "[-10, 10]", 13, 28, "the number -10", "greater than 0"),
    "half a placement": (
        "{size: [10, 10]}",
        "{size: [10, 10], yaw: 3}",
        13,
        20,
        "only 'yaw'",
        "both 'at' and 'yaw'",
    ),
    "unknown tree style": ("tree: both", "tree: bth", 11, 15, "the text 'bth'", "did you mean 'both'?"),
    "scale of zero": ("scale: 2", "scale: 0", 16, 72, "the number 0", "greater than 0"),
    "portal to nowhere": (
        "portals: [0xA9B40151]",
        "portals: [0xA9B40152]",
        17,
        17,
        "a portal to 0xA9B40152",
        "a cell of this scene",
    ),
    "unknown op": (
        "op: transition",
        "op: transitoin",
        20,
        7,
        "the op 'transitoin'",
        "did you mean 'transition'?",
    ),
    "no op": ("  op: transition\n", "", 20, 3, "no 'op'", "the key 'op'"),
    "missing input": ("  begin_cell: 0xA9B40151\n", "", 20, 3, "no 'begin_cell'", "the key 'begin_cell'"),
    "cell that is not in the scene": (
        "begin_cell: 0xA9B40151",
        "begin_cell: 0xA9B40199",
        23,
        15,
        "the cell 0xA9B40199",
        "a cell of the scene",
    ),
    "cell id beyond 32 bits": (
        "begin_cell: 0xA9B40151",
        "begin_cell: 0x1A9B40151",
        23,
        15,
        "the number",
        "a cell id",
    ),
    "cell id as text": (
        "begin_cell: 0xA9B40151",
        "begin_cell: A9B40151",
        23,
        15,
        "the text 'A9B40151'",
        "a whole number",
    ),
    "op without mover": (
        "mover: {spheres: one-sphere, state: [contact, on_walkable]}\n",
        "",
        1,
        1,
        "no 'mover'",
        "the mover that transition works on",
    ),
    "scene of another kind": (
        "  cells:\n",
        "  geometry:\n",
        7,
        3,
        "a scene with 'geometry'",
        "a scene with 'cells'",
    ),
    "unknown mover preset": (
        "one-sphere",
        "one-spere",
        18,
        18,
        "the text 'one-spere'",
        "did you mean 'one-sphere'?",
    ),
    "unknown state": (
        "[contact, on_walkable]",
        "[contact, walking]",
        18,
        47,
        "the text 'walking'",
        "one of 'contact'",
    ),
    "state as a number": (
        "state: [contact, on_walkable]",
        "state: 3",
        18,
        37,
        "the number 3",
        "a list of state names",
    ),
    "flag that is none": ("is_water: false", "is_water: no", 24, 71, "the text 'no'", "true, false, 1 or 0"),
    "unknown retail function": (
        "step_sphere_down",
        "step_sphere_dwn",
        4,
        10,
        "the function 'BSPTREE::step_sphere_dwn'",
        "step_sphere_down",
    ),
    "unknown retail step": ("SD-9", "SD-99", 4, 10, "the step 'SD-99'", "did you mean 'SD-9'?"),
    "no citation": ("[BSPTREE::step_sphere_down SD-9]", "[]", 4, 9, "0 items", "at least 1"),
    "unknown output": (
        "walk_interp: 1",
        "walk_interpol: 1",
        29,
        18,
        "the field 'walk_interpol'",
        "did you mean 'walk_interp'?",
    ),
    "output of a wrong type": ("walk_interp: 1", "walk_interp: OK", 29, 16, "'OK'", "a number"),
    "tolerance without a reason": (
        ", reason: as an example",
        "",
        28,
        8,
        "only 'inclusive', 'tolerance', 'unit', 'value'",
        "together",
    ),
    "negative tolerance": (
        "tolerance: 1e-4",
        "tolerance: -1e-4",
        28,
        32,
        "the number -0.0001",
        "greater than 0",
    ),
    "tolerance on a flag": ("result: true", "result: {bits: 1}", 26, 11, "a tolerance or bits", "a flag"),
    "unknown state in expect": (
        "state: [contact]",
        "state: [contakt]",
        30,
        11,
        "the text 'contakt'",
        "did you mean 'contact'?",
    ),
    "vary as a number": ("vary: {poses: 3}", "vary: 3", 31, 7, "the number 3", "false, or a mapping"),
    "negative number of poses": (
        "poses: 3",
        "poses: -3",
        31,
        15,
        "the number -3",
        "greater than or equal to 0",
    ),
    "duplicate key": (
        "vary: {poses: 3}",
        "tags: [again]",
        31,
        1,
        "the key 'tags' a second time (first at 5:1)",
        "each key once",
    ),
    "case that is a list": ("id: good-case", "- id", 2, 1, "a YAML syntax error", ""),
}


def test_the_good_case_is_good(tmp_path: Path) -> None:
    """The mistakes below are the only ones."""
    file = tmp_path / "good.yaml"
    file.write_text(GOOD, encoding="utf-8")
    loaded = load_file(file)
    assert loaded.problems == ()
    assert [case.id for case in loaded.cases] == ["good-case"]


@pytest.mark.parametrize("name", BAD)
def test_a_mistake_is_located(name: str, tmp_path: Path) -> None:
    """There is a problem at the place of the mistake, and it names it."""
    old, new, line, column, found, expected = BAD[name]
    assert old in GOOD
    file = tmp_path / "bad.yaml"
    file.write_text(GOOD.replace(old, new, 1), encoding="utf-8")
    loaded = load_file(file)
    assert loaded.cases == ()
    problem = next(
        problem
        for problem in loaded.problems
        if (problem.location.line, problem.location.column) == (line, column)
    )
    assert found in problem.found
    assert expected in f"{problem.expected} {problem.hint}"
    assert problem.source_line == file.read_text(encoding="utf-8").splitlines()[line - 1]


def test_enough_kinds_of_mistakes() -> None:
    """At least 25 kinds are pinned."""
    assert len(BAD) >= 25


def test_all_mistakes_of_a_file_at_once(tmp_path: Path) -> None:
    """Head, scene, mover, query and expectations are all looked at, in one go and in file order."""
    text = GOOD
    for old, new in [
        ("good-case", "Good"),
        ("[BSPTREE::step_sphere_down SD-9]", "[BSPTREE::nothing]"),
        ("yaw: 45", "matrix: [[2, 0, 0], [0, 1, 0], [0, 0, 1]]"),
        ("[1, 1, 1], [0", "[1, 1, 1.5], [0"),
        ("[contact, on_walkable]", "[flying]"),
        ("begin_cell", "begin_sell"),
        ("vary: {poses: 3}", "vary: true"),
    ]:
        text = text.replace(old, new, 1)
    file = tmp_path / "bad.yaml"
    file.write_text(text, encoding="utf-8")
    problems = load_file(file).problems
    assert [problem.location.line for problem in problems] == [1, 4, 9, 14, 18, 20, 23, 31]


def test_a_mistake_in_one_case_does_not_lose_the_others(tmp_path: Path) -> None:
    """The other cases of the file can be run; the problems say whose they are."""
    cases = [GOOD, GOOD.replace("good-case", "bad-case").replace("yaw: 45", "yaw: .nan"), GOOD]
    cases[2] = cases[2].replace("good-case", "other-case")
    text = "cases:\n" + "".join("  - " + case.replace("\n", "\n    ").rstrip(" ") for case in cases)
    file = tmp_path / "mixed.yaml"
    file.write_text(text, encoding="utf-8")
    loaded = load_file(file)
    assert [case.id for case in loaded.cases] == ["good-case", "other-case"]
    assert [problem.case_id for problem in loaded.problems] == ["bad-case"]


def test_the_same_id_twice_in_a_file(tmp_path: Path) -> None:
    """Both places are named; the first case stays."""
    text = "cases:\n" + 2 * ("  - " + GOOD.replace("\n", "\n    ").rstrip(" "))
    file = tmp_path / "twice.yaml"
    file.write_text(text, encoding="utf-8")
    loaded = load_file(file)
    assert len(loaded.cases) == 1
    (problem,) = loaded.problems
    assert problem.location.line == 33
    assert "again (first at " in problem.found
    assert "twice.yaml:2:5)" in problem.found


@pytest.mark.parametrize(
    ("text", "line", "column", "found"),
    [
        ("", 1, 1, "nothing (null)"),
        ("- a\n- b\n", 1, 1, "a list of 2"),
        ("just text\n", 1, 1, "the text 'just text'"),
        ("cases: []\n", 1, 8, "a list of 0"),
        ("cases: {id: a}\n", 1, 8, "a mapping with the keys 'id'"),
        ("cases: [1]\n", 1, 9, "the number 1"),
        ("cases: [a]\ntitle: x\n", 1, 9, "the text 'a'"),
    ],
)
def test_files_that_hold_no_case(text: str, line: int, column: int, found: str, tmp_path: Path) -> None:
    """A file without a case is a mistake as well: nothing is passed over in silence."""
    file = tmp_path / "none.yaml"
    file.write_text(text, encoding="utf-8")
    loaded = load_file(file)
    assert loaded.cases == ()
    problem = loaded.problems[0]
    assert (problem.location.line, problem.location.column) == (line, column)
    assert problem.found == found
