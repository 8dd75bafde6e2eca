"""Features: what a query may need besides its operation, so that an engine can say what it leaves out."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, Final

from conformance.query import Skipped

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping
    from collections.abc import Set as AbstractSet

    from conformance.query import Query

FEATURES: Final[Mapping[str, str]] = {
    "two-spheres": "movers and bodies of two spheres",
    "scale": "movers, cells' trees and objects of another scale than 1",
    "objects": "things in cells: statics, objects, shadow lists",
    "several-cells": "more than one interior cell, with portals between them",
    "land": "worlds with landblocks",
    "buildings": "worlds with buildings",
    "restrictions": "cells and land that admit only some movers",
    "placement": "movers that are placed, not moved: no `from`, or another insert type",
    "not-finite": "NaN and infinite numbers among the inputs",
}
"""Every feature of protocol v1, and what an engine that declares it understands."""


def _is_there(value: Any) -> bool:
    return bool(value)


def _is_several(value: Any) -> bool:
    return len(value) > 1


def _is_scaled(value: Any) -> bool:
    return value is not None and value != 1.0


_OF_KEY: Final[Mapping[str, tuple[str, Callable[[Any], bool]]]] = {
    "scale": ("scale", _is_scaled),
    "statics": ("objects", _is_there),
    "objects": ("objects", _is_there),
    "shadow": ("objects", _is_there),
    "cells": ("several-cells", _is_several),
    "landblocks": ("land", _is_there),
    "buildings": ("buildings", _is_there),
    "restrictions": ("restrictions", _is_there),
    "insert_type": ("placement", _is_there),
}
"""The feature that a key of inputs asks for, wherever it stands, and for which values."""


def undeclared(query: Query, ops: AbstractSet[str], features: AbstractSet[str]) -> Skipped | None:
    """Return why an engine is not asked a query: it has not declared the operation, or a feature of it."""
    if query.op not in ops:
        return Skipped(f"operation {query.op} is not declared")
    if features >= FEATURES.keys():
        return None
    missing = next((name for name in needed_features(query.inputs) if name not in features), None)
    return None if missing is None else Skipped(f"feature {missing} is not declared ({FEATURES[missing]})")


def needed_features(inputs: Mapping[str, Any]) -> list[str]:
    """Return the features that the inputs of an operation need, in the order of `FEATURES`."""
    found: set[str] = set()
    _search(inputs, found)
    if any(len((inputs.get(who) or {}).get("spheres", ())) > 1 for who in ("mover", "body")):
        found.add("two-spheres")
    if inputs.get("from", inputs) is None:
        found.add("placement")
    return [name for name in FEATURES if name in found]


def _search(value: Any, found: set[str]) -> None:
    """Look for what needs a feature, wherever it stands."""
    if isinstance(value, float):
        if not math.isfinite(value):
            found.add("not-finite")
    elif isinstance(value, dict):
        for key, item in value.items():
            if key in _OF_KEY:
                feature, needs = _OF_KEY[key]
                if needs(item):
                    found.add(feature)
            _search(item, found)
    elif isinstance(value, list | tuple):
        for item in value:
            _search(item, found)
