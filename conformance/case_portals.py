"""From portals and doorways as they are written to the portals of a world's cells."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Final

from conformance.scenes.algebra import ORIGIN, round_point
from conformance.scenes.doorways import carried, matching_opening, opening_polygon, side_of
from conformance.scenes.primitives import Opening
from conformance.scenes.world_model import InteriorCell, Portal
from conformance.schema.primitives import OpeningModel

if TYPE_CHECKING:
    from conformance.case_scene import SceneMaker
    from conformance.scenes.model import Pose, Vec3
    from conformance.scenes.polygons import Corners
    from conformance.schema.primitives import RoomModel
    from conformance.schema.scene import CellModel, SceneModel
    from conformance.schema.world import DoorwayModel
    from conformance.source import DocPath

INTO: Final = 0
OUT_OF: Final = 1
"""Sides of a portal whose polygon faces into its cell, or out of it (09 2.1)."""


@dataclass(slots=True)
class _Draft:
    """A portal whose way back is not known yet."""

    other: int | None
    side: int | None
    polygon: Corners
    place: DocPath
    back: int | None = None


class PortalMaker:
    """Makes the portals of a scene: those of each cell as listed, then those of the doorways in their order.

    Attributes
    ----------
    cells : dict of int to InteriorCell
        The cells that could be made, by id, in order.
    """

    def __init__(self, maker: SceneMaker, scene: SceneModel) -> None:
        self.cells: dict[int, InteriorCell] = {}
        self._maker = maker
        self._models = {cell.id: cell for cell in scene.cells or ()}
        self._openings: dict[int, list[OpeningModel]] = {}
        self._drafts: dict[int, list[_Draft]] = {id_: [] for id_ in self._models}
        for index, cell in enumerate(scene.cells or ()):
            for number, portal in enumerate(cell.placed_portals):
                place: DocPath = ("scene", "cells", index, "portals", number)
                polygon = tuple(portal.polygon)
                self._drafts[cell.id].append(
                    _Draft(portal.to, portal.side, polygon, place, portal.other_portal)
                )
        for index, doorway in enumerate(scene.doorways):
            self._doorway(doorway, ("scene", "doorways", index))

    def opened(self, cell: CellModel) -> CellModel:
        """Return a cell with the openings of its doorways cut into its room."""
        openings, geometry = self._openings.get(cell.id), cell.geometry
        if not openings or geometry is None or geometry.room is None:
            return cell
        room = geometry.room.model_copy(update={"openings": [*geometry.room.openings, *openings]})
        return cell.model_copy(update={"geometry": geometry.with_room(room)})

    def add(self, cell: InteriorCell) -> None:
        """Note a cell that was made."""
        self.cells[cell.id] = cell

    def portals(self, cell_id: int) -> tuple[Portal, ...]:
        """Return the portals of a cell, in order."""
        made = []
        for draft in self._drafts[cell_id]:
            side = self._side(draft, cell_id) if draft.side is None else draft.side
            made.append(Portal(draft.other, side, draft.polygon, self._back(draft, cell_id)))
        return tuple(made)

    def exits(self, cell_id: int) -> list[int]:
        """Return the indices of a cell's portals that lead outdoors."""
        drafts = self._drafts.get(cell_id, ())
        return [index for index, draft in enumerate(drafts) if draft.other is None]

    def place(self, cell_index: int, portal: int) -> DocPath:
        """Return where in the file a portal of a made cell is written."""
        return self._drafts[list(self.cells)[cell_index]][portal].place

    def _side(self, draft: _Draft, cell_id: int) -> int:
        planes = self.cells[cell_id].geometry.cell_planes or ()
        side = self._maker.attempt(lambda: side_of(draft.polygon, planes), draft.place)
        return INTO if side is None else side

    def _back(self, draft: _Draft, cell_id: int) -> int:
        """Return the index of the portal that leads back, or 0 as there is none."""
        if draft.back is not None:
            return draft.back
        others = self._drafts.get(draft.other or 0, [])
        # A doorway's two portals know each other by their place: there may be two between the same cells.
        same = [index for index, other in enumerate(others) if other.place == draft.place]
        led = [index for index, other in enumerate(others) if other.other == cell_id]
        return next(iter(same + led), 0)

    def _doorway(self, doorway: DoorwayModel, place: DocPath) -> None:
        first, second = doorway.between
        opening = Opening(doorway.side, doorway.width, doorway.height, doorway.offset, doorway.sill)
        room = self._room(first, (*place, "between", 0))
        if room is None:
            return
        polygon = self._maker.attempt(
            lambda: opening_polygon(room.size, opening, room.at or ORIGIN, room.yaw or 0.0), place
        )
        if polygon is None:
            return
        self._open(first, opening)
        self._drafts[first].append(_Draft(second, INTO, _rounded(polygon), place))
        if second is not None:
            self._far_side(polygon, first, second, place)

    def _far_side(self, polygon: Corners, first: int, second: int, place: DocPath) -> None:
        """Cut the doorway into the other cell's room and write its portal."""
        room = self._room(second, (*place, "between", 1))
        if room is None:
            return
        here = carried(polygon, self._pose(first), self._pose(second))
        opening = self._maker.attempt(
            lambda: matching_opening(here, room.size, room.at or ORIGIN, room.yaw or 0.0), place
        )
        if opening is not None:
            self._open(second, opening)
            self._drafts[second].append(_Draft(first, OUT_OF, _rounded(here), place))

    def _room(self, cell_id: int, place: DocPath) -> RoomModel | None:
        model = self._models.get(cell_id)
        if model is None:
            self._maker.fault(place, f"the cell 0x{cell_id:08X}", "a cell of this scene")
            return None
        room = None if model.geometry is None else model.geometry.room
        if room is None:
            self._maker.fault(place, f"the cell 0x{cell_id:08X} without a room", "a cell with a 'room'")
        return room

    def _pose(self, cell_id: int) -> Pose:
        return self._maker.quiet_pose(self._models[cell_id].pose, cell_id)

    def _open(self, cell_id: int, opening: Opening) -> None:
        # Not rounded to float32 as what a file gives: it must meet edges that are not, either.
        model = OpeningModel.model_construct(
            side=opening.side,
            width=opening.width,
            height=opening.height,
            offset=opening.offset,
            sill=opening.sill,
        )
        self._openings.setdefault(cell_id, []).append(model)


def _rounded(polygon: Corners) -> tuple[Vec3, ...]:
    return tuple(round_point(corner) for corner in polygon)
