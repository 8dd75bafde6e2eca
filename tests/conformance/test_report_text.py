"""How a failure reads."""

from __future__ import annotations

import math

import pytest
from shipped_cases import shipped_cases
from shipped_vectors import VECTORS, records

from conformance.compare import Difference, Tolerance
from conformance.fields import MISSING
from conformance.report.scene import scene_line
from conformance.report.text import render_failure, summary_line
from conformance.report.values import format_value
from conformance.shapes import Kind

D_LOST = Difference("contact_plane.plane[3]", "contact_plane.d", Kind.FLOAT32, -94.0, 0.0)


def test_a_difference_in_one_line() -> None:
    """Field, both values in decimal and bits, and the distance."""
    assert summary_line(D_LOST, "bug:cell-origin") == (
        "contact_plane.d: retail -94.0 (0xC2BC0000), bug:cell-origin 0.0 (0x00000000), 1.1e9 ULPs"
    )


@pytest.mark.parametrize(
    ("difference", "text"),
    [
        (Difference("r", "r", Kind.FLAG, 1, 0), "r: retail 1, engine 0"),
        (Difference("result", "result", Kind.STATE, "OK", "SLID"), "result: retail OK, engine SLID"),
        (
            Difference("t", "t", Kind.FLOAT64, 0.1, math.nextafter(0.1, 1)),
            "t: retail 0.1 (0x3FB999999999999A), engine 0.10000000000000002 (0x3FB999999999999B), 1 ULP",
        ),
        (
            Difference("w", "w", Kind.FLOAT32, 0.0, -0.0, "the sign of zero"),
            "w: retail 0.0 (0x00000000), engine -0.0 (0x80000000), 0 ULPs, the sign of zero",
        ),
        (
            Difference(
                "w", "w", Kind.FLOAT32, 0.5, 0.50001, "not a float32", Tolerance(1e-6, "m", True, "rounding")
            ),
            (
                "w: retail 0.5 (0x3F000000), engine 0.50001 (0x3F0000A8), 168 ULPs, "
                "not a float32, allowed <= 1e-06 m (rounding)"
            ),
        ),
        (
            Difference("n", "n", Kind.BLOCK, None, [0.0, 0.47999998927116394, 1.0]),
            "n: retail none, engine [0.0, 0.48, 1.0]",
        ),
        (Difference("x", "x", Kind.CELL, 0xA9B40150, 5), "x: retail 0xA9B40150, engine 0x00000005"),
    ],
)
def test_differences_of_other_kinds(difference: Difference, text: str) -> None:
    """States, cells and flags read as what they are."""
    assert summary_line(difference, "engine") == text


@pytest.mark.parametrize(
    ("kind", "value", "text"),
    [
        (Kind.FLOAT32, math.nan, "nan (0x7FC00000)"),
        (Kind.FLOAT32, 1, "1.0 (0x3F800000)"),
        (Kind.FLOAT32, "0.5", "'0.5' (str)"),
        (Kind.MOVER_BITS, 0x203, "0x203 (contact, on_walkable, edge_slide)"),
        (Kind.MOVER_BITS, 0, "0x0"),
        (Kind.BITS, 0x81, "0x81"),
        (Kind.TEXT, "", '""'),
        (Kind.TEXT, "K1D3", "K1D3"),
        (Kind.POLYGON, None, "none"),
        (Kind.POLYGON, 4, "4"),
        (Kind.FLAG, True, "1"),
        (Kind.STATE, MISSING, "(absent)"),
        (Kind.BLOCK, list(range(100)), "[" + ", ".join(map(str, range(100)))[:68] + "..."),
        (Kind.BLOCK, {"valid": 1, "plane": [0.0]}, "{valid: 1, plane: [0.0]}"),
    ],
)
def test_values(kind: Kind, value: object, text: str) -> None:
    """Every kind of value has its way to be read; one of another type is shown with its type."""
    assert format_value(kind, value) == text


def test_a_whole_failure() -> None:
    """Case, differing fields side by side, the scene in a line, the command that reruns it."""
    query = records(VECTORS / "find_collisions.jsonl")[0].query
    differences = [Difference("result", "result", Kind.STATE, "OK", "ADJUSTED"), D_LOST]
    text = render_failure(
        case="origin[pose 3]",
        title="a floor",
        differences=differences,
        candidate="engine",
        query=query,
        rerun="pytest x.yaml",
    )
    assert text.splitlines() == [
        "origin[pose 3]: a floor",
        "",
        "  field            retail              engine            distance",
        "  result           OK                  ADJUSTED",
        "  contact_plane.d  -94.0 (0xC2BC0000)  0.0 (0x00000000)  1.1e9 ULPs",
        "",
        (
            "  scene: find_collisions; cell seed_tri (1 polygon) in 0xA9B40111 at (100.0, 50.0, 94.0) "
            "rotated (0.9238795, 0.0, 0.0, 0.38268343); 1 sphere of radius 0.48; from (100.0, 50.0, 94.5); "
            "to (100.0, 50.0, 94.5); path step_down 1, step_down_amt 0.5, walk_interp 1.0, "
            "walkable_allowance 0.66417414"
        ),
        "  rerun: pytest x.yaml",
    ]


def test_repeats_of_one_kind_are_cut() -> None:
    """After twenty differences of a kind only their number is told; other kinds are still shown."""
    query = records(VECTORS / "find_collisions.jsonl")[0].query
    many = [Difference(f"g[{i}]", f"g[{i}]", Kind.FLOAT32, 0.0, 1.0) for i in range(25)]
    other = Difference("result", "result", Kind.STATE, "OK", "SLID")
    text = render_failure(
        case="c", title="", differences=[*many, other], candidate="engine", query=query, rerun="r"
    )
    assert text.count("0x3F800000") == 20
    assert "  ... and 5 more of kind float32" in text
    assert "SLID" in text


@pytest.mark.parametrize(
    ("file", "said"),
    [
        ("transition.jsonl", "cell seed_tri (1 polygon) in 0xA9B40111 at (100.0, 50.0, 94.0)"),
        ("polygon.jsonl", "room_01 (7 polygons) polygon 1"),
        ("bsp.jsonl", "door_81"),
        ("math.jsonl", "plane_localtoglobal; from (172.44481, -123.869995, 173.27399); to (-73.04558"),
        ("world_transition.jsonl", "world w_sea1"),
    ],
)
def test_scenes_of_other_operations(file: str, said: str) -> None:
    """Every operation has its line, without line breaks."""
    line = scene_line(records(VECTORS / file)[0].query)
    assert said in line
    assert "\n" not in line


def test_every_shipped_record_has_a_scene_line() -> None:
    """No record of part 1 is beyond description."""
    for file in (
        "math.jsonl",
        "polygon.jsonl",
        "bsp.jsonl",
        "find_collisions.jsonl",
        "transition.jsonl",
        "walk.jsonl",
    ):
        assert all(scene_line(record.query).startswith(record.query.op) for record in records(VECTORS / file))


def test_every_built_in_query_has_a_scene_line() -> None:
    """An engine may fail any of them; a world that a case spells out may have no name."""
    queries = [query for case in shipped_cases().values() for query in case.queries]
    lines = [scene_line(query) for query in queries]
    assert all(line.startswith(query.op) for line, query in zip(lines, queries, strict=True))
    assert any("world world with" in line for line in lines)
