"""Random queries are aimed well: they meet polygons, on every path, and every candidate can be asked them."""

from __future__ import annotations

import math
from collections import Counter
from typing import TYPE_CHECKING

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from conformance.candidates.registry import make_candidate
from conformance.floats import is_float32
from conformance.query import Query, Result
from conformance.strategies.collisions import DISPATCHES, find_collisions, transitions
from conformance.strategies.contact import draw_aim
from conformance.strategies.geometry_queries import BSP_OPS, POLYGON_OPS, geometry_queries
from conformance.strategies.math_queries import FRAME_OPS, MOVER_OPS, frame_queries, mover_queries
from conformance.strategies.numbers import DIRECTIONS, anywhere, grid
from conformance.strategies.poses import ORIGINS, ROTATIONS
from conformance.strategies.scenes import GEOMETRIES, face
from conformance.strategies.walks import TICKS, body_walks, walks

if TYPE_CHECKING:
    from conformance.query import Fields
    from conformance.scenes.model import Geometry, Quaternion, Vec3

ORACLE = make_candidate("oracle")
EPS5 = 0.0009999999747378752
"""Retail's bound on how far a rotation's squared length may be from 1 (01, Frame::IsValid)."""
SAME_EVERY_TIME = settings(
    derandomize=True, database=None, deadline=None, suppress_health_check=[HealthCheck.too_slow]
)
ENOUGH = 200
"""Queries of a sample: Hypothesis draws them in families, so that far fewer may all be alike."""
OF_EACH_PATH = 100
"""Of calls of trees there are nine such samples, which are looked at together, too."""
VARIED_ANSWERS = {
    "polygon_point_in_polygon": "r",
    "polygon_hits_sphere_slow": "r",
    "polygon_pos_hits_sphere": "struck",
    "polygon_walkable_hits_sphere": "r",
    "polygon_check_walkable": "r",
    "polygon_find_crossed_edge": "r",
    "polygon_adjust_sphere_to_plane": "r",
    "bsp_sphere_intersects_poly": "r",
    "bsp_sphere_intersects_solid": "r",
    "bsp_hits_walkable": "r",
    "bsp_find_walkable": "changed",
    "bsp_point_inside_cell": "r",
}
"""Operations with two answers, both of which random queries must reach."""


def answers(queries: st.SearchStrategy[Query], count: int) -> list[Fields]:
    """Ask the oracle `count` queries, the same ones every time."""
    given_answers: list[Fields] = []

    @settings(SAME_EVERY_TIME, max_examples=count)
    @given(queries)
    def ask(query: Query) -> None:
        outcome = ORACLE.answer(query)
        assert isinstance(outcome, Result), outcome
        given_answers.append(outcome.fields)

    ask()
    assert len(given_answers) >= count / 2
    return given_answers


def share(values: list[bool]) -> float:
    """Return the part of values that is true."""
    return sum(values) / len(values)


@pytest.fixture(scope="module")
def collisions() -> dict[str, list[Fields]]:
    """Return the oracle's answers to queries of each path."""
    return {dispatch: answers(find_collisions(dispatch), OF_EACH_PATH) for dispatch in DISPATCHES}


def test_every_path_is_taken(collisions: dict[str, list[Fields]]) -> None:
    """A query meant for a path takes it; ethereal movers take the path of placement."""
    for dispatch, found in collisions.items():
        taken = "placement" if dispatch == "ethereal" else dispatch
        assert {fields["dispatch"] for fields in found} == {taken}


def test_collisions_are_not_all_ok(collisions: dict[str, list[Fields]]) -> None:
    """Of every path at least a tenth meets something, and at least a third of all."""
    hits = {d: [fields["result"] != "OK" for fields in found] for d, found in collisions.items()}
    assert all(share(values) > 0.1 for values in hits.values()), {d: share(v) for d, v in hits.items()}
    assert share([hit for values in hits.values() for hit in values]) > 1 / 3


def test_every_result_is_reached(collisions: dict[str, list[Fields]]) -> None:
    """All four transition states come up, and so do contact planes and walkable polygons."""
    every = [fields for found in collisions.values() for fields in found]
    assert {fields["result"] for fields in every} == {"OK", "COLLIDED", "ADJUSTED", "SLID"}
    assert any(fields["contact_plane"]["valid"] and fields["walkable"] is not None for fields in every)
    assert any(fields["neg_poly_hit"] for fields in every)


