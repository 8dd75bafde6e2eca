"""One collision call against one tree, and many of them."""

from __future__ import annotations

from typing import TYPE_CHECKING

from engine import layout as at
from engine.constants import INITIAL_PLACEMENT_INSERT, NEEDS_STEP_UP
from engine.kernels.ahead import bring_to_write
from engine.kernels.bsp_placement import placement_insert
from engine.kernels.bsp_tree import dispatch, find_collisions
from engine.kernels.cell_array import ints_of, position_of
from engine.kernels.compile import kernel
from engine.kernels.path import enter_localspace
from engine.kernels.query import go_to_end, prepare, report, set_path_fields
from engine.kernels.stepping import step_up_or_slide
from engine.kernels.trace import INITIAL_PLACEMENT_CALL, trace_close

if TYPE_CHECKING:
    from engine.kernels.types import Array, Ints


@kernel
def _target(wi: Ints, q: Array) -> tuple[int, int, bool]:
    """Return where the target's position lies, the root of its tree, and whether it is an object's part."""
    thing = int(q[at.Q_TARGET_OBJECT])
    if thing != at.NO_OBJECT:
        part = wi[wi[at.WORLD_OBJECT_INTS] + at.OBJECT_INTS * thing + at.OBJECT_FIRST]
        root = wi[wi[at.WORLD_PART_INTS] + at.PART_INTS * part + at.PART_TREE]
        return wi[at.WORLD_PART_FLOATS] + at.PART_FLOATS * part, root, True
    cell = int(q[at.Q_TARGET_CELL])
    return position_of(wi, cell), wi[ints_of(wi, cell) + at.CELL_TREE], False


@kernel
def collide(wf: Array, wi: Ints, s: Array, q: Array, out: Array) -> None:
    """Answer one query: test the mover at the end pose against the target's tree.

    retail: what calls BSPTREE::find_collisions 0x0053A440 or BSPTREE::placement_insert 0x00539960
    """
    prepare(s, q)
    go_to_end(s, q, s[at.CURR_CELL])
    set_path_fields(s, q)
    floats, root, is_part = _target(wi, q)
    scale = wf[floats + at.PART_SCALE] if is_part else 1.0
    enter_localspace(s, wf, floats, scale)
    bring_to_write(out, 0, at.RESULT_SIZE)
    if s[at.INSERT_TYPE] == INITIAL_PLACEMENT_INSERT:
        path = INITIAL_PLACEMENT_CALL
        ts = placement_insert(wf, wi, s, root)
    else:
        path = dispatch(s)
        ts = find_collisions(wf, wi, s, root, scale)
        if ts == NEEDS_STEP_UP:
            ts = step_up_or_slide(wf, wi, s)
            trace_close(wi, s, ts)
    report(wf, s, out, ts)
    out[at.R_DISPATCH] = path
