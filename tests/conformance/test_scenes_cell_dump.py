"""Cell dumps are imported as they are, and bad ones are refused with the place."""

from __future__ import annotations

import json
import struct
from typing import TYPE_CHECKING, Any

import pytest

from conformance.scenes.importers.cell_dump import DumpFolder, load_folder, read_cell, read_object
from conformance.scenes.importers.dump_json import DumpError
from conformance.scenes.model import Geometry, Scene, walk_tree
from conformance.scenes.planes import signed_distance
from conformance.scenes.rotations import rows_from_quaternion
from conformance.scenes.validate import check_geometry, check_scene

if TYPE_CHECKING:
    from pathlib import Path

FLOOR = {
    "id": 0,
    "sides": 0,
    "plane": [0, 0, 1, 0],
    "v": [[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]],
}
CELL: dict[str, Any] = {
    "cell": "0xA9B40151",
    "rotation_rows": [[-1, 8.74228e-08, 0], [-8.74228e-08, -1, 0], [0, 0, 1]],
    "origin": [130.5, 11.5, 94],
    "polygons": [FLOOR],
    "portals": [
        {"other_cell": 0x0152, "polygon": 0, "flags": 1},
        {"other_cell": 0xFFFF, "polygon": 0, "flags": 5},
        {"other_cell": 0x0152, "polygon": 1, "flags": 1},
    ],
}


def written(folder: Path, record: object, name: str = "0xA9B40151.json") -> Path:
    """Write a dump and return its file."""
    file = folder / name
    file.write_text(json.dumps(record), encoding="utf-8", newline="\n")
    return file


def test_cell(tmp_path: Path) -> None:
    """Id, pose, polygons and neighbours of a cell; portals to outdoors and repeated ones are left out."""
    cell = read_cell(written(tmp_path, CELL))
    assert cell.id == cell.pose.cell == 0xA9B40151
    assert cell.pose.origin == (130.5, 11.5, 94.0)
    assert cell.pose.rotation == (4.3711398944878965e-08, 0.0, 0.0, 1.0)
    assert cell.portals == (0xA9B40152,)
    assert cell.geometry is not None
    assert cell.geometry.corners(0)[2] == (1.0, 1.0, 0.0)
    assert cell.geometry.cell_planes is None


def test_object(tmp_path: Path) -> None:
    """An object is a geometry in its own frame, called by its id."""
    shape = read_object(written(tmp_path, {"gfxobj": "0x01000A2B", "polygons": [FLOOR]}))
    assert (shape.name, len(shape.polygons)) == ("0x01000A2B", 1)


def test_negative_zero_keeps_its_sign(tmp_path: Path) -> None:
    """-0 in a dump is a float, whatever JSON readers make of it."""
    file = written(tmp_path, CELL)
    text = file.read_text(encoding="utf-8").replace("[1, -1, 0]", "[1, -1, -0]")
    file.write_text(text, encoding="utf-8", newline="\n")
    geometry = read_cell(file).geometry
    assert geometry is not None
    assert struct.pack("<f", geometry.corners(0)[1][2]) == b"\x00\x00\x00\x80"


def test_folder(tmp_path: Path) -> None:
    """A folder gives its cells by id and its objects by name, and leaves other files alone."""
    written(tmp_path, CELL)
    written(tmp_path, {"gfxobj": "0x01000A2B", "polygons": [FLOOR]}, "0x01000A2B.gfxobj.json")
    (tmp_path / "README.md").write_text("not a dump", encoding="utf-8")
    folder = load_folder(tmp_path)
    assert (list(folder.cells), list(folder.objects)) == ([0xA9B40151], ["0x01000A2B"])


def test_folder_with_a_cell_twice(tmp_path: Path) -> None:
    """A file that is not called after what it holds is refused, so that no id is there twice."""
    written(tmp_path, CELL)
    written(tmp_path, CELL, "0xA9B40152.json")
    with pytest.raises(DumpError, match=r"0xA9B40152\.json: found 0xA9B40151 in a file of another name"):
        load_folder(tmp_path)


@pytest.mark.parametrize(("name", "found"), [("", "no dump"), ("absent", "no such folder")])
def test_folder_without_dumps(tmp_path: Path, name: str, found: str) -> None:
    """An empty or absent folder is an error, not an empty answer."""
    with pytest.raises(DumpError, match=f": found {found}, expected files named"):
        load_folder(tmp_path / name)


def changed_polygon(**change: object) -> dict[str, Any]:
    """Return a cell whose only polygon is changed."""
    return {**CELL, "polygons": [{**FLOOR, **change}]}


def without(key: str) -> dict[str, Any]:
    """Return a cell without a key."""
    return {name: value for name, value in CELL.items() if name != key}


