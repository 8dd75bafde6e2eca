"""Every law, by its name."""

from __future__ import annotations

from types import MappingProxyType
from typing import TYPE_CHECKING, Final

from conformance.laws import renaming, signed_axes, splitting, translation

if TYPE_CHECKING:
    from collections.abc import Mapping

    from conformance.laws.law import Law

LAWS: Final[Mapping[str, Law]] = MappingProxyType(
    {law.name: law for module in (renaming, signed_axes, translation, splitting) for law in module.LAWS}
)
