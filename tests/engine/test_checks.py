"""Input of the wrong kind: the engine answers, or says where it is wrong, whatever a field is."""

from __future__ import annotations

import math
import pickle
from dataclasses import fields, replace
from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

from engine import (
    Body,
    Building,
    BuildingPortal,
    Cell,
    CollisionCall,
    ContactPlane,
    EngineError,
    InputError,
    LandBlock,
    Leaf,
    Move,
    Mover,
    Node,
    ObjectCall,
    Obstacle,
    Part,
    PathState,
    Plan,
    Portal,
    Pose,
    QueryError,
    Restriction,
    Seed,
    Shape,
    Stage,
    UndeterminedError,
    Weenie,
    World,
    find_collisions,
    find_collisions_many,
    find_object_collisions,
    find_object_collisions_many,
    find_visible_child_cell,
    place,
    resolve,
    resolve_many,
    set_elasticity,
    set_local_velocity,
    set_velocity,
    step,
    step_many,
    strike_many,
    update_many,
)
from engine import layout as at
from engine.body import body_rows
from engine.body_layout import BODY_DTYPE
from engine.checks import finite, flag, keyed, number, optional, record, several, told, whole
from engine.tracing import UnknownTopicError

if TYPE_CHECKING:
    from collections.abc import Callable

CELL = 0xA9B40100
ERRORS = [QueryError("move 3", "lost"), UndeterminedError(3, [1.0]), UnknownTopicError("steps")]
HERE, THERE = Pose(CELL, (50.0, 50.0, 0.0)), Pose(CELL, (50.2, 50.0, 0.0))
LEAF = Leaf((0.0, 0.0, 0.0, 10.0), (0,))
CORNERS = [(-5.0, -5.0, 0.0), (5.0, -5.0, 0.0), (0.0, 5.0, 0.0)]
FLOOR = Shape(CORNERS, [(0, 1, 2)], LEAF)
SOLID = Obstacle(HERE, state=0x10001, parts=[Part(FLOOR)])
MOVER = Mover([(0.0, 0.0, 0.5, 0.5)], step_down_height=1.5)
PLANE = ContactPlane((0.0, 0.0, 1.0, 0.0), CELL)
MOVE = Move(MOVER, THERE, CELL, HERE, Seed(PLANE, PLANE, (1.0, 0.0, 0.0)))


def deep() -> list[Any]:
    """Return a list in a list in a list, deeper than Python follows."""
    nested: list[Any] = []
    for _ in range(5000):
        nested = [nested]
    return nested


def cyclic() -> list[Any]:
    """Return a list that holds itself."""
    endless: list[Any] = []
    endless.append(endless)
    return endless


HOSTILE: dict[str, Any] = {
    "nothing": None,
    "text": "x",
    "bytes": b"\xff",
    "nan": math.nan,
    "infinite": math.inf,
    "negative": -1,
    "fraction": 1.5,
    "huge": 1 << 70,
    "beyond float32": 1e300,
    "empty": [],
    "ragged": [[1, 2], [3]],
    "not finite": [math.nan] * 3,
    "mapping": {},
    "object": object(),
    "nested": deep(),
    "cyclic": cyclic(),
}


def world(*cells: Cell, **more: Any) -> World:
    """Return a world of one cell, unless others are given."""
    return World(cells or [Cell(CELL, HERE, FLOOR)], **more)


def floored(tree: Any) -> Any:
    """Compile the floor with another tree."""
    return world(Cell(CELL, HERE, Shape(CORNERS, [(0, 1, 2)], tree)))


def with_object(thing: Any) -> Any:
    """Compile a cell with an object in it, and one that has to be registered."""
    return world(Cell(CELL, HERE, FLOOR, [thing])), world(objects=[thing])


def with_building(building: Any) -> Any:
    """Compile a building on a block."""
    return World(landblocks=[LandBlock(0xA9B4, [0.0] * 81)], buildings=[building])


