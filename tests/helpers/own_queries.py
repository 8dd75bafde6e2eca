"""Queries of the suite's own operations, which no vector file has: those of the built-in cases."""

from __future__ import annotations

import functools
from pathlib import Path
from typing import TYPE_CHECKING

import conformance
from conformance.loader import Vary, load_file
from conformance.own_operations import OWN_OUTPUTS

if TYPE_CHECKING:
    from conformance.query import Query

CASES = Path(conformance.__file__).parent / "cases"
FILES = (
    "cells/shadows.yaml",
    "cells/visible.yaml",
    "houses/entry.yaml",
    "math/combine.yaml",
    "math/path.yaml",
    "math/rays.yaml",
    "objects/overlap.yaml",
    "placement/bodies.yaml",
    "terrain/loading.yaml",
    "ticks/unusual.yaml",
    "transition/steps.yaml",
)
"""Where they are asked."""


@functools.cache
def own_queries() -> dict[str, Query]:
    """Return the first built-in query of each own operation."""
    found: dict[str, Query] = {}
    for name in FILES:
        for case in load_file(CASES / name, Vary(poses=0)).cases:
            if case.op in OWN_OUTPUTS:
                found.setdefault(case.op, case.queries[0])
    assert found.keys() == OWN_OUTPUTS.keys()
    return found
