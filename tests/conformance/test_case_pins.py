"""Pinned outputs: values, bits, tolerances."""

from __future__ import annotations

import pytest

from conformance.case_pins import make_pins
from conformance.compare import Tolerance, pin_differences
from conformance.pins import Pin

FREE = {"value": -94, "tolerance": 1e-4, "unit": "m", "inclusive": True, "reason": "visible"}


def test_nested_fields_become_single_pins() -> None:
    """Blocks and lists are pinned value by value, so that a report names the part that differs."""
    pins, faults = make_pins("find_collisions", {"contact_plane": {"valid": True, "plane": [0, 0, 1, -94]}})
    assert faults == []
    assert [pin.path for pin in pins] == [
        "contact_plane.valid",
        *(f"contact_plane.plane[{i}]" for i in range(4)),
    ]
    assert pins[0] == Pin("contact_plane.valid", 1)


def test_a_tolerance_and_the_bits_beside_it() -> None:
    """One field may be pinned loosely for readers and exactly for machines."""
    pins, faults = make_pins("find_collisions", {"contact_plane": {"d": {**FREE, "bits": 0xC2BC0000}}})
    assert faults == []
    assert pins == (
        Pin("contact_plane.d", -94.0),
        Pin("contact_plane.d", -94.0, Tolerance(1e-4, "m", inclusive=True, reason="visible")),
    )


def test_states_by_name() -> None:
    """Mover bits are pinned by their names, null is a value."""
    pins, faults = make_pins("find_collisions", {"state": ["contact", "edge_slide"], "walkable": None})
    assert faults == []
    assert pins == (Pin("state", 0x201), Pin("walkable", None))


@pytest.mark.parametrize(
    ("expect", "path", "found"),
    [
        ({"reslt": "OK"}, ("expect", "reslt"), "the field 'reslt'"),
        ({"reslt": {}}, ("expect", "reslt"), "the field 'reslt'"),
        ({"reslt": [{}]}, ("expect", "reslt", 0), "the field 'reslt[0]'"),
        ({"contact_plane": {}}, ("expect", "contact_plane"), "an empty mapping"),
        ({"result": "FINE"}, ("expect", "result"), "the text 'FINE'"),
        ({"walk_interp": "x"}, ("expect", "walk_interp"), "'x' (str)"),
        ({"walk_interp": {"value": 1}}, ("expect", "walk_interp"), "only 'value'"),
        ({"walk_interp": {"bits": -1}}, ("expect", "walk_interp", "bits"), "the number -1"),
        ({"collide": FREE}, ("expect", "collide"), "a tolerance or bits"),
        ({"state": ["flying"]}, ("expect", "state", 0), "the text 'flying'"),
        (
            {"contact_plane": {"plane": [0, 0, "up", 1]}},
            ("expect", "contact_plane", "plane", 2),
            "'up' (str)",
        ),
    ],
)
def test_pins_that_do_not_fit(expect: dict[str, object], path: tuple[str | int, ...], found: str) -> None:
    """Unknown fields, wrong types, freedom where there is none."""
    _, (fault,) = make_pins("find_collisions", expect)
    assert (fault.path, fault.found) == (path, found)


def test_a_list_is_pinned_with_its_length() -> None:
    """One item more, or one less, is a difference; so is one where there should be none."""
    pins, faults = make_pins("find_cell_list", {"cells": [[0xA9B40100, 1]]})
    assert faults == []
    right = {"cells": [[0xA9B40100, 1]], "new_cell": 0, "hits_interior_cell": 0, "added_outside": 0}
    assert pin_differences(pins, right, op="find_cell_list") == []
    longer = {**right, "cells": [[0xA9B40100, 1], [0xA9B40101, 1]]}
    (found,) = pin_differences(pins, longer, op="find_cell_list")
    assert (found.name, found.note) == ("cells", "1 items, candidate 2")
    shorter = {**right, "cells": []}
    assert "cells" in {found.name for found in pin_differences(pins, shorter, op="find_cell_list")}
    none, _ = make_pins("find_cell_list", {"cells": []})
    assert [found.name for found in pin_differences(none, right, op="find_cell_list")] == ["cells"]
    vector, _ = make_pins("find_collisions", {"collision_normal": [0, 0, 1]})
    assert [pin.count for pin in vector] == [None, None, None]
