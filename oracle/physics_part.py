"""CPartArray, CPhysicsPart and CGfxObj: the parts of an object, and their BSP trees."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Final, cast

from oracle.constants import EPS
from oracle.enums import InsertType, TransitionState

if TYPE_CHECKING:
    from collections.abc import Sequence

    from oracle.bbox import BBox
    from oracle.bsp_tree import BSPTree
    from oracle.cyl_sphere import CylSphere
    from oracle.frame import Frame
    from oracle.position import Position
    from oracle.sphere import Sphere
    from oracle.sphere_path import SpherePath
    from oracle.transition import Transition
    from oracle.vector import Vector3

DEGRADE_MODE_3D: Final = 1
"""The way of drawing that is not flat (09 6.5.4)."""


class GfxObj:
    """A graphic object.

    Attributes
    ----------
    physics_bsp : BSPTree or None
        What is collided with.
    physics_sphere : Sphere or None
        The sphere of the physics tree's root.
    bounding_box : BBox or None
        Box of all vertices, part space, metres, unscaled (gfx_bound_box, 09 8); only looked at when an
        object is registered in cells.
    drawing_sphere : Sphere or None
        Stands in for the physics sphere there.
    """

    __slots__ = ("bounding_box", "drawing_sphere", "physics_bsp", "physics_sphere")

    def __init__(
        self,
        physics_bsp: BSPTree | None,
        *,
        bounding_box: BBox | None = None,
        drawing_sphere: Sphere | None = None,
    ) -> None:
        self.physics_bsp = physics_bsp
        self.physics_sphere: Sphere | None = None if physics_bsp is None else physics_bsp.root_node.sphere
        self.bounding_box = bounding_box
        self.drawing_sphere = drawing_sphere

    def find_obj_collisions(self, transition: Transition, scale: float) -> TransitionState:
        """Test the path's local-space spheres against the physics BSP, if one comes near it.

        The caller has seen that there is one (08 6.1).

        retail: CGfxObj::find_obj_collisions 0x00534700, 08 7.
        """
        path = transition.sphere_path
        bsp, ps = cast("BSPTree", self.physics_bsp), cast("Sphere", self.physics_sphere)
        # 08 7.1, 08 7.2
        for i in range(path.num_sphere):
            s = path.localspace_sphere[i]
            dx = ps.center.x - s.center.x
            dy = ps.center.y - s.center.y
            dz = ps.center.z - s.center.z
            r = s.radius + ps.radius
            if dx * dx + dy * dy + dz * dz - r * r < EPS:
                break
        # 08 7.3
        else:
            return TransitionState.OK
        # 08 7.4
        if path.insert_type == InsertType.INITIAL_PLACEMENT:
            return bsp.placement_insert(transition)
        return bsp.find_collisions(transition, scale)


class PhysicsPart:
    """One part of an object.

    Attributes
    ----------
    gfxobj : GfxObj or None
        The most detailed graphic object.
    pos : Position
        The part's own global position.
    gfxobj_scale : Vector3
        Of which collision only uses z.
    degrade_modes : tuple of int
        How the part is drawn at each level of detail; empty without degrade info.
    """

    __slots__ = ("degrade_modes", "gfxobj", "gfxobj_scale", "pos")

    def __init__(self, gfxobj: GfxObj | None, pos: Position, gfxobj_scale: Vector3) -> None:
        self.gfxobj = gfxobj
        self.pos = pos
        self.gfxobj_scale = gfxobj_scale
        self.degrade_modes: tuple[int, ...] = ()

    def always_2d(self) -> bool:
        """Tell whether even the most detailed picture of the part is flat.

        retail: CPhysicsPart::Always2D 0x0050D8A0, 09 6.5.4.
        """
        return bool(self.degrade_modes) and self.degrade_modes[0] != DEGRADE_MODE_3D

    def bounding_sphere(self) -> Sphere | None:
        """Return the physics sphere, else the drawing sphere; part space, metres, unscaled (09 4.3.1)."""
        g = self.gfxobj
        return None if g is None else g.physics_sphere or g.drawing_sphere

    def bounding_box(self) -> BBox:
        """Return the box of the graphic object, part space, metres, unscaled (0x0050D600, 09 8).

        Raises
        ------
        ValueError
            The part was made without one: it is not meant to be registered in cells.
        """
        if self.gfxobj is None or self.gfxobj.bounding_box is None:
            message = "a part that is registered in cells needs its bounding box (09 8)"
            raise ValueError(message)
        return self.gfxobj.bounding_box

    def cache_local_space(self, path: SpherePath) -> None:
        """Take the path's spheres into the part's space (08 6.2, of find_obj_collisions)."""
        path.cache_localspace_sphere(self.pos, self.gfxobj_scale.z)

    def find_obj_collisions(self, transition: Transition) -> TransitionState:
        """Test the path against this part.

        retail: CPhysicsPart::find_obj_collisions 0x0050D8D0, 08 6.
        """
        # 08 6.1
        g = self.gfxobj
        if g is None or g.physics_bsp is None:
            return TransitionState.OK
        # 08 6.2
        self.cache_local_space(transition.sphere_path)
        # 08 6.3
        return g.find_obj_collisions(transition, self.gfxobj_scale.z)


@dataclass(frozen=True, slots=True)
class Setup:
    """What the setup of an object says about movement.

    Attributes
    ----------
    step_up_height, step_down_height : float
        Metres, before the part array's scale.
    cylsphere : tuple of CylSphere
        The collision cylinders, object space, metres.
    sphere : tuple of Sphere
        The collision spheres, object space, metres; a mover's are what moves.
    allow_free_heading : bool
        Whether the object may turn where it cannot move.
    sorting_sphere : Sphere or None
        Bounds the object, object space, metres, unscaled (08 9.2); None is not set.
    """

    step_up_height: float = 0.0
    step_down_height: float = 0.0
    cylsphere: tuple[CylSphere, ...] = ()
    sphere: tuple[Sphere, ...] = ()
    allow_free_heading: bool = False
    sorting_sphere: Sphere | None = None

    @property
    def num_sphere(self) -> int:
        """How many collision spheres it has."""
        return len(self.sphere)


class PartArray:
    """The parts of an object, its setup (or none) and its scale."""

    __slots__ = ("parts", "scale", "setup")

    def __init__(self, parts: Sequence[PhysicsPart | None], setup: Setup | None, scale: Vector3) -> None:
        self.parts = list(parts)
        self.setup = setup
        self.scale = scale

    def get_num_sphere(self) -> int:
        """Return the number of collision spheres; 0 without a setup."""
        return 0 if self.setup is None else self.setup.num_sphere

    def get_cylsphere(self) -> Sequence[CylSphere]:
        """Return the collision cylinders (object space, metres, unscaled)."""
        return () if self.setup is None else self.setup.cylsphere

    def get_sphere(self) -> Sequence[Sphere]:
        """Return the collision spheres (object space, metres, unscaled)."""
        return () if self.setup is None else self.setup.sphere

    def update(self, quantum: float, offset: Frame) -> None:
        """Write the root motion of a tick into `offset` (06 UPI-2); parts without animation have none."""

    def find_obj_collisions(self, transition: Transition) -> TransitionState:
        """Test the path against each part until one is in the way.

        retail: CPartArray::FindObjCollisions 0x00518180, 08 5.
        """
        r = TransitionState.OK
        # 08 5.1
        for part in self.parts:
            if part is None:
                continue
            r = part.find_obj_collisions(transition)
            if r != TransitionState.OK:
                return r
        # 08 5.2
        return r
