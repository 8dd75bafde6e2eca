"""What queries need besides their operations."""

from __future__ import annotations

import math

import pytest
from shipped_vectors import one_of_each

from conformance.protocol.features import FEATURES, needed_features, undeclared
from conformance.query import Query, Skipped

SPHERE = [0.0, 0.0, 0.5, 0.5]
NEEDS = {
    "two-spheres": {"mover": {"spheres": [SPHERE, SPHERE]}},
    "scale": {"mover": {"spheres": [SPHERE], "scale": 1.5}},
    "objects": {"cells": [{"id": 1, "statics": [{"geometry": "box"}]}]},
    "several-cells": {"cells": [{"id": 1}, {"id": 2}]},
    "land": {"world": {"landblocks": [{"block": 1}]}},
    "buildings": {"world": {"buildings": [{"geometry": "house"}]}},
    "restrictions": {"world": {"restrictions": {"2847146010": {"admits": [7]}}}},
    "placement": {"from": None},
    "not-finite": {"point": [0.0, math.nan, 0.0]},
}


@pytest.mark.parametrize("feature", FEATURES)
def test_each_feature_is_noticed(feature: str) -> None:
    """Alone, where only it is needed."""
    assert needed_features(NEEDS[feature]) == [feature]


def test_plain_queries_need_nothing() -> None:
    """One sphere, one cell, scale 1, finite numbers."""
    plain = {
        "cells": [{"id": 1, "statics": []}],
        "mover": {"spheres": [SPHERE], "scale": 1.0},
        "from": {"cell": 1, "origin": [0.0, 0.0, 0.0]},
        "path": {"insert_type": 0},
        "world": {"landblocks": [], "shadow": {}},
        "body": None,
    }
    assert needed_features(plain) == []


def test_a_placement_is_one_by_its_path_too() -> None:
    """Initial placement has a start."""
    assert needed_features({"from": {}, "path": {"insert_type": 2}}) == ["placement"]


def test_the_shipped_records_need_each_feature() -> None:
    """So each of them is of use."""
    found = {feature for record in one_of_each() for feature in needed_features(record.query.inputs)}
    assert found == set(FEATURES) - {"not-finite", "restrictions"}


def test_what_is_missing_is_named() -> None:
    """First the operation, then the feature with its meaning; a query with all it needs is asked."""
    query = Query("transition", {**NEEDS["scale"], "from": None})
    assert undeclared(query, frozenset(), FEATURES.keys()) == Skipped("operation transition is not declared")
    missing = Skipped(f"feature placement is not declared ({FEATURES['placement']})")
    assert undeclared(query, {"transition"}, {"scale"}) == missing
    assert undeclared(query, {"transition"}, {"scale", "placement"}) is None
    assert undeclared(query, {"transition"}, FEATURES.keys()) is None