PUBLIC: list[tuple[Any, Callable[[Any], Any]]] = [
    (HERE, lambda pose: (world(Cell(CELL, pose, FLOOR)), resolve(world(), replace(MOVE, start=pose)))),
    (
        Cell(CELL, HERE, FLOOR, [SOLID], [CELL + 1], [CELL]),
        lambda cell: world(cell, Cell(CELL + 1, HERE, FLOOR)),
    ),
    (Portal(CELL + 1, CORNERS), lambda portal: world(Cell(CELL, HERE, FLOOR, portals=[portal]))),
    (LandBlock(0xA9B4, [0.0] * 81, [0] * 81), lambda block: World(landblocks=[block])),
    (Building(HERE, FLOOR, [BuildingPortal(CELL)]), with_building),
    (BuildingPortal(CELL), lambda portal: with_building(Building(HERE, FLOOR, [portal]))),
    (SOLID, with_object),
    (Obstacle(HERE, spheres=[(0.0, 0.0, 0.0, 1.0)]), with_object),
    (Part(FLOOR), lambda part: with_object(replace(SOLID, parts=[part]))),
    (Weenie(), lambda weenie: with_object(replace(SOLID, weenie=weenie))),
    (Restriction([1]), lambda restriction: world(restrictions={CELL: restriction})),
    (LEAF, floored),
    (Node((0.0, 0.0, 1.0, 0.0), LEAF.sphere, LEAF, LEAF), floored),
    (MOVER, lambda mover: resolve(world(), replace(MOVE, mover=mover))),
    (PLANE, lambda plane: resolve(world(), replace(MOVE, seed=Seed(plane, plane)))),
    (MOVE.seed, lambda seed: resolve(world(), replace(MOVE, seed=seed))),
    (MOVE, lambda move: resolve(world(), move)),
    (CollisionCall(MOVE), lambda call: find_collisions(world(), call)),
    (ObjectCall(MOVE), lambda call: find_object_collisions(world(Cell(CELL, HERE, FLOOR, [SOLID])), call)),
    (PathState(), lambda path: find_collisions(world(), CollisionCall(MOVE, path=path))),
    (Body(HERE, MOVER.spheres, velocity=(0.0, 0.0, -3.0)), lambda body: step(world(), body, 0.1)),
]


def refusal(ask: Callable[[], Any]) -> InputError | None:
    """Ask, and return the error with which the input is refused; none if it is answered."""
    try:
        ask()
    except InputError as error:
        return error
    except EngineError:
        return None
    return None


@pytest.mark.parametrize(("given", "ask"), PUBLIC, ids=lambda value: type(value).__name__)
@pytest.mark.filterwarnings("ignore:overflow encountered:RuntimeWarning")
def test_a_field_of_the_wrong_kind(given: Any, ask: Callable[[Any], Any]) -> None:
    """Each field in turn is something else: either that is fine, or the error has a place and words."""
    ask(given)
    refused = set()
    for field in fields(given):
        for kind, value in HOSTILE.items():
            error = refusal(partial(ask, replace(given, **{field.name: value})))
            if error is not None:
                refused.add(kind)
                assert error.where, (field.name, kind)
                assert 0 < len(error.problem) < 300, (field.name, kind)
    assert {"text", "object", "mapping"} <= refused


@pytest.mark.parametrize("name", ["cells", "landblocks", "buildings", "shadows", "objects", "restrictions"])
def test_a_world_of_the_wrong_kind(name: str) -> None:
    """What is no sequence of cells, or a sequence of something else, is refused by name."""
    for value in HOSTILE.values():
        others: list[Any] = [value, [value], {CELL: value}, {-1: value}, {"x": value}]
        for given in others:
            error = refusal(partial(World, **{name: given}))
            if error is None:
                assert given is None or not given
            else:
                assert error.where.startswith(name)


def test_queries_of_the_wrong_kind() -> None:
    """A batch of something else, a tree of something else, and threads that are no number."""
    for value in HOSTILE.values():
        with pytest.raises(InputError):
            resolve(world(), value)
        with pytest.raises(InputError):
            floored(value)
        if value != HOSTILE["huge"]:  # more threads than queries are as many
            with pytest.raises(QueryError, match="threads: "):
                resolve_many(world(), [MOVE], threads=value)
    assert len(resolve_many(world(), [])) == 0


