"""One call of an obstacle, of a cell's obstacles or of a whole cell."""

from __future__ import annotations

from typing import TYPE_CHECKING

from engine import layout as at
from engine.constants import (
    NEEDS_STEP_UP,
    OK,
    TARGET_CELL,
    TARGET_ENTRY,
    TARGET_OBJECT,
    TARGET_OBJECTS,
)
from engine.kernels.ahead import bring_to_write
from engine.kernels.compile import kernel
from engine.kernels.insertion import answer_step_up, find_in_cell, find_obj_collisions, find_object
from engine.kernels.objects import test_object_shape
from engine.kernels.query import go_to_end, prepare, report, set_path_fields
from engine.kernels.restrictions import check_entry_restrictions, is_restricted

if TYPE_CHECKING:
    from engine.kernels.types import Array, Ints


@kernel
def _call(wf: Array, wi: Ints, s: Array, q: Array) -> int:
    """Test the mover against what the query names; a TransitionState."""
    kind, cell, thing = int(q[at.Q_TARGET_KIND]), int(q[at.Q_TARGET_CELL]), int(q[at.Q_TARGET_OBJECT])
    if kind == TARGET_CELL:
        return find_in_cell(wf, wi, s, cell)
    if kind == TARGET_ENTRY:
        return check_entry_restrictions(wf, wi, s, cell) if is_restricted(wi, cell) else OK
    if kind == TARGET_OBJECTS:
        return find_obj_collisions(wf, wi, s, cell)
    if kind == TARGET_OBJECT:
        return find_object(wf, wi, s, thing)
    ts = test_object_shape(wf, wi, s, thing, 0)
    return answer_step_up(wf, wi, s) if ts == NEEDS_STEP_UP else ts


@kernel
def meet(wf: Array, wi: Ints, s: Array, q: Array, out: Array) -> None:
    """Answer one query: test the mover at the end pose against obstacles.

    retail: what calls CSphere::intersects_sphere 0x00537FD0, CCylSphere::intersects_sphere 0x0053B8F0,
    CPhysicsObj::FindObjCollisions 0x0050F050, CObjCell::find_obj_collisions 0x0052B750,
    CEnvCell::find_collisions 0x0052C100 or CObjCell::check_entry_restrictions 0x0052B6D0
    """
    prepare(s, q)
    go_to_end(s, q, s[at.CURR_CELL])
    set_path_fields(s, q)
    bring_to_write(out, 0, at.RESULT_SIZE)
    report(wf, s, out, _call(wf, wi, s, q))
