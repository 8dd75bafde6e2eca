"""From the models of a scene to neutral scene data; what cannot be made is a fault, not an exception."""

from __future__ import annotations

import functools
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, TypeVar

from conformance.scenes.algebra import ORIGIN
from conformance.scenes.bsp_builder import TreeStyle, build
from conformance.scenes.cell_planes import box_planes, convex_planes
from conformance.scenes.errors import SceneError
from conformance.scenes.model import Cell, Geometry, Pose, Scene, Static
from conformance.scenes.polygons import Shape, place, round_shape
from conformance.scenes.primitives import PRIMITIVES, Opening
from conformance.scenes.records import geometry_from_record
from conformance.scenes.rotations import quaternion_from_rows, yaw_quaternion
from conformance.scenes.validate import rotation_errors
from conformance.scenes.validate_polygons import shape_errors
from conformance.source import Fault, format_path, parse_path

if TYPE_CHECKING:
    from collections.abc import Callable

    from conformance.scenes.model import PlaneData, Quaternion
    from conformance.schema.frames import FrameModel
    from conformance.schema.geometry import ContainsModel, GeometryModel
    from conformance.schema.primitives import ShapeModel
    from conformance.schema.scene import CellModel, SceneModel, StaticModel
    from conformance.source import DocPath


T = TypeVar("T")


@dataclass(slots=True)
class SceneMaker:
    """Makes one case's scene.

    Attributes
    ----------
    case_id : str
        Names the geometries.
    faults : list of Fault
        What could not be made, with paths inside the case.
    geometries : dict
        Every geometry made, by name.
    """

    case_id: str
    faults: list[Fault] = field(default_factory=list)
    geometries: dict[str, Geometry] = field(default_factory=dict)

    def scene(self, model: SceneModel, path: DocPath) -> Scene:
        """Make the cells of a scene."""
        cells = enumerate(model.cells or ())
        return Scene(tuple(self._cell(cell, (*path, "cells", index)) for index, cell in cells))

    def pose(self, model: FrameModel, cell: int, path: DocPath) -> Pose:
        """Make a pose; an unusable rotation is a fault and becomes the identity."""
        rotation = self.attempt(lambda: _rotation(model, cell), path)
        return Pose(cell, model.origin, rotation or (1.0, 0.0, 0.0, 0.0))

    def quiet_pose(self, model: FrameModel, cell: int) -> Pose:
        """Make a pose whose faults are told elsewhere."""
        return SceneMaker(self.case_id).pose(model, cell, ())

    def fault(self, path: DocPath, found: str, expected: str) -> None:
        """Note a mistake."""
        self.faults.append(Fault(path, found, expected))

    def geometry(self, model: GeometryModel, path: DocPath) -> Geometry | None:
        """Make a geometry under a name of its own, or note why it cannot be made."""
        number = len(self.geometries) + 1
        name = self.case_id if number == 1 else f"{self.case_id}-{number}"
        if model.record is not None:
            return self._recorded({"name": name, **model.record}, (*path, "record"))
        shape, origins = self._shape(model.shapes or [], (*path, "shapes"))
        rounded = round_shape(shape)
        faults = [_polygon_fault(error, origins) for error in shape_errors(rounded, "")]
        self.faults += faults
        if faults or len(origins) == 0:
            return None
        kind = "+".join(dict.fromkeys(item.name for item in model.shapes or ()))
        style = TreeStyle(model.tree or "")
        return self._add(build(name, rounded, style=style, kind=kind, cell_planes=self._planes(model, path)))

    def recorded(self, records: list[dict[str, Any]], path: DocPath) -> None:
        """Read whole geometry records."""
        for index, record in enumerate(records):
            self._recorded(record, (*path, index))

    def _cell(self, model: CellModel, path: DocPath) -> Cell:
        pose = self.pose(model.pose, model.id, (*path, "pose"))
        geometry = None if model.geometry is None else self.geometry(model.geometry, (*path, "geometry"))
        made = (
            self._static(static, model.id, (*path, "statics", index))
            for index, static in enumerate(model.statics)
        )
        statics = tuple(static for static in made if static is not None)
        portals = tuple(portal for portal in model.portals if isinstance(portal, int))
        return Cell(model.id, pose, geometry, statics, portals)

    def _static(self, model: StaticModel, cell: int, path: DocPath) -> Static | None:
        pose = self.pose(model.pose, cell, (*path, "pose"))
        geometry = self.geometry(model.geometry, (*path, "geometry"))
        return None if geometry is None else Static(geometry, pose, model.scale)

    def _shape(self, items: list[ShapeModel], path: DocPath) -> tuple[Shape, list[DocPath]]:
        """Return the polygons of primitives, and where in the case each comes from."""
        shape: Shape = []
        origins: list[DocPath] = []
        for index, item in enumerate(items):
            here = (*path, index, item.name)
            polygons = self.attempt(functools.partial(_polygons, item), here, inside=item.name) or []
            shape += polygons
            explicit = item.polygons is not None
            origins += [(*here, n) if explicit else here for n in range(len(polygons))]
        return shape, origins

    def _recorded(self, record: dict[str, Any], path: DocPath) -> Geometry | None:
        geometry = self.attempt(lambda: geometry_from_record(record, ""), path)
        return None if geometry is None else self._add(geometry)

    def _planes(self, model: GeometryModel, path: DocPath) -> tuple[PlaneData, ...] | None:
        contains = model.contains
        if contains is None:
            return None
        return self.attempt(lambda: _cell_planes(contains, model), (*path, "contains"))

    def _add(self, geometry: Geometry) -> Geometry:
        self.geometries[geometry.name] = geometry
        return geometry

    def attempt(self, make: Callable[[], T], path: DocPath, *, inside: str = "") -> T | None:
        """Make something; a scene error becomes a fault at `path`, without the part `inside` of its own."""
        try:
            return make()
        except SceneError as error:
            below = parse_path(error.path)
            below = below[1:] if below[:1] == (inside,) else below
            self.faults.append(Fault((*path, *below), error.found, error.expected))
            return None


