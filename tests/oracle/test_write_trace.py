"""Recording writes: which ones, by whom, and that nothing stays behind."""

from __future__ import annotations

import pytest
from oracle_worlds import CELL, FLOOR, OTHER_CELL, ScriptedCell, at, mover, vec, world_of
from oracle_worlds import transition as make

from conformance.trace_text import line_of, summarise
from oracle.collision_info import CollisionInfo
from oracle.object_info import ObjectInfo
from oracle.plane import Plane
from oracle.sphere_path import SpherePath
from oracle.transition import Transition
from oracle.vector import Vector3
from oracle.world import World
from oracle.write_trace import UnknownTopicError, recording
from oracle.writes import (
    BSP,
    CELL_TRANSIT,
    CONTACT_PLANE,
    LAST_KNOWN_PLANE,
    SLIDING,
    STATE,
    TOPICS,
    WALKABLE,
    WriteTrace,
)

HOOKED = (CollisionInfo, ObjectInfo, Plane, SpherePath, Transition, Vector3)
FLOOR_PLANE = Plane(Vector3(0.0, 0.0, 1.0), -94.0)


def lines(trace: WriteTrace) -> list[str]:
    """Return the trace's lines."""
    return [line_of(entry) for entry in trace.entries]


def assert_restored() -> None:
    """No class of the port has a hook."""
    assert not [owner for owner in HOOKED if "__setattr__" in vars(owner)]


def test_a_landing_line_by_line() -> None:
    """A sphere falls onto a floor: the calls of its tree and every write, in order, with who made it."""
    made = make(world_of(FLOOR), at(0.0, 0.0, 0.7), at(0.0, 0.0, 0.4))
    with recording(made) as trace:
        assert made.find_valid_position() == 1
    assert lines(trace) == [
        "[bsp] Call: A -> ADJUSTED caller=find_env_collisions",
        "[bsp] Call: L -> ADJUSTED caller=find_env_collisions",
        "[cp-write] ContactPlaneValid: 0 -> 1 caller=find_collisions",
        "[cp-write] ContactPlane: n=(0,0,0) D=0.000 -> n=(0,0,1) D=-0.000 caller=find_collisions",
        "[cp-write] ContactPlaneCellId: 0x00000000 -> 0xA9B40111 caller=find_collisions",
        "[walkable] Walkable: none -> polygon 0 caller=find_collisions",
        "[bsp] Call: L -> OK caller=find_env_collisions",
        "[bsp] Call: P -> OK caller=find_env_collisions",
        "[walkable] Walkable: polygon 0 -> none caller=transitional_insert",
        "[lkp-write] LastKnownContactPlaneValid: 0 -> 1 caller=validate_transition",
        (
            "[lkp-write] LastKnownContactPlane: n=(0,0,0) D=0.000 -> n=(0,0,1) D=-0.000 "
            "caller=validate_transition"
        ),
        "[lkp-write] LastKnownContactPlaneCellId: 0x00000000 -> 0xA9B40111 caller=validate_transition",
        "[state] State: 0x0 -> 0x1 caller=validate_transition",
        "[state] State: 0x1 -> 0x3 caller=validate_transition",
    ]


def test_a_summary_by_caller_and_result() -> None:
    """Writes count for the state that the call around them returns, others as outside of any."""
    made = make(world_of(FLOOR), at(0.0, 0.0, 0.7), at(0.0, 0.0, 0.4))
    with recording(made) as trace:
        made.find_valid_position()
    assert summarise(trace.entries) == {
        (BSP, "find_env_collisions"): {"OK": 2, "ADJUSTED": 2},
        (CONTACT_PLANE, "find_collisions"): {"ADJUSTED": 3},
        (WALKABLE, "find_collisions"): {"ADJUSTED": 1},
        (WALKABLE, "transitional_insert"): {"no BSP call": 1},
        (LAST_KNOWN_PLANE, "validate_transition"): {"no BSP call": 3},
        (STATE, "validate_transition"): {"no BSP call": 2},
    }


@pytest.mark.parametrize("topic", TOPICS)
def test_only_the_topics_that_are_asked_for(topic: str) -> None:
    """Each topic alone gives its share of the whole."""
    world = world_of(FLOOR)

    def record(topics: tuple[str, ...]) -> list[str]:
        made = make(world, at(0.0, 0.0, 0.7), at(0.0, 0.0, 0.4))
        with recording(made, topics) as trace:
            made.find_valid_position()
            made.init_sliding_normal(vec(1.0, 0.0, 0.5))
            made.sphere_path.curr_cell = None
        return lines(trace)

    shares = [line for line in record(TOPICS) if line.startswith(f"[{topic}] ")]
    assert shares
    assert record((topic,)) == shares