@pytest.mark.parametrize(
    ("value", "said"),
    [
        (1 << 32, "4294967296 is not a 32-bit number"),
        (-1, "-1 is not a 32-bit number"),
        (2.0, "2.0 where a whole number is needed"),
        ("9" * 99, "a value of type str where a whole number is needed"),
        ([], "a value of type list where a whole number is needed"),
    ],
)
def test_whole_numbers(value: Any, said: str) -> None:
    """Ids and bit fields have 32 bits; what a message shows is never long."""
    whole()(0xFFFF_FFFF, "here", QueryError)
    whole()(np.uint32(7), "here", QueryError)
    with pytest.raises(QueryError) as caught:
        whole()(value, "here", QueryError)
    assert str(caught.value) == f"here: {said}"


def test_limits_belong_to_a_range() -> None:
    """Both ends are inside."""
    for value in (1, 3):
        whole(1, 3)(value, "here", QueryError)
    with pytest.raises(QueryError, match="here: 4 is not between 1 and 3"):
        whole(1, 3)(4, "here", QueryError)


def test_flags_and_numbers() -> None:
    """0 and 1 are truth values, 2 is none; a finite number may be beyond float32."""
    for value in (True, 0, np.bool_(False)):
        flag(value, "here", QueryError)
    with pytest.raises(QueryError, match="here: 2 where true or false is needed"):
        flag(2, "here", QueryError)
    finite(1e300, "here", QueryError)
    number(math.nan, "here", QueryError)
    with pytest.raises(QueryError, match="here: nan where a finite number is needed"):
        finite(math.nan, "here", QueryError)


def test_places_lead_to_the_field() -> None:
    """Items, keys and fields are named on the way."""
    check = keyed(several(record(Pose, cell=optional(whole()))))
    check({1: [Pose(2)]}, "top", QueryError)
    with pytest.raises(QueryError) as caught:
        check({1: [Pose(2), Pose(-3)]}, "top", QueryError)
    assert caught.value.where == "top, 0x00000001[1], cell"


def test_what_is_told_is_short() -> None:
    """Deep and endless values are told by their type."""
    assert [told(value) for value in (None, 1.5, "a", deep())] == [
        "None",
        "1.5",
        "'a'",
        "a value of type list",
    ]


@pytest.mark.parametrize("world", [None, 3, ()])
def test_what_is_no_world_is_told(world: Any) -> None:
    """Every question refuses what is no world, whatever else it is given."""
    rows = np.zeros(1, at.QUERY_DTYPE)
    bodies = np.zeros(1, BODY_DTYPE)
    questions: list[Callable[[], Any]] = [
        lambda: resolve_many(world, rows),
        lambda: resolve_many(world, []),
        lambda: find_collisions_many(world, rows),
        lambda: find_collisions_many(world, []),
        lambda: find_object_collisions_many(world, []),
        lambda: strike_many(world, 0, [[0.0, 0.0, 0.0, 1.0]], [[0.0, 0.0, 1.0]]),
        lambda: step_many(world, bodies, 0.1, 1),
    ]
    for ask in questions:
        with pytest.raises(QueryError, match=r"^world: .* where a World is needed$"):
            ask()


def test_bodies_are_rows() -> None:
    """What ticks together is an array, and a list of bodies is told so."""
    world = World([Cell(CELL, Pose(CELL, (0.0, 0.0, 0.0)), FLOOR)])
    with pytest.raises(QueryError, match=r"^rows: list where an array of BODY_DTYPE is needed$"):
        step_many(world, [Body(HERE, [(0.0, 0.0, 0.5, 0.5)])], 0.1, 1)  # type: ignore[arg-type]


def bodies() -> tuple[World, Any]:
    """Return a world, and rows of one body in it."""
    world = World([Cell(CELL, Pose(CELL, (0.0, 0.0, 0.0)), FLOOR)])
    return world, body_rows(world, [Body(HERE, [(0.0, 0.0, 0.5, 0.5)])])


def unwritable(rows: Any) -> Any:
    """Return a copy that may only be read."""
    copy = rows.copy()
    copy.flags.writeable = False
    return copy


def unaligned(rows: Any) -> Any:
    """Return a copy that begins between two numbers."""
    room = np.zeros(rows.nbytes + 1, np.uint8)
    room[1:] = rows.view(np.uint8)
    return room[1:].view(rows.dtype)


