"""What a campaign has come to: each shard once, in any order."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import pytest
from hypothesis import given
from hypothesis import strategies as st
from soak_runs import KIND, shard_result

from conformance import exit_codes
from conformance.soak.tally import Tally, UnlikeShardError
from conformance.soak.workshop import Spot

if TYPE_CHECKING:
    from conformance.soak.records import ShardResult


def right(shard: int, **changes: Any) -> ShardResult:
    """Return the result of a shard in which nothing fails."""
    return shard_result(shard, **{"differed": 0, "failures": [], **changes})


@given(st.permutations(range(4)))
def test_the_order_of_shards_does_not_count(order: list[int]) -> None:
    """Counts are the same, and so is which failure is the first."""
    tally = Tally()
    assert all(tally.add(shard_result(shard)) for shard in order)
    assert (tally.shards, tally.queries, tally.agreed, tally.differed) == (4, 40, 28, 8)
    assert (tally.skipped, tally.asked) == ({"engine: no": 4}, {"worlds": 40})
    failing = tally.failing[KIND]
    assert (failing.count, failing.first, failing.said) == (8, Spot(KIND, 0, 1), "x in 0")
    assert 3 in tally
    assert 4 not in tally


def test_a_shard_counts_once() -> None:
    """Asked again, it must come out the same; only the time may differ."""
    tally = Tally()
    assert tally.add(shard_result(1))
    assert not tally.add(shard_result(1, seconds=9.0))
    assert (tally.shards, tally.queries, tally.seconds) == (1, 10, 0.5)


@pytest.mark.parametrize("changes", [{"answers": "b"}, {"agreed": 8, "differed": 1}, {"complaints": ["x"]}])
def test_a_shard_that_comes_out_differently_is_an_error(changes: dict[str, Any]) -> None:
    """Whichever part of it it is."""
    tally = Tally()
    tally.add(shard_result(1))
    with pytest.raises(UnlikeShardError, match=r"^shard 1 was asked twice and came out differently"):
        tally.add(shard_result(1, **changes))


@pytest.mark.parametrize(
    ("results", "code"),
    [
        ([], exit_codes.NOTHING_RAN),
        ([right(0, agreed=0, skipped={"no": 8})], exit_codes.NOTHING_RAN),
        ([right(0)], exit_codes.OK),
        ([right(0), right(1, errored=1)], exit_codes.BROKEN),
        ([right(0, complaints=["late"])], exit_codes.BROKEN),
        ([right(0, errored=1), shard_result(1)], exit_codes.FAILURES),
    ],
)
def test_how_a_campaign_ends(results: list[ShardResult], code: int) -> None:
    """A wrong answer counts more than a missing one, and that more than a right one."""
    tally = Tally()
    for one in results:
        tally.add(one)
    assert tally.exit_code == code