def test_a_setter_is_one_write_of_its_caller() -> None:
    """A sliding normal is assigned and then normalised in place, which is one change."""
    made = Transition(World())
    with recording(made, (SLIDING,)) as trace:
        made.init_sliding_normal(vec(0.0, -0.6, 0.8))
    assert lines(trace) == [
        "[sliding] SlidingNormalValid: 0 -> 1 caller=outside",
        "[sliding] SlidingNormal: n=(0,0,0) -> n=(0,-1,0) caller=outside",
    ]


def test_the_same_value_again_is_no_write() -> None:
    """Only what changes a bit is told; the sign of a zero is a bit."""
    made = Transition(World())
    made.init_contact_plane(CELL, FLOOR_PLANE, 0)
    with recording(made) as trace:
        made.init_contact_plane(CELL, FLOOR_PLANE, 0)
        assert not trace.entries
        made.init_contact_plane(CELL, Plane(vec(-0.0, 0.0, 1.0), -94.0), 0)
    assert lines(trace) == [
        ("[lkp-write] LastKnownContactPlane: n=(0,0,1) D=-94.000 -> n=(-0,0,1) D=-94.000 caller=outside"),
        "[cp-write] ContactPlane: n=(0,0,1) D=-94.000 -> n=(-0,0,1) D=-94.000 caller=outside",
    ]


def test_two_calls_of_a_function_are_two_writes() -> None:
    """Writes by the same statement of the same function stay apart."""
    made = Transition(World())
    with recording(made, (CONTACT_PLANE,)) as trace:
        for height in (-1.0, -2.0):
            made.init_contact_plane(CELL, Plane(vec(0.0, 0.0, 1.0), height), 0)
    assert [line.split(" -> ")[1] for line in lines(trace) if "ContactPlane:" in line] == [
        "n=(0,0,1) D=-1.000 caller=outside",
        "n=(0,0,1) D=-2.000 caller=outside",
    ]


def test_a_field_of_a_plane_written_directly() -> None:
    """Each assignment from outside of retail is a write, also to a plane that has been put in place since."""
    made = Transition(World())
    ci = made.collision_info
    with recording(made) as trace:
        ci.contact_plane.d = 1.0
        ci.contact_plane = Plane(vec(0.0, 0.0, 1.0), 2.0)
        ci.contact_plane.N = vec(1.0, 0.0, 0.0)
        ci.contact_plane.N.y = 0.5
        ci.contact_plane.assign(FLOOR_PLANE)
    assert [line.removeprefix("[cp-write] ContactPlane: ") for line in lines(trace)] == [
        "n=(0,0,0) D=0.000 -> n=(0,0,0) D=1.000 caller=outside",
        "n=(0,0,0) D=1.000 -> n=(0,0,1) D=2.000 caller=outside",
        "n=(0,0,1) D=2.000 -> n=(1,0,0) D=2.000 caller=outside",
        "n=(1,0,0) D=2.000 -> n=(1,0.5,0) D=2.000 caller=outside",
        "n=(1,0.5,0) D=2.000 -> n=(0,0,1) D=-94.000 caller=outside",
    ]


def test_a_change_too_small_for_three_decimals_is_shown() -> None:
    """Numbers get as many decimals as it takes to tell before from after."""
    made = Transition(World())
    made.init_contact_plane(CELL, FLOOR_PLANE, 0)
    with recording(made) as trace:
        made.collision_info.contact_plane.d = -94.00000762939453
        made.collision_info.contact_plane.N.x = 1e-30
    assert [line.removeprefix("[cp-write] ContactPlane: ") for line in lines(trace)] == [
        "n=(0,0,1) D=-94.00000 -> n=(0,0,1) D=-94.00001 caller=outside",
        "n=(0.0,0.0,1.0) D=-94.00000762939453 -> n=(1e-30,0.0,1.0) D=-94.00000762939453 caller=outside",
    ]


