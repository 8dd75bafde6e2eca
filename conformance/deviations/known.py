"""What a pytest run knows of its candidate's deviations."""

from __future__ import annotations

import datetime as dt
from pathlib import Path
from typing import TYPE_CHECKING, Final

import pytest

from conformance.deviations.files import DeviationError, Deviations, find_deviations, path_of, read_deviations
from conformance.loader import NoCasesError, Vary, load_paths
from conformance.yaml_source import YamlError

if TYPE_CHECKING:
    from collections.abc import Sequence

_DEVIATIONS: Final = pytest.StashKey["Deviations"]()


class BadDeviationsError(Exception):
    """The deviations that a run is to hold its candidate against cannot be read."""


def today() -> dt.date:
    """Return the day by which deviations expire: the same everywhere."""
    return dt.datetime.now(dt.UTC).date()


def deviations_of(config: pytest.Config) -> Deviations:
    """Return what is recorded of a run's candidate, read once.

    Raises
    ------
    BadDeviationsError
        The file that ``--deviations`` names, or the candidate's own, has mistakes or is not there.
    """
    if _DEVIATIONS not in config.stash:
        given = config.getoption("--deviations", None)
        config.stash[_DEVIATIONS] = load_deviations(given, config.getoption("--candidate", "engine"))
    return config.stash[_DEVIATIONS]


def load_deviations(given: str | None, candidate: str) -> Deviations:
    """Read the deviations of a file or of an engine by its name; without either, the candidate's own.

    Raises
    ------
    BadDeviationsError
        They cannot be read.
    """
    try:
        if given is None:
            return find_deviations(candidate)
        return read_deviations(path_of(given) or Path(given))
    except OSError as error:
        raise BadDeviationsError(f"cannot read {given}: {error.strerror or error}") from error
    except (DeviationError, YamlError) as error:
        raise BadDeviationsError(f"not a deviation file:\n{error}") from error


def unknown_cases(
    config: pytest.Config, collected: Sequence[pytest.Item], folders: Sequence[Path]
) -> list[str]:
    """Say which deviations are about no case at all; cases that this run leaves out are cases, too."""
    deviations = deviations_of(config)
    if not deviations.unmatched([item.name for item in collected]):
        return []
    try:
        loaded = load_paths(folders, Vary(poses=0))
    except NoCasesError:
        known = []
    else:
        known = [case.id for case in loaded.cases]
    return [
        f"{entry.location}: the deviation is about no case: {entry.deviation.words}"
        for entry in deviations.unmatched(known)
    ]