def _rotation(model: FrameModel, cell: int) -> Quaternion:
    if model.yaw is not None:
        return yaw_quaternion(model.yaw)
    if model.matrix is not None:
        return quaternion_from_rows(model.matrix, "matrix", cell)
    quaternion = model.quaternion or (0.0, 0.0, 0.0, 0.0)
    for error in rotation_errors(quaternion, "quaternion"):
        raise SceneError(error.path, f"{error.found} in cell 0x{cell:08X}", error.expected)
    return quaternion


def _polygons(item: ShapeModel) -> Shape:
    if item.polygons is not None:
        return [tuple(corners) for corners in item.polygons]
    model = getattr(item, item.name)
    parameters = model.parameters()
    if "openings" in parameters:
        parameters["openings"] = [Opening(**opening.model_dump()) for opening in parameters["openings"]]
    shape = PRIMITIVES[item.name](**parameters)
    return shape if model.at is None else place(shape, model.at, model.yaw)


def _polygon_fault(error: SceneError, origins: list[DocPath]) -> Fault:
    _, index, *corner = parse_path(error.path)
    origin = origins[int(index)]
    explicit = "polygons" in origin
    found = error.found if explicit else f"{error.found} in its polygon {format_path(tuple(corner))}".strip()
    return Fault((*origin, *corner) if explicit else origin, found, error.expected)


def _cell_planes(model: ContainsModel, geometry: GeometryModel) -> tuple[PlaneData, ...]:
    if model.low is not None and model.high is not None:
        return box_planes(model.low, model.high)
    if (room := geometry.room) is not None and model.room:
        return convex_planes(place(PRIMITIVES["room"](size=room.size), room.at or ORIGIN, room.yaw or 0.0))
    return tuple(model.planes or ())
