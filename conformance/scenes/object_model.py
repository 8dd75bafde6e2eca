"""The neutral model of an object that movers collide with: its parts, spheres and cylinders."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from conformance.scenes.model import Geometry, Pose, SphereData


@dataclass(frozen=True, slots=True)
class Part:
    """A part of an object.

    Attributes
    ----------
    geometry : Geometry or None
        Its graphic object; None: the part is missing.
    pose, scale : Pose, float or None
        The object's where they are None.
    physics : bool
        False: the graphic object has no physics BSP, so nothing collides with the part.
    drawing_sphere : SphereData or None
        What stands in for the tree's sphere then, when the object is registered in cells.
    flat : bool
        It is always drawn as a flat picture (Always2D, 09 6.5.4).
    """

    geometry: Geometry | None
    pose: Pose | None = None
    scale: float | None = None
    physics: bool = True
    drawing_sphere: SphereData | None = None
    flat: bool = False

    def to_record(self) -> dict[str, Any]:
        """Write one of an object's parts."""
        record: dict[str, Any] = {"geometry": None if self.geometry is None else self.geometry.name}
        if self.pose is not None:
            record["pose"] = self.pose.to_record()
        if self.scale is not None:
            record["scale"] = self.scale
        if not self.physics:
            record["no_physics"] = 1
        if self.drawing_sphere is not None:
            record["drawing_sphere"] = list(self.drawing_sphere)
        if self.flat:
            record["flat"] = 1
        return record


@dataclass(frozen=True, slots=True)
class WorldObject:
    """An object that movers collide with (08).

    Attributes
    ----------
    id : int
        Its own; a mover with the same id passes it.
    pose : Pose
        The cell of the pose is the object's own cell.
    scale : float
        Of spheres and cylinders.
    state : int
        Bits of PhysicsState.
    weenie : tuple of str or None
        Flags of its weenie by name; None: it has none.
    parts : tuple of Part
        BSP shapes.
    cylspheres : tuple of (float, float, float, float, float)
        Low point, radius, height; object space, unscaled metres.
    spheres : tuple of SphereData
        Object space, unscaled metres.
    parent : bool
        It hangs on another object.
    part_array : bool
        False: it has no part array, so it collides with nothing.
    attached : tuple of int
        The objects that hang on it (its children), which are registered where it is.
    """

    id: int
    pose: Pose
    scale: float = 1.0
    state: int = 0
    weenie: tuple[str, ...] | None = None
    parts: tuple[Part, ...] = ()
    cylspheres: tuple[tuple[float, float, float, float, float], ...] = ()
    spheres: tuple[SphereData, ...] = ()
    parent: bool = False
    part_array: bool = True
    attached: tuple[int, ...] = ()

    def to_record(self) -> dict[str, Any]:
        """Write the OBJECT block of a vector record."""
        record: dict[str, Any] = {
            "id": self.id,
            "pose": self.pose.to_record(),
            "scale": self.scale,
            "state": self.state,
        }
        if self.weenie is not None:
            record["weenie"] = dict.fromkeys(self.weenie, 1)
        if self.parts:
            record["parts"] = [part.to_record() for part in self.parts]
        for key in ("cylspheres", "spheres"):
            if shapes := getattr(self, key):
                record[key] = [list(shape) for shape in shapes]
        if self.parent:
            record["parent"] = 1
        if not self.part_array:
            record["no_part_array"] = 1
        if self.attached:
            record["attached"] = list(self.attached)
        return record