@pytest.mark.parametrize(
    ("record", "path", "found"),
    [
        ([], "", "list []"),
        (without("cell"), "", "no 'cell'"),
        (without("origin"), "", "no 'origin'"),
        (without("polygons"), "", "no 'polygons'"),
        ({**CELL, "cell": 5}, "cell", "int 5"),
        ({**CELL, "cell": "cellar"}, "cell", "'cellar'"),
        ({**CELL, "cell": "-0x1"}, "cell", "'-0x1'"),
        ({**CELL, "cell": "9" * 6000}, "cell", f"'{'9' * 40}'"),
        ({**CELL, "origin": [0, 0]}, "origin", "2 numbers"),
        ({**CELL, "origin": [0, 0, "94"]}, "origin[2]", "str '94'"),
        (
            {**CELL, "rotation_rows": [[2, 0, 0], [0, 1, 0], [0, 0, 1]]},
            "rotation_rows[0]",
            "a row of length 2 in cell 0xa9b40151",
        ),
        ({**CELL, "polygons": [{}]}, "polygons[0]", "no 'v'"),
        (changed_polygon(id=4), "polygons[0].id", "4"),
        (changed_polygon(v=FLOOR["v"][:2]), "polygons[0]", "2 corners"),  # type: ignore[index]
        (changed_polygon(v=[[0, 0, 0], [1, 0, 0], 3]), "polygons[0].v[2]", "int 3"),
        (
            changed_polygon(plane=[0, 0, -1, 0]),
            "polygons[0].plane",
            "a normal at -1 (cosine) to that of the corners",
        ),
        ({**CELL, "portals": [{"polygon": 1}]}, "portals[0]", "no 'other_cell'"),
        ({**CELL, "portals": 3}, "portals", "int 3"),
    ],
)
def test_bad_cells(tmp_path: Path, record: object, path: str, found: str) -> None:
    """Missing keys, wrong types and bad values are located in the file."""
    file = written(tmp_path, record)
    with pytest.raises(DumpError) as raised:
        read_cell(file)
    assert (raised.value.path, raised.value.found) == (path, found)
    assert raised.value.file == str(file)
    assert str(raised.value).startswith(str(file))


@pytest.mark.parametrize(
    ("text", "line", "column"),
    [(b'{"cell": "0xA9B40151",\n "origin": [1, 2', 2, 17), (b"", 1, 1), (b'{"a" 1}', 1, 6)],
)
def test_truncated_json(tmp_path: Path, text: bytes, line: int, column: int) -> None:
    """Text that is not JSON is located by line and column."""
    file = tmp_path / "0xA9B40151.json"
    file.write_bytes(text)
    with pytest.raises(DumpError) as raised:
        read_cell(file)
    assert (raised.value.line, raised.value.column) == (line, column)


@pytest.mark.parametrize(
    ("text", "found"),
    [
        (b'{"origin": [NaN, 0, 0]}', "NaN"),
        (b'{"origin": [1e999, 0, 0]}', "1e999"),
        (b'{"cell": "\xff"}', "byte 0xff at offset 10"),
        (b'{"origin": [' + b"9" * 5000 + b", 0, 0]}", "a number of 5000 digits"),
        (b"[" * 100_000, "lists or objects nested too deeply"),
        (b'{"cell": "0xA9B40151", "cell": "0xA9B40152"}', "the key 'cell' twice in an object"),
        (b'{"cell": "\\ud83d"}', "half a character, U+D83D"),
        (b" " * ((1 << 24) + 1), "more than 16777216 bytes"),
    ],
    ids=("nan", "infinite", "encoding", "digits", "nested", "twice", "half", "long"),
)
def test_text_that_no_dump_holds(tmp_path: Path, text: bytes, found: str) -> None:
    """NaN, infinities, bytes that are not UTF-8, and what is too long or too deep are refused."""
    file = tmp_path / "0xA9B40151.json"
    file.write_bytes(text)
    with pytest.raises(DumpError) as raised:
        read_cell(file)
    assert raised.value.found == found


def test_absent_file(tmp_path: Path) -> None:
    """A file that is not there is an error of the dump."""
    with pytest.raises(DumpError, match="expected a readable file"):
        read_cell(tmp_path / "0xA9B40151.json")


@pytest.fixture(scope="module")
def real(fixtures_dir: Path) -> DumpFolder:
    """Return the dumped folder."""
    return load_folder(fixtures_dir)


def test_real_folder_is_whole(real: DumpFolder) -> None:
    """All 22 cells and 4 objects are imported and valid."""
    assert (len(real.cells), len(real.objects)) == (22, 4)
    check_scene(Scene(tuple(real.cells.values())))
    for shape in real.objects.values():
        check_geometry(shape, shape.name)


def test_real_cells_keep_their_numbers(real: DumpFolder, fixtures_dir: Path) -> None:
    """Poses and corners are the dump's, rounded to float32; planes agree with the corners."""
    for cell in real.cells.values():
        record = json.loads((fixtures_dir / f"0x{cell.id:08X}.json").read_text(encoding="utf-8"))
        rows = rows_from_quaternion(cell.pose.rotation)
        for mine, dumped in zip(rows, record["rotation_rows"], strict=True):
            assert mine == pytest.approx(dumped, abs=1e-9)
        assert cell.geometry is not None
        assert len(cell.geometry.polygons) == len(record["polygons"])
        for i, polygon in enumerate(record["polygons"]):
            for corner, dumped in zip(cell.geometry.corners(i), polygon["v"], strict=True):
                assert corner == pytest.approx(dumped, rel=1e-7)
                assert abs(signed_distance(tuple(polygon["plane"]), corner)) < 1e-4


def test_real_trees_are_small(real: DumpFolder) -> None:
    """Cutting does not blow the trees of real cells up: less than eight nodes a polygon."""
    geometries: list[Geometry] = [cell.geometry for cell in real.cells.values() if cell.geometry is not None]
    assert geometries
    for geometry in geometries:
        assert sum(1 for _ in walk_tree(geometry.tree)) < 8 * len(geometry.polygons)
