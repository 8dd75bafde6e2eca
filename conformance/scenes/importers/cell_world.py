"""Import of cell dumps as worlds: the cells of each building, with their portals and what is seen from them.

Besides what `conformance.scenes.importers.cell_dump` reads, a cell file holds ``portal_polygons`` (drawn
surfaces and portals, by their own ids), ``portals`` (``other_cell``, ``polygon``, ``flags``) and
``visible_cells``. A neighbour that is not in the folder is known by its id and not loaded.

The volume of a cell (its cell BSP) is not dumped. It is taken to be the convex hull that the cell's own
polygons and portals give, within the box of their corners: a cell that is not convex contains too much, and
where two cells overlap retail's rule decides, which takes the first of the list.
"""

from __future__ import annotations

from collections import defaultdict
from dataclasses import replace
from typing import TYPE_CHECKING, Any, Final, cast

from conformance.scenes.cell_planes import box_planes
from conformance.scenes.errors import SceneError
from conformance.scenes.importers.cell_dump import (
    CELL_FILES,
    LANDBLOCK,
    OUTDOORS,
    DumpFolder,
    dumped_polygon,
    load_folder,
)
from conformance.scenes.importers.dump_json import DumpError, read_json
from conformance.scenes.planes import plane_of, signed_distance
from conformance.scenes.readers import each, mapping, member, whole
from conformance.scenes.validate_world import check_world
from conformance.scenes.world_model import InteriorCell, Portal, World

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping, Sequence
    from pathlib import Path

    from conformance.scenes.model import Cell, Geometry, PlaneData
    from conformance.scenes.polygons import Corners

FACES_IN: Final = 0x2
"""Portal flag: the polygon faces into the cell, so the portal's side is 0 (09 2.1)."""
EXTERIOR: Final = 0x4
"""Portal flag: it leads outdoors (09 2.1)."""
HULL: Final = 1e-3
"""How far a corner may be behind a polygon that bounds the hull, metres: dumps have five digits."""


def load_worlds(folder: Path) -> list[World]:
    """Read the cells of a folder as worlds, one for each building.

    Cells belong together when portals lead from one to the other, also by way of a cell that was not dumped.

    Parameters
    ----------
    folder : Path
        Of cell dumps.

    Returns
    -------
    list of World
        In the order of their first cells; without land, objects and buildings, so that they may be turned.

    Raises
    ------
    DumpError
        There is no dump, or one that cannot be read or is not valid.
    """
    dumps = load_folder(folder)
    cells = {cell_id: _cell(folder, cell_id, dumps) for cell_id in dumps.cells}
    backs = {cell.id: _with_ways_back(cell, cells) for cell in cells.values()}
    worlds = [
        World(f"cells {group[0]:08X} to {group[-1]:08X}", cells=tuple(backs[id_] for id_ in group))
        for group in _groups(backs)
    ]
    for world in worlds:
        try:
            check_world(world)
        except SceneError as error:
            raise DumpError(str(folder), error) from error
    return worlds


def _cell(folder: Path, cell_id: int, dumps: DumpFolder) -> InteriorCell:
    (file,) = [file for file in folder.glob(CELL_FILES) if file.stem.upper() == f"0X{cell_id:08X}"]
    try:
        return _interior(read_json(file), dumps.cells[cell_id])
    except SceneError as error:
        raise DumpError(str(file), error) from error


def _interior(record: Any, cell: Cell) -> InteriorCell:
    shape = cast("Geometry", cell.geometry)  # a dump without polygons was refused before
    surfaces = dict(each(record, "portal_polygons", "", _surface))
    portals = each(record, "portals", "", lambda portal, path: _portal(portal, path, cell.id, surfaces))
    walls = [shape.corners(polygon) for polygon in range(len(shape.polygons))]
    inwards = [portal.polygon if portal.side == 0 else portal.polygon[::-1] for portal in portals]
    geometry = replace(shape, cell_planes=hull_planes([*walls, *inwards]))
    seen = each(record, "visible_cells", "", whole)
    return InteriorCell(cell.id, cell.pose, geometry, tuple(portals), tuple(seen))


