"""The worlds that a candidate has built of the last few records: many queries share one."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Final, Generic, TypeVar

from conformance.inputs import geometry_names

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from conformance.scenes.model import Geometry

W = TypeVar("W")

KEPT_WORLDS: Final = 32
"""How many worlds are kept for the next query."""


@dataclass(frozen=True, slots=True)
class _Kept(Generic[W]):
    """A world, and what it was made of."""

    record: Mapping[str, Any]
    geometries: Mapping[str, Geometry]
    world: W


class KeptWorlds(Generic[W]):
    """Builds the world of a record, unless it is one of the last few.

    A record is recognised by identity. What a query changes in a world (its clock, what is registered
    in it) must not be in one that is kept.

    Parameters
    ----------
    build : callable
        Makes a world of a WORLD record of FORMAT.md and the geometries that it names.
    """

    def __init__(self, build: Callable[[Mapping[str, Any], Mapping[str, Geometry]], W]) -> None:
        self._build = build
        self._kept: list[_Kept[W]] = []

    def world_of(self, record: Mapping[str, Any], geometries: Mapping[str, Geometry]) -> W:
        """Return the world of a record, the same one for the same record and geometry objects."""
        for kept in self._kept:
            if kept.record is record and all(geometries[k] is g for k, g in kept.geometries.items()):
                return kept.world
        used = {name: geometries[name] for name in geometry_names(record)}
        world = self._build(record, geometries)
        self._kept = [_Kept(record, used, world), *self._kept[: KEPT_WORLDS - 1]]
        return world
