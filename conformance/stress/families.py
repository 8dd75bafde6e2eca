"""The families, by name."""

from __future__ import annotations

from types import MappingProxyType
from typing import TYPE_CHECKING, Final

from conformance.stress import degenerate, drift, rotation, scaling, thresholds, translation

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence

    from conformance.stress.settings import Settings
    from conformance.stress.sweep import Sweep

FAMILIES: Final[Mapping[str, Callable[[Settings], Sequence[Sweep]]]] = MappingProxyType(
    {
        translation.FAMILY: translation.sweeps,
        rotation.FAMILY: rotation.sweeps,
        thresholds.FAMILY: thresholds.sweeps,
        degenerate.FAMILY: degenerate.sweeps,
        drift.FAMILY: drift.sweeps,
        scaling.FAMILY: scaling.sweeps,
    }
)
"""What makes the sweeps of each family, in the order in which they are run."""
