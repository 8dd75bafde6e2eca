"""The models of a case file and the JSON Schema that editors are given."""

from __future__ import annotations

import inspect
import json
from pathlib import Path

import pytest

from conformance.case_query import WORLD_OPS
from conformance.inputs import OPTIONAL, REQUIRED
from conformance.outputs import OUTPUTS
from conformance.scenes.primitives import PRIMITIVES
from conformance.schema.case import CaseModel
from conformance.schema.frames import FrameModel
from conformance.schema.json_schema import SCHEMA_FILE, allowed_keys, file_schema, published_schema
from conformance.schema.mover import MOVER_PRESETS, MoverModel, PathModel
from conformance.schema.primitives import PLACEMENT, OpeningModel, ShapeModel
from conformance.schema.query import MODEL_OF_OP
from conformance.schema.values import INSERT_TYPES, MOVER_STATES, OBJECT_STATES
from conformance.schema.walk_queries import TRANSIENT_STATES
from conformance.validation import validate
from oracle import enums, physics_state, transient_state

PACKAGE = Path(__file__).parents[2] / "conformance"
TICK_OPS = {
    *("update_physics", "update_position", "calc_friction", "calc_acceleration", "set_velocity"),
    *("set_local_velocity", "set_on_walkable", "clear_transient_states", "handle_all_collisions"),
    *("set_position", "seed", "update_object_gates", "set_elasticity"),
}
"""Single calls of part 3: asked as raw records."""
GIVEN_BY_THE_SCENE = {"geometry", "as", "cells", "mover", "world", "side_cell_count"}


def test_the_published_schema_is_that_of_the_models() -> None:
    """Editors see the same keys as the loader."""
    published = (PACKAGE / SCHEMA_FILE).read_text(encoding="utf-8")
    assert published == published_schema()
    assert json.loads(published) == file_schema()


def test_every_case_file_names_the_schema() -> None:
    """The first line of a built-in case file leads an editor to the schema."""
    files = sorted((PACKAGE / "cases").rglob("*.yaml"))
    assert files
    for file in files:
        first = file.read_text(encoding="utf-8").splitlines()[0]
        prefix, _, target = first.partition("$schema=")
        assert prefix == "# yaml-language-server: "
        assert (file.parent / target).resolve() == PACKAGE / SCHEMA_FILE


def test_every_op_of_a_scene_can_be_asked() -> None:
    """There is a model for each operation but worlds' own forms of others, and the tick's single calls."""
    asked = {op for op in OUTPUTS if op not in {*TICK_OPS, *WORLD_OPS.values()}}
    assert len(asked) >= 60
    assert set(MODEL_OF_OP) == asked


@pytest.mark.parametrize("op", sorted(MODEL_OF_OP))
def test_the_keys_of_a_query_are_those_of_the_format(op: str) -> None:
    """A query has the inputs of FORMAT.md but for what the scene gives; `at` and seeds are conveniences."""
    fields = MODEL_OF_OP[op].model_fields
    keys = {info.alias or name for name, info in fields.items()} - {"op", "at"}
    wanted = {*REQUIRED[op], *OPTIONAL.get(op, ())} - GIVEN_BY_THE_SCENE
    if op == "find_collisions":
        wanted -= {"pose", "scale"}
    if op == "body_walk":
        wanted |= {"start", "quantum"}
    if op == "place_body":
        wanted |= {"start"}
    if op in {"check_collisions", "object_call", "object_transition"}:
        wanted -= {"cell", "objects"}
    if op == "terrain_block":
        wanted -= {"heights", "terrain"}
    assert keys == wanted


@pytest.mark.parametrize("name", sorted(PRIMITIVES))
def test_the_parameters_of_a_primitive_are_those_of_its_function(name: str) -> None:
    """The file can give what the function takes, with the same defaults."""
    if name == "polygons":
        assert "polygons" in ShapeModel.model_fields
        return
    (model, _) = ShapeModel.model_fields[name].annotation.__args__  # type: ignore[union-attr]
    parameters = inspect.signature(PRIMITIVES[name]).parameters
    assert set(model.model_fields) - {*PLACEMENT} == set(parameters)
    for key, parameter in parameters.items():
        assert model.model_fields[key].is_required() == (parameter.default is parameter.empty)


def test_every_primitive_has_a_model() -> None:
    """And no model is without its primitive."""
    assert set(ShapeModel.model_fields) == set(PRIMITIVES)
    assert set(OpeningModel.model_fields) == {"side", "width", "height", "offset", "sill"}


def test_state_names_are_retails_bits() -> None:
    """Names and bits agree with the oracle's, which are the specification's."""
    assert MOVER_STATES["contact"] == 0x1
    assert MOVER_STATES["on_walkable"] == 0x2
    assert MOVER_STATES["edge_slide"] == 0x200
    assert {name.upper(): value for name, value in INSERT_TYPES.items()} == {
        item.name.removesuffix("_INSERT"): item.value for item in enums.InsertType
    }


def test_states_of_bodies_are_retails_bits() -> None:
    """Those that the port knows have its values; the others are retail's that it does not read."""
    names = {name.replace("_", ""): bit for name, bit in OBJECT_STATES.items()}
    known = {
        name.removesuffix("_PS").replace("_", "").lower(): bit
        for name, bit in vars(physics_state).items()
        if name.endswith("_PS") and name != "FLIGHT_PS"
    }
    assert {name: bit for name, bit in known.items() if name in names} == {
        name: bit for name, bit in names.items() if name in known
    }
    assert set(names) - set(known) <= {"lightingon", "particleemitter"}
    for name, bit in TRANSIENT_STATES.items():
        assert getattr(transient_state, f"{name.upper()}_TS") == bit


def test_numbers_are_rounded_to_float32() -> None:
    """The value meant is the float32 nearest to the decimal."""
    model, faults = validate(MoverModel, {"spheres": "one-sphere", "state": ["contact", "on_walkable"]})
    assert not faults
    assert model is not None
    assert model.step_up_height == 0.6000000238418579
    assert model.state == 3
    assert [tuple(sphere) for sphere in model.spheres] == [(0.0, 0.0, 0.0, 0.47999998927116394)]
    assert set(MOVER_PRESETS) == {"one-sphere", "two-spheres"}


@pytest.mark.parametrize("value", [True, 1])
def test_flags_are_truth_values_or_bits(value: object) -> None:
    """FORMAT.md writes 0 and 1, people write true and false."""
    model, faults = validate(PathModel, {"step_down": value})
    assert (model and model.step_down, faults) == (1, [])


def test_a_frame_has_exactly_one_rotation() -> None:
    """No rotation is not the identity: a forgotten rotation is the bug this suite began with."""
    assert validate(FrameModel, {"origin": [0, 0, 0]})[1][0].found == "no rotation"
    for rotation in ({"yaw": 0}, {"quaternion": [1, 0, 0, 0]}, {"matrix": [[1, 0, 0], [0, 1, 0], [0, 0, 1]]}):
        assert validate(FrameModel, {"origin": [0, 0, 0], **rotation})[1] == []


def test_allowed_keys_follow_a_location() -> None:
    """Through lists, optional values and chosen models."""
    assert allowed_keys(CaseModel, ()) == list(CaseModel.model_fields)
    assert "pose" in allowed_keys(CaseModel, ("scene", "cells", 0))
    assert "step_down_amt" in allowed_keys(CaseModel, ("query", "FindCollisionsQuery", "path"))
    assert "from" in allowed_keys(CaseModel, ("query", "FindCollisionsQuery"))