def hull_planes(polygons: Sequence[Corners]) -> tuple[PlaneData, ...]:
    """Return the planes of a cell's convex hull, as far as its own polygons tell it.

    Parameters
    ----------
    polygons : sequence of Corners
        Walls and portals that face inwards, metres, in the cell's frame.

    Returns
    -------
    tuple of PlaneData
        Of the polygons that have every corner before them, then of the box of all corners; each once.
    """
    corners = [corner for polygon in polygons for corner in polygon]
    planes = [plane_of(polygon) for polygon in polygons]
    hull = [plane for plane in planes if min(signed_distance(plane, c) for c in corners) >= -HULL]
    xs, ys, zs = zip(*corners, strict=True)
    box = box_planes((min(xs), min(ys), min(zs)), (max(xs), max(ys), max(zs)))
    return tuple(dict.fromkeys((*hull, *box)))


def _surface(record: Any, path: str) -> tuple[int, Corners]:
    polygon_id = whole(member(record, "id", path), f"{path}.id")
    return polygon_id, dumped_polygon(record, path)


def _portal(record: Any, path: str, cell: int, surfaces: Mapping[int, Corners]) -> Portal:
    flags = whole(member(mapping(record, path), "flags", path), f"{path}.flags")
    polygon = whole(member(record, "polygon", path), f"{path}.polygon")
    other = whole(member(record, "other_cell", path), f"{path}.other_cell")
    if polygon not in surfaces:
        raise SceneError(f"{path}.polygon", str(polygon), "the id of one of the portal polygons")
    if bool(flags & EXTERIOR) is not (other == OUTDOORS):
        found = f"flags {flags} with other_cell 0x{other:04X}"
        raise SceneError(f"{path}.flags", found, f"bit 0x4 for 0x{OUTDOORS:04X}, and only for it")
    leads_to = None if flags & EXTERIOR else cell & LANDBLOCK | other
    return Portal(leads_to, 0 if flags & FACES_IN else 1, surfaces[polygon], 0)


def _with_ways_back(cell: InteriorCell, cells: Mapping[int, InteriorCell]) -> InteriorCell:
    """Return a cell whose portals know the portals that lead back."""
    portals = [replace(portal, other_portal=_way_back(portal, cell, cells)) for portal in cell.portals]
    return replace(cell, portals=tuple(portals))


def _way_back(portal: Portal, cell: InteriorCell, cells: Mapping[int, InteriorCell]) -> int:
    """Return the index of the portal that leads back: of two, the one with the same polygon; or 0."""
    other = cells.get(portal.other or 0)
    back = [(k, p) for k, p in enumerate(other.portals if other else ()) if p.other == cell.id]
    same = [k for k, p in back if p.polygon == portal.polygon]
    return next(iter(same or [k for k, _ in back]), 0)


def _groups(cells: Mapping[int, InteriorCell]) -> list[list[int]]:
    """Return the ids of the cells that belong together, in order."""
    neighbours: dict[int, set[int]] = defaultdict(set)
    for cell in cells.values():
        for portal in cell.portals:
            if portal.other is not None:
                neighbours[cell.id].add(portal.other)
                neighbours[portal.other].add(cell.id)
    groups: list[list[int]] = []
    left = dict.fromkeys(cells)
    while left:
        reached = _reached(next(iter(left)), neighbours)
        groups.append([cell for cell in left if cell in reached])
        left = {cell: None for cell in left if cell not in reached}
    return groups


def _reached(first: int, neighbours: Mapping[int, Iterable[int]]) -> set[int]:
    reached, waiting = {first}, [first]
    while waiting:
        new = set(neighbours.get(waiting.pop(), ())) - reached
        reached |= new
        waiting += new
    return reached
