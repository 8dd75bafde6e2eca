"""What is replaced in the oracle is wrong inside the block, and retail's own after it."""

from __future__ import annotations

import pytest

from conformance.candidates.oracle_ops import values
from conformance.candidates.replacements import (
    Constant,
    Edit,
    Everywhere,
    Method,
    edited,
    replaced,
    with_globals,
)
from oracle import bsp_node, constants, object_info
from oracle.arithmetic import f32
from oracle.frame import Frame
from oracle.plane import Plane
from oracle.position import Position
from oracle.sphere import Sphere
from oracle.vector import Vector3

FLOOR = Plane(Vector3(0.0, 0.0, 1.0), -1.0)


def test_a_method_gets_retails_version() -> None:
    """What is made sees what it replaces."""
    retail = Vector3.magnitude
    with replaced([Method(Vector3, "magnitude", lambda old: lambda self: old(self) + 1.0)]):
        assert Vector3(3.0, 4.0, 0.0).magnitude() == 6.0
    assert Vector3.magnitude is retail


def test_everything_is_put_back_if_a_later_replacement_fails() -> None:
    """A name that is not there is an error, and leaves nothing replaced."""
    retail = Vector3.magnitude
    broken = [Method(Vector3, "magnitude", lambda _: None), Method(Vector3, "no_such", lambda _: None)]
    with pytest.raises(KeyError), replaced(broken):
        pass
    assert Vector3.magnitude is retail


def test_a_constant_is_replaced_wherever_it_was_imported() -> None:
    """Modules hold their own name for a constant; all of them see the wrong value, then retail's."""
    with replaced([Constant("EPS", 0.00015)]):
        assert [m.EPS for m in (constants, bsp_node, object_info)] == [0.00015] * 3
    assert [m.EPS for m in (constants, bsp_node, object_info)] == [0.00019999999494757503] * 3


def test_a_name_is_replaced_in_its_package_only() -> None:
    """Modules of other packages keep theirs."""
    mine = object()
    with replaced([Everywhere("conformance.candidates.oracle_ops", "f32", mine)]):
        assert vars(values)["f32"] is mine
        assert vars(bsp_node)["f32"] is f32
    assert vars(values)["f32"] is f32


def test_an_edit_changes_one_piece_of_a_function() -> None:
    """The rest of the function is retail's, and so is the function afterwards."""
    near, far = Sphere(Vector3(), 1.0), Sphere(Vector3(2.00001, 0.0, 0.0), 1.0)
    assert near.intersects(far)
    with replaced([Edit(Sphere, "intersects", (("gap < EPS", "gap < 0.0"),))]):
        assert not near.intersects(far)
    assert near.intersects(far)


def test_an_edit_of_a_static_method_stays_static() -> None:
    """It is called as before."""
    place = Position(0xA9B40151, Frame())
    with replaced([Edit(Plane, "localtoglobal", (("-dot_x(n, g)", "-dot_x(n, g) + 1.0"),))]):
        assert Plane.localtoglobal(place, place, FLOOR).d == 0.0
    assert Plane.localtoglobal(place, place, FLOOR).d == -1.0


@pytest.mark.parametrize(("piece", "count"), [("no such text", 0), ("gap", 3)])
def test_a_piece_must_occur_once(piece: str, count: int) -> None:
    """When retail's source changes, an edit that no longer fits is an error, not another mistake."""
    with pytest.raises(LookupError, match=f"Sphere.intersects: {count} occurrences of '{piece}'"):
        edited(Sphere.intersects, (piece, ""))


def test_an_edited_function_is_made_once() -> None:
    """Candidates replace at every answer; the source is read only the first time."""
    change = ("gap < EPS", "gap < 0.0")
    assert edited(Sphere.intersects, change) is edited(Sphere.intersects, change)


def test_globals_are_replaced_for_one_function() -> None:
    """Its module and its other functions keep theirs."""
    unrounded = with_globals(Vector3.normalize, f32=lambda x: x)
    v, w = Vector3(1.0, 2.0, 2.5), Vector3(1.0, 2.0, 2.5)
    unrounded(v)
    w.normalize()
    assert f32(v.x) == w.x != v.x
