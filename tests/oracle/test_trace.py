"""The trace: nested calls close in order, and an error leaves them open."""

from __future__ import annotations

from dataclasses import dataclass, field

import pytest

from oracle.enums import TransitionState
from oracle.ref import Ref
from oracle.trace import initial_placement, traced


@dataclass
class FakeTransition:
    """What the decorator reads of a transition."""

    trace: list[str] | None = field(default_factory=list)


class Tree:
    """A tree whose calls nest as deep as told."""

    @traced(initial_placement)
    def insert(self, transition: FakeTransition, depth: int) -> TransitionState:
        """Call itself `depth` times."""
        if depth == 0:
            return TransitionState.OK
        self.insert(transition, depth - 1)
        return TransitionState.SLID

    @traced(initial_placement)
    def fail(self, _transition: FakeTransition) -> TransitionState:
        """Raise."""
        raise ValueError("told to")


def test_a_digit_closes_the_innermost_call() -> None:
    """Openings come in order of the calls, results innermost first."""
    transition = FakeTransition()
    assert Tree().insert(transition, 2) is TransitionState.SLID
    assert transition.trace == ["I", "I", "I", "1", "4", "4"]


def test_no_list_no_trace() -> None:
    """None switches the trace off."""
    transition = FakeTransition(None)
    assert Tree().insert(transition, 1) is TransitionState.SLID
    assert transition.trace is None


def test_an_error_passes_through() -> None:
    """The call stays open, so that the trace shows where it happened."""
    transition = FakeTransition()
    with pytest.raises(ValueError, match="told to"):
        Tree().fail(transition)
    assert transition.trace == ["I"]


def test_the_decorated_method_keeps_its_name() -> None:
    """Tools that read docstrings and names see the port, not the wrapper."""
    assert Tree.insert.__name__ == "insert"
    assert Tree.fail.__doc__ == "Raise."


def test_a_reference_shows_its_value() -> None:
    """A memory cell in a failure message can be read."""
    assert repr(Ref(3)) == "Ref(3)"
