"""The limit on processor time."""

from __future__ import annotations

import gc
import sys
from contextlib import suppress

import pytest

from conformance.mutation.watchdog import OutOfTimeError, Watchdog


def test_an_endless_loop_is_ended() -> None:
    """Also one that swallows every ordinary error."""
    with pytest.raises(OutOfTimeError), Watchdog().limit(0.05):
        _swallow_errors()


def test_what_ends_in_time_is_left_alone() -> None:
    """A limit holds for its own block only, and the next one starts anew."""
    watchdog = Watchdog()
    for _ in range(3):
        with watchdog.limit(30.0):
            assert sum(range(100)) == 4950
    with pytest.raises(OutOfTimeError), watchdog.limit(0.0):
        _swallow_errors()


def test_tracing_works_after_a_limit() -> None:
    """An error that was taken back would stop every traced function from beginning."""
    with Watchdog().limit(30.0):
        pass
    called: list[str] = []
    before = sys.gettrace()
    sys.settrace(lambda frame, *_: called.append(frame.f_code.co_name))
    try:
        _traced()
    finally:
        sys.settrace(before)
    assert called == ["_traced"]


def test_nothing_is_collected_in_the_block() -> None:
    """A callback of the collector would swallow the error, once and for all."""
    with Watchdog().limit(30.0):
        assert not gc.isenabled()
    assert gc.isenabled()
    with pytest.raises(OutOfTimeError), Watchdog().limit(0.05):
        _swallow_errors()
    assert gc.isenabled()


def _traced() -> None:
    """Do nothing."""


def _swallow_errors() -> None:
    """Go on for ever, whatever ordinary error there is."""
    while True:
        with suppress(Exception):
            sum(range(100))
