"""Output fields: their names, and reading them exactly."""

from __future__ import annotations

import math

import pytest
from shipped_vectors import FILES, records

from conformance.fields import (
    MISSING,
    FieldError,
    UnknownFieldError,
    canonical_path,
    field_at,
    field_names,
    kind_of,
    normalise,
)
from conformance.floats import bits32
from conformance.inputs import OPTIONAL, REQUIRED
from conformance.outputs import OUTPUTS
from conformance.shapes import Kind

PLANE = {"valid": 1, "plane": [0.0, 0.0, 1.0, -94.0], "cell_id": 1, "is_water": 0}


def test_inputs_and_outputs_are_of_the_same_operations() -> None:
    """Whatever can be asked has outputs, and the other way round."""
    assert REQUIRED.keys() == OUTPUTS.keys()
    assert OPTIONAL.keys() < OUTPUTS.keys()


@pytest.mark.parametrize("path", FILES, ids=lambda path: path.name)
def test_every_shipped_record_fits_the_table(path: object) -> None:
    """No field of a shipped record is unknown, missing or of another kind."""
    assert len(records(path)) >= 17  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("op", "path", "canonical", "kind"),
    [
        ("find_collisions", "contact_plane.d", "contact_plane.plane[3]", Kind.FLOAT32),
        ("find_collisions", "contact_plane.n.z", "contact_plane.plane[2]", Kind.FLOAT32),
        ("find_collisions", "contact_plane.plane[0]", "contact_plane.plane[0]", Kind.FLOAT32),
        ("find_collisions", "contact_plane.plane", "contact_plane.plane", Kind.BLOCK),
        ("find_collisions", "contact_plane", "contact_plane", Kind.BLOCK),
        ("find_collisions", "check.origin.z", "check.origin[2]", Kind.FLOAT32),
        ("find_collisions", "curr.rotation.w", "curr.rotation[0]", Kind.FLOAT32),
        ("find_collisions", "global_spheres[1].x", "global_spheres[1][0]", Kind.FLOAT32),
        ("find_collisions", "result", "result", Kind.STATE),
        ("transition", "result", "result", Kind.FLAG),
        ("find_collisions", "state", "state", Kind.MOVER_BITS),
        ("find_collisions", "walkable", "walkable", Kind.POLYGON),
        ("find_collisions", "collision_normal.y", "collision_normal[1]", Kind.FLOAT32),
        ("find_collisions", "trace", "trace", Kind.TEXT),
        ("polygon_adjust_sphere_to_poly", "t", "t", Kind.FLOAT64),
        ("plane_localtoglobal", "plane.d", "plane[3]", Kind.FLOAT32),
        ("frame_cache", "m.m4", "m[4]", Kind.FLOAT32),
        ("cache_localspace_sphere", "spheres[0].r", "spheres[0][3]", Kind.FLOAT32),
        ("walk", "ticks[17].pos.z", "ticks[17].pos[2]", Kind.FLOAT32),
        ("walk", "tick 17: contact_plane.d", "ticks[17].cp[3]", Kind.FLOAT32),
        ("body_walk", "tick 3: velocity.x", "ticks[3].v[0]", Kind.FLOAT32),
        ("a tick of walk", "contact_plane.d", "contact_plane[3]", Kind.FLOAT32),
    ],
)
def test_paths(op: str, path: str, canonical: str, kind: Kind) -> None:
    """Both spellings of a path lead to the same field of a known kind."""
    assert canonical_path(op, path) == canonical
    assert canonical_path(op, canonical) == canonical
    assert kind_of(op, path) is kind


@pytest.mark.parametrize(
    "path", ["", "contact_plane.q", "contact_plane.plane[4]", "global_spheres.x", "result.x", "a b", "ticks"]
)
def test_unknown_paths(path: str) -> None:
    """A path that leads nowhere is refused."""
    with pytest.raises(UnknownFieldError):
        canonical_path("find_collisions", path)


def test_names_for_suggestions() -> None:
    """Names are those that people read, each once, and each leads to its field."""
    names = field_names("find_collisions")
    assert len(names) == len(set(names))
    assert {"contact_plane.d", "check.origin.x", "global_spheres[0].z", "trace"} <= set(names)
    assert all(canonical_path("find_collisions", name) for name in names)


def test_field_at() -> None:
    """A field is found by either spelling; what is not there is missing, not null."""
    fields = {"contact_plane": PLANE, "collision_normal": None, "global_spheres": [[1.0, 2.0, 3.0]]}
    assert field_at(fields, "find_collisions", "contact_plane.d") == -94.0
    assert field_at(fields, "find_collisions", "global_spheres[0].y") == 2.0
    assert field_at(fields, "find_collisions", "global_spheres[1].y") is MISSING
    assert field_at(fields, "find_collisions", "collision_normal") is None
    assert field_at(fields, "find_collisions", "collision_normal.x") is MISSING
    assert field_at(fields, "find_collisions", "trace") is MISSING


def test_numbers_become_float32() -> None:
    """Decimals and integers become exactly the float32 they mean; float64 fields stay."""
    small = normalise("normalize_check_small", {"small": 0, "v": [0.48, 1, "nan"]})
    assert bits32(small["v"][0]) == 0x3EF5C28F
    assert small["v"][0] != 0.48
    assert isinstance(small["v"][1], float)
    assert math.isnan(small["v"][2])
    assert normalise("polygon_adjust_sphere_to_poly", {"t": 0.1}) == {"t": 0.1}
    assert normalise("polygon_adjust_sphere_to_poly", {"t": "-inf"}) == {"t": -math.inf}


@pytest.mark.parametrize(
    ("op", "fields", "path", "found"),
    [
        ("frame_is_equal", {"r": 2}, "r", "2 (int)"),
        ("frame_is_equal", {"r": "1"}, "r", "'1' (str)"),
        ("frame_is_equal", {}, "r", "nothing"),
        ("frame_is_equal", {"r": 1, "rr": 1}, "rr", "an unknown field"),
        ("block_offset", {"v": [1, 2]}, "v", "[1, 2] (list)"),
        ("block_offset", {"v": [1, 2, None]}, "v[2]", "None (NoneType)"),
        ("block_offset", {"v": [1, 2, True]}, "v[2]", "True (bool)"),
        ("block_offset", {"v": [1, 2, 10**400]}, "v[2]", "a number beyond float64"),
        ("block_offset", [1], "", "[1] (list)"),
        ("polygon_hits_sphere_fast", {"r": 1, "contact": 0}, "contact", "0 (int)"),
    ],
)
def test_what_does_not_fit_is_located(op: str, fields: object, path: str, found: str) -> None:
    """An expected block that does not fit its operation says where and what was found."""
    with pytest.raises(FieldError) as caught:
        normalise(op, fields)  # type: ignore[arg-type]
    assert (caught.value.path, caught.value.found) == (path, found)
