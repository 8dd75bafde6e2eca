"""Obstacles: objects that movers collide with, given as plain data (08)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Final

from engine.checks import flag, number, optional, record, sequence, several, whole
from engine.constants import HAS_PHYSICS_BSP, STATIC
from engine.geometry import Shape
from engine.pose import Pose, check_pose

if TYPE_CHECKING:
    from collections.abc import Sequence


@dataclass(frozen=True, slots=True, eq=False)
class Part:
    """A part of an object.

    Attributes
    ----------
    shape : Shape or None
        Its geometry, unscaled; a part without one collides with nothing, and is found nowhere.
    pose : Pose or None
        Where it is, in its landblock; None: where the object is.
    scale : float or None
        Uniform, greater than 0; None: the object's.
    always_flat : bool
        Even its most detailed picture is flat: its sphere counts, not its box, for the land cells in
        which it is found (09, 6.5.4).
    has_physics : bool
        Whether it has a physics BSP. Without one it collides with nothing; what its object is found by is
        then the box of its vertices and the `drawing_sphere`.
    drawing_sphere : sequence of float or None
        Centre x, y, z and radius, in its own frame, before `scale`: bounds it if there is no physics BSP.
        Without either it reaches through no portal (09, 4.3.1).
    """

    shape: Shape | None
    pose: Pose | None = None
    scale: float | None = None
    always_flat: bool = False
    has_physics: bool = True
    drawing_sphere: Sequence[float] | None = None


@dataclass(frozen=True, slots=True)
class Weenie:
    """What an object's game object says of itself.

    Attributes
    ----------
    creature, player, pk, pklite, impenetrable : bool
        Whether it is a creature, a player, a player killer of either kind, and impenetrable.
    """

    creature: bool = False
    player: bool = False
    pk: bool = False
    pklite: bool = False
    impenetrable: bool = False


@dataclass(frozen=True, slots=True, eq=False)
class Obstacle:
    """An object that does not move by itself; the same one may be listed in several cells.

    It collides with its parts if its state says that they have a physics BSP, or else with its
    cylspheres if it has any, or else with its spheres.

    Attributes
    ----------
    pose : Pose
        Where it is, in its landblock.
    scale : float
        Uniform, greater than 0.
    state : int
        PhysicsState bits: 1 static, 4 ethereal, 0x10 ignores collisions, 0x40 missile, 0x10000 has a
        physics BSP.
    parts : sequence of Part
    cylspheres : sequence of sequences of float
        Low point x, y, z, radius and height: metres, in the object's frame, before `scale`.
    spheres : sequence of sequences of float
        Centre x, y, z and radius: metres, in the object's frame, before `scale`.
    weenie : Weenie or None
        None: it has no game object.
    id : int
        Its object id; 0 for none.
    has_parent : bool
        Attached to another object, and so never collided with.
    has_part_array : bool
        Without one it has nothing to collide with.
    sorting_sphere : sequence of float or None
        Centre x, y, z and radius, in the object's frame, before `scale`, which plays no role: by it is
        found what moves and has neither a physics BSP nor cylspheres (08, 9.2).
    """

    pose: Pose
    scale: float = 1.0
    state: int = int(STATIC)
    parts: Sequence[Part] = ()
    cylspheres: Sequence[Sequence[float]] = ()
    spheres: Sequence[Sequence[float]] = ()
    weenie: Weenie | None = None
    id: int = 0
    has_parent: bool = False
    has_part_array: bool = True
    sorting_sphere: Sequence[float] | None = None

    @classmethod
    def solid(
        cls, shape: Shape, pose: Pose, scale: float = 1.0, state: int = int(STATIC | HAS_PHYSICS_BSP)
    ) -> Obstacle:
        """Return an object of one part."""
        return cls(pose, scale, state, (Part(shape),))


_CHECK_PART: Final = record(
    Part,
    shape=optional(record(Shape)),
    pose=optional(check_pose),
    scale=optional(number),
    always_flat=flag,
    has_physics=flag,
    drawing_sphere=optional(sequence),
)
CHECK_OBSTACLE: Final = record(
    Obstacle,
    pose=check_pose,
    scale=number,
    state=whole(),
    parts=several(_CHECK_PART),
    cylspheres=several(sequence),
    spheres=several(sequence),
    weenie=optional(
        record(Weenie, **dict.fromkeys(("creature", "player", "pk", "pklite", "impenetrable"), flag))
    ),
    id=whole(),
    has_parent=flag,
    has_part_array=flag,
    sorting_sphere=optional(sequence),
)
