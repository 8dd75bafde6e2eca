"""Geometries and worlds of its own, for an oracle that builds other ones than retail's."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any
from weakref import WeakKeyDictionary

from conformance.candidates.kept_worlds import KeptWorlds
from conformance.candidates.oracle_ops import geometry, world
from conformance.candidates.replacements import Method

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from conformance.candidates.replacements import Replacement
    from conformance.scenes.model import Geometry
    from oracle.world import World


def own_caches() -> tuple[Replacement, ...]:
    """Return replacements of the caches by new, empty ones, for things that are made in another way."""
    return (
        Method(geometry, "CACHE", always(WeakKeyDictionary())),
        Method(world, "CACHE", always(KeptWorlds(_build_world))),
    )


def always(value: Any) -> Callable[[Any], Any]:
    """Make a `Method` whose wrong value does not depend on retail's."""
    return lambda _retail: value


def _build_world(record: Mapping[str, Any], geometries: Mapping[str, Geometry]) -> World:
    """Make a world with what stands for the oracle's builder now."""
    return world.build_world(record, geometries)