@pytest.mark.parametrize(
    ("change", "said"),
    [
        (lambda _: np.zeros(12), "not of engine.body_layout.BODY_DTYPE"),
        (lambda rows: rows["velocity"].copy(), "not of engine.body_layout.BODY_DTYPE"),
        (lambda rows: rows.reshape(1, 1), r"shape \(1, 1\) where one row for each body is needed"),
        (lambda rows: np.repeat(rows, 4)[::2], "not contiguous"),
        (unwritable, "not writable, or not aligned"),
        (unaligned, "not writable, or not aligned"),
    ],
)
def test_kernels_write_to_bodies_only(change: Callable[[Any], Any], said: str) -> None:
    """Whoever changes rows in place takes nothing else for them: a kernel would write beyond its end."""
    world, rows = bodies()
    wrong = change(rows)
    velocities = np.zeros((len(wrong), 3))
    questions: list[Callable[[], Any]] = [
        lambda: set_velocity(wrong, velocities),
        lambda: set_local_velocity(wrong, velocities),
        lambda: set_elasticity(wrong, velocities[:, 0]),
        lambda: step_many(world, wrong, 0.1, 1),
        lambda: update_many(world, wrong, 0.1),
    ]
    for ask in questions:
        with pytest.raises(QueryError, match=rf"^rows: {said}$"):
            ask()


@pytest.mark.parametrize("ticks", [2.5, math.nan, -1, 10**18, "2", None])
def test_ticks_are_counted(ticks: Any) -> None:
    """In whole numbers that end some day; none is one of them, and changes nothing."""
    world, rows = bodies()
    with pytest.raises(QueryError, match=r"^ticks: "):
        step_many(world, rows, 0.1, ticks)
    assert step_many(world, rows.copy(), 0.1, 0).tobytes() == rows.tobytes()


@pytest.mark.parametrize("rows", [np.zeros((2, 3), at.QUERY_DTYPE), np.zeros((), at.QUERY_DTYPE)])
def test_queries_are_in_one_row(rows: Any) -> None:
    """Of a table nobody knows which are meant."""
    world, _ = bodies()
    for ask in (resolve_many, find_collisions_many, find_object_collisions_many):
        with pytest.raises(QueryError, match=r"^rows: shape .* where one row for each query is needed$"):
            ask(world, rows)


@pytest.mark.parametrize("plan", [None, Stage.BOUNDS, "none"])
def test_what_is_no_plan_is_told(plan: Any) -> None:
    """A stage is none: a plan says what to do with it."""
    world, rows = bodies()
    empty = np.zeros(0, at.QUERY_DTYPE)
    questions: list[Callable[[], Any]] = [
        lambda: resolve_many(world, empty, plan=plan),
        lambda: find_collisions_many(world, empty, plan=plan),
        lambda: step_many(world, rows, 0.1, 1, plan=plan),
    ]
    for ask in questions:
        with pytest.raises(QueryError, match=r"^plan: .* where a Plan is needed$"):
            ask()
    with pytest.raises(QueryError, match=r"^plan, skip: 'all' where a whole number is needed$"):
        Plan("all")  # type: ignore[arg-type]


def test_what_is_no_cell_or_body_is_told() -> None:
    """With what was found."""
    world, rows = bodies()
    wrong: Any = "hall"
    with pytest.raises(QueryError, match=r"^cell: 'hall' where a whole number is needed$"):
        find_visible_child_cell(world, wrong, (0.0, 0.0, 0.0), search_stabs=True)
    with pytest.raises(QueryError, match=r"^cell: 'hall' where a whole number is needed$"):
        place(world, rows[0], HERE, wrong)
    for ask in (lambda: step(world, wrong, 0.1), lambda: place(world, wrong, HERE, CELL)):
        with pytest.raises(
            QueryError, match=r"^body: 'hall' where a Body, or a record of BODY_DTYPE, is needed$"
        ):
            ask()
    with pytest.raises(QueryError, match=r"^velocities: not an array of numbers \(int too large"):
        set_velocity(rows, [[10**400, 0, 0]])


@pytest.mark.parametrize("error", ERRORS)
def test_errors_go_to_other_processes(error: EngineError) -> None:
    """As what they are, with all that they say: a pool waits for ever for one that cannot be read."""
    read = pickle.loads(pickle.dumps(error))  # noqa: S301 - our own
    assert type(read) is type(error)
    assert str(read) == str(error)
    assert vars(read) == vars(error)
