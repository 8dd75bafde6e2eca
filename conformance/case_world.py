"""From the models of a scene to a world: land, cells with portals, buildings, objects, shadow lists."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from conformance.case_portals import PortalMaker
from conformance.scenes.object_model import Part, WorldObject
from conformance.scenes.terrain import Area, flat_heights, formula_heights, table_heights, terrain_words
from conformance.scenes.validate_world import arrangement_errors
from conformance.scenes.world_model import Building, InteriorCell, LandBlock, Restriction, World
from conformance.source import Fault, parse_path

if TYPE_CHECKING:
    from collections.abc import Iterator

    from conformance.case_scene import SceneMaker
    from conformance.scenes.errors import SceneError
    from conformance.scenes.model import Geometry
    from conformance.schema.scene import CellModel, SceneModel
    from conformance.schema.world import BuildingModel, ObjectModel, TerrainModel
    from conformance.source import DocPath

MAP_ROWS = 8
"""Index of the last row of a map, and of the southernmost height."""


class WorldMaker:
    """Makes one case's world.

    Parameters
    ----------
    maker : SceneMaker
        Makes geometries and poses, and takes the faults.
    scene : SceneModel
        What is written.
    """

    def __init__(self, maker: SceneMaker, scene: SceneModel) -> None:
        self._maker = maker
        self._scene = scene
        self._places: dict[tuple[str | int, int], DocPath] = {}

    def world(self) -> World:
        """Make the world, its shadow lists still empty; what is wrong is noted as faults."""
        blocks = tuple(self._landblocks())
        portals = PortalMaker(self._maker, self._scene)
        cells = tuple(self._cells(portals))
        cells = tuple(replace(cell, portals=portals.portals(cell.id)) for cell in cells)
        buildings = tuple(self._buildings(portals))
        world = World(
            self._maker.case_id,
            blocks,
            cells,
            buildings,
            tuple(self._objects()),
            restrictions=self._restrictions(),
        )
        faults = [self._fault(error, portals) for error in arrangement_errors(world)]
        # One formula may be wrong in 81 places: the first tells enough.
        first = {fault.path: fault for fault in reversed(faults)}
        self._maker.faults += reversed(first.values())
        return world

    def object(self, model: ObjectModel, path: DocPath) -> WorldObject:
        """Make one object."""
        maker = self._maker
        parts = []
        for index, part in enumerate(model.parts):
            here = (*path, "parts", index)
            geometry = None if part.geometry is None else maker.geometry(part.geometry, (*here, "geometry"))
            pose = None if part.pose is None else maker.pose(part.pose, part.pose.cell, (*here, "pose"))
            parts.append(Part(geometry, pose, part.scale, part.physics, part.drawing_sphere, flat=part.flat))
        return WorldObject(
            id=model.id,
            pose=maker.pose(model.pose, model.pose.cell, (*path, "pose")),
            scale=model.scale,
            state=model.state,
            weenie=None if model.weenie is None else tuple(model.weenie),
            parts=tuple(parts),
            cylspheres=tuple(model.cylspheres),
            spheres=tuple(model.spheres),
            parent=bool(model.parent),
            part_array=model.part_array,
            attached=tuple(model.attached),
        )

    def _landblocks(self) -> Iterator[LandBlock]:
        count = 0
        for index, terrain in enumerate(self._scene.terrain):
            path: DocPath = ("scene", "terrain", index)
            areas = [Area(area.from_, area.to, area.type) for area in terrain.areas]
            for block in terrain.blocks:
                heights = self._heights(terrain, block, path)
                if heights is None:
                    break
                self._places["landblocks", count] = path
                count += 1
                yield LandBlock(block, heights, terrain_words(areas), terrain.side_cell_count)

    def _heights(self, terrain: TerrainModel, block: int, path: DocPath) -> tuple[float, ...] | None:
        maker, frame = self._maker, self._scene.landblock
        if terrain.flat is not None:
            return flat_heights(terrain.flat)
        if (text := terrain.formula) is not None and frame is not None:
            return maker.attempt(lambda: formula_heights(text, block, frame), (*path, "formula"))
        key, rows = ("map", terrain.map) if terrain.heights is None else ("heights", terrain.heights)
        return maker.attempt(lambda: table_heights(rows or [], as_map=key == "map"), (*path, key))

    def _cells(self, portals: PortalMaker) -> Iterator[InteriorCell]:
        ids = [cell.id for cell in self._scene.cells or ()]
        for index, model in enumerate(self._scene.cells or ()):
            path: DocPath = ("scene", "cells", index)
            pose = self._maker.pose(model.pose, model.id, (*path, "pose"))
            geometry = self._geometry(portals.opened(model), path)
            if geometry is None:
                continue
            self._places["cells", len(portals.cells)] = path
            cell = InteriorCell(
                model.id, pose, geometry, stab=_stab(model, ids), portal_array=model.portal_array
            )
            portals.add(cell)
            yield cell

    def _geometry(self, model: CellModel, path: DocPath) -> Geometry | None:
        if model.geometry is None:
            self._maker.faults.append(Fault((*path, "geometry"), "nothing (null)", "a geometry in a world"))
            return None
        geometry = self._maker.geometry(model.geometry, (*path, "geometry"))
        if geometry is not None and geometry.cell_planes is None:
            expected = "'contains': the volume of the cell, which other cells need to find it"
            self._maker.faults.append(Fault((*path, "geometry"), "no 'contains' in a world", expected))
            return None
        return geometry

    def _buildings(self, portals: PortalMaker) -> Iterator[Building]:
        count = 0
        for index, model in enumerate(self._scene.buildings):
            path: DocPath = ("scene", "buildings", index)
            pose = self._maker.pose(model.pose, model.pose.cell, (*path, "pose"))
            shell = model.geometry
            geometry = None if shell is None else self._maker.geometry(shell, (*path, "geometry"))
            doors = self._doors(model, portals, path)
            if shell is None or geometry is not None:
                self._places["buildings", count] = path
                count += 1
                yield Building(pose, geometry, doors, model.landblock)

    def _doors(
        self, model: BuildingModel, portals: PortalMaker, path: DocPath
    ) -> tuple[tuple[int, int], ...]:
        doors: list[tuple[int, int]] = []
        for index, door in enumerate(model.portals):
            if not isinstance(door, int):
                doors.append((door.cell, door.portal))
                continue
            exits = portals.exits(door)
            if not exits:
                found = f"the cell 0x{door:08X}, which has no portal to outdoors"
                expected = "a cell of this scene with one, or {cell, portal}"
                self._maker.faults.append(Fault((*path, "portals", index), found, expected))
            doors += [(door, portal) for portal in exits]
        return tuple(doors)

    def _objects(self) -> Iterator[WorldObject]:
        for index, model in enumerate(self._scene.objects):
            self._places["objects", index] = ("scene", "objects", index)
            yield self.object(model, ("scene", "objects", index))

    def _restrictions(self) -> dict[int, Restriction]:
        made: dict[int, Restriction] = {}
        for index, model in enumerate(self._scene.restrictions):
            for number, cell in enumerate(model.cells):
                self._places["restrictions", cell] = ("scene", "restrictions", index, "cells", number)
                made[cell] = Restriction(tuple(model.admits), model.known)
        return made

    def _fault(self, error: SceneError, portals: PortalMaker) -> Fault:
        """Return a mistake of the world's record at the place in the file that it comes from."""
        what, index, *below = parse_path(error.path)
        if below == ["block"] and what == "buildings":
            below = ["landblock"]
        place = self._places.get((what, int(index)), ("scene",))
        if what == "landblocks":
            path = _terrain_place(self._scene, place, below)
        elif below[:1] == ["portals"] and what == "cells":
            path = portals.place(int(index), int(below[1]))
        else:
            path = (*place, *below)
        return Fault(path, error.found, error.expected)


def _stab(model: CellModel, ids: list[int]) -> tuple[int, ...]:
    if isinstance(model.stab, str):  # 'all'
        return tuple(other for other in ids if other != model.id)
    return tuple(model.stab)


def _terrain_place(scene: SceneModel, place: DocPath, below: list[str | int]) -> DocPath:
    """Return where a landblock's mistake was made; a height has its own place only in a table."""
    terrain = scene.terrain[int(place[-1])]
    if below[0] == "block":
        return (*place, "blocks")
    if below[0] != "heights":
        return (*place, "areas")
    i, j = divmod(int(below[1]), MAP_ROWS + 1)
    if terrain.heights is not None:
        return (*place, "heights", i, j)
    if terrain.map is not None:
        return (*place, "map", MAP_ROWS - j, i)
    return (*place, "flat" if terrain.flat is not None else "formula")
