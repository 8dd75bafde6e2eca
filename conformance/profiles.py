"""Hypothesis profiles of the random queries: `ci`, `default`, `soak`."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Final

from hypothesis import HealthCheck, Phase, settings
from hypothesis.database import DirectoryBasedExampleDatabase

if TYPE_CHECKING:
    from collections.abc import Mapping

CI: Final = "ci"
DEFAULT: Final = "default"
SOAK: Final = "soak"

_DATABASE: Final = ".hypothesis/examples"
"""Where Hypothesis keeps failing examples by itself, too."""
_SLOW_GENERATION: Final = (HealthCheck.too_slow, HealthCheck.data_too_large)
"""A scene with its tree is a large example; how long it takes depends on the machine."""
_NO_EXPLANATION: Final = tuple(phase for phase in Phase if phase is not Phase.explain)
"""The report names the differing fields; explaining would ask many more queries after the shrinking."""


def profiles() -> Mapping[str, settings]:
    """Return the settings of each profile; `max_examples` is per law, a law may ask for a multiple.

    `ci` gives the same queries every time and keeps no database; `default` adds the failures it has found
    before; `soak` runs long, on demand.
    """
    common = settings(
        deadline=None, suppress_health_check=_SLOW_GENERATION, phases=_NO_EXPLANATION, print_blob=True
    )
    # Both are said in every profile: what is not said comes from the profile that is loaded just now.
    fresh = settings(common, derandomize=False, database=DirectoryBasedExampleDatabase(_DATABASE))
    return {
        CI: settings(common, max_examples=100, derandomize=True, database=None),
        DEFAULT: settings(fresh, max_examples=100),
        SOAK: settings(fresh, max_examples=20_000),
    }


def register() -> None:
    """Make the profiles known to Hypothesis and load `ci` on a CI machine, else `default`.

    ``--hypothesis-profile`` overrides the choice, if this runs before Hypothesis's plug-in is configured: at
    the top of a ``conftest.py``.
    """
    for name, profile in profiles().items():
        settings.register_profile(name, profile)
    settings.load_profile(CI if os.environ.get("CI") else DEFAULT)


def scaled(multiple: float) -> settings:
    """Return the loaded profile with its number of examples multiplied."""
    loaded = settings.get_profile(settings.get_current_profile_name())
    return settings(loaded, max_examples=max(1, round(loaded.max_examples * multiple)))
