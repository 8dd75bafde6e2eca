"""The oracle's operations on spheres, cylinders and objects: what is built, which function is called."""

from __future__ import annotations

from typing import Any

import pytest

from conformance.candidates.oracle_candidate import OracleCandidate
from conformance.candidates.oracle_ops.objects import cylsphere, physics_object, weenie
from conformance.query import Errored, Query, Result, Skipped
from conformance.scenes.model import Geometry, Leaf, Polygon
from oracle.weenie import Weenie
from oracle.world import World

CELL = 0xA9B40111
POSE = {"cell": CELL, "origin": [0.0, 0.0, 0.0], "rotation": [1.0, 0.0, 0.0, 0.0]}
FLOOR = Geometry(
    name="floor",
    vertices=((-9.0, -8.0, 0.0), (9.0, -8.0, 0.0), (0.0, 8.0, 0.0)),
    polygons=(Polygon((0, 1, 2)),),
    tree=Leaf(0, solid=False, sphere=(0.0, 0.0, 0.0, 15.0), polygons=(0,)),
)
GEOMETRIES = {"floor": FLOOR}
MOVER = {
    "spheres": [[0.0, 0.0, 0.0, 0.5]],
    "scale": 1.0,
    "state": 0,
    "step_up_height": 0.5,
    "step_down_height": 1.5,
    "ethereal": 0,
    "step_down": 1,
    "gravity": 1,
}
BALL: dict[str, Any] = {"id": 5, "pose": POSE, "scale": 1.0, "state": 0, "spheres": [[0.0, 0.0, 0.0, 1.5]]}
PILLAR: dict[str, Any] = {
    "id": 6,
    "pose": POSE,
    "scale": 1.0,
    "state": 0,
    "cylspheres": [[0.0, 0.0, -0.5, 1.5, 2.0]],
}


def pose(x: float, y: float, z: float) -> dict[str, Any]:
    """Return an unrotated pose."""
    return {**POSE, "origin": [x, y, z]}


def call(
    function: str, *objects: dict[str, Any], geometry: str | None = None, z: float = 1.75, **path: Any
) -> dict[str, Any]:
    """Return the inputs of an ``object_call`` from half a metre above `z`."""
    return {
        "cell": {"id": CELL, "pose": POSE, "geometry": geometry},
        "objects": list(objects),
        "mover": MOVER,
        "from": pose(0.0, 0.0, z + 0.5),
        "to": pose(0.0, 0.0, z),
        "seed": {},
        "path": {"walk_interp": 1.0, "step_down_amt": 1.0, **path},
        "function": function,
    }


def ask(op: str, inputs: dict[str, Any]) -> dict[str, Any]:
    """Ask the oracle and return the fields."""
    outcome = OracleCandidate().answer(Query(op, inputs, GEOMETRIES))
    assert isinstance(outcome, Result), outcome
    return dict(outcome.fields)


def test_an_object_has_what_its_block_says() -> None:
    """Every key of an OBJECT, and the part's own pose and scale or else the object's."""
    world = World()
    block = {
        "id": 7,
        "pose": pose(1.0, 2.0, 3.0),
        "scale": 2.0,
        "state": 0x10008,
        "weenie": {"creature": 1, "player": 1, "pk": 1, "pklite": 1, "impenetrable": 1},
        "parts": [
            {"geometry": None},
            {"geometry": "floor"},
            {"geometry": "floor", "pose": pose(4.0, 5.0, 6.0), "scale": 3.0},
        ],
        "cylspheres": [[1.0, 2.0, 3.0, 4.0, 5.0]],
        "spheres": [[1.0, 2.0, 3.0, 4.0], [5.0, 6.0, 7.0, 8.0]],
        "sorting_sphere": [9.0, 8.0, 7.0, 6.0],
        "parent": 1,
    }
    made = physics_object(block, GEOMETRIES, world)
    assert (made.id, made.state, made.m_scale, made.world) == (7, 0x10008, 2.0, world)
    assert made.weenie_obj == Weenie(
        is_creature=True, is_player=True, is_pk=True, is_pklite=True, is_impenetrable=True, id=7
    )
    assert made.parent is not None
    parts = made.part_array
    assert parts is not None
    assert parts.setup is not None
    assert (len(parts.setup.cylsphere), parts.setup.num_sphere) == (1, 2)
    assert parts.setup.sorting_sphere is not None
    assert parts.setup.sorting_sphere.radius == 6.0
    missing, plain, own = parts.parts
    assert missing is None
    assert plain is not None
    assert own is not None
    assert (plain.pos.frame.origin.x, plain.gfxobj_scale.z) == (1.0, 2.0)
    assert (own.pos.frame.origin.x, own.gfxobj_scale.z) == (4.0, 3.0)
    assert plain.gfxobj is own.gfxobj


