"""Environment cells, their portals, and who may enter, given as plain data (09)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Final

from engine.checks import flag, optional, record, sequence, several, whole
from engine.geometry import Shape
from engine.objects import CHECK_OBSTACLE
from engine.pose import check_pose

if TYPE_CHECKING:
    from collections.abc import Collection, Sequence

    from engine.errors import InputError
    from engine.objects import Obstacle
    from engine.pose import Pose


@dataclass(frozen=True, slots=True, eq=False)
class Portal:
    """A way out of a cell.

    Attributes
    ----------
    other : int or None
        Id of the cell behind it, which need not be in the world; None is the outside.
    polygon : sequence of sequences of float, or None
        Corners x, y, z in the cell's frame, metres. Only their plane counts, and only where no cell of
        the world is behind the portal; then they cannot be left out.
    side : int
        The cell's interior is on the positive (0) or the negative (1) side of that plane.
    """

    other: int | None
    polygon: Sequence[Sequence[float]] | None = None
    side: int = 0


@dataclass(frozen=True, slots=True)
class Restriction:
    """What keeps players out of a cell, as a house does (09, 3.1).

    It is asked about movers that are `Mover.restricted` players; others enter as they like.

    Attributes
    ----------
    admits : collection of int
        Object ids of the movers that may enter.
    is_known : bool
        Whether what restricts the cell is in the world and has a game object. If not, nobody is admitted,
        and a land cell doesn't answer with a collision normal.
    """

    admits: Collection[int] = ()
    is_known: bool = True


@dataclass(frozen=True, slots=True, eq=False)
class Cell:
    """An environment cell.

    Attributes
    ----------
    id : int
        Cell id; the low 16 bits of an indoor cell are at least 0x100.
    pose : Pose
        Where the cell's frame is.
    shape : Shape or None
        Its collision geometry and containment planes; None collides with nothing and contains every
        point.
    objects : sequence of Obstacle
        In the order in which they are tested.
    portals : sequence of Portal or int, or None
        In the order in which they are looked at; the id of a cell of this world stands for a portal
        to it. None is retail's missing list: such a cell contains no point.
    stab : sequence of int
        Ids of the cells that may be visible from it, in order.
    """

    id: int
    pose: Pose
    shape: Shape | None
    objects: Sequence[Obstacle] = ()
    portals: Sequence[Portal | int] | None = ()
    stab: Sequence[int] = ()


_CHECK_PORTAL: Final = record(Portal, other=optional(whole(1)), polygon=optional(sequence), side=whole(0, 1))
CHECK_RESTRICTION: Final = record(Restriction, admits=several(whole(1)), is_known=flag)


def _check_way(value: Any, where: str, error: type[InputError]) -> None:
    """Check a portal, or the id that stands for one."""
    (whole(1) if isinstance(value, int) else _CHECK_PORTAL)(value, where, error)


CHECK_CELL: Final = record(
    Cell,
    id=whole(),
    pose=check_pose,
    shape=optional(record(Shape)),
    objects=several(CHECK_OBSTACLE),
    portals=optional(several(_check_way)),
    stab=several(whole()),
)
