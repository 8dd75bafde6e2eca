"""Import of cell dumps: a folder of ``<cell id>.json`` and ``<object id>.gfxobj.json`` files.

A cell file holds ``cell``, ``rotation_rows`` (row vectors: ``world = local * rows + origin``),
``origin``, ``polygons`` and ``portals``; an object file holds ``gfxobj`` and ``polygons``. A polygon is
``id``, ``sides``, ``plane`` and its corner points ``v``. There is no BSP tree in a dump: it is built.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Final, TypeVar

from conformance.scenes.algebra import dot, round_point
from conformance.scenes.bsp_builder import TreeStyle, build
from conformance.scenes.errors import SceneError
from conformance.scenes.importers.dump_json import MAX_DIGITS, DumpError, read_json
from conformance.scenes.model import Cell, Geometry, Pose
from conformance.scenes.planes import unit_normal
from conformance.scenes.readers import each, floats_of, member, text, whole
from conformance.scenes.rotations import quaternion_from_rows
from conformance.scenes.validate import check, polygon_errors, pose_errors

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

    from conformance.scenes.polygons import Corners, Shape

T = TypeVar("T")

CELL_FILES: Final = "0x????????.json"
OBJECT_FILES: Final = "0x????????.gfxobj.json"

_ID: Final = re.compile("0x[0-9a-fA-F]{8}")
OUTDOORS: Final = 0xFFFF
"""What a portal to the landscape has in place of a cell; `read_cell` leaves such portals out."""
LANDBLOCK: Final = 0xFFFF0000
"""The bits of a cell id that name its landblock."""
STYLE: Final = TreeStyle.FRONT
"""Cells are not closed (portals are holes), so no leaf behind a wall is known to be solid."""
FACING: Final = 0.999
"""Smallest cosine between a dumped plane's normal and the corners' own: the winding agrees."""


@dataclass(frozen=True, slots=True)
class DumpFolder:
    """What a folder of dumps holds, each in order of file names.

    Attributes
    ----------
    cells : dict of int to Cell
        By cell id, without static objects (dumps name none).
    objects : dict of str to Geometry
        By object id as written, like ``0x01000A2B``.
    """

    cells: dict[int, Cell]
    objects: dict[str, Geometry]


def load_folder(folder: Path) -> DumpFolder:
    """Read every dump of a folder.

    Raises
    ------
    DumpError
        There is no such folder, no dump in it, or one that cannot be read or is not called after its id.
    """
    cells = [_named(file, cell, cell.id) for file, cell in _read_all(folder, CELL_FILES, read_cell)]
    objects = [
        _named(file, shape, int(shape.name, 16))
        for file, shape in _read_all(folder, OBJECT_FILES, read_object)
    ]
    if not cells and not objects:
        expected = f"files named {CELL_FILES} or {OBJECT_FILES}"
        found = "no dump" if folder.is_dir() else "no such folder"
        raise DumpError(str(folder), SceneError("", found, expected))
    return DumpFolder({cell.id: cell for cell in cells}, {shape.name: shape for shape in objects})


def _read_all(folder: Path, pattern: str, read: Callable[[Path], T]) -> list[tuple[Path, T]]:
    return [(file, read(file)) for file in sorted(folder.glob(pattern))]


def _named(file: Path, dump: T, own_id: int) -> T:
    """Return a dump whose file is called after it, so that no id is there twice."""
    if file.name.partition(".")[0].upper() != f"0X{own_id:08X}":
        wrong = SceneError(
            "", f"0x{own_id:08X} in a file of another name", "each dump in a file of its own id"
        )
        raise DumpError(str(file), wrong)
    return dump


def read_cell(file: Path) -> Cell:
    """Read a cell: its pose, its collision polygons with a built tree, its neighbours.

    Parameters
    ----------
    file : Path
        A cell dump.

    Returns
    -------
    Cell
        The geometry is in the cell's frame and has no cell planes, so it contains every point: the
        cell's own containment tree is not dumped.

    Raises
    ------
    DumpError
        The file is not JSON, a key is missing or of a wrong type, the matrix is not rigid, a polygon is
        not valid or does not face as its plane says.
    """
    return _located(file, _cell)


def read_object(file: Path) -> Geometry:
    """Read an object's collision polygons, in the object's frame, with a built tree.

    Raises
    ------
    DumpError
        As for `read_cell`.
    """
    return _located(file, _object)


def _located(file: Path, read: Callable[[Any], T]) -> T:
    record = read_json(file)
    try:
        return read(record)
    except SceneError as error:
        raise DumpError(str(file), error) from error


def _cell(record: Any) -> Cell:
    name = text(member(record, "cell", ""), "cell")
    cell_id = _id(name, "cell")
    rows = each(record, "rotation_rows", "", floats_of(3))
    origin = round_point(floats_of(3)(member(record, "origin", ""), "origin"))
    pose = Pose(cell_id, origin, quaternion_from_rows(rows, "rotation_rows", cell_id))
    check(pose_errors(pose, ""))
    others = each(record, "portals", "", _other_cell)
    portals = [cell_id & LANDBLOCK | other for other in others if other != OUTDOORS]
    return Cell(cell_id, pose, _geometry(record, name, "cell"), portals=tuple(dict.fromkeys(portals)))


def _object(record: Any) -> Geometry:
    name = text(member(record, "gfxobj", ""), "gfxobj")
    _id(name, "gfxobj")
    return _geometry(record, name, "object")


def _geometry(record: Any, name: str, kind: str) -> Geometry:
    shape: Shape = each(record, "polygons", "", dumped_polygon)
    ids = each(record, "polygons", "", lambda polygon, path: whole(member(polygon, "id", path), f"{path}.id"))
    for i, polygon_id in enumerate(ids):
        if polygon_id != i:
            raise SceneError(f"polygons[{i}].id", str(polygon_id), f"{i}: ids count up from 0")
    return build(name, shape, style=STYLE, kind=kind)


def dumped_polygon(record: Any, path: str) -> Corners:
    """Return the corners of a polygon that is valid and faces as its dumped plane says."""
    corners = tuple(round_point(corner) for corner in each(record, "v", path, floats_of(3)))
    check(polygon_errors(corners, path))
    nx, ny, nz, _ = floats_of(4)(member(record, "plane", path), f"{path}.plane")
    facing = dot((nx, ny, nz), unit_normal(corners))
    if not facing >= FACING:
        found = f"a normal at {facing:.6g} (cosine) to that of the corners"
        raise SceneError(f"{path}.plane", found, f"at least {FACING}: counter-clockwise from its front")
    return corners


def _other_cell(record: Any, path: str) -> int:
    return whole(member(record, "other_cell", path), f"{path}.other_cell")


def _id(written: str, path: str) -> int:
    if not _ID.fullmatch(written):
        raise SceneError(path, repr(written[:MAX_DIGITS]), "an id like 0xA9B40151")
    return int(written, 16)