def test_an_object_has_nothing_else() -> None:
    """What a block leaves out is not there."""
    made = physics_object({"id": 7, "pose": POSE, "scale": 1.0, "state": 0}, {})
    assert (made.weenie_obj, made.parent) == (None, None)
    assert made.part_array is not None
    assert (made.part_array.parts, made.part_array.get_sphere(), made.part_array.get_cylsphere()) == (
        [],
        (),
        (),
    )
    assert physics_object({**BALL, "no_part_array": 1}, {}).part_array is None
    assert (
        physics_object({**BALL, "parent": 0, "no_part_array": 0, "weenie": None}, {}).part_array is not None
    )
    assert weenie({}) == Weenie()


def test_a_cylinder_has_radius_before_height() -> None:
    """The record's order is x, y, z, radius, height."""
    assert repr(cylsphere([1.0, 2.0, 3.0, 4.0, 5.0])) == "CylSphere(Vector3(1.0, 2.0, 3.0), 5.0, 4.0)"


def test_a_part_knows_the_box_of_all_vertices() -> None:
    """Unscaled, whether a polygon uses them or not."""
    part = physics_object({**BALL, "parts": [{"geometry": "floor"}]}, GEOMETRIES).part_array
    assert part is not None
    assert part.parts[0] is not None
    assert part.parts[0].gfxobj is not None
    box = part.parts[0].gfxobj.bounding_box
    assert repr(box) == "BBox(Vector3(-9.0, -8.0, 0.0), Vector3(9.0, 8.0, 0.0))"


@pytest.mark.parametrize(
    ("function", "objects", "geometry", "trace"),
    [
        ("sphere", (BALL,), None, "S2"),
        ("cylsphere", (PILLAR,), None, "C2"),
        ("object", (PILLAR, BALL), None, "C2"),
        ("cell_objects", ({**BALL, "parent": 1}, PILLAR, BALL), None, "C2"),
        ("cell_objects", ({**BALL, "state": 4}, PILLAR), None, "S2C2"),
        ("cell", (BALL,), None, "S2"),
        ("cell", (BALL,), "floor", "P1S2"),
    ],
)
def test_each_function_is_called(
    function: str, objects: tuple[dict[str, Any], ...], geometry: str | None, trace: str
) -> None:
    """A placement: one letter for every shape that is looked at."""
    fields = ask("object_call", call(function, *objects, geometry=geometry, insert_type=1))
    assert (fields["result"], fields["trace"]) == ("COLLIDED", trace)


def test_objects_are_recorded_by_id() -> None:
    """What was touched, what was hit last, and no environment."""
    ethereal = {**BALL, "state": 4}
    fields = ask("object_call", call("cell_objects", ethereal, PILLAR, insert_type=1))
    assert fields["collide_objects"] == [5, 6]
    assert fields["last_collided"] == 6
    assert (fields["obstruction_ethereal"], fields["hits_interior_cell"]) == (0, 0)
    nothing = ask("object_call", call("object", BALL, z=50.0, hits_interior_cell=1))
    assert (nothing["collide_objects"], nothing["last_collided"]) == ([], 0)
    assert nothing["hits_interior_cell"] == 1


