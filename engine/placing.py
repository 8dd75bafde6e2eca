"""Placements: putting bodies down where there is room for them."""

from __future__ import annotations

from enum import IntEnum
from typing import TYPE_CHECKING, Any, Final, NamedTuple

import numpy as np

from engine import body_layout as of_body
from engine import layout as at
from engine.answering import answer
from engine.batch import check_status
from engine.body import given_body
from engine.checks import optional, whole
from engine.errors import QueryError
from engine.kernels import program
from engine.memory import rows_as_numbers
from engine.pose import pose_row
from engine.world import CHECK_WORLD

if TYPE_CHECKING:
    from engine.pose import Pose
    from engine.world import World


_CHECK_CELL: Final = optional(whole())


class PlacementResult(IntEnum):
    """What came of a placement (SetPositionError, 06, 10)."""

    PLACED = int(of_body.PLACED)
    """It is there; or, without a cell, lost."""
    NO_VALID_POSITION = int(of_body.NO_VALID_POSITION)
    """There is no room."""
    NO_CELL = int(of_body.PLACED_IN_NO_CELL)
    """There is room, but outside of all cells; a placement that FP-3 accepts does not end there."""
    COLLIDED = int(of_body.PLACEMENT_COLLIDED)
    """There is no room, and a game object was told what is in the way."""


class Placement(NamedTuple):
    """The answer to `place`.

    Attributes
    ----------
    result : PlacementResult
    body : numpy record of `engine.body_layout.BODY_DTYPE`
        The body afterwards.
    origin : tuple of float
        The wanted origin, or the one at which a body that must not slide was found room for.
    """

    result: PlacementResult
    body: Any
    origin: tuple[float, float, float]


def place(
    world: World,
    body: Any,
    pose: Pose,
    cell: int | None,
    *,
    slide: bool = False,
    do_not_load_cells: bool = False,
) -> Placement:
    """Put a body down at a pose.

    Parameters
    ----------
    world : World
    body : Body or record
        A body, or what an earlier tick or placement returned; it is not changed.
    pose : Pose
        Where.
    cell : int or None
        Id of the cell that the pose is in: on the land the one under it, indoors the one that
        `engine.find_visible_child_cell` finds. None: it is in no cell, and the body is lost there.
    slide : bool
        Whether it may end somewhere near.
    do_not_load_cells : bool
        Whether, indoors, only the cells count that are visible from `cell`.

    Raises
    ------
    QueryError, PoseError
        If it cannot be asked about.
    UndeterminedError
        If it depends on what is not known of retail.

    Notes
    -----
    retail: CPhysicsObj::SetPosition 0x005160C0, SP-3...SP-7
    """
    CHECK_WORLD(world, "world", QueryError)
    _CHECK_CELL(cell, "cell", QueryError)
    rows = given_body(world, body)
    placements = np.zeros(1, dtype=of_body.PLACEMENT_DTYPE)
    given = placements[0]
    given["pose"] = pose_row(pose, "pose")
    given["cell"] = at.NO_CELL if cell is None else world.cell_index(cell)
    if cell is not None and given["cell"] == at.NO_CELL:
        raise QueryError("cell", f"{cell:#010x} is not in the world")
    given["slide"], given["do_not_load_cells"] = slide, do_not_load_cells
    bodies, numbers = rows_as_numbers(rows), rows_as_numbers(placements)
    if answer(world, program.run, lambda: (program.PLACE, bodies, numbers), 1, 1, coherent=False):
        check_status(rows["status"])
    x, y, z = (float(c) for c in given["pose"][at.POSE_ORIGIN :])
    return Placement(PlacementResult(int(given["result"])), rows[0], (x, y, z))
