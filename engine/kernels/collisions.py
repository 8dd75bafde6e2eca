"""One collision call against one tree, and many of them."""

from __future__ import annotations

from typing import TYPE_CHECKING

from engine import layout as at
from engine.constants import INITIAL_PLACEMENT_INSERT, NEEDS_STEP_UP
from engine.kernels.bsp_placement import placement_insert
from engine.kernels.bsp_tree import dispatch, find_collisions
from engine.kernels.compile import entry, kernel
from engine.kernels.path import cache_localspace_sphere, set_check_pos
from engine.kernels.query import prepare, report, set_path_fields
from engine.kernels.stepping import step_up_or_slide
from engine.kernels.trace import INITIAL_PLACEMENT_CALL, trace_close

if TYPE_CHECKING:
    from engine.kernels.types import Array, Ints


@kernel
def _target(wi: Ints, q: Array) -> tuple[int, int, bool]:
    """Return where the target's floats and ints lie, and whether it is an object.

    A cell's and an object's records begin alike: position, tree.
    """
    thing = int(q[at.Q_TARGET_OBJECT])
    if thing != at.NO_OBJECT:
        floats = wi[at.WORLD_OBJECT_FLOATS] + at.OBJECT_FLOATS * thing
        return floats, wi[at.WORLD_OBJECT_INTS] + at.OBJECT_INTS * thing, True
    cell = int(q[at.Q_TARGET_CELL])
    return (
        wi[at.WORLD_CELL_FLOATS] + at.CELL_FLOATS * cell,
        wi[at.WORLD_CELL_INTS] + at.CELL_INTS * cell,
        False,
    )


@entry
def collide(wf: Array, wi: Ints, s: Array, q: Array, out: Array) -> None:
    """Answer one query: test the mover at the end pose against the target's tree.

    retail: BSPTREE::find_collisions 0x0053A440, or BSPTREE::placement_insert 0x00539960
    """
    prepare(s, q)
    set_check_pos(s, at.END_POS, s[at.CURR_CELL])
    set_path_fields(s, q)
    floats, ints, is_object = _target(wi, q)
    scale = wf[floats + at.OBJECT_SCALE] if is_object else 1.0
    root = wi[ints]
    cache_localspace_sphere(s, wf, floats, scale)
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


@entry
def collide_many(wf: Array, wi: Ints, s: Array, queries: Array, out: Array) -> None:
    """Answer many queries, one after the other, in one row of state."""
    for i in range(len(queries)):
        collide(wf, wi, s, queries[i], out[i])