def test_transitions_are_mixed() -> None:
    """Transitions succeed and fail, in contact and in the air, with and without a collision."""
    found = answers(transitions(), ENOUGH)
    kinds = Counter(
        (fields["result"], fields["contact_plane"]["valid"], fields["collision_normal"] is not None)
        for fields in found
    )
    assert len(kinds) >= 5
    assert share([len(fields["trace"]) > 2 for fields in found]) > 0.5


def test_walks_meet_things() -> None:
    """Recorded moves stand, slide and fail; every walk has all its ticks."""
    found = answers(walks(), 40)
    ticks = [tick for fields in found for tick in fields["ticks"]]
    assert len(ticks) == len(found) * TICKS
    assert {tick["r"] for tick in ticks} >= {0, 1}
    assert share(["cp" in tick for tick in ticks]) > 0.1
    assert any("cn" in tick for tick in ticks)


def test_bodies_stand_and_fly() -> None:
    """Bodies move in the air and on the ground, and meet things."""
    ticks = [tick for fields in answers(body_walks(), 15) for tick in fields["ticks"]]
    grounded = share([bool(tick["ts"] & 1) for tick in ticks])
    assert 0.05 < grounded < 0.95
    assert any("cn" in tick for tick in ticks)


@pytest.mark.parametrize(("op", "field"), VARIED_ANSWERS.items())
def test_predicates_give_both_answers(op: str, field: str) -> None:
    """A yes-or-no question is answered both ways, each at least once in twenty."""
    yes = share([bool(fields[field]) for fields in answers(geometry_queries(op), ENOUGH)])
    assert 0.05 < yes < 0.95


@pytest.mark.parametrize("op", [*POLYGON_OPS, *BSP_OPS])
def test_geometry_queries_can_be_answered(op: str) -> None:
    """The oracle answers every random query of polygons and trees."""
    assert answers(geometry_queries(op), 5)


@pytest.mark.parametrize("op", FRAME_OPS)
def test_frame_queries_can_be_answered(op: str) -> None:
    """The oracle answers every random query of frames."""
    assert answers(frame_queries(op), 5)


@pytest.mark.parametrize("op", MOVER_OPS)
def test_mover_queries_can_be_answered(op: str) -> None:
    """The oracle answers every random query of movers."""
    assert answers(mover_queries(op), 5)


@settings(SAME_EVERY_TIME, max_examples=50)
@given(grid(-2.0, 2.0), anywhere(-2.0, 2.0))
def test_numbers_are_float32(on_grid: float, number: float) -> None:
    """What is drawn is exact in float32 and in its range."""
    for value in (on_grid, number):
        assert is_float32(value)
        assert -2.0 <= value <= 2.0
    assert (on_grid * 64).is_integer()


@settings(SAME_EVERY_TIME, max_examples=100)
@given(ROTATIONS, DIRECTIONS, ORIGINS)
def test_poses_are_rigid(rotation: Quaternion, direction: Vec3, origin: Vec3) -> None:
    """Rotations pass retail's own check of unit length; directions are unit; origins are in the world."""
    assert all(is_float32(part) for part in rotation)
    assert abs(sum(part * part for part in rotation) - 1.0) <= EPS5
    assert math.isclose(math.hypot(*direction), 1.0)
    assert all(abs(part) <= 254 * 192 for part in origin)


@settings(SAME_EVERY_TIME, max_examples=100)
@given(st.data(), GEOMETRIES, grid(0.125, 1.0))
def test_aims_are_near_their_polygon(data: st.DataObject, geometry: Geometry, radius: float) -> None:
    """A sphere is put within two radii of the plane of a polygon that exists."""
    aim = draw_aim(data.draw, geometry, radius)
    assert abs(aim.distance) <= 2.0 * radius + 1e-3
    normal, corners = face(geometry, aim.polygon)
    assert normal == aim.normal
    offset = sum(n * (c - p) for n, c, p in zip(normal, aim.center, corners[0], strict=True))
    assert math.isclose(offset, aim.distance, abs_tol=1e-4)  # corners are rounded to float32
