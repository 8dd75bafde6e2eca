"""Parts of the suite."""

from __future__ import annotations

from pathlib import Path

import pytest

from conformance.bench.parts import spread
from conformance.loader import load_paths

FOLDER = Path(__file__).parents[2] / "conformance" / "cases" / "walks"
CASES = load_paths([FOLDER]).cases
assert len(CASES) > 12, f"too few walks in {FOLDER}"


@pytest.mark.parametrize("count", [1, 3, 12])
def test_every_case_is_in_one_part(count: int) -> None:
    """So all parts together are the suite."""
    parts = spread(CASES, count)
    assert len(parts) == count
    assert sorted(case.id for part in parts for case in part) == sorted(case.id for case in CASES)


def test_long_walks_are_shared_out() -> None:
    """No part has more of them than another, and the ticks of all are about the same."""
    ticks = [[len(case.queries[0].inputs.get("ticks", ())) for case in part] for part in spread(CASES, 3)]
    assert max(map(len, ticks)) - min(map(len, ticks)) <= 1
    assert max(map(sum, ticks)) < 1.2 * min(map(sum, ticks))
