"""Hypothesis profiles: which there are, and which one a run gets."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest
from hypothesis import Phase, settings

from conformance.profiles import CI, DEFAULT, SOAK, profiles, register, scaled

if TYPE_CHECKING:
    from collections.abc import Iterator


@pytest.fixture(autouse=True)
def profile_kept() -> Iterator[None]:
    """Leave the profile of this run as it was."""
    before = settings.get_current_profile_name()
    yield
    settings.load_profile(before)


def test_ci_asks_the_same_every_time() -> None:
    """The profile of gates is derandomised, without database and deadline, and prints its blobs."""
    ci = profiles()[CI]
    assert ci.derandomize
    assert ci.database is None
    assert ci.deadline is None
    assert ci.print_blob


@pytest.mark.parametrize("loaded", [CI, DEFAULT, SOAK])
def test_soak_runs_long(loaded: str) -> None:
    """The profile for long runs asks two hundred times as much, at random, and remembers; always."""
    register()
    settings.load_profile(loaded)
    every = profiles()
    assert every[SOAK].max_examples == 200 * every[DEFAULT].max_examples
    assert not every[SOAK].derandomize
    assert every[SOAK].database is not None


def test_no_profile_explains_by_asking_more() -> None:
    """The comparison names what differs."""
    assert all(Phase.explain not in profile.phases for profile in profiles().values())


@pytest.mark.parametrize(("variable", "name"), [("true", CI), ("", DEFAULT)])
def test_the_machine_chooses(variable: str, name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """On a CI machine the gate's profile is loaded, elsewhere the default one."""
    monkeypatch.setenv("CI", variable)
    register()
    assert settings.get_current_profile_name() == name
    assert settings.default is not None
    assert settings.default.derandomize == (name == CI)


def test_laws_scale_the_profile() -> None:
    """A law asks a multiple of the loaded profile's number of examples, at least one."""
    settings.register_profile("scaled-test", settings(max_examples=40))
    settings.load_profile("scaled-test")
    assert scaled(0.5).max_examples == 20
    assert scaled(0.001).max_examples == 1
