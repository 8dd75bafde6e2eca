"""The benchmark's scenes and queries: turned, of the promised sizes, and as movers meet them."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest

from conformance.bench import sampling
from conformance.bench.scenes import BenchScene, hall_geometry, hall_scene, make_scene, single
from conformance.bench.spots import RADIUS, Surfaces, near_surfaces, up_in_cell
from conformance.bench.work import batches
from engine import find_collisions_many, resolve_many
from engine.constants import ADJUSTED, OK

COUNT = 200


@cache
def scene() -> BenchScene:
    """Return the room."""
    return make_scene("room")


@cache
def surfaces() -> Surfaces:
    """Return its polygons."""
    return Surfaces(scene().geometry)


def generator() -> np.random.Generator:
    """Return random numbers that are the same in every test."""
    return np.random.default_rng(11)


@pytest.mark.parametrize(("name", "least", "most"), [("room", 50, 80), ("building", 450, 600)])
def test_scenes_have_the_promised_size(name: str, least: int, most: int) -> None:
    """About 60 polygons, about 500."""
    assert least <= make_scene(name).size <= most


def test_no_face_is_along_an_axis() -> None:
    """No component of any normal is 0 or 1, where rounding would do nothing."""
    assert np.abs(surfaces().normals).min() > 1e-3
    assert np.abs(surfaces().normals).max() < 1.0


def test_up_is_oblique_in_the_cell_and_floors_can_be_walked_on() -> None:
    """The pose tilts the cell back, but not wholly."""
    up = up_in_cell(scene())
    assert np.abs(up).min() > 0.01
    assert len(surfaces().facing(up)) >= 4
    assert len(surfaces().walls(up)) >= 8


def test_numbers_are_float32() -> None:
    """Everything that is asked can be stored by retail."""
    work = sampling.strikes(scene(), surfaces(), generator(), COUNT)
    for array in (work.spheres, work.movements, work.ups):
        assert (array == single(array)).all()


def test_the_same_seed_asks_the_same() -> None:
    """The printed seed makes the queries again."""
    first, second = (near_surfaces(surfaces(), generator(), COUNT)[0] for _ in range(2))
    assert (first == second).all()


def test_spheres_are_near_surfaces() -> None:
    """Centres are within one and a half radii of a polygon's plane."""
    spheres, directions = near_surfaces(surfaces(), generator(), COUNT)
    middles = surfaces().corners[:, 0]
    offsets = np.einsum("pd,pd->p", surfaces().normals, middles)
    distances = np.abs(spheres[:, :3] @ surfaces().normals.T - offsets).min(axis=1)
    assert distances.max() <= 1.5 * RADIUS + 1e-5
    assert np.linalg.norm(directions, axis=1) == pytest.approx(np.ones(COUNT))


def test_walkers_stand_and_many_are_stopped() -> None:
    """Every walk begins in contact; a good share of strides ends short of its aim."""
    work = sampling.contact_walk(scene(), surfaces(), generator(), COUNT)
    assert (work.rows["contact_plane_valid"] == 1).all()
    moved = resolve_many(scene().world, work.rows)
    short = np.abs(moved["curr"][:, -3:-1] - work.rows["end"][:, -3:-1]).max(axis=1) > 1e-3
    assert 0.1 < short.mean() < 0.9


def test_nothing_is_in_the_way_of_free_flight() -> None:
    """Every flight ends exactly where it was meant to, and has touched nothing."""
    work = sampling.free_flight(scene(), generator(), COUNT)
    moved = resolve_many(scene().world, work.rows)
    assert (moved["curr"][:, -3:] == work.rows["end"][:, -3:]).all()
    assert not moved["collision_normal_valid"].any()
    assert not moved["contact_plane_valid"].any()


def test_tree_calls_have_different_outcomes() -> None:
    """Some calls pass, some are adjusted or pushed: not one branch is clocked alone."""
    work = sampling.tree_calls(scene(), surfaces(), generator(), COUNT)
    outcomes = set(find_collisions_many(scene().world, work.rows)["result"].tolist())
    assert {float(OK), float(ADJUSTED)} <= outcomes


def test_without_rooms_there_is_no_air() -> None:
    """Of a scene that is not made of rooms it is not known where nothing is in reach."""
    with pytest.raises(sampling.NoAirError, match="hall"):
        sampling.free_flight(hall_scene(hall_geometry()), generator(), 1)


def test_open_walks_have_one_length() -> None:
    """Every move is as long as was asked for, level."""
    work = sampling.open_walk(hall_scene(hall_geometry()), generator(), COUNT, 1.5, 1.0)
    steps = work.rows["end"][:, -3:] - work.rows["start"][:, -3:]
    assert (steps[:, 2] == 0.0).all()
    assert np.hypot(steps[:, 0], steps[:, 1]) == pytest.approx(np.full(COUNT, 1.5), abs=1e-4)


def test_parts_share_no_query() -> None:
    """Parts of work that do not overlap make up the whole."""
    work = sampling.strikes(scene(), surfaces(), generator(), COUNT)
    parts = [work.part(first, first + 50) for first in range(0, COUNT, 50)]
    assert (np.concatenate([part.spheres for part in parts]) == work.spheres).all()


def test_calls_cover_all_queries() -> None:
    """The last call is as long as what is left."""
    assert batches(5, 2) == [(0, 2), (2, 4), (4, 5)]