def test_the_foot_is_the_low_point_of_the_check_position() -> None:
    """Lines can end with it; before there is a check position there is none."""
    made = make(world_of(FLOOR), at(1.0, 2.0, 3.0), at(1.0, 2.0, 3.0))
    fresh = Transition(World())
    for transition, foot in ((made, " foot=(1.000,2.000,2.520)"), (fresh, "")):
        with recording(transition, (STATE,)) as trace:
            transition.object_info.state = 0x100
        (entry,) = trace.entries
        assert line_of(entry, with_foot=True) == f"[state] State: 0x0 -> 0x100 caller=outside{foot}"


def test_every_transition_made_inside_is_watched_and_no_other() -> None:
    """Without a transition to watch, those that are made in the block are."""
    before = Transition(World())
    with recording(None, (STATE,)) as trace:
        for state in (1, 2):
            Transition(World()).init_object(mover(), state)
        before.init_object(mover(), 4)
        CollisionInfo().init()
    assert [entry.transition for entry in trace.entries] == [1, 2]
    assert lines(trace) == ["[state] State: 0x0 -> 0x1 caller=init", "[state] State: 0x0 -> 0x2 caller=init"]


def test_a_cell_transit_is_a_change_from_one_cell() -> None:
    """Its first cell is none; another one is, and so is to be nowhere."""
    world = world_of(FLOOR)
    with recording(None, (CELL_TRANSIT,)) as trace:
        made = make(world, at(0.0, 0.0, 0.7), at(0.0, 0.0, 0.4))
        path = made.sphere_path
        path.curr_cell = ScriptedCell([], cell_id=OTHER_CELL)
        path.curr_cell = None
    assert lines(trace) == [
        "[cell-transit] CurrCell: 0xA9B40111 -> 0xA9B40112 caller=outside",
        "[cell-transit] CurrCell: 0xA9B40112 -> none caller=outside",
    ]


def test_nothing_is_recorded_outside_the_block() -> None:
    """After the block the classes are as before and a transition writes unseen."""
    world = world_of(FLOOR)
    with recording(None) as trace:
        made = make(world, at(0.0, 0.0, 0.7), at(0.0, 0.0, 0.4))
    assert_restored()
    recorded = lines(trace)
    made.find_valid_position()
    assert lines(trace) == recorded
    assert made.trace == ["A", "3", "L", "3", "L", "1", "P", "1"]


def test_an_error_leaves_nothing_behind() -> None:
    """The trace holds what was written before, and an open call is told to be unfinished."""
    made = make(world_of(FLOOR), at(0.0, 0.0, 0.7), at(0.0, 0.0, 0.4))

    def fail() -> None:
        assert made.trace is not None
        made.trace.append("K")
        made.collision_info.contact_plane_valid = 1
        raise ValueError("told to")

    with pytest.raises(ValueError, match="told to"), recording(made) as trace:
        fail()
    assert_restored()
    assert lines(trace) == [
        "[bsp] Call: K -> unfinished caller=outside",
        "[cp-write] ContactPlaneValid: 0 -> 1 caller=outside",
    ]
    assert (type(made.trace), made.trace) == (list, ["K"])


def test_a_transition_without_letters_stays_without() -> None:
    """Its calls are recorded nevertheless."""
    made = make(world_of(FLOOR), at(0.0, 0.0, 0.7), at(0.0, 0.0, 0.4))
    made.trace = None
    with recording(made, (BSP,)) as trace:
        made.find_valid_position()
    assert len(trace.entries) == 4
    assert made.trace is None


def test_a_call_that_began_before_the_recording_is_not_told() -> None:
    """Its result closes nothing."""
    made = Transition(World(), trace=["K"])
    with recording(made) as trace:
        assert made.trace is not None
        made.trace.append("4")
    assert not trace.entries
    assert made.trace == ["K", "4"]


def test_recordings_nest() -> None:
    """The inner one's end leaves the outer one running."""
    made = Transition(World())
    with recording(made, (STATE,)) as outer:
        with recording(made, (STATE,)) as inner:
            made.object_info.state = 1
        made.object_info.state = 2
    assert_restored()
    assert lines(inner) == ["[state] State: 0x0 -> 0x1 caller=outside"]
    assert lines(outer) == [*lines(inner), "[state] State: 0x1 -> 0x2 caller=outside"]


def test_an_unknown_topic_is_refused() -> None:
    """Nothing is hooked for it."""
    complaint = r"unknown topic 'cp'; there are: cp-write, "
    with pytest.raises(UnknownTopicError, match=complaint), recording(None, ("cp",)):
        pass
    assert_restored()