def test_the_mover_does_not_meet_itself() -> None:
    """An object with the mover's id is skipped; a mover without one meets everything."""
    inputs = call("cell_objects", BALL, insert_type=1)
    assert ask("object_call", inputs)["trace"] == "S2"
    assert ask("object_call", {**inputs, "mover": {**MOVER, "id": 5}})["trace"] == ""


def test_a_missile_and_its_target() -> None:
    """With another target it passes through a creature."""
    creature = {**BALL, "weenie": {"creature": 1}}
    for target, trace in ((9, ""), (5, "S2"), (0, "S2")):
        mover = {**MOVER, "missile": 1, "target_id": target}
        assert (
            ask("object_call", {**call("object", creature, insert_type=1), "mover": mover})["trace"] == trace
        )


def test_a_sphere_can_be_called_as_a_creature_s() -> None:
    """Only the direct call is told; nobody stands on a creature."""
    inputs = call("sphere", BALL, step_down=1)
    assert ask("object_call", inputs)["result"] == "ADJUSTED"
    assert ask("object_call", {**inputs, "is_creature": 1})["result"] == "OK"


def test_a_transition_onto_a_ball() -> None:
    """It falls by half a metre and rests: 2 metres above the middle, by the plane that retail writes."""
    inputs = {key: value for key, value in call("", BALL).items() if key not in {"path", "function"}}
    fields = ask("object_transition", inputs)
    assert fields["result"] == 1
    assert fields["contact_plane"]["is_water"] == 1
    assert fields["check"]["origin"][2] == 2.0
    placed = ask("object_transition", {**inputs, "from": None, "placement_allows_sliding": 0})
    assert placed["result"] == 0


def test_an_overlap_is_asked_as_a_placement() -> None:
    """What stands inside the first object overlaps it, whether or not it would collide in moving."""
    given = call("", BALL)
    inputs = {key: given[key] for key in ("cell", "objects", "mover")}
    inside, above = {**inputs, "from": POSE}, {**inputs, "from": pose(0.0, 0.0, 9.0)}
    assert ask("check_collisions", inside) == {"r": 1}
    assert ask("check_collisions", above) == {"r": 0}


def test_the_walkable_s_geometry_is_named() -> None:
    """Where the cell's floor supports, its geometry is told."""
    fields = ask("object_call", call("cell", geometry="floor", z=0.25, step_down=1, walkable_allowance=0.6))
    assert (fields["result"], fields["walkable"], fields["walkable_geometry"]) == ("ADJUSTED", 0, "floor")


def test_a_shape_of_an_object_without_parts_is_an_error() -> None:
    """The message names the object."""
    inputs = call("sphere", {**BALL, "no_part_array": 1})
    outcome = OracleCandidate().answer(Query("object_call", inputs, {}))
    assert isinstance(outcome, Errored)
    assert "object 5 has no part array" in outcome.context


def test_what_retail_does_is_not_always_known() -> None:
    """07 11: the head overlaps, the feet are beside: skipped, with the reason."""
    mover = {**MOVER, "spheres": [[3.0, 0.0, 0.0, 0.5], [0.0, 0.0, 0.0, 0.5]]}
    inputs = {**call("sphere", BALL, z=0.0, step_down=1), "mover": mover}
    outcome = OracleCandidate().answer(Query("object_call", inputs, {}))
    assert isinstance(outcome, Skipped)
    assert outcome.reason.startswith("retail's answer is not known: ")


def test_time_of_collision() -> None:
    """A double: 0.5 for 4 metres towards a sphere 3 metres away, and -1 for none."""
    inputs = {"movement": [4.0, 0.0, 0.0], "disp": [-3.0, 0.0, 0.0], "radsum": 1.0}
    assert ask("find_time_of_collision", inputs) == {"t": 0.5}
    assert ask("find_time_of_collision", {**inputs, "disp": [-3.0, 2.0, 0.0]}) == {"t": -1.0}
