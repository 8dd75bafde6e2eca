"""Mistakes about cells: who is let into a building, which neighbours are listed, how land is cut."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

from conformance.candidates.bug_candidate import KnownBug
from conformance.candidates.oracle_ops import terrain_ops
from conformance.candidates.replacements import Edit, Method
from oracle import cell_list, land_block_struct
from oracle.arithmetic import f32
from oracle.env_cell import CellPortal, EnvCell
from oracle.land_defs import get_block_offset
from oracle.sphere import Sphere
from oracle.vector import Vector3

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from oracle.cell_array import CellArray
    from oracle.obj_cell import ObjCell
    from oracle.position import Position
    from oracle.sphere_path import SpherePath

_DECIMAL: Final = (("h * _TWO_TO_MINUS_32", "h * 2.3283064e-10"),)


def _enter_across_the_border(retail: Callable[..., None]) -> Callable[..., None]:
    """Take the spheres to the cell's own landblock first."""

    def check_building_transit(
        self: EnvCell,
        portal_id: int,
        p: Position,
        num_sphere: int,
        spheres: Sequence[Sphere],
        array: CellArray,
        path: SpherePath | None,
    ) -> None:
        off = get_block_offset(p.objcell_id, self.id)
        centers = [s.center for s in spheres]
        moved = [Vector3(f32(c.x - off.x), f32(c.y - off.y), f32(c.z - off.z)) for c in centers]
        taken = [Sphere(center, s.radius) for center, s in zip(moved, spheres, strict=True)]
        retail(self, portal_id, p, num_sphere, taken, array, path)

    return check_building_transit


def _keep_every_cell(_retail: Any) -> Callable[[CellArray, ObjCell], None]:
    return lambda _array, _start: None


BUGS: Final = (
    KnownBug(
        "building-across-border",
        "a building in the next landblock can be entered across the border: the block offset is subtracted",
        "no offset is applied, so that no sphere of another landblock reaches the building's cells (09 4.4)",
        (Method(EnvCell, "check_building_transit", _enter_across_the_border),),
        case="bug-building-across-border",
        output="new_cell",
    ),
    KnownBug(
        "portal-side",
        "the side flag of a portal is read the wrong way round: what is inside counts as outside",
        "the flag's bit is inverted when it is read: a clear bit is side 1, the cell behind the plane"
        " (09 2.1, 4.2 C, 4.3)",
        (
            Edit(
                CellPortal,
                "__init__",
                (("self.portal_side = portal_side", "self.portal_side = 1 - portal_side"),),
            ),
        ),
        case="bug-portal-side",
        output="cells",
    ),
    KnownBug(
        "cell-list-unpruned",
        "the cell list of a static object keeps cells that cannot be seen from its own",
        "with do_not_load set only the starting cell and its stab list stay, also if the search for the"
        " current cell ended early (09 5.1 step 7)",
        (Method(cell_list, "_prune", _keep_every_cell),),
        case="bug-cell-list-unpruned",
        output="cells",
    ),
    KnownBug(
        "terrain-split-decimal",
        "the constant of the triangle split is written as a decimal, 2.3283064e-10",
        "it is 2^-32 exactly, so that the top bit decides (10 3.3)",
        (
            Edit(land_block_struct, "cuts_sw_to_ne", _DECIMAL),
            Edit(terrain_ops, "cuts_sw_to_ne", _DECIMAL),
        ),
        survives="equivalent: it cuts 34 of all 32-bit numbers the other way, from 0x80000000 on, and of the"
        " 2048 x 2048 cells that ids can name the nearest is 440 off",
    ),
)
